use super::*;
use crate::law::Ends;
use crate::law::breaks::MOST_BREAKS;
use crate::law::tests::{bounded, listed, near, own, shown};
use crate::numbers::enclosure::{Interval, ONE};

const F: [f64; 5] = [1.0, -2.0, 0.5, 3.0, -0.25];
const G: [f64; 5] = [0.25, 1.5, -1.0, 0.5, 0.75];

/// The product of two polynomials by their coefficients.
fn product(f: &[f64], g: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; f.len() + g.len() - 1];
    f.iter()
        .enumerate()
        .for_each(|(j, f)| g.iter().enumerate().for_each(|(k, g)| all[j + k] += f * g));
    all
}

/// The same law by another route: jets, fourth derivative, bounds.
fn agree(law: &Law, polynomial: &[f64]) {
    let expected = Law::polynomial(polynomial);
    for x in [-1.3, -0.4, 0.0, 0.7, 1.9] {
        law.jet(x)
            .into_iter()
            .zip(expected.jet(x))
            .for_each(|(found, exact)| near(found, exact, 1e-12));
        near(law.fourth(x), expected.fourth(x), 1e-12);
    }
    bounded(law, &[(0.5, 0.5), (-0.25, -0.25), (1.5, 1.5)], 0.0);
    bounded(law, &[(0.5, 0.500_1), (-0.25, -0.249_9)], 50.0);
    assert!(
        law.is_smooth()
            && law.refusal().is_none()
            && law.breaks(-9.0, 9.0).is_empty()
            && !law.description().is_empty()
    );
}

#[test]
fn sums_products_and_compositions_of_polynomials() {
    let f = Law::polynomial(&F);
    let g = Law::polynomial(&G);
    agree(&(f.clone() + g.clone()), &std::array::from_fn::<f64, 5, _>(|k| F[k] + G[k]));
    agree(&(f.clone() - g.clone()), &std::array::from_fn::<f64, 5, _>(|k| F[k] - G[k]));
    agree(&(-f.clone()), &F.map(|f| -f));
    agree(&(2.5 * f.clone()), &F.map(|f| 2.5 * f));
    agree(&(f.clone() * -0.5), &F.map(|f| -0.5 * f));
    agree(&(f.clone() * g.clone()), &product(&F, &G));
    // by Horner's rule on coefficients
    let composed = F.iter().rev().fold(vec![0.0], |sum, f| {
        let mut next = product(&sum, &G);
        next[0] += f;
        next
    });
    agree(&f.compose(&g), &composed);
    let shifted = F.iter().rev().fold(vec![0.0], |sum, f| {
        let mut next = product(&sum, &[-0.75, 1.0]);
        next[0] += f;
        next
    });
    agree(&f.shifted(0.75), &shifted);
}

#[test]
fn kinds_parts_and_parameters() {
    let f = Law::linear(1.0, 2.0);
    let g = Law::ramp(3.0);
    let all = [
        (
            f.clone() + g.clone(),
            "sum",
            vec!["first.f0", "first.rate", "second.rate"],
            vec!["first", "second"],
        ),
        (
            f.clone() * g.clone(),
            "product",
            vec!["first.f0", "first.rate", "second.rate"],
            vec!["first", "second"],
        ),
        (0.5 * g.clone(), "multiple", vec!["factor", "law.rate"], vec!["law"]),
        (
            f.compose(&g),
            "composed",
            vec!["outer.f0", "outer.rate", "inner.rate"],
            vec!["outer", "inner"],
        ),
    ];
    for (law, kind, names, parts) in all {
        assert!(law.description().contains("f("), "{kind}");
        assert_eq!(
            (law.kind(), law.parts().into_iter().map(|part| part.0).collect::<Vec<_>>()),
            (kind, parts.iter().map(|part| part.to_string()).collect())
        );
        assert_eq!(shown(&law).iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), names);
        for (k, name) in names.iter().enumerate() {
            let mut changed = law.clone();
            let before = shown(&law);
            assert!(changed.set_parameter(name, 7.5));
            for (j, ((name, value), (_, before))) in shown(&changed).iter().zip(&before).enumerate()
            {
                assert_eq!(*value, if j == k { 7.5 } else { *before }, "{kind} {name}");
            }
            assert_eq!(changed.kind(), kind);
        }
        for name in [
            "",
            "rate",
            "first",
            "first.",
            "firstrate",
            "law.x",
            "outer.x",
            "factor.x",
            "second.f0",
            "inner.f0",
        ] {
            assert!(!law.clone().set_parameter(name, 1.0), "{kind} {name}");
        }
    }
}

