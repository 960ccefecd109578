//! The table of tiers below the views: a row for each tier, in the order of cutting.
//!
//! A click on a row selects it, and the views outline its facets; a click on a facet there selects its row. The
//! buttons above the table act on the selected tier.

use crate::panels::rows::{ANY, Number, explain, spoken};
use crate::panels::{gear_fields, scale_fields};
use brillianteer_cut::{Cut, FROSTINGS, Tier, TierChange, TierZone, Tiers, read_indices};
use brillianteer_session::model::{
    Model,
    action::{Actions, Edit, ViewAction},
    meet_pick::MeetPick,
};
use egui::{Color32, ComboBox, Id, Panel, Response, RichText, ScrollArea, Sense, TextEdit, Ui, vec2};

/// The least, the first and the greatest height of the table, points.
const HEIGHTS: [f32; 3] = [110.0, 270.0, 560.0];
/// The widths of the columns, points: grip, cut, name, zone, angle, distance, meet, indices, frosting, instructions.
const WIDTHS: [f32; 10] = [34.0, 34.0, 84.0, 88.0, 84.0, 92.0, 278.0, 240.0, 64.0, 200.0];
/// The heads of the columns and their meanings.
const HEADS: [(&str, &str); 10] = [
    ("", "The number of the tier. Drag it to cut the tier earlier or later."),
    ("Cut", "A tier that is not cut stays in the list and makes no facets."),
    ("Name", "The cutters' name of the tier, such as P1, G1, C1 or T."),
    ("Zone", "The part of the stone where the tier lies. Choose another to turn the tier over."),
    ("Angle", "The angle from the girdle plane, in degrees; negative in the pavilion."),
    ("Distance", "The distance from the origin to the facets, in mm at the stone's present size."),
    (
        "Meet",
        "Where the facets go, in cutters' words: Meet P1-G1, Level girdle, Cut to centre point, Meet girdle point. The distance \
         follows, also when an earlier tier changes. Empty for the distance as it is.",
    ),
    ("Indices", "The teeth of the gear at which the tier is cut, joined by dashes."),
    ("Frosting", "The frosting of the facets: 0 is polished, 1 is as rough as possible."),
    ("Instructions", "Further instructions for the cutter."),
];

/// Draws the table where it is open and the design is cut by tiers.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    let Cut::Tiers(tiers) = &model.document.work.design.cut else { return };
    if !model.shows_tiers() {
        return;
    }
    let panel = Panel::bottom("tiers").resizable(true).default_size(HEIGHTS[1]);
    panel.size_range(HEIGHTS[0]..=HEIGHTS[2]).show(ui, |ui| {
        let selected = model.session.tier.filter(|place| *place < tiers.tiers.len());
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| buttons(model, (tiers, selected), actions, ui));
        ScrollArea::both().auto_shrink(false).show(ui, |ui| {
            heads(ui);
            let seen = ui.make_persistent_id("selected row in sight");
            let is_new = ui.data(|data| data.get_temp::<Option<usize>>(seen)).flatten() != selected;
            for (place, called) in tiers.names().iter().enumerate() {
                let row = row(model, tiers, (place, called), actions, ui);
                if is_new && selected == Some(place) {
                    // The table is wider than its window, and keeps its place across.
                    let across = ui.clip_rect().x_range();
                    ui.scroll_to_rect(egui::Rect::from_x_y_ranges(across, row.y_range()), None);
                }
            }
            ui.data_mut(|data| data.insert_temp(seen, selected));
        });
    });
}

/// Draws the buttons that change the list, and the gear.
fn buttons(model: &Model, (tiers, selected): (&Tiers, Option<usize>), actions: &mut Actions, ui: &mut Ui) {
    let add = ui.button("Add tier");
    let meaning =
        "Adds a tier after the selected one. It touches the stone and cuts nothing until it is moved.";
    actions.push_if(explain(ui, add, meaning).clicked(), Edit::AddTier(selected));
    let last = tiers.tiers.len().saturating_sub(1);
    let place = selected.unwrap_or_default();
    let all: [(&str, &str, bool, TierChange); 5] = [
        ("Copy tier", "Puts a copy after the selected tier.", true, TierChange::Copy(place)),
        (
            "Split tier",
            "Makes the second half of the selected tier's facets a tier of its own.",
            selected.is_some_and(|place| tiers.tiers[place].facets.len() > 1),
            TierChange::Split(place),
        ),
        ("Delete tier", "Takes the selected tier out of the list.", last > 0, TierChange::Delete(place)),
        (
            "Earlier",
            "Cuts the selected tier before the one above it.",
            place > 0,
            TierChange::Move(place, place.saturating_sub(1)),
        ),
        (
            "Later",
            "Cuts the selected tier after the one below it.",
            place < last,
            TierChange::Move(place, (place + 1).min(last)),
        ),
    ];
    for (name, meaning, is_possible, change) in all {
        let button = ui.add_enabled(selected.is_some() && is_possible, egui::Button::new(name));
        if explain(ui, button, meaning).clicked() {
            if let TierChange::Move(_, to) = change {
                actions.push(ViewAction::Tier(Some(to)));
            }
            actions.push(Edit::Tiers(change));
        }
    }
    let find = ui.button("Find meets");
    let meaning = "Gives every tier without a meet the one that its instructions state, or else the one that the stone shows: the \
        points through which its facets pass. No tier moves.";
    actions.push_if(explain(ui, find, meaning).clicked(), Edit::Tiers(TierChange::FindMeets));
    next_meets(tiers, selected, actions, ui);
    gear_fields::show(tiers, actions, ui);
    scale_fields::show(model, tiers, actions, ui);
}

