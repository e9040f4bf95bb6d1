//! The parameters of one constraint that hang on dimensions.

use std::fmt;

use super::{Dimension, IntoNumber, Of};
use crate::model::law::Law;
use crate::numbers::algebra::Axis;

/// The name of a number in a constraint: written only where it is asked for.
pub enum Name<'a> {
    /// A parameter: `k`.
    Own(&'a str),
    /// A component: `u_i.x`, `motor.rate`.
    Field(&'a Name<'a>, &'a str),
    /// One of several: `c[2]`.
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

/// The numbers of one constraint that are expressions of dimensions, each by the name of its
/// parameter. None is the rule, and takes nothing from the heap: [`crate::Mechanism::add`] takes
/// them out.
#[derive(Clone, Default)]
pub struct Bindings(Vec<(String, Dimension)>);

impl Bindings {
    /// None.
    pub const NONE: Bindings = Bindings(Vec::new());

    /// Notes that the parameter of that name is this number, and gives its value.
    pub fn note(&mut self, name: &Name<'_>, number: Dimension) -> f64 {
        if number.of() != Of::Nothing {
            self.0.push((name.to_string(), number));
        }
        number.value()
    }

    /// The value of a parameter of that name, noted if it hangs on dimensions.
    pub fn number(&mut self, name: &str, number: impl IntoNumber) -> f64 {
        self.note(&Name::Own(name), number.into_number())
    }

    /// The vector of these components, noted as `NAME.x`, `NAME.y` and `NAME.z` if they hang on
    /// dimensions.
    pub(crate) fn vector(&mut self, name: &str, components: [Dimension; 3]) -> [f64; 3] {
        let mut names = ["x", "y", "z"].into_iter();
        components
            .map(|x| self.note(&Name::Field(&Name::Own(name), names.next().unwrap_or_default()), x))
    }

    /// The values of the parameters `name[first]`, `name[first + 1]`, …, noted if they hang on
    /// dimensions.
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

    /// The axis that is given by the components of its direction, after which those of a second one
    /// may follow. They are noted if any of them hangs on dimensions, each as `NAME.h.x`, …,
    /// `NAME.f.z`.
    pub fn axis(&mut self, name: &str, given: &[Dimension]) -> Axis {
        if given.iter().any(|number| number.of() != Of::Nothing) {
            self.0.extend(
                (0..).zip(given).map(|(part, number)| (Axis::name_of(name, part), *number)),
            );
        }
        Axis::given(&given.iter().map(|number| number.value()).collect::<Vec<f64>>())
    }

    /// Notes the numbers of a law that hang on dimensions, under their names.
    pub(crate) fn law(&mut self, name: &str, law: &Law) {
        law.each_hung(&mut |own, number| {
            self.note(&Name::Field(&Name::Own(name), own), number);
        });
    }

    /// Those there are, which are then no longer there.
    pub fn take(&mut self) -> Vec<(String, Dimension)> {
        std::mem::take(&mut self.0)
    }
}
