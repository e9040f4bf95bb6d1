"""Mechanisms from Python: runs, files, copies, threads."""

import copy
import json
import pickle
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from unusual import parabolic_slot

import kin

DATA = Path(__file__).resolve().parents[2] / "tests" / "data"


def two_link():
    m = kin.Mechanism("two-link manipulator")
    link2, link3 = m.link("link 2", 0.2), m.link("link 3", 0.35)
    m.add("O", kin.revolute(m.ground, link2, (0, 0), link2.start))
    m.add("A", kin.revolute(link2, link3, link2.end, link3.start))
    m.add("motor 2", kin.drive_angle(link2, kin.Law.linear(np.pi / 6, 0.5)))
    m.add("motor 3", kin.drive_angle(link3, kin.Law.linear(np.pi / 12, 0.75)))
    motion = m.build().run(np.linspace(0.0, 24.0, 2401))
    return m, motion, motion.point(link3, link3.end)


def slot():
    m = kin.Mechanism("slider in a slot")
    slider = m.planar("slider", x=0.2, y=0.1)
    m.add("slot", parabolic_slot(slider, m.ground, u_i=(0, 0), k=2.0))
    m.add("upright", kin.drive_angle(slider, 0.0))
    m.add("motor", kin.drive(slider.x, kin.Law.sine(0.3, 1.0)))
    return m, slider


def four_bar():
    m = kin.Mechanism("four-bar")
    crank, coupler, rocker = m.link("crank", 1.0), m.link("coupler", 3.5), m.link("rocker", 3.0)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, coupler, crank.end, coupler.start))
    m.add("B", kin.revolute(coupler, rocker, coupler.end, rocker.end))
    m.add("C", kin.revolute(m.ground, rocker, (4, 0), rocker.start))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(2 * np.pi)))
    m.prefer(rocker, kin.deg(100))
    return m


def test_a_drawn_pose_that_is_singular_is_not_left_in_silence():
    m = kin.Mechanism("lift")
    rod = m.planar("rod", x=1.0)
    m.add("left", kin.point_on_line(rod, m.ground, (-1, 0), (0, 0), (0, 1)))
    m.add("right", kin.point_on_circle(rod, m.ground, (1, 0), (0.5, 0), 1.5))
    m.add("lift", kin.drive(rod.y, 0.0))
    with pytest.raises(kin.SingularAt, match="satisfies every equation") as caught:
        m.build().run([0, 1])
    assert caught.value.drawn and caught.value.rank == 2


def test_two_link_arm_is_the_closed_form():
    """Twelve lines at most, and r, v, a of the end effector by hand."""
    import inspect

    body = inspect.getsource(two_link).splitlines()[1:-1]
    assert len(body) <= 12
    _, motion, e = two_link()
    t = motion.times
    a, b = np.pi / 6 + 0.5 * t, np.pi / 12 + 0.75 * t
    r = np.stack([0.2 * np.cos(a) + 0.35 * np.cos(b), 0.2 * np.sin(a) + 0.35 * np.sin(b)], axis=1)
    acc = -np.stack(
        [0.05 * np.cos(a) + 0.196875 * np.cos(b), 0.05 * np.sin(a) + 0.196875 * np.sin(b)], axis=1
    )
    np.testing.assert_allclose(e.r, r, atol=1e-13)
    np.testing.assert_allclose(e.a, acc, atol=1e-13)
    assert motion.q.shape == (2401, 6) and motion["link 3.theta"].velocity[7] == pytest.approx(0.75)


def test_slot_is_the_closed_form():
    m, slider = slot()
    motion = m.build().run(np.linspace(0, 6, 601))
    x, t = 0.3 * np.sin(np.linspace(0, 6, 601)), np.linspace(0, 6, 601)
    acceleration = 4 * ((0.3 * np.cos(t)) ** 2 - x * x)
    np.testing.assert_allclose(motion["slider.y"].value, 2 * x * x, atol=1e-13)
    np.testing.assert_allclose(motion["slider.y"].acceleration, acceleration, atol=1e-12)
    np.testing.assert_array_equal(motion[slider.y].value, motion.q[:, 1])


