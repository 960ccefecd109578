//! The checks of a shape's dimensions, and the errors that they return.

use super::ImplicitForm;
use super::profile::inradius;

/// The least and the greatest dimension, in girdle radii: squares of their quotients keep their digits.
const SIZES: [f64; 2] = [1e-6, 1e6];

/// The greatest slope of a plate's wave. Where the slope is so steep, the plate is an eighth as thick as along z.
pub const STEEPEST: f64 = 8.0;

/// The most waves along the longer side of a plate.
pub const MOST_WAVES: f64 = 200.0;

/// Why a shape cannot be made.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ImplicitSurfaceError {
    /// A dimension is NaN, 0, negative, or out of the range that can be computed with.
    #[error("{name} is {value}; it must be a number from 1e-6 to 1e6 girdle radii")]
    Dimension {
        /// The name of the dimension.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// A number that may be 0 is NaN, negative or too large.
    #[error("{name} is {value}; it must be a number from 0 to 1e6")]
    Number {
        /// The name of the number.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// The radius of an edge, or of the corners of a pane's outline, exceeds the room that the shape has for it.
    #[error("the edge's radius is {edge}; in this shape there is room for {most}")]
    Edge {
        /// The radius given.
        edge: f64,
        /// The largest radius that this shape allows.
        most: f64,
    },
    /// The wave is too steep.
    #[error(
        "the wave is as steep as {slope:.2}; at most 8: make its amplitude smaller or the wavelength longer"
    )]
    Slope {
        /// The greatest slope of the wave, 2π amplitude / wavelength.
        slope: f64,
    },
    /// The wave is too short.
    #[error("the wavelength is {wavelength}; for a plate so large it must be {least} or more")]
    Wavelength {
        /// The wavelength given.
        wavelength: f64,
        /// The shortest wavelength that this plate allows.
        least: f64,
    },
}

impl ImplicitForm {
    /// Returns the largest radius that the edges can have, in the unit of the dimensions.
    pub fn largest_edge(&self) -> f64 {
        match *self {
            Self::Pane { size, corner, .. } => corner.min(size.z / 2.0),
            Self::Prism { size, .. } => (size.x / 2.0).min(inradius(size.y, size.z)),
            Self::Pill { size, .. } | Self::Block { size, .. } | Self::Plate { size, .. } => {
                size.min_element() / 2.0
            }
        }
    }
}

/// Returns an error for dimensions that no shape can have.
pub fn check(form: &ImplicitForm) -> Result<(), ImplicitSurfaceError> {
    let (ImplicitForm::Pill { size, edge }
    | ImplicitForm::Block { size, edge }
    | ImplicitForm::Pane { size, edge, .. }
    | ImplicitForm::Prism { size, edge }
    | ImplicitForm::Plate { size, edge, .. }) = *form;
    for (name, value) in
        [("the size along x", size.x), ("the size along y", size.y), ("the size along z", size.z)]
    {
        dimension(name, value)?;
    }
    number("the edge's radius", edge)?;
    if let ImplicitForm::Pane { corner, .. } = *form {
        number("the corners' radius", corner)?;
        let most = size.x.min(size.y) / 2.0;
        if corner > most {
            return Err(ImplicitSurfaceError::Edge { edge: corner, most });
        }
    }
    let most = form.largest_edge();
    if edge > most {
        return Err(ImplicitSurfaceError::Edge { edge, most });
    }
    if let ImplicitForm::Plate { amplitude, wavelength, phase, .. } = *form {
        number("the amplitude", amplitude)?;
        dimension("the wavelength", wavelength)?;
        number("the phase, its sign aside,", phase.abs())?;
        let slope = std::f64::consts::TAU * amplitude / wavelength;
        if slope > STEEPEST {
            return Err(ImplicitSurfaceError::Slope { slope });
        }
        let least = size.x.max(size.y) / MOST_WAVES;
        if wavelength < least {
            return Err(ImplicitSurfaceError::Wavelength { wavelength, least });
        }
    }
    Ok(())
}

fn dimension(name: &'static str, value: f64) -> Result<(), ImplicitSurfaceError> {
    let is_one = (SIZES[0]..=SIZES[1]).contains(&value);
    if is_one { Ok(()) } else { Err(ImplicitSurfaceError::Dimension { name, value }) }
}

fn number(name: &'static str, value: f64) -> Result<(), ImplicitSurfaceError> {
    let is_one = (0.0..=SIZES[1]).contains(&value);
    if is_one { Ok(()) } else { Err(ImplicitSurfaceError::Number { name, value }) }
}
