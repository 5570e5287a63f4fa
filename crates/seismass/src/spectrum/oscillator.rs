//! One linear oscillator seen in steps of a motion: its exact step, and its extremes inside steps and after the last.

/// Largest s = w dt for which the power series is used and for which u is bounded by its chord.
const SMALL_STEP: f64 = 1.0;
/// Largest zeta s of steps taken as small: 8 zeta s `chord` is below 0.4 up to there, and has to be below 1.
const MOST_DECAY: f64 = 0.25;
/// Terms of the power series: s^k / k! is below 1e-19 at s = 1 beyond them, and k of them at zeta = 1.
const SERIES_TERMS: usize = 23;
/// Terms that change no sum any more: the smallest, `phi2`, is above 0.1.
const NEGLIGIBLE: f64 = 1e-19;
/// 1 / k.
const INVERSES: [f64; SERIES_TERMS + 3] = {
    let mut inverses = [0.0; SERIES_TERMS + 3];
    let mut k = 1;
    while k < inverses.len() {
        inverses[k] = 1.0 / k as f64;
        k += 1;
    }
    inverses
};
/// A zero of the velocity is known well enough when the phase moves by less: the peak changes by its square.
const PHASE_TOLERANCE: f64 = 1e-9;
/// Bisection alone would end within this many steps.
const MAX_ITERATIONS: usize = 64;
/// 2 pi - TAU.
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

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
                let (next_inverse, second_inverse) = (INVERSES[k + 1], INVERSES[k + 2]);
                gamma += c;
                phi1 += c * next_inverse;
                phi2 += c * next_inverse * second_inverse;
                psi += c * second_inverse;
                let next = -(2.0 * zeta * s * c + s * s * previous * INVERSES[k]) * next_inverse;
                previous = c;
                c = next;
                if c.abs() + previous.abs() < NEGLIGIBLE {
                    break;
                }
            }
            return Self { gamma, phi1, phi2, psi };
        }
        let theta = s * q;
        let theta_low = s.mul_add(q, -theta) + s * q_low + s_low * q;
        let decay_exponent = zeta * s;
        let decay_low = zeta.mul_add(s, -decay_exponent) + zeta * s_low;
        let decay = libm::exp(-decay_exponent) * (1.0 - decay_low);
        let (sine, cosine) = libm::sincos(theta);
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

/// Whether steps `dt` are so small that |u| within them is bounded by its samples and the load ([`Oscillator::screen`]).
pub(super) fn is_small_step(period: f64, zeta: f64, dt: f64) -> bool {
    let s = std::f64::consts::TAU / period * dt;
    s <= SMALL_STEP && zeta * s <= MOST_DECAY
}

/// One oscillator seen in steps of the motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Oscillator {
    /// Phase of a step, s = w dt.
    pub(super) s: f64,
    pub(super) zeta: f64,
    /// sqrt(1 - zeta^2).
    pub(super) q: f64,
    /// Increment of u over a step, per u, u', and the load at the two ends.
    pub(super) step_u: [f64; 4],
    /// Increment of u' over a step, per the same.
    pub(super) step_v: [f64; 4],
    /// Increment over a step of the increment w of u, per u, w, and the load at the two ends and at the end of the next.
    pub(super) step_w: [f64; 5],
    /// Particular solution per b and per increment of b: u_p = -(first b - second increment).
    pub(super) particular: [f64; 2],
    /// Bound of |u - chord| within a step over the largest |u''| at its ends; only where s is small.
    pub(super) chord: f64,
}

impl Oscillator {
    pub(super) fn new(period: f64, zeta: f64, dt: f64) -> Self {
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
        let ([uu, uv, u0, u1], [vu, vv, v0, v1]) = (step_u, step_v);
        // w = uu u + uv v + u0 b0 + u1 b1 in place of v. Where the step is small, no sum loses more than a digit.
        let step_w = [uv * vu - vv * uu, uu + vv, uv * v0 - vv * u0 - u0, uv * v1 - vv * u1 + (u0 - u1), u1];
        // u'' is a free vibration: within a small step at most e^(zeta s) / cos(q s / 2) times its largest end value.
        let chord = libm::exp(zeta * s) / (8.0 * libm::cos(0.5 * q * s));
        let particular = [1.0 / square, viscous / (square * square)];
        Self { s, zeta, q, step_u, step_v, step_w, particular, chord }
    }

    /// Bound of |u| within a block of small steps, per largest |u| and |b| of its samples.
    ///
    /// With Y the largest |u''| at samples, |u''| <= 8 `chord` Y, so v differs from the increment of u by 4 `chord` Y at
    /// most, and u'' = -(b + 2 zeta s v + s^2 u) gives Y <= |b| + s^2 |u| + 2 zeta s (2 |u| + 4 `chord` Y).
    pub(super) fn screen(&self) -> [f64; 2] {
        let of_load = self.chord / (1.0 - 8.0 * self.zeta * self.s * self.chord);
        [1.0 + of_load * (self.s * self.s + 4.0 * self.zeta * self.s), of_load]
    }

    /// The increment of u over the step to which loads belong.
    pub(super) fn increment(&self, [u, v]: [f64; 2], [b0, b1]: [f64; 2]) -> f64 {
        let [uu, uv, u0, u1] = self.step_u;
        uu * u + uv * v + (u0 * b0 + u1 * b1)
    }

    /// The v at its start, where the increment of u over the step is `w`.
    pub(super) fn rate(&self, [u, w]: [f64; 2], [b0, b1]: [f64; 2]) -> f64 {
        let [uu, uv, u0, u1] = self.step_u;
        (w - uu * u - (u0 * b0 + u1 * b1)) / uv
    }

