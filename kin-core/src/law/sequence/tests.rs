use super::*;
use crate::law::tests::{bounded, listed, near, own, shown};

fn constant(c: f64) -> Law {
    Law::constant(c)
}

/// 0, 0.5 to 1.5 up by 1, down again to 3.5, and 0.5 of rest.
fn tent() -> Sequence {
    Sequence::new(
        0.5,
        vec![(1.0, Law::ramp(1.0)), (2.0, Law::linear(1.0, -0.5)), (0.5, constant(0.0))],
    )
}

#[test]
fn seams_are_where_parts_meet() {
    let seams: Vec<_> =
        tent().seams().iter().map(|seam| (seam.x, seam.order, seam.values)).collect();
    let expected = [
        (0.5, Some(1), (0.0, 0.0)),
        (1.5, Some(1), (1.0, 1.0)),
        (3.5, Some(1), (0.0, 0.0)),
        (4.0, None, (0.0, 0.0)),
    ];
    assert_eq!(seams.len(), 4);
    for ((x, order, values), expected) in seams.into_iter().zip(expected) {
        assert_eq!((x, order), (expected.0, expected.1));
        near(values.0, expected.2.0, 1e-14);
        near(values.1, expected.2.1, 1e-14);
    }
    // The end of the last part meets what is held.
    let orders = |last: Law| {
        Sequence::new(0.0, vec![(1.0, last)])
            .seams()
            .iter()
            .map(|seam| seam.order)
            .collect::<Vec<_>>()
    };
    assert_eq!(orders(Law::polynomial(&[0.0, 0.0, 0.0, 1.0])), [Some(3), Some(1)]);
    assert_eq!(orders(Law::polynomial(&[0.0, 0.0, 1.0])), [Some(2), Some(1)]);
    assert_eq!(orders(Law::polynomial(&[0.0, 2.0, -1.0])), [Some(1), Some(2)]);
    // It is judged by its own size, whatever the others are.
    let small = Sequence::new(0.0, vec![(1.0, Law::linear(1e9, -1e9)), (1.0, Law::ramp(1e-3))]);
    assert_eq!(
        small.seams().iter().map(|seam| seam.order).collect::<Vec<_>>(),
        [Some(1), Some(1), Some(1)]
    );
    assert!(Sequence::new(0.0, vec![]).seams().is_empty());
}

/// The tolerance of a slope's jump goes by the shorter one of two parts that meet, and by the
/// length of one that stands alone.
#[test]
fn slopes_of_short_parts_are_off_by_more() {
    let short = 1e-7;
    let flat = |slope: f64| Law::linear(1.0, slope);
    let orders = |parts: Vec<(f64, Law)>| {
        Sequence::new(0.0, parts).seams().iter().map(|seam| seam.order).collect::<Vec<_>>()
    };
    for (slope, order) in [(3e-7, None), (3e-6, Some(1))] {
        let held = 1.0 + slope * short;
        assert_eq!(
            orders(vec![(1.0, constant(1.0)), (short, flat(slope))])[1..],
            [order, order],
            "{slope}"
        );
        assert_eq!(
            orders(vec![(short, flat(slope)), (1.0, constant(held))]),
            [order, order, None],
            "{slope}"
        );
    }
    assert_eq!(orders(vec![(1.0, flat(3e-7))]), [Some(1), Some(1)]);
}

/// Up to a seam the law is the part before, from it on the next one; beyond both ends it is held.
#[test]
fn each_part_has_its_own_variable() {
    let law = Law::sequence(
        2.0,
        [
            (1.0, Law::polynomial(&[0.0, 0.0, 1.0])),
            (2.0, Law::polynomial(&[1.0, -1.0, 3.0, 0.0, 2.0])),
        ],
    );
    let held = |y: f64| [y, 0.0, 0.0, 0.0];
    assert_eq!([-9.0, 1.999].map(|x| law.jet(x)), [held(0.0); 2]);
    assert_eq!((law.jet(2.0), law.jet(2.5)), ([0.0, 0.0, 2.0, 0.0], [0.25, 1.0, 2.0, 0.0]));
    assert_eq!((law.jet(3.0), law.jet(4.0)), ([1.0, -1.0, 6.0, 0.0], [5.0, 13.0, 30.0, 48.0]));
    // At the end of the last part the law is that part.
    assert_eq!(law.jet(5.0), [43.0, 75.0, 102.0, 96.0]);
    assert_eq!([5.001, 99.0].map(|x| law.jet(x)), [held(43.0); 2]);
    assert_eq!([1.0, 2.5, 3.0, 4.5, 5.0].map(|x| law.fourth(x)), [0.0, 0.0, 48.0, 48.0, 48.0]);
    assert!(Law::sequence(0.0, Vec::<(f64, Law)>::new()).at(1.0).is_nan());
    let half = Law::sequence(
        -1.0,
        [(1.5, constant(2.0) * Law::polynomial(&[2.0, 1.0])), (0.5, constant(7.0))],
    );
    assert_eq!([-2.0, -0.75, 0.75, 1.5].map(|x| half.at(x)), [4.0, 4.5, 7.0, 7.0]);
}

