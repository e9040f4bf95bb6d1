//! Long branches: of each choice only the one that is taken is computed, and nothing else changes.

use std::cell::Cell;

use kin::emitted::{At, Offsets};
use kin::prelude::*;

use crate::twice;

twice! { Symbolic spline_of_twenty_pieces(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    let knots: [f64; 21] = std::array::from_fn(|k| k as f64 / 5.0 - 2.0);
    let piece = |k: usize| {
        let s = x - knots[k];
        let [a, b, c, d] = [0.1 * k as f64, 0.7 - 0.1 * k as f64, 0.3, 0.05 * k as f64];
        a + s * (b + s * (c + s * d))
    };
    for k in 0..19 {
        if x < knots[k + 1] {
            return y - piece(k);
        }
    }
    y - piece(19)
} }

twice! { Symbolic pieces_that_the_last_one_wins(coord time (1.5)): fn f(x: Coord, t: Time, r: f64) -> f64 {
    let mut value = x * x;
    for (k, begin) in [-1.0, -0.4, 0.3, 1.1].into_iter().enumerate() {
        if x >= begin {
            let s = (x - begin) * (k as f64 + r);
            value = s.sin() * s.exp() + (s + t).cos() * s.cosh() + k as f64;
        }
    }
    value - t
} }

// Sine and cosine of one angle where a branch needs one of them and the code behind it the other.
twice! { Symbolic half_a_pair_in_a_branch(coord coord): fn f(x: Coord, y: Coord) -> (f64, f64) {
    let a = 2.0 * x + y;
    let u = if y < 0.3 { a.sin() * (x * y).exp() + (x - y).sinh() } else { x * y };
    let v = if x < 0.1 { a.cos() * (x * y).exp() - (x + y).cosh() } else { a.cos() + y };
    (u + a.cos(), v * a.sin())
} }

twice! { Symbolic branches_in_branches(planar coord (0.4)): fn f(i: Planar, s: Coord, r: f64) -> [f64; 3] {
    let p = i.point(vec2(0.3, r));
    let (nose, height) = if s < -0.5 {
        let d = p.x.exp() * s.sin() + p.y;
        (d, d * d.cos())
    } else if s < 0.8 {
        let e = (p.x * p.y).tanh() + s.powi(3);
        if e > 0.2 { (e.sin() * p.x, e.cosh() * s) } else { (e * e.exp() + p.y.sin(), e - (s * p.x).cos()) }
    } else {
        (s.ln() * p.x.atan(), (s + p.y).sinh())
    };
    [nose - height * s, height * i.theta, nose * nose + p.x]
} }

// Values of one choice that another one needs, and the other way round.
twice! { Symbolic choices_that_need_each_other(coord coord): fn f(x: Coord, y: Coord) -> [f64; 2] {
    let first = x < 0.2;
    let second = y < -0.1;
    let a = if first { (x * y).sin() + x.exp() * y } else { x.cosh() };
    let b = if second { (a * y).sin() + a.exp() } else { (a + x).cos() * y.exp() };
    let c = if second { (x * x).sin() + x.exp() * y } else { y.cosh() * x };
    let d = if first { (c * y).atan() + c.cos() * x.sinh() } else { c.tanh() - y };
    [a + b * d, c - b]
} }

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

/// A function that notes its calls.
fn counted<D: Dual>(x: Real<D>) -> Real<D> {
    CALLS.with(|calls| calls.set(calls.get() + 1));
    x * x + 1.0
}

#[constraint(symbolic)]
pub fn with_a_call_in_one_branch(x: Coord, y: Coord) -> f64 {
    if x < 1.0 { counted(x + y) * x.sin() } else { x * y.exp() - x.sinh() }
}

#[test]
fn what_a_branch_calls_is_not_called_where_the_other_one_is_taken() {
    let constraint = with_a_call_in_one_branch(kin::check::any_coord(), kin::check::any_coord());
    let calls = |x: f64| {
        CALLS.with(|calls| calls.set(0));
        let states = [x, x.sin(), x.cos(), 0.5, 0.5_f64.sin(), 0.5_f64.cos()];
        let begins = [Offsets::new(0, 0), Offsets::new(3, 1)];
        let at = At::new(0.0, &states, &begins);
        let mut c = [0.0];
        let mut c_q = [0.0; 2];
        constraint.linearize(&at, &mut c, &mut c_q);
        assert!(c[0].is_finite() && c_q.iter().all(|x| x.is_finite()));
        CALLS.with(Cell::get)
    };
    assert!(calls(0.5) > 0);
    assert_eq!(calls(1.5), 0);
}
