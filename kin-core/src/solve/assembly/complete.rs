//! Stores the assemblies that Kin found, and the evidence that the list is complete.

use std::fmt::{Display, Formatter};
use std::ops::Deref;

use serde::Serialize;

use super::label::Label;

/// One assembly of a mechanism.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Assembly {
    /// The label that identifies the assembly.
    pub label: Label,
    /// The pose, with C(q, t) = 0. \[m, rad\] If you pass the pose to
    /// [`crate::System::set_initial`], the system finds this assembly again.
    pub q: Vec<f64>,
}

/// Says whether a list of assemblies is complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Complete {
    /// Kin has proved that no other assembly exists.
    Proved,
    /// Kin does not expect another assembly from more starts. A statistical rule ended the search,
    /// so completeness is not proved.
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

/// The assemblies that [`crate::System::assemblies`] has found, in the order of their labels.
///
/// The field `complete` says whether the list is complete.
///
/// The type dereferences to a slice: `all.len()`, `all[0]`, `for one in &all`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Assemblies {
    /// The assemblies in the order of their labels.
    pub assemblies: Vec<Assembly>,
    /// Says whether the list is complete.
    pub complete: Complete,
    /// The reason for the value of `complete`, as a sentence.
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

/// The figures of a search, from which its verdict follows.
pub(super) struct Account {
    /// The number of starts of all groups.
    pub starts: usize,
    /// The largest number of poses that may be missing in one group; `rarest` is how often the
    /// rarest pose was found.
    pub missing: f64,
    pub rarest: usize,
    /// True as long as every group is affine, so that it has exactly one solution.
    pub is_affine: bool,
    /// The first reason why poses may be missing; `None` if there is none.
    pub doubt: Option<String>,
}

impl Account {
    pub(super) fn new() -> Self {
        Account { starts: 0, missing: 0.0, rarest: usize::MAX, is_affine: true, doubt: None }
    }

    /// Records a reason for doubt, unless there is one already.
    pub(super) fn doubt(&mut self, reason: impl FnOnce() -> String) {
        self.doubt.get_or_insert_with(reason);
    }

    /// Returns the verdict on `found` assemblies, and its reason.
    pub(super) fn verdict(self, found: usize) -> (Complete, String) {
        let starts = self.starts;
        match self.doubt {
            Some(doubt) => (Complete::Unknown, doubt),
            None if found == 0 => (
                Complete::Unknown,
                format!(
                    "none of {starts} starting poses led to an assembly. Call `diagnose` to see how near the parts can come"
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
                    "{starts} starting poses led to each assembly {} times or more. By the estimate of Boender and Rinnooy Kan {:.2} assemblies are missing",
                    self.rarest, self.missing
                ),
            ),
        }
    }
}
