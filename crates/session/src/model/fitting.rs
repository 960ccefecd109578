//! The forms of two dialogs: one fits the design to another material, one to a piece of rough or a weight.

use brillianteer_base::Failure;
use brillianteer_cut::{
    Design, Finished, MaterialRef, RetargetError, RetargetRule, Retargeted, Rough, RoughError, Size, retarget,
};
use brillianteer_scene::{Specimen, Stone};

/// A rule by which angles follow a material, without its factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitRule {
    /// Each pavilion tier turns by the difference of the critical angles. Meets that tiers keep are solved anew.
    CriticalAngle,
    /// The tangents of all pavilion angles are multiplied by one factor, which keeps every meet.
    Pavilion,
    /// The tangents of all crown angles are multiplied by one factor, which keeps every meet.
    Crown,
}

impl FitRule {
    /// All rules, in the order in which lists show them.
    pub const ALL: [Self; 3] = [Self::CriticalAngle, Self::Pavilion, Self::Crown];

    /// Returns the name that lists show.
    pub fn name(self) -> &'static str {
        match self {
            Self::CriticalAngle => "Critical angle",
            Self::Pavilion => "Tangent ratio of the pavilion",
            Self::Crown => "Tangent ratio of the crown",
        }
    }

    /// Returns the meaning of the rule, in whole sentences.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::CriticalAngle => {
                "Each pavilion tier turns by the difference of the critical angles. Meets that tiers keep are solved anew."
            }
            Self::Pavilion => {
                "The tangents of all pavilion angles are multiplied by one factor, which keeps every meet."
            }
            Self::Crown => {
                "The tangents of all crown angles are multiplied by one factor, which keeps every meet."
            }
        }
    }
}

/// The choices in the dialog that fits the design to another material.
#[derive(Debug, Clone, PartialEq)]
pub struct FitOptions {
    /// The new material.
    pub material: MaterialRef,
    /// The rule by which the angles change.
    pub rule: FitRule,
    /// The typed factor of the tangents; `None` for the rule's own factor, which keeps the main tier's margin over
    /// the critical angle and leaves the crown as it is.
    pub factor: Option<f64>,
}

impl FitOptions {
    fn rule(&self) -> RetargetRule {
        match self.rule {
            FitRule::CriticalAngle => RetargetRule::CriticalAngle,
            FitRule::Pavilion => RetargetRule::PavilionRatio(self.factor),
            FitRule::Crown => RetargetRule::CrownRatio(self.factor.unwrap_or(1.0)),
        }
    }
}

/// The light of a stone face up in the ASET, as parts of its face.
#[derive(Debug, Clone, PartialEq)]
pub struct StoneLight {
    /// Light that returns to the viewer's side.
    pub light_return: f64,
    /// Light that leaves below.
    pub leakage: f64,
    /// The greatest error of the two figures.
    pub error: f64,
    /// The weight, carats; `None` where the density is not known.
    pub carats: Option<f64>,
}

/// The stones whose light is compared, to be measured in the background.
#[derive(Debug, Clone)]
pub struct LightRequest {
    /// The number of the question, which comes back with the answer.
    pub number: u64,
    /// The stones, each with the words that say which it is.
    pub stones: Vec<(String, Design)>,
}

/// The state of the dialog that fits the design to another material.
#[derive(Debug, Clone)]
pub struct RetargetForm {
    /// The design as it is.
    pub design: Design,
    /// The choices of the dialog.
    pub options: FitOptions,
    /// The fitted design, or the reason why there is none.
    pub found: Result<Box<Retargeted>, RetargetError>,
    /// The number of the last question for light.
    pub asked: u64,
    /// The light of the old angles in both materials and of the new angles; `None` while it is measured.
    pub light: Option<Result<Vec<StoneLight>, Failure>>,
}

impl RetargetForm {
    /// Begins with the material that the design has, under the rule that keeps every meet.
    pub fn new(design: &Design) -> Self {
        let options = FitOptions { material: design.material.clone(), rule: FitRule::Pavilion, factor: None };
        let found = retarget(design, options.material.clone(), options.rule()).map(Box::new);
        Self { design: design.clone(), options, found, asked: 0, light: None }
    }

