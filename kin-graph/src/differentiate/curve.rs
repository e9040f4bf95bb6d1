//! Gives the derivatives of inputs along a line or a curve.

use super::Jet;
use crate::{Graph, Input, Node, Part};

/// The line or the curve along which is differentiated.
#[derive(Clone, Copy, Default)]
pub(super) enum Curve {
    /// q + s q̇
    #[default]
    Straight,
    /// q + s q̇ + ½ s² q̈, the second rate of argument k being the rate of argument k + this.
    Bent(usize),
}

impl Curve {
    /// The derivatives of an input.
    pub(super) fn jet(self, g: &mut Graph, input: Input) -> Jet {
        let zero = g.zero();
        match input {
            Input::Time => Jet { first: g.input(Input::TimeRate), second: zero },
            Input::State(argument, Part::Sin) => {
                self.angle(g, argument, Part::Sin, Part::Cos, false)
            }
            Input::State(argument, Part::Cos) => {
                self.angle(g, argument, Part::Cos, Part::Sin, true)
            }
            Input::State(argument, part) => {
                let first = g.input(Input::Rate(argument, part));
                Jet { first, second: self.second_rate(g, argument, part) }
            }
            _ => Jet { first: zero, second: zero },
        }
    }

    /// q̈ of a coordinate.
    fn second_rate(self, g: &mut Graph, argument: usize, part: Part) -> Node {
        match self {
            Curve::Straight => g.zero(),
            Curve::Bent(beyond) => g.input(Input::Rate(argument + beyond, part)),
        }
    }

    /// (sin θ)′ = θ̇ cos θ, (sin θ)″ = θ̈ cos θ − θ̇² sin θ; (cos θ)′ = −θ̇ sin θ, (cos θ)″ = −θ̈
    /// sin θ − θ̇² cos θ
    fn angle(self, g: &mut Graph, argument: usize, part: Part, other: Part, minus: bool) -> Jet {
        let this = g.input(Input::State(argument, part));
        let other = g.input(Input::State(argument, other));
        let rate = g.input(Input::Rate(argument, Part::Theta));
        let first = g.mul(rate, other);
        let rate_squared = g.mul(rate, rate);
        let bent = g.mul(rate_squared, this);
        let first = if minus { g.neg(first) } else { first };
        let second_rate = self.second_rate(g, argument, Part::Theta);
        let along = g.mul(second_rate, other);
        let sum = if minus { g.add(along, bent) } else { g.sub(along, bent) };
        Jet { first, second: if minus { g.neg(sum) } else { sum } }
    }
}
