//! The pictures that the views show, as textures.

use crate::app::model::Model;
use crate::app::studio::{Grade, Shot, Slot, TakenPicture, Which};
use egui::{Color32, Context, Painter, Rect, TextureHandle, TextureOptions, pos2};
use std::collections::HashMap;

/// A picture as it is shown, with the shot and the grade that it answers.
pub struct Shown {
    /// The pixels, on the card.
    pub texture: TextureHandle,
    /// The shot that the picture answers.
    pub shot: Shot,
    pub grade: Grade,
    pub taken: TakenPicture,
}

impl Shown {
    /// Paints the whole picture into a rectangle of the window.
    pub fn paint(&self, painter: &Painter, rect: Rect) {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(self.texture.id(), rect, whole, Color32::WHITE);
    }
}

/// All pictures that are shown.
#[derive(Default)]
pub struct Gallery {
    /// The pictures that were traced.
    pub traced: HashMap<Slot, Shown>,
    /// The pictures that were looked up.
    pub looked: HashMap<Slot, Shown>,
    /// The number of the document that the pictures are of.
    document: u64,
}

impl Gallery {
    /// Returns the picture of a view: looked up where the view shows such a picture, else traced.
    pub fn shown(&self, model: &Model, slot: Slot) -> Option<&Shown> {
        let shows = model.workspace.panes[slot.0].shows;
        match model.is_looked_up(slot.0) {
            true => self.looked.get(&slot).filter(|shown| shown.shot.shows == shows),
            false => self.traced.get(&slot),
        }
    }

    /// Drops the pictures of a document, or of a comparison, that has ended.
    pub fn tidy(&mut self, model: &Model) {
        let is_other = self.document != model.session.begun;
        let is_compared = model.session.compared.is_some();
        self.document = model.session.begun;
        // A pane of liquid glass is no picture of the stone.
        let stays = |which: Which, shown: &Shown| match which {
            Which::Present => !is_other || shown.shot.shows.is_pane(),
            Which::Other => is_compared,
        };
        self.traced.retain(|(_, which), shown| stays(*which, shown));
        self.looked.retain(|(_, which), shown| stays(*which, shown));
    }
}

/// Replaces the picture in a slot.
pub fn hang(
    ctx: &Context,
    pictures: &mut HashMap<Slot, Shown>,
    slot: Slot,
    (shot, grade, taken): (Shot, Grade, TakenPicture),
) {
    let image = taken.image.clone();
    let texture = match pictures.remove(&slot) {
        Some(mut shown) => {
            shown.texture.set(image, TextureOptions::LINEAR);
            shown.texture
        }
        None => ctx.load_texture(format!("{slot:?}"), image, TextureOptions::LINEAR),
    };
    pictures.insert(slot, Shown { texture, shot, grade, taken });
}
