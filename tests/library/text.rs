//! Every joint of the library read as text: the same facts, the same terms, the same measures, demands and
//! points as the compiled one has.

use std::collections::HashMap;
use std::path::Path;

use kin::constraint::Attached;
use kin::coordinates::Target;
use kin::data::{Describer, LawData};
use kin::dual_route::ArgumentKind;
use kin::prelude::*;
use kin::{Registry, jerk_rhs, measure, terms};
use kin_text::{Equation, Making, On, Parameter};
use quote::ToTokens;
use serde_json::Value;
use syn::{File, Item, ItemFn};

use crate::sample::{Random, columns};
use crate::table::all;

/// The equations of the library by their names and the kinds of their arguments.
fn library() -> HashMap<(String, Vec<ArgumentKind>), Equation> {
    let mut all = HashMap::new();
    let joints = Path::new(env!("CARGO_MANIFEST_DIR")).join("kin-core/src/joints");
    for folder in ["planar", "spatial", "drivers"] {
        for entry in std::fs::read_dir(joints.join(folder)).expect("a folder") {
            let text = std::fs::read_to_string(entry.expect("a file").path()).expect("readable");
            for equation in equations(&text) {
                all.insert((equation.name().to_owned(), equation.arguments()), equation);
            }
        }
    }
    all
}

fn is_constraint(function: &ItemFn) -> bool {
    function.attrs.iter().any(|attribute| attribute.path().is_ident("constraint"))
}

/// The constraints of a file, each with the functions beside it.
fn equations(text: &str) -> Vec<Equation> {
    let file: File = syn::parse_str(text).expect("Rust");
    let functions: Vec<&ItemFn> = file
        .items
        .iter()
        .filter_map(|item| if let Item::Fn(function) = item { Some(function) } else { None })
        .collect();
    let (own, helpers): (Vec<&ItemFn>, Vec<&ItemFn>) =
        functions.into_iter().partition(|function| is_constraint(function));
    let helpers: String = helpers.iter().map(|helper| helper.to_token_stream().to_string()).collect();
    own.into_iter()
        .map(|function| {
            let text = format!("{helpers}\n{}", function.to_token_stream());
            Equation::read(&text).unwrap_or_else(|mistakes| panic!("{}: {mistakes}", function.sig.ident))
        })
        .collect()
}

/// The equation on the bodies and with the parameters of a compiled constraint.
fn like(equation: &Equation, compiled: &dyn Constraint) -> Box<dyn Constraint> {
    let mut describer = Describer::default();
    compiled.describe(&mut describer);
    let mut bodies = compiled.arguments().into_iter().map(|argument| match argument.target {
        Target::Planar(body) => On::Planar(body),
        Target::Spatial(body) => On::Spatial(body),
        Target::Coord(coordinate, _) => On::Coord(coordinate),
    });
    let first = equation.on(bodies.next().expect("an argument"));
    let making = bodies.fold(first, Making::on);
    let making =
        describer.parameters().iter().fold(making, |making, (name, value)| making.with(name, of_json(value)));
    Box::new(making.constraint().unwrap_or_else(|error| panic!("{error}")))
}

fn of_json(value: &Value) -> Parameter {
    fn flat(value: &Value, to: &mut Vec<f64>) {
        match value {
            Value::Array(all) => all.iter().for_each(|part| flat(part, to)),
            number => to.push(number.as_f64().expect("a number")),
        }
    }
    if value.is_object() {
        let data: LawData = serde_json::from_value(value.clone()).expect("a law");
        return Registry::new().law(&data).expect("a law").into();
    }
    let mut numbers = Vec::new();
    flat(value, &mut numbers);
    numbers.into()
}

/// Difference of two numbers as a part of the largest number around.
fn apart(a: f64, b: f64, size: f64) -> f64 {
    if a == b || a.is_nan() && b.is_nan() { 0.0 } else { (a - b).abs() / size }
}

