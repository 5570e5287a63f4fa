"""Taylor series of all that moves, in the time itself: decimal numbers have no overflow.

The direction d of a relative velocity r follows, order by order, from r x d = 0 and |d| = 1 alone. A block in motion
has its part across from order k of r x d. A block at rest that starts has it from order k + 1, where r_(k+1) contains
d_k: one linear system for all that start at an instant. The series of a start with mu_s = mu_k is asymptotic.
"""

from __future__ import annotations

from decimal import Decimal
from operator import mul

from forty_digits.model import Block, Precision, Storey, Vector, length
from forty_digits.polynomials import ZERO, Series, product

NONE = Decimal("1e-24")
"""An acceleration below this part of the friction is none."""


def solved(matrix: list[Vector], right: Vector) -> Vector:
    """Solve a small linear system by elimination with pivots."""
    n = len(right)
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda row: abs(rows[row][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for j in range(i + 1, n):
            factor = rows[j][i] / rows[i][i]
            rows[j] = [x - factor * y for x, y in zip(rows[j], rows[i], strict=True)]
    found = [ZERO] * n
    for i in reversed(range(n)):
        rest = rows[i][n] - sum((rows[i][j] * found[j] for j in range(i + 1, n)), ZERO)
        found[i] = rest / rows[i][i]
    return found


def cross(r: list[Series], d: list[Series], k: int) -> Decimal:
    """Order k of r x d, by the terms that are known."""
    low, end = max(0, k + 1 - len(d[0])), min(k + 1, len(r[0]))
    turned = [p[k - low :: -1] for p in d]
    return sum(map(mul, r[0][low:end], turned[1]), ZERO) - sum(map(mul, r[1][low:end], turned[0]), ZERO)


class Motion:
    """The series from an instant on.

    Attributes
    ----------
    u : list by direction, by floor
        Displacements relative to the ground.
    a : list by direction, by node with the ground first
        Absolute accelerations.
    moving : list of Block
        Blocks that slide or start.
    r, d : list by moving block, by direction
        Relative velocities and their directions.
    speed : list by moving block
        Lengths of the relative velocities.
    """

    def __init__(
        self,
        displacement: list[Vector],
        velocity: list[Vector],
        blocks: list[Block],
        storeys: list[list[Storey]],
        damping: list[list[Vector]],
        mass: Vector,
        ground: list[Series],
        contact: Series,
        precision: Precision,
    ) -> None:
        self.storeys, self.damping, self.ground, self.contact = storeys, damping, ground, contact
        self.precision = precision
        self.u = [[[x, v] for x, v in zip(*pair, strict=True)] for pair in zip(displacement, velocity, strict=True)]
        self.a: list[list[Series]] = [[[] for _ in range(len(mass) + 1)] for _ in range(2)]
        self.moving = [block for block in blocks if block.moves]
        self.r: list[list[Series]] = [[[c] for c in block.r] for block in self.moving]
        self.d = [[[c] for c in block.start or [c / length(block.r) for c in block.r]] for block in self.moving]
        self.mass = [
            m + sum((block.mass for block in blocks if block.node == p and not block.moves), ZERO)
            for p, m in enumerate(mass, start=1)
        ]
        for k in range(precision.order + 1):
            self._bare(k)
            if k > 0:
                self._directions(k)
            self._finish(k)
        self.speed = []
        for r, d in zip(self.r, self.d, strict=True):
            x, y = (product(one, other)[: precision.order + 1] for one, other in zip(r, d, strict=True))
            self.speed.append([one + other for one, other in zip(x, y, strict=True)])

    def _bare(self, k: int) -> None:
        """Accelerations of order k without friction: forces of springs and dampers over mass, and the ground."""
        for a in range(2):
            u = [series[k] for series in self.u[a]]
            v = [(k + 1) * series[k + 1] for series in self.u[a]]
            shear = []
            for p, storey in enumerate(self.storeys[a]):
                drift = u[p] - (u[p - 1] if p else ZERO)
                shear.append(storey.tangent() * drift + (storey.constant() if k == 0 else ZERO))
            shear.append(ZERO)
            self.a[a][0].append(self.ground[a][k] if k < 2 else ZERO)
            for p, mass in enumerate(self.mass):
                force = shear[p + 1] - shear[p] - sum(map(mul, self.damping[a][p], v), ZERO)
                self.a[a][p + 1].append(force / mass)

    def _friction(self, i: int, a: int, k: int) -> Decimal:
        """Friction of order k of a moving block over its mass: mu_k (N d)_k."""
        d = self.d[i][a]
        before = self.contact[1] * d[k - 1] if k else ZERO
        return self.moving[i].mu_k * (self.contact[0] * d[k] + before)

    def _rates(self, k: int) -> list[Vector]:
        """Order k + 1 of all relative velocities, by the directions to order k."""
        friction = [[self._friction(i, a, k) for a in range(2)] for i in range(len(self.moving))]
        found = []
        for i, block in enumerate(self.moving):
            rate = []
            for a in range(2):
                floor = self.a[a][block.node][k]
                if block.node:
                    goods = zip(self.moving, friction, strict=True)
                    on_node = sum((b.mass * f[a] for b, f in goods if b.node == block.node), ZERO)
                    floor += on_node / self.mass[block.node - 1]
                rate.append(-(friction[i][a] + floor) / (k + 1))
            found.append(rate)
        return found

    def _directions(self, k: int) -> None:
        """Order k of the directions: along the first by |d| = 1, across by r x d = 0."""
        starts = []
        for i, block in enumerate(self.moving):
            squares = sum((sum(map(mul, p[1:k], p[k - 1 : 0 : -1]), ZERO) for p in self.d[i]), ZERO)
            for p in self.d[i]:
                p.append(-squares / 2 * p[0])
            if block.start is None:
                self._turn(i, k, -cross(self.r[i], self.d[i], k) / length(block.r))
            else:
                starts.append(i)
        if starts:
            matrix = [[self._response(i, j, k) for j in starts] for i in starts]
            parts = solved(matrix, [-value for value in self._remains(k, starts)])
            for i, part in zip(starts, parts, strict=True):
                self._turn(i, k, part)

    def _turn(self, i: int, k: int, part: Decimal) -> None:
        """Add a part across the first direction to a direction of order k."""
        p, q = self.d[i]
        p[k] -= part * q[0]
        q[k] += part * p[0]

    def _remains(self, k: int, starts: list[int]) -> Vector:
        """Order k + 1 of r x d of the blocks that start, by the directions to order k."""
        rates = self._rates(k)
        known = [[[*p, rate] for p, rate in zip(self.r[i], rates[i], strict=True)] for i in starts]
        return [cross(r, self.d[i], k + 1) for r, i in zip(known, starts, strict=True)]

    def _response(self, i: int, j: int, k: int) -> Decimal:
        """What a unit part across of the direction of j, d_0 turned by a quarter, adds to order k + 1 of r x d of i."""
        one, other = self.moving[i], self.moving[j]
        (x, y), (p, q) = ([series[0] for series in self.d[at]] for at in (i, j))
        force = other.mu_k * self.contact[0] * (p * x + q * y)  # -(n_j x d_0) = d_j . d_0
        found = ZERO
        if one.node == other.node and one.node:
            found += other.mass * force / self.mass[one.node - 1] / (k + 1)
        if i == j:
            found += force / (k + 1) + self.r[i][0][1] * x + self.r[i][1][1] * y  # r_1 x n
        return found

    def _finish(self, k: int) -> None:
        """Take what follows from the directions to order k."""
        rates = self._rates(k)
        for i, block in enumerate(self.moving):
            # A breakaway with mu_s = mu_k has no acceleration, but for what its guard takes as equal.
            is_zero = k == 0 and block.start is not None and length(rates[i]) < NONE * block.mu_s * self.contact[0]
            for a in range(2):
                if block.node:
                    self.a[a][block.node][k] += block.mass * self._friction(i, a, k) / self.mass[block.node - 1]
                self.r[i][a].append(ZERO if is_zero else rates[i][a])
        for a in range(2):
            for p, series in enumerate(self.u[a]):
                ground = self.ground[a][k] if k < 2 else ZERO
                series.append((self.a[a][p + 1][k] - ground) / ((k + 1) * (k + 2)))

    def end(self, h: Decimal) -> Decimal:
        """The step after which the last terms are below their limit, and no velocity has come to zero."""
        limits = [(d, Decimal(1)) for pair in self.d for d in pair]
        for a in range(2):
            size = max(abs(self.ground[a][0]), Decimal("0.1"))
            limits += [(series, max(abs(series[0]), size)) for series in self.a[a][1:]]
        order = self.precision.order
        digits = [
            self.precision.last.adjusted() + size.adjusted() - c.adjusted() - 1
            for series, size in limits
            for c in series[-3:]
            if c
        ]
        step = min([h, *(Decimal(10) ** (Decimal(d) / order) for d in digits)])
        for speed in self.speed:
            first = next(k for k, c in enumerate(speed) if c)
            while True:
                terms = (c * step ** (k - first) for k, c in enumerate(speed) if k > first and c < 0)
                if -sum(terms, ZERO) <= Decimal("0.76") * speed[first]:
                    break
                step *= Decimal("0.8")
        return step
