//! Computes the first derivatives of one value by all columns at once, from the value inwards.
//!
//! If a value is a long chain of sums and products, this pass is cheaper than differentiation
//! column by column.

use std::collections::BTreeMap;

use super::partial::{By, input_derivative};
use crate::{Column, Graph, Input, Node, Op, Part};

/// Estimates the operations that differentiation inwards from each of `rows` saves, compared with
/// differentiation column by column.
///
/// The estimate counts the products and sums of both ways, before simplification and without shared
/// nodes.
pub fn promise_of_columns(g: &Graph, rows: &[Node], columns: &[Column]) -> usize {
    let inward = rows.iter().map(|&row| inward_work(g, row)).sum();
    forward_work(g, rows, columns).saturating_sub(inward)
}

/// Operations for the derivatives of all nodes behind `rows` by each column.
fn forward_work(g: &Graph, rows: &[Node], columns: &[Column]) -> usize {
    let nodes = moving(g, rows);
    let mut moves = vec![false; g.len()];
    let mut work = 0;
    for column in columns {
        for &node in &nodes {
            moves[node.index()] = match g.op(node) {
                Op::Input(input) => moves_with(input, column),
                Op::Mul(a, b) => {
                    let left = moves[a.index()];
                    let right = moves[b.index()];
                    work += [0, 1, 3][usize::from(left) + usize::from(right)];
                    left || right
                }
                Op::Add(a, b) | Op::Sub(a, b) => {
                    let left = moves[a.index()];
                    let right = moves[b.index()];
                    work += usize::from(left && right);
                    left || right
                }
                Op::Neg(a) => moves[a.index()],
                _ => false,
            };
        }
    }
    work
}

fn moves_with(input: Input, column: &Column) -> bool {
    match input {
        Input::State(argument, Part::Sin | Part::Cos) => argument == column.argument,
        Input::State(argument, part) => argument == column.argument && part == column.part,
        _ => false,
    }
}

/// Operations for the derivatives of one row by all nodes behind it.
fn inward_work(g: &Graph, row: Node) -> usize {
    let mut work = 0;
    let mut used = vec![false; g.len()];
    for node in moving(g, &[row]) {
        let is_product = matches!(g.op(node), Op::Mul(..));
        g.each_operand(node, |operand| {
            if g.depends(operand).on_q {
                let again = std::mem::replace(&mut used[operand.index()], true);
                work += usize::from(is_product) + usize::from(again);
            }
        });
    }
    work
}

/// The nodes behind `rows` that depend on coordinates.
fn moving(g: &Graph, rows: &[Node]) -> Vec<Node> {
    g.reachable(rows).into_iter().filter(|&node| g.depends(node).on_q).collect()
}

/// Returns ∂node/∂column for each of `columns`, zeros included.
///
/// Returns `None` if the node depends on coordinates by operations other than sums and products.
pub fn by_columns(g: &mut Graph, node: Node, columns: &[Column]) -> Option<Vec<Node>> {
    let inwards = gradient(g, node)?;
    let zero = g.zero();
    let sum = |g: &mut Graph, column: &Column| {
        inwards.values().fold(zero, |sum, &(input, adjoint)| {
            let derivative = input_derivative(g, input, By::Column(*column));
            let term = g.mul(adjoint, derivative);
            g.add(sum, term)
        })
    };
    Some(columns.iter().map(|column| sum(g, column)).collect())
}

/// The derivatives by all inputs that are, or depend on, coordinates.
fn gradient(g: &mut Graph, node: Node) -> Option<BTreeMap<usize, (Input, Node)>> {
    let moving = moving(g, &[node]);
    let mut adjoints: BTreeMap<Node, Node> = BTreeMap::from([(node, g.constant(1.0))]);
    let mut found = BTreeMap::new();
    for &n in moving.iter().rev() {
        let Some(adjoint) = adjoints.remove(&n) else { continue };
        let terms = match g.op(n) {
            Op::Input(input) => {
                found.insert(n.index(), (input, adjoint));
                continue;
            }
            Op::Add(a, b) => [Some((a, adjoint)), Some((b, adjoint))],
            Op::Sub(a, b) => [Some((a, adjoint)), Some((b, g.neg(adjoint)))],
            Op::Neg(a) => [Some((a, g.neg(adjoint))), None],
            Op::Mul(a, b) => [Some((a, g.mul(adjoint, b))), Some((b, g.mul(adjoint, a)))],
            _ => return None,
        };
        for (operand, term) in terms.into_iter().flatten() {
            if g.depends(operand).on_q {
                let before = adjoints.get(&operand).copied();
                let sum = before.map_or(term, |before| g.add(before, term));
                adjoints.insert(operand, sum);
            }
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::super::Partial;
    use super::*;
    use crate::Function;
    use crate::testing::{SplitMix, value};

    /// Coordinates and sine of some angles, and a row of sums and products of them.
    fn row(random: &mut SplitMix) -> (Graph, Node, HashMap<Input, f64>) {
        let mut g = Graph::default();
        let inputs: Vec<Input> = (0..3)
            .flat_map(|k| [Part::Theta, Part::Sin, Part::Cos].map(|part| Input::State(k, part)))
            .chain([Input::Time, Input::Parameter(0)])
            .collect();
        let mut nodes: Vec<Node> = inputs.iter().map(|&input| g.input(input)).collect();
        for _ in 0..40 {
            let a = nodes[random.below(nodes.len())];
            let b = nodes[random.below(nodes.len())];
            let node = match random.below(5) {
                0 => g.add(a, b),
                1 => g.sub(a, b),
                2 => g.neg(a),
                _ if nodes.len() < 30 => g.mul(a, b),
                _ => g.mul(a, nodes[random.below(11)]),
            };
            nodes.push(node);
        }
        let numbers =
            inputs.into_iter().map(|input| (input, random.below(5) as f64 - 2.0)).collect();
        (g, nodes[nodes.len() - 1], numbers)
    }

    #[test]
    fn inwards_is_column_by_column() {
        let mut random = SplitMix(5);
        let mut compared = 0;
        let mut zeros = 0;
        for _ in 0..300 {
            let (mut g, row, numbers) = row(&mut random);
            let columns: Vec<Column> =
                (0..3).map(|argument| Column { argument, part: Part::Theta }).collect();
            let found = by_columns(&mut g, row, &columns).expect("sums and products");
            for (column, found) in columns.into_iter().zip(found) {
                let expected = Partial::by_column(column).of(&mut g, row);
                let found = value(&g, found, &numbers);
                let expected = value(&g, expected, &numbers);
                if expected.abs() < 2f64.powi(50) {
                    assert_eq!(found, expected);
                    compared += 1;
                    zeros += usize::from(expected == 0.0);
                }
            }
        }
        assert!(compared > 700 && compared - zeros > 300, "{compared} compared, {zeros} are zero");
    }

    #[test]
    fn other_functions_of_coordinates_are_left_alone() {
        let mut g = Graph::default();
        let x = g.input(Input::State(0, Part::Theta));
        let y = g.input(Input::Parameter(0));
        let columns = [Column { argument: 0, part: Part::Theta }];
        let root = g.call(Function::Sqrt, x);
        assert!(by_columns(&mut g, root, &columns).is_none());
        let of_parameters = g.call(Function::Sqrt, y);
        let product = g.mul(x, of_parameters);
        assert_eq!(by_columns(&mut g, product, &columns), Some(vec![of_parameters]));
    }
}
