"""What Python adds to Rust, and what SymPy takes: the figures of docs/guide/python.md as JSON lines.

    cargo bench --bench beside_python --no-run            # prints where the program is
    python benches/python/times.py target/release/deps/beside_python-…

Both sides read one mechanism file and do the same work in turn, in a process each; a figure is the median over the rounds,
a ratio the median of the ratios of each round. Times are CPU time of all threads. The wheel is the one of `bash .ci/python`.
W1 is the lecture's two-link manipulator in nine coordinates, W7 a sweep of ten thousand four-bars.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import kin

TIMES = 0.01 * np.arange(1000)
# What differs from case to case of the four-bars, and of what the largest value is kept.
NAMES = ["C.u_i.x"]
KEPT = "rocker.theta"


def w1():
    m = kin.Mechanism("two-link manipulator")
    body1, link2, link3 = m.planar("body 1"), m.link("link 2", 0.2), m.link("link 3", 0.35)
    m.add("ground", kin.fixed(body1, (0, 0), 0.0))
    m.add("O", kin.revolute(body1, link2, (0, 0), link2.start))
    m.add("A", kin.revolute(link2, link3, link2.end, link3.start))
    m.add("motor 2", kin.drive_angle(link2, kin.Law.linear(np.pi / 6, 0.5)))
    m.add("motor 3", kin.drive_angle(link3, kin.Law.linear(np.pi / 12, 0.75)))
    return m


def by_sympy():
    """The same as a person would write it with SymPy and SciPy: functions of q and t, Newton by `scipy.linalg.solve`."""
    import sympy
    from scipy.linalg import solve

    t = sympy.Symbol("t")
    q = sympy.symbols("x1 y1 a1 x2 y2 a2 x3 y3 a3")
    qd = sympy.symbols("dx1 dy1 da1 dx2 dy2 da2 dx3 dy3 da3")
    x1, y1, a1, x2, y2, a2, x3, y3, a3 = q
    l2, l3 = 0.2, 0.35
    c = sympy.Matrix([
        x1, y1, a1,
        x1 - x2 + l2 / 2 * sympy.cos(a2), y1 - y2 + l2 / 2 * sympy.sin(a2),
        x2 + l2 / 2 * sympy.cos(a2) - x3 + l3 / 2 * sympy.cos(a3), y2 + l2 / 2 * sympy.sin(a2) - y3 + l3 / 2 * sympy.sin(a3),
        a2 - 0.5 * t - sympy.pi / 6, a3 - 0.75 * t - sympy.pi / 12,
    ])  # fmt: skip
    c_q, c_t = c.jacobian(q), c.diff(t)
    v = sympy.Matrix(qd)
    q_d = -((c_q * v).jacobian(q) * v) - 2 * c_q.diff(t) * v - c_t.diff(t)
    f = [sympy.lambdify((q, t), one, "numpy") for one in (c, c_q, c_t)]
    g = sympy.lambdify((q, qd, t), q_d, "numpy")

    def run(times):
        a, b = np.pi / 6, np.pi / 12
        at = np.array([0, 0, 0, 0.1 * np.cos(a), 0.1 * np.sin(a), a, 0.2 * np.cos(a) + 0.175 * np.cos(b),
                       0.2 * np.sin(a) + 0.175 * np.sin(b), b])  # fmt: skip
        rows = []
        for instant in times:
            for _ in range(50):
                residual = f[0](at, instant)[:, 0]
                if np.max(np.abs(residual)) < 1e-10:
                    break
                at = at - solve(f[1](at, instant), residual)
            matrix = f[1](at, instant)
            rate = solve(matrix, -f[2](at, instant)[:, 0])
            rows.append((at, rate, solve(matrix, g(at, rate, instant)[:, 0])))
        return [np.array(one) for one in zip(*rows)]

    return run


def four_bars(n=10_000):
    m = kin.Mechanism("four-bar")
    crank, coupler, rocker = m.link("crank", 1.0), m.link("coupler", 3.5), m.link("rocker", 3.0)
    m.add("O", kin.revolute(m.ground, crank, (0, 0), crank.start))
    m.add("A", kin.revolute(crank, coupler, crank.end, coupler.start))
    m.add("B", kin.revolute(coupler, rocker, coupler.end, rocker.end))
    m.add("C", kin.revolute(m.ground, rocker, (4, 0), rocker.start))
    m.add("motor", kin.drive_angle(crank, kin.Law.ramp(1.0)))
    m.prefer(rocker, kin.deg(100))
    cases = np.random.default_rng(1).uniform(3.2, 4.4, (n, 1))
    return m, cases, np.linspace(0, 2 * np.pi, 361)[:-1]


class Rust:
    """The program beside, with a job of its own."""

    def __init__(self, program, folder, mechanism, times, plain, cases=(), lanes=True):
        job = {"mechanism": json.loads(mechanism.to_json()), "times": list(times), "plain": plain, "names": NAMES,
               "cases": [list(case) for case in cases], "keep": KEPT, "lanes": lanes}  # fmt: skip
        path = Path(folder) / "job.json"
        path.write_text(json.dumps(job), encoding="utf-8")
        self.process = subprocess.Popen([program, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self, repeats):
        """CPU time of so many repeats, and the number that they come to."""
        self.process.stdin.write(f"{repeats}\n")
        self.process.stdin.flush()
        seconds, number = self.process.stdout.readline().split()
        return float(seconds), float(number)

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def python(work):
    """The same of a function of Python."""

    def timed(repeats):
        begun = time.process_time()
        for _ in range(repeats):
            number = work()
        return time.process_time() - begun, number

    return timed


def beside(workload, rust, ours, steps, rounds, repeats):
    """Both in turn; a line of the figures."""
    pairs = []
    for k in range(rounds + 1):
        first, second = (rust, ours) if k % 2 else (ours, rust)
        found = {first: first(repeats), second: second(repeats)}
        (theirs, there), (own, here) = found[rust], found[ours]
        assert np.isclose(here, there, rtol=1e-14, atol=0), (workload, here, there)
        # The first round warms caches up.
        pairs.extend([(own, theirs)] if k else [])
    rust.end()
    middle = lambda values: statistics.median(list(values))  # noqa: E731
    ns = 1e9 / (repeats * steps)
    show(
        workload=workload,
        python_ns=round(ns * middle(own for own, _ in pairs), 1),
        rust_ns=round(ns * middle(theirs for _, theirs in pairs), 1),
        ratio=round(middle(own / theirs for own, theirs in pairs), 3),
    )


def show(**figures):
    print(json.dumps(figures), flush=True)


def against_rust(program, folder):
    arm = w1()
    for plain in (True, False):
        system, engine = arm.build(), "step-by-step" if plain else "auto"

        def run():
            motion = system.run(TIMES, engine=engine)
            # All three arrays are asked for.
            return float((motion.q, motion.qd, motion.qdd)[2][-1, -1])

        rust = Rust(program, folder, arm, TIMES, plain)
        beside(f"W1, 1000 times, engine {engine}", rust, python(run), len(TIMES), 61, 100)
    four_bar, cases, times = four_bars()
    for lanes in (True, False):
        system = four_bar.build()

        def sweep():
            return float(sum(kin.sweep(system, NAMES, cases, times, [f"{KEPT} max"], lanes=lanes)[f"{KEPT} max"].tolist()))

        rust = Rust(program, folder, four_bar, times, False, cases, lanes)
        name = f"W7, {len(cases)} four-bars at {len(times)} times, {'in lanes' if lanes else 'one by one'}"
        beside(name, rust, python(sweep), len(cases) * len(times), 7 if lanes else 5, 1)


def against_sympy():
    system, by_hand = w1().build(), by_sympy()
    q, qd, qdd = by_hand(TIMES)
    motion = system.run(TIMES)
    error = max(float(np.max(np.abs(mine - theirs))) for mine, theirs in zip((motion.q, motion.qd, motion.qdd), (q, qd, qdd)))
    for engine in ("step-by-step", "auto"):
        ratios = []
        for _ in range(5):
            theirs, own = python(lambda: by_hand(TIMES))(1)[0], python(lambda: system.run(TIMES, engine=engine).qdd)(200)[0] / 200
            ratios.append(theirs / own)
        show(
            workload=f"W1, 1000 times, SymPy and SciPy beside engine {engine}",
            sympy_ms=round(1e3 * theirs, 1),
            python_ms=round(1e3 * own, 3),
            times_as_fast=round(statistics.median(ratios)),
            largest_difference=error,
        )


def main():
    with tempfile.TemporaryDirectory() as folder:
        against_rust(sys.argv[1], folder)
    against_sympy()


if __name__ == "__main__":
    main()
