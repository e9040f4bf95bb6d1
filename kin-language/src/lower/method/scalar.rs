//! Methods of numbers, under the names of f64, and methods of integers.

use quote::{ToTokens, quote};

use super::Call;
use crate::lower::integer::{self, IntegerType};
use crate::lower::template::Template;
use crate::lower::value::Value;
use crate::lower::{Read, Reader, Unreadable, counted, first_span};
use crate::parse::Shape;
use crate::vocabulary::is_underived;
use kin_graph::{Comparison, Function, Function2, Graph, Node};

impl Reader {
    pub(super) fn scalar_method(&mut self, n: Node, call: &Call) -> Read {
        let name = call.name.as_str();
        if name == "powi" {
            if !self.counted(1, call) {
                return Ok(Value::Poison);
            }
            return self.power(n, call.arguments[0].clone(), call.places[0], call.whole);
        }
        if let "total_cmp" | "partial_cmp" = name {
            let Some(other) = self.scalars_of(1, call) else { return Ok(Value::Poison) };
            let order = self.order_of(n, other[0]);
            return match name {
                "total_cmp" => Ok(order),
                _ => self.each(order, call, &mut |_, order| Ok(Value::some(order))),
            };
        }
        if is_underived(name) {
            return self.underived(n, call);
        }
        let count = match name {
            _ if Function::from_method(name).is_some() || KINDS_OF_NUMBERS.contains(&name) => 0,
            "sin_cos" | "recip" | "to_radians" | "to_degrees" => 0,
            _ if Function2::from_method(name).is_some() => 1,
            "copysign" | "log" => 1,
            "mul_add" | "clamp" => 2,
            _ if OTHER_METHODS_OF_F64.contains(&name) => {
                return Err(Unreadable::new(&call.whole.method, format!("`{name}`")));
            }
            _ => return Ok(self.unknown(call, "a number", cure(name))),
        };
        let Some(arguments) = self.scalars_of(count, call) else { return Ok(Value::Poison) };
        Ok(self.scalar_function(n, name, &arguments, call.whole))
    }

