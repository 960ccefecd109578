//! Reads the instructions of cutters as meets.
//!
//! The words were collected from some five thousand instructions in published designs.

use super::meet::{ANY_GIRDLE, GivenSize, Meet, MeetPoint};
use super::names::TierNames;
use super::written::{self, MOST_POINTS};
use crate::tiers::{TierZone, Tiers};

/// Words for the point where the axis leaves the stone.
const CENTRE: [&str; 9] = [
    "pcp",
    "cp",
    "centerpoint",
    "centrepoint",
    "center point",
    "centre point",
    "perm.cpt",
    "meet culet",
    "at culet",
];

/// Words for a point on the axis that later tiers cut away.
const TEMPORARY: [&str; 2] = ["tcp", "temporary"];

/// Words for a corner of the girdle.
const GIRDLE_POINT: [&str; 12] = [
    "gmp",
    "g.m.p",
    "girdle meet",
    "meet girdle",
    "meet the girdle",
    "meet at girdle",
    "cut to girdle",
    "cut to meet girdle",
    "match girdle",
    "mp @ girdle",
    "mp@ girdle",
    "to the girdle",
];

/// Words for a size that the cutter chooses.
const CHOSEN: [&str; 16] = [
    "set",
    "fix",
    "size",
    "establish",
    "estimate",
    "width",
    "length",
    "thickness",
    "tickness",
    "locate",
    "position",
    "leave some",
    "by eye",
    "eyeball",
    "choice",
    "form girdle",
];

/// Words that precede the names of a corner.
const BEFORE_NAMES: [&str; 6] = ["meet", "meets", "mp", "to", "from", "with"];

/// Words before a point that the tier makes and does not meet.
const MADE: [&str; 4] = ["form", "make", "create", "new"];

/// Returns, for each tier, the meets that its instruction may mean, the literal one first; the list is empty where it
/// states none.
pub(super) fn stated(tiers: &Tiers) -> Vec<Vec<Meet>> {
    let names = TierNames::of(tiers);
    let mut meets: Vec<Vec<Meet>> = vec![];
    for (place, tier) in tiers.tiers.iter().enumerate() {
        let above = meets.last().cloned().unwrap_or_default();
        meets.push(readings(&tier.instructions, tier.zone(), &names, place, above));
    }
    meets
}

impl Tiers {
    /// Reads the literal meaning of an instruction for the tier at a place, from 0; `None` where it states no meet.
    pub fn meet_in_words(&self, place: usize, text: &str) -> Option<Meet> {
        let tier = self.tiers.get(place)?;
        let names = TierNames::of(self);
        let mut meet = readings(text, tier.zone(), &names, place, vec![]).into_iter().next()?;
        name_as_written(&mut meet, &names, place);
        Some(meet)
    }
}

/// Writes each name in a meet as its tier has it, where they differ only in small and capital letters. `place` is the
/// tier of the meet.
pub(super) fn name_as_written(meet: &mut Meet, names: &TierNames, place: usize) {
    for name in meet.names_mut() {
        let mut meant = names.meant(name, place).into_iter().map(|tier| names.written(tier, place));
        let own = meant.find(|own| own.eq_ignore_ascii_case(name));
        own.into_iter().for_each(|own| *name = own);
    }
}

/// Reads one instruction. `above` holds the readings of the tier before, which a ditto mark repeats.
fn readings(text: &str, zone: TierZone, names: &TierNames, from: usize, above: Vec<Meet>) -> Vec<Meet> {
    let text = text.to_lowercase();
    let literal = written::points(&text, names, from).map(Meet::Points);
    if text.contains(['"', '“', '”']) && !text.contains(|c: char| c.is_alphanumeric() && c != 'g') {
        return above;
    }
    if let Some(angle) = centre_angle(&text) {
        return vec![match zone {
            TierZone::Girdle => Meet::CentreAngle(angle),
            _ => Meet::Points(vec![MeetPoint::Centre { temporary: true }]),
        }];
    }
    let (mut corners, ends_at_centre) = corners(&text, names, from);
    corners.truncate(MOST_POINTS);
    let has = |words: &[&str]| words.iter().any(|word| has_words(&text, word));
    let centre = if has(&TEMPORARY) {
        Some(MeetPoint::Centre { temporary: true })
    } else {
        has(&CENTRE).then_some(MeetPoint::Centre { temporary: false })
    };
    let is_new_centre = centre.is_some() && has(&MADE);
    let is_chosen = has(&CHOSEN);
    let is_at_girdle = GIRDLE_POINT.iter().any(|words| text.contains(words)) && !is_chosen;
    let is_level = has_words(&text, "level") && text.contains("girdle") && !has_words(&text, "not level");
    let centre = centre.filter(|_| ends_at_centre || !(text.contains("w from") || text.contains("below")));

    let mut points: Vec<Vec<MeetPoint>> = vec![];
    points.extend(centre.clone().filter(|_| ends_at_centre).map(|centre| vec![centre]));
    points.extend((!corners.is_empty()).then(|| corners.clone()));
    points.extend(is_at_girdle.then(|| vec![MeetPoint::GirdlePoint]));
    points.extend(centre.filter(|_| !ends_at_centre).map(|centre| vec![centre]));
    points.extend((is_level && !(points.is_empty() && is_chosen)).then(|| vec![MeetPoint::LevelGirdle]));
    points.extend(other_corners(&corners, names, from));
    let chosen = is_chosen.then(|| {
        let is_girdle = text.contains("girdle") || text.contains("thick");
        if is_girdle && zone != TierZone::Girdle { GivenSize::GirdleThickness } else { GivenSize::Size }
    });
    let chosen = chosen.or(is_new_centre.then_some(GivenSize::CentrePoint));
    let read = points.into_iter().map(Meet::Points).chain(chosen.map(Meet::Given));
    let mut meets: Vec<Meet> = literal.iter().cloned().collect();
    meets.extend(read.filter(|meet| literal.as_ref() != Some(meet)));
    meets
}

