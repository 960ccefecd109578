//! Tests that packets agree with the surfaces in f64, lane by lane.

use super::super::lanes::{Lanes, Vectors};
use super::*;
use brillianteer_math::ImplicitForm;
use glam::{DVec3, Vec3};
use pulp::{Arch, WithSimd};

/// Pseudorandom numbers from -1 to 1 (Marsaglia, Xorshift RNGs, 2003).
struct Chance(u64);

impl Chance {
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point();
            if let Some(unit) = p.try_normalize().filter(|_| p.length() < 1.0 && p.length() > 0.1) {
                return unit;
            }
        }
    }
}

/// The form's name, and the form.
type Named = (&'static str, ImplicitSurface);

/// Returns the shapes that the program comes with, in girdle radii, and then others.
fn shapes() -> Vec<Named> {
    let size = DVec3::new;
    let plate = |size, edge, amplitude, wavelength| ImplicitForm::Plate {
        size,
        edge,
        amplitude,
        wavelength,
        phase: 0.7,
    };
    let forms = [
        ("pill", ImplicitForm::Pill { size: size(2.0, 0.575, 0.31), edge: 0.155 }),
        ("cube", ImplicitForm::Block { size: size(2.0, 2.0, 2.0), edge: 0.38 }),
        ("prism", ImplicitForm::Prism { size: size(2.0, 0.758, 0.596), edge: 0.05 }),
        ("wavy plate", plate(size(2.0, 2.0, 0.348), 0.06, 0.098, 3.092)),
        ("tall pill", ImplicitForm::Pill { size: size(0.6, 1.8, 0.8), edge: 0.1 }),
        ("sphere", ImplicitForm::Pill { size: size(1.5, 1.5, 1.5), edge: 0.75 }),
        ("sharp pill", ImplicitForm::Pill { size: size(2.0, 0.5, 1.0), edge: 0.0 }),
        ("pane", ImplicitForm::Pane { size: size(2.0, 1.25, 0.24), corner: 0.4, edge: 0.12 }),
        ("sharp block", ImplicitForm::Block { size: size(0.5, 1.15, 1.65), edge: 0.0 }),
        ("sharp prism", ImplicitForm::Prism { size: size(2.0, 0.758, 0.596), edge: 0.0 }),
        ("wide prism", ImplicitForm::Prism { size: size(0.5, 1.5, 0.4), edge: 0.1 }),
        ("large cube", ImplicitForm::Block { size: size(2e3, 2e3, 2e3), edge: 300.0 }),
        ("plate of many waves", plate(size(2.0, 2.0, 0.5), 0.05, 0.1, 0.9)),
        ("sharp plate", plate(size(2.0, 1.5, 0.5), 0.0, 0.1, 1.5)),
        ("steep plate", plate(size(2.0, 2.0, 0.3), 0.05, 0.15, 0.5)),
    ];
    forms.into_iter().map(|(name, form)| (name, ImplicitSurface::new(form).unwrap())).collect()
}

/// A ray whose numbers are those of f32.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Ray {
    origin: DVec3,
    direction: DVec3,
}

impl Ray {
    fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin: origin.as_vec3().as_dvec3(), direction: direction.as_vec3().as_dvec3() }
    }

    fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }
}

/// The function of the surface that packets compute.
#[derive(Clone, Copy, PartialEq)]
enum Question {
    Entry,
    Exit,
    /// The change of the normal; the direction is the displacement.
    Turned,
}

/// An answer of one lane: a distance and a normal, or the normal's change.
#[derive(Clone, Copy, Debug, Default)]
struct Answer {
    distance: f32,
    normal: Vec3,
}

/// Many rays, followed in packets.
struct Packets<'a> {
    shape: PacketShape,
    question: Question,
    rays: &'a [[Vec<f32>; 3]; 2],
}

impl WithSimd for Packets<'_> {
    type Output = [Vec<f32>; 4];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [Vec<f32>; 4] {
        let [[x, y, z], [u, v, w]] = self.rays;
        let mut found = [vec![0.0; x.len()], vec![0.0; x.len()], vec![0.0; x.len()], vec![0.0; x.len()]];
        let mut i = 0;
        while i + S::F32_LANES <= x.len() {
            let to = i + S::F32_LANES;
            let o = Vectors([load(simd, &x[i..to]), load(simd, &y[i..to]), load(simd, &z[i..to])]);
            let d = Vectors([load(simd, &u[i..to]), load(simd, &v[i..to]), load(simd, &w[i..to])]);
            let (distance, normal) = match self.question {
                Question::Entry => {
                    let met = self.shape.entry(simd, o, d);
                    (met.distance, met.normal)
                }
                Question::Exit => {
                    let met = self.shape.exit(simd, o, d);
                    (met.distance, met.normal)
                }
                Question::Turned => (o[0], self.shape.turned(simd, o, d).unwrap()),
            };
            found[0][i..to].copy_from_slice(distance.as_slice());
            found[1][i..to].copy_from_slice(normal[0].as_slice());
            found[2][i..to].copy_from_slice(normal[1].as_slice());
            found[3][i..to].copy_from_slice(normal[2].as_slice());
            i = to;
        }
        found
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, values: &[f32]) -> Lanes<S> {
    let mut lanes = Lanes::splat(simd, 0.0);
    for (lane, &value) in values.iter().enumerate() {
        lanes.set_lane(lane, value);
    }
    lanes
}

