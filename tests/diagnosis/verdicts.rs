//! One cut for ranks; redundant equations of ordinary accuracy; turns that nothing depends on; what
//! can be asked where `build` refuses.

use kin::diagnosis::{Change, Diagnosis, Elsewhere};
use kin::joints::drivers::spatial as drivers;
use kin::prelude::*;
use kin::{Error, SolverOptions, System};

use crate::engines::Engines;

use crate::models::*;

/// Two bars between pins that are just as far apart as the bars are long together, seen from
/// anywhere.
fn two_bars(a: f64, b: f64, unit: f64, turn: f64) -> Mechanism {
    let mut m = Mechanism::new("two bars");
    let left = m.link("left", a * unit).unwrap();
    let right = m.link("right", b * unit).unwrap();
    let along = |r: f64| vec2(r * unit * turn.cos(), r * unit * turn.sin());
    let p = along(0.5 * a);
    let q = along(a + 0.5 * b);
    m.set_pose(left, pose(p.x, p.y, turn)).unwrap();
    m.set_pose(right, pose(q.x, q.y, turn)).unwrap();
    m.add("A", revolute(m.ground(), left, vec2(0.0, 0.0), left.start())).unwrap();
    m.add("B", revolute(left, right, left.end(), right.start())).unwrap();
    m.add("C", revolute(m.ground(), right, along(a + b), right.end())).unwrap();
    m
}

/// A parallelogram of two cranks whose crank is driven to this angle.
fn flat(angle: f64, offset: f64) -> Mechanism {
    let mut m = Mechanism::new("parallelogram");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 2.0), ("rocker", 1.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    let (s, c) = (angle + offset).sin_cos();
    m.set_pose(crank, pose(0.5 * c, 0.5 * s, angle + offset)).unwrap();
    m.set_pose(coupler, pose(1.0 + c, s, 0.0)).unwrap();
    m.set_pose(rocker, pose(2.0 + 0.5 * c, 0.5 * s, angle + offset)).unwrap();
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(2.0, 0.0), rocker.start())).unwrap();
    m.add("motor", drive_angle(crank, Law::linear(angle + offset, 1.0))).unwrap();
    m
}

/// True if a pose, the one that a diagnosis looks at, can be driven; diagnosis and solver have to
/// agree on it.
fn agreed(system: &System) -> bool {
    let found = system.diagnose(0.0).unwrap();
    let solved = system.solve_at(0.0, &found.q);
    assert_eq!(found.can_be_driven(), solved.is_ok(), "{found}\n{solved:?}");
    found.can_be_driven()
}

#[test]
fn solver_and_diagnosis_have_one_cut_for_ranks() {
    for (a, b, unit, turn) in [
        (0.2, 0.3, 1.0, 0.0),
        (0.2, 0.3, 1000.0, 0.7),
        (1.0, 1.0, 1e-3, -2.0),
        (0.35, 3.0, 1.0, 0.4),
    ] {
        assert!(!agreed(&two_bars(a, b, unit, turn).build().unwrap()), "{a} {b} {unit} {turn}");
    }
    for angle in [0.0, PI] {
        // At 1e-7 itself, where the two branches are as near to one another as the cut, either may
        // be found.
        for exponent in [3, 6, 8, 10] {
            let regular = agreed(&flat(angle, 10.0_f64.powi(-exponent)).build().unwrap());
            assert_eq!(regular, exponent < 7, "{angle} {exponent}");
        }
    }
}

/// A scissor lift, one of whose links is put together on top of the other: then both guides of its
/// table hold the same, and it turns freely.
#[test]
fn a_coordinate_that_only_rounding_holds_is_free() {
    let mut m = Mechanism::new("lift");
    let a = m.link_between("a", vec2(0.0, 0.0), vec2(1.0, 0.8)).unwrap();
    let b = m.link("b", 1.64_f64.sqrt()).unwrap();
    let g = m.ground();
    let table = m.planar("table", pose(0.0, 0.8, 0.0)).unwrap();
    let o = vec2(0.0, 0.0);
    let along = vec2(1.0, 0.0);
    m.add("foot a", revolute(a, g, a.start(), o)).unwrap();
    m.add("cross", revolute(a, b, o, o)).unwrap();
    m.add("top b", revolute(b, table, b.end(), o)).unwrap();
    m.add("roller b", point_on_line(b, g, b.start(), vec2(1.0, 0.0), along)).unwrap();
    m.add("roller a", point_on_line(a, table, a.end(), o, along)).unwrap();
    m.add("motor", drive_angle(a, Law::linear(0.6, 0.2))).unwrap();
    let system: System = m.build().unwrap();
    // Of the pose beside the guess all say so; assembly finds the other one, of a lift that is one.
    let found = system.diagnose(0.0).unwrap();
    assert!(found.rank == 8 && found.to_string().contains("`table`"), "{found}");
    assert!(!agreed(&system));
    let lift = system.position(0.0).unwrap();
    assert!(
        lift.report.smallest_pivot > 0.1 && (lift.q[5] + 0.6 + PI).sin().abs() < 1e-12,
        "{lift:?}"
    );
    assert!((lift.qd[7] - 0.2 * 1.64_f64.sqrt() * 0.6_f64.cos()).abs() < 1e-12, "{lift:?}");
}

