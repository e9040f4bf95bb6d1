//! Motions that drives may hide between the ends of a step, with a lever that is known.

mod sampled;

use super::*;
use crate::joints::drivers::drive;
use crate::law::LawFunction;
use crate::{Law, Mechanism, System, constraint};

fn bound(c: &[[f64; 2]], len: usize) -> Option<[f64; COEFFICIENTS]> {
    let c: Vec<Interval> = c.iter().map(|[lo, hi]| Interval::new(*lo, *hi)).collect();
    Bound::of(&Series::of(&c, len)).map(|bound| bound.0)
}

/// A smooth signal is off by its third derivative; one of which less is known by how much its last
/// derivative may jump. One that may turn round leaves what is between its ends besides.
#[test]
fn how_far_a_signal_may_be_off() {
    let near = |found: Option<[f64; 4]>, exact: [f64; 4]| {
        let found = found.expect("is known");
        assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {exact:?}");
    };
    let c = |slope: [f64; 2]| [[1.0, 2.0], slope, [-3.0, 2.0], [-0.5, 4.0]];
    near(bound(&c([0.5, 1.0]), 4), [0.0, 0.0, 0.0, 4.0]);
    near(bound(&c([-0.5, 1.0]), 4), [0.0, 0.0, 0.75, 4.0]);
    near(bound(&c([0.5, 1.0]), 7), [0.0, 0.0, 0.0, 4.0]);
    near(bound(&c([0.5, 1.0]), 3), [0.0, 0.0, 5.0, 0.0]);
    near(bound(&c([-0.5, 1.0]), 3), [0.0, 0.0, 5.75, 0.0]);
    near(bound(&c([0.5, 1.0]), 2), [0.0, 0.5, 0.0, 0.0]);
    near(bound(&c([-0.5, 1.0]), 2), [0.0, 2.0, 0.0, 0.0]);
    near(bound(&c([-2.0, 1.0]), 2), [0.0, 4.0, 0.0, 0.0]);
    near(bound(&c([0.5, 1.0]), 1), [1.0, 0.0, 0.0, 0.0]);
    near(bound(&[[3.0, 3.0]], 7), [0.0; 4]);
    assert_eq!(
        (bound(&c([0.5, 1.0]), 0), bound(&[[0.0, 0.0], [0.0, f64::INFINITY]], 2)),
        (None, None)
    );
}

#[test]
fn bounds_of_several_signals() {
    let mut sum = Bound([1.0, 2.0, 0.0, 4.0]);
    assert_eq!((sum.at(0.5), sum.at(0.0)), (2.5, 1.0));
    sum.add(3.0, &Bound([0.5, 0.0, 2.0, 1.0]));
    assert_eq!((sum, sum.at(1.0)), (Bound([2.5, 2.0, 6.0, 7.0]), 17.5));
    // A term that is not moved at all stays as it is, however far it could lead.
    sum.add(f64::INFINITY, &Bound::default());
    assert_eq!(sum.0, [2.5, 2.0, 6.0, 7.0]);
}

/// A position that each unit of an equation moves by `lever`; along that it bends and turns by so
/// much, and is singular from a multiple on.
struct Known {
    instant: Instant,
    lever: f64,
    bend: f64,
    turned: f64,
    singular: f64,
    moved: Vec<(usize, Vec<f64>)>,
}

impl Known {
    fn new(system: &System) -> Self {
        let instant = system.equations().instant_at(0.0, system.initial());
        Known {
            instant,
            lever: 1.0,
            bend: f64::INFINITY,
            turned: 0.0,
            singular: f64::INFINITY,
            moved: Vec::new(),
        }
    }
}

impl Lever for Known {
    fn instant(&self) -> &Instant {
        &self.instant
    }

    fn moved(&mut self, first: usize, b: &[f64]) -> f64 {
        self.moved.push((first, b.to_vec()));
        b.iter().fold(0.0, |most: f64, b| most.max(b.abs())) * self.lever
    }

    fn bend(&mut self) -> f64 {
        self.bend
    }

    fn turned(&self) -> f64 {
        self.turned
    }

    fn is_singular_within(&mut self, factor: f64) -> bool {
        factor >= self.singular
    }
}

