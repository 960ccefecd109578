//! Makes stones from meshes: a convex stone becomes planes, any other triangles.

use super::departure::{Departure, departure};
use super::file::{self, MaterialHint, MeshFile, MeshFormat, Statement};
use super::parts::{ChosenPart, MeshBody};
use super::place::{MeshPlace, MeshRemarks, axes, doubtful, usual_up};
use crate::design_file::ImportedDesign;
use crate::mesh_options::{MeshForm, MeshOptions, MeshPart};
use brillianteer_base::{Fault, FileError};
use brillianteer_cut::from_mesh::{
    Evening, FacetError, FromMesh, TablePart, Up, UpFound, directions, find_up, from_mesh,
};
use brillianteer_cut::{Cut, Design, MaterialRef, MeshShape, is_printable};
use brillianteer_math::faceting::{
    Change, Faceted, NotFaceted, SurfaceKind, Unfaceted, faceted_hull, facets, hull_facets,
};
use brillianteer_math::mending::{Mended, OpenPiece, SurfaceError};
use brillianteer_math::{Pose, Surface, Symmetry, TriangleMesh, at_most, signed};
use glam::{DQuat, DVec3};
use std::path::Path;

/// The material of a mesh whose file gives none.
const USUAL: &str = "diamond";

/// Reads a mesh of any format; `bytes` are the content of the file at `path`.
///
/// # Errors
/// Fails where the mesh makes no stone; the error has the path and the place.
pub fn read(bytes: Vec<u8>, path: &Path, options: &MeshOptions) -> Result<ImportedDesign, FileError> {
    ClosedFile::of(bytes, path)?.design(options)
}

/// Reads every body of a mesh that lies inside no other, as [`read`] reads one, in the order of their numbers. `most` is the
/// largest number of them.
///
/// # Errors
/// Fails where one of them makes no stone, or where there are more; the error has the path and the place.
pub fn read_bodies(
    bytes: Vec<u8>,
    path: &Path,
    options: &MeshOptions,
    most: usize,
) -> Result<Vec<(MeshPart, ImportedDesign)>, FileError> {
    let file = ClosedFile::of(bytes, path)?;
    let apart = (1..).zip(&file.mended.parts).filter(|(_, part)| part.within.is_none());
    let parts: Vec<MeshPart> = apart.map(|(number, _)| MeshPart::Number(number)).collect();
    if parts.len() > most {
        let problem = format!("{} bodies are in the file, and at most {most} are read at once", parts.len());
        return Err(FileError::new(path.display(), problem));
    }
    let read = |part: MeshPart| {
        let design = file.design(&MeshOptions { part: part.clone(), ..options.clone() })?;
        Ok((part, design))
    };
    parts.into_iter().map(read).collect()
}

/// Returns the direction that is up in a file with these bytes, unless a person says another: y in glTF, else z.
pub fn upward(bytes: &[u8]) -> DVec3 {
    file::looks_like(bytes).map_or(DVec3::Z, usual_up)
}

/// The closed surface of a mesh file, before one of its bodies is taken.
struct ClosedFile {
    label: String,
    format: MeshFormat,
    name: String,
    hint: Option<MaterialHint>,
    statement: Option<Statement>,
    mended: Mended,
    open: Vec<OpenPiece>,
    notes: Vec<String>,
    warnings: Vec<String>,
}

impl ClosedFile {
    fn of(bytes: Vec<u8>, path: &Path) -> Result<Self, FileError> {
        let label = path.display().to_string();
        let MeshFile { format, surface, hint, statement, mut notes, warnings, name, .. } =
            file::parse(bytes, &label, path.parent())?;
        let (mended, open) =
            surface.mend_closed().map_err(|error| unmended(&warnings, &error).in_file(&label))?;
        notes.extend(told_of(&mended));
        let name = Some(name).filter(|name| is_printable(name)).unwrap_or_else(|| "stone".to_owned());
        Ok(Self { label, format, name, hint, statement, mended, open, notes, warnings })
    }

