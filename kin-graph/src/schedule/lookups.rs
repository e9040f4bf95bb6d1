//! Finds chains of selections between given numbers, by tests of one number, which become tables.
//!
//! Chains with the same tests share a table and find their row once.

use super::tables::{Chain, Test, chain, depths, is_given};
use crate::{Comparison, Graph, Node};

/// A table. Its row is the row of the first tests that are true, otherwise the last row.
pub struct Lookup {
    /// The tests that must hold together.
    pub tests: Vec<Test>,
    /// For each test the numbers, one for each row except the last.
    pub knots: Vec<Vec<Node>>,
    /// The numbers of the table, by column.
    pub columns: Vec<Vec<Node>>,
    chain: Chain,
}

/// For each node its lookup and its column, counted from 1; 0 for a node that is in no lookup.
pub type Cells = Vec<(u32, u32)>;

/// Returns the lookups among `nodes` that `can` be read.
///
/// A chain that is part of another chain is not a separate lookup.
pub fn lookups(g: &Graph, nodes: &[Node], can: impl Fn(&Lookup) -> bool) -> (Vec<Lookup>, Cells) {
    let Some(depths) = depths(g, nodes) else { return (vec![], vec![]) };
    let (mut found, mut cells): (Vec<Lookup>, Cells) = (vec![], vec![(0, 0); g.len()]);
    let mut inner = vec![false; g.len()];
    for &root in
        nodes.iter().rev().filter(|node| depths.get(node.index()).is_some_and(|&depth| depth > 0))
    {
        if inner[root.index()] {
            continue;
        }
        let Some(chain) = chain(g, root, &depths) else { continue };
        let values = chain.values();
        if !values.iter().all(|&value| is_given(g, value)) {
            continue;
        }
        let mut node = root;
        for step in &chain.steps {
            inner[node.index()] = true;
            if let crate::Op::Select(_, a, b) = g.op(node) {
                node = if step.negated { a } else { b };
            }
        }
        let place = found.iter_mut().position(|lookup| lookup.take(&chain)).unwrap_or_else(|| {
            found.push(Lookup::new(chain.clone()));
            found.len() - 1
        });
        let lookup = &mut found[place];
        lookup.columns.push(values);
        cells[root.index()] = (place as u32 + 1, lookup.columns.len() as u32);
    }
    found.iter_mut().for_each(Lookup::finish);
    let readable: Vec<bool> = found.iter().map(can).collect();
    cells
        .iter_mut()
        .filter(|cell| cell.0 > 0 && !readable[cell.0 as usize - 1])
        .for_each(|cell| *cell = (0, 0));
    (found, cells)
}

impl Lookup {
    fn new(chain: Chain) -> Self {
        Lookup { tests: vec![], knots: vec![], columns: vec![], chain }
    }

    /// True if a chain finds its numbers in this table; its last pieces may be one where their
    /// numbers are the same.
    fn take(&mut self, chain: &Chain) -> bool {
        let own = &self.chain.steps;
        let other = &chain.steps;
        let same = own
            .iter()
            .zip(other)
            .all(|(a, b)| a.condition == b.condition && a.negated == b.negated);
        if same && other.len() > own.len() {
            self.chain = chain.clone();
        }
        same
    }

    fn finish(&mut self) {
        let steps = &self.chain.steps;
        for column in &mut self.columns {
            let last = column[column.len() - 1];
            column.resize(steps.len() + 1, last);
        }
        self.tests = steps[0].tests.iter().map(|(test, _)| *test).collect();
        self.knots = (0..self.tests.len())
            .map(|k| steps.iter().map(|step| step.tests[k].1).collect())
            .collect();
    }

