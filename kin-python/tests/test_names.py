"""Questions that Rust's API answers, under the same names: each against a number from elsewhere."""

import gc
import pickle

import numpy as np
import pytest
from test_mechanism import four_bar

import kin

TIMES = np.linspace(0.0, 6.0, 61)


def slider_crank(mass=True):
    m = kin.Mechanism("slider-crank")
    a, b = m.dimension("crank", 0.1, "m", tolerance=1e-4), m.dimension("rod", 0.3, "m", tolerance=2e-4, distribution="uniform")
    crank, rod = m.link("crank", a), m.link("rod", b)
    slider = m.planar("slider", a + b)
    m.add("O", kin.revolute(crank, m.ground, crank.start, (0, 0)))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("guide", kin.prismatic(slider, m.ground, (0, 0), (0, 0), (0, 1), 0.0))
    m.add("motor", kin.drive_angle(crank, kin.Law.linear(0.3, 1.0)))
    if mass:
        m.mass(slider, 2.0, (0, 0), 0.001)
        m.gravity((0, -9.81))
    return m, crank, rod, slider


def drum(coefficient=0.1):
    m = kin.Mechanism("drum")
    body = m.planar("drum")
    m.add("shaft", kin.revolute(body, m.ground, (0, 0), (0, 0)))
    m.friction("shaft", kin.Friction.pin(coefficient, 0.02, 1e-3))
    m.add("motor", kin.drive_angle(body, kin.Law.ramp(5.0)))
    m.mass(body, 30.0, (0, 0), 0.6)
    m.gravity((0, -9.81))
    return m, body


def test_friction_in_a_pin_takes_its_torque():
    """μ r F, by `coefficient`, radius and weight; and in a copy, which is a file."""
    for m in (drum()[0], kin.Mechanism.from_json(drum()[0].to_json())):
        system = m.build()
        motion = system.run([0.0, 1.0])
        forces = system.forces(motion)
        torque = 0.1 * 0.02 * 30.0 * 9.81
        assert abs(forces.drive("motor").peak.value - torque) < 1e-12
        np.testing.assert_allclose(forces.friction("shaft").on(m["drum"]).torque, -torque, rtol=1e-12)
        np.testing.assert_allclose(forces.friction("shaft").power.value, -5.0 * torque, rtol=1e-12)
    with pytest.raises(kin.UnknownName, match="motor"):
        forces.friction("motor")
    with pytest.raises(kin.UnknownName, match="no constraint `pin`"):
        m.friction("pin", kin.Friction.pin(0.1, 0.02, 1e-3))
    with pytest.raises(kin.InvalidParameters, match="radius"):
        m.friction("shaft", kin.Friction.pin(0.1, -0.02, 1e-3))
    with pytest.raises(TypeError, match="is no friction"):
        m.friction("shaft", 0.1)
    with pytest.raises(ValueError, match="belongs to a pin"):
        kin.Friction.slide(0.1, (0.2, 0.1), 1e-3).length(0.1)


@kin.constraint
def pushed_at(i: kin.Planar, arm: float, law: kin.Law, t: kin.Time):
    """The point at `arm` beside the block's line is as far along x as the law says.  [m]"""
    return i.point((0, arm)).x - law.at(t)


def test_a_block_that_jams_is_an_exception_with_its_fields():
    """P = load/(1 − 2 μ a/L), and no such P where a ≥ L/(2 μ)."""

    def block(arm):
        m = kin.Mechanism("block")
        body = m.planar("block", 0.1)
        m.add("guide", kin.prismatic(body, m.ground, (0, 0), (0, 0), (0, 1), 0.0))
        m.friction("guide", kin.Friction.slide(0.3, (0.1, 0.0), 1e-9))
        m.add("push", pushed_at(body, arm, kin.Law.linear(0.1, 0.5)))
        m.load("load", kin.Load.force(body, (0, 0), (-100.0, 0.0)))
        system = m.build()
        motion = system.run([0.0, 1.0])
        return system, motion

    system, motion = block(0.1)
    found = system.forces(motion).drive("push").peak.value
    assert abs(found - 100.0 / (1.0 - 2 * 0.3 * 0.1 / 0.1)) < 1e-9 * found
    system, motion = block(0.2)
    with pytest.raises(kin.Jammed, match="already requires infinite forces") as told:
        system.forces(motion)
    error = told.value
    assert error.constraint == "guide" and error.t == 0.0 and error.drives == ["push"]
    assert abs(error.share - 0.1 / (2 * 0.3 * 0.2)) < 1e-6
    assert pickle.loads(pickle.dumps(error)).share == error.share