/// A whole rests on what its parts rest on, is refused where one is, breaks where one does, and has
/// bounds only where both do.
#[test]
fn what_holds_of_a_part_holds_of_the_whole() {
    let own = own(|x| [x, 1.0, 0.0, 0.0, 0.0]);
    let plain = Law::linear(0.0, 1.0);
    let bad = Law::cycloidal(1.0, 0.0);
    let worse = Law::cycloidal(1.0, -1.0);
    let rise = Law::harmonic_rise(1.0, 1.0);
    type Both = fn(&Law, &Law) -> Law;
    let both: [(Both, usize); 3] = [
        (|f, g| f.clone() + g.clone(), 0),
        (|f, g| f.clone() * g.clone(), 0),
        (|f, g| f.compose(g), 1),
    ];
    for (law, first) in both {
        for (f, g) in [(&own, &plain), (&plain, &own)] {
            assert_eq!(
                (law(f, g).trusted(), law(f, g).over(&Series::number(1.0)).is_none()),
                (vec!["law".to_string()], true)
            );
        }
        assert_eq!(
            (
                law(&plain, &plain).trusted().len(),
                law(&plain, &plain).over(&Series::number(1.0)).is_none()
            ),
            (0, false)
        );
        assert_eq!(
            (law(&bad, &plain).refusal(), law(&plain, &bad).refusal()),
            (bad.refusal(), bad.refusal())
        );
        assert_eq!(law(&bad, &worse).refusal(), [&bad, &worse][first].refusal());
        for law in [law(&rise, &plain), law(&plain, &rise)] {
            assert_eq!(
                (listed(&law, -1.0, 2.0), law.is_smooth()),
                (vec![(0.0, 2), (1.0, 2)], false)
            );
            assert_eq!(
                (listed(&law, 0.5, 2.0), law.sharpest_break(0.5, 2.0)),
                (vec![(1.0, 2)], Some(Break { x: 1.0, order: 2 }))
            );
            assert_eq!(law.sharpest_break(1.5, 2.0), None);
        }
    }
    let multiple = 3.0 * rise.clone();
    assert_eq!(
        (listed(&multiple, -1.0, 0.5), multiple.is_smooth(), (2.0 * own.clone()).trusted().len()),
        (vec![(0.0, 2)], false, 1)
    );
    assert_eq!(
        (multiple.sharpest_break(0.5, 2.0), (2.0 * bad.clone()).refusal()),
        (Some(Break { x: 1.0, order: 2 }), bad.refusal())
    );
    assert!((2.0 * own).over(&Series::number(1.0)).is_none());
    // the rougher one of both, wherever it is
    let corner = Law::sequence(0.25, [(0.5, Law::ramp(1.0))]);
    for law in [
        rise.clone() + corner.clone(),
        corner.clone() + rise.clone(),
        rise.clone() * corner.clone(),
    ] {
        assert_eq!(law.sharpest_break(-1.0, 2.0), Some(Break { x: 0.25, order: 1 }));
        assert_eq!(listed(&law, -1.0, 2.0), [(0.0, 2), (0.25, 1), (0.75, 1), (1.0, 2)]);
    }
}

