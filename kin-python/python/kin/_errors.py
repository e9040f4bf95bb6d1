"""Errors in Kin's words. Each variant of Rust's `kin::Error` is a class of its own; its fields are attributes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Optional

if TYPE_CHECKING:
    from ._motion import Motion


class Error(Exception):
    """Anything that Kin refuses or cannot do.

    `motion` is what a failing run had computed before, `diagnosis` the verdict by name where there is one (as a
    dictionary); the fields of the error (`t`, `constraint`, `row`, …) are attributes.
    """

    motion: "Optional[Motion]" = None
    diagnosis: Optional[dict[str, Any]] = None

    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"{type(self).__name__} has no field `{name}`")

    def __reduce__(self) -> Any:
        return (_remade, (type(self), str(self), dict(self.__dict__)))


class ConstraintError(Error):
    """A mistake in a traced function, at a line of it: `filename`, `lineno`."""

    filename: str
    lineno: int


class CannotBeDriven(Error):
    """A mechanism that cannot be driven, whatever its pose."""


class NoConvergence(Error):
    """Newton's method did not reach C(q, t) = 0."""


class SingularAt(Error):
    """C_q has no inverse at a position."""


class Toggle(Error):
    """A toggle: no position exists beyond its time `t`."""


class CannotReach(Error):
    """A follower that stopped before the values it was given: `reached` holds the values of the drivers there, `asked` those it was
    given, by name."""


class CannotFollow(Error):
    """A step that may have left its branch, and cannot be made any shorter."""


class WrongBranch(Error):
    """A position that closes, but not as it is meant."""


class LawJumps(Error):
    """A law that jumps where it drives the motion."""


class NotFinite(Error):
    """A constraint gave a value or derivative that is infinite or not a number."""


class ParameterNotFinite(Error):
    """A parameter of a constraint is infinite or not a number."""


class InvalidParameters(Error):
    """Parameters that make no sense: a length below zero, an axis without direction."""


class InitialNotFinite(Error):
    """An initial or other value given for a coordinate is infinite or not a number."""


class InvalidLength(Error):
    """A link must have a length above zero."""


class ForeignBody(Error):
    """A body or coordinate of another mechanism."""


class RepeatedBody(Error):
    """The same body or coordinate twice in one constraint."""


class NoCoordinates(Error):
    """An equation left without coordinates, because all its bodies are the ground."""


class CannotBeProved(Error):
    """A motion that Kin cannot prove by interval bounds."""


class InvalidConstraint(Error):
    """A constraint that contradicts itself, or cannot do what a call requires."""


class DuplicateName(Error):
    """A name given twice."""


class EmptyName(Error):
    """A name that is empty."""


class UnknownName(Error):
    """An unknown name; `known` lists the known names."""


class InvalidTimes(Error):
    """Times that no run can follow."""


class InvalidOptions(Error):
    """An option out of its range."""


class NeedsMemory(Error):
    """Motions that take more memory than the option `memory` allows."""


class CaseNotFinite(Error):
    """A case of a sweep with a number that is infinite or not a number."""


class WrongLength(Error):
    """A list of the wrong length."""


class Stopped(Error):
    """A run or sweep that your code stopped."""


class Mismatch(Error):
    """Routes to a derivative that do not agree."""


class NoDerivative(Error):
    """A derivative by a parameter that does not exist, or is not known."""


class NotUnique(Error):
    """A force that redundant constraints share, so that it is not unique."""


class OtherMotion(Error):
    """A motion from before a change of the system: at `t` its `equation` is not satisfied."""


class Jammed(Error):
    """A mechanism that friction jams: no finite forces of its drives move it. `constraint` is the joint that jams, `t` the
    first such time, `share` the share of the friction that is enough, `drives` the drives that push."""


class Unbounded(Error):
    """Forces at a singular position, where they have no bound. `t` is its time; `growth` has the name of each constraint whose
    forces grow, with the power of |t − t*|."""


class OutputNotFinite(Error):
    """An output with a value that is infinite or not a number."""


class DimensionError(Error):
    """A named dimension that is invalid, unused, or belongs to another mechanism."""


class DataError(Error):
    """Something that cannot be written as data, or data that are invalid."""


class TableError(Error):
    """A table that cannot be read, or is no table of a law."""


class FileError(Error):
    """A file that cannot be written."""


def raised(kind: str, text: str, fields: str, motion: Any, diagnosis: Optional[str]) -> Error:
    """The exception of an error of Rust; its native motion becomes one of Python's."""
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
