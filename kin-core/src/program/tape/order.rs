//! Chooses the order of steps and the runs.
//!
//! The start of a run costs as many instructions as two steps, and most sums and products of a
//! mechanism come in twos and threes. So a product can become a fused step that adds −0, and a sum
//! a fused step that multiplies by 1; the same holds for differences and changes of sign. Results
//! are equal to the last bit, and runs are longer.

use std::ops::Range;

use kin_graph::{Graph, Node};

use super::Kind;
use super::schedule::{Planner, REST, SETUP, Task};

/// The instructions that the start of a run costs, and the additional instructions of a step of
/// three operands.
const RUN: usize = 33;
const MORE: usize = 4;

/// The largest number of runs that become one, so that the time of the search is linear in their
/// number.
const MOST: usize = 64;

/// The constants with which fused steps change nothing.
#[derive(Clone, Copy)]
pub(super) struct Neutral {
    one: Node,
    minus_zero: Node,
}

impl Neutral {
    pub(super) fn new(graph: &mut Graph) -> Self {
        Neutral { one: graph.constant(1.0), minus_zero: graph.constant(-0.0) }
    }
}

/// Orders the tasks stage by stage, each after its operands, and merges similar runs.
pub(super) fn ordered(planner: &mut Planner<'_>, neutral: Neutral) -> Vec<usize> {
    let (order, stretches) = order(planner);
    for stretch in stretches {
        let own = &order[stretch];
        for run in merged(own, |k| planner.tasks[k].kind) {
            let first = planner.tasks[own[run.start]].kind;
            if own[run.clone()].iter().any(|k| planner.tasks[*k].kind != first) {
                own[run].iter().for_each(|k| planner.tasks[*k].fuse(neutral));
            }
        }
    }
    order
}

/// Returns the kind that can replace a kind.
fn family(kind: Kind) -> Kind {
    match kind {
        Kind::Add | Kind::Mul => Kind::Fma,
        Kind::Sub | Kind::Neg => Kind::NegatedProduct,
        kind => kind,
    }
}

impl Task {
    /// Converts the task to a step of its family.
    fn fuse(&mut self, Neutral { one, minus_zero }: Neutral) {
        let [a, b, _] = self.reads;
        self.reads = match self.kind {
            Kind::Add => [a, Some(one), b],
            Kind::Mul => [a, b, Some(minus_zero)],
            Kind::Sub => [b, Some(one), a],
            Kind::Neg => [a, Some(one), Some(minus_zero)],
            _ => return,
        };
        self.kind = family(self.kind);
    }
}

/// Returns the tasks in order, and the stretches that belong to one family.
fn order(planner: &Planner<'_>) -> (Vec<usize>, Vec<Range<usize>>) {
    let tasks = &planner.tasks;
    let mut users = vec![Vec::new(); tasks.len()];
    let mut missing = vec![0_usize; tasks.len()];
    for (k, task) in tasks.iter().enumerate() {
        for before in task.reads.iter().flatten().filter_map(|node| planner.maker.get(*node)) {
            if tasks[before as usize].stage == task.stage {
                users[before as usize].push(k);
                missing[k] += 1;
            }
        }
    }
    let mut order = Vec::with_capacity(tasks.len());
    let mut stretches = Vec::new();
    for stage in SETUP..=REST {
        let mut ready = Ready::default();
        let begins = (0..tasks.len()).filter(|k| tasks[*k].stage == stage && missing[*k] == 0);
        begins.for_each(|k| ready.add(tasks[k].kind, k));
        while let Some(own) = ready.largest_family() {
            let first = order.len();
            while let Some(kind) = ready.largest_of(own) {
                // A step of the same kind that has become ready belongs to the same run.
                while let Some(k) = ready.take(kind) {
                    order.push(k);
                    for &user in &users[k] {
                        missing[user] -= 1;
                        if missing[user] == 0 {
                            ready.add(tasks[user].kind, user);
                        }
                    }
                }
            }
            stretches.push(first..order.len());
        }
    }
    (order, stretches)
}

