"""How a motion changes with parameters, and what tolerances of dimensions make of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Optional, Union

import numpy as np

from . import _native
from ._motion import Motion, Quantity, array
from ._short import short

if TYPE_CHECKING:
    from ._system import Measure


@short
@dataclass(frozen=True)
class Extreme:
    """A place where a measure turns round."""

    t: float
    value: float
    is_max: bool = True


@short
@dataclass(frozen=True)
class Extremes:
    """The extremes of a measure over a motion, with times as exact as poses can be solved."""

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
    """∂q/∂p, ∂q̇/∂p and ∂q̈/∂p by one parameter: a row a time, a column a coordinate."""

    name: str
    q: Any
    qd: Any
    qdd: Any


@short
@dataclass(frozen=True)
class ExtremeSensitivity:
    """How the time and the value of an extreme of a measure change with a parameter.   [s, unit of the measure, a unit of p]"""

    name: str
    t: float
    value: float


class Sensitivities:
    """The derivatives of a motion by parameters and dimensions, exact; `system.sensitivities` gives them."""

    def __init__(
        self, system: "_native.System", motion: Motion, names: list[str], measured: Callable[[Measure], Any]
    ) -> None:
        self._native = _native.Derivatives(system, motion._native, names)
        self._measured = measured
        #: The motion that they belong to.
        self.motion = motion

    def all(self) -> dict[str, Sensitivity]:
        """Those of all coordinates, by each parameter."""
        n = len(self.motion.names)
        return {name: Sensitivity(name, *(array(one, n) for one in lists)) for name, lists in self._native.all()}

    def of(self, what: Measure) -> dict[str, Quantity]:
        """Those of a measure and its rates, by each parameter, at fixed times."""
        asked, times = self._measured(what), self.motion.times
        title = asked if isinstance(asked, str) else what(self.motion).name  # type: ignore[operator]
        found = self._native.of(asked)
        return {name: Quantity._of((f"d {title} / d {name}", "", lists), times) for name, lists in found}

    def extreme(self, what: Measure, extreme: Extreme) -> dict[str, ExtremeSensitivity]:
        """How time and value of an extreme of a measure change: dt/dp = −ẏ_p/ÿ, the value by y_p. The extreme is one of
        `system.extremes(motion, what)`."""
        found = self._native.extreme(self._measured(what), _of(extreme))
        return {name: ExtremeSensitivity(name, *values) for name, *values in found}

    def between(
        self, what: Measure, first: Extreme, second: Extreme
    ) -> dict[str, ExtremeSensitivity]:
        """How the difference of two extremes changes, the first less the second: of the values (a stroke), of the times
        (between dead centres)."""
        found = self._native.extreme(self._measured(what), _of(first), _of(second))
        return {name: ExtremeSensitivity(name, *values) for name, *values in found}


@short
@dataclass(frozen=True)
class Contribution:
    """The share that one dimension, or one clearance, has in a measure that is off: s the derivative, ± T the tolerance, `off` = s
    T, `sigma` = |s| σ; `share` of the worst case, `share_of_variance` of σ²."""

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
    """The second-order term of a stack of tolerances: H by the dimensions of `names`, how far it moves the mean, and the
    standard deviation with it.   [unit of the measure]"""

    names: list[str]
    hessian: Any
    mean_shift: float
    sigma: float


@short
@dataclass(frozen=True)
class Proved:
    """Bounds, by interval arithmetic, that no mechanism within the tolerances passes; laws that were taken on their own word.
    [unit of the measure]"""

    low: float
    high: float
    trusted: list[str]


@short
@dataclass(frozen=True)
class Searched:
    """Where in the box of tolerances the mechanism itself was looked at: how many `corners`, whether those are `all_corners`,
    how many places on faces and `inside`; by how much each dimension is off at the `lowest` and the `highest` value (empty: none),
    and at a place where the mechanism cannot be assembled (`unassembled`, `None` if it can wherever it was looked at)."""

    corners: int
    all_corners: bool
    inside: int
    lowest: dict[str, float]
    highest: dict[str, float]
    unassembled: Optional[dict[str, float]]


@dataclass(frozen=True)
class Tolerance:
    """How far a measure may be off at one time, and by which dimensions: `worst_case` Σ |s| T, `rss` √(Σ s² T²), `sigma` √(Σ s² σ²),
    the least and the largest value that the mechanism itself has at the worst `corners` and inside of the box (both `None` where a
    part of it cannot be assembled: then there is no worst case), how far off the one that is farther is (`attained`), where it was
    `searched`, how far the stack is `misled` (`None` where that cannot be said), the `second_order` term, and what is `proved`
    (`system.tolerance_proved`). `print` shows the table."""

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
        """The contributions as a pandas DataFrame, which has to be installed."""
        import pandas

        return pandas.DataFrame([vars(one) for one in self.contributions])


@short
@dataclass(frozen=True)
class Samples:
    """A number of a measure in many mechanisms whose dimensions are off at random (Monte Carlo): `values` of those that can be
    assembled, the smallest first. `print` shows mean, σ and quantiles.   [unit of the measure]"""

    name: str
    unit: str
    values: Any
    count: int
    seed: int
    text: str

    @property
    def missing(self) -> int:
        """How many cannot be assembled."""
        return self.count - len(self.values)

    @property
    def share_missing(self) -> float:
        """Their share of all.   [-]"""
        return self.missing / self.count

    @property
    def mean(self) -> float:
        """Mean; NaN if there are none."""
        return float(np.mean(self.values)) if len(self.values) else float("nan")

    @property
    def sigma(self) -> float:
        """Standard deviation, by n − 1; NaN if there are fewer than two."""
        return float(np.std(self.values, ddof=1)) if len(self.values) > 1 else float("nan")

    def quantile(self, p: float) -> float:
        """The value that a share p of them is below, interpolated between two; NaN if there are none, or p is not between 0 and
        1."""
        inside = len(self.values) and 0.0 <= p <= 1.0
        return float(np.quantile(self.values, p)) if inside else float("nan")

    def __str__(self) -> str:
        return self.text


__all__ = [
    "Contribution", "Extreme", "ExtremeSensitivity", "Extremes", "Searched", "Of", "Proved", "Samples", "SecondOrder", "Sensitivities",
    "Sensitivity", "Tolerance",
]  # fmt: skip
