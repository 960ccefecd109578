//! Fitting a design to another material, and to a piece of rough or a weight, by the names on the screen.

use super::row_defaults::double_click_name;
use super::*;
use brillianteer_cut::{Finished, MaterialRef, Rough};
use brillianteer_session::model::{dialog::Dialog, fitting::RetargetForm};
use egui::Role;

/// Opens an editor in a window that is high enough for the dialogs.
fn tall() -> Bench {
    let mut bench = Bench::sized(Setup::default(), egui::vec2(1400.0, 900.0));
    bench.settle();
    bench
}

fn form(bench: &Bench) -> &RetargetForm {
    match &bench.editor().model.session.dialog {
        Some(Dialog::Retarget(form)) => form,
        other => panic!("{other:?}"),
    }
}

/// Opens a list and clicks an entry.
pub fn pick(bench: &mut Bench, list: &str, entry: &str) {
    bench.settle();
    bench.field(Role::ComboBox, list).click();
    bench.harness.run_steps(6);
    bench.harness.get_by_role_and_label(Role::Button, entry).scroll_to_me();
    bench.harness.run_steps(SCROLLED);
    bench.harness.get_by_role_and_label(Role::Button, entry).click();
    bench.harness.run_steps(6);
}

fn material(bench: &Bench) -> MaterialRef {
    bench.editor().model.document.work.design.material.clone()
}

#[test]
fn a_brilliant_is_fitted_to_sapphire_as_one_step_with_the_light_of_both() {
    let mut bench = tall();
    let (before, first) = (bench.brilliant(), material(&bench));
    bench.choose("Design", "Fit to another material…");
    assert!(bench.harness.query_by_label_contains("No angle changes").is_some());
    pick(&mut bench, "New material", "sapphire");
    pick(&mut bench, "Rule", "Critical angle");
    let found = form(&bench).found.clone().unwrap();
    assert_eq!(found.tiers.len(), 2, "mains and lower halves: {:?}", found.tiers);
    let main = found.tiers.iter().find(|tier| tier.name == found.main).unwrap();
    for angle in [main.before_deg, main.after_deg] {
        assert!(bench.harness.query_by_label(&format!("{angle:.2}°")).is_some(), "{angle}");
    }
    bench.wait(|editor| match &editor.model.session.dialog {
        Some(Dialog::Retarget(form)) => form.light.is_some(),
        _ => false,
    });
    let light = form(&bench).light.clone().unwrap().unwrap();
    assert_eq!(light.len(), 3);
    for stone in &light {
        let text = format!("{:.2} ± {:.2}", 100.0 * stone.light_return, 100.0 * stone.error);
        assert!(bench.harness.query_all_by_label(&text).next().is_some(), "{text}");
    }
    let design = bench.editor().model.document.work.design.clone();
    let measured =
        brillianteer_render::measure(&design, &brillianteer_render::MeasureOptions::default()).unwrap();
    assert_eq!(light[0].light_return, measured.light_return());
    // With a diamond's margin over the critical angle, sapphire leaks.
    assert!(light[2].leakage > light[1].leakage, "{light:?}");
    bench.click("Apply");
    bench.settle();
    assert_eq!(material(&bench), MaterialRef::Name("sapphire".to_owned()));
    assert_ne!(bench.brilliant(), before);
    bench.choose("Edit", "Undo");
    bench.settle();
    assert_eq!((bench.brilliant(), material(&bench)), (before, first));
    assert!(!bench.editor().model.document.steps().0, "it was one step");
}

