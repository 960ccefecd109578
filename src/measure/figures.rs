//! The figures of one view, from exact beams.

use crate::scene::Scope;
use crate::trace::beam::Beams;

/// A number for each band of a scope, in the scope's order.
pub type Zones = Vec<f64>;

/// What becomes of the light of one view, as fractions of the silhouette.
///
/// The sums of `surface` and `transmitted`, `absorbed` and `unresolved` add up to 1; those of `strongest_exit_area`
/// and `strongest_exit_undecided` likewise. By beams, glare is exact, transmitted and absorbed light may each be too
/// low by up to `unresolved`, and areas of strongest exits by up to what is undecided; by rays, `standard_error` is
/// that of sampling.
#[derive(Debug, Clone, PartialEq)]
pub struct Figures {
    /// Area of the silhouette, in squared girdle radii.
    pub silhouette_area: f64,
    /// Glare of the outer surface, by the band that it reflects.
    pub surface: Zones,
    /// Light from inside the stone, by the band that it comes from.
    pub transmitted: Zones,
    /// The part of the silhouette whose strongest exit lies in each band.
    pub strongest_exit_area: Zones,
    /// The part of the silhouette in which a stronger exit may be hidden in what is unresolved, or through which
    /// nothing leaves the stone at all.
    pub strongest_exit_undecided: f64,
    /// Absorbed inside the stone.
    pub absorbed: f64,
    /// Not followed to its end: bounds the error of each zone's light.
    pub unresolved: f64,
    /// Beams followed, or rays, in one domain of the symmetry.
    pub beams: usize,
    /// The largest standard error of any zone; 0 for beams, which sample nothing.
    pub standard_error: f64,
}

impl Figures {
    /// All the light that is accounted for; 1 but for rounding.
    pub fn sum(&self) -> f64 {
        self.surface.iter().chain(&self.transmitted).sum::<f64>() + self.absorbed + self.unresolved
    }

    /// The light return under the scope that these figures are of: light that has been inside the stone and comes from
    /// bands above the horizon that shine. For a scope with a border at the horizon; of a band on both sides of it,
    /// nothing is counted.
    pub fn light_return(&self, scope: &Scope) -> f64 {
        scope.shining().map(|k| self.transmitted[k]).sum()
    }

    /// The glare out of the same bands.
    pub fn glare_return(&self, scope: &Scope) -> f64 {
        scope.shining().map(|k| self.surface[k]).sum()
    }

    /// Adds the zone after `k` to zone `k`.
    pub(super) fn join(&mut self, k: usize) {
        for zones in [&mut self.surface, &mut self.transmitted, &mut self.strongest_exit_area] {
            let next = zones.remove(k + 1);
            zones[k] += next;
        }
    }
}

/// The figures of exact beams under a scope.
pub fn by_beams(beams: &Beams, scope: &Scope) -> Figures {
    let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
    let bands = scope.bands.len();
    let (mut surface, mut transmitted, mut strongest) =
        (vec![0.0; bands], vec![0.0; bands], vec![0.0; bands]);
    let mut absorbed = 0.0;
    for beam in beams.iter() {
        absorbed += beam.absorbed * share;
        if beam.weight > 0.0 {
            let zones = if beam.is_surface() { &mut surface } else { &mut transmitted };
            zones[scope.band(beam.exit, beams.zenith)] += beam.weight * beam.area * share;
        }
    }
    let cells = beams.strongest_exits();
    for cell in cells.iter().filter(|cell| !cell.undecided) {
        if let Some(exit) = cell.strongest {
            let band = scope.band(beams.get(exit).exit, beams.zenith);
            strongest[band] += beams.get(cell.outline).area * share;
        }
    }
    Figures {
        silhouette_area: beams.silhouette_area,
        surface,
        transmitted,
        strongest_exit_area: strongest,
        strongest_exit_undecided: beams.undecided(&cells),
        absorbed,
        unresolved: beams.unresolved(),
        beams: beams.len(),
        standard_error: 0.0,
    }
}
