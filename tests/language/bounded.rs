//! Constraints that are symbolic because every bound is known: control flow, patterns, lists and
//! closures that change, integers.

use crate::twice;

twice! { Symbolic assertions(coord (2.0)): fn f(a: Coord, k: f64) -> f64 {
    assert!(k > 0.0, "a gain of {k}");
    debug_assert!(k.is_finite());
    assert_eq!(1 + 1, 2);
    a.sin() * k
} }

#[derive(Clone, Copy, PartialEq)]
pub enum Profile {
    Flat,
    Slope(f64),
    Arc { r: f64, centre: (f64, f64) },
}

macro_rules! profiles {
    ($($name:ident $profile:expr;)*) => {$(
        twice! { Symbolic $name(coord ($profile)): fn f(a: Coord, profile: Profile) -> f64 {
            let height = match profile {
                Profile::Flat => 0.5,
                Profile::Slope(k) if k > 1.0 => k * a,
                Profile::Slope(k) => a / k,
                Profile::Arc { r, centre: (x, y) } => y + (r * r - (a / 4.0 - x).powi(2)).sqrt(),
            };
            height - a * a
        } }
    )*};
}
profiles! {
    flat_profile Profile::Flat;
    steep_profile Profile::Slope(2.0);
    gentle_profile Profile::Slope(0.5);
    round_profile Profile::Arc { r: 3.0, centre: (0.1, 0.2) };
}

macro_rules! options {
    ($($name:ident $k:expr, $v:expr;)*) => {$(
        twice! { Symbolic $name(coord coord ($k) ($v)): fn f(a: Coord, b: Coord, k: Option<f64>, v: Option<(f64, f64)>) -> (f64, f64) {
            let gain = k.map_or(1.0, |k| k * b);
            let offset = k.unwrap_or(0.25) + k.map(|k| k.sin()).unwrap_or(a);
            let pair = if let Some((x, y)) = v { x * a - y } else { a };
            let Some(k) = k else { return (a * gain, pair - b) };
            let large = (k > 1.0).then(|| a * k).unwrap_or_else(|| a - k);
            let other = (a > b).then_some(a * b);
            (gain * large + offset, pair + other.map_or(0.0, |x| x.cos()))
        } }
    )*};
}
options! {
    options_held Some(2.0), Some((1.0, 2.0));
    options_small Some(0.5), None;
    options_empty None, Some((0.5, -1.0));
}

#[derive(Clone)]
pub struct Spring {
    pub rate: f64,
    pub length: f64,
}

twice! { Symbolic structs_taken_apart(coord (Spring { rate: 3.0, length: 0.5 }) ((2.0, 1.0))): fn f(a: Coord, spring: Spring, pair: (f64, f64)) -> f64 {
    let Spring { rate, length } = spring;
    let (x, y) = pair;
    rate * (a - length) + x * a.sin() - y
} }

twice! { Symbolic tables_inside(coord): fn f(a: Coord) -> f64 {
    const KNOTS: [(f64, f64); 4] = [(-2.0, 1.0), (-0.5, 0.0), (0.75, 2.0), (2.0, 1.5)];
    const WEIGHTS: &[f64] = &[0.5, 0.25];
    static NAMES: [(usize, f64); 2] = [(1, 0.5), (3, 2.0)];
    let mut y = 0.0;
    for k in 0..KNOTS.len() - 1 {
        let (x0, y0) = KNOTS[k];
        let (x1, y1) = KNOTS[k + 1];
        if a >= x0 && a < x1 {
            y = y0 + (y1 - y0) * (a - x0) / (x1 - x0);
        }
    }
    for &(n, w) in NAMES.iter() {
        y += w * a.powi(n as i32);
    }
    y + WEIGHTS.iter().sum::<f64>() * a
} }

twice! { Symbolic returns_anywhere(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    for k in 1..4 {
        let x = a * k as f64;
        if x > 2.5 {
            if b > 0.0 {
                return x - b;
            }
            return x.cos();
        }
    }
    let y = match (a * b > 1.0, b > 1.0) {
        (true, _) => return a * b,
        (false, true) => b,
        _ => {
            if a < -1.0 {
                return a.sin();
            }
            a
        }
    };
    {
        if y > 0.5 {
            return y * y;
        }
    }
    y - b
} }

twice! { Symbolic breaks_and_labels(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let mut sum = 0.0;
    'rows: for i in 0..4 {
        for k in 0..4 {
            let x = a * i as f64 + b * k as f64;
            if x > 3.0 {
                break 'rows;
            }
            if x < -3.0 {
                continue 'rows;
            }
            if k == 2 && i > 1 {
                continue;
            }
            sum += x.sin();
        }
        sum += 0.125;
    }
    let found = 'found: {
        if sum > 1.0 {
            break 'found a;
        }
        b
    };
    let first = loop {
        if sum > 0.0 {
            break sum;
        }
        break sum * 2.0;
    };
    sum + found * first
} }

