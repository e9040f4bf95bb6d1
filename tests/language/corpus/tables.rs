//! Look-up tables, laws by pieces, drivers, filters and other code as people write it.

use crate::twice;

twice! { Symbolic linear_table(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const X: [f64; 5] = [-2.0, -1.0, 0.0, 1.5, 2.5];
    const Y: [f64; 5] = [0.0, 1.0, 0.5, 2.0, 1.0];
    let mut value = Y[0];
    for k in 1..X.len() {
        if x > X[k - 1] {
            let s = ((x - X[k - 1]) / (X[k] - X[k - 1])).min(1.0);
            value = Y[k - 1] + s * (Y[k] - Y[k - 1]);
        } else {
            break;
        }
    }
    y - value
} }

twice! { Symbolic table_by_position(coord): fn f(x: Coord) -> f64 {
    let knots = [-1.0, 0.0, 1.0];
    let levels = [0.25, 0.5, 0.75, 1.0];
    let k = knots.iter().position(|&knot| x < knot).unwrap_or(knots.len());
    x * levels[k] - 0.1
} }

twice! { Symbolic dwell_rise_dwell(coord time (1.0)): fn f(x: Coord, t: Time, rise: f64) -> f64 {
    let u = t - 1.0;
    let y = match u {
        u if u < 0.0 => 0.0,
        u if u < 2.0 => {
            let s = u / 2.0;
            rise * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
        }
        _ => rise,
    };
    x - y
} }

twice! { Symbolic trapezoid_speed(coord time): fn f(x: Coord, t: Time) -> f64 {
    let ramp = 0.75;
    let hold = 1.5;
    let v = 2.0;
    let s = if t <= ramp {
        0.5 * v / ramp * t * t
    } else if t <= ramp + hold {
        0.5 * v * ramp + v * (t - ramp)
    } else {
        let left = (2.0 * ramp + hold - t).max(0.0);
        v * (ramp + hold) - 0.5 * v / ramp * left * left
    };
    x - s
} }

twice! { Symbolic bilinear_map(coord coord coord): fn f(x: Coord, y: Coord, z: Coord) -> f64 {
    static GRID: [[f64; 3]; 3] = [[0.0, 1.0, 0.5], [1.0, 2.0, 0.0], [0.5, 1.5, 1.0]];
    let cell = |u: f64| if u < 0.0 { (0, (u + 2.0) / 2.0) } else { (1, u / 2.0) };
    let (i, s) = cell(x);
    let (j, t) = cell(y);
    let low = GRID[i][j] * (1.0 - t) + GRID[i][j + 1] * t;
    let high = GRID[i + 1][j] * (1.0 - t) + GRID[i + 1][j + 1] * t;
    z - (low * (1.0 - s) + high * s)
} }

twice! { Symbolic friction_curve(coord coord): fn f(v: Coord, force: Coord) -> f64 {
    const COULOMB: f64 = 0.3;
    const STICTION: f64 = 0.5;
    let stribeck = COULOMB + (STICTION - COULOMB) * (-(v / 0.2).powi(2)).exp();
    force - stribeck * (v / 0.05).tanh() - 0.1 * v
} }

twice! { Symbolic backlash(coord coord (0.2)): fn f(a: Coord, b: Coord, gap: f64) -> f64 {
    let d = a - b;
    let play = match () {
        _ if d > gap => d - gap,
        _ if d < -gap => d + gap,
        _ => 0.0,
    };
    play + 0.01 * b
} }

twice! { Symbolic weighted_mean_of_pairs(coords): fn f(q: [Coord; 3]) -> f64 {
    let samples = q.iter().zip([1.0, 2.0, 4.0]);
    let (sum, weight) = samples.fold((0.0, 0.0), |(s, w), (x, k)| (s + k * x, w + k));
    sum / weight - q.iter().skip(1).map(|x| x.cos()).product::<f64>()
} }

twice! { Symbolic counted_crossings(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut crossings = 0;
    for pair in q.windows(2) {
        if pair[0] < 0.0 && pair[1] >= 0.0 {
            crossings += 1;
        }
    }
    q.iter().sum::<f64>() - 0.25 * crossings as f64
} }

twice! { Symbolic bisection(coord): fn f(a: Coord) -> f64 {
    let mut low = -4.0;
    let mut high = 4.0;
    for _ in 0..6 {
        let middle = 0.5 * (low + high);
        if middle * middle * middle + middle > a {
            high = middle;
        } else {
            low = middle;
        }
    }
    a * low - high
} }

twice! { Symbolic continued_fraction(coord): fn f(x: Coord) -> f64 {
    let mut value = 9.0;
    for k in (0..4).rev() {
        value = (2 * k + 1) as f64 + x * x / value;
    }
    x / value - 0.25
} }

twice! { Symbolic fixed_point_filter(coord (0.5)): fn f(x: Coord, gain: f64) -> f64 {
    let mut state = (0.0, 0.0);
    let mut step = |input: f64| {
        state.0 += gain * (input - state.0);
        state.1 += gain * (state.0 - state.1);
        state.1
    };
    let mut out = 0.0;
    for k in 0..3 {
        out = step(x * (k as f64 + 1.0));
    }
    out
} }

twice! { Symbolic horner_from_the_end(coord): fn f(x: Coord) -> f64 {
    let coefficients = [1.0, -2.0, 0.5, 0.25];
    let mut rest = &coefficients[..];
    let mut value = 0.0;
    while let Some((last, others)) = rest.split_last() {
        value = value * x + last;
        rest = others;
    }
    value
} }

twice! { Symbolic modes_of_a_state_machine(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    #[derive(Clone, Copy, PartialEq)]
    enum Mode {
        Free,
        Touching { depth: f64 },
        Jammed(f64, f64),
    }
    let mode = if x > 1.0 {
        Mode::Jammed(x, y)
    } else if x > 0.0 {
        Mode::Touching { depth: x * y }
    } else {
        Mode::Free
    };
    let force = match mode {
        Mode::Free => 0.0,
        Mode::Touching { depth } => 2.0 * depth,
        Mode::Jammed(a, b) if a > b => a - b,
        Mode::Jammed(a, _) => a,
    };
    force + if mode == Mode::Free { y } else { x }
} }

twice! { Symbolic gaussian_quadrature(coord): fn f(x: Coord) -> f64 {
    let nodes = [(0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (-0.774_596_669_241_483_4, 5.0 / 9.0)];
    let half = 0.5 * x;
    let integral: f64 = nodes.iter().map(|&(u, w)| w * (half * (1.0 + u)).exp()).sum::<f64>() * half;
    integral - 0.5
} }

twice! { Symbolic runge_kutta_step(coord coord): fn f(x: Coord, v: Coord) -> (f64, f64) {
    let rate = |(x, v): (f64, f64)| (v, -x - 0.1 * v * v * v);
    let along = |(x, v): (f64, f64), (dx, dv): (f64, f64), h: f64| (x + h * dx, v + h * dv);
    let h = 0.25;
    let s = (x, v);
    let k1 = rate(s);
    let k2 = rate(along(s, k1, 0.5 * h));
    let k3 = rate(along(s, k2, 0.5 * h));
    let k4 = rate(along(s, k3, h));
    let next = |a: f64, k: [f64; 4]| a + h / 6.0 * (k[0] + 2.0 * k[1] + 2.0 * k[2] + k[3]);
    (next(x, [k1.0, k2.0, k3.0, k4.0]), next(v, [k1.1, k2.1, k3.1, k4.1]))
} }
