//! Laws of rings: closed metal, free stones, a free finger, and numbers that make a ring or an error that names them.

use super::band::band;
use super::gem::{MountedStone, TOUCHING_MM};
use super::head::{apart, prongs, station};
use super::rod::{Station, rod};
use super::skin::CHORD_MM;
use super::*;
use brillianteer_cut::TOLKOWSKY;
use brillianteer_math::{Plane, Polytope, Pose, ShadedSurface};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

fn brilliant() -> Polytope {
    let planes: Vec<Plane> = TOLKOWSKY.facets().unwrap().into_iter().map(|(_, plane)| plane).collect();
    Polytope::from_planes(&planes).unwrap()
}

/// Returns a double cone of this many sides, longer along x by a factor.
fn faceted(sides: usize, length: f64) -> Polytope {
    let azimuths = (0..sides).map(|k| TAU * (k as f64 + 0.5) / sides as f64);
    let stretched = |plane: Plane| Plane::new(plane.normal / DVec3::new(length, 1.0, 1.0), plane.offset);
    let mut planes = vec![Plane::new(DVec3::Z, 0.25), Plane::new(-DVec3::Z, 0.8)];
    for azimuth in azimuths {
        planes.push(stretched(Plane::from_slope(0.6, azimuth, 0.6_f64.sin())));
        planes.push(stretched(Plane::from_slope(PI / 2.0, azimuth, 1.0)));
        planes.push(stretched(Plane::from_slope(PI - 0.7, azimuth, 0.7_f64.sin() + 0.04 * 0.7_f64.cos())));
    }
    Polytope::from_planes(&planes).unwrap()
}

fn cube() -> Polytope {
    let sides = DVec3::AXES.into_iter().flat_map(|axis| [Plane::new(axis, 1.0), Plane::new(-axis, 1.0)]);
    Polytope::from_planes(&sides.collect::<Vec<_>>()).unwrap()
}

fn styled(style: RingStyle) -> Ring {
    Ring { style, ..Ring::default() }
}

/// Makes the ring with a main stone of this shape and size, and small stones of the same shape, where its style holds them.
fn made(ring: &Ring, shape: &Polytope, diameter_mm: f64) -> Result<Mounting, RingError> {
    let main = SetStone { shape, diameter_mm };
    let small = SetStone { shape, diameter_mm: ring.small_diameter_mm };
    ring.mounting((ring.style.prongs() > 0).then_some(&main), ring.style.has_small().then_some(&small))
}

fn mounted(mounting: &Mounting, shape: &Polytope) -> Vec<MountedStone> {
    let stone = |seat: &RingSeat| {
        MountedStone::new(&SetStone { shape, diameter_mm: 2.0 * seat.pose.scale }, &seat.pose)
    };
    mounting.seats.iter().map(stone).collect()
}

/// Returns the fault of a surface that should be closed; `None` where it has none.
fn open(surface: &ShadedSurface) -> Option<String> {
    // Points less than a tenth of a nanometre apart count as one; a triangle between them has no area.
    let place = |k: u32| surface.points[k as usize].to_array().map(|x| (x * 1e7).round() as i64);
    let mut edges = HashMap::new();
    for t in &surface.corners {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (place(t[a]), place(t[b]));
            if a != b {
                *edges.entry((a, b)).or_insert(0) += 1;
            }
        }
    }
    let alone = edges.iter().find(|((a, b), count)| edges.get(&(*b, *a)) != Some(count));
    if surface.points.iter().any(|point| !point.is_finite()) {
        return Some("a point is not finite".to_owned());
    }
    if surface.normals.iter().any(|normal| (normal.length() - 1.0).abs() > 1e-9) {
        return Some("a normal is no unit vector".to_owned());
    }
    if surface.volume() <= 0.0 {
        return Some(format!("the volume is {}", surface.volume()));
    }
    alone.map(|(edge, count)| format!("the edge {edge:?} is there {count} times"))
}

