// Measures the computing speed of a card: 32 independent chains of fused multiply-adds of f32 in each invocation, 128
// operations a turn, and little else.

// x: the factor; y: the summand; z: the number of turns.
@group(0) @binding(0) var<uniform> given: vec4f;
@group(0) @binding(1) var<storage, read_write> found: array<vec4f>;

@compute @workgroup_size(64)
fn arithmetic(@builtin(global_invocation_id) id: vec3u) {
    let factor = vec4f(given.x);
    let more = vec4f(given.y);
    var a = vec4f(f32(id.x));
    var b = a + 1.0;
    var c = a + 2.0;
    var d = a + 3.0;
    var e = a + 4.0;
    var f = a + 5.0;
    var g = a + 6.0;
    var h = a + 7.0;
    for (var k = 0u; k < u32(given.z); k++) {
        a = fma(a, factor, more);
        b = fma(b, factor, more);
        c = fma(c, factor, more);
        d = fma(d, factor, more);
        e = fma(e, factor, more);
        f = fma(f, factor, more);
        g = fma(g, factor, more);
        h = fma(h, factor, more);
        a = fma(a, factor, more);
        b = fma(b, factor, more);
        c = fma(c, factor, more);
        d = fma(d, factor, more);
        e = fma(e, factor, more);
        f = fma(f, factor, more);
        g = fma(g, factor, more);
        h = fma(h, factor, more);
    }
    // All results are written, so that no compiler can leave a chain out.
    found[id.x] = (a + b) + (c + d) + ((e + f) + (g + h));
}
