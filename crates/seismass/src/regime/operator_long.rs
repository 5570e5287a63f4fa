//! The system of a tall regime, and the state that it acts on.

use crate::lanes::{Symmetric, Vector, WIDTH, filled_to, lanes, lanes_mut};
use crate::machines::model::Model;
use crate::regime::{Regime, Row};

/// The regime's system.
pub(crate) struct LongOperator<'a> {
    tangent: Vec<f64>,
    pub(crate) inverse_mass: Vec<f64>,
    /// Rayleigh damping of each storey and floor, zeros without it.
    storey_damping: Vec<f64>,
    pub(crate) floor_damping: Vec<f64>,
    /// Full damping matrix.
    full_damping: Option<&'a Symmetric<1>>,
    pub(crate) nothing: Vec<f64>,
}

impl<'a> LongOperator<'a> {
    pub(crate) fn new(model: &'a Model, regime: &Regime, length: usize) -> Self {
        let n = model.storeys();
        let of_regime = |row: Row| filled_to(length, regime.row(row)[..n].iter().copied(), 0.0);
        let of_model = |values: &[f64]| filled_to(length, values.iter().copied().take(n), 0.0);
        Self {
            tangent: of_regime(Row::Tangent),
            inverse_mass: of_regime(Row::InverseMass),
            storey_damping: of_model(&model.lanes.storey_damping),
            floor_damping: of_model(&model.lanes.floor_damping),
            full_damping: model.symmetric_damping(),
            nothing: vec![0.0; length],
        }
    }

