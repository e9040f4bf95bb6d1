"""Defines vectors, matrices and Euler parameters of plain or traced numbers."""

from __future__ import annotations

import math
from typing import Any, Iterator, Optional, Sequence, Union

import numpy as np

from . import _native
from ._dimension import NumberLike, valued
from ._number import Number
from ._place import users_line
from ._scalars import Expr, Scalar, Traced
from . import _functions as functions
from . import _mistakes
from ._ufunc import Operand, real


class _Components(Operand):
    """Numbers with names, `_NAMES`; traced ones know the expression as a whole, `_node` of `_trace`."""

    __slots__ = ("_all", "_trace", "_node")
    _NAMES: tuple[str, ...] = ()
    _TYPE = ""

    def __init__(self, *components: Union[Scalar, NumberLike]) -> None:
        if len(components) != len(self._NAMES):
            raise TypeError(f"{type(self).__name__} has {len(self._NAMES)} components, not {len(components)}")
        self._all: Optional[tuple[Any, ...]] = tuple(
            one if isinstance(one, Number) else real(one) for one in components
        )
        traced = next((one for one in components if isinstance(one, Expr)), None)
        self._trace: Any = traced._trace if traced is not None else None
        self._node: Optional[int] = None

    @classmethod
    def _of(cls, trace: Any, node: int) -> Any:
        made = cls.__new__(cls)
        made._all, made._trace, made._node = None, trace, node
        return made

    def _components(self) -> tuple[Scalar, ...]:
        if self._all is None:
            parts = (self._trace.op("{}." + name, "f64", self._node) for name in self._NAMES)
            self._all = tuple(Expr(self._trace, part) for part in parts)
        return self._all

    def _in(self, trace: Any) -> int:
        """The node of the whole, in a trace."""
        if self._node is None or self._trace is not trace:
            self._node = self._made(trace)
            self._trace = trace
        return self._node

    def _made(self, trace: Any) -> int:
        parts = [trace.number(one) for one in self._components()]
        holes = ", ".join("{:a}" for _ in parts)
        made: int = trace.op(f"{self._TYPE}::new({holes})", self._TYPE, *parts)
        return made

    def __iter__(self) -> Iterator[Scalar]:
        return iter(self._components())

    def __len__(self) -> int:
        return len(self._NAMES)

    def __getitem__(self, key: int) -> Scalar:
        return self._components()[key]

    def __repr__(self) -> str:
        if self._trace is not None and self._node is not None:
            return str(self._trace.inline(self._node))
        return f"{type(self).__name__}({', '.join(repr(one) for one in self._components())})"

    def __eq__(self, other: Any) -> bool:
        if self._trace is not None or getattr(other, "_trace", None) is not None:
            _mistakes.at(users_line(), "vectors are compared component by component here: a.x == b.x")
        return isinstance(other, type(self)) and self._components() == other._components()

    def __hash__(self) -> int:
        return hash((type(self).__name__, self._components()))

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        parts = self._components()
        if not any(isinstance(one, Number) for one in parts):
            return np.array(parts, dtype=dtype or float)
        array = np.empty(len(parts), dtype=object)
        array[:] = parts
        return array

    def __reduce__(self) -> Any:
        return (type(self), self._components())


