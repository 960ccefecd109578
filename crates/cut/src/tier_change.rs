//! Changes of the list of tiers of a cutter's design, as its table in the editor makes them.

use super::meets::{Meet, SolvedTiers};
use super::tiers::{Indexed, Tier, TierZone, Tiers};
use brillianteer_math::{Plane, Polytope};
use glam::DVec3;

/// Half of the last decimal of indices in the editor, teeth.
const SHOWN: f64 = 0.5e-4;

/// Half of the last decimal of indices on sheets, teeth.
const PRINTED: f64 = 0.5e-3;

/// The angle by which a new tier is flatter than the one before it, degrees.
const FLATTER: f64 = 3.0;

/// The distance from a whole tooth up to which an index becomes that tooth after a change of the gear.
const WHOLE: f64 = 1e-9;

/// A change of the list of tiers. Places count from 0, in the order of cutting, with the tiers that are not cut.
#[derive(Debug, Clone, PartialEq)]
pub enum TierChange {
    /// Inserts a tier at a place; those from there on move down.
    Insert(usize, Tier),
    /// Inserts a copy of a tier after it.
    Copy(usize),
    /// Takes a tier out of the list.
    Delete(usize),
    /// Moves a tier from one place to another; those between close up.
    Move(usize, usize),
    /// Divides a tier in two: the first half of its facets stays, the others become a tier after it.
    Split(usize),
    /// Sets whether a tier is cut.
    IsCut(usize, bool),
    /// Names a tier. Its facets get no names of their own. Meets that name this tier alone follow.
    Name(usize, String),
    /// Sets the instructions of a tier.
    Instructions(usize, String),
    /// Sets the indices at which a tier is cut, in teeth.
    Indices(usize, Vec<f64>),
    /// Sets the angle of a tier, degrees, and its distance, in the unit of the design. A tier whose distance changes loses its
    /// meet, which would give another, and instructions that say no more than that meet; a size that the cutter chooses stays.
    Setting(usize, f64, f64),
    /// Sets the frosting of the facets of a tier: 0 polished, 1 as rough as possible.
    Frosting(usize, f64),
    /// Sets the meet of a tier; `None` for its distance alone. Instructions that state another meet are replaced by
    /// the words of this one.
    Meet(usize, Option<Meet>),
    /// Gives every tier without a meet the one that its instructions state, or else the one that the geometry shows; neither
    /// where it would move the tier.
    FindMeets,
    /// Sets the teeth of the index gear, below 0 where they are counted clockwise; not 0. All facets stay in their
    /// places, so their indices change.
    Gear(i32),
    /// States the number of repeats of the design around its axis, and whether each repeat is its own mirror image.
    /// No facet changes.
    Symmetry(u32, bool),
}

impl Tiers {
    /// Returns the design with a change made and all meets followed.
    pub fn changed(&self, change: TierChange) -> SolvedTiers {
        let mut design = self.clone();
        design.change(change);
        design.solved()
    }

