//! The check of a step, on x² + x + y = t, x + y = 0: det C_q is 2 x, and so is the smaller pivot
//! beside entries of 1; of a miss v Newton and Kantorovich estimate v/x.

mod around;

use super::{Check, Objection, REACH};
use crate::numbers::padded::Padded;
use crate::solve::newton::{Newton, Steps};
use crate::solve::options::SolverOptions;
use crate::{Law, Mechanism, System, constraint};

#[constraint]
fn square(x: Coord, y: Coord, t: Time) -> [f64; 2] {
    [x * x + x + y - t, x + y]
}

fn system() -> System {
    let mut m = Mechanism::new("square");
    let x = m.length("x", 1.0).expect("a new name");
    let y = m.length("y", -1.0).expect("a new name");
    m.add("c", square(x, y)).expect("adds");
    m.build().expect("builds")
}

/// At x, without rates.
fn stand(newton: &mut Newton<'_>, x: f64) {
    (newton.q[0], newton.q[1]) = (x, -x);
    newton.solve(x * x, Steps::Full).expect("solves");
    newton.qd.iter_mut().chain(newton.qdd.iter_mut()).for_each(|rate| *rate = 0.0);
}

/// True if a step to `to` after one was accepted at `before` counts as missed, where the prediction
/// misses by so much.
fn is_missed(before: f64, to: f64, miss: f64) -> bool {
    let system = system();
    let options = SolverOptions::default();
    let mut newton = Newton::new(&system, &options);
    let mut check = Check::new(&system);
    stand(&mut newton, 1.0);
    stand(&mut newton, before);
    check.accept(&newton);
    stand(&mut newton, to);
    let still = Padded::new(2, 0.0);
    let mut from = Padded::new(2, 0.0);
    (from[0], from[1]) = (to - miss, miss - to);
    matches!(check.judge(&mut newton, 1.0, [&from, &still, &still]), Err(Objection::Missed(_)))
}

#[test]
fn a_miss_is_held_against_the_smaller_pivot() {
    assert!(!is_missed(1.0, 1.0, 0.04));
    for (before, to) in [(1.0, 0.01), (0.01, 0.01)] {
        assert!(is_missed(before, to, 0.004), "{before} {to}");
        assert!(!is_missed(before, to, 1e-4));
    }
}

#[test]
fn a_larger_miss_is_safe_while_second_order_terms_are_small() {
    for to in [1.0, 0.5] {
        assert!(!is_missed(1.0, to, 0.2 * to), "{to}");
        for share in [0.3, 0.6, 1.5] {
            assert!(is_missed(1.0, to, share * to), "{to} {share}");
        }
    }
}

/// k x² + x + y = t, x + y = 0: what a miss is to Newton's method does not depend on k, while
/// pivots come near 1 with it.
#[constraint]
fn steep(x: Coord, y: Coord, t: Time, k: f64) -> [f64; 2] {
    [k * x * x + x + y - t, x + y]
}

/// x y = 2 t, y = t: det C_q is y, and so is a pivot beside entries of 1; along y all equations are
/// straight.
#[constraint]
fn product(x: Coord, z: Coord, y: Coord, t: Time) -> [f64; 3] {
    [x * (1.0 + y) + z - 2.0 * t, x + z, y - t]
}

#[constraint]
fn angle(a: Coord, t: Time) -> f64 {
    a - t
}

/// Newton's method and a check of one system, led from place to place.
struct Led<'a> {
    newton: Newton<'a>,
    check: Check,
}

impl<'a> Led<'a> {
    fn new(system: &'a System, options: &'a SolverOptions) -> Self {
        Led { newton: Newton::new(system, options), check: Check::new(system) }
    }

    fn stand(&mut self, t: f64, q: &[f64]) {
        self.newton.q.iter_mut().zip(q).for_each(|(q, x)| *q = *x);
        self.newton.solve(t, Steps::Full).expect("solves");
        self.newton.qd.iter_mut().chain(self.newton.qdd.iter_mut()).for_each(|rate| *rate = 0.0);
    }

    fn accept(&mut self, t: f64, q: &[f64]) {
        self.stand(t, q);
        self.check.accept(&self.newton);
    }

