"""Where angles of hinges, sleeves and tables are zero."""

import json
import pathlib

import numpy as np
import pytest

import kin

ROWS = json.loads((pathlib.Path(__file__).parents[2] / "tests" / "library" / "zeros.json").read_text())


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_zeros_of_hinges_sleeves_and_tables(row):
    """The table is that of the tests in Rust too. An f that the axis has of its own is replaced."""
    S, o, (h, f) = kin.spatial, (0, 0, 0), row["h_i"]
    for joint in (S.revolute, S.cylindrical, S.planar):
        for h_i in (kin.Axis(h, f), h) if f is None else (kin.Axis(h, f), kin.Axis(kin.Axis(h), f)):
            m = kin.Mechanism("m")
            body = m.spatial("body")
            m.add("J", joint(body, m.ground, o, o, h_i, row["h_j"]).zero(row["f_i"], row["f_j"]))
            m.add("still", S.fixed(body, o, kin.EulerParameters()))
            system = m.build()
            assert system.measure(system.run([0.0]), "J.angle").value[0] == pytest.approx(row["angle"], abs=1e-12)


def test_an_axis_of_an_axis_takes_the_direction_that_it_is_given():
    old = kin.Axis((0, 0, 2), (0, 1, 0))
    assert kin.Axis(old) == old and kin.Axis(old, (1, 0, 3)) == kin.Axis((0, 0, 1), (1, 0, 0)) != old
    with pytest.raises((ValueError, TypeError, kin.Error)):
        kin.Mechanism("m").add("J", kin.spatial.revolute(kin.Mechanism("m").spatial("b"), kin.ground, (0, 0, 0), (0, 0, 0), old, (0, 0, 1)).zero((0, 0, 1), (1, 0, 0)))


def test_reprs_stay_short():
    m = kin.Mechanism("m")
    x = m.length("x", 0.0)
    k = m.dimension("k", 1.0)
    m.add("d", kin.drive(x, kin.Law.sine(k, 1.0)))
    m.add("s", kin.coupling(x, m.length("z", 0.0), 1.0, -1.0, 0.0))
    system = m.build()
    times = [0.01 * one for one in range(3000)]
    rows = kin.sweep(system, ["k"], [[1e300 * one] for one in range(2000)], times[:5], ["x max"])
    motion = system.run(times)
    batch = kin.Batch.of(system, ["k"], times, ["x max"])
    for one in (rows, motion, batch, system.extremes(motion, "x"), system.prove(system.run(times[:500])), system.position(0.1)):
        assert len(repr(one)) < 2500, f"{type(one).__name__}: {len(repr(one))} characters"
    assert repr(rows).startswith("<2000 cases of ['x max']: ")


def test_an_extreme_that_is_not_of_the_motion_is_refused():
    m = kin.Mechanism("m")
    x, a = m.length("x", 0.0), m.dimension("a", 1.0, tolerance=0.01)
    m.add("d", kin.drive(x, kin.Law.sine(a, 2.0)))
    system = m.build()
    motion = system.run([0.1 * k for k in range(41)])
    found, derivatives = system.extremes(motion, x), system.sensitivities(motion, ["a"])
    for one in found.all:
        assert derivatives.extreme(x, one)["a"].value == pytest.approx(1.0 if one.is_max else -1.0)
        # What a file or a print-out has of it is enough.
        assert derivatives.extreme(x, kin.Extreme(float(f"{one.t:.12g}"), 0.0, one.is_max))["a"].value
    first = found.all[0]
    for wrong in (kin.Extreme(1.0, 0.3, True), kin.Extreme(first.t, first.value, not first.is_max), kin.Extreme(99.0, 0.0, False)):
        word = "maximum" if wrong.is_max else "minimum"
        asked = [
            lambda wrong=wrong: derivatives.extreme(x, wrong),
            lambda wrong=wrong: derivatives.between(x, first, wrong),
            lambda wrong=wrong: system.tolerance(motion, x, wrong),
            lambda wrong=wrong: system.samples(motion, x, wrong, count=10),
        ]
        for ask in asked:
            with pytest.raises(kin.InvalidConstraint, match=rf"the measure has no {word} at t = .*. The nearest {word} is at t = .*system.extremes"):
                ask()


