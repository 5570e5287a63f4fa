//! What must hold for any response of the general engine by itself: numbers, legal sequences of events, friction within its
//! limits, stops that never pull, slips within clearances and penetrations.

use seismass::{
    Event, EventKind, GeneralResponse, GeneralScene, GeneralStatus, Goods, Histories, Motion, STANDARD_GRAVITY,
    SpringLaw, Stops,
};

use crate::larger;
use crate::stress::consistency::{Contact, ROUNDING, is_of_storey, order, springs, step};

/// Checks a response that has events, energies and histories at every sample; the first fault found.
///
/// # Errors
/// The fault, in one line.
pub(super) fn check(scene: &GeneralScene, motion: &Motion, response: &GeneralResponse) -> Result<(), String> {
    let log = response.events.as_deref().ok_or("no event log")?;
    let log: Vec<Event> = log.iter().map(|entry| entry.event).collect();
    let histories = response.histories.as_ref().ok_or("no histories")?;
    if log.len() != response.statistics.events.total() {
        return Err(format!("{} events in the log, {} counted", log.len(), response.statistics.events.total()));
    }
    numbers(response, histories)?;
    order(&log, response.end_time * (1.0 + 4.0 * f64::EPSILON))?;
    springs(&laws(scene), &log)?;
    energies(response)?;
    peaks(scene, response, histories)?;
    slips(scene, response)?;
    Walk::new(scene, motion, response, histories).check(&log)
}

pub(super) fn laws(scene: &GeneralScene) -> Vec<&SpringLaw> {
    let of_building = scene.building().into_iter().flat_map(|building| building.storeys());
    let of_racks = scene.racks().iter().flat_map(|rack| &rack.levels);
    of_building.chain(of_racks).map(|storey| &storey.law).collect()
}

pub(super) fn numbers(response: &GeneralResponse, h: &Histories) -> Result<(), String> {
    let p = &response.peaks;
    let base = [p.base_shear];
    let lists = [&p.drift[..], &p.acceleration, &p.shear, &base, &p.slip, &p.contact_force, &p.contact_velocity];
    let names = ["drift", "acceleration", "shear", "base shear", "slip", "contact force", "contact velocity"];
    for (name, list) in names.iter().zip(lists) {
        for (i, peak) in list.iter().enumerate() {
            let in_time = peak.time >= 0.0 && peak.time <= response.end_time * (1.0 + 4.0 * f64::EPSILON);
            if !(peak.value.is_finite() && peak.value >= 0.0 && in_time) {
                return Err(format!("peak {name} {}: {peak:?}", i + 1));
            }
        }
    }
    if let Some(base) = &response.base {
        let of_run = [base.slip.value, base.acceleration.value, base.residual_slip, base.slip_path];
        let completed = response.status == GeneralStatus::Completed;
        if !of_run.iter().chain(base.history.iter().filter(|_| completed)).all(|value| value.is_finite()) {
            return Err("numbers of the base that are not finite".into());
        }
    }
    let residuals = [&response.residual_drift, &response.residual_slip, &response.slip_path];
    let histories = [&h.drift, &h.slip, &h.floor_velocity, &h.block_velocity, &h.floor_acceleration, &h.storey_force];
    let finite = |lists: &[&Vec<f64>]| lists.iter().all(|list| list.iter().all(|value| value.is_finite()));
    if !finite(&residuals) {
        return Err("residuals that are not finite".into());
    }
    let completed = response.status == GeneralStatus::Completed;
    if completed && !finite(&histories) { Err("histories that are not finite".into()) } else { Ok(()) }
}

/// What is dissipated is not negative, and no more than rounding is missing in the balance of what is.
pub(super) fn energies(response: &GeneralResponse) -> Result<(), String> {
    let Some(energy) = &response.energy else { return Ok(()) };
    let parts = [energy.viscous, energy.hysteretic, energy.friction, energy.contact];
    let least = -ROUNDING * parts.iter().fold(energy.kinetic, |sum, part| sum + part.abs());
    for (name, part) in ["viscous", "hysteretic", "friction", "contact"].iter().zip(parts) {
        if part < least || part.is_nan() {
            return Err(format!("{name} energy is {part:e} J"));
        }
    }
    Ok(())
}

