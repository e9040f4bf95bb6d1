"""Defines placeholders for the arguments of a traced function, and the same states with plain numbers."""

from __future__ import annotations

import math
from typing import Any

from . import _mistakes
from ._place import users_line
from ._scalars import Expr, Scalar
from ._ufunc import Operand
from ._vectors import EulerParameters, Mat2, Mat3, Vec2, Vec3


class _Body:
    """The state of a body: traced, a name in a trace; or plain numbers."""

    __slots__ = ("_trace", "_name", "_q")
    _VECTOR: Any = None
    _NAMES: tuple[str, ...] = ()

    def __init__(self, *q: float) -> None:
        if len(q) != len(self._NAMES):
            raise TypeError(f"the state of a {type(self).__name__} body is {', '.join(self._NAMES)}")
        self._q: tuple[float, ...] = tuple(float(one) for one in q)
        self._trace: Any = None
        self._name = ""

    @classmethod
    def _traced(cls, trace: Any, name: str) -> Any:
        made = cls.__new__(cls)
        made._q, made._trace, made._name = (), trace, name
        return made

    def _scalar(self, field: str) -> Expr:
        return Expr(self._trace, self._trace.atom(f"{self._name}.{field}", "f64"))

    def _vector(self, method: str, vector: Any) -> Any:
        cls = self._VECTOR
        given = vector if isinstance(vector, cls) else None
        if given is None:
            try:
                given = cls(*vector)
            except TypeError:
                text = f"`{self._name or 'body'}.{method}` takes a {cls.__name__}, not {vector!r}"
                _mistakes.at(users_line(), text)
        if self._trace is None:
            return given
        node = self._trace.op(f"{self._name}.{method}({{:a}})", cls._TYPE, given._in(self._trace))
        return cls._of(self._trace, node)

    def __repr__(self) -> str:
        return self._name or f"{type(self).__name__}{self._q}"


class Planar(_Body):
    """The state of a planar body in a function under `@kin.constraint`: `r`, `theta`, `point(u)`, ….

    In a call of the decorated function, the argument is a body, a link or the ground.

    `Planar(x, y, theta)` is a state of plain numbers, to evaluate the function itself. [m, m, rad]
    """

    __slots__ = ()
    _VECTOR = Vec2
    _NAMES = ("x", "y", "theta")

    @property
    def r(self) -> Vec2:
        """The position R of the origin of the body frame. [m]"""
        if self._trace is None:
            return Vec2(*self._q[:2])
        made: Vec2 = Vec2._of(self._trace, self._trace.atom(f"{self._name}.r", "Vec2"))
        return made

    @property
    def theta(self) -> Scalar:
        """The angle θ, counter-clockwise; the angle counts full revolutions. [rad]"""
        return self._q[2] if self._trace is None else self._scalar("theta")

    @property
    def sin(self) -> Scalar:
        """The sine of θ."""
        return math.sin(self._q[2]) if self._trace is None else self._scalar("sin")

    @property
    def cos(self) -> Scalar:
        """The cosine of θ."""
        return math.cos(self._q[2]) if self._trace is None else self._scalar("cos")

    def a(self) -> Mat2:
        """The rotation matrix A from the body frame to the global frame."""
        if self._trace is None:
            return Mat2(self.cos, -self.sin, self.sin, self.cos)
        made: Mat2 = Mat2._of(self._trace, self._trace.atom(f"{self._name}.a()", "Mat2"))
        return made

    def direction(self, h: Any) -> Vec2:
        """Returns A h̄, the global components of a direction of the body."""
        given = self._vector("direction", h)
        made: Vec2 = self.a() @ given if self._trace is None else given
        return made

    def point(self, u: Any) -> Vec2:
        """Returns R + A ū, the global position of a point of the body. [m]"""
        given = self._vector("point", u)
        made: Vec2 = self.r + self.a() @ given if self._trace is None else given
        return made

    def local(self, p: Any) -> Vec2:
        """Returns Aᵀ (p − R), the local position of a global point. [m]"""
        given = self._vector("local", p)
        made: Vec2 = self.a().transpose() @ (given - self.r) if self._trace is None else given
        return made