    /// Makes a change. A place past the last tier changes nothing. Tiers without a name get theirs where a meet may name them,
    /// as another tier might be called so after the change.
    pub fn change(&mut self, change: TierChange) {
        let count = self.tiers.len();
        if self.has_named_meets() {
            *self = std::mem::take(self).with_names();
        }
        match change {
            TierChange::Insert(place, tier) => self.tiers.insert(place.min(count), tier),
            TierChange::Move(from, to) if from < count && to < count => {
                let moved = self.tiers.remove(from);
                self.tiers.insert(to, moved);
            }
            TierChange::Copy(place) | TierChange::Split(place) if place < count => {
                let mut copy = self.tiers[place].clone();
                if let TierChange::Split(_) = change {
                    copy.facets = self.tiers[place].split_off();
                }
                copy.rename(&self.free_name(&self.names()[place]));
                if !copy.facets.is_empty() {
                    self.tiers.insert(place + 1, copy);
                }
            }
            TierChange::FindMeets => *self = self.with_own_meets().with_names_in_meets(),
            TierChange::Gear(teeth) if teeth != 0 => self.change_gear(teeth),
            TierChange::Symmetry(symmetry, mirror) => (self.symmetry, self.mirror) = (symmetry, mirror),
            TierChange::Name(place, name) if place < count => {
                self.rename_in_meets(place, &name);
                self.tiers[place].rename(&name);
            }
            TierChange::Delete(place) if place < count => drop(self.tiers.remove(place)),
            TierChange::Meet(place, Some(meet)) if place < count => {
                let stated = self.meet_in_words(place, &self.tiers[place].instructions);
                if stated
                    .is_some_and(|stated| self.tiers[place].meet.as_ref() != Some(&meet) && stated != meet)
                {
                    let others = self.words_beside_meets(place);
                    let words = if others.is_empty() { others } else { format!("{meet}, {others}") };
                    self.tiers[place].instructions = words;
                }
                self.tiers[place].meet = Some(meet);
            }
            TierChange::Setting(place, angle, distance) if place < count => {
                let tier = &self.tiers[place];
                if distance != tier.distance && !matches!(tier.meet, Some(Meet::Given(_)) | None) {
                    self.tiers[place].instructions = self.words_beside_meets(place);
                    self.tiers[place].meet = None;
                }
                (self.tiers[place].angle, self.tiers[place].distance) = (angle, distance);
            }
            TierChange::IsCut(place, _)
            | TierChange::Instructions(place, _)
            | TierChange::Indices(place, _)
            | TierChange::Frosting(place, _)
            | TierChange::Meet(place, _)
                if place < count =>
            {
                self.tiers[place].change(change);
            }
            _ => {}
        }
    }

    /// Returns the design with instructions that state no other meets than its tiers have: where a tier was found to meet another
    /// point than its words say, the words become those of its meet.
    #[must_use]
    pub fn with_words_of_meets(mut self) -> Self {
        for place in 0..self.tiers.len() {
            let stated = self.meet_in_words(place, &self.tiers[place].instructions);
            if stated.is_some_and(|stated| self.tiers[place].meet.as_ref() != Some(&stated)) {
                let meet = self.tiers[place].meet.take();
                if meet.is_some() {
                    self.change(TierChange::Meet(place, meet));
                }
            }
        }
        self
    }

    /// Returns the clauses of a tier's instructions that state no meet.
    fn words_beside_meets(&self, place: usize) -> String {
        let text = &self.tiers[place].instructions;
        let clauses = text.split("; ").flat_map(|part| part.split(", ")).flat_map(|part| part.split(". "));
        let others = clauses.filter(|clause| self.meet_in_words(place, clause).is_none());
        others.map(str::trim).filter(|clause| !clause.is_empty()).collect::<Vec<_>>().join(", ")
    }

    /// Puts another gear on the machine, at whose indices the facets lie as before.
    fn change_gear(&mut self, teeth: i32) {
        let ratio = f64::from(teeth) / f64::from(self.gear);
        let changed = |index: f64| {
            let exact = index * ratio;
            let exact = if (exact - exact.round()).abs() < WHOLE { exact.round() } else { exact };
            if exact < 0.0 { exact + f64::from(teeth.abs()) } else { exact }
        };
        (self.gear, self.offset) = (teeth, changed(self.offset));
        let facets = self.tiers.iter_mut().flat_map(|tier| &mut tier.facets);
        facets.for_each(|facet| facet.index = changed(facet.index));
    }

    /// Writes a tier's new name into the meets that mean this tier alone by its old one.
    fn rename_in_meets(&mut self, place: usize, name: &str) {
        let names = self.names();
        let old = &names[place];
        let is_only = names.iter().filter(|other| other.eq_ignore_ascii_case(old)).count() == 1;
        if name.is_empty() || !is_only {
            return;
        }
        let points = self.tiers.iter_mut().filter_map(|tier| tier.meet.as_mut());
        let names = points.flat_map(Meet::names_mut).filter(|own| own.eq_ignore_ascii_case(old));
        names.for_each(|own| name.clone_into(own));
    }

