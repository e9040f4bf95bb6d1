//! `if`, `match`, `for`, closures, functions inside the body; and what only dual numbers can
//! follow.

use kin::check::{any_coord as c, any_planar as p};
use kin::prelude::*;

use crate::reads;

#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Fast,
    Slow,
}

const GAIN: f64 = 1.5;

#[constraint]
fn by_mode(a: Coord, mode: Mode) -> f64 {
    let gain = match mode {
        Mode::Fast => 2.0,
        Mode::Slow => GAIN,
    };
    if mode == Mode::Fast { gain * a } else { a / gain }
}
reads!(match_on_an_enum_of_ones_own, Symbolic, by_mode(c(), Mode::Slow), at [3.0], 0.0 => [2.0]);
reads!(match_on_the_other_variant, Symbolic, by_mode(c(), Mode::Fast), at [3.0], 0.0 => [6.0]);

#[constraint]
fn by_number(a: Coord, n: i32) -> f64 {
    match (n, a > 0.0) {
        (0, true) => a,
        (1..=3, _) => 2.0 * a,
        (_, false) => -a,
        _ => a * n as f64,
    }
}
reads!(match_on_a_tuple, Symbolic, by_number(c(), 7), at [2.0], 0.0 => [14.0]);

#[constraint]
fn guarded(a: Coord) -> f64 {
    match a {
        x if x < -1.0 => -x,
        x if x > 1.0 => x,
        x => x * x,
    }
}
reads!(match_with_guards, Symbolic, guarded(c()), at [-3.0], 0.0 => [3.0]);

#[constraint]
fn assigned_in_branches(b: Planar, flag: bool) -> Vec2 {
    let mut v = b.r;
    let scale;
    if flag && b.theta > 0.0 {
        v.x += b.theta;
        scale = 2.0;
    } else if b.theta < -1.0 {
        v = -v;
        scale = 1.0;
    } else {
        scale = b.theta;
    }
    v * scale
}
reads!(if_as_a_statement, Symbolic, assigned_in_branches(p(), true), at [1.0, 2.0, 0.5], 0.0 => [3.0, 4.0]);

#[constraint]
fn chosen_weight(b: Planar, n: usize, w: [f64; 3]) -> f64 {
    let w = w[n] + w[n.min(1)];
    if !(b.r.x > 0.0) || b.r.y >= 1.0 { w * b.r.x } else { b.r.y - w }
}
reads!(a_parameter_as_index, Symbolic, chosen_weight(p(), 2, [1.0, 2.0, 3.0]), at [-1.0, 0.0, 0.0], 0.0 => [-5.0]);

#[constraint]
fn unrolled(b: Planar) -> f64 {
    let mut sum = 0.0;
    for i in (0..3).rev() {
        for k in 1..=2 {
            sum += b.point(vec2(i as f64, k as f64)).norm_squared() / (i + 2 * k) as f64;
        }
    }
    for (k, x) in [b.r.x, b.r.y].iter().enumerate() {
        sum -= k as f64 * x;
    }
    sum
}
reads!(nested_loops_over_ranges, Symbolic, unrolled(p()), at [0.0, 0.0, 0.0], 0.0
    => [1.0 / 2.0 + 4.0 / 4.0 + 2.0 / 3.0 + 5.0 / 5.0 + 5.0 / 4.0 + 8.0 / 6.0]);

#[constraint]
fn inside(a: Coord, b: Coord) -> [f64; 2] {
    const HALF: f64 = 0.5;
    fn square(x: f64) -> f64 {
        x * x
    }
    let blend = |u: f64, v: f64| HALF * u + v;
    [square(a) + b, blend(b, square(a))]
}
reads!(functions_constants_and_closures_inside, Symbolic, inside(c(), c()), at [3.0, 4.0], 0.0 => [13.0, 11.0]);

#[constraint]
fn imported_inside(a: Coord) -> f64 {
    use std::f64::consts::FRAC_PI_2;
    a.sin() * FRAC_PI_2 - std::f64::consts::PI * a
}
reads!(imports_inside, Symbolic, imported_inside(c()), at [0.0], 0.0 => [0.0]);

#[constraint]
fn folded(q: [Coord; 3]) -> f64 {
    let horner = q.iter().rev().fold(0.0, |sum, x| sum * 0.5 + x);
    let squares = q.map(|x| x * x);
    horner + squares[2] + squares.iter().skip(1).take(1).sum::<f64>()
}
reads!(iterators_over_coordinates, Symbolic, folded([c(), c(), c()]), at [1.0, 2.0, 4.0], 0.0 => [3.0 + 16.0 + 4.0]);

#[constraint]
fn kinked(a: Coord, b: Coord) -> f64 {
    let dead_band = if a.abs() < 0.1 { 0.0 } else { a - 0.1 * a.signum() };
    dead_band * b + a.max(b).min(2.0) + (a - b).abs() + a.fract() * 0.0 + b
}
reads!(kinks, Symbolic, kinked(c(), c()), at [1.1, 1.0], 0.0 => [1.0 + 1.1 + 0.1 + 1.0]);

#[constraint]
fn safe_quotient(a: Coord) -> f64 {
    if a != 0.0 { a.sin() / a } else { 1.0 }
}
reads!(the_branch_not_taken_may_be_undefined, Symbolic, safe_quotient(c()), at [0.0], 0.0 => [1.0]);

#[constraint]
fn early(a: Coord) -> f64 {
    if a > 0.0 {
        return a.sin();
    }
    a.cos()
}
reads!(an_early_return_in_a_branch, Symbolic, early(c()), at [0.0], 0.0 => [1.0]);

#[constraint]
fn iterated(a: Coord) -> f64 {
    let mut x = a;
    let mut n = 0;
    while n < 5 {
        x = x - (x.sin() - a) / 2.0;
        n += 1;
    }
    x
}
reads!(a_while_over_known_integers, Symbolic, iterated(c()), at [0.0], 0.0 => [0.0]);

#[constraint]
fn counted(a: Coord, n: usize) -> f64 {
    let mut sum = 0.0;
    for k in 0..n {
        sum += a * (k as f64);
    }
    sum.sin()
}
reads!(a_loop_bound_by_a_parameter_is_dual, Dual, counted(c(), 3), at [0.5], 0.0 => [1.5_f64.sin()]);

#[constraint]
fn looked_for(a: Coord, steps: Vec<f64>) -> f64 {
    let mut k = 0;
    let mut y = a;
    loop {
        if k >= steps.len() {
            break;
        }
        y = y * y + steps[k];
        k += 1;
    }
    y
}
reads!(a_loop_with_break_is_dual, Dual, looked_for(c(), vec![1.0, 2.0]), at [1.0], 0.0 => [6.0]);

#[constraint(dual)]
fn asked_for(i: Planar, j: Planar, u: Vec2) -> Vec2 {
    i.point(u) - j.r
}
reads!(dual_numbers_when_asked_for, Dual, asked_for(p(), p(), vec2(1.0, 0.0)), at [0.0, 0.0, 0.0, 1.0, 1.0, 0.0], 0.0 => [0.0, -1.0]);
