"""Shortens the texts of results at the prompt to a few lines."""

from __future__ import annotations

import reprlib
from dataclasses import fields
from typing import Any, TypeVar

T = TypeVar("T")

_REPR = reprlib.Repr()
_REPR.maxlist = _REPR.maxtuple = _REPR.maxdict = 6
_REPR.maxstring = _REPR.maxother = 200
_REPR.maxlevel = 3


def shown(value: Any) -> str:
    """Returns the `repr` of a value, without the middle part if it is long."""
    return _REPR.repr(value)


def short(kind: type[T]) -> type[T]:
    """Makes a dataclass whose `repr` omits the middle of long fields; `str` and the fields contain everything."""

    def __repr__(self: Any) -> str:
        return f"{type(self).__name__}({', '.join(f'{one.name}={shown(getattr(self, one.name))}' for one in fields(self))})"

    kind.__repr__ = __repr__  # type: ignore[method-assign]
    return kind