/// Returns the coordinates of rays in columns, filled up with NaN to whole packets of any processor.
fn columns(rays: &[Ray]) -> [[Vec<f32>; 3]; 2] {
    let mut rays = rays.to_vec();
    rays.resize(rays.len().next_multiple_of(64), Ray { origin: DVec3::NAN, direction: DVec3::NAN });
    let column = |pick: fn(&Ray) -> DVec3| {
        [0, 1, 2].map(|axis| rays.iter().map(|ray| pick(ray)[axis] as f32).collect::<Vec<f32>>())
    };
    [column(|ray| ray.origin), column(|ray| ray.direction)]
}

fn ask(surface: &ImplicitSurface, question: Question, rays: &[Ray]) -> Vec<Answer> {
    let packets = Packets { shape: PacketShape::new(surface), question, rays: &columns(rays) };
    let [distance, x, y, z] = Arch::new().dispatch(packets);
    (0..rays.len()).map(|i| Answer { distance: distance[i], normal: Vec3::new(x[i], y[i], z[i]) }).collect()
}

/// Returns rays from around a shape toward it and past it.
fn rays(surface: &ImplicitSurface, count: usize, chance: &mut Chance) -> Vec<Ray> {
    let reach = surface.reach();
    (0..count)
        .map(|_| {
            let direction = chance.direction();
            Ray::new(chance.point() * reach * 0.8 - direction * 2.5 * reach, direction)
        })
        .collect()
}

/// Returns rays inside: as refracted at an index of 2 where they enter, then as reflected at their exits.
fn inside(surface: &ImplicitSurface, count: usize, chance: &mut Chance) -> Vec<Ray> {
    let mut found = vec![];
    while found.len() < count {
        let [ray] = rays(surface, 1, chance)[..] else { continue };
        let Some(distance) = surface.entry(ray.origin, ray.direction) else { continue };
        let mut point = ray.at(distance);
        let normal = surface.normal(point);
        let mut direction = (ray.direction * 0.5 - normal * 0.5).try_normalize().unwrap();
        for _ in 0..4 {
            let ray = Ray::new(point, direction);
            found.push(ray);
            let Some(distance) = surface.exit(ray.origin, ray.direction) else { break };
            point = ray.at(distance);
            let normal = surface.normal(point);
            direction -= normal * (2.0 * direction.dot(normal));
        }
    }
    found.truncate(count);
    found
}

/// The differences between packets and f64, over all rays that meet the surface; rays that differ in whether they
/// meet it are counted separately.
#[derive(Debug, Default)]
struct Agreement {
    met: usize,
    /// Rays that meet the surface in one of the two computations only, or at points far from each other.
    parted: usize,
    /// Those of them that do not graze.
    parted_clearly: usize,
    /// The greatest distance of a point from the surface, in units of the reach.
    off: f64,
    /// The greatest distance between the two points, of rays that do not graze, in units of the reach.
    apart: f64,
    /// The greatest distance between the two normals, of rays that do not graze, less what the bend between the points
    /// explains.
    normals: f64,
}

/// The least cosine of incidence, at either end of the way through the shape, of rays that do not graze.
const GRAZING: f64 = 0.03;