/// The tasks that can be next, by kinds.
#[derive(Default)]
struct Ready(Vec<(Kind, std::collections::VecDeque<usize>)>);

impl Ready {
    fn add(&mut self, kind: Kind, k: usize) {
        match self.0.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, own)) => own.push_back(k),
            None => self.0.push((kind, [k].into())),
        }
    }

    fn take(&mut self, kind: Kind) -> Option<usize> {
        self.0.iter_mut().find(|(known, _)| *known == kind)?.1.pop_front()
    }

    /// Returns the family with the most ready tasks; of equal ones the first.
    fn largest_family(&self) -> Option<Kind> {
        let count = |own: Kind| -> usize {
            self.0
                .iter()
                .filter(|(kind, _)| family(*kind) == own)
                .map(|(_, ready)| ready.len())
                .sum()
        };
        let families =
            self.0.iter().filter(|(_, ready)| !ready.is_empty()).map(|(kind, _)| family(*kind));
        families.rev().max_by_key(|own| count(*own))
    }

    /// Returns the kind of a family with the most ready tasks.
    fn largest_of(&self, own: Kind) -> Option<Kind> {
        let all =
            self.0.iter().rev().filter(|(kind, ready)| family(*kind) == own && !ready.is_empty());
        all.max_by_key(|(_, ready)| ready.len()).map(|(kind, _)| *kind)
    }
}

/// Returns the runs of a stretch with the fewest instructions: runs of one kind, or several kinds
/// in one run.
fn merged(stretch: &[usize], kind: impl Fn(usize) -> Kind) -> Vec<Range<usize>> {
    let mut pure: Vec<Range<usize>> = Vec::new();
    for (k, task) in stretch.iter().enumerate() {
        match pure.last_mut() {
            Some(run) if kind(stretch[run.start]) == kind(*task) => run.end = k + 1,
            _ => pure.push(k..k + 1),
        }
    }
    let more = |run: &Range<usize>| {
        let own = kind(stretch[run.start]);
        if family(own) == own { 0 } else { MORE * run.len() }
    };
    // The smallest cost of the runs before each one, and the start of the last of them.
    let mut least: Vec<(usize, usize)> = vec![(0, 0)];
    for end in 1..=pure.len() {
        let mut best = (least[end - 1].0 + RUN, end - 1);
        let mut together = more(&pure[end - 1]);
        for begin in (0..end - 1).rev().take(MOST) {
            together += more(&pure[begin]);
            best = best.min((least[begin].0 + RUN + together, begin));
        }
        least.push(best);
    }
    let mut runs = Vec::new();
    let mut end = pure.len();
    while end > 0 {
        let begin = least[end].1;
        runs.push(pure[begin].start..pure[end - 1].end);
        end = begin;
    }
    runs.reverse();
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Short runs of a family become one, long ones of two operands stay.
    #[test]
    fn runs_that_take_less_together_are_one() {
        let runs = |kinds: &[(Kind, usize)]| {
            let all: Vec<Kind> =
                kinds.iter().flat_map(|(kind, count)| vec![*kind; *count]).collect();
            merged(&(0..all.len()).collect::<Vec<_>>(), |k| all[k])
        };
        let ends = |kinds: &[(Kind, usize)]| {
            runs(kinds).into_iter().map(|run| run.end).collect::<Vec<_>>()
        };
        assert_eq!(ends(&[(Kind::Mul, 3), (Kind::Add, 2), (Kind::Fma, 9)]), [14]);
        assert_eq!(ends(&[(Kind::Mul, 30), (Kind::Add, 2), (Kind::Fma, 1)]), [30, 33]);
        assert_eq!(ends(&[(Kind::Mul, 30)]), [30]);
        assert!(ends(&[]).is_empty());
    }
}