    /// Judges a step to a place that the prediction misses by so much.
    fn judge(&mut self, t: f64, q: &[f64], miss: &[f64]) -> Result<(), Objection> {
        self.stand(t, q);
        let from: Vec<f64> = self.newton.q.iter().zip(miss).map(|(q, miss)| q - miss).collect();
        let from = Padded::from(&from[..]);
        let still = Padded::new(q.len(), 0.0);
        self.check.judge(&mut self.newton, 0.1, [&from, &still, &still])
    }
}

fn steep_system(k: f64) -> System {
    let mut m = Mechanism::new("steep");
    let [x, y] =
        [("x", 1.0), ("y", -1.0)].map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("c", steep(x, y, k)).expect("adds");
    m.build().expect("builds")
}

fn product_system() -> System {
    let mut m = Mechanism::new("product");
    let [x, z, y] = [("x", 2.0), ("z", -2.0), ("y", 1.0)]
        .map(|(name, guess)| m.length(name, guess).expect("a new name"));
    m.add("c", product(x, z, y)).expect("adds");
    m.build().expect("builds")
}

/// The pivot at the other end of the step counts as this one's does, until a position is left open.
#[test]
fn the_pivot_at_the_other_end_counts() {
    let system = steep_system(100.0);
    let options = SolverOptions::default();
    let at = |x: f64| (100.0 * x * x, [x, -x]);
    let missed = |before: f64, open: bool, miss: f64| {
        let mut led = Led::new(&system, &options);
        let (t, q) = at(0.1);
        led.stand(t, &q);
        let (t, q) = at(before);
        led.accept(t, &q);
        if open {
            led.check.leave_open();
        }
        let (t, q) = at(0.1);
        matches!(led.judge(t, &q, &[miss, -miss]), Err(Objection::Missed(_)))
    };
    assert_eq!(
        [missed(0.1, false, 0.04), missed(1e-3, false, 0.04), missed(1e-3, true, 0.04)],
        [false, true, false]
    );
    assert!(!missed(1e-3, false, 0.01));
}

/// A miss that is not a number counts as one, in whichever coordinate or rate it is.
#[test]
fn no_number_is_a_miss() {
    let system = product_system();
    let options = SolverOptions::default();
    for (rate, k) in [(0, 0), (0, 1), (0, 2), (1, 0), (1, 2), (2, 1)] {
        let mut led = Led::new(&system, &options);
        led.accept(1.0, &[2.0, -2.0, 1.0]);
        led.stand(1.0, &[2.0, -2.0, 1.0]);
        let mut from = [led.newton.q.clone(), Padded::new(3, 0.0), Padded::new(3, 0.0)];
        assert_eq!(led.check.judge(&mut led.newton, 0.1, from.each_ref()), Ok(()));
        from[rate][k] = f64::NAN;
        assert!(
            matches!(
                led.check.judge(&mut led.newton, 0.1, from.each_ref()),
                Err(Objection::Missed(_))
            ),
            "{rate} {k}"
        );
    }
}

/// Where equations are straight along a miss a pivot that has faded tells of a singular position
/// within it, wherever it was large.
#[test]
fn a_pivot_that_fades_is_a_warning() {
    let system = product_system();
    let options = SolverOptions::default();
    let near = (0.1, [2.0, -2.0, 0.1]);
    let far = (1.0, [2.0, -2.0, 1.0]);
    let miss = [0.0, 0.0, 0.15];
    let is_missed = |found: Result<(), Objection>| matches!(found, Err(Objection::Missed(_)));
    let led = || Led::new(&system, &options);

    let mut never_larger = led();
    never_larger.accept(near.0, &near.1);
    assert!(!is_missed(never_larger.judge(near.0, &near.1, &miss)));

    let mut accepted = led();
    accepted.accept(far.0, &far.1);
    accepted.accept(near.0, &near.1);
    assert!(
        !is_missed(accepted.judge(near.0, &near.1, &[0.0, 0.0, 0.02]))
            && is_missed(accepted.judge(near.0, &near.1, &miss))
    );

    let mut judged = led();
    judged.accept(near.0, &near.1);
    for (t, q) in [far, near] {
        assert!(!is_missed(judged.judge(t, &q, &[0.0; 3])));
    }
    assert!(is_missed(judged.judge(near.0, &near.1, &miss)));

    // On either side, as soon as the pivot is half of what it is here.
    for (miss, missed) in [
        (0.15, true),
        (-0.15, true),
        (0.07, true),
        (-0.07, true),
        (0.06, true),
        (-0.06, true),
        (0.03, false),
        (-0.03, false),
    ] {
        let mut led = led();
        led.accept(far.0, &far.1);
        led.accept(near.0, &near.1);
        assert_eq!(is_missed(led.judge(near.0, &near.1, &[0.0, 0.0, miss])), missed, "{miss}");
    }
    // The pivot may have faded at the other end.
    let mut faded = led();
    faded.accept(far.0, &far.1);
    faded.accept(near.0, &near.1);
    assert!(is_missed(faded.judge(0.6, &[2.0, -2.0, 0.6], &[0.0, 0.0, 0.7])));
}

