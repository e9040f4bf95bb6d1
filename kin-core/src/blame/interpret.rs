//! The steps of an equation once more, with derivatives, and from the row that failed back to the step where it began.

use std::collections::BTreeSet;

use num_dual::Dual3_64;

use super::graph::{Given, Graph, Outside, Step, jet_of_law};
use super::jet::Jet;
use super::{Asked, Blame, Direction, Input, Part, Source};

impl Graph {
    /// The expression that made a term not finite; `parameters` are the values of the parameters.
    pub fn blame(&self, asked: &Asked<'_>, parameters: &[f64], outside: Outside<'_>) -> Option<Blame> {
        let row = *self.rows.get(asked.row)?;
        let part = asked.term.part();
        asked.directions().into_iter().find_map(|direction| {
            let run = Run { graph: self, q: asked.q, t: asked.t, parameters, direction: &direction, outside };
            let jets = run.jets();
            let (step, part) = self.origin(row, &jets, part)?;
            Some(self.told(step, part, &jets, parameters))
        })
    }

    /// Back from a result that is not finite to the step all of whose operands are.
    fn origin(&self, row: u16, jets: &[Jet], last: Part) -> Option<(u16, Part)> {
        let (mut step, mut part) = (row, fault(jets, row, last)?);
        while let Some(next) = self.operands(step, &|c| holds(jets, c)).into_iter().find_map(|k| Some((k, fault(jets, k, part)?))) {
            (step, part) = next;
        }
        Some((step, part))
    }

    /// The steps that a result comes from: of a selection that which is taken.
    pub(crate) fn operands(&self, step: u16, holds: &dyn Fn(u16) -> bool) -> Vec<u16> {
        let all = match self.steps.get(usize::from(step)).map(|(_, step)| *step) {
            Some(Step::Negated(a) | Step::Call(_, a) | Step::Power(a, _) | Step::Law(_, a, _)) => vec![a],
            Some(Step::Call2(_, a, b)) => vec![a, b],
            Some(Step::Select(c, a, b)) => vec![if holds(c) { a } else { b }],
            Some(Step::Foreign(_, operands, _)) => operands.to_vec(),
            _ => vec![],
        };
        // Operands come first: so going back ends.
        all.into_iter().filter(|&k| k < step).collect()
    }

    fn told(&self, step: u16, part: Part, jets: &[Jet], parameters: &[f64]) -> Blame {
        let (number, kind) = self.steps[usize::from(step)];
        let expression = self.expressions.get(usize::from(number));
        let name = match kind {
            Step::Parameter(k) => self.parameters.get(usize::from(k)).copied(),
            _ => None,
        };
        let text = name.or(expression.map(|expression| expression.0)).unwrap_or_default();
        let value = |k: &u16| jets[usize::from(*k)].value;
        Blame {
            expression: text.to_string(),
            source: expression.filter(|_| name.is_none()).map(|&(_, line, column)| Source { file: self.file, line, column }),
            part,
            value: value(&step),
            operands: self.operands(step, &|c| holds(jets, c)).iter().map(value).collect(),
            inputs: self.inputs(step, jets, parameters),
        }
    }

    /// The coordinates, parameters and the time behind a result: coordinates first, the time last.
    fn inputs(&self, step: u16, jets: &[Jet], parameters: &[f64]) -> Vec<Input> {
        let (mut seen, mut open) = (BTreeSet::new(), vec![step]);
        while let Some(step) = open.pop() {
            if seen.insert(step) {
                open.extend(self.operands(step, &|c| holds(jets, c)));
            }
        }
        let steps = || seen.iter().filter_map(|&step| Some(self.steps.get(usize::from(step))?.1));
        let columns = steps().filter_map(|step| if let Step::Column(k) = step { Some(k) } else { None }).collect::<BTreeSet<_>>();
        let named = steps().filter_map(|step| match step {
            Step::Parameter(k) => Some((self.parameters.get(usize::from(k))?, parameters.get(usize::from(k))?)),
            _ => None,
        });
        let time = steps().any(|step| matches!(step, Step::Time)).then_some(Input::Time);
        let columns = columns.into_iter().map(|k| Input::Column(usize::from(k)));
        columns.chain(named.map(|(name, value)| Input::Parameter(name, *value))).chain(time).collect()
    }
}