    /// Returns a name like the one given that no tier has: its letters with the next free number.
    pub fn free_name(&self, like: &str) -> String {
        let letters = like.trim_end_matches(|c: char| c.is_ascii_digit());
        let names = self.names();
        let is_free = |name: &String| !names.contains(name);
        (1..).map(|number| format!("{letters}{number}")).find(is_free).unwrap_or_default()
    }

    /// Returns the names of the tiers with an index between two teeth of the gear, as far as three decimals show it,
    /// the number that sheets print. Flat tiers have no direction, and are left out.
    pub fn between_teeth(&self) -> Vec<String> {
        let is_flat = |tier: &Tier| matches!(tier.zone(), TierZone::Table | TierZone::Culet);
        let is_between = |facet: &Indexed| (facet.index - facet.index.round()).abs() >= PRINTED;
        let named = self.names().into_iter().zip(&self.tiers);
        let leaning = named.filter(|(_, tier)| !is_flat(tier));
        leaning.filter(|(_, tier)| tier.facets.iter().any(is_between)).map(|(name, _)| name).collect()
    }

    /// Returns the place in the list of the tier that is the one at `number`, from 0, among those that are cut; the length of the
    /// list where there are not so many.
    pub fn place_of_cut(&self, number: usize) -> usize {
        let cut = self.tiers.iter().enumerate().filter(|(_, tier)| tier.is_cut);
        cut.map(|(place, _)| place).nth(number).unwrap_or(self.tiers.len())
    }

    /// Returns the place of the tier to which a plane of the design belongs. `plane` counts the facets of all tiers that are
    /// cut, in their order.
    pub fn tier_of_plane(&self, plane: usize) -> Option<usize> {
        self.facet_of_plane(plane).map(|(tier, _)| tier)
    }

    /// Returns the place of the tier to which a plane of the design belongs, as [`tier_of_plane`](Self::tier_of_plane) does, and
    /// the place of the facet in that tier.
    pub fn facet_of_plane(&self, plane: usize) -> Option<(usize, usize)> {
        let mut before = 0;
        self.tiers.iter().enumerate().filter(|(_, tier)| tier.is_cut).find_map(|(place, tier)| {
            let facet = plane.checked_sub(before).filter(|facet| *facet < tier.facets.len());
            before += tier.facets.len();
            facet.map(|facet| (place, facet))
        })
    }
}

impl Tiers {
    /// Makes a tier for a place in the list, with the indices of the tier before it. It is 3 degrees flatter than
    /// that one, or steeper where there is no room, and touches the stone at a corner or an edge.
    pub fn beside_stone(&self, place: usize) -> Tier {
        let before = place.checked_sub(1).and_then(|place| self.tiers.get(place));
        let angle = match before.map_or(0.0, |tier| tier.angle) {
            0.0 => 30.0,
            90.0 | -90.0 => -45.0,
            angle if angle.abs() > 2.0 * FLATTER => angle - FLATTER.copysign(angle),
            angle => angle + FLATTER.copysign(angle),
        };
        let mut indices: Vec<f64> =
            before.map_or(vec![], |tier| tier.facets.iter().map(|facet| facet.index).collect());
        if indices.len() < 2 {
            let repeats = self.symmetry.clamp(1, 96);
            indices = (0..repeats)
                .map(|k| f64::from(self.gear.abs()) * f64::from(k) / f64::from(repeats))
                .collect();
        }
        let mut tier = Tier {
            angle,
            distance: 1.0,
            instructions: String::new(),
            meet: None,
            is_cut: true,
            frosting: 0.0,
            facets: vec![],
        };
        tier.change(TierChange::Indices(0, indices));
        tier.rename(&self.free_name(match tier.zone() {
            TierZone::Pavilion => "P1",
            _ => "C1",
        }));
        let normals: Vec<DVec3> =
            tier.facets.iter().map(|facet| self.plane(&tier, facet.index).normal).collect();
        let reach = self.corners().into_iter().flat_map(|corner| normals.iter().map(move |n| n.dot(corner)));
        tier.distance = reach.fold(0.0, f64::max);
        tier
    }

