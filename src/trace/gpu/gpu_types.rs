//! What crosses the door between program and shader, declared once for both.

use bytemuck::{Pod, Zeroable};

/// Declares a struct whose fields are all one number or all four wide, so that Rust and WGSL lay it out alike, and its WGSL
/// text.
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
    (@ f32) => { f32 };
    (@ vec4f) => { [f32; 4] };
    (@ vec4u) => { [u32; 4] };
    (@ two_vec4f) => { [f32; 8] };
    (# f32) => { "f32" };
    (# vec4f) => { "vec4f" };
    (# vec4u) => { "vec4u" };
    (# two_vec4f) => { "array<vec4f, 2>" };
}

both_sides! {
    /// All that a dispatch is told, whatever it looks for.
    Frame, FRAME_WGSL {
        /// The image's x axis; how far the stones reach from the origin.
        right: vec4f,
        /// The image's y axis; the side of a pixel.
        up: vec4f,
        /// The axis to the eye; its distance, 0 for parallel rays.
        toward: vec4f,
        /// Least weight; how far, in parts of the band, from the wavelength taken to its middle; where in its pixel, or its cell of the pixel's grid, a ray stands, x and y.
        limits: vec4f,
        /// Stones; wavelengths; most bounces; 1 for polarised.
        counts: vec4u,
        /// Pixels across; pixels down; first row and number of rows of this dispatch.
        film: vec4u,
        /// How many dispatches the pixels have seen; in scopes the rays along each side of a pixel, under light the first
        /// row that the stage holds; first wavelength and the one after the last.
        turn: vec4u,
        /// Turns of loops that a ray may take where it counts them; nothing in the others.
        most: vec4u,
        /// How much of the way that refraction turns light is followed, 1 for physics; nothing in the others.
        strength: vec4f,
    }
}

both_sides! {
    /// A scope.
    Bands, BANDS_WGSL {
        /// Its axis.
        zenith: vec4f,
        /// Sines of the elevations at which the bands after the first begin; 2 where there is none.
        borders_low: vec4f,
        /// The next four.
        borders_high: vec4f,
    }
}

both_sides! {
    /// One stone.
    Body, BODY_WGSL {
        /// Middle and radius of a ball around it.
        middle: vec4f,
        /// Its first plane, the one after its last, and the same of its clusters; or of its triangles and boxes; or its place
        /// among the shapes.
        range: vec4u,
    }
}

both_sides! {
    /// What a stone is made of at one wavelength, as in [`crate::scene::Medium`].
    Medium, MEDIUM_WGSL {
        /// Refractive index.
        index: f32,
        /// Its change over the wavelengths that are taken for one.
        spread: f32,
        /// Absorption of the ordinary polarisation.
        absorption_o: f32,
        /// Of the extraordinary.
        absorption_e: f32,
    }
}

both_sides! {
    /// What stands around the stones.
    Environment, ENVIRONMENT_WGSL {
        /// Its x axis; side of its map.
        right: vec4f,
        /// Its y axis; number of lamps.
        up: vec4f,
        /// Its axis; number of the map's last level.
        zenith: vec4f,
        /// The photograph's distance behind the origin and its width, 0 for none; cosine of the head's half angle, and
        /// least width of its shadow's edge.
        photo: vec4f,
        /// 1 where rays beside the stones see what stands around.
        backdrop: vec4f,
    }
}

both_sides! {
    /// A small disc of even light.
    Lamp, LAMP_WGSL {
        /// Direction to its middle; square of the chord from there to its edge.
        toward: vec4f,
        /// Radiance by channel.
        radiance: vec4f,
    }
}

both_sides! {
    /// The colour of each channel's light in a band of wavelengths.
    Response, RESPONSE_WGSL {
        /// Of the key illuminant.
        key: vec4f,
        /// Of red.
        red: vec4f,
        /// Of green.
        green: vec4f,
        /// Of blue.
        blue: vec4f,
    }
}

both_sides! {
    /// What light shows of one pixel: sums over rays and wavelengths.
    RadiancePixel, RADIANCE_PIXEL_WGSL {
        /// Red, green, blue, cover.
        colour: vec4f,
        /// Unresolved; absorbed; nothing in the others.
        rest: vec4f,
    }
}

both_sides! {
    /// What is seen through one pixel: means over its rays. Zones are by band, in the scope's order.
    ScopePixel, SCOPE_PIXEL_WGSL {
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
    Cluster, CLUSTER_WGSL {
        /// Mean normal and offset.
        middle: vec4f,
        /// How far its normals and its offsets lie from these; first plane; number of planes.
        spread: vec4f,
    }
}

both_sides! {
    /// A triangle, and the normal of its facet in the corners' fourth places.
    Triangle, TRIANGLE_WGSL {
        /// One corner; the normal's x.
        a: vec4f,
        /// The next; y.
        b: vec4f,
        /// The last; z.
        c: vec4f,
    }
}

both_sides! {
    /// A glass shape: [`crate::math::ImplicitSurface`] in its own frame, in which it reaches 1 from the origin.
    ImplicitSurface, IMPLICIT_SURFACE_WGSL {
        /// The frame's x axis in the world; half the length of the core.
        right: vec4f,
        /// Its y axis; radius of the ball that is rolled around the core.
        back: vec4f,
        /// Its z axis; how far the body without its wave reaches.
        up: vec4f,
        /// Its origin; the length of its unit in the world.
        shift: vec4f,
        /// Half sides of the outline, radius of the disc around it, 0; or a triangle's corner at +y, its apex, 1.
        outline: vec4f,
        /// Normal and length of a triangle's flank at +y; 1 where there is a wave.
        flank: vec4f,
        /// The wave's amplitude; its waves per unit; its phase in turns; nothing.
        wave: vec4f,
    }
}

both_sides! {
    /// A box around triangles, as [`crate::math::BvhNode`].
    BvhNode, BVH_NODE_WGSL {
        /// Least coordinates; how many nodes after it the second half stands, or its first triangle.
        low: vec4f,
        /// Greatest coordinates; how many triangles stand right in it.
        high: vec4f,
    }
}

impl ScopePixel {
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

/// A vector and a fourth number, narrowed.
pub(super) fn with(v: glam::DVec3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

impl From<&crate::scene::Medium> for Medium {
    fn from(medium: &crate::scene::Medium) -> Self {
        let [absorption_o, absorption_e] = medium.absorption.map(|a| a as f32);
        Self { index: medium.index as f32, spread: medium.spread as f32, absorption_o, absorption_e }
    }
}
