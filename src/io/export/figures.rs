//! The figures of a view, and their JSON.

use super::event::Reporter;
use super::viewing::Viewing;
use crate::io::Failure;
use crate::measure::{Bounds, LATTICE, MeasureError, Measured, UNRESOLVED, measure_subject};
use crate::picture::Scoped;
use crate::scene::{Glare, Lean, Projection, Viewpoint};
use crate::trace::{Subject, Tracer, Watch};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// Figures, and how they were measured.
pub struct FigureReport<'a> {
    /// The stone and how it was viewed.
    pub viewing: Viewing<'a>,
    /// The scope, with its zones as they are before an observer's head hides some.
    pub scoped: Scoped,
    /// The figures.
    pub measured: Measured,
    /// The tracer that was used.
    pub tracer: Tracer<'a>,
    /// How long the measurement took, in seconds.
    pub seconds: f64,
}

/// Measures a stone by the zones of a scope, seen from the side that the scope is for.
///
/// # Errors
/// The errors of [`Viewing::check`], an error of `tell`, or [`Failure::Stopped`] when `watch` asks to stop.
pub fn measure<'a>(
    viewing: &Viewing<'a>,
    scoped: &Scoped,
    watch: Watch,
    tell: Reporter,
) -> Result<FigureReport<'a>, Failure> {
    let viewing = viewing.facing(scoped.side);
    viewing.check()?;
    let scope = scoped.with_head(viewing.head_deg);
    let unresolved = viewing.unresolved.unwrap_or(UNRESOLVED);
    let bounds = Bounds { unresolved, polarised: viewing.polarised, lattice: LATTICE };
    let view = viewing.view();
    let subject = Subject { specimen: viewing.specimen, medium: viewing.medium, view: &view, scope: &scope };
    let start = Instant::now();
    let by = |tracer| {
        let measured = measure_subject(subject, tracer, &bounds, watch).map_err(|e| failure(&viewing, e))?;
        Ok((measured, tracer))
    };
    let (measured, tracer) = match viewing.tracer {
        Tracer::Beams => by(Tracer::Beams)?,
        Tracer::Rays(first) => first.or_rays(tell, |used| by(Tracer::Rays(used)))?,
    };
    let seconds = start.elapsed().as_secs_f64();
    if matches!(tracer, Tracer::Beams) {
        viewing.warn_of_open(
            (measured.figures.unresolved, measured.figures.beams),
            bounds.unresolved,
            tell,
        )?;
    }
    Ok(FigureReport { viewing, scoped: scoped.clone(), measured, tracer, seconds })
}

fn failure(viewing: &Viewing, error: MeasureError) -> Failure {
    match error {
        MeasureError::CannotTrace(why) => viewing.cannot(why),
        #[cfg(feature = "gpu")]
        MeasureError::Card(error) => Failure::Card(error),
        MeasureError::Stopped(stopped) => stopped.into(),
        other => Failure::Input(format!("{}: {other}", viewing.file)),
    }
}

impl FigureReport<'_> {
    /// Returns the figures and how they were measured, as docs/formats.md describes them.
    ///
    /// Energies are fractions of the silhouette. The time taken is included only if `timing`, so that equal input gives
    /// equal files.
    pub fn json(&self, timing: bool) -> Value {
        let (viewing, measured) = (&self.viewing, &self.measured);
        let (figures, material) = (&measured.figures, &viewing.specimen.material);
        let mut strongest = self.zones(&figures.strongest_exit_area);
        strongest.insert("undecided".into(), json!(figures.strongest_exit_undecided));
        let glare = viewing.glare.unwrap_or(Glare::Included);
        let mut value = json!({
            "file": viewing.file,
            "name": viewing.specimen.design.name,
            "scope": measured.scope.name,
            "silhouette_area": figures.silhouette_area,
            "light_return": measured.light_return(),
        });
        let mut set = |key: &str, what: Value| value[key] = what;
        match glare {
            Glare::Included => {
                set("light_return_with_glare", json!(measured.light_return() + measured.glare_return()));
                set("surface", Value::Object(self.zones(&figures.surface)));
            }
            Glare::LeftOut => set("glare_left_out", json!(measured.glare())),
        }
        set("transmitted", Value::Object(self.zones(&figures.transmitted)));
        set("strongest_exit_area", Value::Object(strongest));
        set("absorbed", json!(figures.absorbed));
        set("unresolved", json!(figures.unresolved));
        set("beams", json!(figures.beams));
        if timing {
            set("seconds", json!(self.seconds));
        }
        set("material", json!(material.name));
        if material.colour_is_illustrative {
            set("colour_is_illustrative", json!(true));
        }
        set("index", json!(viewing.medium.index));
        set("wavelength_nm", json!(viewing.wavelength_nm));
        set("head_deg", json!(viewing.head_deg));
        set("tracer", json!(self.tracer.name()));
        set("polarised", json!(viewing.polarised));
        set("view", seen_from(&viewing.viewpoint));
        if matches!(self.tracer, Tracer::Rays(_)) {
            set("standard_error", json!(figures.standard_error));
        }
        value
    }

    /// Returns the value of each band by name, the lowest band last. Bands that the observer's head hides have the value 0.
    fn zones(&self, values: &[f64]) -> Map<String, Value> {
        let bands = &self.scoped.scope.bands;
        let all = bands.iter().skip(1).chain(bands.first()).map(|b| (b.name.clone(), json!(0.0)));
        let seen = self.measured.scope.bands.iter().zip(values).map(|(b, v)| (b.name.clone(), json!(v)));
        all.chain(seen).collect()
    }
}

/// The JSON of a viewpoint.
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
