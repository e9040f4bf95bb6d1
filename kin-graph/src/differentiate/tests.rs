//! Every derivative rule, at ordinary and at nasty points, against central differences and against
//! the second-order jets.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use super::{Jets, Partial};
use crate::functions::Place;
use crate::testing::value;
use crate::{Function, Function2, Graph, Input, Part};

/// Ordinary points of a function: well within its domain, away from poles and kinks.
fn ordinary(f: Function) -> impl Iterator<Item = f64> {
    let facts = f.facts();
    let [from, to] = facts.domain;
    let points = [-2.3, -0.7, -0.4, 0.1, 0.35, 0.6, 1.3, 1.7, 2.9, 4.7];
    let is_far = |place: Place, x: f64| match place {
        Place::At(pole) => (x - pole).abs() > 0.2,
        Place::Quarters { first, every } => {
            let periods = (x / FRAC_PI_2 - first) / every;
            (periods - periods.round()).abs() * every > 0.4
        }
    };
    points.into_iter().filter(move |x| {
        (from + 0.2..to - 0.2).contains(x) && facts.poles.iter().all(|pole| is_far(*pole, *x))
    })
}

#[test]
fn every_function_agrees_with_central_differences() {
    let h = 1e-5;
    for &f in Function::ALL {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let y = g.call(f, x);
        let mut d = Partial::by_variable();
        let first = d.of(&mut g, y);
        let second = d.of(&mut g, first);
        for at in ordinary(f) {
            let eval = |node, x| value(&g, node, &HashMap::from([(Input::Column(0), x)]));
            for (node, derivative) in [(y, first), (first, second)] {
                let central = (eval(node, at + h) - eval(node, at - h)) / (2.0 * h);
                let exact = eval(derivative, at);
                assert!(
                    (exact - central).abs() < 1e-7 * (1.0 + exact.abs()),
                    "{f:?} at {at}: {exact} is not {central}"
                );
            }
        }
    }
}

#[test]
fn every_function_of_two_agrees_with_central_differences() {
    let h = 1e-5;
    let [p, q] = [0, 1].map(|k| Input::State(k, Part::Theta));
    for &f in Function2::ALL {
        let mut g = Graph::default();
        let x = g.input(p);
        let y = g.input(q);
        let z = g.call2(f, x, y);
        let columns = g.columns(&[z]);
        for at in [[0.7, 1.9], [2.6, 0.45], [1.1, 3.0]] {
            let eval = |g: &Graph, node, at: [f64; 2]| {
                value(g, node, &HashMap::from([(p, at[0]), (q, at[1])]))
            };
            for (k, column) in columns.iter().enumerate() {
                let exact = Partial::by_column(*column).of(&mut g, z);
                let mut up = at;
                let mut down = at;
                up[k] += h;
                down[k] -= h;
                let central = (eval(&g, z, up) - eval(&g, z, down)) / (2.0 * h);
                let exact = eval(&g, exact, at);
                assert!(
                    (exact - central).abs() < 1e-8 * (1.0 + exact.abs()),
                    "{f:?} at {at:?} by {k}: {exact} is not {central}"
                );
            }
        }
    }
}

#[test]
fn derivatives_at_nasty_points_are_the_documented_ones() {
    let cases = [
        (Function::Abs, 0.0, 1.0),
        (Function::Abs, -0.0, 1.0),
        (Function::Signum, 0.0, 0.0),
        (Function::Floor, 1.0, 0.0),
        (Function::Fract, 2.0, 1.0),
        (Function::Sin, 0.0, 1.0),
        (Function::Cos, 0.0, 0.0),
        (Function::Tanh, 0.0, 1.0),
        (Function::Asinh, 0.0, 1.0),
        // The square of these is too large for a number.
        (Function::Asinh, 4e160, 2.5e-161),
        (Function::Asinh, -4e300, 2.5e-301),
        (Function::Acosh, 4e160, 2.5e-161),
        (Function::Acosh, 4e300, 2.5e-301),
        (Function::Ln1p, 0.0, 1.0),
        (Function::ExpM1, 0.0, 1.0),
    ];
    for (f, at, expected) in cases {
        let mut g = Graph::default();
        let x = g.input(Input::Column(0));
        let y = g.call(f, x);
        let first = Partial::by_variable().of(&mut g, y);
        assert_eq!(
            value(&g, first, &HashMap::from([(Input::Column(0), at)])),
            expected,
            "{f:?} at {at}"
        );
    }
}

