"""Every public function, method and class, found by looking and not by a list: with arguments of wrong number, type, shape and value it
raises an ordinary exception or does what it says; it never ends the process, and its words are never those of a fault within."""

import inspect
import math
import threading
from pathlib import Path

import numpy as np
import pytest
from test_arguments import ODD, WANTED
from test_mechanism import slot
from test_names import slider_crank

import kin

# What may be raised besides: modules that are not installed, files that cannot be read, ends of iterations.
ALSO = (*WANTED, IndexError, ImportError, OSError, StopIteration, ZeroDivisionError, RecursionError)


def public(owner):
    """Names of the public callables of a module or an object."""
    for name in sorted(dir(owner)):
        if not name.startswith("_") and callable(getattr(owner, name, None)):
            yield name


def objects():
    """One of each kind of object that the package gives out, by a name."""
    m, slider = slot()
    system = m.build()
    motion = system.run(np.linspace(0, 1, 5), jerk=True)
    loaded, crank, rod, block = slider_crank()
    machine = loaded.build()
    moved = machine.run(np.linspace(0, 1, 5))
    forces = machine.forces(moved)
    reaction = forces.reaction("A")
    space = kin.Mechanism("space")
    body = space.spatial("body")
    found = [
        kin.Mechanism("fuzzed"), loaded, slider, crank, kin.ground, slider.x, body, space.spatial_link_between("l", (0, 0, 0), (1, 0, 0)),
        system, motion, motion[slider.x], motion.point(slider), motion.chart("slider.R_x"), system.page(motion), machine, moved,
        forces, reaction, reaction.on(rod), forces.drive("motor"), forces.balance, forces.energy, forces.drive("motor").peak,
        machine.sensitivities(moved, ["crank"]), machine.tolerance(moved, block.x), machine.samples(moved, block.x, 0.5, count=10),
        machine.prove(moved), machine.compile(), machine.extremes(moved, block.x), machine.diagnose(0.0), machine.position(0.0),
        kin.Law.ramp(1.0), kin.law(lambda x: x * x), kin.Axis((0, 0, 1)), kin.vec2(1, 2), kin.vec3(1, 2, 3), kin.Mat2(1, 0, 0, 1),
        kin.EulerParameters(1, 0, 0, 0), kin.Solid.sphere(0.1, 1.0), kin.Friction.pin(0.1, 0.1, 0.1), loaded.dimensions["crank"],
        kin.revolute(crank, rod, (0, 0), (0, 0)), kin.loads.torsion_spring(crank, rod, 1.0, 0.0), kin.Error("words"),
        kin.equation("fn slot(i: Planar, k: f64) -> f64 { i.r.y - k * i.r.x }"), kin.sweep(system, ["slot.k"], [1.0], [0.0], ["slider.R_x max"]),
        kin.Batch.of(system, ["slot.k"], [0.0], ["slider.R_x max"]), kin.Planar(0, 0, 0), kin.Mat3(*range(9)),
    ]  # fmt: skip
    return [(type(one).__name__, one) for one in found]


def callables():
    """Everything that can be called, by its path."""
    for module in (kin, kin.spatial, kin.loads, kin.loads.spatial):
        for name in public(module):
            yield f"{module.__name__}.{name}", getattr(module, name)
            if inspect.isclass(getattr(module, name)):
                for method in public(getattr(module, name)):
                    yield f"{module.__name__}.{name}.{method}", getattr(getattr(module, name), method)
    for kind, one in objects():
        for name in public(one):
            yield f"{kind}().{name}", getattr(one, name)


def arguments(function):
    """How many arguments without default a function has; those of methods of pyo3 and NumPy are not known."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return 1
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(one.kind in kinds and one.default is inspect.Parameter.empty for one in signature.parameters.values())


def attempt(path, function, *given, **named):
    """A call that works or raises what is expected of it."""
    try:
        function(*given, **named)
    except ALSO as error:
        # An error of one's own types may show the value that was given: a long one is no sentence of a fault.
        words = str(error)
        assert "panicked" not in words and "PanicException" not in type(error).__name__, (path, given, words)


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """What writes files writes them into a folder of the test."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.filterwarnings("ignore")
def test_each_callable_with_each_odd_value():
    found = dict(callables())
    assert len(found) > 500, "the package has lost its functions, or this test has"
    for path, function in found.items():
        count = arguments(function)
        for value in ODD:
            attempt(path, function, *[value] * max(count, 1))
        for first in (2.0, "slider.x", [0.0, 0.1]):
            attempt(path, function, first, *[ODD[0]] * max(count - 1, 0))


