// The functions that light.wgsl calls, where no metal stands beside the stones; metal.wgsl has them for scenes with
// metal.
//
// Imports: ray, light.

// The state of the random numbers, which is empty, because nothing is decided by chance.
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

// Returns the weight with which light of this weight goes on to another body: all of it.
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
