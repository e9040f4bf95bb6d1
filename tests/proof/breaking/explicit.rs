//! z = g(x) with x driven along a line: steps, remainders, selections, angles over their cut, at a
//! distance from their jumps, over them, and at them.

use super::{Case, lengths, moved};
use crate::wide::{Wide, w};
use kin::prelude::*;

type Adds = fn(&mut Mechanism, Coordinate, Coordinate, f64) -> kin::Result<()>;
type Function = fn(&Wide, &Wide) -> Wide;

/// Each g as a constraint, and in 77 digits.
macro_rules! explicit {
    (mod $module:ident; $($name:ident |$x:ident, $k:ident| $f:block $wide:block)*) => {
        mod $module {
            use super::*;

            $(#[constraint]
            fn $name($x: Coord, z: Coord, $k: f64) -> f64 {
                z - $f
            })*

            mod in_wide {
                use super::*;
                $(#[allow(clippy::all)]
                pub fn $name($x: &Wide, $k: &Wide) -> Wide $wide)*
            }

            pub fn all() -> Vec<(&'static str, Adds, Function)> {
                vec![$((stringify!($name), (|m, x, z, k| m.add("z", $name(x, z, k)).map(|_| ())) as Adds, in_wide::$name as Function)),*]
            }
        }
    };
}

explicit! {
    mod jumping;
    floor |x, k| { (x * k).floor() } { (x * k).floor() }
    ceil |x, k| { (x * k).ceil() } { (x * k).ceil() }
    round |x, k| { (x * k).round() } { (x * k).round() }
    trunc |x, k| { (x * k).trunc() } { (x * k).trunc() }
    fract |x, k| { (x * k).fract() } { (x * k).fract() }
    signum |x, k| { (x - k).signum() } { (x - k).signum() }
    remainder |x, k| { x % k } { x.rem(k) }
    remainder_of_square |x, k| { (x * x) % k } { (x * x).rem(k) }
    euclidean |x, k| { x.rem_euclid(k) } { x.rem_euclid(k) }
    quotient |x, k| { x.div_euclid(k) } { x.div_euclid(k) }
    selected |x, k| { if x >= k { 1.0 } else { 0.0 } } { w(if x >= k { 1.0 } else { 0.0 }) }
    shifted |x, k| { if x > k { x - 0.25 } else { x } } { if x > k { x - 0.25 } else { x.clone() } }
    between |x, k| { if x > k && x < k + 1.0 { x } else { x - 0.5 } } { if x > k && *x < k + 1.0 { x.clone() } else { x - 0.5 } }
    outside |x, k| { if !(x < k) || x < k - 1.0 { 2.0 * x } else { x } } { if x >= k || *x < k - 1.0 { 2.0 * x } else { x.clone() } }
    equal |x, k| { if x == k { 1.0 } else { 0.0 } } { w(if x == k { 1.0 } else { 0.0 }) }
    staircase |x, k| { x + (x * k).floor() * 1e-3 } { x + (x * k).floor() * crate::wide::dec("1e-3") }
    small_step |x, k| { x + (x - k).signum() * 1e-9 } { x + (x - k).signum() * crate::wide::dec("1e-9") }
    nested |x, k| { (x.sin() * k).floor() + x } { (x.sin() * k).floor() + x }
    wave_of_step |x, k| { (x * k).floor().cos() * x } { (x * k).floor().cos() * x }
    angle |x, k| { (x - k).atan2(-1.0) } { (x - k).atan2(&w(-1.0)) }
    half_angle |x, k| { 0.5 * (x - k).atan2(-1.0) } { 0.5 * (x - k).atan2(&w(-1.0)) }
    sine_of_half |x, k| { (0.5 * (x - k).atan2(-1.0)).sin() } { (0.5 * (x - k).atan2(&w(-1.0))).sin() }
    angle_squared |x, k| { (x - k).atan2(-1.0).powi(2) } { let a = (x - k).atan2(&w(-1.0)); &a * &a }
    two_angles |x, k| { (x - k).atan2(-1.0) + (k - x).atan2(-2.0) } { (x - k).atan2(&w(-1.0)) + (k - x).atan2(&w(-2.0)) }
    remainder_of_angle |x, k| { (x - k).atan2(-1.0) % 6.0 } { (x - k).atan2(&w(-1.0)).rem(&w(6.0)) }
    chosen_by_angle |x, k| { if (x - k).atan2(-1.0) > 0.0 { 1.0 } else { 2.0 } } { w(if (x - k).atan2(&w(-1.0)) > 0.0 { 1.0 } else { 2.0 }) }
}

