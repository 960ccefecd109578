//! Solves meets: goes through the tiers in the order in which they are cut, and gives each the distance (and angle,
//! and indices) at which its facets pass through the points of its meet.

use super::super::tiers::{Tier, TierZone, Tiers};
use super::fault::{MeetError, MeetFault};
use super::meet::{Meet, MeetPoint};
use super::names::TierNames;
use super::stone::{FARTHEST, PartStone, StoneCorner, StoneSide};
use crate::facet_zones::EXACT;
use brillianteer_math::Plane;
use glam::DVec3;
use std::f64::consts::TAU;

/// The largest difference between the facets of a tier, in lengths of the largest distance. Files whose distances
/// were found by hand have such differences.
pub(super) const AGREE: f64 = 1e-3;

/// The largest difference between depths that count as one, in lengths of the largest distance.
pub(super) const SAME_DEPTH: f64 = 1e-4;

/// The most times that corners are chosen again for an angle that follows from them.
const MOST_TRIES: usize = 8;

/// A design whose meets were followed.
#[derive(Debug, Clone, PartialEq)]
pub struct SolvedTiers {
    /// The design, with the numbers that follow from its meets. A tier whose meet fails keeps its numbers.
    pub tiers: Tiers,
    /// The outcome for each tier, in their order.
    pub outcomes: Vec<TierOutcome>,
    /// For each tier, the number of corners, at different depths, that fit the names of its meet; 0 where its meet
    /// names none. Where it is above 1, the names alone are ambiguous.
    pub choices: Vec<usize>,
}

/// The outcome for a tier.
#[derive(Debug, Clone, PartialEq)]
pub enum TierOutcome {
    /// The tier keeps its numbers, because it has no meet, because the cutter chooses its size, or because it is not
    /// cut.
    Kept,
    /// The tier keeps its distance, because it is the first at the point that it names: it sets the centre point or
    /// the girdle line.
    Sets,
    /// The meet gave the tier its numbers.
    Solved,
    /// The meet could not be followed.
    Failed(MeetError),
}

impl SolvedTiers {
    /// Returns the meets that could not be followed.
    pub fn errors(&self) -> impl Iterator<Item = &MeetError> {
        self.outcomes.iter().filter_map(|outcome| match outcome {
            TierOutcome::Failed(error) => Some(error),
            _ => None,
        })
    }
}

impl Tiers {
    /// Follows the meets of all tiers and returns the design with the numbers that they give.
    ///
    /// Tiers are cut in the order in which they are listed, except that a tier whose meet names a later one is cut
    /// after that. Of several corners that fit a meet, the facet goes to the first that it reaches as it is cut
    /// deeper.
    pub fn solved(&self) -> SolvedTiers {
        self.followed(true)
    }

    /// Follows the meet of each tier between the design's own planes, so that the meets before it move nothing. The
    /// difference shows how well the design's numbers agree with each meet.
    pub fn checked_meets(&self) -> SolvedTiers {
        self.followed(false)
    }

    /// Follows all meets. Where `by_meets` is true, the tiers before each one lie where their meets place them;
    /// otherwise they lie at their own numbers.
    fn followed(&self, by_meets: bool) -> SolvedTiers {
        let mut bench = Bench::of(self);
        let count = self.tiers.len();
        let (outcomes, choices) = (vec![TierOutcome::Kept; count], vec![0; count]);
        let mut solved = SolvedTiers { tiers: self.clone(), outcomes, choices };
        for place in cutting_order(self) {
            let given = &self.tiers[place];
            if !given.is_cut {
                continue;
            }
            let tier = &mut solved.tiers.tiers[place];
            if let Some(meet) = &given.meet {
                solved.choices[place] = bench.choices(place, tier, meet);
                solved.outcomes[place] = bench.follow(place, tier, meet).unwrap_or_else(|fault| {
                    TierOutcome::Failed(MeetError { tier: place + 1, name: tier.name().to_owned(), fault })
                });
            }
            bench.cut(place, if by_meets { tier } else { given });
        }
        solved
    }
}

