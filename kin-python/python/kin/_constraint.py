"""Defines `@kin.constraint`, which traces a Python function C(q, t) once and writes it as an equation in Kin's
language.
"""

from __future__ import annotations

import contextlib
import functools
import inspect
import re
import textwrap
import typing
from dataclasses import dataclass
from typing import Any, Callable, NoReturn, Optional, Sequence, Union, overload

import numpy as np

from . import _mistakes, _native
from ._errors import ConstraintError
from ._handles import Coordinate, Handle
from ._joint import Joint
from ._law import Law
from ._library_names import LIBRARY, LOADS
from ._place import users_line
from ._scalars import Condition, Expr
from ._states import Coord, Planar, Rate, Spatial, Time, TracedLaw
from ._trace import Trace
from ._values import NAMES, finite, items, law_of, numbers_of
from ._vectors import Axis, EulerParameters, Mat2, Mat3, Vec2, Vec3, _Components

_VALUES: dict[Any, str] = {
    float: "f64",
    Vec2: "Vec2",
    Vec3: "Vec3",
    EulerParameters: "EulerParameters",
    Mat2: "Mat2",
    Mat3: "Mat3",
    Axis: "Axis",
    Law: "Law",
}
_BODIES: dict[Any, str] = {Planar: "Planar", Spatial: "Spatial", Coord: "Coord"}
_COUNTS = (int, bool, str)
# Words of Rust that a name of Python can be.
_RUST = set("abstract become box const crate do dyn enum extern final fn impl let loop macro match mod move mut override "
            "priv pub ref self static struct super trait type typeof unsafe unsized use virtual where gen".split())  # fmt: skip


@dataclass(frozen=True)
class Argument:
    """An argument of a traced function: its name, its type in Kin's language, and its count if it is a list."""

    name: str
    kind: str
    count: Optional[int] = None
    default: Any = inspect.Parameter.empty

    @property
    def is_body(self) -> bool:
        """True for bodies and coordinates."""
        return self.kind in _BODIES.values()

    @property
    def written(self) -> str:
        """The name of the argument in the text."""
        return f"r#{self.name}" if self.name in _RUST else self.name

    @property
    def type(self) -> str:
        """The type of the argument in the text."""
        return self.kind if self.count is None else f"[{self.kind}; {self.count}]"


@dataclass(frozen=True)
class Constraint:
    """An equation on bodies, with its parameters, for `m.add(name, …)`."""

    equation: "Equation"
    bodies: tuple[Union[Handle, Coordinate], ...]
    parameters: dict[str, Any]

    def _joint(self) -> Joint:
        """The same as a joint of that kind."""
        kinds = [(one.name, one.kind) for one in self.equation.arguments if one.is_body for _ in range(one.count or 1)]
        bodies = tuple((name, kind, body) for (name, kind), body in zip(kinds, self.bodies))
        types = {one.name: one.type for one in self.equation.arguments}
        return Joint(self.equation.name, bodies, tuple((name, types[name], value) for name, value in self.parameters.items()))

    def __repr__(self) -> str:
        return f"{self.equation.name}(…)"


class Equation:
    """An equation C(q, t) = 0 that Kin has read. Call it with bodies and parameters to create a constraint."""

    def __init__(self, text: str, arguments: Sequence[Argument], native: "_native.Equation") -> None:
        self.text, self.arguments, self._native = text, tuple(arguments), native
        self.name = native.name()

    def __call__(self, *args: Any, **keywords: Any) -> Constraint:
        given = _bound(self.name, self.arguments, args, keywords)
        bodies: list[Any] = []
        parameters: dict[str, Any] = {}
        for argument in self.arguments:
            if argument.is_body:
                value = given[argument.name]
                bodies.extend([value] if argument.count is None else value)
            elif argument.kind not in ("Time", "Rate"):
                parameters[argument.name] = given[argument.name]
        return Constraint(self, tuple(bodies), parameters)

    def __repr__(self) -> str:
        return f"<equation {self.name}({', '.join(one.name for one in self.arguments)})>"

    def __reduce__(self) -> Any:
        return (equation, (self.text,))


