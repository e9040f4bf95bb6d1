"""Computes reactions of joints and efforts of drivers in a driven motion."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _native
from ._handles import Ground, PlanarBody, SpatialBody
from ._joint import foreign
from ._mistakes import values
from ._names import Named
from ._motion import Motion, Peak, Quantity, array
from ._values import flat
from ._vectors import VectorLike


@values
@dataclass(frozen=True)
class Drive:
    """The efforts and the power of a driver. [N m or N, W]

    `efforts` contains one effort for each law of the driver: a torque if the law is an angle, a force if the law is a
    length. An effort is positive in the direction in which its law grows. `power` is the sum of effort · ḟ, and `peak`
    is the largest effort.
    """

    name: str
    efforts: list[Quantity]
    power: Quantity
    peak: Peak

    @property
    def effort(self) -> Quantity:
        """The effort of the first law of the driver."""
        return self.efforts[0]


@dataclass(frozen=True)
class Growth:
    """The growth of the force or torque of one constraint near a singular position at the time t*. [s, -]

    The force grows like |t − t*| to the negative exponent `power`.
    """

    constraint: str
    t: float
    power: float
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Energy:
    """The kinetic energy T = Σ ½ m v² + ½ ω · J ω, and the potential energy of the weight, over time. [J]"""

    kinetic: Quantity
    potential: Quantity


@dataclass(frozen=True)
class Balance:
    """The balance of powers over time: the power of drivers and loads (including weight), dT/dt, and the difference
    `left`. [W]

    Kin computes dT/dt by differentiating the kinetic energy T, not from forces. `worst` is the largest difference as a
    share of the `largest` power.
    """

    drives: Quantity
    loads: Quantity
    kinetic: Quantity
    left: Quantity
    largest: float
    worst: float
    text: str

    def __str__(self) -> str:
        return self.text


@values
class Forces:
    """The forces of a motion, from C_qᵀ λ = Q_e + Q_v − M q̈. `print` shows the balance of powers.

    The object contains the `reaction` of each constraint on each body, efforts and powers of drivers, energies, and the
    balance of powers.
    """

    def __init__(
        self, system: "_native.System", motion: Motion, token: str, mechanism: str, sharing: Any, engine: str
    ) -> None:
        names = None if isinstance(sharing, str) or sharing is None else list(sharing)
        if isinstance(sharing, str) and sharing != "least norm":
            raise ValueError(f'`sharing` is "least norm", or the names of equations that hold nothing, not "{sharing}"')
        if sharing is not None and engine != "auto":
            raise ValueError("`sharing` is for redundant equations, which have no compiled forces. Leave `engine` out")
        self._native = _native.Forces(system, motion._native, engine, sharing == "least norm", names)
        self._system, self._token, self._mechanism = system, token, mechanism
        #: The motion that they belong to.
        self.motion = motion
        energies, powers, largest, worst, text = self._native.balance()
        self.energy = Energy(self._quantity(energies[0]), self._quantity(energies[1]))
        drives, loads, kinetic, left = (self._quantity(one) for one in powers)
        self.balance = Balance(drives, loads, kinetic, left, largest, worst, text)

    def _quantity(self, told: Any) -> Quantity:
        return Quantity._of(told, self.motion.times)

    @property
    def engine(self) -> tuple[int, int]:
        """The number of times that a program has computed, and the number of times that it returned to the step-by-step
        solver.
        """
        return self._native.engine()

    @property
    def why_not_compiled(self) -> Optional[str]:
        """The reason why Kin computed all times one by one although a program would have been faster."""
        return self._native.why_not_compiled()

    @property
    def loads(self) -> list[str]:
        """The names of the loads."""
        return self._system.parts()[1]

    @property
    def drives(self) -> list[str]:
        """The names of the drivers."""
        return self._native.drives()

    def drive(self, name: str) -> Drive:
        """Returns the efforts and the power of a driver."""
        name, efforts, power, (value, t, unit), text = self._native.drive(name)
        peak = Peak(value, t, unit, text)
        return Drive(name, [self._quantity(one) for one in efforts], self._quantity(power), peak)

    def reaction(self, constraint: str) -> "Reaction":
        """Returns the force and torque of a constraint, such as a joint or a driver, on its bodies."""
        return self._from("constraints", constraint)

    def load(self, name: str) -> "Reaction":
        """Returns the force and torque of a load on its bodies."""
        return self._from("load", name)

    def friction(self, joint: str) -> "Reaction":
        """Returns the force and torque of the friction in a joint on its bodies.

        `reaction` contains only the normal forces of the joint.

        Raises an error if the joint has no friction.
        """
        return self._from("friction", joint)

    def sum(self, constraints: Iterable[str]) -> "Reaction":
        """Returns the force and torque of several constraints together.

        The sum over redundant constraints can be unique although the force of each constraint is not unique.
        """
        names = tuple(constraints)
        if not names:
            raise ValueError("`sum` needs the name of at least one constraint")
        return self._from("constraints", *names)

    @property
    def on_ground(self) -> "Reaction":
        """Returns the force and torque of all constraints on the ground: the shaking force, and the shaking moment
        about the origin.

        Use `forces.on_ground.on(m.ground)`.
        """
        return self._from("constraints")

    def _from(self, kind: str, *names: str) -> "Reaction":
        self._native.check((kind, names))
        return Reaction(self, (kind, names))

    def growth(self) -> list[Growth]:
        """Returns the constraints whose forces grow without bound near the singular positions of the motion.

        The singular positions are the toggle that ended the motion and the change points that the motion passed. For
        mechanisms with redundant equations and for motions from given states the list is empty.
        """
        return [Growth(*one) for one in self._native.growth()]

    def named(self, name: str) -> Quantity:
        """Returns the column with this name, such as `motor` or `A on crank.F_x`.

        Raises an error, with the existing names, if no column has the name. A component that is not unique has no
        column.
        """
        return self._quantity(self._native.named(name))

    def __getitem__(self, name: str) -> Quantity:
        """The same as `named`: `forces["motor"]`."""
        return self.named(name)

    def columns(self) -> dict[str, Any]:
        """Returns all unique quantities by the headers of the CSV file, such as `A on crank.F_x [N]`."""
        table: dict[str, Any] = Named("column", {"t": self.motion.times})
        for told in self._native.columns():
            one = self._quantity(told)
            table[f"{one.name} [{one.unit}]"] = one.value
        return table

    def to_pandas(self) -> Any:
        """Returns the columns as a pandas DataFrame. The package pandas must be installed."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """Returns the columns as an Arrow table. The package pyarrow must be installed."""
        import pyarrow

        return pyarrow.table(self.columns())

    def write_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the columns as a CSV file with 17 digits and creates missing folders."""
        self._native.write_csv(os.fspath(path))

    def __repr__(self) -> str:
        return f"<forces of {self._mechanism}: {self.balance.text}>"


