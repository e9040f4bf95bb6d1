//! The table of all laws, and what holds for each of them.

use kin::check;
use kin::law::Break;
use kin::prelude::*;

use crate::engines::Engines;

use crate::hermite;

/// A law by the name of its constructor, and the part of it that is looked at.
pub struct Line {
    pub name: &'static str,
    pub law: Law,
    pub from: f64,
    pub to: f64,
}

fn line(name: &'static str, law: Law, from: f64, to: f64) -> Line {
    Line { name, law, from, to }
}

/// A bump of one's own.
#[law]
#[require(width > 0.0, "a bump needs a width")]
fn bump(x: f64, height: f64, width: f64) -> f64 {
    height * (-(x / width).powi(2)).exp()
}

fn wave() -> Vec<(f64, f64)> {
    vec![(0.0, 1.0), (0.5, 1.8), (1.25, 0.2), (2.0, -0.7), (3.5, 0.4), (4.0, 1.0)]
}

pub fn all() -> Vec<Line> {
    let up = Law::cycloidal(0.5, 1.0);
    let down = Law::constant(0.5) - Law::polynomial_345(0.5, 1.5);
    vec![
        line("constant", Law::constant(-3.0), -2.0, 2.0),
        line("ramp", Law::ramp(2.5), -2.0, 2.0),
        line("linear", Law::linear(0.4, -1.5), -2.0, 2.0),
        line("polynomial", Law::polynomial(&[1.0, -2.0, 0.5, 3.0, -0.25]), -2.0, 2.0),
        line("harmonic", Law::harmonic(0.3, 0.05), -4.0, 4.0),
        line("sine", Law::sine(2.0, 3.0, 0.5), -2.0, 2.0),
        line(
            "fourier",
            Law::fourier(0.5, 2.0, &[(0.3, -0.2), (0.0, 0.1), (0.05, 0.02)]),
            -2.0,
            2.0,
        ),
        line("harmonic_rise", Law::harmonic_rise(0.8, 1.5), -0.4, 2.0),
        line("cycloidal", Law::cycloidal(0.8, 1.5), -0.4, 2.0),
        line("polynomial_345", Law::polynomial_345(-0.8, 1.5), -0.4, 2.0),
        line("polynomial_4567", Law::polynomial_4567(0.8, 1.5), -0.4, 2.0),
        line("modified_sine", Law::modified_sine(0.8, 1.5), -0.4, 2.0),
        line("modified_trapezoid", Law::modified_trapezoid(0.8, 1.5), -0.4, 2.0),
        line("trapezoidal", Law::trapezoidal(2.0, 1.0, 2.0), -0.5, 3.5),
        line("trapezoidal", Law::trapezoidal(-0.3, 1.0, 2.0), -0.5, 1.5),
        line("s_curve", Law::s_curve(2.0, 1.0, 2.0, 8.0), -0.5, 4.0),
        line("s_curve", Law::s_curve(0.8, 2.0, 1.0, 8.0), -0.5, 3.0),
        line("s_curve", Law::s_curve(-0.05, 2.0, 2.0, 8.0), -0.1, 1.2),
        line("spline", Law::spline(&wave(), Ends::Natural), -1.0, 5.0),
        line("spline", Law::spline(&wave(), Ends::Clamped { start: -1.0, end: 2.0 }), -1.0, 5.0),
        line("spline", Law::spline(&wave(), Ends::Periodic), -5.0, 9.0),
        line("quintic_spline", Law::quintic_spline(&wave(), Ends::Natural), -1.0, 5.0),
        line(
            "quintic_spline",
            Law::quintic_spline(&wave(), Ends::Clamped { start: -1.0, end: 2.0 }),
            -1.0,
            5.0,
        ),
        line("quintic_spline", Law::quintic_spline(&wave(), Ends::Periodic), -5.0, 9.0),
        line(
            "sequence",
            Law::sequence(
                0.25,
                [(1.0, up.clone()), (0.5, Law::constant(0.5)), (1.5, down.clone())],
            ),
            -0.5,
            4.0,
        ),
        line(
            "periodic",
            Law::sequence(0.0, [(1.0, up), (1.5, down), (0.5, Law::constant(0.0))]).periodic(3.0),
            -4.0,
            8.0,
        ),
        line(
            "compose",
            Law::trapezoidal(2.0, 1.0, 2.0).compose(&Law::sine(3.0, 1.0, 0.0)),
            -2.0,
            4.0,
        ),
        line("shifted", Law::cycloidal(1.0, 1.0).shifted(0.5), -1.0, 3.0),
        line(
            "sum",
            2.0 * (Law::harmonic(0.3, 0.05) + Law::trapezoidal(1.0, 1.0, 1.0))
                - 0.5 * Law::sine(1.0, 2.0, 0.0),
            -1.0,
            3.0,
        ),
        line("product", Law::sine(1.0, 2.0, 0.3) * Law::s_curve(1.0, 1.0, 1.0, 2.0), -1.0, 4.0),
        line("#[law]", bump(0.4, 0.7), -2.0, 2.0),
    ]
}

