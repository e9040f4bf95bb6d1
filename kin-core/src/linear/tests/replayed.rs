//! Demands on a replay: it restores constants, notices that it no longer fits, and stays flat and
//! linear.

use super::*;
use crate::numbers::random::Random;

/// C_q of a four-bar in absolute coordinates (pins O, A, B, C, then the driver) at its angles;
/// links a, b, c and ground d.
fn four_bar([a, b, c, _]: [f64; 4], [t2, t3, t4]: [f64; 3]) -> Vec<f64> {
    let lever = |l: f64, t: f64| [-0.5 * l * t.sin(), 0.5 * l * t.cos()];
    let a = lever(a, t2);
    let b = lever(b, t3);
    let c = lever(c, t4);
    let rows = (0..2).map(|k| vec![1.0, -a[k]]);
    let rows = rows.chain((0..2).map(|k| vec![1.0, a[k], -1.0, b[k]]));
    let rows = rows.chain((0..2).map(|k| vec![1.0, b[k], -1.0, -c[k]]));
    rows.chain((0..2).map(|k| vec![1.0, -c[k]])).flatten().chain([1.0]).collect()
}

/// Places and constants of a pattern.
type Pattern = (Vec<Option<(usize, usize)>>, Vec<Option<f64>>);

fn four_bar_pattern() -> Pattern {
    let mut pattern = Vec::new();
    for (pin, bodies) in [vec![0], vec![0, 1], vec![1, 2], vec![2]].into_iter().enumerate() {
        for k in 0..2 {
            pattern.extend(
                bodies
                    .iter()
                    .flat_map(|body| [(2 * pin + k, 3 * body + k), (2 * pin + k, 3 * body + 2)])
                    .map(Some),
            );
        }
    }
    pattern.push(Some((8, 2)));
    let levers = pattern
        .iter()
        .map(|place| place.is_some_and(|(row, column)| column % 3 == 2 && row < 8))
        .collect::<Vec<_>>();
    let ones = four_bar([1.0; 4], [0.0; 3]);
    let constants = ones.iter().zip(levers).map(|(one, lever)| (!lever).then_some(*one)).collect();
    (pattern, constants)
}

/// Angles of coupler and rocker over the crank's, open branch.
fn angles([a, b, c, d]: [f64; 4], t2: f64) -> [f64; 3] {
    let x = a * t2.cos();
    let y = a * t2.sin();
    let dx = d - x;
    let dy = -y;
    let r = dx.hypot(dy);
    let e = (b * b - c * c + r * r) / (2.0 * r);
    let h = (b * b - e * e).sqrt();
    let px = (e * dx - h * dy) / r;
    let py = (e * dy + h * dx) / r;
    [t2, py.atan2(px), (y + py).atan2(x + px - d)]
}

/// Its crank turns right round, and so do coupler and rocker: every lever passes through zero, C_q
/// stays regular.
#[test]
fn drag_link_four_bar_is_recorded_anew_where_a_pivot_fades() {
    let links = [2.5, 2.0, 2.5, 1.0];
    let (pattern, constants) = four_bar_pattern();
    let mut linear = Linear::new(9, pattern.iter().copied(), &constants);
    let steps = 20_000;
    let mut worst = 0.0_f64;
    for k in 0..3 * steps {
        let values =
            four_bar(links, angles(links, std::f64::consts::TAU * k as f64 / steps as f64));
        linear.values_mut().copy_from_slice(&values);
        linear.measure();
        assert!(linear.factor());
        let x = solve(&mut linear, &[0.0, 0.1, -0.2, 0.3, 1.0, -0.5, 0.7, 0.2, 1.0]);
        let mut r = [0.0, 0.1, -0.2, 0.3, 1.0, -0.5, 0.7, 0.2, 1.0];
        pattern.iter().flatten().zip(&values).for_each(|((i, j), value)| r[*i] -= value * x[*j]);
        worst = r.iter().fold(worst, |m, r| m.max(r.abs()));
        assert!(linear.smallest_pivot() > 1e-3, "{k}: {:e}", linear.smallest_pivot());
    }
    assert!(worst < 1e-13, "{worst:e}");
    assert!((2..=40).contains(&linear.recordings), "{} recordings", linear.recordings);
}

