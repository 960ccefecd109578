// The rays of a picture from the eye: the twin of src/trace/ray/camera.rs.

// Returns a point outside all stones on the ray through the point `p` of the image plane, and the ray's unit direction.
fn camera_ray(p: vec2f) -> array<vec3f, 2> {
    let at = frame.right.xyz * p.x + frame.up.xyz * p.y;
    var direction = -frame.toward.xyz;
    var from_eye = FAR;
    if frame.toward.w > 0.0 {
        let ray = at - frame.toward.xyz * frame.toward.w;
        from_eye = length(ray);
        direction = ray / from_eye;
    }
    return array<vec3f, 2>(at - direction * min(from_eye, 2.0 * frame.right.w + length(at)), direction);
}

// Returns the ray of a pixel as `camera_ray` does; `step` is the ray's place in the pixel, 0 to 1 across and down.
fn pixel_ray(pixel: vec2u, step: vec2f) -> array<vec3f, 2> {
    let centred = vec2f(pixel) + step - 0.5 * vec2f(frame.film.xy);
    return camera_ray(vec2f(centred.x, -centred.y) * frame.up.w);
}
