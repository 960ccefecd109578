//! Small solids and surfaces for tests, some that are not convex, and noise for them.
#![allow(dead_code, reason = "each test uses its part")]

use brillianteer_math::{ShadedMesh, ShadedSurface, Surface};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Corners, and triangles between them, counter-clockwise seen from outside.
pub type Triangles = (Vec<DVec3>, Vec<[u32; 3]>);

/// An upright prism over an outline, from -`half` to `half`. The outline runs counter-clockwise, and all of it can be seen
/// from the origin.
pub fn extruded(outline: &[DVec2], half: f64) -> Triangles {
    let count = outline.len() as u32;
    let mut vertices: Vec<DVec3> = outline.iter().map(|p| p.extend(half)).collect();
    vertices.extend(outline.iter().map(|p| p.extend(-half)));
    vertices.extend([DVec3::Z * half, DVec3::NEG_Z * half]);
    let sides = |i: u32| {
        let j = (i + 1) % count;
        let [top, bottom] = [2 * count, 2 * count + 1];
        [[top, i, j], [bottom, count + j, count + i], [i, count + i, count + j], [i, count + j, j]]
    };
    (vertices, (0..count).flat_map(sides).collect())
}

/// A pyramid above an outline and one below it. The outline runs counter-clockwise, and all of it can be seen from the
/// origin.
pub fn spiked(outline: &[DVec2], above: f64, below: f64) -> Triangles {
    let count = outline.len() as u32;
    let mut vertices: Vec<DVec3> = outline.iter().map(|p| p.extend(0.0)).collect();
    vertices.extend([DVec3::Z * above, DVec3::NEG_Z * below]);
    let sides = |i: u32| {
        let j = (i + 1) % count;
        [[i, j, count], [j, i, count + 1]]
    };
    (vertices, (0..count).flat_map(sides).collect())
}

/// A star of five points.
pub fn star() -> Triangles {
    let corner = |k: u32| {
        let radius = if k.is_multiple_of(2) { 1.0 } else { 0.45 };
        DVec2::from_angle(0.1 + TAU * f64::from(k) / 10.0) * radius
    };
    spiked(&(0..10).map(corner).collect::<Vec<_>>(), 0.45, 0.7)
}

/// A heart whose cleft points upward, with a flat top and a point below.
pub fn heart() -> Triangles {
    let outline: Vec<DVec2> = (0..28).map(heart_corner).collect();
    let count = outline.len() as u32;
    let mut vertices: Vec<DVec3> = outline.iter().map(|p| (*p * 0.6).extend(0.35)).collect();
    vertices.extend(outline.iter().map(|p| p.extend(0.0)));
    vertices.extend([DVec3::Z * 0.35, DVec3::NEG_Z * 0.75]);
    let sides = |i: u32| {
        let j = (i + 1) % count;
        let [top, bottom] = [2 * count, 2 * count + 1];
        [[top, i, j], [i, count + i, count + j], [i, count + j, j], [bottom, count + j, count + i]]
    };
    (vertices, (0..count).flat_map(sides).collect())
}

fn heart_corner(k: u32) -> DVec2 {
    let t = -TAU * (f64::from(k) + 0.5) / 28.0;
    // The well-known heart curve: x = 16 sin³ t, y = 13 cos t - 5 cos 2t - 2 cos 3t - cos 4t.
    let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
    DVec2::new(16.0 * t.sin().powi(3), y) / 17.0
}

/// A C that is open toward +x: two bars along x and z, 0.6 thick and 0.8 apart, and the part that joins them. `half` is half
/// its length along z.
pub fn clasp(half: f64) -> Triangles {
    let outline = [
        (-1.0, -1.0),
        (1.0, -1.0),
        (1.0, -0.4),
        (-0.5, -0.4),
        (-0.5, 0.4),
        (1.0, 0.4),
        (1.0, 1.0),
        (-1.0, 1.0),
    ];
    let caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 7], [7, 4, 5], [7, 5, 6]];
    let mut vertices: Vec<DVec3> = outline.map(|p| DVec2::from(p).extend(half)).to_vec();
    vertices.extend(outline.map(|p| DVec2::from(p).extend(-half)));
    let mut triangles: Vec<[u32; 3]> = caps.to_vec();
    triangles.extend(caps.map(|[a, b, c]| [a + 8, c + 8, b + 8]));
    for i in 0..8 {
        let j = (i + 1) % 8;
        triangles.extend([[i, i + 8, j + 8], [i, j + 8, j]]);
    }
    (vertices, triangles)
}

/// Returns a torus around z, cut into this many parts along and across.
pub fn torus((major, minor): (f64, f64), (along, across): (u32, u32), is_smooth: bool) -> ShadedMesh {
    let (mut points, mut normals, mut corners) = (vec![], vec![], vec![]);
    for k in 0..along * across {
        let (i, j) = (k / across, k % across);
        let [(sin, cos), (up, out)] =
            [(i, along), (j, across)].map(|(k, of)| (TAU * f64::from(k) / f64::from(of)).sin_cos());
        normals.push(DVec3::new(out * cos, out * sin, up));
        points.push(DVec3::new((major + minor * out) * cos, (major + minor * out) * sin, minor * up));
        let place = |i: u32, j: u32| (i % along) * across + j % across;
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        corners.extend([[a, b, c], [a, c, d]]);
    }
    let normals = if is_smooth { normals } else { vec![] };
    ShadedMesh::new(ShadedSurface { points, corners, normals }).unwrap()
}

/// Makes a function that returns numbers from -1 to 1 that look random and are the same every time.
pub fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Cuts every triangle into four.
pub fn divided(surface: &Surface) -> Surface {
    let mut middles = std::collections::HashMap::new();
    let mut vertices = surface.vertices.clone();
    let mut between = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            vertices.push((surface.vertices[a as usize] + surface.vertices[b as usize]) / 2.0);
            vertices.len() as u32 - 1
        })
    };
    let mut triangles = vec![];
    for &[a, b, c] in &surface.triangles {
        let [x, y, z] = [between(a, b), between(b, c), between(c, a)];
        triangles.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]);
    }
    Surface::new(vertices, triangles)
}
