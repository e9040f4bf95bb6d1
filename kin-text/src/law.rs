//! Creates laws from text: `fn lift(x: f64, h: f64) -> f64 { … }` becomes the same law as with
//! `#[law]`.

use std::sync::Arc;

use kin::Law;
use kin::data::LawReader;
use kin::emitted::LawFunction;
use kin::emitted::graph::{Given, Graph, Node, Series, Table, give_law};
use kin_language::lower::{self, Lowered};
use kin_language::parse::{self, LawFn, SecondReader};
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ItemFn};

use crate::mistake::Mistakes;
use crate::read::{Asked, Places, read_with};
use crate::signature::Signature;
use crate::unknown::understood;

/// A function of one variable that Kin has read from text, with all derivatives.
///
/// The text contains a function in the form of a function under `#[law]`. The first argument is the
/// variable, and the other arguments are parameters. The same text contains the functions and
/// constants that the function uses.
///
/// ```
/// use kin_text::LawText;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let lift = LawText::read("fn lift(x: f64, h: f64) -> f64 { h * (1.0 - x.cos()) }")?;
/// let law = lift.law(&[("h", 0.02)])?;
/// assert!((law.jet(0.5)[1] - 0.02 * 0.5_f64.sin()).abs() < 1e-16);
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct LawText(Arc<Read>);

/// A law as it was read, without its numbers.
struct Read {
    text: String,
    name: String,
    description: String,
    signature: Signature,
    formula: Asked,
    requirements: Vec<(Asked, String)>,
}

impl LawText {
    /// Reads a law from a text.
    ///
    /// Errors: the text contains mistakes, each with line, column and suggestion, as for an
    /// equation.
    pub fn read(text: &str) -> Result<LawText, Mistakes> {
        let read = read_with(text, |(said, item, _)| of_item(said, item))?;
        Ok(LawText(Arc::new(Read { text: text.to_owned(), ..read })))
    }

    /// Returns the name of the function.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Returns the names of the numbers of the law, such as `h`, `c[0]` or `u.x`.
    pub fn numbers(&self) -> &[String] {
        &self.0.signature.numbers
    }

    /// Creates the law with these numbers.
    ///
    /// Errors: a number is missing, unknown or not finite; the law contains other laws, which only
    /// a file can provide; a condition of `#[require]` is not satisfied.
    pub fn law(&self, numbers: &[(&str, f64)]) -> Result<Law, String> {
        let known =
            |name: &str| numbers.iter().find(|(known, _)| *known == name).map(|(_, value)| *value);
        self.made(known, numbers.iter().map(|(name, _)| *name), |part| {
            Err(format!("the part `{part}` is a law. Give this part in a mechanism file"))
        })
    }

    /// The law that a file describes.
    fn of_file(file: &LawReader<'_>) -> Result<Law, String> {
        let read = LawText::read(file.text()).map_err(|mistakes| mistakes.to_string())?;
        read.made(|name| file.number(name).ok(), file.names(), |part| file.part(part))
    }

    fn made<'a>(
        &self,
        number: impl Fn(&str) -> Option<f64>,
        mut names: impl Iterator<Item = &'a str>,
        part: impl Fn(&str) -> Result<Law, String>,
    ) -> Result<Law, String> {
        let name = &self.0.name;
        let signature = &self.0.signature;
        let lacks =
            |number: &String| format!("the number `{number}` of the law `{name}` is missing");
        let of = |wanted: &String| number(wanted).ok_or_else(|| lacks(wanted));
        let numbers = signature.numbers.iter().map(of).collect::<Result<Vec<f64>, _>>()?;
        let parts = signature.laws().map(part).collect::<Result<Vec<Law>, _>>()?;
        match names
            .find(|given| signature.number(given).is_none() && signature.law(given).is_none())
        {
            Some(other) => Err(format!("the law `{name}` has no number `{other}`")),
            None => Ok(Law::new(WrittenLaw { read: self.0.clone(), numbers, parts })),
        }
    }
}

/// Creates a law from its text in a file.
pub fn of_file(file: &LawReader<'_>) -> Result<Law, String> {
    LawText::of_file(file)
}