def _bound(
    name: str, arguments: Sequence[Argument], args: tuple[Any, ...], keywords: dict[str, Any]
) -> dict[str, Any]:
    """Values by names, as Python binds them; time and rates are not given."""
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    wanted = [
        inspect.Parameter(one.name, kind, default=one.default)
        for one in arguments
        if one.kind not in ("Time", "Rate")
    ]
    # A default before an argument without one is no signature of Python's; then all are asked for.
    try:
        signature = inspect.Signature(wanted)
    except ValueError:
        signature = inspect.Signature([one.replace(default=inspect.Parameter.empty) for one in wanted])
    try:
        bound = signature.bind(*args, **keywords)
    except TypeError as error:
        raise TypeError(f"{name}(): {error}; it takes {', '.join(str(one) for one in signature.parameters)}") from None
    bound.apply_defaults()
    return dict(bound.arguments)


class Traced:
    """A function under `@kin.constraint`. Call it with bodies and parameters to create a constraint.

    `function` is the Python function. `text` is its equation in Kin's language. `plain(…)` evaluates the function with
    states of plain numbers and returns the rows of C as a list.
    """

    #: What stands before the function in the text.
    _mark: tuple[str, ...] = ()

    def __init__(self, function: Callable[..., Any], name: Optional[str]) -> None:
        functools.update_wrapper(self, function)
        self.function = function
        self.name = name or function.__name__
        self._place = (function.__code__.co_filename, function.__code__.co_firstlineno)
        if not self.name.isidentifier():
            _mistakes.at(self._place, "a function of a constraint needs a name: write it with `def`")
        if self.name in LIBRARY or self.name in LOADS:
            what = "joint" if self.name in LIBRARY else "load"
            text = f"`{self.name}` is a {what} of the library: give your function another name"
            _mistakes.at(self._place, text)
        self._known: dict[tuple[Any, ...], Equation] = {}
        self._arguments = self._read_arguments()
        self._counts = [one.name for one in self._arguments if one.kind == "count"]
        if not self._counts:
            with contextlib.suppress(NameError):  # of a helper that stands further down: the first call tells
                self._traced({})

    def __call__(self, *args: Any, **keywords: Any) -> Any:
        return self._constraint(*args, **keywords)

    def _constraint(self, *args: Any, **keywords: Any) -> Constraint:
        given = _bound(self.name, self._arguments, args, keywords)
        counts = {name: given.pop(name) for name in self._counts}
        return self._traced(counts)(**given)

    def _read_arguments(self) -> list[Argument]:
        return _arguments(self.function, self._place)

    @property
    def text(self) -> str:
        """The equation in Kin's language."""
        return self._traced({}).text

    def _traced(self, counts: dict[str, Any]) -> Equation:
        key = tuple(counts.items())
        if key not in self._known:
            self._known[key] = _trace(self, counts)
        return self._known[key]

    def plain(self, *args: Any, **keywords: Any) -> list[float]:
        """Evaluates the Python function with plain numbers and returns the rows of C.

        The arguments are plain numbers and states, such as `kin.Planar(x, y, theta)`, and include the time.
        """
        return [float(one) for one in _flat(self.function(*args, **keywords), self._place)[0]]

    def __repr__(self) -> str:
        return f"<constraint {self.name}>"

    def __reduce__(self) -> str:
        return str(self.function.__qualname__)


@overload
def constraint(function: Callable[..., Any]) -> Traced: ...
@overload
def constraint(*, name: Optional[str] = None) -> Callable[[Callable[..., Any]], Traced]: ...
def constraint(function: Any = None, *, name: Optional[str] = None) -> Any:
    """Creates a constraint C(q, t) = 0 from a Python function that contains the equation.

    Kin calls the function once with placeholders for its arguments, which record the operations. From this record Kin
    derives the residual, C_q, C_t and Q_d. Annotations give the types of arguments: `kin.Planar`, `kin.Spatial`,
    `kin.Coord` and `kin.Time`. Parameters are `float` (the default), `kin.Vec2`, `kin.Vec3`, `kin.Axis`, `kin.Law`,
    `kin.EulerParameters` or matrices. `Annotated[Sequence[kin.Coord], 3]` gives three coordinates; the same form works
    for the other types. Kin knows the value of an argument of the type `int`, `bool` or `str` while it traces the
    function. The function returns a number, a vector, or a list of both; each number is one row.

    Raises `kin.ConstraintError` at the user's line.
    """
    if function is None:
        return lambda given: Traced(given, name)
    return Traced(function, name)


