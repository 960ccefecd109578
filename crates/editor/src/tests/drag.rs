//! Measures how quickly the views follow the hand. This is ignored by default, because measuring takes time:
//! `cargo test --release --lib drag -- --ignored --nocapture`

use super::*;
use brillianteer_cut::{Crown, Tier, TierChange};
use brillianteer_scene::Side;
use brillianteer_session::model::{Action, action::Edit, update};
use glam::DVec2;

/// Number of changes, one for each frame of a screen of 60 Hz.
const CHANGES: u32 = 120;
const FRAME: Duration = Duration::from_micros(16_667);

/// Changes the first cut at 60 Hz, as a hand does, and prints the number of pictures that each pane shows in a second, and
/// the time of a frame of the window in milliseconds.
fn drag(name: &str, shows_map: bool, change: impl FnMut(&mut Editor, u32)) {
    drag_of(None, name, shows_map, change);
}

/// Does the same with the cut of a file in `cuts/`.
fn drag_of(cut: Option<&str>, name: &str, shows_map: bool, mut change: impl FnMut(&mut Editor, u32)) {
    let file = cut.map(|cut| format!("{}/../../cuts/{cut}", env!("CARGO_MANIFEST_DIR")).into());
    let workspace = Workspace { shows_map, ..Workspace::default() };
    let setup = Setup { workspace, file, ..Setup::default() };
    let mut bench = Bench::sized(setup, egui::vec2(1440.0, 900.0));
    bench.harness.state_mut().model.document.work.settings.look.head = Some(1e-9);
    bench.settle();
    let begun = Instant::now();
    let (mut frames, mut seen) = (vec![], [0_u32; 3]);
    let mut last = [const { None }; 3];
    for k in 0..CHANGES {
        let due = begun + FRAME * k;
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        change(bench.harness.state_mut(), k);
        let start = Instant::now();
        bench.harness.step();
        frames.push(start.elapsed().as_secs_f64() * 1e3);
        for (pane, (count, last)) in seen.iter_mut().zip(&mut last).enumerate() {
            let shot =
                bench.editor().views.gallery.traced.get(&(pane, Which::Present)).map(|p| p.shot.clone());
            *count += u32::from(*last != shot);
            *last = shot;
        }
    }
    let seconds = begun.elapsed().as_secs_f64();
    frames.sort_by(f64::total_cmp);
    let each = seen.map(|n| format!("{:.0}", f64::from(n) / seconds)).join(", ");
    println!(
        "{name}: {each} pictures a second in render, ASET, hearts; a frame of the window {:.1} ms, the slowest {:.1} ms",
        frames[frames.len() / 2],
        frames[frames.len() - 1]
    );
}

/// Drags the crown angle of the first cut by this many degrees at a time.
fn drag_crown(name: &str, step: f64) {
    drag(name, false, |editor, k| {
        if let Cut::RoundBrilliant(brilliant) = &mut editor.model.document.work.design.cut {
            brilliant.crown = Crown::Angle(33.0 + step * f64::from(k));
        }
    });
}

#[test]
#[ignore = "measures times, which takes a minute of two idle cores"]
fn the_views_follow_the_hand() {
    drag_crown("crown angle", 0.02);
    // This starts with a tilted stone: near a tilt of 0 the view would snap to 0.
    drag("tilt", false, |editor, k| {
        if k == 0 {
            editor.model.workspace.eye.lean = glam::DVec2::new(-0.25, -0.55);
        }
        editor.model.workspace.eye.drag(Side::Table, DVec2::new(0.004, 0.002));
    });
}

/// Drags the angle of a tier of a cut that is turned into tiers: the first that `is_meant`.
fn drag_tier(cut: Option<&str>, name: &str, is_meant: fn(&Tier) -> bool) {
    let mut held: Option<(usize, Tier)> = None;
    drag_of(cut, name, false, |editor, k| {
        let (place, tier) = held.get_or_insert_with(|| {
            update(&mut editor.model, Action::Edit(Edit::IntoTiers));
            let Cut::Tiers(tiers) = &editor.model.document.work.design.cut else { panic!() };
            let place = tiers.tiers.iter().position(is_meant).unwrap();
            (place, tiers.tiers[place].clone())
        });
        let angle = tier.angle + 0.005 * f64::from(k);
        update(
            &mut editor.model,
            Action::Edit(Edit::Tiers(TierChange::Setting(*place, angle, tier.distance))),
        );
    });
}

#[test]
#[ignore = "measures times, which takes a minute of two idle cores"]
fn the_views_follow_a_tier_as_they_follow_the_brilliant() {
    drag_crown("crown angle", 0.005);
    drag_tier(None, "a tier of the brilliant", |tier| tier.name() == "C1");
    let portuguese = Some("portuguese.toml");
    drag_tier(portuguese, "a pavilion tier of 193 facets", |tier| (-80.0..0.0).contains(&tier.angle));
    drag_tier(portuguese, "a crown tier of 193 facets", |tier| (1.0..80.0).contains(&tier.angle));
    drag_of(portuguese, "the crown angle of 193 facets", false, |editor, k| {
        let cut = &mut editor.model.document.work.design.cut;
        cut.proportion("crown_angle").unwrap().set(cut, 52.0 + 0.005 * f64::from(k));
    });
}

#[test]
#[ignore = "measures times, which takes two minutes of two idle cores"]
fn the_views_follow_the_hand_while_a_map_is_open() {
    for shows_map in [false, true] {
        // The crown angle moves the design on the map; another table begins another map with each change.
        drag(if shows_map { "crown angle, map" } else { "crown angle" }, shows_map, |editor, k| {
            if let Cut::RoundBrilliant(brilliant) = &mut editor.model.document.work.design.cut {
                brilliant.crown = Crown::Angle(33.0 + 0.02 * f64::from(k));
            }
        });
        drag(if shows_map { "table, map" } else { "table" }, shows_map, |editor, k| {
            if let Cut::RoundBrilliant(brilliant) = &mut editor.model.document.work.design.cut {
                brilliant.table = 53.0 + 0.02 * f64::from(k);
            }
        });
    }
}
