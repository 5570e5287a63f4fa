//! Elastic response spectra: peak relative displacement of linear oscillators under a sampled ground motion.
//!
//! # Method
//! The motion is linear between samples, so the state after a step is an exact linear function of the state before
//! and the two samples (Nigam and Jennings 1969, Bull. Seism. Soc. Am. 59:909). Time is measured in steps: with
//! s = w dt and b = dt^2 a, the oscillator is u'' + 2 zeta s u' + s^2 u = -b. Within a step u'' is a free vibration,
//! so its zeros are known in closed form; between them u' is monotone and each of its zeros is bracketed. A step is
//! looked into only when a bound on |u| inside it exceeds the peak so far.
//!
//! # Limitation
//! Damping ratios from 0 to below 1. After the last sample the motion goes to zero over one step and stays there.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::batch::Control;
use crate::error::{Domain, Error, Result};
use crate::scene::Motion;

/// Oscillators advanced together.
const LANES: usize = 8;
/// Steps between two looks at the peaks.
const BLOCK: usize = 16;
/// Blocks between two looks at the stop flag.
const BLOCKS_PER_POLL: usize = 4096;
/// Largest s = w dt for which the power series is used and for which u is bounded by its chord.
const SMALL_STEP: f64 = 1.0;
/// Terms of the power series: s^k / k! is below 1e-19 at s = 1 beyond them, and k of them at zeta = 1.
const SERIES_TERMS: usize = 23;
/// Shortest and longest period over the time step.
const PERIOD_RANGE: [f64; 2] = [1e-3, 1e9];
/// A zero of the velocity is known well enough when the phase moves by less: the peak changes by its square.
const PHASE_TOLERANCE: f64 = 1e-9;
/// Bisection alone would end within this many steps.
const MAX_ITERATIONS: usize = 64;
/// 2 pi - TAU.
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// Peak relative displacement (m) of oscillators at rest at the first sample, in continuous time, the free vibration
/// after the motion included; row-major (motions, damping, periods).
///
/// `periods` in s, `damping` as ratios of critical. Any number of `threads` gives the same bits (default: all cores).
///
/// # Errors
/// [`Error::Invalid`] when a period, a ratio or the number of threads is out of its range, [`Error::NotFinite`] when a
/// displacement is, [`Error::Interrupted`] when stopped.
pub fn response_spectra(
    motions: &[Motion],
    periods: &[f64],
    damping: &[f64],
    threads: Option<usize>,
    control: &Control,
) -> Result<Vec<f64>> {
    validate(motions, periods, damping)?;
    let per_motion = periods.len() * damping.len();
    let mut peaks = vec![0.0; motions.len() * per_motion];
    if peaks.is_empty() {
        return Ok(peaks);
    }
    let solve = |peaks: &mut [f64]| {
        peaks.par_chunks_mut(per_motion).zip(motions).try_for_each(|(peaks, motion)| {
            let load = Load::new(motion);
            peaks.par_chunks_mut(LANES).enumerate().try_for_each(|(group, peaks)| {
                let oscillators: [Oscillator; LANES] = std::array::from_fn(|lane| {
                    let index = group * LANES + lane.min(peaks.len() - 1);
                    Oscillator::new(periods[index % periods.len()], damping[index / periods.len()], motion.dt())
                });
                let found = advance(&load, &oscillators, control)?;
                peaks.copy_from_slice(&found[..peaks.len()]);
                match peaks.iter().position(|peak| !peak.is_finite()) {
                    None => Ok(()),
                    Some(lane) => Err(Error::NotFinite {
                        time: motion.dt() * motion.acceleration().len() as f64,
                        element: format!(
                            "the oscillator of period {} s",
                            periods[(group * LANES + lane) % periods.len()]
                        ),
                    }),
                }
            })
        })
    };
    match threads {
        None => solve(&mut peaks)?,
        Some(threads) => {
            let refuse = |value: String| {
                Error::invalid(Domain::Options, "threads", "spectrum", "a number of threads that can be started", value)
            };
            if threads == 0 {
                return Err(refuse("0".into()));
            }
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.map_err(|error| refuse(format!("{threads} ({error})")))?.install(|| solve(&mut peaks))?;
        }
    }
    Ok(peaks)
}

