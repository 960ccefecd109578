//! Makes the metal of a ring and the places of its stones, and checks that both fit.

use super::gem::{MountedStone, SetStone, TOUCHING_MM};
use super::{MetalPart, Mounting, RING_NUMBERS, Ring, RingError, band, halo, head, row};
use glam::DVec3;

impl Ring {
    /// Makes the metal and the places of the stones: `stone` is the main stone, `small` one of the small stones, whose
    /// diameter is `small_diameter_mm`.
    ///
    /// # Errors
    /// Fails where a number is out of its range, where stones are missing or too many, or where parts do not fit; the
    /// error gives the excess.
    pub fn mounting(
        &self,
        stone: Option<&SetStone>,
        small: Option<&SetStone>,
    ) -> Result<Mounting, RingError> {
        self.check(stone.is_some(), small.is_some())?;
        let mut mounting = Mounting::default();
        mounting.metal.push(MetalPart { name: "band", surface: band::band(self) });
        let mut mounted = vec![];
        match (stone, small) {
            (None, None) => {}
            (Some(stone), None) => mounted = head::head(self, stone, &mut mounting)?,
            (Some(stone), Some(small)) => mounted = halo::halo(self, stone, small, &mut mounting)?,
            (None, Some(small)) => mounted = row::eternity(self, small, &mut mounting)?,
        }
        mounting.check(&mounted)?;
        Ok(mounting)
    }

    /// Returns the number of stones that the ring holds: that of the seats of [`mounting`](Self::mounting), without making the
    /// metal. `stone` and `small` are as there.
    ///
    /// # Errors
    /// Fails where a number is out of its range, and where stones are missing or too many. Whether the metal fits is not
    /// examined.
    pub fn stone_count(
        &self,
        stone: Option<&SetStone>,
        small: Option<&SetStone>,
    ) -> Result<usize, RingError> {
        self.check(stone.is_some(), small.is_some())?;
        match (stone, small) {
            (None, None) => Ok(0),
            (Some(_), None) => Ok(1),
            (Some(stone), Some(small)) => Ok(1 + halo::halo_count(self, stone, small)?),
            (None, Some(small)) => row::eternity_count(self, small),
        }
    }

    /// Checks the numbers, and whether exactly the stones are given that the style holds.
    ///
    /// # Errors
    /// The error names the first fault.
    pub fn check(&self, has_stone: bool, has_small: bool) -> Result<(), RingError> {
        let style = self.style;
        RING_NUMBERS.iter().try_for_each(|number| number.check(self))?;
        let rise = self.comfort_mm - 0.6 * self.thickness_mm;
        if rise > 0.0 {
            return Err(RingError::NoRoom {
                key: "comfort_mm",
                what: "the inside rises through more than 60 percent of thickness_mm,",
                by_mm: rise,
                change: "lower it or raise thickness_mm",
            });
        }
        match (style.prongs() > 0, has_stone, style.has_small(), has_small) {
            (true, false, ..) => Err(RingError::NoStone { style }),
            (false, true, ..) => Err(RingError::NoPlace { key: "stone", style }),
            (_, _, true, false) => Err(RingError::NoSmallStone { style }),
            (_, _, false, true) => Err(RingError::NoPlace { key: "small_stone", style }),
            _ => Ok(()),
        }
    }
}

impl Mounting {
    /// Checks that no metal lies inside a stone.
    fn check(&self, stones: &[MountedStone]) -> Result<(), RingError> {
        for part in &self.metal {
            let surface = &part.surface;
            let triangles = (0..surface.corners.len()).map(|k| surface.triangle(k));
            let depth = |triangle: [DVec3; 3]| stones.iter().map(move |stone| stone.depth_of(triangle));
            let by_mm = triangles.flat_map(depth).fold(0.0, f64::max);
            if by_mm > TOUCHING_MM {
                return Err(RingError::InsideStone { part: part.name, by_mm });
            }
        }
        Ok(())
    }
}
