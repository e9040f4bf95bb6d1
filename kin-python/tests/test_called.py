"""Values that are called like methods, names that nothing has, points by dimensions: each error says what to write."""

import copy
import pickle

import numpy as np
import pytest

import kin


def four_bar():
    m = kin.Mechanism("four-bar")
    crank, rod, rocker = m.link("crank", m.dimension("a", 0.1, "m", tolerance=1e-4)), m.link("rod", 0.3), m.link("rocker", 0.25)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, rod, crank.end, rod.start))
    m.add("B", kin.revolute(rod, rocker, rod.end, rocker.end))
    m.add("C", kin.revolute(rocker, m.ground, rocker.start, (0.3, 0)))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(1.0)))
    m.prefer(rod, 0.5)
    m.mass(rod, 1.0, (0, 0), 0.01)
    return m, crank, rod


@pytest.fixture(scope="module")
def made():
    m, crank, rod = four_bar()
    system = m.build()
    motion = system.run(np.linspace(0, 1, 11))
    return m, crank, rod, system, motion


@pytest.mark.parametrize(
    "call, spelled",
    [
        (lambda m, crank, system, motion, forces: m.ground(), "m.ground"),
        (lambda m, crank, system, motion, forces: m.dimensions(), "m.dimensions"),
        (lambda m, crank, system, motion, forces: crank.end(), "crank.end"),
        (lambda m, crank, system, motion, forces: crank.theta(), "crank.theta"),
        (lambda m, crank, system, motion, forces: system.names(), "system.names"),
        (lambda m, crank, system, motion, forces: system.initial(), "system.initial"),
        (lambda m, crank, system, motion, forces: motion.summary(), "motion.summary"),
        (lambda m, crank, system, motion, forces: copy.copy(motion).warnings(), "copy.copy(motion).warnings"),
        (lambda m, crank, system, motion, forces: motion["crank.theta"].max(), "motion['crank.theta'].max"),
        (lambda m, crank, system, motion, forces: forces.drives(), "forces.drives"),
        (lambda m, crank, system, motion, forces: forces.on_ground(), "forces.on_ground"),
        (lambda m, crank, system, motion, forces: kin.Law.ramp(1.0).range(), "kin.Law.ramp(1.0).range"),
    ],
)
def test_a_value_that_is_called_says_so(made, call, spelled):
    m, crank, _, system, motion = made
    name = spelled.rpartition(".")[2]
    with pytest.raises(TypeError) as told:
        call(m, crank, system, motion, system.forces(motion))
    assert str(told.value).startswith(f"`{name}` is a value and no method: write `{spelled}`, without brackets"), str(told.value)


def test_arrays_that_are_called_say_so():
    m, _, _ = four_bar()
    motion = m.build().run([0.0, 0.1])
    with pytest.raises(TypeError, match="`times` is a value and no method: write `motion.times`"):
        motion.times()
    assert motion.times[1] == 0.1 and getattr(motion, "q").shape == (2, 9)
    # What a value gives may be called: that is no call of the value.
    assert motion.summary.upper() and motion.names.index("crank.theta") == 2


@pytest.mark.parametrize(
    "look, words",
    [
        (lambda system, motion: motion["crank.tehta"], "Did you mean `crank.theta`? Use one of `crank.theta`, "),
        (lambda system, motion: motion["nonsense"], "`nonsense`. Use one of `crank.R_x`, `crank.R_y`, "),
        (lambda system, motion: motion["A.angle"], 'If `A` is a joint, its measure is system.measure(motion, "A.angle")'),
        (lambda system, motion: motion.columns()["crank"], "there is no column `crank`. Use one of `t`, "),
        (lambda system, motion: system.parameters["O.u_i.z"], "there is no parameter `O.u_i.z`. Use one of `O.u_i.x`, `O.u_i.y`"),
        (lambda system, motion: system.dimensions["b"], "there is no dimension `b`. Use `a`"),
        (lambda system, motion: system.forces(motion)["moter"], "Did you mean `motor`? Use one of `motor`, "),
        (lambda system, motion: system.forces(motion).columns()["motor"], "there is no column `motor`. Use one of `t`, "),
        (
            lambda system, motion: system.sensitivities(motion, ["a"]).of("rod.theta")["A"],
            "there is no parameter of the derivatives `A`. Use `a`",
        ),
        (
            lambda system, motion: kin.sweep(system, ["a"], [[0.1]], [0.0], ["rod.theta max"])["rod.theta"],
            "there is no column `rod.theta`. Use `rod.theta max`",
        ),
        (
            lambda system, motion: kin.Batch.of(system, ["O.u_i.x"], [0.0], ["rod.theta max"])({"note": ["x"], "O.u_i_x": [0.1]}),
            "there is no column `O.u_i.x`. Did you mean `O.u_i_x`? Use one of `O.u_i_x` and `note`",
        ),
    ],
)
def test_an_unknown_name_is_told_with_the_known_ones(made, look, words):
    *_, system, motion = made
    with pytest.raises(kin.UnknownName) as told:
        look(system, motion)
    assert words in str(told.value), str(told.value)
    assert isinstance(told.value, KeyError) and not str(told.value).startswith(("'", '"'))
    again = pickle.loads(pickle.dumps(told.value))
    assert str(again) == str(told.value) and again.known == told.value.known


