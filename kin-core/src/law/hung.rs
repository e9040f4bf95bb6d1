//! Records the numbers of a law that depend on dimensions.

use super::Law;
use crate::dimensions::{Bindings, IntoParameter, Name};

impl Bindings {
    /// Records the numbers of a law that depend on dimensions, under their names.
    pub(crate) fn law(&mut self, name: &str, law: &Law) {
        self.numbers_of(&Name::Own(name), law);
    }

    fn numbers_of(&mut self, name: &Name<'_>, law: &Law) {
        law.each_hung(&mut |own, number| {
            self.note(&Name::Field(name, own), number);
        });
    }
}

impl IntoParameter<Law> for Law {
    fn into_parameter(self, name: &Name<'_>, to: &mut Bindings) -> Law {
        to.numbers_of(name, &self);
        self
    }
}