class _Vector(_Components):
    __slots__ = ()

    @property
    def value(self) -> Any:
        """The vector of plain numbers, with the nominal value of each dimension, such as for `link.start`."""
        return type(self)(*(valued(one) for one in self))

    def _like(self, other: Any) -> Any:
        """The same kind of vector of anything with as many numbers; `None` of anything else."""
        if isinstance(other, type(self)):
            return other
        if isinstance(other, (tuple, list, np.ndarray)) and len(other) == len(self._NAMES):
            return type(self)(*other)
        return None

    def _both(self, template: str, other: Any, plain: Any, swapped: bool = False) -> Any:
        second = self._like(other)
        if second is None:
            return NotImplemented
        first = self
        if swapped:
            first, second = second, first
        trace = first._trace or second._trace
        if trace is None:
            return type(self)(*(plain(a, b) for a, b in zip(first, second)))
        return type(self)._of(trace, trace.op(template, self._TYPE, first._in(trace), second._in(trace)))

    def _scaled(self, template: str, factor: Any, plain: Any) -> Any:
        trace = self._trace or getattr(factor, "_trace", None)
        if trace is None:
            if not isinstance(factor, (int, float, np.integer, np.floating, Number)):
                return NotImplemented
            return type(self)(*(plain(a, factor) for a in self))
        operand = trace.number(factor)
        if operand is None:
            return NotImplemented
        return type(self)._of(trace, trace.op(template, self._TYPE, self._in(trace), operand))

    def __add__(self, other: Any) -> Any:
        return self._both("{} + {}", other, lambda a, b: a + b)

    def __radd__(self, other: Any) -> Any:
        if isinstance(other, int) and other == 0:
            return self  # the beginning of `sum`
        return self._both("{} + {}", other, lambda a, b: a + b, swapped=True)

    def __sub__(self, other: Any) -> Any:
        return self._both("{} - {}", other, lambda a, b: a - b)

    def __rsub__(self, other: Any) -> Any:
        return self._both("{} - {}", other, lambda a, b: a - b, swapped=True)

    def __mul__(self, factor: Any) -> Any:
        return self._scaled("{} * {}", factor, lambda a, s: a * s)

    __rmul__ = __mul__

    def __truediv__(self, divisor: Any) -> Any:
        return self._scaled("{} / {}", divisor, lambda a, s: a / s)

    def __neg__(self) -> Any:
        if self._trace is None:
            return type(self)(*(-one for one in self))
        return type(self)._of(self._trace, self._trace.op("-{}", self._TYPE, self._in(self._trace)))

    def __pos__(self) -> Any:
        return self

    def __matmul__(self, other: Any) -> Any:
        return self.dot(other)

    def __rmatmul__(self, other: Any) -> Any:
        n = len(self._NAMES)
        if isinstance(other, np.ndarray) and other.shape == (n, n):
            return type(self)(*(sum((a * b for a, b in zip(row, self)), 0.0) for row in other.tolist()))
        return self.dot(other) if self._like(other) is not None else NotImplemented

    def _asked(self, method: str, other: Any) -> tuple[Any, Any]:
        second = self._like(other)
        if second is None:
            raise TypeError(f"`{method}` of a {type(self).__name__} needs one too, not {other!r}")
        return second, self._trace or second._trace

    def dot(self, other: Any) -> Scalar:
        """Returns the dot product a · b."""
        second, trace = self._asked("dot", other)
        if trace is None:
            found: Scalar = sum((a * b for a, b in zip(self, second)), 0.0)
            return found
        return Expr(trace, trace.op("{}.dot({:a})", "f64", self._in(trace), second._in(trace)))

    def norm_squared(self) -> Scalar:
        """Returns the squared length |a|²."""
        return self.dot(self)

    def norm(self) -> Scalar:
        """Returns the length |a|."""
        if self._trace is None:
            if any(isinstance(one, Number) for one in self):
                return functions.sqrt(self.dot(self))
            return math.hypot(*(float(one) for one in self))
        return Expr(self._trace, self._trace.op("{}.norm()", "f64", self._in(self._trace)))

    def normalize(self) -> Any:
        """Returns the unit vector a/|a|."""
        return self / self.norm()

    def component_mul(self, other: Any) -> Any:
        """Returns the vector of the products (a_x b_x, a_y b_y, …)."""
        second, _ = self._asked("component_mul", other)
        return type(self)(*(a * b for a, b in zip(self, second)))

    def lerp(self, other: Any, s: Scalar) -> Any:
        """Returns the linear interpolation a + s (b − a)."""
        second, _ = self._asked("lerp", other)
        return self + (second - self) * s


class Vec2(_Vector):
    """A vector of the plane, (x, y), of plain numbers, or of traced numbers in a function under `@kin.constraint`."""

    __slots__ = ()
    _NAMES = ("x", "y")
    _TYPE = "Vec2"

    @property
    def x(self) -> Scalar:
        return self._components()[0]

    @property
    def y(self) -> Scalar:
        return self._components()[1]

    def perp(self) -> "Vec2":
        """Returns (−y, x): the vector rotated by 90° counter-clockwise."""
        if self._trace is None:
            return Vec2(-self.y, self.x)
        made: Vec2 = Vec2._of(self._trace, self._trace.op("{}.perp()", "Vec2", self._in(self._trace)))
        return made

    def cross(self, other: Any) -> Scalar:
        """Returns a_x b_y − a_y b_x, the z-component of the cross product."""
        second, trace = self._asked("cross", other)
        if trace is None:
            return self.x * second.y - self.y * second.x  # type: ignore[no-any-return]
        return Expr(trace, trace.op("{}.cross({:a})", "f64", self._in(trace), second._in(trace)))


