//! Makes the orders of pictures and figures for everything in sight, from the model.

use super::Model;
use super::motion::WaveCache;
use crate::shows::Shows;
use crate::studio::{FiguresOrder, Order, Paper, Shot, SweepOrder, Which};
use brillianteer_picture::DrawnMarks;
use brillianteer_scene::{Companions, Look, Pose, Side, Smoothing, Specimen, View};
use std::sync::Arc;

/// A view in sight, and the size of its picture in pixels.
pub type Seen = (usize, [u32; 2]);

/// Makes the orders of a model's pictures.
pub struct Orders<'a> {
    /// The state of the editor.
    pub model: &'a Model,
    /// The phases of waving plates that were made for earlier orders.
    pub waves: &'a mut WaveCache,
    /// The paper colour of drawings.
    pub paper: Paper,
}

impl Orders<'_> {
    /// Returns the order of all that is in sight.
    pub fn all(&mut self, seen: &[Seen]) -> Order {
        let mut order = Order::default();
        // The views are about to change: the file that is being read needs the processor more.
        let mut opening = self.model.session.awaited.opening.iter();
        if opening.any(|opening| !opening.request.is_beside() && opening.read.is_none()) {
            return order;
        }
        let is_compared = self.model.session.compared.is_some();
        for which in [Which::Present, Which::Other].into_iter().take(1 + usize::from(is_compared)) {
            for &(pane, size) in seen {
                // Liquid glass is drawn by a task of its own, and not by the studio.
                let is_drawn = self.model.workspace.panes[pane].shows == Shows::LiquidGlass;
                if let Some(shot) = self.shot(pane, which, size).filter(|_| !is_drawn) {
                    order.shots.push(((pane, which), shot));
                }
            }
            self.figures(which, &mut order);
        }
        order.sweeps = self.sweeps();
        order
    }

    /// Returns the sweeps whose plots are in sight; that of the map comes first.
    fn sweeps(&self) -> Vec<SweepOrder> {
        let session = &self.model.session;
        let has_stone = self.model.document.specimen().stone().is_ok();
        let map = session.map.sweep.wanted().filter(|_| has_stone && self.model.shows_map());
        map.into_iter().chain(session.tilt.sweep.wanted()).cloned().collect()
    }

    fn figures(&mut self, which: Which, order: &mut Order) {
        let eye = self.model.workspace.eye;
        let view = eye.view(Some(Side::Table));
        let Some(specimen) = self.model.stone(which) else { return };
        let document = self.model.session.begun;
        let figures = FiguresOrder {
            document,
            specimen,
            view,
            head: self.model.document.work.settings.look.head_of_scopes(),
        };
        if which == Which::Present {
            order.tilts = Some(FiguresOrder { view: View { tilt: 0.0, ..view }, ..figures.clone() });
        }
        order.figures.push((which, figures));
    }

    /// Returns the shot of a view; `None` where the studio does not make its picture, or where the picture is too
    /// small.
    pub fn shot(&mut self, pane: usize, which: Which, size: [u32; 2]) -> Option<Shot> {
        let Model { document, workspace, session } = self.model;
        let settings = &document.work.settings;
        let shows = workspace.panes[pane].shows;
        let is_other_pane = shows.is_pane() && which == Which::Other;
        if shows == Shows::Profile || is_other_pane || size[0] < 8 || size[1] < 8 {
            return None;
        }
        let eye = *workspace.eye(pane);
        let view = self.model.view(pane);
        let fit = self.model.fit(shows, &view);
        let specimen = self.model.stone(which)?;
        if shows.needs_facets() && specimen.stone().is_err() {
            return None;
        }
        let (specimen, copies) = if shows.has_copies() {
            self.model.copies(which, self.waves)?
        } else {
            (specimen, vec![Pose::STILL])
        };
        let companions = if shows.has_copies() { self.model.companions() } else { Companions::default() };
        let plain = self.plain(shows, view, specimen);
        Some(Shot {
            film: eye.film(size, &fit),
            whole: fit.whole(size),
            // Renders show three bands while the key for a comparison with three bands is held.
            look: Look {
                wavelengths: if session.keys.three { 3 } else { settings.look.wavelengths },
                smoothing: settings.look.smoothing,
                ..plain.look
            },
            jitter: !session.keys.three,
            overlay: workspace.overlay().filter(|_| shows.takes_overlay()),
            paper: self.paper,
            marks: match (shows, which) {
                (Shows::Diagram, Which::Present) => self.model.found_marks(),
                _ => DrawnMarks::default(),
            },
            copies,
            companions,
            ..plain
        })
    }

    /// Returns the shot of a render of all copies and companions in a view.
    pub fn render(&mut self, view: View) -> Shot {
        let alone = (Arc::clone(self.model.document.specimen()), vec![Pose::STILL]);
        let (specimen, copies) = self.model.copies(Which::Present, self.waves).unwrap_or(alone);
        let fit = self.model.fit(Shows::Render, &view);
        let plain = self.plain(Shows::Render, view, specimen);
        let companions = self.model.companions();
        Shot { film: fit.film([1, 1]), whole: fit.whole([1, 1]), copies, companions, ..plain }
    }

    /// Returns a shot of one stone at rest, with the light and the backplate of the model.
    fn plain(&self, shows: Shows, view: View, specimen: Arc<Specimen>) -> Shot {
        let Model { document, workspace, session } = self.model;
        let settings = &document.work.settings;
        let fit = super::framing_fit::FramingFit::reaching(1.0);
        Shot {
            document: session.begun,
            marks: DrawnMarks::default(),
            specimen,
            title: document.name().to_owned(),
            shows,
            strongest: workspace.strongest,
            glare: workspace.glare(),
            view,
            film: fit.film([1, 1]),
            whole: fit.whole([1, 1]),
            light: session.light.at_hand.clone(),
            // Smoothing is for the window alone. The light of the document may still be on its way.
            look: Look {
                light: session.light.name.clone(),
                background: settings.look.background_at_hand().cloned(),
                strength: settings.strength(),
                smoothing: Smoothing::None,
                ..settings.look.clone()
            },
            jitter: true,
            copies: vec![Pose::STILL],
            companions: Companions::default(),
            overlay: None,
            liquid: self.model.liquid(),
            paper: Paper::default(),
        }
    }
}
