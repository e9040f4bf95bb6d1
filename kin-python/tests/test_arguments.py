"""Arguments of all kinds: an exception, never an abort."""

import math
import random

import numpy as np
import pytest
from test_mechanism import four_bar, slot
from unusual import parabolic_slot

import kin


def odd_values():
    """Everything that is no number where one is wanted, and numbers that make no sense."""
    read_only = np.zeros(2)
    read_only.flags.writeable = False
    return [
        None, True, "x", b"x", 1j, object(), [], {}, (), [None], [[1, 2], [3]], math.nan, math.inf, -math.inf, 1e308,
        -0.0, 2**70, 10**400, np.float32(1), np.int64(3), np.array(1.0), np.zeros(0), np.zeros((2, 2)), np.zeros(2)[::-1],
        np.zeros((4, 4))[::2, 1], read_only, np.array(["a"]), np.array([None]), np.array([1j]), np.array([math.nan, 1]),
        np.ma.masked_array([1, 2], [True, False]), kin.vec2(1, 2), kin.vec3(1, 2, 3), kin.Law.ramp(1.0), kin.ground,
        kin.revolute, range(3), iter([1.0]), lambda x: x, "\0", "\ud800", "a" * 10_000, slice(2), type, float("1e-320"),
    ]  # fmt: skip


ODD = odd_values()


def calls(m, system, motion, a, x):
    """Calls of one argument of each public method."""
    return [
        m.link, lambda v: m.link("l", v), lambda v: m.link_between("l", v, v), lambda v: m.planar("p", v), m.planar,
        lambda v: m.spatial("s", v), lambda v: m.spatial("s", (0, 0, 0), v), lambda v: m.spatial("s", axis=v),
        lambda v: m.spatial("s", facing=v), lambda v: m.angle("a", v), lambda v: m.angle(v, 0.0), lambda v: m.add("n", v),
        lambda v: m.add(v, v), lambda v: m[v], lambda v: m.prefer(v, v), lambda v: m.prefer(x, v), lambda v: m.limit(v, v, v),
        lambda v: m.guess(x, v), lambda v: m.guess(v, 1.0), m.set_initial, lambda v: m.set_pose(a, v, v, v),
        lambda v: m.local(a, v), lambda v: m.local(v, (0, 0)), lambda v: m.units(v, v), kin.Mechanism, m.diagnose,
        lambda v: m.diagnose(0.0, v), kin.Mechanism.from_json, lambda v: m.add("r", kin.revolute(v, v, v, v)),
        lambda v: m.add("r", kin.revolute(a, kin.ground, v, v)), lambda v: m.add("d", kin.drive(x, v)),
        lambda v: m.add("s", kin.spatial.revolute(v, kin.ground, v, v, v, v)), lambda v: kin.linear_coupling(v, v, v),
        lambda v: m.add("c", parabolic_slot(a, kin.ground, v, v)), lambda v: parabolic_slot(v, v, v, v), kin.equation,
        kin.constraint, kin.law, kin.Law.ramp, lambda v: kin.Law.sine(v, v, v), lambda v: kin.Law.spline(v, v),
        lambda v: kin.Law.sequence(v, v), kin.Law.polynomial, lambda v: kin.Law.ramp(1.0).at(v),
        lambda v: kin.Law.ramp(1.0).periodic(v), lambda v: kin.Law.ramp(1.0) * v, kin.Axis, lambda v: kin.Axis((0, 0, 1), v),
        system.run, lambda v: system.run([0.0, 0.1], tolerance=v), lambda v: system.run([0.0, 0.1], engine=v),
        lambda v: system.run([0.0, 0.1], other_branch_at=v), lambda v: system.run([0.0, 0.1], memory=v),
        lambda v: system.run([0.0, 0.1], max_iterations=v), lambda v: system.run([0.0, 0.1], jerk=v),
        lambda v: system.run([0.0, 0.1], wrong=v), lambda v: system.run([0.0, 0.1], progress=v), system.position,
        lambda v: system.position(0.0, v), lambda v: system.residual(v, v), lambda v: system.jacobian(v, 0.0),
        lambda v: system.acceleration(v, v, 0.0), lambda v: system.set(v, v), lambda v: system.set("slot.k", v),
        system.set_initial, system.parameter, lambda v: system.measure(motion, v), lambda v: system.measure(v, "slot.k"),
        lambda v: system.extremes(motion, v), lambda v: system.crossings(motion, "slider.x", v),
        lambda v: system.at(motion, v), lambda v: system.sensitivities(motion, v).of("slider.y"), lambda v: system.sensitivities(motion, ["slot.k"]).of(v),
        lambda v: system.gradient(motion, ["slot.k"], "slider.y", v), lambda v: motion[v], lambda v: motion.point(v),
        lambda v: motion.point(a, v), lambda v: motion.rotation(v), kin.Motion.from_json, lambda v: system.assembly_near(0.0, v, v),
        lambda v: kin.sweep(system, v, v, v, v), lambda v: kin.sweep(system, ["slot.k"], v, [0.0, 0.1], ["slider.y max"]),
        lambda v: kin.sweep(system, ["slot.k"], [1.0], [0.0, 0.1], ["slider.y max"], threads=v),
        lambda v: kin.sweep(system, ["slot.k"], [1.0], [0.0, 0.1], v), lambda v: kin.where(v, v, v), kin.vec2,
        lambda v: kin.vec2(v, v), lambda v: kin.vec2(1, 2) + v, lambda v: kin.vec3(1, 2, 3).cross(v), kin.sin,
    ]  # fmt: skip


