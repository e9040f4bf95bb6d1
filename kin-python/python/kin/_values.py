"""Converts values of parameters for the native module: any list, tuple or array of the right shape."""

from __future__ import annotations

import inspect
import math
import threading
from typing import Any

import numpy as np

from ._dimension import Dimension, Frozen, valued, written
from ._errors import ParameterNotFinite
from ._law import Law
from ._vectors import Axis, EulerParameters

NUMBERS = {"f64": 1, "Vec2": 2, "Vec3": 3, "EulerParameters": 4, "Mat2": 4, "Mat3": 9}
NAMES = {"Vec2": ("x", "y"), "Vec3": ("x", "y", "z"), "EulerParameters": ("e0", "e1", "e2", "e3")}


def items(value: Any) -> list[Any]:
    """Returns all numbers of a number, a vector, a list or an array, including dimensions.

    Raises TypeError and ValueError as NumPy does.
    """
    if isinstance(value, Dimension):
        return [value]
    if isinstance(value, (str, bytes, bool)) or value is None:
        raise TypeError("numbers are needed")
    array = np.asarray(list(value) if hasattr(value, "_components") else value)
    if array.dtype == object:
        found = array.ravel().tolist()
        if all(isinstance(one, (Dimension, int, float, np.integer, np.floating)) and not isinstance(one, bool) for one in found):
            return [one if isinstance(one, Dimension) else float(one) for one in found]
    if array.dtype.kind not in "iuf":
        raise TypeError("numbers are needed")
    return [float(one) for one in array.astype(float).ravel()]


def flat(value: Any) -> list[float]:
    """Returns all numbers of a value, without following dimensions."""
    return [float(one) for one in items(value)]


class _Follows(threading.local):
    """Whether the measure that is called now is to follow dimensions: its derivatives by them, or its values where they are off."""

    dimensions = False


FOLLOWS = _Follows()

_WELD = (
    'Weld a body there, tip = m.planar("tip") and m.add("tip weld", kin.weld(tip, body, (0, 0), point, 0.0)), and measure its '
    "origin, motion.point(tip). In space the weld is kin.spatial.weld"
)


def local_of(call: str, local: Any) -> list[float]:
    """The numbers of a local position of a motion. Raises TypeError if the position depends on dimensions, because a motion would not follow them."""
    given = list(local) if isinstance(local, (tuple, list)) or hasattr(local, "_components") else []
    for one in given:
        if isinstance(one, Dimension):
            raise TypeError(f"`{call}` takes plain numbers, and this point is given by the dimension `{one.text}`. {_WELD}")
        if FOLLOWS.dimensions and isinstance(one, Frozen):
            raise TypeError(
                f"the measure does not follow the dimension `{one.text}`: `{call}` has its plain number, `.value`, and a part of "
                f"the derivative would be missing. {_WELD}"
            )
    return flat(local)


def numbers_of(place: str, mechanism: str, own: str, argument: Any, value: Any) -> Any:
    """Converts a parameter to numbers in order, with dimensions as texts, or to a law as JSON."""
    if argument.kind == "Law":
        return law_of(place, argument.name, value)._json(place, mechanism, own)
    if argument.kind == "Axis":
        return sum(axis_of(place, argument.name, value)._rows(), [])
    wanted = NUMBERS.get(argument.kind)
    try:
        found = [written(place, mechanism, own, one) for one in items(value)]
    except (TypeError, ValueError):
        found = None
    if wanted is not None:
        wanted *= argument.count or 1
    if found is None or (wanted is not None and len(found) != wanted):
        kind = "a number" if argument.kind == "f64" and argument.count is None else f"{argument.type}"
        raise TypeError(f"`{place}`: its parameter `{argument.name}` is {kind}, not {value!r}")
    return found


def law_of(place: str, name: str, value: Any) -> Law:
    """Returns a law; a number becomes a constant law."""
    if isinstance(value, Law):
        return value
    if isinstance(value, Dimension):
        return Law.constant(value)
    if isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool):
        finite(place, name, float(value))
        return Law.constant(float(value))
    if callable(value):
        from ._constraint import LawFunction, law

        made = value if isinstance(value, LawFunction) else law(value)
        if isinstance(made, LawFunction):
            if any(one.default is inspect.Parameter.empty for one in made.arguments):
                wanted = ", ".join(f"{one.name}=…" for one in made.arguments)
                raise TypeError(f"`{place}`: `{made.name}` has parameters: give it their values, {made.name}({wanted})")
            made = made()
        return made
    raise TypeError(f"`{place}`: its parameter `{name}` is a law, not {value!r}")


def axis_of(place: str, name: str, value: Any) -> Axis:
    """Returns an axis; for a direction Kin chooses f."""
    if isinstance(value, Axis):
        return value
    try:
        return Axis(flat(value))
    except (TypeError, ValueError):
        raise TypeError(f"`{place}`: its parameter `{name}` is an axis or a direction, not {value!r}") from None


def euler_of(value: Any) -> list[float]:
    """Returns four Euler parameters."""
    return flat(EulerParameters(*value))


def finite(place: str, name: str, number: Any) -> Any:
    """Returns the number or dimension.

    Raises `ParameterNotFinite` if the number is infinite or NaN.
    """
    value = valued(number)
    if math.isfinite(value):
        return number
    shown = "NaN" if math.isnan(value) else ("inf" if value > 0 else "-inf")
    error = ParameterNotFinite(f"`{place}` has {shown} as its parameter `{name}`. Give a finite number")
    error.__dict__.update(constraint=place, parameter=name)
    raise error
