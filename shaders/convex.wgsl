// Where light goes from convex stones.

// What has left a convex stone never meets it again.
fn depart(departing: Inbound) {
    leave(outward(departing.ray), (departing.light.x + departing.light.y) * departing.left, departing.bounce == 0u);
}

// Follows a ray that enters the body at a facet, of light of this weight.
fn follow(ray: Ray, entered: Meeting, weight: f32) -> Rest {
    return passage(arriving(ray, entered, weight));
}
