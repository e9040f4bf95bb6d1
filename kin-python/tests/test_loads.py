"""Loads from Python against vector code of the test's own, and against each other by two ways of writing them."""

import re
from pathlib import Path

import numpy as np
import pytest

import kin
from kin import loads

T = np.linspace(0.0, 2.0, 81)
L = 0.6
SOURCES = Path(__file__).resolve().parents[2] / "kin-core" / "src" / "forces"


def door(load):
    """A body driven about the origin by θ = 0.3 + t + 0.2 t²: without mass the motor holds the load alone."""
    m = kin.Mechanism("door")
    door = m.link("door", L)
    m.add("O", kin.revolute(m.ground, door, (0, 0), door.start))
    m.add("motor", kin.drive_angle(door, kin.Law.polynomial([0.3, 1.0, 0.2])))
    m.load("load", load(m, door))
    system = m.build()
    motion = system.run(T)
    return m, door, system, system.forces(motion)


def effort(load):
    return door(load)[3].drive("motor").effort.value


THETA, OMEGA = 0.3 + T + 0.2 * T**2, 1.0 + 0.4 * T
END = L * np.stack([np.cos(THETA), np.sin(THETA)], axis=1)
PIN = np.array([0.1, 0.5])
LENGTH = np.linalg.norm(END - PIN, axis=1)
# The rate of the length by the angle of the door.
ARM = np.sum((END - PIN) * L * np.stack([-np.sin(THETA), np.cos(THETA)], axis=1), axis=1) / LENGTH
K, FREE, C = 80.0, 0.3, 12.0


def length(m, door):
    return loads.length(door, m.ground, door.end, PIN)


@kin.potential
def own_spring(i: kin.Planar, j: kin.Planar, u_i: kin.Vec2, u_j: kin.Vec2, k: float, free: float):
    """V = ½ k (l − l0)²   [J]"""
    stretch = (i.point(u_i) - j.point(u_j)).norm() - free
    return 0.5 * k * stretch**2


@kin.force
def absorber(x: kin.Coord, rate: kin.Rate, t: kin.Time, k: float, free: float, c: float, law: kin.Law):
    """A spring, and a damper by the square of the rate, stronger by a law of time.   [N]"""
    return (-k * (x - free) - c * rate * abs(rate)) * law.at(t)


@kin.constraint
def own_length(i: kin.Planar, j: kin.Planar, u_i: kin.Vec2, u_j: kin.Vec2):
    return (i.point(u_i) - j.point(u_j)).norm()


PUSH = {  # force along the length, positive apart
    "spring": (lambda m, d: loads.spring(d, m.ground, d.end, PIN, K, FREE), -K * (LENGTH - FREE)),
    "own spring": (lambda m, d: own_spring(d, m.ground, d.end, PIN, k=K, free=FREE), -K * (LENGTH - FREE)),
    "damper": (lambda m, d: loads.damper(d, m.ground, d.end, PIN, C), -C * ARM * OMEGA),
    "both": (
        lambda m, d: loads.spring_damper(length(m, d), K, FREE, C), -K * (LENGTH - FREE) - C * ARM * OMEGA,
    ),
    "sum": (
        lambda m, d: own_spring(d, m.ground, d.end, PIN, K, FREE) + loads.viscous(length(m, d), C),
        -K * (LENGTH - FREE) - C * ARM * OMEGA,
    ),
    "lambda": (
        lambda m, d: kin.Load.along(length(m, d), lambda x, rate, t: -K * (x - FREE) * kin.cos(t) - C * rate**3),
        -K * (LENGTH - FREE) * np.cos(T) - C * (ARM * OMEGA) ** 3,
    ),
    "own length": (
        lambda m, d: kin.Load.along(own_length(d, m.ground, d.end, PIN), lambda x: np.sin(x) * K), K * np.sin(LENGTH),
    ),
    "absorber": (
        lambda m, d: absorber(length(m, d), K, FREE, c=C, law=kin.Law.linear(1.0, 0.5)),
        (-K * (LENGTH - FREE) - C * ARM * OMEGA * np.abs(ARM * OMEGA)) * (1 + 0.5 * T),
    ),
    "strut": (lambda m, d: loads.strut(d, m.ground, d.end, PIN, lambda x: 3 * x**2), 3 * LENGTH**2),
    "gas spring": (
        lambda m, d: loads.gas_spring(d, m.ground, [d.end, PIN], 200.0, (0.5, 0.8), 1.3),
        200.0 * (0.8 / (0.8 + LENGTH - 0.5)) ** 1.3,
    ),
    "pressure": (lambda m, d: loads.pressure(length(m, d), lambda x: 1e4 / x, 0.01), 100.0 / LENGTH),
    "in time": (lambda m, d: loads.force_in_time(length(m, d), kin.Law.sine(5.0, 3.0)), 5 * np.sin(3 * T)),
}  # fmt: skip


