"""Reports mistakes in traced functions at the user's line."""

from __future__ import annotations

import ast
import contextlib
import functools
import linecache
import math
import opcode
import os
import re
import sys
import textwrap
import threading
from types import FrameType
from typing import Any, Iterator, NoReturn, Optional, TypeVar

from ._errors import ConstraintError

Place = tuple[str, int]
T = TypeVar("T")

# The functions of `math` and NumPy that Kin has, by its own names.
KINS = {
    "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2", "arcsinh": "asinh", "arccosh": "acosh",
    "arctanh": "atanh", "deg2rad": "radians", "rad2deg": "degrees", "pow": "power", "absolute": "fabs", "fmax": "maximum",
    "fmin": "minimum", "abs": "fabs",
}  # fmt: skip

CONDITION = "a condition on a coordinate: "


class _Open(threading.local):
    """The functions that are being traced, each inside of the one before."""

    def __init__(self) -> None:
        self.traces: list[Any] = []


OPEN = _Open()


@contextlib.contextmanager
def tracing(trace: Any, name: str, place: Place) -> Iterator[None]:
    """Guards a function while Kin traces it.

    If Kin refuses an operation, tracing fails even if the function catches the error, because without the refused
    operation the function would be different.
    """
    OPEN.traces.append(trace)
    try:
        yield
    except RecursionError:
        at(place, f"`{name}` calls itself without end. A condition on a coordinate cannot end it")
    except ConstraintError:
        raise
    except Exception as error:
        _caught(trace, name)
        _of_arrays(error, place)
        raise
    finally:
        OPEN.traces.pop()
    _caught(trace, name)


def _caught(trace: Any, name: str) -> None:
    """Raises the first error that the function has caught."""
    if trace.refused:
        first = trace.refused[0]
        text = f"{str(first).split(': ', 1)[1]}. `{name}` catches this error and would become another equation. Correct this line"
        raise _made((first.filename, first.lineno), text) from None


def _of_arrays(error: Exception, place: Place) -> None:
    """Tells a function of NumPy that meets plain numbers beside traced ones in an array."""
    found = re.search(r"type (\w+) which has no callable (\w+) method", str(error))
    if found:
        name, frame = found.group(2), error.__traceback__
        while frame is not None:
            code = frame.tb_frame.f_code
            place = (code.co_filename, frame.tb_lineno) if code.co_filename == place[0] else place
            frame = frame.tb_next
        kins = KINS.get(name, name)
        at(place, f"`np.{name}` of an array that mixes numbers and coordinates: write kin.{kins}(…) of the array")


def _made(place: Place, text: str) -> ConstraintError:
    error = ConstraintError(f"{os.path.basename(place[0])}:{place[1]}: {text}")
    error.filename, error.lineno = place
    return error


def at(place: Place, text: str) -> NoReturn:
    """Raises a `ConstraintError` that the traced function cannot suppress by catching it."""
    error = _made(place, text)
    if OPEN.traces:
        OPEN.traces[-1].refused.append(error)
    raise error from None


def as_plain(place: Place, text: str) -> NoReturn:
    """Raises a `ConstraintError` where a plain number would also fail, so that a function that catches the error
    behaves the same with both.
    """
    raise _made(place, text) from None


def key(place: Place) -> NoReturn:
    """Reports that the function uses a traced number as a key of a set or a dictionary."""
    for node in _around(place):
        if isinstance(node, ast.Compare) and isinstance(node.ops[0], (ast.In, ast.NotIn)):
            condition(place)
    at(place, "a coordinate or parameter cannot be a key of a set or a dictionary, because it has no value yet: "
              "compare it with each key, as in kin.where(x == key, a, b)")


def condition(place: Place, is_number: bool = False, is_moving: bool = True) -> NoReturn:
    """Reports that the function needs the truth of a traced condition or number; `is_moving` is true if it depends on
    coordinates.
    """
    for node in _around(place):
        if isinstance(node, (ast.If, ast.IfExp)):
            at(place, f"{CONDITION}write kin.where({_joined(node.test, is_number)}, a, b)")
        if isinstance(node, ast.While):
            at(place, f"{CONDITION}a loop cannot end by `{ast.unparse(node.test)}`. Give the loop a fixed count")
        if isinstance(node, ast.Assert):
            name = "branch" if is_moving else "require"
            at(place, f"{CONDITION}write kin.{name}({_joined(node.test, is_number)}, \"why\")")
        if isinstance(node, ast.Call):
            _of_call(place, node)
        if isinstance(node, ast.Compare) and len(node.ops) == 1 and not isinstance(node.ops[0], (ast.In, ast.NotIn)):
            at(place, f"{CONDITION}NumPy cannot compare an array of coordinates: compare each item, as in "
                      "[kin.where(one > 0, a, b) for one in array]")
        if isinstance(node, (ast.BoolOp, ast.Compare, ast.UnaryOp)):
            at(place, f"{CONDITION}write {_joined(node, is_number)}, and kin.where(condition, a, b) to choose by it")
    at(place, f"{CONDITION}write kin.where(condition, a, b)")