#[test]
fn a_factor_is_typed_for_one_side_and_cancelling_changes_nothing() {
    let mut bench = tall();
    let before = bench.editor().model.document.work.clone();
    bench.choose("Design", "Fit to another material…");
    pick(&mut bench, "Rule", "Tangent ratio of the crown");
    bench.type_number("Factor", "0.9");
    let found = form(&bench).found.clone().unwrap();
    let tan = |degrees: f64| degrees.to_radians().tan();
    assert!(found.tiers.len() > 2, "{:?}", found.tiers);
    for tier in found.tiers.iter().filter(|tier| tier.before_deg != 0.0) {
        assert!((tan(tier.after_deg) / tan(tier.before_deg) - 0.9).abs() < 1e-9, "{tier:?}");
    }
    double_click_name(&mut bench, Role::SpinButton, "Factor");
    assert_eq!(form(&bench).options.factor, None, "the rule finds the factor again");
    bench.click("Cancel");
    bench.settle();
    assert!(bench.editor().model.session.dialog.is_none());
    assert_eq!(bench.editor().model.document.work, before);
}

#[test]
fn tiers_with_meets_are_met_anew_after_their_angles_have_turned() {
    let mut bench = tall();
    bench.choose("Edit", "Turn into tiers");
    bench.settle();
    bench.choose("Design", "Fit to another material…");
    pick(&mut bench, "New material", "spinel");
    pick(&mut bench, "Rule", "Critical angle");
    bench.click("Apply");
    bench.settle();
    let Cut::Tiers(now) = bench.editor().model.document.work.design.cut.clone() else { panic!() };
    assert!(now.tiers.iter().any(|tier| tier.meet.is_some()));
    let again = now.solved().tiers;
    let off = now.tiers.iter().zip(&again.tiers).map(|(a, b)| (a.distance - b.distance).abs());
    assert!(off.fold(0.0, f64::max) < 1e-9);
}

#[test]
fn rough_and_weight_give_the_size_and_the_yield() {
    let mut bench = tall();
    bench.choose("Design", "Size and yield…");
    for (name, mm) in [("Rough length", "9"), ("Rough width", "8"), ("Rough depth", "7")] {
        bench.type_number(name, mm);
    }
    let sides = |bench: &Bench| match &bench.editor().model.session.dialog {
        Some(Dialog::Yield(form)) => (form.options.sides_mm, form.first.sides_mm),
        other => panic!("{other:?}"),
    };
    double_click_name(&mut bench, Role::SpinButton, "Rough width");
    let (now, first) = sides(&bench);
    assert_eq!(now, [9.0, first[1], 7.0], "the row is as the dialog began");
    bench.type_number("Rough width", "8");
    let specimen = Arc::clone(bench.editor().model.document.specimen());
    let rough = Rough::new([9.0, 8.0, 7.0]).unwrap();
    let found = Finished::from_rough(&specimen.stone().unwrap().polytope, &rough, None).unwrap();
    assert!((found.diameter_mm - 8.0).abs() < 1e-6, "{found:?}");
    let carats = specimen.material.carats(found.volume_mm3).unwrap();
    let texts = [
        format!("{carats:.3} ct"),
        format!("{:.2} %", 100.0 * found.volume_mm3 / 504.0),
        format!("{:.3} mm", found.depth_left_mm),
    ];
    for text in &texts {
        assert!(bench.harness.query_by_label(text).is_some(), "{text}");
    }
    bench.click("Use this size");
    bench.settle();
    assert!((bench.editor().model.document.work.design.diameter_mm - found.diameter_mm).abs() < 1e-12);
    bench.choose("Design", "Size and yield…");
    pick(&mut bench, "Size by", "Wanted weight");
    bench.type_number("Wanted weight", "2");
    bench.type_number("Rough weight", "5");
    assert!(bench.harness.query_by_label("40.00 %").is_some());
    bench.click("Girdle of its own");
    assert!(bench.harness.query_by_label("Use this size").is_none(), "the girdle is no number of the design");
    bench.click("Girdle of its own");
    bench.click("Use this size");
    bench.settle();
    let carats = bench.editor().model.document.specimen().carats().unwrap();
    assert!((carats - 2.0).abs() < 1e-9, "{carats}");
}
