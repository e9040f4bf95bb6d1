//! Laws whose function is text in Kin's language, `fn lift(x: Coord) -> f64 { … }`: the derivatives are those
//! of the equation that the text is as a constraint on one coordinate. Files carry it as the law's kind.

use kin::constraint::Constraint;
use kin::text::{Equation, ReadConstraint};
use kin::{Law, LawFunction, Registry, any_coord};
use serde_json::Value;

/// A law from text.
#[derive(Clone)]
pub struct Written {
    equation: ReadConstraint,
    text: String,
}

impl Written {
    /// Reads a text. Errors: its mistakes, more than one argument.
    pub fn read(text: &str) -> Result<Written, String> {
        let equation = Equation::read(text).map_err(|mistakes| mistakes.to_string())?;
        let made = equation.on(any_coord()).constraint().map_err(|error| error.to_string())?;
        match made.facts().rows.len() {
            1 => Ok(Written { equation: made, text: text.to_owned() }),
            rows => Err(format!("a law gives one number, not {rows}")),
        }
    }
}

impl LawFunction for Written {
    fn jet(&self, x: f64) -> [f64; 4] {
        let terms = kin::terms(&self.equation, &[x], &[1.0], 0.0);
        let third = kin::jerk_rhs(&self.equation, &[x], &[1.0], &[0.0], 0.0);
        let first = |list: &[f64]| list.first().copied().unwrap_or(f64::NAN);
        let third = third.map_or(f64::NAN, |third| -first(third.as_slice()));
        [first(terms.c.as_slice()), first(terms.c_q.as_slice()), -first(terms.q_d.as_slice()), third]
    }

    fn kind(&self) -> &str {
        &self.text
    }

    fn description(&self) -> &str {
        self.equation.facts().description
    }
}

/// The registry of the library, with the laws that a description carries as text.
pub fn registry(described: &Value) -> Result<Registry, String> {
    let mut found = Vec::new();
    texts(described, &mut found);
    found.into_iter().try_fold(kin::text::registry(), |registry, text| {
        let law = Written::read(text)?;
        Ok(registry.with_law(text, move |_| Ok(Law::new(law.clone()))))
    })
}

/// The kinds of laws that are texts.
fn texts<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
    match value {
        Value::Array(all) => all.iter().for_each(|one| texts(one, found)),
        Value::Object(fields) => {
            let kind = fields.get("kind").and_then(Value::as_str);
            found.extend(kind.filter(|kind| kind.contains("fn ")));
            fields.values().for_each(|one| texts(one, found));
        }
        _ => {}
    }
}
