//! Reads, sets, checks and writes the numeric parameters of a constraint.

use super::Constraint;
use crate::dimensions::Bindings;
use crate::law::Law;
use crate::model::describer::Describer;

/// The numeric parameters of a constraint.
///
/// Compiled constraints implement this trait. [`Constraint::parts`] returns the implementation.
pub trait Parameters {
    /// Passes each numeric parameter and its name (`k`, `u_i.x`, `c[2]`) to `visit`.
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64));

    /// Sets one numeric parameter by a name from [`Parameters::parameters`].
    ///
    /// Returns false if no parameter has this name.
    fn set_parameter(&mut self, name: &str, value: f64) -> bool;

    /// Sets one numeric parameter by its index in the order of [`Parameters::parameters`].
    ///
    /// Returns false if no parameter has this index. The default implementation searches for the
    /// name; compiled constraints use the index directly.
    fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
        let mut number = 0;
        let mut wanted = None;
        self.parameters(&mut |name, _| {
            if number == index {
                wanted = Some(name.to_string());
            }
            number += 1;
        });
        wanted.is_some_and(|name| self.set_parameter(&name, value))
    }

    /// Replaces the law of the parameter with this name. Returns false if no law has this name,
    /// which is the default. Compiled constraints implement it.
    fn set_law(&mut self, name: &str, law: &Law) -> bool {
        let _ = (name, law);
        false
    }

    /// Returns the ends of the range of measure k of [`super::Facts::measures`], if the measure has
    /// a range, such as the slide of a slot.
    fn ends(&self, k: usize) -> Option<[f64; 2]> {
        let _ = k;
        None
    }

    /// Returns the reason if the parameters are invalid.
    ///
    /// The error of the mechanism contains this text.
    fn refusal(&self) -> Option<String> {
        None
    }

    /// Removes and returns the parameters that are expressions of dimensions.
    ///
    /// The default implementation returns an empty list.
    fn take_bindings(&mut self) -> Bindings {
        Bindings::NONE
    }

    /// Writes each parameter under its name, so that a file can contain the constraint.
    ///
    /// The default implementation records that the constraint cannot be described.
    fn describe(&self, to: &mut Describer) {
        to.refuse(UNKNOWN);
    }
}

const UNKNOWN: &str = "the constraint is hand-written, so Kin does not know its parameters";

/// The parameters of any constraint. A constraint without the trait has no parameters.
impl dyn Constraint + '_ {
    /// Calls [`Parameters::parameters`].
    pub fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        if let Some(own) = self.parts().parameters {
            own.parameters(visit);
        }
    }

    /// Calls [`Parameters::set_parameter`].
    pub fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        self.parameters_mut().is_some_and(|own| own.set_parameter(name, value))
    }

    /// Calls [`Parameters::set_parameter_at`].
    pub fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
        self.parameters_mut().is_some_and(|own| own.set_parameter_at(index, value))
    }

    /// Calls [`Parameters::set_law`].
    pub fn set_law(&mut self, name: &str, law: &Law) -> bool {
        self.parameters_mut().is_some_and(|own| own.set_law(name, law))
    }

    /// Calls [`Parameters::ends`].
    pub fn ends(&self, k: usize) -> Option<[f64; 2]> {
        self.parts().parameters?.ends(k)
    }

    /// Calls [`Parameters::refusal`].
    pub fn refusal(&self) -> Option<String> {
        self.parts().parameters.and_then(|own| own.refusal())
    }

    /// Calls [`Parameters::take_bindings`].
    pub fn take_bindings(&mut self) -> Bindings {
        self.parameters_mut().map_or(Bindings::NONE, |own| own.take_bindings())
    }

    /// Calls [`Parameters::describe`].
    pub fn describe(&self, to: &mut Describer) {
        match self.parts().parameters {
            Some(own) => own.describe(to),
            None => to.refuse(UNKNOWN),
        }
    }
}