@kin.constraint
def tip(theta: kin.Coord, length: float):
    """The end of an arm in one coordinate.  [m]"""
    return length * kin.cos(theta), length * kin.sin(theta)


def test_a_point_mass_swings_as_its_closed_form_says():
    """T = m l² θ̈ + m g l cos θ, and the file carries the point."""
    m = kin.Mechanism("bare")
    theta = m.angle("theta", 0.2)
    m.add("motor", kin.drive(theta, kin.Law.sine(0.7, 2.0, 0.3)))
    m.point_mass("bob", tip(theta, 0.4), 2.5)
    m.gravity((0, -9.81))
    for mechanism in (m, kin.Mechanism.from_json(m.to_json())):
        system = mechanism.build()
        motion = system.run(TIMES)
        effort = system.forces(motion).drive("motor").effort.value
        x = motion["theta"]
        wanted = 2.5 * 0.16 * x.acceleration + 2.5 * 9.81 * 0.4 * np.cos(x.value)
        np.testing.assert_allclose(effort, wanted, rtol=0, atol=1e-12)
    with pytest.raises(kin.Error, match="above zero"):
        m.point_mass("other", tip(theta, 0.4), 0.0)
    with pytest.raises(TypeError, match="is no point"):
        m.point_mass("other", (0, 0), 1.0)


def test_a_motion_from_states_has_forces():
    """A pendulum let go at rest: what would hold it there needs no torque."""
    m = kin.Mechanism("pendulum")
    bob = m.planar("bob")
    m.add("O", kin.revolute(bob, m.ground, (0, 0), (0, 0)))
    m.add("swing", kin.drive_angle(bob, 0.0))
    m.mass(bob, 2.0, (0, -0.5), 0.02)
    m.gravity((0, -9.81))
    system = m.build()
    alpha = -2.0 * 9.81 * 0.5 * np.sin(0.3) / (0.02 + 2.0 * 0.25)
    motion = kin.Motion.from_states(system, [0.0], [[0, 0, 0.3]], np.zeros((1, 3)), [[0, 0, alpha]])
    assert abs(system.forces(motion).drive("swing").effort.value[0]) < 1e-14
    with pytest.raises(ValueError, match="`qd` has a row of 3 numbers for each of the 1 times"):
        kin.Motion.from_states(system, [0.0], [[0, 0, 0.3]], np.zeros((1, 2)), [[0, 0, alpha]])
    with pytest.raises(kin.Error, match="finite"):
        kin.Motion.from_states(system, [0.0], [[0, 0, np.nan]], np.zeros((1, 3)), np.zeros((1, 3)))


def test_a_toggle_moves_with_dimensions():
    """0.3 + 0.1 t = rod: dt*/d rod = 10."""
    m = kin.Mechanism("reach")
    rod = m.link("rod", m.dimension("rod", 0.5))
    slider = m.planar("slider", 0.4, 0.3)
    m.add("O", kin.revolute(rod, m.ground, rod.start, (0, 0)))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("upright", kin.drive_angle(slider, 0.0))
    m.add("lift", kin.drive(slider.y, kin.Law.linear(0.3, 0.1)))
    system = m.build()
    with pytest.raises(kin.Toggle) as told:
        system.run(np.linspace(0, 4, 41))
    toggle = told.value.motion.singular_positions[-1]
    assert abs(toggle["t"] - 2.0) < 1e-9
    assert abs(system.toggle_by(toggle, ["rod"])["rod"] - 10.0) < 1e-9
    with pytest.raises(ValueError, match="`toggle` is one of the singular positions of a motion"):
        system.toggle_by({}, ["rod"])


