//! What a run gives back: peaks in continuous time, residuals, events, histories, energies, statistics.

use std::fmt::{Display, Formatter};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum Status {
    /// The motion ended.
    Completed,
    /// A storey reached its collapse drift: the run stops there, later history is NaN.
    Collapsed {
        /// Storey, counted from 1.
        storey: usize,
        /// Time (s).
        time: f64,
    },
}

/// Largest absolute value over continuous time, and when it was first reached.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Peak {
    /// Absolute value (SI).
    pub value: f64,
    /// Time (s).
    pub time: f64,
}

impl Peak {
    /// Takes a value if it beats the peak; tells whether it did.
    #[inline]
    pub(crate) fn take(&mut self, value: f64, time: f64) -> bool {
        let beats = value.abs() > self.value;
        if beats {
            *self = Self { value: value.abs(), time };
        }
        beats
    }
}

/// Peaks in continuous time. Storeys, floors and blocks in order; index 0 is storey 1.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Peaks {
    /// Storey drift (m).
    pub drift: Vec<Peak>,
    /// Slip of each block, block displacement minus floor displacement (m).
    pub slip: Vec<Peak>,
    /// Absolute floor acceleration; where it jumps both one-sided limits count (m/s2).
    pub floor_acceleration: Vec<Peak>,
    /// Storey shear: the spring force alone, without damping and P-Delta (N). Base shear is that of storey 1.
    pub storey_shear: Vec<Peak>,
}

/// Kinds of events (`numerics`, section 5).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum EventKind {
    /// A spring comes to the next segment of its backbone.
    Yield,
    /// The storey velocity turns and the spring leaves its backbone, or the line on which it reloads.
    Unload,
    /// A peak-oriented spring begins to reload: at zero force, or where it had begun to unload.
    Reload,
    /// A stop of a storey touches.
    Close,
    /// A stop of a storey is left.
    Open,
    /// A stuck block breaks away.
    Slip,
    /// A sliding block comes to rest on its floor.
    Stick,
    /// The relative velocity passes zero without sticking.
    Reverse,
    /// The relative velocity reaches zero and goes on as before.
    Touch,
    /// The contact force falls to zero.
    Lift,
    /// The contact force is positive again.
    Land,
    /// The friction coefficients of a block change with the path it has slipped.
    Wear,
    /// A block comes to a stop of its own.
    TouchStop,
    /// A block leaves a stop of its own.
    LeaveStop,
}

impl EventKind {
    /// All kinds, in the order of [`EventCounts`].
    pub const ALL: [Self; 14] = [
        Self::Yield,
        Self::Unload,
        Self::Reload,
        Self::Close,
        Self::Open,
        Self::Slip,
        Self::Stick,
        Self::Reverse,
        Self::Touch,
        Self::Lift,
        Self::Land,
        Self::Wear,
        Self::TouchStop,
        Self::LeaveStop,
    ];

    /// Lower-case name as in event tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Yield => "yield",
            Self::Unload => "unload",
            Self::Reload => "reload",
            Self::Close => "close",
            Self::Open => "open",
            Self::Slip => "slip",
            Self::Stick => "stick",
            Self::Reverse => "reverse",
            Self::Touch => "touch",
            Self::Lift => "lift",
            Self::Land => "land",
            Self::Wear => "wear",
            Self::TouchStop => "touch_stop",
            Self::LeaveStop => "leave_stop",
        }
    }
}

impl Display for EventKind {
    /// The [`name`](Self::name).
    fn fmt(&self, out: &mut Formatter) -> std::fmt::Result {
        out.pad(self.name())
    }
}

/// One event of the log.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Event {
    /// Time (s).
    pub time: f64,
    /// What happened.
    pub kind: EventKind,
    /// Storey for yield, unload, reload, close and open, otherwise block; counted from 1.
    pub number: usize,
    /// Sign: yield, of the force; unload, of the force before; reload, of the force that follows; close and open, of the
    /// drift; slip and reverse, of the relative velocity that follows; stick, of the one before; touch, lift, land, wear,
    /// of the one then (0: none); touch_stop and leave_stop, of the side of the stop.
    pub sign: i8,
    /// Yield: how many segments of the backbone have been left, 1 at first yield; wear: the stage that begins; otherwise 0.
    pub element: u8,
}

/// How often each kind of event happened, in the order of [`EventKind::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct EventCounts(pub [usize; EventKind::ALL.len()]);

