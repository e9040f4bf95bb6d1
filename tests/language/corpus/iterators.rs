//! Chains of iterators and lists, as they are written where speed does not matter.

use kin::prelude::*;

use crate::twice;

twice! { Symbolic pairs_of_a_triangle(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut sum = 0.0;
    for (i, a) in q.iter().enumerate() {
        for b in &q[i + 1..] {
            sum += (a - b).powi(2);
        }
    }
    sum - 2.0
} }

twice! { Symbolic flat_map_over_pairs(coords): fn f(q: [Coord; 3]) -> f64 {
    (0..3).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| q[i] * q[j]).sum::<f64>() - 1.0
} }

twice! { Symbolic chained_and_cycled(coords): fn f(q: [Coord; 3]) -> f64 {
    let ends = [0.5, 1.5];
    q.iter().chain(ends.iter()).zip([1.0, -1.0].iter().cycle()).map(|(x, s)| s * x * x).sum()
} }

twice! { Symbolic numbered_from_one(coords ([0.3, 0.2, 0.1])): fn f(q: [Coord; 2], c: [f64; 3]) -> f64 {
    c.iter().zip(1..).map(|(c, n)| c * (n as f64 * q[0]).sin()).sum::<f64>() - q[1]
} }

twice! { Symbolic taken_while(coords): fn f(q: [Coord; 4]) -> f64 {
    q.iter().copied().take_while(|x| *x < 1.0).sum::<f64>() + q.iter().skip_while(|x| **x < 0.0).count() as f64 * q[0]
} }

twice! { Symbolic split_and_joined(coords): fn f(q: [Coord; 5]) -> f64 {
    let (low, high) = q.split_at(2);
    let joined = [high, low].concat();
    joined.iter().rev().fold(0.0, |sum, x| 0.5 * sum + x)
} }

twice! { Symbolic unzipped(coords): fn f(q: [Coord; 4]) -> f64 {
    let (squares, cubes): (Vec<f64>, Vec<f64>) = q.iter().map(|x| (x * x, x * x * x)).unzip();
    squares.iter().sum::<f64>() - cubes.iter().sum::<f64>() / 3.0
} }

twice! { Symbolic successors(coord): fn f(x: Coord) -> f64 {
    std::iter::successors(Some(1.0), |term| Some(term * x * 0.5)).take(6).sum::<f64>() - 1.5
} }

twice! { Symbolic repeated(coord): fn f(x: Coord) -> f64 {
    std::iter::repeat(x).take(4).product::<f64>() - std::iter::once(0.5).chain([x]).sum::<f64>()
} }

twice! { Symbolic any_and_all(coords): fn f(q: [Coord; 3]) -> f64 {
    let close = q.iter().any(|x| x.abs() < 0.5);
    let positive = q.iter().all(|&x| x > -1.0);
    match (close, positive) {
        (true, true) => q[0] + q[1],
        (true, false) => q[0] - q[2],
        _ => q.iter().product(),
    }
} }

twice! { Symbolic found_by_a_predicate(coords): fn f(q: [Coord; 3]) -> f64 {
    let first = q.iter().find(|x| **x > 0.5).copied().unwrap_or(0.5);
    let mapped = q.iter().find_map(|&x| if x < 0.0 { Some(x * x) } else { None });
    first + mapped.unwrap_or_default() - q[2]
} }

twice! { Symbolic partitioned(coords): fn f(q: [Coord; 4]) -> f64 {
    let sign = |x: f64| if x >= 0.0 { 1.0 } else { 0.0 };
    let positive: f64 = q.iter().map(|&x| sign(x) * x).sum();
    let negative: f64 = q.iter().map(|&x| (1.0 - sign(x)) * x).sum();
    positive * 2.0 + negative
} }

twice! { Symbolic prefix_sums(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut sums = Vec::new();
    let mut running = 0.0;
    for x in q {
        running += x;
        sums.push(running);
    }
    sums.last().copied().unwrap_or(0.0) * sums[0] - sums.iter().skip(1).step_by(2).sum::<f64>()
} }

twice! { Symbolic moving_average(coords (3)): fn f(q: [Coord; 5], _width: usize) -> [f64; 3] {
    let means: Vec<f64> = q.windows(3).map(|w| w.iter().sum::<f64>() / w.len() as f64).collect();
    [means[0] - 0.1, means[1] - means[0], means[2]]
} }

twice! { Symbolic rotated_and_filled(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut all = q;
    all.rotate_left(1);
    let mut padded = [0.0; 6];
    padded[1..5].copy_from_slice(&all);
    padded[0] = all[3];
    padded.iter().zip(padded.iter().skip(1)).map(|(a, b)| a * b).sum::<f64>() - 1.0
} }

twice! { Symbolic min_and_max_by_key(coords): fn f(q: [Coord; 3]) -> f64 {
    let most = q.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
    let least = q.into_iter().min_by(|a, b| (a - 0.5).abs().partial_cmp(&(b - 0.5).abs()).unwrap()).unwrap();
    most * least - 0.5
} }

twice! { Symbolic median_of_three(coord coord coord): fn f(a: Coord, b: Coord, c: Coord) -> f64 {
    a.max(b).min(a.min(b).max(c)) - 0.25 * (a + b + c)
} }

twice! { Symbolic matrix_by_collected_rows(coords): fn f(q: [Coord; 3]) -> f64 {
    let rows: Vec<Vec<f64>> = (0..3).map(|i| (0..3).map(|j| if i == j { 2.0 + q[i] } else { 0.25 * q[j] }).collect()).collect();
    rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1])
        - rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0])
        + rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0])
        - 8.0
} }

twice! { Symbolic last_and_nth(coords): fn f(q: [Coord; 4]) -> f64 {
    let last = q.iter().last().unwrap();
    let second = q.iter().nth(1).unwrap();
    let rest: f64 = q.iter().skip(2).take(1).sum();
    last * second - rest + *q.first().unwrap() - q.get(2).copied().unwrap_or(9.0) * q.len() as f64
} }

twice! { Symbolic two_dimensional_sums(coords ([[1.0, 0.5], [-0.5, 2.0]])): fn f(q: [Coord; 2], stiffness: [[f64; 2]; 2]) -> f64 {
    let energy: f64 = stiffness.iter().zip(&q).map(|(row, a)| row.iter().zip(&q).map(|(k, b)| a * k * b).sum::<f64>()).sum();
    0.5 * energy - 1.0
} }

twice! { Symbolic peeked_differences(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut steps = q.iter().peekable();
    let mut total = 0.0;
    while let Some(x) = steps.next() {
        if let Some(&next) = steps.peek() {
            total += (next - x).powi(2);
        }
    }
    total - 3.0
} }

twice! { Symbolic iterator_by_hand(coords): fn f(q: [Coord; 4]) -> f64 {
    let mut it = q.into_iter();
    let first = it.next().unwrap();
    let second = it.next().unwrap_or(0.0);
    first * second - it.map(|x| x * 0.5).sum::<f64>()
} }
