//! A specimen: a stone made from a design, with its solid, its material, and warnings about anything unusual.

use super::{Body, Medium, Stone};
use brillianteer_cut::{Audit, AuditSubject, Cut, Design, DesignError, FamilySolid, Tiers, Warning};
use brillianteer_math::{NotConvex, Plane, Polytope, PolytopeError, Pose, SmoothSolid, SolidRef};
use brillianteer_optics::{Material, critical_angle, line};
use glam::DVec3;
use std::sync::Arc;

/// A design and the stone that it describes.
#[derive(Debug, Clone, PartialEq)]
pub struct Specimen {
    /// The design, as its file describes it.
    pub design: Design,
    /// The solid of the stone, which scenes share.
    pub body: Arc<Body>,
    /// The stone's material.
    pub material: Material,
    /// Warnings about proportions that are possible but unusual.
    pub unusual: Vec<Warning>,
    /// Warnings about properties of the solid that its owner may not have meant, in words.
    pub warnings: Vec<String>,
    /// The greatest distance that the stone reaches from its axis, or along the axis from the origin, girdle radii. Views
    /// are fitted to it, so that the girdle keeps its size while the depth changes.
    pub reach: f64,
    /// The pose that carries the design's own frame into the stone's; [`Pose::STILL`] for all designs but those of tiers. Its
    /// scale is the unit of the design's distances, in girdle radii.
    pub frame: Pose,
    /// The greatest distance that the stone reaches from the origin in any direction, girdle radii.
    pub radius: f64,
}

/// The reason why a design makes no stone.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpecimenError {
    /// The design has numbers that no stone can have.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The planes enclose nothing; the message names them.
    #[error("{0}")]
    Solid(String),
}

impl Specimen {
    /// Builds the stone.
    ///
    /// # Errors
    /// The error names the first fault of the design.
    pub fn new(design: Design) -> Result<Self, SpecimenError> {
        let material = design.material.material().map_err(DesignError::from)?;
        let body = match &design.cut {
            Cut::Mesh(shape) => Some(Body::Mesh(Arc::clone(&shape.0))),
            Cut::Family(cut) => Some(match cut.solid().map_err(DesignError::from)? {
                FamilySolid::Convex(polytope, names) => Body::Stone(Stone::named(polytope, names)),
                FamilySolid::Mesh(mesh) => Body::Mesh(Arc::from(mesh)),
            }),
            Cut::Glass(glass) if glass.planes().is_none() => {
                Some(Body::Glass(SmoothSolid::new(glass.field().map_err(DesignError::from)?)))
            }
            _ => None,
        };
        if let Some(body) = body {
            let unusual = design.warnings()?;
            return Ok(Self { unusual, ..Self::made(design, body, material) });
        }
        let mut facets = design.facets()?;
        let given = facets.len();
        let unusual = design.warnings()?;
        let mut warnings = vec![];
        let (stone, frame) = match (Stone::new(&facets), &design.cut) {
            (Ok(stone), Cut::Tiers(_)) => stone.girdled(),
            (Ok(stone), _) => (stone, Pose::STILL),
            (Err(PolytopeError::Unbounded { .. }), Cut::Tiers(_)) => {
                facets.extend(Tiers::block());
                let stone = Stone::new(&facets).map_err(|e| with_names(&e, &facets))?;
                warnings.push(closed_by_block(&stone));
                stone.girdled()
            }
            (Err(error), _) => return Err(with_names(&error, &facets)),
        };
        let stone = match &design.cut {
            Cut::Tiers(tiers) => {
                let frosting = tiers.frosting();
                stone.frosted(|plane| frosting.get(plane).copied().unwrap_or(0.0))
            }
            _ => stone,
        };
        warnings.extend(odd(&stone, &facets, given));
        warnings.extend(scattering(&stone));
        if let Cut::Tiers(tiers) = &design.cut {
            warnings.extend(tiers.concave_warning());
        }
        Ok(Self { unusual, warnings, frame, ..Self::made(design, Body::Stone(stone), material) })
    }

    fn made(design: Design, body: Body, material: Material) -> Self {
        let far = |v: &DVec3| v.truncate().length().max(v.z.abs());
        let reach = body.solid().vertices().iter().map(far).fold(0.0, f64::max);
        let radius = body.solid().reach();
        let (unusual, warnings, frame) = (vec![], vec![], Pose::STILL);
        Self { design, body: Arc::new(body), material, unusual, warnings, reach, frame, radius }
    }

