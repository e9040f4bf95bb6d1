//! A table of tolerances as text.

use std::fmt;

use super::super::feature::Feature;
use super::Tolerance;

/// Beyond this share the corners are told to differ from the stack.   \[-\]
const MISLED: f64 = 0.05;

/// Beyond this share of σ the second order is told.   \[-\]
const BENT: f64 = 0.02;

/// A number with so many digits, as short as it can be.
pub(super) fn digits(x: f64, count: usize) -> f64 {
    format!("{x:.count$e}").parse().unwrap_or(x)
}

/// The same, not below x.
fn above(x: f64, count: usize) -> f64 {
    let near = digits(x, count);
    // Half a unit of the last digit further it is rounded to the next number.
    if near >= x { near } else { digits(x * (1.0 + 0.5 * 0.1_f64.powi(count as i32)), count).max(near) }
}

impl fmt::Display for Tolerance {
    /// "slide (0.312 m at 0.418 s): ± 0.00041 worst case, ± 0.00027 RSS.", and a line for each dimension.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tolerance { name, unit, .. } = self;
        let when = match self.feature {
            Feature::Stroke(_) => String::new(),
            _ => format!(" at {} {}", digits(self.t, 4), self.units.time()),
        };
        let proved = self.proved.as_ref().map(|proved| proved.off(self.nominal));
        let proved = proved.map_or(String::new(), |off| format!(" (proved: {})", above(off, 2)));
        writeln!(
            f,
            "{name} ({} {unit}{when}): ± {} worst case{proved}, ± {} RSS.",
            digits(self.nominal, 4),
            digits(self.worst_case(), 2),
            digits(self.rss(), 2)
        )?;
        let longest = self.contributions.iter().map(|one| one.name.chars().count()).max().unwrap_or(0);
        for one in &self.contributions {
            let off = digits(one.off(), 2);
            writeln!(
                f,
                "  {:longest$}  {:3.0} %  {}{}   ± {} {}",
                one.name,
                100.0 * self.share(one),
                if off < 0.0 { "−" } else { "+" },
                off.abs(),
                one.tolerance,
                one.unit
            )?;
        }
        write!(f, "  Shares are of the worst case; signs are those of a larger dimension.")?;
        if let Some(second) = &self.second_order
            && (second.mean_shift.abs() > BENT * self.sigma() || second.sigma > (1.0 + BENT) * self.sigma())
        {
            write!(
                f,
                "\n  Second order: the mean is off by {}, σ is {} ({} to first order).",
                digits(second.mean_shift, 2),
                digits(second.sigma, 2),
                digits(self.sigma(), 2)
            )?;
        }
        if let Some(proved) = self.proved.as_ref().filter(|proved| !proved.trusted.is_empty()) {
            write!(f, "\n  Proved trusting the bounds of {}.", proved.trusted.join(", "))?;
        }
        match (self.corners, self.misled()) {
            ([Some(low), Some(high)], Some(misled)) if misled > MISLED => write!(
                f,
                "\n  At the worst corners it is off by {} and +{}: the stack misleads by {:.0} %.",
                digits(low - self.nominal, 2),
                digits(high - self.nominal, 2),
                100.0 * misled
            ),
            ([Some(_), Some(_)], _) => Ok(()),
            _ => {
                write!(f, "\n  At a corner that the stack calls the worst the mechanism cannot be assembled.")
            }
        }
    }
}