/// Returns the meanings of the names of corners other than the literal one: each of several corners alone, or tiers
/// on the side of the tier where the names have the letter of the other side.
fn other_corners(corners: &[MeetPoint], names: &TierNames, from: usize) -> Vec<Vec<MeetPoint>> {
    let mut others: Vec<Vec<MeetPoint>> = vec![];
    if corners.len() > 1 {
        others.extend(corners.iter().map(|corner| vec![corner.clone()]));
    }
    let on_own_side = |corner: &MeetPoint| {
        let (named, _) = corner.named()?;
        let moved = named.iter().map(|name| names.on_own_side(name, from).unwrap_or_else(|| name.clone()));
        Some(MeetPoint::Corner(moved.collect())).filter(|moved| moved != corner)
    };
    others.extend(corners.iter().filter_map(on_own_side).map(|corner| vec![corner]));
    others
}

/// Returns whether a text contains these words, and not only as a part of longer words.
fn has_words(text: &str, words: &str) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    text.match_indices(words).any(|(at, _)| {
        !is_letter(text[..at].chars().next_back()) && !is_letter(text[at + words.len()..].chars().next())
    })
}

/// The centre-point angles that are accepted, in degrees. Flatter facets would meet far outside any stone.
const CENTRE_ANGLES_DEG: std::ops::Range<f64> = 1.0..90.0;

/// Returns the angle of the centre-point angle method, in degrees.
fn centre_angle(text: &str) -> Option<f64> {
    let (before, after) = text.split_once("cam")?;
    if before.ends_with(char::is_alphanumeric) {
        return None;
    }
    let number = after.trim_start();
    let end = number.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(number.len());
    let angle: f64 = number[..end].trim_end_matches('.').parse().ok()?;
    CENTRE_ANGLES_DEG.contains(&angle).then_some(angle)
}

/// A piece of an instruction.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Piece<'a> {
    Word(&'a str),
    /// The end of a sentence, or a semicolon.
    Stop,
    Comma,
    Hyphen,
}

fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = vec![];
    let mut start = None;
    for (at, letter) in text.char_indices().chain([(text.len(), ' ')]) {
        if letter.is_alphanumeric() || matches!(letter, '\'' | '_') {
            start.get_or_insert(at);
            continue;
        }
        if let Some(start) = start.take() {
            pieces.push(Piece::Word(&text[start..at]));
        }
        match letter {
            ';' | '.' => pieces.push(Piece::Stop),
            ',' => pieces.push(Piece::Comma),
            '&' => pieces.push(Piece::Word("and")),
            '-' => pieces.push(Piece::Hyphen),
            _ => {}
        }
    }
    pieces
}

/// Returns whether a word may be the name of a tier: one or two letters, a number, or both.
fn is_name(word: &str) -> bool {
    let letters = word.chars().take_while(|c| c.is_alphabetic()).count();
    let digits = word.chars().skip(letters).take_while(char::is_ascii_digit).count();
    let is_whole = letters + digits == word.chars().count();
    is_whole && digits <= 2 && (letters <= 1 || (digits > 0 && letters <= 2))
}

/// The longest name of a tier that may stand in a list, in letters and digits.
const LONGEST_NAME: usize = 16;

/// Words that a list of names reads as something else than a name.
const IN_LISTS: [&str; 20] = [
    "and",
    "at",
    "the",
    "with",
    "to",
    "lower",
    "upper",
    "corner",
    "corners",
    "point",
    "points",
    "girdle",
    "gjrdle",
    "pcp",
    "tcp",
    "cp",
    "centerpoint",
    "center",
    "centrepoint",
    "culet",
];

/// Returns whether a text can be the name of a tier in a list of names joined by dashes: one word, without a meaning of its own
/// in instructions.
pub(super) fn is_listable(name: &str) -> bool {
    let name = name.to_lowercase();
    let is_word = pieces(&name) == [Piece::Word(&name)] && name.chars().count() <= LONGEST_NAME;
    let phrases = CENTRE.iter().chain(&TEMPORARY).chain(&GIRDLE_POINT).chain(&CHOSEN).chain(&MADE);
    let has_meaning = phrases.chain(&["level", "cam"]).any(|words| has_words(&name, words));
    is_word && !has_meaning && !IN_LISTS.contains(&&*name) && !BEFORE_NAMES.contains(&&*name)
}

