"""Positions by values of drivers."""

import math

import numpy as np
import pytest

import kin


def four_bar(lengths=(1.0, 3.5, 3.0, 4.0)):
    crank_length, coupler_length, rocker_length, ground = lengths
    m = kin.Mechanism("four-bar")
    crank = m.link("crank", crank_length)
    coupler = m.link("coupler", coupler_length)
    rocker = m.link("rocker", rocker_length)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, coupler, crank.end, coupler.start))
    m.add("B", kin.revolute(coupler, rocker, coupler.end, rocker.end))
    m.add("C", kin.revolute(m.ground, rocker, (ground, 0), rocker.start))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(2 * math.pi)))
    m.prefer(rocker.theta, 1.75)
    return m.build()


def rocker_angle(angle, lengths=(1.0, 3.5, 3.0, 4.0)):
    """The angle of the rocker by the law of cosines, with the coupler above."""
    a, b, c, d = lengths
    x, y = d - a * math.cos(angle), -a * math.sin(angle)
    span = math.hypot(x, y)
    first = math.atan2(y, x) + math.acos((b * b + span * span - c * c) / (2 * b * span))
    return math.atan2(a * math.sin(angle) + b * math.sin(first), a * math.cos(angle) + b * math.cos(first) - d)


def test_a_value_gives_the_position():
    follower = four_bar().follower()
    here = follower.to(motor=2.5)
    assert here["rocker.theta"] == pytest.approx(rocker_angle(2.5), abs=1e-9)
    assert here.drivers == {"motor": 2.5} == follower.drivers
    assert here.measures["O.angle"] == here["O.angle"]
    assert follower.units == {"motor": "rad"}
    assert here.motion.q.shape == (1, len(here.q))
    with pytest.raises(KeyError, match="rocker.theta"):
        here["rocker"]


def test_arrays_of_values_are_one_call():
    follower = four_bar().follower()
    angles = np.linspace(0, 12, 50)
    path = follower.to(motor=angles)
    assert path.q.shape == (50, 9) and len(path) == 50
    exact = [rocker_angle(angle) for angle in angles]
    assert np.allclose(path["rocker.theta"], exact, atol=1e-9)
    assert path["O.angle"].shape == (50,)
    assert follower.drivers["motor"] == 12


def test_a_dict_names_drivers():
    follower = four_bar().follower()
    assert follower.to({"motor": 1})["rocker.theta"] == pytest.approx(rocker_angle(1), abs=1e-9)


def test_a_toggle_on_the_way_ends_the_move():
    lengths = (2.0, 1.5, 2.2, 3.5)
    system = four_bar(lengths)
    follower = system.follower(0.1)
    with pytest.raises(kin.CannotReach, match="follower stops at `motor`") as stop:
        follower.to(motor=3.0)
    toggle = math.acos((2.0**2 + 3.5**2 - 3.7**2) / (2 * 2.0 * 3.5))
    assert stop.value.reached["motor"] == pytest.approx(toggle, abs=1e-12)
    assert stop.value.asked == {"motor": 3.0}
    assert "coupler" in stop.value.movable and stop.value.singular == "turning-point"
    assert np.array_equal(stop.value.motion.q[0], follower.here.q)
    follower.to(motor=0.5)


def test_a_move_is_proved():
    follower = four_bar().follower()
    proof = follower.prove_to({"motor": 0.3}, 30)
    assert proof.is_complete and proof.proved == 30 and proof.trusted == []
    assert follower.drivers == {"motor": 0.3}
    assert follower.here["rocker.theta"] == pytest.approx(rocker_angle(0.3), abs=1e-9)
    with pytest.raises(kin.Error, match="at least 1 step"):
        follower.prove_to({"motor": 0}, 0)


def test_mistakes_are_named():
    follower = four_bar().follower()
    with pytest.raises(kin.UnknownName, match="`motor`"):
        follower.to(crank=1)
    with pytest.raises(kin.Error, match="nan|NaN"):
        follower.to(motor=math.nan)
    assert follower.drivers == {"motor": 0}


def test_rates_are_those_of_a_run():
    system = four_bar()
    follower = system.follower()
    follower.to(motor=2 * math.pi * 0.3)
    qd, qdd = follower.rates({"motor": 2 * math.pi})
    motion = system.run([0, 0.3])
    assert np.allclose(qd, motion.qd[1], atol=1e-9) and np.allclose(qdd, motion.qdd[1], atol=1e-8)


def test_a_circuit_passes_dead_centres():
    a, b, c, d = lengths = (2.0, 1.5, 2.2, 3.5)
    circuit = four_bar(lengths).follower(0.1).circuit("motor", 181)
    assert circuit.is_closed and circuit.q.shape == (181, 9) and len(circuit.inputs) == 181
    toggle = math.acos((a * a + d * d - (b + c) ** 2) / (2 * a * d))
    assert sorted(dead.input for dead in circuit.dead_centres) == pytest.approx([-toggle, toggle], abs=1e-12)
    assert circuit.range("crank.theta") == pytest.approx((-toggle, toggle), abs=1e-12)
    assert circuit.crossings == [] and circuit.length > 0
    x, y, angle = circuit.q[:, 3], circuit.q[:, 4], circuit.q[:, 5]
    curve = np.stack([x + 0.75 * np.cos(angle), y + 0.75 * np.sin(angle)], axis=1)
    assert np.allclose(np.linalg.norm(curve - [d, 0], axis=1), c)
    assert len(circuit.extremes("rocker.theta")) == 4 or len(circuit.extremes("rocker.theta")) == 2
    with pytest.raises(kin.UnknownName, match="`motor`"):
        four_bar().circuit("crank")


