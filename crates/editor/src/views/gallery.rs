//! The pictures that the views show, as textures.

use crate::state_file::BlockSizes;
use brillianteer_session::model::Model;
use brillianteer_session::pixels::Pixels;
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Grade, Shot, Slot, TakenPicture, Which};
use egui::{Color32, ColorImage, Context, Painter, Rect, TextureHandle, TextureOptions, pos2};
use std::collections::HashMap;

/// A picture in a view, with the shot and the grade that it answers.
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

/// All pictures of the views.
#[derive(Default)]
pub struct Gallery {
    /// The pictures that were traced.
    pub traced: HashMap<Slot, Shown>,
    /// The pictures that were looked up.
    pub looked: HashMap<Slot, Shown>,
}

impl Gallery {
    /// Returns the picture of a view: looked up where the view shows such a picture, else traced.
    pub fn shown(&self, model: &Model, slot: Slot) -> Option<&Shown> {
        let shows = model.workspace.panes[slot.0].shows;
        if model.is_looked_up(slot.0) {
            self.looked.get(&slot).filter(|shown| shown.shot.shows == shows)
        } else {
            self.traced.get(&slot)
        }
    }

    /// Returns how much larger than the film's the pixels of the coarsest pictures are.
    pub fn blocks(&self) -> BlockSizes {
        let coarsest = |renders: bool| {
            let own = self.traced.values().filter(|shown| (shown.shot.shows == Shows::Render) == renders);
            let times = own.map(|shown| {
                f64::from(shown.shot.film.size[0]) / shown.texture.size()[0] as f64 * shown.taken.coarser
            });
            times.fold(1.0, f64::max)
        };
        BlockSizes { renders: coarsest(true), others: coarsest(false) }
    }

    /// Drops the pictures of a document, or of a comparison, that has ended. The studio may still answer with such a picture.
    pub fn tidy(&mut self, Model { session, .. }: &Model) {
        let stays = |which: Which, shot: &Shot| match which {
            // A pane of liquid glass is no picture of the stone.
            Which::Present => shot.document == session.begun || shot.shows.is_pane(),
            Which::Other => session.compared.is_some(),
        };
        self.traced.retain(|(_, which), shown| stays(*which, &shown.shot));
        self.looked.retain(|(_, which), shown| stays(*which, &shown.shot));
    }
}

/// Returns a picture as egui takes it, its cover multiplied into the colours.
pub fn texture_image(pixels: &Pixels) -> ColorImage {
    ColorImage::from_rgba_unmultiplied(pixels.size, &pixels.rgba)
}

/// Replaces the picture in a slot.
pub fn hang(
    ctx: &Context,
    pictures: &mut HashMap<Slot, Shown>,
    slot: Slot,
    (shot, grade, taken): (Shot, Grade, TakenPicture),
) {
    let image = texture_image(&taken.image);
    let texture = match pictures.remove(&slot) {
        Some(mut shown) => {
            shown.texture.set(image, TextureOptions::LINEAR);
            shown.texture
        }
        None => ctx.load_texture(format!("{slot:?}"), image, TextureOptions::LINEAR),
    };
    pictures.insert(slot, Shown { texture, shot, grade, taken });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::ViewTools;
    use brillianteer_session::model::{action::FileAction, dialog::Then, update, workspace::Workspace};

    #[test]
    fn a_picture_of_a_document_that_has_ended_is_dropped_whenever_it_comes() {
        let ctx = Context::default();
        let mut model = Model::new(Workspace::default()).unwrap();
        let slot = (1, Which::Present);
        let shot =
            |model: &Model| ViewTools::default().orders(model).shot(1, Which::Present, [64, 32]).unwrap();
        let come = |gallery: &mut Gallery, model: &Model, shot: &Shot| {
            let image = Pixels::opaque([2, 1], &[0; 6]);
            let taken = TakenPicture { image, unresolved: None, tracer: "", coarser: 1.0, map: None };
            hang(&ctx, &mut gallery.traced, slot, (shot.clone(), Grade::Rough, taken));
            gallery.tidy(model);
            gallery.shown(model, slot).is_some()
        };
        let mut gallery = Gallery::default();
        let first = shot(&model);
        assert!(come(&mut gallery, &model, &first));
        update(&mut model, FileAction::Ask(Then::Library("modern-ideal".to_owned())).into());
        gallery.tidy(&model);
        assert!(gallery.shown(&model, slot).is_none());
        assert!(!come(&mut gallery, &model, &first), "it comes after the next document has begun");
        let second = shot(&model);
        assert!(come(&mut gallery, &model, &second));
    }
}
