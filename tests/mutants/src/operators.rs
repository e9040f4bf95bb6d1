//! Alternatives that may stand instead of an expression.
//!
//! Numbers within formulas stay as they are: most of their small changes only make a method slower
//! or a bound wider. Left out is also what a mutant that is there dies with: where `a` and `b`
//! instead of `a && b` are told from it, so is `a || b`; where `true` and `false` instead of a
//! comparison are, so is its opposite.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Expr, ExprBinary, ExprMethodCall, Lit, UnOp};

use crate::source::Alternative;

/// Methods that give what they were called on, but for what they do to it.
const LEFT_OUT: [&str; 16] = [
    "abs",
    "floor",
    "ceil",
    "round",
    "min",
    "max",
    "clamp",
    "with_value",
    "cut",
    "up_to",
    "hull",
    "common",
    "rev",
    "filter",
    "take",
    "skip",
];

/// Methods of one type that do the opposite of one another.
const OPPOSITES: [(&str, &str); 15] = [
    ("all", "any"),
    ("min", "max"),
    ("first", "last"),
    ("lo", "hi"),
    ("floor", "ceil"),
    ("next_up", "next_down"),
    ("is_some", "is_none"),
    ("is_ok", "is_err"),
    ("is_some_and", "is_none_or"),
    ("imin", "imax"),
    ("split_first", "split_last"),
    ("position", "rposition"),
    ("max_by", "min_by"),
    ("sin", "cos"),
    ("before", "after"),
];

/// Functions of one number by which it is rounded.
const ROUNDING: [&str; 4] = ["up", "down", "above", "below"];

pub struct Operators<'a> {
    pub text: &'a str,
}

impl Operators<'_> {
    pub fn code(&self, span: Span) -> &str {
        &self.text[span.byte_range()]
    }

    /// The alternatives that may stand instead of an expression.
    pub fn of(&self, expr: &Expr) -> Vec<Alternative> {
        match expr {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(unary) if !matches!(unary.op, UnOp::Deref(_)) => {
                let name = self.code(unary.op.span());
                vec![Alternative::new(
                    format!("({})", self.code(unary.expr.span())),
                    format!("without `{name}`"),
                )]
            }
            Expr::Assign(_) => vec![Alternative::new("{}", "left out")],
            Expr::Lit(lit) if matches!(lit.lit, Lit::Bool(_)) => literal(&lit.lit),
            Expr::MethodCall(call) => self.method(call),
            Expr::Call(call)
                if call.args.len() == 1 && ROUNDING.contains(&self.code(call.func.span())) =>
            {
                let argument = self.code(call.args[0].span());
                vec![Alternative::new(
                    format!("({argument})"),
                    format!("without `{}`", self.code(call.func.span())),
                )]
            }
            _ => Vec::new(),
        }
    }

    fn binary(&self, binary: &ExprBinary) -> Vec<Alternative> {
        let op = &binary.op;
        let name = self.code(op.span());
        let left = self.code(binary.left.span());
        let right = self.code(binary.right.span());
        let by = |other: &str| {
            Alternative::new(
                format!("({left}) {other} ({right})"),
                format!("`{name}` becomes `{other}`"),
            )
        };
        let assigned = |other: &str| {
            Alternative::new(
                format!("{left} {other} {right}"),
                format!("`{name}` becomes `{other}`"),
            )
        };
        let comparison = |other: Option<&str>| {
            let constant = ["true", "false"]
                .map(|value| Alternative::new(value, format!("`{name}` becomes {value}")));
            other.map(by).into_iter().chain(constant).collect::<Vec<_>>()
        };
        // a threshold that lets more pass; a named number is changed where it stands
        let further = |factor: &str| {
            let named = |side: &Expr| {
                self.code(side.span())
                    .chars()
                    .all(|c| c.is_ascii_uppercase() || c == '_' || c == '0' || c == '.')
            };
            let text = format!(
                "crate::mutants::number({left}) {name} {factor} * crate::mutants::number({right})"
            );
            let label = format!("`{name}` with {factor} times its right side");
            if named(&binary.left) || named(&binary.right) {
                Vec::new()
            } else {
                vec![Alternative::new(text, label)]
            }
        };
        let gone = || Alternative::new("{}", "left out");
        match op {
            BinOp::And(_) | BinOp::Or(_) => [(left, "right"), (right, "left")]
                .map(|(kept, gone)| {
                    Alternative::new(
                        format!("({kept})"),
                        format!("`{name}` without its {gone} side"),
                    )
                })
                .into(),
            BinOp::Lt(_) => [comparison(Some("<=")), further("1.5")].concat(),
            BinOp::Le(_) => [comparison(Some("<")), further("1.5")].concat(),
            BinOp::Gt(_) => [comparison(Some(">=")), further("0.5")].concat(),
            BinOp::Ge(_) => [comparison(Some(">")), further("0.5")].concat(),
            BinOp::Eq(_) | BinOp::Ne(_) => comparison(None),
            BinOp::Add(_) => vec![by("-"), by("*")],
            BinOp::Sub(_) => vec![by("+"), by("/")],
            BinOp::Mul(_) => vec![by("/"), by("+")],
            BinOp::Div(_) => vec![by("*"), by("-")],
            BinOp::Rem(_) => vec![by("/"), by("+")],
            BinOp::AddAssign(_) => vec![assigned("-="), gone()],
            BinOp::SubAssign(_) => vec![assigned("+="), gone()],
            BinOp::MulAssign(_) => vec![assigned("/="), gone()],
            BinOp::DivAssign(_) => vec![assigned("*="), gone()],
            _ => Vec::new(),
        }
    }

    fn method(&self, call: &ExprMethodCall) -> Vec<Alternative> {
        let name = call.method.to_string();
        let receiver = self.code(call.receiver.span());
        let arguments = call
            .args
            .iter()
            .map(|argument| self.code(argument.span()))
            .collect::<Vec<_>>()
            .join(", ");
        let mut all = Vec::new();
        let pair = OPPOSITES.iter().find(|(a, b)| *a == name || *b == name);
        if let (Some((a, b)), None) = (pair, &call.turbofish) {
            let other = if *a == name { b } else { a };
            all.push(Alternative::new(
                format!("({receiver}).{other}({arguments})"),
                format!("`{name}` becomes `{other}`"),
            ));
        }
        if LEFT_OUT.contains(&name.as_str()) {
            all.push(Alternative::new(format!("({receiver})"), format!("without `{name}`")));
        }
        all
    }
}

/// Other values than that of a named number, which is a threshold or a bound and no coefficient, or
/// than that of a truth.
pub fn literal(lit: &Lit) -> Vec<Alternative> {
    let to = |value: String| Alternative::new(value.clone(), format!("becomes {value}"));
    match lit {
        Lit::Bool(bool) => vec![to((!bool.value).to_string())],
        Lit::Float(float) => {
            let Ok(x) = float.base10_parse::<f64>() else { return Vec::new() };
            let others =
                if (1e-3..1e6).contains(&x) { [8.0 * x, 0.125 * x] } else { [1e6 * x, x / 1e6] };
            others.into_iter().map(|x| to(format!("{x:?}{}", float.suffix()))).collect()
        }
        Lit::Int(int) => {
            let Ok(n) = int.base10_parse::<u64>() else { return Vec::new() };
            [4 * n, n / 4]
                .into_iter()
                .filter(|m| *m != n)
                .map(|n| to(format!("{n}{}", int.suffix())))
                .collect()
        }
        _ => Vec::new(),
    }
}