class Spatial(_Body):
    """The state of a spatial body in a function under `@kin.constraint`: `r`, `p`, `a()`, `point(u)`, ….

    In a call of the decorated function, the argument is a body or the ground.

    `Spatial(x, y, z, e0, e1, e2, e3)` is a state of plain numbers, to evaluate the function itself. [m, –]
    """

    __slots__ = ()
    _VECTOR = Vec3
    _NAMES = ("x", "y", "z", "e0", "e1", "e2", "e3")

    @property
    def r(self) -> Vec3:
        """The position R of the origin of the body frame. [m]"""
        if self._trace is None:
            return Vec3(*self._q[:3])
        made: Vec3 = Vec3._of(self._trace, self._trace.atom(f"{self._name}.r", "Vec3"))
        return made

    @property
    def p(self) -> EulerParameters:
        """The Euler parameters, scalar first. [–]"""
        if self._trace is None:
            return EulerParameters(*self._q[3:])
        node = self._trace.atom(f"{self._name}.p", "EulerParameters")
        made: EulerParameters = EulerParameters._of(self._trace, node)
        return made

    def a(self) -> Mat3:
        """Returns the rotation matrix A from the body frame to the global frame."""
        if self._trace is None:
            return self.p.rotation()
        made: Mat3 = Mat3._of(self._trace, self._trace.atom(f"{self._name}.a()", "Mat3"))
        return made

    def direction(self, h: Any) -> Vec3:
        """Returns A h̄, the global components of a direction of the body."""
        given = self._vector("direction", h)
        made: Vec3 = self.a() @ given if self._trace is None else given
        return made

    def point(self, u: Any) -> Vec3:
        """Returns R + A ū, the global position of a point of the body. [m]"""
        given = self._vector("point", u)
        made: Vec3 = self.r + self.a() @ given if self._trace is None else given
        return made

    def local(self, p: Any) -> Vec3:
        """Returns Aᵀ (p − R), the local position of a global point. [m]"""
        given = self._vector("local", p)
        made: Vec3 = self.a().transpose() @ (given - self.r) if self._trace is None else given
        return made


class TracedLaw(Operand):
    """A law among the arguments of a traced function, which returns values and slopes."""

    def __init__(self, trace: Any, name: str) -> None:
        self._trace = trace
        self._name = name

    def _asked(self, method: str, x: Any) -> Expr:
        node = self._trace.number(x)
        if node is None:
            _mistakes.at(users_line(), f"`{self._name}.{method}` takes a number, not {x!r}")
        return Expr(self._trace, self._trace.op(f"{self._name}.{method}({{:a}})", "f64", node))

    def at(self, x: Any) -> Expr:
        """Returns f(x)."""
        return self._asked("at", x)

    def slope(self, x: Any) -> Expr:
        """Returns f′(x)."""
        return self._asked("slope", x)

    __call__ = at

    def __repr__(self) -> str:
        return self._name

    def _told(self, *_: Any) -> Any:
        text = f"`{self._name}` is a Law: get a value with `{self._name}.at(x)`"
        _mistakes.at(users_line(), text)

    def _cure(self, _: str) -> str:
        return f"ask `{self._name}` for a value with `{self._name}.at(x)`"

    def __getattr__(self, name: str) -> Any:
        from ._law import Law

        if not name.startswith("_") and hasattr(Law, name):
            _mistakes.at(users_line(), f"`{self._name}.{name}` cannot be traced. Use `{self._name}.at(x)` and `.slope(x)`")
        raise AttributeError(f"`{self._name}` has no attribute `{name}`")

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _told
    __neg__ = __pow__ = __rpow__ = __lt__ = __le__ = __gt__ = __ge__ = __float__ = _told


class Coord(Expr):
    """Marks a scalar coordinate or a coordinate of a body: a number in the function, `slider.x` or `m.angle(…)` in its
    call.
    """

    __slots__ = ()


class Time(Expr):
    """Marks the time t: a number in the function. A call of the function does not contain the time. [s]"""

    __slots__ = ()


class Rate(Expr):
    """Marks the velocity ẋ of the length or angle along which a force acts, in a function under `@kin.force`. [m/s,
    rad/s]

    A call of the function does not contain the velocity.
    """

    __slots__ = ()
