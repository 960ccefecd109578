//! Stones from trade tables, and coloured gems. Each has an index, and an absorption spectrum made of bands and an
//! edge.
//!
//! The wavelengths of each gem's bands are known. Their strengths differ from stone to stone; they are chosen so that
//! a stone of 6.5 mm, in which light travels about 14 mm, has the colour for which the gem is valued.

mod gem;
mod table;
#[cfg(test)]
mod tests;

use super::absorption::Absorption;
use super::dispersion::{Dispersion, VISIBLE_NM};
use super::material::Material;
use gem::{AbsorptionBand, Gem, Host};

/// The step between the samples of a spectrum, in nm: about half the width of the narrowest band.
const STEP_NM: usize = 5;
/// 4 ln 2: the function exp(-4 ln 2 x²) is a half where x, in full widths, is ±1/2.
const PER_WIDTH_SQUARED: f64 = 4.0 * std::f64::consts::LN_2;
const TRADE: &str = "trade tables, from memory, not yet checked";
const COLOUR: &str = "illustrative: band positions from the literature, from memory, not yet checked; strengths chosen \
                      for a stone of 6.5 mm";

/// Returns all stones of the table. A stone with a known host takes the index of that host from `colourless`.
pub(super) fn gems(colourless: &[Material]) -> Vec<Material> {
    table::GEMS.iter().map(|gem| gem.material(colourless)).collect()
}

impl Gem {
    fn material(&self, colourless: &[Material]) -> Material {
        let clear = self.host.material(colourless);
        let description = format!("{}; {}.", clear.description, self.text);
        let source = match self.bands {
            [] => clear.source,
            _ => format!("index: {}; colour: {COLOUR}", clear.source),
        };
        let colour_is_illustrative = !self.bands.is_empty();
        let (name, absorption) = (self.name.to_owned(), self.absorption());
        Material { name, description, absorption, source, colour_is_illustrative, ..clear }
    }

    fn absorption(&self) -> [Absorption; 2] {
        if self.bands.is_empty() {
            return Default::default();
        }
        let wavelengths = (*VISIBLE_NM.start() as u32..=*VISIBLE_NM.end() as u32).step_by(STEP_NM);
        let sample = |axis: usize| move |nm| (f64::from(nm), rounded(self.per_mm(f64::from(nm), axis)));
        [0, 1].map(|axis| {
            let samples = wavelengths.clone().map(sample(axis)).collect();
            Absorption::new(samples).unwrap_or_else(|error| panic!("{}: {error}", self.name))
        })
    }

    /// Returns the absorption coefficient at a wavelength, per mm, for the ordinary polarisation (0) or the
    /// extraordinary one (1).
    fn per_mm(&self, nm: f64, axis: usize) -> f64 {
        let edge = self.edge.at_400[axis] * ((400.0 - nm) / self.edge.fold_nm).exp();
        edge + self.bands.iter().map(|band| band.per_mm(nm, axis)).sum::<f64>()
    }
}

impl Host {
    /// Returns the colourless material of the host; the words on the gem are not yet in its description.
    fn material(&self, colourless: &[Material]) -> Material {
        match *self {
            Self::Known(name, kind) => {
                let host = colourless.iter().find(|m| m.name == name);
                let host = host.unwrap_or_else(|| panic!("no host '{name}'")).clone();
                Material { description: kind.to_owned(), ..host }
            }
            Self::Trade(kind, least, most, b_minus_g, density) => {
                let text = format!("{kind}; n {least} to {most}, the middle taken");
                let law = Dispersion::cauchy_from(0.5 * (least + most), b_minus_g);
                Material::clear(kind, &text, law, TRADE, None).weighing(density)
            }
        }
    }
}

impl AbsorptionBand {
    fn per_mm(&self, nm: f64, axis: usize) -> f64 {
        let widths = (1e7 / nm - 1e7 / self.nm) / self.width;
        self.height[axis] * (-PER_WIDTH_SQUARED * widths * widths).exp()
    }
}

/// Rounds to four decimals, more than are known, so that a spectrum written to a file is easy to read.
fn rounded(per_mm: f64) -> f64 {
    (1e4 * per_mm).round() / 1e4
}