@pytest.mark.parametrize("path", sorted((DATA / "examples").glob("*.json")), ids=lambda path: path.stem)
def test_examples_come_back_as_files(path):
    """Every mechanism of the gallery made of the library runs from its file, and its file is the same again."""
    try:
        m = kin.Mechanism.read_json(path)
    except kin.DataError as error:
        assert "unknown constraint" in str(error)  # of the example's own program
        pytest.skip("the example has a constraint of its own")
    assert json.loads(m.to_json()) == json.loads(path.read_text())
    motion = m.build().run([0.0, 0.01])
    again = pickle.loads(pickle.dumps(m)).build().run([0.0, 0.01])
    np.testing.assert_array_equal(motion.q, again.q)
    assert np.isfinite(motion.qdd).all()


def test_pickle_and_copy_are_files_with_their_equations():
    m, slider = slot()
    for other in (copy.copy(m), copy.deepcopy(m), pickle.loads(pickle.dumps(m)), kin.Mechanism.from_json(m.to_json())):
        times = np.linspace(0, 1, 11)
        np.testing.assert_array_equal(m.build().run(times).qdd, other.build().run(times).qdd)
    copied = copy.copy(m)
    copied.guess(slider.x, 0.1)  # a body of the one is a body of the other
    system = m.build()
    system.set("slot.k", 3.0)
    again = pickle.loads(pickle.dumps(system))
    assert again.parameter("slot.k") == 3.0
    motion = system.run(np.linspace(0, 1, 11), jerk=True)
    back = pickle.loads(pickle.dumps(motion))
    np.testing.assert_array_equal(motion.qddd, back.qddd)
    assert back.names == motion.names and back.summary == motion.summary


def test_errors_have_words_fields_and_the_motion():
    m = kin.Mechanism("toggle")
    crank, rod = m.link("crank", 1.0), m.link("rod", 1.5)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("slide", kin.point_on_line(rod, m.ground, rod.end, (0, -1), (1, 0)))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(1.0)))
    m.prefer(rod, kin.deg(-60))
    with pytest.raises(kin.Toggle) as found:
        m.build().run(np.linspace(0, 3, 301))
    error = found.value
    assert error.t == pytest.approx(np.pi / 6, abs=1e-9) and error.asked > error.t and "toggle" in str(error)
    assert isinstance(error, kin.Error) and 40 < len(error.motion) < 60
    assert error.motion.singular_positions and error.movable == ["rod"]
    assert str(error).endswith("is in this error: `error.motion`.")
    again = pickle.loads(pickle.dumps(error))
    assert again.t == error.t and len(again.motion) == len(error.motion) and str(again) == str(error)
    with pytest.raises(AttributeError, match="has no field `rank`"):
        error.rank  # noqa: B018


def test_threads_run_side_by_side_and_agree():
    system = four_bar().build()
    times = np.linspace(0, 3, 2001)
    alone, together = system.run(times), [None] * 4
    def work(k):
        for _ in range(3):
            together[k] = system.run(times)
    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    for motion in together:
        np.testing.assert_array_equal(motion.qdd, alone.qdd)


def test_a_parameter_can_be_set_while_another_thread_runs():
    m, _ = slot()
    system, stop = m.build(), threading.Event()
    def set_them():
        while not stop.is_set():
            system.set("slot.k", 2.0)
    thread = threading.Thread(target=set_them)
    thread.start()
    try:
        for _ in range(20):
            system.run(np.linspace(0, 1, 501))
    finally:
        stop.set()
        thread.join()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timer of signals")
def test_ctrl_c_ends_a_run_and_a_sweep():
    system = four_bar().build()

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        for call in (
            lambda: system.run(np.linspace(0, 1000, 2_000_000), memory=1 << 32),
            lambda: kin.sweep(system, ["C.u_i.x"], np.full((200_000, 1), 4.0), np.linspace(0, 1, 101), ["rocker.theta max"]),
        ):
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            begun = time.monotonic()
            with pytest.raises(KeyboardInterrupt):
                call()
            assert time.monotonic() - begun < 3.0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_progress_is_told_and_its_exception_ends_the_run():
    system, seen = four_bar().build(), []
    system.run(np.linspace(0, 100, 100_001), progress=lambda done, all: seen.append((done, all)))
    assert seen[-1] == (100_001, 100_001) and seen == sorted(seen)

    def refuse(done, all):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        system.run(np.linspace(0, 1000, 1_000_001), progress=refuse)