/// The larger of both misses counts, whichever end it is seen from, in what bends and in what
/// turns.
#[test]
fn the_larger_miss_counts() {
    let system = steep_system(1.0);
    let options = SolverOptions::default();
    let h = 0.1;
    let x = 0.5;
    let d = 0.01;
    for (back, missed) in [(0.1, false), (0.15, true)] {
        let mut led = Led::new(&system, &options);
        led.accept(x * x, &[x, -x]);
        led.stand(x * x, &[x, -x]);
        (led.newton.qd[0], led.newton.qd[1]) = ((d - back) / h, (back - d) / h);
        let from = Padded::from(&[x - d, d - x][..]);
        let still = Padded::new(2, 0.0);
        let found = led.check.judge(&mut led.newton, h, [&from, &still, &still]);
        assert_eq!(matches!(found, Err(Objection::Missed(_))), missed, "{back}: {found:?}");
    }
    let mut m = Mechanism::new("angle");
    let a = m.angle("a", 0.0).expect("a new name");
    m.add("c", angle(a)).expect("adds");
    let system = m.build().expect("builds");
    for (back, missed) in [(0.9, false), (1.1, true)] {
        let mut led = Led::new(&system, &options);
        led.accept(0.0, &[0.0]);
        led.stand(0.0, &[0.0]);
        led.newton.qd[0] = back / h;
        let (from, rate, still) =
            (Padded::from(&[0.0][..]), Padded::from(&[0.05 / h][..]), Padded::new(1, 0.0));
        let found = led.check.judge(&mut led.newton, h, [&from, &rate, &still]);
        assert_eq!(matches!(found, Err(Objection::Missed(_))), missed, "{back}: {found:?}");
    }
}

#[constraint]
fn led_square(x: Coord, y: Coord, law: Law, t: Time) -> [f64; 2] {
    [x * x + x + y - law.at(t), x + y]
}

#[constraint]
fn led_angle(a: Coord, law: Law, t: Time) -> f64 {
    a - law.at(t)
}

/// A motor that goes out and comes back within a step is seen where equations are not straight that
/// far, or a body turns too far meanwhile.
#[test]
fn out_and_back_within_a_step() {
    let options = SolverOptions::default();
    let hill = |f0: f64, height: f64| Law::polynomial(&[f0, 4.0 * height, -4.0 * height]);
    let judge = |system: &System, q: &[f64]| {
        let mut led = Led::new(system, &options);
        led.accept(0.0, q);
        led.stand(1.0, q);
        let from = Padded::from(q);
        let still = Padded::new(q.len(), 0.0);
        led.check.judge(&mut led.newton, 1.0, [&from, &still, &still])
    };
    for (height, found) in [
        (0.01, Ok(())),
        (0.2, Ok(())),
        (0.9, Err(Objection::Hidden)),
        (-0.9, Err(Objection::Hidden)),
    ] {
        let mut m = Mechanism::new("square");
        let [x, y] = [("x", 1.0), ("y", -1.0)]
            .map(|(name, guess)| m.length(name, guess).expect("a new name"));
        m.add("c", led_square(x, y, hill(1.0, height))).expect("adds");
        assert_eq!(judge(&m.build().expect("builds"), &[1.0, -1.0]), found, "{height}");
    }
    for (height, found) in [(0.01, Ok(())), (0.4, Ok(())), (2.5, Err(Objection::Hidden))] {
        let mut m = Mechanism::new("angle");
        let a = m.angle("a", 0.0).expect("a new name");
        m.add("c", led_angle(a, hill(0.0, height))).expect("adds");
        // The angle alone is given by its row; beside equations that are not straight it is looked
        // at.
        let [x, y] = [("x", 1.0), ("y", -1.0)]
            .map(|(name, guess)| m.length(name, guess).expect("a new name"));
        m.add("square", led_square(x, y, hill(1.0, 0.0))).expect("adds");
        assert_eq!(judge(&m.build().expect("builds"), &[0.0, 1.0, -1.0]), found, "{height}");
    }
}

