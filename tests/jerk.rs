//! The jerk: of every example's mechanism against differences of its accelerations, of redundant
//! and spatial mechanisms, of points, in files.

use kin::SolverOptions;
use kin::data::Registry;
use kin::extend::{Entry, Facts};
use kin::prelude::*;
use kin::results::Solution;

use crate::engines::Engines;

#[path = "data/engines.rs"]
mod engines;
#[path = "data/own.rs"]
mod own;

fn with_jerk() -> SolverOptions {
    SolverOptions::new().jerk(true)
}

/// The largest difference of the jerk at the times from five-point differences of q̈ around them,
/// by the largest number of the jerk. Of two steps, h and 20 h, that counts which fits: near a
/// singular position rounding asks for the longer one.
fn worst(system: &System, times: &[f64], h: f64) -> f64 {
    let motion = system.run_both_with(times, &with_jerk()).expect("runs");
    assert!(motion.has_jerk());
    let mut off = 0.0_f64;
    for (k, t) in times.iter().enumerate() {
        let beside = |s: f64| -> Vec<f64> {
            let near =
                |j: usize| motion.q(k)[j] + s * (motion.qd(k)[j] + 0.5 * s * motion.qdd(k)[j]);
            let near: Vec<f64> = (0..motion.names().len()).map(near).collect();
            let Solution { qdd, .. } = system.solve_at(t + s, &near).expect("solves");
            qdd
        };
        let jerk = motion.qddd(k);
        let size = jerk.iter().chain(motion.qdd(k)).fold(1.0_f64, |m, x| m.max(x.abs()));
        let miss = |h: f64| {
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| beside(s * h));
            let difference = |j: usize| (a[j] - 8.0 * b[j] + 8.0 * c[j] - d[j]) / (12.0 * h);
            jerk.iter()
                .enumerate()
                .fold(0.0_f64, |m, (j, known)| m.max((difference(j) - known).abs() / size))
        };
        off = off.max(miss(h).min(miss(20.0 * h)));
    }
    off
}

/// How long each example runs.   [s]
const SECONDS: [(&str, f64); 27] = [
    ("01_slider_crank", 1.0),
    ("02_two_link_manipulator", 24.0),
    ("03_custom_constraint", 1.0),
    ("04_four_bar", 1.0),
    ("05_quick_return", 1.0),
    ("06_scotch_yoke", 2.0),
    ("07_cam_follower", 2.0),
    ("08_peaucellier", 2.0),
    ("09_jansen_leg", 1.0),
    ("10_drawn_path", 6.0),
    ("11_epicyclic_gears", 8.0),
    ("12_hookes_joint", 4.0),
    ("13_stewart_platform", 8.0),
    ("14_sweep_four_bars", 6.0),
    ("15_windscreen_wiper", 1.0),
    // Short of its first change point.
    ("16_change_points", 0.25),
    ("17_double_wishbone", 8.0),
    ("18_excavator", 12.0),
    ("19_delta_robot", 2.0),
    ("20_geneva_drive", 6.0),
    ("21_cam_with_roller", 2.0),
    ("22_planetary_train", 8.0),
    ("23_press_tolerance", 1.0),
    ("24_toe_tolerance", 4.0),
    ("25_arm_torque", 4.0),
    ("26_engine", 40.0),
    ("27_digging", 9.0),
];

#[test]
fn every_example() {
    let root = env!("CARGO_MANIFEST_DIR");
    let examples =
        std::fs::read_dir(format!("{root}/examples")).expect("readable").filter(|file| {
            let name = file.as_ref().expect("an entry").file_name();
            name.to_string_lossy().starts_with(|first: char| first.is_ascii_digit())
        });
    assert_eq!(
        examples.count(),
        SECONDS.len(),
        "an example without its mechanism here; copy its mechanism.json to tests/data/examples/"
    );
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    for (name, seconds) in SECONDS {
        let mechanism =
            Mechanism::read_json(format!("{root}/tests/data/examples/{name}.json"), &registry)
                .expect("reads back");
        // odd numbers, off the knots of splines and the dwells of cams
        let times: Vec<f64> = (0..=97).map(|k| seconds * (k as f64 + 0.137) / 98.3).collect();
        let off = worst(&mechanism.build().expect("builds"), &times, 1e-5 * seconds);
        println!("{name}: {off:.1e}");
        assert!(off < 1e-8, "{name}: off by {off:.1e}");
    }
}

/// A hand-written constraint that says nothing of the jerk: x² + y² = 1.
#[derive(Clone)]
struct OnUnitCircle(PlanarBody);