@pytest.mark.parametrize("name", PUSH)
def test_a_load_along_a_length_is_the_closed_form(name):
    load, push = PUSH[name]
    np.testing.assert_allclose(effort(load), -push * ARM, rtol=1e-12, atol=1e-11)


TURN = {  # torque on the door
    "torsion spring": (lambda m, d: loads.torsion_spring(d, m.ground, 4.0, 0.2), -4.0 * (THETA - 0.2)),
    "torsion damper": (lambda m, d: loads.torsion_damper(d, m.ground, 3.0), -3.0 * OMEGA),
    "coordinate spring": (lambda m, d: loads.coordinate_spring(d.theta, 4.0, 0.2), -4.0 * (THETA - 0.2)),
    "along": (lambda m, d: loads.force_along(d.theta, kin.Law.ramp(2.0)), 2.0 * T),
    "torque": (lambda m, d: kin.Load.torque(d, lambda t: 1.0 + t**2), 1.0 + T**2),
    "torque in body": (lambda m, d: kin.Load.torque_in_body(d, 2.5), 2.5 + 0 * T),
    "force": (
        lambda m, d: kin.Load.force(d, d.end, (3.0, kin.Law.ramp(2.0))), END[:, 0] * 2.0 * T - END[:, 1] * 3.0,
    ),
    "force in body": (lambda m, d: kin.Load.force_in_body(d, d.end, (7.0, 2.0)), 2.0 * L + 0 * T),
    "bushing": (
        # The spring is at the far end, from a point of the ground.
        lambda m, d: loads.damped_bushing(d, m.ground, [d.end, PIN], (K, 2 * K, 4.0), (C, 2 * C, 3.0), 0.2),
        -K * (END - PIN)[:, 0] * -END[:, 1] - 2 * K * (END - PIN)[:, 1] * END[:, 0] - 4.0 * (THETA - 0.2)
        - OMEGA * (C * END[:, 1] ** 2 + 2 * C * END[:, 0] ** 2 + 3.0),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", TURN)
def test_a_load_on_a_body_is_the_closed_form(name):
    load, torque = TURN[name]
    np.testing.assert_allclose(effort(load), -torque, rtol=1e-12, atol=1e-11)


def test_a_load_is_asked_and_balances():
    _, body, _, forces = door(PUSH["own spring"][0])
    push = PUSH["own spring"][1]
    along = (END - PIN) / LENGTH[:, None]
    np.testing.assert_allclose(forces.load("load").on(body).force, push[:, None] * along, atol=1e-11)
    np.testing.assert_allclose(forces.load("load").power.value, push * ARM * OMEGA, atol=1e-11)
    assert forces.balance.worst < 1e-12
    with pytest.raises(kin.UnknownName, match="no load `closer`. Use `load`"):
        forces.load("closer").power


def test_in_space_a_spring_and_a_damper_are_the_closed_form():
    m = kin.Mechanism("arm")
    arm, z = m.spatial("arm", (L / 2, 0.0, 0.0)), (0.0, 0.0, 1.0)
    pin, end = (0.1, 0.5, 0.2), (L / 2, 0.0, 0.0)
    m.add("O", kin.spatial.revolute(arm, m.ground, (-L / 2, 0, 0), (0, 0, 0), z, z))
    m.add("motor", kin.spatial.drive_turn(arm, m.ground, z, z, kin.Law.polynomial([0.3, 1.0, 0.2])))
    m.load("spring", loads.spatial.spring(arm, m.ground, end, pin, K, FREE) + loads.spatial.damper(arm, m.ground, end, pin, C))
    m.load("torsion", loads.spatial.torsion_spring(arm, m.ground, z, z, 4.0, 0.2))
    m.load("hand", kin.Load.torque_in_body(arm, (0.0, 0.0, kin.Law.ramp(2.0))) + kin.Load.force(arm, end, (0.0, 3.0, 9.0)))
    system = m.build()
    forces = system.forces(system.run(T))
    away = np.hstack([END, np.zeros((len(T), 1))]) - pin
    length = np.linalg.norm(away, axis=1)
    arm_ = np.sum(away[:, :2] * L * np.stack([-np.sin(THETA), np.cos(THETA)], axis=1), axis=1) / length
    torque = (-K * (length - FREE) - C * arm_ * OMEGA) * arm_ - 4.0 * (THETA - 0.2) + 2.0 * T + 3.0 * END[:, 0]
    np.testing.assert_allclose(forces.drive("motor").effort.value, -torque, rtol=1e-12, atol=1e-11)


@pytest.mark.parametrize("name", [*PUSH, *TURN])
def test_files_carry_loads_and_give_the_same(name):
    load, _ = {**PUSH, **TURN}[name]
    m, _, system, forces = door(load)
    again = kin.Mechanism.from_json(m.to_json())
    assert again.to_json() == m.to_json()
    other = again.build()
    np.testing.assert_array_equal(
        other.forces(other.run(T)).drive("motor").effort.value, forces.drive("motor").effort.value
    )


def test_two_functions_of_one_line_are_two():
    m = kin.Mechanism("two")
    x = m.length("x", 0.0)
    m.add("motor", kin.drive(x, kin.Law.sine(1.0, 1.0)))
    for k in range(3):
        m.load(f"load {k}", kin.Load.along(loads.along(x), lambda q: float(k + 1) * q))
    system = m.build()
    forces = system.forces(system.run(T))
    np.testing.assert_allclose(forces.drive("motor").effort.value, -6.0 * np.sin(T), atol=1e-12)


def test_a_force_acts_along_a_measure_by_its_name():
    # The angle of the pin is that of the ground in the door.
    found = effort(lambda m, d: loads.spring_damper("O.angle", K, FREE, C))
    np.testing.assert_allclose(found, K * (THETA + FREE) + C * OMEGA, rtol=1e-12)
    found = effort(lambda m, d: kin.Load.along("door.theta", lambda x, rate: -C * rate * abs(rate)))
    np.testing.assert_allclose(found, C * OMEGA * abs(OMEGA), rtol=1e-12)
    found = effort(lambda m, d: absorber("door.theta", K, FREE, C, kin.Law.constant(2.0)))
    np.testing.assert_allclose(found, 2.0 * (K * (THETA - FREE) + C * OMEGA * abs(OMEGA)), rtol=1e-12)
    with pytest.raises(kin.Error, match=r"`load` \(load\): the load acts along `O.slide`"):
        effort(lambda m, d: loads.viscous("O.slide", C))


def test_every_load_of_the_library_is_here():
    for file, module in (("library.rs", loads), ("library/spatial.rs", loads.spatial)):
        names = set(re.findall(r"^pub fn (\w+)", (SOURCES / file).read_text(encoding="utf-8"), flags=re.MULTILINE))
        assert len(names) > 9 and names <= set(module.__all__), names - set(module.__all__)


MISTAKES = [
    (lambda m, d: m.load("l", 3.0), TypeError, "is no load: call kin.loads.spring"),
    (lambda m, d: m.load("l", kin.revolute(m.ground, d, (0, 0), d.start)), TypeError, "is no load"),
    (lambda m, d: m.load("", loads.spring(d, m.ground, d.end, PIN, K, FREE)), kin.Error, "name"),
    (lambda m, d: m.load("l", loads.viscous(3.0, C)), TypeError, "acts along a length or an angle"),
    (lambda m, d: m.load("l", loads.viscous(kin.revolute(m.ground, d, (0, 0), d.start), C)), kin.Error, "2 rows"),
    (lambda m, d: m.load("l", loads.spring(d, m.ground, d.end, PIN, np.nan, FREE)), kin.Error, "stiffness"),
    (lambda m, d: m.load("l", loads.spring(d, m.ground, d.end, (1, 2, 3), K, FREE)), TypeError, "u_j"),
    (lambda m, d: m.load("l", loads.pressure(length(m, d), 1.0, -0.01)), kin.Error, "area of the piston"),
    (lambda m, d: m.load("l", kin.Load.force(m.ground, (0, 0), (1, 2))), ValueError, "a load on the ground"),
    (lambda m, d: m.load("l", kin.Load.force(d.theta, (0, 0), (1, 2))), TypeError, "acts on a body"),
    (lambda m, d: m.load("l", kin.Load.force(d, (0, 0), (1, 2, 3))), TypeError, "its force has 2 components"),
    (lambda m, d: m.load("l", kin.Load.force(d, (0, 0, 1), (1, 2))), TypeError, "a point of `door` has 2 numbers"),
    (lambda m, d: m.load("l", kin.Load.torque(d, (1, 2, 3))), TypeError, "its torque has 1 component"),
    (lambda m, d: m.load("l", kin.Load.torque(d, np.inf)), kin.Error, "torque"),
    (lambda m, d: m.load("l", kin.Load.force(d, (0, 0), (None, 2))), TypeError, "force"),
    (lambda m, d: kin.Load.along(length(m, d), 3.0), TypeError, "takes a function of x"),
    (lambda m, d: kin.Load.along(length(m, d), lambda a, b, c, e: a), kin.ConstraintError, "4 arguments"),
    (lambda m, d: kin.Load.along(length(m, d), lambda x: 1.0 if x > 0 else 2.0), kin.ConstraintError, "kin.where"),
    (lambda m, d: loads.spring(d, m.ground, d.end, PIN, K, FREE) + 3, TypeError, "unsupported operand"),
    (lambda m, d: m.load("l", loads.torsion_spring(d, m.ground, 1.0, np.inf)), kin.Error, "free"),
    (lambda m, d: m.add("c", own_spring(d, m.ground, d.end, PIN, K, FREE)), TypeError, "is no constraint"),
]


@pytest.mark.parametrize("number", range(len(MISTAKES)))
def test_a_mistake_is_told_by_name(number):
    wrong, kind, words = MISTAKES[number]
    m = kin.Mechanism("door")
    door = m.link("door", L)
    m.add("motor", kin.drive_angle(door, kin.Law.ramp(1.0)))
    with pytest.raises(kind, match=re.escape(words)):
        wrong(m, door)
    assert "loads" not in m.to_json()


def test_a_name_that_another_load_has_is_told():
    m, body, _, _ = door(TURN["torsion spring"][0])
    with pytest.raises(kin.DuplicateName, match="load"):
        m.load("load", kin.Load.torque(body, 1.0))


def test_a_body_of_another_mechanism_is_told():
    m, other = kin.Mechanism("one"), kin.Mechanism("other")
    body = other.link("door", L)
    m.link("door", L)
    for load in (loads.torsion_spring(body, m.ground, 1.0, 0.0), kin.Load.torque(body, 1.0)):
        with pytest.raises(kin.ForeignBody, match="`spring`"):
            m.load("spring", load)


def test_names_of_the_library_are_taken():
    def spring(i: kin.Planar, k: float):
        return k * i.x**2

    with pytest.raises(kin.ConstraintError, match="`spring` is a load of the library"):
        kin.potential(spring)