class LawFunction:
    """A function of one variable and parameters under `@kin.law`. Call it with the parameters to create a law."""

    def __init__(self, name: str, text: str, arguments: Sequence[Argument], place: tuple[str, int]) -> None:
        self.name, self.text, self.arguments = name, text, tuple(arguments)
        self._place = place

    def __call__(self, *args: Any, **keywords: Any) -> Law:
        given = _bound(self.name, self.arguments, args, keywords)
        numbers: dict[str, Any] = {}
        parts: dict[str, Any] = {}
        for argument in self.arguments:
            value = given[argument.name]
            if argument.kind == "Law":
                parts[argument.name] = law_of(self.name, argument.name, value)._data
            else:
                numbers.update(_numbers_of_law(self.name, argument, value))
        return _checked_law(self.name, self.text, numbers, parts, self._place)

    def __repr__(self) -> str:
        return f"<law {self.name}({', '.join(one.name for one in self.arguments)})>"


def _numbers_of_law(name: str, argument: Argument, value: Any) -> dict[str, Any]:
    """A parameter of a law as numbers with names."""
    found = items(value)
    names = NAMES.get(argument.kind)
    keys = [argument.name] if names is None else [f"{argument.name}.{one}" for one in names]
    if len(found) != len(keys):
        kind = "a number" if argument.kind == "f64" else argument.kind
        raise TypeError(f"`{name}`: its parameter `{argument.name}` is {kind}, not {value!r}")
    return {key: finite(name, key, one) for key, one in zip(keys, found)}


def _checked_law(
    name: str, text: str, numbers: dict[str, Any], parts: dict[str, Any], place: tuple[str, int]
) -> Law:
    """The law of a text, which is read now."""
    data: dict[str, Any] = {"kind": name, "text": text, "numbers": numbers}
    made = Law({**data, "parts": parts} if parts else data)
    try:
        made._native  # noqa: B018
    except ValueError as error:
        _mistakes.at(place, f"`{name}`: {error}")
    return made


def law(function: Callable[..., Any]) -> Any:
    """Creates a law f(x), with derivatives up to the third, from a Python function of one variable.

    Kin traces the function like a constraint. Kin reads constants of the surrounding program once, when it traces the
    function.

    A function with more than one argument has parameters: numbers, vectors (`u: kin.Vec2`) or laws (`inner: kin.Law`).
    Such a function becomes a function of the parameters that returns a law: `@kin.law def lift(phi, h): …`, then
    `lift(0.02)` or `lift(h=m.dimension("h", 0.02))`.

    Raises `kin.ConstraintError` at the user's line.
    """
    place = (function.__code__.co_filename, function.__code__.co_firstlineno)
    name = function.__name__ if function.__name__.isidentifier() else "law"
    variable, *parameters = _arguments_of_law(function, name, place)
    trace = Trace(name)
    stand_ins = [_stand_in(trace, one, one.written) for one in (variable, *parameters)]
    with _mistakes.tracing(trace, name, place):
        result = function(*stand_ins)
    rows, _ = _flat(result, place)
    if len(rows) != 1:
        _mistakes.at(place, f"a law gives one number, not {len(rows)}")
    if not isinstance(rows[0], Expr) and not parameters:
        return Law.constant(float(rows[0]))
    row = trace.expression(rows[0])
    trace.over = True
    text, places = _written(trace, name, [variable, *parameters], [row._node], [0], function.__doc__)
    last = places[-1] if places[-1][1] else place
    if parameters:
        return LawFunction(name, text, parameters, last)
    return _checked_law(name, text, {}, {}, last)


