//! Handles parameters and laws that differ from case to case.
//!
//! Parameters that differ become inputs of the stages. Kin evaluates laws that differ at each time
//! and does not write them into the graph. Kin folds all other parameters and laws.

use kin_graph::{Graph, Input, Node, Op};

use super::timed::timed;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::formula::{Given, Outside};
use crate::system::System;

/// Some constraints as they are in one case, with marks for the numbers and laws that differ in
/// others.
#[derive(Clone, Debug, Default)]
pub(crate) struct Differences(Vec<OfBlock>);

/// The parts of one constraint: the parameters of its formula in order, then its laws.
#[derive(Clone, Debug, Default)]
struct OfBlock {
    /// The index of the constraint.
    block: usize,
    parts: Vec<Part>,
}

/// A parameter or law of a constraint, with `differs` true if other cases have another value.
#[derive(Clone, Debug)]
struct Part {
    own: Own,
    differs: bool,
}

/// A parameter or law, by its index in the formula.
#[derive(Clone, Debug)]
enum Own {
    Parameter(usize, f64),
    Law(usize, Option<Law>),
}

/// The numbers and laws of one case.
#[derive(Clone, Debug, Default)]
pub(crate) struct Case {
    /// The values of the free parameters, by [`Input::Parameter`]; NaN if a value is unknown.
    pub parameters: Vec<f64>,
    /// The laws of the program, by their indices.
    pub laws: Vec<Law>,
}

/// All free inputs of a program, with the constraints that read them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Free {
    differences: Differences,
    /// The index of the constraint that is being gathered, if it differs between cases.
    here: Option<usize>,
    /// The constraint and index of each free parameter, in the order of [`Input::Parameter`].
    slots: Vec<(usize, usize)>,
    /// The values of the free parameters in the case from which the program was made.
    pub values: Vec<f64>,
    /// Each free law, as (index in the program, constraint, place in the constraint).
    laws: Vec<(usize, usize, LawPlace)>,
}

/// The place of a law in a constraint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LawPlace {
    /// A law of the formula, by its index.
    Law(usize),
    /// A node of the formula that only rustc can read.
    Node(Node),
}

impl Differences {
    /// Creates the description of these constraints in one case; nothing differs yet.
    pub(crate) fn new(system: &System, blocks: &[bool]) -> Self {
        let all = system.equations().blocks.iter().zip(blocks).enumerate();
        let own = all.filter(|(_, (_, wanted))| **wanted);
        Differences(
            own.map(|(block, (own, _))| OfBlock::new(block, own.constraint.as_ref())).collect(),
        )
    }

    /// Marks the numbers and laws that differ in this case.
    pub(crate) fn note(&mut self, system: &System) {
        for own in &mut self.0 {
            let Some(block) = system.equations().blocks.get(own.block) else { continue };
            own.note(block.constraint.as_ref());
        }
    }
}

impl OfBlock {
    fn new(block: usize, constraint: &dyn Constraint) -> Self {
        let all = constraint.formula(|table, parameters, outside| {
            let graph = &table.formula().graph;
            let mut numbers: Vec<usize> =
                graph.nodes().filter_map(|node| law_number(graph, node)).collect();
            numbers.sort_unstable();
            numbers.dedup();
            let parameters =
                parameters.iter().enumerate().map(|(k, value)| Own::Parameter(k, *value));
            let law = |k: usize| Own::Law(k, Given::by(outside, k, &[]).law().cloned());
            parameters.chain(numbers.into_iter().map(law)).collect::<Vec<_>>()
        });
        let part = |own| Part { own, differs: false };
        OfBlock { block, parts: all.unwrap_or_default().into_iter().map(part).collect() }
    }

    fn note(&mut self, constraint: &dyn Constraint) {
        constraint.formula(|_, parameters, outside| {
            self.parts
                .iter_mut()
                .for_each(|part| part.differs |= !part.own.is_among(parameters, outside));
        });
    }

    /// Returns true if everything that is not free is unchanged.
    fn fits(&self, parameters: &[f64], outside: Outside<'_>) -> bool {
        self.parts.iter().all(|part| part.differs || part.own.is_among(parameters, outside))
    }
}