/// And those of intervals, of which proofs are made: each law has them (no derivative is left out
/// but those beyond a break).
#[test]
fn derivatives_and_breaks_are_those_of_the_law() {
    for Line { name, law, from, to } in all() {
        assert!(law.refusal().is_none(), "{name}: {:?}", law.refusal());
        let worst = check::compare_law(&law, from, to)
            .unwrap_or_else(|mismatch| panic!("{name}: {mismatch}"));
        println!("{name:20} {worst:.1e}  {} breaks", law.breaks(from, to).len());
        assert!(!law.description().is_empty(), "{name}");
    }
}

/// Each law drives a coordinate over its whole range, breaks and all: proved, so its bounds are
/// known, and narrow enough; and the law is in the tube.
#[test]
fn motions_by_every_law_can_be_proved() {
    for Line { name, law, from, to } in all() {
        let mut m = Mechanism::new(name);
        let x = m.length("x", law.at(from)).unwrap();
        m.add("motor", drive(x, law.clone())).unwrap();
        let system = m.build().unwrap();
        let motion = system.run_both(linspace(from, to, 38)).unwrap();
        let proof = system.prove(&motion).unwrap();
        println!("{proof}");
        assert!(proof.is_complete(), "{proof}");
        for (step, u) in
            proof.steps().iter().flat_map(|step| (0..=16).map(move |k| (step, f64::from(k) / 16.0)))
        {
            let t = step.from + u * (step.to - step.from);
            let radius = step.tube.as_ref().unwrap().radius[0];
            let off = (hermite::interpolated(&motion, step.step, u)[0] - law.at(t)).abs();
            assert!(off <= radius + 1e-13, "{name}: at {t} off by {off:e}, tube {radius:e}");
        }
        assert!((0..38).all(|k| proof.error(k).is_some_and(|error| error[0] < 1e-12)), "{proof}");
    }
}

/// A number just below zero, brought into the period, is the period itself by rounding: there the
/// law is what it is at zero.
#[test]
fn periodic_laws_just_below_zero() {
    let spline = Law::spline(&wave(), Ends::Periodic);
    let repeated =
        Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]).periodic(2.0);
    for (law, period) in [(spline, 4.0), (repeated, 2.0)] {
        for x in [-1e-17, -3e-17, -1e-300] {
            for turn in [0.0, period] {
                let below = law.jet(x + turn);
                let zero = law.jet(0.0);
                assert!(
                    (0..3).all(|k| (below[k] - zero[k]).abs() < 1e-12),
                    "{} at {x}: {below:?} instead of {zero:?}",
                    law.kind()
                );
            }
        }
    }
}

/// A smooth law has no break anywhere; the others have what they list, and no listed break is of no
/// effect (`compare_law` looks at each).
#[test]
fn breaks_are_listed() {
    let orders = |law: &Law, from, to| {
        law.breaks(from, to).iter().map(|b| (b.x, b.order)).collect::<Vec<_>>()
    };
    assert_eq!(
        orders(&Law::trapezoidal(2.0, 1.0, 2.0), -1.0, 9.0),
        [(0.0, 2), (0.5, 2), (2.0, 2), (2.5, 2)]
    );
    assert_eq!(orders(&Law::trapezoidal(0.5, 1.0, 2.0), -1.0, 9.0), [(0.0, 2), (0.5, 2), (1.0, 2)]);
    assert_eq!(orders(&Law::cycloidal(1.0, 2.0), 0.0, 2.0), [(0.0, 3), (2.0, 3)]);
    assert_eq!(orders(&Law::cycloidal(1.0, 2.0), 0.5, 1.5), []);
    assert_eq!(orders(&Law::harmonic_rise(1.0, 2.0), -1.0, 3.0), [(0.0, 2), (2.0, 2)]);
    let corner = Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::linear(1.0, -1.0))]);
    assert_eq!(orders(&corner, -1.0, 3.0), [(0.0, 1), (1.0, 1), (2.0, 1)]);
    assert_eq!(orders(&corner.periodic(2.0), 0.5, 3.5), [(1.0, 1), (2.0, 1), (3.0, 1)]);
    assert_eq!(orders(&corner.shifted(10.0), 10.5, 11.5).len(), 1);
    // of two laws added, the rougher one counts
    let both = Law::cycloidal(1.0, 1.0) + Law::harmonic_rise(1.0, 1.0);
    assert_eq!(orders(&both, -1.0, 2.0), [(0.0, 2), (1.0, 2)]);
    for Line { name, law, from, to } in all() {
        assert!(!law.is_smooth() || law.breaks(from, to).is_empty(), "{name}");
    }
}