def test_tolerances_are_stacked_sampled_and_proved():
    """Crank and rod in line: x = a + b; the stroke is 2 a, whatever the rod is."""
    m, _, _, slider = slider_crank()
    system = m.build()
    motion = system.run(TIMES)
    extremes = system.extremes(motion, slider.x)
    for of in ("max", extremes.max):
        outer = system.tolerance(motion, slider.x, of)
        assert abs(outer.worst_case - 3e-4) < 1e-15 and outer.contributions[0].name == "rod"
        assert outer.contributions[0].distribution == "uniform" and outer.proved is None
    sigma = np.hypot(1e-4 / 3, 2e-4 / np.sqrt(3))
    assert abs(outer.sigma - sigma) < 1e-12
    assert abs(system.tolerance(motion, slider.x, "stroke").worst_case - 2e-4) < 1e-15
    at = system.tolerance(motion, slider.x, 1.0)
    assert at.t == 1.0 and at.second_order is not None and at.second_order.hessian.shape == (2, 2)
    proved = system.tolerance_proved(motion, slider.x, 1.0)
    assert proved.proved is not None and proved.proved.low <= at.corners[0] <= at.corners[1] <= proved.proved.high
    samples = system.samples(motion, slider.x, "max", count=20_000, seed=7)
    assert samples.missing == 0 and len(samples.values) == 20_000 and np.all(np.diff(samples.values) >= 0)
    assert abs(samples.mean - 0.4) < 4 * sigma / np.sqrt(20_000) and abs(samples.sigma / sigma - 1) < 0.02
    assert samples.quantile(0.0) == samples.values[0] and np.isnan(samples.quantile(2.0))
    assert "20000 samples of seed 7" in str(samples)
    again = system.samples(motion, slider.x, "max", count=20_000, seed=7)
    np.testing.assert_array_equal(again.values, samples.values)
    for wrong in ("most", None):
        with pytest.raises((ValueError, TypeError), match="`of`"):
            system.tolerance_proved(motion, slider.x, wrong)
    with pytest.raises(ValueError, match='distribution: "normal"'):
        m.dimension("other", 1.0, distribution="gaussian")


def test_a_clearance_is_off_in_its_disc():
    """A pin with play at the end of a rod that is stretched along x: x is off by the radius at most."""
    m = kin.Mechanism("play")
    arm, slider = m.planar("arm"), m.planar("slider", 0.5)
    m.add("O", kin.revolute(arm, m.ground, (0, 0), (0, 0)))
    gap = m.clearance("pin", 1e-3)
    m.add("B", kin.revolute(slider, arm, (0, 0), kin.vec2(0.5, 0) + gap))
    m.add("upright", kin.drive_angle(slider, 0.0))
    m.add("motor", kin.drive_angle(arm, 0.0))
    system = m.build()
    motion = system.run([0.0])
    found = system.tolerance(motion, slider.x, 0.0)
    assert [(one.name, one.distribution) for one in found.contributions] == [("pin", "disc")]
    assert abs(found.worst_case - 1e-3) < 1e-12
    samples = system.samples(motion, slider.x, 0.0, count=5000)
    assert abs(samples.values[0] - 0.499) < 1e-4 and abs(samples.sigma - 0.5e-3) < 2e-5
    assert system.dimensions == {"pin.x": 0.0, "pin.y": 0.0}


def test_sensitivities_of_coordinates_and_extremes():
    m, _, _, slider = slider_crank()
    system = m.build()
    motion = system.run(TIMES)
    by = system.sensitivities(motion, ["crank", "motor.law.rate"])
    column = motion.names.index("crank.theta")
    rate = by.all()["motor.law.rate"]
    np.testing.assert_allclose(rate.q[:, column], TIMES, atol=1e-12)
    np.testing.assert_allclose(rate.qd[:, column], 1.0, atol=1e-12)
    np.testing.assert_allclose(by.of("crank.theta")["motor.law.rate"].value, TIMES, atol=1e-12)
    extremes = system.extremes(motion, slider.x)
    outer, inner = extremes.max, extremes.min
    # θ = 0.3 + ω t = 2 π at the outer dead centre: dt/dω = −t/ω.
    found = by.extreme(slider.x, outer)
    assert abs(found["crank"].value - 1.0) < 1e-9 and abs(found["motor.law.rate"].t + outer.t) < 1e-8
    assert abs(by.between(slider.x, outer, inner)["crank"].value - 2.0) < 1e-9


