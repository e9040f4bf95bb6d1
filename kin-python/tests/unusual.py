"""Constraints that no library has, in many ways of writing Python."""

import dataclasses
import functools
import math
from typing import Annotated, Sequence

import numpy as np

import kin
from kin import Coord, Law, Planar, Spatial, Time, Vec2, Vec3, constraint

LAW = Law.sine(0.4, 1.3, 0.2)
TABLE = [0.3, -0.1, 0.05, 0.02]


@constraint
def parabolic_slot(i: Planar, j: Planar, u_i: Vec2, k: float):
    s = j.local(i.point(u_i))
    return s.y - k * s.x**2


@constraint
def horner(x: Coord, y: Coord):
    """A loop over a table of the program."""
    value = 0.0
    for c in reversed(TABLE):
        value = value * x + c
    return y - value


@constraint
def four_links(theta: Annotated[Sequence[Coord], 4], length: Annotated[Sequence[float], 4]):
    """A closed chain of links by comprehensions."""
    closed = [sum(a * f(q) for a, q in zip(length, theta)) for f in (np.cos, np.sin)]
    return closed


@constraint
def by_arrays(theta: Annotated[Sequence[Coord], 3], k: float):
    """NumPy's arrays of coordinates, and of plain numbers."""
    q = np.array(theta)
    weights = np.array([1.0, -2.0, 0.5])
    return np.sum(weights * np.sin(q)) + k * (q @ np.array([1.0, 2.0, 3.0])) - np.exp(-q[0] * q[1])


@constraint
def either_side(x: Coord, y: Coord):
    """Another curve on either side."""
    return y - kin.where((x > 0.1) & (x < 5.0), x * x, np.where(x < -3.0, x, 0.2 * x))


@constraint
def smooth_maximum(x: Coord, y: Coord, z: Coord):
    return kin.log(kin.exp(4 * x) + kin.exp(4 * y)) / 4 - z + kin.maximum(x, y, 0.1) * 0.1 + min_of(x, y)


def min_of(x, y):
    """A helper of another place."""
    return 0.01 * kin.minimum(x, y)


@constraint
def hyperbolic(x: Coord, y: Coord):
    return np.tanh(x) + np.arcsinh(y) - np.arctan(x * y) + np.log1p(x * x) + np.expm1(0.1 * y) + np.cbrt(2 + x)


@constraint
def inverse(x: Coord, y: Coord):
    return kin.asin(0.3 * x) + kin.acos(0.2 * y) + kin.atanh(0.1 * x) + kin.acosh(2 + y * y) + kin.exp2(x) + kin.log2(3 + y)


@constraint
def powers(x: Coord, y: Coord, p: float):
    return (2 + x) ** p - 2.0**y + abs(x - 3) ** 1.5 + (1 + y * y) ** -2 + x**3 / 7 + 1 / (3 + x)


@constraint
def sawtooth(x: Coord, y: Coord):
    """Remainders as Python has them."""
    return y - (x % 0.7) - (-x) % 0.45 + (3 * x) // 2 * 0.1 + math.floor(x) + math.ceil(y) + 0 * np.degrees(x)


@constraint
def rheonomic(b: Planar, t: Time, amplitude: float = 0.3):
    """A point that draws a figure of Lissajous, by time itself."""
    return b.r - kin.vec2(amplitude * np.sin(2 * t), amplitude * kin.cos(3 * t)), b.theta - t**2


@constraint
def chained(x: Coord, law: Law):
    """A law of a law of a coordinate."""
    return law.at(law.at(x) + law.slope(0.5 * x)) - 0.2


@constraint
def nested(a: Planar, b: Planar, n: int, scale: float):
    """A count that is known while it is traced, and a closure."""

    def turn(v, k):
        return v if k == 0 else turn(v.perp() * scale, k - 1)

    return turn(a.r, n).dot(b.r) + turn(a.a() @ (1, 2), n).norm_squared() - b.theta


@constraint
def quadric(b: Spatial, u: Vec3, m: kin.Mat3):
    """A point on a quadric: s · M s = 1, and the trace and determinant of its frame."""
    s = b.point(u)
    return s @ (m @ s) - 1, b.a().trace() + (m @ b.a()).T.determinant(), m.column(1).dot(b.a().row(2))


@constraint
def twisted(i: Spatial, j: Spatial, p: kin.EulerParameters):
    q = p.product(i.p).conjugate().product(j.p)
    return q.rotation() @ (0.1, 0.2, 0.3) - i.direction([0.3, 0.2, 0.1]), q.dot(p) + q.e3


