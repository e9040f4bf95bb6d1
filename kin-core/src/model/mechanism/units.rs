//! Declares the names of units, and checks that they do not contradict other numbers.

use super::{Mechanism, Refused};
use crate::coordinates::units::Units;
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};

/// The names of the units from [`Mechanism::units`], to which [`UnitWords::mass`] adds the unit of
/// mass.
pub struct UnitWords<'a> {
    mechanism: &'a mut Mechanism,
}

impl UnitWords<'_> {
    /// Names the unit of mass.
    ///
    /// Kin derives the units of force, torque, energy and power from the units of length, time and
    /// mass.
    pub fn mass(self, mass: &str) {
        let units = self.mechanism.layout.words.with_mass(mass);
        let again = std::mem::replace(&mut self.mechanism.declared[1], true);
        self.mechanism.set_units(units, again);
    }
}

/// Acceleration of the earth's gravity (ISO 80000-3).   \[m/s²\]
const EARTH: f64 = 9.80665;

/// Numbers within this share of the constant count as the earth's gravity. \[-\]
const ABOUT: f64 = 0.01;

impl Mechanism {
    /// Names the units of length and time in files, pages and messages: `m.units("mm", "s")`. The
    /// default is `m`, `s` and `kg`.
    ///
    /// For another unit of mass, write `m.units("mm", "s").mass("t")`. Kin does not convert
    /// numbers: write all numbers in the named units.
    ///
    /// [`Mechanism::build`] returns an error in these cases: a name is empty or names another
    /// quantity; a later call gives other names; the gravity is the earth's gravity in other units;
    /// a dimension has another unit of length.
    pub fn units(&mut self, length: &str, time: &str) -> UnitWords<'_> {
        let units = Units::new(length, time).with_mass(self.layout.words.mass());
        let again = std::mem::replace(&mut self.declared[0], true);
        self.set_units(units, again);
        UnitWords { mechanism: self }
    }

    /// Stores the words, which a call may have declared before.
    fn set_units(&mut self, units: Units, again: bool) {
        let before = again.then(|| self.layout.words.clone());
        match refusal(before.as_ref(), &units) {
            Ok(()) => self.layout.words = units,
            Err(_) => self.refuse(Refused::Units { before, units }),
        }
    }

    /// Returns an error if gravity or a dimension is in other units than the declared ones. Without
    /// declared units nothing can contradict them.
    pub(super) fn check_units(&self) -> Result<()> {
        let units = &self.layout.words;
        refusal(None, units)?;
        if !self.declared[0] {
            return Ok(());
        }
        self.check_gravity(units)?;
        let Some(dimensions) = &self.dimensions else { return Ok(()) };
        let contradicts = |unit: &str| Units::is_length(unit) && unit != units.length();
        let store = dimensions.store();
        match store
            .entries
            .iter()
            .find(|entry| Units::is_length(units.length()) && contradicts(&entry.unit))
        {
            Some(entry) => Err(refused(
                &entry.name,
                "dimension",
                format!(
                    "the dimension is in {}, but the mechanism has lengths in {}. Kin converts no units, so give the dimension in {1}",
                    entry.unit,
                    units.length()
                ),
            )),
            None => Ok(()),
        }
    }

    /// Checks the earth's gravity, whose value depends on the units.
    fn check_gravity(&self, units: &Units) -> Result<()> {
        let size = self.loads.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let Some(exponent) = units.of_acceleration() else { return Ok(()) };
        let own = EARTH * 10.0_f64.powi(-exponent);
        let is = |number: f64| (size / number - 1.0).abs() < ABOUT;
        // The earth's gravity in metres, centimetres and millimetres.
        if is(own) || ![EARTH, 1e2 * EARTH, 1e3 * EARTH].into_iter().any(is) {
            return Ok(());
        }
        let unit = format!("{}/{}^2", units.length(), units.time());
        let reason = format!(
            "{size} {unit} is the earth's gravity in other units. In {unit} the earth's gravity is {}. Give gravity in the units of the mechanism, or declare the units by {}",
            format!("{own:.6e}").parse().unwrap_or(own),
            Surface::chosen().units()
        );
        Err(refused("gravity", "acceleration", reason))
    }
}

/// Returns the error of words, which a call may have declared before.
pub(super) fn refusal(before: Option<&Units>, units: &Units) -> Result<()> {
    if let Some(what) = units.missing() {
        return Err(Error::EmptyName { what });
    }
    if let Some((what, word, of)) = units.misplaced() {
        let reason = format!(
            "`{word}` is a unit of {of}, but your code gives it as the unit of {what}. {} takes length, time and mass in this order",
            Surface::chosen().units()
        );
        return Err(refused("units", "words", reason));
    }
    let Some(before) = before.filter(|before| *before != units) else { return Ok(()) };
    let told = |units: &Units| format!("{}, {} and {}", units.length(), units.time(), units.mass());
    let reason = format!(
        "your code declares the units {}, and later the units {}. Kin converts no units, so declare the units once",
        told(before),
        told(units)
    );
    Err(refused("units", "words", reason))
}

fn refused(name: &str, kind: &str, reason: String) -> Error {
    Error::InvalidParameters { constraint: name.to_string(), kind: kind.to_string(), reason }
}