/// Returns the places of the tiers in the order in which they are cut.
pub(super) fn cutting_order(tiers: &Tiers) -> Vec<usize> {
    let names = TierNames::of(tiers);
    let needs = |place: usize| -> Vec<Vec<usize>> {
        let Some(Meet::Points(points)) = &tiers.tiers[place].meet else { return vec![] };
        let corners = points.iter().filter_map(|point| point.named().map(|(names, _)| names));
        let of_others = |meant: &Vec<usize>| !meant.is_empty() && !meant.contains(&place);
        corners.flatten().map(|name| names.meant(name, place)).filter(of_others).collect()
    };
    let mut waiting: Vec<(usize, Vec<Vec<usize>>)> =
        (0..tiers.tiers.len()).map(|place| (place, needs(place))).collect();
    let mut order: Vec<usize> = vec![];
    while !waiting.is_empty() {
        let is_ready = |(_, needs): &(usize, Vec<Vec<usize>>)| {
            needs.iter().all(|meant| meant.iter().any(|other| order.contains(other)))
        };
        // Tiers that wait for one another are cut in the order in which they are listed.
        let next = waiting.iter().position(is_ready).unwrap_or(0);
        order.push(waiting.remove(next).0);
    }
    order
}

/// The stone on the bench: the part of a design that is cut so far.
pub(super) struct Bench<'a> {
    design: &'a Tiers,
    names: TierNames,
    stone: PartStone,
    /// The height of the temporary centre point above the girdle line, from the first centre-point angle.
    centre_height: Option<f64>,
    is_done: Vec<bool>,
}

/// A plane through the points of a meet, as the setting of a facet.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacetSolution {
    angle: f64,
    index: f64,
    distance: f64,
}

impl<'a> Bench<'a> {
    pub fn of(design: &'a Tiers) -> Self {
        let largest = design.tiers.iter().map(|tier| tier.distance.abs()).fold(0.0, f64::max);
        let scale = if largest > 0.0 { largest } else { 1.0 };
        let count = design.tiers.iter().map(|tier| tier.facets.len()).sum();
        Self {
            design,
            names: TierNames::of(design),
            stone: PartStone::new(scale, count),
            centre_height: None,
            is_done: vec![false; design.tiers.len()],
        }
    }

    pub fn names(&self) -> &TierNames {
        &self.names
    }

    pub fn stone(&self) -> &PartStone {
        &self.stone
    }

    pub fn plane(&self, tier: &Tier, index: f64) -> Plane {
        self.design.plane(tier, index)
    }

    /// Cuts a tier with its own numbers.
    pub fn cut(&mut self, place: usize, tier: &Tier) {
        if let (Some(Meet::CentreAngle(angle)), None) = (&tier.meet, self.centre_height) {
            self.centre_height = Some(tier.distance.abs() * angle.to_radians().tan());
        }
        self.is_done[place] = true;
        self.stone.cut(place, tier.facets.iter().map(|facet| self.design.plane(tier, facet.index)));
    }

    /// Gives a tier the numbers that follow from a meet.
    pub fn follow(&self, place: usize, tier: &mut Tier, meet: &Meet) -> Result<TierOutcome, MeetFault> {
        match meet {
            Meet::Given(_) => Ok(TierOutcome::Kept),
            Meet::CentreAngle(_) if tier.zone() != TierZone::Girdle => Err(MeetFault::NotUpright),
            Meet::CentreAngle(angle) => {
                let Some(height) = self.centre_height else { return Ok(TierOutcome::Sets) };
                let distance = height / angle.to_radians().tan();
                if distance.is_nan() || distance > FARTHEST * self.stone.scale() {
                    return Err(MeetFault::TooFar { angle: *angle });
                }
                tier.distance = distance.copysign(tier.distance);
                Ok(TierOutcome::Solved)
            }
            Meet::Points(points) if self.is_first(tier, points) => Ok(TierOutcome::Sets),
            Meet::Points(points) => self.follow_points(place, tier, points).map(|()| TierOutcome::Solved),
        }
    }

    /// Returns whether a tier itself makes the one point that its meet names, because nothing on its side makes it
    /// yet.
    fn is_first(&self, tier: &Tier, points: &[MeetPoint]) -> bool {
        let Some(first) = tier.facets.first() else { return true };
        let side = StoneSide::of(self.design.plane(tier, first.index).normal);
        match points {
            [] => true,
            [MeetPoint::Centre { .. }] => side.is_some_and(|side| self.stone.centre(side).is_none()),
            [MeetPoint::LevelGirdle] => self.girdle_height(side).is_none(),
            _ => false,
        }
    }

