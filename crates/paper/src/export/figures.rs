//! The figures of a view, and their JSON.

use super::event::Reporter;
use super::viewing::{Viewing, note};
use brillianteer_base::{Failure, Watch};
use brillianteer_measure::{Bounds, Estimate, Measured, UNRESOLVED};
use brillianteer_picture::Scoped;
use brillianteer_render::{Backend, FiguresProduct, Product, Renderer};
use brillianteer_scene::{Film, Glare, Lean, Projection, Viewpoint};
use serde_json::{Map, Value, json};
use std::time::Instant;

/// Figures, with the stone, scope and tracer that they belong to.
pub struct FigureReport<'a> {
    /// The stone with its view and tracer.
    pub viewing: Viewing<'a>,
    /// The scope, with its zones before an observer's head hides some.
    pub scoped: Scoped,
    /// The figures.
    pub measured: Measured,
    /// The tracer that was used.
    pub backend: Backend,
    /// The duration of the measurement, in seconds.
    pub seconds: f64,
}

/// Measures a stone by the zones of a scope, seen from the side that the scope is for.
///
/// # Errors
/// The errors of [`Viewing::check`], an error of `tell`, or [`Failure::Stopped`] when `watch` asks to stop.
pub fn measure<'a>(
    viewing: &Viewing<'a>,
    scoped: &Scoped,
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<FigureReport<'a>, Failure> {
    let viewing = viewing.facing(scoped.side);
    viewing.check(renderer)?;
    let product = FiguresProduct { scope: scoped.with_head(viewing.head_deg), medium: viewing.medium };
    let mut job = viewing.job(Film::NONE, Product::Figures(product), UNRESOLVED);
    let Viewing { unresolved, standard_error, .. } = viewing;
    job.quality.standard_error = standard_error;
    job.quality.beams.unresolved = Bounds { unresolved, standard_error, ..Bounds::default() }.left_by_beams();
    let start = Instant::now();
    let rendered = renderer.run(&job, watch, &mut |part| note(&part, tell))?;
    let seconds = start.elapsed().as_secs_f64();
    let backend = rendered.backend.clone();
    let measured = rendered.figures()?;
    if backend.is_beams() {
        let open = (measured.figures.uncertain(), measured.figures.beams);
        let aim = if measured.figures.estimate.is_some() { UNRESOLVED } else { job.quality.beams.unresolved };
        viewing.warn_of_open(open, aim, tell)?;
    }
    Ok(FigureReport { viewing, scoped: scoped.clone(), measured, backend, seconds })
}

impl FigureReport<'_> {
    /// Returns the figures and the way of measuring, in the form of docs/formats.md.
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
        if let Some(estimate) = &figures.estimate {
            set("estimated", self.estimated(estimate));
        }
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
        set("tracer", json!(self.backend.name()));
        set("polarised", json!(viewing.polarised));
        set("view", seen_from(&viewing.viewpoint));
        if !self.backend.is_beams() {
            set("standard_error", json!(figures.standard_error));
        }
        value
    }

    /// Returns the parts of the figures that are estimated, and their standard errors.
    fn estimated(&self, estimate: &Estimate) -> Value {
        let zones = |values: &[f64]| Value::Object(self.zones(values));
        json!({
            "transmitted": zones(&estimate.transmitted),
            "strongest_exit_area": zones(&estimate.strongest_exit_area),
            "absorbed": estimate.absorbed,
            "unresolved": estimate.unresolved,
            "rays": estimate.rays,
            "standard_error": {
                "light_return": self.measured.light_return_error(),
                "transmitted": zones(&estimate.standard_errors()),
                "strongest_exit_area": zones(&estimate.area_errors()),
                "absorbed": estimate.absorbed_error,
            },
        })
    }

    /// Returns the value of each band by name, the lowest band last. Bands that the observer's head hides have the value 0.
    fn zones(&self, values: &[f64]) -> Map<String, Value> {
        let bands = &self.scoped.scope.bands;
        let all = bands.iter().skip(1).chain(bands.first()).map(|b| (b.name.clone(), json!(0.0)));
        let seen = self.measured.scope.bands.iter().zip(values).map(|(b, v)| (b.name.clone(), json!(v)));
        all.chain(seen).collect()
    }
}

/// Returns the JSON of a viewpoint.
pub(super) fn seen_from(viewpoint: &Viewpoint) -> Value {
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
