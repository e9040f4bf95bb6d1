"""Named dimensions from Python: what hangs on them, how they are set, their mistakes by name."""

import copy
import math
import pickle

import numpy as np
import pytest

import kin

TIMES = np.linspace(0.0, 1.0, 31)


@kin.constraint
def raised_slot(i: kin.Planar, j: kin.Planar, u_i: kin.Vec2, k: float, lift: kin.Law):
    s = j.local(i.point(u_i))
    return s.y - k * s.x**2 - lift.at(s.x)


def described(numbers):
    """The mechanism with these numbers, given by a function of mechanism, name and value."""
    m = kin.Mechanism("four-bar with a slot")
    crank, base, height, rate = (numbers(m, *one) for one in NUMBERS.items())
    arm = m.link("arm", crank)
    coupler, rocker = m.link("coupler", 3.5 * crank), m.link("rocker", kin.hypot(0.3 + base - 0.4, 0.0))
    slider = m.planar("slider", x=0.02, y=height / 2)
    m.add("O", kin.revolute(m.ground, arm, (0, 0), arm.start))
    m.add("A", kin.revolute(arm, coupler, arm.end, coupler.start))
    m.add("B", kin.revolute(coupler, rocker, coupler.end, rocker.end))
    m.add("C", kin.revolute(m.ground, rocker, (base, np.sin(height) - np.sqrt(height**2)), rocker.start))
    m.add("motor", kin.drive_angle(arm, kin.Law.linear(0.2, rate * 3) + 0.1 * height * kin.Law.sine(1.0, 2.0)))
    lift = kin.Law.spline([-1.0, 0.0, 1.0], [0.0, height, 0.0]) * (1.0 / base)
    m.add("slot", raised_slot(slider, m.ground, kin.Vec2(0.0, height) * 0.5, base * 2, lift))
    m.add("upright", kin.drive_angle(slider, height - 0.04))
    m.add("feed", kin.drive(slider.x, kin.Law.harmonic(0.02, height)))
    m.prefer(rocker, kin.deg(100))
    return m


NUMBERS = {"crank": 0.1, "base": 0.4, "the height": 0.04, "rate": 1.3}
OTHERS = {"crank": 0.09, "base": 0.42, "the height": 0.05, "rate": 1.1}


def named(m, name, value):
    return m.dimension(name, value, unit="m", within=(0.01, 2.0), tolerance=1e-4)


def others(m, name, _):
    return OTHERS[name]


def test_a_system_that_is_set_is_the_one_built_of_these_numbers():
    m = described(named)
    system = m.build()
    assert system.dimensions == NUMBERS
    plain = described(lambda _, __, value: value).build()
    built = plain.parameters
    assert list(built) == list(system.parameters)
    np.testing.assert_allclose(list(system.parameters.values()), list(built.values()), rtol=1e-15, atol=1e-17)
    for name, value in OTHERS.items():
        system.set(name, value)
    expected = described(others).build()
    found, wanted = system.parameters, expected.parameters
    np.testing.assert_allclose(list(found.values()), list(wanted.values()), rtol=1e-14, atol=1e-16)
    assert system.parameter("C.u_i.x") == 0.42 and system.parameter("the height") == 0.05
    np.testing.assert_allclose(system.run(TIMES).qdd, expected.run(TIMES).qdd, rtol=0, atol=1e-9)


def test_files_pickles_and_copies_keep_dimensions():
    m = described(named)
    for again in (kin.Mechanism.from_json(m.to_json()), pickle.loads(pickle.dumps(m)), copy.copy(m)):
        assert {name: one.value for name, one in again.dimensions.items()} == NUMBERS
        assert again.to_json() == m.to_json()
        assert again["arm"].end.x.text == "0.5 * crank"
    system = m.build()
    for name, value in OTHERS.items():
        system.set(name, value)
    for again in (pickle.loads(pickle.dumps(system)), copy.copy(system), copy.deepcopy(system)):
        assert again.dimensions == system.dimensions and again.parameters == system.parameters
        again.set("crank", 0.08)
    assert system.dimensions["crank"] == 0.09