def test_rates_of_one_position_and_how_good_they_are():
    m, _, _, slider = slider_crank()
    system = m.build()
    motion = system.run(TIMES, jerk=True)
    k = 30
    state = motion.q[k], motion.qd[k], motion.qdd[k]
    np.testing.assert_allclose(system.jerk(*state, TIMES[k]), motion.qddd[k], rtol=0, atol=1e-10)
    rhs = system.jerk_rhs(*state, TIMES[k])
    np.testing.assert_allclose(system.jacobian(motion.q[k], TIMES[k]) @ motion.qddd[k], rhs, atol=1e-10)
    condition = system.condition(motion)
    assert condition.unit == "-" and np.all(condition.value >= 1.0)
    assert condition.times[np.argmax(condition.value)] == condition.at_max
    assert system.constraints == ["O", "A", "B", "guide", "motor"] and system.loads == []
    assert system.bodies == ["crank", "rod", "slider"]


def test_a_label_leads_back_to_its_assembly():
    system = four_bar().build()
    all_of_them = system.assemblies(0.0, seed=3)
    assert len(all_of_them) == 2
    for one in all_of_them:
        np.testing.assert_allclose(system.assembly(0.0, one.label, seed=3).q, one.q, atol=1e-9)
    assert isinstance(all_of_them, kin.Assemblies) and all_of_them.complete == "believed"
    assert "starting poses" in all_of_them.reason and all_of_them[0].label == list(all_of_them)[0].label
    cut_short = system.assemblies(0.0, starts=2)
    assert cut_short.complete == "unknown" and "2 starting poses" in cut_short.reason
    with pytest.raises(kin.UnknownName, match="label"):
        system.assembly(0.0, "left")
    with pytest.raises(TypeError, match="there is no option `effort`"):
        system.assemblies(0.0, effort=3)


def test_a_proof_is_told_step_by_step():
    system = four_bar().build()
    motion = system.run(np.linspace(0, 1, 201))
    proof = system.prove(motion)
    assert proof.is_complete and proof.first_unproved is None and proof.trusted == []
    step = proof.steps[7]
    assert (step.start, step.end) == (motion.times[7], motion.times[8]) and step.doubt is None
    assert np.all(step.radius < step.alone) and len(proof.errors) == 201 and np.all(proof.errors[3] < 1e-9)
    # A crank that comes to a change point: nothing is proved where two motions cross.
    m = kin.Mechanism("parallelogram")
    a, b, c = m.link("a", 1.0), m.link("b", 2.0), m.link("c", 1.0)
    m.add("O", kin.revolute(m.ground, a, (0, 0), a.start))
    m.add("A", kin.revolute(a, b, a.end, b.start))
    m.add("B", kin.revolute(b, c, b.end, c.end))
    m.add("C", kin.revolute(m.ground, c, (2, 0), c.start))
    m.add("motor", kin.drive_angle(a, kin.Law.linear(0.5, -1.0)))
    m.prefer(c, 0.5)
    system = m.build()
    crossing = system.prove(system.run(np.linspace(0, 1, 5)))
    doubtful = crossing.first_unproved
    assert not crossing.is_complete and doubtful.doubt and doubtful.radius is None
    assert doubtful.start <= doubtful.doubt_at <= doubtful.end and doubtful.start <= 0.5 <= doubtful.end


def test_a_program_is_told_in_numbers():
    program = four_bar().build().compile()
    assert len(program.substituted) + len(program.unknowns) == 9 and sum(program.blocks) == len(program.unknowns)
    assert program.steps > 50 and "four-bar" in str(program)


def test_derived_quantities_of_a_motion():
    m, crank, rod, slider = slider_crank()
    motion = m.build().run(TIMES, jerk=True)
    length = motion.distance(slider, (0, 0), m.ground, (0, 0))
    np.testing.assert_allclose(length.value, motion[slider.x].value, atol=1e-12)
    np.testing.assert_allclose(length.velocity, motion[slider.x].velocity, atol=1e-12)
    # The instant centre of the rod is above the slider, on the line of the crank.
    centre = motion.instant_centre(rod, m.ground)
    theta = motion[crank.theta].value
    np.testing.assert_allclose(centre[:, 0], motion[slider.x].value, atol=1e-9)
    np.testing.assert_allclose(centre[:, 1], centre[:, 0] * np.tan(theta), atol=1e-7)
    across = motion.transmission_angle(rod, (m.ground, (0, 1)))
    slope = np.abs(motion[rod.theta].value)
    np.testing.assert_allclose(across.value, np.pi / 2 - slope, atol=1e-12)
    with pytest.raises(TypeError, match="this point is given by the dimension `.* rod`. Weld a body there"):
        motion.point(rod, rod.start)
    point = motion.point(rod, rod.start.value)
    np.testing.assert_allclose(point.along((2, 0)).acceleration, point.a[:, 0], atol=1e-14)
    np.testing.assert_allclose(point.acceleration_magnitude, 0.1, atol=1e-12)
    np.testing.assert_allclose(point.jerk_magnitude, 0.1, atol=1e-10)
    np.testing.assert_allclose(motion.relative_angle(rod, m.ground).value, motion[rod.theta].value, atol=0)
    assert motion.worst in m.build().equations and motion.misfit == 0.0 and motion.breaks == []
    assert {one.name for one in motion.displaced} <= {"crank", "rod", "slider"}
    with pytest.raises(TypeError, match="planar bodies"):
        motion.distance(crank.x, (0, 0), m.ground, (0, 0))