/// A block that has turned over is seen however near both positions are, after one that was left
/// open too.
#[test]
fn a_block_that_turns_over() {
    let system = steep_system(1.0);
    let options = SolverOptions::default();
    let at = |led: &mut Led<'_>, x: f64| led.judge(x * x, &[x, -x], &[0.0; 2]);
    let mut led = Led::new(&system, &options);
    led.check.leave_open();
    assert_ne!(at(&mut led, 0.5), Err(Objection::TurnedOver));
    assert_eq!(at(&mut led, -0.5), Err(Objection::TurnedOver));
    led.check.leave_open();
    assert_ne!(at(&mut led, -0.5), Err(Objection::TurnedOver));
    assert_eq!(at(&mut led, 0.5), Err(Objection::TurnedOver));
}

/// The prediction is that of second degree: what rates explain is no miss.
#[test]
fn rates_are_no_miss() {
    let system = steep_system(1.0);
    let options = SolverOptions::default();
    for (share, missed) in [(0.2, false), (0.3, true), (-0.2, false), (-0.3, true)] {
        let h = 0.5;
        let x = 0.5;
        let miss = 0.5 * share;
        let mut led = Led::new(&system, &options);
        led.accept(x * x, &[x, -x]);
        led.stand(x * x, &[x, -x]);
        let qd = [0.0, 3.0];
        let qdd = [0.0, -7.0];
        for k in 0..2 {
            (led.newton.qd[k], led.newton.qdd[k]) = (qd[k] + h * qdd[k], qdd[k]);
        }
        let from = [x - miss, -x + miss - h * (3.0 - 0.5 * h * 7.0)];
        let end = [Padded::from(&from[..]), Padded::from(&qd[..]), Padded::from(&qdd[..])];
        let found = led.check.judge(&mut led.newton, h, [&end[0], &end[1], &end[2]]);
        assert_eq!(matches!(found, Err(Objection::Missed(_))), missed, "{share}: {found:?}");
    }
}

#[test]
fn no_body_turns_too_far_in_one_step() {
    let mut m = Mechanism::new("angle");
    let a = m.angle("a", 0.0).expect("a new name");
    m.add("c", angle(a)).expect("adds");
    let system = m.build().expect("builds");
    let options = SolverOptions::default();
    let step = |by: f64| {
        let mut led = Led::new(&system, &options);
        led.accept(0.0, &[0.0]);
        led.stand(by, &[by]);
        led.newton.qd[0] = by / 0.1;
        let start = Padded::from(&[0.0][..]);
        let rate = Padded::from(&[by / 0.1][..]);
        let still = Padded::new(1, 0.0);
        led.check.judge(&mut led.newton, 0.1, [&start, &rate, &still])
    };
    assert_eq!([step(0.95 * REACH), step(-0.95 * REACH)], [Ok(()); 2]);
    assert_eq!([step(1.05 * REACH), step(-1.05 * REACH)], [Err(Objection::Long); 2]);
}

#[test]
fn each_objection_has_its_reason() {
    let all = [Objection::Long, Objection::Missed(0.1), Objection::TurnedOver, Objection::Hidden]
        .map(|objection| objection.reason().to_string());
    assert!((0..4).all(|k| !all[k].is_empty() && !all[..k].contains(&all[k])), "{all:?}");
}

/// A step that is accepted leaves the pivot at its end for the next one, be it larger or smaller
/// than before.
#[test]
fn a_step_hands_its_pivot_on() {
    let system = steep_system(100.0);
    let options = SolverOptions::default();
    let at = |x: f64| (100.0 * x * x, [x, -x]);
    let missed = |first: f64, second: f64| {
        let mut led = Led::new(&system, &options);
        let mut to = |x: f64, miss: f64| {
            let (t, q) = at(x);
            led.judge(t, &q, &[miss, -miss])
        };
        assert_eq!((to(0.1, 0.0), to(first, 0.0), to(second, 0.0)), (Ok(()), Ok(()), Ok(())));
        matches!(to(0.1, 0.04), Err(Objection::Missed(_)))
    };
    assert_eq!((missed(0.1, 0.1), missed(1e-3, 0.1), missed(0.1, 1e-3)), (false, false, true));
}
