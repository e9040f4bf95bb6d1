//! Faults that once passed in silence: bodies that are assembled far from where they are drawn,
//! handles of other mechanisms, kinks of equations.

use kin::Error;
use kin::prelude::*;
use kin::results::EventKind;

use crate::engines::Engines;

use crate::models::*;

/// y = 0 before the edge, and a slope of 1 beyond it: a step of a cam.      [m]
#[constraint]
fn stepped(x: Coord, y: Coord, edge: f64) -> f64 {
    y - if x > edge { x - edge } else { 0.0 }
}

/// y = |x − c|, or the larger one of that and the floor.      [m]
#[constraint]
fn folded(x: Coord, y: Coord, c: f64, floor: f64) -> f64 {
    y - (x - c).abs().max(floor)
}

/// x = sin t, and y by a constraint.
fn swinging<C: Constraint + 'static>(make: impl FnOnce(Coordinate, Coordinate) -> C) -> System {
    let mut m = Mechanism::new("swinging");
    let x = m.length("x", 0.0).unwrap();
    let y = m.length("y", 0.0).unwrap();
    m.add("x", drive(x, Law::sine(1.0, 1.0, 0.0))).unwrap();
    m.add("y", make(x, y)).unwrap();
    m.build().unwrap()
}

#[test]
fn kinks_of_if_are_events_at_their_times() {
    let motion = swinging(|x, y| stepped(x, y, 0.5)).run_both(linspace(0.0, 3.0, 7)).unwrap();
    let kinks: Vec<_> =
        motion.events().iter().filter(|event| event.kind == EventKind::Kink).collect();
    let exact = [0.5_f64.asin(), PI - 0.5_f64.asin()];
    assert_eq!(kinks.len(), 2, "{:?}", motion.events());
    for (event, exact) in kinks.iter().zip(exact) {
        assert!((event.t - exact).abs() < 1e-4, "{event}");
        assert!(
            event.name == "y"
                && event.text.contains("`x > edge`")
                && event.text.contains("silence.rs:"),
            "{event}"
        );
    }
    assert!(kinks[0].text.contains("becomes true") && kinks[1].text.contains("becomes false"));
    // Backwards they come in the order of the run.
    let back = swinging(|x, y| stepped(x, y, 0.5)).run_both([3.0, 2.0, 1.0, 0.0]).unwrap();
    assert!(back.events().len() == 2 && back.events()[0].t > back.events()[1].t);
    // Beyond reach there is none.
    assert!(
        swinging(|x, y| stepped(x, y, 1.5))
            .run_both(linspace(0.0, 3.0, 7))
            .unwrap()
            .events()
            .is_empty()
    );
}

/// abs takes its other side at x = 0.2, where max holds the floor; max changes at |x − 0.2| = 0.1.
#[test]
fn kinks_of_abs_and_max_are_events_where_they_take_part() {
    let motion = swinging(|x, y| folded(x, y, 0.2, 0.1)).run_both(linspace(0.0, 1.5, 16)).unwrap();
    let times: Vec<f64> = motion.events().iter().map(|event| event.t).collect();
    for exact in [0.1_f64.asin(), 0.2_f64.asin(), 0.3_f64.asin()] {
        assert!(times.iter().any(|t| (t - exact).abs() < 1e-4), "{exact}: {:?}", motion.events());
    }
    assert_eq!(times.len(), 3, "{:?}", motion.events());
}

#[test]
fn summary_tells_how_far_bodies_are_from_where_they_are_drawn() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let motion = m.build().unwrap().run_both([0.0, 0.1]).unwrap();
    let displaced = motion.displaced();
    assert_eq!(displaced.len(), 3, "{displaced:?}");
    // Nearly there: no hint. How far the crank is: its middle is drawn at (0.3, 0.4).
    assert!(displaced.iter().all(|body| body.hint.is_none()), "{displaced:?}");
    let crank = displaced.iter().find(|body| body.name == "crank").unwrap();
    let exact = (0.5 * 1.0_f64.cos() - 0.3).hypot(0.5 * 1.0_f64.sin() - 0.4);
    assert!(
        (crank.moved.unwrap() - exact).abs() < 1e-12 && (crank.turned.unwrap() - 0.1).abs() < 1e-12
    );
    let text = motion.summary();
    assert!(
        text.contains("distance of the first position from the initial guess: `")
            && !text.contains("warning"),
        "{text}"
    );
    // Links by their lengths alone are drawn nowhere.
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(3.0, 1.0))).unwrap();
    let motion = m.build().unwrap().run_both([0.0, 0.1]).unwrap();
    assert!(
        motion.displaced().is_empty() && motion.summary().lines().count() == 1,
        "{}",
        motion.summary()
    );
}

#[test]
fn degrees_for_radians_are_asked_about() {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(98.6, 1.0))).unwrap();
    let text = m.build().unwrap().run_both([0.0, 0.1]).unwrap().summary();
    assert!(
        text.contains("`crank` begins 98.6 rad from its initial guess, which is more than a turn.")
            && text.contains("98.6° is `deg(98.6)`."),
        "{text}"
    );
}

#[test]
fn runs_without_newton_steps_do_not_read_like_faults() {
    let (mut m, [crank, ..]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let text = m.build().unwrap().run_both(linspace(0.0, 1.0, 401)).unwrap().summary();
    assert!(
        text.contains("predictions satisfied the equations at ")
            && !text.contains("0 Newton steps"),
        "{text}"
    );
}

/// A motion knows the bodies of its own mechanism alone, and says so.
#[test]
fn handles_of_other_mechanisms_are_errors() {
    let (mut m, [crank, coupler, _]) = four_bar();
    m.add("motor", drive_angle(crank, Law::linear(1.0, 1.0))).unwrap();
    let system = m.build().unwrap();
    let mut motion = system.run_both([0.0, 0.1]).unwrap();
    let (other, [foreign, ..]) = four_bar();
    let marker = other.marker("tip", foreign, (0.5, 0.5), (1.0, 0.0)).unwrap();
    let mut space = Mechanism::new("space");
    let body = space.spatial("body", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    let refused: Vec<kin::Result<()>> = vec![
        motion.point(foreign, vec2(0.0, 0.0)).map(drop),
        motion.point(body, vec3(0.0, 0.0, 0.0)).map(drop),
        motion.coordinate(foreign.theta()).map(drop),
        motion.marker(&marker).map(drop),
        motion.rotation(body).map(drop),
        motion.relative_angle(coupler, foreign).map(drop),
        motion.transmission_angle(coupler, foreign).map(drop),
        motion.instant_centre(foreign, coupler).map(drop),
        motion.add_point("tip", foreign, vec2(0.0, 0.0)),
        motion.add_marker(&marker),
        motion.add_rotation("body", body),
        system.extremes(&motion, foreign.theta()).map(drop),
        system.crossings(&motion, foreign.theta(), 0.0).map(drop),
        system.measure(&motion, foreign.theta()).map(drop),
    ];
    for (k, result) in refused.into_iter().enumerate() {
        let error = result.expect_err(&format!("{k}"));
        assert!(
            matches!(error, Error::ForeignBody { .. })
                && error.to_string().contains("does not belong to \"four-bar\""),
            "{k}: {error}"
        );
    }
    assert!(motion.outputs().is_empty());
}
