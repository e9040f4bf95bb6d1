"""What joints hold and drives must give, of a motion that is driven."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _native
from ._handles import Ground, PlanarBody, SpatialBody
from ._joint import foreign
from ._motion import Motion, Peak, Quantity, array
from ._values import flat
from ._vectors import VectorLike


@dataclass(frozen=True)
class Drive:
    """What a driving constraint must give: `efforts`, one for each of its laws, a torque where its law is an angle, a force where
    it is a length, positive the way the law grows; its `power`, the sum of effort · ḟ; its `peak`.   [N m or N, W]"""

    name: str
    efforts: list[Quantity]
    power: Quantity
    peak: Peak

    @property
    def effort(self) -> Quantity:
        """That of its first law."""
        return self.efforts[0]


@dataclass(frozen=True)
class Growth:
    """How the force or torque of one constraint grows towards a singular position of a motion, at the time t*: as |t − t*| to a
    `power` below zero.   [s, -]"""

    constraint: str
    t: float
    power: float
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Energy:
    """Kinetic energy T = Σ ½ m v² + ½ ω · J ω, and potential energy of weight, over time.   [J]"""

    kinetic: Quantity
    potential: Quantity


@dataclass(frozen=True)
class Balance:
    """The balance of powers over time: what drives and loads (weight among them) put in, the rate of the kinetic energy, which is
    differentiated from T and not from forces, and what is `left`; `worst` is its largest share of the `largest` power.   [W]"""

    drives: Quantity
    loads: Quantity
    kinetic: Quantity
    left: Quantity
    largest: float
    worst: float
    text: str

    def __str__(self) -> str:
        return self.text


class Forces:
    """The forces of a motion, from C_qᵀ λ = Q_e + Q_v − M q̈: `reaction` of each constraint on each body, efforts and powers of
    drives, energies, the balance of powers. `print` shows the balance."""

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
        """How many times a program has computed, and how many of those it has handed back."""
        return self._native.engine()

    @property
    def why_not_compiled(self) -> Optional[str]:
        """Why all times were computed one by one, where a program would have paid: what stands in the way, by name."""
        return self._native.why_not_compiled()

    @property
    def loads(self) -> list[str]:
        """Names of the loads."""
        return self._system.parts()[1]

    @property
    def drives(self) -> list[str]:
        """Names of the constraints that drive."""
        return self._native.drives()

    def drive(self, name: str) -> Drive:
        """The force or torque that a driving constraint must give, and its power."""
        name, efforts, power, (value, t, unit), text = self._native.drive(name)
        peak = Peak(value, t, unit, text)
        return Drive(name, [self._quantity(one) for one in efforts], self._quantity(power), peak)

    def reaction(self, constraint: str) -> "Reaction":
        """Force and torque of a constraint on its bodies; of a driver too."""
        return self._from("constraints", constraint)

    def load(self, name: str) -> "Reaction":
        """Force and torque of a load on its bodies."""
        return self._from("load", name)

    def friction(self, joint: str) -> "Reaction":
        """Force and torque of the friction in a joint on its bodies; they are a part of those of `reaction`.

        Raises an error by name: a joint that has none.
        """
        return self._from("friction", joint)

    def sum(self, constraints: Iterable[str]) -> "Reaction":
        """Force and torque of several constraints together: of redundant ones the sum can be unique where none of them is."""
        names = tuple(constraints)
        if not names:
            raise ValueError("`sum` needs the name of at least one constraint")
        return self._from("constraints", *names)

    def on_ground(self) -> "Reaction":
        """Force and torque of all constraints on the ground, `forces.on_ground().on(m.ground)`: the shaking force, and the
        shaking moment about the origin."""
        return self._from("constraints")

    def _from(self, kind: str, *names: str) -> "Reaction":
        self._native.check((kind, names))
        return Reaction(self, (kind, names))

    def growth(self) -> list[Growth]:
        """The constraints whose forces grow without bound towards singular positions of the motion: the toggle that has ended it,
        and change points that it has passed. Of mechanisms with redundant equations and of motions given by states nothing is told.
        """
        return [Growth(*one) for one in self._native.growth()]

    def named(self, name: str) -> Quantity:
        """The column of this name, such as `motor` or `A on crank.F_x`.

        Raises an error by name, with those that there are; a component that is not unique has none.
        """
        return self._quantity(self._native.named(name))

    def columns(self) -> dict[str, Any]:
        """Everything that is unique by the headers of the CSV file, such as `A on crank.F_x [N]`."""
        table: dict[str, Any] = {"t": self.motion.times}
        for told in self._native.columns():
            one = self._quantity(told)
            table[f"{one.name} [{one.unit}]"] = one.value
        return table

    def to_pandas(self) -> Any:
        """The columns as a pandas DataFrame, which has to be installed."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """The columns as a table of Arrow (pyarrow, which has to be installed)."""
        import pyarrow

        return pyarrow.table(self.columns())

    def write_csv(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the columns with 17 digits, making folders that are missing."""
        self._native.write_csv(os.fspath(path))

    def __repr__(self) -> str:
        return f"<forces of {self._mechanism}: {self.balance.text}>"