fn driven(law: Law) -> System {
    let mut m = Mechanism::new("driven");
    let x = m.length("x", 0.0).expect("a new name");
    m.add("motor", drive(x, law)).expect("adds");
    m.build().expect("builds")
}

/// Time moves what C_q is made of.
#[constraint]
fn stretched(x: Coord, law: Law, t: Time) -> f64 {
    x * (2.0 + law.at(t)) - 1.0
}

fn stretching(law: Law) -> System {
    let mut m = Mechanism::new("stretching");
    let x = m.length("x", 0.5).expect("a new name");
    m.add("rod", stretched(x, law)).expect("adds");
    m.build().expect("builds")
}

/// A law that tells nothing beyond its values and derivatives.
#[derive(Clone)]
struct Silent(fn(f64) -> [f64; 4]);

impl LawFunction for Silent {
    fn jet(&self, x: f64) -> [f64; 4] {
        (self.0)(x)
    }
}

fn hides(drive: &mut Drive, system: &System, [from, to]: [f64; 2], lever: &mut Known) -> bool {
    drive.hides(Span { equations: system.equations(), from, to, pivot: 1.0 }, lever)
}

fn near(found: [f64; 4], exact: [f64; 4]) {
    assert!(
        found.iter().zip(exact).all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + b.abs())),
        "{found:?} {exact:?}"
    );
}

/// Bounds hold for a number of steps, within the times for which they were found, while the
/// smallest pivot leaves room.
#[test]
fn what_is_told_by_what_was_seen() {
    let system = driven(Law::sine(1.0, 1.0, 0.0));
    let drive = |c: f64, steps: u32| {
        let mut drive = Drive::new(system.equations());
        (drive.stretch, drive.off, drive.pivot, drive.steps) =
            ([1.0, 10.0], Bound([0.0, 0.0, c, 0.0]), 0.5, steps);
        drive
    };
    // 2 · 4 c · 0.5 ≤ 0.05 · 0.64
    let suffices = |c: f64, [from, to]: [f64; 2]| drive(c, 9).ends_suffice(from, to, 0.8);
    assert_eq!(
        [[2.0, 4.0], [4.0, 2.0], [8.0, 10.0], [3.0, 1.0]].map(|step| suffices(0.0079, step)),
        [true; 4]
    );
    assert_eq!([[2.0, 4.0], [4.0, 2.0]].map(|step| suffices(0.0081, step)), [false; 2]);
    assert_eq!(
        [[0.8, 2.0], [9.0, 10.5], [9.9, 12.0], [2.0, 0.9]].map(|step| suffices(0.0, step)),
        [false; 4]
    );
    let mut even = drive(0.0, 9);
    even.off = Bound([0.0, 0.02, 0.0, 0.0]);
    assert_eq!(
        [
            even.ends_suffice(4.0, 2.0, 0.8),
            even.ends_suffice(2.0, 4.0, 0.8),
            even.ends_suffice(4.0, 3.0, 0.8)
        ],
        [false, false, true]
    );
    let mut once = drive(0.0, 1);
    assert_eq!([once.ends_suffice(2.0, 3.0, 1.0), once.ends_suffice(2.0, 3.0, 1.0)], [true, false]);
    assert!(!Drive::new(system.equations()).ends_suffice(0.0, 1e-9, 1.0));
    once.ends_suffice = true;
    assert!(once.ends_suffice(-5.0, 50.0, 0.0));
    assert!(Drive::new(driven(Law::constant(1.0)).equations()).sources.len() <= 1);
}

/// A motor that goes on evenly hides nothing, ever.
#[test]
fn an_even_motor_is_told_for_good() {
    let system = driven(Law::linear(1.0, 2.0));
    let mut drive = Drive::new(system.equations());
    let mut lever = Known::new(&system);
    assert!(!drive.ends_suffice && !hides(&mut drive, &system, [0.0, 5.0], &mut lever));
    assert!(drive.ends_suffice && drive.ends_suffice(-1e9, 1e9, 0.0));
    assert!(drive.sources[0].terms.is_empty() && lever.moved.is_empty() && drive.looks == u32::MAX);
}