/// Returns the depth of the deepest point inside a stone, in mm, of the corners and of the places at a third and at the half
/// of each edge.
fn deepest(mounting: &Mounting, stones: &[MountedStone]) -> f64 {
    let in_stones = |point: DVec3| stones.iter().map(|stone| stone.depth(point)).fold(0.0, f64::max);
    let of = |surface: &ShadedSurface| {
        let along = (0..surface.corners.len()).flat_map(|k| {
            let [a, b, c] = surface.triangle(k);
            [(a, b), (b, c), (c, a)]
                .into_iter()
                .flat_map(|(from, to)| [0.0, 1.0 / 3.0, 0.5].map(|part| from.lerp(to, part)))
        });
        along.map(in_stones).fold(0.0, f64::max)
    };
    mounting.metal.iter().map(|part| of(&part.surface)).fold(0.0, f64::max)
}

/// Returns the least distance of metal and stones from the finger's axis, in mm.
fn least_hole(mounting: &Mounting, shape: &Polytope) -> f64 {
    let from_axis = |point: DVec3| point.x.hypot(point.z);
    let middles = mounting.metal.iter().flat_map(|part| {
        let surface = &part.surface;
        (0..surface.corners.len()).flat_map(move |k| {
            let [a, b, c] = surface.triangle(k);
            [a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0]
        })
    });
    let seats = mounting.seats.iter();
    let corners = seats.flat_map(|seat| shape.vertices().iter().map(|&corner| seat.pose.place(corner)));
    middles.chain(corners).map(from_axis).fold(f64::INFINITY, f64::min)
}

/// Returns whether a plane between the middles of any two stones separates them, where the stones are larger by a factor.
fn are_apart(mounting: &Mounting, shape: &Polytope, factor: f64) -> bool {
    let seats = &mounting.seats;
    let span = |seat: &RingSeat, line: DVec3| {
        let pose = Pose { scale: seat.pose.scale * factor, ..seat.pose };
        let along = shape.vertices().iter().map(|&corner| pose.place(corner).dot(line));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), at| (l.min(at), h.max(at)))
    };
    let free = |i: usize, j: usize| {
        let line = seats[j].pose.at - seats[i].pose.at;
        span(&seats[i], line).1 < span(&seats[j], line).0
    };
    (0..seats.len()).all(|j| (0..j).all(|i| free(i, j)))
}

#[test]
fn every_part_of_every_style_is_closed_and_faces_outward() {
    let stone = brilliant();
    for (name, style) in RingStyle::NAMES {
        let mounting = made(&styled(style), &stone, 6.5).unwrap();
        let parts = mounting.metal.iter();
        let counts = parts.clone().map(|part| part.surface.corners.len()).sum::<usize>();
        let most = if style.has_small() { 160_000 } else { 60_000 };
        assert!((20_000..most).contains(&counts), "{name}: {counts} triangles");
        for MetalPart { name: part, surface } in parts {
            assert_eq!(open(surface), None, "{name}: {part}");
            // Shading normals keep to the side of their triangles, but where a notch is cut.
            let area = |k: usize, least: f64| {
                let [a, b, c] = surface.triangle(k);
                let face = (b - a).cross(c - a);
                let normals = surface.corners[k].map(|n| surface.normals[n as usize]);
                let strays = normals.iter().any(|n| n.dot(face) < least * face.length());
                if strays { face.length() } else { 0.0 }
            };
            let sum = |least| (0..surface.corners.len()).map(|k| area(k, least)).sum::<f64>();
            assert!(sum(0.7) < 0.01 * sum(2.0), "{name}: {part}: {} of {}", sum(0.7), sum(2.0));
        }
    }
}

#[test]
fn the_check_of_closed_surfaces_sees_a_hole_a_turned_triangle_and_a_surface_inside_out() {
    let whole = band(&Ring::default());
    assert_eq!(open(&whole), None);
    let (mut holed, mut turned, mut inside_out) = (whole.clone(), whole.clone(), whole);
    holed.corners.pop();
    turned.corners[7].reverse();
    inside_out.corners.iter_mut().for_each(|t| t.reverse());
    assert!([holed, turned, inside_out].iter().all(|surface| open(surface).is_some()));
}