/// Returns the corners whose names an instruction lists, and whether such a list ends at the centre point.
fn corners(text: &str, names: &TierNames, from: usize) -> (Vec<MeetPoint>, bool) {
    let pieces = pieces(text);
    let mut lists: Vec<(Vec<String>, usize)> = vec![];
    let mut ends_at_centre = false;
    let mut at = 0;
    while at < pieces.len() {
        let is_begun = matches!(pieces[at], Piece::Word(word) if BEFORE_NAMES.contains(&word));
        let is_bare = matches!(pieces[at..], [Piece::Word(a), Piece::Hyphen, Piece::Word(b), ..]
            if known(a, names, from) && known(b, names, from));
        if !is_begun && !is_bare {
            at += 1;
            continue;
        }
        let (mut found, next, is_centre) = lists_from(&pieces, at + usize::from(is_begun), names, from);
        if !matches!(pieces[at], Piece::Word("meet" | "meets" | "mp")) {
            // Other words may follow these words too, so lists whose names mean no tier are dropped.
            found.retain(|list| list.iter().all(|name| !names.meant(name, from).is_empty()));
        }
        ends_at_centre |= is_centre;
        lists.extend(found.into_iter().map(|list| (list, 1)));
        if let (
            [Piece::Word("reached"), Piece::Word("as"), Piece::Word("number"), Piece::Word(number), ..],
            Some(last),
        ) = (&pieces[next..], lists.last_mut())
        {
            last.1 = number.parse().unwrap_or(1);
        }
        at = next.max(at + 1);
    }
    let own = |name: &String| names.meant(name, from) == [from];
    lists.iter_mut().for_each(|(list, _)| list.retain(|name| !own(name)));
    lists.retain(|(list, _)| list.iter().any(|name| name != ANY_GIRDLE));
    let corner = |(names, reached)| match reached {
        0 | 1 => MeetPoint::Corner(names),
        _ => MeetPoint::LaterCorner { names, reached },
    };
    (lists.into_iter().map(corner).collect(), ends_at_centre)
}

fn known(word: &str, names: &TierNames, from: usize) -> bool {
    is_name(word) && !names.meant(word, from).is_empty()
}

/// Returns whether the word at a place is a name that stands beside a dash, though few cutters would use it as one.
fn is_joined_name(pieces: &[Piece<'_>], at: usize, names: &TierNames, from: usize) -> bool {
    let is_hyphen = |at: usize| pieces.get(at) == Some(&Piece::Hyphen);
    let is_joined = is_hyphen(at + 1) || at.checked_sub(1).is_some_and(is_hyphen);
    is_joined
        && matches!(pieces[at], Piece::Word(word) if is_listable(word) && !names.meant(word, from).is_empty())
}

/// Reads lists of names from a place on. Returns the lists, the place after them, and whether they end at the centre
/// point.
fn lists_from(
    pieces: &[Piece<'_>],
    mut at: usize,
    names: &TierNames,
    from: usize,
) -> (Vec<Vec<String>>, usize, bool) {
    let mut lists: Vec<Vec<String>> = vec![vec![]];
    let mut ends_at_centre = false;
    while let Some(piece) = pieces.get(at) {
        let last = lists.len() - 1;
        match *piece {
            Piece::Comma => {}
            Piece::Stop => {
                let follows =
                    matches!(pieces.get(at + 1), Some(Piece::Word(word)) if known(word, names, from));
                if !follows || lists[last].is_empty() {
                    break;
                }
                lists.push(vec![]);
            }
            Piece::Word("and") if !lists[last].is_empty() => lists.push(vec![]),
            Piece::Word("pcp" | "tcp" | "cp" | "centerpoint" | "center" | "centrepoint" | "culet") => {
                ends_at_centre |= !lists[0].is_empty() && pieces[at - 1] != Piece::Comma;
            }
            Piece::Word("girdle" | "gjrdle") => lists[last].push(ANY_GIRDLE.to_owned()),
            Piece::Word(word) if is_name(word) || is_joined_name(pieces, at, names, from) => {
                lists[last].push(word.to_owned());
            }
            Piece::Hyphen
            | Piece::Word(
                "and" | "at" | "the" | "with" | "to" | "lower" | "upper" | "corner" | "corners" | "point"
                | "points",
            ) => {}
            Piece::Word(_) => break,
        }
        at += 1;
    }
    // A single name gives no corner, so it is joined to the list beside it.
    let mut joined: Vec<Vec<String>> = vec![];
    for list in lists.into_iter().filter(|list| !list.is_empty()) {
        match joined.last_mut() {
            Some(before) if list.len() < 2 || before.len() < 2 => before.extend(list),
            _ => joined.push(list),
        }
    }
    (joined, at, ends_at_centre)
}
