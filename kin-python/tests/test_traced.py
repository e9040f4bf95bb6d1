"""Traced functions against the compiled joints, and against differences of the functions as they are written."""

import numpy as np
import pytest
from rewritten import REWRITTEN
from states import bodies, called, kinds_of, plain, random_state
from unusual import UNUSUAL

import kin

ALL = [(traced, parameters) for traced, _, parameters in REWRITTEN] + UNUSUAL


def closed(joint_or_constraint, mechanism, handles):
    """The system of one constraint, and of drives that hold every coordinate."""
    mechanism.add("tested", joint_or_constraint)
    for handle in handles:
        axes = ["x", "y", "theta"] if isinstance(handle, kin.PlanarBody) else []
        for axis in axes:
            mechanism.add(f"hold {handle.name}.{axis}", kin.drive(getattr(handle, axis), 0.0))
        if isinstance(handle, kin.SpatialBody):
            for axis in ("R_x", "R_y", "R_z", "e1", "e2", "e3"):
                mechanism.add(f"hold {handle.name}.{axis}", kin.drive(mechanism[f"{handle.name}.{axis}"], 0.0))
        if isinstance(handle, kin.Coordinate):
            mechanism.add(f"hold {handle.name}", kin.drive(handle, 0.0))
    return mechanism.build()


def test_there_are_forty_of_the_library_and_fifteen_others():
    assert len(REWRITTEN) >= 40 and len(UNUSUAL) >= 15


@pytest.mark.parametrize("traced, joint, parameters", REWRITTEN, ids=lambda one: getattr(one, "name", ""))
def test_traced_is_compiled(traced, joint, parameters):
    """C, C_q, C_t and Q_d of the traced function are those of the joint that rustc has compiled, to 1e-13."""
    random = np.random.default_rng(7)
    kinds = kinds_of(traced)
    for _ in range(4):
        m = kin.Mechanism("compared")
        handles = bodies(m, kinds)
        system = closed(called(joint, traced, handles, parameters), m, handles)
        q, qd, t = random_state(kinds, random), random.normal(size=len(system.names)), random.normal()
        own = m.terms(called(traced, traced, handles, parameters), q, qd, t)
        rows = len(own.c)
        assert all(np.isfinite(one).all() for one in (own.c, own.c_q, own.c_t, own.q_d))
        for mine, theirs in [
            (own.c, system.residual(q, t)),
            (own.c_q, system.jacobian(q, t)),
            (own.c_t, system.c_t(q, t)),
            (own.q_d, system.acceleration_rhs(q, qd, t)),
        ]:
            scale = max(1.0, float(np.max(np.abs(theirs[:rows]))))
            np.testing.assert_allclose(mine, theirs[:rows], rtol=0, atol=1e-13 * scale)


@pytest.mark.parametrize("traced, parameters", ALL, ids=lambda one: getattr(one, "name", ""))
def test_derivatives_are_those_of_the_function(traced, parameters):
    """C, and central differences for C_q, C_t and Q_d, of the function called with plain numbers."""
    random = np.random.default_rng(3)
    kinds = kinds_of(traced)
    for _ in range(3):
        m = kin.Mechanism("differentiated")
        handles = bodies(m, kinds)
        q, t = 0.5 * random_state(kinds, random), 0.3 * random.normal()
        qd = random.normal(size=len(q))
        own = m.terms(called(traced, traced, handles, parameters), q, qd, t)
        assert all(np.isfinite(one).all() for one in (own.c, own.c_q, own.c_t, own.q_d))
        value = lambda q, t: plain(traced, q, t, parameters)  # noqa: E731
        scale = max(1.0, float(np.max(np.abs(own.c_q))), float(np.max(np.abs(own.q_d))))
        np.testing.assert_allclose(own.c, value(q, t), rtol=1e-12, atol=1e-12 * scale)
        h = 1e-5
        for k in range(len(q)):
            step = h * np.eye(len(q))[k]
            column = (8 * (value(q + step, t) - value(q - step, t)) - value(q + 2 * step, t) + value(q - 2 * step, t)) / (
                12 * h
            )
            np.testing.assert_allclose(own.c_q[:, k], column, rtol=1e-8, atol=1e-8 * scale)
        by_time = (value(q, t + h) - value(q, t - h)) / (2 * h)
        np.testing.assert_allclose(own.c_t, by_time, rtol=1e-7, atol=1e-7 * scale)
        s = 1e-3
        along = lambda s: value(q + s * qd, t + s)  # noqa: E731
        second = (16 * (along(s) + along(-s)) - along(2 * s) - along(-2 * s) - 30 * along(0)) / (12 * s * s)
        np.testing.assert_allclose(own.q_d, -second, rtol=1e-5, atol=1e-6 * scale)


def test_docstring_and_points_are_in_the_text():
    from unusual import parabolic_slot

    text = kin.equation('/// A slot.\nfn slot(i: Planar, k: f64) -> f64 { i.r.y - k * i.r.x.powi(2) }').text
    assert "A slot" in text
    assert "j.local(i.point(u_i))" in parabolic_slot.text


def test_text_of_rust_and_function_of_python_agree():
    m = kin.Mechanism("two ways")
    a, b = m.planar("a"), m.planar("b")
    text = kin.equation(
        "fn slot(i: Planar, j: Planar, u_i: Vec2, k: f64) -> f64 {\n"
        "    let s = j.local(i.point(u_i));\n    s.y - k * s.x * s.x\n}"
    )
    from unusual import parabolic_slot

    q, qd = np.arange(6) * 0.1, np.ones(6)
    one = m.terms(text(a, b, u_i=(0.1, 0.2), k=2.0), q, qd)
    two = m.terms(parabolic_slot(a, b, k=2.0, u_i=np.array([0.1, 0.2])), q, qd)
    np.testing.assert_allclose(one.c_q, two.c_q, rtol=0, atol=1e-15)
    np.testing.assert_allclose(one.q_d, two.q_d, rtol=0, atol=1e-13)
