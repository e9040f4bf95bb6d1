"""Mistakes, each with the words that it is told in, at the user's line."""

import inspect
import math
from typing import Annotated, Sequence

import numpy as np
import pytest

import kin
from kin import Coord, Law, Planar, Spatial, Vec2

HERE = "test_mistakes.py"


def told(make):
    """The error of a function that makes a constraint, and the line at which it says to be."""
    with pytest.raises(kin.ConstraintError) as found:
        make()
    error = found.value
    assert error.filename.endswith(HERE)
    text = str(error)
    assert text.startswith(f"{HERE}:{error.lineno}: ")
    line = inspect.getsource(inspect.getmodule(told)).splitlines()[error.lineno - 1]
    return text.split(": ", 1)[1], line.strip()


def test_an_if():
    def make():
        @kin.constraint
        def f(i: Planar, j: Planar, u: Vec2):
            s = j.local(i.point(u))
            if s.x > 0:
                return s.y
            return s.y + s.x

    assert told(make) == ("a condition on a coordinate: write kin.where(s.x > 0, a, b)", "if s.x > 0:")


def test_a_conditional_expression():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return y - (x if x >= 2.0 * y else 0)

    assert told(make)[0] == "a condition on a coordinate: write kin.where(x >= 2.0 * y, a, b)"


def test_a_table_by_numpy():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return y - np.interp(x, [0, 1, 2], [0, 1, 4])

    assert told(make)[0].startswith("`np.interp` has corners. Give the function an argument")


def test_and():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return kin.where(x > 0 and not y > 1, x, y)

    assert told(make)[0].startswith("a condition on a coordinate: write (x > 0) & (~(y > 1)), and kin.where")


def test_a_chain_of_comparisons():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return kin.where(0 < x < 1, x, y)

    assert told(make)[0].startswith("a condition on a coordinate: write (0 < x) & (x < 1), and kin.where")


def test_a_while():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            while x > 1:
                x = x / 2
            return x - y

    message = "a condition on a coordinate: a loop cannot end by `x > 1`. Give the loop a fixed count"
    assert told(make) == (message, "while x > 1:")


def test_an_assert():
    def make():
        @kin.constraint
        def f(x: Coord, k: float):
            assert k > 0
            return x - k

    assert told(make)[0] == 'a condition on a coordinate: write kin.require(k > 0, "why")'


def test_max():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return max(x, y) - 1

    assert told(make)[0] == "a condition on a coordinate: `max` compares; write kin.maximum(x, y)"


def test_math_sin():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return math.sin(x + y)

    text, line = told(make)
    assert text.startswith("`math.sin` takes plain numbers only") and "write kin.sin(x + y) or np.sin(x + y)" in text
    assert line == "return math.sin(x + y)"


def test_math_atan2():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return math.atan2(y, x)

    assert "write kin.atan2(y, x) or np.arctan2(y, x)" in told(make)[0]


def test_range_of_a_parameter():
    def make():
        @kin.constraint
        def f(x: Coord, n: float):
            return sum(x for _ in range(n))

    assert "give the argument the type `int`" in told(make)[0]


def test_a_law_as_a_number():
    def make():
        @kin.constraint
        def f(x: Coord, profile: Law):
            return x - profile

    assert told(make)[0] == "`profile` is a Law: get a value with `profile.at(x)`"


def test_no_rows():
    def make():
        @kin.constraint
        def f(x: Coord):
            x - 1

    assert told(make)[0].startswith("the function returns nothing: return a number, a vector or a list of them")


def test_a_condition_as_a_result():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return x == y

    assert told(make)[0] == "the function returns a condition: return a number that has to be zero, a - b for a == b"


def test_no_body():
    def make():
        @kin.constraint
        def f(a: float, b: float):
            return a - b

    assert "give an argument the type kin.Planar, kin.Spatial or kin.Coord" in told(make)[0]


