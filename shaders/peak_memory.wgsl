// Measures how fast a card reads its memory. Each invocation reads 28 times 16 bytes in each turn from a buffer that
// is larger than caches; neighbouring invocations read neighbouring places.

// z: the number of turns; w: the number of invocations.
@group(0) @binding(0) var<uniform> given: vec4f;
@group(0) @binding(1) var<storage, read_write> found: array<vec4f>;
@group(0) @binding(2) var<storage, read> kept: array<vec4f>;

@compute @workgroup_size(64)
fn memory(@builtin(global_invocation_id) id: vec3u) {
    var sum = vec4f(0.0);
    for (var turn = 0u; turn < u32(given.z); turn++) {
        for (var k = 0u; k < 28u; k++) {
            // Each turn begins elsewhere, so that no compiler can keep the numbers that another turn has read.
            sum += kept[id.x + (k + turn) % 28u * u32(given.w)];
        }
    }
    found[id.x] = sum;
}
