// Exits from convex stones.
//
// Imports: trace, pose.

// Passes light that leaves the body on to `leave`, because it never meets a convex stone again.
fn depart(departing: Inbound) {
    let weight = weight_of(departing.light) * departing.left;
    leave(outward(departing.ray), weight, outward_polarisation(departing), departing.bounce == 0u);
}

// Follows light of this weight into the body at the facet `entered`.
fn follow(ray: Ray, entered: Meeting, weight: f32, polarisation: Polarisation) -> Rest {
    return passage(arriving(ray, entered, weight, polarisation));
}