impl Constraint for OnUnitCircle {
    fn facts(&self) -> Facts<'_> {
        const FACTS: Facts<'static> = Facts {
            rows: &["1"],
            pattern: &[Entry::new(0, 0), Entry::new(0, 1)],
            ..Facts::of("on_unit_circle")
        };
        FACTS
    }
    fn arguments(&self) -> Vec<kin::extend::coordinates::Argument> {
        vec![kin::extend::coordinates::Argument {
            name: "b",
            target: kin::extend::Target::Planar(self.0),
        }]
    }
    fn residual(&self, at: &kin::extend::state::At<'_>, c: &mut [f64]) {
        let r = at.planar(0).r;
        c[0] = r.x * r.x + r.y * r.y - 1.0;
    }
    fn jacobian(&self, at: &kin::extend::state::At<'_>, c_q: &mut [f64]) {
        let r = at.planar(0).r;
        c_q.copy_from_slice(&[2.0 * r.x, 2.0 * r.y]);
    }
    fn velocity_rhs(&self, _: &kin::extend::state::At<'_>, rhs: &mut [f64]) {
        rhs[0] = 0.0;
    }
    fn acceleration_rhs(
        &self,
        _: &kin::extend::state::At<'_>,
        qd: &kin::extend::state::Rates<'_>,
        _: f64,
        q_d: &mut [f64],
    ) {
        let [x, y] = qd.planar(0).r;
        q_d[0] = -2.0 * (x * x + y * y);
    }
}

