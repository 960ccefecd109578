//! The structs that the program and its shaders share, each declared once for both.

use bytemuck::{Pod, Zeroable};

/// Declares a struct, and the text that declares it in WGSL. Its fields are either all one number wide or all four
/// numbers wide, so that Rust and WGSL lay them out alike.
macro_rules! both_sides {
    ($(#[$meta:meta])* $name:ident, $wgsl:ident { $($(#[$doc:meta])* $field:ident: $kind:ident,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
        #[repr(C)]
        pub struct $name { $($(#[$doc])* pub $field: both_sides!(@ $kind),)* }

        /// The declaration of the struct in WGSL.
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
    /// The parameters of a dispatch, for scopes and for light.
    Frame, FRAME_WGSL {
        /// x: the most loop turns of a ray, where rays count them; y: the number of the sample pass; z: the number of
        /// bodies of metal; w: the sixteenths of a turn that one plane counts for. The field comes first because
        /// Mesa's software driver (22.3) writes the first number of a uniform into the shader, and compiles the
        /// shader anew at each dispatch where that number allows more operations than before, as with a tilted axis.
        most: vec4u,
        /// xyz: the image's x axis; w: the reach of the stones from the origin.
        right: vec4f,
        /// xyz: the image's y axis; w: the side of a pixel.
        up: vec4f,
        /// xyz: the axis to the eye; w: the eye's distance, 0 for parallel rays.
        toward: vec4f,
        /// x: the least weight that is followed; y: beside metal, the weight below which light goes on to another
        /// body by chance; zw: the place of the ray in its pixel, or in its cell of the pixel's grid.
        limits: vec4f,
        /// x: the number of stones; y: the number of wavelengths; z: the most bounces; w: 1 for polarised light.
        counts: vec4u,
        /// x: pixels across; y: pixels down; z: the first row of the strip that the buffer holds; w: the number of
        /// its rows.
        film: vec4u,
        /// x: in scopes, the number of the cell in the pixel's grid; y: the cells along each side of a pixel; z: the
        /// first wavelength; w: the one after the last.
        turn: vec4u,
        /// The strip's tiles of 8 by 8 pixels. x: the first tile of this dispatch; y: the number of its tiles; z: the
        /// stride of their order through the strip; w: the number of all tiles.
        tiles: vec4u,
        /// x: the share of refraction's change of direction that is followed, 1 for physics; yz: the stretch of a
        /// pixel that a ray represents, in image coordinates; w is unused.
        sample: vec4f,
    }
}

both_sides! {
    /// The bands of a scope.
    Bands, BANDS_WGSL {
        /// xyz: the scope's axis.
        zenith: vec4f,
        /// The sines of the elevations at which the four bands after the first begin; 2 where there is none.
        borders_low: vec4f,
        /// The same for the next four bands.
        borders_high: vec4f,
    }
}

both_sides! {
    /// One stone, or body of metal: the ball around it, the place of its surface in the buffers, and its pose.
    Body, BODY_WGSL {
        /// xyz: the middle, in the world, of a ball around the stone; w: the ball's radius there.
        middle: vec4f,
        /// For planes: the first plane, the one after the last, the first cluster, the one after the last. For
        /// triangles: the first box, and the bits of the triangles' reach from the frame's origin; for metal also the
        /// number of triangles between a triangle and its smooth normals, and the number of the finish. For a glass
        /// shape: x is its index among the shapes.
        range: vec4u,
        /// The unit quaternion that rotates the body's frame into the world.
        turn: vec4f,
        /// xyz: the frame's origin in the world; w: the length of its unit there.
        place: vec4f,
    }
}

both_sides! {
    /// The medium of a stone at one wavelength, as in [`brillianteer_scene::Medium`].
    Medium, MEDIUM_WGSL {
        /// The refractive index.
        index: f32,
        /// The change of the index over the wavelengths that this one represents.
        spread: f32,
        /// The absorption coefficient of the ordinary polarisation, per unit of the body's frame.
        absorption_o: f32,
        /// The absorption coefficient of the extraordinary polarisation.
        absorption_e: f32,
    }
}

both_sides! {
    /// The environment around the stones.
    Environment, ENVIRONMENT_WGSL {
        /// xyz: the light's x axis; w: the side of its map, in texels.
        right: vec4f,
        /// xyz: the light's y axis; w: the number of lamps.
        up: vec4f,
        /// xyz: the light's axis; w: the number of the map's last level.
        zenith: vec4f,
        /// x: the backplate's distance behind the origin; y: its width, 0 for none; z: the cosine of the half angle
        /// of the observer's head, above 1 for none; w: the least width of the edge of the head's shadow.
        photo: vec4f,
        /// x: 1 where rays that miss the stones see the environment.
        backdrop: vec4f,
    }
}

both_sides! {
    /// A small disc of even light.
    Lamp, LAMP_WGSL {
        /// xyz: the unit direction to the lamp's middle; w: the square of the chord from there to its edge.
        toward: vec4f,
        /// The radiance by channel.
        radiance: vec4f,
    }
}

both_sides! {
    /// The colour of each channel's light in one band of wavelengths.
    Response, RESPONSE_WGSL {
        /// xyz: linear sRGB of the key illuminant's light.
        key: vec4f,
        /// xyz: linear sRGB of red light.
        red: vec4f,
        /// xyz: linear sRGB of green light.
        green: vec4f,
        /// xyz: linear sRGB of blue light.
        blue: vec4f,
    }
}

both_sides! {
    /// The light of one pixel: sums over rays and wavelengths.
    RadiancePixel, RADIANCE_PIXEL_WGSL {
        /// xyz: red, green, blue; w: cover.
        colour: vec4f,
        /// x: unresolved; y: absorbed; the others are unused.
        rest: vec4f,
    }
}

both_sides! {
    /// The light of one pixel in a scope: means over its rays. Arrays are by band, in the scope's order.
    ScopePixel, SCOPE_PIXEL_WGSL {
        /// The light from inside the stone.
        transmitted: two_vec4f,
        /// The glare of the outer surface.
        surface: two_vec4f,
        /// The share of rays whose strongest exit lies in the band.
        strongest: two_vec4f,
        /// x: absorbed; y: unresolved; z: the share of rays that hit the stone; w: the share of rays without a
        /// certain strongest exit.
        rest: vec4f,
    }
}

both_sides! {
    /// A cluster: planes of similar normals and offsets.
    Cluster, CLUSTER_WGSL {
        /// xyz: the mean normal; w: the mean offset.
        middle: vec4f,
        /// x, y: the largest deviation of its normals and of its offsets from these; z: the first plane; w: the
        /// number of planes.
        spread: vec4f,
    }
}

both_sides! {
    /// A triangle. The fourth numbers of its corners are the normal of its facet. An entry of smooth normals holds
    /// them in place of the corners.
    Triangle, TRIANGLE_WGSL {
        /// xyz: first corner; w: the normal's x.
        a: vec4f,
        /// xyz: second corner; w: the normal's y.
        b: vec4f,
        /// xyz: third corner; w: the normal's z.
        c: vec4f,
    }
}

both_sides! {
    /// A glass shape: [`brillianteer_math::ImplicitSurface`] in units of its reach.
    ImplicitSurface, IMPLICIT_SURFACE_WGSL {
        /// x: half the length of the core; y: the radius of the ball that is rolled around it; z: the reach of the
        /// body without its wave; w is unused.
        size: vec4f,
        /// For a rectangle: its half sides, the radius of the disc rolled around it, and 0. For a triangle: its
        /// corner at +y, the z of its apex, and 1.
        outline: vec4f,
        /// xy: the outward unit normal of a triangle's flank at +y; z: the flank's length; w: 1 where there is a
        /// wave.
        flank: vec4f,
        /// x: the wave's amplitude; y: the number of waves per unit of length; z: the phase in turns; w is unused.
        wave: vec4f,
    }
}

both_sides! {
    /// A pane of liquid glass over a picture, in front of a background.
    PaneData, PANE_DATA_WGSL {
        /// x, y: pixels across and down; z: samples of the frost, 0 where there is no pane; w: 1 over the background, 0 alone.
        size: vec4u,
        /// xy: the pane's middle in pixels; z: its shorter side in pixels; w is unused.
        place: vec4f,
        /// xy: half the sides in units of the shorter one; zw: the places where the rim begins.
        half_level: vec4f,
        /// xy: the share of the square in the ramps; z: the degree to which the ramps exclude each other; w is
        /// unused.
        round_corner: vec4f,
        /// x: refraction, 0 to 1; y: thickness; z: dispersion, 0 to 1; w: frost, 0 to 1.
        strengths: vec4f,
        /// xyz: unit direction toward the light.
        toward: vec4f,
        /// xyz: the unit direction half-way between those toward the light and toward the eye.
        between: vec4f,
        /// xyz: the colour of the light.
        colour: vec4f,
    }
}

both_sides! {
    /// A box around triangles, as [`brillianteer_math::BvhNode`].
    BvhNode, BVH_NODE_WGSL {
        /// xyz: the least coordinates; w: for a box of boxes, the distance in nodes to its second half; for a box of
        /// triangles, its first triangle.
        low: vec4f,
        /// xyz: the greatest coordinates; w: the number of triangles directly in the box, 0 for a box of boxes.
        high: vec4f,
    }
}

impl ScopePixel {
    /// Returns the share of the light that was absorbed.
    pub fn absorbed(&self) -> f32 {
        self.rest[0]
    }

    /// Returns the share of the light that was not followed to its end.
    pub fn unresolved(&self) -> f32 {
        self.rest[1]
    }

    /// Returns the share of the pixel's rays that hit the stone.
    pub fn hit(&self) -> f32 {
        self.rest[2]
    }

    /// Returns the share of the pixel's rays whose strongest exit is not certain.
    pub fn undecided(&self) -> f32 {
        self.rest[3]
    }
}

/// Packs a vector and a fourth number as f32.
pub(super) fn with(v: glam::DVec3, w: f64) -> [f32; 4] {
    [v.x as f32, v.y as f32, v.z as f32, w as f32]
}

impl Medium {
    /// Packs a medium for a shader whose unit of length is `unit` units of the body's frame.
    pub(super) fn new(medium: &brillianteer_scene::Medium, unit: f64) -> Self {
        let [absorption_o, absorption_e] = medium.absorption.map(|a| (a * unit) as f32);
        Self { index: medium.index as f32, spread: medium.spread as f32, absorption_o, absorption_e }
    }
}