@dataclass(frozen=True)
class Reaction:
    """Forces and torques of a constraint, of several together, of a load, or of friction in a joint, on bodies."""

    forces: Forces
    _sources: tuple[str, tuple[str, ...]]

    def on(self, body: Union[PlanarBody, SpatialBody, Ground]) -> "BodyWrench":
        """Force and torque on one body; the ground takes the opposite of all that is put on bodies.

        Raises an error by name: a body of another mechanism, one that it does not act on.
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

    @property
    def power(self) -> Quantity:
        """The power that it puts into the mechanism, Q · q̇.   [W]"""
        return self.forces._quantity(self.forces._native.power(self._sources))


@dataclass(frozen=True)
class BodyWrench:
    """Force and torque on a body over time, first about the constraint's point on that body and in global axes. A component that
    is not unique, because equations are redundant, is not given as a number: asking for it is an error by name."""

    _reaction: Reaction
    _body: tuple[bool, Any]
    _ways: tuple[tuple[str, list[float]], ...]

    def _moved(self, way: str, point: Any) -> "BodyWrench":
        return BodyWrench(self._reaction, self._body, (*self._ways, (way, point)))

    def at(self, u: VectorLike) -> "BodyWrench":
        """The same about another point of the body, ū; on the ground about a global one.   [m]"""
        return self._moved("at", flat(u))

    def about(self, point: VectorLike) -> "BodyWrench":
        """The same about a global point that stays where it is.   [m]"""
        return self._moved("about", flat(point))

    def in_body(self) -> "BodyWrench":
        """The same by components in the axes of the body."""
        return self._moved("in_body", [])

    def _asked(self, asked: str) -> list[Quantity]:
        forces = self._reaction.forces
        found = forces._native.acted(self._reaction._sources, self._body, list(self._ways), asked)
        return [forces._quantity(one) for one in found]

    @property
    def force(self) -> Any:
        """The force, a row a time.   [N]"""
        return np.stack([one.value for one in self._asked("F_x F_y" if self._body[0] else "F_x F_y F_z")], axis=1)

    @property
    def torque(self) -> Any:
        """The torque about the point: a number a time in the plane, a row a time in space.   [N m]"""
        if self._body[0]:
            return self._asked("T")[0].value
        return np.stack([one.value for one in self._asked("T_x T_y T_z")], axis=1)

    @property
    def magnitude(self) -> Quantity:
        """|F|   [N]"""
        return self._asked("magnitude")[0]

    @property
    def torque_magnitude(self) -> Quantity:
        """|T|   [N m]"""
        return self._asked("torque_magnitude")[0]

    def component(self, name: str) -> Quantity:
        """One component by its name: `F_x`, `F_y`, `T` in the plane, `F_x`, …, `T_z` in space.   [N, N m]"""
        if len(name.split()) != 1 or name in ("components", "magnitude", "torque_magnitude"):
            raise ValueError(f"`{name}` is no component. Use one of F_x, F_y, F_z, T, T_x, T_y, T_z")
        return self._asked(name)[0]

    @property
    def components(self) -> list[Quantity]:
        """The components that are unique at all times."""
        return self._asked("components")

    def _points(self) -> tuple[bytes, list[str]]:
        forces = self._reaction.forces
        return forces._native.points(self._reaction._sources, self._body, list(self._ways))

    @property
    def points(self) -> Any:
        """The points about which the torque is, in the global frame, a row a time.   [m]"""
        return array(self._points()[0], 2 if self._body[0] else 3)

    @property
    def not_unique(self) -> list[str]:
        """Names of the components that are not unique at some time."""
        return self._points()[1]