    /// Returns the nodes whose rows the lookup searches.
    pub fn searched(&self) -> impl Iterator<Item = Node> + '_ {
        self.tests.iter().map(|test| test.of)
    }

    /// Returns the direction of each test, if all knots are sorted constants, so that bisection can
    /// find the row.
    ///
    /// The direction is true if the test becomes true at a knot, and false if it becomes false.
    pub fn begins(&self, g: &Graph) -> Option<Vec<bool>> {
        let begins = |(test, knots): (&Test, &Vec<Node>)| {
            let numbers: Vec<f64> =
                knots.iter().map(|&knot| g.constant_value(knot)).collect::<Option<_>>()?;
            let rising = numbers.windows(2).all(|pair| pair[0] <= pair[1]);
            let falling = numbers.windows(2).all(|pair| pair[0] >= pair[1]);
            let less = match test.comparison {
                Comparison::Less | Comparison::LessEqual => true,
                Comparison::Greater | Comparison::GreaterEqual => false,
                Comparison::Equal | Comparison::NotEqual => return None,
            };
            let grows = less == test.on_the_left;
            match (rising, falling) {
                (true, _) => Some(grows != test.negated),
                (_, true) => Some(grows == test.negated),
                _ => None,
            }
        };
        self.tests.iter().zip(&self.knots).map(begins).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::SplitMix;
    use crate::{Function, Input};

    /// A chain by these tests of x, with its own numbers for values.
    fn chain_of(
        g: &mut Graph,
        comparison: Comparison,
        knots: &[f64],
        negated: bool,
        turned: bool,
    ) -> Node {
        let x = g.input(Input::Column(0));
        let mut all = g.constant(100.0);
        for (k, &knot) in knots.iter().enumerate().rev() {
            let knot = g.constant(knot);
            let own = g.constant(k as f64 + 1.0);
            let condition = if turned {
                g.compare(comparison, knot, x)
            } else {
                g.compare(comparison, x, knot)
            };
            all =
                if negated { g.select(condition, all, own) } else { g.select(condition, own, all) };
        }
        all
    }

    fn only(g: &Graph, root: Node) -> Lookup {
        let (mut found, cells) = lookups(g, &g.reachable(&[root]), |_| true);
        assert_eq!((found.len(), cells[root.index()]), (1, (1, 1)));
        found.remove(0)
    }

    #[test]
    fn knots_in_order_are_known_to_be_so() {
        let mut random = SplitMix(11);
        let mut in_order = 0;
        for turn in 0..400 {
            let mut knots: Vec<f64> = (0..5).map(|_| random.below(9) as f64 - 4.0).collect();
            match turn % 3 {
                0 => knots.sort_by(f64::total_cmp),
                1 => knots.sort_by(|a, b| b.total_cmp(a)),
                _ => {}
            }
            let comparison = Comparison::ALL[random.below(4)];
            let negated = random.below(2) == 0;
            let turned = random.below(2) == 0;
            let mut g = Graph::default();
            let root = chain_of(&mut g, comparison, &knots, negated, turned);
            let lookup = only(&g, root);
            let Some(begins) = lookup.begins(&g) else { continue };
            in_order += 1;
            for x in [f64::NEG_INFINITY, -3.5, -2.0, 0.0, 0.5, 4.0, 7.0, f64::NAN] {
                let holds = |knot: &f64| {
                    let (a, b) = if turned { (*knot, x) } else { (x, *knot) };
                    comparison.holds(&a, &b) != negated
                };
                let changes = knots.windows(2).map(|pair| (holds(&pair[0]), holds(&pair[1])));
                for (before, after) in changes {
                    assert!(
                        before == after || after == begins[0],
                        "{knots:?} {comparison:?} at {x}"
                    );
                }
            }
        }
        assert!(in_order > 200, "{in_order}");
    }

    #[test]
    fn chains_by_the_same_tests_are_one_table() {
        let mut g = Graph::default();
        let first = chain_of(&mut g, Comparison::Less, &[1.0, 2.0, 3.0, 4.0], false, false);
        let short = chain_of(&mut g, Comparison::Less, &[1.0, 2.0, 3.0], false, false);
        let other = chain_of(&mut g, Comparison::LessEqual, &[1.0, 2.0, 3.0], false, false);
        let moving = g.input(Input::Column(1));
        let no_table = g.call(Function::Sin, moving);
        let all = [first, short, other, no_table];
        let (found, cells) = lookups(&g, &g.reachable(&all), |_| true);
        assert_eq!(found.len(), 2);
        assert_eq!(cells[first.index()].0, cells[short.index()].0);
        assert_ne!(cells[first.index()].0, cells[other.index()].0);
        let table = &found[cells[first.index()].0 as usize - 1];
        assert!(table.columns.iter().all(|column| column.len() == 5) && table.knots[0].len() == 4);
        let (_, none) = lookups(&g, &g.reachable(&all), |_| false);
        assert!(none.iter().all(|cell| *cell == (0, 0)));
    }
}
