"""What a traced function refuses, it refuses for good: a function that catches the error would be another equation."""

import contextlib
import copy
import functools
import math

import numpy as np
import pytest

import kin
from kin import Coord


def by_if(x, z):
    try:
        if x > 0:
            return z - x
    except Exception:
        pass
    return z - 2 * x


def by_a_plain_function(x, z):
    try:
        y = math.sin(x)
    except Exception:
        y = 5.0
    return z - y


def by_suppress(x, z):
    y = 2 * x
    with contextlib.suppress(Exception):
        y = float(x)
    return z - y


def by_finally(x, z):
    def chosen():
        try:
            return math.sqrt(x)
        finally:
            return 3.0 * x  # noqa: B012  a return here swallows the error

    return z - chosen()


def by_a_generator(x, z):
    def parts():
        for one in (x, 2 * x):
            try:
                yield math.exp(one)
            except Exception:
                yield one

    return z - sum(parts())


class Swallowing:
    def __enter__(self):
        return self

    def __exit__(self, *_):
        return True


def by_a_context(x, z):
    y = x
    with Swallowing():
        y = int(x)
    return z - y


def by_bool(x, z):
    try:
        y = 1.0 if bool(x) else 2.0
    except BaseException:
        y = 3.0
    return z - y * x


def by_hasattr(x, z):
    return z - (x if hasattr(x, "is_integer") else 2 * x)


def by_getattr(x, z):
    return z - x * getattr(x, "as_integer_ratio", lambda: (1, 1))()[0]


def by_a_set(x, z):
    try:
        return z - (x if x in {0.7, 1.0} else 2 * x)
    except Exception:
        return z - 3 * x


def by_a_dictionary(x, z):
    with contextlib.suppress(Exception):
        return z - {0.7: 1.0}.get(x, 2.0) * x
    return z - x


def by_a_cache(x, z):
    kept = functools.lru_cache(lambda y: 2 * y)
    try:
        return z - kept(x)
    except Exception:
        return z - x


def by_complex(x, z):
    try:
        y = abs(x + 1j)
    except TypeError:
        y = x
    except Exception:
        y = 2 * x
    return z - y


def by_numpy(x, z):
    try:
        y = np.interp(x, [0, 1], [0, 1])
    except Exception:
        y = x
    return z - y


def by_an_array(x, z):
    try:
        y = np.array([x, x], dtype=float).sum()
    except Exception:
        y = x
    return z - y


def by_max(x, z):
    with contextlib.suppress(Exception):
        return z - max(x, 0.1)
    return z - x


def by_another_error(x, z):
    with contextlib.suppress(Exception):
        y = math.sin(x)
    return z - y  # the name has no value then


SWALLOWING = [by_if, by_a_plain_function, by_suppress, by_finally, by_a_generator, by_a_context, by_bool, by_hasattr, by_getattr,
              by_a_set, by_a_dictionary, by_a_cache, by_complex, by_numpy, by_an_array, by_max, by_another_error]  # fmt: skip


def typed(function):
    function.__annotations__ = {"x": Coord, "z": Coord}
    return function


@pytest.mark.parametrize("function", SWALLOWING, ids=lambda one: one.__name__)
def test_an_error_that_the_function_catches_fails_at_its_end(function):
    with pytest.raises(kin.ConstraintError) as found:
        kin.constraint(typed(function))
    first, last = function.__code__.co_firstlineno, function.__code__.co_firstlineno + 14
    assert first <= found.value.lineno <= last and found.value.filename == __file__
    if function not in (by_hasattr, by_getattr):  # these let the error pass
        assert f"`{function.__name__}` catches this error" in str(found.value)


def test_so_do_potentials_forces_and_laws():
    def energy(x: Coord):
        with contextlib.suppress(Exception):
            return math.cos(x)
        return x

    def force(x):
        with contextlib.suppress(Exception):
            return math.cos(x)
        return x

    for make in (kin.potential, kin.force, kin.law):
        with pytest.raises(kin.ConstraintError, match="catches this error"):
            make(energy if make is kin.potential else force)


def test_what_fails_with_plain_numbers_too_may_be_caught():
    """Such an error is the function's own: it does the same with plain numbers."""

    def one_or_all(x):
        try:
            return sum(x)
        except Exception:
            return x

    @kin.constraint
    def f(x: Coord, z: Coord):
        with contextlib.suppress(TypeError):
            len(3)
        with contextlib.suppress(TypeError):
            x + "a"
        with contextlib.suppress(AttributeError):
            x.name
        kept = {"x": x}
        assert not hasattr(x, "shape_of_it") and copy.copy([x])[0] is x and math.isclose(1.0, 1.0)
        return z - one_or_all(kept["x"]) - one_or_all([x, x])

    m = kin.Mechanism("m")
    assert m.terms(f(m.length("x", 0.7), m.length("z", 0.5)), [0.7, 0.5], [0.0, 0.0]).c == pytest.approx(0.5 - 3 * 0.7)


def test_an_inner_function_that_fails_is_its_own():
    """The function that is traced makes another one; its mistake is not this one's."""

    @kin.constraint
    def f(x: Coord, z: Coord):
        try:
            kin.law(lambda y: math.sin(y))
        except kin.ConstraintError:
            pass
        return z - x

    assert f.text
