//! The numeric parameters of a constraint: read and changed by name, judged, and written as data.

use super::Constraint;
use crate::model::describer::Describer;
use crate::model::dimension::Bindings;

/// The parameters of a constraint. [`Constraint::parts`] shows them; emitted constraints have them.
pub trait Parameters {
    /// Shows each numeric parameter with its name (`k`, `u_i.x`, `c[2]`).
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64));

    /// Sets one numeric parameter by the name [`Parameters::parameters`] gives it; false if there
    /// is none of that name.
    fn set_parameter(&mut self, name: &str, value: f64) -> bool;

    /// Sets one numeric parameter by its number in the order of [`Parameters::parameters`]; false
    /// if there is none. The default goes by name; emitted constraints do not.
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

    /// The ends of the range of measure k of [`super::Facts::measures`], if it has any: those of a
    /// slot.
    fn ends(&self, k: usize) -> Option<[f64; 2]> {
        let _ = k;
        None
    }

    /// The reason why the parameters make no sense, if so: a mechanism refuses the constraint with
    /// these words.
    fn refusal(&self) -> Option<String> {
        None
    }

    /// Takes out which parameters were given as expressions of dimensions; none by default.
    fn take_bindings(&mut self) -> Bindings {
        Bindings::NONE
    }

    /// Tells each parameter under its name, so that the constraint can be written as data and made
    /// anew; refuses where it cannot be (default).
    fn describe(&self, to: &mut Describer) {
        to.refuse(UNKNOWN);
    }
}

const UNKNOWN: &str =
    "it is written by hand, not made from a function, so its parameters are not known";

/// The parameters of any constraint; one that shows none has none.
impl dyn Constraint + '_ {
    /// [`Parameters::parameters`]
    pub fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        if let Some(own) = self.parts().parameters {
            own.parameters(visit);
        }
    }

    /// [`Parameters::set_parameter`]
    pub fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        self.parameters_mut().is_some_and(|own| own.set_parameter(name, value))
    }

    /// [`Parameters::set_parameter_at`]
    pub fn set_parameter_at(&mut self, index: usize, value: f64) -> bool {
        self.parameters_mut().is_some_and(|own| own.set_parameter_at(index, value))
    }

    /// [`Parameters::ends`]
    pub fn ends(&self, k: usize) -> Option<[f64; 2]> {
        self.parts().parameters?.ends(k)
    }

    /// [`Parameters::refusal`]
    pub fn refusal(&self) -> Option<String> {
        self.parts().parameters.and_then(|own| own.refusal())
    }

    /// [`Parameters::take_bindings`]
    pub fn take_bindings(&mut self) -> Bindings {
        self.parameters_mut().map_or(Bindings::NONE, |own| own.take_bindings())
    }

    /// [`Parameters::describe`]
    pub fn describe(&self, to: &mut Describer) {
        match self.parts().parameters {
            Some(own) => own.describe(to),
            None => to.refuse(UNKNOWN),
        }
    }
}
