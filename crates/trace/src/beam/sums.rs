//! The sums of beams by the bands of a scope. A beam that is summed up and split need not be kept.

use super::cells::StrongestExit;
use super::tree::Beams;
use brillianteer_scene::Scope;

/// The light of beams as parts of the silhouette, by the bands of a scope.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamSums {
    /// The glare of the outer surface, by the band whose light it reflects.
    pub surface: Vec<f64>,
    /// The light that has been inside the stone, by the band from which it comes.
    pub transmitted: Vec<f64>,
    /// The part of the silhouette whose strongest exit lies in each band.
    pub strongest_exit_area: Vec<f64>,
    /// The part of the silhouette whose strongest exit is not certain, or that has no exit.
    pub undecided: f64,
    /// The light that is absorbed.
    pub absorbed: f64,
    /// The light that was not followed to its end.
    pub unresolved: f64,
    /// The number of beams.
    pub beams: usize,
}

impl BeamSums {
    /// Sums up all beams of a tree.
    pub fn of(beams: &Beams, scope: &Scope) -> Self {
        let mut adder = BeamAdder::new(beams, scope);
        adder.take_in(beams);
        adder.finish(beams)
    }
}

/// The strongest exit known so far along the path of a beam, and whether the beam was split.
#[derive(Clone, Copy)]
pub(crate) struct Standing {
    /// The strongest exit along the path, as a band of the scope.
    pub strongest: StrongestExit<u32>,
    /// True where the beam was split further.
    is_parted: bool,
}

/// Adds up beams in the order of their ids, as the tree grows.
pub(super) struct BeamAdder {
    scope: Scope,
    /// The part of the silhouette that a unit of area in one domain of the symmetry represents.
    share: f64,
    /// The area in one domain whose strongest exit will never be known.
    undecided: f64,
    sums: BeamSums,
    /// The standings of the beams that have been added and are still in the tree.
    standings: Vec<Standing>,
}

impl BeamAdder {
    /// Returns an adder for a view, to which no beam has been added yet.
    pub fn new(beams: &Beams, scope: &Scope) -> Self {
        let zeros = vec![0.0; scope.bands.len()];
        let sums = BeamSums {
            surface: zeros.clone(),
            transmitted: zeros.clone(),
            strongest_exit_area: zeros,
            undecided: 0.0,
            absorbed: 0.0,
            unresolved: 0.0,
            beams: 0,
        };
        let share = f64::from(beams.symmetry.order()) / beams.silhouette_area;
        Self { scope: scope.clone(), share, undecided: 0.0, sums, standings: vec![] }
    }

    /// Adds the beams that the tree has gained since the last call.
    pub fn take_in(&mut self, beams: &Beams) {
        let Self { scope, share, undecided, sums, standings } = self;
        let new = standings.len() as u32..beams.len() as u32;
        sums.beams += new.len();
        for id in new {
            let beam = beams.get(id);
            sums.absorbed += beam.absorbed * *share;
            let band = (beam.weight > 0.0).then(|| scope.band(beam.exit, beams.zenith));
            if let Some(band) = band {
                let zones = if beam.is_surface() { &mut sums.surface } else { &mut sums.transmitted };
                zones[band] += beam.weight * beam.area * *share;
            }
            let before = beam.parent.map(|parent| &mut standings[parent as usize]);
            let before = before.map(|parent| {
                parent.is_parted = true;
                parent.strongest
            });
            let strongest = StrongestExit::of(&beam, before.as_ref(), band.map(|band| band as u32));
            if strongest.is_decided && !before.is_some_and(|before| before.is_decided) {
                match strongest.exit {
                    Some(band) => sums.strongest_exit_area[band as usize] += beam.area * *share,
                    None => *undecided += beam.area,
                }
            }
            standings.push(Standing { strongest, is_parted: false });
        }
    }

    /// Forgets all beams except these, whose ids ascend and become the numbers 0, 1, 2 and so on. The other beams
    /// must not be split any more.
    pub fn keep(&mut self, ids: &[u32], beams: &Beams) {
        let mut kept = ids.iter().peekable();
        for (id, standing) in (0..).zip(&self.standings) {
            if kept.next_if_eq(&&id).is_none() && standing.is_left_undecided() {
                self.undecided += beams.get(id).area;
            }
        }
        for (new, &id) in ids.iter().enumerate() {
            self.standings[new] = self.standings[id as usize];
        }
        self.standings.truncate(ids.len());
    }

    /// Returns the sums. The tree must not grow any more.
    pub fn finish(&self, beams: &Beams) -> BeamSums {
        let left = (0..).zip(&self.standings).filter(|(_, standing)| standing.is_left_undecided());
        let undecided = left.fold(self.undecided, |area, (id, _)| area + beams.get(id).area);
        BeamSums { undecided: undecided * self.share, unresolved: beams.unresolved(), ..self.sums.clone() }
    }

    /// Returns the standings of the beams that were kept.
    pub fn into_standings(self) -> Vec<Standing> {
        self.standings
    }
}

impl Standing {
    /// Returns whether the strongest exit seen through the whole beam is not certain and no later beam will decide
    /// it.
    fn is_left_undecided(&self) -> bool {
        !self.strongest.is_decided && !self.is_parted
    }
}