#[test]
fn stones_are_free_of_metal_and_of_one_another_and_so_is_the_finger() {
    for shape in [brilliant(), faceted(12, 1.0)] {
        for (name, style) in RingStyle::NAMES {
            let ring = styled(style);
            let mounting = made(&ring, &shape, 6.5).unwrap();
            let mut stones = mounted(&mounting, &shape);
            assert!(deepest(&mounting, &stones) <= TOUCHING_MM, "{name}: {}", deepest(&mounting, &stones));
            assert!(are_apart(&mounting, &shape, 1.0), "{name}");
            let hole = least_hole(&mounting, &shape);
            assert!((hole - ring.hole()).abs() < 2.0 * CHORD_MM, "{name}: {hole}");
            if mounting.seats.is_empty() {
                continue;
            }
            // The same checks see stones that are a little lower or larger.
            let lower = mounting.seats.iter().map(|seat| {
                let up = seat.pose.turn * DVec3::Z;
                let pose = Pose { at: seat.pose.at - up * 0.1, ..seat.pose };
                MountedStone::new(&SetStone { shape: &shape, diameter_mm: 2.0 * pose.scale }, &pose)
            });
            stones = lower.collect();
            assert!(deepest(&mounting, &stones) > 0.05, "{name}");
            assert!(mounting.seats.len() == 1 || !are_apart(&mounting, &shape, 1.3), "{name}");
        }
    }
}

#[test]
fn stones_of_a_ring_have_their_tables_outward_and_the_gaps_that_are_asked_for() {
    let shape = brilliant();
    for (style, count) in [(RingStyle::Halo, 17), (RingStyle::Eternity, 43)] {
        let ring = styled(style);
        let mounting = made(&ring, &shape, 6.5).unwrap();
        assert_eq!(mounting.seats.len(), count, "{style:?}");
        assert!(mounting.small_gap_mm.unwrap() >= ring.small_gap_mm - 1e-9);
        for seat in &mounting.seats {
            let up = seat.pose.turn * DVec3::Z;
            assert!(up.dot(DVec3::new(seat.pose.at.x, 0.0, seat.pose.at.z)) > 0.0, "{seat:?}");
            let diameter = if seat.kind == SeatKind::Main { 6.5 } else { ring.small_diameter_mm };
            assert!((2.0 * seat.pose.scale - diameter).abs() < 1e-12);
        }
    }
    let higher = Ring { culet_gap_mm: 1.0, ..Ring::default() };
    let height = |ring: &Ring| made(ring, &shape, 6.5).unwrap().culet_height_mm.unwrap();
    assert!((height(&higher) - height(&Ring::default()) - 0.75).abs() < 1e-9);
    assert!(height(&higher) > higher.thickness_mm);
}

#[test]
fn prongs_would_reach_into_the_stone_as_deep_as_their_notch() {
    for shape in [brilliant(), faceted(24, 1.0), faceted(16, 1.3), cube()] {
        for style in [RingStyle::FourProng, RingStyle::SixProng] {
            let ring = Ring { culet_gap_mm: 1.0, ..styled(style) };
            let stone = SetStone { shape: &shape, diameter_mm: 6.5 };
            let head = prongs(&ring, &stone).unwrap();
            let stones = [MountedStone::new(&stone, &stone.pose(DVec3::Z * head.lift, DQuat::IDENTITY))];
            let depth = |surface: &ShadedSurface| {
                surface.points.iter().map(|&point| stones[0].depth(point)).fold(0.0, f64::max)
            };
            let asked = ring.notch * ring.prong_diameter_mm;
            for prong in &head.prongs {
                let radius = 0.5 * ring.prong_diameter_mm;
                let uncut =
                    |at| Station { inward: f64::INFINITY, ..station(at, prong, head.lift, radius, &ring) };
                let stations: Vec<Station> = prong.way.iter().map(uncut).collect();
                let (whole, cut) = (rod(&stations, &[]), rod(&stations, &stones));
                let deep = depth(&whole);
                // At a corner of the stone the middle stays that far from the corner, and is nearer to its sides.
                assert!((0.4 * asked..1.05 * asked).contains(&deep), "{deep} of {asked}");
                assert!(depth(&cut) <= TOUCHING_MM && cut.volume() < whole.volume());
                let nearest =
                    stations.iter().map(|at| stones[0].depth(at.at)).fold(f64::NEG_INFINITY, f64::max);
                assert!(nearest < -0.3 * apart(&ring), "the middle of a prong lies in the stone: {nearest}");
            }
        }
    }
}

