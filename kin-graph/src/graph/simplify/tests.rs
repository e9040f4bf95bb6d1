//! Equal expressions are one, and what can be folded is.

use super::*;
use crate::Comparison;

fn three() -> (Graph, Node, Node, Node) {
    let mut g = Graph::default();
    let [x, y, z] = [0, 1, 2].map(|k| g.input(Input::Parameter(k)));
    (g, x, y, z)
}

#[test]
fn equal_expressions_are_one_node() {
    let (mut g, x, y, _) = three();
    assert_eq!(g.add(x, y), g.add(y, x));
    assert_eq!(g.mul(x, y), g.mul(y, x));
}

#[test]
fn zeros_ones_and_signs_vanish() {
    let (mut g, x, y, _) = three();
    let zero = g.zero();
    let one = g.constant(1.0);
    assert_eq!(g.add(x, zero), x);
    assert_eq!(g.mul(one, x), x);
    assert_eq!(g.mul(zero, x), zero);
    assert_eq!(g.sub(x, x), zero);
    let minus = g.neg(x);
    assert_eq!(g.neg(minus), x);
    let sum = g.add(y, minus);
    let difference = g.sub(y, x);
    assert_eq!(sum, difference);
    let minus_zero = g.constant(-0.0);
    assert_eq!(minus_zero, zero);
}

#[test]
fn a_common_factor_is_taken_out() {
    let (mut g, x, y, z) = three();
    let xy = g.mul(x, y);
    let xz = g.mul(x, z);
    let difference = g.sub(xy, xz);
    let rest = g.sub(y, z);
    assert_eq!(difference, g.mul(x, rest));
    let two_x = g.add(x, x);
    let three_x = g.add(two_x, x);
    let factor = g.constant(3.0);
    assert_eq!(three_x, g.mul(factor, x));
}

#[test]
fn powers_of_two_are_taken_out() {
    let (mut g, x, y, _) = three();
    let two = g.constant(2.0);
    let four = g.constant(4.0);
    let four_x = g.mul(four, x);
    let two_x = g.mul(two, x);
    let two_y = g.mul(two, y);
    let sum = g.sub(four_x, two_y);
    let inner = g.sub(two_x, y);
    assert_eq!(sum, g.mul(two, inner));
}

/// As written 10¹⁶ + 1 is not 10¹⁶, a third of 3 d is not known to be d, and √2 is not a number of
/// f64.
#[test]
fn nothing_is_rounded_as_written() {
    let built = |mut g: Graph| {
        let x = g.input(Input::Parameter(0));
        let [large, one, three, four, tenth] = [1e16, 1.0, 3.0, 4.0, 0.1].map(|c| g.constant(c));
        let sum = g.add(large, one);
        let sum = g.sub(sum, large);
        let third = g.div(one, three);
        let quarter = g.div(one, four);
        let inner = g.mul(tenth, x);
        let root = g.call(Function::Sqrt, three);
        let other = g.call(Function::Sqrt, four);
        let nested = g.mul(three, inner);
        let power = g.powi(tenth, 7);
        let values = [sum, third, quarter, root, other, power].map(|node| g.constant_value(node));
        (values, matches!(g.op(nested), Op::Mul(_, rest) if rest == inner), g.is_rounded())
    };
    assert_eq!(
        built(Graph::as_written()),
        ([None, None, Some(0.25), None, Some(2.0), None], true, true)
    );
    let (values, nested, rounded) = built(Graph::default());
    assert!(values.iter().all(Option::is_some) && values[0] == Some(0.0) && !nested && rounded);
}

#[test]
fn powers_of_two_do_not_overflow() {
    let (mut g, x, y, _) = three();
    let large = g.constant(2_f64.powi(1000));
    let small = g.constant(2_f64.powi(-1000));
    let a = g.mul(large, x);
    let b = g.mul(small, y);
    let c = g.mul(large, y);
    for node in [g.add(a, b), g.sub(b, a), g.mul(a, c)] {
        let finite = |n: &Node| g.constant_value(*n).is_none_or(|c| c.is_finite() && c != 0.0);
        assert!(g.reachable(&[node]).iter().all(finite));
    }
}

#[test]
fn conditions_fold() {
    let (mut g, x, y, _) = three();
    let one = g.constant(1.0);
    let two = g.constant(2.0);
    let less = g.compare(Comparison::Less, one, two);
    assert_eq!(g.select(less, x, y), x);
    let open = g.compare(Comparison::Less, x, y);
    assert_eq!(g.select(open, x, x), x);
    let never = g.bool(false);
    assert_eq!(g.and(open, never), never);
}

#[test]
fn functions_of_inverse_functions_are_roots() {
    let (mut g, x, ..) = three();
    let arcsine = g.call(Function::Asin, x);
    let arccosine = g.call(Function::Acos, x);
    let arctangent = g.call(Function::Atan, x);
    let cosine = g.call(Function::Cos, arcsine);
    assert!(matches!(g.op(cosine), Op::Call(Function::Sqrt, _)));
    assert_eq!(g.call(Function::Sin, arccosine), cosine);
    assert_eq!(g.call(Function::Tan, arctangent), x);
    // Outside of −1..1 neither has a value, so what is outside stays what it is.
    let sine = g.call(Function::Sin, arcsine);
    assert!(matches!(g.op(sine), Op::Call(Function::Sin, _)));
}