def slider_crank():
    m = kin.Mechanism("slider-crank")
    crank, rod, slider = m.link("crank", 1), m.link("rod", 2), m.planar("slider", 2.5, 0, 0)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("guide", kin.prismatic(slider, m.ground, (0, 0), (0, 0), (0, 1), 0))
    m.add("motor", kin.drive_angle(crank, kin.Law.constant(1)))
    m.prefer(crank.theta, 1)
    m.mass(slider, 2.0, (0, 0), 0.1)
    m.gravity((-9.81, 0))
    return m.build()


def test_other_values_are_given_in_place_of_drivers():
    system = slider_crank()
    follower = system.follower(given=["slider.R_x"])
    here = follower.to({"slider.R_x": 2.5})
    angle = math.acos((1 + 2.5**2 - 4) / 5)
    assert here["crank.theta"] == pytest.approx(angle, abs=1e-12)
    assert here.left_out == {"motor": pytest.approx(angle, abs=1e-12)}
    assert here.drivers == {"slider.R_x": 2.5} and follower.units == {"slider.R_x": "m"}
    again = follower.given("motor")
    assert again.to(motor=0.7)["slider.R_x"] == pytest.approx(math.cos(0.7) + math.sqrt(4 - math.sin(0.7) ** 2))
    assert follower.efforts() == {"slider.R_x": pytest.approx(2 * 9.81)}
    with pytest.raises(kin.Error, match="`slider.R_x` and `crank.theta` are given, but .* 1 freedom"):
        system.follower(given=["slider.R_x", "crank.theta"])
    with pytest.raises(kin.UnknownName, match="`motor`"):
        system.follower(given=["crank"])


def test_a_map_leads_both_ways():
    system = slider_crank()
    forward = system.map(["motor"], ["slider.R_x"])
    here = forward.to(motor=0.7)
    sin, cos = math.sin(0.7), math.cos(0.7)
    root = math.sqrt(4 - sin * sin)
    assert here["slider.R_x"] == pytest.approx(cos + root, abs=1e-13)
    assert here.jacobian == pytest.approx(np.array([[-sin - sin * cos / root]]), abs=1e-13)
    assert here.units == {"motor": "rad", "slider.R_x": "m"}
    back = forward.inverse.here
    assert back["motor"] == pytest.approx(0.7, abs=1e-13)
    assert here.velocities({"motor": 2.0})["slider.R_x"] == pytest.approx(2 * here.jacobian[0, 0])
    assert here.efforts({"slider.R_x": 3.0})["motor"] == pytest.approx(3 * here.jacobian[0, 0])
    h = 1e-4
    rate = forward.jacobian_rate({"motor": 2.0})
    ends = [forward.to(motor=0.7 + s * h).jacobian[0, 0] for s in (-2, 2)]
    assert rate[0, 0] == pytest.approx((ends[1] - ends[0]) / (2 * h), abs=1e-6)
    border = forward.border({"motor": (0.2, 1.2)}, 5)
    assert [one["motor"] for one in border] == pytest.approx([0.2, 0.45, 0.7, 0.95, 1.2])
    assert forward.configuration["crank.theta"] == pytest.approx(0.7 + 2 * h)
    with pytest.raises(KeyError, match="motor"):
        here["crank"]
    with pytest.raises(KeyError, match="slider.R_x"):
        here.efforts({"motor": 1.0})


def test_a_run_leaves_a_dead_centre_in_the_stated_direction():
    m = kin.Mechanism("press")
    crank, rod, slider = m.link("crank", 1), m.link("rod", 2), m.planar("slider", 2.9, 0, 0)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("guide", kin.prismatic(slider, m.ground, (0, 0), (0, 0), (0, 1), 0))
    m.add("cylinder", kin.drive(slider.x, kin.Law.polynomial([3, 0, -0.5])))
    system = m.build()
    times = np.linspace(0, 1, 11)
    for sign in (1, -1):
        motion = system.run(times, start={"crank": sign})
        assert motion.qd[0][2] == pytest.approx(sign * math.sqrt(2 / 3), abs=1e-12)
        assert motion.q[-1][2] == pytest.approx(sign * math.acos((2.5**2 - 3) / 5), abs=1e-11)
    with pytest.raises(kin.Error, match=r'dead centre of `cylinder` .*start=\{"crank'):
        system.run(times)
    with pytest.raises(ValueError, match="one coordinate or body"):
        system.run(times, start={})


def test_a_mechanism_is_printed_as_c():
    system = four_bar()
    text = system.emit("c", name="bar", measures=["rocker.theta"])
    assert "int bar_to(bar_state *s, const double u[]);" in text
    with pytest.raises(kin.CannotEmit, match="no formula of the measure"):
        system.emit("c", measures=["O.angle"])
    with pytest.raises(kin.InvalidOptions, match="does not print the language `lisp`"):
        system.emit("lisp")