def test_another_type():
    def make():
        @kin.constraint
        def f(x: Coord, table: dict):
            return x

    assert told(make)[0].startswith("`table`: a constraint has no arguments of the type dict. Use Planar, Spatial")


def test_any_number_of_arguments():
    def make():
        @kin.constraint
        def f(*x: Coord):
            return sum(x)

    assert "write `x: Annotated[Sequence[kin.Coord], 3]`" in told(make)[0]


def test_a_vector_of_three_in_the_plane():
    def make():
        @kin.constraint
        def f(i: Planar):
            return i.point((1, 2, 3))

    assert told(make)[0] == "`i.point` takes a Vec2, not (1, 2, 3)"


def test_a_constant_that_is_not_finite():
    def make():
        @kin.constraint
        def f(x: Coord):
            return x - math.inf

    assert told(make)[0] == "a number of the function is inf. Constants must be finite"


def test_a_function_of_numpy_without_a_derivative():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            return np.nextafter(x, y)

    assert told(make)[0] == "`np.nextafter` has no derivative here. Use the functions of `kin`"


def test_numbers_of_another_function():
    kept = []

    @kin.constraint
    def first(x: Coord, y: Coord):
        kept.append(x)
        return x - y

    def make():
        @kin.constraint
        def second(x: Coord):
            return x - kept[0]

    assert told(make)[0] == "a number of another constraint, `first`, is used here"


def test_endless_recursion():
    def make():
        def g(x):
            return g(x + 1)

        @kin.constraint
        def f(x: Coord):
            return g(x)

    assert "`f` calls itself without end" in told(make)[0]


def test_a_name_of_the_library():
    def make():
        @kin.constraint
        def revolute(i: Planar, j: Planar):
            return i.r - j.r

    assert told(make)[0] == "`revolute` is a joint of the library: give your function another name"


def test_a_row_without_coordinates():
    def make():
        @kin.constraint
        def f(x: Coord, k: float):
            return x, k - 1

    assert told(make)[0].startswith("`f`: ")


def test_too_much_for_the_text():
    def make():
        @kin.constraint
        def f(x: Coord, y: Coord):
            value = x
            for k in range(20_000):
                value = np.sin(value * y + k)
            return value

    text, _ = told(make)
    assert text.startswith("`f`: ")


# What a mechanism refuses.


@kin.constraint
def slot(i: Planar, j: Planar, u_i: Vec2, k: float = 2.0):
    s = j.local(i.point(u_i))
    return s.y - k * s.x**2


@pytest.mark.parametrize(
    "make, error, words",
    [
        (lambda m, a, b: slot(a, b), TypeError, "missing a required argument: 'u_i'"),
        (lambda m, a, b: slot(a, b, (0, 0), 1.0, 2.0), TypeError, "too many positional arguments"),
        (lambda m, a, b: slot(a, 3, (0, 0)), TypeError, "its argument `j` is a planar body, not 3"),
        (lambda m, a, b: slot(a, m.spatial("s"), (0, 0)), TypeError, "its argument `j` is a planar body"),
        (lambda m, a, b: slot(a, b, (0, 0, 0)), TypeError, r"its parameter `u_i` is Vec2, not \(0, 0, 0\)"),
        (lambda m, a, b: slot(a, b, (0, 0), k="two"), TypeError, "its parameter `k` is a number, not 'two'"),
        (lambda m, a, b: slot(a, b, (0, 0), k=None), TypeError, "its parameter `k` is a number, not None"),
        (lambda m, a, b: slot(a, b, (0, math.nan)), kin.ParameterNotFinite, r"has NaN as its parameter `u_i.y`. Give a finite number"),
        (lambda m, a, b: slot(a, a, (0, 0)), kin.RepeatedBody, "has `a` twice, as `i` and as `j`"),
        (lambda m, a, b: slot(m.ground, m.ground, (0, 0)), kin.NoCoordinates, "depends on no coordinate"),
        (lambda m, a, b: slot(kin.Mechanism("n").planar("a"), b, (0, 0)), kin.ForeignBody, "cannot use `i`, which belongs to another mechanism"),
        (lambda m, a, b: slot, TypeError, "is no constraint"),
        (lambda m, a, b: kin.revolute(a, b, (0, 0), (math.inf, 0)), kin.ParameterNotFinite, "has inf as its parameter `u_j.x`"),
        (lambda m, a, b: kin.revolute(a, b, (0, 0), 3), TypeError, "`revolute`: its parameter `u_j` is Vec2"),
        (lambda m, a, b: kin.distance(a, b, (0, 0), (0, 0), -1.0), kin.InvalidParameters, "the length of the rod must be above zero"),
        (lambda m, a, b: kin.drive(a, 0.0), TypeError, "its argument `q` is a coordinate"),
        (lambda m, a, b: kin.drive(a.x, "fast"), TypeError, "its parameter `law` is a law, not 'fast'"),
        (lambda m, a, b: kin.drive(a.x, Law.ramp(math.nan)), ValueError, "`rate` is nan. Give a finite number"),
        (lambda m, a, b: kin.drive(a.x, Law.spline([0, 0], [1, 2])), ValueError, "spline"),
        (lambda m, a, b: kin.coupling(a.x, b.x, 0.0, 1.0, 0.0), kin.InvalidParameters, "the factors must not be zero"),
    ],
)
def test_what_is_refused(make, error, words):
    m = kin.Mechanism("m")
    a, b = m.planar("a"), m.planar("b")
    with pytest.raises(error, match=words):
        m.add("tested", make(m, a, b))


