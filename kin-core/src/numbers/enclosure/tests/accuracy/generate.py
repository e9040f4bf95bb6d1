"""Values of the functions of one and two numbers at their worst arguments, to some 32 digits of 60 computed: functions.txt.

    pip install mpmath
    python3 generate.py > functions.txt

Arguments are f64s: those at which the platform's function was found to be off most among many random ones of all sizes, and those at which functions
are known to be hard (edges of domains, zeros, poles, overflow, underflow, large multiples of a quarter turn). A line is the function's name, its
arguments, the nearest f64 of the value and the nearest f64 of the rest, all as bits.
"""
import math, random, struct
import mpmath as mp

mp.mp.prec = 4000  # tan and sin of 1e300 need the 1000 bits of their argument; no result is used to more than 106 bits
random.seed(1)
TRIED, KEPT = 6000, 24


def bits(x):
    return "%016x" % struct.unpack(">Q", struct.pack(">d", x))[0]


def nearest(x):
    """The f64 nearest to a number of mpmath (float() rounds twice among subnormals; those are left out below)."""
    return float(x)


def acosh(x):
    if x > 1e9: return math.log(x) + math.log(2.0)
    if x > 2: return math.log(2 * x - 1 / (x + math.sqrt(x * x - 1)))
    t = x - 1
    return math.log1p(t + math.sqrt(t * (2 + t)))


def atanh(x):
    a = abs(x)
    y = 2 * a + 2 * a * a / (1 - a) if a < 0.5 else 2 * a / (1 - a)
    return math.copysign(0.5 * math.log1p(y), x)


def asinh(x):
    a = abs(x)
    if a == 0: return x
    i = 1 / a
    return math.copysign(math.log1p(a + a / (math.hypot(1, i) + i)), x)


def cbrt(x):
    return -mp.cbrt(-x) if x < 0 else mp.cbrt(x)


def sizes(lo, hi):
    """Of all sizes and both signs."""
    return random.choice([-1, 1]) * 10 ** random.uniform(lo, hi)


def beside(x, lo=-17, hi=-1):
    """Near a number."""
    return x * (1 + sizes(lo, hi)) if x else sizes(-300, hi)


quarter = math.pi / 2
turns = [k * quarter for k in [1, 2, 3, 4, 5, 7, 11, 22, 355, 1e5, 1e9, 1e15]] + [6381956970095103.0 * 2.0 ** 797, 5.319372648326541e255, 1e300, 1e22]
edges = [1e-310, 1e-300, 1e-160, 1e-20, 1e-8, 0.5, 1.0, 2.0]

