//! The key `meet` of a tier: words, or lists of names.

use brillianteer_base::Fault;
use brillianteer_cut::{GivenSize, Meet, MeetPoint};
use serde::{Deserialize, Serialize};

/// The words before the angle of the centre-point angle method.
const CENTRE_ANGLE: &str = "centre angle";

/// The most points of a meet.
const MOST_POINTS: usize = 3;

/// A meet as a cut file gives it.
#[derive(Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a meet is words such as \"level girdle\", a list of the names of tiers that meet, or a list of two or three of both"
)]
pub(super) enum MeetForm {
    Words(String),
    List(Vec<PointForm>),
}

/// A point, or a name in the list of a corner.
#[derive(Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "a point is words such as \"level girdle\", a list of the names of tiers that meet, or { corner = names, reached = number }"
)]
pub(super) enum PointForm {
    Words(String),
    Names(Vec<String>),
    Later(LaterForm),
}

/// A corner where several corners have the same names, by its number among them.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LaterForm {
    corner: Vec<String>,
    reached: usize,
}

impl MeetForm {
    pub fn of(meet: &Meet) -> Self {
        match meet {
            Meet::Given(size) => Self::Words(words_of(&GivenSize::IN_WORDS, size)),
            Meet::CentreAngle(angle) => Self::Words(format!("{CENTRE_ANGLE} {angle}")),
            Meet::Points(points) => match &points[..] {
                [MeetPoint::Corner(names)] => {
                    Self::List(names.iter().cloned().map(PointForm::Words).collect())
                }
                [point @ MeetPoint::LaterCorner { .. }] => Self::List(vec![PointForm::of(point)]),
                [point] => Self::Words(words_of(&MeetPoint::IN_WORDS, point)),
                points => Self::List(points.iter().map(PointForm::of).collect()),
            },
        }
    }

    /// Returns the meet of the tier at this place in the file, from 0.
    pub fn meet(self, place: usize) -> Result<Meet, Fault> {
        let meet = match self {
            Self::Words(words) => Self::in_words(&words),
            Self::List(points) => Self::in_points(points),
        };
        meet.map_err(|problem| Fault::key(format!("tier/{place}/meet"), format!("meet: {problem}")))
    }

    fn in_words(words: &str) -> Result<Meet, String> {
        if let Some(size) = of_words(&GivenSize::IN_WORDS, words) {
            return Ok(Meet::Given(size));
        }
        if let Some(angle) = words.strip_prefix(CENTRE_ANGLE) {
            let angle = angle.trim().parse::<f64>().ok().filter(|angle| *angle > 0.0 && *angle < 90.0);
            let problem =
                format!("'{words}' has no angle above 0 and below 90 degrees, as in \"{CENTRE_ANGLE} 41.7\"");
            return angle.map(Meet::CentreAngle).ok_or(problem);
        }
        point_of(words).map(|point| Meet::Points(vec![point]))
    }

    fn in_points(points: Vec<PointForm>) -> Result<Meet, String> {
        let is_name = |form: &PointForm| matches!(form, PointForm::Words(words) if of_words(&MeetPoint::IN_WORDS, words).is_none());
        if !points.is_empty() && points.iter().all(is_name) {
            let names = points.into_iter().filter_map(|form| match form {
                PointForm::Words(name) => Some(name),
                PointForm::Names(_) | PointForm::Later(_) => None,
            });
            return Ok(Meet::Points(vec![corner(names.collect())?]));
        }
        if !(1..=MOST_POINTS).contains(&points.len()) {
            return Err(format!("{} points are given; from 1 to {MOST_POINTS} are expected", points.len()));
        }
        points.into_iter().map(PointForm::point).collect::<Result<_, _>>().map(Meet::Points)
    }
}

impl PointForm {
    fn of(point: &MeetPoint) -> Self {
        match point {
            MeetPoint::Corner(names) => Self::Names(names.clone()),
            MeetPoint::LaterCorner { names, reached } => {
                Self::Later(LaterForm { corner: names.clone(), reached: *reached })
            }
            point => Self::Words(words_of(&MeetPoint::IN_WORDS, point)),
        }
    }

    fn point(self) -> Result<MeetPoint, String> {
        match self {
            Self::Words(words) => point_of(&words),
            Self::Names(names) => corner(names),
            Self::Later(LaterForm { reached: 0, .. }) => {
                Err("reached is 0; the corner that a facet reaches first is 1".to_owned())
            }
            Self::Later(LaterForm { corner: names, reached: 1 }) => corner(names),
            Self::Later(LaterForm { corner: names, reached }) => {
                corner(names.clone()).map(|_| MeetPoint::LaterCorner { names, reached })
            }
        }
    }
}

fn corner(names: Vec<String>) -> Result<MeetPoint, String> {
    if names.iter().any(|name| name.trim().is_empty()) || names.is_empty() {
        Err("a corner has no names; list those of the tiers that meet there".to_owned())
    } else {
        Ok(MeetPoint::Corner(names))
    }
}

fn point_of(words: &str) -> Result<MeetPoint, String> {
    of_words(&MeetPoint::IN_WORDS, words).ok_or_else(|| {
        let all = MeetPoint::IN_WORDS.iter().map(|(words, _)| *words);
        let all: Vec<&str> = all.chain(GivenSize::IN_WORDS.iter().map(|(words, _)| *words)).collect();
        format!(
            "'{words}' is no meet; give {}, {CENTRE_ANGLE} 41.7, or a list of names of tiers",
            all.join(", ")
        )
    })
}

fn of_words<T: Clone>(table: &[(&str, T)], words: &str) -> Option<T> {
    table.iter().find(|(known, _)| *known == words).map(|(_, meaning)| meaning.clone())
}

fn words_of<T: PartialEq>(table: &[(&str, T)], meaning: &T) -> String {
    table.iter().find(|(_, known)| known == meaning).map(|(words, _)| (*words).to_owned()).unwrap_or_default()
}
