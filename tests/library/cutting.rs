//! Audits, other materials and rough, on real files of real cutters where there are any.
#![cfg(feature = "interchange")]

use crate::common::shared;
use brillianteer::cut::{FindingKind, Finished, MaterialRef, RetargetRule, Rough, retarget};
use brillianteer::io::design_file;
use brillianteer::scene::Specimen;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::LazyLock;

/// The stones of the corpus.
static STONES: LazyLock<Vec<(PathBuf, Specimen)>> = LazyLock::new(|| {
    let Some(folder) = shared("cutting", "data/asc/library") else { return vec![] };
    let listed = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = listed.collect();
    files.sort();
    let made = files.into_iter().filter_map(|file| {
        let design = design_file::read(&file).ok()?.design;
        Some((file, Specimen::new(design).ok()?))
    });
    let made: Vec<_> = made.collect();
    assert!(made.len() > 2000, "only {} stones were made", made.len());
    made
});

#[test]
fn every_design_can_be_audited_and_most_have_few_candidates() {
    let stones = &*STONES;
    let mut designs = BTreeMap::<FindingKind, usize>::new();
    let mut clean = 0;
    for (file, specimen) in stones {
        let audit = specimen.audit().unwrap();
        clean += usize::from(audit.findings.is_empty());
        for kind in FindingKind::ALL {
            *designs.entry(kind).or_default() += usize::from(audit.of_kind(kind).count() > 0);
        }
        for finding in &audit.findings {
            assert!(
                finding.size.is_finite() && !finding.facets.is_empty(),
                "{}: {finding:?}",
                file.display()
            );
        }
    }
    println!("{} designs, {clean} without a finding; with findings: {designs:?}", stones.len());
    assert!(stones.is_empty() || clean > stones.len() / 5, "{clean} of {} have no finding", stones.len());
    let below = designs.get(&FindingKind::BelowCritical).copied().unwrap_or_default();
    assert!(stones.is_empty() || (450..650).contains(&below), "{below} designs lie below the critical angle");
}

#[test]
fn a_tangent_ratio_keeps_the_facets_and_corners_of_real_designs() {
    let stones = &*STONES;
    let (mut kept, mut tried) = (0, 0);
    for (_, specimen) in stones.iter().step_by(10) {
        let rule = RetargetRule::PavilionRatio(Some(1.05));
        let Ok(found) = retarget(&specimen.design, MaterialRef::Index(1.62), rule) else { continue };
        let Ok(after) = Specimen::new(found.design) else { continue };
        tried += 1;
        let count = |specimen: &Specimen| {
            let stone = &specimen.stone().unwrap().polytope;
            (stone.facets().len(), stone.redundant().len())
        };
        kept += usize::from(count(specimen) == count(&after));
    }
    println!("{kept} of {tried} keep all facets");
    assert!(stones.is_empty() || (tried > 200 && kept * 100 > tried * 95), "{kept} of {tried}");
}

#[test]
fn every_design_fits_into_rough() {
    for (file, specimen) in STONES.iter().step_by(10) {
        let rough = Rough::new([12.0, 9.0, 7.0]).unwrap();
        let found = Finished::from_rough(&specimen.stone().unwrap().polytope, &rough, None).unwrap();
        let within =
            found.size_mm.iter().zip(rough.sides_mm).all(|(size, side)| *size <= side * (1.0 + 1e-9));
        let part = found.yield_of(rough.volume_mm3());
        assert!(within && part > 0.01 && part < 1.0, "{}: {found:?}", file.display());
    }
}
