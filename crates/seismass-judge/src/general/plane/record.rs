//! What a run in the plane gives back: what is of each direction, and of vectors.

use seismass::{GeneralStatus, Peak, PlaneEvent, VectorPeaks};

use super::series::PlaneSeries;
use super::state::Plane;
use crate::general::record::{GeneralSolution, Recorder, base_shear, shears};
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::state::Contact;

/// The response of a scene in two directions, rounded to doubles.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneSolution {
    /// What is of x and of y, with events of springs and stops; paths are those in each direction alone.
    pub directions: [GeneralSolution; 2],
    /// Peaks of vectors.
    pub vector: VectorPeaks,
    /// Path slipped by each block in contact with its node (m).
    pub slip_path: Vec<f64>,
    /// Events of vectors, in order.
    pub events: Vec<PlaneEvent>,
}

pub(super) struct PlaneRecorder<R> {
    directions: [Recorder<R>; 2],
    vector: VectorPeaks,
    path: Vec<R>,
}

/// Raises a peak to the length of a vector.
fn beat<R: Real>(peak: &mut Peak, [x, y]: [&Polynomial<R>; 2], time: R, length: R) {
    let bound = x.size() * x.size() + y.size() * y.size();
    if bound.to_f64() > peak.value * peak.value {
        let (square, place) = x.times(x).plus(&y.times(y)).extreme();
        let value = square.sqrt().to_f64();
        if value > peak.value {
            *peak = Peak { value, time: (time + place * length).to_f64() };
        }
    }
}

impl<R: Real> PlaneRecorder<R> {
    /// A record that begins at t = 0. Peaks begin with the first stretch, which begins there too.
    pub(super) fn new(plane: &Plane<R>, every: usize) -> Self {
        let (nodes, goods) = (plane.directions[0].model.mass.len(), plane.heads.len());
        let recorder = |a: usize| {
            let direction = &plane.directions[a];
            Recorder::new(&direction.model, &direction.state, vec![R::zero(); nodes], every)
        };
        let (of_nodes, of_goods) = (vec![Peak::default(); nodes], vec![Peak::default(); goods]);
        Self {
            directions: [recorder(0), recorder(1)],
            vector: VectorPeaks {
                drift: of_nodes.clone(),
                acceleration: of_nodes.clone(),
                shear: of_nodes,
                base_shear: Peak::default(),
                slip: of_goods,
            },
            path: vec![R::zero(); goods],
        }
    }

    /// Adds a row of the histories if the sample has one.
    pub(super) fn sample(&mut self, plane: &Plane<R>, sample: usize) {
        for (recorder, direction) in self.directions.iter_mut().zip(&plane.directions) {
            recorder.sample(&direction.state, sample);
        }
    }

    /// Takes in a stretch that starts at `time` and at this state.
    pub(super) fn stretch(&mut self, plane: &Plane<R>, series: &PlaneSeries<R>, time: R) {
        let length = series.length();
        for a in 0..2 {
            let direction = &plane.directions[a];
            self.directions[a].stretch(&direction.model, &direction.state, &series.directions[a], time);
        }
        let [x, y] = &series.directions;
        let shear = [0, 1].map(|a| {
            let direction = &plane.directions[a];
            shears(&direction.model, &direction.state, &series.directions[a])
        });
        let base = [0, 1].map(|a| base_shear(&plane.directions[a].model, &series.directions[a], &shear[a]));
        let peaks = &mut self.vector;
        for p in 0..peaks.drift.len() {
            beat(&mut peaks.drift[p], [&x.drift[p], &y.drift[p]], time, length);
            beat(&mut peaks.acceleration[p], [&x.acceleration[p + 1], &y.acceleration[p + 1]], time, length);
            beat(&mut peaks.shear[p], [&shear[0][p], &shear[1][p]], time, length);
        }
        if let [Some(x), Some(y)] = &base {
            beat(&mut peaks.base_shear, [x, y], time, length);
        }
        for j in 0..peaks.slip.len() {
            beat(&mut peaks.slip[j], [&x.slip[j], &y.slip[j]], time, length);
            if let Contact::Sliding(_) = plane.directions[0].state.blocks[j].contact {
                self.path[j] = self.path[j] + plane.path_over(j, series);
            }
        }
    }

    /// Takes accelerations of a node in the last instants before blocks stop.
    pub(super) fn at_stop(&mut self, node: usize, acceleration: [R; 2], time: R) {
        let [x, y] = acceleration;
        self.directions.iter_mut().zip(acceleration).for_each(|(of, value)| of.acceleration(node, value, time));
        let (value, peak) = ((x * x + y * y).sqrt().to_f64(), &mut self.vector.acceleration[node]);
        if value > peak.value {
            *peak = Peak { value, time: time.to_f64() };
        }
    }

    pub(super) fn finish(self, plane: Plane<R>, ending: (GeneralStatus, f64), samples: usize) -> PlaneSolution {
        let [x, y] = self.directions;
        let [of_x, of_y] = plane.directions;
        let directions = [(x, of_x), (y, of_y)].map(|(recorder, direction)| {
            recorder.finish(&direction.model, &direction.state, ending, samples, direction.log, direction.parted)
        });
        PlaneSolution {
            directions,
            vector: self.vector,
            slip_path: self.path.iter().map(|path| path.to_f64()).collect(),
            events: plane.log,
        }
    }
}
