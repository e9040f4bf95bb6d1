//! Describes forces that grow without bound near a singular position.

use std::fmt;

use crate::coordinates::units::Units;
use crate::outcome::words;

/// The growth of the force or torque of a constraint near a singular position
/// ([`crate::forces::Forces::growth`]).
///
/// The force grows like a negative power of |t − t*|.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Growth {
    /// The name of the constraint. If the constraint is a driver, its effort grows.
    pub constraint: String,
    /// The time t* of the singular position.   \[s\]
    pub t: f64,
    /// The exponent of |t − t*|, such as −½. \[-\]
    pub power: f64,
    /// Names of the units of length and time.
    pub units: Units,
}

/// Forces have no bound at the requested time, which is a singular position.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "forces have no bound at the singular position at t* = {}: near t* the forces grow like {}. Leave this time out, or drive another body",
    words::at(*.t, .units), listed(.growth)
)]
#[non_exhaustive]
pub struct Unbounded {
    /// The time t* of the singular position.   \[s\]
    pub t: f64,
    /// The constraints whose forces grow, with their exponents.
    pub growth: Vec<Growth>,
    /// Names of the units of length and time.
    pub units: Units,
}

/// Denominators of the exponents that Kin prints as fractions.
const DENOMINATORS: [i32; 5] = [1, 2, 3, 4, 6];

impl Growth {
    /// Returns the exponent as a fraction: `−1/2`.
    fn fraction(&self) -> String {
        let size = self.power.abs();
        let parts = |below: &i32| (f64::from(*below) * size, *below);
        let whole =
            DENOMINATORS.iter().map(parts).find(|(above, _)| (above - above.round()).abs() < 1e-9);
        let sign = if self.power < 0.0 { "−" } else { "" };
        match whole {
            Some((above, 1)) => format!("{sign}{above:.0}"),
            Some((above, below)) => format!("{sign}{above:.0}/{below}"),
            None => format!("{sign}{size:.2}"),
        }
    }
}

impl fmt::Display for Growth {
    /// "the forces of `A` grow without bound towards t* = 0.5 s, like |t − t*|^(−1/2)"
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let constraint = &self.constraint;
        let at = words::at(self.t, &self.units);
        write!(
            f,
            "the forces of `{constraint}` grow without bound towards t* = {at}, like |t − t*|^({})",
            self.fraction()
        )
    }
}

/// Lists the constraints by common exponents, the steepest first.
fn listed(growth: &[Growth]) -> String {
    let mut powers: Vec<&Growth> = Vec::new();
    for one in growth {
        if powers.iter().all(|known| known.power != one.power) {
            powers.push(one);
        }
    }
    powers.sort_by(|a, b| a.power.total_cmp(&b.power));
    let names = |power: f64| -> Vec<String> {
        growth.iter().filter(|one| one.power == power).map(|one| one.constraint.clone()).collect()
    };
    let told = |one: &&Growth| {
        format!("|t − t*|^({}) at {}", one.fraction(), words::list(&names(one.power)))
    };
    words::joined(&powers.iter().map(told).collect::<Vec<_>>(), "and")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn growth(constraint: &str, power: f64) -> Growth {
        Growth { constraint: constraint.to_string(), t: 0.25, power, units: Units::default() }
    }

    #[test]
    fn powers_are_told_as_fractions() {
        let told = |power: f64| growth("A", power).fraction();
        assert_eq!(
            [-2.0, -0.5, -1.5, -1.0 / 3.0, -0.3177].map(told),
            ["−2", "−1/2", "−3/2", "−1/3", "−0.32"]
        );
    }

    #[test]
    fn constraints_with_one_power_are_told_together() {
        let all = [growth("A", -0.5), growth("motor", -2.0), growth("B", -0.5)];
        assert_eq!(listed(&all), "|t − t*|^(−2) at `motor` and |t − t*|^(−1/2) at `A` and `B`");
        assert_eq!(
            all[0].to_string(),
            "the forces of `A` grow without bound towards t* = 0.25 s, like |t − t*|^(−1/2)"
        );
    }
}