/// Draws the buttons that cut the selected tier to the next corner.
fn next_meets(tiers: &Tiers, selected: Option<usize>, actions: &mut Actions, ui: &mut Ui) {
    let is_cut = selected.and_then(|place| tiers.tiers.get(place)).is_some_and(|tier| tier.is_cut);
    for (name, meaning, is_deeper) in [
        ("Out to a meet", "Cuts the selected tier less deep, to the next corner that it reaches.", false),
        ("In to a meet", "Cuts the selected tier deeper, to the next corner that it reaches.", true),
    ] {
        let button = ui.add_enabled(is_cut, egui::Button::new(name));
        if let (true, Some(place)) = (explain(ui, button, meaning).clicked(), selected) {
            actions.push(Edit::NextMeet { place, is_deeper });
        }
    }
}

fn heads(ui: &mut Ui) {
    ui.horizontal(|ui| {
        for ((name, meaning), width) in HEADS.into_iter().zip(WIDTHS) {
            cell(ui, width, |ui| {
                let label = ui.label(RichText::new(name).weak());
                explain(ui, label, meaning)
            });
        }
    });
}

/// Draws the contents of a cell that is as wide as its column.
fn cell<T>(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui) -> T) -> T {
    let size = vec2(width, ui.spacing().interact_size.y);
    let layout = egui::Layout::left_to_right(egui::Align::Center);
    let shown = ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(width);
        contents(ui)
    });
    shown.inner
}

/// Draws the row of a tier, which is called by this name; returns its place.
fn row(
    model: &Model,
    tiers: &Tiers,
    (place, called): (usize, &str),
    actions: &mut Actions,
    ui: &mut Ui,
) -> egui::Rect {
    let tier = &tiers.tiers[place];
    let is_selected = model.session.tier == Some(place);
    let fill =
        if is_selected { ui.visuals().selection.bg_fill.gamma_multiply(0.35) } else { Color32::TRANSPARENT };
    let frame = egui::Frame::new().fill(fill).show(ui, |ui| {
        ui.horizontal(|ui| {
            let grip = cell(ui, WIDTHS[0], |ui| grip(place, called, is_selected, ui));
            actions.push_if(grip.clicked(), ViewAction::Tier(Some(place)));
            let mut is_cut = tier.is_cut;
            let cut = cell(ui, WIDTHS[1], |ui| ui.checkbox(&mut is_cut, ""));
            spoken(&cut, &format!("Cut {called}"));
            actions.push_if(cut.changed(), Edit::Tiers(TierChange::IsCut(place, is_cut)));
            let named = text(ui, WIDTHS[2], (place, "Name", called), called, |text| {
                Some(TierChange::Name(place, text.trim().to_owned()))
            });
            let turned = cell(ui, WIDTHS[3], |ui| zone((place, tier, called), ui));
            named.into_iter().chain(turned).for_each(|change| actions.push(Edit::Tiers(change)));
            setting(model, (place, tier, called), grip.id, actions, ui);
            let meet = meet(model, (place, tiers, called), actions, ui);
            let indices =
                text(ui, WIDTHS[7], (place, "Indices", called), &tier.indices(tiers.gear), |text| {
                    read_indices(text).map(|indices| TierChange::Indices(place, indices))
                });
            let frosting = frosting((place, tier, called), grip.id, ui);
            let instructions =
                text(ui, WIDTHS[9], (place, "Instructions", called), &tier.instructions, |text| {
                    Some(TierChange::Instructions(place, text.to_owned()))
                });
            let changes = [meet, indices, frosting, instructions].into_iter().flatten();
            changes.for_each(|change| actions.push(Edit::Tiers(change)));
        });
    });
    dropped(place, &frame.response, actions, ui);
    frame.response.rect
}