/// At a break of the outer law that is passed backwards the law has the derivatives of its left
/// side: by the first derivative that moves.
#[test]
fn breaks_that_are_passed_backwards() {
    // up by 1 until 1, then down by 1
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let through = |c: &[f64]| corner.compose(&Law::polynomial(c)).jet(0.0);
    let expected: [(&[f64], [f64; 4]); 6] = [
        (&[1.0, 1.0], [1.0, -1.0, 0.0, 0.0]),
        (&[1.0, -1.0], [1.0, -1.0, 0.0, 0.0]),
        (&[1.0, 0.0, 1.0], [1.0, 0.0, -2.0, 0.0]),
        (&[1.0, 0.0, -1.0], [1.0, 0.0, -2.0, 0.0]),
        (&[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, -6.0]),
        (&[1.0, 0.0, 0.0, -1.0], [1.0, 0.0, 0.0, -6.0]),
    ];
    for (c, jet) in expected {
        through(c).into_iter().zip(jet).for_each(|(found, exact)| near(found, exact, 1e-11));
    }
    // beside the break each side has its own
    assert_eq!([0.9, 1.1].map(|x| corner.compose(&Law::ramp(-1.0)).jet(-x)[1]), [-1.0, 1.0]);
    // At rest on the left of where a rise begins, at constant speed on the left of where it brakes,
    // wherever these are.
    for at in [0.0, 1e6, -1e6, 1e-6] {
        let back =
            |law: Law, from: f64| law.shifted(at).compose(&Law::linear(at + from, -1.0)).jet(0.0);
        assert_eq!(back(Law::harmonic_rise(1.0, 1.0), 0.0)[2], 0.0, "{at}");
        let brakes = back(Law::trapezoidal(2.0, 1.0, 2.0), 2.0);
        [1.75, -1.0, 0.0, 0.0]
            .into_iter()
            .zip(brakes)
            .for_each(|(exact, found)| near(found, exact, 1e-9));
        let speeds_up = back(Law::trapezoidal(2.0, 1.0, 2.0), 0.5);
        [0.25, -1.0, 2.0, 0.0]
            .into_iter()
            .zip(speeds_up)
            .for_each(|(exact, found)| near(found, exact, 1e-9));
    }
}

/// Breaks of a composition: where the inner law takes the places of the outer one's, and those of
/// the inner one.
#[test]
fn breaks_of_a_composition() {
    let motion = Law::trapezoidal(2.0, 1.0, 2.0);
    // 3 sin t takes 0, 0.5, 2 and 2.5 on its way up and on its way down
    let law = motion.compose(&Law::sine(3.0, 1.0, 0.0));
    let up = [0.0, 0.5, 2.0, 2.5].map(|y| (y / 3.0_f64).asin());
    let expected: Vec<f64> =
        up.into_iter().chain(up.into_iter().rev().map(|x| std::f64::consts::PI - x)).collect();
    let found = listed(&law, -0.5, 3.5);
    assert_eq!(found.iter().map(|b| b.1).collect::<Vec<_>>(), [2; 8]);
    found.iter().zip(&expected).for_each(|((x, _), exact)| near(*x, *exact, 1e-14));
    assert_eq!(law.sharpest_break(0.1, 1.0), Some(Break { x: found[1].0, order: 2 }));
    assert_eq!((listed(&law, 0.2, 0.7), listed(&law, 0.5, 0.7)), (vec![], vec![]));
    // An inner law that turns round at its own break: each side is looked at by itself.
    let tent = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    let law = Law::harmonic_rise(1.0, 0.5).compose(&tent);
    assert_eq!(listed(&law, 0.1, 1.9), [(0.5, 2), (1.0, 1), (1.5, 2)]);
    assert_eq!(law.sharpest_break(0.1, 0.9), Some(Break { x: 0.5, order: 2 }));
    assert_eq!(
        (law.sharpest_break(0.1, 1.9), law.is_smooth()),
        (Some(Break { x: 1.0, order: 1 }), false)
    );
    // More than are listed are not gathered without end.
    let wave = Law::spline(&[(0.0, 0.0), (1.0, 1.0), (1.5, 0.3), (2.0, 0.0)], Ends::Periodic);
    let many = listed(&wave.compose(&Law::linear(0.0, 2.0)), 0.0, 1e9);
    assert!(
        many.len() <= MOST_BREAKS && many.windows(2).all(|pair| pair[0].0 < pair[1].0),
        "{}",
        many.len()
    );
    assert!(bounds_of(&wave.compose(&Law::linear(0.0, 2.0)), 0.0, 0.25).len() >= 4);
}

fn bounds_of(law: &Law, lo: f64, hi: f64) -> Series {
    law.over(&Series::variable(Interval::new(lo, hi), ONE, 7)).expect("has bounds")
}
