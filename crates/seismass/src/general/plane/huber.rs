//! The acceleration of a node whose blocks press on stops: the minimum of a convex function (`numerics`, section 9.7).

use crate::general::plane::vector::{Vector2, dot, length, minus, plus, times};

/// A block as it acts on its node: y = A - drive, up to `limit` as mass, beyond as a force of that size along y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carried {
    pub(super) mass: f64,
    pub(super) drive: Vector2,
    /// Infinite for a block that sticks whatever y is (m/s2).
    pub(super) limit: f64,
}

impl Carried {
    /// m y up to the limit, m limit y/|y| beyond.
    fn force(&self, a: Vector2) -> Vector2 {
        let y = minus(a, self.drive);
        times(self.mass * (self.limit / length(y)).min(1.0), y)
    }

    /// The potential of the force.
    fn potential(&self, a: Vector2) -> f64 {
        let size = length(minus(a, self.drive));
        let within = size.min(self.limit);
        self.mass * (0.5 * within * within + if size > self.limit { self.limit * (size - self.limit) } else { 0.0 })
    }

    /// Second derivatives of the potential: xx, xy, yy.
    fn curvature(&self, a: Vector2) -> [f64; 3] {
        let y = minus(a, self.drive);
        let size = length(y);
        if size <= self.limit {
            return [self.mass, 0.0, self.mass];
        }
        let factor = self.mass * self.limit / (size * size * size);
        [factor * y[1] * y[1], -factor * y[0] * y[1], factor * y[0] * y[0]]
    }
}

/// The A with m A + the forces of all blocks = Q, by Newton's method on two unknowns; a step that does not lower the
/// convex function whose gradient vanishes there is halved.
pub(super) fn acceleration(mass: f64, q: Vector2, blocks: &[Carried]) -> Vector2 {
    let potential = |a: Vector2| {
        let of_blocks: f64 = blocks.iter().map(|block| block.potential(a)).sum();
        0.5 * mass * dot(a, a) - dot(q, a) + of_blocks
    };
    let mut a = times(1.0 / (mass + blocks.iter().map(|block| block.mass).sum::<f64>()), q);
    let mut value = potential(a);
    for _ in 0..100 {
        let mut gradient = minus(times(mass, a), q);
        let [mut xx, mut xy, mut yy] = [mass, 0.0, mass];
        for block in blocks {
            gradient = plus(gradient, block.force(a));
            let curvature = block.curvature(a);
            (xx, xy, yy) = (xx + curvature[0], xy + curvature[1], yy + curvature[2]);
        }
        let determinant = xx * yy - xy * xy;
        let mut step =
            times(-1.0 / determinant, [yy * gradient[0] - xy * gradient[1], xx * gradient[1] - xy * gradient[0]]);
        if length(step) <= f64::EPSILON * length(a) {
            return plus(a, step);
        }
        let mut next = potential(plus(a, step));
        let enough = f64::EPSILON * (value.abs() + dot(q, a).abs());
        for _ in 0..60 {
            if next <= value + enough {
                break;
            }
            step = times(0.5, step);
            next = potential(plus(a, step));
        }
        a = plus(a, step);
        value = next;
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    /// m A + the forces of the blocks = Q holds to rounding, with blocks within their limits and beyond.
    #[test]
    fn forces_balance() {
        for step in 0..200 {
            let t = 0.1 * f64::from(step);
            let q = [30.0 * t.sin(), 20.0 * (1.7 * t).cos()];
            let blocks = [
                Carried { mass: 0.1, drive: [-1.2, 0.4 * t.cos()], limit: 1.0 },
                Carried { mass: 10.0, drive: [1.15 * t.sin(), 0.3], limit: 1.0 },
                Carried { mass: 2.0, drive: [0.0; 2], limit: 0.5 },
            ];
            let a = acceleration(1.0, q, &blocks);
            let sum = blocks.iter().fold(a, |sum, block| plus(sum, block.force(a)));
            assert!(length(minus(sum, q)) < 1e-12 * (1.0 + length(q)), "{step}: {a:?}");
        }
    }
}
