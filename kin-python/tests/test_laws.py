"""Laws: every kind, and functions of one variable."""

import pickle

import numpy as np
import pytest

import kin
from kin import Law

TABLE = ([0.0, 0.5, 1.2, 2.0, 2.5], [0.0, 0.3, 0.1, 0.4, 0.0])
UP = Law.cycloidal(0.02, 1.0)
LAWS = [
    Law.constant(0.3), Law.ramp(2.0), Law.linear(0.1, 2.0), Law.polynomial([0.1, 0.2, -0.3, 0.4]), Law.harmonic(0.3, 0.1),
    Law.sine(0.3, 2.0, 0.1), Law.fourier(0.1, 2.0, [(0.1, 0.2), (0.3, 0.4)]), Law.harmonic_rise(0.3, 2.0), UP,
    Law.polynomial_345(0.3, 2.0), Law.polynomial_4567(0.3, 2.0), Law.modified_sine(0.3, 2.0), Law.modified_trapezoid(0.3, 2.0),
    Law.trapezoidal(1.0, 0.8, 1.5), Law.s_curve(1.0, 0.8, 1.5, 6.0), Law.spline(*TABLE), Law.spline(*TABLE, ends="periodic"),
    Law.quintic_spline(*TABLE, ends=(0.1, -0.1)), Law.sequence(0.0, [(1.0, UP), (0.5, Law.constant(0.02)), (1.0, 0.02 - UP)]),
    Law.sequence(0.0, [(1.0, UP), (1.0, 0.02 - UP)]).periodic(2.0), UP.compose(Law.sine(1.0, 1.0)), UP.shifted(0.3),
    UP + Law.ramp(1.0), UP * Law.ramp(1.0), 3.0 * UP, -UP, UP - 0.5,
]  # fmt: skip


@kin.law
def lift(phi):
    """A lift of 30 mm, from a function."""
    return 0.03 * (1 - kin.cos(phi)) ** 2 + np.exp(-phi * phi) * kin.where(phi > 1.0, 0.001, 0.001)