#[test]
fn prongs_of_a_stone_with_their_symmetry_are_copies_of_one_another() {
    for (style, sides) in [(RingStyle::FourProng, 24), (RingStyle::SixProng, 24)] {
        let of = |shape: &Polytope| {
            let mounting = made(&styled(style), shape, 6.5).unwrap();
            let parts = mounting.metal.into_iter().filter(|part| part.name == "prong");
            parts.map(|part| part.surface).collect::<Vec<_>>()
        };
        let farthest = |prongs: &[ShadedSurface]| {
            let turn = DQuat::from_rotation_z(TAU / prongs.len() as f64);
            let pairs = prongs.iter().zip(prongs.iter().cycle().skip(1));
            let apart = pairs.map(|(a, b)| {
                // Rounding may change the order of points, so each is compared with the nearest.
                let nearest = |p: &DVec3| {
                    b.points.iter().map(|q| (turn * *p).distance(*q)).fold(f64::INFINITY, f64::min)
                };
                a.points.iter().map(nearest).fold(0.0, f64::max)
            });
            apart.fold(0.0, f64::max)
        };
        let even = of(&faceted(sides, 1.0));
        assert_eq!(even.len(), style.prongs());
        assert!(farthest(&even) < 1e-6, "{}", farthest(&even));
    }
    // A longer stone is gripped where it is: its prongs are no copies.
    let mounting = made(&styled(RingStyle::SixProng), &faceted(24, 1.3), 6.5).unwrap();
    let reach = |part: &MetalPart| {
        part.surface.points.iter().map(|point| point.truncate().length()).fold(0.0, f64::max)
    };
    let reaches: Vec<f64> = mounting.metal.iter().filter(|part| part.name == "prong").map(reach).collect();
    assert!(reaches[0] > reaches[1] + 0.3, "{reaches:?}");
}

/// Returns the volume of a band of even width by Pappus' theorem: the integral of 2πv times the section's width at v.
fn pappus(ring: &Ring, outer: f64) -> f64 {
    let steps = 200_000;
    let width =
        |height: f64, power: f64| ring.width_mm * (1.0 - height.powf(power)).max(0.0).powf(1.0 / power);
    let middle = ring.hole() + ring.comfort_mm;
    let at = |k: usize| {
        let part = (k as f64 + 0.5) / steps as f64;
        let (up, down) = (ring.thickness_mm - ring.comfort_mm, ring.comfort_mm);
        TAU * (middle + up * part) * width(part, outer) * up / steps as f64
            + TAU * (middle - down * part) * width(part, 4.0) * down / steps as f64
    };
    (0..steps).map(at).sum()
}

#[test]
fn a_band_of_even_width_has_the_volume_of_pappus() {
    for (outside, power) in [(OuterShape::D, 2.0), (OuterShape::Flat, 9.0)] {
        let ring = Ring { outside, taper: 1.0, ..styled(RingStyle::Band) };
        let volume = band(&ring).volume();
        assert!((volume / pappus(&ring, power) - 1.0).abs() < 2e-3, "{volume} {}", pappus(&ring, power));
        assert!((volume / pappus(&ring, 1.3 * power) - 1.0).abs() > 2e-3);
        // Chords lie inside the outer curves, so finer ones could only add.
        assert!(volume < pappus(&ring, power) * 1.0005);
    }
}