#[test]
fn each_parameter_can_be_read_and_set() {
    for Line { name: constructor, law, .. } in all() {
        let mut names = Vec::new();
        law.parameters(&mut |name, _| names.push(name.to_string()));
        assert!(!names.is_empty(), "{constructor}");
        for name in names {
            let mut changed = law.clone();
            assert!(changed.set_parameter(&name, 0.125), "{constructor}: {name}");
            let mut value = None;
            changed.parameters(&mut |known, x| value = value.or((known == name).then_some(x)));
            assert_eq!(value, Some(0.125), "{constructor}: {name}");
        }
        for wrong in ["nonsense", "", "part[9].length", "c[99]", "y[77]"] {
            assert!(!law.clone().set_parameter(wrong, 1.0), "{constructor}: {wrong}");
        }
    }
}

/// Where the fourth derivative is known it is that of the third.
#[test]
fn fourth_derivative_is_that_of_the_third() {
    let mut known = 0;
    for Line { name, law, from, to } in all() {
        let breaks = law.breaks(from, to);
        let h = 1e-6 * (to - from);
        for k in 0..50 {
            let x = from + (to - from) * (f64::from(k) + 0.37) / 50.0;
            let fourth = law.fourth(x);
            // the modified shapes have breaks of their fourth derivative inside
            if fourth.is_nan() || breaks.iter().any(|b| (b.x - x).abs() < 3.0 * h) {
                continue;
            }
            let slope = (law.jet(x + h)[3] - law.jet(x - h)[3]) / (2.0 * h);
            assert!(
                (slope - fourth).abs() < 1e-4 * (1.0 + fourth.abs()),
                "{name} at {x}: {fourth} {slope}"
            );
            known += 1;
        }
    }
    assert!(known > 1000, "{known}");
}

#[test]
fn values_are_those_of_the_formulas() {
    assert_eq!(Law::polynomial(&[1.0, 2.0, 3.0]).jet(2.0), [17.0, 14.0, 6.0, 0.0]);
    assert_eq!(Law::polynomial(&[0.0; 0]).jet(2.0), [0.0; 4]);
    assert_eq!(Law::linear(1.0, 2.0).at(3.0), 7.0);
    assert_eq!(Law::harmonic(0.3, 0.05).at(0.0), 0.3);
    assert_eq!(Law::constant(4.0).jet(1.0), [4.0, 0.0, 0.0, 0.0]);
    assert_eq!(Law::fourier(1.0, 2.0, &[(0.5, 0.25)]).at(0.0), 1.5);
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    // halfway up every rise; Norton's largest accelerations over h/β²
    for (law, peak, at) in [
        (Law::harmonic_rise(2.0, 3.0), 4.934_802_200_544_679, 0.0),
        (Law::cycloidal(2.0, 3.0), TAU, 0.25),
        (Law::polynomial_345(2.0, 3.0), 5.773_502_691_896_257, 0.5 - 3.0_f64.sqrt() / 6.0),
        (Law::modified_sine(2.0, 3.0), 5.527_957, 0.125),
        (Law::modified_trapezoid(2.0, 3.0), 4.888_124, 0.2),
    ] {
        assert!(
            (law.jet(3.0 * at)[2] - peak * 2.0 / 9.0).abs() < 1e-6,
            "{law:?}: {}",
            law.jet(3.0 * at)[2] * 4.5
        );
        close(law.at(1.5), 1.0);
        assert_eq!((law.at(-1.0), law.at(3.0), law.at(99.0)), (0.0, 2.0, 2.0), "{law:?}");
    }
    close(Law::polynomial_4567(2.0, 3.0).at(1.5), 1.0);
}

