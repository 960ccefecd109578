// What the eye's rays are on a card: the settings of a picture, and a ray with its change.
//
// Imports: Frame.

@group(0) @binding(0) var<uniform> frame: Frame;

// A ray. `fan` is the change of its direction, and `shift` that of its origin, over the range that the ray
// represents: a band of wavelengths and a stretch of its pixel.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    fan: vec3f,
    shift: vec3f,
}
