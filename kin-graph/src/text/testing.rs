//! Reads expressions into a graph, so that tests can print them and compare the values.

use std::collections::HashMap;

use super::{Dialect, Language, Meaning, Mistake, print, read};
use crate::testing::value;
use crate::{Function, Function2, Graph, Input, Node, Op};

/// The names of functions in a language.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Names {
    Kin,
    C,
    Latex,
}

/// Expressions of the three names a, b and c that use every function and every operator.
pub const TEXTS: [&str; 22] = [
    "a - (b - c) - (a + 2)",
    "a * (b / c) / (a * -b)",
    "-(a + b) * -(c - 1)",
    "-(a * b) - -c",
    "sin(a) * cos(b + c) + tan(a / 4)",
    "asin(a / 10) + acos(b / 10) - atan(c)",
    "sinh(a) + cosh(b) + tanh(c)",
    "asinh(a) + acosh(1 + b) + atanh(c / 20)",
    "exp(a - b) * exp2(c) - exp_m1(b)",
    "ln(a) * ln_1p(b) + log2(c) - log10(a + b)",
    "sqrt(a / b) - cbrt(a - c)",
    "abs(a - c) + signum(b - c)",
    "floor(a * 2.3) + ceil(b * 1.7) - round(c) + trunc(a - c) * fract(b)",
    "atan2(a - c, b) + hypot(a, -b)",
    "powf(a, b) + powi(a - c, 3) / powi(b, -2)",
    "max(a, b) - min(a - b, c)",
    "rem_euclid(a - c, b) + div_euclid(a - c, b)",
    "(a - c) % b",
    "powi(powi(a, 2), 2) - powf(a + 1, -b)",
    "a + -1.5e-7 * b - 3e300 / 1e300",
    "exp(-a) / (1 + exp(b)) / 2",
    "a - (b + (c - (a - b)))",
];

struct Terms {
    graph: Graph,
    names: Names,
}

impl Terms {
    fn function(&self, name: &str) -> Option<Function> {
        let method = match (self.names, name) {
            (Names::C, "expm1") => "exp_m1",
            (Names::C, "log") => "ln",
            (Names::C, "log1p") => "ln_1p",
            (Names::C, "fabs") => "abs",
            (Names::C, "kin_sign") | (Names::Latex, "sgn") => "signum",
            (Names::C, "kin_fraction") => "fract",
            (Names::Latex, "arsinh") => "asinh",
            (Names::Latex, "arcosh") => "acosh",
            (Names::Latex, "artanh") => "atanh",
            (_, other) => other,
        };
        Function::from_method(method)
    }

    fn function2(&self, name: &str) -> Option<Function2> {
        let method = match (self.names, name) {
            (Names::C, "pow") => "powf",
            (Names::C, "fmax") => "max",
            (Names::C, "fmin") => "min",
            (Names::C, "kin_remainder") | (Names::Latex, "mod") => "rem_euclid",
            (Names::C, "kin_whole_quotient") | (Names::Latex, "div") => "div_euclid",
            (Names::C, "fmod") | (Names::Latex, "rem") => "%",
            (_, other) => other,
        };
        Function2::from_method(method)
    }
}

impl Language for Terms {
    type Value = Node;
    const REMAINDER: bool = true;
    const POWER: bool = true;
    const DEEPEST: usize = 50;

    fn number_length(text: &str) -> usize {
        let digits =
            |text: &str| text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
        let mantissa = digits(text);
        match text[mantissa..].strip_prefix('e') {
            Some(rest) => {
                let sign = usize::from(rest.starts_with('-'));
                mantissa + 1 + sign + digits(&rest[sign..])
            }
            None => mantissa,
        }
    }

    fn is_in_name(letter: char, first: bool) -> bool {
        letter.is_alphabetic() || !first && (letter.is_alphanumeric() || letter == '_')
    }

    fn words(mistake: Mistake<'_>) -> String {
        format!("{mistake:?}")
    }

    fn number(&mut self, text: &str) -> Result<Node, String> {
        Ok(self.graph.constant(text.parse().map_err(|_| text.to_string())?))
    }

    fn name(&mut self, name: &str, called: bool) -> Result<Meaning<Node>, String> {
        let column = ["a", "b", "c"].iter().position(|known| *known == name);
        match (column, called) {
            (_, true) => Ok(Meaning::Function),
            (Some(k), _) => Ok(Meaning::Value(self.graph.input(Input::Column(k)))),
            (None, _) if name == "e" => {
                Ok(Meaning::Value(self.graph.constant(std::f64::consts::E)))
            }
            (None, _) => Err(name.to_string()),
        }
    }

    fn call(&mut self, name: &str, arguments: Vec<Node>) -> Result<Node, String> {
        match (arguments.as_slice(), self.function(name), self.function2(name)) {
            ([a], Some(f), _) => Ok(self.graph.raw(Op::Call(f, *a))),
            ([a, b], _, Some(f)) => Ok(self.graph.raw(Op::Call2(f, *a, *b))),
            ([a, n], ..) if matches!(name, "powi" | "kin_power") => {
                let n = self.graph.known_value(*n).ok_or("no number")?;
                Ok(self.graph.raw(Op::Powi(*a, n as i32)))
            }
            _ => Err(name.to_string()),
        }
    }

    fn negative(&mut self, a: Node) -> Node {
        self.graph.neg(a)
    }

    fn two(&mut self, a: Node, operator: char, b: Node) -> Node {
        let op = match operator {
            '+' => Op::Add(a, b),
            '-' => Op::Sub(a, b),
            '*' => Op::Mul(a, b),
            '/' => Op::Div(a, b),
            '%' => Op::Call2(Function2::Rem, a, b),
            _ => Op::Call2(Function2::Powf, a, b),
        };
        self.graph.raw(op)
    }
}

fn terms(text: &str, names: Names) -> (Graph, Node) {
    let mut terms = Terms { graph: Graph::default(), names };
    let node = read(text, &mut terms).unwrap_or_else(|reason| panic!("{text}: {reason}"));
    (terms.graph, node)
}

/// Returns an expression of Kin's files in another dialect.
pub fn printed(text: &str, dialect: &dyn Dialect) -> String {
    let (graph, node) = terms(text, Names::Kin);
    let named = |node| match graph.op(node) {
        Op::Input(Input::Column(k)) => Some(["a", "b", "c"][k].to_string()),
        _ => None,
    };
    print(&graph, node, dialect, named, 1000).expect("a short text")
}

/// Prints an expression, reads it again in the words that `plain` makes of it, and compares the
/// values.
pub fn comes_back(text: &str, dialect: &dyn Dialect, names: Names, plain: fn(&str) -> String) {
    let again = printed(text, dialect);
    let (graph, node) = terms(text, Names::Kin);
    let (other, same) = terms(&plain(&again), names);
    for numbers in [[0.7, 1.3, 2.9], [2.1, 0.4, 0.9]] {
        let inputs: HashMap<Input, f64> =
            numbers.into_iter().enumerate().map(|(k, x)| (Input::Column(k), x)).collect();
        let expected = value(&graph, node, &inputs);
        let found = value(&other, same, &inputs);
        assert!(expected.is_finite(), "{text}");
        let off = (found - expected).abs();
        assert!(off <= 1e-14 * (1.0 + expected.abs()), "{text} as {again}: {found} ≠ {expected}");
    }
}
