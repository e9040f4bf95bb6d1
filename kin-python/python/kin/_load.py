"""Defines loads: forces and torques on bodies, forces along lengths and angles, and energies, for `m.load(name, load)`.
"""

from __future__ import annotations

import hashlib
import inspect
from dataclasses import dataclass
from typing import Any, Callable, Protocol, Union

from . import _mistakes
from ._constraint import Argument, Constraint, Traced, _arguments
from ._dimension import Dimension, written
from ._handles import Coordinate, Ground, Handle, PlanarBody, SpatialBody
from ._joint import Joint, foreign, joint
from ._values import items, law_of

# A scalar: what is zero where a constraint holds is a number everywhere.
Scalar = Union[Joint, Constraint]
# A length or an angle to act along: a scalar, or the name of a measure of a joint or of a coordinate.
Along = Union[Joint, Constraint, str]
# Texts of functions of one's own, by their names.
Texts = dict[str, str]
# What x of a force stands for in its description: the load knows.
FORCED = Coordinate("0", "", "ground_coord")


class _Part(Protocol):
    def data(self, name: str, mechanism: str, own: str, texts: Texts) -> dict[str, Any]: ...


@dataclass(frozen=True)
class Load:
    """A load: one or more forces that act under one name, as in `m.load("closer", load)`.

    `a + b` combines two loads.
    """

    _parts: tuple[_Part, ...]

    @staticmethod
    def force(body: Handle, u: Any, force: Any) -> "Load":
        """Creates a force at a point ū of a body, in global components: numbers, laws of time or functions of time. [m,
        N]
        """
        return Load((_OnBody(body, u, force, None, False),))

    @staticmethod
    def force_in_body(body: Handle, u: Any, force: Any) -> "Load":
        """Creates a force at a point ū of a body, in the axes of the body; its direction rotates with the body. [m, N]
        """
        return Load((_OnBody(body, u, force, None, True),))

    @staticmethod
    def torque(body: Handle, torque: Any) -> "Load":
        """Creates a torque on a body: counter-clockwise positive in the plane, three global components in space. [N m]
        """
        return Load((_OnBody(body, None, None, torque, False),))

    @staticmethod
    def torque_in_body(body: Handle, torque: Any) -> "Load":
        """Creates a torque on a body, in the axes of the body. [N m]"""
        return Load((_OnBody(body, None, None, torque, True),))

    @staticmethod
    def along(x: Along, force: Callable[..., Any]) -> "Load":
        """Creates a force or torque along a length or an angle x. [N, N m]

        x is `kin.loads.length(…)`, any constraint of one row, or the name of a measure of a joint or of a coordinate
        (`"guide.slide"`). `force` is a function of x, of x and its velocity, or of x, its velocity and time; Kin traces
        the function like a constraint. A positive force increases x. An angle of a joint counts full revolutions.
        """
        return _Bare(force)(x)

    def __add__(self, other: "Load") -> "Load":
        if not isinstance(other, Load):
            return NotImplemented
        return Load(self._parts + other._parts)

    def _data(self, name: str, mechanism: str, own: str) -> tuple[dict[str, Any], list[str]]:
        """Its description under a name, and the texts of functions in it."""
        texts: Texts = {}
        parts = [part.data(name, mechanism, own, texts) for part in self._parts]
        return {"name": name, "parts": parts}, list(texts.values())

    def __repr__(self) -> str:
        return f"<load of {len(self._parts)} part{'s' if len(self._parts) > 1 else ''}>"


@dataclass(frozen=True)
class _Energy:
    of: Scalar

    def data(self, name: str, mechanism: str, own: str, texts: Texts) -> dict[str, Any]:
        return {"energy": _scalar(self.of, name, mechanism, own, texts)}


@dataclass(frozen=True)
class _Along:
    x: Along
    force: Scalar

    def data(self, name: str, mechanism: str, own: str, texts: Texts) -> dict[str, Any]:
        force = _scalar(self.force, name, mechanism, own, texts)
        x = {"measure": self.x} if isinstance(self.x, str) else _scalar(self.x, name, mechanism, own, texts)
        del force["arguments"]
        return {"along": {"x": x, "force": force}}


@dataclass(frozen=True)
class _OnBody:
    body: Any
    u: Any
    force: Any
    torque: Any
    in_body: bool

    def data(self, name: str, mechanism: str, own: str, texts: Texts) -> dict[str, Any]:
        if isinstance(self.body, Ground):
            raise ValueError(f"`{name}`: a load on the ground moves nothing")
        if not isinstance(self.body, (PlanarBody, SpatialBody)):
            raise TypeError(f"`{name}`: a force or torque acts on a body, not on {self.body!r}")
        if self.body._of != own:
            raise foreign(name, "body", mechanism)
        size = 2 if isinstance(self.body, PlanarBody) else 3
        data: dict[str, Any] = {"body": self.body.name, "in_body": self.in_body}
        if self.force is not None:
            force, point = _components(name, "force", self.force, size), items(self.u)
            if len(point) != size:
                raise TypeError(f"`{name}`: a point of `{self.body.name}` has {size} numbers, not {self.u!r}")
            data["point"] = [written(name, mechanism, own, one) for one in point] + [0.0] * (3 - size)
            data["force"] = [law_of(name, "force", one)._written(name, mechanism, own) for one in force]
        if self.torque is not None:
            torque = _components(name, "torque", self.torque, 2 * size - 3)
            data["torque"] = [law_of(name, "torque", one)._written(name, mechanism, own) for one in torque]
        return {"on_body": data}


