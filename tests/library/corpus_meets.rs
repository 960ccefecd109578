//! Tests of meets in real designs: a design whose distances are forgotten is cut again by its instructions.
#![cfg(feature = "interchange")]

use super::corpus::files;
use brillianteer::cut::{
    Cut, Design, Meet, MeetFault, MeetPoint, SolvedTiers, Tier, TierOutcome, TierZone, Tiers,
};
use brillianteer::io::{
    as_tiers, asc, cut_file,
    design_file::{self, DesignFormat, written},
    gcs, gem, library,
};
use brillianteer::scene::Specimen;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The largest difference of a distance that comes back, in the designs' unit, which is about a girdle radius.
const COMES_BACK: f64 = 1e-4;

/// The largest difference between a file's own distance and the one that its meet gives between the file's other
/// planes: the rounding of five digits, and its effect where facets lean. Some tiers on, it may have grown to
/// [`COMES_BACK`].
const BORNE_OUT: f64 = 3e-5;

/// The least share of designs that must come back.
const LEAST: f64 = 0.95;

/// Reasons that are counted: those of designs whose meets the file's own planes bear out.
const BACK: &str = "come back";
const OFF: &str = "do not come back";

/// The result for a design.
#[derive(Debug, Clone, PartialEq)]
enum Fate {
    /// All distances came back.
    Back,
    /// A distance did not come back, for this reason.
    Off(String),
    /// The instructions contradict the file or one another, for this reason.
    Contradicted(&'static str),
}

/// The blocks of a stone, each of which needs one distance of its own.
fn block(zone: TierZone) -> usize {
    match zone {
        TierZone::Table | TierZone::Crown => 0,
        TierZone::Girdle => 1,
        TierZone::Pavilion | TierZone::Culet => 2,
    }
}

/// Forgets each distance that a meet gives: such a tier no longer reaches the stone.
fn forgotten(met: &Tiers, solved: &SolvedTiers) -> Tiers {
    let far = 2.0 * met.tiers.iter().map(|tier| tier.distance.abs()).fold(0.0, f64::max);
    let mut design = met.clone();
    for (tier, outcome) in design.tiers.iter_mut().zip(&solved.outcomes) {
        if *outcome == TierOutcome::Solved {
            tier.distance = far.copysign(tier.distance);
        }
    }
    design
}

/// Returns whether each block of a stone keeps at most one distance of its own, so that all others follow from meets.
fn is_determined(design: &Tiers, solved: &SolvedTiers) -> bool {
    let mut kept = [0; 3];
    for (tier, outcome) in design.tiers.iter().zip(&solved.outcomes) {
        kept[block(tier.zone())] += usize::from(matches!(outcome, TierOutcome::Kept | TierOutcome::Sets));
    }
    kept.iter().all(|&count| count <= 1)
}

/// Returns the reason why no distance can come back: a meet names a tier or a place that does not exist, or another
/// place than the file's own planes.
fn contradicted(design: &Tiers, met: &Tiers) -> Option<&'static str> {
    let checked = met.checked_meets();
    let tiers = design.tiers.iter().zip(&checked.tiers.tiers).zip(&checked.outcomes);
    tiers.into_iter().find_map(|((own, checked), outcome)| {
        if let TierOutcome::Failed(error) = outcome {
            return Some(match error.fault {
                MeetFault::UnknownName { .. } | MeetFault::NotCutYet { .. } => {
                    "a name means no tier that is cut"
                }
                MeetFault::Disagree { .. } => "the facets of a tier would need several distances",
                _ => "facets that are named do not meet",
            });
        }
        let missed = (own.distance.abs() - checked.distance.abs()).abs();
        (missed > BORNE_OUT).then_some(match own.meet.as_ref().or(checked.meet.as_ref()) {
            Some(Meet::CentreAngle(_)) => "the angle of a CAM instruction has only two decimals",
            _ if missed < 1e-3 => "the file's own planes miss a stated point by up to 1e-3",
            _ => "the file's own planes miss a stated point by more than 1e-3",
        })
    })
}

/// Returns whether the meets of a design determine it, and the result for it.
fn fate(design: &Tiers) -> (bool, Fate) {
    let met = design.with_stated_meets().with_found_meets();
    let whole = met.solved();
    let is_determined = is_determined(design, &whole);
    if let Some(why) = contradicted(design, &met) {
        return (is_determined, Fate::Contradicted(why));
    }
    let solved = forgotten(&met, &whole).solved();
    let tiers = design.tiers.iter().zip(&solved.tiers.tiers).zip(&solved.outcomes);
    for (place, ((before, after), outcome)) in tiers.enumerate() {
        let apart = (before.distance.abs() - after.distance.abs()).abs();
        if let TierOutcome::Failed(error) = outcome {
            return (is_determined, Fate::Off(error.to_string()));
        }
        if apart > COMES_BACK {
            let meet = met.tiers[place].meet.as_ref().map(Meet::to_string).unwrap_or_default();
            let why = format!("tier {} is off by {apart:.1e}: {meet}", place + 1);
            return (is_determined, Fate::Off(why));
        }
    }
    (is_determined, Fate::Back)
}

