//! Messages for parameters that make no sense.

use super::Numbers;
use crate::law::Law;
use crate::numbers::algebra::Axis;

/// A parameter that can be wrong independently of the others.
pub trait Refuses {
    /// Returns the fault of the argument, or `None`.
    fn refusal(&self) -> Option<String>;
}

impl Refuses for Law {
    fn refusal(&self) -> Option<String> {
        Law::refusal(self)
    }
}

impl Refuses for Axis {
    fn refusal(&self) -> Option<String> {
        (!self.is_sound()).then(|| {
            "the axis has no direction. Give a vector h that is not zero, and a vector f that is not along h"
                .to_string()
        })
    }
}

/// Returns the first of these parameters that is wrong, with the reason.
pub fn refusal(parameters: &[(&str, &dyn Refuses)]) -> Option<String> {
    parameters
        .iter()
        .find_map(|(name, parameter)| Some(format!("{name}: {}", parameter.refusal()?)))
}

/// Returns the text of a requirement that does not hold, with the values of its parameters.
pub fn refused(text: &str, values: &[(&str, &dyn Numbers)]) -> String {
    let mut shown = Vec::new();
    for (name, value) in values {
        value.visit(name, &mut |name, value| shown.push(format!("{name} = {value}")));
    }
    if shown.is_empty() { text.to_string() } else { format!("{text} ({})", shown.join(", ")) }
}
