//! The plan of an export: its files, and the view and turn of each picture.

use super::export_sheet::SheetChoice;
use super::framing::Framing;
use super::framing_fit::FramingFit;
use super::scene_fit::SceneRoom;
use crate::shows::Shows;
use crate::studio::Shot;
use brillianteer_base::Failure;
use brillianteer_measure::STANDARD_ERROR;
use brillianteer_optics::line;
use brillianteer_paper::export::{Export, OutputFormat, Outputs, Viewing};
use brillianteer_paper::refraction::{self, Coding, MOST_MAP_BANDS, MOST_MAP_PIXELS};
use brillianteer_render::{Renderer, Wanted};
use brillianteer_scene::{
    Companions, Copies, Glare, MetalInstance, Movement, Pose, SceneRing, Side, Specimen, View, Viewpoint,
};
use std::path::PathBuf;
use std::sync::Arc;

/// The selection in the export dialog.
#[derive(Debug, Clone, PartialEq)]
pub struct Selection {
    /// The views to export.
    pub views: Vec<Shows>,
    /// The formats to write.
    pub formats: Vec<OutputFormat>,
    /// True where a refraction map is written, with a page that shows it.
    pub map: bool,
    /// The number of bands of wavelengths of the refraction map.
    pub bands: u32,
    /// The number of places in each pixel of the refraction map, for each band.
    pub places: u32,
    /// True where the copies are written as a scene file, with their cut files.
    pub scene: bool,
    /// The cutter's sheet.
    pub sheet: SheetChoice,
    /// True where facet diagrams mark the findings of the audit.
    pub mark_audit: bool,
    /// The number of pixels along each side.
    pub size: u32,
    /// True where pictures in scopes have a caption with a legend under them.
    pub caption: bool,
}

impl Default for Selection {
    fn default() -> Self {
        let views = vec![Shows::Render, Shows::Aset, Shows::Hearts, Shows::Arrows];
        let formats = vec![OutputFormat::Png];
        Self {
            views,
            formats,
            map: false,
            bands: 1,
            places: 1,
            scene: false,
            sheet: SheetChoice::default(),
            mark_audit: false,
            size: 1024,
            caption: false,
        }
    }
}

/// Returns the different stones among companions, in the order in which they first stand there.
pub fn kinds(companions: &Companions) -> Vec<&Arc<Specimen>> {
    let mut kinds: Vec<&Arc<Specimen>> = vec![];
    for stone in &companions.stones {
        if !kinds.iter().any(|kind| Arc::ptr_eq(kind, &stone.specimen)) {
            kinds.push(&stone.specimen);
        }
    }
    kinds
}

/// The view of a picture and the turn of the stone in it.
#[derive(Debug, Clone)]
pub struct PictureAspect {
    /// The view; pictures that are made for one side take that side instead.
    pub view: View,
    /// The turn of the stone about its axis in the view, radians.
    pub turn: f64,
}

/// Everything that an export needs.
#[derive(Debug, Clone)]
pub struct ExportPlan {
    /// The stone, light and view of renders; its film is not used.
    pub shot: Shot,
    /// The stone of the cut, at rest.
    pub upright: Arc<Specimen>,
    /// The aspect of the linked views; pictures and figures without a view of their own use it as well.
    pub linked: PictureAspect,
    /// The aspect of each view that is not linked, by what it shows.
    pub own: Vec<(Shows, PictureAspect)>,
    /// The part of space that renders show in the window; `None` where they show the stone alone and at rest.
    pub room: Option<SceneRoom>,
    /// What was selected.
    pub selection: Selection,
    /// How plates move, for the scene file.
    pub movement: Movement,
    /// The light, as scene files name it.
    pub light: String,
    /// The folder of the files.
    pub folder: PathBuf,
    /// The files of the cutter's sheet, as [`list_sheet`](Self::list_sheet) found them; none where none is written.
    pub sheet_files: Vec<PathBuf>,
    /// The beginning of the files' names.
    pub stem: String,
}

impl ExportPlan {
    /// Returns the view of a picture and the turn of the stone in it.
    pub fn aspect(&self, shows: Shows) -> &PictureAspect {
        self.own.iter().find(|(own, _)| *own == shows).map_or(&self.linked, |(_, aspect)| aspect)
    }

