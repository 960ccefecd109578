//! The limits of a graphics card for each kind of thing. The shaders are compiled with most of these numbers.

use brillianteer_scene::MOST_STONES;

/// The most planes that fit into the uniform array, 16 KiB.
pub(super) const MOST_UNIFORM: usize = 1024;

/// The most stones that one picture may hold.
pub const MOST_BODIES: usize = MOST_STONES;

/// The most bodies of metal that one picture may hold, which fill a uniform array of 16 KiB.
pub const MOST_METALS: usize = 256;

/// The most kinds of roughness that the metal of one picture may have, whose tables fit into a uniform array of 16
/// KiB.
pub const MOST_ROUGHNESSES: usize = 15;

/// The most triangles that one picture may hold. At 48 bytes each they fit into a buffer below the 128 MiB that all
/// cards take, and their indices are exact in f32. Triangles of metal count twice, because their smooth normals take
/// as much room.
pub const MOST_TRIANGLES: usize = 2_500_000;

/// The greatest depth of boxes within boxes.
pub(super) const MOST_LEVELS: usize = 56;

/// The most exits of one ray that may wait to enter a stone that is not convex again. Rays in hearts and stars leave
/// some ten waiting at once.
pub(super) const MOST_INBOUND: usize = 16;

/// The most bounces of a ray on a graphics card. Chains of very different lengths side by side would leave most of
/// the card idle.
pub const MOST_BOUNCES: u32 = 64;

/// The most bands of a scope that a graphics card traces.
pub const MOST_CARD_BANDS: usize = 8;

/// The most wavelengths that one sample pass may have.
pub const MOST_WAVELENGTHS: usize = 64;

/// The number of workgroups in a row of a dispatch; every card takes 65,535.
pub(super) const GROUPS_ACROSS: u32 = 1 << 15;
