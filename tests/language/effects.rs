//! Side effects on the right of `&&` and `||` happen only where that side is asked; integers do
//! what rustc makes of them.

use kin::check::any_coord as c;
use kin::prelude::*;

use crate::reads;

#[constraint]
fn counted(x: Coord, y: Coord) -> f64 {
    let mut n = 0.0;
    let both = x > 0.0 && {
        n += 1.0;
        y > 0.0
    };
    x + y + 10.0 * n + if both { 100.0 } else { 0.0 }
}
reads!(an_effect_on_the_right_of_and_that_is_not_asked, Symbolic, counted(c(), c()), at [-1.0, 2.0], 0.0 => [1.0]);
reads!(an_effect_on_the_right_of_and_that_is_asked, Symbolic, counted(c(), c()), at [1.0, -2.0], 0.0 => [9.0]);
reads!(both_sides_of_and_hold, Symbolic, counted(c(), c()), at [1.0, 2.0], 0.0 => [113.0]);

#[constraint]
fn either(x: Coord, y: Coord) -> f64 {
    let mut scale = 1.0;
    if x > 0.0 || {
        scale = x * x;
        y > 0.0
    } {
        scale * y
    } else {
        scale * x
    }
}
reads!(an_effect_on_the_right_of_or_that_is_not_asked, Symbolic, either(c(), c()), at [2.0, 3.0], 0.0 => [3.0]);
reads!(an_effect_on_the_right_of_or_that_is_asked, Symbolic, either(c(), c()), at [-2.0, 3.0], 0.0 => [12.0]);
reads!(an_effect_on_the_right_of_or_that_does_not_hold, Symbolic, either(c(), c()), at [-2.0, -3.0], 0.0 => [-8.0]);

/// Chains, conditions known beforehand, and effects inside of effects.
#[constraint]
fn chained(x: Coord, y: Coord, on: bool) -> f64 {
    let mut a = 0.0;
    let mut b = 0.0;
    let never = false;
    let known = never && {
        a += 1000.0;
        true
    };
    let all =
        on && {
            a += 1.0;
            x > 0.0
        } && {
            b += x;
            y > 0.0 || {
                b += y;
                x > y
            }
        };
    x * y + a + 10.0 * b + if all && !known { 100.0 } else { 0.0 }
}
reads!(effects_in_a_chain_up_to_the_first_that_fails, Symbolic, chained(c(), c(), true), at [-2.0, 3.0], 0.0 => [-5.0]);
reads!(effects_in_a_chain_to_its_end, Symbolic, chained(c(), c(), true), at [2.0, -3.0], 0.0 => [85.0]);
reads!(effects_in_a_chain_that_is_not_begun, Symbolic, chained(c(), c(), false), at [2.0, 3.0], 0.0 => [6.0]);

#[constraint]
fn whole_numbers(x: Coord) -> f64 {
    let signed: i32 = 2;
    let below = signed - 5;
    let mut sum = 0;
    for k in -2..=2 {
        sum += k * k;
    }
    let small = 200u8 - 100u8;
    x * below as f64
        + sum as f64
        + small as f64
        + (7_i64.pow(20) % 10) as f64
        + ((1_u64 << 40) % 1000) as f64
}
reads!(integers_of_known_types_are_read, Symbolic, whole_numbers(c()), at [2.0], 0.0 => [-6.0 + 10.0 + 100.0 + 1.0 + 776.0]);

/// 12! is an i32.
#[constraint]
fn twelve(x: Coord) -> f64 {
    let mut f = 1;
    for k in 1..13 {
        f *= k;
    }
    x - f as f64
}
reads!(the_last_factorial_of_an_i32, Symbolic, twelve(c()), at [0.5], 0.0 => [0.5 - 479_001_600.0]);

/// 13! is none: rustc's reading panics, and so does this one, on dual numbers.
#[constraint]
pub fn thirteen(x: Coord) -> f64 {
    let mut f = 1;
    for k in 1..14 {
        f *= k;
    }
    x - f as f64
}

/// The index is below zero for a moment.
#[constraint]
pub fn below_zero(x: Coord, c: [f64; 3]) -> f64 {
    let mut sum = x;
    for k in 0..3 {
        sum += c[k - 1 + 1];
    }
    sum
}

#[test]
fn integers_that_overflow_are_left_to_rustc() {
    assert_eq!(kin::Constraint::facts(&thirteen(c())).route(), Route::Dual);
    assert_eq!(kin::Constraint::facts(&below_zero(c(), [1.0; 3])).route(), Route::Dual);
    let panics = |constraint: &dyn kin::Constraint| {
        let run = || kin::extend::terms(constraint, &[0.5], &[0.0], 0.0).c[0];
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).is_err()
    };
    if cfg!(debug_assertions) {
        assert!(panics(&thirteen(c())), "13! overflows an i32");
        assert!(panics(&below_zero(c(), [1.0; 3])), "0 - 1 of an index overflows");
    }
}
