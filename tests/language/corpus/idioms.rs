//! Idioms of Rust as people write them.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic kept_by_a_condition(coords): fn f(q: [Coord; 4]) -> f64 {
    let positive: f64 = q.iter().filter(|x| **x > 0.0).sum();
    let count = q.iter().filter(|&&x| x > 0.5).count();
    positive - 0.5 * q[0] * count as f64
} }

twice! { Symbolic slice_patterns(coords): fn f(q: [Coord; 4]) -> f64 {
    let [first, .., last] = q;
    let middle = match &q[1..3] {
        [a, b] => a * b,
        _ => 0.0,
    };
    let rest = if let [_, rest @ ..] = &q[..] { rest.iter().sum::<f64>() } else { 0.0 };
    first - last + middle * rest
} }

twice! { Symbolic boxed_functions(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    let laws: [Box<dyn Fn(f64) -> f64>; 3] = [Box::new(|x| x * x), Box::new(f64::sin), Box::new(move |x| x * b)];
    laws.iter().map(|law| law(a)).sum::<f64>()
} }

twice! { Symbolic functions_of_functions(coord): fn f(a: Coord) -> f64 {
    fn twice(f: impl Fn(f64) -> f64) -> impl Fn(f64) -> f64 {
        move |x| f(f(x))
    }
    fn slope(f: &dyn Fn(f64) -> f64, x: f64) -> f64 {
        (f(x + 0.5) - f(x - 0.5)) / 1.0
    }
    let g = twice(|x| x.sin() + 0.5);
    g(a) + slope(&|x| x * x * x, a) + slope(&g, 0.25 * a)
} }

twice! { Symbolic newtypes_and_traits(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    trait Energy {
        fn energy(&self) -> f64;
        fn doubled(&self) -> f64 {
            2.0 * self.energy()
        }
    }
    struct Mass(f64, f64);
    struct Spring {
        rate: f64,
        stretch: f64,
    }
    impl Energy for Mass {
        fn energy(&self) -> f64 {
            0.5 * self.0 * self.1 * self.1
        }
    }
    impl Energy for Spring {
        fn energy(&self) -> f64 {
            0.5 * self.rate * self.stretch.powi(2)
        }
    }
    let m = Mass(2.0, a);
    let s = Spring { rate: 3.0, stretch: b };
    m.energy() + s.energy() + s.doubled() - 1.0
} }

twice! { Symbolic words_as_modes(coord ("fine".to_string())): fn f(a: Coord, mode: String) -> f64 {
    let step = match mode.as_str() {
        "coarse" => 0.5,
        "fine" => 0.125,
        _ => 1.0,
    };
    a.cos() - step
} }

twice! { Symbolic sums_of_vectors(planar planar): fn f(i: Planar, j: Planar) -> Vec2 {
    let corners = [vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, -1.0)];
    let sum: Vec2 = corners.iter().map(|u| i.point(*u) - j.point(*u)).sum();
    let mut mean = sum / corners.len() as f64;
    mean += vec2(0.1, 0.2);
    mean.x -= 0.5;
    -mean
} }

twice! { Symbolic shadows_and_blocks(coord): fn f(a: Coord) -> f64 {
    let x = a;
    let x = {
        let y = x * 2.0;
        let x = y + 1.0;
        x * y
    };
    let a = x - a;
    (|x: f64| x + a)(x)
} }

twice! { Symbolic greatest_with_its_place(coords): fn f(q: [Coord; 3]) -> f64 {
    let (place, value) = q.iter().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap();
    value * (place as f64 + 1.0) - q.iter().copied().fold(f64::INFINITY, |a, b| a.min(b))
} }

twice! { Symbolic results_and_defaults(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    fn divided(a: f64, b: f64) -> Result<f64, &'static str> {
        if b.abs() < 0.25 { Err("too small") } else { Ok(a / b) }
    }
    fn chained(a: f64, b: f64) -> Result<f64, &'static str> {
        let q = divided(a, b)?;
        divided(q, a).map(|x| x + q)
    }
    chained(a, b).unwrap_or_else(|_| a - b) + divided(b, a).ok().unwrap_or(0.5)
} }

twice! { Symbolic matrices_by_hand(coord coord): fn f(a: Coord, b: Coord) -> (Vec2, f64) {
    let m = Mat2::from_rows([vec2(a.cos(), -a.sin()), vec2(a.sin(), a.cos())]);
    let n = m * m.transpose() * b;
    (m * vec2(1.0, b) - n.column(0), n.determinant() - m[(0, 1)])
} }

twice! { Symbolic strides(coords): fn f(q: [Coord; 6]) -> f64 {
    let mut sum = 0.0;
    for k in (0..6).step_by(2) {
        sum += q[k] * q[k + 1];
    }
    for (k, pair) in q.chunks_exact(2).enumerate().skip(1) {
        let &[x, y] = pair else { continue };
        sum -= x * k as f64 - y;
    }
    let last = (1..=5).rev().find(|k| k % 2 == 0).unwrap();
    sum + q[last]
} }

twice! { Symbolic constants_of_a_type(coord): fn f(a: Coord) -> f64 {
    const fn square(n: usize) -> usize {
        n * n
    }
    const SIDE: usize = square(3);
    let mut all = [0.0; SIDE];
    for (k, x) in all.iter_mut().enumerate() {
        *x = a.powi(k as i32 % 3);
    }
    all.iter().sum::<f64>() - f64::EPSILON * SIDE as f64
} }

twice! { Symbolic counters_by_reference(coord coord): fn f(a: Coord, b: Coord) -> f64 {
    struct Counter<'a> {
        total: &'a mut f64,
        calls: usize,
    }
    impl Counter<'_> {
        fn add(&mut self, x: f64) -> f64 {
            *self.total += x;
            self.calls += 1;
            *self.total
        }
    }
    let mut total = a;
    let mut counter = Counter { total: &mut total, calls: 0 };
    let x = counter.add(b) * counter.add(a);
    let calls = counter.calls;
    x + total * calls as f64
} }
