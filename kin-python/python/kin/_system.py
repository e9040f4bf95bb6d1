"""A mechanism made ready for solving."""

from __future__ import annotations

import json
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _mistakes, _native
from ._diagnosis import Diagnosis
from ._errors import Error
from ._design import Extreme, Extremes, Of, Samples, Sensitivities, Tolerance, _of
from ._follower import Follower
from ._forces import Forces
from ._handles import Coordinate
from ._pictures import Page, Picture
from ._results import Assemblies, Assembly, Compiled, Proof, Solution
from ._motion import Motion, Quantity, array, coordinate_name, orders_of, place_of
from ._values import flat

Progress = Union[bool, Callable[[int, int], object], None]
What = Union[str, Coordinate]
# What can be measured of a motion: by a name, a coordinate, or a function of a motion that gives a quantity with its rates.
Measure = Union[str, Coordinate, Callable[[Motion], Quantity]]


class System:
    """A system C(q, t) = 0 ready to be solved; built by `m.build()`. Runs give up Python's lock, so threads run side by
    side; Ctrl-C ends one."""

    def __init__(self, native: "_native.System", mechanism: str, token: str) -> None:
        self._native, self._mechanism, self._token = native, mechanism, token

    def __getattr__(self, name: str) -> Any:
        _mistakes.not_yet("system", name, {Motion: "the motion that `system.run(times)` returns"})

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self._native.name()

    @property
    def names(self) -> list[str]:
        """Names of the coordinates in their order, such as `crank.theta`."""
        return self._native.names()

    @property
    def units(self) -> list[str]:
        """Units of the coordinates."""
        return self._native.units()

    @property
    def equations(self) -> list[str]:
        """Names of the equations in their order, such as `A.x`."""
        return self._native.equations()

    @property
    def constraints(self) -> list[str]:
        """Names of the constraints in their order; those that hold Euler parameters to one come last."""
        return self._native.parts()[0]

    @property
    def loads(self) -> list[str]:
        """Names of the loads in their order."""
        return self._native.parts()[1]

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies and bare coordinates in their order."""
        return self._native.parts()[2]

    @property
    def initial(self) -> Any:
        """The guess of q."""
        return array(self._native.initial())

    @property
    def dimensions(self) -> dict[str, float]:
        """The values of the dimensions by name; expressions that were given a name are among them."""
        return dict(self._native.dimensions())

    @property
    def parameters(self) -> dict[str, float]:
        """All numeric parameters of constraints by name, such as `slot.k`."""
        return dict(self._native.parameters())

    def parameter(self, name: str) -> float:
        """The value of one parameter, such as `slot.k`, or of a dimension."""
        return self._native.parameter(name)

    def set(self, name: str, value: float) -> None:
        """Sets one dimension and all that hangs on it, or one parameter, without a rebuild. A parameter that hangs on
        dimensions keeps the value that it is given until one of these is set.

        Raises an error by name: nothing of that name, not finite, beyond the range of the dimension, an expression of others,
        what makes no sense; the old value stays.
        """
        if isinstance(value, str):
            raise TypeError(f"`{name}` needs a number, not {value!r}")
        self._native.set(name, value)

    def set_initial(self, q: Any) -> None:
        """Another guess for all coordinates."""
        self._native.set_initial(as_bytes(q))

    # Solving.

    def run(self, times: Any, *, progress: Progress = None, **options: Any) -> Motion:
        """Position, velocity and acceleration at each of the times, which only increase or only decrease.   [s]

        Options: `tolerance`, `jerk`, `engine` ("auto", "step-by-step" or "compiled"), `follow` ("smooth" or "unchecked"), `other_branch_at`
        (numbers of change points), `allowed_misfit`, `max_iterations`, `predict`, `rescue`, `halvings`, `memory`,
        `effort`, `residual_only`. `progress` is called with the times that are done and all of them; True shows a bar of tqdm.

        Warns (`kin.MotionWarning`) of usual slips: numbers that look like degrees, a first position far from the drawn one, a start near
        a singular position, a table that ends before the run. `motion.warnings` lists them too.

        Raises `kin.Error`; its `.motion` is what was computed before, and is warned of as well.
        """
        try:
            motion = self._run(times, progress=progress, **options)
        except Error as error:
            if error.motion is not None:
                error.motion._warn()
            raise
        motion._warn()
        return motion

    def _run(self, times: Any, *, progress: Progress = None, **options: Any) -> Motion:
        """The same without warnings."""
        if progress is None:
            return Motion(self._native.run(as_bytes(times), options or None))
        with _Bar(progress, self.name) as told:
            return Motion(self._native.run(as_bytes(times), options or None, told))

    def position(self, t: float, q: Any = None, **options: Any) -> Solution:
        """Position, velocity and acceleration at one time, assembled from the guess; from q, where it is given: after `compile()` by the
        program, if q is near, which is what a loop of a controller wants."""
        told = self._native.position(t, None if q is None else as_bytes(q), options or None)
        at, q, qd, qdd, iterations, residual, worst, compiled = told
        return Solution(at, array(q), array(qd), array(qdd), iterations, residual, worst, compiled)

    def residual(self, q: Any, t: float) -> Any:
        """C(q, t)"""
        return array(self._native.at_position(0, as_bytes(q), t))

    def jacobian(self, q: Any, t: float) -> Any:
        """C_q at q and t, a row an equation, a column a coordinate."""
        return array(self._native.jacobian(as_bytes(q), t), len(self.names))

    def c_t(self, q: Any, t: float) -> Any:
        """C_t at q and t"""
        return array(self._native.at_position(1, as_bytes(q), t))

    def acceleration_rhs(self, q: Any, qd: Any, t: float) -> Any:
        """Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt"""
        return array(self._native.at_velocity(0, as_bytes(q), as_bytes(qd), t))

    def velocity(self, q: Any, t: float) -> Any:
        """q̇ of C_q q̇ = −C_t"""
        return array(self._native.at_position(2, as_bytes(q), t))

    def acceleration(self, q: Any, qd: Any, t: float) -> Any:
        """q̈ of C_q q̈ = Q_d"""
        return array(self._native.at_velocity(1, as_bytes(q), as_bytes(qd), t))

    def jerk_rhs(self, q: Any, qd: Any, qdd: Any, t: float) -> Any:
        """−g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s), the right side of C_q q⃛"""
        return array(self._native.at_acceleration(0, (flat(q), flat(qd), flat(qdd)), t))

    def jerk(self, q: Any, qd: Any, qdd: Any, t: float) -> Any:
        """q⃛ of C_q q⃛ = −g‴(0)"""
        return array(self._native.at_acceleration(1, (flat(q), flat(qd), flat(qdd)), t))

    # What is asked of it.

    def diagnose(self, t: float, q: Any = None) -> Diagnosis:
        """Counts, rank, dependencies and freedoms by name."""
        return Diagnosis(*self._native.diagnose(t, None if q is None else as_bytes(q)))

    def assemblies(self, t: float, **options: Any) -> Assemblies:
        """All assemblies that are found at a time, a list in the order of their labels, which says whether it is `complete` and for
        what `reason`. Poses with a hinge turned over, its axes opposed, are left out.

        Options: `starts` at most for equations that must be solved together (20000; fewer for more than seven), `patience` (60: it goes
        on for so many starts that lead to nothing new at least, and ten more for each solution that is known), `steps` of Newton's
        method from one start (60), `seed` (0), `time_limit`.   [s]
        """
        found, complete, reason = self._native.assemblies(t, options)
        return Assemblies([Assembly(label, array(q)) for label, q in found], complete, reason)

    def assembly(self, t: float, label: str, **options: Any) -> Assembly:
        """The assembly of a label that `assemblies` gave out, with the same options. Raises `kin.UnknownName`."""
        return Assembly(label, array(self._native.assembly(t, label, options)))

    def assembly_near(self, t: float, what: What, value: float) -> Assembly:
        """The assembly with a measure nearest to a value."""
        label, q = self._native.assembly_near(t, self._what(what), value)
        return Assembly(label, array(q))

    @property
    def measures(self) -> list[str]:
        """What `measure` can be asked for of joints, such as `slot.slide`."""
        return self._native.measures()

    @property
    def has_forces(self) -> bool:
        """True where something has mass or something acts, so that it can be asked for forces."""
        return self._native.has_forces()

    def measure(self, motion: Motion, what: Measure) -> Quantity:
        """A measure over a motion, with its rates: of a joint or a coordinate, or a function of the motion, such as
        `lambda motion: motion.point(rod, (0.1, 0)).along((1, 0))`."""
        return Quantity._of(self._native.measure(motion._native, self._measured(what)), motion.times)

    def extremes(self, motion: Motion, what: Measure) -> Extremes:
        """Where a measure turns round: dead centres, stroke, time ratio. A measure that is a function of a motion is called
        for motions of one time too."""
        found = self._native.extremes(motion._native, self._measured(what))
        name, unit, turns, stroke, ratio, least, most = found
        ends = Extreme(*least, is_max=False), Extreme(*most)
        return Extremes(name, unit, [Extreme(*one) for one in turns], stroke, ratio, *ends)

    def crossings(self, motion: Motion, what: Measure, value: float) -> list[tuple[float, bool]]:
        """When a measure passes a value, and whether it rises there."""
        return self._native.crossings(motion._native, self._measured(what), value)

    def at(self, motion: Motion, t: float) -> Motion:
        """One pose, at any time of the motion: a motion of one time."""
        return Motion(self._native.at(motion._native, t))

    def condition(self, motion: Motion) -> Quantity:
        """The condition number of C_q at each time, rows and columns in their sizes; infinite where it is singular.   [-]"""
        return Quantity._of(self._native.condition(motion._native), motion.times)

    def smallest_singular_value(self, motion: Motion) -> Quantity:
        """How near the motion comes to a singular position."""
        return Quantity._of(self._native.smallest_singular_value(motion._native), motion.times)

    def mechanical_advantage(self, motion: Motion, drive: str, output: What) -> Quantity:
        """The force (or torque) along an output for a unit of a drive's effort at each time, by virtual power, all other drives
        standing still; infinite at a dead centre of the output. Without masses, loads and friction.   [-, 1/m, m]

        Raises an error by name: a name that no driver has, a driver of several rows, a singular position.
        """
        found = self._native.mechanical_advantage(motion._native, drive, self._what(output))
        return Quantity._of(found, motion.times)

    def prove(self, motion: Motion) -> Proof:
        """By interval bounds: that exactly one continuous motion leads through the computed positions."""
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
        """The mechanism at a time of the motion, or some poses of it on one another, as SVG."""
        return Picture(self._native.picture(motion._native, t, poses))

    def follower(self, t: float = 0.0, **options: Any) -> Follower:
        """A follower on the branch of the assembled position at time t. It moves by values of drivers instead of by time:
        `follower.to(motor=0.63)`. The options are those of `run`.

        Raises the errors of `position`, and one if no law of time drives the mechanism.
        """
        return Follower(self._native.follower(t, options or None), self._native)

    def compile(self) -> Compiled:
        """What its rows give and what is left to Newton's method, as one program; or an error that names why not."""
        return Compiled(*self._native.compile())

    def sensitivities(self, motion: Motion, names: Iterable[str]) -> Sensitivities:
        """The derivatives of a motion by parameters and dimensions, exact: `.of(what)` those of a measure and its rates at each time,
        `.all()` those of all coordinates, `.extreme(what, …)` those of time and value of an extreme.

        Raises an error by name: a name that is no parameter or on which nothing depends, a law whose derivative is not known, a
        motion with a singular position, a motion of another system.
        """
        return Sensitivities(self._native, motion, list(names), self._measured)

    def toggle_by(self, toggle: dict[str, Any], names: Iterable[str]) -> dict[str, float]:
        """How the time of a toggle changes with parameters and dimensions: dt*/dp = −λᵀ C_p / λᵀ C_t, where λᵀ C_q = 0. The toggle is
        the last of `error.motion.singular_positions` of a run that has ended there.   [s a unit of p]

        Raises an error by name: a change point, a redundant mechanism, several parts that are singular at once.
        """
        order = list(names)
        return dict(zip(order, _native.toggle_by(self._native, json.dumps(toggle), order)))

    def tolerance(self, motion: Motion, what: Measure, of: Optional[Of] = None) -> Tolerance:
        """How far a measure of a motion may be off by the tolerances of dimensions: at the time at which that is worst, or of one
        number that it has: its value at a time, an extreme of `system.extremes`, wherever in time that moves, "max", "min" or
        "stroke".

        Raises `kin.DimensionError` where no dimension has a tolerance.
        """
        found = _native.tolerance(self._native, motion._native, self._measured(what), _of(of), False)
        return Tolerance._of(found)

    def tolerance_proved(self, motion: Motion, what: Measure, of: Of) -> Tolerance:
        """The same with bounds, by interval arithmetic, that hold for every mechanism within the tolerances (`.proved`).

        Raises `kin.CannotBeProved` where some of these may not be assembled, and of what no bounds are known.
        """
        if of is None:
            raise TypeError('`of` says what is proved: a time, an extreme, "max", "min" or "stroke"')
        found = _native.tolerance(self._native, motion._native, self._measured(what), _of(of), True)
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
        """The same number in many mechanisms whose dimensions are off at random, each by its own distribution, else by this one:
        "normal", "truncated normal" or "uniform". The same seed gives the same samples, on every machine."""
        found = _native.samples(
            self._native, motion._native, self._measured(what), _of(of), count, seed, distribution
        )
        text, name, unit, values = found
        return Samples(name, unit, array(values), count, seed, text)

    def forces(
        self, motion: Motion, sharing: Union[str, Iterable[str], None] = None, *, engine: str = "auto"
    ) -> Forces:
        """The forces of a motion of this system: masses are given by `m.mass` or `m.solid`, weight by `m.gravity`. Of redundant
        constraints `sharing` says how they share what no balance decides: "least norm", or the names of equations that hold
        nothing; without it no number is given for what is not unique. `engine` is "step-by-step", "compiled", by one
        program over several times at once, or "auto", by that where it pays; their numbers differ in the last digits.

        Raises an error by name: nothing has mass and nothing acts, a motion of another system, a singular position; with
        "compiled" also what stands in the way of a program.
        """
        return Forces(self._native, motion, self._token, self.name, sharing, engine)

    def gradient(self, motion: Motion, names: Sequence[str], what: Measure, weights: Any) -> Any:
        """The derivatives by parameters of one number, whose derivatives by a measure, its rate and its second rate at
        each time are the rows of `weights`."""
        rows = np.zeros((len(motion), 3))
        given = np.asarray(weights, dtype=float)
        rows[:, : 1 if given.ndim == 1 else given.shape[1]] = given.reshape(len(motion), -1)
        found = _native.gradient(self._native, motion._native, list(names), self._measured(what), as_bytes(rows))
        return np.array(found)

    def objective(
        self,
        names: Sequence[str],
        times: Any,
        what: Measure,
        cost: Callable[[Quantity], tuple[float, Any]],
        **options: Any,
    ) -> Callable[[Any], tuple[float, Any]]:
        """A function of parameters with its exact gradient, as `scipy.optimize.minimize(…, jac=True)` takes one.

        `cost` makes of a measure over the motion the number, and its derivatives by the values of the measure (a row, or
        three columns with those by its rate and second rate). The function works on a copy of the system.
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

    def _measured(self, what: Measure) -> Any:
        """A measure as the native part takes it: a name, or a function of its motion."""
        if not callable(what):
            return self._what(what)
        return lambda native: orders_of(what(Motion(native)))

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
    """Numbers of any array, list or iterable, as the native part reads them."""
    if type(numbers) is np.ndarray and numbers.dtype == np.float64:
        return numbers.tobytes()
    if isinstance(numbers, (range, map, filter)) or hasattr(numbers, "__next__"):
        numbers = list(numbers)
    found = np.asarray(numbers)
    if found.dtype.kind not in "iufb" or found.dtype.kind == "b":
        raise TypeError(f"numbers are needed, not {type(numbers).__name__} of {found.dtype}")
    return np.ascontiguousarray(found, dtype=np.float64).ravel().tobytes()