@values
@dataclass(frozen=True)
class Reaction:
    """The forces and torques of a constraint, of several constraints, of a load, or of the friction in a joint, on
    bodies.
    """

    forces: Forces
    _sources: tuple[str, tuple[str, ...]]

    def on(self, body: Union[PlanarBody, SpatialBody, Ground]) -> "BodyWrench":
        """Returns the force and torque on one body.

        The force on the ground is the opposite of all forces on the bodies.

        Raises an error if the body belongs to another mechanism, or if the source does not act on the body.
        """
        if not isinstance(body, (PlanarBody, SpatialBody, Ground)):
            raise TypeError(f"`on` takes a body, not {body!r}")
        if isinstance(body, Ground):
            return BodyWrench(self, (self._in_plane(), None), ())
        if body._of != self.forces._token:
            raise foreign("on", "body", self.forces._mechanism)
        return BodyWrench(self, (isinstance(body, PlanarBody), body.name), ())

    def _in_plane(self) -> bool:
        return not any(name.endswith(".e0") for name in self.forces.motion.names)

    @cached_property
    def power(self) -> Quantity:
        """The power Q · q̇ that the source puts into the mechanism. [W]"""
        return self.forces._quantity(self.forces._native.power(self._sources))


@values
@dataclass(frozen=True)
class BodyWrench:
    """The force and torque on a body over time, about a point and in axes that you choose.

    The default point is the constraint's point on this body, and the default axes are global. If a component is not
    unique because equations are redundant, each method that needs the component raises an error.
    """

    _reaction: Reaction
    _body: tuple[bool, Any]
    _ways: tuple[tuple[str, list[float]], ...]

    def _moved(self, way: str, point: Any) -> "BodyWrench":
        return BodyWrench(self._reaction, self._body, (*self._ways, (way, point)))

    def at(self, u: VectorLike) -> "BodyWrench":
        """Moves the torque to another point ū of the body; on the ground ū is a global point. [m]"""
        return self._moved("at", flat(u))

    def about(self, point: VectorLike) -> "BodyWrench":
        """Moves the torque to a fixed global point. [m]"""
        return self._moved("about", flat(point))

    def in_body(self) -> "BodyWrench":
        """Converts the components to the axes of the body."""
        return self._moved("in_body", [])

    def _asked(self, asked: str) -> list[Quantity]:
        forces = self._reaction.forces
        found = forces._native.acted(self._reaction._sources, self._body, list(self._ways), asked)
        return [forces._quantity(one) for one in found]

    @cached_property
    def force(self) -> Any:
        """The force, a row for each time. [N]"""
        return _rows(self._asked("F_x F_y" if self._body[0] else "F_x F_y F_z"))

    @cached_property
    def torque(self) -> Any:
        """The torque about the point: a number for each time in the plane, a row for each time in space. [N m]"""
        if self._body[0]:
            return self._asked("T")[0].value
        return _rows(self._asked("T_x T_y T_z"))

    @cached_property
    def magnitude(self) -> Quantity:
        """The magnitude |F| of the force over time. [N]"""
        return self._asked("magnitude")[0]

    @cached_property
    def torque_magnitude(self) -> Quantity:
        """The magnitude |T| of the torque over time. [N m]"""
        return self._asked("torque_magnitude")[0]

    def component(self, name: str) -> Quantity:
        """Returns one component by its name: `F_x`, `F_y`, `T` in the plane, `F_x`, …, `T_z` in space. [N, N m]"""
        if len(name.split()) != 1 or name in ("components", "magnitude", "torque_magnitude"):
            raise ValueError(f"`{name}` is no component. Use one of F_x, F_y, F_z, T, T_x, T_y, T_z")
        return self._asked(name)[0]

    @property
    def components(self) -> list[Quantity]:
        """The components that are unique at all times."""
        return self._asked("components")

    @cached_property
    def _points(self) -> tuple[bytes, list[str]]:
        forces = self._reaction.forces
        return forces._native.points(self._reaction._sources, self._body, list(self._ways))

    @cached_property
    def points(self) -> Any:
        """The global positions of the point of the torque, a row for each time. [m]"""
        return array(self._points[0], 2 if self._body[0] else 3)

    @cached_property
    def not_unique(self) -> list[str]:
        """The names of the components that are not unique at some time."""
        return self._points[1]


def _rows(columns: list[Quantity]) -> Any:
    """Their values side by side, a row a time, read-only."""
    rows = np.stack([one.value for one in columns], axis=1)
    rows.flags.writeable = False
    return rows