/// Limits are kept and reached, the way is the distance, and the time is that of the textbook.
#[test]
fn motions_keep_their_limits() {
    for (law, end, peaks) in [
        (Law::trapezoidal(2.0, 1.0, 2.0), 2.5, [1.0, 2.0, f64::NAN]),
        (Law::trapezoidal(0.5, 1.0, 2.0), 1.0, [1.0, 2.0, f64::NAN]),
        (Law::trapezoidal(-0.125, 1.0, 2.0), 0.5, [0.5, 2.0, f64::NAN]),
        // jerk 0.25 s, 0.25 s of acceleration 2, cruise 1.25 s
        (Law::s_curve(2.0, 1.0, 2.0, 8.0), 2.75, [1.0, 2.0, 8.0]),
        // no cruise: 2 T_a with T_a = T_j/2 + √(T_j²/4 + d/a)
        (
            Law::s_curve(0.8, 2.0, 1.0, 8.0),
            2.0 * (0.0625 + (0.0625_f64.powi(2) + 0.8).sqrt()),
            [f64::NAN, 1.0, 8.0],
        ),
        // neither speed nor acceleration reached: 4 ∛(d/2j)
        (
            Law::s_curve(-0.05, 2.0, 2.0, 8.0),
            4.0 * (0.05_f64 / 16.0).cbrt(),
            [f64::NAN, f64::NAN, 8.0],
        ),
    ] {
        let last = law.breaks(-1.0, 99.0).last().expect("an end").x;
        assert!((last - end).abs() < 1e-12, "{law:?} ends at {last}, not at {end}");
        let largest = (0..20_000).map(|k| law.jet(end * f64::from(k) / 20_000.0));
        let largest =
            largest.fold([0.0_f64; 4], |m, jet| std::array::from_fn(|k| m[k].max(jet[k].abs())));
        for (found, peak) in largest[1..].iter().zip(peaks) {
            assert!(peak.is_nan() || (found - peak).abs() < 1e-3 * peak, "{law:?}: {largest:?}");
        }
        let before = law.at(end - 1e-9);
        let after = law.jet(end + 1e-9);
        assert!((before - after[0]).abs() < 1e-12 && after[1] == 0.0, "{law:?}");
    }
}

#[test]
fn splines_go_through_their_tables_and_repeat_what_is_cubic() {
    for ends in [Ends::Natural, Ends::Clamped { start: -1.0, end: 2.0 }, Ends::Periodic] {
        let law = Law::spline(&wave(), ends);
        wave().iter().for_each(|(x, y)| assert!((law.at(*x) - y).abs() < 1e-14, "{ends:?} at {x}"));
    }
    // a cubic with its own end slopes comes back everywhere
    let cubic = Law::polynomial(&[1.0, -2.0, 0.5, 0.75]);
    let table: Vec<(f64, f64)> =
        [0.0, 0.3, 1.1, 1.4, 2.0].iter().map(|x| (*x, cubic.at(*x))).collect();
    let spline =
        Law::spline(&table, Ends::Clamped { start: cubic.jet(0.0)[1], end: cubic.jet(2.0)[1] });
    for k in 0..200 {
        let x = f64::from(k) / 100.0;
        (0..4).for_each(|order| {
            assert!((spline.jet(x)[order] - cubic.jet(x)[order]).abs() < 1e-11, "{x}, {order}")
        });
    }
    assert_eq!(
        (spline.jet(-1.0)[1], Law::spline(&table, Ends::Natural).jet(0.0)[2]),
        (cubic.jet(0.0)[1], 0.0)
    );
    // a sine at 64 places, to the fourth power of their distance
    let places = (0..=64).map(|k| f64::from(k) * TAU / 64.0);
    let sine: Vec<(f64, f64)> = places.map(|x| (x, if x == TAU { 0.0 } else { x.sin() })).collect();
    let spline = Law::spline(&sine, Ends::Periodic);
    let worst = (0..1000)
        .map(|k| f64::from(k) * 0.02)
        .map(|x| (spline.at(x) - x.sin()).abs())
        .fold(0.0, f64::max);
    assert!(worst < 3.0 * (TAU / 64.0).powi(4) / 384.0 && spline.is_periodic(TAU), "{worst:e}");
}