fn validate(motions: &[Motion], periods: &[f64], damping: &[f64]) -> Result<()> {
    for (i, &period) in periods.iter().enumerate() {
        if !(period.is_finite() && period > 0.0) {
            let owner = format!("oscillator {}", i + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, "a positive number", period));
        }
    }
    if let Some((i, zeta)) = damping.iter().enumerate().find(|(_, zeta)| !(0.0..1.0).contains(*zeta)) {
        let owner = format!("spectrum {}", i + 1);
        return Err(Error::invalid(Domain::Options, "damping", owner, "at least 0 and below 1", zeta));
    }
    for (m, motion) in motions.iter().enumerate() {
        let [shortest, longest] = PERIOD_RANGE.map(|ratio| ratio * motion.dt());
        if let Some((i, period)) = periods.iter().enumerate().find(|(_, t)| !(shortest..=longest).contains(*t)) {
            let owner = format!("oscillator {}", i + 1);
            let requirement = format!("from {shortest} to {longest} s for the time step of motion {}", m + 1);
            return Err(Error::invalid(Domain::Options, "period", owner, requirement, period));
        }
    }
    Ok(())
}

/// A motion times dt^2 (m), with the zero that follows it, and what bounds it in each block of steps.
struct Load {
    samples: Vec<f64>,
    blocks: Vec<LoadBounds>,
}

/// Largest sample and largest increment within a block.
struct LoadBounds {
    sample: f64,
    increment: f64,
}

impl Load {
    fn new(motion: &Motion) -> Self {
        let square = motion.dt() * motion.dt();
        let mut samples: Vec<f64> = motion.acceleration().iter().map(|a| square * a).collect();
        samples.push(0.0);
        let blocks = (0..samples.len() - 1)
            .step_by(BLOCK)
            .map(|start| {
                let within = &samples[start..samples.len().min(start + BLOCK + 1)];
                LoadBounds {
                    sample: within.iter().fold(0.0, |most, b| b.abs().max(most)),
                    increment: within.windows(2).fold(0.0, |most, b| (b[1] - b[0]).abs().max(most)),
                }
            })
            .collect();
        Self { samples, blocks }
    }
}

/// Impulse response g of the oscillator at the end of a step and its integrals, all free of cancellation.
#[derive(Debug, Clone, Copy)]
struct ImpulseResponse {
    /// g.
    gamma: f64,
    /// Integral of g.
    phi1: f64,
    /// Integral of the integral of g.
    phi2: f64,
    /// `phi1 - phi2`.
    psi: f64,
}

impl ImpulseResponse {
    /// After a step of phase s = `s` + `s_low`, with the damping ratio `zeta` and q = sqrt(1 - zeta^2) = `q` + `q_low`.
    fn new([s, s_low]: [f64; 2], zeta: f64, [q, q_low]: [f64; 2]) -> Self {
        if s <= SMALL_STEP {
            // g = sum of c_k with c_1 = 1 and (k + 1) (k + 2) c_(k+2) = -2 zeta s (k + 1) c_(k+1) - s^2 c_k.
            let (mut previous, mut c) = (0.0, 1.0);
            let (mut gamma, mut phi1, mut phi2, mut psi) = (0.0, 0.0, 0.0, 0.0);
            for k in 1..=SERIES_TERMS {
                let k = k as f64;
                gamma += c;
                phi1 += c / (k + 1.0);
                phi2 += c / ((k + 1.0) * (k + 2.0));
                psi += c / (k + 2.0);
                let next = -(2.0 * zeta * s * c + s * s * previous / k) / (k + 1.0);
                previous = c;
                c = next;
            }
            return Self { gamma, phi1, phi2, psi };
        }
        let theta = s * q;
        let theta_low = s.mul_add(q, -theta) + s * q_low + s_low * q;
        let decay_exponent = zeta * s;
        let decay_low = zeta.mul_add(s, -decay_exponent) + zeta * s_low;
        let decay = (-decay_exponent).exp() * (1.0 - decay_low);
        let (sine, cosine) = theta.sin_cos();
        let (sine, cosine) = (sine + theta_low * cosine, cosine - theta_low * sine);
        let gamma = decay * sine / theta;
        let free = decay * cosine + zeta * s * gamma;
        let square = s * s;
        let phi1 = (1.0 - free) / square;
        let phi2 = (1.0 - gamma - 2.0 * zeta * s * phi1) / square;
        let psi = (gamma - free + 2.0 * zeta * s * phi1) / square;
        Self { gamma, phi1, phi2, psi }
    }
}