/// Draws the number of a row, by which it is selected and dragged.
fn grip(place: usize, called: &str, is_selected: bool, ui: &mut Ui) -> Response {
    let size = vec2(WIDTHS[0] - 6.0, ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let visuals = ui.style().interact_selectable(&response, is_selected);
    ui.painter().rect_filled(rect, 3.0, visuals.weak_bg_fill);
    let font = egui::TextStyle::Body.resolve(ui.style());
    ui.painter().text(
        rect.center(),
        egui::Align2::CENTER_CENTER,
        (place + 1).to_string(),
        font,
        visuals.text_color(),
    );
    response.dnd_set_drag_payload(place);
    spoken(&response, &format!("Select {called}"));
    explain(ui, response, HEADS[0].1)
}

/// Moves the row that is dropped on this one.
fn dropped(place: usize, row: &Response, actions: &mut Actions, ui: &Ui) {
    if row.dnd_hover_payload::<usize>().is_some() {
        let stroke = ui.visuals().selection.stroke;
        ui.painter().hline(row.rect.x_range(), row.rect.top(), stroke);
    }
    if let Some(from) = row.dnd_release_payload::<usize>().filter(|from| **from != place) {
        actions.push(Edit::Tiers(TierChange::Move(*from, place)));
        actions.push(ViewAction::Tier(Some(place)));
    }
}

/// The angle of a level or vertical tier that the user turns into a leaning one, degrees.
const LEANING: f64 = 40.0;

/// Draws the choice of the zone of a tier; returns the change that turns the tier over.
fn zone((place, tier, called): (usize, &Tier, &str), ui: &mut Ui) -> Option<TierChange> {
    let (now, mut chosen) = (tier.zone(), None);
    let field = ComboBox::from_id_salt(("zone", place)).selected_text(now.name()).width(WIDTHS[3] - 8.0);
    let shown = field.show_ui(ui, |ui| {
        for zone in [TierZone::Pavilion, TierZone::Girdle, TierZone::Crown, TierZone::Table, TierZone::Culet]
        {
            if ui.selectable_label(zone == now, zone.name()).clicked() && zone != now {
                chosen = Some(zone);
            }
        }
    });
    spoken(&shown.response, &format!("Zone of {called}"));
    let leaning = if matches!(tier.angle.abs(), 0.0 | 90.0) { LEANING } else { tier.angle.abs() };
    let angle = match chosen? {
        TierZone::Pavilion => -leaning,
        TierZone::Girdle => 90.0,
        TierZone::Crown => leaning,
        TierZone::Table => 0.0,
        TierZone::Culet => -0.0,
    };
    Some(TierChange::Setting(place, angle, tier.distance.abs()))
}

/// Draws the angle and the distance of a tier; `grip` is the number of its row.
fn setting(
    model: &Model,
    (place, tier, called): (usize, &Tier, &str),
    grip: Id,
    actions: &mut Actions,
    ui: &mut Ui,
) {
    let document = &model.document;
    let unit_mm = document.specimen().design_unit_mm();
    let (mut angle, mut distance_mm) = (tier.angle, tier.distance * unit_mm);
    let before_mm = distance_mm;
    let number =
        |ui: &mut Ui, value: &mut f64, column: usize, (decimals, speed, unit): (usize, f64, &str)| {
            let width = WIDTHS[column];
            cell(ui, width, |ui| {
                let shown = Number { decimals, speed, range: ANY, unit, default: None }.show(
                    ui,
                    (width - 8.0, grip),
                    value,
                );
                spoken(&shown, &format!("{} of {called}", HEADS[column].0));
            });
        };
    number(ui, &mut angle, 4, (2, 0.02, "°"));
    number(ui, &mut distance_mm, 5, (3, 0.002, " mm"));
    // A distance that the user does not touch keeps all its digits.
    let distance = if distance_mm == before_mm { tier.distance } else { distance_mm / unit_mm };
    // The table and the culet are level; other tiers keep their side where no sign is typed.
    let is_level = matches!(tier.zone(), TierZone::Table | TierZone::Culet);
    let angle = if is_level { angle } else { angle.abs().copysign(tier.angle) };
    let is_changed = (angle, distance) != (tier.angle, tier.distance);
    let is_possible = (-180.0..=180.0).contains(&angle) && distance.is_finite();
    actions.push_if(is_changed && is_possible, Edit::Tiers(TierChange::Setting(place, angle, distance)));
}

/// Draws the field for the frosting of a tier; `grip` is the number of its row.
fn frosting((place, tier, called): (usize, &Tier, &str), grip: Id, ui: &mut Ui) -> Option<TierChange> {
    let (mut frosting, width) = (tier.frosting, WIDTHS[8]);
    cell(ui, width, |ui| {
        let number = Number { decimals: 2, speed: 0.005, range: FROSTINGS, unit: "", default: None };
        let shown = number.show(ui, (width - 8.0, grip), &mut frosting);
        spoken(&shown, &format!("Frosting of {called}"));
    });
    (frosting != tier.frosting && FROSTINGS.contains(&frosting))
        .then_some(TierChange::Frosting(place, frosting))
}

/// Draws the field for the meet of a tier with the button that picks it in a view, and marks one that could not be followed.
fn meet(
    model: &Model,
    (place, tiers, called): (usize, &Tiers, &str),
    actions: &mut Actions,
    ui: &mut Ui,
) -> Option<TierChange> {
    let own = tiers.tiers[place].meet.as_ref().map(ToString::to_string).unwrap_or_default();
    let fault = model.session.meet_faults.get(place).and_then(Option::as_ref);
    let left = ui.cursor().left();
    let picks: f32 = PICKS.iter().map(|pick| pick.width + ui.spacing().item_spacing.x).sum();
    let width = WIDTHS[6] - picks;
    let changed = text(ui, width, (place, "Meet", called), &own, |text| match text.trim() {
        "" => Some(TierChange::Meet(place, None)),
        text => tiers.meet_in_words(place, text).map(|meet| TierChange::Meet(place, Some(meet))),
    });
    if let Some(fault) = fault {
        let (row, colour) = (ui.max_rect(), ui.visuals().error_fg_color);
        let cell = egui::Rect::from_x_y_ranges(left..=left + width - 8.0, row.y_range());
        ui.painter().rect_stroke(cell, 3.0, egui::Stroke::new(1.0, colour), egui::StrokeKind::Inside);
        let under = ui.interact(cell, ui.scope_id().with(("fault", place)), Sense::hover());
        let said = format!("The meet of {called} cannot be followed: {fault}");
        spoken(&under, &said);
        under.on_hover_text(said);
    }
    for (kind, wanted) in PICKS.iter().zip(1..) {
        let is_picked = model.meet_pick().is_some_and(|pick| pick.place == place && pick.wanted == wanted);
        let is_cut = tiers.tiers[place].is_cut;
        let label = |ui: &mut Ui| ui.selectable_label(is_picked, kind.label);
        let pick = cell(ui, kind.width, |ui| ui.add_enabled_ui(is_cut, label).inner);
        spoken(&pick, &format!("{} of {called}", kind.name));
        let pick = explain(ui, pick, kind.meaning);
        let next = (!is_picked).then(|| MeetPick::new(place, wanted));
        actions.push_if(pick.clicked(), ViewAction::PickMeet(next));
    }
    changed
}

/// A button that begins a pick of corners.
struct PickButton {
    label: &'static str,
    name: &'static str,
    meaning: &'static str,
    /// The width, points.
    width: f32,
}

/// The buttons beside a meet: for one, two and three corners.
const PICKS: [PickButton; 3] = [
    PickButton {
        label: "Pick",
        name: "Pick meet",
        meaning: "Shows the corners that the tier can be cut to. Click one in a view to meet it.",
        width: 36.0,
    },
    PickButton {
        label: "2",
        name: "Pick two points",
        meaning: "Shows the corners of the stone. Click two in a view: the tier passes through both, and its angle follows.",
        width: 18.0,
    },
    PickButton {
        label: "3",
        name: "Pick three points",
        meaning: "Shows the corners of the stone. Click three in a view: the tier passes through all, and its angle and index follow.",
        width: 18.0,
    },
];

/// Draws a field for a text of a tier; returns the change that the text describes once the user leaves the field or
/// presses Return.
///
/// A text that describes no change is red while it is typed, and dropped afterwards.
fn text(
    ui: &mut Ui,
    width: f32,
    (place, column, called): (usize, &str, &str),
    own: &str,
    change: impl Fn(&str) -> Option<TierChange>,
) -> Option<TierChange> {
    cell(ui, width, |ui| {
        let id = ui.make_persistent_id((column, place));
        let typed = id.with("typed");
        let mut text = ui.data(|data| data.get_temp::<String>(typed)).unwrap_or_else(|| own.to_owned());
        let means_nothing = change(&text).is_none();
        let mut field = TextEdit::singleline(&mut text).id(id).desired_width(width - 8.0);
        if means_nothing {
            field = field.text_color(ui.visuals().error_fg_color);
        }
        let shown = ui.add(field);
        spoken(&shown, &format!("{column} of {called}"));
        if shown.has_focus() {
            ui.data_mut(|data| data.insert_temp(typed, text.clone()));
        } else {
            ui.data_mut(|data| data.remove_temp::<String>(typed));
        }
        change(&text).filter(|_| shown.lost_focus() && text != own)
    })
}
