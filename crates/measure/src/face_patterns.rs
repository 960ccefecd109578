//! Measures of the pattern that an eye sees on the face: contrast and fire at the eye's resolution, patches, crushed
//! ice, bow tie and fish eye.
//!
//! They need the stone's size, as the eye resolves less of a small stone. Formulas are in docs/optics.md, "Pattern".

use super::bow_tie::bow_tie;
use super::exit_sight::{ExitSight, brightness, seen_apart};
use super::eye_grid::{EyeGrid, rms_contrast};
use super::interval::Interval;
use super::light_measures::MeasureSettings;
use super::pattern_settings::{PatternSettings, SHAPE_IS_SEEN};
use super::virtual_facets::VirtualFacets;
use brillianteer_base::{Stopped, Watch, go_on};
use brillianteer_cut::FacetZones;
use brillianteer_math::Polytope;
use brillianteer_trace::beam::{Beam, Beams};
use serde::{Deserialize, Serialize};

/// The measures of the pattern on the face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PatternMeasures {
    /// The contrast of the face after averaging over squares of the eye's resolution.
    pub eye_contrast: Interval,
    /// The mean diameter of the patches of such squares that are all brighter, or all darker, than the mean of the face,
    /// weighted by area; as a part of the face's diameter. Diameters are those of circles of the same area.
    pub patch_size: Interval,
    /// The part of the face in virtual facets of the strongest exits that are smaller than a circle of
    /// [`SHAPE_IS_SEEN`] times the eye's resolution.
    pub crushed_ice: Interval,
    /// The part of the fire from virtual facets that are at least as large as a circle of the eye's resolution; as a
    /// part of the silhouette's light.
    pub fire_seen: Interval,
    /// The obstruction toward the face's short axis less that toward its long axis, -1 to 1; `None` where the face
    /// has no area.
    pub bow_tie: Option<Interval>,
    /// The part of the table through which one sees the girdle, reflected once in the pavilion; `None` where no table is seen.
    pub fish_eye: Option<Interval>,
}

impl PatternMeasures {
    /// Takes the measures of exact beams; `fans` are those of [`Beams::fans`]. Fails where `watch` asks to stop.
    pub(super) fn of(
        beams: &Beams,
        polytope: &Polytope,
        fans: &[f64],
        (settings, pattern): (&MeasureSettings, &PatternSettings),
        watch: Watch,
    ) -> Result<Self, Stopped> {
        let head_deg = settings.head_deg;
        let resolves = pattern.resolves();
        let bright = brightness(beams, head_deg);
        let grid = EyeGrid::of(beams, &bright, resolves, &|done| watch(0.3 * done))?;
        let facets = VirtualFacets::of(beams, polytope, &|done| watch(0.3 + 0.4 * done))?;
        go_on(watch, 0.7)?;
        let crushed_ice = facets.smaller_than(SHAPE_IS_SEEN * resolves);
        go_on(watch, 0.8)?;
        let fire_seen = fire_seen(&facets.areas(), beams, fans, (settings, resolves));
        go_on(watch, 0.9)?;
        Ok(Self {
            eye_contrast: rms_contrast(grid.cells.iter().copied()),
            patch_size: grid.patch_size(),
            crushed_ice,
            fire_seen,
            bow_tie: bow_tie(beams, polytope, head_deg),
            fish_eye: fish_eye(beams, polytope),
        })
    }
}

/// Returns the fire of virtual facets that are at least as large as a circle of the eye's resolution, girdle radii.
fn fire_seen(
    areas: &[Interval],
    beams: &Beams,
    fans: &[f64],
    (settings, resolves): (&MeasureSettings, f64),
) -> Interval {
    let limit = std::f64::consts::FRAC_PI_4 * resolves * resolves;
    let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
    // Where the material has no dispersion, unresolved light has no fire either.
    let most = if settings.has_dispersion() { beams.unresolved() } else { 0.0 };
    let mut fire = Interval { least: 0.0, most };
    for (beam, area) in beams.iter().zip(areas) {
        let is_seen = !beam.is_surface()
            && beam.weight > 0.0
            && ExitSight::of(&beam, beams, settings.head_deg) != ExitSight::Below;
        if !is_seen {
            continue;
        }
        let energy = beam.weight * beam.area * share * seen_apart(fans[beam.id as usize], settings.blur_deg);
        fire.least += if area.least >= limit { energy } else { 0.0 };
        fire.most += if area.most >= limit { energy } else { 0.0 };
    }
    fire
}

/// Returns the part of the table through which one sees the girdle by one reflection in the pavilion; `None` without a table.
fn fish_eye(beams: &Beams, polytope: &Polytope) -> Option<Interval> {
    let (facets, zones) = (polytope.facets(), FacetZones::of(polytope));
    let under_table = |beam: &Beam| beam.is_surface() && zones.is_table(&facets[beam.facet as usize]);
    let in_pavilion = |beam: &Beam| {
        let facet = &facets[beam.facet as usize];
        let before = beam.parent.map(|parent| beams.get(parent));
        !zones.is_girdle(facet)
            && facet.plane.normal.z < 0.0
            && before.is_some_and(|before| under_table(&before))
    };
    let [mut table, mut girdle, mut open] = [0.0; 3];
    for beam in beams.iter() {
        let after_pavilion = || beam.parent.is_some_and(|parent| in_pavilion(&beams.get(parent)));
        if under_table(&beam) {
            table += beam.area;
        } else if zones.is_girdle(&facets[beam.facet as usize]) && after_pavilion() {
            girdle += beam.area;
        }
        // The next facet of unresolved light may be the pavilion's or the girdle's.
        if beam.open && (under_table(&beam) || in_pavilion(&beam)) {
            open += beam.area;
        }
    }
    (table > 0.0).then(|| Interval::from(girdle / table, open / table))
}