/// Two bars in line, and a parallelogram at its change point: the refusal of a position carries the
/// verdict of the diagnosis.
#[test]
fn refusal_and_diagnosis_tell_the_same_rank() {
    for (system, rank) in
        [(two_bars(0.2, 0.3, 1.0, 0.0).build().unwrap(), 5), (flat(PI, 0.0).build().unwrap(), 8)]
    {
        let found = system.diagnose(0.0).unwrap();
        let error = system.position(0.0).unwrap_err();
        let told = error.diagnosis().unwrap();
        assert!(
            !found.can_be_driven() && (found.rank, told.rank) == (rank, rank),
            "{found}\n{told}"
        );
    }
}

/// A pole of an angle at the guess made every row look small that came after it.
#[test]
fn guess_at_the_pole_of_an_angle_does_no_harm() {
    let o = vec3(0.0, 0.0, 0.0);
    let y = vec3(0.0, 1.0, 0.0);
    let mut m = Mechanism::new("wheel");
    let wheel = m
        .spatial("wheel", SpatialPose::turned(vec3(0.0, 2.0, 0.0), vec3(1.0, 0.0, 0.0), PI / 2.0))
        .unwrap();
    m.add("hinge", spatial::revolute(wheel, m.ground(), o, vec3(0.0, 2.0, 0.0), y, y)).unwrap();
    m.add("motor", drivers::drive_turn(wheel, m.ground(), y, y, Law::ramp(0.5))).unwrap();
    assert!(agreed(&m.build().unwrap()));
}

#[test]
fn singular_start_says_where_to_begin() {
    let found = flat(0.0, 0.0).diagnose(0.0).unwrap();
    let Some(Elsewhere::Time(t)) = found.elsewhere else { panic!("{found}") };
    assert!(found.to_string().contains(&format!("Begin at t = {t} s")), "{found}");
    assert!(flat(0.0, 0.0).build().unwrap().run_both([t, t + 0.1]).is_ok());
    // A motor that stands still: another value of it.
    let mut m = Mechanism::new("parallelogram");
    let [crank, coupler, rocker] = [("crank", 1.0), ("coupler", 2.0), ("rocker", 1.0)]
        .map(|(name, length)| m.link(name, length).unwrap());
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(2.0, 0.0), rocker.start())).unwrap();
    m.set_pose(coupler, pose(2.0, 0.0, 0.0)).unwrap();
    m.set_pose(rocker, pose(2.5, 0.0, 0.0)).unwrap();
    m.set_pose(crank, pose(0.5, 0.0, 0.0)).unwrap();
    let with = |value: f64| {
        let mut m = m.clone();
        m.add("motor", drive_angle(crank, Law::constant(value))).unwrap();
        m
    };
    let found = with(0.0).diagnose(0.0).unwrap();
    let Some(Elsewhere::Drive { constraint, asks }) = &found.elsewhere else { panic!("{found}") };
    assert_eq!((constraint.as_str(), asks.coordinate.as_str()), ("motor", "crank.theta"));
    assert!(with(asks.stands).build().unwrap().position(0.0).is_ok(), "{found}");
}

/// The share that a refusal advises to allow.
fn advised(found: &Diagnosis) -> f64 {
    let allow = found.changes.iter().find_map(|change| {
        if let Change::Allow { misfit } = change { Some(*misfit) } else { None }
    });
    allow.unwrap_or_else(|| panic!("{found}"))
}