// continuous all along, or jumping elsewhere
explicit! {
    mod continuous;
    size |x, k| { (x - k).abs() } { (x - k).abs() }
    larger |x, k| { (2.0 * x).max(x + k) } { (2.0 * x).max(&(x + k)) }
    smaller |x, k| { (2.0 * x).min(x + k) } { (2.0 * x).min(&(x + k)) }
    clamped |x, k| { x.clamp(k - 0.1, k + 0.1) } { let tenth = crate::wide::dec("0.1"); x.max(&(k - &tenth)).min(&(k + &tenth)) }
    sine_of_angle |x, k| { (x - k).atan2(-1.0).sin() } { (x - k).atan2(&w(-1.0)).sin() }
    cosine_of_twice |x, k| { (2.0 * (x - k).atan2(-1.0)).cos() } { (2.0 * (x - k).atan2(&w(-1.0))).cos() }
    difference_of_angles |x, k| { ((x - k).atan2(-1.0) - 3.0 * (x - k).atan2(-2.0)).cos() } { ((x - k).atan2(&w(-1.0)) - 3.0 * (x - k).atan2(&w(-2.0))).cos() }
    step_far_away |x, k| { x + (x - k + 50.5).floor() } { x + (x - k + 50.5).floor() }
    branch_far_away |x, k| { if x > k - 50.0 { x * x } else { -x } } { if *x > k - 50.0 { x * x } else { -x } }
    remainder_far_away |x, k| { (x - k + 5.0) % 10.0 } { (x - k + 5.0).rem(&w(10.0)) }
}

/// x from a to b within a second, in some steps.
fn case(
    name: &str,
    add: Adds,
    f: Function,
    [a, b, k]: [f64; 3],
    steps: usize,
    honest: bool,
) -> Option<Case> {
    let at = f(&w(a), &w(k)).show().parse::<f64>().unwrap_or(0.0);
    let system = lengths([a, at], |m, [x, z]| {
        m.add("x", drive(x, Law::linear(a, b - a)))?;
        add(m, x, z, k)
    });
    let motion = moved(&system, &linspace(0.0, 1.0, steps + 1))?;
    let solutions = move |t: &Wide| {
        let x = w(a) + w(b - a) * t;
        let z = f(&x, &w(k));
        vec![(0, vec![x, z])]
    };
    let name = format!("{name}, k = {k}, x from {a} to {b} in {steps}");
    Some(Case { name, honest, system, motion, solutions: Box::new(solutions) })
}

pub fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for (name, add, f) in jumping::all() {
        // over a jump, at one, a hair before one, far from zero
        let ranges = [
            ([0.7, 1.3, 1.0], 1),
            ([0.7, 1.3, 1.0], 7),
            ([1.0, 1.4, 1.0], 2),
            ([1.0 - 1e-9, 1.0 - 1e-13, 1.0], 1),
            ([2.9, 3.2, 0.3], 4),
        ];
        all.extend(
            ranges.into_iter().filter_map(|(range, steps)| case(name, add, f, range, steps, false)),
        );
        // clear of them
        let clear =
            if matches!(name, "nested" | "round") { [0.1, 0.3, 1.0] } else { [0.55, 0.95, 1.0] };
        all.extend(case(name, add, f, clear, 3, true));
    }
    for (name, add, f) in continuous::all() {
        let ranges = [([0.7, 1.3, 1.0], 4), ([1.0, 1.4, 1.0], 2), ([2.9, 3.2, 3.0], 9)];
        all.extend(
            ranges.into_iter().filter_map(|(range, steps)| case(name, add, f, range, steps, true)),
        );
    }
    all
}