def _arguments_of_law(function: Callable[..., Any], name: str, place: tuple[str, int]) -> list[Argument]:
    """The variable of a law and its parameters."""
    hints = getattr(function, "__annotations__", {})
    with contextlib.suppress(NameError):
        hints = typing.get_type_hints(function)
    arguments: list[Argument] = []
    for one, parameter in inspect.signature(function).parameters.items():
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD, parameter.KEYWORD_ONLY):
            _mistakes.at(place, f"`{name}`: a law has a variable and named parameters, `{name}(x, h)`, not `{parameter}`")
        hint = hints.get(one, float)
        # The variable is the time of a driver, or the coordinate that a cam turns by.
        is_number = hint is Any or (not arguments and hint in (Coord, Time))
        kind = "f64" if is_number else next((kind for known, kind in _VALUES.items() if hint is known), None)
        if kind not in ("f64", "Vec2", "Vec3", "Law") or (not arguments and kind != "f64"):
            what = "its variable is a number" if not arguments else "parameters of laws are float, Vec2, Vec3 and Law"
            _mistakes.at(place, f"`{name}`: `{one}` is of the type {getattr(hint, '__name__', hint)}; {what}")
        arguments.append(Argument(one, kind, None, parameter.default))
    if not arguments:
        _mistakes.at(place, f"a law is a function of one variable; `{name}` has none")
    return arguments


def equation(text: str) -> Equation:
    """Reads an equation from text in Kin's language, `fn name(i: Planar, …, k: f64) -> f64 { … }`.

    Raises `kin.ConstraintError` with every mistake in the text, each with line, column and suggestion.
    """
    native, mistakes = _native.Equation.read(text)
    if native is None:
        told = "\n".join(f"{message}\n --> text:{line}:{column}\n{shown}" for message, line, column, shown in mistakes)
        error = ConstraintError(told.rstrip())
        error.filename, error.lineno = "text", mistakes[0][1]
        raise error
    return Equation(text, _read_signature(text, native.name()), native)


def _read_signature(text: str, name: str) -> list[Argument]:
    """The arguments of a text that has been read."""
    found = re.search(r"\bfn\s+(?:r#)?" + re.escape(name) + r"\s*(?:<[^>]*>)?\s*\(", text)
    assert found is not None
    depth, start, end = 1, found.end(), found.end()
    while depth:
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(text[end], 0)
        end += 1
    inside = re.sub(r"//[^\n]*", "", text[start : end - 1])
    parts = re.findall(r"([^:,\[\(]+):((?:[^,\[\(]|\[[^\]]*\]|\([^\)]*\))+)", inside)
    arguments = []
    for left, right in parts:
        several = re.fullmatch(r"\[\s*(Planar|Spatial|Coord)\s*;\s*(\d+)\s*\]", right.strip())
        kind, count = (several.group(1), int(several.group(2))) if several else (right.strip(), None)
        arguments.append(Argument(re.sub(r"^\s*(mut\s+)?(r#)?", "", left).strip(), kind.split("::")[-1], count))
    return arguments


def _arguments(
    function: Callable[..., Any], place: tuple[str, int], usual: Optional[dict[str, str]] = None
) -> list[Argument]:
    """The arguments of a function by their types; `usual` are kinds of those that have none."""
    try:
        hints = typing.get_type_hints(function, include_extras=True)
    except Exception as error:  # a name that does not exist, in any form that `eval` gives it
        _mistakes.at(place, f"the types of `{function.__name__}` cannot be read: {error}")
    arguments = []
    for name, parameter in inspect.signature(function).parameters.items():
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            text = f"`*{name}` has no fixed number of arguments: write `{name}: Annotated[Sequence[kin.Coord], 3]`"
            _mistakes.at(place, text)
        known = (usual or {}).get(name)
        kind, count = (known, None) if known else _kind(name, hints.get(name, float), place)
        arguments.append(Argument(name, kind, count, parameter.default))
    if not any(one.is_body for one in arguments):
        text = "a constraint acts on bodies or coordinates: give an argument the type kin.Planar, kin.Spatial or kin.Coord"
        _mistakes.at(place, text)
    return arguments