def test_what_is_asked_of_a_motion():
    m = four_bar()
    system = m.build()
    motion = system.run(np.linspace(0, 1, 361))
    swing = system.extremes(motion, "rocker.theta")
    inner = np.arccos((9 + 16 - 2.5**2) / 24)
    assert np.pi - swing.max.value == pytest.approx(np.pi - swing.max.value)
    assert swing.stroke == pytest.approx(np.ptp(motion["rocker.theta"].value), abs=1e-3)
    assert min(abs(np.pi - inner - one.value) for one in swing.all) < 1e-9
    assert len(system.crossings(motion, m["rocker"].theta, swing.min.value + 0.1)) == 2
    assert system.prove(motion).is_complete
    assert "four-bar" in str(system.diagnose(0.1)) and system.diagnose(0.1).rank == 9
    assert len(system.assemblies(0.1)) == 2
    assert system.measure(motion, "A.angle").value.shape == (361,)
    assert len(system.at(motion, 0.1234)) == 1
    compiled = system.run(np.linspace(0, 1, 2001), engine="compiled")
    assert compiled.engine[0] > 1000
    np.testing.assert_allclose(compiled.q, system.run(np.linspace(0, 1, 2001)).q, atol=1e-11)
    by = system.sensitivities(motion, ["B.u_i.x"]).of("rocker.theta")["B.u_i.x"]
    h = 1e-6
    moved = []
    for step in (h, -h):
        other = copy.copy(system)
        other.set("B.u_i.x", 1.75 + step)
        moved.append(other.run(motion.times)["rocker.theta"].value)
    np.testing.assert_allclose(by.value, (moved[0] - moved[1]) / (2 * h), atol=1e-7)
    weights = np.zeros((361, 3))
    weights[100, 0] = 1.0
    assert system.gradient(motion, ["B.u_i.x"], "rocker.theta", weights)[0] == pytest.approx(by.value[100], abs=1e-10)


def test_a_sweep_is_its_runs():
    system = four_bar().build()
    times = np.linspace(0, 1, 61)
    cases = np.array([[x, 3.4 + 0.01 * x] for x in np.linspace(3.2, 4.4, 40)] + [[9.0, 3.5]])
    names = ["C.u_i.x", "B.u_i.x"]
    rows = kin.sweep(system, names, cases * [1, 0.5], times, ["rocker.theta max", ("A.angle", "range")], lanes=False)
    assert rows.values.shape == (41, 2) and not rows.ok[40] and rows.ok.sum() == 40 and rows.status[40]
    assert np.isnan(rows.values[40]).all()
    for k in (0, 17, 39):
        one = copy.copy(system)
        for name, value in zip(names, cases[k] * [1, 0.5]):
            one.set(name, value)
        motion = one.run(times)
        assert rows["rocker.theta max"][k] == motion["rocker.theta"].value.max()
        assert rows["A.angle range"][k] == pytest.approx(np.ptp(one.measure(motion, "A.angle").value), abs=1e-14)
    lanes = kin.sweep(system, names, cases * [1, 0.5], times, ["rocker.theta max"])
    np.testing.assert_allclose(lanes.values[:40, 0], rows.values[:40, 0], atol=1e-11)


def test_spatial_bodies_and_joints():
    m = kin.Mechanism("door")
    door = m.spatial("door", (0.4, 0, 0), axis=(0, 0, 1), angle=0.1)
    hinge = kin.spatial.revolute(door, m.ground, (-0.4, 0, 0), (0, 0, 0), (0, 0, 1), kin.vec3(0, 0, 1))
    m.add("hinge", hinge.zero((1, 0, 0), (1, 0, 0)))
    m.add("motor", kin.spatial.drive_turn(door, m.ground, (0, 0, 1), (0, 0, 1), kin.Law.ramp(2.0)))
    system = m.build()
    motion = system.run(np.linspace(0, 1, 11))
    np.testing.assert_allclose(motion.rotation(door).omega, np.tile([0, 0, 2.0], (11, 1)), atol=1e-12)
    np.testing.assert_allclose(system.measure(motion, "hinge.angle").value, 2 * motion.times, atol=1e-12)
    np.testing.assert_allclose(motion.point(door, (0.4, 0, 0)).speed, 1.6, atol=1e-12)
    assert m.local(door, (0.4, 0, 0)) == kin.vec3(0, 0, 0)


def test_tables_where_they_are_installed():
    pandas = pytest.importorskip("pandas")
    _, motion, _ = two_link()
    frame = motion.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame.shape == (2401, 19)
    np.testing.assert_array_equal(frame["link 3.theta'"], motion.qd[:, 5])