def test_a_body_in_space_turns_about_its_axis():
    m = kin.Mechanism("top")
    body = m.spatial("top")
    m.add("pin", kin.spatial.revolute(body, m.ground, (0, 0, 0), (0, 0, 0), (0, 0, 1), (0, 0, 1)))
    m.add("motor", kin.spatial.drive_turn(body, m.ground, (0, 0, 1), (0, 0, 1), kin.Law.ramp(3.0)))
    rotation = m.build().run([0.0, 0.1]).rotation(body)
    np.testing.assert_allclose(rotation.speed, 3.0, rtol=1e-12)
    np.testing.assert_allclose(rotation.about((0, 0, 5)), 3.0, rtol=1e-12)


def test_breaks_of_laws_are_told():
    m = kin.Mechanism("rise")
    x = m.length("x", 0.0)
    m.add("motor", kin.drive(x, kin.Law.harmonic_rise(0.1, 1.0)))
    crossed = m.build().run(np.linspace(0, 2, 21)).breaks
    assert [(one.constraint, one.x, one.order) for one in crossed] == [("motor", 1.0, 2)]
    assert crossed[0].between[0] < 1.0 <= crossed[0].between[1]


def test_arrays_of_a_motion_are_read_where_they_lie():
    system = four_bar().build()
    motion = system.run(np.linspace(0, 1, 1001), jerk=True)
    for name in ("times", "q", "qd", "qdd", "qddd"):
        array = getattr(motion, name)
        which = ["q", "qd", "qdd", "qddd", "times"].index(name)
        assert np.shares_memory(array, np.asarray(motion._native.rows(which))) and not array.flags.writeable
    kept, wanted = motion.qdd, motion.qdd.copy()
    del motion
    gc.collect()
    for _ in range(20):
        system.run(np.linspace(0, 1, 1001))
    np.testing.assert_array_equal(kept, wanted)


def test_forces_say_about_which_point_and_what_is_not_unique():
    m, crank, rod, slider = slider_crank()
    m.load("push", kin.Load.force(slider, (0.1, 0.05), (-3.0, 0.0)))
    system = m.build()
    motion = system.run(TIMES)
    forces = system.forces(motion)
    assert forces.loads == ["push"] == system.loads
    pin = forces.reaction("A").on(rod)
    np.testing.assert_allclose(pin.points, motion.point(rod, rod.start.value).r, atol=1e-12)
    assert pin.not_unique == []
    # Two hinges share the thrust of a door: along the axis neither has one of its own.
    m = kin.Mechanism("door")
    door = m.spatial("door")
    for k, z in enumerate((0.0, 2.0)):
        m.add(f"hinge {k}", kin.spatial.revolute(door, m.ground, (0, 0, z), (0, 0, z), (0, 0, 1), (0, 0, 1)))
    m.add("motor", kin.spatial.drive_turn(door, m.ground, (0, 0, 1), (0, 0, 1), kin.Law.ramp(1.0)))
    m.mass(door, 10.0, (0.4, 0, 1.0), (1, 1, 1))
    m.gravity((0, 0, -9.81))
    system = m.build()
    forces = system.forces(system.run([0.0, 0.5]))
    hinge = forces.reaction("hinge 0").on(door)
    assert "F_z" in hinge.not_unique
    with pytest.raises(kin.NotUnique, match="hinge 0"):
        hinge.force  # noqa: B018
    both = forces.sum(["hinge 0", "hinge 1"]).on(door).component("F_z")
    np.testing.assert_allclose(both.value, 98.1, rtol=1e-10)