fn agreement(surface: &ImplicitSurface, question: Question, rays: &[Ray]) -> Agreement {
    let mut sum = Agreement::default();
    let reach = surface.reach();
    let find = |ray: &Ray| match question {
        Question::Entry => surface.entry(ray.origin, ray.direction),
        _ => surface.exit(ray.origin, ray.direction),
    };
    for (ray, answer) in rays.iter().zip(ask(surface, question, rays)) {
        let found = Some(f64::from(answer.distance)).filter(|d| d.is_finite());
        let expected = find(ray);
        let cosine = |distance: f64| surface.normal(ray.at(distance)).dot(ray.direction).abs();
        let sharp = [expected, found].into_iter().flatten().any(|d| is_near_edge(surface, ray.at(d)));
        let ends = [expected, found].into_iter().flatten().map(cosine).fold(1.0, f64::min);
        let start = if question == Question::Exit { cosine(0.0) } else { 1.0 };
        let grazes = ends.min(start) < GRAZING || sharp;
        sum.met += usize::from(expected.is_some());
        if let Some((a, b)) = found.zip(expected).filter(|(a, b)| (a - b).abs() < 1e-3 * reach) {
            let (p, q) = (ray.at(a), ray.at(b));
            sum.off = sum.off.max(surface.value(p).abs() / reach);
            assert!((answer.normal.length() - 1.0).abs() < 1e-5, "{surface:?} {ray:?} {answer:?}");
            if !grazes {
                sum.apart = sum.apart.max(p.distance(q) / reach);
                let normal = surface.normal(q);
                let bend = surface.bend(q);
                let most = bend.x_axis.length() + bend.y_axis.length() + bend.z_axis.length();
                let explained = most * (p.distance(q) + 3e-7 * reach);
                sum.normals = sum.normals.max(answer.normal.as_dvec3().distance(normal) - explained);
            }
        } else if found.is_some() || expected.is_some() {
            sum.parted += 1;
            sum.parted_clearly += usize::from(!grazes);
        }
    }
    sum
}

/// Returns whether a point is so near to a sharp edge that rounding may decide to which face it belongs.
fn is_near_edge(surface: &ImplicitSurface, point: DVec3) -> bool {
    if surface.parts().edge > 0.0 {
        return false;
    }
    let normal = surface.normal(point);
    (0..8).any(|corner| {
        let sides = [1, 2, 4].map(|bit| if corner & bit == 0 { 1.0 } else { -1.0 });
        let near = DVec3::from_array(sides) * (3e-6 * surface.reach());
        surface.normal(point + near).distance(normal) > 0.1
    })
}

fn check((name, surface): &Named, sum: &Agreement) {
    assert!(sum.met > 1000 && sum.parted * 500 < sum.met, "{name}: {sum:?}");
    // A ray through the rounded edge of a plate with steep waves may leave twice.
    let most = if surface.is_convex() { 0 } else { sum.met / 2000 };
    assert!(sum.parted_clearly <= most, "{name}: {sum:?}");
    assert!(sum.off < 1e-6 && sum.apart < 1e-5 && sum.normals < 1e-5, "{name}: {sum:?}");
}

#[test]
fn packets_enter_where_rays_in_f64_enter() {
    let mut chance = Chance(11);
    for named in shapes() {
        let rays = rays(&named.1, 20_000, &mut chance);
        check(&named, &agreement(&named.1, Question::Entry, &rays));
    }
}

#[test]
fn packets_leave_where_rays_in_f64_leave() {
    let mut chance = Chance(12);
    for named in shapes() {
        let rays = inside(&named.1, 20_000, &mut chance);
        check(&named, &agreement(&named.1, Question::Exit, &rays));
    }
}

#[test]
fn light_that_leaves_a_plate_enters_again_where_rays_in_f64_do() {
    let mut chance = Chance(13);
    let mut entered = 0;
    for (name, surface) in shapes() {
        let leaving: Vec<Ray> = inside(&surface, 20_000, &mut chance)
            .iter()
            .filter_map(|ray| Some(Ray::new(ray.at(surface.exit(ray.origin, ray.direction)?), ray.direction)))
            .collect();
        let sum = agreement(&surface, Question::Entry, &leaving);
        assert!(sum.parted_clearly == 0 && sum.parted * 100 < leaving.len(), "{name}: {sum:?}");
        assert!(surface.is_convex() || sum.apart < 1e-5, "{name}: {sum:?}");
        entered += sum.met;
    }
    assert!(entered > 1000, "{entered}");
}

#[test]
fn normals_turn_as_in_f64() {
    let mut chance = Chance(14);
    for (name, surface) in shapes() {
        let reach = surface.reach();
        let moves: Vec<Ray> = rays(&surface, 20_000, &mut chance)
            .iter()
            .filter_map(|ray| Some(ray.at(surface.entry(ray.origin, ray.direction)?)))
            .map(|point| Ray::new(point, chance.point()))
            .collect();
        let (mut most, mut bent) = (0.0_f64, 0);
        for (m, answer) in moves.iter().zip(ask(&surface, Question::Turned, &moves)) {
            let turned = answer.normal.as_dvec3();
            bent += usize::from(turned.length() * reach > 0.01);
            // On a seam between two pieces of the surface, the bend of either piece is correct.
            let around = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).chain([DVec3::ZERO]);
            let apart = around
                .map(|off| surface.bend(m.origin + off * (5e-7 * reach)) * m.direction)
                .map(|expected| (expected - turned).length() / (expected.length() + 1.0 / reach))
                .fold(f64::INFINITY, f64::min);
            most = most.max(apart);
        }
        assert!(moves.len() > 5000 && most < 1e-3, "{name}: {most}");
        let is_flat = surface.parts().edge == 0.0 && surface.parts().round == 0.0 || name == "sharp prism";
        assert!(bent > 500 || (is_flat && surface.is_convex()), "{name}: {bent}");
    }
}