twice! { Symbolic newton_with_an_end(coord): fn f(a: Coord) -> f64 {
    let mut x = 0.5 * a;
    let mut n = 0;
    while (x * x * x + x - a).abs() > 1e-13 && n < 12 {
        x -= (x * x * x + x - a) / (3.0 * x * x + 1.0);
        n += 1;
    }
    let mut k = 3_i32;
    let mut product = 1.0;
    while k > 0 {
        product *= x + k as f64;
        k -= 1;
    }
    let mut turns = 0;
    loop {
        turns += 1;
        if turns >= 4 {
            break;
        }
        product += x;
    }
    product
} }

twice! { Symbolic lists_that_change(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let mut all = [a, b, a * b, 1.0];
    all.swap(0, 2);
    all.reverse();
    for x in all.iter_mut() {
        *x += 0.5;
    }
    for (k, x) in all.iter_mut().enumerate() {
        *x *= k as f64 + 1.0;
    }
    all[1..3].reverse();
    let mut list = Vec::new();
    list.push(a);
    list.extend(all.iter().copied());
    list.truncate(4);
    let largest = list.iter().copied().reduce(|x, y| x.max(y)).unwrap();
    let least = all.iter().min_by(|x, y| x.total_cmp(y)).unwrap();
    let running: f64 = all.iter().scan(0.0, |sum, x| { *sum += x; Some(*sum * b) }).sum();
    let pair: [f64; 2] = all[..2].try_into().unwrap();
    let first = all.first().unwrap() - list.last().unwrap();
    largest - least + running + pair[0] * pair[1] + first
} }

twice! { Symbolic references_that_change(planar coord): fn f(i: Planar, a: Coord) -> (Vec2, f64) {
    fn bump(x: &mut f64, by: f64) {
        *x += by * *x;
    }
    fn shift(all: &mut [f64]) {
        for k in 1..all.len() {
            all[k] += all[k - 1];
        }
    }
    let mut p = i.r;
    let y = &mut p.y;
    *y *= 2.0;
    let mut x = a;
    bump(&mut x, 0.5);
    bump(&mut p.x, x);
    let mut all = [a, x, 1.0];
    shift(&mut all);
    shift(&mut all[1..]);
    let mut s = a;
    let mut t = x;
    std::mem::swap(&mut s, &mut t);
    (p, all[2] + s - t * t)
} }

twice! { Symbolic closures_of_every_kind(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let mut count = 0.0;
    let mut add = |x: f64| {
        count += x;
        count
    };
    let both = add(a) * add(b);
    let mut steps = 0;
    let mut next = move || {
        steps += 1;
        steps as f64
    };
    let later = next() + next();
    fn apply(f: impl Fn(f64) -> f64, x: f64) -> f64 {
        f(f(x))
    }
    fn sine(x: f64) -> f64 {
        x.sin()
    }
    let chosen = if a > 0.0 { f64::cos } else { sine };
    let scale = b;
    norm(&[a, b]) + norm(&[count]) + both + later * chosen(b) + apply(|x| x * scale, a) + steps as f64
} }

twice! { Symbolic whole_numbers_cast(coord (7)): fn f(a: Coord, n: i32) -> f64 {
    let k = 300_i32 as u8 as f64;
    let m = (2.75_f64 * 2.0) as usize;
    let mask = !0_u8 >> 4;
    let back = !5_i32;
    let flag = (a > 0.0) as i32;
    let chosen = if a > 1.0 { 2 } else { 0 };
    let table = [a, a * a, a.sin()];
    table[chosen] * flag as f64 + k + m as f64 * a + mask as f64 + back as f64 + n as f64
} }

twice! { Symbolic chosen_indices(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let table = [(-1.0, 0.5), (0.0, 1.5), (1.0, -0.5), (2.0, 2.0)];
    let mut k = 0;
    while k < 2 && a > table[k + 1].0 {
        k += 1;
    }
    let (x0, y0) = table[k];
    let (x1, y1) = table[k + 1];
    let mut last = None;
    for (n, &(x, y)) in table.iter().enumerate() {
        if b > x {
            last = Some((n, y));
        }
    }
    let step = match last {
        Some((n, y)) => n as f64 * a + y * b,
        None => b,
    };
    y0 + (y1 - y0) * (a - x0) / (x1 - x0) + step
} }

twice! { Symbolic let_else_and_chains(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    fn root(x: f64) -> Option<f64> {
        if x < 0.0 {
            return None;
        }
        Some(x.sqrt())
    }
    fn both(x: f64, y: f64) -> Option<f64> {
        let r = root(x)?;
        Some(r + root(y)?)
    }
    let Some(r) = root(a + 1.0) else {
        return b - a;
    };
    let s = if let Some(s) = root(b) && s < 1.0 { s } else { 0.5 * b };
    r + s + both(a, b).unwrap_or(0.125)
} }

twice! { Symbolic sorted_by_a_network(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut all = q.to_vec();
    all.sort_by(|x, y| x.partial_cmp(y).unwrap());
    let median = 0.5 * (all[1] + all[2]);
    median + all[3] * 0.25 - all[0]
} }

// A function of which nothing is known beforehand: it panics at some states, and jumps at others.
twice! { Any assertion_that_fails_somewhere(coord): fn f(a: Coord) -> f64 {
    assert!(a > -1.5, "too far");
    a * a + (7.0 * a) % 3.0
} }
