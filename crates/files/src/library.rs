//! The cuts and scenes that come with the program, as the texts of their files.

/// The cuts that come with the program: the name of each, and the text of its file in `cuts/`.
pub const CUTS: [(&str, &str); 35] = [
    ("tolkowsky", include_str!("../../../cuts/tolkowsky.toml")),
    ("modern-ideal", include_str!("../../../cuts/modern-ideal.toml")),
    ("steep-deep", include_str!("../../../cuts/steep-deep.toml")),
    ("shallow", include_str!("../../../cuts/shallow.toml")),
    ("fisheye", include_str!("../../../cuts/fisheye.toml")),
    ("sixty-sixty", include_str!("../../../cuts/sixty-sixty.toml")),
    ("old-european", include_str!("../../../cuts/old-european.toml")),
    ("transitional", include_str!("../../../cuts/transitional.toml")),
    ("single-cut", include_str!("../../../cuts/single-cut.toml")),
    ("portuguese", include_str!("../../../cuts/portuguese.toml")),
    ("rose", include_str!("../../../cuts/rose.toml")),
    ("briolette", include_str!("../../../cuts/briolette.toml")),
    ("oval", include_str!("../../../cuts/oval.toml")),
    ("block", include_str!("../../../cuts/block.toml")),
    ("princess", include_str!("../../../cuts/princess.toml")),
    ("radiant", include_str!("../../../cuts/radiant.toml")),
    ("emerald", include_str!("../../../cuts/emerald.toml")),
    ("asscher", include_str!("../../../cuts/asscher.toml")),
    ("baguette", include_str!("../../../cuts/baguette.toml")),
    ("tapered-baguette", include_str!("../../../cuts/tapered-baguette.toml")),
    ("kite", include_str!("../../../cuts/kite.toml")),
    ("hexagon", include_str!("../../../cuts/hexagon.toml")),
    ("barion", include_str!("../../../cuts/barion.toml")),
    ("cushion-barion", include_str!("../../../cuts/cushion-barion.toml")),
    ("oval-barion", include_str!("../../../cuts/oval-barion.toml")),
    ("marquise", include_str!("../../../cuts/marquise.toml")),
    ("pear", include_str!("../../../cuts/pear.toml")),
    ("heart", include_str!("../../../cuts/heart.toml")),
    ("cushion", include_str!("../../../cuts/cushion.toml")),
    ("modified-cushion", include_str!("../../../cuts/modified-cushion.toml")),
    ("trillion", include_str!("../../../cuts/trillion.toml")),
    ("pill", include_str!("../../../cuts/pill.toml")),
    ("prism", include_str!("../../../cuts/prism.toml")),
    ("cube", include_str!("../../../cuts/cube.toml")),
    ("plate", include_str!("../../../cuts/plate.toml")),
];

/// The name of the cut with which the program begins.
pub const FIRST_CUT: &str = "tolkowsky";

/// Returns the text of a cut file that comes with the program, by its name; capitals do not matter.
pub fn cut(name: &str) -> Option<&'static str> {
    CUTS.iter().find(|(n, _)| n.eq_ignore_ascii_case(name)).map(|(_, text)| *text)
}

/// The scenes that come with the program: the name of each, and the text of its file in `scenes/`.
pub const SCENES: [(&str, &str); 12] = [
    ("trilogy", include_str!("../../../scenes/trilogy.toml")),
    ("ring", include_str!("../../../scenes/ring.toml")),
    ("parcel", include_str!("../../../scenes/parcel.toml")),
    ("subtle-pill", include_str!("../../../scenes/subtle-pill.toml")),
    ("prism-rainbow", include_str!("../../../scenes/prism-rainbow.toml")),
    ("rotating-cube", include_str!("../../../scenes/rotating-cube.toml")),
    ("wavy-plate", include_str!("../../../scenes/wavy-plate.toml")),
    ("free-diamond", include_str!("../../../scenes/free-diamond.toml")),
    ("solitaire", include_str!("../../../scenes/solitaire.toml")),
    ("four-prong", include_str!("../../../scenes/four-prong.toml")),
    ("halo-ring", include_str!("../../../scenes/halo-ring.toml")),
    ("eternity", include_str!("../../../scenes/eternity.toml")),
];

/// Returns the text of a scene file that comes with the program, by its name; capitals do not matter.
pub fn scene(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(n, _)| n.eq_ignore_ascii_case(name)).map(|(_, text)| *text)
}

/// Returns whether a cut or a scene of this name comes with the program.
pub fn contains(name: &str) -> bool {
    cut(name).is_some() || scene(name).is_some()
}
