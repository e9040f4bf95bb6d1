//! Kinks of equations that a run passes: where a condition of an `if` changes, and where `abs`, `max` and
//! `min` take their other side.

use kin_graph::{Formula, Function, Function2, Input, LeafUse, Node, Op, Results, Source, evaluate};

use crate::model::formula::{Given, Outside, Table, jet_of_law};
use crate::numbers::real::Dual3_64;
use crate::solve::motion::{Event, EventKind, Motion};
use crate::system::System;
use crate::system::evaluate::Block;

/// Each step of a motion is looked at in so many places; a condition that holds for less than that and not at
/// its ends is not seen.
const PLACES: usize = 4;

impl System {
    /// Tells the motion of each kink that it passes.
    pub(crate) fn note_kinks(&self, motion: &mut Motion) {
        if self.switching().is_empty() {
            return;
        }
        // Where the motion cannot be followed more finely, its own times tell what they can.
        let fine = self.fine(motion, None).unwrap_or_else(|_| motion.clone());
        self.note_kinks_along(&fine, motion);
    }

    /// The same of kinks that another motion passes between its times, along quintics.
    pub(crate) fn note_kinks_along(&self, along: &Motion, motion: &mut Motion) {
        for &block in self.switching() {
            let block = &self.equations().blocks[block];
            let events = block.constraint.formula(|table, parameters, outside| {
                let formula = table.formula();
                Watched { system: self, block, table, formula, parameters, outside }.events(along)
            });
            events.into_iter().flatten().for_each(|event| motion.add_event(event));
        }
    }
}

/// An equation along a motion.
struct Watched<'a> {
    system: &'a System,
    block: &'a Block,
    table: &'a Table,
    formula: &'a Formula,
    parameters: &'a [f64],
    outside: Outside<'a>,
}

impl Watched<'_> {
    fn events(&self, motion: &Motion) -> Vec<Event> {
        let local = self.local(motion);
        let switches: Vec<Node> = self
            .formula
            .graph
            .reachable(&self.formula.rows)
            .into_iter()
            .filter(|node| self.is_switch(*node))
            .collect();
        let at = |q: &[f64], t: f64| self.sides(&switches, &local(q), t);
        let (mut all, times) = (Vec::new(), motion.times());
        let Some(&first) = times.first() else { return all };
        let mut before = at(motion.q(0), first);
        for k in 0..times.len().saturating_sub(1) {
            let quintics = motion.quintics(k);
            let (from, to) = (times[k], times[k + 1]);
            let pose = |u: f64| -> Vec<f64> {
                quintics.iter().map(|c| c.iter().rev().fold(0.0, |sum, c| sum * u + c)).collect()
            };
            let along = |u: f64| {
                at(&if u == 1.0 { motion.q(k + 1).to_vec() } else { pose(u) }, from + u * (to - from))
            };
            for place in 1..=PLACES {
                let (low, high) = ((place - 1) as f64 / PLACES as f64, place as f64 / PLACES as f64);
                let after = along(high);
                for (step, side) in after.iter().enumerate() {
                    if let (Some(old), Some(new)) = (before[step], *side)
                        && old != new
                    {
                        let u = first_with(new, [low, high], &|u| along(u)[step]);
                        all.push(self.event(switches[step], new, from + u * (to - from)));
                    }
                }
                before = after;
            }
        }
        all
    }

    /// The columns of the equation from all coordinates; the ground's are what they are.
    fn local(&self, motion: &Motion) -> impl Fn(&[f64]) -> Vec<f64> + use<> {
        let arguments = self.block.constraint.arguments();
        let instant = self.system.equations().instant_at(0.0, motion.q(0));
        let at = self.system.equations().at(self.block, &instant);
        let still = arguments
            .iter()
            .enumerate()
            .flat_map(|(k, argument)| at.coordinates(k, argument.target.columns()).to_vec());
        let moving = arguments.iter().flat_map(|argument| self.system.layout().columns(argument));
        let columns: Vec<(f64, Option<usize>)> = still.zip(moving).collect();
        move |q| {
            columns
                .iter()
                .map(|(still, column)| column.and_then(|column| q.get(column)).copied().unwrap_or(*still))
                .collect()
        }
    }

    fn is_switch(&self, node: Node) -> bool {
        matches!(
            self.formula.graph.op(node),
            Op::Select(..)
                | Op::Call(Function::Abs | Function::Signum, _)
                | Op::Call2(Function2::Max | Function2::Min, ..)
        )
    }

    /// The side that each switch is on; `None` of one that has no part in the rows.
    fn sides(&self, switches: &[Node], q: &[f64], t: f64) -> Vec<Option<bool>> {
        let graph = &self.formula.graph;
        let results = evaluate(
            graph,
            &self.formula.rows,
            &Given64 { q, t, parameters: self.parameters, outside: self.outside },
        );
        let holds = |node: Node| results.condition(node).unwrap_or_default();
        let (mut seen, mut open) = (vec![false; graph.len()], self.formula.rows.clone());
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.index()], true) {
                open.extend(graph.numbers_behind(node, holds));
            }
        }
        switches.iter().map(|node| seen[node.index()].then(|| self.side(*node, &results))).collect()
    }

    fn side(&self, node: Node, results: &Results<f64>) -> bool {
        let of = |node: Node| results.number(node).unwrap_or(f64::NAN);
        match self.formula.graph.op(node) {
            Op::Select(c, ..) => results.condition(c).unwrap_or_default(),
            Op::Call(_, a) => of(a) >= 0.0,
            Op::Call2(_, a, b) => of(a) >= of(b),
            _ => false,
        }
    }

    fn event(&self, node: Node, new: bool, t: f64) -> Event {
        let (told, what) = match self.formula.graph.op(node) {
            Op::Select(c, ..) => {
                (self.formula.expression(c), if new { "begins to hold" } else { "ceases to hold" })
            }
            _ => (self.formula.expression(node), "takes its other side"),
        };
        let (text, place) = told.map_or((String::new(), String::new()), |expression| {
            (format!("`{}` ", expression.text), format!(" ({})", self.table.source(expression)))
        });
        let (name, units) = (self.block.name.clone(), self.system.layout().words.clone());
        Event {
            t,
            units,
            kind: EventKind::Kink,
            text: format!("a kink of `{name}`: {text}{what}{place}"),
            name,
        }
    }
}

/// The arguments of one evaluation of an equation.
struct Given64<'a> {
    q: &'a [f64],
    t: f64,
    parameters: &'a [f64],
    outside: Outside<'a>,
}

impl Source<f64> for Given64<'_> {
    fn input(&self, input: Input) -> f64 {
        let given = match input {
            Input::Column(k) => self.q.get(k).copied(),
            Input::Time => Some(self.t),
            Input::Parameter(k) => self.parameters.get(k).copied(),
            _ => None,
        };
        given.unwrap_or(f64::NAN)
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        jet_of_law(self.outside, law, x, order)[0]
    }

    fn opaque(&self, number: usize, component: usize, operands: Vec<f64>) -> f64 {
        let operands: Vec<Dual3_64> = operands.into_iter().map(Dual3_64::from_re).collect();
        Given::by(self.outside, number, &operands).number(component).re
    }

    /// Calls stand in formulas as values of the user's program.
    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        f64::NAN
    }
}

/// The first place, as nearly as can be told, at which a switch is on that side.
fn first_with(side: bool, [mut low, mut high]: [f64; 2], at: &dyn Fn(f64) -> Option<bool>) -> f64 {
    const HALVINGS: usize = 50;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if at(middle) == Some(side) { high = middle } else { low = middle }
    }
    high
}
