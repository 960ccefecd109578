// The pose of the present body. Rays are carried into the frame in which the body was built, and light that leaves is
// carried back. This is the twin of crates/math/src/pose.rs and of crates/trace/src/ray/instance_tracer.rs.
//
// Imports: Body, trace.

// Rotates a vector by a unit quaternion.
fn rotated(turn: vec4f, v: vec3f) -> vec3f {
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}

// Rotates a vector of the world into the body's frame.
fn own_vector(v: vec3f) -> vec3f {
    return rotated(vec4f(-body.turn.xyz, body.turn.w), v);
}

// Rotates a vector of the body's frame into the world.
fn world_vector(v: vec3f) -> vec3f {
    return rotated(body.turn, v);
}

// Returns the length in the world of the unit of the body's frame.
fn unit() -> f32 {
    return body.unit;
}

// Returns the place in the world of a point of the body.
fn place(point: vec3f) -> vec3f {
    return world_vector(point) * unit() + body.place;
}

// Returns the point of the body at a place in the world.
fn unplace(place: vec3f) -> vec3f {
    return own_vector(place - body.place) / unit();
}

// Returns the facet by which a ray of the world enters the body, and the distance to it in the world; the distance is
// negative where the ray misses.
fn meet(origin: vec3f, direction: vec3f) -> Meeting {
    let met = entry(unplace(origin), own_vector(direction));
    return Meeting(met.facet, met.distance * unit());
}

// Returns light of this weight that meets the body at `met`, in the body's frame. Its ray starts on the surface, so that
// a long way to the body costs no digits.
fn arriving(ray: Ray, met: Meeting, weight: f32, polarisation: Polarisation) -> Inbound {
    let direction = own_vector(ray.direction);
    let distance = met.distance / unit();
    let point = polished(unplace(ray.origin) + direction * distance);
    let fan = own_vector(ray.fan);
    let shift = own_vector(ray.shift) / unit() + fan * distance;
    let own = Polarisation(polarisation.light, own_vector(polarisation.s));
    return inbound_of(Ray(point, direction, fan, shift), Meeting(met.facet, 0.0), weight, own);
}

// Carries a ray that leaves the body into the world.
fn outward(ray: Ray) -> Ray {
    return Ray(place(ray.origin), world_vector(ray.direction), world_vector(ray.fan), world_vector(ray.shift) * unit());
}

// Returns the polarisation of light that leaves the body, in the world.
fn outward_polarisation(departing: Inbound) -> Polarisation {
    return Polarisation(departing.light, world_vector(departing.s));
}
