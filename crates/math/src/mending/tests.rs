//! Tests that damage known surfaces in every way that occurs in files, and mend them.

use super::*;
use crate::solids::noise;
use crate::{Plane, Polytope, triangulate};

pub fn cube() -> Polytope {
    let sides = [DVec3::X, DVec3::Y, DVec3::Z];
    let planes: Vec<Plane> = sides.iter().flat_map(|&n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]).collect();
    Polytope::from_planes(&planes).unwrap()
}

/// Makes a stone with a table, two tiers above and one below, of `sides` facets each: sixteen or more facets of any slope.
pub fn stone(sides: u32) -> Polytope {
    let turn = |k: u32, half: f64| (f64::from(k) + half) * std::f64::consts::TAU / f64::from(sides);
    let mut planes = vec![Plane::new(DVec3::Z, 0.3)];
    for k in 0..sides {
        planes.push(Plane::from_slope(0.6, turn(k, 0.0), 0.6));
        planes.push(Plane::from_slope(1.57, turn(k, 0.0), 1.0));
        planes.push(Plane::from_slope(2.4, turn(k, 0.5), 0.7));
    }
    Polytope::from_planes(&planes).unwrap()
}

pub fn surface(polytope: &Polytope) -> Surface {
    let mesh = triangulate(polytope);
    let names = (0..polytope.facets().len()).map(|i| format!("facet {i}")).collect();
    Surface { vertices: mesh.vertices, triangles: mesh.triangles, groups: mesh.facets, names }
}