def test_an_unknown_body_is_told_with_the_known_ones(made):
    m, _, _, system, motion = made
    with pytest.raises(kin.UnknownName, match="`crnk`. Did you mean `crank`. Use one of `crank`, `rod` and `rocker`"):
        m["crnk"]
    with pytest.raises(TypeError, match="The ground is m.ground"):
        m["ground"]
    with pytest.raises(TypeError, match="All coordinates at time number k are motion.q\\[k\\]"):
        motion[3]
    table = pickle.loads(pickle.dumps(system.parameters))
    assert table == system.parameters and table.get("nobody") is None
    with pytest.raises(KeyError):
        table["nobody"]


def test_a_body_named_ground_is_refused_with_the_cure():
    m = kin.Mechanism("m")
    with pytest.raises(kin.DuplicateName, match="a body cannot have the name `ground`.*Use `m.ground` in joints, or choose"):
        m.planar("ground")


def test_a_polynomial_needs_numbers():
    for call in (lambda: kin.Law.polynomial(), lambda: kin.Law.polynomial([]), lambda: kin.Law.polynomial(2.0)):
        with pytest.raises(TypeError, match="takes a list of numbers, lowest power first, such as Law.polynomial"):
            call()
    assert kin.Law.polynomial([1.0, 2.0]).at(3.0) == 7.0


def test_a_measure_of_a_point_by_dimensions_follows_them_or_is_refused(made):
    """The plain number of a dimension would give a part of the derivative: 0.5 sin θ of sin θ for the end of a crank."""
    m, crank, _, system, motion = made

    def height(local):
        return lambda motion: motion.point(crank, local).along((0, 1))

    for local in (crank.end.value, (crank.length.value / 2, 0.0), [0.5 * crank.length.value, 0.0]):
        # The number itself is right for these dimensions.
        np.testing.assert_allclose(system.measure(motion, height(local)).value, 0.1 * np.sin(motion.times), atol=1e-12)
        for ask in (
            lambda: system.tolerance(motion, height(local)),
            lambda: system.tolerance_proved(motion, height(local), "max"),
            lambda: system.samples(motion, height(local), "max", count=10),
            lambda: system.sensitivities(motion, ["a"]).of(height(local)),
            lambda: system.gradient(motion, ["a"], height(local), np.ones(11)),
        ):
            with pytest.raises(TypeError, match="does not follow the dimension `.*a.*`.*Weld a body there"):
                ask()
        # Another parameter does not move the point.
        slope = system.sensitivities(motion, ["motor.law.rate"]).of(height(local))["motor.law.rate"]
        np.testing.assert_allclose(slope.value, 0.1 * motion.times * np.cos(motion.times), atol=1e-9)
    with pytest.raises(TypeError, match="this point is given by the dimension `.*a.*`. Weld a body there"):
        motion.point(crank, crank.end)
    with pytest.raises(TypeError, match="`distance` takes plain numbers"):
        motion.distance(crank, crank.end, m.ground, (0, 0))
    # The cure: all of the derivative.
    m, crank, _ = four_bar()
    tip = m.planar("tip")
    m.add("tip weld", kin.weld(tip, crank, (0, 0), crank.end, 0.0))
    system = m.build()
    motion = system.run(np.linspace(0, 1, 11))
    slope = system.sensitivities(motion, ["a"]).of(lambda motion: motion.point(tip).along((0, 1)))["a"]
    np.testing.assert_allclose(slope.value, np.sin(motion.times), atol=1e-9)


@pytest.mark.parametrize(
    "change, words",
    [
        (('"guess"', '"gues"'), "`/bodies/0` has the unknown key `gues`. Did you mean `guess`. Use one of `guess`"),
        (('"planar"', '"planer"'), "cannot be `planer`. Did you mean `planar`. Use one of"),
        (('"revolute"', '"revolut"'), "unknown constraint `revolut`. Did you mean `revolute`. Use one of `revolute`"),
        (("{", ""), "line 1, column "),
    ],
)
def test_a_slip_in_a_file_is_told_with_its_place(made, change, words):
    text = made[0].to_json()
    assert change[0] in text
    with pytest.raises(kin.DataError, match=words) as told:
        kin.Mechanism.from_json(text.replace(*change, 1))
    assert not any(word in str(told.value) for word in ("field", "variant", "Registry"))