#[test]
fn metal_that_two_parts_share_is_weighed_once() {
    let mut mounting = made(&styled(RingStyle::Band), &cube(), 1.0).unwrap();
    let one = mounting.metal[0].surface.volume();
    assert!((mounting.volume_mm3() / one - 1.0).abs() < 1e-3, "{} {one}", mounting.volume_mm3());
    assert!((ALLOYS[0].grams(one) - 0.01558 * one).abs() < 1e-9);
    let again = mounting.metal[0].clone();
    mounting.metal.push(again.clone());
    assert!((mounting.volume_mm3() / one - 1.0).abs() < 1e-3);
    let away = Pose { at: DVec3::new(1.0, 50.0, 0.0), ..Pose::STILL };
    mounting.metal[1].surface = again.surface.placed(&away);
    assert!((mounting.volume_mm3() / one - 2.0).abs() < 2e-3);
    let head = made(&styled(RingStyle::SixProng), &brilliant(), 6.5).unwrap();
    let sum: f64 = head.metal.iter().map(|part| part.surface.volume()).sum();
    let volume = head.volume_mm3();
    assert!(volume < 0.99 * sum && volume > head.metal[0].surface.volume(), "{volume} {sum}");
    assert_eq!(Mounting::default().volume_mm3(), 0.0);
}

#[test]
fn metal_as_long_as_a_metre_is_weighed_row_by_row() {
    // A rod across the box: lines over the whole box would take many gigabytes.
    // It does not lie along the diagonal of the lines, where all rows would err alike.
    let span = DVec3::new(1000.0, 3.0, 871.3);
    let sides = [DVec3::Y, DVec3::new(1.0, 0.0, -1.0)].map(|side| side.normalize_or_zero());
    let corner = |k: usize| {
        let signs = [k & 1, k >> 1 & 1].map(|bit| bit as f64 - 0.5);
        sides[0] * signs[0] + sides[1] * signs[1] + if k > 3 { span } else { DVec3::ZERO }
    };
    let points: Vec<DVec3> = (0..8).map(corner).collect();
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mut surface = ShadedSurface::creased(&points, &triangles, 0.5);
    if surface.volume() < 0.0 {
        surface.corners.iter_mut().for_each(|t| t.reverse());
    }
    assert_eq!(open(&surface), None);
    let volume = surface.volume();
    let mounting = Mounting { metal: vec![MetalPart { name: "rod", surface }], ..Mounting::default() };
    assert!((mounting.volume_mm3() / volume - 1.0).abs() < 1e-3, "{} {volume}", mounting.volume_mm3());
}

#[test]
fn impossible_rings_are_errors_that_name_the_number_and_say_by_how_much() {
    let refused = |ring: &Ring, shape: &Polytope, mm: f64| made(ring, shape, mm).unwrap_err().to_string();
    let stone = brilliant();
    let solitaire = Ring::default();
    for (ring, message) in [
        (Ring { width_mm: 0.5, ..solitaire.clone() }, "width_mm: 0.5 must be from 1 to 12 mm"),
        (Ring { taper: f64::NAN, ..solitaire.clone() }, "taper: NaN must be from 0.4 to 1"),
        (
            Ring { comfort_mm: 1.5, ..solitaire.clone() },
            "comfort_mm: the inside rises through more than 60 percent of thickness_mm, by 0.480 mm; lower it",
        ),
        (
            Ring { prong_diameter_mm: 2.0, ..solitaire.clone() },
            "prong_diameter_mm: neighbouring prongs come too near to one another by",
        ),
    ] {
        let text = refused(&ring, &stone, if ring.prong_diameter_mm == 2.0 { 3.0 } else { 6.5 });
        assert!(text.starts_with(message), "{text}\ninstead of\n{message}");
    }
    let main = SetStone { shape: &stone, diameter_mm: 6.5 };
    let text = |ring: &Ring, main, small| ring.mounting(main, small).unwrap_err().to_string();
    assert!(text(&solitaire, None, None).starts_with("stone: a ring of style 'six-prong' holds a stone"));
    assert!(
        text(&styled(RingStyle::Halo), Some(&main), None).starts_with("small_stone: a ring of style 'halo'")
    );
    assert!(
        text(&styled(RingStyle::Band), Some(&main), None).starts_with("stone: a ring of style 'band' has no")
    );
    assert!(
        text(&solitaire, Some(&main), Some(&main))
            .starts_with("small_stone: a ring of style 'six-prong' has no")
    );
    let aside = cube().reframed(&Pose { at: DVec3::X * 3.0, ..Pose::STILL });
    assert!(refused(&solitaire, &aside, 6.5).starts_with("stone: the axis of its frame"));
}