    /// Returns the height of the girdle line on a side; for an upright facet, that below or, where there is none,
    /// that above.
    fn girdle_height(&self, side: Option<StoneSide>) -> Option<f64> {
        let below = || self.stone.girdle_height(StoneSide::Below);
        side.map_or_else(
            || below().or_else(|| self.stone.girdle_height(StoneSide::Above)),
            |side| self.stone.girdle_height(side),
        )
    }

    fn follow_points(&self, place: usize, tier: &mut Tier, points: &[MeetPoint]) -> Result<(), MeetFault> {
        let planes = self.planes(tier, tier.angle);
        let solve = |facet| self.facet_through(place, tier, &planes, facet, points);
        let solutions = (0..tier.facets.len()).map(solve).collect::<Result<Vec<_>, _>>()?;
        let Some(first) = solutions.first() else { return Ok(()) };
        let most = AGREE * self.stone.scale();
        for (other, facet) in solutions.iter().zip(&tier.facets) {
            let apart = (other.distance - first.distance).abs();
            let turned = (other.angle - first.angle).abs();
            if apart > most || turned > AGREE.to_degrees() {
                let by = if apart > most { apart } else { turned };
                return Err(MeetFault::Disagree { first: tier.facets[0].index, other: facet.index, by });
            }
        }
        tier.angle = first.angle;
        tier.distance = first.distance.copysign(tier.distance);
        for (facet, solution) in tier.facets.iter_mut().zip(&solutions) {
            facet.index = solution.index;
        }
        Ok(())
    }

    /// Returns the planes of a tier's facets at another angle.
    pub fn planes(&self, tier: &Tier, angle: f64) -> Vec<Plane> {
        let bare = Tier { angle, instructions: String::new(), facets: vec![], meet: None, ..*tier };
        tier.facets.iter().map(|facet| self.design.plane(&bare, facet.index)).collect()
    }

    /// Returns the planes of a tier's facets at the angle of one of them, with that one at its index.
    pub fn planes_of(&self, tier: &Tier, facet: usize, solution: &FacetSolution) -> Vec<Plane> {
        let mut turned = self.planes(tier, solution.angle);
        let bare =
            Tier { angle: solution.angle, instructions: String::new(), facets: vec![], meet: None, ..*tier };
        turned[facet] = self.design.plane(&bare, solution.index);
        turned
    }

    /// Returns the setting at which one facet of a tier passes through points. `planes` are those of the tier.
    fn facet_through(
        &self,
        place: usize,
        tier: &Tier,
        planes: &[Plane],
        facet: usize,
        points: &[MeetPoint],
    ) -> Result<FacetSolution, MeetFault> {
        let places = |planes: &[Plane]| {
            let place = |point| self.point(place, planes, facet, point);
            points.iter().map(place).collect::<Result<Vec<DVec3>, _>>()
        };
        let mut through = places(planes)?;
        let mut solution = self.through(tier, facet, planes[facet].normal, &through)?;
        // With the new angle, the facet may reach other corners first.
        for _ in 1..if points.len() > 1 { MOST_TRIES } else { 1 } {
            let turned = self.planes_of(tier, facet, &solution);
            let again = places(&turned)?;
            if again == through {
                break;
            }
            solution = self.through(tier, facet, turned[facet].normal, &again)?;
            through = again;
        }
        Ok(solution)
    }

    /// Returns the place of a point of a meet for a facet. `planes` are those of the facet's tier.
    pub fn point(
        &self,
        place: usize,
        planes: &[Plane],
        facet: usize,
        point: &MeetPoint,
    ) -> Result<DVec3, MeetFault> {
        let normal = planes[facet].normal;
        let side = StoneSide::of(normal);
        let missing = || MeetFault::NoPoint { point: point.clone() };
        match point {
            MeetPoint::Centre { .. } => {
                let side = side.ok_or(MeetFault::Upright)?;
                let height = self.stone.centre(side).ok_or_else(missing)?;
                Ok(DVec3::new(0.0, 0.0, height.copysign(normal.z)))
            }
            MeetPoint::LevelGirdle => {
                let height = self.girdle_height(side).ok_or(MeetFault::NoGirdleLine)?;
                self.stone.section_support(height, normal).ok_or_else(missing)
            }
            MeetPoint::GirdlePoint => {
                let fits = |corner: &StoneCorner| self.is_girdle_corner(corner, side);
                self.reached(planes, facet, fits).first().copied().ok_or_else(missing)
            }
            MeetPoint::Corner(named) | MeetPoint::LaterCorner { names: named, .. } => {
                let number = point.named().map_or(1, |(_, number)| number);
                let meant = self.meant(place, named)?;
                let fits = |corner: &StoneCorner| self.is_corner_of(corner, &meant);
                let reached = self.reached(planes, facet, fits);
                reached.get(number.saturating_sub(1)).copied().ok_or_else(missing)
            }
        }
    }

