//! Limits of searches and runs are options; what drives is seen.

use std::time::Duration;

use kin::diagnosis::{Change, Resize, Size};
use kin::extend::state::{At, Rates};
use kin::extend::{Entry, Facts};
use kin::prelude::*;
use kin::solver::{AssemblyOptions, SearchOptions};
use kin::{Error, SolverOptions};

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
    for search in [SearchOptions::new().starts(0), SearchOptions::new().steps(0)] {
        let options = SolverOptions::new().search(search.clone());
        assert!(matches!(system.run_both_with([0.0], &options), Err(Error::InvalidOptions { .. })));
        assert!(matches!(
            system.solver().options(options.clone()).position(0.0),
            Err(Error::InvalidOptions { .. })
        ));
        let options = search;
        assert!(matches!(
            system.solver().options(SolverOptions::new().search(options.clone())).diagnose(0.0),
            Err(Error::InvalidOptions { .. })
        ));
    }
    let none = AssemblyOptions::new().starts(0);
    assert!(matches!(
        system.solver().options(SolverOptions::new().assemblies(none.clone())).assemblies(0.0),
        Err(Error::InvalidOptions { .. })
    ));
}

#[test]
fn gaps_tell_how_many_starts_were_tried() {
    let system = out_of_reach();
    let starts = |search: SearchOptions| {
        let found = system
            .solver()
            .options(SolverOptions::new().search(search.clone()))
            .diagnose(0.0)
            .unwrap();
        (found.gaps[0].starts, found.gaps[0].constraint.clone())
    };
    assert_eq!(starts(SearchOptions::default()), (16, "motor".to_string()));
    assert_eq!(starts(SearchOptions::new().starts(3).seed(9)), (3, "motor".to_string()));
    let at_once = SearchOptions::new().time_limit(Some(Duration::ZERO));
    let found = system
        .solver()
        .options(SolverOptions::new().search(at_once.clone()))
        .diagnose(0.0)
        .unwrap();
    assert!(
        !found.can_be_driven() || found.rank < found.coordinates,
        "nothing is claimed that was not looked for: {found}"
    );
    // A good mechanism needs no second start.
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    assert!(
        m.build().unwrap().run_both_with([0.0, 0.1], &SolverOptions::new().search(at_once)).is_ok()
    );
}

#[test]
fn search_for_assemblies_ends_in_time() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let system = m.build().unwrap();
    let options = AssemblyOptions::new().time_limit(Some(Duration::ZERO));
    assert!(
        system
            .solver()
            .options(SolverOptions::new().assemblies(options.clone()))
            .assemblies(0.0)
            .unwrap()
            .len()
            <= 1
    );
    let all = system.assemblies(0.0).unwrap();
    assert_eq!(
        system
            .solver()
            .options(SolverOptions::new().assemblies(AssemblyOptions::default()))
            .assembly(0.0, &all[1].label)
            .unwrap(),
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
    fn arguments(&self) -> Vec<kin::extend::coordinates::Argument> {
        vec![kin::extend::coordinates::Argument {
            name: "b",
            target: kin::extend::Target::Planar(self.0),
        }]
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
