// Exits from convex stones.

// Passes light that leaves the body on to `leave`, because it never meets a convex stone again.
fn depart(departing: Inbound) {
    leave(outward(departing.ray), (departing.light.x + departing.light.y) * departing.left, departing.bounce == 0u);
}

// Follows a ray of this weight into the body at the facet `entered`.
fn follow(ray: Ray, entered: Meeting, weight: f32) -> Rest {
    return passage(arriving(ray, entered, weight));
}
