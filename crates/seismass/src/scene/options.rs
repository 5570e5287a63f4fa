//! What a run gives back.

/// What a run gives back beside peaks, residuals and statistics.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// Histories at every so many samples.
    pub histories: Option<std::num::NonZeroUsize>,
    /// Histories of drifts and slips alone: those of velocities, accelerations and forces stay empty.
    pub displacements_only: bool,
    /// Energies and their residual.
    pub energy: bool,
    /// Peaks of floor forces; chains of storeys in one direction alone.
    pub floor_force: bool,
    /// The event log.
    pub events: bool,
    /// Nothing but peaks is wanted: the run may stop when none can be beaten any more, and residuals are NaN. Without
    /// effect where histories or energies are asked for.
    pub peaks_only: bool,
}

impl Options {
    /// Peaks alone, as a study asks for them.
    pub const PEAKS: Self = Self {
        histories: None,
        displacements_only: false,
        energy: false,
        floor_force: false,
        events: false,
        peaks_only: true,
    };
}