#[test]
fn bounds_of_parts() {
    let steep = Law::sequence(
        2.0,
        [(1.0, Law::polynomial(&[0.0, 0.0, 1.0])), (2.0, Law::polynomial(&[1.0, 2.0, 3.0]))],
    );
    let intervals = [
        (0.0, 1.5),
        (1.5, 2.25),
        (2.125, 2.25),
        (2.75, 3.25),
        (3.5, 3.75),
        (4.5, 7.0),
        (6.0, 8.0),
        (0.0, 9.0),
    ];
    bounded(&steep, &intervals, 2.5);
    let lens = |law: &Law, lo: f64, hi: f64| {
        law.over(&Series::variable(Interval::new(lo, hi), crate::numbers::enclosure::ONE, 7))
            .map(|y| y.len())
    };
    // A slope that jumps is the last that is known; what is held does not change.
    assert_eq!(
        (lens(&steep, 1.5, 2.25), lens(&steep, 2.75, 3.25), lens(&steep, 4.5, 7.0)),
        (Some(3), Some(3), Some(2))
    );
    assert_eq!(lens(&steep, 2.125, 2.25), Some(7));
    assert!(
        Law::sequence(0.0, Vec::<(f64, Law)>::new())
            .over(&Series::number(1.0))
            .is_none_or(|y| y.len() == 0)
    );
    let own = own(|x| [x, 1.0, 0.0, 0.0, 0.0]);
    assert!(Law::sequence(0.0, [(1.0, own.clone())]).over(&Series::number(0.5)).is_none());
    assert_eq!(
        (Law::sequence(0.0, [(1.0, own.clone())]).trusted(), own.periodic(1.0).trusted()),
        (vec!["law".to_string()], vec!["law".to_string()])
    );
}

/// Breaks of a part are its own inside, and nobody's beyond its ends; where it ends what jumps is
/// told of the seam.
#[test]
fn breaks_of_parts() {
    let motion = Law::trapezoidal(2.0, 1.0, 2.0);
    let before = || Law::polynomial(&[1.0, -2.0, 1.0]);
    let law = |k: f64| {
        let motion = motion.compose(&Law::linear(0.0, 1.0 / k));
        let before = before().compose(&Law::linear(0.0, 1.0 / k));
        Law::sequence(10.0 * k, [(k, before), (2.0 * k, motion), (k, Law::linear(1.75, 1.0 / k))])
    };
    for k in [1.0, 1e-8, 1e8] {
        let found = listed(&law(k), -99.0 * k, 99.0 * k);
        assert_eq!(found.iter().map(|b| b.1).collect::<Vec<_>>(), [1, 2, 1], "{k} {found:?}");
        found.iter().zip([10.0, 11.5, 14.0]).for_each(|((x, _), at)| near(x / k, at, 1e-13));
    }
    let law = law(1.0);
    assert_eq!(listed(&law, 11.5, 11.5), [(11.5, 2)]);
    assert_eq!(
        (
            listed(&law, -5.0, -1.0),
            listed(&law, 11.0, 11.4),
            listed(&law, 12.0, 13.9),
            listed(&law, 20.0, 30.0)
        ),
        (vec![], vec![], vec![], vec![])
    );
    assert_eq!(
        (listed(&law, 10.0, 11.5), listed(&law, 11.5, 14.0)),
        (vec![(10.0, 1), (11.5, 2)], vec![(11.5, 2), (14.0, 1)])
    );
    assert_eq!(law.sharpest_break(10.5, 20.0), Some(Break { x: 14.0, order: 1 }));
    assert_eq!(
        (law.sharpest_break(10.5, 13.0), law.sharpest_break(12.0, 13.0)),
        (Some(Break { x: 11.5, order: 2 }), None)
    );
    assert!(!law.is_smooth());
}

