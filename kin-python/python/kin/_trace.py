"""Records one call of a user's function with placeholders for its arguments, and writes the record in Kin's language.

Each operation is one node: its template, the type of its value, and the nodes of its operands. The text uses `let` for
an expression that is long or occurs more than once.
"""

from __future__ import annotations

import math
import numbers
import re
from typing import Any, Optional

import numpy as np

from . import _mistakes
from ._dimension import Dimension
from ._errors import ConstraintError
from ._place import users_line
from ._scalars import Condition, Expr

# Text that stands without brackets as an operand or before a method.
_ATOM = "atom"
# An expression longer than this, or nested deeper, gets a name.
_LONGEST, _DEEPEST = 90, 5
# Nodes of one function at most; Kin's own limits of the text are told by Kin.
_MOST = 200_000


class Trace:
    """The trace of one function."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.templates: list[str] = []
        self.types: list[str] = []
        self.operands: list[tuple[int, ...]] = []
        self.lines: list[tuple[str, int]] = []
        self.known: dict[tuple[Any, ...], int] = {}
        self.requirements: list[tuple[int, str]] = []
        self.branches: list[tuple[int, str]] = []
        self.measures: list[tuple[str, int, str]] = []
        # What was refused while the function ran, whether or not the function let the error pass.
        self.refused: list[ConstraintError] = []
        self.over = False
        # Names, as the text has them, of the arguments that change in a motion.
        self.moving: set[str] = set()

    def op(self, template: str, kind: str, *operands: int) -> int:
        """Returns the node of an operation."""
        key = (template, kind, operands)
        known = self.known.get(key)
        if known is not None:
            return known
        if self.over:
            _mistakes.at(users_line(), f"a number of `{self.name}` is used after its function has ended")
        if len(self.templates) >= _MOST:
            _mistakes.at(users_line(), f"`{self.name}` has more than {_MOST} operations")
        self.templates.append(template)
        self.types.append(kind)
        self.operands.append(operands)
        self.lines.append(users_line())
        self.known[key] = len(self.templates) - 1
        return len(self.templates) - 1

    def atom(self, text: str, kind: str) -> int:
        """Returns the node of a name."""
        return self.op(text.replace("{", "{{").replace("}", "}}"), kind)

    def number(self, value: Any) -> Optional[int]:
        """Returns the node of a number, plain or traced; `None` for any other value."""
        if isinstance(value, Expr):
            if value._trace is not self:
                _mistakes.at(users_line(), f"a number of another constraint, `{value._trace.name}`, is used here")
            return value._node
        if isinstance(value, np.ndarray) and value.ndim == 0:
            value = value.item()
            if isinstance(value, Expr):
                return self.number(value)
        if isinstance(value, Dimension):
            text = f"the dimension `{value.text}` belongs to a mechanism, not to an equation. Give `{self.name}` an argument for it"
            _mistakes.at(users_line(), text)
        if isinstance(value, (complex, np.complexfloating)):
            _mistakes.at(users_line(), f"{value!r} is a complex number; equations are made of real ones")
        if isinstance(value, (numbers.Real, np.integer, np.floating)) and not isinstance(value, np.timedelta64):
            return self.atom(self._literal(float(value)), "f64")
        return None

    def _literal(self, value: float) -> str:
        if not math.isfinite(value):
            _mistakes.at(users_line(), f"a number of the function is {value}. Constants must be finite")
        text = repr(abs(value))
        return f"(-{text})" if math.copysign(1.0, value) < 0.0 else text

    def expression(self, value: Any) -> Expr:
        """Returns a number of this trace."""
        node = self.number(value)
        if node is None:
            _mistakes.at(users_line(), f"{value!r} is no number")
        return Expr(self, node)

    def both(self, sign: str, a: Condition, b: Any) -> Condition:
        """Combines two conditions to one."""
        if isinstance(b, (bool, np.bool_)):
            return a if bool(b) == (sign == "&&") else Condition(self, self.atom(str(bool(b)).lower(), "bool"))
        if not isinstance(b, Condition):
            _mistakes.at(users_line(), f"a condition is joined with another one, not with {b!r}")
        return Condition(self, self.op("{} " + sign + " {}", "bool", a._node, b._node))

    def is_moving(self, node: int) -> bool:
        """True if a node depends on bodies, coordinates, velocities or time."""
        open_nodes, seen = [node], {node}
        while open_nodes:
            one = open_nodes.pop()
            word = re.match(r"(?:r#)?\w+", self.templates[one])
            # A method of a body has its name in the template, beside its operands.
            if word is not None and word.group() in self.moving:
                return True
            fresh = set(self.operands[one]) - seen
            seen |= fresh
            open_nodes.extend(fresh)
        return False

    def inline(self, node: int) -> str:
        """Writes a node without names for its parts."""
        return _Printer(self, [node], inline=True).argument(node)

    def printed(self, results: list[int]) -> "_Printer":
        """Returns the statements of the function and its results."""
        return _Printer(self, results)


class _Printer:
    """The text of some nodes: `let` statements, with the user's line of each, and expressions made of their names."""

    def __init__(self, trace: Trace, results: list[int], inline: bool = False) -> None:
        self.trace = trace
        self.statements: list[str] = []
        self.places: list[tuple[str, int]] = []
        self.texts: dict[int, str] = {}
        self.depths: dict[int, int] = {}
        needed, uses = self._needed(results)
        for node in needed:
            text, depth = self._text(node)
            named = uses[node] > 1 or len(text) > _LONGEST or depth > _DEEPEST
            if named and trace.operands[node] and not inline:
                name = f"v{len(self.statements) + 1}"
                self.statements.append(f"let {name} = {text};")
                self.places.append(trace.lines[node])
                text, depth = name, 0
            self.texts[node], self.depths[node] = text, depth

    def _needed(self, results: list[int]) -> tuple[list[int], dict[int, int]]:
        """The nodes that the results are made of, in order, and how often each is used."""
        uses: dict[int, int] = {}
        open_nodes = list(results)
        for node in results:
            uses[node] = uses.get(node, 0) + 1
        seen = set(results)
        while open_nodes:
            for operand in self.trace.operands[open_nodes.pop()]:
                uses[operand] = uses.get(operand, 0) + 1
                if operand not in seen:
                    seen.add(operand)
                    open_nodes.append(operand)
        return sorted(seen), uses

    def _text(self, node: int) -> tuple[str, int]:
        operands = self.trace.operands[node]
        template = self.trace.templates[node]
        if not operands:
            return template.format(), 0
        parts = [_Part(self.texts[operand]) for operand in operands]
        return template.format(*parts), 1 + max(self.depths[operand] for operand in operands)

    def argument(self, node: int) -> str:
        """Returns a node in a place that needs no brackets."""
        return self.texts[node]


class _Part:
    """The text of an operand: in brackets where it is an operand of operators, `{:a}` for a bare one."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __format__(self, spec: str) -> str:
        if spec == "a" or _is_atom(self.text):
            return self.text
        return f"({self.text})"


def _is_atom(text: str) -> bool:
    """True of names, calls and numbers, and of what stands in brackets."""
    depth = 0
    for k, sign in enumerate(text):
        if sign in "([":
            depth += 1
        elif sign in ")]":
            depth -= 1
        elif depth == 0 and not (sign.isalnum() or sign in "._:#"):
            return False
        elif depth == 0 and sign == "." and text[:1].isdigit() and k + 1 < len(text) and text[k + 1].isalpha():
            return False
    return not text[:1].isdigit() or text.replace(".", "").isdigit()
