"""A mechanism as it is described."""

from __future__ import annotations

import json
import os
import uuid
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _mistakes, _native
from ._constraint import Constraint, parameters_of
from ._diagnosis import Diagnosis
from ._dimension import Dimension, NumberLike, quoted, written
from ._handles import (
    Coordinate,
    Ground,
    Handle,
    Link,
    PlanarBody,
    SpatialBody,
    SpatialLink,
    ground,
    place_of,
)
from ._joint import AxisLike, EulerLike, Joint, Vec2Like, Vec3Like, foreign
from ._load import Load
from ._motion import Motion
from ._friction import Friction
from ._solid import Solid, in_space, inertia_of
from ._system import System
from ._values import axis_of, flat, items, law_of
from ._vectors import Vec2, Vec3

Body = Union[PlanarBody, SpatialBody]


class Mechanism:
    """Bodies, bare coordinates and constraints under one name, in any consistent set of units.   [m, rad, s]

    A copy, and what pickle brings back, is a mechanism file (`to_json`); bodies that one has given out are those of
    the other too.
    """

    def __init__(self, name: str) -> None:
        self._native = _native.Mechanism(name)
        self._token = uuid.uuid4().hex

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name()

    @property
    def ground(self) -> Ground:
        """What does not move."""
        return ground

    def units(self, length: str, time: str, mass: Optional[str] = None) -> None:
        """Names the units of length, time and mass in files and messages: words alone, no number is changed. Those of force,
        torque, energy and power follow."""
        self._native.units(length, time, mass)

    # Named dimensions.

    def dimension(
        self,
        name: str,
        value: NumberLike,
        unit: str = "",
        *,
        within: Optional[tuple[float, float]] = None,
        tolerance: Optional[float] = None,
        distribution: Optional[str] = None,
    ) -> Dimension:
        """A named number that others hang on; given an expression of others, it is a name for that.

        `unit` is a word for tables and files, nothing is converted. `system.set` keeps to the range `within`, both ends
        included; `tolerance` is how far the shop may be off, either way, `distribution` how often by how much: "normal" (σ a
        third of the tolerance, which it is where nothing is said), "truncated normal" or "uniform".

        Raises an error by name: name empty or taken, a value that is not finite, a dimension of another mechanism; when the
        mechanism is built, a range without the value, a tolerance below zero, a dimension on which nothing hangs.
        """
        given, ends = self._number(name, value), None if within is None else (float(within[0]), float(within[1]))
        made = self._native.dimension(name, given, unit, ends, tolerance, distribution)
        return Dimension(quoted(name), made, self._token)

    def clearance(self, name: str, radius: float) -> Vec2:
        """The clearance of a joint, whose hole is wider than its pin by `radius` on every side: a vector of two dimensions, `NAME.x`
        and `NAME.y`, both zero, off uniformly in the disc of that radius. It is added to a point of the joint,
        `kin.revolute(crank, rod, crank.end + gap, rod.start)`.   [m]

        Raises an error by name: those of `dimension`; a radius below zero is told when the mechanism is built.
        """
        self._native.clearance(name, radius)
        return Vec2(*(self._expression(quoted(f"{name}.{axis}")) for axis in "xy"))

    @property
    def dimensions(self) -> dict[str, Dimension]:
        """The dimensions by their names, in the order in which they were made."""
        names = [one["name"] for one in json.loads(self._native.to_json()).get("dimensions", [])]
        return {name: self._expression(quoted(name)) for name in names}

    def _expression(self, text: str) -> Dimension:
        return Dimension(text, self._native.expression(text), self._token)

    def _number(self, place: str, number: Any) -> Any:
        return written(place, self.name, self._token, number)

    # Bodies and bare coordinates.

    def link(self, name: str, length: NumberLike) -> Link:
        """A planar body between two pins, `length` apart, frame at the middle; assembly finds its pose. Of a dimension the
        pins `start` and `end` hang on it.   [m]"""
        made = self._native.link(name, self._number(name, length))
        return Link(name, self._token, length if isinstance(length, Dimension) else made)

    def link_between(self, name: str, a: Vec2Like, b: Vec2Like) -> Link:
        """The same between two global points: their distance is its length.   [m]"""
        return Link(name, self._token, self._native.link_between(name, flat(a), flat(b)))

    def planar(
        self, name: str, x: NumberLike = 0.0, y: NumberLike = 0.0, theta: NumberLike = 0.0
    ) -> PlanarBody:
        """A planar body with the guess (R_x, R_y, θ).   [m, m, rad]"""
        self._native.planar(name, tuple(self._number(name, one) for one in (x, y, theta)))
        return PlanarBody(name, self._token)

    def spatial(
        self,
        name: str,
        r: Vec3Like = (0.0, 0.0, 0.0),
        p: EulerLike = (1.0, 0.0, 0.0, 0.0),
        *,
        axis: Optional[Vec3Like] = None,
        angle: float = 0.0,
        facing: Optional[AxisLike] = None,
    ) -> SpatialBody:
        """A spatial body with the guess R and Euler parameters p; or turned by `angle` about `axis`; or with its x-axis
        along `facing`, an axis or a direction.   [m, –]"""
        self._native.spatial(name, spatial_pose(r, p, axis, angle, facing))
        return SpatialBody(name, self._token)

    def spatial_link_between(self, name: str, a: Vec3Like, b: Vec3Like) -> SpatialLink:
        """A spatial body between two global points, frame at the middle, x-axis from a to b.   [m]"""
        return SpatialLink(name, self._token, self._native.spatial_link_between(name, flat(a), flat(b)))

    def angle(self, name: str, guess: NumberLike) -> Coordinate:
        """A bare coordinate that is an angle.   [rad]"""
        self._native.angle(name, self._number(name, guess))
        return Coordinate(name, self._token)

    def length(self, name: str, guess: NumberLike) -> Coordinate:
        """A bare coordinate that is a length.   [m]"""
        self._native.length(name, self._number(name, guess))
        return Coordinate(name, self._token)

    def __getitem__(self, name: str) -> Any:
        """The body or bare coordinate of that name, or a body's coordinate such as "crank.theta"."""
        for body in json.loads(self._native.to_json())["bodies"]:
            kind, own, length = body["kind"], body["name"], body.get("length")
            if isinstance(length, str):
                length = self._expression(length)
            if own == name and kind == "planar":
                return PlanarBody(name, self._token) if length is None else Link(name, self._token, length)
            if own == name and kind == "spatial":
                return SpatialBody(name, self._token) if length is None else SpatialLink(name, self._token, length)
            if own == name or (name.startswith(own + ".") and kind in ("planar", "spatial")):
                return Coordinate(name, self._token)
        raise KeyError(f'there is no body or coordinate `{name}` in the mechanism "{self.name}"')

    # Constraints.

    def add(self, name: str, constraint: Union[Joint, Constraint]) -> None:
        """Adds a joint of the library, or a constraint of an equation of your own, under a name.

        Raises an error by name: name empty or taken, parameters that are not finite or make no sense, a body of
        another mechanism or twice the same one.
        """
        if isinstance(constraint, Joint):
            self._native.add(constraint.described(name, self.name, self._token))
        elif isinstance(constraint, Constraint):
            self._native.add_equation(name, *self._making(name, constraint))
        else:
            raise TypeError(
                f"`{name}`: {constraint!r} is no constraint: call a joint such as kin.revolute(…), or a function under "
                "@kin.constraint, with bodies and parameters"
            )

    def _making(self, name: str, constraint: Constraint) -> Any:
        """The equation, its bodies and coordinates, its parameters."""
        parameters = parameters_of(constraint, self.name, self._token)
        return constraint.equation._native, self._on(name, constraint), parameters

    def _on(self, name: str, constraint: Constraint) -> list[tuple[str, Optional[str]]]:
        wanted = [
            (one.name, one.kind) for one in constraint.equation.arguments if one.is_body for _ in range(one.count or 1)
        ]
        if len(wanted) != len(constraint.bodies):
            text = f"`{name}`: it takes {len(wanted)} bodies and coordinates, not {len(constraint.bodies)}"
            raise TypeError(text)
        places = []
        for (argument, kind), body in zip(wanted, constraint.bodies):
            short, body_name, of = place_of(name, argument, kind, body)
            if of and of != self._token:
                raise foreign(name, argument, self.name)
            places.append((short, body_name))
        return places

    def terms(self, constraint: Constraint, q: Any, qd: Any, t: float = 0.0) -> "Terms":
        """Every term of a constraint of an equation, where its own coordinates, one body after the other, are q, their
        rates qd, and the time t."""
        equation, on, parameters = self._making(constraint.equation.name, constraint)
        return Terms(*self._native.terms(equation, on, parameters, _bytes(q), _bytes(qd), t))

    # Guesses and preferences.

    def guess(self, coordinate: Coordinate, value: float) -> None:
        """Another guess for one coordinate.   [m or rad]"""
        self._native.set_guess(self._own("guess", coordinate), value)

    def set_initial(self, q: Any) -> None:
        """Another guess for all coordinates, in the order of their declaration."""
        self._native.set_initial(flat(q))

    def set_pose(self, body: PlanarBody, x: float, y: float, theta: float) -> None:
        """Another guess for the pose of a planar body.   [m, m, rad]"""
        self._native.set_pose(self._own("set_pose", body), (x, y, theta))

    def set_spatial_pose(
        self,
        body: SpatialBody,
        r: Vec3Like = (0.0, 0.0, 0.0),
        p: EulerLike = (1.0, 0.0, 0.0, 0.0),
        *,
        axis: Optional[Vec3Like] = None,
        angle: float = 0.0,
        facing: Optional[AxisLike] = None,
    ) -> None:
        """Another guess for the pose of a spatial body, told as to `spatial`.   [m, –]"""
        self._native.set_spatial_pose(self._own("set_spatial_pose", body), spatial_pose(r, p, axis, angle, facing))

    def prefer(self, what: Union[Body, Coordinate, str], value: Any) -> None:
        """Which of several assemblies: the one with this nearest the value: a coordinate, a planar body by its θ, a
        spatial body by its Euler parameters, a measure of a joint by its name. The value may be a dimension.   [m or rad]"""
        if isinstance(what, str):
            self._native.prefer(what, self._number("prefer", value))
        elif isinstance(what, SpatialBody):
            turn = [self._number("prefer", one) for one in items(value)]
            self._native.prefer_turn(self._own("prefer", what), turn)
        elif isinstance(what, PlanarBody):
            self._native.prefer(self._own("prefer", what.theta), self._number("prefer", value))
        else:
            self._native.prefer(self._own("prefer", what), self._number("prefer", value))

    def limit(self, measure: str, start: float, end: float) -> None:
        """The range that a measure of a joint or a coordinate should keep to: a run tells when it leaves it."""
        self._native.limit(measure, start, end)

    def local(self, body: Handle, point: Any) -> Any:
        """ū, where a global point is in a body as it is drawn.   [m]"""
        return self._local(body, point, True)

    def local_direction(self, body: Handle, h: Any) -> Any:
        """h̄, a global direction as a body sees it where it is drawn."""
        return self._local(body, h, False)

    def _local(self, body: Handle, vector: Any, point: bool) -> Any:
        kind = "spatial" if isinstance(body, SpatialBody) else "planar"
        name = None if isinstance(body, Ground) else self._own("local", body)
        found = self._native.local((kind, name), flat(vector), point)
        return Vec2(*found) if len(found) == 2 else Vec3(*found)

    def hold_idle_turns(self) -> list[str]:
        """Holds turns of rods about their own axes, which nothing else holds; gives the names of what was added."""
        return self._native.hold_idle_turns()

    def _own(self, place: str, handle: Union[Body, Coordinate]) -> str:
        if not isinstance(handle, (PlanarBody, SpatialBody, Coordinate)):
            raise TypeError(f"`{place}` takes a body or coordinate, not {handle!r}")
        if handle._of != self._token:
            raise foreign(place, "body", self.name)
        return handle.name

    # Masses, weight and loads.

    def mass(self, body: Body, mass: NumberLike, centre: Any, inertia: Any) -> None:
        """The mass of a body, its centre of mass in the body's frame and its inertia about that centre: in the plane one moment,
        in space a tensor in the body's axes, or its diagonal. Each of the numbers may be a dimension. Given again it takes
        the place of what was given.   [kg, m, kg m²]

        Raises an error by name: the ground, a body of another mechanism, a mass not above zero, an inertia that no body has.
        """
        place, in_plane = self._massive("mass", body)
        numbers = [mass, *in_space(centre), *inertia_of(inertia, in_plane)]
        self._native.mass(place, [self._number("mass", one) for one in numbers])

    def solid(self, body: Body, solid: Solid) -> None:
        """The same by a shape and a density: `m.solid(crank, kin.Solid.bar(0.1, 0.02, 0.01, kin.Solid.STEEL))`."""
        self._native.solid(self._massive("solid", body)[0], solid._tuple())

    def point_mass(self, name: str, point: Constraint, mass: NumberLike) -> None:
        """A mass at a point that moves with coordinates, for mechanisms that have no bodies: the point is a function of your own
        of two or three rows, its global coordinates, `m.point_mass("bob", tip(theta, 0.4), 2.0)`.   [m, kg]

        Raises an error by name: more or fewer rows, a mass not above zero, a name that is taken.
        """
        if not isinstance(point, Constraint):
            text = f"`{name}`: {point!r} is no point: call a function under @kin.constraint of two or three rows"
            raise TypeError(text)
        equation, on, parameters = self._making(name, point)
        self._native.point_mass(name, equation, on, parameters, self._number(name, mass))

    def friction(self, joint: str, friction: Friction) -> None:
        """Dry friction in a joint that is there: `m.friction("shaft", kin.Friction.pin(0.1, 0.02, 1e-3))`. Reactions, efforts
        of drives and the balance of powers then have it; given again it takes the place of what was given.

        Raises an error by name: a name that no constraint has, a joint that is no pin or no slide, numbers that make no
        sense. `system.forces` raises `kin.Jammed` where it holds the mechanism fast.
        """
        if not isinstance(friction, Friction):
            raise TypeError(f"`{joint}`: {friction!r} is no friction: call kin.Friction.pin(…) or kin.Friction.slide(…)")
        self._native.friction(joint, *friction._told(lambda number: self._number(joint, number)))

    def load(self, name: str, load: Load) -> None:
        """Lets something act on the mechanism, under a name: `kin.loads.spring(…)` and the others of that library,
        `kin.Load.force(body, u, force)`, a function under `@kin.potential` or `@kin.force`; `a + b` is both. Numbers of it may be
        dimensions.

        Raises an error by name: the ground, a body of another mechanism, a length of several rows, a name that is taken.
        """
        if not isinstance(load, Load):
            raise TypeError(
                f"`{name}`: {load!r} is no load: call kin.loads.spring(…) or another of that library, kin.Load.force(…), or a "
                "function under @kin.potential or @kin.force"
            )
        data, texts = load._data(name, self.name, self._token)
        self._native.load(json.dumps(data), texts)

    def gravity(self, g: Any) -> None:
        """The acceleration of gravity, such as (0, -9.81); zero without it. Its components may be dimensions.   [m/s²]"""
        self._native.gravity([self._number("gravity", one) for one in in_space(g)])

    def _massive(self, place: str, body: Any) -> tuple[tuple[str, Optional[str]], bool]:
        if isinstance(body, Ground):
            return ("planar", None), True
        if not isinstance(body, (PlanarBody, SpatialBody)):
            raise TypeError(f"`{place}` takes a body, not {body!r}")
        in_plane = isinstance(body, PlanarBody)
        return ("planar" if in_plane else "spatial", self._own(place, body)), in_plane

    # What it becomes.

    def __getattr__(self, name: str) -> Any:
        later = {System: "the system that `m.build()` returns", Motion: "the motion that `m.build().run(times)` returns"}
        _mistakes.not_yet("mechanism", name, later)

    def build(self) -> System:
        """The system: order of coordinates and equations fixed, ready to be solved. Raises `kin.Error` by name."""
        return System(self._native.build(), self._native.to_json(), self._token)

    def diagnose(self, t: float, q: Any = None) -> Diagnosis:
        """What is wrong with it, or that nothing is: rank, dependencies and freedoms by name; it need not be buildable."""
        return Diagnosis(*self._native.diagnose(t, None if q is None else flat(q)))

    # Files.

    def to_json(self) -> str:
        """The mechanism as the text of a file."""
        return self._native.to_json()

    @staticmethod
    def from_json(text: str) -> "Mechanism":
        """The mechanism that such a text says. Raises `kin.Error` by name."""
        return Mechanism._of(text, uuid.uuid4().hex)

    def write_json(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mechanism as a file, making folders that are missing."""
        self._native.write_json(os.fspath(path))

    @staticmethod
    def read_json(path: Union[str, "os.PathLike[str]"]) -> "Mechanism":
        """The mechanism of such a file."""
        with open(os.fspath(path), encoding="utf-8") as file:
            return Mechanism.from_json(file.read())

    @staticmethod
    def _of(text: str, token: str) -> "Mechanism":
        made = Mechanism.__new__(Mechanism)
        made._native, made._token = _native.Mechanism.from_json(text), token
        return made

    def __reduce__(self) -> Any:
        return (Mechanism._of, (self.to_json(), self._token))

    def __copy__(self) -> "Mechanism":
        return Mechanism._of(self.to_json(), self._token)

    def __deepcopy__(self, _: Any) -> "Mechanism":
        return self.__copy__()

    def __repr__(self) -> str:
        return f"<mechanism {self.name}>"


class Terms:
    """Every term of one constraint at one state: `c`, `c_q`, `c_t`, `q_d`, as arrays."""

    def __init__(self, c: Sequence[float], c_q: Sequence[Sequence[float]], c_t: Sequence[float], q_d: Any) -> None:
        self.c, self.c_q, self.c_t, self.q_d = (np.array(one, dtype=float) for one in (c, c_q, c_t, q_d))


def spatial_pose(
    r: Vec3Like, p: EulerLike, axis: Optional[Vec3Like], angle: float, facing: Optional[AxisLike]
) -> list[float]:
    """Position and Euler parameters of a pose, by whichever way it is told."""
    if axis is not None:
        turn = _native.euler_turned(flat(axis), angle)
    elif facing is not None:
        turn = _native.euler_facing(axis_of("pose", "facing", facing)._rows())
    else:
        turn = flat(p)
    pose = flat(r) + list(turn)
    if len(pose) != 7:
        raise TypeError("a pose in space is a position of three numbers and four Euler parameters")
    return pose


def _bytes(numbers: Any) -> bytes:
    return np.ascontiguousarray(numbers, dtype=np.float64).ravel().tobytes()


__all__ = ["Body", "Mechanism", "Terms", "law_of"]
