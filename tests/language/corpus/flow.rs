//! Ways through a function: early returns, guards, labels, options, results, loops that end
//! somewhere.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic stops_of_a_spring(coord coord): fn f(x: Coord, force: Coord) -> f64 {
    if x < -1.0 {
        return force - (100.0 * (x + 1.0) - 1.0);
    }
    if x > 1.0 {
        return force - (100.0 * (x - 1.0) + 1.0);
    }
    force - x
} }

twice! { Symbolic regions_by_match(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    match (a.is_sign_positive(), b.partial_cmp(&0.5)) {
        (true, Some(std::cmp::Ordering::Greater)) => a * b,
        (true, _) => a + b,
        (false, Some(std::cmp::Ordering::Less)) => a - b,
        (false, _) => b * b - a,
    }
} }

twice! { Symbolic ranges_as_patterns(coord): fn f(a: Coord) -> f64 {
    match a {
        ..=-1.0 => a + 1.0,
        -1.0..0.0 => -a * (a + 1.0),
        0.0..=1.0 => a * (1.0 - a),
        _ => 1.0 - a,
    }
} }

twice! { Symbolic bound_by_at(coord (3)): fn f(a: Coord, n: u8) -> f64 {
    let gain = match n {
        0 => 0.0,
        k @ 1..=4 => k as f64 * 0.5,
        k if k % 2 == 0 => 4.0,
        _ => 5.0,
    };
    a.sin() * gain - 0.2
} }

twice! { Symbolic question_marks(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    fn angle(adjacent: f64, hypotenuse: f64) -> Option<f64> {
        let c = adjacent / hypotenuse;
        (c.abs() <= 1.0).then(|| c.acos())
    }
    fn triangle(a: f64, b: f64) -> Option<(f64, f64)> {
        let alpha = angle(a, 2.0)?;
        let beta = angle(b, 2.0)?;
        Some((alpha, beta))
    }
    match triangle(a, b) {
        Some((alpha, beta)) => alpha + beta - 2.0,
        None => a - b,
    }
} }

twice! { Symbolic errors_as_enums(coord): fn f(a: Coord) -> f64 {
    enum Fault {
        Short(f64),
        Long { by: f64 },
    }
    fn checked(x: f64) -> Result<f64, Fault> {
        if x < -0.5 {
            Err(Fault::Short(-0.5 - x))
        } else if x > 0.5 {
            Err(Fault::Long { by: x - 0.5 })
        } else {
            Ok(x)
        }
    }
    match checked(a) {
        Ok(x) => x,
        Err(Fault::Short(by)) => -0.5 - 0.1 * by,
        Err(Fault::Long { by }) => 0.5 + 0.1 * by * by,
    }
} }

twice! { Symbolic regula_falsi(coord): fn f(k: Coord) -> f64 {
    let g = |x: f64| x.exp() - 2.0 - 0.1 * k;
    let mut a = 0.0;
    let mut b = 2.0;
    let mut ga = g(a);
    let gb = g(b);
    for _ in 0..4 {
        let x = (a * gb - b * ga) / (gb - ga);
        let gx = g(x);
        if gx * ga > 0.0 {
            a = x;
            ga = gx;
        } else {
            b = x;
        }
    }
    a + b - 1.0
} }

twice! { Symbolic kepler(coord coord): fn f(mean: Coord, x: Coord) -> f64 {
    const ECCENTRICITY: f64 = 0.3;
    let mut e = mean;
    for k in 0..20 {
        let step = (e - ECCENTRICITY * e.sin() - mean) / (1.0 - ECCENTRICITY * e.cos());
        e -= step;
        if step.abs() < 1e-14 || k > 6 {
            break;
        }
    }
    x - (e.cos() - ECCENTRICITY)
} }

twice! { Symbolic arithmetic_geometric_mean(coord coord): fn f(a: Coord, period: Coord) -> f64 {
    let mut x = 1.0;
    let mut y = (0.5 * a).cos().abs() + 0.1;
    let mut turns = 0;
    loop {
        (x, y) = (0.5 * (x + y), (x * y).sqrt());
        turns += 1;
        if turns == 5 {
            break period - std::f64::consts::FRAC_PI_2 / x;
        }
    }
} }

twice! { Symbolic ternary_search(coord): fn f(a: Coord) -> f64 {
    let cost = |x: f64| (x - 0.3 * a).powi(2);
    let mut range = (-1.0, 1.0);
    for _ in 0..5 {
        let third = (range.1 - range.0) / 3.0;
        let p = range.0 + third;
        let q = range.1 - third;
        range = if cost(p) < cost(q) { (range.0, q) } else { (p, range.1) };
    }
    a - 0.5 * (range.0 + range.1)
} }

