"""Describes a mechanism."""

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
from ._mistakes import values
from ._names import Named, unknown
from ._motion import Motion
from ._friction import Friction
from ._released import Released
from ._solid import Solid, in_space, inertia_of
from ._system import System
from ._values import axis_of, flat, items, law_of
from ._vectors import Vec2, Vec3

Body = Union[PlanarBody, SpatialBody]


@values
class Mechanism:
    """The bodies, scalar coordinates and constraints of a machine, in any consistent set of units. [m, rad, s]

    A copy, and a mechanism restored by pickle, come from a mechanism file (`to_json`). The handles of bodies of the
    original are valid in the copy too.
    """

    def __init__(self, name: str) -> None:
        self._native = _native.Mechanism(name)
        self._token = uuid.uuid4().hex

    @property
    def name(self) -> str:
        """The name of the mechanism."""
        return self._native.name()

    @property
    def ground(self) -> Ground:
        """The ground: the global frame, as a planar and a spatial body without coordinates."""
        return ground

    def units(self, length: str, time: str, mass: Optional[str] = None) -> None:
        """Names the units of length, time and mass in files and messages.

        Kin does not convert numbers. Kin derives the units of force, torque, energy and power from these units.
        """
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
        """Declares a named dimension, on which other numbers can depend.

        If the value is an expression of other dimensions, the call gives the expression a name.

        `unit` is a text for tables and files; Kin does not convert numbers. `system.set` accepts values in the range
        `within`, both ends included. `tolerance` is the largest deviation in both directions. `distribution` is the
        distribution within the tolerance: "normal" (the default, with σ = tolerance/3), "truncated normal" or
        "uniform".

        Raises an error if the name is empty or taken, the value is not finite, or a dimension belongs to another
        mechanism. `build` raises an error if the range excludes the value, the tolerance is negative, or no number
        depends on the dimension.
        """
        given, ends = self._number(name, value), None if within is None else (float(within[0]), float(within[1]))
        made = self._native.dimension(name, given, unit, ends, tolerance, distribution)
        return Dimension(quoted(name), made, self._token)

    def clearance(self, name: str, radius: float) -> Vec2:
        """Declares the clearance of a joint, whose hole is wider than its pin by `radius` on every side. [m]

        The result is a vector of two dimensions, `NAME.x` and `NAME.y`, with the value zero and a uniform distribution
        in the disc of this radius. Add the result to a point of the joint: `kin.revolute(crank, rod, crank.end + gap,
        rod.start)`.

        Raises the errors of `dimension`. `build` raises an error if the radius is negative.
        """
        self._native.clearance(name, radius)
        return Vec2(*(self._expression(quoted(f"{name}.{axis}")) for axis in "xy"))

    @property
    def dimensions(self) -> dict[str, Dimension]:
        """The dimensions by name, in the order of their declaration."""
        names = [one["name"] for one in json.loads(self._native.to_json()).get("dimensions", [])]
        return Named("dimension", {name: self._expression(quoted(name)) for name in names})

    def _expression(self, text: str) -> Dimension:
        return Dimension(text, self._native.expression(text), self._token)

    def _number(self, place: str, number: Any) -> Any:
        return written(place, self.name, self._token, number)

    # Bodies and bare coordinates.

    def link(self, name: str, length: NumberLike) -> Link:
        """Adds a planar body between two pins at the distance `length`, with its frame in the middle. [m]

        The assembly finds the pose of the body. If the length is a dimension, the pins `start` and `end` depend on the
        dimension.
        """
        made = self._native.link(name, self._number(name, length))
        return Link(name, self._token, length if isinstance(length, Dimension) else made)

    def link_between(self, name: str, a: Vec2Like, b: Vec2Like) -> Link:
        """Adds a planar body between two pins at global points; the length is the distance of the points. [m]"""
        return Link(name, self._token, self._native.link_between(name, flat(a), flat(b)))

    def planar(
        self, name: str, x: NumberLike = 0.0, y: NumberLike = 0.0, theta: NumberLike = 0.0
    ) -> PlanarBody:
        """Adds a planar body with a guess of (R_x, R_y, θ). [m, m, rad]"""
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
        """Adds a spatial body with a guess of its pose. [m, –]

        Give R and the Euler parameters p, or R and a rotation by `angle` about `axis`, or R and `facing`, an axis or
        direction along the x-axis of the body.
        """
        self._native.spatial(name, spatial_pose(r, p, axis, angle, facing))
        return SpatialBody(name, self._token)

    def spatial_link_between(self, name: str, a: Vec3Like, b: Vec3Like) -> SpatialLink:
        """Adds a spatial body between two global points a and b, with its frame in the middle and its x-axis from a to
        b. [m]
        """
        return SpatialLink(name, self._token, self._native.spatial_link_between(name, flat(a), flat(b)))

    def angle(self, name: str, guess: NumberLike) -> Coordinate:
        """Adds a scalar coordinate that is an angle. [rad]"""
        self._native.angle(name, self._number(name, guess))
        return Coordinate(name, self._token)

    def length(self, name: str, guess: NumberLike) -> Coordinate:
        """Adds a scalar coordinate that is a length. [m]"""
        self._native.length(name, self._number(name, guess))
        return Coordinate(name, self._token)

    def __getitem__(self, name: str) -> Any:
        """Returns the body or scalar coordinate with this name, or a coordinate of a body such as "crank.theta"."""
        bodies = json.loads(self._native.to_json())["bodies"]
        if name == "ground" or not isinstance(name, str):
            raise TypeError(f"m[…] takes the name of a body or coordinate, not {name!r}. The ground is m.ground")
        for body in bodies:
            kind, own, length = body["kind"], body["name"], body.get("length")
            if isinstance(length, str):
                length = self._expression(length)
            if own == name and kind == "planar":
                return PlanarBody(name, self._token) if length is None else Link(name, self._token, length)
            if own == name and kind == "spatial":
                return SpatialBody(name, self._token) if length is None else SpatialLink(name, self._token, length)
            if own == name or (name.startswith(own + ".") and kind in ("planar", "spatial")):
                return Coordinate(name, self._token)
        unknown("body or coordinate", name, [body["name"] for body in bodies])

    # Constraints.

    def add(self, name: str, constraint: Union[Joint, Constraint]) -> None:
        """Adds a joint of the library, or a user-defined constraint, under a name.

        Raises an error if the name is empty or taken, a parameter is not finite or invalid, a body belongs to another
        mechanism, or the constraint contains a body twice.
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
        """Returns every term of a constraint at the state q, qd and t.

        q and qd are the coordinates and velocities of the bodies of the constraint, one body after the other.
        """
        equation, on, parameters = self._making(constraint.equation.name, constraint)
        return Terms(*self._native.terms(equation, on, parameters, _bytes(q), _bytes(qd), t))

    # Guesses and preferences.

    def guess(self, coordinate: Coordinate, value: float) -> None:
        """Sets the guess of one coordinate. [m or rad]"""
        self._native.set_guess(self._own("guess", coordinate), value)

    def set_initial(self, q: Any) -> None:
        """Sets the guesses of all coordinates, in the order of their declaration. [m, rad]"""
        self._native.set_initial(flat(q))

    def set_pose(self, body: PlanarBody, x: float, y: float, theta: float) -> None:
        """Sets the guess of the pose of a planar body. [m, m, rad]"""
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
        """Sets the guess of the pose of a spatial body, in the same form as for `spatial`. [m, –]"""
        self._native.set_spatial_pose(self._own("set_spatial_pose", body), spatial_pose(r, p, axis, angle, facing))

    def prefer(self, what: Union[Body, Coordinate, str], value: Any) -> None:
        """Selects the assembly in which a quantity is nearest to a value. [m or rad]

        The quantity is a coordinate, a planar body (its θ), a spatial body (its Euler parameters), or a measure of a
        joint by its name. The value may be a dimension.
        """
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
        """Sets the permitted range of a measure of a joint or of a coordinate.

        A run reports an event where the measure leaves the range.
        """
        self._native.limit(measure, start, end)

    def local(self, body: Handle, point: Any) -> Any:
        """Returns the local position ū of a global point in a body at its drawn pose. [m]"""
        return self._local(body, point, True)

    def local_direction(self, body: Handle, h: Any) -> Any:
        """Returns the local direction h̄ of a global direction in a body at its drawn pose."""
        return self._local(body, h, False)

    def _local(self, body: Handle, vector: Any, point: bool) -> Any:
        kind = "spatial" if isinstance(body, SpatialBody) else "planar"
        name = None if isinstance(body, Ground) else self._own("local", body)
        found = self._native.local((kind, name), flat(vector), point)
        return Vec2(*found) if len(found) == 2 else Vec3(*found)

    def hold_idle_turns(self) -> list[str]:
        """Holds idle rotations, such as the rotation of a rod between two ball joints about its axis.

        Returns the names of the held bodies.
        """
        return self._native.hold_idle_turns()

    def _own(self, place: str, handle: Union[Body, Coordinate]) -> str:
        if not isinstance(handle, (PlanarBody, SpatialBody, Coordinate)):
            raise TypeError(f"`{place}` takes a body or coordinate, not {handle!r}")
        if handle._of != self._token:
            raise foreign(place, "body", self.name)
        return handle.name

    # Masses, weight and loads.

    def mass(self, body: Body, mass: NumberLike, centre: Any, inertia: Any) -> None:
        """Sets the mass of a body, its centre of mass in the body frame and its inertia about the centre of mass. [kg,
        m, kg m²]

        The inertia is one moment in the plane. In space it is a tensor in the axes of the body, or the diagonal of the
        tensor. Each number may be a dimension. A second call for the same body replaces the mass of the first call.

        Raises an error if the body is the ground or belongs to another mechanism, if the mass is not positive, or if no
        body can have the inertia.
        """
        place, in_plane = self._massive("mass", body)
        numbers = [mass, *in_space(centre), *inertia_of(inertia, in_plane)]
        self._native.mass(place, [self._number("mass", one) for one in numbers])

    def solid(self, body: Body, solid: Solid) -> None:
        """Sets the mass of a body from a shape and a density: `m.solid(crank, kin.Solid.bar(0.1, 0.02, 0.01,
        kin.Solid.STEEL))`.
        """
        self._native.solid(self._massive("solid", body)[0], solid._tuple())

    def point_mass(self, name: str, point: Constraint, mass: NumberLike) -> None:
        """Adds a mass at a point that depends on coordinates, for mechanisms without bodies. [m, kg]

        The point is a user-defined constraint of two or three rows, its global coordinates: `m.point_mass("bob",
        tip(theta, 0.4), 2.0)`.

        Raises an error if the point does not have two or three rows, the mass is not positive, or the name is taken.
        """
        if not isinstance(point, Constraint):
            text = f"`{name}`: {point!r} is no point: call a function under @kin.constraint of two or three rows"
            raise TypeError(text)
        equation, on, parameters = self._making(name, point)
        self._native.point_mass(name, equation, on, parameters, self._number(name, mass))

    def friction(self, joint: str, friction: Friction) -> None:
        """Adds dry friction to an existing joint: `m.friction("shaft", kin.Friction.pin(0.1, 0.02, 1e-3))`.

        Friction changes reactions, efforts of drivers and the balance of powers. A second call for the same joint
        replaces the friction of the first call.

        Raises an error if no constraint has the name, the joint is neither a pin nor a slide, or a number is invalid.
        `system.forces` raises `kin.Jammed` if friction jams the mechanism.
        """
        if not isinstance(friction, Friction):
            raise TypeError(f"`{joint}`: {friction!r} is no friction: call kin.Friction.pin(…) or kin.Friction.slide(…)")
        self._native.friction(joint, *friction._told(lambda number: self._number(joint, number)))

    def load(self, name: str, load: Load) -> None:
        """Adds a load to the mechanism, under a name.

        The load is `kin.loads.spring(…)` or another load of the library, `kin.Load.force(body, u, force)`, or the
        result of a function under `@kin.potential` or `@kin.force`. `a + b` combines two loads. The numbers of a load
        may be dimensions.

        Raises an error if the load acts on the ground alone, a body belongs to another mechanism, a length has several
        rows, or the name is taken.
        """
        if not isinstance(load, Load):
            raise TypeError(
                f"`{name}`: {load!r} is no load: call kin.loads.spring(…) or another of that library, kin.Load.force(…), or a "
                "function under @kin.potential or @kin.force"
            )
        data, texts = load._data(name, self.name, self._token)
        self._native.load(json.dumps(data), texts)

    def gravity(self, g: Any) -> None:
        """Sets the acceleration of gravity, such as (0, -9.81); without this call it is zero. [m/s²]

        The components may be dimensions.
        """
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
        """Builds the system of the mechanism, with a fixed order of coordinates and equations.

        Raises `kin.Error` with the name of the cause.
        """
        return System(self._native.build(), self._native.to_json(), self._token)

    def released(self, t: float = 0.0) -> Released:
        """The mechanism with its drivers released, at the assembled position at time t. It may have fewer equations than coordinates, and moves
        by wishes: `released.drag(hand, hand.end, (0.3, 0.6))`.

        Raises `kin.Error` if no position satisfies the equations.
        """
        return Released(_native.Released.of_mechanism(self._native, t))

    def diagnose(self, t: float, q: Any = None) -> Diagnosis:
        """Diagnoses the mechanism: rank, dependencies and freedoms by name.

        The call also works if the mechanism cannot be built.
        """
        return Diagnosis(*self._native.diagnose(t, None if q is None else flat(q)))

    # Files.

    def to_json(self) -> str:
        """Returns the mechanism as the text of a mechanism file."""
        return self._native.to_json()

    @staticmethod
    def from_json(text: str) -> "Mechanism":
        """Creates a mechanism from the text of a mechanism file.

        Raises `kin.Error` with the name of the cause.
        """
        return Mechanism._of(text, uuid.uuid4().hex)

    def write_json(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mechanism as a file and creates missing folders."""
        self._native.write_json(os.fspath(path))

    @staticmethod
    def read_json(path: Union[str, "os.PathLike[str]"]) -> "Mechanism":
        """Reads a mechanism from a file."""
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
    """Every term of one constraint at one state, as arrays: `c`, `c_q`, `c_t`, `q_d`."""

    def __init__(self, c: Sequence[float], c_q: Sequence[Sequence[float]], c_t: Sequence[float], q_d: Any) -> None:
        self.c, self.c_q, self.c_t, self.q_d = (np.array(one, dtype=float) for one in (c, c_q, c_t, q_d))


def spatial_pose(
    r: Vec3Like, p: EulerLike, axis: Optional[Vec3Like], angle: float, facing: Optional[AxisLike]
) -> list[float]:
    """Converts the forms of a pose to a position and Euler parameters."""
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
