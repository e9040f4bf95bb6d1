"""Defines the results of a system: positions, assemblies, proofs, programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._mistakes import values
from ._short import short


@short
@dataclass(frozen=True)
class Solution:
    """The position, velocity and acceleration at one time."""

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
    """One assembly of a mechanism: its label and its pose."""

    label: str
    q: Any


class Assemblies(list):  # type: ignore[type-arg]
    """The list of found assemblies.

    `complete` is `"proved"`, `"believed"` (Kin expects no other assembly from more starts) or `"unknown"`, and `reason`
    gives the reason.
    """

    complete: str
    reason: str

    def __init__(self, found: Any, complete: str, reason: str) -> None:
        super().__init__(found)
        self.complete, self.reason = complete, reason


@short
@dataclass(frozen=True)
class StepProof:
    """The proof of one step of a motion. [m, rad, s]

    If Kin proved the step, a solution exists within `radius` of the interpolated position at every time, and no other
    solution exists within `alone`; both have a number for each coordinate. Otherwise `doubt` is the obstacle, with its
    time.
    """

    start: float
    end: float
    radius: Any
    alone: Any
    doubt: Optional[str]
    doubt_at: Optional[float]


@values
@short
@dataclass(frozen=True)
class Proof:
    """The proof of a motion by interval bounds. `print` shows the result in words."""

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
        """The number of proved steps."""
        return sum(one.doubt is None for one in self.steps)

    @property
    def first_unproved(self) -> Optional[StepProof]:
        """The first step without a proof."""
        return next((one for one in self.steps if one.doubt is not None), None)

    def __str__(self) -> str:
        return self.text


@short
@dataclass(frozen=True)
class Compiled:
    """The compiled program of a system. `print` shows a summary.

    Rows determine the `substituted` coordinates, and Newton's method computes the `unknowns`. The other fields are the
    number of coordinates of each block, and the number of `steps` of the program.
    """

    text: str
    substituted: list[str]
    unknowns: list[str]
    blocks: list[int]
    steps: int

    def __str__(self) -> str:
        return self.text


__all__ = ["Assemblies", "Assembly", "Compiled", "Proof", "Solution", "StepProof"]