    /// Divides the export by the turn of the stone: the linked views, each view that is not linked, and the drawings and
    /// figures, which show the stone without a turn.
    pub fn parts(&self) -> Vec<(Outputs, Viewing<'_>)> {
        let is_drawing = |shows: &Shows| !shows.is_seen();
        let is_own = |shows: &Shows| self.own.iter().any(|(own, _)| own == shows);
        let json = self.selection.formats.contains(&OutputFormat::Json);
        let formats = |json: bool| {
            let pixels = self.selection.formats.iter().copied().filter(|f| *f != OutputFormat::Json);
            pixels.chain(json.then_some(OutputFormat::Json)).collect()
        };
        let seen = self.outputs(|s| !is_drawing(s) && !is_own(s), formats(false));
        let linked = Viewpoint::from(self.linked.view);
        let turned = |aspect: &PictureAspect| aspect.turn.to_degrees();
        let mut parts = vec![(seen, self.viewing(linked, turned(&self.linked)))];
        for (shows, aspect) in self.own.iter().filter(|(shows, _)| shows.is_seen()) {
            let alone = self.outputs(|s| s == shows, formats(false));
            if !alone.pictures.is_empty() {
                let viewpoint = Viewpoint::from(aspect.view);
                parts.push((alone, self.viewing(viewpoint, turned(aspect))));
            }
        }
        let azimuth_deg = (linked.azimuth_deg - self.linked.turn.to_degrees()).rem_euclid(360.0);
        let azimuth_deg = if linked.tilt_deg == 0.0 { 0.0 } else { azimuth_deg };
        let upright = self.outputs(is_drawing, formats(json));
        // The figures are those of the panel, which shows the table side alone.
        let viewpoint = Viewpoint { azimuth_deg, side: Side::Table, ..linked };
        parts.push((upright, self.viewing(viewpoint, 0.0)));
        parts
    }

    fn outputs(&self, is_part: impl Fn(&Shows) -> bool, formats: Vec<OutputFormat>) -> Outputs {
        let picture = |shows: &Shows| Some((shows.key().to_owned(), shows.picture()?.picture()));
        Outputs {
            folder: self.folder.clone(),
            stem: self.stem.clone(),
            pictures: self.selection.views.iter().filter(|s| is_part(s)).filter_map(picture).collect(),
            size: self.selection.size,
            formats,
            caption: self.selection.caption,
            mark_audit: self.selection.mark_audit,
            strongest: true,
            timing: false,
        }
    }

