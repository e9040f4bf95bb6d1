"""Masses, forces and tolerances from Python, against closed forms."""

import numpy as np
import pytest

import kin

T = np.linspace(0.0, 3.0, 301)
M, G, R, J, L = 1.2, 9.81, 0.35, 0.03, 0.5


def arm():
    """A driven pendulum: its centre of mass is R from the pin, θ = 0.2 + 2 t + 0.3 t²."""
    m = kin.Mechanism("arm")
    arm = m.link("arm", L)
    m.mass(arm, M, (R - L / 2, 0.0), J)
    m.gravity((0.0, -G))
    m.add("O", kin.revolute(m.ground, arm, (0, 0), arm.start))
    m.add("motor", kin.drive_angle(arm, kin.Law.polynomial([0.2, 2.0, 0.3])))
    system = m.build()
    return m, arm, system, system.run(T)


def closed_form():
    theta, omega, alpha = 0.2 + 2 * T + 0.3 * T**2, 2 + 0.6 * T, 0.6 + 0 * T
    cos, sin = np.cos(theta), np.sin(theta)
    acceleration = R * np.stack([-alpha * sin - omega**2 * cos, alpha * cos - omega**2 * sin], axis=1)
    return theta, omega, alpha, M * (acceleration + np.array([0.0, G]))


def test_a_driven_pendulum_is_the_closed_form():
    m, arm_, system, motion = arm()
    theta, omega, alpha, pin = closed_form()
    torque = (J + M * R**2) * alpha + M * G * R * np.cos(theta)
    forces = system.forces(motion)
    drive = forces.drive("motor")
    assert forces.drives == ["motor"] and drive.effort.unit == "N m" and drive.power.unit == "W"
    np.testing.assert_allclose(drive.effort.value, torque, atol=1e-12)
    np.testing.assert_allclose(drive.power.value, torque * omega, atol=1e-12)
    assert drive.effort.rms == pytest.approx(np.sqrt(np.mean((torque[1:] ** 2 + torque[:-1] ** 2) / 2)))
    k = int(np.argmax(np.abs(torque)))
    assert drive.peak.value == pytest.approx(torque[k]) and drive.peak.t == T[k] and "N m at" in str(drive.peak)
    on = forces.reaction("O").on(arm_)
    np.testing.assert_allclose(on.force, pin, atol=1e-11)
    np.testing.assert_allclose(on.torque, 0.0, atol=1e-12)
    np.testing.assert_allclose(on.magnitude.value, np.linalg.norm(pin, axis=1), atol=1e-11)
    np.testing.assert_allclose(on.component("F_x").value, pin[:, 0], atol=1e-11)
    assert [one.name.split(".")[-1] for one in on.components] == ["F_x", "F_y", "T"]
    # By the axes of the body, and about its far end: F is turned back by θ, T is −l e × F.
    along = pin[:, 0] * np.cos(theta) + pin[:, 1] * np.sin(theta)
    across = -pin[:, 0] * np.sin(theta) + pin[:, 1] * np.cos(theta)
    np.testing.assert_allclose(on.in_body().force, np.stack([along, across], axis=1), atol=1e-11)
    np.testing.assert_allclose(on.at(arm_.end).torque, -L * across, atol=1e-11)
    np.testing.assert_allclose(on.about((1.0, 0.0)).torque, -pin[:, 1], atol=1e-11)
    np.testing.assert_allclose(forces.on_ground.on(m.ground).force, -pin, atol=1e-11)
    # The pin holds the whole torque of the motor against the ground: the shaking moment about the origin.
    np.testing.assert_allclose(forces.on_ground.on(m.ground).torque, -torque, atol=1e-11)
    np.testing.assert_allclose(forces.sum(["O", "motor"]).on(arm_).force, pin, atol=1e-11)
    np.testing.assert_allclose(forces.reaction("motor").power.value, torque * omega, atol=1e-11)
    np.testing.assert_allclose(forces.energy.kinetic.value, 0.5 * (J + M * R**2) * omega**2, atol=1e-12)
    np.testing.assert_allclose(forces.energy.potential.value, M * G * R * np.sin(theta), atol=1e-12)
    balance = forces.balance
    assert balance.worst < 1e-13 and "power balance" in str(balance)
    left = balance.drives.value + balance.loads.value - balance.kinetic.value
    np.testing.assert_allclose(balance.left.value, left, atol=1e-13 * balance.largest)


