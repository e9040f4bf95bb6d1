//! All assemblies that were found, and whether there can be others.

use std::fmt::{Display, Formatter};
use std::ops::Deref;

use serde::Serialize;

use super::label::Label;

/// One assembly of a mechanism.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Assembly {
    /// Its name among all.
    pub label: Label,
    /// The pose, C(q, t) = 0: a guess from which the mechanism is assembled in this way again
    /// ([`crate::System::set_initial`]).   \[m, rad\]
    pub q: Vec<f64>,
}

/// Completeness of a list of assemblies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Complete {
    /// There is no other assembly.
    Proved,
    /// More starts are not expected to lead to another assembly: the search has ended by its
    /// statistical rule, not by a proof.
    Believed,
    /// Other assemblies may exist.
    Unknown,
}

impl Display for Complete {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Complete::Proved => "proved",
            Complete::Believed => "believed",
            Complete::Unknown => "unknown",
        })
    }
}

/// The assemblies that [`crate::System::assemblies`] has found, in the order of their labels, and
/// whether they are all there are. Reads like a slice: `all.len()`, `all[0]`, `for one in &all`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Assemblies {
    /// The assemblies.
    pub assemblies: Vec<Assembly>,
    /// The verdict on completeness.
    pub complete: Complete,
    /// The reason for the verdict, in words.
    pub reason: String,
}

impl Deref for Assemblies {
    type Target = [Assembly];

    fn deref(&self) -> &[Assembly] {
        &self.assemblies
    }
}

impl IntoIterator for Assemblies {
    type Item = Assembly;
    type IntoIter = std::vec::IntoIter<Assembly>;

    fn into_iter(self) -> Self::IntoIter {
        self.assemblies.into_iter()
    }
}

impl<'a> IntoIterator for &'a Assemblies {
    type Item = &'a Assembly;
    type IntoIter = std::slice::Iter<'a, Assembly>;

    fn into_iter(self) -> Self::IntoIter {
        self.assemblies.iter()
    }
}

/// The figures of a search, for its verdict.
pub(super) struct Account {
    /// Starts of all groups.
    pub starts: usize,
    /// The largest number of poses that may be missing in one group, and how often the rarest pose
    /// was met.
    pub missing: f64,
    pub rarest: usize,
    /// True as long as every group had exactly one solution by its form.
    pub is_affine: bool,
    /// Why poses may be missing, the first reason.
    pub doubt: Option<String>,
}

impl Account {
    pub(super) fn new() -> Self {
        Account { starts: 0, missing: 0.0, rarest: usize::MAX, is_affine: true, doubt: None }
    }

    /// Notes a reason for doubt unless there is one.
    pub(super) fn doubt(&mut self, reason: impl FnOnce() -> String) {
        self.doubt.get_or_insert_with(reason);
    }

    /// The verdict on so many assemblies, and its reason.
    pub(super) fn verdict(self, found: usize) -> (Complete, String) {
        let starts = self.starts;
        match self.doubt {
            Some(doubt) => (Complete::Unknown, doubt),
            None if found == 0 => (
                Complete::Unknown,
                format!(
                    "none of {starts} starts led to an assembly; a diagnosis says how near the parts can come"
                ),
            ),
            None if self.is_affine => (
                Complete::Proved,
                "each equation is linear in the coordinates that it determines and has one solution"
                    .to_string(),
            ),
            None => (
                Complete::Believed,
                format!(
                    "{starts} starts led to each assembly {} times or more; by the estimate of Boender and Rinnooy \
                     Kan {:.2} are missing",
                    self.rarest, self.missing
                ),
            ),
        }
    }
}
