//! Laws from text: the same numbers as a compiled law, files that carry them, and mistakes at their
//! place.

use kin::data::Registry;
use kin::data::{LawData, MechanismData};
use kin::prelude::*;
use kin::{Law, Mechanism, check, law};
use kin_text::{LawText, registry};

use crate::engines::Engines;

/// A rise that is bent: h (1 − cos(π x/β))/2 · exp(−c₁ x²) + c₀ x.
#[law]
#[require(beta > 0.0, "beta is a length, which is greater than 0")]
fn bent_rise(x: f64, h: f64, beta: f64, c: [f64; 2]) -> f64 {
    let phase = PI * x / beta;
    let rise = if x > beta { h } else { h * (1.0 - phase.cos()) / 2.0 };
    rise * (-c[1] * x * x).exp() + c[0] * x
}

#[law]
fn wave(x: f64, h: f64, beta: f64, c: [f64; 2]) -> f64 {
    h * (PI * x / beta).sin() * (-c[1] * x * x).exp() + c[0] * x
}

const TEXT: &str = r#"
/// A rise that is bent.
#[require(beta > 0.0, "beta is a length, which is greater than 0")]
fn bent_rise(x: f64, h: f64, beta: f64, c: [f64; 2]) -> f64 {
    let phase = PI * x / beta;
    let rise = if x > beta { h } else { h * (1.0 - phase.cos()) / 2.0 };
    rise * damped(x, c[1]) + c[0] * x
}
fn damped(x: f64, rate: f64) -> f64 {
    (-rate * x * x).exp()
}
"#;
/// Texts of laws, to be spoilt.
pub const TEXTS: [&str; 4] = [
    TEXT,
    "fn lift(x: f64, h: f64) -> f64 { h * (1.0 - x.cos()) / 2.0 }",
    "#[law]\nfn doubled(x: f64, inner: Law, k: f64) -> f64 { k * inner.at(2.0 * x) }",
    "const A: f64 = 0.3;\nfn wave(x: f64, c: [f64; 3]) -> f64 { let mut s = A; for k in 0..3 { s += c[k] * x.powi(k as i32); } s }",
];
const NUMBERS: [(&str, f64); 4] = [("h", 0.04), ("beta", 1.5), ("c[0]", 0.2), ("c[1]", 0.7)];

/// The whole text: the function that is meant is marked, since another one follows it.
fn text() -> String {
    TEXT.replace("#[require", "#[law]\n#[require")
}

fn read() -> Law {
    LawText::read(&text()).unwrap().law(&NUMBERS).unwrap()
}

fn compiled() -> Law {
    bent_rise(0.04, 1.5, [0.2, 0.7])
}

#[test]
fn a_law_from_text_is_the_compiled_one() {
    let read = read();
    let compiled = compiled();
    for k in -40..=80 {
        let x = f64::from(k) * 0.037 + 1e-13 * f64::from(k % 3);
        for (a, b) in read.jet(x).into_iter().zip(compiled.jet(x)) {
            assert!((a - b).abs() <= 2e-14 * b.abs().max(1.0), "at {x}: {a} and {b}");
        }
    }
    check::law(&read, -1.0, 1.4);
    assert_eq!(read.kind(), "bent_rise");
    assert_eq!(read.description(), "A rise that is bent.");
    assert!(read.trusted().is_empty(), "its formula is known");
}

