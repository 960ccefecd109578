//! Chooses the layer of an OpenEXR file that holds its picture. A layer is a part of the file, or the channels whose names
//! share what stands before the last point, as in `ViewLayer.Combined.R`.

use brillianteer_base::Fault;
use exr::error::{Error, Result as ExrResult};
use exr::meta::attribute::Text;
use exr::meta::header::Header;
use exr::prelude::ReadChannels;

/// Names that programs give to the layer with the whole picture, in lower case.
const WHOLE: [&str; 8] = ["combined", "beauty", "rgba", "rgb", "composite", "image", "final", "color"];

/// The channels of a picture.
pub(super) enum Colours {
    /// Red, green and blue; or luminance with the chroma of red and blue.
    Three {
        /// The names of the channels.
        names: [Text; 3],
        /// True where the channels are Y, RY and BY.
        are_chroma: bool,
    },
    /// Luminance alone.
    Luminance(Text),
}

/// Channels of one part of a file alone, as several parts may have channels of the same names.
pub(super) struct OfPart<C> {
    pub header: Header,
    pub channels: C,
}

impl<'s, C: ReadChannels<'s>> ReadChannels<'s> for OfPart<C> {
    type Reader = C::Reader;

    fn create_channels_reader(&'s self, header: &Header) -> ExrResult<Self::Reader> {
        if is_same_part(header, &self.header) {
            self.channels.create_channels_reader(header)
        } else {
            Err(Error::Invalid("this is another part".into()))
        }
    }
}

/// Returns whether two headers are of the same part. Other attributes may be numbers that do not equal themselves.
fn is_same_part(a: &Header, b: &Header) -> bool {
    let place = |header: &Header| (header.layer_size, header.own_attributes.layer_position);
    let name = |header: &Header| header.own_attributes.layer_name.clone();
    a.channels == b.channels && place(a) == place(b) && name(a) == name(b)
}

/// The layer with the picture of a file.
pub(super) struct ColourLayer<'h> {
    /// The header of its part.
    pub header: &'h Header,
    pub colours: Colours,
    /// A warning where other layers hold colours as well.
    pub warnings: Vec<String>,
}

/// A layer that may hold the picture.
struct Candidate<'h> {
    header: &'h Header,
    /// The part of the names before the last point, with the name of the part of the file; empty where there is neither.
    name: String,
    colours: Colours,
    /// How well it suits as the picture of the file; the least suits best.
    rank: usize,
}

impl<'h> ColourLayer<'h> {
    /// Chooses a layer: red, green and blue before luminance, names that stand for the whole picture before others, and the
    /// first of equals.
    ///
    /// # Errors
    /// Fails where no layer holds colours or luminance.
    pub fn of(headers: &'h [Header]) -> Result<Self, Fault> {
        let mut candidates: Vec<Candidate> =
            headers.iter().filter(|header| !header.deep).flat_map(candidates).collect();
        let Some(best) = (0..candidates.len()).min_by_key(|&k| candidates[k].rank) else {
            let problem = if headers.iter().all(|header| header.deep) {
                "it holds deep data, several samples a pixel; save it flat, as RGB"
            } else {
                "no layer has channels R, G and B, or the luminance Y; save it as RGB"
            };
            return Err(problem.into());
        };
        let Candidate { header, name, colours, rank } = candidates.swap_remove(best);
        let others: Vec<&str> = candidates.iter().map(|other| other.name.as_str()).collect();
        // A layer without a name is the picture, whatever other layers there are.
        let is_doubtful = rank > 0 && !others.is_empty();
        let warning = is_doubtful.then(|| {
            format!("of its layers with colours '{name}' is read; the others are '{}'", others.join("', '"))
        });
        Ok(Self { header, colours, warnings: warning.into_iter().collect() })
    }
}

/// Returns the layers of a part that may hold the picture.
fn candidates(header: &Header) -> Vec<Candidate<'_>> {
    let mut groups: Vec<(&str, Vec<(&str, &Text)>)> = vec![];
    let names: Vec<(String, &Text)> =
        header.channels.list.iter().map(|channel| (channel.name.to_string(), &channel.name)).collect();
    for (full, text) in &names {
        let (group, base) = full.rsplit_once('.').unwrap_or(("", full.as_str()));
        match groups.iter_mut().find(|(name, _)| *name == group) {
            Some((_, channels)) => channels.push((base, *text)),
            None => groups.push((group, vec![(base, *text)])),
        }
    }
    let part = header.own_attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default();
    let candidate = |(group, channels): (&str, Vec<(&str, &Text)>)| {
        let colours = colours(&channels)?;
        let kind = usize::from(matches!(colours, Colours::Luminance(_)));
        let last = group.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        let is_whole = |name: &str| WHOLE.contains(&name);
        let strangeness = match (last.as_str(), part.to_ascii_lowercase().as_str()) {
            ("", "") => 0,
            ("", part) if is_whole(part) => 1,
            (last, _) if is_whole(last) => 1,
            _ => 2,
        };
        let name =
            [part.as_str(), group].into_iter().filter(|name| !name.is_empty()).collect::<Vec<_>>().join(".");
        Some(Candidate { header, name, colours, rank: 3 * kind + strangeness })
    };
    groups.into_iter().filter_map(candidate).collect()
}

/// Returns the channels of a group that hold colours: R, G and B, also as words or in lower case; Y with RY and BY; or Y
/// alone, unless it is a coordinate beside X or Z.
fn colours(channels: &[(&str, &Text)]) -> Option<Colours> {
    let named = |name: &str| {
        let found = channels.iter().find(|(base, _)| base.eq_ignore_ascii_case(name));
        found.map(|(_, text)| (*text).clone())
    };
    let three = |names: [&str; 3], are_chroma| {
        let [a, b, c] = names.map(named);
        Some(Colours::Three { names: [a?, b?, c?], are_chroma })
    };
    let luminance = || (named("X").is_none() && named("Z").is_none()).then(|| named("Y")).flatten();
    three(["R", "G", "B"], false)
        .or_else(|| three(["red", "green", "blue"], false))
        .or_else(|| three(["Y", "RY", "BY"], true))
        .or_else(|| luminance().map(Colours::Luminance))
}