    /// Makes a design of the body that the options choose.
    fn design(&self, options: &MeshOptions) -> Result<ImportedDesign, FileError> {
        let in_file = |fault: Fault| fault.in_file(&self.label);
        let (open, is_stated) = (self.open.clone(), self.statement.is_some());
        let chosen = ChosenPart::of(&self.mended, open, &options.part, is_stated).map_err(in_file)?;
        let place = MeshPlace::of(self.format, options, self.statement.clone());
        let name = name_of_read(&chosen.bodies).unwrap_or(&self.name).to_owned();
        let file = File { hint: self.hint.clone(), name, place, evening: options.evening };
        let brought = file.of_form(options.form, chosen.surface).map_err(in_file)?;
        let notes = [self.notes.clone(), chosen.notes, brought.notes].concat();
        let warnings =
            [self.warnings.clone(), chosen.warning.into_iter().collect(), brought.warnings].concat();
        Ok(ImportedDesign { bodies: chosen.bodies, notes, warnings, ..brought })
    }
}

/// Returns the name of the one body of several that is read; `None` where it has none, or where all are read.
fn name_of_read(bodies: &[MeshBody]) -> Option<&str> {
    let mut read = bodies.iter().filter(|body| body.is_read).map(|body| body.name.as_str());
    read.next().filter(|name| read.next().is_none() && is_printable(name))
}

/// Returns the fault of a surface that cannot be mended, behind the warnings about what was left out of it: they may be the
/// cause.
fn unmended(warnings: &[String], error: &SurfaceError) -> Fault {
    Fault::whole(
        warnings.iter().map(|warning| format!("{warning}; ")).collect::<String>() + &error.to_string(),
    )
}

/// The note on a mesh that is traced as triangles without a request for that.
const NOT_CONVEX: &str = "it is not convex; read as a faceted stone it would be the convex stone around it";

/// The note on a convex mesh without facets.
const CURVED: &str = "it is curved: no flat facets, or not as few as a stone may have, make up its shape; if it is a faceted stone, save a \
                      coarser mesh";

/// The note on a scan in which no facets are found.
const HIDDEN: &str =
    "its noise hides any flat facets that it has; a scan with less noise or more corners would show them";

/// Returns the message on why a mesh cannot be read as a faceted stone, and what to do.
fn impossible(error: NotFaceted) -> Fault {
    let instead = match error {
        NotFaceted::Curved => "save a coarser mesh",
        NotFaceted::Noisy => "scan it with less noise or more corners",
    };
    Fault::whole(format!("it cannot be read as a faceted stone: {error}; {instead}, or read it as triangles"))
}

/// Returns the note on the changes where a mesh is read as a convex stone. Lengths of the file times `scale` are
/// girdle radii.
fn changed(change: &Change, tolerance: f64, scale: f64) -> String {
    let (sharpest, volume) = (change.sharpest.to_degrees(), 100.0 * change.volume);
    let [deepest, tolerance] = [change.deepest, tolerance].map(|length| scale * length);
    format!(
        "the mesh bends inward at {} edges, by up to {sharpest:.1} degrees, and is read as the convex stone that it \
         stands for: the volume changes by {} %, the deepest point of the mesh lies {deepest:.4} girdle radii \
         below the stone's facets, and corners within {} girdle radii of a plane share a facet; read as \
         triangles the mesh would stay as it is",
        change.bent,
        signed(volume, 3),
        at_most(tolerance)
    )
}

/// Returns the note on how well the facets of a scan are known; `None` for other meshes.
fn known_to(errors: &[FacetError]) -> Option<String> {
    let mut slopes: Vec<f64> = errors.iter().map(|error| error.slope_deg).collect();
    slopes.sort_by(f64::total_cmp);
    let (least, most) = (slopes.first()?, slopes.last()?);
    let median = slopes[slopes.len() / 2];
    let [least, median, most] = [*least, median, *most].map(at_most);
    Some(format!(
        "its noise leaves the slopes with standard errors of {least} to {most} degrees, in the median {median} degrees"
    ))
}

/// The warning about facets that were found in spite of noise, of which too few corners tell.
const UNCERTAIN: &str = "too many of its corners lie off the facets that were found, and too few within them, to tell which facets are true: some may \
                         be parts of one facet or several facets as one, and angles have no standard errors; a scan with less noise or more \
                         corners would tell";

