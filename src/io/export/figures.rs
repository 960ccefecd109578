//! The figures of a view, and how they are written down.

use super::sampler::{Sampler, Subject};
use super::told::Tell;
use super::viewing::{Tracer, Viewing};
use crate::io::Failure;
use crate::measure::{Figures, by_beams};
use crate::scene::{ASET_CONE, Backing, Lean, Projection, Scope, Viewpoint};
use crate::trace::{Watch, beam};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// Where figures stop following beams when not told: face up a few hundredths of a second's work, tilted some seconds.
const UNRESOLVED: f64 = 1.5e-4;

/// Rays along each side of one of the lattices that figures by rays are sampled on.
pub const LATTICE: u32 = 256;

/// Figures with what says how they came about.
pub struct Measured<'a> {
    /// How the stone was looked at.
    pub viewing: Viewing<'a>,
    /// The light whose bands are the zones: the ASET's, with the head.
    pub scope: Scope,
    /// What came of it.
    pub figures: Figures,
    /// What followed rays; none for exact beams.
    pub sampler: Option<Sampler<'a>>,
    /// How long it took.
    pub seconds: f64,
}

/// Measures a stone's ASET zones.
///
/// # Errors
/// Those of [`Viewing::check`], what `tell` answers, or [`Failure::Stopped`] when `watch` asks to stop.
pub fn measure<'a>(viewing: &Viewing<'a>, watch: Watch, tell: Tell) -> Result<Measured<'a>, Failure> {
    viewing.check()?;
    let scope = Scope::aset(ASET_CONE, Backing::Black).with_head(viewing.head_deg);
    let start = Instant::now();
    let (figures, sampler) = match viewing.tracer {
        Tracer::Beams => (of_beams(viewing, &scope, watch, tell)?, None),
        Tracer::Rays(first) => {
            first.or_rays(tell, |used| Ok((of_rays(viewing, &scope, used, watch)?, Some(used))))?
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    Ok(Measured { viewing: *viewing, scope, figures, sampler, seconds })
}

fn of_beams(viewing: &Viewing, scope: &Scope, watch: Watch, tell: Tell) -> Result<Figures, Failure> {
    let (polytope, view) = (&viewing.stone()?.polytope, viewing.viewpoint.view());
    let options = viewing.beams(UNRESOLVED);
    let beams = beam::trace(polytope, viewing.medium, &view, &options, watch)?;
    viewing.warn_of_open(&beams, &options, tell)?;
    Ok(by_beams(&beams, scope))
}

fn of_rays(viewing: &Viewing, scope: &Scope, sampler: Sampler, watch: Watch) -> Result<Figures, Failure> {
    let view = viewing.viewpoint.view();
    let look = Subject { specimen: viewing.specimen, medium: viewing.medium, view: &view, scope };
    sampler.figures(look, viewing.rays(UNRESOLVED), LATTICE, watch)
}

impl Measured<'_> {
    /// The figures and how they came about, as docs/formats.md has them; numbers are fractions of the silhouette.
    pub fn json(&self) -> Value {
        let (figures, viewing) = (&self.figures, &self.viewing);
        let mut strongest = self.zones(&figures.strongest_exit_area);
        strongest.insert("undecided".into(), json!(figures.strongest_exit_undecided));
        let mut value = json!({
            "file": viewing.file,
            "name": viewing.specimen.design.name,
            "silhouette_area": figures.silhouette_area,
            "surface": self.zones(&figures.surface),
            "transmitted": self.zones(&figures.transmitted),
            "strongest_exit_area": strongest,
            "absorbed": figures.absorbed,
            "unresolved": figures.unresolved,
            "beams": figures.beams,
            "seconds": self.seconds,
            "index": viewing.medium.index,
            "wavelength_nm": viewing.wavelength_nm,
            "head_deg": viewing.head_deg,
            "tracer": self.sampler.map_or("beam", Sampler::name),
            "polarised": viewing.polarised,
            "view": seen_from(&viewing.viewpoint),
        });
        if self.sampler.is_some() {
            value["standard_error"] = json!(figures.standard_error);
        }
        value
    }

    /// Bands by name, those of the ASET always there.
    fn zones(&self, values: &[f64]) -> Map<String, Value> {
        let mut zones: Map<String, Value> = ["green", "red", "blue", "below"]
            .map(|name| (name.to_string(), json!(0.0)))
            .into_iter()
            .collect();
        zones.extend(self.scope.bands.iter().zip(values).map(|(b, v)| (b.name.clone(), json!(v))));
        zones
    }
}

/// A viewpoint as figures report it.
fn seen_from(viewpoint: &Viewpoint) -> Value {
    let tilt = |lean| if viewpoint.lean == lean { viewpoint.tilt_deg } else { 0.0 };
    json!({
        "side": viewpoint.side.name(),
        "tilt": tilt(Lean::Stone),
        "eye_tilt": tilt(Lean::Eye),
        "azimuth": viewpoint.azimuth_deg,
        "projection": match viewpoint.projection {
            Projection::Orthographic => json!("orthographic"),
            Projection::Perspective { distance } => json!({ "perspective": distance }),
        },
    })
}
