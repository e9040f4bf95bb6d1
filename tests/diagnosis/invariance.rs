//! The verdict does not depend on the unit of length, on the order of declaration, or on where the
//! mechanism stands.

use std::f64::consts::PI;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::plan::*;

/// One mechanism of each verdict.
fn plans() -> Vec<Plan> {
    let motor = |k: usize, angle: f64, rate: f64| Joint::Motor(k, angle, rate);
    vec![
        three_cranks(1.0, &[motor(0, 1.0, 1.0)]),
        three_cranks(1.1, &[motor(0, 1.0, 1.0)]),
        three_cranks(1.0, &[motor(0, 1.0, 1.0), motor(1, 1.0, 1.5)]),
        three_cranks(1.0, &[motor(0, 1.0, 1.0), motor(1, 1.2, 1.0)]),
        three_cranks(1.0, &[]),
        chain(
            &[0.6, 0.9, 1.4],
            None,
            &[motor(0, 0.6, 1.0), motor(1, 0.9, 1.0), motor(0, 0.6, 1.0)],
        ),
        chain(&[0.0, 0.0], Some([2.0, 0.0]), &[]),
        chain(&[0.5, 0.5], Some([1.7, 0.9]), &[]),
        chain(&[0.3, 0.3, 1.2], None, &[motor(0, 0.3, 1.0), motor(1, 0.3, 0.0)]),
        chain(&[0.3, 1.3, 1.2], Some([5.0, 0.0]), &[motor(0, 0.3, 1.0)]),
    ]
}

#[test]
fn every_plan_has_its_verdict() {
    let all: Vec<Vec<String>> = plans()
        .iter()
        .map(|plan| verdict(&plan.mechanism(&View::plain()).diagnose(0.0).unwrap()))
        .collect();
    for (k, verdict) in all.iter().enumerate() {
        println!("{k}: {verdict:#?}");
    }
    let has = |k: usize, text: &str| all[k].iter().any(|line| line.contains(text));
    assert!(
        has(0, "Redundant O3")
            && has(1, "gap at O3 true")
            && has(2, "Velocity motor 2")
            && has(3, "gap at motor 2 true")
    );
    assert!(
        has(4, "Always [\"coupler\", \"crank 1\", \"crank 2\", \"crank 3\"]")
            && has(4, "Redundant")
    );
    assert!(
        has(5, "misleads true") && has(5, "Redundant motor 3") && has(5, "Always [\"link 3\"]")
    );
    assert!(has(6, "Infinitesimal") && has(6, "moves false"));
    assert!(has(8, "Always [\"link 3\"]") && has(9, "gap at "));
}

#[test]
fn every_verdict_reads_back_from_its_file() {
    let folder = std::env::temp_dir().join(format!("kin-diagnoses-{}", std::process::id()));
    for (k, plan) in plans().iter().enumerate() {
        let found = plan.mechanism(&View::plain()).diagnose(0.0).unwrap();
        let file = folder.join(format!("{k}.json"));
        found.write_json(&file).unwrap();
        let read = kin::diagnosis::Diagnosis::read_json(&file).unwrap();
        assert_eq!(read, found);
        assert_eq!(read.to_string(), found.to_string());
    }
    std::fs::remove_dir_all(folder).unwrap();
}

/// The second plan turned by −1.497 rad: at the smallest gap its joints once were called of full
/// rank.
#[test]
fn contradictory_third_crank_keeps_its_mobility_however_it_is_turned() {
    let plan = &plans()[1];
    let plain = verdict(&plan.mechanism(&View::plain()).diagnose(0.0).unwrap());
    for k in -4..5 {
        let view = View { turn: -1.497 + 0.006 * f64::from(k), ..View::plain() };
        let found = plan.mechanism(&view).diagnose(0.0).unwrap();
        assert_eq!(verdict(&found), plain, "turned by {}:\n{found}", view.turn);
    }
}

/// Every plan from many sides; what differs is counted, so that one run shows all.
fn looked_at(cases: usize, mut random: fastrand::Rng) {
    let plans = plans();
    let plain: Vec<Vec<String>> = plans
        .iter()
        .map(|plan| verdict(&plan.mechanism(&View::plain()).diagnose(0.0).unwrap()))
        .collect();
    let mut wrong = Vec::new();
    for case in 0..cases {
        let k = case % plans.len();
        let mut number = |size: f64| size * (2.0 * random.f64() - 1.0);
        let unit = 10.0_f64.powf(number(3.0));
        let turn = number(PI);
        let shift = [number(3.0), number(3.0)];
        let view = View { unit, turn, shift, order: (0..16).map(|_| random.u64(..)).collect() };
        let found = plans[k].mechanism(&view).diagnose(0.0).unwrap();
        if verdict(&found) != plain[k] {
            let text = format!(
                "plan {k} {view:?}: {:?} instead of {:?}\n{found}",
                verdict(&found),
                plain[k]
            );
            println!("{text}");
            wrong.push(text);
        }
    }
    assert!(wrong.is_empty(), "{} of {cases}\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
#[ignore = "takes its time: `cargo test --release -- --ignored`"]
fn verdict_is_the_same_from_thousands_of_sides() {
    looked_at(5_000, fastrand::Rng::with_seed(1));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, max_shrink_iters: 8, rng_seed: RngSeed::Fixed(20240607), ..ProptestConfig::default() })]

    #[test]
    fn verdict_is_the_same_in_other_units_orders_and_places(
        k in 0_usize..10,
        exponent in -3.0_f64..3.0,
        turn in -3.0_f64..3.0,
        shift in prop::array::uniform2(-3.0_f64..3.0),
        order in prop::collection::vec(any::<u64>(), 16),
    ) {
        let plan = &plans()[k];
        let plain = verdict(&plan.mechanism(&View::plain()).diagnose(0.0).unwrap());
        for view in [
            View { unit: 10.0_f64.powf(exponent), order, ..View::plain() },
            View { unit: 10.0_f64.powf(-exponent), turn, shift, ..View::plain() },
        ] {
            let found = plan.mechanism(&view).diagnose(0.0).unwrap();
            prop_assert_eq!(&verdict(&found), &plain, "plan {} {:?}\n{}", k, view, found);
        }
    }
}
