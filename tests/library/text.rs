//! Every joint of the library read as text: the same facts, the same terms, the same measures,
//! demands and points as the compiled one has.

use std::collections::HashMap;
use std::path::Path;

use kin::extend::Attached;
use kin::extend::coordinates::Target;
use kin::extend::dual_route::ArgumentKind;
use kin::extend::measure;
use kin::prelude::*;
use kin_text::Equation;
use quote::ToTokens;
use syn::{File, Item, ItemFn};

use crate::as_text::{apart, difference, like};
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
    let helpers: String =
        helpers.iter().map(|helper| helper.to_token_stream().to_string()).collect();
    own.into_iter()
        .map(|function| {
            let text = format!("{helpers}\n{}", function.to_token_stream());
            Equation::read(&text)
                .unwrap_or_else(|mistakes| panic!("{}: {mistakes}", function.sig.ident))
        })
        .collect()
}

/// The largest difference of a measure, as a part of the largest number of it.
fn of_measures(a: &dyn Constraint, b: &dyn Constraint, [q, qd, qdd]: [&[f64]; 3], t: f64) -> f64 {
    let all = (0..a.facts().measures.len()).map(|k| {
        let both = [a, b].map(|c| measure(c, k, kin::extend::Moving { q, qd, qdd, qddd: qd }, t));
        let size = both[0].iter().map(|x| x.abs()).filter(|x| x.is_finite()).fold(1.0, f64::max);
        both[0].into_iter().zip(both[1]).map(|(x, y)| apart(x, y, size)).fold(0.0, f64::max)
    });
    all.fold(0.0, f64::max)
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
    let a = points(a);
    let b = points(b);
    a.len() == b.len()
        && a.into_iter().zip(b).all(|((k, is_point, u), (l, is_same, v))| {
            k == l && is_point == is_same && (u - v).norm() <= 1e-15 * (1.0 + u.norm())
        })
}

/// Everything that does not depend on the state.
fn says_the_same(compiled: &dyn Constraint, read: &dyn Constraint, name: &str) {
    use kin::extend::Facts;
    let a = compiled.facts();
    let b = read.facts();
    // How emitted code splits a row by time is its own matter.
    let facts = |f: &Facts<'_>| {
        format!("{:?}", Facts { n_timed: 0, sides_of_time: None, constants: &[], ..*f })
    };
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
    let mut worst = 0.0_f64;
    let mut states = 0;
    for joint in all() {
        for seed in 0..4 {
            let random = &mut Random::new(300 + seed);
            let sample = (joint.make)(random);
            let compiled = sample.constraint();
            let name = joint.name();
            let equation = library.get(&(name.clone(), kinds(compiled)));
            let read = like(equation.unwrap_or_else(|| panic!("no text of `{name}`")), compiled);
            says_the_same(compiled, &read, &name);
            for _ in 0..8 {
                let n = columns(compiled);
                let mut vector = |near: f64| -> Vec<f64> {
                    (0..n).map(|_| random.between(-near, near)).collect()
                };
                let near = if states % 3 == 0 { 1e-8 } else { 2.0 };
                let [q, qd, qdd] = [vector(near), vector(2.0), vector(2.0)];
                let found = difference(compiled, &read, [&q, &qd, &qdd], 0.37);
                let measured = of_measures(compiled, &read, [&q, &qd, &qdd], 0.37);
                assert!(found < 1e-14, "{name}: {found:e} at {q:?}");
                // Measures are quotients and roots of these, three times differentiated.
                assert!(measured < 4e-14, "{name}: {measured:e} at {q:?}");
                worst = worst.max(found);
                states += 1;
            }
        }
    }
    println!("{} joints at {states} states: within {worst:.1e}", all().len());
}
