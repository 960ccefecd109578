//! The structs that the program and its shaders share, each declared once for both.

use bytemuck::{Pod, Zeroable};

/// Declares a struct, and the text that declares it in WGSL. Rust and WGSL lay out its fields alike where vectors of two
/// numbers begin at an even number, those of three and four at a multiple of four, and the whole is a multiple of
/// four; a test checks it.
macro_rules! both_sides {
    ($(#[$meta:meta])* $name:ident, $wgsl:ident { $($(#[$doc:meta])* $field:ident: $kind:ident,)* }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
        #[repr(C)]
        pub struct $name { $($(#[$doc])* pub $field: both_sides!(@ $kind),)* }

        /// The declaration of the struct in WGSL.
        pub(super) const $wgsl: &str =
            concat!("struct ", stringify!($name), " {", $(stringify!($field), ": ", both_sides!(# $kind), ",",)* "}\n");

        impl $name {
            /// The name and the place, in bytes, of each field.
            #[cfg(test)]
            pub(super) const PLACES: &[(&str, usize)] =
                &[$((stringify!($field), std::mem::offset_of!(Self, $field)),)*];
        }
    };
    (@ f32) => { f32 };
    (@ u32) => { u32 };
    (@ vec2f) => { [f32; 2] };
    (@ vec2u) => { [u32; 2] };
    (@ vec3f) => { [f32; 3] };
    (@ vec4f) => { [f32; 4] };
    (@ vec4u) => { [u32; 4] };
    (@ two_vec4f) => { [f32; 8] };
    (# f32) => { "f32" };
    (# u32) => { "u32" };
    (# vec2f) => { "vec2f" };
    (# vec2u) => { "vec2u" };
    (# vec3f) => { "vec3f" };
    (# vec4f) => { "vec4f" };
    (# vec4u) => { "vec4u" };
    (# two_vec4f) => { "array<vec4f, 2>" };
}

both_sides! {
    /// The parameters of a dispatch, for scopes and for light.
    Frame, FRAME_WGSL {
        /// The most loop turns of a ray, where rays count them. The field comes first because Mesa's software driver (22.3)
        /// writes the first number of a uniform into the shader, and compiles the shader anew at each dispatch where
        /// that number allows more operations than before, as with a tilted axis.
        most_turns: u32,
        /// The number of the sample pass.
        pass_number: u32,
        /// The number of bodies of metal.
        metal_count: u32,
        /// The sixteenths of a turn that one plane counts for.
        plane_sixteenths: u32,
        /// The image's x axis.
        right: vec3f,
        /// The reach of the stones from the origin.
        reach: f32,
        /// The image's y axis.
        up: vec3f,
        /// The side of a pixel.
        pixel: f32,
        /// The axis to the eye.
        toward: vec3f,
        /// The eye's distance, 0 for parallel rays.
        eye_distance: f32,
        /// The least weight that is followed.
        least_weight: f32,
        /// Beside metal, the weight below which light goes on to another body by chance.
        by_chance: f32,
        /// The place of the ray in its pixel, or in its cell of the pixel's grid, 0 to 1 across and down.
        place: vec2f,
        /// The number of stones.
        stone_count: u32,
        /// The number of wavelengths.
        wavelength_count: u32,
        /// The most bounces.
        most_bounces: u32,
        /// 1 for polarised light, 0 otherwise.
        is_polarised: u32,
        /// The film's pixels across and down.
        size: vec2u,
        /// The first row of the strip that the buffer holds.
        first_row: u32,
        /// The number of the strip's rows.
        row_count: u32,
        /// In scopes, the number of the cell in the pixel's grid.
        cell: u32,
        /// The cells along each side of a pixel.
        grid: u32,
        /// The first wavelength of the dispatch.
        first_wavelength: u32,
        /// The wavelength after the last one.
        end_wavelength: u32,
        /// The first of the strip's tiles of 8 by 8 pixels in this dispatch.
        first_tile: u32,
        /// The number of the dispatch's tiles.
        tile_count: u32,
        /// The stride of the tiles' order through the strip.
        tile_stride: u32,
        /// The number of all tiles of the strip.
        all_tiles: u32,
        /// The stretch of a pixel that a ray represents, in image coordinates.
        stretch: vec2f,
        /// The share of refraction's change of direction that is followed, 1 for physics.
        strength: f32,
        /// Fills up the last row.
        unused: f32,
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
        /// The middle, in the world, of a ball around the stone.
        middle: vec3f,
        /// The ball's radius in the world.
        radius: f32,
        /// The place of the surface, in the form that its kind has: `PlaneRange` in shaders/leaving.wgsl for planes,
        /// `MeshRange` in shaders/bvh.wgsl for triangles. For a glass shape the first number is its index among the
        /// shapes.
        range: vec4u,
        /// The unit quaternion that rotates the body's frame into the world.
        turn: vec4f,
        /// The frame's origin in the world.
        place: vec3f,
        /// The length in the world of the frame's unit.
        unit: f32,
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
    /// The finish of a body of metal at one wavelength.
    Finish, FINISH_WGSL {
        /// The real and the imaginary part of the metal's index.
        index: vec2f,
        /// The share of repeatedly reflected light that the metal does not absorb.
        again: f32,
        /// The number of the table of its rough surface.
        surface: f32,
    }
}

both_sides! {
    /// The environment around the stones.
    Environment, ENVIRONMENT_WGSL {
        /// The light's x axis.
        right: vec3f,
        /// The side of the light's map, in texels.
        map_side: f32,
        /// The light's y axis.
        up: vec3f,
        /// The number of lamps.
        lamp_count: u32,
        /// The light's axis.
        zenith: vec3f,
        /// The number of the map's last level.
        last_level: f32,
        /// The backplate's distance behind the origin.
        backplate_distance: f32,
        /// The backplate's width, 0 for none.
        backplate_width: f32,
        /// The cosine of the half angle of the observer's head, above 1 for none.
        cos_head: f32,
        /// The least width of the edge of the head's shadow.
        head_edge: f32,
        /// x: 1 where rays that miss the stones see the environment.
        backdrop: vec4f,
    }
}

both_sides! {
    /// A small disc of even light.
    Lamp, LAMP_WGSL {
        /// The unit direction to the lamp's middle.
        toward: vec3f,
        /// The square of the chord from the middle to the edge.
        chord_squared: f32,
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
        /// Red, green and blue.
        colour: vec3f,
        /// The number of rays that see a body or the environment.
        cover: f32,
        /// The light that was not followed to its end.
        unresolved: f32,
        /// The light that was absorbed.
        absorbed: f32,
        /// Fills up the last row.
        unused: vec2f,
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
        /// The share of the light that was absorbed.
        absorbed: f32,
        /// The share of the light that was not followed to its end.
        unresolved: f32,
        /// The share of the pixel's rays that hit the stone.
        hit: f32,
        /// The share of the pixel's rays whose strongest exit is not certain.
        undecided: f32,
    }
}

both_sides! {
    /// A cluster: planes of similar normals and offsets.
    Cluster, CLUSTER_WGSL {
        /// The mean normal.
        normal: vec3f,
        /// The mean offset.
        offset: f32,
        /// The largest deviation of its normals from the mean.
        normal_spread: f32,
        /// The largest deviation of its offsets from the mean.
        offset_spread: f32,
        /// The first plane.
        first: u32,
        /// The number of planes.
        count: u32,
    }
}

both_sides! {
    /// A triangle with the normal of its facet. An entry of smooth normals holds them in place of the corners.
    Triangle, TRIANGLE_WGSL {
        /// The first corner.
        a: vec3f,
        /// The normal's x.
        normal_x: f32,
        /// The second corner.
        b: vec3f,
        /// The normal's y.
        normal_y: f32,
        /// The third corner.
        c: vec3f,
        /// The normal's z.
        normal_z: f32,
    }
}

both_sides! {
    /// A glass shape: [`brillianteer_math::ImplicitSurface`] in units of its reach.
    ImplicitSurface, IMPLICIT_SURFACE_WGSL {
        /// Half the length of the core.
        half: f32,
        /// The radius of the ball that is rolled around the core.
        edge: f32,
        /// The reach of the body without its wave.
        body_reach: f32,
        /// 1 where the outline is a triangle, 0 where it is a rectangle.
        is_triangle: u32,
        /// The half sides of a rectangle, or the corner of a triangle at +y.
        corner: vec2f,
        /// The radius of the disc rolled around a rectangle, or the z of a triangle's apex.
        round: f32,
        /// 1 where there is a wave, 0 otherwise.
        has_wave: u32,
        /// The outward unit normal of a triangle's flank at +y.
        flank_normal: vec2f,
        /// The flank's length.
        flank_length: f32,
        /// The wave's amplitude.
        amplitude: f32,
        /// The number of waves per unit of length.
        waves: f32,
        /// The wave's phase, in turns.
        phase: f32,
        /// Fills up the last row.
        unused: vec2f,
    }
}

both_sides! {
    /// A pane of liquid glass over a picture, in front of a background.
    PaneData, PANE_DATA_WGSL {
        /// The picture's pixels across and down.
        size: vec2u,
        /// The number of samples of the frost, 0 where there is no pane.
        sample_count: u32,
        /// 1 over the background, 0 alone.
        is_over: u32,
        /// The pane's middle, in pixels.
        middle: vec2f,
        /// The pane's shorter side, in pixels.
        unit: f32,
        /// The degree to which the ramps exclude each other.
        corner: f32,
        /// Half the sides, in units of the shorter one.
        half: vec2f,
        /// The places where the rim begins.
        level: vec2f,
        /// The share of the square in the ramps.
        round: vec2f,
        /// The refraction, 0 to 1.
        refraction: f32,
        /// The thickness.
        thickness: f32,
        /// The unit direction toward the light.
        toward: vec3f,
        /// The dispersion, 0 to 1.
        dispersion: f32,
        /// The unit direction half-way between those toward the light and toward the eye.
        between: vec3f,
        /// The frost, 0 to 1.
        frost: f32,
        /// xyz: the colour of the light.
        colour: vec4f,
    }
}

both_sides! {
    /// A box around triangles, as [`brillianteer_math::BvhNode`].
    BvhNode, BVH_NODE_WGSL {
        /// The least coordinates.
        low: vec3f,
        /// For a box of boxes, the distance in nodes to its second half; for a box of triangles, its first triangle.
        start: u32,
        /// The greatest coordinates.
        high: vec3f,
        /// The number of triangles directly in the box, 0 for a box of boxes.
        count: u32,
    }
}

/// Packs a vector as f32.
pub(super) fn three(v: glam::DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
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