/// One that goes to and fro is known for all time, and weighed by the length of the step; over one
/// step alone by what it does there.
#[test]
fn a_motor_to_and_fro() {
    let system = driven(Law::sine(1.0, 1.0, 0.0));
    let mut drive = Drive::new(system.equations());
    let mut lever = Known::new(&system);
    assert!(!hides(&mut drive, &system, [0.0, 0.1], &mut lever));
    assert_eq!(
        (drive.ends_suffice, drive.steps, drive.looks, drive.longest, drive.pivot),
        (false, KNOWN, u32::MAX, f64::INFINITY, 1.0)
    );
    near(drive.off.0, [0.0, 0.0, 0.125, 1.0 / 6.0]);
    assert_eq!(lever.moved, [(0, vec![-1.0])]);
    // The bound is still known, and the position is looked at without new ones.
    drive.steps = 0;
    assert!(!hides(&mut drive, &system, [5.0, 4.9], &mut lever));
    assert_eq!((drive.steps, drive.looks, drive.stretch[1]), (KNOWN, u32::MAX - 1, f64::INFINITY));
    near(drive.off.0, [0.0, 0.0, 0.125, 1.0 / 6.0]);
    drive.looks = 0;
    assert!(!hides(&mut drive, &system, [0.0, 0.1], &mut lever) && drive.looks == u32::MAX);
    // Longer steps only where it does not turn round.
    assert!(!hides(&mut drive, &system, [0.0, 0.6], &mut lever));
    assert_eq!((drive.stretch, drive.longest), ([0.0, 0.6], 1.2));
    assert!(!hides(&mut drive, &system, [0.6, 0.0], &mut lever) && drive.stretch == [0.0, 0.6]);
    assert!(hides(&mut drive, &system, [1.3, 1.9], &mut lever));
    assert_eq!((drive.longest, drive.steps, drive.looks), (2.0 * (1.9 - 1.3), 0, 0));
    lever.bend = 0.0;
    assert!(!hides(&mut drive, &system, [1.3, 1.9], &mut lever));
    // No stretch is shorter than the step, and a smaller pivot allows less.
    (drive.longest, drive.looks) = (0.1, 0);
    assert!(!hides(&mut drive, &system, [0.0, 0.6], &mut lever) && drive.stretch == [0.0, 0.6]);
    lever.bend = f64::INFINITY;
    let weak = Span { equations: system.equations(), from: 0.0, to: 0.6, pivot: 0.5 };
    assert!(Drive::new(system.equations()).hides(weak, &mut lever));
    // An easier position is led further.
    (lever.lever, lever.bend) = (100.0, f64::INFINITY);
    assert!(hides(&mut Drive::new(system.equations()), &system, [0.2, 0.5], &mut lever));
}

/// Where C_q moves with time what is seen holds for this position, and for a few looks.
#[test]
fn time_in_c_q() {
    let system = stretching(Law::sine(0.1, 1.0, 0.0));
    let mut drive = Drive::new(system.equations());
    let mut lever = Known::new(&system);
    assert!(!hides(&mut drive, &system, [0.0, 0.1], &mut lever));
    assert_eq!(
        (drive.steps, drive.looks, drive.ends_suffice, drive.sources[0].apart),
        (KNOWN, LOOKS, false, false)
    );
    near(drive.off.0, [0.0, 0.0, 0.00625, 0.1 / 12.0]);
    // Slopes are those of the position in hand.
    drive.looks = 0;
    lever.instant = system.equations().instant_at(0.0, &[2.0]);
    assert!(!hides(&mut drive, &system, [0.0, 0.1], &mut lever));
    near(drive.off.0, [0.0, 0.0, 0.025, 0.1 / 3.0]);
    let even = stretching(Law::linear(0.0, 0.5));
    let mut drive = Drive::new(even.equations());
    assert!(!hides(&mut drive, &even, [0.0, 0.1], &mut Known::new(&even)) && !drive.ends_suffice);
}

