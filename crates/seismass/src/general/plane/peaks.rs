//! Peaks of vectors in continuous time, and of slips, which turn in either direction while a block slides.

use crate::general::peaks::{Observer, turns};
use crate::general::plane::products::{add_product, constant, half_square_rate, reach};
use crate::general::plane::response::{PlanePeaks, VectorPeaks};
use crate::general::plane::series::PlaneSeries;
use crate::general::plane::state::PlaneState;
use crate::general::plane::vector::{Vector2, length};
use crate::general::series::Quantity;
use crate::lanes::Plain;
use crate::polynomial::power::Polynomial;
use crate::response::Peak;

/// Peaks so far. Lists by node have an entry for the ground.
pub(super) struct PlaneObserver {
    axes: [Observer; 2],
    slip: [Vec<Peak>; 2],
    vector: VectorPeaks,
}

impl PlaneObserver {
    pub(super) fn new(state: &PlaneState) -> Self {
        let none = |count: usize| vec![Peak::default(); count];
        let (width, goods) = (state.system().nodes + 1, state.slides.len());
        Self {
            axes: state.axes.each_ref().map(Observer::new),
            slip: [none(goods), none(goods)],
            vector: VectorPeaks {
                drift: none(width),
                acceleration: none(width),
                shear: none(width),
                base_shear: Peak::default(),
                slip: none(goods),
            },
        }
    }

    pub(super) fn finish(self) -> PlanePeaks {
        let mut directions = self.axes.map(Observer::finish);
        for (peaks, slip) in directions.iter_mut().zip(self.slip) {
            peaks.slip = slip;
        }
        let mut vector = self.vector;
        for list in [&mut vector.drift, &mut vector.acceleration, &mut vector.shear] {
            list.remove(0);
        }
        PlanePeaks { directions, vector }
    }

    /// Takes the present drifts, slips and contact forces.
    pub(super) fn take_values(&mut self, state: &PlaneState, time: f64) {
        for (observer, axis) in self.axes.iter_mut().zip(&state.axes) {
            observer.take_values(axis, time);
        }
        for p in 1..=state.system().nodes {
            self.vector.drift[p].take(length(state.drift(p)), time);
            self.vector.shear[p].take(length(state.axes.each_ref().map(|axis| axis.spring_force(p))), time);
        }
        let base_shear = state.axes.each_ref().map(|axis| crate::general::peaks::base_shear(axis, &axis.x));
        self.vector.base_shear.take(length(base_shear), time);
        for j in 0..state.slides.len() {
            let slip = state.slip(j);
            self.slip.iter_mut().zip(slip).for_each(|(peaks, slip)| _ = peaks[j].take(slip, time));
            self.vector.slip[j].take(length(slip), time);
        }
    }

    /// Takes accelerations of all nodes, that of the ground first.
    pub(super) fn take_accelerations(&mut self, accelerations: &[Vec<f64>; 2], time: f64) {
        for (observer, values) in self.axes.iter_mut().zip(accelerations) {
            observer.take_accelerations(values, time);
        }
        for (p, peak) in self.vector.acceleration.iter_mut().enumerate().skip(1) {
            peak.take(length([accelerations[0][p], accelerations[1][p]]), time);
        }
    }

    /// Takes accelerations of a node.
    pub(super) fn take_node(&mut self, node: usize, accelerations: Vector2, time: f64) {
        for (observer, value) in self.axes.iter_mut().zip(accelerations) {
            observer.take_node(node, value, time);
        }
        self.vector.acceleration[node].take(length(accelerations), time);
    }

    /// Takes the velocity at which a block comes to a stop of a direction.
    pub(super) fn take_contact_velocity(&mut self, axis: usize, block: usize, velocity: f64, time: f64) {
        self.axes[axis].take_contact_velocity(block, velocity, time);
    }

    /// Takes the extremes inside a series up to its place `end`, before the state is advanced; returns how many quantities
    /// could not be cleared by a bound.
    pub(super) fn observe(&mut self, state: &mut PlaneState, series: &PlaneSeries, end: f64) -> usize {
        let mut isolated = 0;
        for (a, observer) in self.axes.iter_mut().enumerate() {
            isolated += observer.observe(&mut state.axes[a], &series.axes[a], end);
        }
        for p in 1..=state.system().nodes {
            isolated += self.observe_spring(state, series, p, end);
            isolated += self.observe_acceleration(state, series, p, end);
        }
        isolated += self.observe_base_shear(state, series, end);
        for position in 0..state.axes[0].moving.len() {
            isolated += self.observe_slip(state, series, position, end);
        }
        isolated
    }

