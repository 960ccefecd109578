//! Orders pictures and figures of all that is in sight from the studio.

use crate::app::editor::Editor;
use crate::app::model::framing::FramingFit;
use crate::app::shows::Shows;
use crate::app::studio::{BEHIND, FiguresOrder, Order, Paper, Shot, Smoothing, Which};
use crate::io::lighting::Lighting;
use crate::scene::{Copies, Pose, Side, Specimen, View};
use std::sync::Arc;

impl Editor {
    /// Orders from the studio all that is in sight.
    pub(crate) fn order(&mut self, seen: &[(usize, [u32; 2])]) {
        // What is in sight is about to go: the file that is being opened needs the processor more.
        if self.opening.iter().any(|opening| !opening.is_beside()) {
            return self.studio.order(Order::default());
        }
        let light = self.light();
        let mut order = Order::default();
        let compared = self.compared.is_some();
        let sides = if compared { vec![Which::Present, Which::Other] } else { vec![Which::Present] };
        for which in sides {
            for &(pane, size) in seen {
                // Liquid glass is looked up, and not traced.
                let is_drawn = self.desk.panes[pane].shows == Shows::LiquidGlass;
                if let Some(shot) = self.shot(pane, which, size, &light).filter(|_| !is_drawn) {
                    order.shots.push(((pane, which), shot));
                }
            }
            let eye = self.desk.eye;
            let view = eye.view(Some(Side::Table));
            if let Some(specimen) = self.specimen(which, eye.turn) {
                let ask = FiguresOrder { specimen, view, head: self.document.work.head };
                if which == Which::Present {
                    order.tilts = Some(FiguresOrder { view: View { tilt: 0.0, ..view }, ..ask.clone() });
                }
                order.figures.push((which, ask));
            }
        }
        self.asked = order.clone();
        self.studio.order(order);
    }

    /// Returns the number of bands of wavelengths of renders: three while they are compared with what three bands show.
    fn bands(&self) -> u32 {
        if self.shows_three { 3 } else { self.desk.wavelengths }
    }

    pub(crate) fn specimen(&mut self, which: Which, turn: f64) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(self.posed(turn)),
            Which::Other => self.compared.as_mut().map(|c| c.posed(turn)),
        }
    }

    pub(crate) fn shot(
        &mut self,
        pane: usize,
        which: Which,
        size: [u32; 2],
        light: &Arc<Lighting>,
    ) -> Option<Shot> {
        let shows = self.desk.panes[pane].shows;
        let is_other_pane = shows.is_pane() && which == Which::Other;
        if shows == Shows::Profile || is_other_pane || size[0] < 8 || size[1] < 8 {
            return None;
        }
        let eye = *self.desk.eye(pane);
        let view = self.desk.view(pane);
        let fit = self.fit(shows, (eye.turn, &view));
        // A diagram has an index of its own, so it does not follow the stone's turn.
        let turn = if shows == Shows::Diagram { 0.0 } else { eye.turn };
        let specimen = self.specimen(which, turn)?;
        if shows == Shows::Diagram && specimen.stone().is_err() {
            return None;
        }
        let (specimen, company) = match shows.has_company() {
            true => self.company(which, eye.turn)?,
            false => (specimen, vec![Pose::STILL]),
        };
        let work = &self.document.work;
        Some(Shot {
            film: eye.film(size, &fit),
            whole: fit.whole(size),
            view,
            title: self.document.work.design.name.clone(),
            shows,
            strongest: self.desk.strongest,
            glare: self.desk.glare(),
            light: Arc::clone(light),
            exposure: work.exposure,
            bands: self.bands(),
            jitter: !self.shows_three,
            behind: self.desk.background(),
            distance: self.distance(),
            strength: self.desk.strength(),
            company,
            smoothing: self.desk.smoothing,
            head: self.document.work.head,
            overlay: self.desk.overlay().filter(|_| shows.takes_overlay()),
            liquid: self.desk.liquid,
            paper: self.paper,
            specimen,
        })
    }

    /// Returns what a render shows: the stone, and the poses of its copies.
    fn company(&mut self, which: Which, turn: f64) -> Option<(Arc<Specimen>, Vec<Pose>)> {
        let company = &self.document.work.company;
        if *company == Copies::default() && self.moving.seconds == 0.0 {
            return Some((self.specimen(which, turn)?, vec![Pose::STILL]));
        }
        let specimen = match which {
            Which::Present => self.document.specimen(),
            Which::Other => &self.compared.as_ref()?.specimen,
        };
        Some(self.moving.now(specimen, company, turn))
    }

    /// Returns what a view takes in whose stone is turned by `turn`, radians: the stone that views are fitted to, or all
    /// copies.
    pub(crate) fn fit(&self, shows: Shows, (turn, view): (f64, &View)) -> FramingFit {
        let is_alone = self.document.work.company == Copies::default();
        match shows.has_company() && !(is_alone && self.moving.seconds == 0.0) {
            true => FramingFit::reaching(self.reach(shows)),
            false => self.framing.fit(turn, view),
        }
    }

    /// Returns how far a view's picture reaches from its middle, girdle radii.
    ///
    /// Both designs are shown on one scale, that of the present design.
    pub(crate) fn reach(&self, shows: Shows) -> f64 {
        let Specimen { reach, radius, .. } = **self.document.specimen();
        if !shows.has_company() {
            return reach;
        }
        let company = &self.document.work.company;
        match self.moving.tumbles(self.document.specimen()) {
            // A stone that tumbles shows all its sides.
            true => company
                .poses
                .iter()
                .map(|p| p.at.truncate().abs().max_element() + radius)
                .fold(company.reach(radius), f64::max),
            false => company.reach(reach),
        }
    }

    /// Returns how far behind the middle the backplate hangs, girdle radii.
    fn distance(&self) -> f64 {
        self.desk.behind_mm.map_or(BEHIND, |mm| mm / self.document.specimen().unit_mm())
    }

    /// Returns what a render shows in a view, with the stone turned by `turn`, radians.
    pub(crate) fn render_shot(&mut self, view: View, turn: f64) -> Shot {
        let light = self.light();
        let (specimen, company) =
            self.company(Which::Present, turn).unwrap_or((self.posed(turn), vec![Pose::STILL]));
        let fit = self.fit(Shows::Render, (turn, &view));
        Shot {
            specimen,
            title: self.document.work.design.name.clone(),
            shows: Shows::Render,
            strongest: self.desk.strongest,
            glare: self.desk.glare(),
            view,
            film: fit.film([1, 1]),
            whole: fit.whole([1, 1]),
            light,
            exposure: self.document.work.exposure,
            bands: self.desk.wavelengths,
            jitter: true,
            behind: self.desk.background(),
            distance: self.distance(),
            strength: self.desk.strength(),
            company,
            smoothing: Smoothing::None,
            head: self.document.work.head,
            overlay: None,
            liquid: self.desk.liquid,
            paper: Paper::default(),
        }
    }
}
