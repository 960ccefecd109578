//! Results as plain data.

use super::*;
use brillianteer_measure::{Interval, LightMeasures, MeasureName, MeasureSettings, Measured};
use brillianteer_optics::line;
use brillianteer_scene::Viewpoint;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn read_back<T: Serialize + DeserializeOwned>(result: &T) -> T {
    serde_json::from_str(&serde_json::to_string(result).unwrap()).unwrap()
}

#[test]
fn what_was_measured_is_read_back_equal_also_where_a_bound_is_missing() {
    let design = specimen("round_brilliant").design;
    let tilted = Viewpoint { tilt_deg: 12.0, azimuth_deg: 20.0, ..Viewpoint::default() };
    let options = MeasureOptions { viewpoint: tilted, ..MeasureOptions::default() };
    let measured: Measured = measure(&design, &options).unwrap();
    assert!(measured.figures.estimate.is_some());
    assert_eq!(read_back(&measured), measured);
    let sweep = Sweep {
        design,
        viewpoint: Viewpoint::default(),
        axes: vec![],
        settings: MeasureSettings::usual([1.0; 2]),
        wavelength_nm: line::SODIUM_D,
        unresolved: 0.1,
        polarised: true,
    };
    let (keys, names) =
        (["crown_angle", "index"].map(SweepKey::of), [MeasureName::Leakage, MeasureName::Fire]);
    let graded = sweep.gradient(&keys, &names, &unwatched).unwrap();
    assert_eq!(read_back(&graded), graded);
    let by_name = graded.by_name(&keys);
    assert_eq!(read_back(&by_name), by_name);
    assert_eq!(
        by_name.get("fire").unwrap().per.get("index"),
        Some(&MeasureSlope::Smooth(graded.gradients[1].per[1]))
    );
    let contrast = Interval { least: 0.5, most: f64::INFINITY };
    let measures = LightMeasures { contrast, ..graded.stone.measures };
    assert_eq!(read_back(&measures), measures);
}
