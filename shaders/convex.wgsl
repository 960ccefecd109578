// Where light goes from convex stones.

// Turns of loops are few enough.
fn is_spent() -> bool {
    return false;
}

// What has left a convex stone never meets it again.
fn depart(ray: Ray, light: vec4f, s: vec3f, left: f32, path: f32, bounce: u32) {
    leave(ray, (light.x + light.y) * left, bounce == 0u);
}

// Follows a ray that enters the body at a facet, of light of this weight.
fn follow(ray: Ray, entered: Meeting, weight: f32) -> Rest {
    return passage(arriving(ray, entered, weight));
}