def _kind(name: str, hint: Any, place: tuple[str, int]) -> tuple[str, Optional[int]]:
    if typing.get_origin(hint) is typing.Annotated:
        inner, *extra = typing.get_args(hint)
        of = typing.get_args(inner)
        counts = [one for one in extra if isinstance(one, int) and one > 0]
        if of and counts:
            return _kind(name, of[0], place)[0], counts[0]
    for known, kind in [*_BODIES.items(), *_VALUES.items(), (Time, "Time"), (Rate, "Rate")]:
        if hint is known:
            return kind, None
    if hint in _COUNTS:
        return "count", None
    text = f"`{name}`: a constraint has no arguments of the type {getattr(hint, '__name__', hint)}. Use Planar, "
    text += "Spatial, Coord, Time, float, Vec2, Vec3, EulerParameters, Mat2, Mat3, Axis, Law, and int for counts"
    _mistakes.at(place, text)


def _stand_in(trace: Trace, argument: Argument, name: str) -> Any:
    """What a function is called with for an argument."""
    kind = argument.kind
    if kind == "Planar":
        return Planar._traced(trace, name)
    if kind == "Spatial":
        return Spatial._traced(trace, name)
    if kind == "Coord":
        return Coord(trace, trace.atom(name, "f64"))
    if kind in ("Time", "Rate"):
        return (Time if kind == "Time" else Rate)(trace, trace.atom(name, "f64"))
    if kind == "f64":
        return Expr(trace, trace.atom(name, "f64"))
    if kind == "Law":
        return TracedLaw(trace, name)
    if kind == "Axis":
        return Axis._traced(*(Vec3._of(trace, trace.atom(f"{name}.{part}", "Vec3")) for part in "hfg"))
    vector: Any = {"Vec2": Vec2, "Vec3": Vec3, "EulerParameters": EulerParameters, "Mat2": Mat2, "Mat3": Mat3}[kind]
    return vector._of(trace, trace.atom(name, kind))


def _trace(self: Traced, counts: dict[str, Any]) -> Equation:
    """Calls the function with stand-ins, and reads the text of what it did."""
    trace = Trace(self.name)
    given: dict[str, Any] = dict(counts)
    kept = [one for one in self._arguments if one.kind != "count"]
    trace.moving = {one.written for one in kept if one.is_body or one.kind in ("Time", "Rate")}
    for one in kept:
        if one.count is None:
            given[one.name] = _stand_in(trace, one, one.written)
        else:
            given[one.name] = [_stand_in(trace, one, f"{one.written}[{k}]") for k in range(one.count)]
    with _mistakes.tracing(trace, self.name, self._place):
        result = self.function(**given)
    rows, shape = _flat(result, self._place)
    nodes = [trace.number(row) for row in rows]
    trace.over = True
    name = self.name + "".join(f"_{re.sub(r'[^0-9a-zA-Z]', '_', str(value))}" for value in counts.values())
    known = [node for node in nodes if node is not None]
    text, places = _written(trace, name, kept, known, shape, self.__doc__, self._mark)
    native, mistakes = _native.Equation.read(text)
    if native is None:
        _told(self, text, places, mistakes)
    return Equation(text, kept, native)


def _flat(result: Any, place: tuple[str, int]) -> tuple[list[Any], list[int]]:
    """All rows, and how many each part of the result has; 0 is a number."""
    if isinstance(result, _Components):
        return list(result), [len(result)]
    if isinstance(result, np.ndarray) and result.ndim > 0:
        result = list(result.flat)
    if isinstance(result, (list, tuple)):
        if not result:
            _mistakes.at(place, "the function returns no rows: return a number, a vector or a list of them")
        parts = [_flat(one, place) for one in result]
        rows = [row for part, _ in parts for row in part]
        return rows, [count for _, shape in parts for count in shape]
    if isinstance(result, Condition):
        _mistakes.at(place, "the function returns a condition: return a number that has to be zero, a - b for a == b")
    if isinstance(result, (Expr, int, float, np.integer, np.floating, np.ndarray)) and not isinstance(result, bool):
        return [result], [0]
    told = "nothing" if result is None else f"`{result!r}`"
    _mistakes.at(place, f"the function returns {told}: return a number, a vector or a list of them, zero where it holds")


