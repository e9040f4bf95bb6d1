"""Numbers and arrays of NumPy with everything of Kin that is traced or has a name: both sides, all operators."""

import operator

import numpy as np
import pytest

import kin
from kin import Coord, Planar, Vec2

SCALARS = [np.float16(3), np.float32(3), np.float64(3), np.longdouble(3), np.int8(3), np.int16(3), np.int32(3), np.int64(3),
           np.uint8(3), np.uint64(3), np.intp(3), np.bool_(True), np.array(3.0), np.array(3), np.array(3, dtype=object)]  # fmt: skip
OPERATORS = [operator.add, operator.sub, operator.mul, operator.truediv, operator.floordiv, operator.mod, operator.pow]
COMPARISONS = [operator.lt, operator.le, operator.gt, operator.ge, operator.eq, operator.ne]
X, Z, K = 0.7, 0.45, 1.3


def residual(function):
    """C of a function of x, z and k, by Kin and by the function itself."""
    traced = kin.constraint(function)
    m = kin.Mechanism("m")
    terms = m.terms(traced(m.length("x", X), m.length("z", Z), K), [X, Z], [0.0, 0.0])
    return terms.c, traced.plain(X, Z, K)


def agrees(body):
    """The rows of `body` by Kin are those of plain numbers; a traced `x` tells it which is asked for."""

    def f(x: Coord, z: Coord, k: float):
        return [z - x * k, *body(x, z, k)]

    mine, plain = residual(f)
    np.testing.assert_allclose(mine, np.array(plain, dtype=float), rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("scalar", SCALARS, ids=lambda one: f"{type(one).__name__}-{one.dtype}")
def test_scalars_of_numpy_before_and_after_a_traced_number(scalar):
    plain = scalar.item() if scalar.dtype != np.longdouble else float(scalar)
    # NumPy computes with plain numbers in the precision of the scalar, Kin always in double precision.
    given = lambda x: scalar if isinstance(x, Coord) else plain  # noqa: E731
    for act in OPERATORS:
        agrees(lambda x, z, k: [act(given(x), x) + z, act(x, given(x)) + z, act(k, given(x)) * x])
    for act in COMPARISONS:
        agrees(lambda x, z, k: [kin.where(act(given(x), x), z, x), kin.where(act(x, given(x)), z, x)])


@pytest.mark.parametrize("scalar", SCALARS, ids=lambda one: f"{type(one).__name__}-{one.dtype}")
def test_scalars_of_numpy_and_a_dimension(scalar):
    plain = float(scalar)
    a = kin.Mechanism("m").dimension("a", 1.5)
    if scalar.dtype == bool:
        with pytest.raises(TypeError):
            scalar * a
        return
    for act in OPERATORS:
        for left, right, value in ((scalar, a, act(plain, 1.5)), (a, scalar, act(1.5, plain))):
            made = act(left, right)
            assert isinstance(made, kin.Dimension) and made.value == pytest.approx(value, rel=1e-15)
    for act in COMPARISONS:
        assert bool(act(scalar, a)) == act(plain, 1.5) and bool(act(a, scalar)) == act(1.5, plain)


ARRAYS = [np.array([1.0, 2.0]), np.array([1, 2]), np.array([[1.0, 2.0], [3.0, 4.0]], dtype=np.float32), np.array([1.0, 2], dtype=object)]


@pytest.mark.parametrize("array", ARRAYS, ids=lambda one: f"{one.shape}-{one.dtype}")
def test_arrays_before_and_after_a_traced_number(array):
    given = lambda x: array if isinstance(x, Coord) else array.astype(float)  # noqa: E731
    for act in OPERATORS:
        agrees(lambda x, z, k: [(act(given(x), x) * z).sum(), (act(x, given(x)) * z).sum(), (given(x) * k * x).sum()])
    made = array * kin.Mechanism("m").dimension("a", 1.5)
    assert made.shape == array.shape and [one.value for one in made.ravel()] == [float(one) * 1.5 for one in array.ravel()]


def test_arrays_of_traced_numbers():
    matrix = np.array([[1.0, 2.0], [3.0, 4.0]])
    agrees(lambda x, z, k: list(matrix @ np.array([x, z])) + list(np.array([x, z]) @ matrix) + [np.array([x, z]) @ np.array([x, k])])
    agrees(lambda x, z, k: list(np.float64(2) * np.array([x, z]) + np.array([1.0, 2.0]) * x) + [np.dot(np.array([x, z]), [3.0, 4.0])])
    agrees(lambda x, z, k: list(np.sin(np.array([x, z]))) + list(kin.sin(np.array([x, z]))) + [np.array([x, z]).mean(), np.sum([x, z])])
    agrees(lambda x, z, k: list(kin.cos(np.array([1.0, x])) * z) + list(kin.maximum(np.array([0.5, 0.8]), x) * z))
    agrees(lambda x, z, k: [np.where(x > np.float64(0.5), np.float64(2) * z, x), *np.where(x > z, np.array([1.0, 2.0]), z)])


UNARY = [np.sin, np.cos, np.tan, np.arcsin, np.arccos, np.arctan, np.sinh, np.cosh, np.tanh, np.arcsinh, np.arctanh, np.exp, np.exp2,
         np.expm1, np.log, np.log1p, np.log2, np.log10, np.sqrt, np.cbrt, np.abs, np.fabs, np.floor, np.ceil, np.trunc, np.sign,
         np.square, np.reciprocal, np.negative, np.positive, np.deg2rad, np.rad2deg, np.radians, np.degrees, np.conjugate]  # fmt: skip
BINARY = [np.add, np.subtract, np.multiply, np.divide, np.floor_divide, np.remainder, np.mod, np.power, np.float_power, np.hypot,
          np.arctan2, np.maximum, np.minimum, np.fmax, np.fmin]  # fmt: skip


def test_functions_of_numpy():
    for function in UNARY:
        agrees(lambda x, z, k, f=function: [f(x) + z, f(k * 0.5) + x])
        assert function(kin.Mechanism("m").dimension("a", 0.5)).value == pytest.approx(float(function(0.5)), rel=1e-15)
    for function in BINARY:
        agrees(lambda x, z, k, f=function: [f(np.float64(2), x) + z, f(x, np.int32(2)) + z, f(x, z), f(np.array([2.0, 3.0]), x).sum()])
    agrees(lambda x, z, k: [*np.divmod(np.float64(2), x), *divmod(x, np.float64(0.3))])


def test_vectors_and_matrices():
    A, u = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([0.3, 0.4])

    @kin.constraint
    def f(i: Planar, j: Planar, v: Vec2):
        w = i.point(v)
        parts = [np.float64(2) * w, w * np.float64(2), w / np.int32(2), u + w, w + u, u - w, w - u, -w, A @ w, i.a() @ u, A @ i.a() @ w]
        return [*parts, u @ w, w @ u, np.dot(u, w), np.add(u, w), np.sin(w)[0], np.linalg.norm(w), j.theta - np.int32(5)]

    q, v = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], (0.7, 0.8)
    m = kin.Mechanism("m")
    mine = m.terms(f(m.planar("i"), m.planar("j"), v), q, [0.0] * 6).c
    np.testing.assert_allclose(mine, f.plain(Planar(*q[:3]), Planar(*q[3:]), kin.vec2(*v)), rtol=1e-14)


