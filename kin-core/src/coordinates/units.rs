//! Names the units of length, time and mass in files, pages and messages.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// Names of units of mass, length and time, with their powers of ten of kilogram, metre and second.
const MASSES: [(&str, i32); 4] = [("kg", 0), ("g", -3), ("t", 3), ("mg", -6)];
const LENGTHS: [(&str, i32); 7] =
    [("m", 0), ("dm", -1), ("cm", -2), ("mm", -3), ("um", -6), ("µm", -6), ("km", 3)];
const TIMES: [(&str, i32); 4] = [("s", 0), ("ms", -3), ("us", -6), ("µs", -6)];

/// Other units of length, which Kin only distinguishes from each other.
const OTHER_LENGTHS: [&str; 4] = ["in", "inch", "ft", "yd"];
const OTHER_TIMES: [&str; 4] = ["min", "h", "sec", "second"];
const OTHER_MASSES: [&str; 4] = ["lb", "lbm", "slug", "oz"];
const FORCES: [&str; 6] = ["N", "mN", "kN", "MN", "lbf", "kgf"];

/// The kind of unit of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// A length.   \[m\]
    Metre,
    /// An angle.   \[rad\]
    Radian,
    /// An Euler parameter.   \[-\]
    One,
}

/// The names of the units of length, time and mass; angles are in radians. Kin converts nothing and
/// computes in any consistent set of units.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(from = "Words", into = "Words")]
pub struct Units(Arc<Words>);

/// The names as a file contains them.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
struct Words {
    length: String,
    time: String,
    #[serde(default = "kilogram", skip_serializing_if = "is_kilogram")]
    mass: String,
}

fn kilogram() -> String {
    "kg".to_string()
}

fn is_kilogram(mass: &String) -> bool {
    mass == "kg"
}

impl From<Words> for Units {
    fn from(words: Words) -> Units {
        Units::new(&words.length, &words.time).with_mass(&words.mass)
    }
}

impl From<Units> for Words {
    fn from(units: Units) -> Words {
        units.0.as_ref().clone()
    }
}

impl Default for Units {
    /// Returns metre and second.
    fn default() -> Self {
        Units::new("m", "s")
    }
}

impl Units {
    /// Creates the names of the units of length and time and removes surrounding blanks.
    pub fn new(length: &str, time: &str) -> Units {
        let length = length.trim().to_string();
        let time = time.trim().to_string();
        Units(Arc::new(Words { length, time, mass: kilogram() }))
    }

    /// Returns the units with another name for the unit of mass.
    #[must_use]
    pub fn with_mass(&self, mass: &str) -> Units {
        Units(Arc::new(Words { mass: mass.trim().to_string(), ..self.0.as_ref().clone() }))
    }

    /// Returns the name of the unit of length, such as `mm`.
    pub fn length(&self) -> &str {
        &self.0.length
    }

    /// Returns the name of the unit of time, such as `s`.
    pub fn time(&self) -> &str {
        &self.0.time
    }

    /// Returns the name of the unit of mass, such as `kg`.
    pub fn mass(&self) -> &str {
        &self.0.mass
    }

    /// Returns the unit of force, such as `N`.
    ///
    /// The unit of force is `mN` for millimetre, second and kilogram, and `N` for millimetre,
    /// second and tonne. If Kin does not know the names of the units, it returns
    /// `MASS LENGTH/TIME^2`.
    pub fn force(&self) -> String {
        self.newtons()
            .unwrap_or_else(|| format!("{} {}/{}^2", self.mass(), self.length(), self.time()))
    }

    /// Returns the unit of torque, such as `N m` or `mN mm`.
    pub fn torque(&self) -> String {
        match self.newtons() {
            Some(force) => format!("{force} {}", self.length()),
            None => format!("{} {}^2/{}^2", self.mass(), self.length(), self.time()),
        }
    }

    /// Returns the unit of energy, such as `J` or `kJ`.
    ///
    /// The unit of energy is `mJ` for millimetre, second and tonne. If Kin does not know the names
    /// of the units, it returns the unit of torque.
    pub fn energy(&self) -> String {
        self.prefixed([1, 2, -2], "J").unwrap_or_else(|| self.torque())
    }

    /// Returns the unit of power, such as `W` or `kW`.
    ///
    /// The unit of power is `mW` for millimetre, second and tonne. If Kin does not know the names
    /// of the units, it returns `MASS LENGTH^2/TIME^3`.
    pub fn power(&self) -> String {
        self.prefixed([1, 2, -3], "W")
            .unwrap_or_else(|| format!("{} {}^2/{}^3", self.mass(), self.length(), self.time()))
    }

    /// Returns newton with its prefix.
    fn newtons(&self) -> Option<String> {
        self.prefixed([1, 1, -2], "N")
    }

    /// Returns an SI unit with the prefix that follows from these powers of mass, length and time.
    /// Returns `None` for unknown names, or if there is no such prefix.
    fn prefixed(&self, powers: [i32; 3], unit: &str) -> Option<String> {
        let mass = power_of_ten(self.mass(), &MASSES)?;
        let length = power_of_ten(self.length(), &LENGTHS)?;
        let time = power_of_ten(self.time(), &TIMES)?;
        let prefix =
            [("", 0), ("m", -3), ("µ", -6), ("n", -9), ("p", -12), ("k", 3), ("M", 6), ("G", 9)];
        let exponent = mass * powers[0] + length * powers[1] + time * powers[2];
        prefix
            .iter()
            .find(|(_, known)| *known == exponent)
            .map(|(prefix, _)| format!("{prefix}{unit}"))
    }

