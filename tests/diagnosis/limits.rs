//! Limits of searches and runs are options; what drives is seen.

use std::time::Duration;

use kin::diagnosis::{Change, DiagnosisOptions, Resize, Size};
use kin::prelude::*;
use kin::state::{At, Rates};
use kin::{AssemblyOptions, Entry, Error, Facts, Options, SearchOptions};

use crate::engines::Engines;
use crate::models::*;

/// The four-bar with a motor that asks for what cannot be reached.
fn out_of_reach() -> System {
    let (mut m, [_, _, rocker]) = four_bar();
    m.add("motor", drive_angle(rocker, Law::constant(0.3))).unwrap();
    m.build().unwrap()
}

#[test]
fn limits_of_zero_are_refused() {
    let system = out_of_reach();
    for search in [
        SearchOptions { starts: 0, ..SearchOptions::default() },
        SearchOptions { steps: 0, ..SearchOptions::default() },
    ] {
        let options = Options { search: search.clone(), ..Options::default() };
        assert!(matches!(system.run_both_with([0.0], &options), Err(Error::InvalidOptions { .. })));
        assert!(matches!(system.position_with(0.0, &options), Err(Error::InvalidOptions { .. })));
        let options = DiagnosisOptions { search, ..DiagnosisOptions::default() };
        assert!(matches!(system.diagnose_with(0.0, &options), Err(Error::InvalidOptions { .. })));
    }
    let none = AssemblyOptions { starts: 0, ..AssemblyOptions::default() };
    assert!(matches!(system.assemblies_with(0.0, &none), Err(Error::InvalidOptions { .. })));
}

#[test]
fn gaps_tell_how_many_starts_were_tried() {
    let system = out_of_reach();
    let starts = |search: SearchOptions| {
        let found = system
            .diagnose_with(0.0, &DiagnosisOptions { search, ..DiagnosisOptions::default() })
            .unwrap();
        (found.gaps[0].starts, found.gaps[0].constraint.clone())
    };
    assert_eq!(starts(SearchOptions::default()), (16, "motor".to_string()));
    assert_eq!(
        starts(SearchOptions { starts: 3, seed: 9, ..SearchOptions::default() }),
        (3, "motor".to_string())
    );
    let at_once = SearchOptions { time_limit: Some(Duration::ZERO), ..SearchOptions::default() };
    let found = system
        .diagnose_with(
            0.0,
            &DiagnosisOptions { search: at_once.clone(), ..DiagnosisOptions::default() },
        )
        .unwrap();
    assert!(
        !found.can_be_driven() || found.rank < found.coordinates,
        "nothing is claimed that was not looked for: {found}"
    );
    // A good mechanism needs no second start.
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    assert!(
        m.build()
            .unwrap()
            .run_both_with([0.0, 0.1], &Options { search: at_once, ..Options::default() })
            .is_ok()
    );
}

#[test]
fn search_for_assemblies_ends_in_time() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let system = m.build().unwrap();
    let options =
        AssemblyOptions { time_limit: Some(Duration::ZERO), ..AssemblyOptions::default() };
    assert!(system.assemblies_with(0.0, &options).unwrap().len() <= 1);
    let all = system.assemblies(0.0).unwrap();
    assert_eq!(
        system.assembly_with(0.0, &all[1].label, &AssemblyOptions::default()).unwrap(),
        all[1]
    );
}

/// A motor written by hand that says nothing of itself: θ = t.
#[derive(Clone)]
struct Motor(PlanarBody);

impl Constraint for Motor {
    fn facts(&self) -> Facts<'_> {
        const FACTS: Facts<'static> =
            Facts { rows: &["1"], pattern: &[Entry::new(0, 2)], ..Facts::of("motor") };
        FACTS
    }
    fn arguments(&self) -> Vec<kin::coordinates::Argument> {
        vec![kin::coordinates::Argument { name: "b", target: kin::Target::Planar(self.0) }]
    }
    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        c[0] = at.planar(0).theta - 1.0 - at.t;
    }
    fn jacobian(&self, _: &At<'_>, c_q: &mut [f64]) {
        c_q[0] = 1.0;
    }
    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = 1.0;
    }
    fn acceleration_rhs(&self, _: &At<'_>, _: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d[0] = 0.0;
    }
}

#[test]
fn hand_written_motor_counts_as_a_driver() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", Motor(crank.into())).unwrap();
    let found = m.build().unwrap().diagnose(0.0).unwrap();
    assert_eq!((found.drivers, found.gruebler, found.mobility), (1, 1, 1));
}

/// Three cranks of which the third is 0.1 too long: its length is what does not fit, and no other.
#[test]
fn joint_that_cannot_be_met_asks_for_another_dimension() {
    let mut p = parallelogram(1.1, 1.0);
    p.mechanism.add("motor", drive_angle(p.cranks[0], Law::linear(1.0, 1.0))).unwrap();
    let found = p.mechanism.diagnose(0.0).unwrap();
    let [Change::Resize { any }] = &found.changes[..] else { panic!("{found}") };
    let [Resize { of: Size::Length { body }, is, fits, exact, .. }] = &any[..] else {
        panic!("{found}")
    };
    assert!(body == "crank 3" && is == &[1.1] && (fits[0] - 1.0).abs() < 1e-9 && *exact, "{found}");
    assert!((found.gaps[0].size() - 0.1).abs() < 1e-6, "{found}");
    assert_eq!(found.mobility, 1);
}