    fn second_derivative(&self, u: f64, v: f64, b: f64) -> f64 {
        -(b + 2.0 * self.zeta * self.s * v + self.s * self.s * u)
    }

    /// The step from a state under a load.
    pub(super) fn step(&self, [u, v]: [f64; 2], b: [f64; 2]) -> Step {
        let [vu, vv, v0, v1] = self.step_v;
        let v_end = v + (vu * u + vv * v + (v0 * b[0] + v1 * b[1]));
        Step { u: [u, u + self.increment([u, v], b)], v: [v, v_end], b }
    }

    /// Bound of |u| within a step.
    pub(super) fn bound(&self, step: &Step) -> f64 {
        let Step { u: [u0, u1], v: [v0, v1], b: [b0, b1] } = *step;
        if self.s <= SMALL_STEP {
            let [y0, y1] = [self.second_derivative(u0, v0, b0), self.second_derivative(u1, v1, b1)];
            return u0.abs().max(u1.abs()) + self.chord * y0.abs().max(y1.abs());
        }
        // The particular solution is linear, the free vibration about it decays.
        let [per_load, per_increment] = self.particular;
        let particular = [b0, b1].map(|b| per_increment * (b1 - b0) - per_load * b);
        let free = u0 - particular[0];
        let free_rate = v0 + per_load * (b1 - b0);
        let out_of_phase = (free_rate + self.zeta * self.s * free) / (self.q * self.s);
        particular[0].abs().max(particular[1].abs()) + libm::hypot(free, out_of_phase)
    }

    /// The larger of `peak` and |u| at any zero of u' inside the steps of a block.
    pub(super) fn peak_inside_steps(&self, mut state: [f64; 2], samples: &[f64], mut peak: f64) -> f64 {
        for pair in samples.windows(2) {
            let step = self.step(state, [pair[0], pair[1]]);
            if self.bound(&step) > peak {
                peak = peak.max(self.interior_extreme(&step)[1].abs());
            }
            state = step.end();
        }
        peak
    }

    /// Time within the step, 0 to 1, and u where |u| is largest at a zero of u' inside a step; zeros where there is none.
    pub(super) fn interior_extreme(&self, step: &Step) -> [f64; 2] {
        let [u0, u1] = step.u;
        let [v0, v1] = step.v;
        let [b0, b1] = step.b;
        let y0 = self.second_derivative(u0, v0, b0);
        // The zeros of u'' are half a period apart, so a small step has at most one.
        if self.s <= SMALL_STEP && y0 * self.second_derivative(u1, v1, b1) > 0.0 {
            return if v0 * v1 < 0.0 { self.monotone_extreme(step, [0.0, 1.0], [v0, v1]) } else { [0.0; 2] };
        }
        let (theta, decay) = (self.q * self.s, self.zeta * self.s);
        let y_rate = -(b1 - b0) - 2.0 * decay * y0 - self.s * self.s * v0;
        let mut phase = libm::atan2(-y0, (y_rate + decay * y0) / theta);
        while phase <= 0.0 {
            phase += std::f64::consts::PI;
        }
        let mut extreme = [0.0f64; 2];
        let (mut left, mut v_left) = (0.0, v0);
        while left < 1.0 {
            let right = (phase / theta).min(1.0);
            let v_right = if right < 1.0 { self.within(step, right)[1] } else { v1 };
            if v_left * v_right < 0.0 {
                let [time, u] = self.monotone_extreme(step, [left, right], [v_left, v_right]);
                if u.abs() > extreme[1].abs() {
                    extreme = [time, u];
                }
            }
            (left, v_left) = (right, v_right);
            phase += std::f64::consts::PI;
        }
        extreme
    }

    /// Time and u at the zero of u' in an interval in which u' is monotone and changes sign: Newton, kept inside its
    /// bracket.
    fn monotone_extreme(&self, step: &Step, [mut left, mut right]: [f64; 2], [v_left, v_right]: [f64; 2]) -> [f64; 2] {
        let mut time = left + (right - left) * (v_left / (v_left - v_right));
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
        [time, self.within(step, time)[0]]
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

    /// Largest |u| of the free vibration from a state.
    pub(super) fn free_peak(&self, u: f64, v: f64) -> f64 {
        u.abs().max(self.free_extreme(u, v)[1].abs())
    }

    /// OscillatorSteps until the first extreme of the free vibration from a state, and u there, where u^2 + 2 zeta u v + v^2 (v in
    /// units of w) has decayed at the rate 2 zeta w. A velocity upwards leads to a positive extreme.
    pub(super) fn free_extreme(&self, u: f64, v: f64) -> [f64; 2] {
        let v = v / self.s;
        let mut phase = libm::atan2(self.q * v, self.zeta * v + u);
        if phase < 0.0 {
            phase += std::f64::consts::PI;
        }
        let envelope = libm::hypot(u + self.zeta * v, self.q * v);
        let extreme = envelope * libm::exp(-self.zeta * phase / self.q);
        [phase / (self.q * self.s), if v < 0.0 { -extreme } else { extreme }]
    }
}

/// Displacement, velocity and load at both ends of a step.
pub(super) struct Step {
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
    pub(super) b: [f64; 2],
}

impl Step {
    /// Displacement and velocity at its end.
    pub(super) fn end(&self) -> [f64; 2] {
        [self.u[1], self.v[1]]
    }
}
