// Exits from solids that need not be convex: light that leaves may enter again. This is the twin of
// crates/trace/src/ray/tree.rs.
//
// Imports: trace, pose.

// Light that has left the body, will meet it again and waits to be followed.
var<private> inbound: array<Inbound, MOST_INBOUND>;
var<private> inbound_count: u32;
// The weight of the light that is not followed further, which counts as unresolved.
var<private> given_up: f32;

// Handles light that leaves the body. The light leaves for good by `leave`, or waits to enter the body again. Light
// that is too weak to wait, or finds no room, is given up.
fn depart(departing: Inbound) {
    let weight = weight_of(departing.light) * departing.left;
    let met = again(departing.ray.origin, departing.ray.direction);
    let ray = outward(departing.ray);
    if is_spent() {
        given_up += weight;
    } else if met.distance < 0.0 || is_taken(ray, met.distance * unit()) {
        leave(ray, weight, outward_polarisation(departing), departing.bounce == 0u);
    } else if weight > frame.least_weight && inbound_count < MOST_INBOUND {
        inbound[inbound_count] = departing;
        inbound[inbound_count].met = met;
        inbound_count += 1u;
    } else {
        given_up += weight;
    }
}

// Follows light of this weight into the body at the facet `entered`, and then all of it that enters the body again, the
// strongest first.
fn follow(ray: Ray, entered: Meeting, weight: f32, polarisation: Polarisation) -> Rest {
    inbound_count = 0u;
    given_up = 0.0;
    var rest = passage(arriving(ray, entered, weight, polarisation));
    while inbound_count > 0u {
        var strongest = 0u;
        var most = -1.0;
        for (var k = 0u; k < inbound_count; k++) {
            turns += 1u;
            let own = weight_of(inbound[k].light) * inbound[k].left;
            if own > most {
                most = own;
                strongest = k;
            }
        }
        let next = inbound[strongest];
        inbound_count -= 1u;
        inbound[strongest] = inbound[inbound_count];
        let passed = passage(next);
        rest = Rest(rest.absorbed + passed.absorbed, rest.unresolved + passed.unresolved, max(rest.bounces, passed.bounces));
    }
    rest.unresolved += given_up;
    return rest;
}