/// Returns the name of a group of designs.
fn group(states: bool, is_determined: bool) -> String {
    let meets = if states { "stated meets" } else { "found meets alone" };
    let free = if is_determined { "one distance a block" } else { "more distances kept" };
    format!("{meets}, {free}")
}

#[test]
fn designs_whose_distances_are_forgotten_are_cut_again_by_their_meets() {
    let files = files(&["asc"]);
    let fates: Vec<(String, bool, (bool, Fate))> = files
        .par_iter()
        .filter_map(|file| {
            let Cut::Tiers(design) = design_file::read(file).ok()?.design.cut else { return None };
            let states = design.with_stated_meets().tiers.iter().any(|tier| tier.meet.is_some());
            let name = file.file_name()?.to_string_lossy().into_owned();
            Some((name, states, fate(&design)))
        })
        .collect();
    if files.is_empty() {
        return;
    }
    let mut reasons: BTreeMap<String, BTreeMap<&str, usize>> = BTreeMap::new();
    let mut counts: BTreeMap<(bool, &str), usize> = BTreeMap::new();
    for (name, states, (is_determined, fate)) in &fates {
        let reason = match fate {
            Fate::Back => BACK,
            Fate::Off(why) => {
                println!("{name}: {why}");
                OFF
            }
            Fate::Contradicted(why) => why,
        };
        *counts.entry((*is_determined, reason)).or_default() += 1;
        *reasons.entry(group(*states, *is_determined)).or_default().entry(reason).or_default() += 1;
    }
    reasons.iter().for_each(|(group, reasons)| println!("{group}: {reasons:?}"));
    for is_determined in [true, false] {
        let count = |reason| counts.get(&(is_determined, reason)).copied().unwrap_or(0);
        let (back, off) = (count(BACK), count(OFF));
        let share = back as f64 / (back + off).max(1) as f64;
        println!("determined: {is_determined}: {back} come back, {off} do not, {:.2} %", 100.0 * share);
        assert!(back > 100 && share >= LEAST, "determined: {is_determined}: {back} come back, {off} do not");
    }
}

#[test]
fn the_check_of_meets_can_fail() {
    let file = files(&["asc"]).into_iter().find(|file| file.ends_with("SRB.asc"));
    let Some(file) = file else { return };
    let Cut::Tiers(design) = design_file::read(&file).unwrap().design.cut else {
        panic!("tiers are expected")
    };
    let met = design.with_stated_meets().with_found_meets();
    assert!(met.tiers.iter().any(|tier| matches!(&tier.meet, Some(Meet::Points(points))
        if points.iter().any(|point| matches!(point, MeetPoint::Corner(_))))));
    let whole = met.solved();
    let mut other = forgotten(&met, &whole);
    // A size that differs by a thousandth moves the tiers that meet it.
    let kept = whole.outcomes.iter().position(|outcome| *outcome != TierOutcome::Solved).unwrap();
    other.tiers[kept].distance *= 1.001;
    let solved = other.solved();
    let apart = design.tiers.iter().zip(&solved.tiers.tiers).enumerate().filter(|(place, _)| *place != kept);
    let most = apart.map(|(_, (a, b))| (a.distance.abs() - b.distance.abs()).abs()).fold(0.0, f64::max);
    assert!(most > COMES_BACK, "{most}");
}

#[test]
fn meets_that_designs_state_are_kept_where_they_move_nothing() {
    let files = files(&["asc"]);
    let counts: Vec<[usize; 3]> = files
        .par_iter()
        .filter_map(|file| {
            let Cut::Tiers(design) = design_file::read(file).ok()?.design.cut else { return None };
            let kept = design.with_own_meets();
            let largest = design.tiers.iter().map(|tier| tier.distance.abs()).fold(0.0, f64::max);
            let solved = kept.solved();
            assert_eq!(solved.errors().count(), 0, "{}", file.display());
            for (own, solved) in design.tiers.iter().zip(&solved.tiers.tiers) {
                let moved = (own.distance.abs() - solved.distance.abs()).abs();
                assert!(moved <= 1e-4 * largest, "{}: {} moves by {moved:.1e}", file.display(), own.name());
            }
            let met = |tiers: &Tiers| tiers.tiers.iter().filter(|tier| tier.meet.is_some()).count();
            Some([met(&design.with_stated_meets()), met(&design.with_kept_stated_meets()), met(&kept)])
        })
        .collect();
    let [stated, adopted, all] =
        counts.iter().fold([0; 3], |sum, count| [0, 1, 2].map(|at| sum[at] + count[at]));
    println!(
        "{} designs: {stated} meets stated, {adopted} kept, {all} with those that are found",
        counts.len()
    );
    assert!(files.is_empty() || (adopted > stated / 2 && all > adopted), "{adopted} of {stated}, {all}");
}