    /// Returns the corners of the stone in the design's unit; none where the facets make none.
    fn corners(&self) -> Vec<DVec3> {
        let mut planes: Vec<Plane> = self.facets().into_iter().map(|(_, plane)| plane).collect();
        let solid = Polytope::from_planes(&planes).or_else(|_| {
            planes.extend(Self::block().map(|(_, plane)| plane));
            Polytope::from_planes(&planes)
        });
        solid.map(|solid| solid.vertices().to_vec()).unwrap_or_default()
    }
}

impl Tier {
    /// Names the tier: its first facet gets the name, the others none.
    pub fn rename(&mut self, name: &str) {
        self.facets.iter_mut().for_each(|facet| facet.name.clear());
        if let Some(first) = self.facets.first_mut() {
            name.clone_into(&mut first.name);
        }
    }

    /// Makes a change that concerns only this tier.
    fn change(&mut self, change: TierChange) {
        match change {
            TierChange::IsCut(_, is_cut) => self.is_cut = is_cut,
            TierChange::Instructions(_, text) => self.instructions = text,
            TierChange::Indices(_, indices) => {
                let name = self.name().to_owned();
                // An index that equals the rounded one on the screen keeps its further digits.
                let kept = |index: f64| {
                    let same = self.facets.iter().find(|facet| (facet.index - index).abs() < SHOWN);
                    same.map_or(index, |facet| facet.index)
                };
                let facet = |index| Indexed { index: kept(index), name: String::new() };
                self.facets = indices.into_iter().map(facet).collect();
                self.rename(&name);
            }
            TierChange::Frosting(_, frosting) => self.frosting = frosting,
            TierChange::Meet(_, meet) => self.meet = meet,
            _ => {}
        }
    }

    /// Takes the second half of the facets out of the tier.
    fn split_off(&mut self) -> Vec<Indexed> {
        self.facets.split_off(self.facets.len().div_ceil(2))
    }

    /// Writes the indices as cutters do, joined by dashes, to four decimals; index 0 is the gear's last tooth.
    pub fn indices(&self, gear: i32) -> String {
        let tooth = |facet: &Indexed| match facet.index {
            0.0 => gear.abs().to_string(),
            index => ((index * 1e4).round() / 1e4).to_string(),
        };
        self.facets.iter().map(tooth).collect::<Vec<_>>().join("-")
    }
}

/// Reads indices as cutters write them: joined by dashes, commas or blanks. `None` where one of them is no number, or
/// where there is none.
pub fn read_indices(text: &str) -> Option<Vec<f64>> {
    let parts =
        text.split(|c: char| c == '-' || c == ',' || c.is_whitespace()).filter(|part| !part.is_empty());
    let indices: Option<Vec<f64>> =
        parts.map(|part| part.parse().ok().filter(|i: &f64| i.is_finite())).collect();
    indices.filter(|indices| !indices.is_empty())
}

#[cfg(test)]
mod tests {
    use super::super::MeetPoint;
    use super::*;

    fn design() -> Tiers {
        let tier = |name: &str, angle: f64, indices: &[f64]| {
            let facet = |(k, &index): (usize, &f64)| Indexed {
                index,
                name: if k == 0 { name.to_owned() } else { String::new() },
            };
            Tier {
                angle,
                distance: 1.0,
                instructions: String::new(),
                meet: None,
                is_cut: true,
                frosting: 0.0,
                facets: indices.iter().enumerate().map(facet).collect(),
            }
        };
        let tiers = vec![
            tier("P1", -42.0, &[0.0, 24.0, 48.0, 72.0]),
            tier("G1", 90.0, &[12.0, 36.0, 60.0, 84.0]),
            tier("T", 0.0, &[0.0]),
        ];
        Tiers { gear: 96, tiers, ..Tiers::default() }
    }

