"""What a system answers with: positions, assemblies, proofs, programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._short import short


@short
@dataclass(frozen=True)
class Solution:
    """Position, velocity and acceleration at one time."""

    t: float
    q: Any
    qd: Any
    qdd: Any
    iterations: int
    residual: float
    worst: str
    compiled: bool


@short
@dataclass(frozen=True)
class Assembly:
    """One way to put a mechanism together: its label, and its pose."""

    label: str
    q: Any


class Assemblies(list):  # type: ignore[type-arg]
    """The assemblies that were found, a list, and whether these are all: `complete` is `"proved"`, `"believed"` (more starts are not
    expected to lead to another one) or `"unknown"`, for this `reason`."""

    complete: str
    reason: str

    def __init__(self, found: Any, complete: str, reason: str) -> None:
        super().__init__(found)
        self.complete, self.reason = complete, reason


@short
@dataclass(frozen=True)
class StepProof:
    """One step of a motion that is proved, or not: `radius`, within which of the interpolated position there is a solution at every
    time, and `alone`, within which there is no other, a number a coordinate; else the `doubt`, and its time.   [m, rad, s]"""

    start: float
    end: float
    radius: Any
    alone: Any
    doubt: Optional[str]
    doubt_at: Optional[float]


@short
@dataclass(frozen=True)
class Proof:
    """What interval bounds show of a motion; `print` shows it in words."""

    text: str
    is_complete: bool
    steps: list[StepProof]
    #: Laws whose bounds are taken on their own word, each with its constraint.
    trusted: list[str]
    #: Of each position the distance from the solution beside it, for each coordinate; `None` where it is not known.
    errors: list[Any]

    @staticmethod
    def _of(found: Any) -> "Proof":
        text, is_complete, steps, trusted, errors = found
        told = []
        for start, end, tube, doubt in steps:
            radius, alone = (None, None) if tube is None else (np.array(one) for one in tube)
            at, why = (None, None) if doubt is None else doubt
            told.append(StepProof(start, end, radius, alone, why, at))
        return Proof(text, is_complete, told, trusted, [None if one is None else np.array(one) for one in errors])

    @property
    def proved(self) -> int:
        """How many steps were proved."""
        return sum(one.doubt is None for one in self.steps)

    @property
    def first_unproved(self) -> Optional[StepProof]:
        """The first step that was not proved."""
        return next((one for one in self.steps if one.doubt is not None), None)

    def __str__(self) -> str:
        return self.text


@short
@dataclass(frozen=True)
class Compiled:
    """The program of a system: coordinates that rows give (`substituted`), those that are left to Newton's method (`unknowns`), how
    many of these are solved together, block by block, and its number of `steps`. `print` shows it in words."""

    text: str
    substituted: list[str]
    unknowns: list[str]
    blocks: list[int]
    steps: int

    def __str__(self) -> str:
        return self.text


__all__ = ["Assemblies", "Assembly", "Compiled", "Proof", "Solution", "StepProof"]