#[test]
fn tables_are_read_from_files() {
    let path = std::env::temp_dir().join(format!("kin-table-{}.csv", std::process::id()));
    std::fs::write(
        &path,
        "angle [rad], lift [m], remark\n0, 1.0, start\n 0.5,1.8\n1.25,0.2\n2,-7e-1\n3.5,0.4\n4,1\n",
    )
    .expect("written");
    let law = Law::spline_from_csv(&path, Ends::Periodic).expect("a law");
    assert_eq!(law.jet(0.7), Law::spline(&wave(), Ends::Periodic).jet(0.7));
    for (text, said) in [
        ("0,1\n1,x\n", "line 2: `1,x` is not two numbers"),
        ("x,y\n0,1\n1,2\n1,3\n", "x must increase, but x = 1 is followed by 1"),
        ("0,1\n1\n", "line 2"),
        ("", "0 points"),
        ("0,1\n1,nan\n2,3\n", "finite"),
    ] {
        std::fs::write(&path, text).expect("written");
        let error = Law::spline_from_csv(&path, Ends::Natural).expect_err("refused").to_string();
        assert!(error.contains(said) && error.contains("kin-table"), "{text:?}: {error}");
    }
    std::fs::remove_file(&path).expect("removed");
    assert!(
        Law::spline_from_csv(&path, Ends::Natural)
            .expect_err("no file")
            .to_string()
            .contains("kin-table")
    );
}

#[test]
fn what_makes_no_sense_is_refused_in_words() {
    for (law, said) in [
        (Law::ramp(f64::NAN), "rate is NaN"),
        (Law::cycloidal(1.0, 0.0), "length of a rise"),
        (Law::trapezoidal(1.0, -1.0, 1.0), "above zero"),
        (Law::s_curve(1.0, 1.0, 1.0, 0.0), "above zero"),
        (Law::spline(&[(0.0, 1.0)], Ends::Natural), "1 point. Give at least 2"),
        (Law::spline(&[(0.0, 1.0), (0.0, 2.0)], Ends::Natural), "must increase"),
        (
            Law::spline(&[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)], Ends::Periodic),
            "first and the last y of a periodic table must be equal",
        ),
        (Law::sequence(0.0, Vec::<(f64, Law)>::new()), "the list of parts is empty"),
        (
            Law::sequence(0.0, [(1.0, Law::ramp(1.0)), (1.0, Law::constant(2.0))]),
            "parts 1 and 2 of the sequence do not meet: part 1 ends at 1",
        ),
        (
            Law::sequence(0.0, [(1.0, Law::cycloidal(1.0, -1.0))]),
            "part 1 of the sequence: cycloidal",
        ),
        (Law::sequence(0.0, [(0.0, Law::ramp(1.0))]), "the length 0"),
        (Law::ramp(1.0).periodic(2.0), "does not repeat after 2"),
        (Law::constant(1.0).periodic(-1.0), "period must be above zero"),
        (
            2.0 * Law::ramp(1.0).compose(&Law::sequence(0.0, Vec::<(f64, Law)>::new())),
            "the list of parts is empty",
        ),
        (bump(1.0, 0.0), "a bump needs a width (width = 0)"),
    ] {
        let found = law.refusal().unwrap_or_else(|| panic!("{law:?} is not refused"));
        assert!(found.contains(said), "{found}");
    }
}

#[test]
fn the_checker_finds_what_is_wrong() {
    struct Wrong;
    impl kin::extend::LawFunction for Wrong {
        fn jet(&self, x: f64) -> [f64; 4] {
            [x * x, 2.0 * x, 2.5, 0.0]
        }
        fn breaks(&self, _: f64, _: f64) -> Vec<Break> {
            vec![Break { x: 0.3, order: 1 }]
        }
    }
    let text = check::compare_law(&Law::new(Wrong), 0.0, 1.0).expect_err("wrong").to_string();
    assert!(
        text.contains("the derivative of order 2 at x = ")
            && text.contains("central differences give 2.0000"),
        "{text}"
    );
    let text = check::compare_law(&(Law::cycloidal(1.0, 1.0) + Law::new(Wrong)), -0.5, 0.4)
        .expect_err("wrong")
        .to_string();
    assert!(text.contains("the derivative of order 2 at x = "), "{text}");
}

/// Every constructor of laws is in the table.
#[test]
fn the_table_is_complete() {
    let mut open = vec![std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("kin-core/src/law")];
    let names: Vec<&str> = all().iter().map(|line| line.name).collect();
    let mut missing = Vec::new();
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(
                std::fs::read_dir(path)
                    .expect("readable")
                    .map(|entry| entry.expect("an entry").path()),
            );
            continue;
        }
        let text = std::fs::read_to_string(path).expect("readable");
        let constructors = text
            .lines()
            .filter(|line| line.starts_with("    pub fn ") && line.ends_with("-> Law {"));
        missing.extend(
            constructors
                .filter_map(|line| line[11..].split(['(', '<']).next())
                .filter(|name| !names.contains(name))
                .map(str::to_owned),
        );
    }
    assert!(missing.is_empty(), "not in the table: {missing:?}");
}