def test_engines_agree_and_say_which_they_were():
    _, _, system, motion = arm()
    plain, program = (system.forces(motion, engine=engine) for engine in ("step-by-step", "compiled"))
    # The first time is computed by both, and compared.
    assert plain.engine == (0, 0) and program.engine == (len(T) - 1, 0)
    assert plain.why_not_compiled is None and program.why_not_compiled is None
    for name, values in plain.columns().items():
        np.testing.assert_allclose(program.columns()[name], values, atol=1e-11)
    column = plain.named("O on arm.F_x")
    assert column.name == "O on arm.F_x" and column.unit == "N"
    np.testing.assert_allclose(column.value, closed_form()[3][:, 0], atol=1e-11)


def test_a_sweep_keeps_columns_of_forces():
    _, _, system, _ = arm()
    # A pin off the centre line turns the lever arm of the weight: cases against the closed form of each.
    rows = [[-L / 2], [-L / 2 + 0.05]]
    keep = ["motor max", ("O on arm.F_x", "min"), "arm.theta max"]
    for lanes in (True, False):
        found = kin.sweep(system, ["O.u_j.x"], rows, T, keep, lanes=lanes)
        assert found.status == ["", ""]
        for k, (u,) in enumerate(rows):
            theta, omega, alpha = 0.2 + 2 * T + 0.3 * T**2, 2 + 0.6 * T, 0.6
            r = R - L / 2 - u
            effort = (J + M * r**2) * alpha + M * G * r * np.cos(theta)
            force = -M * r * (alpha * np.sin(theta) + omega**2 * np.cos(theta))
            np.testing.assert_allclose(found.values[k], [effort.max(), force.min(), theta.max()], atol=1e-11)
    # A misspelt name is told before anything is computed, and takes no good column along.
    with pytest.raises(kin.UnknownName, match="`motr`.*`motor`"):
        kin.sweep(system, ["O.u_j.x"], rows, T, ["motor max", "motr max"])
    with pytest.raises(ValueError, match="only these have rates"):
        kin.sweep(system, ["O.u_j.x"], rows, T, ["motor max_rate"])


def test_tables_and_files(tmp_path):
    pandas = pytest.importorskip("pandas", reason="NOT RUN: pandas is not installed")
    _, _, system, motion = arm()
    forces = system.forces(motion)
    table = forces.to_pandas()
    np.testing.assert_allclose(table["O on arm.F_x [N]"], closed_form()[3][:, 0], atol=1e-11)
    forces.write_csv(tmp_path / "new" / "forces.csv")
    read = pandas.read_csv(tmp_path / "new" / "forces.csv")
    np.testing.assert_array_equal(read.iloc[:, 1:].to_numpy(), table.iloc[:, 1:].to_numpy())
    if pytest.importorskip("pyarrow", reason="NOT RUN: pyarrow is not installed"):
        assert forces.to_arrow().num_rows == len(T)


def test_masses_are_in_files():
    m, _, system, motion = arm()
    again = kin.Mechanism.from_json(m.to_json()).build()
    np.testing.assert_array_equal(again.forces(motion_of(again)).drive("motor").effort.value,
                                  system.forces(motion).drive("motor").effort.value)  # fmt: skip


def motion_of(system):
    return system.run(T)


def door():
    m = kin.Mechanism("door")
    door, z = m.spatial("door", (0.5, 0.0, 1.0)), (0.0, 0.0, 1.0)
    for name, height in (("hinge 1", 0.3), ("hinge 2", 1.7)):
        m.add(name, kin.spatial.revolute(door, m.ground, (-0.5, 0.0, height - 1.0), (0.0, 0.0, height), z, z))
    m.add("hand", kin.spatial.drive_turn(door, m.ground, z, z, kin.Law.ramp(0.5)))
    m.mass(door, 20.0, (0.0, 0.0, 0.0), (8.0, 7.0, 2.0))
    m.gravity((0.0, 0.0, -G))
    system = m.build()
    return door, system, system.run([0.0, 0.5])