    /// Reads `k.to_bits()` and similar methods without a derivative: a mistake on a number that
    /// varies, else a call in emitted code.
    fn underived(&mut self, n: Node, call: &Call) -> Read {
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

    /// Returns f(x, …) for a function of f64, if the number of arguments is right.
    pub fn scalar_function(
        &mut self,
        x: Node,
        name: &str,
        arguments: &[Node],
        at: &dyn ToTokens,
    ) -> Value {
        let g = &mut self.graph;
        let function = (Function::from_method(name), Function2::from_method(name));
        let y = match (name, function, arguments) {
            (_, (Some(f), _), []) => g.call(f, x),
            (_, (_, Some(f)), [y]) => g.call2(f, x, *y),
            ("sin_cos", _, []) => {
                let sin = g.call(Function::Sin, x);
                let cos = g.call(Function::Cos, x);
                return Value::Tuple(vec![Value::Scalar(sin), Value::Scalar(cos)]);
            }
            ("recip", _, []) => g.powi(x, -1),
            ("to_radians", _, []) => {
                let factor = g.constant_of(RADIANS, 1f64.to_radians());
                g.mul(factor, x)
            }
            ("to_degrees", _, []) => {
                let factor = g.constant_of(DEGREES, 1f64.to_degrees());
                g.mul(factor, x)
            }
            ("copysign", _, [sign]) => {
                let size = g.call(Function::Abs, x);
                let sign = g.call(Function::Signum, *sign);
                g.mul(size, sign)
            }
            (_, _, []) if KINDS_OF_NUMBERS.contains(&name) => {
                return Value::Condition(is_such(g, name, x));
            }
            ("log", _, [base]) => {
                let x = g.call(Function::Ln, x);
                let base = g.call(Function::Ln, *base);
                g.div(x, base)
            }
            ("mul_add", _, [a, b]) => {
                let product = g.mul(x, *a);
                g.add(product, *b)
            }
            ("clamp", _, [low, high]) => {
                let x = g.call2(Function2::Max, x, *low);
                g.call2(Function2::Min, x, *high)
            }
            _ => return self.miscounted(name, 1 + arguments.len(), at),
        };
        Value::Scalar(y)
    }

    /// Reports a function of f64 with too few or too many numbers; the receiver counts as one of
    /// them.
    fn miscounted(&mut self, name: &str, given: usize, at: &dyn ToTokens) -> Value {
        let (takes, form) = match name {
            "mul_add" | "clamp" => (3, format!("x.{name}(a, b)")),
            "copysign" | "log" => (2, format!("x.{name}(y)")),
            _ if Function2::from_method(name).is_some() => (2, format!("x.{name}(y)")),
            _ => (1, format!("x.{name}()")),
        };
        let text = counted(&format!("`{name}`"), takes, "number", given);
        self.mistake(at, format!("{text}: write `{form}`"))
    }

    pub(super) fn integer_method(&mut self, k: i64, ty: Option<IntegerType>, call: &Call) -> Read {
        let unreadable = || Unreadable::new(&call.whole.method, "this method of an integer");
        let argument = match &call.arguments[..] {
            [] => None,
            [one] => match one.clone().referent() {
                Value::Integer(n, _) => Some(n),
                _ => {
                    return Err(Unreadable::new(
                        call.places[0],
                        "integer arithmetic with an unknown value",
                    ));
                }
            },
            _ => return Err(unreadable()),
        };
        let ty = if call.name == "abs_diff" { None } else { ty };
        match (call.name.as_str(), argument) {
            ("is_power_of_two", None) => {
                return Ok(Value::Condition(self.graph.bool(k > 0 && k & (k - 1) == 0)));
            }
            ("is_multiple_of", Some(n)) => {
                return Ok(Value::Condition(self.graph.bool(k == 0 || n != 0 && k % n == 0)));
            }
            ("count_ones", None) if k >= 0 => {
                return Ok(Value::Integer(i64::from(k.count_ones()), IntegerType::named("u32")));
            }
            ("trailing_zeros", None) if k > 0 => {
                return Ok(Value::Integer(
                    i64::from(k.trailing_zeros()),
                    IntegerType::named("u32"),
                ));
            }
            _ => {}
        }
        let value = match (call.name.as_str(), argument) {
            ("div_ceil", Some(n)) if k >= 0 && n > 0 => Some((k - 1).div_euclid(n) + 1),
            ("saturating_sub", Some(n)) if ty.is_some_and(IntegerType::is_unsigned) => {
                Some((k - n).max(0))
            }
            ("pow", Some(n)) => u32::try_from(n).ok().and_then(|n| k.checked_pow(n)),
            ("abs", None) => k.checked_abs(),
            ("signum", None) => Some(k.signum()),
            ("rem_euclid", Some(n)) => k.checked_rem_euclid(n),
            ("div_euclid", Some(n)) => k.checked_div_euclid(n),
            ("min", Some(n)) => Some(k.min(n)),
            ("max", Some(n)) => Some(k.max(n)),
            ("abs_diff", Some(n)) => k.checked_sub(n).and_then(i64::checked_abs),
            (name, _) if Function::from_method(name).is_some() => {
                return Ok(self.mistake(
                    &call.whole.receiver,
                    crate::error::integer_for_a_number(&call.whole.receiver, k),
                ));
            }
            _ => None,
        };
        // The smaller operand decides if a negative result may have an unsigned type.
        let of = [argument.unwrap_or_default().min(k)];
        value.and_then(|value| integer::made(value, ty, &of)).ok_or_else(unreadable)
    }
}

fn number(n: Node, at: &dyn ToTokens) -> Template {
    Template::Numbers(vec![n], Shape::Scalar, first_span(at))
}

/// Methods that test the class of a number.
pub const KINDS_OF_NUMBERS: [&str; 5] =
    ["is_nan", "is_finite", "is_infinite", "is_sign_negative", "is_sign_positive"];

/// Returns the condition that x belongs to the class that the method tests.
fn is_such(g: &mut Graph, name: &str, x: Node) -> Node {
    let zero = g.zero();
    match name {
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
    }
}

/// π/180 and 180/π as decimal texts.
const RADIANS: &str = "0.01745329251994329576923690768488612713442871888541725456";
const DEGREES: &str = "57.29577951308232087679815481410517033240547246656432154916";

/// Methods that are good Rust, but that the interpreter does not read.
const OTHER_METHODS_OF_F64: &[&str] = &[
    "is_normal",
    "is_subnormal",
    "classify",
    "to_string",
    "round_ties_even",
    "eq",
    "ne",
    "lt",
    "le",
    "gt",
    "ge",
    "add",
    "sub",
    "mul",
    "div",
    "rem",
    "neg",
    "try_into",
];

fn cure(name: &str) -> &'static str {
    match name {
        "pow" => ": write `powi` for an integer exponent, `powf` for a number",
        "square" => ": write `x * x` or `x.powi(2)`",
        "arctan2" | "atan_2" => ": write `y.atan2(x)`",
        "norm" => ": write `abs()`",
        "arcsin" | "arccos" | "arctan" => ": the names of f64 are `asin`, `acos`, `atan`",
        _ => ": use a method of f64, such as `sin`, `sqrt`, `atan2`, `powi`, `hypot`, `max`",
    }
}