    /// Returns the power of ten of the unit of acceleration in m/s². Returns `None` for unknown
    /// names.
    pub(crate) fn of_acceleration(&self) -> Option<i32> {
        Some(power_of_ten(self.length(), &LENGTHS)? - 2 * power_of_ten(self.time(), &TIMES)?)
    }

    /// Returns true if the word is a known unit of length.
    pub(crate) fn is_length(word: &str) -> bool {
        power_of_ten(word, &LENGTHS).is_some() || OTHER_LENGTHS.contains(&word)
    }

    /// Returns a word that is the unit of another quantity: which unit it should be, the word, and
    /// the other quantity.
    pub(crate) fn misplaced(&self) -> Option<(&'static str, &str, &'static str)> {
        let of = |word: &str| {
            let known = |all: &[(&str, i32)], others: &[&str]| {
                power_of_ten(word, all).is_some() || others.contains(&word)
            };
            match () {
                () if known(&LENGTHS, &OTHER_LENGTHS) => Some("length"),
                () if known(&TIMES, &OTHER_TIMES) => Some("time"),
                () if known(&MASSES, &OTHER_MASSES) => Some("mass"),
                () if FORCES.contains(&word) => Some("force"),
                () => None,
            }
        };
        let all = [("length", self.length()), ("time", self.time()), ("mass", self.mass())];
        let wrong = |(what, word): (&'static str, _)| {
            Some((what, word, of(word).filter(|of| *of != what)?))
        };
        all.into_iter().find_map(wrong)
    }

    /// Returns true if the units are metre and second.
    pub(crate) fn is_default(&self) -> bool {
        *self == Units::default()
    }

    /// Returns which of length and time has no name, if one has none.
    pub(crate) fn missing(&self) -> Option<&'static str> {
        if self.length().is_empty() {
            Some("unit of length")
        } else if self.time().is_empty() {
            Some("unit of time")
        } else if self.mass().is_empty() {
            Some("unit of mass")
        } else {
            None
        }
    }

    /// Returns the unit of a coordinate (`order` 0) or of its derivatives, such as `mm/s^2`.
    pub(crate) fn text(&self, unit: Unit, order: usize) -> String {
        match unit {
            Unit::Metre => self.rate(self.length(), order),
            Unit::Radian => self.rate("rad", order),
            Unit::One => self.rate("-", order),
        }
    }

    /// Returns the unit of a derivative of a quantity in `unit`; without a unit (`-`) it is `1/s`.
    pub(crate) fn rate(&self, unit: &str, order: usize) -> String {
        let unit = match (unit, order) {
            (unit, 0) => return unit.to_string(),
            ("-" | "", _) => "1",
            (unit, _) => unit,
        };
        let power = if order == 1 { String::new() } else { format!("^{order}") };
        format!("{unit}/{}{power}", self.time())
    }

    /// Converts a unit in metres and seconds (`m`, `m/s`, `1/m`) to these names. Other words
    /// remain.
    pub(crate) fn in_own_words(&self, unit: &str) -> String {
        let word = |word: &str| match word {
            "m" => self.length().to_string(),
            "s" => self.time().to_string(),
            other => other.to_string(),
        };
        let mut text = String::new();
        let mut rest = unit;
        while let Some(first) = rest.chars().next() {
            let end = rest
                .find(|c: char| c.is_alphabetic() != first.is_alphabetic())
                .unwrap_or(rest.len());
            let (run, after) = rest.split_at(end);
            text += &word(run);
            rest = after;
        }
        text
    }
}

fn power_of_ten(word: &str, known: &[(&str, i32)]) -> Option<i32> {
    known.iter().find(|(unit, _)| *unit == word).map(|(_, power)| *power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_force_follow_from_those_of_mass_length_and_time() {
        let of = |mass: &str, length: &str, time: &str| {
            let units = Units::new(length, time).with_mass(mass);
            [units.force(), units.torque(), units.energy(), units.power()]
        };
        assert_eq!(of("kg", "m", "s"), ["N", "N m", "J", "W"]);
        assert_eq!(of("kg", "mm", "s"), ["mN", "mN mm", "µJ", "µW"]);
        assert_eq!(of("t", "mm", "s"), ["N", "N mm", "mJ", "mW"]);
        assert_eq!(of("g", "mm", "ms"), ["N", "N mm", "mJ", "W"]);
        assert_eq!(of("t", "m", "s"), ["kN", "kN m", "kJ", "kW"]);
        assert_eq!(of("lb", "in", "s"), ["lb in/s^2", "lb in^2/s^2", "lb in^2/s^2", "lb in^2/s^3"]);
        assert_eq!(of("kg", "m", "min")[0], "kg m/min^2");
    }

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
            ["m", "rad", "m/s^2", "1/m", "m^2", "-", "", "mol"]
                .map(|unit| units.in_own_words(unit)),
            ["mm", "rad", "mm/min^2", "1/mm", "mm^2", "-", "", "mol"]
        );
    }
}
