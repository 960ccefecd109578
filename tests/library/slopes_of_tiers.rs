//! The exact slopes of measures by the angles and distances of cutters' tiers.

use brillianteer::base::unwatched;
use brillianteer::cut::{Cut, Design, ScaledSide};
use brillianteer::io::{as_tiers, cut_file, library};
use brillianteer::measure::{MeasureDerivatives, MeasureName, MeasureSettings};
use brillianteer::render::{Sweep, SweepKey, with_numbers};
use brillianteer::scene::{Medium, Specimen, Stone, View, Viewpoint};
use brillianteer::trace::beam::{BeamOptions, Beams, trace_bounces};

/// The number of reflections through which all stones of a comparison are followed, so that neighbours have the same
/// beams.
const BOUNCES: u32 = 4;

const NAMES: [&str; 8] = [
    "return-cos2",
    "return-cos3+glare",
    "leakage",
    "windowing",
    "obstruction",
    "fire",
    "extinction",
    "contrast",
];

/// Returns a cut of the program as tiers without meets, each moved and turned a little: where four facets meet in one corner,
/// a facet that moves alone opens an edge on one side only, and differences are those of a kink.
fn loosened(name: &str, some: &mut impl FnMut(f64) -> f64) -> Option<Design> {
    let design = cut_file::parse(library::cut(name)?, name).unwrap();
    let specimen = Specimen::new(design).unwrap();
    let mut tiers = as_tiers(&specimen)?;
    for tier in &mut tiers.tiers {
        tier.meet = None;
        tier.distance *= 1.0 + some(0.004);
        if tier.angle.abs() > 1.0 && tier.angle.abs() < 89.0 {
            tier.angle += some(0.3);
        }
    }
    Some(Design { cut: Cut::Tiers(tiers), ..specimen.design })
}

struct Traced {
    stone: Stone,
    beams: Beams,
}

fn traced(design: &Design) -> Traced {
    let specimen = Specimen::new(design.clone()).unwrap();
    let stone = specimen.stone().unwrap().clone();
    let beams = trace_bounces(
        &stone.polytope,
        Medium::clear(1.9),
        &View::default(),
        &BeamOptions::default(),
        BOUNCES,
    );
    Traced { stone, beams }
}

fn sums(of: &Traced, settings: &MeasureSettings) -> Vec<MeasureDerivatives> {
    let name = |name: &&str| {
        let name: MeasureName = name.parse().unwrap();
        name.derivatives(&of.beams, &of.stone.polytope, settings, &unwatched).unwrap().unwrap()
    };
    NAMES.iter().map(name).collect()
}

#[test]
fn derivatives_by_angles_and_distances_of_tiers_are_those_of_differences() {
    let mut settings = MeasureSettings::usual([1.88, 1.92]);
    settings.domes = vec!["cos2".parse().unwrap(), "cos3".parse().unwrap()];
    let mut state = 0.3;
    let mut some = |by: f64| {
        state = f64::fract(state + 0.618_033_988_749_895);
        by * (2.0 * state - 1.0)
    };
    let (mut designs, mut compared, mut worse, mut at_borders) = (0, 0, 0, 0);
    for (name, _) in library::CUTS {
        let Some(design) = loosened(name, &mut some) else { continue };
        if designs == 20 {
            break;
        }
        designs += 1;
        let own = traced(&design);
        let (own, facets) = (sums(&own, &settings), own.stone.polytope.facets().len());
        let sweep = Sweep {
            design: design.clone(),
            viewpoint: Viewpoint::default(),
            axes: vec![],
            settings: settings.clone(),
            wavelength_nm: 589.0,
            unresolved: 0.5,
            polarised: true,
        };
        let tiers = design.cut.settings();
        let scales = ScaledSide::ALL.map(|side| (SweepKey::Scale(side), 100.0, 2e-4));
        let slanted = tiers.iter().filter(|tier| (5.0..85.0).contains(&tier.angle.abs())).take(4);
        let of_tiers = slanted.map(|tier| {
            [
                (SweepKey::Tier(tier.name.clone()), tier.angle.abs(), 2e-5),
                (SweepKey::Distance(tier.name.clone()), tier.distance, 2e-7 * tier.distance),
            ]
        });
        for group in of_tiers.chain([scales]) {
            for (key, at, step) in group {
                let changes = sweep.plane_changes(std::slice::from_ref(&key)).unwrap();
                let changes = changes.of_key(0).unwrap().to_vec();
                assert_eq!(changes.len(), facets);
                let differences = |step: f64| -> Vec<f64> {
                    let of = |by: f64| {
                        let moved = traced(&with_numbers(&design, [(&key, at + by * step)]).unwrap());
                        sums(&moved, &settings)
                    };
                    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(of);
                    let change = |k: usize| {
                        (8.0 * (c[k].value - b[k].value) - (d[k].value - a[k].value)) / (12.0 * step)
                    };
                    (0..NAMES.len()).map(change).collect()
                };
                let (coarse, fine) = (differences(step), differences(0.5 * step));
                for (k, own) in own.iter().enumerate() {
                    let found = own.derivatives.along(changes.iter().copied());
                    let unit = fine[k].abs().max(0.01);
                    // Where two steps disagree, the measure has a kink between them.
                    if (coarse[k] - fine[k]).abs() > 2e-7 * unit {
                        at_borders += 1;
                        continue;
                    }
                    compared += 1;
                    let error = (found - fine[k]).abs() / unit;
                    worse += u32::from(error > 1e-6);
                    assert!(error < 5e-6, "{name} {key} {}: {found} {}", NAMES[k], fine[k]);
                }
            }
        }
    }
    assert_eq!(designs, 20);
    // Only few slopes are worse: in them, the changes of the planes themselves are known less well.
    assert!(worse * 100 < compared, "{worse} of {compared} differ by more than 1e-6");
    assert!(compared > 5 * at_borders && compared > 400, "{compared} compared, {at_borders} at borders");
}
