//! A design in the form that the readers of all formats return.

use crate::mesh::MeshBody;
use brillianteer_cut::Design;
use brillianteer_cut::from_mesh::FacetError;
use brillianteer_math::Pose;

/// A design that was read from a file, with notes and warnings.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedDesign {
    /// The design.
    pub design: Design,
    /// Notes on how the file was understood, where another reading is possible.
    pub notes: Vec<String>,
    /// Warnings about unusual content of the file, each with its line or offset where it has one.
    pub warnings: Vec<String>,
    /// For a mesh, true where its shape leaves a doubt which way its table faces; `None` for other designs.
    pub doubt: Option<bool>,
    /// The first 256 bodies of a mesh that has several, the closed ones first, in the order of their numbers; empty for any
    /// other design.
    pub bodies: Vec<MeshBody>,
    /// True for a mesh whose notes say that other [`MeshOptions`](crate::mesh_options::MeshOptions) read it in another
    /// way.
    pub has_other_reading: bool,
    /// For a mesh, the pose that carried the points of its file into the stone's frame.
    pub pose: Option<Pose>,
    /// True for a mesh that was given a symmetry, which another option leaves out.
    pub is_evened: bool,
    /// The standard errors of the facets of a scan, in the order of the design's facets; empty for other designs.
    pub errors: Vec<FacetError>,
}

impl ImportedDesign {
    /// Wraps a design without notes and warnings.
    pub fn of(design: Design) -> Self {
        let (notes, warnings, bodies, errors) = (vec![], vec![], vec![], vec![]);
        let (has_other_reading, is_evened) = (false, false);
        Self {
            design,
            notes,
            warnings,
            doubt: None,
            bodies,
            has_other_reading,
            pose: None,
            is_evened,
            errors,
        }
    }

    /// Returns how messages call the bodies of a mesh of which one may be chosen, in the order of their numbers; none where
    /// there is no choice.
    pub fn choices(&self) -> Vec<String> {
        if !MeshBody::leave_a_choice(&self.bodies) {
            return vec![];
        }
        self.bodies.iter().filter(|body| body.number.is_some()).map(ToString::to_string).collect()
    }
}