    /// Vectors of everything, as many as there are.
    #[inline(always)]
    fn lanes(&self) -> LongOperatorLanes<'_> {
        let count = self.tangent.len() / WIDTH;
        LongOperatorLanes {
            count,
            tangent: &lanes(&self.tangent)[..count],
            inverse_mass: &lanes(&self.inverse_mass)[..count],
            storey_damping: &lanes(&self.storey_damping)[..count],
            floor_damping: &lanes(&self.floor_damping)[..count],
        }
    }

    /// Floor accelerations from drifts, drift rates, floor velocities less that of the ground, and floor loads.
    #[inline(always)]
    pub(crate) fn accelerations<V: Vector>(
        &self,
        x: &[f64],
        v: &[f64],
        velocity: &[f64],
        load: &[f64],
        out: &mut [f64],
    ) {
        if let Some(damping) = self.full_damping {
            return self.fully_damped::<V>(damping, x, V::splat(1.0), v, load, out);
        }
        let operator = self.lanes();
        let count = operator.count;
        let (x, v) = (&lanes(x)[..count], &lanes(v)[..count]);
        let (velocity, load, out) = (&lanes(velocity)[..count], &lanes(load)[..count], &mut lanes_mut(out)[..count]);
        let mut here = operator.force(0, V::load(&x[0]), V::load(&v[0]));
        for k in 1..count {
            let above = operator.force(k, V::load(&x[k]), V::load(&v[k]));
            let (floor, load) = (V::load(&velocity[k - 1]), V::load(&load[k - 1]));
            operator.acceleration(k - 1, [here, above], floor, load).store(&mut out[k - 1]);
            here = above;
        }
        let (floor, load) = (V::load(&velocity[count - 1]), V::load(&load[count - 1]));
        operator.acceleration(count - 1, [here, V::splat(0.0)], floor, load).store(&mut out[count - 1]);
    }

    /// A time derivative times a factor, of drift rates and of floor accelerations, from what it is the derivative of:
    /// `x`, drift rates; `a`, floor accelerations, that of the ground before them.
    #[inline(always)]
    pub(crate) fn derivatives<V: Vector>(
        &self,
        x: &[f64],
        a: &[f64],
        factor: V,
        load: &[f64],
        v_out: &mut [f64],
        a_out: &mut [f64],
    ) {
        if let Some(damping) = self.full_damping {
            for ((out, floor), below) in lanes_mut(v_out).iter_mut().zip(lanes(&a[1..])).zip(lanes(a)) {
                factor.mul(V::load(floor).sub(V::load(below))).store(out);
            }
            return self.fully_damped(damping, x, factor, v_out, load, a_out);
        }
        let operator = self.lanes();
        let count = operator.count;
        let (x, below, floors) = (&lanes(x)[..count], &lanes(a)[..count], &lanes(&a[1..])[..count]);
        let (load, v_out, a_out) =
            (&lanes(load)[..count], &mut lanes_mut(v_out)[..count], &mut lanes_mut(a_out)[..count]);
        let ground = V::splat(a[0]);
        let v = factor.mul(V::load(&floors[0]).sub(V::load(&below[0])));
        v.store(&mut v_out[0]);
        let mut here = operator.force(0, factor.mul(V::load(&x[0])), v);
        for k in 1..count {
            let v = factor.mul(V::load(&floors[k]).sub(V::load(&below[k])));
            v.store(&mut v_out[k]);
            let above = operator.force(k, factor.mul(V::load(&x[k])), v);
            let velocity = factor.mul(V::load(&floors[k - 1]).sub(ground));
            operator.acceleration(k - 1, [here, above], velocity, V::load(&load[k - 1])).store(&mut a_out[k - 1]);
            here = above;
        }
        let (velocity, load) = (factor.mul(V::load(&floors[count - 1]).sub(ground)), V::load(&load[count - 1]));
        operator.acceleration(count - 1, [here, V::splat(0.0)], velocity, load).store(&mut a_out[count - 1]);
    }

    /// Floor accelerations with a full damping matrix, from drifts times a factor, drift rates and floor loads.
    #[inline(always)]
    fn fully_damped<V: Vector>(
        &self,
        damping: &Symmetric<1>,
        x: &[f64],
        factor: V,
        v: &[f64],
        load: &[f64],
        out: &mut [f64],
    ) {
        let operator = self.lanes();
        let count = operator.count;
        let out = &mut out[..WIDTH * count];
        damping.multiply::<V>(v, out);
        let (x, load, out) = (&lanes(x)[..count], &lanes(load)[..count], &mut lanes_mut(out)[..count]);
        let mut here = V::load(&operator.tangent[0]).mul_add(factor.mul(V::load(&x[0])), V::load(&out[0]));
        for k in 0..count {
            let mut above = V::splat(0.0);
            if k + 1 < count {
                let springs = factor.mul(V::load(&x[k + 1]));
                above = V::load(&operator.tangent[k + 1]).mul_add(springs, V::load(&out[k + 1]));
            }
            let net = here.shifted_down(above).sub(here).add(V::load(&load[k]));
            net.mul(V::load(&operator.inverse_mass[k])).store(&mut out[k]);
            here = above;
        }
    }
}

/// An [`LongOperator`] in vectors.
struct LongOperatorLanes<'a> {
    count: usize,
    tangent: &'a [[f64; WIDTH]],
    inverse_mass: &'a [[f64; WIDTH]],
    storey_damping: &'a [[f64; WIDTH]],
    floor_damping: &'a [[f64; WIDTH]],
}

impl LongOperatorLanes<'_> {
    /// Storey forces of vector `k` from its drifts and drift rates.
    #[inline(always)]
    fn force<V: Vector>(&self, k: usize, x: V, v: V) -> V {
        V::load(&self.storey_damping[k]).mul_add(v, V::load(&self.tangent[k]).mul(x))
    }

    /// Floor accelerations of vector `k` from its storey forces and those above, floor velocities and loads.
    #[inline(always)]
    fn acceleration<V: Vector>(&self, k: usize, [here, above]: [V; 2], velocity: V, load: V) -> V {
        let net = here.shifted_down(above).sub(here).add(load);
        net.sub(V::load(&self.floor_damping[k]).mul(velocity)).mul(V::load(&self.inverse_mass[k]))
    }
}