@pytest.mark.parametrize(
    "body, words",
    [
        (lambda x: np.heaviside(x, 0.5), "`np.heaviside` has no derivative here"),
        (lambda x: np.isfinite(x), "`np.isfinite` has no derivative here"),
        (lambda x: np.add.outer(np.ones(2), x), "as `.outer`, cannot be traced"),
        (lambda x: np.add(x, 1.0, out=np.zeros(1)), "writes into an array of plain numbers"),
        (lambda x: np.cos(np.array([1.0, x])), r"mixes numbers and coordinates: write kin.cos\(…\) of the array"),
        (lambda x: np.arcsin(np.array([0.5, x])), r"write kin.asin\(…\) of the array"),
        (lambda x: (np.array([x, 1.0]) > 0.5)[0], "compare each item"),
        (lambda x: x + 1j, "is a complex number"),
        (lambda x: np.complex128(1j) * x, "is a complex number"),
        (lambda x: np.vectorize(float)(np.array([x])), "is no plain number here"),
    ],
)
def test_what_numpy_cannot_do_is_told(body, words):
    with pytest.raises(kin.ConstraintError, match=words):

        @kin.constraint
        def f(x: Coord, z: Coord):
            return z - body(x)


@pytest.mark.parametrize("left, right", [(np.array([1.0, 2.0, 3.0]), 0), (np.str_("a"), 0), (0, np.datetime64("2020-01-01"))])
def test_what_is_no_number_is_a_type_error(left, right):
    v, a = kin.vec2(1, 2), kin.Mechanism("m").dimension("a", 1.0)
    for one in (v,) if isinstance(left, np.ndarray) else (v, a):
        with pytest.raises(TypeError):
            operator.add(left, one) if right == 0 else operator.add(one, right)


def test_complex_numbers_are_no_numbers_of_kin():
    """Their imaginary part is not forgotten."""
    z, m = np.complex128(1 + 1j), kin.Mechanism("m")
    a = m.dimension("a", 1.0)
    makes = [lambda: kin.Law.ramp(z), lambda: kin.Law.ramp(1.0) * z, lambda: z + kin.Law.ramp(1.0), lambda: a * z, lambda: z / a,
             lambda: a > z, lambda: kin.vec2(1, 2) * z, lambda: kin.vec2(z, 1.0), lambda: kin.drive(m.length("x", z), 0.0),
             lambda: m.add("d", kin.drive(m.length("y", 0.0), z)), lambda: kin.Law.ramp(1.0).at(z)]  # fmt: skip
    for make in makes:
        with pytest.raises((TypeError, kin.Error)):
            make()
