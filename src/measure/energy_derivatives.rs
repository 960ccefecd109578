//! How measures that are sums of light change with the planes of the stone and with its index.

use super::{MeasureName, MeasureSettings};
use crate::math::Polytope;
use crate::scene::{DomeLight, elevation_deg};
use crate::trace::beam::{Beam, BeamPartials, Beams, PlaneDerivatives};
use glam::DVec3;

/// A measure that is a sum of light, with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyDerivatives {
    /// The light that was followed to where the measure counts it: the least value of the measure.
    pub value: f64,
    /// How `value` changes with each plane and with the index, while the stone keeps the symmetry of the picture.
    pub derivatives: PlaneDerivatives,
}

impl MeasureName {
    /// Whether this measure is a sum of light, which has derivatives.
    pub fn is_energy(&self) -> bool {
        Counted::of(self, 0.0).is_some()
    }

    /// Returns how this measure changes with the planes of `polytope`, which must be the one that was traced, and with the
    /// index; `None` for measures that are no sums of light (extinction, contrast, fire, absorbed), and where the stone
    /// absorbs light.
    ///
    /// They are the derivatives of the light that was followed, between the borders of domes, heads and horizon: light that
    /// crosses a border makes a measure jump, and a facet through which light ceases to leave makes a kink. Neither is in
    /// the derivative. Their formulas are in docs/optics.md, "Derivatives".
    pub fn derivatives(
        &self,
        beams: &Beams,
        polytope: &Polytope,
        settings: &MeasureSettings,
    ) -> Option<EnergyDerivatives> {
        let counted = Counted::of(self, settings.head_deg)?;
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        let mut partials = BeamPartials::none(beams.len());
        let mut value = 0.0;
        for beam in beams.iter().filter(|beam| beam.weight > 0.0) {
            let Some((radiance, slope)) = counted.radiance(&beam, beams) else { continue };
            let k = beam.id as usize;
            value += beam.weight * beam.area * radiance * share;
            partials.weight[k] = beam.area * radiance * share;
            partials.area[k] = beam.weight * radiance * share;
            partials.exit[k] = slope * (beam.weight * beam.area * share);
        }
        // The silhouette, of which the measure is a part, is made up of the beams that enter.
        for beam in beams.iter().filter(Beam::is_surface) {
            partials.area[beam.id as usize] -= value * share;
        }
        let derivatives = beams.derivatives(polytope, &partials)?;
        Some(EnergyDerivatives { value, derivatives })
    }
}

/// Which light a measure counts.
enum Counted {
    Dome { dome: DomeLight, with_glare: bool },
    Below { only_straight: bool },
    Head { head_deg: f64 },
}

impl Counted {
    fn of(name: &MeasureName, head_deg: f64) -> Option<Self> {
        Some(match *name {
            MeasureName::Return(dome) => Self::Dome { dome, with_glare: false },
            MeasureName::ReturnWithGlare(dome) => Self::Dome { dome, with_glare: true },
            MeasureName::Leakage => Self::Below { only_straight: false },
            MeasureName::Windowing => Self::Below { only_straight: true },
            MeasureName::Obstruction => Self::Head { head_deg },
            _ => return None,
        })
    }