twice! { Symbolic hysteresis_with_a_flag(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut on = false;
    let mut total = 0.0;
    for x in q {
        on = match on {
            false if x > 0.5 => true,
            true if x < -0.5 => false,
            same => same,
        };
        total += if on { x } else { 0.25 * x };
    }
    total
} }

twice! { Symbolic state_machine_over_samples(coords): fn f(q: [Coord; 3]) -> f64 {
    #[derive(Clone, Copy)]
    enum State {
        Idle,
        Moving(f64),
        Done { at: f64 },
    }
    let mut state = State::Idle;
    for x in q.iter().copied() {
        state = match state {
            State::Idle if x > 0.0 => State::Moving(x),
            State::Moving(v) if v + x > 1.0 => State::Done { at: v + x },
            State::Moving(v) => State::Moving(v * x),
            other => other,
        };
    }
    match state {
        State::Idle => q[0],
        State::Moving(v) => v + q[1],
        State::Done { at } => at * q[2],
    }
} }

twice! { Symbolic shadowed_in_arms(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let r = match x * x + y * y {
        d2 if d2 > 4.0 => {
            let d = d2.sqrt();
            2.0 + (d - 2.0) * 0.5
        }
        d2 => {
            let x = d2 * 0.5;
            x
        }
    };
    r - x
} }

twice! { Symbolic nested_blocks_with_labels(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let gear = 'shift: {
        if a > 1.0 {
            break 'shift 3.0;
        }
        let load = a * b;
        if load > 0.5 {
            break 'shift 2.0 + load;
        }
        1.0
    };
    a * gear - b
} }

twice! { Symbolic while_let_over_a_stack(coord): fn f(a: Coord) -> f64 {
    let mut stack = vec![(a, 0)];
    let mut sum = 0.0;
    while let Some((x, depth)) = stack.pop() {
        if depth == 3 {
            sum += x;
            continue;
        }
        stack.push((x * 0.5 + 0.1, depth + 1));
        stack.push((x * x, depth + 1));
    }
    sum - 1.0
} }

twice! { Symbolic collatz_over_a_known_number(coord): fn f(a: Coord) -> f64 {
    let mut n = 6_u32;
    let mut x = a;
    while n != 1 {
        if n % 2 == 0 {
            n /= 2;
            x *= 0.5;
        } else {
            n = 3 * n + 1;
            x = 3.0 * x + 1.0;
        }
    }
    x - 0.1
} }

twice! { Symbolic options_taken_and_replaced(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let mut held = Some(a);
    let old = held.take();
    let none = held.is_none();
    held = Some(b);
    let both = old.zip(held).map(|(x, y)| x * y);
    let kept = held.filter(|x| *x > 0.0).or(old).unwrap();
    both.unwrap_or(0.0) + if none { kept } else { 0.0 }
} }

twice! { Symbolic chains_of_conditions(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let limit = Some(0.5);
    if let Some(l) = limit && a > l && let Some(w) = (b > 0.0).then_some(b) {
        a * w
    } else if a > 0.0 || b > 1.0 {
        a - b
    } else {
        b
    }
} }

twice! { Symbolic bits_of_a_mask(coords (0b101)): fn f(q: [Coord; 3], _mask: u32) -> f64 {
    const MASK: u32 = 0b101;
    let mut sum = 0.0;
    for (k, x) in q.iter().enumerate() {
        if MASK >> k & 1 == 1 {
            sum += x * x;
        } else {
            sum -= x;
        }
    }
    sum - MASK.count_ones() as f64
} }

twice! { Symbolic recursion_over_a_slice(coords): fn f(q: [Coord; 5]) -> f64 {
    fn fraction(terms: &[f64]) -> f64 {
        match terms {
            [] => 0.0,
            [only] => *only,
            [first, rest @ ..] => 3.0 + first + 1.0 / (4.0 + fraction(rest)),
        }
    }
    fraction(&q) - 3.5
} }

twice! { Symbolic simplex_by_halves(coords): fn f(q: [Coord; 2]) -> f64 {
    fn area(a: (f64, f64), b: (f64, f64), c: (f64, f64), depth: u32) -> f64 {
        if depth == 0 {
            return 0.5 * ((b.0 - a.0) * (c.1 - a.1) - (c.0 - a.0) * (b.1 - a.1));
        }
        let m = (0.5 * (b.0 + c.0), 0.5 * (b.1 + c.1));
        area(a, b, m, depth - 1) + area(a, m, c, depth - 1)
    }
    area((0.0, 0.0), (1.0, q[0]), (q[1], 1.0), 3) - 0.3
} }
