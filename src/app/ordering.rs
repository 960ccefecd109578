//! Orders pictures and figures of all that is in sight from the studio.

use super::editor::Editor;
use super::framing::FramingFit;
use super::shows::Shows;
use super::studio::{BEHIND, FiguresOrder, Order, Paper, Shot, Smoothing, Which};
use crate::io::lighting::Lighting;
use crate::scene::{Copies, Pose, Side, Specimen, View};
use std::sync::Arc;

impl Editor {
    /// Orders from the studio all that is in sight.
    pub(super) fn order(&mut self, seen: &[(usize, [u32; 2])]) {
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
            if let Some(specimen) = self.specimen(which) {
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

    pub(super) fn specimen(&self, which: Which) -> Option<Arc<Specimen>> {
        match which {
            Which::Present => Some(Arc::clone(self.document.specimen())),
            Which::Other => self.compared.as_ref().map(|c| Arc::clone(&c.specimen)),
        }
    }

    pub(super) fn shot(
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
        let fit = self.fit(shows, &view);
        let specimen = self.specimen(which)?;
        if shows == Shows::Diagram && specimen.stone().is_err() {
            return None;
        }
        let (specimen, company) = match shows.has_company() {
            true => self.company(which)?,
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
    fn company(&mut self, which: Which) -> Option<(Arc<Specimen>, Vec<Pose>)> {
        let (specimen, company) = (self.specimen(which)?, &self.document.work.company);
        if *company == Copies::default() && self.moving.seconds == 0.0 {
            return Some((specimen, vec![Pose::STILL]));
        }
        Some(self.moving.now(&specimen, company))
    }

    /// Returns what a view takes in: the stone that views are fitted to, or all copies.
    pub(super) fn fit(&self, shows: Shows, view: &View) -> FramingFit {
        let is_alone = self.document.work.company == Copies::default();
        match shows.has_company() && !(is_alone && self.moving.seconds == 0.0) {
            true => FramingFit::reaching(self.reach(shows)),
            false => self.framing.fit(view),
        }
    }

    /// Returns how far a view's picture reaches from its middle, girdle radii.
    ///
    /// Both designs are shown on one scale, that of the present design.
    pub(super) fn reach(&self, shows: Shows) -> f64 {
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

    /// Returns what a render shows in a view.
    pub(super) fn render_shot(&mut self, view: View) -> Shot {
        let light = self.light();
        let alone = (Arc::clone(self.document.specimen()), vec![Pose::STILL]);
        let (specimen, company) = self.company(Which::Present).unwrap_or(alone);
        let fit = self.fit(Shows::Render, &view);
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
