// Numbers whose bits look random: the twin of crates/math/src/random_bits.rs. A number of 64 bits is stored as its
// low and its high half.

const GAMMA = vec2u(0x7f4a7c15u, 0x9e3779b9u);

fn sum64(a: vec2u, b: vec2u) -> vec2u {
    let low = a.x + b.x;
    return vec2u(low, a.y + b.y + select(0u, 1u, low < a.x));
}

// Returns the whole product of two numbers of 32 bits, computed from products of their halves.
fn wide_product(a: u32, b: u32) -> vec2u {
    let low = vec2u(a, b) & vec2u(0xffffu);
    let high = vec2u(a, b) >> vec2u(16u);
    let least = low.x * low.y;
    let left = high.x * low.y;
    let right = low.x * high.y;
    let middle = (least >> 16u) + (left & 0xffffu) + (right & 0xffffu);
    let upper = high.x * high.y + (left >> 16u) + (right >> 16u) + (middle >> 16u);
    return vec2u((least & 0xffffu) | (middle << 16u), upper);
}

// Returns the last 64 bits of a product.
fn product64(a: vec2u, b: vec2u) -> vec2u {
    let low = wide_product(a.x, b.x);
    return vec2u(low.x, low.y + a.x * b.y + a.y * b.x);
}

// Shifts a number down by 1 to 31 bits.
fn shifted64(a: vec2u, by: u32) -> vec2u {
    return vec2u((a.x >> by) | (a.y << (32u - by)), a.y >> by);
}

// Returns a number whose bits look random. It is the twin of `mixed` in crates/math/src/random_bits.rs.
fn mixed_bits(number: vec2u) -> vec2u {
    var z = sum64(number, GAMMA);
    z = product64(z ^ shifted64(z, 30u), vec2u(0x1ce4e5b9u, 0xbf58476du));
    z = product64(z ^ shifted64(z, 27u), vec2u(0x133111ebu, 0x94d049bbu));
    return z ^ shifted64(z, 31u);
}

// Returns a number from 0 to below 1 made of random bits. It is the twin of `unit`, with the digits that f32 has.
fn unit_of_bits(bits: vec2u) -> f32 {
    return f32(bits.y >> 8u) / 16777216.0;
}
