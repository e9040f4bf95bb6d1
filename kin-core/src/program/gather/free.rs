//! Parameters and laws that a program leaves free because they differ from case to case: the former are
//! inputs of the stages, the latter are asked time by time instead of being written out. All else is folded.

use kin_graph::{Graph, Input, Node, Op};

use super::timed::timed;
use crate::model::constraint::Constraint;
use crate::model::formula::{Given, Outside};
use crate::model::law::Law;
use crate::system::System;

/// Some constraints as they are in one case, and which of their numbers and laws others have.
#[derive(Clone, Debug, Default)]
pub(crate) struct Differences(Vec<OfBlock>);

/// The same of one constraint: the parameters and laws of its formula.
#[derive(Clone, Debug, Default)]
struct OfBlock {
    block: usize,
    parameters: Vec<f64>,
    differs: Vec<bool>,
    laws: Vec<(usize, Option<Law>)>,
    laws_differ: Vec<bool>,
}

/// The numbers and laws of one case.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    pub parameters: Vec<f64>,
    pub laws: Vec<Law>,
}

/// All that is free in a program, and where it is read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Free {
    differences: Differences,
    /// The constraint that is gathered, if it is one that differs.
    here: Option<usize>,
    /// The constraint and number of each free parameter, [`Input::Parameter`] by its place here, and what it
    /// is in the case of which the program was made.
    slots: Vec<(usize, usize)>,
    pub values: Vec<f64>,
    /// The number of each free law, its constraint, and where it stands there.
    laws: Vec<(usize, usize, LawPlace)>,
}

/// Where a law stands in a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LawPlace {
    /// A law of the formula, by its number.
    Law(usize),
    /// A node of the formula that only rustc can read.
    Node(Node),
}

impl Differences {
    /// These constraints as they are in a case; nothing differs yet.
    pub(crate) fn new(system: &System, blocks: &[bool]) -> Self {
        let all = system.equations().blocks.iter().zip(blocks).enumerate();
        let own = all.filter(|(_, (_, wanted))| **wanted);
        Differences(own.map(|(block, (own, _))| OfBlock::new(block, own.constraint.as_ref())).collect())
    }

    /// Notes the numbers and laws that are others in this case.
    pub(crate) fn note(&mut self, system: &System) {
        for own in &mut self.0 {
            let Some(block) = system.equations().blocks.get(own.block) else { continue };
            own.note(block.constraint.as_ref());
        }
    }
}

impl OfBlock {
    fn new(block: usize, constraint: &dyn Constraint) -> Self {
        let own = constraint.formula(|table, parameters, outside| {
            let graph = &table.formula().graph;
            let mut numbers: Vec<usize> = graph.nodes().filter_map(|node| law_number(graph, node)).collect();
            numbers.sort_unstable();
            numbers.dedup();
            let law = |number: &usize| (*number, Given::by(outside, *number, &[]).law().cloned());
            (parameters.to_vec(), numbers.iter().map(law).collect::<Vec<_>>())
        });
        let (parameters, laws) = own.unwrap_or_default();
        let (differs, laws_differ) = (vec![false; parameters.len()], vec![false; laws.len()]);
        OfBlock { block, parameters, differs, laws, laws_differ }
    }

    /// Shows which of these parameters (false) and laws (true) are others, by their places here.
    fn compare(&self, parameters: &[f64], outside: Outside<'_>, mut show: impl FnMut(bool, usize)) {
        for (k, own) in self.parameters.iter().enumerate() {
            if parameters.get(k).is_none_or(|other| other.to_bits() != own.to_bits()) {
                show(false, k);
            }
        }
        for (k, (number, own)) in self.laws.iter().enumerate() {
            let same = match (own, Given::by(outside, *number, &[]).law()) {
                (Some(own), Some(other)) => own.is(other),
                (own, other) => own.is_none() && other.is_none(),
            };
            if !same {
                show(true, k);
            }
        }
    }