#[test]
fn third_rod_of_ordinary_accuracy_is_allowed_on_request() {
    for off in [1e-9, 5e-9, 3e-7] {
        let mut p = parallelogram(1.0 + off, 1.0);
        p.mechanism.add("motor", drive_angle(p.cranks[0], Law::linear(1.0, 2.0))).unwrap();
        let system = p.mechanism.build().unwrap();
        let times = linspace(0.0, 7.0, 301);
        let error = system.run_both(&times).unwrap_err();
        let closure = advised(error.diagnosis().unwrap());
        assert!(closure > off / 3.0 && closure < 10.0 * off, "{closure} for {off}");
        assert!(
            error
                .to_string()
                .contains(&format!("SolverOptions::new().allowed_misfit({closure:e})")),
            "{error}"
        );
        let motion =
            system.run_both_with(&times, &SolverOptions::new().allowed_misfit(closure)).unwrap();
        assert!(
            motion.misfit() > 0.01 * off && motion.misfit() <= closure,
            "{} for {off}",
            motion.misfit()
        );
        assert!(
            motion.summary().contains("allowed contradiction of the equations"),
            "{}",
            motion.summary()
        );
        let x = motion.named("coupler.R_x").unwrap();
        let exact = times.iter().map(|t| (1.0 + 2.0 * t).cos());
        assert!(x.value.values().iter().zip(exact).all(|(x, exact)| (x - exact).abs() < 2.0 * off));
        // The half of it is too little, and so is what is allowed without being asked.
        assert!(
            system
                .run_both_with(&times, &SolverOptions::new().allowed_misfit(0.05 * closure))
                .is_err()
        );
    }
    assert!(matches!(
        parallelogram(1.0, 1.0).mechanism.diagnose(0.0).and_then(|_| flat(1.0, 0.0)
            .build()?
            .run_both_with([0.0], &SolverOptions::new().allowed_misfit(-1.0))),
        Err(Error::InvalidOptions { .. })
    ));
}