/// The largest difference of all that a solver asks for.
fn difference(a: &dyn Constraint, b: &dyn Constraint, [q, qd, qdd]: [&[f64]; 3], t: f64) -> f64 {
    let (x, y) = (terms(a, q, qd, t), terms(b, q, qd, t));
    let jerks = [a, b].map(|c| jerk_rhs(c, q, qd, qdd, t).expect("known"));
    let mut pairs: Vec<(f64, f64)> = x.c_q.iter().copied().zip(y.c_q.iter().copied()).collect();
    let vectors =
        [(&x.c, &y.c), (&x.c_t, &y.c_t), (&x.q_d, &y.q_d), (&x.c_tt, &y.c_tt), (&jerks[0], &jerks[1])];
    vectors.iter().for_each(|(x, y)| pairs.extend(x.iter().copied().zip(y.iter().copied())));
    for k in 0..a.facts().measures.len() {
        let both = [a, b].map(|c| measure(c, k, kin::Moving { q, qd, qdd, qddd: qd }, t));
        pairs.extend(both[0].into_iter().zip(both[1]));
    }
    let size = pairs.iter().map(|(x, _)| x.abs()).filter(|x| x.is_finite()).fold(100.0, f64::max);
    pairs.into_iter().map(|(x, y)| apart(x, y, size)).fold(0.0, f64::max)
}

fn kinds(compiled: &dyn Constraint) -> Vec<ArgumentKind> {
    let of = |target: Target| match target {
        Target::Planar(_) => ArgumentKind::Planar,
        Target::Spatial(_) => ArgumentKind::Spatial,
        Target::Coord(..) => ArgumentKind::Coord,
    };
    compiled.arguments().into_iter().map(|argument| of(argument.target)).collect()
}

fn same_points(a: &dyn Constraint, b: &dyn Constraint) -> bool {
    let points = |c: &dyn Constraint| -> Vec<(usize, bool, Vec3)> {
        let all = c.attachments().into_iter();
        all.map(|one| match one.what {
            Attached::Point(u) => (one.argument, true, u),
            Attached::Direction(h) => (one.argument, false, h),
        })
        .collect()
    };
    let (a, b) = (points(a), points(b));
    a.len() == b.len()
        && a.into_iter().zip(b).all(|((k, is_point, u), (l, is_same, v))| {
            k == l && is_point == is_same && (u - v).norm() <= 1e-15 * (1.0 + u.norm())
        })
}

/// Everything that does not depend on the state.
fn says_the_same(compiled: &dyn Constraint, read: &dyn Constraint, name: &str) {
    use kin::constraint::Facts;
    let (a, b) = (compiled.facts(), read.facts());
    // How emitted code splits a row by time is its own matter.
    let facts =
        |f: &Facts<'_>| format!("{:?}", Facts { n_timed: 0, sides_of_time: None, constants: &[], ..*f });
    assert_eq!(facts(&a), facts(&b), "{name}");
    assert_eq!(compiled.arguments(), read.arguments(), "{name}");
    assert_eq!(compiled.refusal(), read.refusal(), "{name}");
    let listed = |c: &dyn Constraint| {
        let mut all = Vec::new();
        c.parameters(&mut |name, value| all.push((name.to_owned(), value.to_bits())));
        all
    };
    assert_eq!(listed(compiled), listed(read), "{name}");
    assert!(same_points(compiled, read), "{name}");
    for k in 0..a.measures.len() {
        assert_eq!(compiled.ends(k), read.ends(k), "{name}");
    }
}

#[test]
fn every_joint_from_text_is_the_compiled_one() {
    let library = library();
    let (mut worst, mut states) = (0.0_f64, 0);
    for joint in all() {
        for seed in 0..4 {
            let random = &mut Random::new(300 + seed);
            let sample = (joint.make)(random);
            let compiled = sample.constraint();
            let name = joint.name();
            let equation = library.get(&(name.clone(), kinds(compiled)));
            let read = like(equation.unwrap_or_else(|| panic!("no text of `{name}`")), compiled);
            says_the_same(compiled, &*read, &name);
            for _ in 0..8 {
                let n = columns(compiled);
                let mut vector =
                    |near: f64| -> Vec<f64> { (0..n).map(|_| random.between(-near, near)).collect() };
                let near = if states % 3 == 0 { 1e-8 } else { 2.0 };
                let [q, qd, qdd] = [vector(near), vector(2.0), vector(2.0)];
                let found = difference(compiled, &*read, [&q, &qd, &qdd], 0.37);
                // Rounding is worse where a row is: as bad as between the two compiled routes.
                let routes = difference(compiled, &*sample.by_dual(), [&q, &qd, &qdd], 0.37);
                assert!(found < 4e-14_f64.max(4.0 * routes.min(1e-12)), "{name}: {found:e} at {q:?}");
                worst = worst.max(found);
                states += 1;
            }
        }
    }
    println!("{} joints at {states} states: within {worst:.1e}", all().len());
}