impl Own {
    /// Returns true if a case with these parameters and laws has the same value.
    fn is_among(&self, parameters: &[f64], outside: Outside<'_>) -> bool {
        match self {
            Own::Parameter(k, own) => {
                parameters.get(*k).is_some_and(|other| other.to_bits() == own.to_bits())
            }
            Own::Law(k, own) => match (own, Given::by(outside, *k, &[]).law()) {
                (Some(own), Some(other)) => own.is(other),
                (own, other) => own.is_none() && other.is_none(),
            },
        }
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

    /// Returns the constraint and index of each free parameter.
    pub(crate) fn slots(&self) -> &[(usize, usize)] {
        &self.slots
    }

    /// Returns true if the law with this index differs from case to case.
    pub(crate) fn has_law(&self, law: usize) -> bool {
        self.laws.iter().any(|(number, ..)| *number == law)
    }

    /// Begins to gather the rows of this constraint.
    pub(super) fn enter(&mut self, block: usize) {
        self.here = self.differences.0.iter().position(|own| own.block == block);
    }

    /// Returns true if the present constraint differs from case to case.
    pub(super) fn differs(&self) -> bool {
        self.own().is_some()
    }

    fn own(&self) -> Option<&OfBlock> {
        self.here.and_then(|here| self.differences.0.get(here))
    }

    /// Returns the input of a parameter of the present constraint, if the parameter is free.
    pub(super) fn parameter(&mut self, index: usize) -> Option<Input> {
        let block = self.own()?.block;
        let Some(Part { own: Own::Parameter(_, value), differs: true }) =
            self.own()?.parts.get(index)
        else {
            return None;
        };
        let slot = (block, index);
        let value = *value;
        let known = self.slots.iter().position(|known| *known == slot);
        Some(Input::Parameter(known.unwrap_or_else(|| {
            self.slots.push(slot);
            self.values.push(value);
            self.slots.len() - 1
        })))
    }

    /// Returns the index of a law of the present constraint, if the law is free. It appends the law
    /// to `laws` if necessary.
    pub(super) fn law(&mut self, place: LawPlace, law: &Law, laws: &mut Vec<Law>) -> Option<usize> {
        let OfBlock { block, parts } = self.own()?;
        let is_own = |part: &&Part| matches!(part.own, Own::Law(k, _) if LawPlace::Law(k) == place);
        let differs = match place {
            LawPlace::Law(_) => parts.iter().find(is_own)?.differs,
            LawPlace::Node(_) => true,
        };
        if !differs {
            return None;
        }
        let block = *block;
        let known = self.laws.iter().find(|(_, of, at)| (*of, *at) == (block, place));
        Some(known.map(|(number, ..)| *number).unwrap_or_else(|| {
            laws.push(law.clone());
            self.laws.push((laws.len() - 1, block, place));
            laws.len() - 1
        }))
    }

    /// Returns the numbers and laws of a case, where `laws` are those of the program. Returns
    /// `None` if a folded value differs.
    pub(crate) fn case(&self, system: &System, laws: &[Law]) -> Option<Case> {
        let mut case = Case { parameters: vec![f64::NAN; self.slots.len()], laws: laws.to_vec() };
        for own in &self.differences.0 {
            let constraint = system.equations().blocks.get(own.block)?.constraint.as_ref();
            constraint.formula(|_, parameters, outside| {
                if !own.fits(parameters, outside) {
                    return None;
                }
                let slots = self.slots.iter().zip(&mut case.parameters);
                for ((_, index), value) in slots.filter(|((block, _), _)| *block == own.block) {
                    *value = parameters.get(*index).copied()?;
                }
                for (number, _, place) in
                    self.laws.iter().filter(|(_, block, _)| *block == own.block)
                {
                    *case.laws.get_mut(*number)? = match place {
                        LawPlace::Law(own) => Given::by(outside, *own, &[]).law().cloned()?,
                        LawPlace::Node(node) => timed(constraint, &[*node]).pop()?.1,
                    };
                }
                Some(())
            })??;
        }
        Some(case)
    }
}
