//! The rows of the table of gems, as plain numbers and words.

/// A gem: its host, and the bands and the edge that colour it.
pub(super) struct Gem {
    pub name: &'static str,
    /// The look of the gem and the cause of its colour, in words.
    pub text: &'static str,
    pub host: Host,
    pub edge: AbsorptionEdge,
    pub bands: &'static [AbsorptionBand],
}

/// The host of a gem: the material that holds the colour and gives the index.
pub(super) enum Host {
    /// A colourless material with this name; the gem is described as this kind.
    Known(&'static str, &'static str),
    /// A mineral of this kind, with the least and the greatest value of its index, its B-G dispersion and its density
    /// in g/cm³.
    Trade(&'static str, f64, f64, f64, f64),
}

/// An absorption edge: absorption grows toward the ultraviolet by a factor of e every `fold_nm`.
///
/// At 400 nm the coefficient is `at_400` per mm, for the ordinary and the extraordinary polarisation. The edge is a
/// simple approximation of the wide bands of charge transfer.
pub(super) struct AbsorptionEdge {
    pub at_400: [f64; 2],
    pub fold_nm: f64,
}

/// An absorption band, Gaussian over wavenumbers: its centre in nm, its full width at half maximum in 1/cm, and its height
/// per mm for the ordinary and the extraordinary polarisation.
pub(super) struct AbsorptionBand {
    pub nm: f64,
    pub width: f64,
    pub height: [f64; 2],
}
