"""Warnings of a first run: usual slips that still give a motion."""

import json
import pickle
import subprocess
import sys
import warnings

import numpy as np
import pytest

import kin


def crank(law):
    m = kin.Mechanism("crank")
    link = m.link("crank", 1.0)
    m.add("O", kin.revolute(link, m.ground, link.start, (0, 0)))
    m.add("motor", kin.drive_angle(link, law))
    return m


def run(m, times=np.linspace(0.0, 1.0, 11)):
    """The motion of a run that warns of nothing."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return m.build().run(times)


def test_degrees_are_asked_about_in_words_of_python():
    with pytest.warns(kin.MotionWarning) as caught:
        motion = crank(kin.Law.ramp(360)).build().run(np.linspace(0.0, 1.0, 11))
    assert [str(one.message) for one in caught] == [
        "`motor` turns `crank` at 360 rad/s (57 turns/s): the law of the driver is `Law.ramp(360)`. Angles are in radians; if degrees are meant, give "
        "`Law.ramp(kin.tau)`."
    ]
    assert caught[0].filename == __file__
    [warning] = motion.warnings
    assert (warning.kind, warning.names, str(warning)) == ("degrees", ["motor", "crank"], str(caught[0].message))
    assert f"\n  warning: {warning}" in motion.summary
    with pytest.warns(kin.MotionWarning, match=r"`motor\.law\.f0` is 90\. .* `kin\.deg\(90\)`\."):
        crank(kin.Law.linear(90, 1)).build().run([0.0, 0.1])


@pytest.mark.parametrize("speed", [1.0, 10.0, 100.0, 314.16, 2 * np.pi, 300.0])
def test_usual_speeds_are_not_asked_about(speed):
    assert run(crank(kin.Law.ramp(speed))).warnings == []


def test_warnings_are_filtered_by_their_class():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", kin.MotionWarning)
        assert len(crank(kin.Law.ramp(360)).build().run([0.0, 0.1]).warnings) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error", kin.MotionWarning)
        with pytest.raises(kin.MotionWarning, match="360 rad/s") as caught:
            crank(kin.Law.ramp(360)).build().run([0.0, 0.1])
    assert caught.value.kind == "degrees"
    assert issubclass(kin.MotionWarning, UserWarning)


def test_a_first_position_far_from_the_drawn_one():
    m = kin.Mechanism("plate")
    plate = m.planar("plate", x=1.0)
    m.add("O", kin.revolute(plate, m.ground, (1, 0), (0, 0)))
    m.add("motor", kin.drive_angle(plate, kin.Law.ramp(np.pi)))
    with pytest.warns(kin.MotionWarning, match=r"`m\.local\(plate, point\)`") as caught:
        motion = m.build().run(np.linspace(0.0, 1.0, 11))
    assert [one.message.kind for one in caught] == ["far from drawn"]
    assert motion.displaced[0].hint == str(motion.warnings[0])


def test_a_table_that_ends_before_the_run():
    table = kin.Law.spline([0.0, 1.0, 2.0], [0.0, 0.4, 0.3])
    with pytest.warns(kin.MotionWarning, match="`law` of `motor` ends at 2, but the run continues to 3") as caught:
        crank(table).build().run(np.linspace(0.0, 3.0, 31))
    assert [one.message.kind for one in caught] == ["beyond range"]


def test_a_run_that_ends_early_warns_too():
    m = crank(kin.Law.ramp(360) + kin.Law.sequence(0.0, [(0.05, kin.Law.polynomial([0, 0, 1.0]))]))
    with pytest.warns(kin.MotionWarning, match="360 rad/s"), pytest.raises(kin.Error) as caught:
        m.build().run(np.linspace(0.0, 1.0, 101))
    assert [one.kind for one in caught.value.motion.warnings] == ["degrees"]


def test_warnings_are_in_the_file_of_a_motion_and_in_copies():
    with pytest.warns(kin.MotionWarning):
        motion = crank(kin.Law.ramp(360)).build().run([0.0, 0.1])
    [warning] = json.loads(motion.to_json())["warnings"]
    assert (warning["kind"], warning["names"]) == ("degrees", ["motor", "crank"])
    again = kin.Motion.from_json(motion.to_json())
    assert [str(one) for one in again.warnings] == [str(one) for one in motion.warnings]
    copy = pickle.loads(pickle.dumps(motion.warnings[0]))
    assert (copy.kind, copy.names, str(copy)) == ("degrees", ["motor", "crank"], str(motion.warnings[0]))


def test_an_objective_does_not_warn_at_each_call():
    system = crank(kin.Law.ramp(360)).build()

    def cost(quantity):
        return float(quantity.value.sum()), np.ones_like(quantity.value)

    objective = system.objective(["motor.law.rate"], [0.0, 0.1], "crank.theta", cost)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        objective([360.0])


def test_a_program_prints_its_warning_once():
    program = """
import kin
m = kin.Mechanism("crank")
link = m.link("crank", 1.0)
m.add("O", kin.revolute(link, m.ground, link.start, (0, 0)))
m.add("motor", kin.drive_angle(link, kin.Law.ramp(360)))
system = m.build()
for _ in range(5):
    system.run([0.0, 0.1])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stderr.count("if degrees are meant, give") == 1, done.stderr
