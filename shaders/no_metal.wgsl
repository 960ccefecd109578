// What light.wgsl asks where no metal stands beside the stones; metal.wgsl answers where there is some.

// What decides by chance where light goes on: nothing does.
struct Chances {
    none: u32,
}

fn chances_of_pixel(pixel: vec2u, wavelength: u32) -> Chances {
    return Chances(0u);
}

fn chances_beyond(own: Chances, exit: u32) -> Chances {
    return own;
}

fn is_reflected(own: Chances) -> bool {
    return false;
}

fn begin_sieve(own: Chances) {}

// Returns the weight with which light of this weight goes on to another body.
fn sieved(weight: f32) -> f32 {
    return weight;
}

fn with_metal(stone: First, ray: Ray, left: Left) -> First {
    return stone;
}

fn meets_metal(ray: Ray, before: f32) -> bool {
    return false;
}

fn reflect_by_metal(next: Waiting, wavelength: u32) {}