#[test]
fn its_derivatives_by_parameters_are_those_of_differences() {
    let smooth = "fn wave(x: f64, h: f64, beta: f64, c: [f64; 2]) -> f64 { h * (PI * x / beta).sin() * (-c[1] * x * x).exp() + c[0] * x }";
    for law in [LawText::read(smooth).unwrap().law(&NUMBERS).unwrap(), wave(0.04, 1.5, [0.2, 0.7])]
    {
        for (name, value) in NUMBERS {
            let slope = law.by_parameter(name).unwrap_or_else(|| panic!("by {name}"));
            for x in [-0.7, 0.0, 0.4, 1.3, 2.2] {
                let at = |shift: f64| {
                    let mut moved = law.clone();
                    assert!(moved.set_parameter(name, value + shift));
                    moved.jet(x)
                };
                let d = 1e-4;
                let near = (at(d), at(-d));
                let far = (at(2.0 * d), at(-2.0 * d));
                for order in 0..3 {
                    let one = |pair: &([f64; 4], [f64; 4])| pair.0[order] - pair.1[order];
                    let expected = (8.0 * one(&near) - one(&far)) / (12.0 * d);
                    let found = slope.jet(x)[order];
                    assert!(
                        (found - expected).abs() < 1e-9 * expected.abs().max(1.0),
                        "{name}, {x}, {order}"
                    );
                }
            }
        }
        assert!(law.by_parameter("width").is_none());
    }
    for law in [read(), compiled()] {
        assert!(law.by_parameter("beta").is_none(), "it switches at x = beta");
    }
}

fn slider(law: Law) -> Mechanism {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.0, 0.0, 0.0)).unwrap();
    m.add(
        "rail",
        kin::joints::planar::prismatic(
            kin::Ground,
            slider,
            [0.0, 0.0],
            [0.0, 0.0],
            [0.0, 1.0],
            0.0,
        ),
    )
    .unwrap();
    m.add("motor", kin::joints::drivers::drive(slider.x(), law)).unwrap();
    m
}

#[test]
fn files_carry_laws_and_give_the_same_motion_by_either_engine() {
    for (name, law) in [("read", read()), ("compiled", compiled())] {
        let path =
            std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("law {name}.json"));
        slider(law.clone()).write_json(&path).unwrap();
        let again =
            Mechanism::read_json(&path, &registry()).unwrap_or_else(|error| panic!("{error}"));
        let run = |m: &Mechanism, engine| {
            let options = kin::SolverOptions::new().engine(engine);
            m.clone()
                .build()
                .unwrap()
                .solver()
                .options(options.clone())
                .run(linspace(0.0, 1.4, 141))
                .unwrap()
        };
        let motions = [
            run(&slider(law), kin::Engine::StepByStep),
            run(&again, kin::Engine::StepByStep),
            run(&again, kin::Engine::Compiled),
        ];
        assert!(motions[2].engine().compiled > 100, "{:?}", motions[2].engine());
        for k in 0..141 {
            let of_all: [fn(&kin::Motion, usize) -> f64; 3] =
                [|m, k| m.q(k)[0], |m, k| m.qd(k)[0], |m, k| m.qdd(k)[0]];
            for of in of_all {
                let [a, b, c] = motions.each_ref().map(|m| of(m, k));
                assert!(
                    (a - b).abs() < 1e-13 && (a - c).abs() < 1e-12,
                    "{name}, time {k}: {a}, {b}, {c}"
                );
            }
        }
        // A program that knows the law by its name needs no reader of texts, and the numbers can be
        // set.
        let known = Registry::new().with_law("bent_rise", |law| {
            let c: [f64; 2] = law.list("c", 0).try_into().map_err(|_| "two numbers c")?;
            Ok(bent_rise(law.number("h")?, law.number("beta")?, c))
        });
        let mut system = Mechanism::read_json(&path, &known).unwrap().build().unwrap();
        system.set("motor.law.h", 0.08).unwrap();
        let other = slider(bent_rise(0.08, 1.5, [0.2, 0.7])).build().unwrap();
        let at = linspace(0.0, 1.4, 15);
        assert_eq!(system.run_both(at.clone()).unwrap().data(), other.run_both(at).unwrap().data());
        let error =
            Mechanism::read_json(&path, &Registry::new()).err().map(|error| error.to_string());
        let error = error.unwrap_or_default();
        assert!(error.contains("`motor`") && error.contains("unknown law `bent_rise`"), "{error}");
        assert!(error.contains("kin::text::registry()"), "{error}");
    }
}

