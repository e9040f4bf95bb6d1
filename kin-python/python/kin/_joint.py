"""Describes joints of the library on bodies in the form of a mechanism file, from which Kin's registry creates
constraints.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from . import _values
from ._dimension import NumberLike, written
from ._errors import ForeignBody
from ._handles import Coordinate, Ground, Handle, place_of
from ._law import Law
from ._vectors import Axis, EulerParameters, Vec2, Vec3

Vec2Like = Union[Vec2, Sequence[NumberLike], "np.ndarray[Any, Any]"]
Vec3Like = Union[Vec3, Sequence[NumberLike], "np.ndarray[Any, Any]"]
EulerLike = Union[EulerParameters, Sequence[float], "np.ndarray[Any, Any]"]
AxisLike = Union[Axis, Vec3, Sequence[float], "np.ndarray[Any, Any]"]
LawLike = Union[Law, NumberLike, Callable[[Any], Any]]

# Places of `linear_coupling`, which takes two to six coordinates.
_TERMS = 6


@dataclass(frozen=True)
class Joint:
    """A joint, coupling or driver of the library, for `m.add(name, …)`."""

    kind: str
    bodies: tuple[tuple[str, str, Union[Handle, Coordinate]], ...]
    parameters: tuple[tuple[str, str, Any], ...]

    def zero(self, f_i: Vec3Like, f_j: Vec3Like) -> "Joint":
        """Returns the joint with another zero of its measured angle: the angle is zero where the direction f_i of body
        i is along f_j of body j.

        Kin uses only the parts of f_i and f_j perpendicular to the axis. The last call sets the zero. The method works
        for spatial `revolute`, `cylindrical` and `planar`. For `screw`, `relative_angle` and `drive_turn` give both
        axes a reference direction, `kin.Axis(h, f)`: the angle is zero where the f of h_i is along the f of h_j.
        """
        values = {name: value for name, _, value in self.parameters}
        kinds = [kind for _, kind, _ in self.bodies]
        if kinds != ["Spatial", "Spatial"] or self.kind not in ("revolute", "cylindrical", "planar"):
            raise TypeError(f"`{self.kind}` has no angle whose zero can be chosen")
        own, other, asked = Axis(values["h_i"], f_i), Axis(values["h_j"]), Axis(values["h_j"], f_j)
        f = own.f * asked.f.dot(other.f) - own.g * asked.f.dot(other.g)
        turned = Axis(own.h, f)
        parameters = ((name, kind, turned if name == "h_i" else value) for name, kind, value in self.parameters)
        return Joint(self.kind, self.bodies, tuple(parameters))

    def __repr__(self) -> str:
        return f"{self.kind}(…)"

    def described(self, name: str, mechanism: str, own: str) -> str:
        """Returns the description of the joint under a name, as JSON."""
        return json.dumps({"name": name, **self.data(name, mechanism, own)})

    def data(self, name: str, mechanism: str, own: str) -> dict[str, Any]:
        """Returns the kind, bodies and parameters of the joint, as in a mechanism file."""
        arguments = []
        for argument, kind, body in self.bodies:
            short, body_name, of = place_of(name, argument, kind, body)
            if of and of != own:
                raise foreign(name, argument, mechanism)
            if short == "ground_coord":
                arguments.append({"ground_coord": int(body_name or 0)})
            else:
                arguments.append({short: body_name})  # type: ignore[dict-item]
        parameters = {key: _json(name, mechanism, own, key, kind, value) for key, kind, value in self.parameters}
        return {"kind": self.kind, "arguments": arguments, "parameters": parameters}


def foreign(place: str, argument: str, mechanism: str) -> ForeignBody:
    """Returns the error for a body of another mechanism."""
    text = f'`{place}` cannot use `{argument}`, which belongs to another mechanism than "{mechanism}". Use what "{mechanism}" returned'
    return ForeignBody(text)


def joint(kind: str, given: Sequence[tuple[str, str, Any]]) -> Joint:
    """Creates the joint with these arguments: each has a name, a type in Rust and a value."""
    bodies: list[tuple[str, str, Any]] = []
    parameters: list[tuple[str, str, Any]] = []
    for name, of, value in given:
        if of == "[Coord; N]":
            bodies.extend((name, "Coord", one) for one in _terms(kind, value, Ground().x))
        elif of == "[f64; N]":
            parameters.append((name, of, _terms(kind, value, 0.0)))
        elif of in ("Planar", "Spatial", "Coord"):
            place_of(kind, name, of, value)
            bodies.append((name, of, value))
        else:
            parameters.append((name, of, value))
            if of != "Law":
                _checked(kind, name, of, value)
    return Joint(kind, tuple(bodies), tuple(parameters))


def _terms(kind: str, value: Any, filler: Any) -> list[Any]:
    terms = list(value)
    if not 2 <= len(terms) <= _TERMS:
        raise TypeError(f"`{kind}` takes two to six coordinates, and a factor for each, not {len(terms)}")
    return terms + [filler] * (_TERMS - len(terms))


def _checked(kind: str, name: str, of: str, value: Any) -> None:
    """Tells a parameter of another type where the joint is made."""
    if of == "Axis":
        _values.axis_of(kind, name, value)
        return
    wanted = _values.NUMBERS.get(of)
    try:
        found: Optional[int] = len(_values.items(value))
    except (TypeError, ValueError):
        found = None
    if found is None or (wanted is not None and found != wanted):
        shown = "a number" if of == "f64" else f"{of}, {wanted} numbers"
        raise TypeError(f"`{kind}`: its parameter `{name}` is {shown}, not {value!r}")


def _json(place: str, mechanism: str, own: str, name: str, kind: str, value: Any) -> Any:
    """A parameter as JSON."""
    if kind == "Law":
        return _values.law_of(place, name, value)._written(place, mechanism, own)
    if kind == "Axis":
        rows = _values.axis_of(place, name, value)._rows()
        return [[_values.finite(place, f"{name}.{key}", x) for x, key in zip(row, "xyz")] for row in rows]
    numbers = _values.items(value)
    if kind == "f64":
        return written(place, mechanism, own, _values.finite(place, name, numbers[0]))
    names = _values.NAMES.get(kind)
    parts = [f"{name}.{one}" for one in names] if names else [f"{name}[{k}]" for k in range(len(numbers))]
    return [written(place, mechanism, own, _values.finite(place, part, x)) for part, x in zip(parts, numbers)]
