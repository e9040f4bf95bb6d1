//! Places: variables, and parts of them.

/// The number of a variable.
pub type Slot = usize;

/// A variable, or a part of one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Place {
    pub slot: Slot,
    pub steps: Vec<Step>,
}

/// A step from a value to one of its parts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Step {
    Field(String),
    Index(usize),
    /// The range from the first index to before the second.
    Slice(usize, usize),
}

impl Place {
    /// Returns the place of a whole variable.
    pub fn whole(slot: Slot) -> Place {
        Place { slot, steps: vec![] }
    }

    /// Returns the place at the end of further steps.
    pub fn then(&self, steps: &[Step]) -> Place {
        Place { slot: self.slot, steps: [&self.steps, steps].concat() }
    }

    fn to(&self, step: Step) -> Place {
        self.then(&[step])
    }

    pub fn field(&self, name: &str) -> Place {
        self.to(Step::Field(name.into()))
    }

    pub fn index(&self, k: usize) -> Place {
        self.to(Step::Index(k))
    }

    pub fn slice(&self, from: usize, to: usize) -> Place {
        self.to(Step::Slice(from, to))
    }
}

#[cfg(test)]
mod tests {
    use super::{Place, Step};

    #[test]
    fn steps_lead_from_a_variable_to_its_parts() {
        let place = Place::whole(3).field("r").index(1);
        assert_eq!(place.steps, [Step::Field("r".into()), Step::Index(1)]);
        assert_eq!(Place::whole(3).then(&place.steps), place);
    }
}