/// Where equations are straight along each signal as far as all may have led it does not matter
/// where it was.
#[test]
fn straight_along_all_signals() {
    let system = driven(Law::sine(1.0, 1.0, 0.0));
    let straight = |bounds: &[f64], term_lever: f64, [bend, turned, singular]: [f64; 3]| {
        let mut drive = Drive::new(system.equations());
        let mut lever = Known::new(&system);
        let term = |off: &f64| Term {
            slopes: vec![*off],
            bound: Bound([*off, 0.0, 0.0, 0.0]),
            lever: term_lever,
        };
        drive.sources[0].terms = bounds.iter().map(term).collect();
        (lever.bend, lever.turned, lever.singular) = (bend, turned, singular);
        let found = drive.is_straight(system.equations(), 1.0, &mut lever);
        (found, lever.moved.len())
    };
    // Two of 0.2 each: 0.4 of the bend, of what turns and of what is singular.
    let two = [0.2, 0.2, 0.0];
    assert_eq!(straight(&two, 2.0, [1.2, 2.4, 0.41]), (true, 2));
    assert_eq!(straight(&two, 2.0, [1.3, 2.4, 0.41]), (false, 1));
    assert_eq!(straight(&two, 2.0, [1.2, 2.6, 0.41]), (false, 1));
    assert_eq!(straight(&two, 2.0, [1.2, 2.4, 0.39]), (false, 1));
    // One of them alone is not.
    assert!(!straight(&[0.1, 0.3], 2.0, [1.2, 0.0, 0.41]).0);
    // The equations are tested as far as the position can go at all.
    for (bend, is) in [(2.4e8, true), (2.6e8, false)] {
        assert_eq!(straight(&[1e9], 1e6, [bend, 1.0, 1.0]).0, is);
    }
}

#[constraint]
fn pair(x: Coord, y: Coord, f: Law, g: Law, t: Time) -> [f64; 2] {
    [x - f.at(t), y - g.at(t)]
}

/// Of several signals each counts: one that goes on evenly does not hide another one, nor one that
/// is known one that is sampled.
#[test]
fn several_signals() {
    let system_of = |f: Law, g: Law| {
        let mut m = Mechanism::new("pair");
        let [x, y] = ["x", "y"].map(|name| m.length(name, 0.0).expect("a new name"));
        m.add("pair", pair(x, y, f, g)).expect("adds");
        m.build().expect("builds")
    };
    let mixed = system_of(Law::linear(0.0, 1.0), Law::sine(1.0, 1.0, 0.0));
    let mut drive = Drive::new(mixed.equations());
    let mut lever = Known::new(&mixed);
    assert!(!hides(&mut drive, &mixed, [0.0, 0.1], &mut lever));
    near(drive.off.0, [0.0, 0.0, 0.125, 1.0 / 6.0]);
    let silent = system_of(
        Law::new(Silent(|t| [t * t * t, 3.0 * t * t, 6.0 * t, 6.0])),
        Law::sine(1.0, 1.0, 0.0),
    );
    let mut drive = Drive::new(silent.equations());
    let mut lever = Known::new(&silent);
    assert!(!hides(&mut drive, &silent, [0.0, 0.1], &mut lever));
    assert_eq!(lever.moved, [(0, vec![1.0, 0.0]), (0, vec![0.0, 1.0])]);

    let mut m = Mechanism::new("both");
    let [x, y, z] = ["x", "y", "z"].map(|name| m.length(name, 0.5).expect("a new name"));
    m.add("motor", crate::joints::drivers::drive(x, Law::sine(1.0, 1.0, 0.0))).expect("adds");
    m.add("rod", stretched(y, Law::sine(0.1, 1.0, 0.0))).expect("adds");
    m.add("other", crate::joints::drivers::drive(z, Law::new(Silent(|_| [0.0; 4])))).expect("adds");
    let both = m.build().expect("builds");
    let mut drive = Drive::new(both.equations());
    assert!(!hides(&mut drive, &both, [0.0, 0.1], &mut Known::new(&both)));
    assert_eq!((drive.looks, drive.steps), (LOOKS, 0));
}

/// A signal that was sampled while no bounds were known is followed by its own slopes as soon as
/// they are.
#[test]
fn bounds_that_come_to_be_known() {
    let system = driven(Law::sine(1.0, 1.0, 0.0));
    let mut drive = Drive::new(system.equations());
    let instant = Known::new(&system).instant;
    let source = &mut drive.sources[0];
    let bounds = Some(vec![Bound([0.0, 0.0, 0.0, 1.0])]);
    for _ in 0..2 {
        source.take(system.equations(), &instant, None);
        assert!(source.is_sampled && source.terms[0].slopes == [1.0]);
        source.take(system.equations(), &instant, bounds.clone());
        assert!(
            !source.is_sampled
                && source.terms[0].slopes == [-1.0]
                && Some(vec![source.terms[0].bound]) == bounds
        );
    }
}