_COMPARING = {
    "max": "maximum", "min": "minimum", "maximum": "maximum", "minimum": "minimum", "fmax": "maximum", "fmin": "minimum",
    "amax": "maximum", "amin": "minimum", "clip": "clip", "sign": "sign",
}  # fmt: skip


def _of_call(place: Place, call: ast.Call) -> None:
    """Tells a call that compares: `max`, `min`, `np.max` and the like, `array.max()`."""
    function = ast.unparse(call.func)
    name = function.rsplit(".", 1)[-1]
    if name in ("sorted", "sort", "argmax", "argmin", "argsort"):
        at(place, f"{CONDITION}`{function}` compares, but the order is unknown here: choose with kin.where, kin.maximum and kin.minimum")
    if name not in _COMPARING or function.startswith("kin.") or call.keywords:
        return
    arguments = [ast.unparse(argument) for argument in call.args]
    if not arguments and isinstance(call.func, ast.Attribute):
        arguments = [ast.unparse(call.func.value)]
    if len(arguments) == 1 and _COMPARING[name] in ("maximum", "minimum") and not isinstance(call.args[:1] and call.args[0], ast.Starred):
        arguments = [f"*{arguments[0]}"]
    at(place, f"{CONDITION}`{function}` compares; write kin.{_COMPARING[name]}({', '.join(arguments)})")


def plain_number(place: Place) -> NoReturn:
    """Reports that the function needs a traced number as a plain number."""
    import kin

    calls = [node for node in _around(place) if isinstance(node, ast.Call)]
    for node in reversed(calls):  # the innermost first: only that one was given the number itself
        function = ast.unparse(node.func)
        home, _, name = function.rpartition(".")
        if home not in ("", "math", "cmath") or name in ("float", "complex") or (not home and not hasattr(math, name)):
            continue
        arguments = ", ".join(ast.unparse(argument) for argument in node.args)
        kins = KINS.get(name, name)
        what = f"`{function}` takes plain numbers only, and coordinates and parameters have no value yet: "
        if not hasattr(kin, kins):
            at(place, what + "it has no derivative here. Build it from the functions of `kin`")
        numpys = {name: numpys for numpys, name in KINS.items() if name.startswith("a")}.get(kins, kins)
        if name == "pow":
            numpys = "power"
        at(place, what + f"write kin.{kins}({arguments}) or np.{numpys}({arguments})")
    at(place, "a coordinate or parameter is no plain number here: use it directly, without float(…)")


def count(place: Place) -> NoReturn:
    """Reports that the function uses a traced number as a count."""
    at(
        place,
        "a coordinate or parameter cannot be a count or an index here: give the argument the type `int`, "
        "and Kin reads the function for each of its values. The whole part of a number is kin.trunc(x)",
    )


def _joined(test: ast.AST, is_number: bool = False) -> str:
    """A condition without `and`, `or`, `not`, `in` and chains, which ask for truth; `is_number` where it is a number, which is
    true unless it is zero."""
    if isinstance(test, ast.BoolOp):
        sign = " & " if isinstance(test.op, ast.And) else " | "
        return sign.join(f"({_joined(value, is_number)})" for value in test.values)
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return f"~({_joined(test.operand, is_number)})"
    if isinstance(test, ast.Compare) and len(test.ops) > 1:
        left = [test.left, *test.comparators[:-1]]
        parts = zip(left, test.ops, test.comparators)
        return " & ".join(f"({_joined(ast.Compare(a, [op], [b]))})" for a, op, b in parts)
    if isinstance(test, ast.Compare) and isinstance(test.ops[0], (ast.In, ast.NotIn)):
        return _among(test)
    if is_number and not isinstance(test, ast.Compare):
        text = ast.unparse(test)
        return f"{text} != 0" if isinstance(test, (ast.Name, ast.Attribute, ast.Call, ast.Subscript)) else f"({text}) != 0"
    return ast.unparse(test)


