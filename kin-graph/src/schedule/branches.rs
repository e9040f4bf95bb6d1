//! Finds the nodes that only one branch of a choice needs, so that emitted code runs only the
//! selected branch.
//!
//! All selections by one condition at the same depth below the outputs are one choice, so that a
//! value and its derivatives test the condition once. A node belongs to the innermost branch that
//! contains all of its uses. A choice with few operations remains a selection, because a processor
//! computes both values faster than it branches.

use std::collections::BTreeMap;

use super::lookups::{Cells, Lookup, lookups};
use crate::{Graph, Node, Op};

/// Work below which both branches are computed.
const SHORT: usize = 16;

/// Branches in branches beyond this depth are computed outside: emitted code is read by a compiler
/// that recurses.
const DEEPEST: usize = 256;

/// A place where nodes are computed: the whole code, or a branch of a choice.
type Scope = usize;

/// The whole code.
const WHOLE: Scope = 0;

/// Selections by one condition that the code makes together.
#[derive(Clone)]
pub struct Choice {
    pub condition: Node,
    /// The selections, each with its value if the condition holds and its value otherwise.
    pub selections: Vec<Node>,
    /// Nodes from outside a branch that the branch reads.
    pub reads: Vec<Node>,
}

/// The choices of some code, and the choice of each selection.
#[derive(Default)]
pub struct Branches {
    choices: Vec<Choice>,
    /// The choice of each selection by number of the node, counted from 1; 0 of all other nodes.
    /// Empty where there is no choice.
    choice_of: Vec<u32>,
    lookups: Vec<Lookup>,
    /// Which nodes are numbers of a table.
    cells: Cells,
}

impl Branches {
    /// Returns branches without choices: every selection computes both values.
    pub fn none() -> Self {
        Branches::default()
    }

    /// Finds the choices among `outputs` that save operations, up to the `given` nodes.
    ///
    /// Kin uses a table if `can` says that the code can read it.
    pub fn new(
        g: &Graph,
        outputs: &[Node],
        given: impl Fn(Node) -> bool,
        can: impl Fn(&Lookup) -> bool,
    ) -> Self {
        Self::longer_than(SHORT, g, outputs, given, can)
    }

    /// The same of choices with at least so much work in their branches.
    fn longer_than(
        short: usize,
        g: &Graph,
        outputs: &[Node],
        given: impl Fn(Node) -> bool,
        can: impl Fn(&Lookup) -> bool,
    ) -> Self {
        let nodes: Vec<Node> =
            g.reachable_from(outputs, &given).into_iter().filter(|&node| !given(node)).collect();
        if !nodes.iter().any(|&node| matches!(g.op(node), Op::Select(..))) {
            return Branches::none();
        }
        let (lookups, cells) = lookups(g, &nodes, can);
        let tables = Branches { lookups, cells, ..Branches::none() };
        // Nodes that only the chains of tables hold are not computed.
        let nodes = if tables.lookups.is_empty() {
            nodes
        } else {
            tables.reachable(g, outputs, &given).into_iter().filter(|&node| !given(node)).collect()
        };
        let mut places = Places::new(g, &tables, &nodes, outputs);
        places.find(g, &tables);
        places.close(g, short);
        places.into_branches(g, tables)
    }

    /// Returns the index of the table that contains a node, and its column.
    pub fn cell(&self, node: Node) -> Option<(usize, usize)> {
        let (lookup, column) = self.cells.get(node.index()).copied().unwrap_or_default();
        Some((lookup.checked_sub(1)? as usize, column.checked_sub(1)? as usize))
    }

    pub fn lookup(&self, number: usize) -> &Lookup {
        &self.lookups[number]
    }

    /// Returns the choice to which a node belongs.
    pub fn choice(&self, node: Node) -> Option<&Choice> {
        match self.choice_of.get(node.index()) {
            None | Some(0) => None,
            Some(&choice) => Some(&self.choices[choice as usize - 1]),
        }
    }

