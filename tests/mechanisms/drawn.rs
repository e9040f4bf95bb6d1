//! A mechanism that is drawn in a pose that meets every equation is in that pose, or the error
//! names it.

use kin::Error;
use kin::error::FailureKind;
use kin::prelude::*;

/// A rod with one end on a vertical line and the other one on a circle about (0.5, 0), its middle
/// lifted to a height. Drawn in line with the circle's radius it is exact and singular; cos θ =
/// −1/3 is its other assembly.
fn lift(theta: f64) -> (Mechanism, PlanarBody) {
    let mut m = Mechanism::new("lift");
    let rod = m.planar("rod", pose(theta.cos(), 0.0, theta)).unwrap();
    m.add("left", point_on_line(rod, m.ground(), (-1.0, 0.0), (0.0, 0.0), (0.0, 1.0))).unwrap();
    m.add("right", point_on_circle(rod, m.ground(), (1.0, 0.0), (0.5, 0.0), 1.5)).unwrap();
    m.add("lift", drive(rod.y(), Law::constant(0.0))).unwrap();
    (m, rod)
}

fn is_refused_as_drawn(error: &Error) -> bool {
    matches!(
        error.kind(),
        Some(FailureKind::SingularAt { drawn: true, rank: 2, n: 3, unmet: None, .. })
    )
}

#[test]
fn an_exact_drawn_pose_that_is_singular_is_not_left_in_silence() {
    let system = lift(0.0).0.build().unwrap();
    let error = system.run([0.0, 1.0]).unwrap_err();
    assert!(is_refused_as_drawn(&error), "{error}");
    let text = error.to_string();
    for part in [
        "rank 2",
        "The initial guess is singular",
        "`rod` turns about",
        "satisfies every equation",
        "Let `lift` begin at another value",
        "prefer the assembly",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(is_refused_as_drawn(&system.position(0.0).unwrap_err()));
}

/// The verdict does not depend on other assemblies.
#[test]
fn a_singular_drawn_pose_is_refused_with_or_without_another_assembly() {
    let mut m = Mechanism::new("two bars in line");
    let a = m.link("a", 1.0).unwrap();
    let b = m.link("b", 1.0).unwrap();
    m.add("O", revolute(a, m.ground(), a.start(), (0.0, 0.0))).unwrap();
    m.add("A", revolute(b, a, b.start(), a.end())).unwrap();
    m.add("guide", point_on_line(b, m.ground(), b.end(), (0.0, 0.0), (1.0, 0.0))).unwrap();
    m.add("piston", drive(b.x(), Law::constant(1.5))).unwrap();
    m.guess(a.x(), 0.5).unwrap();
    m.guess(b.x(), 1.5).unwrap();
    let error = m.build().unwrap().run([0.0]).unwrap_err();
    assert!(matches!(error.kind(), Some(FailureKind::SingularAt { drawn: true, .. })), "{error}");
}

#[test]
fn a_preferred_assembly_is_nearer_than_the_drawn_pose_or_refused() {
    let other = (-1.0_f64 / 3.0).acos();
    let begun = |prefer: f64| {
        let (mut m, rod) = lift(0.0);
        m.prefer(rod, prefer);
        m.guess(rod.theta(), 0.0).unwrap();
        m.build().unwrap().position(0.0).map(|found| found.q[2])
    };
    for exact in [other, -other] {
        assert!((begun(exact).unwrap() - exact).abs() < 1e-9);
    }
    // The drawn pose, and what is near it, is refused; no other one is taken.
    let refused = begun(0.0).unwrap_err();
    assert!(
        matches!(refused.kind(), Some(FailureKind::SingularAt { drawn: true, .. })),
        "{refused}"
    );
    let refused = begun(0.05).unwrap_err().to_string();
    assert!(refused.contains("rank 2 here") && refused.contains("change point"), "{refused}");
}

/// A drawing that is not exact is a guess, as ever.
#[test]
fn a_rough_drawing_is_a_guess() {
    let other = (-1.0_f64 / 3.0).acos();
    let found = lift(1.7).0.build().unwrap().position(0.0).unwrap();
    assert!((found.q[2] - other).abs() < 1e-9, "{:?}", found.q);
}
