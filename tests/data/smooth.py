"""Writes smooth.json: value, slopes, Q_d and the jerk's right side of the equations of tests/smooth.rs, by mpmath with 80 digits.

Along q(s) = q + s q̇ + s²/2 q̈ the derivatives of g(s) = C(q(s)) at s = 0 come from power series with numbers of any exponent: nothing overflows, and
no difference is taken. Each equation is written as it is near the point: the side of a `max`, `min`, `clamp` or `if` that is taken there.
"""
import json
import pathlib
from mpmath import mp, mpf, pi

mp.dps = 80
QD, QDD = (mpf("0.7"), mpf("-0.3")), (mpf("0.2"), mpf("0.5"))
ORDER = 4


class Series:
    """c[0] + c[1] s + c[2] s² + c[3] s³"""

    def __init__(self, c):
        self.c = list(c)

    def __add__(self, other):
        return Series(a + b for a, b in zip(self.c, series(other).c))

    def __mul__(self, other):
        o = series(other).c
        return Series(sum(self.c[j] * o[k - j] for j in range(k + 1)) for k in range(ORDER))

    def __truediv__(self, other):
        o, q = series(other).c, []
        for k in range(ORDER):
            q.append((self.c[k] - sum(q[j] * o[k - j] for j in range(k))) / o[0])
        return Series(q)

    def __neg__(self):
        return Series(-a for a in self.c)

    def __sub__(self, other):
        return self + -series(other)

    def __rsub__(self, other):
        return series(other) - self

    def __rtruediv__(self, other):
        return series(other) / self

    def __pow__(self, n):
        return exp(series(n) * log(self)) if isinstance(n, Series) else power(self, mpf(n))

    __radd__, __rmul__ = __add__, __mul__


def series(x):
    return x if isinstance(x, Series) else Series([mpf(x)] + [mpf(0)] * (ORDER - 1))


def integral(value, slope):
    """The series with a value and a derivative."""
    return Series([value] + [slope.c[k - 1] / k for k in range(1, ORDER)])


def slope(x):
    return Series([k * x.c[k] for k in range(1, ORDER)] + [mpf(0)])


def exp(x):
    y, d = [mp.exp(x.c[0])], slope(x).c
    for k in range(1, ORDER):
        y.append(sum(y[j] * d[k - 1 - j] for j in range(k)) / k)
    return Series(y)


def power(x, n):
    y = [x.c[0] ** n]
    for k in range(1, ORDER):
        y.append(sum((n * j - (k - j)) * x.c[j] * y[k - j] for j in range(1, k + 1)) / (k * x.c[0]))
    return Series(y)


log = lambda x: integral(mp.log(x.c[0]), slope(x) / x)
sqrt = lambda x: power(x, mpf("0.5"))
cbrt = lambda x: power(x, mpf(1) / 3)
cosh = lambda x: (exp(x) + exp(-x)) / 2
sinh = lambda x: (exp(x) - exp(-x)) / 2
tanh = lambda x: integral(mp.tanh(x.c[0]), slope(x) / (cosh(x) * cosh(x)))
atan = lambda x: integral(mp.atan(x.c[0]), slope(x) / (1 + x * x))
asin = lambda x: integral(mp.asin(x.c[0]), slope(x) / sqrt(1 - x * x))
acos = lambda x: integral(mp.acos(x.c[0]), -slope(x) / sqrt(1 - x * x))
asinh = lambda x: integral(mp.asinh(x.c[0]), slope(x) / sqrt(1 + x * x))
ZERO = lambda a, b: 0 * a