    /// Returns the shape in the form that tracers take.
    pub fn solid(&self) -> SolidRef<'_> {
        self.body.solid()
    }

    /// Returns the stone with its facets and their names.
    ///
    /// # Errors
    /// Fails where the solid is not a stone between planes.
    pub fn stone(&self) -> Result<&Stone, NotConvex> {
        self.body.stone()
    }

    /// Returns why the solid is no convex stone between planes, as a clause for messages; `None` where it is one.
    pub fn why_not_convex(&self) -> Option<String> {
        match (&*self.body, &self.design.cut) {
            (Body::Stone(_), _) => None,
            (Body::Glass(_), _) => Some("a glass shape is curved".to_owned()),
            // Of the families, only stones of two halves are meshes.
            (Body::Mesh(_), Cut::Family(cut)) => {
                Some(format!("a {} is not convex at its cleft", cut.family.name.to_lowercase()))
            }
            (Body::Mesh(_), _) => {
                Some("this is a mesh of triangles, not the planes of a convex stone".to_owned())
            }
        }
    }

    /// Audits the stone: lists the places that may not be what its designer meant. The critical angle is that of the
    /// material in sodium light; without a finite index there, no angle is compared with it.
    ///
    /// # Errors
    /// Fails where the solid is not a stone between planes.
    pub fn audit(&self) -> Result<Audit, NotConvex> {
        let stone = self.stone()?;
        // The planes that the stone was built from: those of the design, and then those of the block.
        let planes: Vec<String> =
            self.design.facets().unwrap_or_default().into_iter().map(|(name, _)| name).collect();
        let tiers = match &self.design.cut {
            Cut::Tiers(tiers) => Some(tiers),
            _ => None,
        };
        let index = self.material.dispersion.try_index(line::SODIUM_D).ok();
        let critical_deg = index.and_then(critical_angle).map(f64::to_degrees);
        let polytope = &stone.polytope;
        Ok(Audit::of(&AuditSubject {
            stone: polytope,
            names: stone.names(),
            planes: &planes,
            tiers,
            critical_deg,
        }))
    }

    /// Makes the specimen of another design. The solid is not built anew where the cut is the same.
    ///
    /// # Errors
    /// The error names the first fault of the design.
    pub fn remade(&self, design: Design) -> Result<Self, SpecimenError> {
        if design.cut != self.design.cut {
            return Self::new(design);
        }
        let material = design.material.material().map_err(DesignError::from)?;
        let unusual = design.warnings()?;
        Ok(Self { design, material, unusual, ..self.clone() })
    }

    /// Returns the unit of the design's own distances in mm.
    pub fn design_unit_mm(&self) -> f64 {
        self.unit_mm() * self.frame.scale
    }

    /// Returns the girdle radius in mm.
    pub fn unit_mm(&self) -> f64 {
        0.5 * self.design.diameter_mm
    }

    /// Returns the weight in carats; `None` where the material's density is not known.
    pub fn carats(&self) -> Option<f64> {
        self.material.carats(self.solid().volume() * self.unit_mm().powi(3))
    }

    /// Returns the medium at one wavelength, nm.
    pub fn medium(&self, nm: f64) -> Medium {
        Medium::of(&self.material, (nm, nm, nm), self.unit_mm())
    }
}

fn with_names(error: &PolytopeError, facets: &[(String, Plane)]) -> SpecimenError {
    SpecimenError::Solid(error.message(|i| format!("'{}'", facets[i].0)))
}

fn closed_by_block(stone: &Stone) -> String {
    let names: Vec<&str> =
        stone.names().iter().map(String::as_str).filter(|name| name.starts_with("block")).collect();
    format!(
        "the facets leave the stone open; it is closed, as in GemCad, by the block that it is cut from: {}",
        listed(&names)
    )
}

/// Returns warnings about a solid, the first `given` of whose planes are the design's.
fn odd(stone: &Stone, facets: &[(String, Plane)], given: usize) -> Vec<String> {
    let polytope = &stone.polytope;
    let name = |&i: &usize| facets[i].0.as_str();
    let merged: Vec<String> = polytope
        .merged()
        .iter()
        .map(|(dropped, kept)| format!("'{}' in that of '{}'", name(dropped), name(kept)))
        .collect();
    let mut told = vec![];
    if let [first, others @ ..] = &merged[..] {
        let more = match others.len() {
            0 => String::new(),
            1 => format!(", {}", others[0]),
            more => format!(", {} and {} more", others[0], more - 1),
        };
        told.push(format!("facets lie in one plane and become one facet: {first}{more}"));
    }
    if !meets_axis(polytope) {
        let what =
            "the stone lies beside its axis, x = y = 0, around which pictures are centred; move it there";
        told.push(what.to_owned());
    }
    // The planes of the block that closes a stone are not facets of it.
    let redundant = polytope.redundant().iter().filter(|&&i| i < given);
    let names: Vec<&str> = redundant.map(name).collect();
    if !names.is_empty() {
        told.push(format!("these facets do not reach the stone: {}", listed(&names)));
    }
    told
}

/// Returns a warning about frosted facets, because not every picture and figure follows their light.
fn scattering(stone: &Stone) -> Option<String> {
    let facets = (0..).zip(stone.polytope.facets());
    let names: Vec<_> =
        facets.filter(|(_, facet)| facet.frosting > 0.0).map(|(k, _)| stone.name(k)).collect();
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    (!names.is_empty()).then(|| {
        format!(
            "frosted facets scatter light: {}. Pictures under light show it; in figures and pictures in scopes, all light that \
             meets them counts as unresolved; measures of light and contrast maps are those of the stone as if they were polished",
            listed(&names)
        )
    })
}

/// Returns whether the axis, around which pictures are centred, runs through the stone.
fn meets_axis(stone: &Polytope) -> bool {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for plane in stone.planes() {
        match plane.normal.z {
            up if up > 0.0 => high = high.min(plane.offset / up),
            down if down < 0.0 => low = low.max(plane.offset / down),
            _ if plane.offset < 0.0 => return false,
            _ => {}
        }
    }
    low < high
}

/// Lists names in one line, and adds the number of the names that are left out.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 8;
    let shown = names.iter().take(MOST).map(|n| format!("'{n}'")).collect::<Vec<_>>().join(", ");
    if names.len() > MOST { format!("{shown} and {} more", names.len() - MOST) } else { shown }
}
