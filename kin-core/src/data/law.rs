//! Reads and writes laws as data: a kind, numbers, and the laws that a law contains.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{Registry, once};
use crate::law::{Ends, Law};
use crate::outcome::similar;
use crate::outcome::words::list;

/// A law as data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct LawData {
    /// The kind of the law, such as `ramp`. A [`Registry`] first searches for a constructor of this
    /// kind.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub kind: String,
    /// The function as text, `fn lift(x: f64, h: f64) -> f64 { … }`. A program that does not know
    /// the kind of the law uses this text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<String>,
    /// The numbers of the law, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", deserialize_with = "once::map")]
    pub numbers: BTreeMap<String, f64>,
    /// The laws that the law contains, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", deserialize_with = "once::map")]
    pub parts: BTreeMap<String, LawData>,
}

impl LawData {
    /// Returns the data of a law: its kind, numbers and parts.
    pub fn of(law: &Law) -> LawData {
        let parts = law.parts();
        let mut numbers: BTreeMap<String, f64> = law.fixed_numbers().into_iter().collect();
        law.parameters(&mut |name, value| {
            let inside = |(part, _): &(String, Law)| {
                name.strip_prefix(part.as_str()).is_some_and(|rest| rest.starts_with('.'))
            };
            if !parts.iter().any(inside) {
                numbers.insert(name.to_string(), value);
            }
        });
        let parts = parts.iter().map(|(name, part)| (name.clone(), LawData::of(part))).collect();
        LawData {
            kind: law.kind().to_string(),
            text: law.text().map(str::to_string),
            numbers,
            parts,
        }
    }
}

impl LawData {
    /// Returns the name for messages: the kind, or the first line of the text if there is no kind.
    fn name(&self) -> &str {
        let text = self.text.as_deref().unwrap_or_default();
        if self.kind.is_empty() { text.lines().next().unwrap_or_default() } else { &self.kind }
    }
}

/// The data of a law, from which a constructor reads numbers and parts.
pub struct LawReader<'a> {
    data: &'a LawData,
    registry: &'a Registry,
    /// The names that the constructor has read.
    asked: RefCell<BTreeSet<String>>,
}

impl<'a> LawReader<'a> {
    pub(super) fn new(data: &'a LawData, registry: &'a Registry) -> Self {
        LawReader { data, registry, asked: RefCell::default() }
    }

    fn ask(&self, name: &str) {
        self.asked.borrow_mut().insert(name.to_string());
    }

    /// Returns an error for a number or part that the constructor has not read, by name.
    pub(super) fn all_are_asked(&self) -> Result<(), String> {
        let asked = self.asked.borrow();
        let of =
            |names: Vec<&String>| names.into_iter().find(|name| !asked.contains(*name)).cloned();
        let number = of(self.data.numbers.keys().collect()).map(|name| ("number", name));
        let found =
            number.or_else(|| of(self.data.parts.keys().collect()).map(|name| ("part", name)));
        let Some((what, name)) = found else { return Ok(()) };
        let has = similar::nearest_first(&name, asked.iter().cloned());
        let has = if has.is_empty() { "nothing".to_string() } else { list(&has) };
        Err(format!("the law `{}` has no {what} `{name}`; it has {has}", self.data.name()))
    }

    /// Returns the number with this name.
    ///
    /// Errors: no number has the name.
    pub fn number(&self, name: &str) -> Result<f64, String> {
        self.ask(name);
        self.data
            .numbers
            .get(name)
            .copied()
            .ok_or_else(|| self.lacks(&format!("the number `{name}`"), name))
    }

    /// The mistake of a number or part that is missing, with the unread ones that may be meant.
    fn lacks(&self, what: &str, name: &str) -> String {
        let asked = self.asked.borrow();
        let given = self.data.numbers.keys().chain(self.data.parts.keys());
        let given = given.filter(|given| !asked.contains(*given)).cloned();
        let given = similar::nearest_first(name, given);
        let cure = match given[..] {
            [] => ". Add it".to_string(),
            _ => format!(". Is it meant by {}?", list(&given)),
        };
        format!("the law `{}` lacks {what}{cure}", self.data.name())
    }

    /// Returns the function as text, or an empty text if the data contain no text.
    pub fn text(&self) -> &str {
        self.data.text.as_deref().unwrap_or_default()
    }