#[test]
fn each_lane_depends_on_its_own_ray_alone() {
    let mut chance = Chance(15);
    let bad = [f64::NAN, f64::INFINITY, 0.0, 1e30, -1e300].map(DVec3::splat);
    for (name, surface) in shapes() {
        for question in [Question::Entry, Question::Exit, Question::Turned] {
            let rays = if question == Question::Exit {
                inside(&surface, 500, &mut chance)
            } else {
                rays(&surface, 500, &mut chance)
            };
            // Other rays, which meet nothing, are mixed in, in another order.
            let mixed: Vec<Ray> = rays
                .iter()
                .rev()
                .enumerate()
                .flat_map(|(i, ray)| [Ray { origin: bad[i % 5], direction: bad[i / 5 % 5] }, *ray])
                .collect();
            let alone = ask(&surface, question, &rays);
            let among: Vec<Answer> = ask(&surface, question, &mixed).into_iter().skip(1).step_by(2).collect();
            for (a, b) in alone.iter().zip(among.iter().rev()) {
                assert_eq!(a.distance.to_bits(), b.distance.to_bits(), "{name}");
                let is_same = a.normal == b.normal || a.normal.is_nan();
                assert!(is_same && a.normal.is_nan() == b.normal.is_nan(), "{name}");
            }
        }
    }
}

/// Sines and cosines of angles in turns.
struct Sines<'a>(&'a [f32]);

impl WithSimd for Sines<'_> {
    type Output = [Vec<f32>; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [Vec<f32>; 2] {
        let mut found = [vec![0.0; self.0.len()], vec![0.0; self.0.len()]];
        for i in (0..self.0.len()).step_by(S::F32_LANES) {
            let to = i + S::F32_LANES;
            let [sine, cosine] = wave::sin_cos(load(simd, &self.0[i..to]));
            found[0][i..to].copy_from_slice(sine.as_slice());
            found[1][i..to].copy_from_slice(cosine.as_slice());
        }
        found
    }
}

#[test]
fn sines_and_cosines_are_good_to_3e_7() {
    let turns: Vec<f32> = (-(1 << 20)..1 << 20).map(|i| i as f32 / 190_000.0).collect();
    let [sines, cosines] = Arch::new().dispatch(Sines(&turns));
    for ((turns, sine), cosine) in turns.iter().zip(sines).zip(cosines) {
        let angle = f64::from(*turns).fract() * std::f64::consts::TAU;
        let off = (f64::from(sine) - angle.sin()).abs().max((f64::from(cosine) - angle.cos()).abs());
        assert!(off < 3e-7, "{turns}: {off}");
    }
}

/// Returns the least nanoseconds that each of `count` items takes, of several turns.
fn nanoseconds(count: usize, mut work: impl FnMut()) -> f64 {
    let times = (0..7).map(|_| {
        let start = std::time::Instant::now();
        work();
        start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min) / count as f64 * 1e9
}

/// Prints times: `cargo test --release packet_times -- --ignored --nocapture`.
#[test]
#[ignore = "prints times for a person to read"]
#[allow(clippy::print_stdout, reason = "what it measures is read by a person")]
fn packet_times() {
    let mut chance = Chance(16);
    println!(
        "nanoseconds in f64, in packets, and their ratio: an entry, an exit, each with its normal; a turn"
    );
    for (name, surface) in shapes() {
        let outside = rays(&surface, 40_000, &mut chance);
        let inside = inside(&surface, 40_000, &mut chance);
        let mut line = format!("{name:20}");
        for (question, rays) in
            [(Question::Entry, &outside), (Question::Exit, &inside), (Question::Turned, &inside)]
        {
            let find = |ray: &Ray| match question {
                Question::Entry => surface.entry(ray.origin, ray.direction),
                _ => surface.exit(ray.origin, ray.direction),
            };
            let exact = nanoseconds(rays.len(), || {
                for ray in rays {
                    if question == Question::Turned {
                        std::hint::black_box(surface.bend(ray.origin) * ray.direction);
                    } else if let Some(distance) = std::hint::black_box(find(ray)) {
                        std::hint::black_box(surface.normal(ray.at(distance)));
                    }
                }
            });
            let (shape, columns) = (PacketShape::new(&surface), columns(rays));
            let packets = nanoseconds(rays.len(), || {
                std::hint::black_box(Arch::new().dispatch(Packets { shape, question, rays: &columns }));
            });
            line += &format!(" | {exact:6.0} {packets:5.1} {:5.1}", exact / packets);
        }
        println!("{line}");
    }
}
