//! The solid of a glass shape: its implicit surface, or its planes where all faces are flat.

use super::{Cut, Glass, ProportionError};
use brillianteer_math::{ImplicitSurface, Plane};

impl Glass {
    /// Returns the shape's implicit surface, in girdle radii.
    ///
    /// # Errors
    /// The error names the dimension that is wrong, in the unit of its file.
    pub fn field(&self) -> Result<ImplicitSurface, ProportionError> {
        Cut::Glass(*self).check().map(|()| ImplicitSurface::checked(self.form(0.02)))
    }

    /// Returns the faces with their names and planes; `None` unless all faces are flat and all edges sharp.
    pub fn planes(&self) -> Option<Vec<(String, Plane)>> {
        let (Self::Cube(sides) | Self::Prism(sides)) = self else { return None };
        if sides.edge != 0.0 {
            return None;
        }
        let field = self.field().ok()?;
        let surface = field.surface(1);
        let plane = |(group, name): (u32, &&str)| {
            let triangle = surface.triangles.iter().zip(&surface.groups).find(|(_, g)| **g == group)?.0;
            let [a, b, c] = triangle.map(|v| surface.vertices[v as usize]);
            let normal = field.normal((a + b + c) / 3.0);
            Some(((*name).to_owned(), Plane::new(normal, normal.dot(a))))
        };
        // The surface's facets after the flat faces are its edges, which have no extent here.
        Some((0..).zip(field.facets()).filter_map(plane).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::family::Family;
    use super::super::glass::Sides;
    use super::super::glass_table::{CUBE, PILL, PLATE, PRISM};
    use super::*;
    use brillianteer_math::Polytope;

    fn families() -> impl Iterator<Item = (&'static Family, Glass)> {
        [&PILL, &CUBE, &PRISM, &PLATE].into_iter().map(|family| match family.first {
            Cut::Glass(glass) => (family, glass),
            _ => panic!("{} is no glass", family.key),
        })
    }

    /// Returns a shape with one dimension set.
    fn with(family: &Family, key: &str, value: f64) -> Glass {
        let mut cut = family.first.clone();
        family.proportion(key).unwrap().set(&mut cut, value);
        let Cut::Glass(glass) = cut else { panic!("{} is no glass", family.key) };
        glass
    }

    #[test]
    fn every_shape_can_be_made_and_what_is_sharp_has_planes() {
        for (family, glass) in families() {
            let volume = glass.field().unwrap().volume();
            let sharp = with(family, "edge", 0.0);
            let planes = sharp.planes();
            assert_eq!(planes.is_some(), ["cube", "prism"].contains(&family.key), "{}", family.key);
            if let Some(planes) = planes {
                let solid =
                    Polytope::from_planes(&planes.iter().map(|(_, p)| *p).collect::<Vec<_>>()).unwrap();
                assert!((solid.volume() - sharp.field().unwrap().volume()).abs() < 1e-12);
                let faces = if family.key == "cube" { 6 } else { 5 };
                assert!(solid.volume() >= volume - 1e-12 && planes.len() == faces);
            }
        }
    }

    #[test]
    fn impossible_dimensions_are_named_in_percent() {
        for (family, _) in families() {
            for row in family.proportions {
                let error = with(family, row.key, f64::NAN).field().unwrap_err();
                assert_eq!(error.row(), row);
            }
        }
        let told = |family, key, value| with(family, key, value).field().unwrap_err().to_string();
        assert_eq!(
            told(&CUBE, "edge", 51.0),
            "edge: 51 % must be at most 50 %, for which the shape has room; lower it by at least 1"
        );
        let mut still = Cut::Glass(with(&PLATE, "amplitude", 0.0));
        PLATE.proportion("wavelength").unwrap().set(&mut still, 0.3);
        let short = still.check().unwrap_err().to_string();
        assert!(
            short.starts_with("wavelength: 0.3 % must be at least 0.5 %, the shortest wave of so"),
            "{short}"
        );
        assert!(
            told(&PLATE, "amplitude", 300.0).starts_with("amplitude: 300 % must be at most 196.84 %, where")
        );
        assert!(
            told(&PILL, "length", -3.0).starts_with("length: -3 % must be at least 0.0001 %, the smallest")
        );
    }

    #[test]
    fn what_is_too_small_to_compute_with_is_told_in_percent_as_it_was_written() {
        // A length that is a possible number of girdle radii were it in percent, and an edge that rounding takes past
        // its room.
        let small = with(&CUBE, "depth", 2e-5).field().unwrap_err().to_string();
        assert!(small.starts_with("depth: 2e-5 % must be at least 0.0001 %"), "{small}");
        for k in 1..2000 {
            let sides =
                Sides { length: 100.0, width: 0.37 * f64::from(k), depth: 0.13 * f64::from(k), edge: 0.0 };
            let edge = Glass::Prism(sides).form(1.0).largest_edge();
            let field = Glass::Prism(Sides { edge, ..sides }).field();
            assert!(field.is_ok_and(|field| field.volume() > 0.0), "{k}");
        }
    }
}
