//! Methods of numbers, under the names of f64, and methods of integers.

use quote::{ToTokens, quote};

use super::Call;
use crate::lower::values::{
    Branching, Read, Template, Unreadable, Value, Values, counted, first_span,
};
use crate::parse::Shape;
use kin_graph::{Comparison, Function, Graph, Node};

impl Values {
    /// Reads `k.to_bits()` and similar methods without a derivative: a mistake on a number that
    /// varies, else a call in emitted code.
    pub fn underived(&mut self, n: Node, call: &Call) -> Read {
        if let Some(place) = (0..call.places.len())
            .find(|&k| self.value_varies(&call.arguments[k]))
            .map(|k| call.places[k])
        {
            return Ok(self.no_derivative(&call.name, place));
        }
        if self.graph.depends(n).varies() {
            return Ok(self.no_derivative(&call.name, &call.whole.method));
        }
        let arguments = call
            .arguments
            .iter()
            .zip(&call.places)
            .map(|(value, place)| self.template(value.clone(), *place));
        let arguments = arguments.collect::<Read<_>>()?;
        Ok(Value::Opaque(Template::Method(
            Box::new(number(n, call)),
            call.whole.method.to_token_stream(),
            arguments,
        )))
    }

    /// Returns xⁿ with an integer n.
    pub fn power(
        &mut self,
        x: Node,
        exponent: Value,
        place: &dyn ToTokens,
        at: &dyn ToTokens,
    ) -> Read {
        match exponent.referent() {
            Value::Integer(k, _) if i32::try_from(k).is_ok() => {
                let power = self.graph.powi(x, k as i32);
                Ok(Value::Scalar(power))
            }
            value @ (Value::Poison | Value::Never) => Ok(value),
            Value::Opaque(exponent) if !exponent.has_choice() => {
                let power = Template::Method(Box::new(number(x, at)), quote!(powi), vec![exponent]);
                Ok(Value::Scalar(self.scalar(Value::Opaque(power), at)))
            }
            Value::Opaque(_) => Err(Unreadable::new(place, "an unknown exponent")),
            other => Ok(self.mistake(
                place,
                format!(
                    "`powi` takes an integer, but the exponent is {}: write `powf` for a number",
                    other.name()
                ),
            )),
        }
    }

    /// Returns `Some(order)` of two numbers.
    pub fn some_order_of(&mut self, x: Node, y: Node, call: &Call) -> Read {
        let order = self.order_of(x, y);
        self.each(order, call, &mut |_, order| Ok(Value::some(order)))
    }

    /// Reports a function of f64 with too few or too many numbers; the receiver counts as one of
    /// them.
    pub fn miscounted(
        &mut self,
        name: &str,
        takes: usize,
        given: usize,
        at: &dyn ToTokens,
    ) -> Value {
        let form = match takes {
            3 => format!("x.{name}(a, b)"),
            2 => format!("x.{name}(y)"),
            _ => format!("x.{name}()"),
        };
        let text = counted(&format!("`{name}`"), takes, "number", given);
        self.mistake(at, format!("{text}: write `{form}`"))
    }
}

fn number(n: Node, at: &dyn ToTokens) -> Template {
    Template::Numbers(vec![n], Shape::Scalar, first_span(at))
}

/// Returns the condition that x belongs to the class that a method tests.
pub fn class_of(g: &mut Graph, name: &str, x: Node) -> Value {
    let zero = g.zero();
    Value::Condition(match name {
        "is_finite" => g.is_finite(x),
        "is_sign_negative" | "is_sign_positive" => {
            let sign = g.call(Function::Signum, x);
            let side =
                if name == "is_sign_negative" { Comparison::Less } else { Comparison::Greater };
            g.compare(side, sign, zero)
        }
        // The test |x| ≥ 0 fails only if x is NaN.
        _ => {
            let size = g.call(Function::Abs, x);
            let largest = g.constant(f64::MAX);
            match name {
                "is_infinite" => g.compare(Comparison::Greater, size, largest),
                _ => {
                    let is_number = g.compare(Comparison::GreaterEqual, size, zero);
                    g.not(is_number)
                }
            }
        }
    })
}

/// Returns π/180.
pub fn radians(g: &mut Graph) -> Node {
    g.constant_of(RADIANS, 1f64.to_radians())
}

/// Returns 180/π.
pub fn degrees(g: &mut Graph) -> Node {
    g.constant_of(DEGREES, 1f64.to_degrees())
}

/// π/180 and 180/π as decimal texts.
const RADIANS: &str = "0.01745329251994329576923690768488612713442871888541725456";
const DEGREES: &str = "57.29577951308232087679815481410517033240547246656432154916";

/// Methods that are good Rust, but that the interpreter does not read.
pub const OTHER_METHODS_OF_F64: &str = "\
    is_normal is_subnormal classify to_string round_ties_even eq ne lt le gt ge add sub mul \
    div rem neg try_into";

/// Returns what to write instead of a method that no number has.
pub fn cure(name: &str) -> &'static str {
    match name {
        "pow" => ": write `powi` for an integer exponent, `powf` for a number",
        "square" => ": write `x * x` or `x.powi(2)`",
        "arctan2" | "atan_2" => ": write `y.atan2(x)`",
        "norm" => ": write `abs()`",
        "arcsin" | "arccos" | "arctan" => ": the names of f64 are `asin`, `acos`, `atan`",
        _ => ": use a method of f64, such as `sin`, `sqrt`, `atan2`, `powi`, `hypot`, `max`",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_of_a_constant_is_known() {
        let mut g = Graph::default();
        let x = g.constant(-2.0);
        for (name, holds) in [("is_sign_negative", true), ("is_nan", false), ("is_infinite", false)]
        {
            let Value::Condition(node) = class_of(&mut g, name, x) else { panic!("a condition") };
            assert_eq!(g.truth(node), Some(holds), "{name}");
        }
        let factor = radians(&mut g);
        assert_eq!(g.constant_value(factor), Some(1f64.to_radians()));
    }
}