/// Returns the warning about facets of a scan that may be several; `None` where there are none.
fn bent(errors: &[FacetError]) -> Option<String> {
    let bent: Vec<&str> =
        errors.iter().filter(|error| error.is_bent).map(|error| error.facet.as_str()).collect();
    let first = bent.first()?;
    let (which, they) = match bent.len() {
        1 => (format!("the facet '{first}' bends"), "it may be several facets that the noise hides"),
        count => (
            format!("{count} of the facets bend ('{first}' is the first)"),
            "each may be several facets that the noise hides",
        ),
    };
    Some(format!(
        "{which} by more than the scan's noise: {they}, and its angles may be off by more than its standard errors; a scan with less \
         noise or more corners would tell"
    ))
}

/// Returns the warning about a table that noise may have divided.
fn divided(part: &TablePart) -> String {
    format!(
        "the facet '{}' leans only {:.2} degrees from the table: noise may have divided one facet in two, and the table would be \
         larger than it is read; a mesh with less noise would tell",
        part.facet, part.lean_deg
    )
}

/// Returns the warning about a scan that lacks a symmetry by so few facets that noise may have divided or joined them.
fn lacking(facets: usize) -> String {
    let of = if facets == 1 { "1 facet".to_owned() } else { format!("{facets} facets") };
    format!(
        "it was not evened: all its facets but {of} have images of about the same place and slope, and noise may have divided a facet \
         or joined two; a scan with less noise or more corners would tell"
    )
}

/// Returns the note on a stone that was given a symmetry; `None` where it was left as found.
fn evened(symmetry: &Symmetry) -> Option<String> {
    const FOLDS: [&str; 11] = [
        "twofold",
        "threefold",
        "fourfold",
        "fivefold",
        "sixfold",
        "sevenfold",
        "eightfold",
        "ninefold",
        "tenfold",
        "elevenfold",
        "twelvefold",
    ];
    let turns = symmetry.turns as usize;
    let fold =
        (turns > 1).then(|| FOLDS.get(turns - 2).map_or(format!("{turns}-fold"), |fold| (*fold).to_owned()));
    let parts: Vec<String> = fold.into_iter().chain(symmetry.mirror.map(|_| "mirror".to_owned())).collect();
    (!parts.is_empty())
        .then(|| format!("it was evened to {}, which it has except for its noise", parts.join(", ")))
}

/// The statements of a file besides its shape, and the place of its stone.
struct File {
    hint: Option<MaterialHint>,
    name: String,
    place: MeshPlace,
    evening: Evening,
}

impl File {
    fn of_form(self, form: MeshForm, surface: Surface) -> Result<ImportedDesign, Fault> {
        match form {
            MeshForm::Triangles => self.triangles(surface, None),
            MeshForm::Faceted => {
                faceted_hull(surface).map_err(impossible).and_then(|found| self.planes(&found))
            }
            MeshForm::Found => match facets(surface) {
                SurfaceKind::Convex(found) => self.planes(&found),
                SurfaceKind::Concave(surface) => {
                    let why = match Unfaceted::of(&surface) {
                        Unfaceted::Concave => NOT_CONVEX,
                        Unfaceted::Curved => CURVED,
                        Unfaceted::Noisy => HIDDEN,
                    };
                    self.triangles(surface, Some(why))
                }
            },
        }
    }

    fn planes(mut self, found: &Faceted) -> Result<ImportedDesign, Fault> {
        let mut remarks = MeshRemarks::default();
        let surface = found.surface.moved(found.centre);
        let up = self.place.up(&surface, || directions(&found.polytope), &mut remarks);
        let made = from_mesh(found, up, self.evening).map_err(Fault::whole)?;
        let departs = departure(found, &made);
        let FromMesh { mut facets, pose, errors, .. } = made;
        // A known size goes before the width that was found.
        let scale = self.place.scale.unwrap_or(pose.scale);
        let rescaled = scale / pose.scale;
        let pose = Pose { at: rescaled * pose.at, scale, ..pose };
        facets.iter_mut().for_each(|(_, plane)| plane.offset *= rescaled);
        let (count, deviation) = (facets.len(), made.deviation * rescaled);
        remarks.notes.push(format!(
            "{count} facets were found; no corner lies farther from them than {} girdle radii",
            at_most(deviation)
        ));
        remarks.notes.extend(known_to(&errors));
        match departs {
            Some(Departure::Note(note)) => remarks.notes.push(note),
            Some(Departure::Warning(warning)) => remarks.warnings.push(warning),
            None => {}
        }
        remarks.warnings.extend(found.is_uncertain.then(|| UNCERTAIN.to_owned()));
        remarks.warnings.extend(bent(&errors));
        remarks.warnings.extend(made.table_part.as_ref().map(divided));
        remarks.warnings.extend(made.lacking.map(lacking));
        let evened = evened(&made.evened);
        let is_evened = evened.is_some();
        remarks.notes.extend(evened);
        remarks.is_doubtful = made.doubt.is_some();
        remarks.has_other_reading = found.change.is_some() || made.doubt.is_some();
        remarks.notes.extend(found.change.map(|change| changed(&change, found.tolerance, scale)));
        remarks.notes.extend(made.doubt.map(|doubt| doubtful(made.up, doubt.other)));
        let brought =
            ImportedDesign { errors, is_evened, ..self.brought(Cut::Planes(facets), pose, remarks)? };
        brought.design.check().map_err(Fault::whole)?;
        Ok(brought)
    }

