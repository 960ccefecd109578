//! Makes the requests for pictures in sight that are looked up or drawn, and not traced.

use super::tools::ViewTools;
use brillianteer_session::model::{Model, ordering::Seen};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Grade, Slot, Which, backdrop};
use brillianteer_session::tasks::lookup::LookupRequest;

/// Returns a request for each picture in sight that is looked up or drawn.
pub fn look_ups(model: &Model, tools: &mut ViewTools, seen: &[Seen]) -> Vec<(Slot, LookupRequest)> {
    let mut requests = vec![];
    for &(pane, size) in seen {
        for slot in [(pane, Which::Present), (pane, Which::Other)] {
            let request = match model.workspace.panes[pane].shows {
                Shows::LiquidGlass => liquid(model, tools, slot, size),
                Shows::Refraction => refracted(model, tools, slot),
                _ => None,
            };
            requests.extend(request.map(|request| (slot, request)));
        }
    }
    requests
}

/// Requests the pane of liquid glass as screens draw it.
fn liquid(
    model: &Model,
    tools: &mut ViewTools,
    (pane, which): Slot,
    size: [u32; 2],
) -> Option<LookupRequest> {
    let shot = tools.orders(model).shot(pane, which, size)?;
    let behind = backdrop(shot.look.background.as_ref());
    Some(LookupRequest { shot, grade: Grade::Fine, map: None, behind })
}

/// Requests the background behind a stone, once there is a map of the stone.
fn refracted(model: &Model, tools: &ViewTools, slot: Slot) -> Option<LookupRequest> {
    let shown = tools.gallery.traced.get(&slot)?;
    let map = shown.taken.map.clone()?;
    let behind = backdrop(model.document.work.settings.look.background_at_hand());
    let moved = model.session.flowing[slot.0].moved;
    Some(LookupRequest { shot: shown.shot.clone(), grade: shown.grade, map: Some((map, moved)), behind })
}
