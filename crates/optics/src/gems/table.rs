//! The table of gems with their hosts and bands. All numbers are from memory; the parent module says which of them
//! are known and which are chosen.

use super::gem::{AbsorptionBand, AbsorptionEdge, Gem, Host};

const DIAMOND: Host = Host::Known("diamond", "Isotropic");
const SPINEL: Host = Host::Known("spinel", "Isotropic; magnesium aluminate");
const CORUNDUM: Host =
    Host::Known("sapphire", "Uniaxial corundum; ordinary ray only, without double refraction");
const QUARTZ: Host = Host::Known("quartz", "Uniaxial quartz; ordinary ray only, without double refraction");
const PYROPE: Host = Host::Trade("Isotropic garnet", 1.714, 1.742, 0.022, 3.68);
const ALMANDINE: Host = Host::Trade("Isotropic garnet", 1.77, 1.82, 0.025, 4.05);
const RHODOLITE: Host = Host::Trade("Isotropic garnet, of pyrope and almandine", 1.74, 1.77, 0.023, 3.84);
const SPESSARTINE: Host = Host::Trade("Isotropic garnet", 1.79, 1.82, 0.027, 4.15);
const GROSSULAR: Host = Host::Trade("Isotropic garnet", 1.734, 1.759, 0.028, 3.61);
const DEMANTOID: Host = Host::Trade("Isotropic garnet", 1.88, 1.89, 0.057, 3.84);
const BERYL: Host = Host::Trade("Uniaxial beryl, without double refraction", 1.565, 1.602, 0.014, 2.72);
const TOURMALINE: Host =
    Host::Trade("Uniaxial tourmaline, without double refraction", 1.614, 1.666, 0.017, 3.06);
const PERIDOT: Host = Host::Trade("Biaxial olivine, without double refraction", 1.65, 1.70, 0.020, 3.34);
const TOPAZ: Host = Host::Trade("Biaxial topaz, without double refraction", 1.609, 1.643, 0.014, 3.53);

const ZIRCON: Host = Host::Trade("Uniaxial zircon, without double refraction", 1.925, 1.984, 0.039, 4.70);