class Vec3(_Vector):
    """A vector of space, (x, y, z), of plain numbers, or of traced numbers in a function under `@kin.constraint`."""

    __slots__ = ()
    _NAMES = ("x", "y", "z")
    _TYPE = "Vec3"

    @property
    def x(self) -> Scalar:
        return self._components()[0]

    @property
    def y(self) -> Scalar:
        return self._components()[1]

    @property
    def z(self) -> Scalar:
        return self._components()[2]

    def cross(self, other: Any) -> "Vec3":
        """Returns the cross product a × b."""
        b, trace = self._asked("cross", other)
        if trace is None:
            return Vec3(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
        made: Vec3 = Vec3._of(trace, trace.op("{}.cross({:a})", "Vec3", self._in(trace), b._in(trace)))
        return made

    def axis(self) -> "Axis":
        """Returns the axis along the vector, with an f that Kin chooses."""
        if self._trace is not None:
            _mistakes.at(users_line(), "an axis of traced numbers: give the constraint an argument of the type Axis")
        return Axis.along(self)


class EulerParameters(_Components):
    """Euler parameters (e0, e1, e2, e3), scalar first."""

    __slots__ = ()
    _NAMES = ("e0", "e1", "e2", "e3")
    _TYPE = "EulerParameters"

    def __init__(self, e0: Scalar = 1.0, e1: Scalar = 0.0, e2: Scalar = 0.0, e3: Scalar = 0.0) -> None:
        super().__init__(e0, e1, e2, e3)

    @property
    def e0(self) -> Scalar:
        return self._components()[0]

    @property
    def e1(self) -> Scalar:
        return self._components()[1]

    @property
    def e2(self) -> Scalar:
        return self._components()[2]

    @property
    def e3(self) -> Scalar:
        return self._components()[3]

    @staticmethod
    def from_axis_angle(axis: Any, angle: float) -> "EulerParameters":
        """Returns (cos φ/2, n sin φ/2) of a rotation by φ about an axis. [rad]"""
        return EulerParameters(*_native.euler_turned([float(one) for one in axis], float(angle)))

    def vector(self) -> Vec3:
        """The vector part (e1, e2, e3)."""
        return Vec3(self.e1, self.e2, self.e3)

    def conjugate(self) -> "EulerParameters":
        """Returns (e0, −e1, −e2, −e3), the inverse rotation."""
        return EulerParameters(self.e0, -self.e1, -self.e2, -self.e3)

    def dot(self, other: "EulerParameters") -> Scalar:
        """Returns the sum of the products of the components."""
        return sum((a * b for a, b in zip(self, other)), 0)

    def norm_squared(self) -> Scalar:
        """Returns the squared norm |p|²."""
        return self.dot(self)

    def product(self, q: "EulerParameters") -> "EulerParameters":
        """Returns the quaternion product p q: the rotation q, followed by this rotation p."""
        a, b = self, q
        return EulerParameters(
            a.e0 * b.e0 - a.e1 * b.e1 - a.e2 * b.e2 - a.e3 * b.e3,
            a.e0 * b.e1 + a.e1 * b.e0 + a.e2 * b.e3 - a.e3 * b.e2,
            a.e0 * b.e2 - a.e1 * b.e3 + a.e2 * b.e0 + a.e3 * b.e1,
            a.e0 * b.e3 + a.e1 * b.e2 - a.e2 * b.e1 + a.e3 * b.e0,
        )

    def rotation(self) -> "Mat3":
        """Returns the rotation matrix A = (2 e0² − 1) I + 2 (e eᵀ + e0 ẽ) of these Euler parameters."""
        if self._trace is not None:
            made: Mat3 = Mat3._of(self._trace, self._trace.op("{}.rotation()", "Mat3", self._in(self._trace)))
            return made
        a, b, c, d = (float(one) for one in self)
        return Mat3(
            2 * (a * a + b * b) - 1, 2 * (b * c - a * d), 2 * (b * d + a * c),
            2 * (b * c + a * d), 2 * (a * a + c * c) - 1, 2 * (c * d - a * b),
            2 * (b * d - a * c), 2 * (c * d + a * b), 2 * (a * a + d * d) - 1,
        )  # fmt: skip


class _Matrix(_Components):
    """A square matrix, row by row."""

    __slots__ = ()
    _N = 0

    def __matmul__(self, other: Any) -> Any:
        n, vector = self._N, Vec2 if self._N == 2 else Vec3
        if isinstance(other, np.ndarray) and other.shape == (n, n):
            other = type(self)(*other.ravel().tolist())
        if isinstance(other, type(self)):
            trace = self._trace or other._trace
            if trace is not None:
                node = trace.op("{} * {}", self._TYPE, self._in(trace), other._in(trace))
                return type(self)._of(trace, node)
            rows, columns = self.rows(), other.transpose().rows()
            return type(self)(*(row.dot(column) for row in rows for column in columns))
        if isinstance(other, (tuple, list, np.ndarray)) and len(other) == n:
            other = vector(*other)
        if not isinstance(other, vector):
            return NotImplemented
        trace = self._trace or other._trace
        if trace is None:
            return vector(*(row.dot(other) for row in self.rows()))
        return vector._of(trace, trace.op("{} * {}", vector._TYPE, self._in(trace), other._in(trace)))

    def __rmatmul__(self, other: Any) -> Any:
        if isinstance(other, np.ndarray) and other.shape == (self._N, self._N):
            return type(self)(*other.ravel().tolist()) @ self
        if isinstance(other, (tuple, list, np.ndarray)) and len(other) == self._N:
            return self.transpose() @ other
        return NotImplemented

    def rows(self) -> list[Any]:
        """The rows as vectors."""
        vector, n = Vec2 if self._N == 2 else Vec3, self._N
        parts = self._components()
        return [vector(*parts[n * k : n * k + n]) for k in range(n)]

    def row(self, k: int) -> Any:
        """Returns row k as a vector."""
        return self.rows()[k]

    def column(self, k: int) -> Any:
        """Returns column k as a vector."""
        return self.transpose().rows()[k]

    def transpose(self) -> Any:
        """Returns the transpose Aᵀ."""
        n, parts = self._N, self._components()
        return type(self)(*(parts[n * (k % n) + k // n] for k in range(n * n)))

    T = property(transpose)

    def trace(self) -> Scalar:
        """Returns the sum of the diagonal."""
        parts = self._components()
        return sum((parts[k * (self._N + 1)] for k in range(self._N)), 0)

    def determinant(self) -> Scalar:
        """Returns the determinant."""
        rows = self.rows()
        found: Scalar = rows[0].cross(rows[1]) if self._N == 2 else rows[0].dot(rows[1].cross(rows[2]))
        return found


class Mat2(_Matrix):
    """A 2 × 2 matrix, row by row: m11, m12, m21, m22."""

    __slots__ = ()
    _NAMES = ("m11", "m12", "m21", "m22")
    _TYPE = "Mat2"
    _N = 2


class Mat3(_Matrix):
    """A 3 × 3 matrix, row by row: m11, m12, m13, m21, …"""

    __slots__ = ()
    _NAMES = ("m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33")
    _TYPE = "Mat3"
    _N = 3


class Axis:
    """A direction of a spatial body with two perpendicular directions: unit vectors h, f and g = h × f. [–]

    Angles about h are zero at f. `Axis(h, f)` uses the direction h, or the direction of another axis, and the part of f
    perpendicular to h. Without f, an axis keeps its f, and Kin chooses f for a direction.
    """

    __slots__ = ("h", "f", "g")
    h: Vec3
    f: Vec3
    g: Vec3

    def __init__(self, h: Any, f: Any = None) -> None:
        if isinstance(h, Axis):
            if f is None:
                self.h, self.f, self.g = h.h, h.f, h.g
                return
            h = h.h
        made = _native.axis(_three(h), None if f is None else _three(f))
        self.h, self.f, self.g = (Vec3(*one) for one in made)

    @staticmethod
    def along(h: Any) -> "Axis":
        """Returns the axis along `h`, with an f that Kin chooses."""
        return Axis(h)

    @classmethod
    def _traced(cls, h: Vec3, f: Vec3, g: Vec3) -> "Axis":
        made = cls.__new__(cls)
        made.h, made.f, made.g = h, f, g
        return made

    def _rows(self) -> list[list[float]]:
        return [[float(x) for x in v] for v in (self.h, self.f, self.g)]

    def __repr__(self) -> str:
        return f"Axis({self.h!r}, {self.f!r})"

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Axis) and (self.h, self.f, self.g) == (other.h, other.f, other.g)

    def __reduce__(self) -> Any:
        return (Axis._traced, (self.h, self.f, self.g))


def _three(h: Any) -> Sequence[float]:
    numbers = [real(one) for one in h]
    if len(numbers) != 3:
        raise TypeError(f"a direction in space has three components, not {len(numbers)}")
    return numbers


VectorLike = Union[Sequence[NumberLike], Vec2, Vec3, "np.ndarray[Any, Any]"]


def vec2(x: Union[Scalar, NumberLike], y: Union[Scalar, NumberLike]) -> Vec2:
    """Returns the vector (x, y)."""
    return Vec2(x, y)


def vec3(
    x: Union[Scalar, NumberLike], y: Union[Scalar, NumberLike], z: Union[Scalar, NumberLike]
) -> Vec3:
    """Returns the vector (x, y, z)."""
    return Vec3(x, y, z)


__all__ = ["Axis", "EulerParameters", "Mat2", "Mat3", "Vec2", "Vec3", "functions", "vec2", "vec3", "Traced"]