    /// Every node that has to be computed for `outputs` outside the branches of their choices, and
    /// the `given` nodes that these read, in order of creation.
    pub(super) fn reachable(
        &self,
        g: &Graph,
        outputs: &[Node],
        given: impl Fn(Node) -> bool,
    ) -> Vec<Node> {
        if self.choices.is_empty() && self.lookups.is_empty() {
            return g.reachable_from(outputs, given);
        }
        // A choice may read nodes that were created after one of its selections.
        let mut seen = vec![false; g.len()];
        let mut open: Vec<Node> = outputs.to_vec();
        let mut found = Vec::new();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.index()], true) {
                found.push(node);
                if !given(node) {
                    self.each_operand(g, node, |operand| open.push(operand));
                }
            }
        }
        found.sort_unstable();
        found
    }

    /// Passes the nodes that must be known before a node to `show`: its operands, or for a choice
    /// its condition and the nodes that its branches read.
    pub fn each_operand(&self, g: &Graph, node: Node, mut show: impl FnMut(Node)) {
        if let Some((lookup, _)) = self.cell(node) {
            return self.lookups[lookup].searched().for_each(show);
        }
        match self.choice(node) {
            None => g.each_operand(node, show),
            Some(choice) => {
                show(choice.condition);
                choice.reads.iter().copied().for_each(show);
            }
        }
    }
}

/// Where each node is computed, while it is found.
struct Places {
    /// Nodes by how many selections lie above them, users before their operands.
    levels: Vec<Vec<Node>>,
    /// The scope that holds all uses of each node that were seen, by its number.
    scope: Vec<Option<Scope>>,
    found: Vec<Found>,
    /// The choice of each selection, by number of the node.
    choice: Vec<Option<usize>>,
}

struct Found {
    condition: Node,
    selections: Vec<Node>,
    outside: Scope,
    depth: usize,
    /// Work in its branches.
    work: usize,
    open: bool,
}

/// The scope of a branch of a choice.
fn branch(choice: usize, taken: bool) -> Scope {
    1 + 2 * choice + usize::from(!taken)
}

impl Places {
    fn new(g: &Graph, tables: &Branches, nodes: &[Node], outputs: &[Node]) -> Self {
        let mut level = vec![0; g.len()];
        let mut levels: Vec<Vec<Node>> = Vec::new();
        for &node in nodes.iter().rev() {
            let own = level[node.index()];
            levels.resize_with(levels.len().max(own + 1), Vec::new);
            levels[own].push(node);
            let below = own + usize::from(selects(g, tables, node).is_some());
            tables.each_operand(g, node, |operand| {
                level[operand.index()] = below.max(level[operand.index()])
            });
        }
        let mut scope = vec![None; g.len()];
        outputs.iter().for_each(|output| scope[output.index()] = Some(WHOLE));
        Places { levels, scope, found: Vec::new(), choice: vec![None; g.len()] }
    }

    /// Finds the scope of every node, level by level: all selections of a level are placed before
    /// what they choose between.
    fn find(&mut self, g: &Graph, tables: &Branches) {
        let levels = std::mem::take(&mut self.levels);
        for level in &levels {
            let mut choices: BTreeMap<Node, Vec<Node>> = BTreeMap::new();
            for &node in level {
                match selects(g, tables, node) {
                    Some([condition, ..]) => choices.entry(condition).or_default().push(node),
                    None => {
                        let scope = self.scope_of(node);
                        tables.each_operand(g, node, |operand| self.use_in(operand, scope));
                    }
                }
            }
            choices
                .into_iter()
                .for_each(|(condition, selections)| self.choose(g, condition, selections));
        }
        self.levels = levels;
    }

    /// Places selections by one condition where all of them are needed, and their values in its
    /// branches.
    fn choose(&mut self, g: &Graph, condition: Node, selections: Vec<Node>) {
        let mut scopes = selections.iter().map(|&node| self.scope_of(node));
        let first = scopes.next().unwrap_or(WHOLE);
        let outside = scopes.fold(first, |a, b| self.common(a, b));
        let choice = self.found.len();
        let depth = self.depth(outside) + 1;
        self.found.push(Found {
            condition,
            selections: vec![],
            outside,
            depth,
            work: 0,
            open: true,
        });
        self.use_in(condition, outside);
        for &node in &selections {
            (self.scope[node.index()], self.choice[node.index()]) = (Some(outside), Some(choice));
            if let Op::Select(_, a, b) = g.op(node) {
                self.use_in(a, branch(choice, true));
                self.use_in(b, branch(choice, false));
            }
        }
        self.found[choice].selections = selections;
    }

