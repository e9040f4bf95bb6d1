//! The examples' own constraints, and one of an example's joints, read as text.

use std::path::Path;

use kin::data::{Describer, MechanismData};
use kin::extend::Parameters;
use kin::prelude::*;
use kin::{Engine, SolverOptions};
use kin_text::{Equation, registry};
use quote::ToTokens;
use syn::{File, Item, ItemFn, Visibility};

use crate::as_text::{difference, like};
use crate::own;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The functions of a program with `#[constraint]`.
fn constraints(program: &str) -> Vec<ItemFn> {
    let file: File = syn::parse_str(program).expect("Rust");
    let own = |item| match item {
        Item::Fn(function)
            if function.attrs.iter().any(|one| one.path().is_ident("constraint")) =>
        {
            Some(function)
        }
        _ => None,
    };
    file.items.into_iter().filter_map(own).collect()
}

/// The text of a function but for its comments, whoever may see it.
fn text(mut function: ItemFn) -> String {
    function.attrs.retain(|one| !one.path().is_ident("doc"));
    function.vis = Visibility::Inherited;
    function.into_token_stream().to_string()
}

/// Names and texts of the constraints that the examples have of their own.
fn of_examples() -> Vec<(String, String)> {
    let folder = std::fs::read_dir(format!("{ROOT}/examples")).expect("a folder");
    let mut paths: Vec<_> = folder.map(|entry| entry.expect("a file").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    paths.sort();
    let programs = paths.iter().map(|path| std::fs::read_to_string(path).expect("readable"));
    let all = programs.flat_map(|program| constraints(&program));
    all.map(|function| (function.sig.ident.to_string(), text(function))).collect()
}

/// The largest difference of all terms: at states of order 1, near zeros, far off, at zero, with
/// one zero.
fn largest(compiled: &dyn Constraint, read: &kin_text::ReadConstraint) -> f64 {
    let n: usize = compiled.arguments().iter().map(|argument| argument.target.columns()).sum();
    let random = &mut fastrand::Rng::with_seed(1);
    let at = |state: usize| {
        let near = [2.0, 1e-8, 30.0, 0.0, 2.0][state % 5];
        let mut vector =
            |near: f64| -> Vec<f64> { (0..n).map(|_| near * (2.0 * random.f64() - 1.0)).collect() };
        let [mut q, qd, qdd] = [vector(near), vector(2.0), vector(2.0)];
        if state % 5 == 4 {
            q[state / 5 % n] = 0.0;
        }
        difference(compiled, read, [&q, &qd, &qdd], 0.37)
    };
    (0..200).map(at).fold(0.0, f64::max)
}

#[test]
fn every_constraint_of_the_examples_is_the_compiled_one() {
    let c = kin::check::any_coord;
    let p = kin::check::any_planar;
    let u = vec2(0.06, 0.01);
    let compiled: [Box<dyn Constraint>; 4] = [
        Box::new(own::slider_crank(c(), c(), 0.1, 0.25, 0.02, TAU)),
        Box::new(own::parabolic_slot(p(), p(), u, 2.5)),
        Box::new(own::geneva(p(), p(), vec2(0.05, 0.0), 4.0)),
        Box::new(own::geneva(p(), p(), vec2(0.05, 0.0), 7.0)),
    ];
    let texts = of_examples();
    let copies = constraints(
        &std::fs::read_to_string(format!("{ROOT}/tests/data/own.rs")).expect("readable"),
    );
    let copies: Vec<_> =
        copies.into_iter().map(|one| (one.sig.ident.to_string(), text(one))).collect();
    // All that the examples have is compiled here.
    assert_eq!(texts, copies);
    let mut met = Vec::new();
    for compiled in &compiled {
        let mut describer = Describer::default();
        compiled.describe(&mut describer);
        let kind = compiled.facts().kind;
        let (_, written) = texts.iter().find(|(name, _)| name == kind).expect(kind);
        let kept =
            describer.equation().unwrap_or_else(|| panic!("{kind}: {:?}", describer.lacking()));
        for text in [written, &kept] {
            let equation =
                Equation::read(text).unwrap_or_else(|mistakes| panic!("{kind}: {mistakes}"));
            let read = like(&equation, compiled.as_ref());
            let found = largest(compiled.as_ref(), &read);
            assert!(found < 1e-14, "{kind}: {found:e}");
            assert_eq!(compiled.refusal(), read.refusal(), "{kind}");
        }
        met.push(kind);
    }
    met.dedup();
    assert_eq!(met, texts.iter().map(|(name, _)| name).collect::<Vec<_>>());
}

#[test]
fn demands_of_an_example_are_those_of_its_text() {
    let broken =
        own::geneva(kin::check::any_planar(), kin::check::any_planar(), vec2(0.05, 0.0), 2.5);
    let (_, text) = of_examples().into_iter().find(|(name, _)| name == "geneva").expect("a text");
    let mut m = Mechanism::new("wheel");
    let driver = m.planar("driver", pose(0.0, 0.0, 0.0));
    let wheel = m.planar("wheel", pose(1.0, 0.0, 0.0));
    let driver = driver.expect("a body");
    let wheel = wheel.expect("a body");
    let equation = Equation::read(&text).expect("a text");
    let making = equation.on(driver).on(wheel).with("pin", [0.05, 0.0]).with("slots", 2.5);
    let error =
        making.constraint().and_then(|read| m.add("drive", read)).expect_err("a broken demand");
    let refusal = broken.refusal().expect("a broken demand");
    assert!(error.to_string().contains(&*refusal), "{error}; {refusal}");
}

/// The two-link manipulator of the benches, W1, with the joint between its links from text: the
/// numbers that it has with all joints compiled by rustc, by either engine.
#[test]
fn a_joint_from_text_among_compiled_ones_changes_no_number() {
    const PIN: &str = "fn pin(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 { i.point(u_i) - j.point(u_j) }";
    let path = Path::new(ROOT).join("tests/data/examples/02_two_link_manipulator.json");
    let data = MechanismData::read(&std::fs::read_to_string(path).expect("readable"))
        .expect("a mechanism");
    let mut with_text = data.clone();
    let joint = with_text.constraints.iter_mut().find(|one| one.name == "A").expect("the joint");
    assert_eq!(std::mem::replace(&mut joint.kind, "pin".to_owned()), "revolute");
    with_text.equations.push(PIN.to_owned());
    for engine in [Engine::StepByStep, Engine::Auto, Engine::Compiled] {
        let options = SolverOptions::new().engine(engine);
        let [all, one] = [&data, &with_text].map(|data| {
            let system =
                Mechanism::from_data(data, &registry()).and_then(|m| m.build()).expect("builds");
            system.solver().options(options.clone()).run(linspace(0.0, 24.0, 1201)).expect("runs")
        });
        assert_eq!(all.engine().compiled, one.engine().compiled);
        assert_eq!(
            one.engine().compiled > 1000,
            engine != Engine::StepByStep,
            "{:?}",
            one.engine()
        );
        for k in 0..all.len() {
            let [all, one] =
                [&all, &one].map(|motion| [motion.q(k), motion.qd(k), motion.qdd(k)].concat());
            let apart = all.iter().zip(&one).all(|(a, b)| (a - b).abs() <= 1e-13 * (1.0 + a.abs()));
            assert!(apart, "{engine:?}, time {k}: {all:?} {one:?}");
        }
    }
}