def test_what_is_not_unique_is_an_error_by_name_and_shared_by_a_rule():
    door_, system, motion = door()
    forces = system.forces(motion)
    with pytest.raises(kin.NotUnique, match="hinge 1"):
        forces.reaction("hinge 1").on(door_).component("F_z")
    both = forces.sum(["hinge 1", "hinge 2"]).on(door_)
    np.testing.assert_allclose(both.component("F_z").value, 20 * G, rtol=1e-12)
    assert both.force.shape == (2, 3) and both.torque.shape == (2, 3)
    shared = system.forces(motion, sharing="least norm")
    np.testing.assert_allclose(shared.reaction("hinge 1").on(door_).force[:, 2], 10 * G, rtol=1e-9)


def test_shapes_have_their_masses():
    steel = kin.Solid.STEEL
    bar = kin.Solid.bar(0.4, 0.02, 0.01, steel)
    assert bar.mass == pytest.approx(steel * 0.4 * 0.02 * 0.01)
    assert bar.inertia[2][2] == pytest.approx(bar.mass * (0.4**2 + 0.02**2) / 12)
    disc = kin.Solid.disc(0.1, 0.01, steel)
    assert disc.inertia[2][2] == pytest.approx(0.5 * disc.mass * 0.01)
    ball, rod = kin.Solid.sphere(0.1, steel), kin.Solid.cylinder(0.1, 0.3, steel)
    assert ball.inertia[0][0] == pytest.approx(0.4 * ball.mass * 0.01)
    assert rod.inertia[0][0] == pytest.approx(0.5 * rod.mass * 0.01)
    plate = kin.Solid.plate([(0, 0), (0.4, 0), (0.4, 0.02), (0, 0.02)], 0.01, steel)
    assert plate.mass == pytest.approx(bar.mass) and plate.centre == pytest.approx((0.2, 0.01, 0.0))
    two = bar.at((0.2, 0, 0)).and_(bar.at((-0.2, 0, 0)))
    long = kin.Solid.cuboid(0.8, 0.02, 0.01, steel)
    np.testing.assert_allclose(two.inertia, long.inertia, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(long.without(bar.at((0.2, 0, 0))).inertia, bar.inertia, rtol=1e-9, atol=1e-15)
    half = np.sqrt(0.5)
    np.testing.assert_allclose(bar.turned((half, 0, 0, half)).inertia[0][0], bar.inertia[1][1], rtol=1e-12)
    m = kin.Mechanism("with a solid")
    body = m.link("body", 0.4)
    m.solid(body, bar)
    m.add("O", kin.revolute(m.ground, body, (0, 0), body.start))
    m.add("motor", kin.drive_angle(body, kin.Law.polynomial([0.0, 0.0, 0.5])))
    system = m.build()
    effort = system.forces(system.run(T)).drive("motor").effort.value
    np.testing.assert_allclose(effort, bar.inertia[2][2] + bar.mass * 0.04, rtol=1e-12)


def test_tolerances_are_those_on_paper():
    m = kin.Mechanism("slider-crank")
    a, b = m.dimension("crank", 0.1, "m", tolerance=1e-4), m.dimension("rod", 0.3, "m", tolerance=2e-4)
    crank, rod = m.link("crank", a), m.link("rod", b)
    slider = m.planar("slider", a + b)
    m.add("O", kin.revolute(crank, m.ground, crank.start, (0, 0)))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("guide", kin.prismatic(slider, m.ground, (0, 0), (0, 0), (0, 1), 0.0))
    m.add("motor", kin.drive_angle(crank, kin.Law.linear(0.3, 1.0)))
    system = m.build()
    motion = system.run(np.linspace(0, 6, 61))
    outer = system.tolerance(motion, slider.x, "max")
    assert outer.worst_case == pytest.approx(3e-4, abs=1e-12) and outer.rss == pytest.approx(np.hypot(1, 2) * 1e-4)
    assert [one.name for one in outer.contributions] == ["rod", "crank"]
    assert [one.share for one in outer.contributions] == pytest.approx([2 / 3, 1 / 3])
    assert sum(one.share_of_variance for one in outer.contributions) == pytest.approx(1.0)
    assert outer.nominal == pytest.approx(0.4) and outer.corners[1] == pytest.approx(0.4003)
    assert outer.unit == "m" and "67 %" in str(outer) and "RSS" in str(outer)
    worst = system.tolerance(motion, "slider.x")
    slopes = system.sensitivities(motion, ["crank", "rod"]).of("slider.x")
    stack = np.abs(slopes["crank"].value) * 1e-4 + np.abs(slopes["rod"].value) * 2e-4
    assert worst.worst_case == pytest.approx(stack.max()) and worst.t == motion.times[np.argmax(stack)]
    with pytest.raises(kin.DimensionError, match="no dimension that changes the motion has a tolerance"):
        _, arm_, other, moved = arm()
        other.tolerance(moved, arm_.theta)


def refused_masses(m, body):
    return [
        (lambda: m.mass(m.ground, 1.0, (0, 0), 0.1), kin.Error, "the ground does not move"),
        (lambda: m.mass(body, 0.0, (0, 0), 0.1), kin.Error, "`arm`"),
        (lambda: m.mass(body, np.nan, (0, 0), 0.1), kin.Error, "`arm`"),
        (lambda: m.mass(body, 1.0, (0, 0), (1, 2, 3)), TypeError, "one moment about its centre"),
        (lambda: m.mass(body, 1.0, (0,), 0.1), TypeError, "two or three components"),
        (lambda: m.mass("arm", 1.0, (0, 0), 0.1), TypeError, "takes a body"),
        (lambda: m.mass(kin.Mechanism("other").planar("b"), 1.0, (0, 0), 0.1), kin.ForeignBody, "`mass`"),
        (lambda: m.gravity((0.0,)), TypeError, "two or three components"),
        (lambda: m.mass(body, kin.Mechanism("other").dimension("d", 1.0), (0, 0), 0.1), kin.DimensionError, "of another"),
        (lambda: kin.Solid.bar(m.dimension("d", 1.0), 0.1, 0.1, 1.0), TypeError, "Write `.value`"),
        (lambda: kin.Solid.plate([(0, 0), (1, 0)], 0.1, 1.0), ValueError, "`plate`"),
    ]


def test_mistakes_of_masses_and_forces():
    m, arm_, system, motion = arm()
    for make, kind, words in refused_masses(m, arm_):
        with pytest.raises(kind, match=words):
            make()
    forces = system.forces(motion)
    other = kin.Mechanism("other").planar("b")
    for make, kind, words in [
        (lambda: forces.reaction("P").on(arm_).force, kin.UnknownName, "P"),
        (lambda: forces.drive("O"), kin.Error, "`O`"),
        (lambda: forces.reaction("O").on(other), kin.ForeignBody, "`on`"),
        (lambda: forces.reaction("O").on(arm_).component("F_z"), kin.UnknownName, "F_z"),
        (lambda: forces.reaction("O").on(arm_).component("F_x F_y"), ValueError, "no component"),
        (lambda: forces.sum([]), ValueError, "at least"),
        (lambda: forces.named("O on arm.F_z"), kin.UnknownName, "O on arm.F_x"),
        (lambda: system.forces(motion, sharing="fairly"), ValueError, "least norm"),
        (lambda: system.forces(motion, engine="fast"), ValueError, "compiled"),
        (lambda: system.forces(motion, ["O"], engine="compiled"), ValueError, "Leave `engine` out"),
        (lambda: system.tolerance(motion, arm_.theta, "most"), ValueError, "max"),
    ]:
        with pytest.raises(kind, match=words):
            make()
    bare = kin.Mechanism("bare")
    x = bare.length("x", 0.0)
    bare.add("motor", kin.drive(x, 0.0))
    system = bare.build()
    with pytest.raises(kin.Error, match="mass"):
        system.forces(system.run([0.0, 1.0]))
    assert not system.has_forces
    with pytest.raises(kin.UnknownName, match="`motr`") as told:
        kin.sweep(system, ["motor.law.c"], [[0.1]], [0.0, 1.0], ["motr max"])
    assert "mass" not in str(told.value)
