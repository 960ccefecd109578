//! The graphics card that a renderer may use.

#[cfg(feature = "gpu")]
use brillianteer_trace::gpu::{Gpu, GpuError};
#[cfg(feature = "gpu")]
use std::sync::{Arc, OnceLock};

/// The graphics card that a renderer may use.
#[derive(Clone, Default)]
pub enum Card {
    /// No card: the processor does all work.
    #[default]
    None,
    /// The machine's card, which is opened at its first use and stays open until the program ends.
    Machine,
    /// A card that is open already and quicker than the processor, such as one that draws the window.
    #[cfg(feature = "gpu")]
    Open(Arc<Gpu>),
}

/// A tracer with the card that it runs on.
#[derive(Clone)]
pub enum Backend {
    /// Exact beams, on the processor.
    Beams,
    /// Point rays on the processor.
    Rays,
    /// Point rays on a graphics card.
    #[cfg(feature = "gpu")]
    Card(Arc<Gpu>),
}

/// Returns the machine's card, which is opened once.
#[cfg(feature = "gpu")]
fn machine() -> Result<Arc<Gpu>, GpuError> {
    static CARD: OnceLock<Result<Arc<Gpu>, GpuError>> = OnceLock::new();
    CARD.get_or_init(|| Gpu::open().map(Arc::new)).clone()
}

impl Card {
    /// Returns rays on the card, even one that is slower than the processor.
    ///
    /// # Errors
    /// Returns the reason why there is no card.
    pub fn any(&self) -> Result<Backend, NoCard> {
        match self {
            Self::None => Err(NoCard("no graphics card is used".to_owned())),
            #[cfg(feature = "gpu")]
            Self::Machine => machine().map(Backend::Card).map_err(|error| NoCard(error.to_string())),
            #[cfg(not(feature = "gpu"))]
            Self::Machine => Err(NoCard("this program was built without its feature `gpu`".to_owned())),
            #[cfg(feature = "gpu")]
            Self::Open(gpu) => Ok(Backend::Card(Arc::clone(gpu))),
        }
    }

    /// Returns rays on the card where it is quicker than the processor; a card in software is not.
    pub fn quick(&self) -> Option<Backend> {
        let is_known = !matches!(self, Self::Machine);
        self.any().ok().filter(|card| is_known || card.is_quick())
    }
}

/// The reason why there is no graphics card.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoCard(String);

impl NoCard {
    /// Returns the reason why stones with frosted facets are never traced by a card.
    pub fn frosted() -> Self {
        Self("graphics cards do not scatter light at frosted facets yet".to_owned())
    }
}

impl Backend {
    /// Returns the short name that figures use: `beam`, `ray` or `gpu`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Beams => "beam",
            Self::Rays => "ray",
            #[cfg(feature = "gpu")]
            Self::Card(_) => "gpu",
        }
    }

    /// Returns a description in words, with the name of the card.
    pub fn description(&self) -> String {
        match self {
            Self::Beams => "exact beams".to_owned(),
            Self::Rays => "point rays".to_owned(),
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => format!("point rays in f32 on {}", gpu.name()),
        }
    }

    /// Returns the kind of the tracer, without the name of the card.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Beams => "exact beams",
            Self::Rays => "point rays",
            #[cfg(feature = "gpu")]
            Self::Card(_) => "rays on the graphics card",
        }
    }

    /// Returns whether the tracer is rays on the processor, which take longer than all others.
    pub fn is_slow(&self) -> bool {
        matches!(self, Self::Rays)
    }

    /// Returns whether the tracer is exact beams.
    pub fn is_beams(&self) -> bool {
        matches!(self, Self::Beams)
    }

    /// Returns the graphics card, or the driver in software, that traces; `None` for the other tracers.
    #[cfg(feature = "gpu")]
    pub fn gpu(&self) -> Option<&Arc<Gpu>> {
        match self {
            Self::Beams | Self::Rays => None,
            Self::Card(gpu) => Some(gpu),
        }
    }

    /// Returns a note for a driver that only acts as a graphics card, which is slower than rays; `None` for all other
    /// tracers.
    pub fn note_of_software(&self) -> Option<String> {
        match self {
            Self::Beams | Self::Rays => None,
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => gpu.is_software().then(|| {
                format!(
                    "{} is no graphics card: it computes in software, on the processor; the tracer by rays is quicker",
                    gpu.name()
                )
            }),
        }
    }

    /// Returns whether the tracer is a real graphics card, and not one in software.
    pub fn is_quick(&self) -> bool {
        match self {
            Self::Beams | Self::Rays => false,
            #[cfg(feature = "gpu")]
            Self::Card(gpu) => !gpu.is_software(),
        }
    }
}

impl std::fmt::Debug for Backend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.description())
    }
}

impl std::fmt::Debug for Card {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::None => "no card",
            Self::Machine => "the machine's card",
            #[cfg(feature = "gpu")]
            Self::Open(gpu) => gpu.name(),
        })
    }
}
