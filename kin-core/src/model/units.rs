//! The words for the units of length and time, as files, pages and messages write them.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// Unit of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// A length.   \[m\]
    Metre,
    /// An angle.   \[rad\]
    Radian,
    /// An Euler parameter.   \[-\]
    One,
}

/// The words for the units of length and time; angles are in radians. Nothing is converted: Kin computes in
/// any consistent set of units.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(from = "Words", into = "Words")]
pub struct Units(Arc<Words>);

/// The words as they stand in a file.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
struct Words {
    length: String,
    time: String,
}

impl From<Words> for Units {
    fn from(words: Words) -> Units {
        Units::new(&words.length, &words.time)
    }
}

impl From<Units> for Words {
    fn from(units: Units) -> Words {
        units.0.as_ref().clone()
    }
}

impl Default for Units {
    /// Metre and second.
    fn default() -> Self {
        Units::new("m", "s")
    }
}

impl Units {
    /// The words, without blanks around them.
    pub fn new(length: &str, time: &str) -> Units {
        Units(Arc::new(Words { length: length.trim().to_string(), time: time.trim().to_string() }))
    }

    /// The word for the unit of length, such as `mm`.
    pub fn length(&self) -> &str {
        &self.0.length
    }

    /// The word for the unit of time, such as `s`.
    pub fn time(&self) -> &str {
        &self.0.time
    }

    /// True if the units are metre and second.
    pub(crate) fn is_default(&self) -> bool {
        *self == Units::default()
    }

    /// Which of the two has no word, if one has none.
    pub(crate) fn missing(&self) -> Option<&'static str> {
        if self.length().is_empty() {
            Some("unit of length")
        } else if self.time().is_empty() {
            Some("unit of time")
        } else {
            None
        }
    }

    /// The unit of a coordinate (`order` 0) and of its rates, such as `mm/s^2`.
    pub(crate) fn text(&self, unit: Unit, order: usize) -> String {
        match unit {
            Unit::Metre => self.rate(self.length(), order),
            Unit::Radian => self.rate("rad", order),
            Unit::One => self.rate("-", order),
        }
    }

    /// The unit of a rate of something in `unit`; of what has none (`-`) it is `1/s`.
    pub(crate) fn rate(&self, unit: &str, order: usize) -> String {
        let unit = match (unit, order) {
            (unit, 0) => return unit.to_string(),
            ("-" | "", _) => "1",
            (unit, _) => unit,
        };
        let power = if order == 1 { String::new() } else { format!("^{order}") };
        format!("{unit}/{}{power}", self.time())
    }

    /// A unit that a constraint tells in metres and seconds (`m`, `m/s`, `1/m`), in these words; other words
    /// stay.
    pub(crate) fn told(&self, unit: &str) -> String {
        let word = |word: &str| match word {
            "m" => self.length().to_string(),
            "s" => self.time().to_string(),
            other => other.to_string(),
        };
        let mut text = String::new();
        let mut rest = unit;
        while let Some(first) = rest.chars().next() {
            let end = rest.find(|c: char| c.is_alphabetic() != first.is_alphabetic()).unwrap_or(rest.len());
            let (run, after) = rest.split_at(end);
            text += &word(run);
            rest = after;
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_rates_are_made_of_the_words() {
        let units = Units::new(" mm", "ms ");
        assert_eq!(
            [0, 1, 2, 3].map(|order| units.text(Unit::Metre, order)),
            ["mm", "mm/ms", "mm/ms^2", "mm/ms^3"]
        );
        assert_eq!([0, 1, 2].map(|order| units.text(Unit::One, order)), ["-", "1/ms", "1/ms^2"]);
        assert_eq!(units.text(Unit::Radian, 2), "rad/ms^2");
        assert_eq!(Units::default().text(Unit::Metre, 3), "m/s^3");
    }

    #[test]
    fn a_constraint_that_tells_metres_is_read_in_the_words_of_the_mechanism() {
        let units = Units::new("mm", "min");
        assert_eq!(
            ["m", "rad", "m/s^2", "1/m", "m^2", "-", "", "mol"].map(|unit| units.told(unit)),
            ["mm", "rad", "mm/min^2", "1/mm", "mm^2", "-", "", "mol"]
        );
    }
}