/// Along x = x0 + v s the second jet is f″ v², for any composition.
#[test]
fn jets_are_derivatives_along_the_motion() {
    let state = Input::State(0, Part::R(0));
    let rate = Input::Rate(0, Part::R(0));
    for &f in Function::ALL {
        let mut g = Graph::default();
        let x = g.input(state);
        let half = g.constant(0.5);
        let inner = g.mul(half, x);
        let y = g.call(f, inner);
        let y = g.div(y, x);
        let column = g.columns(&[y])[0];
        let mut d = Partial::by_column(column);
        let first = d.of(&mut g, y);
        let second = d.of(&mut g, first);
        let jet = Jets::default().of(&mut g, y);
        for at in ordinary(f) {
            let inputs = HashMap::from([(state, 2.0 * at), (rate, 1.7)]);
            let pairs = [
                (value(&g, first, &inputs) * 1.7, jet.first),
                (value(&g, second, &inputs) * 1.7 * 1.7, jet.second),
            ];
            for (expected, node) in pairs {
                let got = value(&g, node, &inputs);
                assert!(
                    (got - expected).abs() < 1e-12 * (1.0 + expected.abs()),
                    "{f:?} at {at}: {got} is not {expected}"
                );
            }
        }
    }
}

/// Along x = x0 + v s + ½ a s² the second jet is f″ v² + f′ a; of an angle by sine and cosine too.
#[test]
fn jets_along_a_curve_have_the_term_of_the_second_rate() {
    let beyond = 5;
    let [v, a] = [1.7, -0.6];
    for &f in Function::ALL {
        let mut g = Graph::default();
        let x = g.input(Input::State(0, Part::R(0)));
        let y = g.call(f, x);
        let column = g.columns(&[y])[0];
        let mut d = Partial::by_column(column);
        let first = d.of(&mut g, y);
        let second = d.of(&mut g, first);
        let jet = Jets::along_curve(beyond).of(&mut g, y);
        for at in ordinary(f) {
            let rates = [(Input::Rate(0, Part::R(0)), v), (Input::Rate(beyond, Part::R(0)), a)];
            let inputs =
                HashMap::from_iter(rates.into_iter().chain([(Input::State(0, Part::R(0)), at)]));
            let expected = value(&g, second, &inputs) * v * v + value(&g, first, &inputs) * a;
            let got = value(&g, jet.second, &inputs);
            assert!(
                (got - expected).abs() < 1e-12 * (1.0 + expected.abs()),
                "{f:?} at {at}: {got} {expected}"
            );
        }
    }
    let mut g = Graph::default();
    let [sin, cos] = [Part::Sin, Part::Cos].map(|part| g.input(Input::State(0, part)));
    let mut jets = Jets::along_curve(beyond);
    let [sin, cos] = [sin, cos].map(|node| jets.of(&mut g, node));
    let x = 0.4_f64;
    let inputs = HashMap::from([
        (Input::State(0, Part::Sin), x.sin()),
        (Input::State(0, Part::Cos), x.cos()),
        (Input::Rate(0, Part::Theta), v),
        (Input::Rate(beyond, Part::Theta), a),
    ]);
    let expected = [a * x.cos() - v * v * x.sin(), -a * x.sin() - v * v * x.cos()];
    for (jet, expected) in [sin, cos].into_iter().zip(expected) {
        assert!((value(&g, jet.second, &inputs) - expected).abs() < 1e-15);
    }
}

/// x^1.5 at 0 has value and slope 0; an exponent that is a plain number must bring in no logarithm.
#[test]
fn power_of_zero_is_finite() {
    let mut g = Graph::default();
    let x = g.input(Input::Column(0));
    let e = g.constant(1.5);
    let y = g.call2(Function2::Powf, x, e);
    let first = Partial::by_variable().of(&mut g, y);
    assert_eq!(value(&g, first, &HashMap::from([(Input::Column(0), 0.0)])), 0.0);
}
