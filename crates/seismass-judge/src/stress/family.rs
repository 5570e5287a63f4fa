//! The families of random scenes.

use seismass::{Motion, Scene};

use super::hard_scene::{hard_scene, stiff_scene};
use super::tall_scene::tall_scene;
use crate::law_scene::law_scene;
use crate::random_scene::{Draw, random_scene};

/// One scene in so many is of the hard family.
const HARD: u64 = 8;
/// One of the others in so many is of the stiff family.
const STIFF: u64 = 200;
/// One of the others in so many is of the tall family.
const TALL: u64 = 200;
/// One of the others in so many is of the family of laws.
const LAWS: u64 = 4;

/// What a random scene's numbers are drawn from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Family {
    /// Buildings as they are, up to 12 storeys: [`random_scene`].
    #[default]
    Usual,
    /// Numbers from ranges far wider than buildings have: [`hard_scene`].
    Hard,
    /// Of the hard ones those with many vibrations in a step, and heavy goods: `stiff_scene`.
    Stiff,
    /// 13 to 64 storeys: [`tall_scene`].
    Tall,
    /// Springs of the further laws, and blocks that wear: [`law_scene`].
    Laws,
}

impl Family {
    /// All families, each at its place in the tally's arrays.
    pub const ALL: [Self; 5] = [Self::Usual, Self::Hard, Self::Stiff, Self::Tall, Self::Laws];

    /// The family that the seed's scene is of.
    pub fn of(seed: u64) -> Self {
        if Draw(!seed).one_in(HARD) {
            Self::Hard
        } else if Draw(seed.rotate_left(8)).one_in(STIFF) {
            Self::Stiff
        } else if Draw(seed.rotate_left(32)).one_in(TALL) {
            Self::Tall
        } else if Draw(seed.rotate_left(16)).one_in(LAWS) {
            Self::Laws
        } else {
            Self::Usual
        }
    }

    /// The family's name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Usual => "usual",
            Self::Hard => "hard",
            Self::Stiff => "stiff",
            Self::Tall => "tall",
            Self::Laws => "laws",
        }
    }

    /// The seed's scene of this family.
    ///
    /// # Errors
    /// None for any seed.
    pub fn scene(self, seed: u64) -> seismass::Result<(Scene, Motion)> {
        match self {
            Self::Usual => random_scene(seed),
            Self::Hard => hard_scene(seed),
            Self::Stiff => stiff_scene(seed),
            Self::Tall => tall_scene(seed),
            Self::Laws => law_scene(seed),
        }
    }

    /// How much more often than others its scenes are compared with the judge.
    pub fn judged(self) -> f64 {
        match self {
            Self::Usual | Self::Hard => 1.0,
            Self::Laws => 2.0,
            Self::Stiff | Self::Tall => 5.0,
        }
    }
}

/// The seed's scene, of the family that the seed draws.
///
/// # Errors
/// None for any seed.
pub fn scene_of(seed: u64) -> seismass::Result<(Scene, Motion)> {
    Family::of(seed).scene(seed)
}
