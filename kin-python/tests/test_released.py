"""Positions by wishes, with the drivers released."""

import math

import numpy as np
import pytest

import kin


def arm(angles=(0.4, 1.2), lengths=(0.5, 0.4)):
    m = kin.Mechanism("arm")
    before, links = None, []
    for k, (length, angle) in enumerate(zip(lengths, angles)):
        link = m.link(f"link {k}", length)
        if before is None:
            m.add("joint 0", kin.revolute(m.ground, link, (0, 0), link.start))
        else:
            m.add(f"joint {k}", kin.revolute(before, link, before.end, link.start))
        m.guess(link.theta, angle)
        before = link
        links.append(link)
    return m, links


def test_an_arm_without_motors_is_dragged():
    m, (upper, lower) = arm()
    released = m.released()
    assert released.freedoms == ["link 0.theta", "link 1.theta"]
    reached = released.drag(lower, lower.end, (0.3, 0.6))
    assert reached.is_met and reached.freedoms == []
    elbow = math.acos((0.45 + 0.25 - 0.16) / (2 * math.sqrt(0.45) * 0.5))
    assert released["link 0.theta"] == pytest.approx(math.atan2(0.6, 0.3) - elbow, abs=1e-9)
    assert np.allclose(released.motion.point(lower, lower.end).r[0], (0.3, 0.6), atol=1e-9)
    assert released["joint 1.angle"] == released.measures["joint 1.angle"]


def test_what_is_out_of_reach_is_missed_by_a_distance():
    m, (_, lower) = arm()
    reached = m.released().drag(lower, lower.end, (0, 2))
    assert not reached.is_met
    assert reached.wishes[0].missed == pytest.approx(1.1, abs=1e-9) and reached.wishes[0].unit == "m"
    assert "missed by 1.1 m" in repr(reached)


def test_drivers_of_a_system_are_released():
    m, (upper, lower) = arm()
    m.add("motor", kin.drive_angle(upper, kin.Law.constant(0.4)))
    m.add("second", kin.drive_angle(lower, kin.Law.constant(1.2)))
    system = m.build()
    released = system.released()
    assert released.names == system.names
    assert len(released.freedoms) == 2
    assert released.reach(kin.Wish.measure("link 0.theta", 1.0), kin.Wish.hold("link 1.theta")).is_met
    assert released["link 0.theta"] == pytest.approx(1.0) and released["link 1.theta"] == pytest.approx(1.2)


def test_priorities_and_limits():
    m, links = arm((0.4, 1.2, 0.1), (0.5, 0.4, 0.3))
    m.limit("link 0.theta", 0.2, 1.0)
    released = m.released()
    last = links[2]
    first = kin.Wish.point(last, last.end, (0.2, 0.7))
    reached = released.reach([kin.Wish.measure("link 2.theta", 0.5, priority=1), first])
    assert [one.is_met for one in reached.wishes] == [True, True]
    reached = released.drag(last, last.end, (1.1, -0.4))
    assert reached.limits == ["link 0.theta"] and released["link 0.theta"] == pytest.approx(0.2, abs=1e-9)


def test_mistakes_leave_it_where_it_was():
    m, (_, lower) = arm()
    released = m.released()
    before = released.q
    with pytest.raises(KeyError, match="link 0.theta"):
        released.reach(kin.Wish.measure("nothing", 1.0))
    with pytest.raises(kin.Error, match="finite"):
        released.drag(lower, lower.end, (math.nan, 0))
    with pytest.raises(TypeError):
        released.drag("link 1", (0, 0), (0, 0))
    with pytest.raises(kin.Error, match="needs 2"):
        released.drag(lower, lower.end, (1, 2, 3))
    with pytest.raises(KeyError):
        released["nothing"]
    assert np.array_equal(released.q, before)
    released.set_position(before)
    assert np.allclose(released.q, before, atol=1e-12)