/// Gives every triangle corners of its own.
pub fn split(surface: &Surface) -> Surface {
    let vertices = (0..surface.triangles.len()).flat_map(|t| surface.corners(t)).collect();
    let triangles = (0..surface.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Surface { vertices, triangles, ..surface.clone() }
}

pub fn shaken(surface: &Surface, by: f64, seed: u64) -> Surface {
    let mut next = noise(seed);
    let mut shaken = surface.clone();
    shaken.vertices.iter_mut().for_each(|v| *v += by * DVec3::new(next(), next(), next()));
    shaken
}

#[test]
fn what_is_whole_stays_as_it_is() {
    let whole = surface(&stone(8));
    let Mended { surface, mending, .. } = whole.mend().unwrap();
    assert_eq!(mending, Mending { shells: 1, ..Mending::default() });
    assert!(
        (surface.volume() - whole.volume()).abs() < 1e-15 && surface.triangles.len() == whole.triangles.len()
    );
}

#[test]
fn split_corners_copies_and_turned_triangles_are_mended() {
    let whole = surface(&stone(8));
    let mut broken = split(&whole);
    broken.triangles.iter_mut().step_by(3).for_each(|t| t.swap(0, 1));
    for t in [1, 5, 5] {
        let [a, b, c] = broken.triangles[t];
        broken.triangles.push([c, b, a]);
        broken.groups.push(0);
    }
    broken.triangles.push([0, 0, 1]);
    broken.groups.push(0);
    let Mended { surface, mending, .. } = broken.mend().unwrap();
    assert!((surface.volume() - whole.volume()).abs() < 1e-14);
    assert_eq!((mending.copies, mending.degenerate, mending.crack, mending.shells), (3, 1, 0.0, 1));
    assert!(mending.turned > 0 && surface.vertices.len() == whole.vertices.len());
    assert_eq!(surface.mend().unwrap().mending, Mending { shells: 1, ..Mending::default() });
}

#[test]
fn cracks_are_closed_and_holes_are_refused_with_their_edges() {
    let whole = surface(&cube());
    let cracked = shaken(&split(&whole), 1e-4, 1);
    let Mended { surface: closed, mending, .. } = cracked.mend().unwrap();
    assert!(mending.crack > 1e-4 && mending.crack < 1e-3 && closed.vertices.len() == 8, "{mending:?}");
    assert!((closed.volume() - 8.0).abs() < 1e-2);
    let mut open = whole.clone();
    let gone = open.triangles.pop().unwrap().map(|v| whole.vertices[v as usize]);
    open.groups.pop();
    let Err(SurfaceError::Open { count: 3, edges, .. }) = open.mend() else { panic!("a hole was closed") };
    assert!(edges.iter().flatten().all(|end| gone.contains(end)));
    let text = open.mend().unwrap_err().to_string();
    assert!(
        text.starts_with("the surface is open: 3 edges lack their neighbour") && text.contains("1, "),
        "{text}"
    );
    // Beside cracks only the hole is named, as every crack can be closed.
    let cracked = shaken(&split(&open), 1e-4, 1).mend();
    assert!(matches!(cracked, Err(SurfaceError::Open { count: 3, .. })), "{cracked:?}");
}

#[test]
fn the_two_sides_of_something_flat_are_left_out() {
    let mut flap = surface(&cube());
    let before = flap.clone();
    let [a, b, c] = flap.triangles[0];
    let other = (0..8).find(|v| ![a, b, c].contains(v)).unwrap();
    // Such triangles are left by a facet whose sides coincide.
    for triangle in [[a, b, other], [a, other, b]] {
        flap.triangles.push(triangle);
        flap.groups.push(0);
    }
    let Mended { surface, mending, .. } = flap.mend().unwrap();
    assert_eq!((mending.copies, surface.triangles.len()), (2, before.triangles.len()));
    assert!((surface.volume() - 8.0).abs() < 1e-12);
}

#[test]
fn a_corner_on_a_neighbours_edge_is_put_into_it() {
    let mut seamed = surface(&cube());
    let [a, b, c] = seamed.triangles[0];
    let middle = seamed.vertices.len() as u32;
    seamed.vertices.push((seamed.vertices[a as usize] + seamed.vertices[b as usize]) / 2.0);
    seamed.triangles[0] = [a, middle, c];
    seamed.triangles.push([middle, b, c]);
    seamed.groups.push(seamed.groups[0]);
    let Mended { surface, mending, .. } = seamed.mend().unwrap();
    assert_eq!(mending.seams, 1);
    assert!((surface.volume() - 8.0).abs() < 1e-12);
}

#[test]
fn what_is_no_surface_is_refused_with_its_reason() {
    let told = |vertices: &[[f64; 3]], triangles: &[[u32; 3]]| {
        let vertices = vertices.iter().map(|&v| DVec3::from_array(v)).collect();
        Surface::new(vertices, triangles.to_vec()).mend().unwrap_err().to_string()
    };
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 0.3, 0.0]];
    let folded = [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    assert_eq!(told(&flat, &folded), "the surface encloses nothing; a solid is expected");
    assert!(told(&flat, &[[0, 1, 4]]).starts_with("triangle 1 refers to corner 5, and there are 4"));
    let bad = [[0.0; 3], [1.0, f64::NAN, 0.0], [0.0, 1.0, 0.0]];
    assert!(told(&bad, &[[0, 1, 2]]).starts_with("corner 2 is at [1, NaN, 0]; finite"));
    assert!(told(&[], &[]).starts_with("there is no triangle"));
    let far = [[1e12, 0.0, 0.0], [1e12 + 1.0, 0.0, 0.0], [1e12, 1.0, 0.0]];
    assert!(told(&far, &[[0, 1, 2]]).contains("from the origin; move it there"));
    let strip: Vec<[f64; 3]> = (0..10)
        .map(|i| {
            let (turn, side) = (f64::from(i / 2) * 1.2566, f64::from(i % 2) * 2.0 - 1.0);
            let out = 2.0 + side * (turn / 2.0).cos();
            [out * turn.cos(), out * turn.sin(), side * (turn / 2.0).sin()]
        })
        .collect();
    let mut round: Vec<[u32; 3]> =
        (0..4).flat_map(|k| [[2 * k, 2 * k + 1, 2 * k + 2], [2 * k + 1, 2 * k + 3, 2 * k + 2]]).collect();
    round.extend([[8, 9, 1], [9, 0, 1]]);
    assert!(told(&strip, &round).starts_with("the surface"), "a Möbius strip is open along its rim");
}
