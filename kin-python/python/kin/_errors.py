"""Defines the exceptions of Kin.

Each variant of Rust's `kin::Error` is a separate class, with its fields as attributes.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

if TYPE_CHECKING:
    from ._motion import Motion


class Error(Exception):
    """The base class of all errors of Kin.

    `motion` is the motion that a run computed before it failed. `diagnosis` is the diagnosis as a dictionary, if the
    error has one. The fields of the error (`t`, `constraint`, `row`, …) are attributes.
    """

    motion: "Optional[Motion]" = None
    diagnosis: Optional[dict[str, Any]] = None

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"{type(self).__name__} has no field `{name}`")

    def __reduce__(self) -> Any:
        return (_remade, (type(self), str(self), dict(self.__dict__)))


class ConstraintError(Error):
    """A mistake in a traced function, with the attributes `filename` and `lineno` of the user's line."""

    filename: str
    lineno: int


class CannotBeDriven(Error):
    """The mechanism cannot be driven in any pose."""


class NoConvergence(Error):
    """Newton's method did not reach C(q, t) = 0."""


class SingularAt(Error):
    """C_q has no inverse at a position."""


class Toggle(Error):
    """The motion reaches a toggle: no position exists beyond the time `t`."""


class CannotReach(Error):
    """A follower that stopped before the values it was given: `reached` holds the values of the drivers there, `asked` those it was
    given, by name."""


class CannotFollow(Error):
    """A step may have left its branch, and Kin cannot make the step shorter."""


class WrongBranch(Error):
    """A position satisfies the equations but is on the wrong branch."""


class LawJumps(Error):
    """A discontinuous law drives the motion."""


class NotFinite(Error):
    """A constraint gave a value or derivative that is infinite or not a number."""


class ParameterNotFinite(Error):
    """A parameter of a constraint is infinite or not a number."""


class InvalidParameters(Error):
    """The parameters contradict the constraint: a negative length, an axis without direction."""


class InitialNotFinite(Error):
    """The program gives a coordinate an initial or other value that is infinite or not a number."""


class InvalidLength(Error):
    """The length of a link is not positive."""


class ForeignBody(Error):
    """A body or coordinate belongs to another mechanism."""


class RepeatedBody(Error):
    """A constraint contains the same body or coordinate twice."""


class NoCoordinates(Error):
    """An equation contains no coordinates, because all its bodies are the ground."""


class CannotBeProved(Error):
    """Kin cannot prove a motion by interval bounds."""


class CannotEmit(Error):
    """Kin cannot print a part of a mechanism as a file of C."""


class InvalidConstraint(Error):
    """A constraint contradicts itself, or does not implement a required method."""


class DuplicateName(Error):
    """Two things of a mechanism have the same name."""


class EmptyName(Error):
    """A name is empty."""


class UnknownName(Error, KeyError):
    """No thing has the requested name; `known` lists the known names. It is a `KeyError` too."""

    def __str__(self) -> str:
        # A `KeyError` shows its text in quotes.
        return Exception.__str__(self)


class InvalidTimes(Error):
    """The times of a run are not valid."""


class InvalidOptions(Error):
    """An option is out of its range."""


class NeedsMemory(Error):
    """Motions need more memory than the option `memory` allows."""


class CaseNotFinite(Error):
    """A case of a sweep contains a number that is infinite or not a number."""


class WrongLength(Error):
    """A list has the wrong length."""


class Stopped(Error):
    """The program stopped a run or sweep."""


class Mismatch(Error):
    """Two ways to compute a derivative disagree."""


class NoDerivative(Error):
    """Kin cannot differentiate by a parameter: the parameter does not exist, or its derivative is unknown."""


class NotUnique(Error):
    """A force is not unique, because redundant constraints share the force."""


class OtherMotion(Error):
    """A motion does not belong to the present system: at the time `t` its `equation` is not satisfied."""


class Jammed(Error):
    """Friction jams the mechanism: no finite forces of its drivers move it.

    `constraint` is the joint that jams, and `t` is the first such time. `share` is the share of the friction at which
    the mechanism jams. `drives` lists the drivers that work against the friction.
    """


class Unbounded(Error):
    """Forces have no bound at the singular position at the time `t`.

    `growth` lists each constraint whose forces grow, with the exponent of |t − t*|.
    """


class OutputNotFinite(Error):
    """An output contains a value that is infinite or not a number."""


class DimensionError(Error):
    """A named dimension is invalid, unused, or belongs to another mechanism."""


class DataError(Error):
    """Kin cannot write a value as data, or data are invalid."""


class TableError(Error):
    """Kin cannot read the table of a law."""


class FileError(Error):
    """Kin cannot write a file."""


def raised(kind: str, text: str, fields: str, motion: Any, diagnosis: Optional[str]) -> Error:
    """Converts an error of Rust to an exception; its native motion becomes a Python motion."""
    found = globals().get(kind, Error)
    error: Error = found(text) if isinstance(found, type) and issubclass(found, Error) else Error(text)
    error.__dict__.update(json.loads(fields))
    if motion is not None:
        from ._motion import Motion

        error.__dict__["motion"] = Motion(motion)
    if diagnosis is not None:
        error.__dict__["diagnosis"] = json.loads(diagnosis)
    return error


def _remade(kind: type[Error], text: str, fields: dict[str, Any]) -> Error:
    error = kind(text)
    error.__dict__.update(fields)
    return error


ALL = sorted(name for name, known in list(globals().items()) if isinstance(known, type) and issubclass(known, Error))
__all__ = ALL  # noqa: PLE0605