/// A door of three hinges as they come out of a file: off by five nanometres, each in another way.
#[test]
fn imported_assembly_is_allowed_on_request() {
    let z = vec3(0.0, 0.0, 1.0);
    let mut m = Mechanism::new("door");
    let door = m.spatial("door", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    for (k, off) in [vec3(0.0, 0.0, 0.0), vec3(5e-9, -2e-9, 3e-9), vec3(-1e-9, 4e-9, -5e-9)]
        .into_iter()
        .enumerate()
    {
        let at = z * (0.8 * k as f64);
        m.add(
            &format!("hinge {k}"),
            spatial::revolute(door, m.ground(), at, at + off, z + off * 0.3, z),
        )
        .unwrap();
    }
    m.add("motor", drivers::drive_turn(door, m.ground(), z, z, Law::ramp(1.0))).unwrap();
    let system = m.build().unwrap();
    let closure = advised(system.run_both([0.0, 0.1]).unwrap_err().diagnosis().unwrap());
    let motion = system
        .run_both_with(linspace(0.0, 6.0, 61), &SolverOptions::new().allowed_misfit(closure))
        .unwrap();
    assert!(motion.misfit() > 1e-10 && motion.misfit() < 2e-8, "{}", motion.misfit());
    assert!(system.run_both(linspace(0.0, 6.0, 61)).is_err());
}

#[test]
fn idle_turn_of_a_rod_is_held_on_request() {
    let o = vec3(0.0, 0.0, 0.0);
    let x = vec3(1.0, 0.0, 0.0);
    let z = vec3(0.0, 0.0, 1.0);
    let make = |rod: bool| {
        let mut m = Mechanism::new("two cranks");
        let crank = m.spatial("crank", SpatialPose::at(o)).unwrap();
        let rocker = m.spatial("rocker", SpatialPose::at(vec3(3.0, 0.0, -0.5))).unwrap();
        m.add("O", spatial::revolute(crank, m.ground(), o, o, z, z)).unwrap();
        m.add("C", spatial::revolute(rocker, m.ground(), o, vec3(3.0, 0.0, -0.5), x, x)).unwrap();
        m.add("motor", drivers::drive_turn(crank, m.ground(), z, z, Law::sine(0.6, 1.0, 0.0)))
            .unwrap();
        let end = vec3(0.0, 1.5, 2.2);
        if rod {
            let rod = m.spatial_link_between("rod", (1.0, 0.0, 0.0), (3.0, 1.5, 1.7)).unwrap();
            m.add("A", spatial::spherical(crank, rod, x, rod.start())).unwrap();
            m.add("B", spatial::spherical(rod, rocker, rod.end(), end)).unwrap();
        } else {
            let length = vec3(2.0, 1.5, 1.7).norm();
            m.add("rod", spatial::distance(crank, rocker, x, end, length)).unwrap();
        }
        (m, rocker)
    };
    let (mut with_rod, rocker) = make(true);
    let error = with_rod.clone().build().unwrap_err();
    let found = error.diagnosis().unwrap();
    assert!(
        matches!(&found.changes[..], [Change::HoldIdle { bodies }] if bodies == &["rod"]),
        "{found}"
    );
    let text = error.to_string();
    assert!(text.contains("`m.hold_idle_turns()`") && text.contains("`distance`"), "{text}");
    assert_eq!(with_rod.hold_idle_turns().unwrap(), ["rod"]);
    assert!(with_rod.hold_idle_turns().unwrap().is_empty());
    // The rest moves as with a rod without mass in its place.
    let times = linspace(0.0, 6.2, 101);
    let motion = with_rod.build().unwrap().run_both(&times).unwrap();
    let (plain, other) = make(false);
    let plain = plain.build().unwrap().run_both(&times).unwrap();
    let tip =
        |motion: &Motion, rocker: SpatialBody| motion.point(rocker, vec3(0.0, 1.5, 2.2)).unwrap();
    let a = tip(&motion, rocker);
    let b = tip(&plain, other);
    for k in 0..times.len() {
        assert!((a.r()[k] - b.r()[k]).norm() < 1e-9 && (a.a()[k] - b.a()[k]).norm() < 1e-7, "{k}");
    }
}

/// A door that has no motor turns, but not idly.
#[test]
fn turn_of_a_hinge_is_not_idle() {
    let z = vec3(0.0, 0.0, 1.0);
    let mut m = Mechanism::new("door");
    let part = m.spatial("Part2", SpatialPose::at(vec3(0.0, 0.0, 0.0))).unwrap();
    m.add(
        "hinge",
        spatial::revolute(part, m.ground(), vec3(0.5, 0.0, 0.0), vec3(0.0, 0.0, 0.0), z, z),
    )
    .unwrap();
    let found = m.diagnose(0.0).unwrap();
    assert!(!found.freedoms[0].idle && m.hold_idle_turns().unwrap().is_empty());
    assert!(found.to_string().contains("Drive or hold the rotation of `Part2`"), "{found}");
}

#[test]
fn advice_names_the_turn_of_a_planar_body_too() {
    let mut m = Mechanism::new("flap");
    let flap = m.planar("Part2", pose(0.4, 0.1, 0.3)).unwrap();
    m.add("hinge", revolute(flap, m.ground(), vec2(-0.4, 0.0), vec2(0.0, 0.0))).unwrap();
    let found = m.diagnose(0.0).unwrap();
    assert!(found.to_string().contains("Drive or hold `Part2.theta`"), "{found}");
}

/// A mechanism that is refused can be asked, at the guess and at any pose, and a copy changed.
#[test]
fn mechanism_that_cannot_be_built_can_be_asked() {
    let (m, [crank, ..]) = four_bar();
    assert!(m.clone().build().is_err());
    assert_eq!(m.diagnose(0.0).unwrap().lasting_freedoms().count(), 1);
    let q = m.diagnose(0.0).unwrap().q;
    let found = m.diagnose((0.0, &q)).unwrap();
    assert!(found.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9) && found.rank == 8);
    assert!(matches!(m.diagnose((0.0, &q[1..])), Err(Error::WrongLength { .. })));
    let mut driven = m.clone();
    let motor: Box<dyn Constraint> = Box::new(drive_angle(crank, Law::linear(1.0, 1.0)));
    driven.add("motor", motor).unwrap();
    assert!(driven.build().unwrap().run_both([0.0, 0.1]).is_ok());
    assert!(m.diagnose(0.0).unwrap().drivers == 0);
}

/// Two guides written with a `while` over a parameter, which only dual numbers run.      [m]
#[constraint]
fn guides(i: Planar, u: Vec2) -> (Vec2, f64) {
    let mut k = 0;
    let mut guide2 = i.point(u);
    while f64::from(k) < 2.0 * u.x {
        guide2 = guide2 - u;
        k += 1;
    }
    let turn = i.theta;
    (guide2, turn)
}

#[test]
fn rows_keep_their_names_on_the_dual_route() {
    let mut m = Mechanism::new("block");
    let block = m.planar("block", pose(0.1, 0.2, 0.3)).unwrap();
    let constraint = guides(block, vec2(0.4, 0.0));
    assert_eq!(constraint.route(), Route::Dual);
    m.add("guide", constraint).unwrap();
    m.add("again", drive(block.x(), Law::constant(0.0))).unwrap();
    let system = m.build().unwrap();
    assert_eq!(
        system.equation_names(),
        ["guide.guide2.x", "guide.guide2.y", "guide.turn", "again"]
    );
}

#[test]
fn body_is_named_whose_name_is_taken() {
    let mut m = Mechanism::new("two");
    m.link("crank", 1.0).unwrap();
    assert_eq!(
        m.link("crank", 2.0).unwrap_err().to_string(),
        "two bodies or coordinates have the name `crank`. Give the two bodies or coordinates different names"
    );
}
