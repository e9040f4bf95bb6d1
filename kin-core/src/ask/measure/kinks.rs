//! Finds the kinks of equations that a run passes: the condition of an `if` changes, or `abs`,
//! `max` or `min` changes its branch.

use kin_graph::{Formula, Node, Op, Results, evaluate};

use crate::model::formula::bounds::Inputs;
use crate::model::formula::sides::{Kink, Numbers};
use crate::model::formula::{Outside, Table};
use crate::numbers::enclosure::interval::Interval;
use crate::numbers::enclosure::series::{Series, UNKNOWN};
use crate::solve::motion::{Event, EventKind, Motion};
use crate::solve::options::{Engine, SolverOptions};
use crate::system::System;
use crate::system::evaluate::Block;

/// The number of places examined in each step of a motion. Between two of them a switch may leave
/// its side and come back; Kin finds that if its margin has one smallest value in between.
const PLACES: usize = 4;

/// Slopes of margins are measured over this share of a step.   \[-\]
const SLOPE: f64 = 1e-4;

/// A margin whose smallest value, by the cubic through both ends, is above this share of the
/// smaller one at the ends does not reach zero.   \[-\]
const CLEAR: f64 = 0.5;

/// Positions may be off by this share of the largest coordinate of their unit.   \[-\]
const ROUNDING: f64 = 1e-13;

impl System {
    /// Adds an event to the motion for each kink that it passes.
    pub(crate) fn note_kinks(&self, motion: &mut Motion) {
        if self.switching().is_empty() {
            return;
        }
        // If the motion cannot be refined, its times must suffice.
        let fine = self.fine(motion, None).map_or_else(|_| motion.clone(), |fine| fine.motion);
        self.note_kinks_along(&fine, motion);
    }

    /// Adds the kinks that another motion passes between its times, along quintics.
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

/// The side of a switch at a position.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    /// The rows do not depend on the switch.
    Unread,
    /// The switch is on its kink, within rounding of the position.
    OnKink,
    Known(bool),
}

