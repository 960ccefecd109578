//! What dimensions a shape may have.

use super::ImplicitForm;
use super::profile::inradius;

/// Dimensions, in girdle radii: squares of their quotients keep their digits.
const SIZES: [f64; 2] = [1e-6, 1e6];

/// Slope of a plate's wave at its steepest. There a plate is an eighth as thick as along z.
const STEEPEST: f64 = 8.0;

/// Waves that the greater of a plate's sides holds at most.
const MOST_WAVES: f64 = 200.0;

/// Why there is no such shape.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ImplicitSurfaceError {
    /// A dimension is no number, 0, negative, or out of what is computed with.
    #[error("{name} is {value}; it must be a number from 1e-6 to 1e6 girdle radii")]
    Dimension {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A number that may be 0 is none, or negative or too large.
    #[error("{name} is {value}; it must be a number from 0 to 1e6")]
    Number {
        /// Which.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// An edge, of a pane also an outline's corner, is rounder than the shape is wide.
    #[error("the edge's radius is {edge}; in this shape there is room for {most}")]
    Edge {
        /// What was given.
        edge: f64,
        /// The largest.
        most: f64,
    },
    /// The wave is too steep.
    #[error(
        "the wave is as steep as {slope:.2}; at most 8: make its amplitude smaller or the wavelength longer"
    )]
    Slope {
        /// Its greatest slope, 2π amplitude / wavelength.
        slope: f64,
    },
    /// The wave is too short.
    #[error("the wavelength is {wavelength}; for a plate so large it must be {least} or more")]
    Wavelength {
        /// What was given.
        wavelength: f64,
        /// The shortest.
        least: f64,
    },
}

/// Refuses what is no shape.
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
    let most = match *form {
        ImplicitForm::Pane { corner, .. } => corner.min(size.z / 2.0),
        ImplicitForm::Prism { .. } => (size.x / 2.0).min(inradius(size.y, size.z)),
        _ => size.min_element() / 2.0,
    };
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