# name: (the platform's, mpmath's, an argument at random, arguments that are hard)
ONE = {
    "Sin": (math.sin, mp.sin, lambda: beside(random.choice(turns)) if random.random() < 0.5 else sizes(-10, 20), turns),
    "Cos": (math.cos, mp.cos, lambda: beside(random.choice(turns)) if random.random() < 0.5 else sizes(-10, 20), turns),
    "Tan": (math.tan, mp.tan, lambda: beside(random.choice(turns)) if random.random() < 0.5 else sizes(-10, 20), turns),
    "Asin": (math.asin, mp.asin, lambda: random.choice([random.uniform(-1, 1), 1 - 10 ** random.uniform(-16, 0), -1 + 10 ** random.uniform(-16, 0)]), [1.0, -1.0, 0.5, 1 - 2 ** -53]),
    "Acos": (math.acos, mp.acos, lambda: random.choice([random.uniform(-1, 1), 1 - 10 ** random.uniform(-16, 0), -1 + 10 ** random.uniform(-16, 0)]), [-1.0, 0.5, 1 - 2 ** -53, 2 ** -53 - 1]),
    "Atan": (math.atan, mp.atan, lambda: sizes(-20, 20), [1e300, 1.0, -1.0]),
    "Sinh": (math.sinh, mp.sinh, lambda: random.choice([sizes(-20, 2.85), random.uniform(-3, 3)]), [710.0, -709.7]),
    "Cosh": (math.cosh, mp.cosh, lambda: random.choice([sizes(-20, 2.85), random.uniform(-3, 3)]), [710.0, -709.7]),
    "Tanh": (math.tanh, mp.tanh, lambda: random.choice([sizes(-20, 2), random.uniform(-3, 3)]), [19.0, 22.0, -30.0]),
    "Asinh": (asinh, mp.asinh, lambda: random.choice([sizes(-20, 20), random.uniform(-3, 3)]), [1e300, -1e300, 1e-300]),
    "Acosh": (acosh, mp.acosh, lambda: 1 + 10 ** random.uniform(-16, 20), [1 + 2 ** -52, 2.0, 1e9, 1e300]),
    "Atanh": (atanh, mp.atanh, lambda: random.choice([1, -1]) * random.choice([10 ** random.uniform(-20, 0), 1 - 10 ** random.uniform(-16, 0)]), [1 - 2 ** -53, 2 ** -53 - 1, -1 + 1e-9, 0.5, -0.5]),
    "Exp": (math.exp, mp.exp, lambda: random.choice([random.uniform(-708, 709), sizes(-20, 1)]), [709.7, -708.0]),
    "Exp2": (lambda x: math.exp2(x), lambda x: mp.power(2, x), lambda: random.choice([random.uniform(-1021, 1023), sizes(-20, 1)]), [1023.9, -1021.5]),
    "ExpM1": (math.expm1, mp.expm1, lambda: random.choice([random.uniform(-40, 709), sizes(-20, 0)]), [709.7, -50.0]),
    "Ln": (math.log, mp.log, lambda: random.choice([abs(sizes(-300, 300)), abs(beside(1.0))]), [5e-324, 1.7e308, 1 - 2 ** -53, 1 + 2 ** -52]),
    "Ln1p": (math.log1p, mp.log1p, lambda: random.choice([abs(sizes(-20, 300)), -1 + 10 ** random.uniform(-16, 0), sizes(-20, -0.5)]), [2 ** -53 - 1, 1.7e308, 1e-300]),
    "Log2": (math.log2, lambda x: mp.log(x) / mp.log(2), lambda: random.choice([abs(sizes(-300, 300)), abs(beside(1.0))]), [5e-324, 1.7e308, 1 - 2 ** -53, 1 + 2 ** -52]),
    "Log10": (math.log10, mp.log10, lambda: random.choice([abs(sizes(-300, 300)), abs(beside(1.0))]), [5e-324, 1.7e308, 1 - 2 ** -53, 1 + 2 ** -52]),
    "Sqrt": (math.sqrt, mp.sqrt, lambda: abs(sizes(-300, 300)), [5e-324, 2.0]),
    "Cbrt": (lambda x: math.cbrt(x), cbrt, lambda: sizes(-300, 300), [5e-324, -1.7e308]),
}
TWO = {
    "Atan2": (math.atan2, mp.atan2, lambda: (sizes(-8, 8), sizes(-8, 8)), [(1e-300, -1.0), (-1e-300, -1.0), (1.0, 1e-300), (1e300, -1e-5)]),
    "Hypot": (math.hypot, mp.hypot, lambda: (sizes(-6, 6), sizes(-6, 6)), [(1e150, 1e150), (3e-150, 4e-150), (1.0, 1e-9)]),
    "Powf": (math.pow, mp.power, lambda: (abs(sizes(-3, 3)), sizes(-2, 1.9)), [(1 + 2 ** -52, 1e15), (1e100, 2.9999), (1e-100, -2.5), (0.5, 0.3333)]),
}


def line(name, arguments, exact):
    hi = nearest(exact)
    lo = nearest(exact - mp.mpf(hi))
    return " ".join([name, *map(bits, arguments), bits(hi), bits(lo)])


def fits(value):
    return 1e-290 < abs(value) < 1e308


def worst(platform, exact, at_random, hard):
    tried = []
    for k in range(TRIED):
        x = at_random()
        arguments = x if isinstance(x, tuple) else (x,)
        try:
            found = platform(*arguments)
        except (ValueError, OverflowError):
            continue
        if not fits(found): continue
        mp.mp.prec = 1400 if max(map(abs, arguments)) > 1e15 else 240
        value = exact(*map(mp.mpf, arguments))
        off = abs(value - mp.mpf(found)) / mp.mpf(math.ulp(found))
        tried.append((float(off), arguments))
    tried.sort(reverse=True)
    spread = tried[:KEPT] + random.sample(tried, 12)
    mp.mp.prec = 4000
    own = [x if isinstance(x, tuple) else (x,) for x in hard]
    return [arguments for _, arguments in spread] + own


for name, (platform, exact, at_random, hard) in {**ONE, **TWO}.items():
    for arguments in worst(platform, exact, at_random, hard):
        value = exact(*map(mp.mpf, arguments))
        if fits(value): print(line(name, arguments, value))
