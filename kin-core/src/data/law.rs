//! Laws as data: a kind, its own numbers, and the laws that it is made of.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Registry;
use crate::law::Law;

/// A law as data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LawData {
    /// Its kind, such as `ramp`: what a [`Registry`] looks up.
    pub kind: String,
    /// Its own numbers by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub numbers: BTreeMap<String, f64>,
    /// The laws that it is made of, by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parts: BTreeMap<String, LawData>,
}

impl LawData {
    /// The law as its kind, numbers and parts say.
    pub fn of(law: &Law) -> LawData {
        let parts = law.parts();
        let mut numbers = BTreeMap::new();
        law.parameters(&mut |name, value| {
            let inside = |(part, _): &(String, Law)| name.strip_prefix(part.as_str()).is_some_and(|rest| rest.starts_with('.'));
            if !parts.iter().any(inside) {
                numbers.insert(name.to_string(), value);
            }
        });
        let parts = parts.iter().map(|(name, part)| (name.clone(), LawData::of(part))).collect();
        LawData { kind: law.kind().to_string(), numbers, parts }
    }
}

/// A law's data as its constructor reads them.
pub struct LawReader<'a> {
    pub(super) data: &'a LawData,
    pub(super) registry: &'a Registry,
}

impl LawReader<'_> {
    /// The number of that name. Errors: none.
    pub fn number(&self, name: &str) -> Result<f64, String> {
        self.data.numbers.get(name).copied().ok_or_else(|| format!("the law `{}` lacks the number `{name}`", self.data.kind))
    }

    /// The numbers `name[first]`, `name[first + 1]`, … as far as they go.
    pub fn list(&self, name: &str, first: usize) -> Vec<f64> {
        (first..).map_while(|k| self.data.numbers.get(&format!("{name}[{k}]")).copied()).collect()
    }

    /// The law of that name that this one is made of. Errors: none, of an unknown kind.
    pub fn part(&self, name: &str) -> Result<Law, String> {
        let part = self.data.parts.get(name).ok_or_else(|| format!("the law `{}` lacks its part `{name}`", self.data.kind))?;
        self.registry.law(part)
    }
}

/// The laws that ship.
pub(super) fn shipped(registry: Registry) -> Registry {
    registry
        .with_law("constant", |law| Ok(Law::constant(law.number("c")?)))
        .with_law("ramp", |law| Ok(Law::ramp(law.number("rate")?)))
        .with_law("linear", |law| Ok(Law::linear(law.number("f0")?, law.number("rate")?)))
        .with_law("polynomial", |law| Ok(Law::polynomial(&law.list("c", 0))))
        .with_law("harmonic", |law| Ok(Law::harmonic(law.number("mean")?, law.number("amplitude")?)))
        .with_law("sine", |law| Ok(Law::sine(law.number("amplitude")?, law.number("omega")?, law.number("phase")?)))
        .with_law("sum", |law| Ok(law.part("first")? + law.part("second")?))
        .with_law("multiple", |law| Ok(law.number("factor")? * law.part("law")?))
        .with_law("composed", |law| Ok(law.part("outer")?.compose(&law.part("inner")?)))
}