#[test]
fn a_constraint_that_does_not_know_it_is_named() {
    let mut m = Mechanism::new("ring");
    let bead = m.planar("bead", pose(1.0, 0.1, 0.0)).unwrap();
    m.add("ring", OnUnitCircle(bead)).unwrap();
    m.add("upright", drive_angle(bead, Law::constant(0.0))).unwrap();
    m.add("motor", drive(bead.y(), Law::sine(0.5, 1.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    assert!(system.run_both([0.0, 0.1]).is_ok());
    let error = system.run_both_with([0.0, 0.1], &with_jerk()).unwrap_err().to_string();
    assert_eq!(
        error,
        "`ring` (on_unit_circle): Kin does not know how to compute the jerk of this constraint. To avoid this error, implement `Constraint::jerk_rhs`, or run without `SolverOptions::jerk`"
    );
}

/// A parallelogram with a third crank: more equations than coordinates.
fn three_cranks() -> System {
    let mut m = Mechanism::new("parallelogram");
    let ground = m.ground();
    let law = Law::ramp(1.0) + Law::sine(0.4, 2.0, 0.3);
    let coupler = m.planar("coupler", pose(0.94, 0.34, 0.0)).unwrap();
    for (k, pivot) in [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(0.8, -0.5)].into_iter().enumerate() {
        let crank = m.link_between(&format!("crank {k}"), pivot, pivot + vec2(0.94, 0.34)).unwrap();
        m.add(&format!("O{k}"), revolute(ground, crank, pivot, crank.start())).unwrap();
        m.add(&format!("A{k}"), revolute(crank, coupler, crank.end(), pivot)).unwrap();
        if k == 0 {
            m.add("motor", drive_angle(crank, law.clone())).unwrap();
        }
    }
    m.build().unwrap()
}

#[test]
fn redundant_equations() {
    let system = three_cranks();
    assert!(system.n_equations() > system.n_coordinates());
    let off = worst(&system, &linspace(0.1, 6.0, 23), 1e-4);
    assert!(off < 1e-8, "{off:.1e}");
}

#[test]
fn a_point_against_differences_of_its_acceleration() {
    let mut m = Mechanism::new("spun plate on a shaft");
    let axis = kin::Axis::along(Vec3::z());
    let shaft = m.spatial("shaft", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    let plate = m.spatial("plate", SpatialPose::at(vec3(0.5, 0.0, 0.0))).unwrap();
    m.add(
        "O",
        spatial::revolute(
            shaft,
            m.ground(),
            vec3(0.0, 0.0, 0.0),
            vec3(0.0, 0.0, 0.0),
            axis,
            Vec3::z(),
        ),
    )
    .unwrap();
    m.add(
        "A",
        spatial::revolute(
            plate,
            shaft,
            vec3(0.0, 0.0, 0.0),
            vec3(0.5, 0.0, 0.0),
            Vec3::x(),
            Vec3::x(),
        ),
    )
    .unwrap();
    m.add(
        "motor",
        spatial::drive_turn(
            shaft,
            m.ground(),
            axis,
            axis,
            Law::ramp(2.0) + Law::sine(0.2, 3.0, 0.0),
        ),
    )
    .unwrap();
    let along = kin::Axis::along(Vec3::x());
    m.add(
        "spin",
        spatial::drive_turn(plate, shaft, along, along, Law::polynomial(&[0.0, 3.0, 0.5])),
    )
    .unwrap();
    let h = 1e-4;
    let times: Vec<f64> = (0..40)
        .flat_map(|k| (-2..=2).map(move |s| 0.3 + 0.1 * k as f64 + h * f64::from(s)))
        .collect();
    let motion = m.build().unwrap().run_both_with(times, &with_jerk()).unwrap();
    let p = motion.point(plate, vec3(0.1, 0.2, -0.3)).unwrap();
    for k in (2..motion.len()).step_by(5) {
        let a = p.a();
        let difference = (a[k - 2] - a[k - 1] * 8.0 + a[k + 1] * 8.0 - a[k + 2]) / (12.0 * h);
        assert!(
            (difference - p.jerk()[k]).norm() < 1e-7 * (1.0 + difference.norm()),
            "{difference:?} {:?}",
            p.jerk()[k]
        );
        assert!(
            (p.jerk_magnitude().values()[k] - p.jerk()[k].norm()).abs()
                < 1e-12 * (1.0 + difference.norm())
        );
    }
    assert_eq!(
        p.components().iter().map(Series::name).collect::<Vec<_>>()[9..],
        ["x'''", "y'''", "z'''"]
    );
}

/// A slider that follows a cubic spline: its jerk is constant between the knots, and at a knot it
/// is that of the part to the right.
#[test]
fn at_a_break_it_is_that_of_the_right() {
    let table = [(0.0, 0.0), (1.0, 0.3), (2.0, -0.1), (3.0, 0.4), (4.0, 0.0)];
    let law = Law::spline(&table, kin::law::Ends::Natural);
    let mut m = Mechanism::new("slider");
    let x = m.length("x", 0.0).unwrap();
    m.add("motor", drive(x, law)).unwrap();
    let motion = m.build().unwrap().run_both_with([0.5, 1.0, 1.5, 2.0, 2.5], &with_jerk()).unwrap();
    let jerk = motion.coordinate(x).unwrap().third_rate;
    let [left, first, middle, second, right] = jerk.values() else { panic!("five times") };
    assert!(
        (first - middle).abs() < 1e-12
            && (second - right).abs() < 1e-12
            && (left - first).abs() > 1.0
    );
    assert_eq!((jerk.name(), jerk.unit()), ("x'''", "m/s^3"));
}

#[test]
fn files_have_it_where_it_was_asked_for() {
    let system = three_cranks();
    let times = linspace(0.0, 1.0, 11);
    let plain = system.run_both(&times).unwrap();
    let motion = system.run_both_with(&times, &with_jerk()).unwrap();
    assert!(
        !plain.has_jerk()
            && plain.qddd(3).is_empty()
            && plain.named("coupler.R_x").unwrap().third_rate.values().is_empty()
    );
    assert!(plain.headers().iter().all(|header| !header.contains("'''")));
    let headers = motion.headers();
    assert_eq!(headers[1 + 3 * system.n_coordinates()], "coupler.R_x''' [m/s^3]");
    assert_eq!(headers.last().map(String::as_str), Some("crank 2.theta''' [rad/s^3]"));
    let text = serde_json::to_string(&motion.data()).unwrap();
    let back = Motion::from_data(&serde_json::from_str(&text).unwrap()).unwrap();
    assert!((0..motion.len()).all(|k| back.qddd(k) == motion.qddd(k)) && back.has_jerk());
    assert!(!serde_json::to_string(&plain.data()).unwrap().contains("qddd"));
    let mut cut = motion.data();
    cut.qddd.pop();
    assert!(Motion::from_data(&cut).unwrap_err().to_string().contains("qddd needs 11 rows"));
}

#[test]
fn sweeps_have_it_too() {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 1.0).unwrap();
    m.add("O", revolute(m.ground(), arm, vec2(0.0, 0.0), arm.start())).unwrap();
    m.add("motor", drive_angle(arm, Law::sine(0.5, 2.0, 0.0))).unwrap();
    let system = m.build().unwrap();
    let cases = [[-0.5], [-0.6], [-0.7]];
    let jerks = system.sweep(["O.u_j.x"]).unwrap().options(with_jerk()).run(
        &cases,
        [0.0, 0.5],
        |_, motion| {
            let motion = motion.unwrap();
            (motion.qddd(1)[2], motion.point(arm, arm.start()).unwrap().jerk().len())
        },
    );
    // θ⃛ = −½ 2³ cos 2t
    assert!(
        jerks
            .unwrap()
            .iter()
            .all(|(jerk, count)| (jerk + 4.0 * 1.0_f64.cos()).abs() < 1e-12 && *count == 2)
    );
}

/// A function of the user's, of which only the dual numbers know derivatives.
fn bump<D: kin::extend::Dual>(x: kin::extend::Real<D>) -> kin::extend::Real<D> {
    (-(x * x)).exp() * x.sin()
}

/// The user's function inside a symbolic equation.      [m]
#[constraint(symbolic)]
fn on_bump(b: Planar, k: f64, t: Time) -> f64 {
    b.r.y - k * bump(b.r.x) * (1.0 + 0.1 * t)
}

/// A body that only runs on dual numbers: Σ (k x)ⁿ / n! up to a bound that is a parameter.      [m]
#[constraint(dual)]
fn on_series(b: Planar, k: f64, terms: usize) -> f64 {
    let mut sum = 1.0;
    let mut term = 1.0;
    let mut n = 1.0;
    while n < terms as f64 {
        term = term * k * b.r.x / n;
        sum = sum + term;
        n += 1.0;
    }
    b.r.y - sum
}

#[test]
fn users_functions_and_the_dual_route() {
    for which in 0..2 {
        let mut m = Mechanism::new("bead");
        let bead = m.planar("bead", pose(0.1, 0.5, 0.0)).unwrap();
        if which == 0 {
            m.add("wire", on_bump(bead, 0.7)).unwrap();
        } else {
            m.add("wire", on_series(bead, 0.9, 12)).unwrap();
        }
        m.add("upright", drive_angle(bead, Law::constant(0.0))).unwrap();
        m.add("motor", drive(bead.x(), Law::sine(1.1, 1.3, 0.2))).unwrap();
        let off = worst(&m.build().unwrap(), &linspace(0.05, 4.0, 33), 1e-4);
        assert!(off < 1e-8, "{which}: {off:.1e}");
    }
}

/// y is a step of x, steep and smooth.      [m]
#[constraint]
fn logistic(x: Coord, y: Coord, steep: f64) -> f64 {
    y - 1.0 / (1.0 + (-steep * x).exp())
}

/// The same with another number behind the exponential.      [m]
#[constraint]
fn soft_minimum(x: Coord, y: Coord, steep: f64) -> f64 {
    y + ((-steep * x).exp() + (steep * x).exp()).ln() / steep
}

/// The tangents of the exponential are too large for a number before it is itself.
#[test]
fn the_jerk_of_a_steep_step_is_a_number_wherever_it_is_smooth() {
    let speed = 1.0;
    let steep = 800.0;
    // Of the minimum the exponential itself must be a number, its third derivative is none.
    let begin = |is_step: bool| if is_step { -1.0 } else { -0.885 };
    let built = |is_step: bool| {
        let from = begin(is_step);
        let mut m = Mechanism::new("step");
        let x = m.length("x", from).unwrap();
        let y = m.length("y", if is_step { 0.0 } else { from }).unwrap();
        m.add("drive", drive(x, Law::linear(from, speed))).unwrap();
        match is_step {
            true => m.add("step", logistic(x, y, steep)).unwrap(),
            false => m.add("step", soft_minimum(x, y, steep)).unwrap(),
        };
        m.build().unwrap()
    };
    for is_step in [true, false] {
        let from = begin(is_step);
        let times = linspace(0.0, -2.0 * from, 4001);
        let by = |engine| {
            built(is_step).solver().options(with_jerk().engine(engine)).run(&times).unwrap()
        };
        let motions = [kin::Engine::StepByStep, kin::Engine::Compiled].map(by);
        for (motion, k) in
            motions.iter().flat_map(|motion| (0..motion.len()).map(move |k| (motion, k)))
        {
            let x = from + speed * times[k];
            // s (1 − s) is symmetric, and small where s is nearly 0 or 1.
            let e = (-steep * x.abs()).exp();
            let s = 1.0 / (1.0 + e);
            let exact = if is_step {
                let d = e * s * s;
                steep.powi(3) * d * (1.0 - 6.0 * d)
            } else {
                // −ln(2 cosh u)/c, u = c x: its third derivative is 2 c² sech² u tanh u.
                let square = (2.0 * e / (1.0 + e * e)).powi(2);
                2.0 * steep.powi(2) * square * (steep * x).tanh()
            };
            let found = motion.qddd(k)[1];
            assert!(
                (found - exact).abs() <= 1e-6 * exact.abs() + 1e-9 * steep.powi(2),
                "{x}: {found} {exact}"
            );
        }
    }
}