    fn note(&mut self, constraint: &dyn Constraint) {
        let (mut differs, mut laws_differ) =
            (std::mem::take(&mut self.differs), std::mem::take(&mut self.laws_differ));
        constraint.formula(|_, parameters, outside| {
            self.compare(
                parameters,
                outside,
                |is_law, k| {
                    if is_law { laws_differ[k] = true } else { differs[k] = true }
                },
            );
        });
        (self.differs, self.laws_differ) = (differs, laws_differ);
    }

    /// True if all that is not free is what it was.
    fn fits(&self, parameters: &[f64], outside: Outside<'_>) -> bool {
        let mut fits = true;
        self.compare(parameters, outside, |is_law, k| {
            fits &= if is_law { self.laws_differ[k] } else { self.differs[k] }
        });
        fits
    }
}

fn law_number(graph: &Graph, node: Node) -> Option<usize> {
    match graph.op(node) {
        Op::Law(number, ..) => Some(number),
        _ => None,
    }
}

impl Free {
    pub(super) fn new(differences: Differences) -> Self {
        Free { differences, ..Free::default() }
    }

    /// The rows of this constraint are gathered from now on.
    pub(super) fn enter(&mut self, block: usize) {
        self.here = self.differences.0.iter().position(|own| own.block == block);
    }

    /// True if the constraint in hand differs from case to case.
    pub(super) fn differs(&self) -> bool {
        self.own().is_some()
    }

    fn own(&self) -> Option<&OfBlock> {
        self.here.and_then(|here| self.differences.0.get(here))
    }

    /// The input that stands for a parameter of the constraint in hand, if that is free.
    pub(super) fn parameter(&mut self, index: usize) -> Option<Input> {
        let own = self.own().filter(|own| own.differs.get(index) == Some(&true))?;
        let (slot, value) = ((own.block, index), own.parameters[index]);
        let known = self.slots.iter().position(|known| *known == slot);
        Some(Input::Parameter(known.unwrap_or_else(|| {
            self.slots.push(slot);
            self.values.push(value);
            self.slots.len() - 1
        })))
    }

    /// The number of a law of the constraint in hand, if that is free; a new one where `laws` does not have
    /// it.
    pub(super) fn law(&mut self, place: LawPlace, law: &Law, laws: &mut Vec<Law>) -> Option<usize> {
        let own = self.own()?;
        let differs = match place {
            LawPlace::Law(number) => {
                let k = own.laws.iter().position(|(known, _)| *known == number)?;
                own.laws_differ[k]
            }
            LawPlace::Node(_) => true,
        };
        if !differs {
            return None;
        }
        let block = own.block;
        let known = self.laws.iter().find(|(_, of, at)| (*of, *at) == (block, place));
        Some(known.map(|(number, ..)| *number).unwrap_or_else(|| {
            laws.push(law.clone());
            self.laws.push((laws.len() - 1, block, place));
            laws.len() - 1
        }))
    }

    /// The numbers and laws of a case, `laws` being those of the program; `None` where something is another
    /// that was folded.
    pub(crate) fn case(&self, system: &System, laws: &[Law]) -> Option<Case> {
        let mut case = Case { parameters: vec![f64::NAN; self.slots.len()], laws: laws.to_vec() };
        for own in &self.differences.0 {
            let constraint = system.equations().blocks.get(own.block)?.constraint.as_ref();
            constraint.formula(|_, parameters, outside| {
                let slots = self.slots.iter().zip(&mut case.parameters);
                for ((_, index), value) in slots.filter(|((block, _), _)| *block == own.block) {
                    *value = parameters.get(*index).copied().unwrap_or(f64::NAN);
                }
                for (number, _, place) in self.laws.iter().filter(|(_, block, _)| *block == own.block) {
                    let law = match place {
                        LawPlace::Law(own) => Given::by(outside, *own, &[]).law().cloned(),
                        LawPlace::Node(node) => timed(constraint, &[*node]).pop().map(|(_, law)| law),
                    };
                    if let (Some(law), Some(place)) = (law, case.laws.get_mut(*number)) {
                        *place = law;
                    }
                }
                own.fits(parameters, outside).then_some(())
            })??;
        }
        Some(case)
    }
}