    fn scope_of(&self, node: Node) -> Scope {
        self.scope[node.index()].unwrap_or(WHOLE)
    }

    fn use_in(&mut self, node: Node, scope: Scope) {
        let known = self.scope[node.index()];
        self.scope[node.index()] = Some(known.map_or(scope, |known| self.common(known, scope)));
    }

    /// How many branches lie around a scope.
    fn depth(&self, scope: Scope) -> usize {
        if scope == WHOLE { 0 } else { self.found[(scope - 1) / 2].depth }
    }

    fn outside(&self, scope: Scope) -> Scope {
        if scope == WHOLE { WHOLE } else { self.found[(scope - 1) / 2].outside }
    }

    /// The innermost scope that holds both.
    fn common(&self, mut a: Scope, mut b: Scope) -> Scope {
        while a != b {
            if self.depth(a) >= self.depth(b) { a = self.outside(a) } else { b = self.outside(b) }
        }
        a
    }

    /// Closes choices that are not worth a question, or too deep; inner ones were found after outer
    /// ones.
    fn close(&mut self, g: &Graph, short: usize) {
        for &node in self.levels.iter().flatten() {
            let scope = self.scope_of(node);
            if scope != WHOLE {
                self.found[(scope - 1) / 2].work += work(g.op(node));
            }
        }
        for k in (0..self.found.len()).rev() {
            let Found { outside, depth, work, .. } = self.found[k];
            self.found[k].open = work >= short && depth <= DEEPEST;
            if outside != WHOLE {
                self.found[(outside - 1) / 2].work += work;
            }
        }
    }

    /// The innermost open scope around a scope.
    fn open(&self, mut scope: Scope) -> Scope {
        while scope != WHOLE && !self.found[(scope - 1) / 2].open {
            scope = self.outside(scope);
        }
        scope
    }

    fn into_branches(self, g: &Graph, tables: Branches) -> Branches {
        let mut reads: Vec<Vec<Node>> = vec![Vec::new(); self.found.len()];
        for &node in self.levels.iter().flatten() {
            match (selects(g, &tables, node), self.choice[node.index()]) {
                (Some([condition, a, b]), Some(k)) if self.found[k].open => {
                    self.read(condition, self.open(self.found[k].outside), &mut reads);
                    self.read(a, branch(k, true), &mut reads);
                    self.read(b, branch(k, false), &mut reads);
                }
                _ => {
                    let scope = self.open(self.scope_of(node));
                    tables.each_operand(g, node, |operand| self.read(operand, scope, &mut reads));
                }
            }
        }
        let mut branches = Branches { choice_of: vec![0; g.len()], ..tables };
        for (found, mut reads) in self.found.into_iter().zip(reads).filter(|(found, _)| found.open)
        {
            reads.sort_unstable();
            reads.dedup();
            let Found { condition, selections, .. } = found;
            branches.choices.push(Choice { condition, selections, reads });
            let choice = branches.choices.len() as u32;
            let selections = &branches.choices[branches.choices.len() - 1].selections;
            selections.iter().for_each(|node| branches.choice_of[node.index()] = choice);
        }
        branches
    }

    /// Notes that a node is used in a scope: every choice between that and the node's own scope
    /// reads it.
    fn read(&self, node: Node, mut scope: Scope, reads: &mut [Vec<Node>]) {
        let own = self.open(self.scope_of(node));
        while scope != own && scope != WHOLE {
            let choice = (scope - 1) / 2;
            reads[choice].push(node);
            scope = self.open(self.found[choice].outside);
        }
    }
}

/// The condition and the values of a selection that is no number of a table.
fn selects(g: &Graph, tables: &Branches, node: Node) -> Option<[Node; 3]> {
    match g.op(node) {
        Op::Select(condition, a, b) if tables.cell(node).is_none() => Some([condition, a, b]),
        _ => None,
    }
}

/// The work of an operation, roughly in additions.
fn work(op: Op) -> usize {
    match op {
        Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_) | Op::Neg(_) => 0,
        Op::Call(..) | Op::Call2(..) | Op::Law(..) | Op::Opaque(..) | Op::Leaf(_) => 8,
        Op::Div(..) | Op::Powi(..) => 4,
        _ => 1,
    }
}

#[cfg(test)]
mod tests;
