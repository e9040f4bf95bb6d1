//! The worst of a box of tolerances where the linear stack does not say it: slopes that vanish,
//! extremes inside, corners that do not close, and many dimensions.

use kin::Coordinate;
use kin::design::Tolerance;
use kin::prelude::*;

use crate::engines::Engines;

/// x is where the end of a chain of links is, as angles say that are added up: Σ l cos(Σ q).
fn chain(angles: &[f64], tolerance: f64) -> (System, Coordinate) {
    let mut m = Mechanism::new("chain");
    let x = m.length("x", 0.5 * angles.len() as f64).expect("a coordinate");
    let mut turned: Option<Dimension> = None;
    let mut last = None;
    let mut at = vec2(0.0, 0.0);
    for (k, own) in angles.iter().enumerate() {
        let q = m.dimension(&format!("q{k}"), *own).expect("a dimension").tolerance(tolerance);
        let sum = turned.map_or(q + 0.0, |turned| turned + q);
        turned = Some(sum);
        let link = m.planar(&format!("link{k}"), pose(0.5 * k as f64, 0.0, 0.0)).expect("a body");
        match last {
            None => m.add("O", revolute(link, Ground, (0.0, 0.0), at)).expect("adds"),
            Some(last) => {
                m.add(&format!("O{k}"), revolute(link, last, (0.0, 0.0), at)).expect("adds")
            }
        };
        m.add(&format!("fix{k}"), angle(link, Ground, sum)).expect("adds");
        (last, at) = (Some(link), vec2(0.5, 0.0));
    }
    m.add("tip", tip(last.expect("a link"), x)).expect("adds");
    (m.build().expect("builds"), x)
}

/// x is that of the point (1/2, 0).      [m]
#[constraint]
fn tip(link: Planar, x: Coord) -> f64 {
    link.point(vec2(0.5, 0.0)).x - x
}

fn stack_of(system: &System, x: Coordinate) -> Tolerance {
    let motion = system.run_both([0.0]).expect("a motion");
    system.tolerance_of(&motion, x, 0.0).expect("a tolerance")
}

fn between(found: &Tolerance, [low, high]: [f64; 2], limit: f64) {
    let [a, b] = found.corners.map(|corner| corner.expect("assembled"));
    assert!(
        (a - low).abs() < limit && (b - high).abs() < limit,
        "{a} … {b}, not {low} … {high}\n{found}"
    );
}

#[test]
fn a_worst_case_where_slopes_vanish() {
    let (system, x) = chain(&[0.0], 0.04);
    let found = stack_of(&system, x);
    between(&found, [0.5 * 0.04_f64.cos(), 0.5], 1e-15);
    let text = found.to_string();
    assert!(
        text.starts_with("x (0.5 m at 0 s): -0.0004 to +0 worst case (linear stack ± 0),"),
        "{text}"
    );
    assert!(
        text.contains(
            "the slopes are zero at the nominal dimensions, so the linear stack has no meaning"
        ),
        "{text}"
    );
    assert!(text.contains("Kin checked all 2 corners of the box of tolerances"), "{text}");
    assert!(found.searched.highest.is_empty() && found.searched.lowest[0].by.abs() == 0.04);
}

#[test]
fn an_upper_corner_is_never_below_the_nominal_value() {
    let (system, x) = chain(&[0.0, 0.0], 0.03);
    let found = stack_of(&system, x);
    // Both off to one side; nothing off.
    between(&found, [0.5 * 0.03_f64.cos() + 0.5 * 0.06_f64.cos(), 1.0], 1e-15);
    // An extreme on an edge: the second angle makes good what the first one takes.
    let (system, x) = chain(&[0.02, -0.01], 0.03);
    let found = stack_of(&system, x);
    between(&found, [0.5 * 0.05_f64.cos() + 0.5 * 0.07_f64.cos(), 1.0], 1e-13);
    assert!(found.searched.all_corners && found.searched.corners == 4 && found.searched.inside > 0);
}

/// Two angles of fourteen are worst one way, and all others the other way round: 2¹⁴ corners are
/// not walked.
#[test]
fn many_dimensions_are_searched_with_bounded_effort() {
    let (system, x) = chain(&[0.0; 14], 0.01);
    let found = stack_of(&system, x);
    let low = (1..=14).map(|k| 0.5 * (0.01 * f64::from(k)).cos()).sum();
    between(&found, [low, 7.0], 1e-13);
    let looked = &found.searched;
    assert!(!looked.all_corners && looked.corners + looked.inside <= 600, "{looked:?}");
    let text = found.to_string();
    let said = format!("Kin checked {} corners of the box of 14 tolerances", looked.corners);
    assert!(
        text.contains(&said) && text.ends_with("Corners that Kin did not check may be worse."),
        "{text}"
    );
}

/// x = a b: no slope, no second derivative by one of them alone, and the corners are worst in
/// pairs.
#[constraint]
fn product(x: Coord, a: f64, b: f64) -> f64 {
    x - a * b
}