/// No sample may beat a peak of continuous time.
pub(super) fn peaks(scene: &GeneralScene, response: &GeneralResponse, h: &Histories) -> Result<(), String> {
    let (n, m) = (scene.nodes(), scene.all_goods().count());
    let p = &response.peaks;
    let of_base = response.base.as_ref().map(|base| vec![base.slip]).unwrap_or_default();
    let base = response.base.as_ref().map_or(&h.drift, |base| &base.history);
    let lists = [
        ("slip of base", base, &of_base, of_base.len()),
        ("drift", &h.drift, &p.drift, n),
        ("slip", &h.slip, &p.slip, m),
        ("acceleration", &h.floor_acceleration, &p.acceleration, n),
        ("shear", &h.storey_force, &p.shear, n),
    ];
    for (name, values, peaks, width) in lists {
        for (i, value) in values.iter().enumerate().filter(|_| width > 0) {
            let peak = peaks[i % width].value;
            if value.abs() > peak * (1.0 + ROUNDING) {
                return Err(format!("{name} {} is {value:e} at sample {}, peak {peak:e}", i % width + 1, i / width));
            }
        }
    }
    Ok(())
}

/// A slip ends at its clearance and the penetration: where the latter is largest, the damper has no force.
pub(super) fn slips(scene: &GeneralScene, response: &GeneralResponse) -> Result<(), String> {
    for (j, goods) in scene.all_goods().enumerate() {
        let Some(stops) = &goods.stops else { continue };
        let bound =
            stops.clearance[0].max(stops.clearance[1]) + response.peaks.contact_force[j].value / stops.stiffness;
        let slip = response.peaks.slip[j].value;
        if slip > bound * (1.0 + ROUNDING) {
            return Err(format!("block {} slips {slip:e} m, bound {bound:e}", j + 1));
        }
    }
    Ok(())
}

/// State of a block's stops, as the event log says.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stopped {
    Free,
    Pressing(i8),
    Parted(i8),
}

