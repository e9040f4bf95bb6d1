"""Times for the table of the guide: W1, the lecture's two-link manipulator in nine coordinates at 2401 times, by Kin and by
SymPy's lambdified C, C_q, C_t and Q_d with SciPy; and a sweep of four-bars. `python tools/times.py`"""

import time

import numpy as np

import kin

TIMES = np.linspace(0.0, 24.0, 2401)


def w1():
    m = kin.Mechanism("two-link manipulator")
    body1, link2, link3 = m.planar("body 1"), m.link("link 2", 0.2), m.link("link 3", 0.35)
    m.add("ground", kin.fixed(body1, (0, 0), 0.0))
    m.add("O", kin.revolute(body1, link2, (0, 0), link2.start))
    m.add("A", kin.revolute(link2, link3, link2.end, link3.start))
    m.add("motor 2", kin.drive_angle(link2, kin.Law.linear(np.pi / 6, 0.5)))
    m.add("motor 3", kin.drive_angle(link3, kin.Law.linear(np.pi / 12, 0.75)))
    return m.build()


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
    return m.build(), cases, np.linspace(0, 2 * np.pi, 361)[:-1]


def best(call, repeats):
    """The shortest of some times.   [s]"""
    found = []
    for _ in range(repeats):
        begun = time.perf_counter()
        call()
        found.append(time.perf_counter() - begun)
    return min(found)


def main():
    system = w1()
    plain = best(lambda: system.run(TIMES, engine="plain"), 20)
    by_itself = best(lambda: system.run(TIMES), 20)
    arrays = best(lambda: system.run(TIMES, engine="plain").qdd, 20)
    run = by_sympy()
    q, qd, qdd = run(TIMES[:301])
    motion = system.run(TIMES[:301])
    error = max(float(np.max(np.abs(mine - theirs))) for mine, theirs in zip((motion.q, motion.qd, motion.qdd), (q, qd, qdd)))
    sympys = best(lambda: run(TIMES), 1)
    print(f"W1, 2401 times: plain steps {1e3 * plain:.3f} ms, as it comes {1e3 * by_itself:.3f} ms, with the arrays "
          f"{1e3 * arrays:.3f} ms; SymPy and SciPy {1e3 * sympys:.1f} ms, {sympys / plain:.0f} × and {sympys / by_itself:.0f} ×; "
          f"they agree to {error:.1e}")  # fmt: skip
    four_bar, cases, times = four_bars()
    keep = ["rocker.theta max"]
    for lanes in (True, False):
        sweep = best(lambda: kin.sweep(four_bar, ["C.u_i.x"], cases, times, keep, lanes=lanes), 2)
        print(f"10⁴ four-bars, 360 times each, lanes {lanes}: {sweep:.2f} s")


if __name__ == "__main__":
    main()