    /// Takes other options and fits the design anew.
    pub fn set(&mut self, options: FitOptions) {
        self.found = retarget(&self.design, options.material.clone(), options.rule()).map(Box::new);
        (self.options, self.light) = (options, None);
        self.asked += 1;
    }

    /// Returns the stones whose light is to be measured: the design as it is, its angles in the new material, and the new
    /// design. `None` where there is no new design.
    pub fn light_request(&self) -> Option<LightRequest> {
        let fitted = self.found.as_ref().ok()?;
        let named =
            |material: &MaterialRef| material.material().map_or_else(|_| "?".to_owned(), |found| found.name);
        let (from, to) = (named(&self.design.material), named(&self.options.material));
        let same_angles = Design { material: self.options.material.clone(), ..self.design.clone() };
        let stones = vec![
            (format!("as it is, {from}"), self.design.clone()),
            (format!("as it is, {to}"), same_angles),
            (format!("fitted, {to}"), fitted.design.clone()),
        ];
        Some(LightRequest { number: self.asked, stones })
    }

    /// Takes the light that was measured, if it answers the last question.
    pub fn take_light(&mut self, number: u64, light: Result<Vec<StoneLight>, Failure>) {
        if number == self.asked {
            self.light = Some(light);
        }
    }
}

/// The quantity that decides the size of a finished stone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SizeBy {
    /// The largest stone that fits into a box, table up, turned as it fits best.
    Rough,
    /// The stone that has this weight.
    Weight,
}

impl SizeBy {
    /// All variants, in the order in which lists show them.
    pub const ALL: [Self; 2] = [Self::Rough, Self::Weight];

    /// Returns the name that lists show.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rough => "Piece of rough",
            Self::Weight => "Wanted weight",
        }
    }

    /// Returns the meaning of the variant, in whole sentences.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Rough => "The largest stone that fits into a box, table up, turned as it fits best.",
            Self::Weight => "The stone that has this weight.",
        }
    }
}

/// The numbers that are typed in the dialog of size and yield.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldOptions {
    /// The quantity that decides the size.
    pub by: SizeBy,
    /// The rough's length, width and depth, mm.
    pub sides_mm: [f64; 3],
    /// The weight of the stone that is wanted, carats.
    pub carats: f64,
    /// The weight of the rough, carats; `None` where it is not known.
    pub rough_carats: Option<f64>,
    /// The thickness of the finished girdle, mm; `None` for that of the design.
    pub girdle_mm: Option<f64>,
}

/// The state of the dialog of size and yield.
#[derive(Debug, Clone)]
pub struct YieldForm {
    /// The numbers in the fields.
    pub options: YieldOptions,
    /// The numbers with which the dialog began.
    pub first: YieldOptions,
    /// The finished stone, or why there is none.
    pub found: Result<Finished, RoughError>,
}

impl YieldForm {
    /// Begins with the box around the stone as it is, and with its weight.
    pub fn new(specimen: &Specimen, stone: &Stone) -> Self {
        let (low, high) = stone.polytope.bounds();
        let sides_mm = ((high - low) * specimen.unit_mm()).to_array().map(|mm| (10.0 * mm).ceil() / 10.0);
        let carats = specimen.carats().unwrap_or(1.0);
        let by = SizeBy::Rough;
        let options = YieldOptions { by, sides_mm, carats, rough_carats: None, girdle_mm: None };
        Self { options, first: options, found: finished(&options, specimen, stone) }
    }

    /// Takes other numbers and finds the stone anew.
    pub fn set(&mut self, options: YieldOptions, specimen: &Specimen, stone: &Stone) {
        (self.options, self.found) = (options, finished(&options, specimen, stone));
    }
}

fn finished(options: &YieldOptions, specimen: &Specimen, stone: &Stone) -> Result<Finished, RoughError> {
    let YieldOptions { by, sides_mm, carats, girdle_mm, .. } = *options;
    match by {
        SizeBy::Rough => Finished::from_rough(&stone.polytope, &Rough::new(sides_mm)?, girdle_mm),
        SizeBy::Weight => {
            Finished::of_size(&stone.polytope, Size::Carats(carats), &specimen.material, girdle_mm)
        }
    }
}