    fn names(tiers: &Tiers) -> Vec<&str> {
        tiers.tiers.iter().map(Tier::name).collect()
    }

    #[test]
    fn tiers_are_copied_deleted_and_moved() {
        let mut tiers = design();
        tiers.change(TierChange::Copy(0));
        assert_eq!(names(&tiers), ["P1", "P2", "G1", "T"]);
        assert_eq!(tiers.tiers[0].facets.len(), tiers.tiers[1].facets.len());
        tiers.change(TierChange::Move(3, 0));
        assert_eq!(names(&tiers), ["T", "P1", "P2", "G1"]);
        tiers.change(TierChange::Move(0, 3));
        tiers.change(TierChange::Delete(1));
        assert_eq!(tiers, design());
        let last = tiers.tiers[2].clone();
        tiers.change(TierChange::Insert(99, last));
        assert_eq!(names(&tiers), ["P1", "G1", "T", "T"]);
        // Places past the last tier change nothing.
        let before = tiers.clone();
        for change in [
            TierChange::Copy(9),
            TierChange::Delete(4),
            TierChange::Move(0, 4),
            TierChange::Split(4),
            TierChange::IsCut(7, false),
        ] {
            tiers.change(change);
        }
        assert_eq!(tiers, before);
    }

    #[test]
    fn a_split_keeps_every_facet_and_one_facet_stays_whole() {
        let mut tiers = design();
        let before = tiers.count();
        tiers.change(TierChange::Split(0));
        assert_eq!(names(&tiers), ["P1", "P2", "G1", "T"]);
        assert_eq!(tiers.count(), before);
        assert_eq!(tiers.tiers[1].indices(96), "48-72");
        tiers.change(TierChange::Split(3));
        assert_eq!(tiers.tiers.len(), 4);
    }

    #[test]
    fn a_tier_is_named_muted_indexed_and_set() {
        let mut tiers = design();
        tiers.change(TierChange::Indices(0, vec![6.0, 90.0]));
        tiers.change(TierChange::IsCut(0, false));
        tiers.change(TierChange::Setting(0, -40.5, 0.9));
        tiers.change(TierChange::Instructions(0, "Cut to TCP".to_owned()));
        let tier = &tiers.tiers[0];
        assert_eq!((tier.name(), tier.angle, tier.distance, tier.is_cut), ("P1", -40.5, 0.9, false));
        assert_eq!((tier.indices(96).as_str(), tier.instructions.as_str()), ("6-90", "Cut to TCP"));
        tiers.change(TierChange::Name(0, "main".to_owned()));
        assert_eq!(tiers.tiers[0].name(), "main");
        // A tier that is not cut has no planes.
        assert_eq!(tiers.tier_of_plane(0), Some(1));
        assert_eq!((tiers.tier_of_plane(4), tiers.tier_of_plane(5)), (Some(2), None));
    }

    #[test]
    fn instructions_never_state_another_meet_than_the_tier_has() {
        let mut tiers = design();
        let meet =
            |names: [&str; 3]| Meet::Points(vec![MeetPoint::Corner(names.map(str::to_owned).to_vec())]);
        tiers.tiers[2].instructions = "meet p1-P1-g1.".to_owned();
        tiers.tiers[2].meet = Some(meet(["P1", "P1", "G1"]));
        let stated = tiers.clone();
        // The same meet keeps its words, another one has its own.
        tiers.change(TierChange::Meet(2, Some(meet(["P1", "P1", "G1"]))));
        assert_eq!(tiers, stated);
        tiers.change(TierChange::Meet(2, Some(meet(["P1", "G1", "G1"]))));
        assert_eq!(tiers.tiers[2].instruction(), "Meet P1-G1-G1");
        // A distance of its own ends the meet, and words that state it alone.
        let mut tiers = stated.clone();
        tiers.change(TierChange::Setting(2, 0.0, 0.7));
        assert_eq!((tiers.tiers[2].meet.clone(), tiers.tiers[2].instruction().as_ref()), (None, ""));
        let mut tiers = stated;
        tiers.tiers[2].instructions = "Polish first".to_owned();
        tiers.change(TierChange::Setting(2, 0.0, 0.7));
        assert_eq!(tiers.tiers[2].instructions, "Polish first");
        // Their other words stay.
        tiers.tiers[2].instructions = "Meet P1-P1-G1, polish with 3000".to_owned();
        tiers.change(TierChange::Meet(2, Some(meet(["P1", "G1", "G1"]))));
        assert_eq!(tiers.tiers[2].instructions, "Meet P1-G1-G1, polish with 3000");
        tiers.change(TierChange::Setting(2, 0.0, 0.75));
        assert_eq!(tiers.tiers[2].instructions, "polish with 3000");
        // A size that the cutter chooses is chosen again.
        let given = Some(Meet::Given(super::super::GivenSize::Size));
        tiers.tiers[1].meet.clone_from(&given);
        tiers.change(TierChange::Setting(1, 90.0, 0.7));
        assert_eq!(tiers.tiers[1].meet, given);
    }