    /// Returns, for each name, the tiers that it means, of which at least one is cut.
    pub fn meant(&self, place: usize, named: &[String]) -> Result<Vec<Vec<usize>>, MeetFault> {
        let of_name = |name: &String| {
            let meant = self.names.meant(name, place);
            if meant.is_empty() {
                Err(MeetFault::UnknownName { name: name.clone() })
            } else if !meant.iter().any(|&tier| self.is_done[tier]) {
                Err(MeetFault::NotCutYet { name: name.clone() })
            } else {
                Ok(meant)
            }
        };
        named.iter().map(of_name).collect()
    }

    /// Returns the setting of a facet whose plane passes through one to three places. With one place, angle and index
    /// stay; with two, the index stays.
    pub fn through(
        &self,
        tier: &Tier,
        facet: usize,
        normal: DVec3,
        places: &[DVec3],
    ) -> Result<FacetSolution, MeetFault> {
        let index = tier.facets[facet].index;
        let kept = FacetSolution { angle: tier.angle, index, distance: normal.dot(places[0]) };
        let (first, others) = (places[0], &places[1..]);
        let same = SAME_DEPTH * self.stone.scale();
        let solution = match others {
            [second, third, ..] => self.through_three(tier, index, normal, [first, *second, *third])?,
            [second] => {
                let azimuth = self.azimuth(index);
                let out = DVec3::new(azimuth.sin(), -azimuth.cos(), 0.0);
                let (rise, run) = ((second.z - first.z) * normal.z.signum(), out.dot(first - *second));
                // Points with the same height and radius do not determine the angle, so it stays.
                if rise.abs().max(run.abs()) <= same {
                    kept
                } else {
                    let slope = rise.atan2(run);
                    let slope = if slope < 0.0 { slope + TAU / 2.0 } else { slope };
                    let (sin, cos) = slope.sin_cos();
                    let before = normal;
                    let normal = out * sin + DVec3::Z * (cos * normal.z.signum());
                    let angle = slope.to_degrees().copysign(before.z);
                    FacetSolution { angle, index, distance: normal.dot(first) }
                }
            }
            [] => kept,
        };
        if solution.distance < 0.0 { Err(MeetFault::BeyondAxis) } else { Ok(solution) }
    }

    fn through_three(
        &self,
        tier: &Tier,
        index: f64,
        before: DVec3,
        [a, b, c]: [DVec3; 3],
    ) -> Result<FacetSolution, MeetFault> {
        let across = (b - a).cross(c - a);
        let least = SAME_DEPTH * self.stone.scale() * (b - a).length().max((c - a).length());
        if across.length() <= least {
            return Err(MeetFault::OneLine);
        }
        let normal = across.normalize_or_zero();
        let normal = if normal.dot(before) < 0.0 { -normal } else { normal };
        let level = normal.truncate().length();
        // A direction that is level except for rounding has no side, so an upright facet keeps its sign.
        let side = if normal.z.abs() < EXACT { tier.angle } else { normal.z };
        let angle = level.atan2(normal.z.abs()).to_degrees().copysign(side);
        let teeth = f64::from(self.design.gear);
        let exact = normal.x.atan2(-normal.y) / TAU * teeth + self.design.offset;
        let turns = ((index - exact) / teeth).round();
        let index = if level > 0.0 { exact + turns * teeth } else { index };
        Ok(FacetSolution { angle, index, distance: normal.dot(a) })
    }

    fn azimuth(&self, index: f64) -> f64 {
        (index - self.design.offset) / f64::from(self.design.gear) * TAU
    }
}
