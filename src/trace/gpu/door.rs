//! What crosses the door between program and shader, declared once for both.

use bytemuck::{Pod, Zeroable};

/// Declares a struct whose fields are all four numbers wide, so that Rust and WGSL lay it out alike, and its WGSL text.
macro_rules! both_sides {
    ($(#[$meta:meta])* $name:ident, $wgsl:ident { $($(#[$doc:meta])* $field:ident: $kind:ident,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
        #[repr(C)]
        pub struct $name { $($(#[$doc])* pub $field: both_sides!(@ $kind),)* }

        /// The same in WGSL.
        pub(super) const $wgsl: &str =
            concat!("struct ", stringify!($name), " {", $(stringify!($field), ": ", both_sides!(# $kind), ",",)* "}\n");
    };
    (@ vec4f) => { [f32; 4] };
    (@ vec4u) => { [u32; 4] };
    (@ two_vec4f) => { [f32; 8] };
    (# vec4f) => { "vec4f" };
    (# vec4u) => { "vec4u" };
    (# two_vec4f) => { "array<vec4f, 2>" };
}

both_sides! {
    /// All that a dispatch is told.
    Frame, FRAME_WGSL {
        /// The image's x axis; how far the stone reaches from the origin.
        right: vec4f,
        /// The image's y axis; the medium's absorption per girdle radius.
        up: vec4f,
        /// The axis to the eye; its distance, 0 for parallel rays.
        toward: vec4f,
        /// The scope's axis; the medium's index.
        zenith: vec4f,
        /// Sines of the elevations at which the bands after the first begin; 2 where there is none.
        borders_low: vec4f,
        /// The next four.
        borders_high: vec4f,
        /// Least weight; half the film's side; where in its cell of a pixel's grid a ray stands, x and y.
        limits: vec4f,
        /// Planes; bunches; most bounces; 1 for polarised.
        counts: vec4u,
        /// Pixels along a side; first row; rows; rays along each side of a pixel.
        film: vec4u,
        /// Which of a pixel's rays; nothing in the others.
        turn: vec4u,
    }
}

both_sides! {
    /// What is seen through one pixel: means over its rays. Zones are by band, in the scope's order.
    Seen, SEEN_WGSL {
        /// Light from inside the stone.
        transmitted: two_vec4f,
        /// Glare of the outer surface.
        surface: two_vec4f,
        /// Share of rays whose strongest exit lies in the band.
        strongest: two_vec4f,
        /// Absorbed; unresolved; share of rays that hit; share of rays with no certain strongest exit.
        rest: vec4f,
    }
}

both_sides! {
    /// Planes that look much the same way.
    Bunch, BUNCH_WGSL {
        /// Mean normal and offset.
        middle: vec4f,
        /// How far its normals and its offsets lie from these; first plane; number of planes.
        spread: vec4f,
    }
}

impl Seen {
    /// Share absorbed.
    pub fn absorbed(&self) -> f32 {
        self.rest[0]
    }

    /// Share not followed to its end.
    pub fn unresolved(&self) -> f32 {
        self.rest[1]
    }

    /// Share of the pixel's rays that hit the stone.
    pub fn hit(&self) -> f32 {
        self.rest[2]
    }

    /// Share of its rays whose strongest exit is not certain.
    pub fn undecided(&self) -> f32 {
        self.rest[3]
    }
}