    fn triangles(mut self, surface: Surface, why: Option<&str>) -> Result<ImportedDesign, Fault> {
        let mut remarks = MeshRemarks::default();
        let up = self.place.up(&surface, || axes().to_vec(), &mut remarks);
        let mesh = TriangleMesh::new(surface).map_err(Fault::whole)?;
        let turn = match up {
            Up::Posed(pose) => pose.turn,
            up => DQuat::from_rotation_arc(axis_of_triangles(mesh.surface(), up, &mut remarks)?, DVec3::Z),
        };
        let (shape, pose) =
            MeshShape::framed(&mesh, turn).ok_or("it has no extent across the direction up")?;
        // A known size stays the same in mm, though this frame may have another scale than the frame of the written
        // stone.
        if let (Some(known), Some(diameter_mm)) = (self.place.scale, &mut self.place.diameter_mm) {
            *diameter_mm *= known / pose.scale;
        }
        remarks.has_other_reading = why.is_some() || remarks.is_doubtful;
        remarks.notes.extend(why.map(str::to_owned));
        remarks.notes.push(format!("it is traced as {} triangles", shape.surface().triangles.len()));
        self.brought(Cut::Mesh(shape), pose, remarks)
    }

    /// Makes the design of a cut, which a pose carried from the file.
    fn brought(self, cut: Cut, pose: Pose, mut remarks: MeshRemarks) -> Result<ImportedDesign, Fault> {
        let scale = pose.scale;
        let diameter_mm = self.place.diameter_mm(scale, &mut remarks)?;
        let MeshRemarks { mut notes, mut warnings, is_doubtful, has_other_reading } = remarks;
        let (material, why) = self.material(0.5 * diameter_mm * scale);
        match why {
            Ok(note) => notes.extend(note),
            Err(warning) => warnings.push(warning),
        }
        let design = Design { name: self.name, source: None, notes: None, material, diameter_mm, cut };
        let doubt = Some(is_doubtful);
        let pose = Some(pose);
        Ok(ImportedDesign { notes, warnings, doubt, has_other_reading, pose, ..ImportedDesign::of(design) })
    }

    /// Returns the material that the file states, with a note where it states none, or a warning where the library
    /// lacks it.
    fn material(&self, mm_per_unit: f64) -> (MaterialRef, Result<Option<String>, String>) {
        let usual = MaterialRef::Name(USUAL.to_owned());
        match (&self.place.material, &self.hint) {
            (Some(stated), hint) if hint.as_ref().is_none_or(|hint| hint.is_of(stated, mm_per_unit)) => {
                (stated.clone(), Ok(None))
            }
            (_, Some(hint)) => match hint.material(mm_per_unit) {
                Ok(Some(material)) => (material, Ok(None)),
                Ok(None) => (usual, Ok(Some(unsaid()))),
                Err(error) => (usual, Err(format!("{error}; {USUAL} is used"))),
            },
            (_, None) => (usual, Ok(Some(unsaid()))),
        }
    }
}

