//! The About dialog: the program's version, its licences, and the crates it is built of.

use super::answers::{answer, body, buttons};
use crate::icon::icon;
use crate::scrolled::follow_focus;
use brillianteer_session::model::{
    action::{Actions, DialogAction, FileAction},
    dialog::{AboutForm, AboutPage},
};
use egui::{
    ColorImage, Grid, Id, Label, RichText, ScrollArea, TextEdit, TextureHandle, TextureOptions, Ui, vec2,
};

/// The program's own licences: the name and the text of each.
const LICENCES: [(&str, &str); 2] = [
    ("MIT", include_str!("../../../../LICENSE-MIT")),
    ("Apache-2.0", include_str!("../../../../LICENSE-APACHE")),
];

/// The crates that the program is built of: name, version, licence and address between tabs. `cargo run -p xtask -- crates`
/// writes the list, and a test holds it current.
const CRATES: &str = include_str!("../../../../assets/crates.tsv");

/// The greatest height of lists and texts, points; a low window gives them less.
const LIST: f32 = 300.0;

/// A crate that the program is built of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Crate<'a> {
    pub name: &'a str,
    pub version: &'a str,
    /// The licence of the crate, as the crate states it.
    pub licence: &'a str,
    /// The address where the crate is found; empty where the crate states none.
    pub link: &'a str,
}

/// Returns all crates of the list.
pub fn crates() -> impl Iterator<Item = Crate<'static>> {
    CRATES.lines().filter_map(|line| {
        let mut cells = line.split('\t');
        let mut next = || cells.next();
        Some(Crate { name: next()?, version: next()?, licence: next()?, link: next()? })
    })
}

/// Draws the dialog.
pub fn show(about: &AboutForm, actions: &mut Actions, ui: &mut Ui) {
    body(ui, 560.0, |ui| {
        head(actions, ui);
        ui.separator();
        let mut page = about.page;
        ui.horizontal_wrapped(|ui| {
            ui.selectable_value(&mut page, AboutPage::Crates, "Built with");
            for (k, (name, _)) in LICENCES.iter().enumerate() {
                ui.selectable_value(&mut page, AboutPage::Licence(k), format!("Licence {name}"));
            }
        });
        actions.push_changed(&about.page, page, DialogAction::AboutPage);
        let height = (ui.ctx().content_rect().height() - 300.0).clamp(120.0, LIST);
        match about.page {
            AboutPage::Crates => list(actions, ui, &about.sought, height),
            AboutPage::Licence(k) => {
                let area = ScrollArea::vertical().id_salt(("licence", k)).max_height(height);
                area.auto_shrink(false).show(ui, |ui| ui.label(RichText::new(LICENCES[k].1).small()));
            }
        }
    });
    answer(actions, [DialogAction::Leave], buttons(ui, &["Close"]));
}

/// Draws the icon, the name and the licences of the program.
fn head(actions: &mut Actions, ui: &mut Ui) {
    ui.horizontal(|ui| {
        if let Some(texture) = texture(ui) {
            ui.image((texture.id(), vec2(72.0, 72.0)));
        }
        ui.vertical(|ui| {
            ui.heading(format!("Brillianteer {}", env!("CARGO_PKG_VERSION")));
            ui.label(env!("CARGO_PKG_DESCRIPTION"));
            ui.label(RichText::new("Licensed under MIT or Apache-2.0, as you choose.").weak());
            let home = env!("CARGO_PKG_REPOSITORY");
            if !home.is_empty() {
                link(actions, ui, home, home);
            }
        });
    });
}

/// Returns the program's icon, which is drawn once.
fn texture(ui: &Ui) -> Option<TextureHandle> {
    let id = Id::unique("program icon");
    ui.data(|data| data.get_temp(id)).or_else(|| {
        let icon = icon()?;
        let size = [icon.width as usize, icon.height as usize];
        let image = ColorImage::from_rgba_unmultiplied(size, &icon.rgba);
        let texture = ui.ctx().load_texture("icon", image, TextureOptions::LINEAR);
        ui.data_mut(|data| data.insert_temp(id, texture.clone()));
        Some(texture)
    })
}