fn any_ring() -> impl Strategy<Value = Ring> {
    let style = prop::sample::select(RingStyle::NAMES.map(|(_, style)| style).to_vec());
    let outside = prop_oneof![Just(OuterShape::D), Just(OuterShape::Flat)];
    let parts = prop::collection::vec(0.0..=1.0, RING_NUMBERS.len());
    // Half of the rings stay near the usual one.
    (style, outside, parts, prop_oneof![Just(1.0), Just(0.15)]).prop_map(|(style, outside, parts, share)| {
        let usual = Ring::default();
        let value = |k: usize| {
            let [least, most] = RING_NUMBERS[k].row.range;
            let first = (RING_NUMBERS[k].row.get)(&usual).unwrap();
            first + (least + (most - least) * parts[k] - first) * share
        };
        Ring {
            style,
            outside,
            inner_diameter_mm: value(0),
            width_mm: value(1),
            thickness_mm: value(2),
            comfort_mm: value(3),
            taper: value(4),
            prong_diameter_mm: value(5),
            notch: value(6),
            grip_mm: value(7),
            culet_gap_mm: value(8),
            rail_diameter_mm: value(9),
            small_diameter_mm: value(10),
            small_gap_mm: value(11),
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]
    #[test]
    fn any_numbers_make_a_ring_or_an_error(ring in any_ring(), shape in 0..4_usize, diameter in 1.0..14.0_f64) {
        let shape = vec![brilliant(), faceted(24, 1.0), faceted(16, 1.4), cube()].swap_remove(shape);
        match made(&ring, &shape, diameter) {
            Err(error) => {
                let stones = ["stone", "small_stone"];
                let mut known = RING_NUMBERS.iter().map(|number| number.row.key).chain(stones);
                prop_assert!(known.any(|key| key == error.key()), "{}: {}", error.key(), error);
            }
            Ok(mounting) => {
                for part in &mounting.metal {
                    prop_assert_eq!(open(&part.surface), None, "{}", part.name);
                }
                let deep = deepest(&mounting, &mounted(&mounting, &shape));
                prop_assert!(deep <= TOUCHING_MM, "{} mm of metal in a stone", deep);
                prop_assert!(least_hole(&mounting, &shape) > ring.hole() - 2.0 * CHORD_MM);
                prop_assert!(are_apart(&mounting, &shape, 1.0));
            }
        }
    }
}

#[test]
fn metal_whose_edge_alone_lies_in_a_stone_is_found() {
    // A cube's corner reaches through an edge between two triangles that have their corners and middles outside.
    let ring = Ring {
        style: RingStyle::Halo,
        inner_diameter_mm: 12.0,
        width_mm: 1.0,
        thickness_mm: 0.8,
        comfort_mm: 0.4671141046963487,
        taper: 0.4,
        prong_diameter_mm: 0.89514692748299,
        notch: 0.2,
        grip_mm: 0.1,
        culet_gap_mm: 1.5352009263476574,
        rail_diameter_mm: 0.8274329938882332,
        small_diameter_mm: 0.8,
        small_gap_mm: 0.9925804692929889,
        ..Ring::default()
    };
    let error = made(&ring, &cube(), 7.559777781725036).unwrap_err();
    let RingError::InsideStone { by_mm, .. } = error else { panic!("{error}") };
    assert!((0.066..0.09).contains(&by_mm), "{by_mm}");
}

#[test]
fn a_ring_is_read_as_it_was_written_and_numbers_left_out_are_the_usual_ones() {
    let ring = Ring { width_mm: 3.0, style: RingStyle::Halo, ..Ring::default() };
    assert_eq!(toml::from_str::<Ring>(&toml::to_string(&ring).unwrap()).unwrap(), ring);
    assert_eq!(toml::from_str::<Ring>("").unwrap(), Ring::default());
    assert!(toml::from_str::<Ring>("width = 3.0").is_err());
}