fn fault(jets: &[Jet], step: u16, last: Part) -> Option<Part> {
    jets.get(usize::from(step))?.fault(last)
}

fn holds(jets: &[Jet], step: u16) -> bool {
    jets.get(usize::from(step)).is_some_and(|jet| jet.value != 0.0)
}

/// One interpretation, with derivatives along one direction.
struct Run<'a> {
    graph: &'a Graph,
    q: &'a [f64],
    t: f64,
    parameters: &'a [f64],
    direction: &'a Direction,
    outside: Outside<'a>,
}

impl Run<'_> {
    fn jets(&self) -> Vec<Jet> {
        let mut jets: Vec<Jet> = Vec::with_capacity(self.graph.steps.len());
        for (_, step) in self.graph.steps {
            let jet = self.jet(*step, &jets);
            jets.push(jet);
        }
        jets
    }

    fn jet(&self, step: Step, jets: &[Jet]) -> Jet {
        let of = |k: u16| jets.get(usize::from(k)).copied().unwrap_or(Jet::constant(f64::NAN));
        let truth = |holds: bool| Jet::constant(if holds { 1.0 } else { 0.0 });
        let moving = |value: f64, rate: Option<f64>| Jet { value, slopes: rate.map(|rate| [rate, 0.0]) };
        match step {
            Step::Column(k) => {
                let k = usize::from(k);
                moving(self.q.get(k).copied().unwrap_or(f64::NAN), self.direction.columns.get(k).copied().flatten())
            }
            Step::Time => moving(self.t, self.direction.time),
            Step::Parameter(k) => Jet::constant(self.parameters.get(usize::from(k)).copied().unwrap_or(f64::NAN)),
            Step::Constant(value) | Step::Decimal(value, _) => Jet::constant(value),
            Step::Negated(a) => of(a).negated(),
            Step::Call(f, a) => of(a).call(f),
            Step::Call2(f, a, b) => of(a).call2(f, of(b)),
            Step::Power(a, n) => of(a).power(n),
            Step::Select(c, a, b) => of(if holds(jets, c) { a } else { b }),
            Step::Compare(comparison, a, b) => truth(comparison.holds(of(a).value, of(b).value)),
            Step::Both(a, b) => truth(holds(jets, a) && holds(jets, b)),
            Step::Either(a, b) => truth(holds(jets, a) || holds(jets, b)),
            Step::Not(a) => truth(!holds(jets, a)),
            Step::Law(law, x, order) => {
                let x = of(x);
                let [f, f1, f2, _] = jet_of_law(self.outside, law, x.value, order);
                x.chain([f, f1, f2])
            }
            Step::Foreign(number, operands, component) => {
                let operands: Vec<Jet> = operands.iter().map(|&k| of(k)).collect();
                self.foreign(number, &operands, component)
            }
        }
    }

    /// The user's own function: its derivatives by each of its arguments, and the second one along the direction.
    fn foreign(&self, number: u16, operands: &[Jet], component: u16) -> Jet {
        let call = |operands: Vec<Dual3_64>| Given::by(self.outside, number, &operands).number(component);
        let still = |operand: &Jet| Dual3_64::from_re(operand.value);
        let value = call(operands.iter().map(still).collect()).re;
        if operands.iter().all(|operand| operand.slopes.is_none()) {
            return Jet::constant(value);
        }
        let mut first = 0.0;
        for (k, operand) in operands.iter().enumerate() {
            let Some([rate, _]) = operand.slopes else { continue };
            let mut seeded: Vec<_> = operands.iter().map(still).collect();
            seeded[k].v1 = 1.0;
            first += call(seeded).v1 * rate;
        }
        let along = call(
            operands
                .iter()
                .map(|operand| {
                    let number = operand.dual();
                    Dual3_64::new(number.re, number.v1, number.v2, 0.0)
                })
                .collect(),
        );
        Jet { value, slopes: Some([first, along.v2]) }
    }
}
