//! A storey's spring driven along a list of drifts, slowly: its hysteresis loop.

use crate::error::{Domain, Error, Result};
use crate::machines::segment::Crossing;
use crate::machines::sign::Sign;
use crate::machines::storey::{StoreyLaw, StoreySpring};
use crate::response::EventKind;
use crate::scene::Storey;

/// An event of a spring on its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringEvent {
    /// Index of the drift on the way to which it happened.
    pub leg: usize,
    /// Drift there (m).
    pub drift: f64,
    /// Force there (N).
    pub force: f64,
    /// What happened.
    pub kind: EventKind,
    /// As in [`Event::sign`](crate::Event::sign).
    pub sign: i8,
    /// As in [`Event::element`](crate::Event::element).
    pub element: u8,
}

/// What a spring did along a list of drifts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpringPath {
    /// Force at each drift (N).
    pub force: Vec<f64>,
    /// Energy dissipated up to each drift (J).
    pub dissipated: Vec<f64>,
    /// Energy stored at each drift (J).
    pub stored: Vec<f64>,
    /// Events on the way.
    pub events: Vec<SpringEvent>,
}

/// Drives the spring of a storey, virgin at first, from one drift (m) to the next, without P-Delta and collapse.
///
/// ```
/// use seismass::{EventKind, Storey, spring_path};
///
/// # fn main() -> seismass::Result<()> {
/// // 1000 N/m up to 10 N, then a twentieth of it; back by Masing's rule.
/// let path = spring_path(&Storey::yielding(1000.0, 10.0), &[0.01, 0.03, 0.02])?;
/// assert_eq!(path.events.iter().map(|event| event.kind).collect::<Vec<_>>(), [EventKind::Yield, EventKind::Unload]);
/// assert!((path.force[1] - 11.0).abs() < 1e-12 && (path.force[2] - 1.0).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`Error::Invalid`] when the storey or a drift is invalid.
pub fn spring_path(storey: &Storey, drifts: &[f64]) -> Result<SpringPath> {
    storey.validate("storey")?;
    if let Some(i) = drifts.iter().position(|drift| !drift.is_finite()) {
        let owner = format!("entry {} of the path", i + 1);
        return Err(Error::invalid(Domain::Options, "drift", owner, "a finite number", drifts[i]));
    }
    let law = StoreyLaw::new(storey, 0.0, None);
    let mut spring = StoreySpring::new(&law);
    let mut path = SpringPath::default();
    let (mut x, mut dissipated) = (0.0, 0.0);
    for (leg, &target) in drifts.iter().enumerate() {
        let mut note = |spring: &StoreySpring, crossing: Crossing| {
            let (drift, force) = (spring.drift(0.0), spring.segment().base_force);
            let Crossing { kind, sign, element } = crossing;
            path.events.push(SpringEvent { leg, drift, force, kind, sign, element });
        };
        let change = target - spring.drift(x);
        let direction = Sign::of(change);
        if change != 0.0 && spring.rate_sign().is_some_and(|sign| sign != direction) {
            let crossing = spring.turn(x);
            note(&spring, crossing);
            x = 0.0;
        }
        loop {
            let (goal, ends) = (target - spring.segment().base_drift, spring.segment().ends);
            let end = if direction == Sign::Positive { ends.1 } else { ends.0 };
            if direction.factor() * (goal - end) <= 0.0 {
                dissipated += spring.dissipated(x, goal - x);
                x = goal;
                break;
            }
            dissipated += spring.dissipated(x, end - x);
            let crossing = spring.end(end, direction);
            note(&spring, crossing);
            x = 0.0;
        }
        path.force.push(spring.segment().force(x));
        path.dissipated.push(dissipated);
        path.stored.push(spring.stored(&law, x));
    }
    Ok(path)
}