    fn viewing(&self, viewpoint: Viewpoint, turned_deg: f64) -> Viewing<'_> {
        let specimen = &*self.upright;
        Viewing {
            specimen,
            file: &self.stem,
            viewpoint,
            turned_deg,
            medium: specimen.medium(line::SODIUM_D),
            wavelength_nm: Some(line::SODIUM_D),
            head_deg: self.shot.look.head_of_scopes(),
            unresolved: None,
            standard_error: Some(STANDARD_ERROR),
            polarised: true,
            // `None` leaves glare out of pictures; figures list it in any case.
            glare: Some(self.shot.glare).filter(|glare| *glare == Glare::Included),
            tracer: Wanted::Quickest,
        }
    }

    /// Returns the paths of the maps, then those of the diffuse layer and the page; `None` where no map is selected.
    pub fn map_paths(&self) -> Option<(Vec<PathBuf>, [PathBuf; 2])> {
        let count = (self.selection.bands * self.selection.places) as usize;
        let maps = refraction::paths(&self.folder, &self.stem, count, Coding::Tiles);
        let page = self.folder.join(format!("{}-refraction.html", self.stem));
        let others = [refraction::diffuse_path(&self.folder, &self.stem), page];
        self.selection.map.then_some((maps, others))
    }

    /// Returns the paths of the scene file, of the cut file of each of its designs, that of the copies first, and of its
    /// metal.
    pub fn scene_paths(&self) -> Vec<PathBuf> {
        let companions = &self.shot.companions;
        let more = (2..2 + kinds(companions).len()).map(|number| format!("cut-{number}.toml"));
        let metals = (1..=self.meshes().len()).map(|number| format!("metal-{number}.obj"));
        let parts = ["scene.toml", "cut.toml"].into_iter().map(str::to_owned).chain(more).chain(metals);
        parts.map(|part| self.folder.join(format!("{}-{part}", self.stem))).collect()
    }

    /// Returns the ring that the scene file describes by its numbers: one whose metal follows from its stones.
    pub fn ring(&self) -> Option<&SceneRing> {
        let Shot { specimen, copies, companions, .. } = &self.shot;
        companions.fitted_ring(specimen, copies.first()?.at)
    }

    /// Returns the bodies of metal that the scene file names as meshes: all but that of [`ring`](Self::ring).
    pub fn meshes(&self) -> Vec<&MetalInstance> {
        let of_ring = self.ring().map(|ring| ring.metal);
        let metals = self.shot.companions.metals.iter().enumerate();
        metals.filter(|(number, _)| Some(*number) != of_ring).map(|(_, metal)| metal).collect()
    }

    /// Returns the file of the render, if it is selected.
    pub fn render_path(&self) -> Option<PathBuf> {
        let wanted = self.selection.views.contains(&Shows::Render)
            && self.selection.formats.contains(&OutputFormat::Png);
        wanted.then(|| self.folder.join(format!("{}-render.png", self.stem)))
    }

    /// Returns the views that can be exported of this stone.
    pub fn can_be_shown(&self) -> impl Iterator<Item = Shows> {
        let has_facets = self.upright.stone().is_ok();
        Shows::EXPORTED.iter().copied().filter(move |shows| has_facets || !shows.needs_facets())
    }

    /// Returns the files that will be written, in that order.
    ///
    /// # Errors
    /// Fails where files cannot be written, for example because there is no stone; the text says why.
    pub fn files(&self) -> Result<Vec<PathBuf>, Failure> {
        if self.selection.map && self.selection.size > MOST_MAP_PIXELS {
            return Err(Failure::Usage(format!(
                "A refraction map can be at most {MOST_MAP_PIXELS} pixels wide and high; choose a smaller size."
            )));
        }
        if self.selection.map && self.selection.bands * self.selection.places > MOST_MAP_BANDS {
            let problem = format!(
                "The number of bands times the number of places can be at most {MOST_MAP_BANDS}; \
                choose fewer."
            );
            return Err(Failure::Usage(problem));
        }
        let mut files = vec![];
        for (outputs, viewing) in &self.parts() {
            files.extend(Export { viewing: *viewing, outputs }.files(&Renderer::default())?);
        }
        files.extend(self.render_path());
        files.extend(self.map_paths().into_iter().flat_map(|(maps, others)| maps.into_iter().chain(others)));
        files.extend(self.sheet_files.iter().cloned());
        files.extend(self.selection.scene.then(|| self.scene_paths()).into_iter().flatten());
        Ok(files)
    }

    /// Returns the shot of a view at a size, framed as in the views of the window.
    pub fn shot(&self, shows: Shows, size: u32) -> Shot {
        let seen = self.aspect(shows).view;
        let view = View { side: shows.side().unwrap_or(seen.side), ..seen };
        let shot = Shot { shows, view, ..self.shot.clone() };
        let size = [size; 2];
        if let Some(room) = self.room.filter(|_| shows.has_copies()) {
            let fit = match room {
                SceneRoom::Square { half } => FramingFit::reaching(half.max(self.copies_reach(&view))),
                SceneRoom::Ball { .. } => room.fit(&view),
            };
            return Shot { film: fit.film(size), whole: fit.whole(size), ..shot };
        }
        let specimen = Arc::clone(&self.upright);
        let fit = Framing::new(&specimen).fit(&shot.view);
        let (film, whole) = (fit.film(size), fit.whole(size));
        let (copies, companions) = (vec![Pose::STILL], Companions::default());
        Shot { film, whole, specimen, copies, companions, ..shot }
    }

    /// Returns how far copies reach in a view that turns them, girdle radii, so that the picture cuts nothing off.
    fn copies_reach(&self, view: &View) -> f64 {
        let turned = Pose::turned(view.turn);
        let poses = self.shot.copies.iter().map(|pose| turned.after(pose)).collect();
        Copies::at(poses, self.shot.specimen.solid().vertices()).reach(0.0)
    }
}
