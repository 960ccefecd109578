//! Reads points in the words that the program itself writes for them.

use super::meet::MeetPoint;
use super::names::TierNames;

/// The most points of a meet.
pub(super) const MOST_POINTS: usize = 3;

/// Returns the points that a text in small letters states if it says nothing else, in the words in which
/// [`Meet`](super::Meet) writes them. `from` is the tier whose facets pass through them.
pub(super) fn points(text: &str, names: &TierNames, from: usize) -> Option<Vec<MeetPoint>> {
    let points: Vec<MeetPoint> =
        text.split("; ").map(|words| point(words.trim(), names, from)).collect::<Option<_>>()?;
    (points.len() <= MOST_POINTS).then_some(points)
}

fn point(words: &str, names: &TierNames, from: usize) -> Option<MeetPoint> {
    let fixed = MeetPoint::IN_WORDS.into_iter().map(|(_, point)| point);
    fixed
        .into_iter()
        .find(|point| point.to_string().to_lowercase() == words)
        .or_else(|| corner(words, names, from))
}

fn corner(words: &str, names: &TierNames, from: usize) -> Option<MeetPoint> {
    let list = words.strip_prefix("meet ")?;
    let (list, reached) = match list.split_once(" (reached as number ") {
        Some((list, number)) => (list, number.strip_suffix(')')?.parse().ok()?),
        None => (list, 1),
    };
    let named: Vec<String> = list.split('-').map(str::to_owned).collect();
    let are_known = named.len() > 1 && named.iter().all(|name| !names.meant(name, from).is_empty());
    are_known.then_some(match reached {
        0 | 1 => MeetPoint::Corner(named),
        _ => MeetPoint::LaterCorner { names: named, reached },
    })
}