#[test]
fn corners_are_walked_beyond_those_of_the_signs() {
    let mut m = Mechanism::new("product");
    let a = m.dimension("a", 0.0).expect("a dimension").tolerance(0.1);
    let b = m.dimension("b", 0.0).expect("a dimension").tolerance(0.2);
    let x = m.length("x", 0.0).expect("a coordinate");
    m.add("product", product(x, a, b)).expect("adds");
    let found = stack_of(&m.build().expect("builds"), x);
    between(&found, [-0.02, 0.02], 1e-15);
}

/// x = k0 a + k1 b + k2 a b + k3 a² + k4 b² + k5 a² b + k6 a⁴.
#[constraint]
#[allow(clippy::too_many_arguments)]
fn surface(
    x: Coord,
    a: f64,
    b: f64,
    k0: f64,
    k1: f64,
    k2: f64,
    k3: f64,
    k4: f64,
    k5: f64,
    k6: f64,
) -> f64 {
    x - (k0 * a
        + k1 * b
        + k2 * a * b
        + k3 * a * a
        + k4 * b * b
        + k5 * a * a * b
        + k6 * a * a * a * a)
}

#[test]
fn the_worst_of_surfaces_at_random_is_that_of_a_fine_grid() {
    let mut random = fastrand::Rng::with_seed(5);
    for number in 0..60 {
        let mut k: Vec<f64> = (0..7).map(|_| 2.0 * random.f64() - 1.0).collect();
        // Slopes that are small or none, beside what bends.
        let share = [0.0, 0.01, 0.1, 1.0][number % 4];
        (k[0], k[1]) = (share * k[0], share * k[1]);
        (k[5], k[6]) = (0.1 * k[5], 0.1 * k[6]);
        let mut m = Mechanism::new("surface");
        let a = m.dimension("a", 0.0).expect("a dimension").tolerance(0.1);
        let b = m.dimension("b", 0.0).expect("a dimension").tolerance(0.2);
        let x = m.length("x", 0.0).expect("a coordinate");
        m.add("surface", surface(x, a, b, k[0], k[1], k[2], k[3], k[4], k[5], k[6])).expect("adds");
        let found = stack_of(&m.build().expect("builds"), x);
        let at = |i: i32, j: i32| {
            let a = 0.1 * f64::from(i) / 100.0;
            let b = 0.2 * f64::from(j) / 100.0;
            let bent =
                k[2] * a * b + k[3] * a * a + k[4] * b * b + k[5] * a * a * b + k[6] * a.powi(4);
            k[0] * a + k[1] * b + bent
        };
        let all = (-100..=100).flat_map(|i| (-100..=100).map(move |j| at(i, j)));
        let (low, high) = all.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        let [a, b] = found.corners.map(|corner| corner.expect("assembled"));
        let width = high - low;
        assert!(a <= low + 1e-9 * width && a >= low - 1e-4 * width, "{number}: {a} {low}");
        assert!(b >= high - 1e-9 * width && b <= high + 1e-4 * width, "{number}: {b} {high}");
    }
}

/// A rod that reaches a line unless it is shorter by its tolerance.
#[test]
fn a_box_that_does_not_close_has_no_worst_case_and_names_the_corner() {
    let mut m = Mechanism::new("stretched");
    let b = m.dimension("b", 1.0).expect("a dimension").tolerance(0.02).unit("m");
    let a = m.dimension("a", 1.0).expect("a dimension").tolerance(0.001);
    let crank = m.link("crank", a).expect("a link");
    let rod = m.link("rod", b).expect("a link");
    let slider = m.planar("slider", pose(1.1, 0.99, 0.0)).expect("a body");
    m.add("O", revolute(crank, Ground, crank.start(), (0.0, 0.0))).expect("adds");
    m.add("A", revolute(crank, rod, crank.end(), rod.start())).expect("adds");
    m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0))).expect("adds");
    m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, -0.99), (0.0, 1.0), 0.0))
        .expect("adds");
    m.add("motor", drive_angle(crank, Law::constant(0.0))).expect("adds");
    let system = m.build().expect("builds");
    let motion = system.run_both([0.0]).expect("a motion");
    let found = system.tolerance(&motion, slider.x()).expect("a tolerance");
    assert_eq!((found.corners, found.attained(), found.misled()), ([None, None], None, None));
    let place = found.searched.unassembled.as_ref().expect("a corner");
    assert!(place.iter().any(|off| off.name == "b" && off.by == -0.02), "{place:?}");
    let text = found.to_string();
    let first = text.lines().next().expect("a line");
    assert!(!first.contains("± 0") || !first.contains("worst case ±"), "{first}");
    assert!(
        first.contains("no worst case, because the mechanism cannot be assembled where"),
        "{first}"
    );
    assert!(first.contains("`b` is off by -0.02 m"), "{first}");
}