pub(super) const GEMS: [Gem; 21] = [
    Gem {
        name: "pyrope",
        text: "blood red, by chromium and iron",
        host: PYROPE,
        edge: edge(0.5, 60.0),
        bands: &[
            band(412.0, 4400.0, 0.45),
            band(568.0, 2700.0, 0.36),
            band(505.0, 900.0, 0.16),
            band(526.0, 600.0, 0.1),
        ],
    },
    Gem {
        name: "almandine",
        text: "dark purplish red, by iron",
        host: ALMANDINE,
        edge: edge(0.5, 62.0),
        bands: &[
            band(460.0, 600.0, 0.12),
            band(505.0, 1200.0, 0.52),
            band(526.0, 800.0, 0.45),
            band(573.0, 1100.0, 0.55),
            band(615.0, 900.0, 0.09),
            band(695.0, 1500.0, 0.07),
        ],
    },
    Gem {
        name: "rhodolite",
        text: "raspberry red, by iron",
        host: RHODOLITE,
        edge: edge(0.2, 50.0),
        bands: &[
            band(460.0, 500.0, 0.1),
            band(505.0, 900.0, 0.28),
            band(526.0, 600.0, 0.21),
            band(573.0, 950.0, 0.32),
            band(615.0, 700.0, 0.05),
            band(695.0, 1200.0, 0.04),
        ],
    },
    Gem {
        name: "spessartine",
        text: "orange, by manganese",
        host: SPESSARTINE,
        edge: edge(0.9, 50.0),
        bands: &[
            band(410.0, 700.0, 0.9),
            band(430.0, 900.0, 0.55),
            band(460.0, 900.0, 0.22),
            band(480.0, 900.0, 0.16),
            band(505.0, 1200.0, 0.12),
            band(526.0, 900.0, 0.08),
            band(573.0, 1200.0, 0.06),
        ],
    },
    Gem {
        name: "grossular",
        text: "colourless where pure",
        host: GROSSULAR,
        edge: edge(0.0, 1.0),
        bands: &[],
    },
    Gem {
        name: "tsavorite",
        text: "vivid green, by vanadium and chromium",
        host: GROSSULAR,
        edge: edge(0.15, 35.0),
        bands: &[band(430.0, 3900.0, 0.44), band(605.0, 3100.0, 0.3)],
    },
    Gem {
        name: "hessonite",
        text: "cinnamon orange, by iron and manganese",
        host: GROSSULAR,
        edge: edge(1.0, 62.0),
        bands: &[band(430.0, 2500.0, 0.25), band(530.0, 4000.0, 0.035)],
    },
    Gem {
        name: "demantoid",
        text: "yellowish green, by iron and chromium",
        host: DEMANTOID,
        edge: edge(0.5, 40.0),
        bands: &[
            band(443.0, 900.0, 0.35),
            band(430.0, 3000.0, 0.15),
            band(615.0, 3000.0, 0.1),
            band(850.0, 2500.0, 0.05),
        ],
    },
    Gem {
        name: "ruby",
        text: "slightly purplish red, by chromium; it does not glow",
        host: CORUNDUM,
        edge: edge(0.2, 60.0),
        bands: &[
            split(410.0, 4600.0, [0.8, 0.85]),
            split(556.0, 2600.0, [0.8, 0.0]),
            split(546.0, 2600.0, [0.0, 0.44]),
        ],
    },
    Gem {
        name: "blue sapphire",
        text: "blue, by iron and titanium",
        host: CORUNDUM,
        edge: edge(0.06, 30.0),
        bands: &[
            split(575.0, 5600.0, [0.42, 0.22]),
            split(705.0, 5400.0, [0.14, 0.32]),
            split(450.0, 450.0, [0.03, 0.02]),
            split(388.0, 1200.0, [0.1, 0.08]),
        ],
    },
    Gem {
        name: "red spinel",
        text: "red, by chromium; it does not glow",
        host: SPINEL,
        edge: edge(0.25, 47.0),
        bands: &[band(390.0, 5900.0, 0.37), band(540.0, 3100.0, 0.38)],
    },
    Gem {
        name: "yellow diamond",
        text: "yellow, by nitrogen",
        host: DIAMOND,
        edge: edge(0.5, 35.0),
        bands: &[band(415.0, 900.0, 0.1), band(478.0, 900.0, 0.05)],
    },
    Gem {
        name: "amethyst",
        text: "purple, by irradiated iron",
        host: QUARTZ,
        edge: edge(0.01, 25.0),
        bands: &[split(545.0, 4200.0, [0.17, 0.14]), band(357.0, 5000.0, 0.16)],
    },
    Gem {
        name: "citrine",
        text: "golden yellow, by iron",
        host: QUARTZ,
        edge: AbsorptionEdge { at_400: [0.5, 0.45], fold_nm: 54.0 },
        bands: &[band(420.0, 5200.0, 0.05)],
    },
    Gem {
        name: "emerald",
        text: "bluish green, by chromium",
        host: BERYL,
        edge: edge(0.08, 30.0),
        bands: &[
            split(430.0, 3700.0, [0.56, 0.0]),
            split(420.0, 3900.0, [0.0, 0.5]),
            split(600.0, 3300.0, [0.36, 0.0]),
            split(635.0, 3300.0, [0.0, 0.34]),
        ],
    },
    Gem {
        name: "aquamarine",
        text: "pale blue, by iron",
        host: BERYL,
        edge: AbsorptionEdge { at_400: [0.012, 0.006], fold_nm: 25.0 },
        bands: &[
            split(825.0, 4700.0, [0.13, 0.04]),
            split(690.0, 5400.0, [0.0, 0.17]),
            split(427.0, 600.0, [0.006, 0.003]),
        ],
    },
    Gem {
        name: "green tourmaline",
        text: "bluish dark green, by iron",
        host: TOURMALINE,
        edge: AbsorptionEdge { at_400: [0.5, 0.2], fold_nm: 45.0 },
        bands: &[split(720.0, 5400.0, [1.4, 0.46]), split(430.0, 3600.0, [0.4, 0.18])],
    },
    Gem {
        name: "pink tourmaline",
        text: "pink, by manganese",
        host: TOURMALINE,
        edge: AbsorptionEdge { at_400: [0.1, 0.06], fold_nm: 35.0 },
        bands: &[split(392.0, 3600.0, [0.18, 0.08]), split(522.0, 4100.0, [0.25, 0.1])],
    },
    Gem {
        name: "zircon",
        text: "colourless, as it is after heating",
        host: ZIRCON,
        edge: edge(0.0, 1.0),
        bands: &[],
    },
    Gem {
        name: "peridot",
        text: "yellowish green, by iron",
        host: PERIDOT,
        edge: edge(0.5, 42.0),
        bands: &[
            band(1040.0, 6500.0, 0.62),
            band(453.0, 500.0, 0.05),
            band(473.0, 500.0, 0.035),
            band(493.0, 450.0, 0.045),
            band(640.0, 900.0, 0.014),
        ],
    },
    Gem {
        name: "blue topaz",
        text: "sky blue, by irradiation",
        host: TOPAZ,
        edge: edge(0.01, 25.0),
        bands: &[band(625.0, 4200.0, 0.08)],
    },
];

/// Makes an edge that is the same for both polarisations.
const fn edge(at_400: f64, fold_nm: f64) -> AbsorptionEdge {
    AbsorptionEdge { at_400: [at_400; 2], fold_nm }
}

/// Makes a band that is the same for both polarisations.
const fn band(nm: f64, width: f64, height: f64) -> AbsorptionBand {
    split(nm, width, [height; 2])
}

/// Makes a band with a height for each polarisation.
const fn split(nm: f64, width: f64, height: [f64; 2]) -> AbsorptionBand {
    AbsorptionBand { nm, width, height }
}