/// One oscillator seen in steps of the motion.
#[derive(Debug, Clone, Copy)]
struct Oscillator {
    /// Phase of a step, s = w dt.
    s: f64,
    zeta: f64,
    /// sqrt(1 - zeta^2).
    q: f64,
    /// Increment of u over a step, per u, u', and the load at the two ends.
    step_u: [f64; 4],
    /// Increment of u' over a step, per the same.
    step_v: [f64; 4],
    /// Bound of |u| within a block, per largest |u| and |u'| at its samples, largest |b| and largest |increment of b|.
    screen: [f64; 4],
    /// Bound of |u - chord| within a step over the largest |u''| at its ends; only where s is small.
    chord: f64,
}

impl Oscillator {
    fn new(period: f64, zeta: f64, dt: f64) -> Self {
        use std::f64::consts::TAU;
        let w = TAU / period;
        let w_low = ((-w).mul_add(period, TAU) + TAU_LOW) / period;
        let s = w * dt;
        let s_low = w.mul_add(dt, -s) + w_low * dt;
        let zeta_square = zeta * zeta;
        let q_square = 1.0 - zeta_square;
        let q_square_low = (1.0 - q_square) - zeta_square - zeta.mul_add(zeta, -zeta_square);
        let q = q_square.sqrt();
        let q_low = ((-q).mul_add(q, q_square) + q_square_low) / (2.0 * q);

        let ImpulseResponse { gamma, phi1, phi2, psi } = ImpulseResponse::new([s, s_low], zeta, [q, q_low]);
        let (square, viscous) = (s * s, 2.0 * zeta * s);
        let step_u = [-square * phi1, gamma, -psi, -phi2];
        let step_v = [-square * gamma, -(viscous * gamma + square * phi1), phi1 - gamma, -phi1];
        let (screen, chord) = if s <= SMALL_STEP {
            // u'' is a free vibration: within the step at most e^(zeta s) / cos(q s / 2) times its largest end value.
            let chord = (zeta * s).exp() / (8.0 * (0.5 * q * s).cos());
            ([1.0 + chord * square, chord * viscous, chord, 0.0], chord)
        } else {
            // |u| <= |particular| + amplitude of the free vibration about it; see `bound`.
            let particular = [1.0 / square, viscous / (square * square)];
            let (out_of_phase, shift) = (1.0 / (q * s), 1.0 + zeta / q);
            let of_load = [(1.0 + shift) * particular[0], (1.0 + shift) * particular[1] + out_of_phase / square];
            ([shift, out_of_phase, of_load[0], of_load[1]], f64::NAN)
        };
        Self { s, zeta, q, step_u, step_v, screen, chord }
    }

    fn second_derivative(&self, u: f64, v: f64, b: f64) -> f64 {
        -(b + 2.0 * self.zeta * self.s * v + self.s * self.s * u)
    }