def pump(rod, angle, law):
    """A slider-crank with a crank of length 1 that its slider drives, with a torque on its crank."""
    m = kin.Mechanism("pump")
    crank, coupler, slider = m.link("crank", 1.0), m.link("rod", rod), m.planar("slider", law.at(0.0))
    m.add("O", kin.revolute(crank, m.ground, crank.start, (0, 0)))
    m.add("A", kin.revolute(crank, coupler, crank.end, coupler.start))
    m.add("B", kin.revolute(coupler, slider, coupler.end, (0, 0)))
    m.add("guide", kin.prismatic(slider, m.ground, (0, 0), (0, 0), (0, 1), 0.0))
    m.add("push", kin.drive(slider.x, law))
    m.prefer(crank, angle)
    m.load("brake", kin.Load.torque(crank, 3.0))
    return m.build()


def test_forces_grow_towards_a_dead_centre():
    """At x = r + l: x = r + l − ½ k φ² there, so that the force goes as |t − t*| to the power −1/2."""
    system = pump(2.5, kin.deg(60), kin.Law.linear(2.4, 0.4))
    with pytest.raises(kin.Toggle) as stopped:
        system.run(np.linspace(0.0, 5.0, 51))
    growth = system.forces(stopped.value.motion).growth()
    assert {one.constraint: one.power for one in growth} == {"O": -0.5, "A": -0.5, "B": -0.5, "push": -0.5}
    assert all(abs(one.t - 2.75) < 1e-9 for one in growth)
    assert "like |t − t*|^(−1/2)" in str(growth[0])
    system = slider_crank()[0].build()
    assert system.forces(system.run(TIMES)).growth() == []


def test_forces_at_a_change_point_are_refused_by_name():
    """x = 2 cos φ for a rod as long as the crank, driven by 2 cos t: at 0 both are stretched."""
    system = pump(1.0, -0.5, kin.Law.sine(2.0, 1.0, np.pi / 2).shifted(0.5))
    motion = system.run(np.linspace(0.0, 1.0, 11))
    assert motion.times[5] == 0.5
    with pytest.raises(kin.Unbounded, match="Leave this time out") as refused:
        system.forces(motion)
    assert abs(refused.value.t - 0.5) < 1e-9
    assert {one["constraint"] for one in refused.value.growth} >= {"push"} and all(one["power"] < 0 for one in refused.value.growth)


def test_mechanical_advantage_is_one_over_the_slope():
    """Of the slider over the crank's motor: 1/(dx/dφ)."""
    m, crank, rod, slider = slider_crank()
    system = m.build()
    motion = system.run(np.linspace(0.0, 6.0, 61))
    phi = motion["crank.theta"].value
    a, b = 0.1, 0.3
    slope = -a * np.sin(phi) - a**2 * np.sin(phi) * np.cos(phi) / np.sqrt(b**2 - (a * np.sin(phi)) ** 2)
    advantage = system.mechanical_advantage(motion, "motor", slider.x)
    np.testing.assert_allclose(advantage.value, 1.0 / slope, rtol=1e-10)
    assert advantage.unit == "1/m" and "motor" in advantage.name
    with pytest.raises(kin.UnknownName, match="motor"):
        system.mechanical_advantage(motion, "engine", slider.x)


def test_series_pass_values_as_in_rust():
    """On the way of time: passed between times, on a time, on two times, touched."""
    times = np.array([0.0, 1.0, 2.0, 4.0, 5.0])

    def passed(values, level, clock=times):
        return kin.Quantity("x", "N", clock, np.array(values)).crossings(level)

    assert passed([-1.0, 1.0, 3.0, -1.0, 0.0], 0.0) == [(0.5, True), (3.5, False)]
    assert passed([-1.0, 0.0, 3.0, 0.0, 2.0], 0.0) == [(1.0, True)]
    assert passed([5.0, 2.0, 2.0, 1.0, 1.5], 2.0) == [(1.0, False)]
    assert passed([-1.0, 1.0, 3.0, 3.0, 3.0], 0.0, -times) == [(-0.5, False)]
    assert passed([], 0.0, times[:0]) == []
    peak = kin.Quantity("x", "N", times, np.array([1.0, -3.0, 3.0, 0.0, 0.0])).peak
    assert (peak.value, peak.t, peak.unit) == (-3.0, 1.0, "N")