/// A law of a text with its numbers.
#[derive(Clone)]
struct WrittenLaw {
    read: Arc<Read>,
    numbers: Vec<f64>,
    parts: Vec<Law>,
}

impl WrittenLaw {
    fn table(&self) -> &Table {
        &self.read.formula.table
    }

    /// The numbers that a formula reads, in its order.
    fn of(&self, asked: &Asked) -> Vec<f64> {
        asked.numbers.iter().filter_map(|k| self.numbers.get(*k)).copied().collect()
    }

    /// Hands over the laws that it is made of.
    fn give(&self, number: usize, to: &mut Given) {
        let law = self.read.formula.laws.get(number).and_then(|k| self.parts.get(*k));
        law.into_iter().for_each(|law| give_law(law, &[], to));
    }

    fn asked(&self) -> Vec<f64> {
        self.of(&self.read.formula)
    }
}

impl LawFunction for WrittenLaw {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.table().law_jet(x, &self.asked(), &|number, _, to| self.give(number, to))
    }

    fn kind(&self) -> &str {
        &self.read.name
    }

    fn description(&self) -> &str {
        &self.read.description
    }

    fn text(&self) -> Option<&str> {
        Some(&self.read.text)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        self.table().law_over(x, &self.asked(), &|number, _, to| self.give(number, to))
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        self.table().law_in(graph, x, &self.asked(), &|number, _, to| self.give(number, to))
    }

    fn trusted(&self) -> Vec<String> {
        self.table().law_trusted(&|number, _, to| self.give(number, to))
    }

    fn refusal(&self) -> Option<String> {
        let own = self.parts.iter().find_map(Law::refusal);
        let fails = |(condition, _): &&(Asked, String)| {
            condition.table.law_jet(0.0, &self.of(condition), &kin::emitted::graph::nothing_outside)
                [0]
                != 1.0
        };
        own.or_else(|| self.read.requirements.iter().find(fails).map(|(_, text)| text.clone()))
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.read
            .signature
            .numbers
            .iter()
            .zip(&self.numbers)
            .for_each(|(name, value)| visit(name, *value));
        for (part, law) in self.parts() {
            law.parameters(&mut |name, value| visit(&format!("{part}.{name}"), value));
        }
    }

    fn parts(&self) -> Vec<(String, Law)> {
        self.read.signature.laws().map(str::to_owned).zip(self.parts.iter().cloned()).collect()
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        self.table().law_by(name, &self.asked(), &|number, _, to| self.give(number, to))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        match self.read.signature.number(name) {
            Some(k) => *changed.numbers.get_mut(k)? = value,
            None => {
                let (part, inside) = name.split_once('.')?;
                let part = changed.parts.get_mut(self.read.signature.law(part)?)?;
                part.set_parameter(inside, value).then_some(())?;
            }
        }
        Some(Law::new(changed))
    }
}

fn of_item(said: TokenStream, item: ItemFn) -> syn::Result<Read> {
    let source = parse::law(&said, item.to_token_stream())?;
    let signature = Signature::of(&source.parameters)?;
    let lowered = understood(lower::law(
        &source.variable,
        &source.parameters,
        &source.body,
        SecondReader::Nobody,
    ))?;
    let places =
        Places { signature: &signature, name: &source.name, arguments: &source.parameters };
    let formula = places.asked(&lowered)?;
    let requirements = source.requirements.iter().map(|demand| {
        Ok((places.asked(&condition(&source, &demand.condition)?)?, demand.text.clone()))
    });
    Ok(Read {
        text: String::new(),
        name: syn::ext::IdentExt::unraw(&source.name).to_string(),
        description: parse::description(&source.attributes),
        requirements: requirements.collect::<syn::Result<_>>()?,
        formula,
        signature,
    })
}

/// A condition on the parameters as a function that is 1 where it holds. The items at the beginning
/// of the body are in sight.
fn condition(source: &LawFn, condition: &Expr) -> syn::Result<Lowered> {
    let items =
        source.body.stmts.iter().take_while(|statement| matches!(statement, syn::Stmt::Item(_)));
    let body = syn::parse_quote!({ #(#items)* if #condition { 1.0 } else { 0.0 } });
    understood(lower::law(&source.variable, &source.parameters, &body, SecondReader::Nobody))
}