    /// Returns the radiance that an exit is weighed by and its change with the direction; `None` where the light is not counted.
    fn radiance(&self, beam: &Beam, beams: &Beams) -> Option<(f64, DVec3)> {
        let elevation = elevation_deg(beam.exit, beams.zenith);
        match *self {
            Self::Dome { dome, with_glare } => {
                let is_counted = with_glare || !beam.is_surface();
                let of_dome =
                    || (dome.radiance(beam.exit, beams.zenith), dome.slope(beam.exit, beams.zenith));
                is_counted.then(of_dome)
            }
            Self::Below { only_straight } => {
                let parent = beams.get(beam.parent?);
                let is_counted = elevation < 0.0 && (!only_straight || parent.is_surface());
                is_counted.then_some((1.0, DVec3::ZERO))
            }
            Self::Head { head_deg } => {
                let is_counted =
                    !beam.is_surface() && head_deg > 0.0 && elevation >= (90.0 - head_deg).max(0.0);
                is_counted.then_some((1.0, DVec3::ZERO))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::{Crown, LowerHalf, Pavilion, RoundBrilliant, TOLKOWSKY};
    use crate::math::Plane;
    use crate::measure::LightMeasures;
    use crate::scene::{Medium, View};
    use crate::trace::beam::{BeamOptions, trace_bounces};

    const BOUNCES: u32 = 4;

    fn planes(cut: &RoundBrilliant) -> Vec<Plane> {
        cut.facets().unwrap().into_iter().map(|(_, plane)| plane).collect()
    }

    /// Returns a brilliant whose table, crown, pavilion and lower halves differ from Tolkowsky's by these amounts.
    fn brilliant([table, crown, pavilion, lower]: [f64; 4]) -> RoundBrilliant {
        RoundBrilliant {
            table: 56.0 + table,
            crown: Crown::Angle(34.0 + crown),
            pavilion: Pavilion::Angle(40.8 + pavilion),
            lower_half: LowerHalf::Radial(77.0 + lower),
            girdle_facets: 32,
            ..TOLKOWSKY
        }
    }

    fn traced(cut: &RoundBrilliant, index: f64, tilt: f64) -> (Polytope, Beams) {
        let stone = Polytope::from_planes(&planes(cut)).unwrap();
        let view = View { tilt, ..View::default() };
        let beams = trace_bounces(&stone, Medium::clear(index), &view, &BeamOptions::default(), BOUNCES);
        (stone, beams)
    }

    /// Returns the central difference of fourth order of some numbers.
    fn difference<const N: usize>(step: f64, of: impl Fn(f64) -> [f64; N]) -> [f64; N] {
        let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(|k| of(k * step));
        std::array::from_fn(|k| (8.0 * (above[k] - below[k]) - (far_above[k] - far_below[k])) / (12.0 * step))
    }

    fn names() -> [MeasureName; 5] {
        ["return-cos2", "return-cos3+glare", "leakage", "windowing", "obstruction"]
            .map(|name| name.parse().unwrap())
    }

    fn values(beams: &Beams, stone: &Polytope, settings: &MeasureSettings) -> [f64; 5] {
        names().map(|name| name.derivatives(beams, stone, settings).unwrap().value)
    }

    #[test]
    fn derivatives_by_proportions_and_index_are_those_of_differences_on_random_brilliants() {
        let mut settings = MeasureSettings::usual([2.4, 2.45]);
        settings.domes = vec!["cos2".parse().unwrap(), "cos3".parse().unwrap()];
        let mut state = 0.5;
        let mut some = |by: f64| {
            state = f64::fract(state + 0.618_033_988_749_895);
            by * (2.0 * state - 1.0)
        };
        let (mut compared, mut at_borders) = (0, 0);
        for number in 0..50 {
            let at: [f64; 4] = [some(3.0), some(4.0), some(1.5), some(5.0)];
            let tilt = if number % 3 == 0 { 0.2 } else { 0.0 };
            let index = 2.2 + some(0.4);
            let (stone, beams) = traced(&brilliant(at), index, tilt);
            let own = names().map(|name| name.derivatives(&beams, &stone, &settings).unwrap());
            let measures = LightMeasures::of(&beams, &stone, &settings);
            assert_eq!(own[2].value.to_bits(), measures.leakage.least.to_bits());
            assert!((own[0].value - measures.domes[0].inside.least).abs() < 1e-14);
            assert!((own[1].value - measures.domes[1].with_glare().least).abs() < 1e-14);
            for by in 0..5 {
                let moved = |h: f64| {
                    let mut at = at;
                    if by < 4 {
                        at[by] += h;
                    }
                    (brilliant(at), if by == 4 { index + h } else { index })
                };
                let found: Vec<f64> = if by == 4 {
                    own.iter().map(|own| own.derivatives.index).collect()
                } else {
                    let start = planes(&brilliant(at));
                    let change = difference(1e-4, |h| {
                        let planes = planes(&moved(h).0);
                        let numbers = |p: &Plane| [p.normal.x, p.normal.y, p.normal.z, p.offset];
                        let all: Vec<f64> = planes.iter().flat_map(numbers).collect();
                        <[f64; 4 * 89]>::try_from(all).unwrap()
                    });
                    let of_facet = |plane: &Plane| {
                        let at = start.iter().position(|p| p.normal.distance(plane.normal) < 1e-9).unwrap();
                        let [x, y, z, offset] = [0, 1, 2, 3].map(|k| change[4 * at + k]);
                        (DVec3::new(x, y, z), offset)
                    };
                    let changes: Vec<(DVec3, f64)> =
                        stone.facets().iter().map(|f| of_facet(&f.plane)).collect();
                    own.iter().map(|own| own.derivatives.along(changes.iter().copied())).collect()
                };
                let differences = |step: f64| {
                    difference(step, |h| {
                        let (cut, index) = moved(h);
                        let (stone, beams) = traced(&cut, index, tilt);
                        values(&beams, &stone, &settings)
                    })
                };
                let unit = if by == 4 { 0.1 } else { 1.0 };
                let (coarse, fine) = (differences(2e-5 * unit), differences(1e-5 * unit));
                for k in 0..5 {
                    // Where two steps disagree, a border lies between them.
                    if (coarse[k] - fine[k]).abs() > 1e-7 * fine[k].abs().max(0.01) {
                        at_borders += 1;
                        continue;
                    }
                    compared += 1;
                    let error = (found[k] - fine[k]).abs();
                    assert!(
                        error < 1e-6 * fine[k].abs().max(0.01),
                        "{number} {by} {k}: {} {}",
                        found[k],
                        fine[k]
                    );
                }
            }
        }
        assert!(
            compared > 20 * at_borders && compared > 1000,
            "{compared} compared, {at_borders} at borders"
        );
    }
}