/// The states of all blocks from sample to sample.
pub(super) struct Walk<'a> {
    scene: &'a GeneralScene,
    motion: &'a Motion,
    response: &'a GeneralResponse,
    histories: &'a Histories,
    contact: Vec<Contact>,
    /// That of the slab; none: the ground.
    base: Option<Contact>,
    base_changed: f64,
    stopped: Vec<Stopped>,
    last_change: Vec<f64>,
    mu_s: Vec<f64>,
    /// Node of each block, in the columns of the histories.
    pub(super) node: Vec<Option<usize>>,
    /// Largest relative velocity, as a measure of rounding (m/s).
    fastest: f64,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        scene: &'a GeneralScene,
        motion: &'a Motion,
        response: &'a GeneralResponse,
        histories: &'a Histories,
    ) -> Self {
        let mut node: Vec<Option<usize>> = scene.goods().iter().map(|g| g.block.floor.checked_sub(1)).collect();
        let mut velocity = scene.initial_velocity().to_vec();
        for rack in scene.racks() {
            let first = velocity.len();
            let floor = rack.floor.checked_sub(1).map_or(0.0, |floor| scene.initial_velocity()[floor]);
            velocity.resize(first + rack.mass.len(), floor);
            node.extend(rack.goods.iter().map(|g| Some(first + g.block.floor - 1)));
        }
        let vertical = motion.vertical().map_or([0.0; 2], |v| [v[0], v[1.min(v.len() - 1)]]);
        let at_start = vertical.map(|v| STANDARD_GRAVITY + v);
        let airborne = at_start[0] < 0.0 || at_start[0] == 0.0 && at_start[1] <= 0.0;
        let contact = scene.all_goods().zip(&node).map(|(goods, node)| {
            match goods.block.velocity.map_or(0.0, |w| w - node.map_or(0.0, |node| velocity[node])) {
                _ if airborne => Contact::Airborne,
                0.0 => Contact::Stuck,
                v => Contact::Sliding(if v > 0.0 { 1 } else { -1 }),
            }
        });
        let velocities = histories.block_velocity.iter().chain(&histories.floor_velocity);
        let contact: Vec<Contact> = contact.collect();
        Self {
            stopped: vec![Stopped::Free; contact.len()],
            last_change: vec![f64::NEG_INFINITY; contact.len()],
            mu_s: scene.all_goods().map(|goods| goods.block.mu_s).collect(),
            fastest: velocities.filter(|v| !v.is_nan()).fold(0.0, |most, v| larger(most, v.abs())),
            base: scene.base().map(|_| if airborne { Contact::Airborne } else { Contact::Stuck }),
            base_changed: f64::NEG_INFINITY,
            scene,
            motion,
            response,
            histories,
            contact,
            node,
        }
    }

    fn check(&mut self, log: &[Event]) -> Result<(), String> {
        let mut events = log.iter().filter(|event| !is_of_storey(event.kind)).peekable();
        for row in 0..self.histories.rows {
            let time = row as f64 * self.motion.dt();
            if time > self.response.end_time || row >= self.motion.acceleration().len() {
                break;
            }
            while let Some(event) = events.next_if(|e| e.time <= time) {
                self.carry_out(event)?;
            }
            self.rests(row)?;
            let moves = self.base.is_some() && !self.is_base_stuck();
            // Nothing has the velocity of a slab that moves.
            let known = |&(j, _): &(usize, &Goods)| self.node[j].is_some() || !moves;
            for (j, goods) in self.scene.all_goods().enumerate().filter(known) {
                let fault = |message: String| format!("block {} at t = {time} s: {message}", j + 1);
                self.friction(j, row).map_err(fault)?;
                goods.stops.as_ref().map_or(Ok(()), |stops| self.stop(j, row, stops)).map_err(fault)?;
            }
        }
        events.try_for_each(|event| self.carry_out(event))
    }

    pub(super) fn carry_out(&mut self, event: &Event) -> Result<(), String> {
        let Some(j) = event.number.checked_sub(1) else {
            let before = self.base.ok_or("an event of no base")?;
            self.base = Some(step(before, event).ok_or_else(|| format!("base: {event:?} while {before:?}"))?);
            self.base_changed = event.time;
            return Ok(());
        };
        let goods = self.scene.all_goods().nth(j).ok_or("an event of no block")?;
        self.last_change[j] = event.time;
        let side = event.sign;
        let stopped = match (event.kind, self.stopped[j]) {
            (EventKind::TouchStop, Stopped::Free) => Stopped::Pressing(side),
            (EventKind::TouchStop, Stopped::Parted(old)) if old == side => Stopped::Pressing(side),
            // Between parting and the touch of the other stop it has come within its clearance.
            (EventKind::TouchStop, Stopped::Parted(_)) => Stopped::Pressing(side),
            (EventKind::LeaveStop, Stopped::Pressing(old)) if old == side => match &goods.stops {
                Some(stops) if stops.damping > 0.0 => Stopped::Parted(side),
                _ => Stopped::Free,
            },
            (EventKind::TouchStop | EventKind::LeaveStop, state) => {
                return Err(format!("stop machine: {event:?} while {state:?}"));
            }
            (EventKind::Wear, state) => {
                self.mu_s[j] = goods.block.wear[usize::from(event.element) - 1].mu_s;
                state
            }
            (_, state) => state,
        };
        self.stopped[j] = stopped;
        if !matches!(event.kind, EventKind::TouchStop | EventKind::LeaveStop) {
            let before = self.contact[j];
            self.contact[j] =
                step(before, event).ok_or_else(|| format!("block machine: {event:?} while {before:?}"))?;
        }
        Ok(())
    }

    fn is_base_stuck(&self) -> bool {
        matches!(self.base, Some(Contact::Stuck | Contact::Landed))
    }

    /// A slab that sticks does not creep.
    fn rests(&self, row: usize) -> Result<(), String> {
        let Some(base) = &self.response.base else { return Ok(()) };
        let time = row as f64 * self.motion.dt();
        let rests = row > 0 && self.is_base_stuck() && self.base_changed < time - self.motion.dt();
        if rests && base.history[row] != base.history[row - 1] {
            return Err(format!("the base creeps from {} to {}", base.history[row - 1], base.history[row]));
        }
        Ok(())
    }

    /// Velocity relative to the node (m/s).
    pub(super) fn relative(&self, j: usize, row: usize) -> f64 {
        let (n, m) = (self.scene.nodes(), self.contact.len());
        let node = self.node[j].map_or(0.0, |node| self.histories.floor_velocity[row * n + node]);
        self.histories.block_velocity[row * m + j] - node
    }

    pub(super) fn slip(&self, j: usize, row: usize) -> f64 {
        self.histories.slip[row * self.contact.len() + j]
    }

    /// A stuck block does not move, nor creep, nor is it driven by more than friction holds; a sliding one keeps its sign.
    fn friction(&self, j: usize, row: usize) -> Result<(), String> {
        let relative = self.relative(j, row);
        match self.contact[j] {
            Contact::Stuck | Contact::Landed => {
                if relative != 0.0 {
                    return Err(format!("stuck with relative velocity {relative:e}"));
                }
                let time = row as f64 * self.motion.dt();
                if row > 0 && self.last_change[j] < time - self.motion.dt() {
                    let slip = [self.slip(j, row - 1), self.slip(j, row)];
                    if slip[0] != slip[1] {
                        return Err(format!("creeps from {} to {}", slip[0], slip[1]));
                    }
                }
                let ground = self.motion.acceleration()[row];
                let (acceleration, largest) = self.node[j].map_or((ground, ground.abs()), |node| {
                    let at = row * self.scene.nodes() + node;
                    (self.histories.floor_acceleration[at], self.response.peaks.acceleration[node].value)
                });
                let push = self.push(j, row);
                let contact = STANDARD_GRAVITY + self.motion.vertical().map_or(0.0, |v| v[row]);
                let limit = self.mu_s[j] * contact;
                let rounding = ROUNDING * (limit.abs() + self.mu_s[j] * STANDARD_GRAVITY + largest + push.abs());
                if (acceleration + push).abs() > limit + rounding {
                    return Err(format!("stuck at {:e}, limit {limit:e} m/s2", acceleration + push));
                }
                Ok(())
            }
            Contact::Sliding(sign) if f64::from(sign) * relative < -ROUNDING * self.fastest => {
                Err(format!("slides with sign {sign} at {relative:e} m/s"))
            }
            _ => Ok(()),
        }
    }

    /// Force of a stop on its node over the block's mass (m/s2), for a block at rest.
    pub(super) fn push(&self, j: usize, row: usize) -> f64 {
        let Some(goods) = self.scene.all_goods().nth(j) else { return 0.0 };
        let (Some(stops), Stopped::Pressing(side)) = (&goods.stops, self.stopped[j]) else { return 0.0 };
        f64::from(side) * stops.stiffness * beyond(stops, side, self.slip(j, row)) / goods.block.mass
    }

    /// A block that presses is not pulled; one that is free is within its clearances; one that has parted would be pulled.
    pub(super) fn stop(&self, j: usize, row: usize, stops: &Stops) -> Result<(), String> {
        let (slip, relative) = (self.slip(j, row), self.relative(j, row));
        let largest = self.response.peaks.contact_force[j].value;
        let finite = |side: i8| Some(beyond(stops, side, 0.0).abs()).filter(|c| c.is_finite()).unwrap_or(0.0);
        let place = finite(1).max(finite(-1)) + slip.abs();
        let rounding = ROUNDING * (largest + stops.stiffness * place + stops.damping * self.fastest);
        let force = |side: i8| stops.stiffness * beyond(stops, side, slip) + stops.damping * f64::from(side) * relative;
        let free = |side: i8| beyond(stops, side, slip) <= ROUNDING * place;
        match self.stopped[j] {
            Stopped::Pressing(side) if force(side) < -rounding => Err(format!("a stop pulls with {:e} N", force(side))),
            Stopped::Parted(side) if force(side) > rounding && !free(side) => {
                Err(format!("a stop does not press with {:e} N", force(side)))
            }
            Stopped::Free if !(free(1) && free(-1)) => {
                Err(format!("slips {slip:e} m past a stop that it does not touch"))
            }
            _ => Ok(()),
        }
    }
}

/// Slip beyond the stop of a side (m).
fn beyond(stops: &Stops, side: i8, slip: f64) -> f64 {
    f64::from(side) * slip - stops.clearance[usize::from(side > 0)]
}