def test_require_and_measure_are_the_functions_own():
    @kin.constraint
    def rail(i: Planar, j: Planar, length: float):
        kin.require(length > 0, "a rail needs a length above zero")
        kin.measure("way", i.r.x - j.r.x, "m")
        kin.branch(i.r.x > j.r.x, "it stands on the other side")
        return i.r.y - j.r.y - length * np.sin(i.theta)

    m = kin.Mechanism("rail")
    a, b = m.planar("a", 1.0), m.planar("b")
    with pytest.raises(kin.InvalidParameters, match="a rail needs a length above zero"):
        m.add("rail", rail(a, b, -1.0))
    m.add("rail", rail(a, b, 1.0))
    m.add("still", kin.fixed(b, (0, 0), 0.0))
    m.add("way", kin.drive(a.x, Law.linear(1.0, 0.5)))
    m.add("turn", kin.drive_angle(a, Law.ramp(0.3)))
    system = m.build()
    motion = system.run(np.linspace(0, 1, 11))
    np.testing.assert_allclose(system.measure(motion, "rail.way").velocity, 0.5, atol=1e-13)
    with pytest.raises(kin.InvalidConstraint, match="`rail.wya` does not exist"):
        system.measure(motion, "rail.wya")


def test_text_tells_every_mistake():
    with pytest.raises(kin.ConstraintError) as found:
        kin.equation("fn f(i: Planar) -> f64 {\n    i.r.x + i.rr.y\n}")
    assert "text:2:" in str(found.value) and found.value.lineno == 2


def test_two_equations_of_one_name():
    def made(power):
        @kin.constraint
        def curve(x: Coord, y: Coord):
            return y - x**power

        return curve

    m = kin.Mechanism("two")
    x, y, z = m.length("x", 0.1), m.length("y", 0.1), m.length("z", 0.1)
    m.add("one", made(2)(x, y))
    m.add("two", made(3)(y, z))
    with pytest.raises(kin.DataError, match="there is another equation `curve`"):
        m.to_json()


def test_a_solitary_spatial_function_needs_what_it_says():
    @kin.constraint
    def f(b: Spatial, q: Annotated[Sequence[Coord], 2]):
        return b.r.x - q[0] * q[1]

    m = kin.Mechanism("m")
    body, x = m.spatial("b"), m.length("x", 1.0)
    with pytest.raises(TypeError, match="takes 3 bodies and coordinates, not 2"):
        m.add("f", f(body, [x]))
