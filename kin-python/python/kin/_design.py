"""Computes derivatives of a motion by parameters, and the effect of tolerances of dimensions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional, TypeVar, Union

import numpy as np

from . import _native
from ._mistakes import values
from ._names import Named
from ._motion import Motion, Quantity, array
from ._short import short

if TYPE_CHECKING:
    from ._system import Measure

T = TypeVar("T")


@short
@dataclass(frozen=True)
class Extreme:
    """A time at which a measure has an extreme."""

    t: float
    value: float
    is_max: bool = True


@short
@dataclass(frozen=True)
class Extremes:
    """The extremes of a measure over a motion. Kin solves the pose at each extreme, so times have the accuracy of the
    solver.
    """

    name: str
    unit: str
    all: list[Extreme]
    stroke: float
    time_ratio: Optional[float]
    min: Extreme
    max: Extreme


# A number of a measure over a motion: its value at a time, an extreme, "max", "min" or "stroke".
Of = Union[float, str, Extreme]


def _of(of: Any) -> Any:
    """The same as the native part takes it."""
    if isinstance(of, Extreme):
        return (of.t, of.value, of.is_max)
    if isinstance(of, str) and of not in ("max", "min", "stroke"):
        raise ValueError(f'`of` is a time, an extreme, "max", "min" or "stroke", not {of!r}')
    return of


@short
@dataclass(frozen=True)
class Sensitivity:
    """∂q/∂p, ∂q̇/∂p and ∂q̈/∂p by one parameter p: a row for each time, a column for each coordinate."""

    name: str
    q: Any
    qd: Any
    qdd: Any


@short
@dataclass(frozen=True)
class ExtremeSensitivity:
    """The derivatives of the time and the value of an extreme of a measure by a parameter. [s, unit of the measure, per
    unit of p]
    """

    name: str
    t: float
    value: float


class Sensitivities:
    """The exact derivatives of a motion by parameters and dimensions, from `system.sensitivities`."""

    def __init__(
        self, system: "_native.System", motion: Motion, names: list[str], measured: Callable[[Measure], Any]
    ) -> None:
        self._native = _native.Derivatives(system, motion._native, names)
        self._measured = measured
        #: The motion that they belong to.
        self.motion = motion

    @staticmethod
    def _by(found: Mapping[str, T]) -> dict[str, T]:
        """By each parameter that the derivatives were requested for."""
        return Named("parameter of the derivatives", found)

    def all(self) -> dict[str, Sensitivity]:
        """Returns the derivatives of all coordinates by each parameter."""
        n = len(self.motion.names)
        found = self._native.all()
        return self._by({name: Sensitivity(name, *(array(one, n) for one in lists)) for name, lists in found})

    def of(self, what: Measure) -> dict[str, Quantity]:
        """Returns the derivatives of a measure and its time derivatives by each parameter, at fixed times."""
        asked, times = self._measured(what), self.motion.times
        title = asked if isinstance(asked, str) else what(self.motion).name  # type: ignore[operator]
        found = self._native.of(asked)
        return self._by({name: Quantity._of((f"d {title} / d {name}", "", lists), times) for name, lists in found})

    def extreme(self, what: Measure, extreme: Extreme) -> dict[str, ExtremeSensitivity]:
        """Returns the derivatives of the time and the value of an extreme of a measure.

        The derivative of the time is dt/dp = −ẏ_p/ÿ, and the derivative of the value is y_p. The extreme is one of
        `system.extremes(motion, what)`.
        """
        found = self._native.extreme(self._measured(what), _of(extreme))
        return self._by({name: ExtremeSensitivity(name, *changes) for name, *changes in found})

    def between(
        self, what: Measure, first: Extreme, second: Extreme
    ) -> dict[str, ExtremeSensitivity]:
        """Returns the derivatives of the difference of two extremes, first minus second.

        The difference of the values is a stroke. The difference of the times is the time between dead centres.
        """
        found = self._native.extreme(self._measured(what), _of(first), _of(second))
        return self._by({name: ExtremeSensitivity(name, *changes) for name, *changes in found})


@short
@dataclass(frozen=True)
class Contribution:
    """The share of one dimension, or one clearance, in the deviation of a measure.

    s is the derivative of the measure, and ± T is the tolerance. `off` is s T, and `sigma` is |s| σ. `share` is the
    share in the worst case, and `share_of_variance` is the share in σ².
    """

    name: str
    unit: str
    distribution: str
    tolerance: float
    slope: float
    off: float
    sigma: float
    share: float
    share_of_variance: float


@short
@dataclass(frozen=True)
class SecondOrder:
    """The second-order term of a stack of tolerances. [unit of the measure]

    H contains the second derivatives by the dimensions in `names`. The other fields are the shift of the mean, and the
    standard deviation with the second-order term.
    """

    names: list[str]
    hessian: Any
    mean_shift: float
    sigma: float


@short
@dataclass(frozen=True)
class Proved:
    """Bounds over all mechanisms within the tolerances, by interval arithmetic. [unit of the measure]

    The bounds rely on the stated bounds of the listed user-defined laws.
    """

    low: float
    high: float
    trusted: list[str]


@short
@dataclass(frozen=True)
class Searched:
    """The points of the box of tolerances at which Kin computed the mechanism.

    `corners` is the number of corners, `all_corners` says whether these are all corners, and `inside` is the number of
    points on faces and inside the box. `lowest` and `highest` are the deviations of the dimensions at the smallest and
    the largest value; an empty list is the centre. `unassembled` is a point at which the mechanism cannot be assembled,
    or `None` if it can be assembled at all points.
    """

    corners: int
    all_corners: bool
    inside: int
    lowest: dict[str, float]
    highest: dict[str, float]
    unassembled: Optional[dict[str, float]]


@dataclass(frozen=True)
class Tolerance:
    """The deviation of a measure at one time, and the share of each dimension. `print` shows a table.

    `worst_case` is Σ |s| T, `rss` is √(Σ s² T²), and `sigma` is √(Σ s² σ²). `corners` are the smallest and the largest
    value at the worst points of the box of tolerances; both are `None` if the mechanism cannot be assembled at a tested
    point. `attained` is the largest deviation at these points, and `searched` describes the points. `misled` is the
    difference of the attained deviation from the linear stack, as a share of the stack, or `None` if it is unknown.
    `second_order` is the second-order term, and `proved` contains the bounds of `system.tolerance_proved`.
    """

    name: str
    unit: str
    t: float
    nominal: float
    worst_case: float
    rss: float
    sigma: float
    misled: Optional[float]
    attained: Optional[float]
    corners: tuple[Optional[float], Optional[float]]
    searched: Searched
    contributions: list[Contribution]
    second_order: Optional[SecondOrder]
    proved: Optional[Proved]
    text: str

    @staticmethod
    def _of(found: dict[str, Any]) -> "Tolerance":
        shares = [Contribution(*names, *values) for names, values in found.pop("contributions")]
        second, proved = found.pop("second_order"), found.pop("proved")
        counts, *places = found.pop("searched")
        if second is not None:
            names, hessian, shift, sigma = second
            second = SecondOrder(names, np.array(hessian), shift, sigma)
        return Tolerance(
            **found,
            contributions=shares,
            searched=Searched(*counts, *places),
            second_order=second,
            proved=None if proved is None else Proved(*proved),
        )

    def __str__(self) -> str:
        return self.text

    def to_pandas(self) -> Any:
        """Returns the contributions as a pandas DataFrame. The package pandas must be installed."""
        import pandas

        return pandas.DataFrame([vars(one) for one in self.contributions])


@values
@short
@dataclass(frozen=True)
class Samples:
    """A feature of a measure in many mechanisms with random deviations of their dimensions (Monte Carlo). [unit of the
    measure]

    `values` contains the values of the mechanisms that can be assembled, in increasing order. `print` shows mean, σ and
    quantiles.
    """

    name: str
    unit: str
    values: Any
    count: int
    seed: int
    text: str

    @property
    def missing(self) -> int:
        """The number of mechanisms that cannot be assembled."""
        return self.count - len(self.values)

    @property
    def share_missing(self) -> float:
        """The share of mechanisms that cannot be assembled. [-]"""
        return self.missing / self.count

    @property
    def mean(self) -> float:
        """The mean, or NaN if no mechanism can be assembled."""
        return float(np.mean(self.values)) if len(self.values) else float("nan")

    @property
    def sigma(self) -> float:
        """The standard deviation (by n − 1), or NaN if fewer than two mechanisms can be assembled."""
        return float(np.std(self.values, ddof=1)) if len(self.values) > 1 else float("nan")

    def quantile(self, p: float) -> float:
        """Returns the value below which a share p of the samples is, interpolated between two samples.

        The result is NaN if no mechanism can be assembled, or if p is not between 0 and 1.
        """
        inside = len(self.values) and 0.0 <= p <= 1.0
        return float(np.quantile(self.values, p)) if inside else float("nan")

    def __str__(self) -> str:
        return self.text


__all__ = [
    "Contribution", "Extreme", "ExtremeSensitivity", "Extremes", "Searched", "Of", "Proved", "Samples", "SecondOrder", "Sensitivities",
    "Sensitivity", "Tolerance",
]  # fmt: skip
