"""Memory stays flat: builds, runs, mistakes, laws, texts and forces leave nothing behind.

Some thousands by default; `KIN_BUILDS=100000`, which `.ci/python --engines` sets, is the full count.
"""

import gc
import itertools
import os
from pathlib import Path

import numpy as np
import pytest

import kin

BUILDS = int(os.environ.get("KIN_BUILDS", "6000"))
STATUS = Path("/proc/self/statm")


def used():
    """Memory in use.   [MB]"""
    gc.collect()
    return int(STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


@kin.constraint
def traced(i: kin.Planar, j: kin.Planar, u_i: kin.Vec2, k: float, law: kin.Law, t: kin.Time):
    """A pin in a slot that moves.  [m]"""
    s = j.local(i.point(u_i))
    return s.y - k * s.x**2 - law.at(t)


def built(k):
    """A mechanism of the library and of a traced function."""
    m = kin.Mechanism(f"built {k}")
    a = m.planar("a", 0.1 * (k % 3))
    m.add("pin", kin.revolute(a, m.ground, (0.1, 0), (0, 0)))
    m.add("motor", kin.drive_angle(a, kin.Law.ramp(1.0 + k)))
    m.build()


def built_of_traced(k):
    m = kin.Mechanism("traced")
    a = m.planar("a", 0.2, 0.1)
    m.add("slot", traced(a, m.ground, (0, 0), 2.0 + k, kin.Law.sine(0.1, 1.0)))
    m.add("upright", kin.drive_angle(a, 0.0))
    m.add("motor", kin.drive(a.x, kin.Law.sine(0.3, 1.0)))
    m.build()


def run(k):
    m = kin.Mechanism("run")
    a = m.planar("a", 0.1)
    m.add("pin", kin.revolute(a, m.ground, (0.1, 0), (0, 0)))
    m.add("motor", kin.drive_angle(a, kin.Law.ramp(1.0)))
    m.mass(a, 1.0, (0, 0), 0.1)
    m.friction("pin", kin.Friction.pin(0.1, 0.01, 1e-3))
    system = m.build()
    motion = system.run(np.linspace(0, 1, 11))
    motion.q, motion.qdd, motion["a.theta"].value  # noqa: B018
    forces = system.forces(motion)
    forces.reaction("pin").on(a).magnitude, forces.drive("motor").peak  # noqa: B018
    system.sensitivities(motion, ["pin.u_i.x"]).of(a.x)
    kin.sweep(system, ["pin.u_i.x"], [0.1, 0.2], [0.0, 0.1], ["a.R_x max"])


def mistaken(k):
    """Errors with a motion, with a diagnosis, of a wrong type, of a text."""
    m = kin.Mechanism("mistaken")
    rod, slider = m.link("rod", 0.5), m.planar("slider", 0.4, 0.3)
    m.add("O", kin.revolute(rod, m.ground, rod.start, (0, 0)))
    m.add("B", kin.revolute(rod, slider, rod.end, (0, 0)))
    m.add("upright", kin.drive_angle(slider, 0.0))
    with pytest.raises(kin.CannotBeDriven):
        m.build().run([0.0])
    m.add("lift", kin.drive(slider.y, kin.Law.linear(0.45, 0.1)))
    with pytest.raises(kin.Toggle) as found:
        m.build().run([0.0, 0.25, 0.75])
    assert found.value.motion is not None
    with pytest.raises(TypeError):
        m.add("wrong", kin.revolute(rod, 3, (0, 0), (0, 0)))
    with pytest.raises(kin.ConstraintError):
        kin.equation(f"fn f(i: Planar) -> f64 {{ i.r.x + i.r.w{k} }}")


def traced_anew(k):
    """New functions, laws of functions and of arrays, texts, files."""

    @kin.constraint
    def curve(x: kin.Coord, y: kin.Coord, law: kin.Law):
        return y - kin.sin(x) - k * law.at(x)

    lift = kin.law(lambda x: (0.1 + k) * x**3)
    m = kin.Mechanism("anew")
    x, y = m.length("x", 0.1), m.length("y", 0.2)
    m.add("curve", curve(x, y, lift))
    m.add("motor", kin.drive(x, kin.Law.spline([0, 1, 2], [0, 1 + k, 0])))
    kin.equation("fn slot(i: Planar, k: f64) -> f64 { i.r.y - k * i.r.x * i.r.x }")
    kin.Mechanism.from_json(m.to_json()).build()


@pytest.mark.skipif(not STATUS.exists(), reason="NOT RUN: this system has no /proc")
@pytest.mark.parametrize("once, share", [(built, 1), (built_of_traced, 1), (run, 20), (mistaken, 50), (traced_anew, 20)])
def test_memory_is_flat(once, share):
    """A third is for warming up. What comes after may take 40 bytes a time, some pages apart: less than any object that stays."""
    count = max(BUILDS // share, 60)
    for k in range(count // 3):
        once(k)
    before = used()
    for k in range(count // 3, count):
        once(k)
    grown = used() - before
    assert grown < 3.0 + 40e-6 * count, f"{grown:.1f} MB more after {count} times"


def test_a_leak_would_be_seen():
    """Half a kilobyte that stays at each of the builds is beyond the bound, even where tests before have left room for a third."""
    kept = [bytes(512) for _ in range(20_000)]
    before = used()
    kept.extend(bytes(bytearray(os.urandom(512))) for _ in itertools.repeat(None, 200_000))
    assert used() - before > 3.0 + 40e-6 * 200_000
