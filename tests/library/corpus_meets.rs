//! Meets of real designs: a design whose distances are forgotten is cut again by what its instructions say.

use super::corpus::files;
use brillianteer::cut::{Cut, Meet, MeetFault, MeetPoint, SolvedTiers, TierOutcome, TierZone, Tiers};
use brillianteer::io::design_file;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The largest difference of a distance that comes back, in the designs' unit, which is about a girdle radius.
const COMES_BACK: f64 = 1e-4;

/// The least share of designs that must come back.
const LEAST: f64 = 0.95;

/// What became of a design.
#[derive(Debug, Clone, PartialEq)]
enum Fate {
    /// All distances came back.
    Back,
    /// A distance did not: why.
    Off(String),
    /// The meets of its tiers do not determine the design: why.
    Undetermined(&'static str),
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

/// Returns why the meets of a design do not determine it.
fn undetermined(design: &Tiers, met: &Tiers, solved: &SolvedTiers) -> Option<&'static str> {
    let mut kept = [0; 3];
    for (tier, outcome) in design.tiers.iter().zip(&solved.outcomes) {
        kept[block(tier.zone())] += usize::from(matches!(outcome, TierOutcome::Kept | TierOutcome::Sets));
    }
    let failed = solved.errors().next().map(|error| match error.fault {
        MeetFault::UnknownName { .. } | MeetFault::NotCutYet { .. } => "a name means no tier that is cut",
        MeetFault::Disagree { .. } => "the facets of a tier would need several distances",
        _ => "facets that are named do not meet",
    });
    let is_wrong = |(place, tier): (usize, &brillianteer::cut::Tier)| {
        let missed = missed(design, met, place);
        (missed > COMES_BACK).then_some(match tier.meet {
            Some(Meet::CentreAngle(_)) => "the angle of a CAM instruction is rounded to two decimals",
            _ if missed < 10.0 * COMES_BACK => "the file's own planes miss a stated point by up to 1e-3",
            _ => "the file's own planes miss a stated point by more than 1e-3",
        })
    };
    match kept {
        _ if failed.is_some() => failed,
        [2.., ..] => Some("more than one distance of the crown is free"),
        [_, 2.., _] => Some("more than one distance of the girdle is free"),
        [.., 2..] => Some("more than one distance of the pavilion is free"),
        _ => met.tiers.iter().enumerate().find_map(is_wrong),
    }
}

/// Returns by how much the file's own distance of a tier differs from the one that its meet gives between the file's other
/// planes.
fn missed(design: &Tiers, met: &Tiers, place: usize) -> f64 {
    let mut alone = met.clone();
    for (other, tier) in alone.tiers.iter_mut().enumerate() {
        // Angles of the centre-point method need the first of them, which keeps its distance.
        if other != place && !matches!(tier.meet, Some(Meet::CentreAngle(_))) {
            tier.meet = None;
        }
    }
    let solved = alone.solved().tiers.tiers[place].distance;
    (solved.abs() - design.tiers[place].distance.abs()).abs()
}

fn fate(design: &Tiers) -> Fate {
    let met = design.with_stated_meets().with_found_meets();
    let whole = met.solved();
    if let Some(why) = undetermined(design, &met, &whole) {
        return Fate::Undetermined(why);
    }
    let solved = forgotten(&met, &whole).solved();
    let tiers = design.tiers.iter().zip(&solved.tiers.tiers).zip(&solved.outcomes);
    for (place, ((before, after), outcome)) in tiers.enumerate() {
        let apart = (before.distance.abs() - after.distance.abs()).abs();
        if let TierOutcome::Failed(error) = outcome {
            return Fate::Off(error.to_string());
        }
        if apart > COMES_BACK {
            let meet = met.tiers[place].meet.as_ref().map(Meet::to_string).unwrap_or_default();
            return Fate::Off(format!("tier {} is off by {apart:.1e}: {meet}", place + 1));
        }
    }
    Fate::Back
}

#[test]
fn designs_whose_distances_are_forgotten_are_cut_again_by_their_meets() {
    let files = files(&["asc"]);
    let fates: Vec<(String, bool, Fate)> = files
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
    let mut reasons: BTreeMap<(bool, &str), usize> = BTreeMap::new();
    for (name, states, fate) in &fates {
        let reason = match fate {
            Fate::Back => "come back",
            Fate::Off(why) => {
                println!("{name}: {why}");
                "do not come back"
            }
            Fate::Undetermined(why) => why,
        };
        *reasons.entry((*states, reason)).or_default() += 1;
    }
    for ((states, reason), count) in &reasons {
        let which = if *states { "with stated meets" } else { "without stated meets" };
        println!("{count} designs {which}: {reason}");
    }
    for states in [true, false] {
        let count = |reason| reasons.get(&(states, reason)).copied().unwrap_or(0);
        let (back, off) = (count("come back"), count("do not come back"));
        let share = back as f64 / (back + off).max(1) as f64;
        assert!(back > 30 && share >= LEAST, "stated: {states}: {back} come back, {off} do not");
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
    // A size that is another by a thousandth moves what meets it.
    let kept = whole.outcomes.iter().position(|outcome| *outcome != TierOutcome::Solved).unwrap();
    other.tiers[kept].distance *= 1.001;
    let solved = other.solved();
    let apart = design.tiers.iter().zip(&solved.tiers.tiers).enumerate().filter(|(place, _)| *place != kept);
    let most = apart.map(|(_, (a, b))| (a.distance.abs() - b.distance.abs()).abs()).fold(0.0, f64::max);
    assert!(most > COMES_BACK, "{most}");
}
