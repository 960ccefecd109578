//! Layers to be painted: polygons of light, each in one channel.

use super::strips::strips;
use brillianteer_math::Affine;
use brillianteer_scene::{Glare, Scope};
use brillianteer_trace::beam::{Beam, Beams};
use glam::{DMat2, DVec2};

/// Where absorption changes a beam's light by more than this part across its outline, the beam is painted in strips.
const UNEVEN: f64 = 1.0 / 256.0;

/// A polygon of even light.
#[derive(Debug, Clone, Copy)]
pub(super) struct LightPatch {
    pub corners: (u32, u32),
    pub channel: u16,
    pub weight: f64,
}

/// The polygons of one domain of a picture's symmetry, with the maps that copy them to the whole picture.
#[derive(Debug, Clone)]
pub struct Layer {
    pub(super) corners: Vec<DVec2>,
    pub(super) patches: Vec<LightPatch>,
    pub(super) copies: Vec<DMat2>,
    /// The name of each channel.
    pub channels: Vec<String>,
    /// How much is not certain: the part of the light that is unresolved, or in the map of strongest exits the part of
    /// the area that is undecided.
    pub open: f64,
}

/// The last channel of a picture: how much of a pixel the stone covers.
const COVER: &str = "cover";

impl Layer {
    /// Builds the picture that a camera in the scope records: for each band a channel with the energy that comes from it
    /// through each pixel, with or without glare, and the stone's cover.
    pub fn energy(beams: &Beams, scope: &Scope, glare: Glare) -> Self {
        let mut layer = Self::new(beams, scope.bands.iter().map(|b| b.name.clone()).collect());
        for beam in beams.iter().filter(|b| b.weight > 0.0 && glare.shows(b.is_surface())) {
            layer.add_faded(
                beams,
                &beam,
                beam.path,
                beam.weight / beam.transmittance,
                scope.band(beam.exit, beams.zenith),
            );
        }
        layer
    }

    /// Builds the map of strongest exits: for each band a channel that is 1 where the strongest exit lies in it, and the
    /// stone's cover. Where no light has left the stone yet, no band is marked.
    pub fn strongest(beams: &Beams, scope: &Scope) -> Self {
        let mut layer = Self::new(beams, scope.bands.iter().map(|b| b.name.clone()).collect());
        let cells = beams.strongest_exits();
        layer.open = beams.undecided(&cells);
        for cell in cells {
            if let Some(exit) = cell.strongest {
                let band = scope.band(beams.get(exit).exit, beams.zenith);
                layer.add(beams.get(cell.outline).outline, band, 1.0);
            }
        }
        layer
    }

    /// Builds all channels that are known: transmitted light and glare of each band, absorbed and unresolved light, and
    /// the stone's cover, of which the others are the parts.
    pub fn full(beams: &Beams, scope: &Scope) -> Self {
        let named = |group: &'static str| scope.bands.iter().map(move |b| format!("{group}.{}", b.name));
        let mut channels: Vec<String> = named("transmitted").chain(named("surface")).collect();
        channels.extend(["absorbed".into(), "unresolved".into()]);
        let mut layer = Self::new(beams, channels);
        let bands = scope.bands.len();
        for beam in beams.iter() {
            let mut add = |path, weight, channel| layer.add_faded(beams, &beam, path, weight, channel);
            if beam.weight > 0.0 {
                let band = scope.band(beam.exit, beams.zenith);
                add(
                    beam.path,
                    beam.weight / beam.transmittance,
                    if beam.is_surface() { bands + band } else { band },
                );
            }
            if let Some(parent) = beam.parent.map(|p| beams.get(p)).filter(|p| p.transmittance > 0.0) {
                let arriving = parent.onward / parent.transmittance;
                add(parent.path, arriving, 2 * bands);
                add(beam.path, -arriving, 2 * bands);
            }
            if beam.open {
                add(beam.path, beam.onward / beam.transmittance, 2 * bands + 1);
            }
        }
        layer
    }

    /// Builds a picture of values that are even over polygons of the whole image, a channel for each of these names, and the
    /// polygons' cover. `open` is the part of the light that is unresolved.
    pub fn of_values<'a, const N: usize>(
        names: [&str; N],
        polygons: impl Iterator<Item = (&'a [DVec2], [f64; N])>,
        open: f64,
    ) -> Self {
        let channels = names.into_iter().chain([COVER]).map(str::to_owned).collect();
        let mut layer =
            Self { corners: vec![], patches: vec![], copies: vec![DMat2::IDENTITY], channels, open };
        for (outline, values) in polygons {
            let corners = layer.outlined(outline);
            for (channel, weight) in values.into_iter().chain([1.0]).enumerate() {
                layer.patches.push(LightPatch { corners, channel: channel as u16, weight });
            }
        }
        layer
    }

    fn new(beams: &Beams, mut channels: Vec<String>) -> Self {
        channels.push(COVER.into());
        let cover = channels.len() - 1;
        let copies = beams.symmetry.copies();
        let open = beams.unresolved();
        let mut layer = Self { corners: vec![], patches: vec![], copies, channels, open };
        for beam in beams.iter().filter(Beam::is_surface) {
            layer.add(beam.outline, cover, 1.0);
        }
        layer
    }

    fn add(&mut self, outline: &[DVec2], channel: usize, weight: f64) {
        let corners = self.outlined(outline);
        self.patches.push(LightPatch { corners, channel: channel as u16, weight });
    }

    /// Keeps an outline, and returns its first corner and their number.
    fn outlined(&mut self, outline: &[DVec2]) -> (u32, u32) {
        let corners = (self.corners.len() as u32, outline.len() as u32);
        self.corners.extend(outline);
        corners
    }

    /// Adds light of this weight over a beam's outline, faded by absorption along `path`.
    fn add_faded(&mut self, beams: &Beams, beam: &Beam, path: Affine, weight: f64, channel: usize) {
        strips(beam.outline, path, &beams.medium, UNEVEN, |part, left| {
            self.add(part, channel, weight * left)
        });
    }
}