POINTS = [
    # name, a, b, the equation near the point
    ("clipped_root", 1.5, 0.0, ZERO), ("clipped_root", -1.5, 0.0, ZERO), ("clipped_root", 0.3, 0.0, lambda a, b: sqrt(1 - a * a)),
    ("clamped_angle", 2.0, 3.0, ZERO), ("clamped_angle", -2.0, 3.0, lambda a, b: pi + 0 * a),
    ("clamped_angle", 0.5, 0.4, lambda a, b: acos(a * b)),
    ("clamped_root", -1.0, 0.0, ZERO), ("clamped_root", 0.5, 0.0, lambda a, b: sqrt(a)), ("clamped_root", 2.0, 0.0, lambda a, b: 1 + 0 * a),
    ("chosen_root", -1.0, 0.0, ZERO), ("chosen_root", 2.0, 0.0, lambda a, b: sqrt(a)),
    ("log_of_root", -1.0, 0.0, ZERO), ("log_of_root", 0.5, 0.0, lambda a, b: log(1 + sqrt(a))),
    ("hertz", -1.0, 0.0, ZERO), ("hertz", 0.5, 0.0, lambda a, b: a * sqrt(a)),
    ("corner", -1.0, -2.0, ZERO), ("corner", -1.0, 2.0, lambda a, b: b), ("corner", 1.0, 2.0, lambda a, b: sqrt(a * a + b * b)),
    ("quadrant", -1.0, -2.0, ZERO), ("quadrant", 2.0, -2.0, lambda a, b: pi / 2 + 0 * a), ("quadrant", 2.0, 3.0, lambda a, b: atan(a / b)),
    ("root_not_taken", 0.0, 2.0, lambda a, b: b), ("root_not_taken", -1.0, 2.0, lambda a, b: b),
    ("root_not_taken", 9.0, 2.0, lambda a, b: sqrt(a)),
    ("pole_not_taken", 0.0, 2.0, lambda a, b: b), ("pole_not_taken", 4.0, 2.0, lambda a, b: 1 / a),
    ("matched", -1.0, 3.0, ZERO), ("matched", 2.0, 3.0, lambda a, b: cbrt(a) + sqrt(a) * b),
    ("nested", -1.0, 0.0, ZERO), ("nested", 0.25, 0.0, ZERO), ("nested", 4.0, 0.0, lambda a, b: sqrt(sqrt(a) - 1)),
    ("returned", -1.0, 0.0, ZERO), ("returned", 2.0, 0.0, lambda a, b: sqrt(a * a * a)),
    ("of_both", -1.0, -1.0, ZERO), ("of_both", 1.0, -1.0, lambda a, b: sqrt(a)), ("of_both", 1.0, 3.0, lambda a, b: sqrt(a + b)),
    ("of_the_larger", -1.0, -3.0, ZERO), ("of_the_larger", -1.0, 3.0, lambda a, b: sqrt(b)), ("of_the_larger", 2.0, 1.0, lambda a, b: sqrt(a)),
    ("own_root", -1.0, 0.0, ZERO), ("own_root", 2.0, 0.0, lambda a, b: 2 * sqrt(a)),
    ("own_inside", -1.0, 0.0, ZERO), ("own_inside", 2.0, 0.0, lambda a, b: sqrt(a)),
    ("own_of_two", -1.0, 4.0, lambda a, b: sqrt(b)), ("own_of_two", 2.0, 4.0, lambda a, b: sqrt(a) + sqrt(b)),
    ("law_of_own", -1.0, 0.0, ZERO), ("law_of_own", 2.0, 0.0, lambda a, b: sqrt(a)),
    ("variable_power", -1.0, 1.5, ZERO), ("variable_power", 2.0, 1.5, lambda a, b: a ** b),
    ("far_length", 0.25, 0.0, lambda a, b: sqrt(a * a + 1)),
]
POINTS += [("logistic", a, 0.0, lambda a, b: 1 / (1 + exp(-800 * a))) for a in (-1.0, -0.9, -0.887, -0.88, -0.872, -0.5, -0.01, 0.0, 0.3, 1.0, 1e6)]
POINTS += [("two_steps", a, b, lambda a, b: 1 / (1 + exp(-800 * a) + exp(900 * b))) for a, b in ((-0.88, 0.1), (0.2, 0.784), (0.2, 0.9), (-2.0, 3.0))]
POINTS += [("soft_minimum", a, b, lambda a, b: -log(exp(-500 * a) + exp(-500 * b)) / 500)
           for a, b in ((0.1, 0.2), (-1.2, -1.3), (-1.41, 0.0), (-1.418, -1.4))]
