use brillianteer::{math::*, scene::*, trace::{beam, ray, unwatched}};
use glam::DVec3;
fn main() {
    let d: serde_json::Value = serde_json::from_str(&std::fs::read_to_string("/work/shared/oracle/aset_mitsuba.json").unwrap()).unwrap();
    let e: f64 = std::env::args().nth(1).map_or(0.001, |s| s.parse().unwrap());
    for (name, s) in d["stones"].as_object().unwrap() {
        let planes: Vec<Plane> = s["planes"].as_array().unwrap().iter().map(|p| {
            let n: Vec<f64> = p["normal"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            Plane::new(DVec3::new(n[0], n[1], n[2]), p["offset"].as_f64().unwrap())
        }).collect();
        let t = std::time::Instant::now();
        let p = Polytope::from_planes(&planes).unwrap();
        println!("{name} build {:?} v {} f {} vol {} sil {}", t.elapsed(), p.vertices().len(), p.facets().len(), p.volume(), p.silhouette_area(DVec3::Z));
        let mesh = triangulate(&p);
        println!("tri {} vs {}", mesh.triangles.len(), 2 * p.vertices().len() - 4);
        let scope = Scope::aset(30.0, Backing::Black);
        for (pol, tilt) in [(false, 0.0f64), (true, 0.0), (true, 15.0)] {
            let o = beam::Options { unresolved: e, polarised: pol, ..Default::default() };
            let v = View { tilt: tilt.to_radians(), azimuth: 0.2, ..View::default() };
            let t = std::time::Instant::now();
            let b = beam::trace(&p, Medium::clear(2.4175), &v, &o, &unwatched).unwrap();
            let el = t.elapsed();
            let (mut su, mut tr) = ([0.0; 4], [0.0; 4]);
            let f = f64::from(b.symmetry.order()) / b.silhouette_area;
            for x in b.iter() {
                if x.weight > 0.0 { let k = scope.band(x.exit, b.zenith); (if x.is_surface() { &mut su } else { &mut tr })[k] += x.weight * x.area * f; }
            }
            let mut st = [0.0; 5];
            for c in b.strongest_exits() { let a = b.get(c.outline).area * f; if c.undecided { st[4] += a; } if let Some(s) = c.strongest { st[scope.band(b.get(s).exit, b.zenith)] += a; } }
            let sum: f64 = su.iter().sum::<f64>() + tr.iter().sum::<f64>() + b.unresolved();
            println!("pol {pol} tilt {tilt} sym {:?} beams {} unres {:.6} {:?} sum-1 {:e}\n  surf {su:?}\n  trans {tr:?}\n  strongest {st:?}", b.symmetry, b.len(), b.unresolved(), el, sum - 1.0);
            if !pol { let all = &s["all_light"]; println!("  diff below {:+.5} green {:+.5} red {:+.5} blue {:+.5}", tr[0]+su[0]-s["below_horizon"].as_f64().unwrap(), tr[1]+su[1]-all["green"].as_f64().unwrap(), tr[2]+su[2]-all["red"].as_f64().unwrap(), tr[3]+su[3]-all["blue"].as_f64().unwrap()); }
        }
        let tracer = ray::Tracer::new(&p, Medium::clear(2.4175), ray::Options { polarised: false, most_bounces: 12, least_weight: 0.0 });
        let cam = ray::Camera::new(&View::default(), &p);
        let t = std::time::Instant::now();
        let mut acc = 0.0;
        for j in 0..512 { for i in 0..512 {
            let q = glam::DVec2::new((i as f64 + 0.5) / 256.0 - 1.0, (j as f64 + 0.5) / 256.0 - 1.0);
            let (o, d) = cam.ray(q);
            tracer.follow(o, d, |e| acc += e.weight);
        } }
        println!("rays {:?} {acc}", t.elapsed());
    }
}