def _among(test: ast.Compare) -> str:
    """`x in [a, b]` as comparisons with each; of a list that is not written there with all of it."""
    is_in, items = isinstance(test.ops[0], ast.In), test.comparators[0]
    sign, joint = ("==", " | ") if is_in else ("!=", " & ")
    left = ast.unparse(test.left)
    left = left if isinstance(test.left, (ast.Name, ast.Attribute, ast.Call, ast.Subscript)) else f"({left})"
    if isinstance(items, (ast.List, ast.Tuple, ast.Set)) and items.elts:
        return joint.join(f"({left} {sign} {ast.unparse(one)})" for one in items.elts)
    name = "or_" if is_in else "and_"
    return f"functools.reduce(operator.{name}, [{left} {sign} one for one in {ast.unparse(items)}])"


def _around(place: Place) -> Iterator[ast.AST]:
    """The statements and expressions of a line that may be meant, the outermost first."""
    tree = _parsed(place)
    if tree is None:
        return
    module, line = tree
    wanted = (ast.If, ast.IfExp, ast.While, ast.Assert, ast.BoolOp, ast.UnaryOp, ast.Compare, ast.Call)
    found = []
    for node in ast.walk(module):
        if not isinstance(node, wanted):
            continue
        asked: Any = node.test if isinstance(node, (ast.If, ast.While)) else node
        if asked.lineno <= line <= (asked.end_lineno or asked.lineno):
            if isinstance(node, ast.UnaryOp) and not isinstance(node.op, ast.Not):
                continue
            found.append((asked.lineno, asked.col_offset, node))
    yield from (node for *_, node in sorted(found, key=lambda one: (-one[0], one[1])))


def _parsed(place: Place) -> Optional[tuple[ast.AST, int]]:
    """The program around a line, and the line's number in it."""
    name, line = place
    lines = linecache.getlines(name)
    try:
        return ast.parse("".join(lines)), line
    except (SyntaxError, ValueError):
        pass
    try:  # A line of an interactive program: alone, as a block of its own.
        text = textwrap.dedent(lines[line - 1]) if line <= len(lines) else ""
        return ast.parse(text + ("    pass" if text.rstrip().endswith(":") else "")), 1
    except (SyntaxError, ValueError):
        return None


class _Value(property):
    """A property that says so where it is called like a method."""

    _name = ""

    def __set_name__(self, owner: Any, name: str) -> None:
        self._name = name

    def __get__(self, obj: Any, owner: Any = None) -> Any:
        if obj is not None and _is_called(sys._getframe(1)):
            _called(self._name, sys._getframe(1))
        return super().__get__(obj, owner)


class _Cached(functools.cached_property):  # type: ignore[type-arg]
    """The same of a property that is computed once; only its first reader is looked at."""

    def __get__(self, obj: Any, owner: Any = None) -> Any:
        if obj is not None and _is_called(sys._getframe(1)):
            _called(self.attrname or "", sys._getframe(1))
        return super().__get__(obj, owner)


def values(kind: type[T]) -> type[T]:
    """A class whose properties name the mistake where they are called like methods, as in `m.ground()`."""
    for name, one in list(vars(kind).items()):
        if type(one) is property:
            made: Any = _Value(one.fget, one.fset, one.fdel, one.__doc__)
        elif type(one) is functools.cached_property:
            made = _Cached(one.func)
        else:
            continue
        made.__set_name__(kind, name)
        setattr(kind, name, made)
    return kind


_LOAD_METHOD, _LOAD_ATTR = opcode.opmap.get("LOAD_METHOD"), opcode.opmap.get("LOAD_ATTR")
# From 3.12 on both are one instruction, whose lowest bit tells them apart.
_ARE_ONE = sys.version_info >= (3, 12)


def _is_called(frame: FrameType) -> bool:
    """True where the program that reads an attribute calls what it reads at once."""
    code, at = frame.f_code.co_code, frame.f_lasti
    if not 0 <= at < len(code) - 1:
        return False
    return (code[at] == _LOAD_ATTR and bool(code[at + 1] & 1)) if _ARE_ONE else code[at] == _LOAD_METHOD


def _called(name: str, frame: FrameType) -> NoReturn:
    """A property was called like a method."""
    spelled = f".{name}"
    for node in _around((frame.f_code.co_filename, frame.f_lineno)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == name:
            spelled = ast.unparse(node.func)
    raise TypeError(f"`{name}` is a value and no method: write `{spelled}`, without brackets behind it") from None


def not_yet(what: str, name: str, later: "dict[type, str]") -> NoReturn:
    """Raises the error of an attribute that an object does not have, and names the later object that has it."""
    place = next((words for kind, words in later.items() if not name.startswith("_") and hasattr(kind, name)), None)
    hint = f". It belongs to {place}" if place else ""
    raise AttributeError(f"a {what} has no attribute `{name}`{hint}")