def _written(
    trace: Trace,
    name: str,
    arguments: list[Argument],
    rows: list[int],
    shape: list[int],
    doc: Optional[str],
    marks: Sequence[str] = (),
) -> tuple[str, list[tuple[str, int]]]:
    """The text of the function, and the user's line of each of its lines."""
    printed = trace.printed(rows)
    lines = [f"/// {line}".rstrip() for line in textwrap.dedent(doc or "").strip().splitlines()]
    lines += marks
    for node, why in trace.requirements:
        lines.append(f"#[require({trace.inline(node)}, {_quoted(why)})]")
    for node, why in trace.branches:
        lines.append(f"#[branch({trace.inline(node)}, {_quoted(why)})]")
    for measure, node, unit in trace.measures:
        lines.append(f"#[measure({measure} = {trace.inline(node)}, {_quoted(unit)})]")
    texts = [printed.argument(row) for row in rows]
    if shape == [0]:
        kind, result = "f64", texts[0]
    elif shape in ([2], [3]):
        kind, result = f"Vec{shape[0]}", f"Vec{shape[0]}::new({', '.join(texts)})"
    else:
        kind, result = f"[f64; {len(rows)}]", f"[{', '.join(texts)}]"
    signature = ", ".join(f"{one.written}: {one.type}" for one in arguments)
    first = len(lines)
    lines.append(f"fn {'r#' if name in _RUST else ''}{name}({signature}) -> {kind} {{")
    lines += [f"    {statement}" for statement in printed.statements]
    lines += [f"    {result}", "}"]
    before = [trace.lines[0] if trace.lines else ("?", 0)] * (first + 1)
    return "\n".join(lines), before + printed.places


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ") + '"'


def _told(self: Traced, text: str, places: list[tuple[str, int]], mistakes: list[tuple[str, int, int, str]]) -> NoReturn:
    """Mistakes of the text at the lines of the function that they come from."""
    message, line, _, shown = mistakes[0]
    place = places[line - 1] if line <= len(places) and places[line - 1][1] else self._place
    if place[0] != self._place[0]:
        place = self._place
    _mistakes.at(place, f"`{self.name}`: {message}" + (f"\n{shown}" if shown else ""))


def _innermost(what: str) -> Trace:
    if not _mistakes.OPEN.traces:
        raise ConstraintError(f"kin.{what} belongs inside of a function under @kin.constraint")
    found: Trace = _mistakes.OPEN.traces[-1]
    return found


def require(condition: Any, why: str) -> None:
    """States a condition on the parameters, inside a function under `@kin.constraint`.

    If the condition is false, a mechanism refuses the constraint with the given text.
    """
    if isinstance(condition, Condition):
        _innermost("require").requirements.append((condition._node, why))
    elif not condition:
        _mistakes.at(users_line(), why)


def branch(condition: Any, wrong: str) -> None:
    """States a condition that distinguishes the intended pose from its mirror image, if the equation cannot.

    `wrong` describes the mistake in a pose that violates the condition.
    """
    if not _mistakes.OPEN.traces and isinstance(condition, (bool, np.bool_)):
        return  # the function runs on plain numbers
    trace = _innermost("branch")
    if not isinstance(condition, Condition):
        _mistakes.at(users_line(), "`branch` needs a condition such as s.x > 0")
    trace.branches.append((condition._node, wrong))


def measure(name: str, value: Any, unit: str) -> None:
    """Defines a measure of the constraint by name, for `system.measure(motion, "slot.slide")`.

    Kin computes the derivatives of the measure.
    """
    if not _mistakes.OPEN.traces and isinstance(value, (int, float)):
        return  # the function runs on plain numbers
    trace = _innermost("measure")
    node = trace.number(value)
    if node is None or not name.isidentifier():
        _mistakes.at(users_line(), "a measure is a name and a number: kin.measure(\"slide\", s.x, \"m\")")
    trace.measures.append((name, node, unit))


def parameters_of(constraint: Constraint, mechanism: str, own: str) -> list[tuple[str, Any]]:
    """Converts the parameters for the native module: numbers in order, or laws."""
    of = {one.name: one for one in constraint.equation.arguments}
    name = constraint.equation.name
    return [(key, numbers_of(name, mechanism, own, of[key], value)) for key, value in constraint.parameters.items()]