@pytest.mark.parametrize("law", [*LAWS, lift], ids=lambda law: str(law)[:24])
def test_derivatives_are_differences(law):
    x, h = np.array([0.137, 0.613, 1.371, 1.909]), 1e-4
    for lower, upper in ((law.at, law.slope), (law.slope, law.second), (law.second, law.third)):
        central = (lower(x + h) - lower(x - h)) / (2 * h)
        np.testing.assert_allclose(upper(x), central, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("law", [*LAWS, lift], ids=lambda law: str(law)[:24])
def test_a_law_pickles_and_drives(law):
    assert pickle.loads(pickle.dumps(law)) == law
    m = kin.Mechanism("driven")
    x = m.length("x", 0.0)
    m.add("motor", kin.drive(x, law))
    m = kin.Mechanism.from_json(m.to_json())
    times = np.linspace(0.11, 0.9, 9)
    motion = m.build().run(times)
    np.testing.assert_allclose(motion["x"].value, law.at(times), atol=1e-14)
    np.testing.assert_allclose(motion["x"].acceleration, law.second(times), atol=1e-12)


def test_a_function_of_python_drives_as_the_law_that_it_is():
    m = kin.Mechanism("cam")
    a, b = m.length("a", 0.0), m.length("b", 0.0)
    m.add("of the library", kin.drive(a, Law.sine(0.3, 2.0, 0.1)))
    m.add("of a function", kin.drive(b, lambda t: 0.3 * np.sin(2.0 * t + 0.1)))
    motion = m.build().run(np.linspace(0, 5, 51), jerk=True)
    for rows in (motion.q, motion.qd, motion.qdd, motion.qddd):
        np.testing.assert_allclose(rows[:, 0], rows[:, 1], atol=1e-13)


def test_what_a_function_of_python_drives_is_proved():
    """Its bounds between two times are known, so that a motion is proved as one of a law of the library is; and a limit
    that is passed between two times is seen."""
    m = kin.Mechanism("crank and rod")
    crank, rod = m.link("crank", 0.1), m.link("rod", 0.3)
    m.add("O", kin.revolute(crank, m.ground, crank.start, (0, 0)))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("slide", kin.point_on_line(rod, m.ground, rod.end, (0, 0), (1, 0)))
    m.add("motor", kin.drive_angle(crank, lambda t: 0.4 * np.sin(2.0 * t) ** 3 + t * np.exp(-t)))
    m.limit("crank.theta", -10.0, 0.5)
    system = m.build()
    motion = system.run(np.linspace(0, 3, 61))
    proof = system.prove(motion)
    assert proof.is_complete and proof.proved == len(proof.steps) == 60, str(proof)
    assert any(event.name == "crank.theta" for event in motion.events)


def test_mistakes_of_laws():
    with pytest.raises(kin.ConstraintError, match="a law is a function of one variable; `f` has none"):

        @kin.law
        def f():
            return 1.0

    with pytest.raises(kin.ConstraintError, match=r"write kin.where\(x > 1, a, b\)"):

        @kin.law
        def g(x):
            return 1.0 if x > 1 else 0.0

    assert kin.law(lambda x: 2.0).at(0.3) == 2.0


def test_arrays_become_splines():
    x = np.linspace(0, 2 * np.pi, 33)
    law = Law.quintic_spline(x, 0.3 + 0.1 * np.sin(x + 1) - 0.1 * np.sin(1), ends="periodic")
    assert abs(law.at(1.234) - (0.3 + 0.1 * np.sin(2.234) - 0.1 * np.sin(1))) < 1e-5
    with pytest.raises(ValueError, match="x has 3 numbers, y 2"):
        Law.spline([1, 2, 3], [1, 2])


def test_a_law_has_parameters():
    @kin.law
    def lift(phi, h, u: kin.Vec2, inner: Law, k: float = 2.0):
        """A lift with parameters."""
        kin.require(h > 0, "a lift needs a height above zero")
        return h * (1 - kin.cos(k * phi)) + u.x * phi + u.y * inner.at(phi)

    value = lambda x, h, k: h * (1 - np.cos(k * x)) + 0.3 * x + 0.5 * np.sin(x)  # noqa: E731
    law = lift(0.02, (0.3, 0.5), Law.sine(1.0, 1.0))
    x = np.linspace(0.1, 2.0, 7)
    np.testing.assert_allclose(law.at(x), value(x, 0.02, 2.0), rtol=1e-14)
    np.testing.assert_allclose(law.third(x), -0.02 * 8 * np.sin(2 * x) - 0.5 * np.cos(x), rtol=1e-12)
    assert pickle.loads(pickle.dumps(law)) == law != lift(h=0.03, u=(0.3, 0.5), inner=Law.sine(1.0, 1.0), k=2.0)

    m = kin.Mechanism("cam")
    h = m.dimension("h", 0.02)
    a = m.length("a", 0.0)
    m.add("follower", kin.drive(a, lift(h, (0.3, 0.5), Law.sine(1.0, 1.0), k=3)))
    for again in (m, kin.Mechanism.from_json(m.to_json())):
        system = again.build()
        np.testing.assert_allclose(system.run(x)["a"].value, value(x, 0.02, 3.0), atol=1e-14)
        system.set("h", 0.05)
        np.testing.assert_allclose(system.run(x)["a"].value, value(x, 0.05, 3.0), atol=1e-14)

    with pytest.raises(kin.ConstraintError, match="a lift needs a height above zero"):
        lift(-1.0, (0, 0), 0.0)
    with pytest.raises(TypeError, match="missing a required argument: 'u'"):
        lift(1.0)
    with pytest.raises(TypeError, match="its parameter `u` is Vec2"):
        lift(1.0, (1, 2, 3), 0.0)
    with pytest.raises(TypeError, match=r"give it their values, rise\(k=…\)"):
        m.add("other", kin.drive(m.length("b", 0.0), kin.law(rise)))
    with pytest.raises(kin.ConstraintError, match="`inner` is of the type Planar"):
        kin.law(of_a_body)


def rise(x, k):
    return k * x


def of_a_body(x, inner: kin.Planar):
    return x


def test_a_function_with_defaults_drives():
    m = kin.Mechanism("m")
    for k in (1, 2):
        m.add(f"d{k}", kin.drive(m.length(f"x{k}", 0.0), lambda t, k=k: k * t))
    assert m.build().run([2.0]).q[0].tolist() == [2.0, 4.0]


def test_laws_and_numbers():
    f, x = Law.sine(0.3, 2.0, 0.1), 0.37
    y, d = f.at(x), kin.Mechanism("m").dimension("d", 4.0)
    for made, value in [
        (f / 2, y / 2), (f / np.float64(2), y / 2), (np.float64(2) * f, 2 * y), (f * np.int32(2), 2 * y), (np.float32(2) - f, 2 - y),
        (f + np.array(2.0), y + 2), (2 + f, 2 + y), (f / d, y / 4), (d * f, 4 * y), (d - f, 4 - y), (-f, -y), (+f, y),
        (np.negative(f), -y), (np.add(f, 1.0), y + 1),
    ]:  # fmt: skip
        assert isinstance(made, Law) and made.at(x) == pytest.approx(value, rel=1e-15)
    made = np.array([1.0, 2.0]) * f
    assert [one.at(x) for one in made] == pytest.approx([y, 2 * y])
    with pytest.raises(ZeroDivisionError):
        f / 0


@pytest.mark.parametrize(
    "make, value",
    [
        (lambda f: kin.sin(f), np.sin), (lambda f: np.sin(f), np.sin), (lambda f: kin.atan(f), np.arctan), (lambda f: np.exp(f), np.exp),
        (lambda f: 1 / f, lambda y: y / y), (lambda f: f / f, lambda y: y / y), (lambda f: f**2, np.square),
        (lambda f: 2.0**f, np.exp2), (lambda f: abs(f), np.abs), (lambda f: np.abs(f), np.abs), (lambda f: np.float64(1) / f, lambda y: y / y),
    ],
)  # fmt: skip
def test_a_function_of_a_law_says_how_it_is_written(make, value):
    f = Law.sine(0.3, 2.0, 0.1)
    with pytest.raises(TypeError) as found:
        make(f)
    cure = str(found.value).split("write ")[1]
    made = eval(cure, {"kin": kin, "law": f, "first": f, "second": f})
    assert made.at(0.37) == pytest.approx(float(value(f.at(0.37))), rel=1e-14)


def test_laws_refuse_what_is_no_number():
    f = Law.ramp(1.0)
    for wrong in ("a", None, [1.0], True, 1j, np.complex128(1j)):
        for make in (lambda: f * wrong, lambda: wrong * f, lambda: f + wrong, lambda: wrong - f, lambda: f / wrong):
            with pytest.raises(TypeError):
                make()
    for make in (lambda: kin.maximum(f, 1.0), lambda: kin.hypot(1.0, f), lambda: np.heaviside(f, 1.0), lambda: f % 2):
        with pytest.raises((TypeError, kin.ConstraintError)):
            make()


def test_the_range_of_a_law_is_that_of_its_table():
    assert kin.Law.spline([0, 1, 2], [0, 1, 4]).range == kin.LawRange(0.0, 2.0, "line")
    assert (kin.Law.spline([0, 1, 2], [0, 1, 4]) / 2).range == kin.LawRange(0.0, 2.0, "line")
    assert kin.Law.sequence(0.0, [(1.0, kin.Law.constant(2.0))]).range.last == 1.0
    assert kin.Law.sine(1.0, 2.0).range is None