#[test]
fn a_law_that_speaks_of_what_stands_beside_it_goes_by_its_name_alone() {
    fn height<D: Dual>(x: Real<D>) -> Real<D> {
        0.1 * x.sin()
    }
    const FAST: f64 = 2.0;
    #[law]
    fn lost(x: f64) -> f64 {
        height(x)
    }
    #[law]
    fn fast(x: f64) -> f64 {
        (FAST * x).sin()
    }
    assert_eq!(lost().text(), None);
    assert!(
        fast().text().is_some_and(|text| text.starts_with("const FAST: f64 = 2.0;\n")),
        "{:?}",
        fast().text()
    );
    let text = compiled().text().map(str::to_owned).unwrap_or_default();
    assert!(text.contains("fn bent_rise(x: f64, h: f64, beta: f64, c: [f64; 2]) -> f64"), "{text}");
}

#[test]
fn laws_are_made_of_laws() {
    let text = "fn doubled(x: f64, inner: Law, k: f64) -> f64 { k * inner.at(2.0 * x) }";
    let described = format!(
        r#"{{"text": "{text}", "numbers": {{"k": 3.0}}, "parts": {{"inner": {{"kind": "ramp", "numbers": {{"rate": 0.5}}}}}}}}"#
    );
    let data: LawData = serde_json::from_str(&described).unwrap();
    let mut law = registry().law(&data).unwrap();
    assert_eq!(law.jet(0.7), [3.0 * 0.7, 3.0, 0.0, 0.0]);
    assert!(law.set_parameter("inner.rate", 1.0) && law.set_parameter("k", 1.0));
    assert_eq!(law.jet(0.7)[..2], [1.4, 2.0]);
    assert_eq!(LawData::of(&law).parts["inner"].kind, "ramp");
    assert!(!law.set_parameter("outer.rate", 1.0) && !law.set_parameter("j", 1.0));
}

#[test]
fn slips_are_told_at_their_place() {
    let mistake =
        |text: &str| LawText::read(text).err().map(|all| all.to_string()).unwrap_or_default();
    for (text, told) in [
        ("fn f(x: f64) -> f64 { x.sine() }", "text:1:25"),
        ("fn f(x: f64) -> f64 { y }", "text:1:23"),
        ("fn f(i: Planar) -> f64 { i.x() }", "a law is a function of numbers"),
        ("fn f() -> f64 { 1.0 }", "a law needs the variable"),
        ("fn f(x: f64) -> Vec2 { Vec2::new(x, x) }", "a law must return a number"),
        ("fn f(x: f64) -> f64 { hidden(x) }", "Kin does not know `hidden` in this text"),
        ("fn f(x: f64) -> f64 { if x > 0.0 { f(x - 1.0) } else { x } }", "text:1"),
        ("lift", "text:1:1"),
    ] {
        assert!(mistake(text).contains(told), "{text}: {}", mistake(text));
    }
    let made = |numbers: &[(&str, f64)]| {
        LawText::read(&text()).unwrap().law(numbers).map(|law| law.refusal())
    };
    assert!(made(&NUMBERS[1..]).is_err_and(|why| why.contains("the number `h` of the law")));
    let more = [&NUMBERS[..], &[("width", 1.0)]].concat();
    assert!(made(&more).is_err_and(|why| why.contains("no number `width`")));
    let wrong = [NUMBERS[0], ("beta", -1.0), NUMBERS[2], NUMBERS[3]];
    assert_eq!(made(&wrong).unwrap().as_deref(), Some("beta is a length, which is greater than 0"));
    let part = LawText::read("fn f(x: f64, g: Law) -> f64 { g.at(x) }").unwrap().law(&[]);
    assert!(part.is_err_and(|why| why.contains("`g` is a law")));
}

#[test]
fn a_file_tells_the_constraint_whose_law_cannot_be_read() {
    let mut data: MechanismData = slider(read()).data().unwrap();
    data.constraints[1].parameters["law"]["text"] = "fn bent_rise(x: f64) -> f64 { x + }".into();
    let error = Mechanism::from_data(&data, &registry()).err().map(|error| error.to_string());
    let error = error.unwrap_or_default();
    assert!(error.contains("`motor`") && error.contains("text:1:"), "{error}");
}
