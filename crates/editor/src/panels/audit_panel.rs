//! The list of the audit below the views: places of the stone that its designer may not have meant.
//!
//! A click on a row selects it: the views outline its facets and mark its corners.

use crate::panels::rows::explain;
use brillianteer_cut::{Audit, Finding, FindingKind};
use brillianteer_math::fixed;
use brillianteer_session::model::{
    Model,
    action::{Actions, ViewAction},
};
use egui::{Button, Panel, RichText, ScrollArea, Ui};
use glam::DVec3;

/// The least, the first and the greatest height of the list, points.
const HEIGHTS: [f32; 3] = [90.0, 190.0, 480.0];

/// The most names of facets in a row; a longer list says how many more there are.
const MOST_NAMES: usize = 8;

/// A place nearer to the axis than this, mm, has no azimuth.
const ON_AXIS_MM: f64 = 5e-4;

/// The explanation of the place in a row.
const PLACE: &str = "Angles are counted counter-clockwise from the right as seen from above the table; heights from the \
    origin of the design.";

/// Draws the list where it is open.
pub fn show(model: &Model, actions: &mut Actions, ui: &mut Ui) {
    if !model.shows_audit() {
        return;
    }
    let panel = Panel::bottom("audit").resizable(true).default_size(HEIGHTS[1]);
    panel.size_range(HEIGHTS[0]..=HEIGHTS[2]).show(ui, |ui| {
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("Audit").strong());
            ui.label(RichText::new(summary(model)).weak());
        });
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if let (Ok(_), Some(audit)) = (model.document.specimen().stone(), &model.session.audit.found) {
                rows(model, audit, actions, ui);
            }
        });
    });
}

/// Returns how many findings there are, or why there can be none.
fn summary(model: &Model) -> String {
    let document = &model.document;
    if let Some(why) = document.specimen().why_not_convex() {
        return format!("Only a convex stone between planes can be audited, and {why}.");
    }
    let Some(audit) = &model.session.audit.found else { return "The audit is under way…".to_owned() };
    let found = match audit.findings.len() {
        0 => "No candidates: the audit found no place that its designer may not have meant.".to_owned(),
        1 => {
            "1 candidate; whether it is a fault is for you to judge. W is the width of the stone.".to_owned()
        }
        count => format!(
            "{count} candidates; whether one is a fault is for you to judge. W is the width of the stone."
        ),
    };
    if document.shows_last_possible() {
        format!("{found} The design makes no stone now; the list is about the last stone.")
    } else {
        found
    }
}

/// Draws the findings, those of one kind under a heading.
fn rows(model: &Model, audit: &Audit, actions: &mut Actions, ui: &mut Ui) {
    for kind in FindingKind::ALL {
        let count = audit.of_kind(kind).count();
        let Some(first) = audit.of_kind(kind).next() else { continue };
        let limit = first.limit_text().map(|limit| format!(", {limit}")).unwrap_or_default();
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(format!("{} ({count}{limit})", capitalised(kind.name()))).strong());
            ui.label(RichText::new(kind.meaning()).weak());
        });
        let all = audit.findings.iter().enumerate();
        for (place, finding) in all.filter(|(_, finding)| finding.kind == kind) {
            let is_selected = model.session.audit.selected == Some(place);
            let text = sentence(finding, model.document.specimen().unit_mm());
            let row = ui.add(Button::selectable(is_selected, text).truncate());
            let now = (!is_selected).then_some(place);
            actions.push_if(explain(ui, row, PLACE).clicked(), ViewAction::Finding(now));
        }
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// Describes a finding: its facets, size and place. `unit_mm` is the unit of the stone's frame in mm.
fn sentence(finding: &Finding, unit_mm: f64) -> String {
    let what = match finding.kind {
        FindingKind::NearMiss => "a gap of ",
        FindingKind::SplitMeet => "an edge of ",
        FindingKind::SmallFacet => "an area of ",
        FindingKind::ThinFacet => "a width of ",
        FindingKind::BelowCritical => "an angle of ",
        FindingKind::UnevenGirdle => "heights that differ by ",
        FindingKind::Outline | FindingKind::Symmetry => "off by ",
        FindingKind::StatedSymmetry => "kept by ",
        FindingKind::UnusedPlane => "",
    };
    let mut text = format!("{}: {what}{}", names(&finding.facets), finding.size_text());
    // The two corners of a meet that is not made lie close to each other; other findings have places apart.
    let (at, more) = match (finding.kind, &finding.points[..]) {
        (_, []) => return text,
        (FindingKind::NearMiss | FindingKind::SplitMeet, points) => {
            (points.iter().sum::<DVec3>() / points.len() as f64, 0)
        }
        (_, [first, rest @ ..]) => (*first, rest.len()),
    };
    text += &place(at * unit_mm);
    match more {
        0 => {}
        1 => text += ", and 1 more place",
        more => text += &format!(", and {more} more places"),
    }
    text
}

/// Returns the first names of a list of facets, and how many more there are.
fn names(facets: &[String]) -> String {
    let shown = facets.iter().take(MOST_NAMES).map(String::as_str).collect::<Vec<_>>().join(", ");
    match facets.len().saturating_sub(MOST_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Describes where a point of the stone lies, in mm and degrees.
fn place(at: DVec3) -> String {
    let out = at.truncate().length();
    let height = fixed(at.z, 2);
    if out < ON_AXIS_MM {
        return format!(", on the axis at height {height} mm");
    }
    let azimuth = (10.0 * at.y.atan2(at.x).to_degrees().rem_euclid(360.0)).round() / 10.0 % 360.0;
    format!(", at {azimuth:.1}°, {} mm from the axis, height {height} mm", fixed(out, 2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use brillianteer_cut::FindingUnit;

    #[test]
    fn a_finding_is_a_sentence_with_its_facets_its_size_and_its_place() {
        let point = DVec3::new(0.0, 0.5, 0.1);
        let facets: Vec<String> = (1..=10).map(|k| format!("C{k}")).collect();
        let mut finding = Finding {
            kind: FindingKind::SplitMeet,
            points: vec![point, point],
            facets,
            size: 0.616,
            threshold: 12.0,
            unit: FindingUnit::PercentOfWidth,
        };
        assert_eq!(
            sentence(&finding, 3.0),
            "C1, C2, C3, C4, C5, C6, C7, C8 and 2 more: an edge of 0.62 % of W, at 90.0°, 1.50 mm from the axis, \
             height 0.30 mm"
        );
        finding.facets.truncate(1);
        finding.kind = FindingKind::BelowCritical;
        assert!(sentence(&finding, 3.0).ends_with("height 0.30 mm, and 1 more place"));
        finding.points.clear();
        assert!(sentence(&finding, 3.0).ends_with("% of W"));
        // A whole turn is no turn, and nothing is -0.
        assert_eq!(place(DVec3::new(1.0, -1e-9, -1e-9)), ", at 0.0°, 1.00 mm from the axis, height 0.00 mm");
        assert_eq!(place(DVec3::new(0.0, 0.0, -2.0)), ", on the axis at height -2.00 mm");
    }
}