def test_sweeps_sensitivities_and_objectives_name_dimensions():
    system = described(named).build()
    rows = kin.sweep(system, ["crank", "the height"], [(0.1, 0.04), (0.09, 0.05)], TIMES, ["rocker.theta max"])
    assert list(rows.status) == ["", ""]
    system.set("crank", 0.09)
    system.set("the height", 0.05)
    alone = system.run(TIMES)["rocker.theta"].value.max()
    assert abs(rows.values[1, 0] - alone) < 1e-12

    def cost(x):
        weights = 2.0 * x.value / len(x.value)
        return np.mean(x.value**2), weights

    names = ["crank", "base", "the height"]
    objective = system.objective(names, TIMES, "rocker.theta", cost)
    at = np.array([0.1, 0.4, 0.04])
    _, gradient = objective(at)
    for k, step in enumerate(1e-6 * at):
        ends = [objective(at + sign * step * np.eye(3)[k])[0] for sign in (1, -1)]
        assert abs((ends[0] - ends[1]) / (2 * step) - gradient[k]) < 1e-6 * max(1.0, abs(gradient[k]))
    motion = system.run(TIMES)
    slopes = system.sensitivities(motion, ["crank"]).of("rocker.theta")["crank"].value
    moved = copy.copy(system)
    ends = []
    for crank in (0.09 + 1e-6, 0.09 - 1e-6):
        moved.set("crank", crank)
        ends.append(moved.run(TIMES)["rocker.theta"].value)
    np.testing.assert_allclose(slopes, (ends[0] - ends[1]) / 2e-6, rtol=1e-6, atol=1e-6)


def test_arithmetic_has_the_values_of_plain_numbers():
    m = kin.Mechanism("arithmetic")
    a, b = m.dimension("a", 0.7), m.dimension("b two", 0.3)
    functions = [
        lambda a, b: a + b - 2 * a / b,
        lambda a, b: (1 - a) ** 2 + a**-1 + a**0.5 + a**b + 2**a,
        lambda a, b: 7 % a + b % 0.2 + a // b,
        lambda a, b: abs(-a) + +b,
        lambda a, b: kin.atan2(a, b) + kin.hypot(a, 2) + kin.hypot(2, b) + kin.maximum(a, b) + kin.minimum(a, 0.1),
        lambda a, b: np.arctan2(a, b) + np.hypot(1.0, a) + np.maximum(a, b),
        lambda a, b: kin.sin(a) + kin.cos(b) + kin.tan(a) + kin.asin(a) + kin.acos(b) + kin.atan(a),
        lambda a, b: np.sinh(a) + np.cosh(b) + np.tanh(a) + np.arcsinh(a) + np.arccosh(1 + b) + np.arctanh(a),
        lambda a, b: np.exp(a) + kin.exp2(b) + kin.expm1(a) + np.log(b) + kin.log1p(a) + kin.log2(a) + np.log10(b),
        lambda a, b: kin.sqrt(a) + kin.cbrt(b) + kin.floor(3 * a) + kin.ceil(b) + kin.trunc(-2 * a) + kin.sign(-a),
        lambda a, b: kin.radians(a) + kin.degrees(b) + np.square(a) + np.reciprocal(b),
        lambda a, b: kin.Vec2(a, 0.4).norm() + kin.Vec3(a, b, 1).dot((1, 2, 3)) + kin.Vec2(a, b).cross(kin.Vec2(b, 1)),
        lambda a, b: sum([a, b, a]) + np.sum(np.array([a, b]) * 2) + np.dot(np.array([a, b]), np.array([1.0, b])),
        lambda a, b: a if a > b else b,
        lambda a, b: kin.where(a > 0.5, a, b),
    ]  # fmt: skip
    for number, function in enumerate(functions):
        expression, plain = function(a, b), function(0.7, 0.3)
        assert isinstance(expression, kin.Dimension), number
        assert expression.value == pytest.approx(plain, rel=1e-15), number
        # The same by Kin's own reading of the text.
        assert m._native.expression(expression.text) == pytest.approx(plain, rel=1e-14), expression.text
    assert f"{a:.2f}" == "0.70" and str(a) == "0.7" and "b two" in repr(b / 2)
    assert a == 0.7 and a != b and a >= b and not a < b and bool(a)


def test_a_name_for_an_expression_is_a_dimension():
    m = kin.Mechanism("crank")
    a = m.dimension("a", 0.2)
    half = m.dimension("half", a / 2)
    body = m.link("body", a)
    m.add("O", kin.revolute(m.ground, body, (half, 0), body.start))
    m.add("motor", kin.drive_angle(body, 0.0))
    system = m.build()
    system.set("a", 0.4)
    assert system.dimensions == {"a": 0.4, "half": 0.2} and system.parameter("O.u_i.x") == 0.2
    with pytest.raises(kin.DimensionError, match="`half`: the dimension is an expression of other dimensions"):
        system.set("half", 0.3)


def loaded(numbers):
    """An arm with all that has mass and acts, its numbers given by a function of mechanism, name and value."""
    m = kin.Mechanism("arm")
    mass, c, g, k, f, mu, side = (numbers(m, *one) for one in LOADS.items())
    arm = m.link("arm", 0.5)
    m.add("O", kin.revolute(arm, m.ground, arm.start, (0, 0)))
    m.add("motor", kin.drive_angle(arm, kin.Law.sine(0.5, 3.0)))
    m.mass(arm, mass, (c, 0.0), 0.1 * mass)
    m.gravity((0.0, g))
    m.load("spring", kin.loads.spring(arm, m.ground, (c, 0.0), (0.3, 0.8), k, 0.4))
    m.load("hook", kin.Load.force(arm, (0.0, c), (f, 0.0)) + kin.Load.torque(arm, 2 * f))
    m.friction("O", kin.Friction.pin(mu, 0.02, 1e-3).length(c))
    m.prefer(arm, side)
    return m, arm


