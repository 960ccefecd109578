//! The figures of one view, and how they are summed up from exact beams.

use super::estimated::Estimate;
use brillianteer_scene::Scope;
use brillianteer_trace::beam::{BeamSums, Beams, SummedBeams};
use serde::{Deserialize, Serialize};

/// A number for each band of a scope, in the scope's order.
pub type Zones = Vec<f64>;

/// The shares of the light of one view, as fractions of the silhouette.
///
/// `surface`, `transmitted`, `absorbed` and the light that was not followed (see [`uncertain`](Self::uncertain)) add
/// up to 1, and so do `strongest_exit_area` and `strongest_exit_undecided`.
///
/// From beams, glare is exact. Transmitted and absorbed light may each be too low by up to `unresolved`, and the
/// areas of strongest exits by up to `strongest_exit_undecided`. Where the light that the beams left is estimated,
/// each of these contains its estimated part; without that part it is certainly not too high. From rays,
/// `standard_error` is the error of sampling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Area of the silhouette, in squared girdle radii.
    pub silhouette_area: f64,
    /// Glare of the outer surface, by the band whose light it reflects.
    pub surface: Zones,
    /// Light that has been inside the stone, by the band that it comes from.
    pub transmitted: Zones,
    /// The part of the silhouette whose strongest exit lies in each band.
    pub strongest_exit_area: Zones,
    /// The part of the silhouette where the strongest exit is not known: unresolved light may hide a stronger one, or no
    /// light leaves the stone at all.
    pub strongest_exit_undecided: f64,
    /// The part of the light that is absorbed inside the stone.
    pub absorbed: f64,
    /// The part of the light that was not followed to its end by beams, or by the rays of sampled figures. It bounds the
    /// error of each zone's light, whether it is estimated or not.
    pub unresolved: f64,
    /// The number of beams in one domain of the view's symmetry, or of rays that hit the stone.
    pub beams: usize,
    /// The largest standard error of the light of any zone; 0 for beams alone, which sample nothing.
    pub standard_error: f64,
    /// The estimated part of the figures, which they contain; `None` where all of them is exact or sampled.
    pub estimate: Option<Estimate>,
}

impl Figures {
    /// Returns all light that is accounted for: 1 up to rounding, and up to the error of an estimate.
    pub fn sum(&self) -> f64 {
        self.surface.iter().chain(&self.transmitted).sum::<f64>() + self.absorbed + self.uncertain()
    }

    /// Returns the largest standard error of the area of any zone's strongest exits.
    pub fn area_error(&self) -> f64 {
        match &self.estimate {
            Some(estimate) => estimate.area_errors().into_iter().fold(0.0, f64::max),
            None => self.standard_error,
        }
    }

    /// Returns the part of the light that is neither followed nor estimated.
    pub fn uncertain(&self) -> f64 {
        self.estimate.as_ref().map_or(self.unresolved, |estimate| estimate.unresolved)
    }

    /// Returns the light return under the scope that these figures were measured with: light that has been inside the
    /// stone and comes from shining bands above the horizon.
    ///
    /// The scope needs a border at the horizon: a band that lies on both sides of it is not counted.
    pub fn light_return(&self, scope: &Scope) -> f64 {
        scope.shining().map(|k| self.transmitted[k]).sum()
    }

    /// Returns the glare that comes from the same bands as [`light_return`](Self::light_return).
    pub fn glare_return(&self, scope: &Scope) -> f64 {
        scope.shining().map(|k| self.surface[k]).sum()
    }

    /// Adds the zone after `k` to zone `k`.
    pub(super) fn join(&mut self, k: usize) {
        for zones in [&mut self.surface, &mut self.transmitted, &mut self.strongest_exit_area] {
            let next = zones.remove(k + 1);
            zones[k] += next;
        }
        if let Some(estimate) = &mut self.estimate {
            estimate.join(k);
            self.standard_error = estimate.standard_error();
        }
    }
}

/// Returns the figures of exact beams under a scope.
pub fn by_beams(beams: &Beams, scope: &Scope) -> Figures {
    Figures::of_sums(BeamSums::of(beams, scope), beams.silhouette_area)
}

/// Returns the figures of summed beams, which equal those of [`by_beams`] to the last digit.
pub fn by_summed_beams(summed: &SummedBeams) -> Figures {
    Figures::of_sums(summed.sums.clone(), summed.open.silhouette_area)
}

impl Figures {
    fn of_sums(sums: BeamSums, silhouette_area: f64) -> Self {
        Self {
            silhouette_area,
            surface: sums.surface,
            transmitted: sums.transmitted,
            strongest_exit_area: sums.strongest_exit_area,
            strongest_exit_undecided: sums.undecided,
            absorbed: sums.absorbed,
            unresolved: sums.unresolved,
            beams: sums.beams,
            standard_error: 0.0,
            estimate: None,
        }
    }
}