def test_a_function_of_a_motion_has_derivatives_and_tolerances():
    m = kin.Mechanism("m")
    x, a = m.length("x", 0.0), m.dimension("a", 1.0, tolerance=0.01)
    m.add("d", kin.drive(x, kin.Law.sine(a, 2.0)))
    system = m.build()
    motion = system.run([0.1 * k for k in range(41)])
    calls = [0]

    def measure(motion):
        calls[0] += 1
        return motion["x"]

    by = system.sensitivities(motion, ["a"])
    assert by.of(measure)["a"].value == pytest.approx(by.of("x")["a"].value)
    most, least = system.extremes(motion, measure).max, system.extremes(motion, measure).min
    assert by.extreme(measure, most)["a"].value == pytest.approx(1.0)
    assert by.between(measure, most, least)["a"].value == pytest.approx(2.0)
    for of in (most, "stroke", 0.3):
        own, named = system.tolerance(motion, measure, of), system.tolerance(motion, "x", of)
        assert own.worst_case == pytest.approx(named.worst_case)
    sampled = [system.samples(motion, what, most, count=20).values for what in (measure, "x")]
    assert sampled[0] == pytest.approx(sampled[1])
    weights = np.ones(len(motion))
    assert system.gradient(motion, ["a"], measure, weights) == pytest.approx(system.gradient(motion, ["a"], "x", weights))
    assert calls[0] > 20

    def fails(motion):
        raise ZeroDivisionError("mine")

    for ask in (lambda: by.of(fails), lambda: system.tolerance(motion, fails, 0.3), lambda: system.samples(motion, fails, 0.3, count=3)):
        with pytest.raises(ZeroDivisionError, match="mine"):
            ask()
    for kept in (measure, (measure, "max")):
        with pytest.raises(TypeError, match="not a function of a motion"):
            kin.sweep(system, ["a"], [[1.0], [2.0]], [0.0, 0.1], [kept])


def test_a_span_of_times_that_is_no_number_is_refused():
    m = kin.Mechanism("m")
    m.add("d", kin.drive(m.length("x", 0.0), 0.0))
    system = m.build()
    for times in ([1e308, -1e308], [-1e308, 0.0, 1e308]):
        with pytest.raises(kin.InvalidTimes, match="is above the largest number, 1.797"):
            system.run(times)
    assert len(system.run([-8e307, 8e307])) == 2


def test_a_measure_is_a_function_of_a_motion():
    m = kin.Mechanism("slider-crank")
    crank, rod = m.link("crank", 0.1), m.link("rod", 0.3)
    m.add("O", kin.revolute(crank, m.ground, crank.start, (0, 0)))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("slide", kin.point_on_line(rod, m.ground, rod.end, (0, 0), (1, 0)))
    m.add("motor", kin.drive_angle(crank, kin.Law.linear(0.4, 1.0)))
    system = m.build()
    motion = system.run(np.linspace(0, 7, 71))
    end = lambda motion: motion.point(rod, rod.end).along((1, 0)).renamed("end")  # noqa: E731
    found = system.extremes(motion, end)
    # The slider is at its dead centres where crank and rod are in line.
    assert (found.name, found.unit) == ("end", "m") and found.stroke == pytest.approx(0.2, abs=1e-12)
    assert [one.value for one in found.all] == pytest.approx([0.2, 0.4], abs=1e-12)
    assert [one.t + 0.4 for one in found.all] == pytest.approx([np.pi, 2 * np.pi], abs=1e-9)
    t, rises = system.crossings(motion, end, 0.3)[0]
    assert not rises and system.at(motion, t).point(rod, rod.end).r[0, 0] == pytest.approx(0.3, abs=1e-12)
    mine, theirs = system.measure(motion, end), end(motion)
    np.testing.assert_array_equal(mine.acceleration, theirs.acceleration)
    square = lambda motion: (lambda e: motion.quantity("square", "m^2", [  # noqa: E731
        e.value**2, 2 * e.value * e.rate, 2 * e.rate**2 + 2 * e.value * e.second_rate]))(end(motion))  # fmt: skip
    assert [one.value for one in system.extremes(motion, square).all] == pytest.approx([0.04, 0.16], abs=1e-12)
    with pytest.raises(ValueError, match="are lists of 71 numbers"):
        motion.quantity("a", "m", [[1.0], [1.0], [1.0]])
    apart = lambda motion: end(motion) - motion.point(crank, crank.end).along((1, 0))  # noqa: E731
    assert system.extremes(motion, apart).max.value == pytest.approx(0.3, abs=1e-12)

    wrong = [
        (lambda motion: 3.0, TypeError, "gives a kin.Quantity, not 3.0"),
        (lambda motion: kin.Quantity("a", "m", motion.times, motion.times), ValueError, "`a` has no rates"),
        (lambda motion: kin.Quantity("a", "m", [], [1.0], [1.0], [1.0]), kin.WrongLength, "`a`, one number per time"),
        (lambda motion: kin.Quantity("a", "m", [], *(0 * motion.times + np.nan,) * 3), kin.OutputNotFinite, "`a` is NaN"),
        (lambda motion: 1 / 0, ZeroDivisionError, "division by zero"),
    ]
    for function, error, words in wrong:
        for ask in (system.measure, system.extremes, lambda motion, what: system.crossings(motion, what, 0.0)):
            with pytest.raises(error, match=words):
                ask(motion, function)