impl Watched<'_> {
    /// Returns the kinks that the motion passes. A switch changes its side only if it is clear of
    /// its kink by more than rounding of the position. So a motion at rest on a kink passes none.
    fn events(&self, motion: &Motion) -> Vec<Event> {
        let local = self.local(motion);
        let radii = radii(motion);
        let switches = Kink::all(self.formula);
        let at = |q: &[f64], t: f64| self.sides(&switches, &local(q, &radii), t);
        let mut all = Vec::new();
        let times = motion.times();
        let by_steps = SolverOptions::new().engine(Engine::StepByStep);
        let Some(&first) = times.first() else { return all };
        // The last known side of each switch.
        let mut last: Vec<Option<bool>> = at(motion.q(0), first).into_iter().map(known).collect();
        for k in 0..times.len().saturating_sub(1) {
            let quintics = motion.quintics(k);
            let from = times[k];
            let to = times[k + 1];
            let pose = |u: f64| -> Vec<f64> {
                quintics.iter().map(|c| c.iter().rev().fold(0.0, |sum, c| sum * u + c)).collect()
            };
            let along = |u: f64| {
                at(
                    &if u == 1.0 { motion.q(k + 1).to_vec() } else { pose(u) },
                    from + u * (to - from),
                )
            };
            // Interpolated positions can pass a kink that the motion does not pass.
            let solved = |u: f64| {
                let t = from + u * (to - from);
                if u == 1.0 {
                    Some(along(u))
                } else {
                    self.system
                        .solver()
                        .options(by_steps.clone())
                        .solve_at(t, &pose(u))
                        .ok()
                        .map(|own| at(&own.q, t))
                }
            };
            let margins = |u: f64| {
                let columns = local(&pose(u), &radii);
                self.margins(&switches, &columns, from + u * (to - from))
            };
            let mut left = along(0.0);
            for place in 1..=PLACES {
                let low = (place - 1) as f64 / PLACES as f64;
                let high = place as f64 / PLACES as f64;
                let after = along(high);
                let before = std::mem::replace(&mut left, after.clone());
                let stays =
                    |step: usize| known(before[step]).is_some() && before[step] == after[step];
                for (step, u) in dips(&margins, [low, high], &stays) {
                    let Some(away) = known(along(u)[step]).filter(|away| Some(*away) != last[step])
                    else {
                        continue;
                    };
                    if solved(u).is_some_and(|own| known(own[step]) != Some(away)) {
                        continue;
                    }
                    let out = first_with([low, u], &|u| known(along(u)[step]) == Some(away));
                    let back = first_with([u, high], &|u| along(u)[step] == after[step]);
                    for (u, new) in [(out, away), (back, !away)] {
                        all.push(self.event(switches[step], new, from + u * (to - from)));
                    }
                }
                for (step, side) in after.iter().enumerate() {
                    let Some(new) = known(*side) else {
                        last[step] = last[step].filter(|_| *side == Side::OnKink);
                        continue;
                    };
                    if last[step].is_some_and(|old| old != new) {
                        if solved(high).is_some_and(|own| own[step] != *side) {
                            continue;
                        }
                        let u = first_with([low, high], &|u| along(u)[step] == *side);
                        all.push(self.event(switches[step], new, from + u * (to - from)));
                    }
                    last[step] = Some(new);
                }
            }
        }
        all
    }

    /// Returns the columns of the equation from all coordinates, with their rounding errors. Those
    /// of the ground are exact.
    fn local(&self, motion: &Motion) -> impl Fn(&[f64], &[f64]) -> Vec<[f64; 2]> + use<> {
        let arguments = self.block.constraint.arguments();
        let instant = self.system.equations().instant_at(0.0, motion.q(0));
        let at = self.system.equations().at(self.block, &instant);
        let still = arguments
            .iter()
            .enumerate()
            .flat_map(|(k, argument)| at.coordinates(k, argument.target.columns()).to_vec());
        let moving = arguments.iter().flat_map(|argument| self.system.layout().columns(argument));
        let columns: Vec<(f64, Option<usize>)> = still.zip(moving).collect();
        move |q, radii| {
            let of =
                |list: &[f64], column: Option<usize>| column.and_then(|k| list.get(k)).copied();
            let own = |(still, column): &(f64, Option<usize>)| {
                [of(q, *column).unwrap_or(*still), of(radii, *column).unwrap_or(0.0)]
            };
            columns.iter().map(own).collect()
        }
    }

    /// The margin of each switch ([`Kink::margin`]).
    fn margins(&self, switches: &[(Node, Kink)], columns: &[[f64; 2]], t: f64) -> Vec<f64> {
        let graph = &self.formula.graph;
        let q: Vec<f64> = columns.iter().map(|[x, _]| *x).collect();
        let numbers = Numbers { q: &q, t, parameters: self.parameters, outside: self.outside };
        let results = evaluate(graph, &nodes(switches), &numbers);
        switches.iter().map(|(_, kink)| kink.margin(graph, &results)).collect()
    }

    /// Returns the side of each switch, for columns with these rounding errors.
    fn sides(&self, switches: &[(Node, Kink)], columns: &[[f64; 2]], t: f64) -> Vec<Side> {
        let graph = &self.formula.graph;
        let rows = &self.formula.rows;
        let q: Vec<f64> = columns.iter().map(|[x, _]| *x).collect();
        let parameters = self.parameters;
        let outside = self.outside;
        let results = evaluate(graph, rows, &Numbers { q: &q, t, parameters, outside });
        let holds = |node: Node| results.condition(node).unwrap_or_default();
        let mut seen = vec![false; graph.len()];
        let mut open = rows.clone();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.index()], true) {
                open.extend(graph.numbers_behind(node, holds));
            }
        }
        let bounds =
            |[x, radius]: &[f64; 2]| Series::constant(Interval::new(x - radius, x + radius));
        let (columns, t): (Vec<Series>, _) =
            (columns.iter().map(bounds).collect(), Series::constant(Interval::from(t)));
        let bounds = evaluate(
            graph,
            &nodes(switches),
            &Inputs { columns: &columns, t, parameters, outside },
        );
        let side = |(node, kink): &(Node, Kink)| match seen[node.index()] {
            true => self.side(*kink, &results, &bounds),
            false => Side::Unread,
        };
        switches.iter().map(side).collect()
    }

    /// Returns the side of a switch on which the rows depend. If no bounds are known, the numbers
    /// alone decide.
    fn side(&self, kink: Kink, results: &Results<f64>, bounds: &Results<Series>) -> Side {
        let range = |node: Node| bounds.number(node).map_or(UNKNOWN.value(), |x| x.all_values());
        let is_around_zero = |gap: Interval| gap.is_finite() && gap.contains(0.0) && !gap.is_thin();
        let is_on_kink = match kink {
            Kink::Condition(condition) => self.is_on_an_edge(condition, bounds),
            Kink::Sign(a) => is_around_zero(range(a)),
            Kink::Larger(a, b) => is_around_zero(range(a) - range(b)),
        };
        if is_on_kink { Side::OnKink } else { Side::Known(kink.side(results)) }
    }

    /// Returns true if rounding of the position decides a condition.
    fn is_on_an_edge(&self, condition: Node, bounds: &Results<Series>) -> bool {
        let graph = &self.formula.graph;
        let open = bounds.condition(condition).is_none_or(|known| !known.never && !known.always);
        open && graph.reachable(&[condition]).into_iter().any(|node| match graph.op(node) {
            Op::Compare(_, a, b) => {
                let range =
                    |node: Node| bounds.number(node).map_or(UNKNOWN.value(), |x| x.all_values());
                let gap = range(a) - range(b);
                gap.is_finite() && gap.contains(0.0)
            }
            _ => false,
        })
    }

    fn event(&self, (node, kink): (Node, Kink), new: bool, t: f64) -> Event {
        let (told, what) = match kink {
            Kink::Condition(c) => {
                (self.formula.expression(c), if new { "becomes true" } else { "becomes false" })
            }
            Kink::Sign(_) | Kink::Larger(..) => {
                (self.formula.expression(node), "changes its branch")
            }
        };
        let (text, place) = told.map_or((String::new(), String::new()), |expression| {
            (format!("`{}` ", expression.text), format!(" ({})", self.table.source(expression)))
        });
        let name = self.block.name.clone();
        let units = self.system.layout().words.clone();
        Event {
            t,
            units,
            kind: EventKind::Kink,
            text: format!("a kink of `{name}`: {text}{what}{place}"),
            name,
        }
    }
}