/// Returns the direction up of a surface that is read as triangles, a unit vector. Where it is to be found, the facets of the
/// surface's hull show it; where the hull has none, the axis that is up by custom is taken.
fn axis_of_triangles(surface: &Surface, up: Up, remarks: &mut MeshRemarks) -> Result<DVec3, Fault> {
    let custom = match up {
        Up::Found => DVec3::Z,
        Up::FoundBy(custom) => custom,
        Up::Given(up) | Up::Known(up) => {
            return Ok(up.try_normalize().ok_or("the direction up must not be 0")?);
        }
        Up::Posed(pose) => return Ok(pose.turn.inverse() * DVec3::Z),
    };
    let Some(hull) = hull_facets(surface) else { return Ok(custom) };
    let UpFound { up, doubt } = find_up(&hull, up).map_err(Fault::whole)?;
    remarks.is_doubtful = doubt.is_some();
    remarks.notes.extend(doubt.map(|doubt| doubtful(up, doubt.other)));
    Ok(up)
}

fn unsaid() -> String {
    format!("the file has no material that refracts; {USUAL} is used")
}

/// Returns notes on the repairs of a mesh, where they exceed those that any file of triangles needs.
fn told_of(mended: &Mended) -> Vec<String> {
    let mending = &mended.mending;
    // A solid inside another is turned as well, as if it were a cavity.
    let turned = if mended.parts.iter().any(|part| part.within.is_some()) { 0 } else { mending.turned };
    let count = |count: usize, what: &str| (count > 0).then(|| format!("{count} {what}"));
    let crack = (mending.crack > 0.0)
        .then(|| format!("cracks of up to {} of its unit were closed", at_most(mending.crack)));
    [
        count(mending.copies, "copies of triangles are left out"),
        count(mending.degenerate, "triangles without an area are left out"),
        count(turned, "triangles that faced inward are turned"),
        count(mending.seams, "pieces were made of triangles whose edges had corners on them"),
        crack,
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
#[allow(clippy::print_stdout, reason = "a test that is left out says so")]
mod tests {
    use super::*;
    use crate::{cut_file, library, write_obj, write_stl};
    use brillianteer_math::Plane;
    use brillianteer_scene::Specimen;

    /// The diamond that most demos load: every corner is one of its hull, and its kites are bent over the wrong diagonal.
    #[test]
    fn a_diamond_of_the_web_is_read_as_the_stone_it_means() {
        let path = Path::new(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../../shared/data/mesh/gkjohnson-diamond.glb"
        ));
        let Ok(bytes) = std::fs::read(path) else {
            println!("SKIPPED: {} is not there", path.display());
            return;
        };
        let open = |form| read(bytes.clone(), path, &MeshOptions { form, ..MeshOptions::default() }).unwrap();
        let found = open(MeshForm::Found);
        let notes = found.notes.join("\n");
        assert!(found.warnings.is_empty() && notes.contains("69 facets were found"), "{notes}");
        assert!(!notes.contains("nearly as likely"), "{notes}");
        assert!(notes.contains("bends inward at 20 edges, by up to 24.7 degrees"), "{notes}");
        assert!(notes.contains("the volume changes by +1.375 %"), "{notes}");
        let stone = Specimen::new(found.design.clone()).unwrap();
        let names = stone.stone().unwrap().names().to_vec();
        assert!(
            names[0] == "table" && names.iter().filter(|n| n.starts_with("pavilion 1")).count() == 20,
            "{names:?}"
        );
        assert!(names.iter().filter(|n| n.starts_with("crown A")).count() == 20, "{names:?}");
        assert_eq!(open(MeshForm::Faceted).design, found.design);
        let triangles = open(MeshForm::Triangles);
        let Cut::Mesh(shape) = &triangles.design.cut else { panic!("no triangles") };
        assert_eq!(shape.surface().triangles.len(), 96);
        assert!(triangles.notes.iter().any(|note| note == "it is traced as 96 triangles"));
    }

    #[test]
    fn a_solid_that_is_not_convex_is_faceted_only_where_that_is_asked_for_and_possible() {
        let obj = |(vertices, triangles): crate::solids::Triangles| {
            let corner = |v: &DVec3| format!("v {} {} {}\n", v.x, v.y, v.z);
            let face = |t: &[u32; 3]| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
            let corners: String = vertices.iter().map(corner).collect();
            (corners + &triangles.iter().map(face).collect::<String>()).into_bytes()
        };
        let open = |bytes: Vec<u8>, form| {
            read(bytes, Path::new("x.obj"), &MeshOptions { form, ..MeshOptions::default() })
        };
        let heart = obj(crate::solids::heart());
        let found = open(heart.clone(), MeshForm::Found).unwrap();
        assert!(
            matches!(found.design.cut, Cut::Mesh(_)) && found.notes.iter().any(|note| note == NOT_CONVEX)
        );
        let faceted = open(heart, MeshForm::Faceted).unwrap();
        assert!(matches!(faceted.design.cut, Cut::Planes(_)));
        let told = faceted.warnings.join("; ");
        assert!(told.contains("the convex stone around the mesh") && told.contains(" facets, "), "{told}");
        assert!(told.contains("its volume departs from the mesh's by +"), "{told}");
        let [before, after] = [found, faceted].map(|b| {
            let solid = Specimen::new(b.design).unwrap();
            let (low, high) = solid.solid().bounds();
            solid.solid().volume() / (high - low).element_product()
        });
        assert!(after > 1.05 * before, "{after} {before}");
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let at = |k: i32| {
            let z = 1.0 - (2.0 * f64::from(k) + 1.0) / 4000.0;
            let (sin, cos) = (golden * f64::from(k)).sin_cos();
            DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
        };
        let vertices: Vec<DVec3> = (0..4000).map(at).collect();
        let triangles = brillianteer_math::convex_hull(&vertices).unwrap();
        let ball = obj((vertices, triangles));
        let found = open(ball.clone(), MeshForm::Found).unwrap();
        assert!(matches!(found.design.cut, Cut::Mesh(_)) && found.notes.iter().any(|note| note == CURVED));
        let error = open(ball, MeshForm::Faceted).unwrap_err().to_string();
        assert!(
            error.contains("cannot be read as a faceted stone") && error.contains("read it as triangles"),
            "{error}"
        );
    }

    #[test]
    fn a_mesh_that_was_scaled_is_told_so_though_its_direction_is_given() {
        let design = cut_file::parse(library::cut("tolkowsky").unwrap(), "t").unwrap();
        let specimen = Specimen::new(design).unwrap();
        let obj = write_obj(&specimen.body, "t", 3.25, Some(&specimen.design.material));
        let scaled = |line: &str| match line.strip_prefix("v ") {
            Some(numbers) => {
                let numbers = numbers.split(' ').map(|n| 2.0 * n.parse::<f64>().unwrap());
                format!("v{}\n", numbers.map(|n| format!(" {n}")).collect::<String>())
            }
            None => format!("{line}\n"),
        };
        let larger: String = obj.lines().map(scaled).collect();
        let open = |text: &str| {
            let options = MeshOptions { up: Up::Given(DVec3::Z), ..MeshOptions::default() };
            read(text.as_bytes().to_vec(), Path::new("t.obj"), &options).unwrap()
        };
        let warnings = open(&larger).warnings.join("; ");
        assert!(
            warnings.contains("its corners have been scaled by 2.0000 since; 6.5 mm is kept"),
            "{warnings}"
        );
        assert_eq!(open(&obj).warnings, Vec::<String>::new());
    }

    /// Six digits of a cutter's file leave corners where facets nearly meet, and slivers of triangles beside them.
    #[test]
    fn facets_that_meet_but_for_the_last_digit_are_found() {
        let design = cut_file::parse(library::cut("tolkowsky").unwrap(), "t").unwrap();
        let rounded = |x: f64| (x * 1e6).round() / 1e6;
        let facets = design.facets().unwrap().into_iter().map(|(name, plane)| {
            (name, Plane::new(plane.normal.to_array().map(rounded).into(), rounded(plane.offset)))
        });
        let specimen = Specimen::new(Design { cut: Cut::Planes(facets.collect()), ..design }).unwrap();
        let count = specimen.stone().unwrap().polytope.facets().len();
        for bytes in [
            write_obj(&specimen.body, "t", 1.0, None).into_bytes(),
            write_stl(&specimen.body, 3.0, None).unwrap(),
        ] {
            let brought = read(bytes, Path::new("t"), &MeshOptions::default()).unwrap();
            let Cut::Planes(planes) = &brought.design.cut else { panic!("concave") };
            assert_eq!(planes.len(), count);
            let again = Specimen::new(brought.design).unwrap().solid().volume();
            assert!((again - specimen.solid().volume()).abs() < 1e-4);
        }
    }
}