    /// Returns the names of all numbers and parts.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let all = self.data.numbers.keys().chain(self.data.parts.keys()).map(String::as_str);
        all.inspect(|name| self.ask(name))
    }

    /// Returns the numbers `name[first]`, `name[first + 1]`, … up to the first missing number.
    pub fn list(&self, name: &str, first: usize) -> Vec<f64> {
        let number = |k: usize| {
            let name = format!("{name}[{k}]");
            let number = self.data.numbers.get(&name).copied();
            number.inspect(|_| self.ask(&name))
        };
        (first..).map_while(number).collect()
    }

    /// Returns two such lists side by side. Errors: their lengths differ.
    fn pairs(&self, names: [&str; 2], first: usize) -> Result<Vec<(f64, f64)>, String> {
        let [a, b] = names.map(|name| self.list(name, first));
        if a.len() == b.len() {
            return Ok(a.into_iter().zip(b).collect());
        }
        let [one, other] = names;
        let own = self.data.name();
        Err(format!(
            "the law `{own}` has {} numbers `{one}` and {} numbers `{other}`",
            a.len(),
            b.len()
        ))
    }

    /// Returns the contained law with this name.
    ///
    /// Errors: no law has the name; the kind of the law is unknown.
    pub fn part(&self, name: &str) -> Result<Law, String> {
        self.ask(name);
        let part = self
            .data
            .parts
            .get(name)
            .ok_or_else(|| self.lacks(&format!("its part `{name}`"), name))?;
        self.registry.law(part)
    }
}

/// A constructor of a rise from its height and length.
type Rise = fn(f64, f64) -> Law;

/// Registers the laws of the library.
pub(super) fn shipped(registry: Registry) -> Registry {
    let rises: [(&str, Rise); 6] = [
        ("harmonic_rise", Law::harmonic_rise),
        ("cycloidal", Law::cycloidal),
        ("polynomial_345", Law::polynomial_345),
        ("polynomial_4567", Law::polynomial_4567),
        ("modified_sine", Law::modified_sine),
        ("modified_trapezoid", Law::modified_trapezoid),
    ];
    let registry = rises.into_iter().fold(registry, |registry, (kind, make)| {
        registry.with_law(kind, move |law| Ok(make(law.number("height")?, law.number("length")?)))
    });
    registry
        .with_law("constant", |law| Ok(Law::constant(law.number("c")?)))
        .with_law("ramp", |law| Ok(Law::ramp(law.number("rate")?)))
        .with_law("linear", |law| Ok(Law::linear(law.number("f0")?, law.number("rate")?)))
        .with_law("polynomial", |law| Ok(Law::polynomial(&law.list("c", 0))))
        .with_law("harmonic", |law| {
            Ok(Law::harmonic(law.number("mean")?, law.number("amplitude")?))
        })
        .with_law("sine", |law| {
            Ok(Law::sine(law.number("amplitude")?, law.number("omega")?, law.number("phase")?))
        })
        .with_law("fourier", |law| {
            let pairs = law.pairs(["a", "b"], 1)?;
            Ok(Law::fourier(law.number("mean")?, law.number("omega")?, &pairs))
        })
        .with_law("trapezoidal", |law| {
            Ok(Law::trapezoidal(
                law.number("distance")?,
                law.number("speed")?,
                law.number("acceleration")?,
            ))
        })
        .with_law("s_curve", |law| {
            Ok(Law::s_curve(
                law.number("distance")?,
                law.number("speed")?,
                law.number("acceleration")?,
                law.number("jerk")?,
            ))
        })
        .with_law("spline", |law| spline(law, Law::spline))
        .with_law("quintic_spline", |law| spline(law, Law::quintic_spline))
        .with_law("sequence", sequence)
        .with_law("periodic", |law| Ok(law.part("law")?.periodic(law.number("period")?)))
        .with_law("product", |law| Ok(law.part("first")? * law.part("second")?))
        .with_law("sum", |law| Ok(law.part("first")? + law.part("second")?))
        .with_law("multiple", |law| Ok(law.number("factor")? * law.part("law")?))
        .with_law("composed", |law| Ok(law.part("outer")?.compose(&law.part("inner")?)))
}

fn spline(law: &LawReader<'_>, make: fn(&[(f64, f64)], Ends) -> Law) -> Result<Law, String> {
    let table = law.pairs(["x", "y"], 0)?;
    let ends = match (law.number("periodic"), law.number("start")) {
        (Ok(_), _) => Ends::Periodic,
        (_, Ok(start)) => Ends::Clamped { start, end: law.number("end")? },
        _ => Ends::Natural,
    };
    Ok(make(&table, ends))
}

fn sequence(law: &LawReader<'_>) -> Result<Law, String> {
    let lengths = (0..).map_while(|k| law.number(&format!("part[{k}].length")).ok());
    let parts =
        lengths.enumerate().map(|(k, length)| Ok((length, law.part(&format!("part[{k}].law"))?)));
    Ok(Law::sequence(law.number("start")?, parts.collect::<Result<Vec<_>, String>>()?))
}
