"""Defines systems: mechanisms that are ready to be solved."""

from __future__ import annotations

import json
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _mistakes, _native
from ._diagnosis import Diagnosis
from ._errors import Error
from ._design import Extreme, Extremes, Of, Samples, Sensitivities, Tolerance, _of
from ._follower import Circuit, Follower, _names
from ._map import Map
from ._released import Released
from ._forces import Forces
from ._handles import Coordinate
from ._mistakes import values
from ._names import Named
from ._pictures import Page, Picture
from ._results import Assemblies, Assembly, Compiled, Proof, Solution
from ._motion import Motion, Quantity, array, coordinate_name, orders_of, place_of
from ._values import FOLLOWS, flat

Progress = Union[bool, Callable[[int, int], object], None]
What = Union[str, Coordinate]
# What can be measured of a motion: by a name, a coordinate, or a function of a motion that gives a quantity with its rates.
Measure = Union[str, Coordinate, Callable[[Motion], Quantity]]


@values
class System:
    """A system C(q, t) = 0 that is ready to be solved, from `m.build()`.

    A run releases Python's global lock, so several threads can run at the same time. Ctrl-C ends a run.
    """

    def __init__(self, native: "_native.System", mechanism: str, token: str) -> None:
        self._native, self._mechanism, self._token = native, mechanism, token

    def __getattr__(self, name: str) -> Any:
        _mistakes.not_yet("system", name, {Motion: "the motion that `system.run(times)` returns"})

    @property
    def name(self) -> str:
        """The name of the mechanism."""
        return self._native.name()

    @property
    def names(self) -> list[str]:
        """The names of the coordinates in order, such as `crank.theta`."""
        return self._native.names()

    @property
    def units(self) -> list[str]:
        """The units of the coordinates."""
        return self._native.units()

    @property
    def equations(self) -> list[str]:
        """The names of the equations in order, such as `A.x`."""
        return self._native.equations()

    @property
    def constraints(self) -> list[str]:
        """The names of the constraints in order.

        The norm constraints of Euler parameters come last.
        """
        return self._native.parts()[0]

    @property
    def loads(self) -> list[str]:
        """The names of the loads in order."""
        return self._native.parts()[1]

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies and scalar coordinates in order."""
        return self._native.parts()[2]

    @property
    def initial(self) -> Any:
        """The guess of q. [m, rad]"""
        return array(self._native.initial())

    @property
    def dimensions(self) -> dict[str, float]:
        """The values of the dimensions by name, including named expressions."""
        return Named("dimension", self._native.dimensions())

    @property
    def parameters(self) -> dict[str, float]:
        """All numeric parameters of constraints by name, such as `slot.k`."""
        return Named("parameter", self._native.parameters())

    def parameter(self, name: str) -> float:
        """Returns the value of one parameter, such as `slot.k`, or of a dimension."""
        return self._native.parameter(name)

    def set(self, name: str, value: float) -> None:
        """Sets one dimension and all numbers that depend on it, or one parameter, without a rebuild.

        You can also set a parameter that depends on dimensions. Such a parameter keeps its value until you set one of
        the dimensions.

        Raises an error if no parameter or dimension has the name, if the value is not finite, outside the range of the
        dimension or invalid, or if the name is an expression of dimensions. After an error the old value remains.
        """
        if isinstance(value, str):
            raise TypeError(f"`{name}` needs a number, not {value!r}")
        self._native.set(name, value)

    def set_initial(self, q: Any) -> None:
        """Sets the guess of all coordinates. [m, rad]"""
        self._native.set_initial(as_bytes(q))

    # Solving.

    def run(self, times: Any, *, progress: Progress = None, start: Optional[Mapping[str, float]] = None, **options: Any) -> Motion:
        """Solves for position, velocity and acceleration at each of the times, which must only increase or only
        decrease. [s]

        Options: `tolerance`, `jerk`, `engine` ("auto", "step-by-step" or "compiled"), `follow` ("smooth" or
        "unchecked"), `other_branch_at` (indices of change points), `allowed_misfit`, `max_iterations`, `predict`,
        `rescue`, `halvings`, `memory`, `effort`, `residual_only`. Kin calls `progress` with the number of computed
        times and the number of all times; True shows a bar of tqdm.

        `start={"crank": 1}` states the direction in which a run leaves the dead centre at which it begins: the angle of the body (or a
        coordinate such as `crank.theta`) grows at first, or falls with -1. The driver must be at rest there.

        Warns (`kin.MotionWarning`) of common mistakes: numbers that look like degrees, a first position far from the
        drawn position, a start near a singular position, a table that ends before the run. `motion.warnings` lists the
        warnings too.

        Raises `kin.Error`. The attribute `motion` of the error is the motion before the failure; Kin also warns of
        mistakes in this motion.
        """
        try:
            motion = self._run(times, progress=progress, start=start, **options)
        except Error as error:
            if error.motion is not None:
                error.motion._warn()
            raise
        motion._warn()
        return motion

    def _run(self, times: Any, *, progress: Progress = None, start: Optional[Mapping[str, float]] = None, **options: Any) -> Motion:
        """The same without warnings."""
        if start is not None and len(start) != 1:
            raise ValueError(f"start: one coordinate or body with 1 or -1, not {dict(start)!r}")
        towards = None if start is None else next((name, float(sign)) for name, sign in start.items())
        if progress is None:
            return Motion(self._native.run(as_bytes(times), options or None, None, towards))
        with _Bar(progress, self.name) as told:
            return Motion(self._native.run(as_bytes(times), options or None, told, towards))

    def position(self, t: float, q: Any = None, **options: Any) -> Solution:
        """Solves for position, velocity and acceleration at one time, from the guess or from q.

        After `compile()` the compiled program finds positions near q, which makes a controller loop faster.
        """
        told = self._native.position(t, None if q is None else as_bytes(q), options or None)
        at, q, qd, qdd, iterations, residual, worst, compiled = told
        return Solution(at, array(q), array(qd), array(qdd), iterations, residual, worst, compiled)

    def residual(self, q: Any, t: float) -> Any:
        """Returns C(q, t), in the unit of each row."""
        return array(self._native.at_position(0, as_bytes(q), t))

    def jacobian(self, q: Any, t: float) -> Any:
        """Returns C_q at q and t: a row for each equation, a column for each coordinate."""
        return array(self._native.jacobian(as_bytes(q), t), len(self.names))

    def c_t(self, q: Any, t: float) -> Any:
        """Returns C_t at q and t."""
        return array(self._native.at_position(1, as_bytes(q), t))

    def acceleration_rhs(self, q: Any, qd: Any, t: float) -> Any:
        """Returns Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt."""
        return array(self._native.at_velocity(0, as_bytes(q), as_bytes(qd), t))

    def velocity(self, q: Any, t: float) -> Any:
        """Returns q̇ from C_q q̇ = −C_t."""
        return array(self._native.at_position(2, as_bytes(q), t))

    def acceleration(self, q: Any, qd: Any, t: float) -> Any:
        """Returns q̈ from C_q q̈ = Q_d."""
        return array(self._native.at_velocity(1, as_bytes(q), as_bytes(qd), t))

    def jerk_rhs(self, q: Any, qd: Any, qdd: Any, t: float) -> Any:
        """Returns −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s), the right side of C_q q⃛."""
        return array(self._native.at_acceleration(0, (flat(q), flat(qd), flat(qdd)), t))

    def jerk(self, q: Any, qd: Any, qdd: Any, t: float) -> Any:
        """Returns q⃛ from C_q q⃛ = −g‴(0)."""
        return array(self._native.at_acceleration(1, (flat(q), flat(qd), flat(qdd)), t))

    # What is asked of it.

    def diagnose(self, t: float, q: Any = None) -> Diagnosis:
        """Diagnoses the mechanism: counts, rank, dependencies and freedoms by name."""
        return Diagnosis(*self._native.diagnose(t, None if q is None else as_bytes(q)))

    def assemblies(self, t: float, **options: Any) -> Assemblies:
        """Returns a list of all assemblies that Kin finds at a time, in the order of their labels. [s]

        `complete` says whether the list is complete, and `reason` gives the reason. The list omits poses in which the
        two axes of a hinge have opposite directions.

        Options: `starts` is the largest number of starts for equations that must be solved together (20 000; fewer for
        more than seven equations). `patience` is the number of consecutive starts without a new solution after which
        the search may end (60; ten more for each known solution). `steps` is the largest number of Newton steps from
        one start (60). `seed` (0) and `time_limit` are the other options.
        """
        found, complete, reason = self._native.assemblies(t, options)
        return Assemblies([Assembly(label, array(q)) for label, q in found], complete, reason)

    def assembly(self, t: float, label: str, **options: Any) -> Assembly:
        """Returns the assembly with a label from `assemblies`, which needs the same options.

        Raises `kin.UnknownName`.
        """
        return Assembly(label, array(self._native.assembly(t, label, options)))

    def assembly_near(self, t: float, what: What, value: float) -> Assembly:
        """Returns the assembly in which a measure is nearest to a value."""
        label, q = self._native.assembly_near(t, self._what(what), value)
        return Assembly(label, array(q))

    @property
    def measures(self) -> list[str]:
        """The names of the measures of joints for `measure`, such as `slot.slide`."""
        return self._native.measures()

    @property
    def has_forces(self) -> bool:
        """True if the mechanism has a mass or a load, so that `forces` has a result."""
        return self._native.has_forces()

    def measure(self, motion: Motion, what: Measure) -> Quantity:
        """Returns a measure over a motion, with its derivatives.

        The measure is a measure of a joint, a coordinate, or a function of the motion, such as `lambda motion:
        motion.point(rod, (0.1, 0)).along((1, 0))`.
        """
        return Quantity._of(self._native.measure(motion._native, self._measured(what)), motion.times)

    def extremes(self, motion: Motion, what: Measure) -> Extremes:
        """Returns the extremes of a measure over a motion: dead centres, stroke, time ratio.

        If the measure is a function of a motion, Kin also calls the function with motions of one time.
        """
        found = self._native.extremes(motion._native, self._measured(what))
        name, unit, turns, stroke, ratio, least, most = found
        ends = Extreme(*least, is_max=False), Extreme(*most)
        return Extremes(name, unit, [Extreme(*one) for one in turns], stroke, ratio, *ends)

    def crossings(self, motion: Motion, what: Measure, value: float) -> list[tuple[float, bool]]:
        """Returns the times at which a measure passes a value, and the directions."""
        return self._native.crossings(motion._native, self._measured(what), value)

    def at(self, motion: Motion, t: float) -> Motion:
        """Returns the pose at any time of the motion, as a motion with one time."""
        return Motion(self._native.at(motion._native, t))

    def condition(self, motion: Motion) -> Quantity:
        """Returns the condition number of C_q at each time, with scaled rows and columns. [-]

        The number is infinite if C_q is singular.
        """
        return Quantity._of(self._native.condition(motion._native), motion.times)

    def smallest_singular_value(self, motion: Motion) -> Quantity:
        """Returns the smallest singular value of C_q at each time, which shows how close the motion is to a singular
        position.
        """
        return Quantity._of(self._native.smallest_singular_value(motion._native), motion.times)

    def mechanical_advantage(self, motion: Motion, drive: str, output: What) -> Quantity:
        """Returns the mechanical advantage of an output over a driver at each time. [-, 1/m, m]

        The mechanical advantage is the force or torque along the output for a unit of the driver's effort, by virtual
        power with all other drivers at rest. At a dead centre of the output it is infinite. Kin ignores masses, loads
        and friction.

        Raises an error if no driver has the name, if the driver has several rows, or if the motion has a singular
        position.
        """
        found = self._native.mechanical_advantage(motion._native, drive, self._what(output))
        return Quantity._of(found, motion.times)

    def prove(self, motion: Motion) -> Proof:
        """Proves by interval bounds that exactly one continuous motion leads through the computed positions."""
        return Proof._of(self._native.prove(motion._native))

    def page(
        self,
        motion: Motion,
        *,
        title: Optional[str] = None,
        traces: Optional[Mapping[str, Any]] = None,
        forces: Optional[Forces] = None,
        charts: Optional[Mapping[str, Any]] = None,
    ) -> Page:
        """Returns a page on which the mechanism moves. A notebook shows the page; `page.save("motion.html")` writes one file.

        `traces` names points whose paths the page shows: `{"end": (link, link.end)}`, or a body for its origin. `forces` shows
        arrows of these forces, and charts of drives and joints. `charts` are more charts over time by title: a measure
        (a name, a coordinate, a function of a motion), a `Quantity`, or a mapping of names to these:
        `{"Angles": {"crank": "crank.theta", "rod": rod.theta}}`. The unit of a chart is that of its first quantity.
        """
        pairs = {name: one if isinstance(one, tuple) else (one, None) for name, one in (traces or {}).items()}
        points = [(name, *place_of("traces", body, local)) for name, (body, local) in pairs.items()]
        drawn = [self._chart(motion, name, one) for name, one in (charts or {}).items()]
        native = None if forces is None else forces._native
        return Page(_native.page(self._native, motion._native, title, points, native, drawn))

    def _chart(self, motion: Motion, title: str, what: Any) -> tuple[str, str, list[tuple[str, list[float]]]]:
        named = what if isinstance(what, Mapping) else {title: what}
        found = {name: one if isinstance(one, Quantity) else self.measure(motion, one) for name, one in named.items()}
        for name, one in found.items():
            if len(one.value) != len(motion):
                raise ValueError(f"chart {title!r}: {name!r} has {len(one.value)} numbers, the motion {len(motion)} times")
        unit = next((one.unit for one in found.values()), "")
        return title, unit, [(name, [float(x) for x in one.value]) for name, one in found.items()]

    def picture(self, motion: Motion, t: Optional[float] = None, *, poses: int = 12) -> Picture:
        """Returns an SVG picture of the mechanism at a time of the motion, or of several poses in one picture."""
        return Picture(self._native.picture(motion._native, t, poses))

    def follower(self, t: float = 0.0, *, given: Optional[Sequence[str]] = None, **options: Any) -> Follower:
        """A follower on the branch of the assembled position at time t. It moves by values of drivers instead of by time:
        `follower.to(motor=0.63)`. The options are those of `run`.

        `given` names other values by which the follower moves: measures of joints, coordinates or drivers, as many as there are
        freedoms. The drivers that are not named are left out.

        Raises the errors of `position`, one if no law of time drives the mechanism, and those of `Follower.given`.
        """
        follower = Follower(_native.Follower(self._native, t, options or None), self._native)
        return follower if given is None else follower.given(given)

    def map(self, given: Sequence[str], wanted: Sequence[str], t: float = 0.0) -> Map:
        """The map from given values to wanted ones, on the branch of the assembled position at time t: values, slopes, their rates, and
        efforts by virtual power. Given and wanted are measures of joints, coordinates or drivers, by name.

        Raises the errors of `follower`, and one for an unknown name.
        """
        native = _native.Map(_native.Follower(self._native, t, None), _names(given), _names(wanted))
        return Map(native, self._native)

    def released(self, t: float = 0.0) -> Released:
        """The mechanism with its drivers released, at the assembled position at time t. It moves by wishes: `released.drag(coupler, (0.2, 0.1),
        (1.5, 0.8))`.

        Raises the errors of `position`.
        """
        return Released(_native.Released.of_system(self._native, t))

    def emit(
        self,
        language: str,
        name: Optional[str] = None,
        free: Iterable[str] = (),
        measures: Iterable[str] = (),
        t: float = 0.0,
    ) -> str:
        """The mechanism as the text of one file of C99 that needs no library but `<math.h>`: `system.emit("c")`.

        The functions of the file find the position at values of the drivers, from the position at time t on. `name` is the prefix of
        all names in the file. `free` names the dimensions that the file leaves free, and `measures` the coordinates that it returns.

        Raises `kin.CannotEmit` if Kin does not know a law or an equation as a formula, or if equations are redundant; the errors of
        `position`; and one for a name that does not exist.
        """
        return self._native.emit(language, name, list(free), list(measures), t)

    def circuit(self, input: str, points: int = 361) -> Circuit:
        """All positions that the mechanism reaches while the named driver moves, past dead centres: `points` of them, equally spaced by
        arc length, from the assembled position at time 0.

        Raises an error by name: no such driver, redundant equations, a singular position.
        """
        return self.follower().circuit(input, points)

    def compile(self) -> Compiled:
        """Compiles the system to one program and returns its description.

        Raises an error with the reason if Kin cannot compile the system.
        """
        return Compiled(*self._native.compile())

    def sensitivities(self, motion: Motion, names: Iterable[str]) -> Sensitivities:
        """Returns the exact derivatives of a motion by parameters and dimensions.

        `.of(what)` returns the derivatives of a measure and its time derivatives at each time, `.all()` those of all
        coordinates, and `.extreme(what, …)` those of the time and value of an extreme.

        Raises an error if no parameter has the name, if no equation depends on the parameter, if the derivative of a
        law is unknown, if the motion has a singular position, or if the motion belongs to another system.
        """
        order = list(names)
        return Sensitivities(self._native, motion, order, lambda what: self._measured(what, order))

    def toggle_by(self, toggle: dict[str, Any], names: Iterable[str]) -> dict[str, float]:
        """Returns the derivatives of the time of a toggle by parameters and dimensions. [s per unit of p]

        The derivative is dt*/dp = −λᵀ C_p / λᵀ C_t, where λᵀ C_q = 0. The toggle is the last of
        `error.motion.singular_positions` of a run that ended at the toggle.

        Raises an error for a change point, for a redundant mechanism, and for several parts that are singular at the
        same time.
        """
        order = list(names)
        return dict(zip(order, _native.toggle_by(self._native, json.dumps(toggle), order)))

    def tolerance(self, motion: Motion, what: Measure, of: Optional[Of] = None) -> Tolerance:
        """Computes the deviation of a measure of a motion for dimensions with tolerances.

        The result is for the worst time, or for one feature: the value at a time, an extreme of `system.extremes`,
        "max", "min" or "stroke". The time of an extreme may change with the dimensions.

        Raises `kin.DimensionError` if no dimension has a tolerance.
        """
        found = _native.tolerance(self._native, motion._native, self._measured(what, None), _of(of), False)
        return Tolerance._of(found)

    def tolerance_proved(self, motion: Motion, what: Measure, of: Of) -> Tolerance:
        """Computes the deviation of one feature with bounds by interval arithmetic (`.proved`).

        The bounds are valid for every mechanism within the tolerances.

        Raises `kin.CannotBeProved` if Kin cannot prove that each of these mechanisms can be assembled, or if a function
        has no known bounds.
        """
        if of is None:
            raise TypeError('`of` says what is proved: a time, an extreme, "max", "min" or "stroke"')
        found = _native.tolerance(self._native, motion._native, self._measured(what, None), _of(of), True)
        return Tolerance._of(found)

    def samples(
        self,
        motion: Motion,
        what: Measure,
        of: Of,
        *,
        count: int = 10_000,
        seed: int = 1,
        distribution: str = "normal",
    ) -> Samples:
        """Computes a feature of a measure in many mechanisms with random deviations of their dimensions.

        Each dimension has its distribution; a dimension without one has the given distribution: "normal", "truncated
        normal" or "uniform". The same seed gives the same samples on every machine.
        """
        found = _native.samples(
            self._native, motion._native, self._measured(what, None), _of(of), count, seed, distribution
        )
        text, name, unit, values = found
        return Samples(name, unit, array(values), count, seed, text)

    def forces(
        self, motion: Motion, sharing: Union[str, Iterable[str], None] = None, *, engine: str = "auto"
    ) -> Forces:
        """Computes the forces of a motion of this system.

        `m.mass` and `m.solid` set masses, and `m.gravity` sets the acceleration of gravity. `sharing` sets how
        redundant constraints share forces: "least norm", or the names of equations that carry no force. Without
        `sharing` Kin returns no number for a force that is not unique. `engine` is "step-by-step", "compiled" (one
        program computes several times at once) or "auto" (the program, if it saves time). The results of both engines
        differ in the last digits.

        Raises an error if the mechanism has no mass and no load, if the motion belongs to another system, or if it has
        a singular position; with "compiled" also if Kin cannot compile a program.
        """
        return Forces(self._native, motion, self._token, self.name, sharing, engine)

    def gradient(self, motion: Motion, names: Sequence[str], what: Measure, weights: Any) -> Any:
        """Returns the derivatives of one number by parameters.

        The rows of `weights` are the derivatives of the number by the measure and by its first and second time
        derivative, at each time.
        """
        rows = np.zeros((len(motion), 3))
        given = np.asarray(weights, dtype=float)
        rows[:, : 1 if given.ndim == 1 else given.shape[1]] = given.reshape(len(motion), -1)
        found = _native.gradient(
            self._native, motion._native, list(names), self._measured(what, names), as_bytes(rows)
        )
        return np.array(found)

    def objective(
        self,
        names: Sequence[str],
        times: Any,
        what: Measure,
        cost: Callable[[Quantity], tuple[float, Any]],
        **options: Any,
    ) -> Callable[[Any], tuple[float, Any]]:
        """Creates a function of parameters with its exact gradient, for `scipy.optimize.minimize(…, jac=True)`.

        `cost` computes the number from a measure over the motion, and the derivatives of the number by the values of
        the measure (a row, or three columns with those by its first and second derivative). The function works on a
        copy of the system.
        """
        system, order = self.__copy__(), list(names)

        def function(x: Any) -> tuple[float, Any]:
            for name, value in zip(order, np.asarray(x, dtype=float).ravel().tolist()):
                system.set(name, value)
            # An optimiser runs the system a thousand times: nobody reads so many warnings.
            motion = system._run(times, **options)
            value, weights = cost(system.measure(motion, what))
            return float(value), system.gradient(motion, order, what, weights)

        return function

    def _measured(self, what: Measure, by: Optional[Iterable[str]] = ()) -> Any:
        """A measure as the native part takes it: a name, or a function of its motion. `by` are the names by which it changes, `None`
        for all dimensions."""
        if not callable(what):
            return self._what(what)
        follows = by is None or not set(self.dimensions).isdisjoint(by)

        def orders(native: "_native.Motion") -> Any:
            before, FOLLOWS.dimensions = FOLLOWS.dimensions, follows
            try:
                return orders_of(what(Motion(native)))
            finally:
                FOLLOWS.dimensions = before

        return orders

    def _what(self, what: What) -> str:
        return coordinate_name(self.names, what.name if isinstance(what, Coordinate) else what)

    def __reduce__(self) -> Any:
        native = self._native
        state = (native.dimensions(), native.parameters(), self.initial.tolist())
        return (_rebuilt, (self._mechanism, self._token, *state))

    def __copy__(self) -> "System":
        return System(self._native.copy(), self._mechanism, self._token)

    def __deepcopy__(self, _: Any) -> "System":
        return self.__copy__()

    def __repr__(self) -> str:
        return f"<system {self.name}: {len(self.names)} coordinates, {len(self.equations)} equations>"


def _rebuilt(
    mechanism: str,
    token: str,
    dimensions: list[tuple[str, float]],
    parameters: list[tuple[str, float]],
    initial: list[float],
) -> System:
    """The system of a mechanism file, with the dimensions, the parameters and the guess that it had."""
    system = System(_native.Mechanism.from_json(mechanism).build(), mechanism, token)
    nominal = system.dimensions
    expressions = {one["name"] for one in json.loads(mechanism).get("dimensions", []) if isinstance(one["value"], str)}
    open_ones = [(name, value) for name, value in dimensions if name not in expressions and nominal[name] != value]
    while open_ones:
        # One alone may make no sense before the others are set.
        refused = []
        for name, value in open_ones:
            try:
                system.set(name, value)
            except Error as error:
                refused.append((name, value, error))
        if len(refused) == len(open_ones):
            raise refused[0][2]
        open_ones = [(name, value) for name, value, _ in refused]
    known = system.parameters
    for name, value in parameters:
        if known[name] != value:
            system.set(name, value)
    system.set_initial(initial)
    return system


class _Bar:
    """Whoever is told of progress: a function, a bar of tqdm, or nobody."""

    def __init__(self, progress: Progress, name: str) -> None:
        self._bar: Any = None
        self._call = progress if callable(progress) else None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(desc=name)
            self._call = self._step

    def _step(self, done: int, all_of_them: int) -> None:
        self._bar.total = all_of_them
        self._bar.update(done - self._bar.n)

    def __enter__(self) -> Optional[Callable[[int, int], object]]:
        return self._call

    def __exit__(self, *_: Any) -> None:
        if self._bar is not None:
            self._bar.close()


def as_bytes(numbers: Any) -> bytes:
    """Converts the numbers of an array, list or iterable for the native module."""
    if type(numbers) is np.ndarray and numbers.dtype == np.float64:
        return numbers.tobytes()
    if isinstance(numbers, (range, map, filter)) or hasattr(numbers, "__next__"):
        numbers = list(numbers)
    found = np.asarray(numbers)
    if found.dtype.kind not in "iufb" or found.dtype.kind == "b":
        raise TypeError(f"numbers are needed, not {type(numbers).__name__} of {found.dtype}")
    return np.ascontiguousarray(found, dtype=np.float64).ravel().tobytes()