@constraint
def deep(x: Coord, y: Coord):
    """Two hundred steps of a pendulum's map, one in the other."""
    a, b = x, y
    for _ in range(200):
        a, b = a + 0.01 * b, b - 0.01 * np.sin(a)
    return a, b


@constraint
def words(type: Coord, match: Coord, fn: float):
    """Names that are words of Rust."""
    return type * fn - match


@constraint
def saturated(x: Coord, y: Coord):
    return np.clip(x, -0.05, 0.4) + np.maximum(y, 0.1) * np.hypot(x, 2.0) - np.sign(x) * np.sqrt(np.square(y) + 1)


@constraint
def mixed_vectors(a: Planar, b: Planar, u: Vec2):
    d = np.array([0.1, 0.2]) + a.point(u) - (0.3, 0.4)
    e = 2 * d / 3 - -b.r
    return d.lerp(e, 0.25).component_mul(u) + kin.where(d.x > e.x, d, e), np.linalg.norm(e) - np.cross(d, e)


@dataclasses.dataclass
class Segment:
    """A class of the program around."""

    start: Vec2
    end: Vec2

    @property
    def length(self):
        return (self.end - self.start).norm()


@constraint
def by_a_class(i: Planar, j: Planar, u: Vec2, length: float = 0.7):
    return Segment(i.point(u), j.point((0.1, 0.0))).length - length


def chebyshev(n, x):
    return 1.0 if n == 0 else x if n == 1 else 2 * x * chebyshev(n - 1, x) - chebyshev(n - 2, x)


@constraint
def by_recursion(x: Coord, y: Coord):
    return y - chebyshev(6, x)


@constraint
def broadcast(q: Annotated[Sequence[Coord], 3], t: Time):
    """Arrays of coordinates: products with matrices, sums along axes, a mean."""
    matrix = np.array([[1.0, 2.0, 3.0], [0.5, 0.0, -1.0]])
    v = np.array(q)
    differences = v[:, None] * np.array([1.0, np.sin(t)])
    return [*(matrix @ v), (v * v).sum() - differences.sum(axis=0)[1], np.mean(v) - np.prod(v)]


@constraint
def pairs_of_neighbours(q: Annotated[Sequence[Coord], 3]):
    named = dict(zip("abc", q))
    rows = [b - a - 0.1 * k for k, (a, b) in enumerate(zip(q, q[1:]))]
    rows.append(functools.reduce(lambda s, c: s * named["a"] + c, (1.0, 2.0, named["c"])))
    return np.array(rows)


@constraint
def chosen_by_numpy(x: Coord, y: Coord):
    """An early return is a choice between two values."""
    return np.where(x > 0.2, y - x, np.where((x < -0.2) & ~(y > 0.1), y + 2 * x, x * y))


@constraint
def fitted(x: Coord, y: Coord):
    return y - np.polyval([0.3, -0.1, 0.5], x) + len(f"{x:.3f} {y}") * 0.0


@constraint
def inner_function(i: Planar, j: Planar, off: float = 0.1):
    def turned(v, angle):
        c, s = np.cos(angle), np.sin(angle)
        return kin.vec2(c * v.x - s * v.y, s * v.x + c * v.y)

    x, y = turned(i.r, j.theta)
    return {"x": x - off, "y": y - j.r.x}["x"], np.stack([np.array(i.r), np.array(j.r)]).mean(axis=0)


# Each with its parameters.
UNUSUAL = [
    (parabolic_slot, [(0.1, 0.2), 2.0]),
    (horner, []),
    (four_links, [[1.0, 2.0, 3.0, 4.0]]),
    (by_arrays, [0.3]),
    (either_side, []),
    (smooth_maximum, []),
    (hyperbolic, []),
    (inverse, []),
    (powers, [1.7]),
    (sawtooth, []),
    (rheonomic, [0.4]),
    (chained, [LAW]),
    (nested, [3, 0.9]),
    (quadric, [(0.1, 0.2, 0.3), [1, 0.1, 0, 0.1, 2, 0.3, 0, 0.3, 3]]),
    (twisted, [(0.9, 0.1, -0.3, 0.2)]),
    (deep, []),
    (words, [0.3]),
    (saturated, []),
    (mixed_vectors, [(0.7, -0.2)]),
    (by_a_class, [(0.7, -0.2), 0.6]),
    (by_recursion, []),
    (broadcast, []),
    (pairs_of_neighbours, []),
    (chosen_by_numpy, []),
    (fitted, []),
    (inner_function, [0.2]),
]