    fn observe_spring(&mut self, state: &PlaneState, series: &PlaneSeries, p: usize, end: f64) -> usize {
        let base = state.axes.each_ref().map(|axis| axis.base_drift[p]);
        let segments = state.axes.each_ref().map(|axis| *axis.springs[p - 1].segment());
        let of_drift = reach(&series.axes, Quantity::Drift, p, base) > self.vector.drift[p].value;
        let largest = |a: usize| {
            let (low, high) = series.axes[a].range(Quantity::Drift, p);
            segments[a].force(low).abs().max(segments[a].force(high).abs())
        };
        let of_shear = length([largest(0), largest(1)]) > self.vector.shear[p].value;
        if !of_drift && !of_shear {
            return 0;
        }
        let of = |quantity: Quantity| [0, 1].map(|a| series.axes[a].polynomial(quantity, p, 1.0, 0.0).0);
        let (x, rate) = (of(Quantity::Drift), of(Quantity::Rate));
        let start = state.axes[0].interval.start + series.tau();
        for (wanted, slope, offset) in
            [(of_drift, [1.0; 2], base), (of_shear, segments.map(|s| s.tangent), segments.map(|s| s.base_force))]
        {
            if !wanted {
                continue;
            }
            let value = [0, 1].map(|a| {
                let mut value = Polynomial::new(x[a].coefficients().iter().map(|c| slope[a] * c));
                value.coefficients[0] += offset[a];
                value
            });
            let rates = [0, 1].map(|a| Polynomial::new(rate[a].coefficients().iter().map(|c| slope[a] * c)));
            let turning = half_square_rate(value.each_ref(), rates.each_ref());
            let peak =
                if offset == base && slope == [1.0; 2] { &mut self.vector.drift[p] } else { &mut self.vector.shear[p] };
            for s in turns(&turning, end) {
                peak.take(length(value.each_ref().map(|value| value.at::<Plain>(s))), start + s * series.h());
            }
        }
        usize::from(of_drift) + usize::from(of_shear)
    }

    fn observe_acceleration(&mut self, state: &PlaneState, series: &PlaneSeries, p: usize, end: f64) -> usize {
        if reach(&series.axes, Quantity::Acceleration, p, [0.0; 2]) <= self.vector.acceleration[p].value {
            return 0;
        }
        let a = [0, 1].map(|axis: usize| series.axes[axis].polynomial(Quantity::Acceleration, p, 1.0, 0.0).0);
        let rates = a.each_ref().map(Polynomial::derivative);
        let start = state.axes[0].interval.start + series.tau();
        for s in turns(&half_square_rate(a.each_ref(), rates.each_ref()), end) {
            self.vector.acceleration[p].take(length(a.each_ref().map(|a| a.at::<Plain>(s))), start + s * series.h());
        }
        1
    }

    /// The base shear is that of storey 1, but where elastic matrices take part.
    fn observe_base_shear(&mut self, state: &PlaneState, series: &PlaneSeries, end: f64) -> usize {
        if state.system().storeys == 0 {
            return 0;
        }
        if state.axes.iter().all(|axis| axis.system.parts[0].elastic.is_empty()) {
            if self.vector.shear[1].value > self.vector.base_shear.value {
                self.vector.base_shear = self.vector.shear[1];
            }
            return 0;
        }
        let shear = [0, 1].map(|a| crate::general::peaks::base_shear_series(&state.axes[a], &series.axes[a]));
        let size = |p: &Polynomial| p.coefficients().iter().map(|c| c.abs()).sum::<f64>();
        if length([size(&shear[0]), size(&shear[1])]) <= self.vector.base_shear.value {
            return 0;
        }
        let rates = shear.each_ref().map(Polynomial::derivative);
        let start = state.axes[0].interval.start + series.tau();
        for s in turns(&half_square_rate(shear.each_ref(), rates.each_ref()), end) {
            let value = length(shear.each_ref().map(|shear| shear.at::<Plain>(s)));
            self.vector.base_shear.take(value, start + s * series.h());
        }
        1
    }

    fn observe_slip(&mut self, state: &PlaneState, series: &PlaneSeries, position: usize, end: f64) -> usize {
        let block = state.axes[0].moving[position];
        let at_start = state.slip(block);
        let start = state.axes[0].interval.start + series.tau();
        let mut isolated = 0;
        let mut reach = [0.0; 2];
        for a in 0..2 {
            let terms = &series.axes[a].blocks[position];
            reach[a] = at_start[a].abs() + terms.slip_change;
            let turns_inside = terms.velocity[0].abs() <= terms.velocity_change;
            if turns_inside && reach[a] > self.slip[a][block].value {
                isolated += 1;
                let slip = series.axes[a].slip_of(position);
                for s in turns(&series.axes[a].velocity_of(position), end) {
                    self.slip[a][block].take(at_start[a] + slip.at::<Plain>(s), start + s * series.h());
                }
            }
        }
        if length(reach) <= self.vector.slip[block].value {
            return isolated;
        }
        let mut turning = constant(0.0);
        let slips = [0, 1].map(|a: usize| {
            let mut slip = series.axes[a].slip_of(position);
            slip.coefficients[0] = at_start[a];
            slip
        });
        for (a, slip) in slips.iter().enumerate() {
            add_product(&mut turning, 1.0, slip, &series.axes[a].velocity_of(position));
        }
        for s in turns(&turning, end) {
            let value = length(slips.each_ref().map(|slip| slip.at::<Plain>(s)));
            self.vector.slip[block].take(value, start + s * series.h());
        }
        isolated + 1
    }
}
