"""Mistakes in traced functions, told at the user's line and in the user's own words."""

from __future__ import annotations

import ast
import linecache
import os
import textwrap
from typing import Any, Iterator, NoReturn, Optional

from ._errors import ConstraintError

Place = tuple[str, int]

CONDITION = "a condition on a coordinate: "


def at(place: Place, text: str) -> NoReturn:
    """Raises a `ConstraintError` there."""
    error = ConstraintError(f"{os.path.basename(place[0])}:{place[1]}: {text}")
    error.filename, error.lineno = place
    raise error from None


def condition(place: Place) -> NoReturn:
    """A traced condition was asked for its truth."""
    for node in _around(place):
        if isinstance(node, (ast.If, ast.IfExp)):
            at(place, f"{CONDITION}write kin.where({_joined(node.test)}, a, b)")
        if isinstance(node, ast.While):
            at(place, f"{CONDITION}a loop cannot end by `{ast.unparse(node.test)}`; give it a count that is known")
        if isinstance(node, ast.Assert):
            at(place, f"{CONDITION}write kin.require({_joined(node.test)}, \"why\")")
        if isinstance(node, (ast.BoolOp, ast.Compare)) or isinstance(node, ast.UnaryOp):
            at(place, f"{CONDITION}write {_joined(node)}, and kin.where(condition, a, b) to choose by it")
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("max", "min"):
            better = "kin.maximum" if node.func.id == "max" else "kin.minimum"
            arguments = ", ".join(ast.unparse(argument) for argument in node.args)
            at(place, f"{CONDITION}`{node.func.id}` compares; write {better}({arguments})")
    at(place, f"{CONDITION}write kin.where(condition, a, b)")


def plain_number(place: Place) -> NoReturn:
    """A traced number was asked to be a plain one."""
    for node in _around(place):
        if isinstance(node, ast.Call):
            function = ast.unparse(node.func)
            name = function.rsplit(".", 1)[-1]
            if function != "float":
                arguments = ", ".join(ast.unparse(argument) for argument in node.args)
                renamed = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "pow": "power"}
                at(
                    place,
                    f"`{function}` takes plain numbers only, which coordinates and parameters are not here: "
                    f"write kin.{name}({arguments}) or np.{renamed.get(name, name)}({arguments})",
                )
    at(place, "a coordinate or parameter is no plain number here: use it as it is, without float(…)")


def count(place: Place) -> NoReturn:
    """A traced number was asked to be a count."""
    at(
        place,
        "a coordinate or parameter cannot be a count or an index here: give the argument the type `int`, "
        "and the function is read for each of its values",
    )


def _joined(test: ast.AST) -> str:
    """A condition without `and`, `or`, `not` and chains, which ask for truth."""
    if isinstance(test, ast.BoolOp):
        sign = " & " if isinstance(test.op, ast.And) else " | "
        return sign.join(f"({_joined(value)})" for value in test.values)
    if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        return f"~({_joined(test.operand)})"
    if isinstance(test, ast.Compare) and len(test.ops) > 1:
        left = [test.left, *test.comparators[:-1]]
        parts = zip(left, test.ops, test.comparators)
        return " & ".join(f"({ast.unparse(ast.Compare(a, [op], [b]))})" for a, op, b in parts)
    return ast.unparse(test)


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