POINTS += [("soft_maximum", a, b, lambda a, b: log(exp(a) + exp(b))) for a, b in ((1.0, 2.0), (800.0, 799.0), (-2000.0, 3000.0), (-1e6, -1e6 - 1.0))]
POINTS += [("soliton", a, 0.0, lambda a, b: tanh(a) / cosh(a)) for a in (0.4, 30.0, 360.0, -400.0, 709.0, 800.0, -1e5)]
POINTS += [("bell", a, 0.0, lambda a, b: cosh(a) ** -2) for a in (0.4, 200.0, -300.0, 360.0, 800.0)]
POINTS += [("root_of_power", a, 0.0, lambda a, b: sqrt(exp(a))) for a in (1.0, 300.0, 600.0, 709.0)]
POINTS += [("log_of_cosh", a, 0.0, lambda a, b: log(cosh(a))) for a in (0.5, 200.0, -500.0, 709.0)]
POINTS += [("area_of_sinh", a, 0.0, lambda a, b: asinh(sinh(a))) for a in (0.5, 200.0, -500.0, 709.0)]
POINTS += [("gauss", a, 0.0, lambda a, b: exp(-(30 * a) ** 2)) for a in (0.01, 0.3, 1.0, 3.0, 1e3)]
POINTS += [("gompertz", a, 0.0, lambda a, b: exp(-exp(a))) for a in (-3.0, 1.0, 8.0, 400.0, 709.0, 800.0)]
POINTS += [("gudermann", a, 0.0, lambda a, b: 2 * atan(exp(a))) for a in (0.3, 300.0, 360.0, 709.5, 800.0, -800.0)]
POINTS += [("saturated", a, 0.0, lambda a, b: tanh(exp(a))) for a in (0.3, 3.0, 400.0, 709.7, 800.0)]
POINTS += [("hill", a, 0.0, lambda a, b: 1 / (1 + a ** 200)) for a in (0.5, 1.01, 3.0, 34.0, 1e3, 1e9)]
POINTS += [("nested_quotient", a, b, lambda a, b: b / (1 + (1 + exp(a)) ** 2)) for a, b in ((0.5, 2.0), (200.0, 2.0), (354.0, 2.0), (400.0, 2.0), (800.0, 2.0))]
POINTS += [("fourth_root", a, 0.0, lambda a, b: (1 + exp(a)) ** mpf("0.25")) for a in (0.5, 300.0, 709.0)]
POINTS += [("mollifier", a, 0.0, (lambda a, b: exp(-1 / (1 - a * a))) if abs(a) < 1 else ZERO) for a in (0.0, 0.5, 0.99, 0.999999, 1.5)]


def exact(f, a, b):
    a, b = mpf(a), mpf(b)
    flat = [mpf(0)] * (ORDER - 2)
    g = f(Series([a, QD[0], QDD[0] / 2, mpf(0)]), Series([b, QD[1], QDD[1] / 2, mpf(0)])).c
    by_a, by_b = f(Series([a, mpf(1)] + flat), series(b)), f(series(a), Series([b, mpf(1)] + flat))
    return [g[0], by_a.c[1], by_b.c[1], -2 * g[2], -6 * g[3]]


def number(x):
    """Too small for a number is zero."""
    x = mp.mpf(x)
    return 0.0 if abs(x) < mpf(10) ** -320 else float(x)


rows = [{"name": name, "at": [a, b], "exact": [number(x) for x in exact(f, a, b)]} for name, a, b, f in POINTS]
path = pathlib.Path(__file__).with_name("smooth.json")
path.write_text("[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]\n")