WANTED = (kin.Error, TypeError, ValueError, OverflowError, KeyError, AttributeError, UnicodeError, RuntimeError, MemoryError)


@pytest.mark.filterwarnings("ignore")
def test_odd_arguments_are_exceptions():
    """Each public call with each odd value: it works, or raises one of the ordinary exceptions."""
    m, slider = slot()
    system = m.build()
    motion = system.run(np.linspace(0, 1, 5))
    tried = 0
    for value in ODD:
        for call in calls(kin.Mechanism("fuzzed"), system, motion, slider, slider.x):
            tried += 1
            try:
                call(value)
            except WANTED as error:
                assert "panicked" not in str(error)
    assert tried > 3500


@pytest.mark.filterwarnings("ignore")
def test_random_functions_are_constraints_or_mistakes():
    """Functions made of random operations: each is a constraint, or a mistake told as one."""
    draw = random.Random(5)
    two = ["a + b", "a - b", "a * b", "a / b", "a ** 2", "a % b", "a // b", "abs(a)", "np.hypot(a, b)", "kin.where(a > b, a, b)",
           "kin.maximum(a, b)", "np.exp(-a)", "np.sqrt(a)", "kin.atan2(a, b)", "kin.log(a)", "np.clip(a, -1, b)", "a ** b"]  # fmt: skip
    made = 0
    for _ in range(300):
        lines = ["def f(x: kin.Coord, y: kin.Coord, k: float):", "    pool = [x, y, k, 0.5, 3]"]
        for _ in range(draw.randint(1, 25)):
            lines.append(f"    a, b = pool[{draw.randint(0, 4)}], pool[-{draw.randint(1, 3)}]")
            lines.append(f"    pool.append({draw.choice(two)})")
        lines.append("    return pool[-1], pool[-2] - x")
        space = {"kin": kin, "np": np}
        exec("\n".join(lines), space)
        try:
            traced = kin.constraint(space["f"])
            m = kin.Mechanism("random")
            terms = m.terms(traced(m.length("x", 0.3), m.length("y", 0.7), 0.4), [0.3, 0.7], [1.0, 1.0])
            plain = np.array(traced.plain(0.3, 0.7, 0.4))
        except (kin.ConstraintError, TypeError, ZeroDivisionError, OverflowError):
            continue
        keep = np.isfinite(plain)
        np.testing.assert_allclose(terms.c[keep], plain[keep], rtol=1e-12, atol=1e-12)
        made += 1
    assert made > 150


def test_arrays_of_any_layout_are_times():
    system = four_bar().build()
    times = np.linspace(0, 1, 21)
    for other in (times[::-1][::-1], np.repeat(times, 2)[::2], list(times), tuple(times), times.astype(">f8"), iter(times)):
        np.testing.assert_array_equal(system.run(other).q, system.run(times).q)
    with pytest.raises(ValueError, match="read-only"):
        system.run(times).q[0, 0] = 1.0