@pytest.mark.filterwarnings("ignore")
def test_each_callable_with_a_wrong_number_of_arguments():
    for path, function in callables():
        for count in (0, 1, 2, 3, 5, 17):
            attempt(path, function, *[1.0] * count)
        attempt(path, function, there_is_no_such_argument=1.0)


@pytest.mark.filterwarnings("ignore")
def test_what_is_native_with_each_odd_value():
    """The classes below, which nobody should call: they must not end the process either."""
    m, slider = slot()
    system = m.build()
    motion = system.run(np.linspace(0, 1, 5))
    owners = [kin._native, m._native, system._native, motion._native, slot_forces()._native]
    called = 0
    for owner in owners:
        for name in public(owner):
            for value in ODD:
                for count in (0, 1, 2, 3, 4):
                    attempt(name, getattr(owner, name), *[value] * count)
                    called += 1
    assert called > 15_000


def slot_forces():
    loaded, *_ = slider_crank()
    machine = loaded.build()
    return machine.forces(machine.run([0.0, 0.1]))


def test_names_with_zeros_controls_and_surrogates():
    """In names, texts and paths."""
    m, slider = slot()
    system = m.build()
    motion = system.run([0.0, 0.1])
    for text in ("\0", "a\0b", "\x1b[2J", "\ud800", "‮slider", "", " ", "a" * 100_000):
        for call in (
            lambda text: kin.Mechanism(text).link("l", 1.0),
            lambda text: kin.Mechanism("m").link(text, 1.0),
            lambda text: kin.Mechanism("m").dimension(text, 1.0),
            lambda text: kin.Mechanism.from_json(text),
            lambda text: kin.equation(text),
            lambda text: system.set(text, 1.0),
            lambda text: motion[text],
            lambda text: motion.write_csv(f"{text}.csv" if text.isprintable() else text),
            lambda text: kin.Mechanism.read_json(text),
            lambda text: system.assembly(0.0, text),
            lambda text: kin.sweep(system, [text], [1.0], [0.0], [f"{text} max"]),
        ):
            attempt("text", call, text)
    assert not Path("\x1b[2J").exists() or Path("\x1b[2J").is_file()


def test_threads_share_systems_and_motions():
    """Sixteen threads run, set, measure, copy and fail on the same objects; each finds what one thread alone finds."""
    m, crank, rod, block = slider_crank()
    system = m.build()
    times = np.linspace(0, 6, 121)
    alone = system.run(times).qdd
    failures = []

    def work(k):
        try:
            for _ in range(8):
                motion = system.run(times)
                np.testing.assert_array_equal(motion.qdd, alone)
                forces = system.forces(motion)
                assert math.isfinite(forces.drive("motor").peak.value)
                own = system.__copy__()
                own.set("crank", 0.1 + 0.001 * k)
                assert own.dimensions["crank"] == 0.1 + 0.001 * k
                with pytest.raises(kin.UnknownName):
                    system.measure(motion, f"nothing {k}")
                kin.Mechanism.from_json(m.to_json()).build()
        except BaseException as error:
            failures.append((k, error))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(16)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures, failures[0]


def test_one_mechanism_in_many_threads():
    """Bodies added from all sides: each is there once, whatever the order."""
    m = kin.Mechanism("shared")
    problems = []

    def add(k):
        for n in range(20):
            try:
                m.planar(f"body {k} {n}")
            except RuntimeError:
                # Two at once: the second one is told so, and tries again.
                problems.append(k)

    threads = [threading.Thread(target=add, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert m.to_json().count('"planar"') == 160 - len(problems)