#[test]
fn constants_that_elimination_changes_are_restored() {
    // Row 2 starts at constants only, and elimination of x_0 and x_1 writes into it.
    let pattern =
        [(0, 0), (0, 2), (1, 1), (1, 2), (1, 3), (2, 0), (2, 1), (2, 2), (3, 2), (3, 3), (0, 3)]
            .map(Some);
    let known = [
        Some(1.0),
        None,
        Some(-1.0),
        None,
        None,
        Some(1.0),
        Some(1.0),
        Some(1.0),
        None,
        None,
        None,
    ];
    let mut linear = Linear::new(4, pattern, &known);
    let random = &mut Random::new(7);
    for round in 0..200 {
        for (value, known) in linear.values_mut().iter_mut().zip(&known) {
            *value = known.unwrap_or(2.0 + 0.2 * random.number());
        }
        linear.measure();
        assert!(linear.factor());
        let values = linear.values().to_vec();
        let x = solve(&mut linear, &[1.0, 2.0, 3.0, 4.0]);
        let mut r = [1.0, 2.0, 3.0, 4.0];
        pattern.iter().flatten().zip(&values).for_each(|((i, j), value)| r[*i] -= value * x[*j]);
        assert!(r.iter().all(|r| r.abs() < 1e-13), "{round}: {r:?}");
        assert_eq!(linear.values(), values);
    }
    assert_eq!(linear.recordings, 1);
}

/// A value that claims to be a constant and is none is no constant.
#[test]
fn constant_that_is_not_what_it_claims_is_a_number_like_others() {
    let mut linear = Linear::new(1, [Some((0, 0))], &[Some(1.0)]);
    linear.values_mut()[0] = 4.0;
    linear.measure();
    assert!(linear.factor());
    assert_eq!(solve(&mut linear, &[2.0]), [0.5]);
}

/// Loops in a row: x_i − x_{i−1} + a_i x_{i+1}, which no order makes triangular.
fn banded(n: usize) -> Linear {
    let places = (0..n).flat_map(|i| [(i, i.wrapping_sub(1)), (i, i), (i, i + 1)]);
    let known = [Some(-1.0), Some(1.0), None].repeat(n);
    let mut linear = Linear::new(n, places.map(Some), &known);
    let random = &mut Random::new(3);
    linear
        .values_mut()
        .chunks_exact_mut(3)
        .for_each(|row| row.copy_from_slice(&[-1.0, 1.0, 0.5 + 0.1 * random.number()]));
    linear.measure();
    linear
}

#[test]
fn work_is_linear_in_the_size_of_a_band() {
    let sizes = [300, 3000, 30_000].map(|n| {
        let mut linear = banded(n);
        assert!(linear.factor());
        let recording = linear.recording.as_ref().unwrap();
        let work = recording.factor.size();
        let solving = recording.solve.size();
        (
            linear.memory.len() as f64 / n as f64,
            (work.0 + work.1) as f64 / n as f64,
            (solving.0 + solving.1) as f64 / n as f64,
        )
    });
    for pair in sizes.windows(2) {
        let a = pair[0];
        let b = pair[1];
        assert!(b.0 < 1.05 * a.0 && b.1 < 1.05 * a.1 && b.2 < 1.05 * a.2, "{sizes:?}");
    }
    assert!(sizes[2].0 < 12.0 && sizes[2].1 < 16.0 && sizes[2].2 < 16.0, "{sizes:?}");
}

#[test]
fn replay_is_the_same_after_any_other_numbers() {
    let mut linear = banded(50);
    let first = linear.values().to_vec();
    assert!(linear.factor());
    let b: Vec<f64> = (0..50).map(|k| (k as f64).sin()).collect();
    let x = solve(&mut linear, &b);
    linear.values_mut().chunks_exact_mut(3).for_each(|row| row[2] *= 1.1);
    assert!(linear.factor());
    assert_ne!(solve(&mut linear, &b), x);
    linear.values_mut().copy_from_slice(&first);
    assert!(linear.factor());
    assert_eq!(solve(&mut linear, &b), x);
    assert_eq!(linear.recordings, 1);
}