    #[test]
    fn meets_follow_the_name_of_a_tier_and_planes_stay_on_another_gear() {
        let mut tiers = design();
        let meet =
            |names: [&str; 2]| Meet::Points(vec![MeetPoint::Corner(names.map(str::to_owned).to_vec())]);
        tiers.change(TierChange::Meet(2, Some(meet(["p1", "G1"]))));
        tiers.change(TierChange::Name(0, "Main".to_owned()));
        assert_eq!(tiers.tiers[2].meet, Some(meet(["Main", "G1"])));
        // A name that two tiers have is ambiguous.
        tiers.change(TierChange::Name(1, "Main".to_owned()));
        tiers.change(TierChange::Name(1, "G9".to_owned()));
        assert_eq!(tiers.tiers[2].meet, Some(meet(["Main", "Main"])));
        let before = tiers.facets();
        tiers.change(TierChange::Gear(-80));
        assert_eq!(tiers.tiers[0].indices(-80), "80-60-40-20");
        tiers.change(TierChange::Gear(0));
        for ((_, now), (_, then)) in tiers.facets().iter().zip(&before) {
            assert!(now.normal.abs_diff_eq(then.normal, 1e-14) && now.offset == then.offset);
        }
        tiers.change(TierChange::Symmetry(2, true));
        assert_eq!((tiers.gear, tiers.symmetry, tiers.mirror), (-80, 2, true));
    }

    #[test]
    fn a_tier_that_is_added_touches_the_stone_and_cuts_nothing() {
        let mut tiers = design();
        tiers.symmetry = 4;
        for place in 0..=3 {
            let mut more = tiers.clone();
            let tier = more.beside_stone(place);
            assert!(!tiers.tiers.iter().any(|old| old.name() == tier.name()));
            let planes: Vec<Plane> = tier.facets.iter().map(|facet| more.plane(&tier, facet.index)).collect();
            let corners = more.corners();
            let highest = |plane: &Plane| corners.iter().map(|c| plane.distance(*c)).fold(f64::MIN, f64::max);
            let most = planes.iter().map(highest).fold(f64::MIN, f64::max);
            assert!(most.abs() < 1e-12 && !corners.is_empty(), "{most}");
            more.change(TierChange::Insert(place, tier));
            assert_eq!(more.tiers.len(), 4);
        }
    }

    #[test]
    fn indices_are_read_as_they_are_written() {
        for tier in &design().tiers {
            let read = read_indices(&tier.indices(96)).unwrap();
            let written: Vec<f64> = tier.facets.iter().map(|facet| facet.index).collect();
            let same = read.iter().zip(&written).all(|(a, b)| (a - b).rem_euclid(96.0) == 0.0);
            assert!(same && read.len() == written.len(), "{read:?} {written:?}");
        }
        assert_eq!(read_indices("6, 12.5 18--24"), Some(vec![6.0, 12.5, 18.0, 24.0]));
        assert!([" ", "6-x", "-", "1e999"].iter().all(|text| read_indices(text).is_none()));
    }
}