    /// Bound of |u| within a step.
    fn bound(&self, step: &Step) -> f64 {
        let Step { u: [u0, u1], v: [v0, v1], b: [b0, b1] } = *step;
        if self.s <= SMALL_STEP {
            let [y0, y1] = [self.second_derivative(u0, v0, b0), self.second_derivative(u1, v1, b1)];
            return u0.abs().max(u1.abs()) + self.chord * y0.abs().max(y1.abs());
        }
        let square = self.s * self.s;
        let shift = 2.0 * self.zeta * (b1 - b0) / self.s;
        let particular = [(shift - b0) / square, (shift - b1) / square];
        let free = u0 - particular[0];
        let free_rate = v0 + (b1 - b0) / square;
        let out_of_phase = (free_rate + self.zeta * self.s * free) / (self.q * self.s);
        particular[0].abs().max(particular[1].abs()) + free.hypot(out_of_phase)
    }

    /// Largest |u| at a zero of u' inside a step.
    fn interior_peak(&self, step: &Step) -> f64 {
        let [u0, _] = step.u;
        let [v0, v1] = step.v;
        let [b0, b1] = step.b;
        let (theta, decay) = (self.q * self.s, self.zeta * self.s);
        let y0 = self.second_derivative(u0, v0, b0);
        let y_rate = -(b1 - b0) - 2.0 * decay * y0 - self.s * self.s * v0;
        let mut phase = (-y0).atan2((y_rate + decay * y0) / theta);
        while phase <= 0.0 {
            phase += std::f64::consts::PI;
        }
        let mut peak = 0.0f64;
        let (mut left, mut v_left) = (0.0, v0);
        while left < 1.0 {
            let right = (phase / theta).min(1.0);
            let v_right = if right < 1.0 { self.within(step, right)[1] } else { v1 };
            if v_left * v_right < 0.0 {
                peak = peak.max(self.monotone_peak(step, [left, right], v_right));
            }
            (left, v_left) = (right, v_right);
            phase += std::f64::consts::PI;
        }
        peak
    }

    /// |u| at the zero of u' in an interval in which u' is monotone and changes sign: Newton, kept inside its bracket.
    fn monotone_peak(&self, step: &Step, [mut left, mut right]: [f64; 2], v_right: f64) -> f64 {
        let mut time = 0.5 * (left + right);
        let tolerance = PHASE_TOLERANCE / self.s.max(1.0);
        for _ in 0..MAX_ITERATIONS {
            let [u, v] = self.within(step, time);
            if v * v_right > 0.0 {
                right = time;
            } else {
                left = time;
            }
            let b = step.b[0] + (step.b[1] - step.b[0]) * time;
            let newton = time - v / self.second_derivative(u, v, b);
            let next = if left <= newton && newton <= right { newton } else { 0.5 * (left + right) };
            let moved = (next - time).abs();
            time = next;
            if moved <= tolerance {
                break;
            }
        }
        self.within(step, time)[0].abs()
    }

    /// u and u' at a time within a step, 0 to 1.
    fn within(&self, step: &Step, time: f64) -> [f64; 2] {
        let Step { u: [u, _], v: [v, _], b: [b0, b1] } = *step;
        let s = self.s * time;
        let ImpulseResponse { gamma, phi1, phi2, .. } = ImpulseResponse::new([s, 0.0], self.zeta, [self.q, 0.0]);
        let (ramp, square) = (time * (b1 - b0), time * time);
        [
            u + (time * gamma * v - s * s * phi1 * u - square * (phi1 * b0 + phi2 * ramp)),
            v - (2.0 * self.zeta * s * gamma + s * s * phi1) * v
                - self.s * s * gamma * u
                - time * (gamma * b0 + phi1 * ramp),
        ]
    }

