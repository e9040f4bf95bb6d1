//! Questions at the present position: is C_q singular near it, which drives move it, what is the
//! outlook of a sweep?

use super::super::{Factored, Lever, is_singular_near};
use super::{Led, steep_system};
use crate::numbers::padded::Padded;
use crate::solve::options::SolverOptions;
use crate::{Mechanism, constraint};

/// √x + y = 1 + t, y = 0: nothing below x = 0.
#[constraint]
fn above_zero(x: Coord, y: Coord, t: Time) -> [f64; 2] {
    [x.sqrt() + y - 1.0 - t, y]
}

/// Where there is no matrix it counts as singular; what was measured on the way is forgotten, and
/// the position in hand is as it was.
#[test]
fn a_look_around_leaves_nothing_behind() {
    let options = SolverOptions::default();
    let mut m = Mechanism::new("above zero");
    let [x, y] =
        [("x", 1.0), ("y", 0.0)].map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("c", above_zero(x, y)).expect("adds");
    let system = m.build().expect("builds");
    let mut led = Led::new(&system, &options);
    led.accept(0.0, &[1.0, 0.0]);
    let signs = led.check.negative.clone();
    for (v, is_singular) in [(0.2, false), (2.0, true), (-2.0, true)] {
        assert_eq!(is_singular_near(&mut led.newton, &[v, 0.0], 1.0, &signs), is_singular, "{v}");
        assert_eq!((led.newton.q[0], led.newton.q[1]), (1.0, 0.0));
    }
    // Far away rows are a thousand times as large; that says nothing of here.
    let system = steep_system(1.0);
    let mut led = Led::new(&system, &options);
    led.accept(1.0, &[1.0, -1.0]);
    let signs = led.check.negative.clone();
    let norms = led.newton.linear.norms().to_vec();
    is_singular_near(&mut led.newton, &[1e3, 0.0], 1.0, &signs);
    assert_eq!(led.newton.linear.norms(), norms);
}

/// The right side of a lever is zero but for the rows that are asked for, whatever it was before.
#[test]
fn a_lever_moves_its_own_rows_alone() {
    let system = steep_system(1.0);
    let options = SolverOptions::default();
    let mut led = Led::new(&system, &options);
    led.accept(1.0, &[1.0, -1.0]);
    let mut v = led.newton.q.clone();
    led.newton.linear.rhs_mut().fill(7.0);
    let mut lever = Factored {
        newton: &mut led.newton,
        v: &mut v,
        turns: &Padded::default(),
        negative: &[],
        fades: 1.0,
    };
    // C_q = [3 1; 1 1]
    for (first, b, exact) in [
        (0, &[1.0][..], [0.5, -0.5]),
        (1, &[1.0], [-0.5, 1.5]),
        (0, &[2.0, 4.0], [-1.0, 5.0]),
        (1, &[1.0], [-0.5, 1.5]),
    ] {
        Lever::moved(&mut lever, first, b);
        assert!(
            (0..2).all(|k| (lever.v[k] - exact[k]).abs() < 1e-14),
            "{first} {b:?}: {:?}",
            [lever.v[0], lever.v[1]]
        );
    }
}