LOADS = {"mass": 1.2, "c": 0.1, "g": -9.81, "k": 80.0, "f": 5.0, "mu": 0.2, "side": 0.3}


def test_masses_loads_friction_and_preferences_hang_on_dimensions():
    others = {"mass": 2.5, "c": 0.2, "g": -1.62, "k": 35.0, "f": -12.0, "mu": 0.35, "side": -0.2}
    m, _ = loaded(lambda m, name, value: m.dimension(name, value))
    plain, _ = loaded(lambda _, name, value: others[name])
    for mechanism in (m, pickle.loads(pickle.dumps(m))):
        system = mechanism.build()
        for name, value in others.items():
            system.set(name, value)
        built = plain.build()
        efforts = [one.forces(one.run(TIMES)).drive("motor").effort.value for one in (system, built)]
        assert np.allclose(*efforts, rtol=1e-13, atol=1e-13) and np.ptp(efforts[0]) > 1.0
        with pytest.raises(kin.DimensionError, match="`mass`: with the value -1 `arm`"):
            system.set("mass", -1.0)
        assert system.dimensions["mass"] == 2.5


MISTAKES = [
    ("foreign", lambda m, a, o: m.link("l", o), "`l` has a dimension of another mechanism than"),
    ("foreign in a joint", lambda m, a, o: m.add("O", kin.fixed(m.planar("b"), (0, o), 0)), "`O` has a dimension of another mechanism"),
    ("foreign in a mass", lambda m, a, o: m.mass(m.planar("b"), o, (0, 0), 1), "`mass` has a dimension of another mechanism"),
    ("foreign in gravity", lambda m, a, o: m.gravity((0, o)), "`gravity` has a dimension of another mechanism"),
    ("foreign in a law", lambda m, a, o: m.add("O", kin.drive_angle(m.planar("b"), kin.Law.ramp(o))), "`O` has a dimension of another mechanism"),
    ("several", lambda m, a, o: a + o, "`a` and `o` are dimensions of two mechanisms"),
    ("NaN", lambda m, a, o: m.dimension("n", math.nan), "`n`: the value is NaN. Give a finite number"),
    ("operand", lambda m, a, o: a * math.inf, "`a` meets inf"),
    ("backtick", lambda m, a, o: m.dimension("a`b", 1.0), "name with backticks"),
    ("unused", lambda m, a, o: m.build(), "no number of the mechanism depends on the dimension `a`"),
]  # fmt: skip


@pytest.mark.parametrize("make, words", [one[1:] for one in MISTAKES], ids=[one[0] for one in MISTAKES])
def test_mistakes_are_told_by_name(make, words):
    m, other = kin.Mechanism("own"), kin.Mechanism("other")
    with pytest.raises(kin.DimensionError, match=words):
        make(m, m.dimension("a", 0.2), other.dimension("o", 0.3))


def test_ranges_and_names_are_told():
    m = kin.Mechanism("own")
    with pytest.raises(kin.EmptyName):
        m.dimension(" ", 1.0)
    a = m.dimension("a", 0.2, within=(0.1, 0.3))
    with pytest.raises(kin.DuplicateName):
        m.dimension("a", 1.0)
    body = m.link("body", a)
    m.add("O", kin.revolute(m.ground, body, (0, 0), body.start))
    m.add("motor", kin.drive_angle(body, 0.0))
    system = m.build()
    for value, words in ((0.5, "outside the range"), (math.nan, "finite number")):
        with pytest.raises(kin.DimensionError, match=words) as found:
            system.set("a", value)
        assert found.value.name == "a" and system.dimensions["a"] == 0.2
    m.dimension("out", 2.0, within=(0.1, 0.3))
    with pytest.raises(kin.DimensionError, match="`out`"):
        m.build()


def test_a_dimension_is_no_plain_number_unless_it_is_said():
    m = kin.Mechanism("own")
    a = m.dimension("a", 0.2)
    for plain in (math.sin, float, lambda a: m.guess(m.angle("x", 0.0), a), lambda a: m.spatial("s", (a, 0, 0))):
        with pytest.raises(TypeError, match="Write `.value` if you want its number"):
            plain(a)
    assert math.sin(a.value) == math.sin(0.2)
    with pytest.raises(kin.ConstraintError, match="Give `f` an argument for it"):

        @kin.constraint
        def f(x: kin.Coord):
            return x - a
