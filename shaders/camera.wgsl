// The rays of a picture from the eye: the twin of crates/trace/src/ray/camera.rs.
//
// Imports: ray, trace.

// Returns the ray through the point `p` of the image plane, from a point outside all stones, with its change when `p`
// moves by `by`.
fn camera_ray(p: vec2f, by: vec2f) -> Ray {
    let at = frame.right * p.x + frame.up * p.y;
    let moved = frame.right * by.x + frame.up * by.y;
    var direction = -frame.toward;
    var from_eye = FAR;
    var fan = vec3f(0.0);
    if frame.eye_distance > 0.0 {
        let ray = at - frame.toward * frame.eye_distance;
        from_eye = length(ray);
        direction = ray / from_eye;
        fan = (moved - direction * dot(direction, moved)) / from_eye;
    }
    let before = min(from_eye, 2.0 * frame.reach + length(at));
    return Ray(at - direction * before, direction, fan, moved - fan * before);
}

// Returns the ray of a pixel as `camera_ray` does; `step` is the ray's place in the pixel, 0 to 1 across and down.
fn pixel_ray(pixel: vec2u, step: vec2f) -> Ray {
    let centred = vec2f(pixel) + step - 0.5 * vec2f(frame.size);
    return camera_ray(vec2f(centred.x, -centred.y) * frame.pixel, frame.stretch);
}
