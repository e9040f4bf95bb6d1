use super::*;
use crate::numbers::enclosure::{Interval, ONE};
use crate::numbers::real::{Dual2_64, Dual3_64};

/// A law of one's own: f and its derivatives up to the fourth.
struct Own<F>(F);

impl<F: Fn(f64) -> [f64; 5] + Send + Sync> LawFunction for Own<F> {
    fn jet(&self, x: f64) -> [f64; 4] {
        let [f, f1, f2, f3, _] = (self.0)(x);
        [f, f1, f2, f3]
    }

    fn fourth(&self, x: f64) -> f64 {
        (self.0)(x)[4]
    }
}

pub(super) fn own(f: impl Fn(f64) -> [f64; 5] + Send + Sync + 'static) -> Law {
    Law::new(Own(f))
}

pub(super) fn near(found: f64, exact: f64, share: f64) {
    assert!((found - exact).abs() <= share * (1.0 + exact.abs()), "{found:e} instead of {exact:e}");
}

/// The breaks that a law lists between two places.
pub(super) fn listed(law: &Law, from: f64, to: f64) -> Vec<(f64, usize)> {
    law.breaks(from, to).iter().map(|b| (b.x, b.order)).collect()
}

/// The names of its parameters, with their values.
pub(super) fn shown(law: &Law) -> Vec<(String, f64)> {
    let mut all = Vec::new();
    law.parameters(&mut |name, value| all.push((name.to_string(), value)));
    all
}

/// A law and its derivatives lie within its bounds over each interval, and these are no wider than
/// `factor` times what 2001 places show.
pub(super) fn bounded(law: &Law, intervals: &[(f64, f64)], factor: f64) {
    for &(lo, hi) in intervals {
        let series =
            law.over(&Series::variable(Interval::new(lo, hi), ONE, 7)).expect("has bounds");
        let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
        for k in 0..=2000 {
            let jet = law.jet(if k == 2000 { hi } else { lo + (hi - lo) * f64::from(k) / 2000.0 });
            for (order, by) in
                [1.0, 1.0, 2.0, 6.0].into_iter().enumerate().take(series.len().min(4))
            {
                let bounds = series.at(order);
                let f = jet[order] / by;
                let slack = 1e-12 * (1.0 + f.abs());
                assert!(
                    bounds.lo() - slack <= f && f <= bounds.hi() + slack,
                    "{law:?} over {lo} to {hi}: {order} {f} {bounds:?}"
                );
                seen[order] = [seen[order][0].min(f), seen[order][1].max(f)];
            }
        }
        for (order, [least, most]) in seen.into_iter().enumerate().take(series.len().min(4)) {
            let room =
                factor * (0.5 * (most - least)) + 1e-11 * (1.0 + most.abs().max(least.abs()));
            assert!(
                series.at(order).radius() <= room,
                "{law:?} over {lo} to {hi}: {order} {:?} {least} {most}",
                series.at(order)
            );
        }
    }
}

#[test]
fn dual_numbers_go_through_a_law() {
    let law = Law::sine(2.0, 3.0, 0.5);
    let [f, f1, f2, _] = law.jet(0.7);
    let y = law.at(Real(Dual2_64::new(0.7, 1.5, -0.25))).0;
    assert_eq!(law.at(0.7), f);
    assert_eq!(law.slope(0.7), f1);
    assert!((y.re - f).abs() < 1e-15 && (y.v1 - f1 * 1.5).abs() < 1e-14);
    assert!((y.v2 - (f2 * 2.25 - f1 * 0.25)).abs() < 1e-13);
}

/// The third derivative of a slope is the fourth of the law; what is at rest does not ask for it.
#[test]
fn dual_numbers_go_through_the_slope_of_a_law() {
    let law = Law::polynomial(&[0.3, -1.0, 2.0, 0.5, -0.25]);
    let x = Dual3_64::new(0.7, 1.5, -0.25, 0.4);
    let [_, f1, f2, f3] = law.jet(0.7);
    let f4 = -6.0;
    let y = law.slope(Real(x)).0;
    near(y.re, f1, 1e-15);
    near(y.v1, f2 * 1.5, 1e-15);
    near(y.v2, f3 * 2.25 - 0.25 * f2, 1e-14);
    near(y.v3, f4 * 1.5_f64.powi(3) + 3.0 * f3 * 1.5 * -0.25 + f2 * 0.4, 1e-14);
    let unknown = own(|x| [x.sin(), x.cos(), -x.sin(), -x.cos(), f64::NAN]);
    assert!(unknown.slope(Real(x)).0.v3.is_nan());
    let resting = unknown.slope(Real(Dual3_64::new(0.7, 0.0, 0.5, -0.2))).0;
    assert_eq!((resting.re, resting.v1), (0.7_f64.cos(), 0.0));
    near(resting.v3, 0.7_f64.sin() * 0.2, 1e-15);
}

#[test]
fn clones_keep_their_parameter() {
    let mut law = Law::ramp(2.0);
    let old = law.clone();
    assert!(law.set_parameter("rate", 3.0));
    assert!(!law.set_parameter("speed", 3.0));
    assert_eq!((law.at(1.0), old.at(1.0)), (3.0, 2.0));
    assert_eq!(format!("{law:?}"), "ramp { rate: 3.0 }");
}