#[test]
fn sequences_that_make_no_sense() {
    let said = |parts: &[(f64, Law)]| {
        Law::sequence(0.0, parts.iter().cloned()).refusal().unwrap_or_default()
    };
    assert_eq!(said(&[]), "sequence: the list of parts is empty. Give at least one part");
    assert_eq!(
        said(&[(1.0, constant(0.0)), (0.0, constant(0.0))]),
        "part 2 of the sequence has the length 0. Give a value above zero"
    );
    assert_eq!(
        said(&[(-1.0, constant(0.0))]),
        "part 1 of the sequence has the length -1. Give a value above zero"
    );
    assert_eq!(
        said(&[(f64::INFINITY, constant(0.0))]),
        "part[0].length is inf. Give a finite number"
    );
    let bad = Law::cycloidal(1.0, 0.0);
    assert_eq!(
        said(&[(1.0, constant(0.0)), (1.0, bad)]),
        "part 2 of the sequence: cycloidal: the length of a rise must be above zero (length = 0)"
    );
    let parts = [
        (1.0, constant(1.0)),
        (1.0, Law::linear(1.0, 0.5)),
        (1.0, constant(2.0)),
        (1.0, constant(3.0)),
    ];
    assert_eq!(
        said(&parts),
        "parts 2 and 3 of the sequence do not meet: part 2 ends at 1.5, and the next part begins at 2"
    );
    assert_eq!(said(&parts[..2]), "");
    // A last part that jumps at its very end: no parts that do not meet, but a break.
    let late = own(|x| [f64::from(x >= 1.0), 0.0, 0.0, 0.0, 0.0]);
    let law = Law::sequence(0.0, [(1.0, late)]);
    assert_eq!((law.refusal(), listed(&law, 0.0, 2.0)), (None, vec![(1.0, 0)]));
}

#[test]
fn parameters_of_sequences() {
    let mut law = Law::sequence(0.5, [(1.0, Law::ramp(2.0)), (3.0, Law::linear(2.0, 1.0))]);
    let names = [
        "start",
        "part[0].length",
        "part[0].law.rate",
        "part[1].length",
        "part[1].law.f0",
        "part[1].law.rate",
    ];
    let values = [0.5, 1.0, 2.0, 3.0, 2.0, 1.0];
    assert_eq!(
        shown(&law),
        names.iter().zip(values).map(|(name, value)| (name.to_string(), value)).collect::<Vec<_>>()
    );
    for (k, name) in names.iter().enumerate() {
        assert!(law.set_parameter(name, 7.0 + k as f64), "{name}");
    }
    assert_eq!(
        shown(&law).iter().map(|(_, value)| *value).collect::<Vec<_>>(),
        [7.0, 8.0, 9.0, 10.0, 11.0, 12.0]
    );
    for name in
        ["part[2].length", "part[0].law.f0", "part[0].x", "part[x].length", "length", "part[0]", ""]
    {
        assert!(!law.set_parameter(name, 1.0), "{name}");
    }
    assert_eq!(
        law.parts().iter().map(|(name, part)| (name.as_str(), part.kind())).collect::<Vec<_>>(),
        [("part[0].law", "ramp"), ("part[1].law", "linear")]
    );
    assert_eq!(
        (law.kind(), law.description().contains("Sequence of laws, each over its length")),
        ("sequence", true)
    );
}

#[test]
fn what_is_beyond_whole_periods() {
    assert_eq!([5.0, 2.0, -0.5, -1e-17, 0.0].map(|x| within(x, 2.0)), [1.0, 0.0, 1.5, 0.0, 0.0]);
    assert_eq!((within(1.75, 2.0), within(2.0_f64.next_down(), 2.0)), (1.75, 2.0_f64.next_down()));
}

fn saw() -> Law {
    Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (3.0, Law::polynomial(&[1.0, 0.0, -1.0 / 9.0]))])
}

