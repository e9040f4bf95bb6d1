//! Records the parameters of a constraint that depend on dimensions.

use std::fmt;

use super::{Dimension, IntoNumber, Of};
use crate::numbers::algebra::Axis;

/// The name of a number in a constraint.
///
/// Kin builds the text of the name only when a number depends on dimensions.
pub enum Name<'a> {
    /// A parameter: `k`.
    Own(&'a str),
    /// A component of a parameter: `u_i.x`, `motor.rate`.
    Field(&'a Name<'a>, &'a str),
    /// An element of a list: `c[2]`.
    Index(&'a Name<'a>, usize),
}

impl fmt::Display for Name<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Name::Own(name) => f.write_str(name),
            Name::Field(of, name) => write!(f, "{of}.{name}"),
            Name::Index(of, k) => write!(f, "{of}[{k}]"),
        }
    }
}

/// The parameters of one constraint that are expressions of dimensions, by name.
///
/// Most constraints have no such parameter, and an empty list needs no memory on the heap.
/// [`crate::Mechanism::add`] removes the list from the constraint.
#[derive(Clone, Default)]
pub struct Bindings(Vec<(String, Dimension)>);

impl Bindings {
    /// The empty list.
    pub const NONE: Bindings = Bindings(Vec::new());

    /// Records the number under this parameter name and returns its value.
    pub fn note(&mut self, name: &Name<'_>, number: Dimension) -> f64 {
        if number.of() != Of::Nothing {
            self.0.push((name.to_string(), number));
        }
        number.value()
    }

    /// Returns the value of a parameter and records the parameter if it depends on dimensions.
    pub fn number(&mut self, name: &str, number: impl IntoNumber) -> f64 {
        self.note(&Name::Own(name), number.into_number())
    }

    /// Returns the vector of these components. Components that depend on dimensions are recorded as
    /// `NAME.x`, `NAME.y` and `NAME.z`.
    pub(crate) fn vector(&mut self, name: &str, components: [Dimension; 3]) -> [f64; 3] {
        let mut names = ["x", "y", "z"].into_iter();
        components
            .map(|x| self.note(&Name::Field(&Name::Own(name), names.next().unwrap_or_default()), x))
    }

    /// Returns the values of the parameters `name[first]`, `name[first + 1]`, … and records the
    /// parameters that depend on dimensions.
    pub fn list(
        &mut self,
        name: &str,
        first: usize,
        numbers: impl Iterator<Item = impl IntoNumber>,
    ) -> Vec<f64> {
        let own = Name::Own(name);
        let numbers = numbers.enumerate();
        numbers
            .map(|(k, number)| self.note(&Name::Index(&own, first + k), number.into_number()))
            .collect()
    }

    /// Returns the axis with the given components of its direction, optionally followed by the
    /// components of a second direction.
    ///
    /// If one component depends on dimensions, the method records all components, as `NAME.h.x`, …,
    /// `NAME.f.z`.
    pub fn axis(&mut self, name: &str, given: &[Dimension]) -> Axis {
        if given.iter().any(|number| number.of() != Of::Nothing) {
            self.0.extend(
                (0..).zip(given).map(|(part, number)| (Axis::name_of(name, part), *number)),
            );
        }
        Axis::given(&given.iter().map(|number| number.value()).collect::<Vec<f64>>())
    }

    /// Removes and returns all recorded numbers.
    pub fn take(&mut self) -> Vec<(String, Dimension)> {
        std::mem::take(&mut self.0)
    }
}
