// Finds the pixel that an invocation traces. A dispatch takes some tiles of 8 by 8 pixels from everywhere in the
// strip, so that it is about as heavy as any other; crates/trace/src/gpu/pieces.rs chooses them.
//
// Imports: ray.

// Returns the column and the row, in the strip, of an invocation's pixel, which may lie beyond the strip.
fn strip_pixel(group: vec3u, within: vec2u) -> vec2u {
    let number = group.x + group.y * GROUPS_ACROSS;
    if number >= frame.tile_count {
        return vec2u(NONE);
    }
    let tile = (frame.first_tile + number) * frame.tile_stride % frame.all_tiles;
    let across = (frame.size.x + 7u) / 8u;
    return vec2u(tile % across, tile / across) * 8u + within;
}