    /// Largest |u| of the free vibration from a state: at its first extreme, where u^2 + 2 zeta u v + v^2 (v in units
    /// of w) has decayed at the rate 2 zeta w.
    fn free_peak(&self, u: f64, v: f64) -> f64 {
        let v = v / self.s;
        let mut phase = (self.q * v).atan2(self.zeta * v + u);
        if phase < 0.0 {
            phase += std::f64::consts::PI;
        }
        let envelope = (u + self.zeta * v).hypot(self.q * v);
        u.abs().max(envelope * (-self.zeta * phase / self.q).exp())
    }
}

/// Displacement, velocity and load at both ends of a step.
struct Step {
    u: [f64; 2],
    v: [f64; 2],
    b: [f64; 2],
}

/// Peak displacement of each oscillator.
fn advance(load: &Load, oscillators: &[Oscillator; LANES], control: &Control) -> Result<[f64; LANES]> {
    let gather = |of: fn(&Oscillator) -> [f64; 4]| -> [[f64; LANES]; 4] {
        std::array::from_fn(|i| std::array::from_fn(|lane| of(&oscillators[lane])[i]))
    };
    let [uu, uv, u0, u1] = gather(|oscillator| oscillator.step_u);
    let [vu, vv, v0, v1] = gather(|oscillator| oscillator.step_v);
    let screen = gather(|oscillator| oscillator.screen);
    let mut u = [[0.0; LANES]; BLOCK + 1];
    let mut v = [[0.0; LANES]; BLOCK + 1];
    let mut peak = [0.0f64; LANES];
    let mut steps = 0;
    for (block, bounds) in load.blocks.iter().enumerate() {
        if block % BLOCKS_PER_POLL == 0 && control.stop.load(Ordering::Relaxed) {
            return Err(Error::Interrupted);
        }
        (u[0], v[0]) = (u[steps], v[steps]);
        let start = block * BLOCK;
        let samples = &load.samples[start..load.samples.len().min(start + BLOCK + 1)];
        steps = samples.len() - 1;
        let (mut x, mut y) = (u[0], v[0]);
        let (mut most_u, mut most_v) = (x.map(f64::abs), y.map(f64::abs));
        for (pair, (u_end, v_end)) in samples.windows(2).zip(u[1..].iter_mut().zip(&mut v[1..])) {
            for lane in 0..LANES {
                let (from_u, from_v) = (x[lane], y[lane]);
                let of_load = u0[lane] * pair[0] + u1[lane] * pair[1];
                let rate_of_load = v0[lane] * pair[0] + v1[lane] * pair[1];
                x[lane] = from_u + (uu[lane] * from_u + uv[lane] * from_v + of_load);
                y[lane] = from_v + (vu[lane] * from_u + vv[lane] * from_v + rate_of_load);
                most_u[lane] = if x[lane].abs() > most_u[lane] { x[lane].abs() } else { most_u[lane] };
                most_v[lane] = if y[lane].abs() > most_v[lane] { y[lane].abs() } else { most_v[lane] };
            }
            (*u_end, *v_end) = (x, y);
        }
        for lane in 0..LANES {
            peak[lane] = peak[lane].max(most_u[lane]);
            let bound = screen[0][lane] * most_u[lane]
                + screen[1][lane] * most_v[lane]
                + screen[2][lane] * bounds.sample
                + screen[3][lane] * bounds.increment;
            if bound <= peak[lane] {
                continue;
            }
            for (i, pair) in samples.windows(2).enumerate() {
                let step =
                    Step { u: [u[i][lane], u[i + 1][lane]], v: [v[i][lane], v[i + 1][lane]], b: [pair[0], pair[1]] };
                if oscillators[lane].bound(&step) > peak[lane] {
                    peak[lane] = peak[lane].max(oscillators[lane].interior_peak(&step));
                }
            }
        }
    }
    Ok(std::array::from_fn(|lane| {
        let finite = u[steps][lane].is_finite() && v[steps][lane].is_finite();
        if finite { peak[lane].max(oscillators[lane].free_peak(u[steps][lane], v[steps][lane])) } else { f64::NAN }
    }))
}