/// Returns the nodes of switches.
fn nodes(switches: &[(Node, Kink)]) -> Vec<Node> {
    switches.iter().map(|(node, _)| *node).collect()
}

/// Returns the side, if it is known.
fn known(side: Side) -> Option<bool> {
    match side {
        Side::Known(side) => Some(side),
        Side::Unread | Side::OnKink => None,
    }
}

/// Returns the rounding error of each coordinate of a motion: a share of the largest coordinate of
/// its unit.
fn radii(motion: &Motion) -> Vec<f64> {
    let units = motion.units();
    let n = units.len();
    let mut most = vec![0.0_f64; n];
    for k in 0..motion.len() {
        most.iter_mut().zip(motion.q(k)).for_each(|(most, q)| *most = most.max(q.abs()));
    }
    let largest = |unit: &String| {
        units.iter().zip(&most).filter(|(own, _)| *own == unit).fold(0.0_f64, |m, (_, x)| m.max(*x))
    };
    units.iter().map(|unit| ROUNDING * largest(unit)).collect()
}

/// Switches whose margins come nearest to zero between two places and may pass it there, each with
/// the place. `stays` is true of a switch that is on one side at both.
fn dips(
    margins: &dyn Fn(f64) -> Vec<f64>,
    [low, high]: [f64; 2],
    stays: &dyn Fn(usize) -> bool,
) -> Vec<(usize, f64)> {
    let width = high - low;
    let small = SLOPE * width;
    let [ends, beside] = [[low, high], [low + small, high - small]].map(|all| all.map(margins));
    let mut found = Vec::new();
    for step in (0..ends[0].len()).filter(|step| stays(*step)) {
        let sign = ends[0][step].signum();
        let values = [0, 1].map(|end| sign * ends[end][step]);
        let nearby = [0, 1].map(|end| sign * beside[end][step]);
        // Slopes inwards from both ends, per width.
        let inwards = [0, 1].map(|end| (nearby[end] - values[end]) / SLOPE);
        if !(values[0] > 0.0 && values[1] > 0.0 && inwards[0] < 0.0 && inwards[1] < 0.0) {
            continue;
        }
        let cubic = |u: f64| {
            let v = 1.0 - u;
            values[0] * v * v * (1.0 + 2.0 * u)
                + values[1] * u * u * (1.0 + 2.0 * v)
                + inwards[0] * u * v * v
                + inwards[1] * v * u * u
        };
        let least = (1..8).map(|k| cubic(f64::from(k) / 8.0)).fold(f64::INFINITY, f64::min);
        if least <= CLEAR * values[0].min(values[1]) {
            found.push((step, lowest([low, high], &|u| sign * margins(u)[step])));
        }
    }
    found
}

/// The place of the smallest value of a function that falls and rises between two places: at once
/// where it is below zero.
fn lowest([mut low, mut high]: [f64; 2], f: &dyn Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 60;
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut values = inner.map(f);
    for _ in 0..STEPS {
        if let Some(k) = (0..2).find(|k| values[*k] < 0.0) {
            return inner[k];
        }
        if values[0] < values[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            values = [f(inner[0]), values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            values = [values[1], f(inner[1])];
        }
    }
    0.5 * (low + high)
}

/// The first place, as nearly as can be told, at which a switch is on its new side.
fn first_with([mut low, mut high]: [f64; 2], is_new: &dyn Fn(f64) -> bool) -> f64 {
    const HALVINGS: usize = 50;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_new(middle) { high = middle } else { low = middle }
    }
    high
}