#[test]
fn laws_cross_threads() {
    fn sent<T: Send + Sync + Clone + 'static>() {}
    sent::<Law>();
}

/// A law of one's own that gives nothing but its jet has the defaults of the trait.
#[test]
fn a_law_that_tells_its_jet_alone() {
    struct Jet;
    impl LawFunction for Jet {
        fn jet(&self, x: f64) -> [f64; 4] {
            [x * x, 2.0 * x, 2.0, 0.0]
        }
    }
    let mut law = Law::new(Jet);
    assert_eq!(
        (law.kind(), law.description(), law.is_smooth(), law.refusal()),
        ("law", "", true, None)
    );
    assert!(law.fourth(1.0).is_nan());
    assert_eq!((law.breaks(-9.0, 9.0), law.sharpest_break(-9.0, 9.0)), (vec![], None));
    assert_eq!((shown(&law), law.parts().len(), law.fixed_numbers()), (vec![], 0, vec![]));
    assert!(law.over(&Series::number(1.0)).is_none());
    assert_eq!(law.trusted(), ["law"]);
    assert!(!law.set_parameter("x", 1.0));
    assert_eq!((2.0 * law.clone() + law.compose(&law)).trusted(), ["law", "law", "law"]);
}

/// The first parameter that is no number is named, and before anything that the law itself would
/// say.
#[test]
fn a_parameter_that_is_not_finite_is_refused_by_its_name() {
    let said = |law: Law| law.refusal().unwrap_or_default();
    assert_eq!(
        said(Law::polynomial(&[1.0, f64::NAN, f64::INFINITY])),
        "c[1] is NaN. Give a finite number"
    );
    assert_eq!(said(Law::linear(f64::NEG_INFINITY, 1.0)), "f0 is -inf. Give a finite number");
    assert_eq!(said(Law::cycloidal(f64::NAN, -1.0)), "height is NaN. Give a finite number");
    assert_eq!(
        said(Law::cycloidal(1.0, -1.0)),
        "cycloidal: the length of a rise must be above zero (length = -1)"
    );
    assert_eq!(said(Law::ramp(1.0)), "");
}

#[test]
fn breaks_are_asked_for_in_either_direction() {
    let law = Law::trapezoidal(2.0, 1.0, 2.0) + Law::harmonic_rise(0.0, 1.0);
    assert_eq!(listed(&law, 2.25, 0.25), [(0.5, 2), (2.0, 2)]);
    assert_eq!(listed(&law, 0.5, 0.5), [(0.5, 2)]);
    for (from, to) in [(0.25, 9.0), (9.0, 0.25)] {
        assert_eq!(law.sharpest_break(from, to), Some(Break { x: 0.5, order: 2 }));
    }
    assert_eq!(law.sharpest_break(3.0, 9.0), None);
}

/// Each derivative may be off by nine digits of its own, and by what rounding of x makes of it;
/// only the first two periods are asked.
#[test]
fn how_much_a_law_that_repeats_may_be_off() {
    const PERIOD: f64 = 4.0;
    // sizes of f to f⁗ in the first period, and what is added in the second
    let off = |sizes: [f64; 5], add: [f64; 4]| {
        let law = own(move |x| {
            let [a, b, c, d] =
                add.map(|add| if (PERIOD..2.0 * PERIOD).contains(&x) { add } else { 0.0 });
            let turn = if (0.0..2.0 * PERIOD).contains(&x) { 1.0 } else { 7.0 };
            let [f, f1, f2, f3, f4] = sizes.map(|size| -turn * size);
            [f + a, f1 + b, f2 + c, f3 + d, f4]
        });
        !law.is_periodic(PERIOD)
    };
    assert!(!off([1.0; 5], [0.0; 4]));
    for k in 0..4 {
        let with = |value: f64| std::array::from_fn(|j| if j == k { value } else { 0.0 });
        // by their own size, others being small
        let sizes = std::array::from_fn(|j| if j == k { 3.0 } else { 1e-3 });
        assert!(
            !off(sizes, with(2.7e-9)) && off(sizes, with(3.6e-9)) && off(sizes, with(f64::NAN)),
            "{k}"
        );
        // by rounding of x, where the next one is large
        let steep = std::array::from_fn(|j| if j == k + 1 { 1e9 } else { 0.0 });
        let allowed = 8.0 * f64::EPSILON * PERIOD * 1e9;
        assert!(!off(steep, with(0.9 * allowed)) && off(steep, with(1.2 * allowed)), "{k}");
        // one that is not known counts for nothing
        let unknown = std::array::from_fn(|j| if j == 4 { f64::NAN } else { 1.0 });
        assert!(!off(unknown, with(0.9e-9)) && off(unknown, with(1.2e-9)), "{k}");
    }
    // Places all over the period are looked at.
    for k in 0..16 {
        let (from, to) = (f64::from(k) * PERIOD / 16.0, f64::from(k + 1) * PERIOD / 16.0);
        let law =
            own(move |x| [if (from..to).contains(&x) { 1.0 } else { 0.0 }, 0.0, 0.0, 0.0, 0.0]);
        assert!(!law.is_periodic(PERIOD), "{k}");
    }
}