/// Returns the design with all meets that it states or shows, followed, as `convert --meets` writes it.
fn followed(design: &Tiers) -> Tiers {
    let (_, solved) = design.with_stated_meets().with_names_in_meets().with_found_meets_followed();
    solved.tiers.with_words_of_meets()
}

/// Returns the first difference between a design whose meets were followed and the same design read back, in words.
fn read_back(design: &Design, format: DesignFormat) -> Result<(), String> {
    let Cut::Tiers(tiers) = &design.cut else { return Err("it has no tiers".to_owned()) };
    let before = followed(tiers);
    let specimen = Specimen::new(Design { cut: Cut::Tiers(before.clone()), ..design.clone() });
    let bytes = written(&specimen.map_err(|e| e.to_string())?, format).map_err(|e| e.to_string())?.bytes;
    let imported = match format {
        DesignFormat::Asc => asc::read(&bytes, "x.asc"),
        DesignFormat::Gem => gem::read(&bytes, "x.gem"),
        _ => gcs::read(&bytes, "x.gcs"),
    };
    let Cut::Tiers(again) = imported.map_err(|e| e.to_string())?.design.cut else { panic!("tiers") };
    let after = followed(&again);
    let cut: Vec<Tier> =
        before.tiers.iter().filter(|tier| tier.is_cut && !tier.facets.is_empty()).cloned().collect();
    if cut.len() != after.tiers.len() {
        return Err(format!("{} tiers became {}", cut.len(), after.tiers.len()));
    }
    for (a, b) in cut.iter().zip(&after.tiers) {
        let said = |tier: &Tier| tier.meet.as_ref().map_or_else(String::new, Meet::to_string).to_lowercase();
        if said(a) != said(b) {
            return Err(format!(
                "{}: '{}' became '{}', from '{}'",
                a.name(),
                said(a),
                said(b),
                b.instructions
            ));
        }
    }
    // Formats have units and origins of their own, so the stones are compared, of which half the diameter is 1.
    let volume = |tiers: Tiers| {
        let specimen = Specimen::new(Design { cut: Cut::Tiers(tiers), ..design.clone() });
        specimen.map(|specimen| specimen.solid().volume()).map_err(|e| e.to_string())
    };
    let [a, b] = [volume(before)?, volume(after)?];
    if (a - b).abs() < COMES_BACK * a { Ok(()) } else { Err(format!("a volume of {a} became {b}")) }
}

/// Returns the cuts that come with the program as tiers without names, meets and instructions.
fn nameless_cuts() -> Vec<Design> {
    let as_nameless = |(name, text): &(&str, &str)| {
        let specimen = Specimen::new(cut_file::parse(text, name).unwrap()).unwrap();
        let mut tiers = as_tiers(&specimen)?;
        for tier in &mut tiers.tiers {
            tier.rename("");
            (tier.meet, tier.instructions) = (None, String::new());
        }
        Some(Design { cut: Cut::Tiers(tiers), ..specimen.design.clone() })
    };
    library::CUTS.iter().filter_map(as_nameless).collect()
}

#[test]
fn a_design_that_is_written_with_its_meets_reads_back_as_the_same_design_with_the_same_meets() {
    let formats = [DesignFormat::Asc, DesignFormat::Gem, DesignFormat::Gcs];
    let own = nameless_cuts();
    assert!(own.len() > 25, "{}", own.len());
    let all = files(&["asc", "gem"]);
    // Every tenth file; BRILLIANTEER_ALL_FILES takes all.
    let step = if std::env::var_os("BRILLIANTEER_ALL_FILES").is_some() { 1 } else { 10 };
    let real = all.iter().step_by(step).filter_map(|file| Some(design_file::read(file).ok()?.design));
    for (whose, designs, least) in [("own", own, 1.0), ("real", real.collect(), LEAST)] {
        for format in formats {
            let results: Vec<(&String, Result<(), String>)> =
                designs.par_iter().map(|design| (&design.name, read_back(design, format))).collect();
            let failed: Vec<_> = results.iter().filter(|(_, result)| result.is_err()).collect();
            println!("{whose} {}: {} of {} differ: {failed:?}", format.ending(), failed.len(), results.len());
            let share = 1.0 - failed.len() as f64 / results.len().max(1) as f64;
            assert!(share >= least, "{whose} {}: {failed:#?}", format.ending());
        }
    }
}