impl EventCounts {
    /// Number of events of a kind.
    pub fn of(&self, kind: EventKind) -> usize {
        self.0[kind as usize]
    }

    /// Number of all events.
    pub fn total(&self) -> usize {
        self.0.iter().sum()
    }

    pub(crate) fn add(&mut self, kind: EventKind) {
        self.0[kind as usize] += 1;
    }
}

/// Histories at every `every`-th sample, row-major: `rows` x storeys or `rows` x blocks. A row at the time of an event is
/// the state after it.
///
/// They are memory of their own in each run. Where the allocator gives it back to the system in between, the faults of its
/// new pages can cost as much as the run. glibc is made to keep it, up to 32 MB, unless its thresholds are set by hand.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Histories {
    /// Decimation: one row every so many samples, from sample 0.
    pub every: usize,
    /// Number of rows.
    pub rows: usize,
    /// Storey drift (m), rows x storeys.
    pub drift: Vec<f64>,
    /// Slip (m), rows x blocks.
    pub slip: Vec<f64>,
    /// Floor velocity relative to the ground (m/s), rows x storeys.
    pub floor_velocity: Vec<f64>,
    /// Block velocity relative to the ground (m/s), rows x blocks.
    pub block_velocity: Vec<f64>,
    /// Absolute floor acceleration (m/s2), rows x storeys.
    pub floor_acceleration: Vec<f64>,
    /// Spring force of each storey (N), rows x storeys.
    pub storey_force: Vec<f64>,
}

/// Energies at the end of the run, relative to the moving ground (J).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Energy {
    /// Kinetic plus elastic energy at the start.
    pub initial: f64,
    /// Input, -int (sum m v) a_g dt over floors and blocks.
    pub input: f64,
    /// Kinetic energy of floors and blocks.
    pub kinetic: f64,
    /// Energy stored in the springs, less the work of P-Delta.
    pub elastic: f64,
    /// Dissipated by viscous damping.
    pub viscous: f64,
    /// Dissipated by yielding.
    pub hysteretic: f64,
    /// Dissipated by friction.
    pub friction: f64,
    /// (initial + input - all others), relative to the initial energy plus the largest input so far.
    pub relative_residual: f64,
}

/// What a scene did not need and was left out, exactly (`numerics`, section 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Skipped {
    /// Storeys that cannot yield: no spring state, no guard.
    pub elastic_storeys: usize,
    /// Floors without a block: no friction guard.
    pub bare_floors: usize,
    /// Samples at the head that are zero, with everything at rest.
    pub head_samples: usize,
    /// Samples at the tail not solved because no peak could be beaten there.
    pub tail_samples: usize,
}

/// The work done. Deterministic: the same for any thread count and batch order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Statistics {
    /// Sample intervals solved.
    pub intervals: usize,
    /// Equal parts that each of them was solved in: more than one where the building is stiff.
    pub substeps: usize,
    /// Steps by a regime's propagator whose guards were proved clear by bounds alone.
    pub plain_steps: usize,
    /// Steps for which the Taylor series was formed, plain steps inside which a peak is beaten among them.
    pub series_steps: usize,
    /// Guards and peaks looked at with Bernstein polynomials.
    pub guards_isolated: usize,
    /// Events by kind.
    pub events: EventCounts,
    /// Different regimes entered.
    pub regimes: usize,
    /// Regime changes that found the regime known.
    pub regime_hits: usize,
    /// What was skipped.
    pub skipped: Skipped,
}

/// The result of one run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Response {
    /// How the run ended.
    pub status: Status,
    /// Time reached (s): the last sample, or the collapse.
    pub end_time: f64,
    /// Peaks in continuous time.
    pub peaks: Peaks,
    /// Drift of each storey at the end (m).
    pub residual_drift: Vec<f64>,
    /// Slip of each block at the end (m); a block may still be sliding.
    pub residual_slip: Vec<f64>,
    /// Path slipped by each block, airborne motion included (m).
    pub slip_path: Vec<f64>,
    /// Peak force of each floor, its mass times its acceleration and the friction of its goods, which is what its
    /// diaphragm passes on (N); if asked for.
    pub floor_force: Option<Vec<Peak>>,
    /// Event log, if asked for.
    pub events: Option<Vec<Event>>,
    /// Histories, if asked for.
    pub histories: Option<Histories>,
    /// Energies, if asked for.
    pub energy: Option<Energy>,
    /// Work done.
    pub statistics: Statistics,
}