def _components(name: str, what: str, value: Any, size: int) -> list[Any]:
    """Components in space: of a plane force z is zero, of a plane torque x and y are."""
    is_vector = hasattr(value, "__len__") or hasattr(value, "_components")
    several = list(value) if is_vector and not isinstance(value, Dimension) else [value]
    if len(several) != size:
        raise TypeError(f"`{name}`: its {what} has {size} component{'s' if size > 1 else ''}, not {value!r}")
    zeros: list[Any] = [0.0] * (3 - size)
    return zeros + several if what == "torque" else several + zeros


def _scalar(one: Scalar, name: str, mechanism: str, own: str, texts: Texts) -> dict[str, Any]:
    if isinstance(one, Constraint):
        texts[one.equation.name] = one.equation.text
        one = one._joint()
    return one.data(name, mechanism, own)


def _length(place: str, x: Any) -> Along:
    if not isinstance(x, (Joint, Constraint, str)):
        text = (
            f"`{place}` acts along a length or an angle: kin.loads.length(…), any constraint of one row, "
            f"or a measure by its name, not {x!r}"
        )
        raise TypeError(text)
    return x


def of_library(kind: str, given: Any) -> Load:
    """Creates a load from an energy of the library."""
    return Load((_Energy(joint(kind, given)),))


def along_library(kind: str, x: Any, given: Any) -> Load:
    """Creates a load from a force of the library along x."""
    return Load((_Along(_length(kind, x), joint(kind, given)),))


class Potential(Traced):
    """A function under `@kin.potential`. Call it with bodies and parameters to create a load."""

    def __call__(self, *args: Any, **keywords: Any) -> Load:
        return Load((_Energy(self._constraint(*args, **keywords)),))

    def __repr__(self) -> str:
        return f"<potential {self.name}>"


class Force(Traced):
    """A function under `@kin.force`. Call it with a length or an angle and its parameters to create a load."""

    _mark = ("#[force]",)

    def __call__(self, x: Along, *args: Any, **keywords: Any) -> Load:
        made = self._constraint(FORCED, *args, **keywords)
        return Load((_Along(_length(self.name, x), made),))

    def _read_arguments(self) -> list[Argument]:
        names = list(inspect.signature(self.function).parameters)
        if not names:
            _mistakes.at(self._place, f"`{self.name}` is a force along x: its first argument is x: kin.Coord")
        known = {names[0]: "Coord", "rate": "Rate", "t": "Time"}
        hints = getattr(self.function, "__annotations__", {})
        usual = {name: kind for name, kind in known.items() if name not in hints}
        return _arguments(self.function, self._place, usual)

    def __repr__(self) -> str:
        return f"<force {self.name}>"


class _Bare(Force):
    """A function of x, its rate and time in this order, without types; its name is that of its text."""

    def __init__(self, function: Callable[..., Any]) -> None:
        if not callable(function):
            raise TypeError(f"`along` takes a function of x, its rate and time, not {function!r}")
        super().__init__(function, "along_x")
        given = hashlib.sha256(self.text.encode()).hexdigest()[:12]
        super().__init__(function, f"along_x_{given}")

    def _read_arguments(self) -> list[Argument]:
        names = list(inspect.signature(self.function).parameters)
        if not 1 <= len(names) <= 3:
            text = f"a force along x is a function of x, its rate and time, not of {len(names)} arguments"
            _mistakes.at(self._place, text)
        return [Argument(name, kind) for name, kind in zip(names, ("Coord", "Rate", "Time"))]


def potential(function: Callable[..., Any]) -> Potential:
    """Creates a load from an energy V(q, t), a function in the form of `@kin.constraint`.

    The generalised forces of the energy are −V_q.

    Raises `kin.ConstraintError` at the user's line.
    """
    return Potential(function, None)


def force(function: Callable[..., Any]) -> Force:
    """Creates a load from a force f(x, ẋ, t) along any length or angle x. [N, N m]

    The arguments of the function are `x: kin.Coord`, then optionally `rate: kin.Rate` and `t: kin.Time`, then
    parameters. In a call of the decorated function, x is `kin.loads.length(…)`, any constraint of one row, or the name
    of a measure (`"guide.slide"`). A call does not contain the rate and the time. A positive force increases x.

    Raises `kin.ConstraintError` at the user's line.
    """
    return Force(function, None)


__all__ = ["Along", "Force", "Load", "Potential", "force", "potential"]