#[test]
fn a_law_over_and_over() {
    let law = saw().periodic(4.0);
    for x in [-7.5, -3.5, 0.5, 4.5, 100.5] {
        assert_eq!((law.jet(x), law.fourth(x)), ([0.5, 1.0, 0.0, 0.0], 0.0));
        assert_eq!(law.jet(x + 1.5), saw().jet(2.0));
    }
    let quartic = Law::polynomial(&[0.0, 0.0, 0.0, -1.0, 1.0]).periodic(1.0);
    assert_eq!((quartic.fourth(7.5), quartic.jet(7.5)), (24.0, [-0.0625, -0.25, 0.0, 6.0]));
    bounded(
        &law,
        &[(0.25, 0.5), (4.25, 4.5), (-3.75, -3.5), (5.25, 7.5), (0.25, 9.0), (3.5, 4.5)],
        2.5,
    );
    assert_eq!(listed(&law, -1.0, 5.0), [(0.0, 1), (1.0, 1), (4.0, 1), (5.0, 1)]);
    assert_eq!(
        (listed(&law, 0.5, 0.75), listed(&law, 1.0, 1.0), listed(&law, 4.0, 4.0)),
        (vec![], vec![(1.0, 1)], vec![(4.0, 1)])
    );
    assert_eq!(
        (law.sharpest_break(1.5, 1e9), law.sharpest_break(1.5, 3.9)),
        (Some(Break { x: 4.0, order: 1 }), None)
    );
    assert!(
        !law.is_smooth()
            && !saw().periodic(0.5).is_smooth()
            && Law::harmonic(0.0, 1.0).periodic(std::f64::consts::TAU).is_smooth()
    );
    assert_eq!(
        (
            law.kind(),
            law.description().contains("repeats the first period of another law without end")
        ),
        ("periodic", true)
    );
}

/// A break of the law at either end of the period is the seam's own: one that is not there when it
/// goes on is none.
#[test]
fn breaks_at_the_ends_of_a_period() {
    // The rise is at rest at both ends; it and its beginning again are one cosine.
    let wave = |k: f64| {
        let law = Law::sequence(
            0.0,
            [(k, Law::harmonic_rise(1.0, k)), (k, constant(1.0) - Law::harmonic_rise(1.0, k))],
        );
        law.periodic(2.0 * k)
    };
    for k in [1.0, 1e-8, 1e8] {
        assert_eq!(
            (listed(&wave(k), -5.0 * k, 5.0 * k), wave(k).is_smooth(), wave(k).refusal()),
            (vec![], true, None),
            "{k}"
        );
    }
    // Breaks just inside are there.
    for (k, at) in [(1e-6, 1.0), (1e-6, 1e-8), (1e-6, 1e8)] {
        let corner = Law::sequence(
            0.0,
            [
                (k * at, Law::ramp(1.0 / at)),
                ((1.0 - 2.0 * k) * at, constant(k)),
                (k * at, Law::linear(k, -1.0 / at)),
            ],
        );
        let found = listed(&corner.periodic(at), 0.0, 0.999_999_99 * at);
        assert_eq!(found.len(), 3, "{at} {found:?}");
    }
}

#[test]
fn laws_that_do_not_repeat_and_their_parameters() {
    let said = |law: Law, period: f64| law.periodic(period).refusal().unwrap_or_default();
    assert_eq!(
        said(Law::ramp(1.0), 2.0),
        "the law does not repeat after 2: the period begins at 0 and ends at 2"
    );
    assert_eq!(said(Law::ramp(1.0), 0.0), "periodic: the period must be above zero (period = 0)");
    assert_eq!(said(Law::ramp(1.0), -1.0), "periodic: the period must be above zero (period = -1)");
    assert_eq!(
        said(Law::cycloidal(1.0, -1.0), 1.0),
        "cycloidal: the length of a rise must be above zero (length = -1)"
    );
    assert_eq!(
        (said(saw(), 4.0), said(Law::harmonic(0.0, 1.0), std::f64::consts::TAU)),
        (String::new(), String::new())
    );
    let mut law = Law::linear(0.5, 0.25).periodic(3.0);
    assert_eq!(
        shown(&law).iter().map(|(name, value)| (name.as_str(), *value)).collect::<Vec<_>>(),
        [("period", 3.0), ("law.f0", 0.5), ("law.rate", 0.25)]
    );
    assert!(law.set_parameter("period", 2.0) && law.set_parameter("law.rate", 4.0));
    assert_eq!((law.at(3.0), shown(&law)[0].1), (4.5, 2.0));
    assert!(!law.set_parameter("rate", 1.0) && !law.set_parameter("law.x", 1.0));
    assert_eq!(
        law.parts().iter().map(|(name, part)| (name.as_str(), part.kind())).collect::<Vec<_>>(),
        [("law", "linear")]
    );
}