fn list(actions: &mut Actions, ui: &mut Ui, sought: &str, height: f32) {
    let seek = sought.to_lowercase();
    let found: Vec<Crate> =
        crates().filter(|c| c.name.contains(&seek) || c.licence.to_lowercase().contains(&seek)).collect();
    ui.horizontal(|ui| {
        let label = ui.label("Find");
        let mut text = sought.to_owned();
        let field = ui.add(TextEdit::singleline(&mut text).desired_width(180.0)).labelled_by(label.id);
        actions.push_if(field.changed(), DialogAction::AboutSearch(text));
        ui.label(RichText::new(format!("{} of {} crates", found.len(), crates().count())).weak());
    });
    ScrollArea::vertical().id_salt("crates").max_height(height).auto_shrink(false).show(ui, |ui| {
        // Long licences are wrapped: a list wider than the window would widen it past the rule under its head.
        Grid::new("crates").num_columns(2).striped(true).show(ui, |ui| {
            for Crate { name, version, licence, link: address } in found {
                let text = format!("{name} {version}");
                if address.is_empty() {
                    drop(ui.label(text))
                } else {
                    link(actions, ui, &text, address)
                }
                ui.add(Label::new(licence).wrap());
                ui.end_row();
            }
        });
        follow_focus(ui);
    });
}

/// Draws a link that the system opens.
fn link(actions: &mut Actions, ui: &mut Ui, text: &str, address: &str) {
    if ui.link(text).on_hover_text(address).clicked() {
        actions.push(FileAction::OpenOutside(address.to_owned()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::Setup;
    use crate::tests::Bench;
    use egui::{Rect, Shape};
    use egui_kittest::kittest::Queryable;

    /// Collects the filled rectangles of a shape, and its horizontal lines.
    fn gather(shape: &Shape, rectangles: &mut Vec<Rect>, rules: &mut Vec<Rect>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather(shape, rectangles, rules)),
            // A blurred rectangle is a shadow.
            Shape::Rect(rectangle) if rectangle.blur_width == 0.0 => rectangles.push(rectangle.rect),
            Shape::LineSegment { points: [a, b], .. } if a.y == b.y => {
                rules.push(Rect::from_two_pos(*a, *b));
            }
            _ => {}
        }
    }

    #[test]
    fn the_rule_under_the_head_is_as_wide_as_the_window() {
        let mut bench = Bench::sized(Setup::default(), vec2(1000.0, 800.0));
        bench.choose("Help", "About Brillianteer");
        bench.harness.run_steps(3);
        let (mut rectangles, mut rules) = (vec![], vec![]);
        for clipped in &bench.harness.output().shapes {
            gather(&clipped.shape, &mut rectangles, &mut rules);
        }
        let head = bench.harness.get_by_label_contains("Licensed under MIT").rect();
        let is_below = |rule: &&Rect| (0.0..40.0).contains(&(rule.top() - head.bottom()));
        let rule = rules.iter().filter(is_below).max_by(|a, b| a.width().total_cmp(&b.width())).unwrap();
        // The window is the smallest rectangle that holds head, rule and button.
        let button = bench.harness.get_by_label("Close").rect();
        let whole = head.union(*rule).union(button);
        let windows = rectangles.iter().filter(|r| r.contains_rect(whole));
        let window = windows.min_by(|a, b| a.area().total_cmp(&b.area())).unwrap();
        let gaps = [rule.left() - window.left(), window.right() - rule.right()];
        assert!((gaps[0] - gaps[1]).abs() < 2.0, "{rule:?} in {window:?}");
    }

    #[test]
    fn the_crates_of_the_list_are_read() {
        let egui = crates().find(|c| c.name == "egui").unwrap();
        assert!(egui.licence.contains("MIT") && egui.link.starts_with("https://"), "{egui:?}");
        assert!(crates().count() > 200);
    }
}
