//! Writes a table of tolerances as text.

use std::fmt;

use super::super::feature::Feature;
use super::{Off, Searched, Tolerance};
use crate::outcome::words::joined;

/// If the corners differ from the stack by more than this share, the text says so. \[-\]
const MISLED: f64 = 0.05;

/// If the difference is larger than this share of the stack, the slopes vanish. \[-\]
const VANISHING: f64 = 10.0;

/// The largest number of dimensions of a place in the text.
const NAMED: usize = 6;

/// If the second order exceeds this share of σ, the text contains it. \[-\]
const BENT: f64 = 0.02;

/// Rounds a number to so many digits.
pub(super) fn digits(x: f64, count: usize) -> f64 {
    format!("{x:.count$e}").parse().unwrap_or(x)
}

/// Rounds a number up to so many digits.
fn above(x: f64, count: usize) -> f64 {
    let near = digits(x, count);
    // Half a unit of the last digit further, it is rounded to the next number.
    if near >= x {
        near
    } else {
        digits(x * (1.0 + 0.5 * 0.1_f64.powi(count as i32)), count).max(near)
    }
}

impl fmt::Display for Tolerance {
    /// Writes "slide (0.312 m at 0.418 s): ± 0.00041 worst case, ± 0.00027 RSS.", and a line for
    /// each dimension.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tolerance { name, unit, .. } = self;
        let when = match self.feature {
            Feature::Stroke(_) => String::new(),
            _ => format!(" at {} {}", digits(self.t, 4), self.units.time()),
        };
        write!(f, "{name} ({} {unit}{when}): ", digits(self.nominal, 4))?;
        self.headline(f)?;
        writeln!(f, " ± {} RSS.", digits(self.rss(), 2))?;
        let longest =
            self.contributions.iter().map(|one| one.name.chars().count()).max().unwrap_or(0);
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
        write!(
            f,
            "  The percentages are fractions of the worst case. The signs are for an increase of the dimension."
        )?;
        if let Some(second) = &self.second_order
            && (second.mean_shift.abs() > BENT * self.sigma()
                || second.sigma > (1.0 + BENT) * self.sigma())
        {
            write!(
                f,
                "\n  Second order: the mean shifts by {}, σ is {} ({} to first order).",
                digits(second.mean_shift, 2),
                digits(second.sigma, 2),
                digits(self.sigma(), 2)
            )?;
        }
        if let Some(proved) = self.proved.as_ref().filter(|proved| !proved.trusted.is_empty()) {
            write!(f, "\n  The proof relies on the bounds of {}.", joined(&proved.trusted, "and"))?;
        }
        self.beyond_the_stack(f)?;
        self.looked(f)
    }
}

impl Tolerance {
    /// Writes "± 0.00041 worst case,". If the stack is misleading, it writes both sides of the
    /// deviation; if a part of the box cannot be assembled, it writes none.
    fn headline(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.searched.unassembled {
            return write!(
                f,
                "no worst case, because the mechanism cannot be assembled where {};",
                self.place(place)
            );
        }
        let stack = digits(self.worst_case(), 2);
        match self.corners {
            [Some(low), Some(high)] if self.is_misled() => {
                let [low, high] = [low, high].map(|value| digits(value - self.nominal, 2));
                write!(f, "{low} to +{high} worst case (linear stack ± {stack}")?;
            }
            _ => write!(f, "± {stack} worst case")?,
        }
        let proved = self.proved.as_ref().map(|proved| above(proved.off(self.nominal), 2));
        match (proved, self.is_misled()) {
            (Some(off), true) => write!(f, "; proved: {off}),"),
            (None, true) => write!(f, "),"),
            (Some(off), false) => write!(f, " (proved: {off}),"),
            (None, false) => write!(f, ","),
        }
    }

    /// Returns true if the measure deviates more than the stack says, by more than rounding.
    fn is_misled(&self) -> bool {
        let rounding = 16.0 * f64::EPSILON * self.nominal.abs();
        self.attained().is_some_and(|off| off > (1.0 + MISLED) * self.worst_case() + rounding)
    }

    /// Writes "`a` is off by 0.01 m and `b` is off by -0.02 m".
    fn place(&self, place: &[Off]) -> String {
        let unit = |name: &str| {
            let own = self.contributions.iter().find(|one| one.name == name);
            own.map_or(String::new(), |one| format!(" {}", one.unit))
        };
        let told = |off: &Off| {
            format!("`{}` is off by {}{}", off.name, digits(off.by, 4), unit(&off.name))
        };
        let mut all: Vec<String> = place.iter().take(NAMED).map(told).collect();
        if place.len() > NAMED {
            all.push(format!(
                "{} more dimensions are off by their tolerances",
                place.len() - NAMED
            ));
        }
        joined(&all, "and")
    }

    fn beyond_the_stack(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([Some(low), Some(high)], true) = (self.corners, self.is_misled()) else {
            return Ok(());
        };
        let [low, high] = [low, high].map(|value| digits(value - self.nominal, 2));
        write!(f, "\n  At the worst places the deviation is {low} and +{high}: ")?;
        match self.misled().filter(|misled| *misled < VANISHING) {
            Some(misled) => {
                write!(f, "the larger deviation is {:.0} % above the linear stack.", 100.0 * misled)
            }
            None => write!(
                f,
                "the slopes are zero at the nominal dimensions, so the linear stack has no meaning."
            ),
        }
    }

    /// Writes "Looked at all 8 corners of the box of tolerances and 3 places inside."
    fn looked(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Searched { corners, all_corners, inside, unassembled, .. } = &self.searched;
        let of = self.contributions.len();
        match (all_corners, unassembled) {
            (true, _) => {
                write!(f, "\n  Kin checked all {corners} corners of the box of tolerances")?
            }
            (false, Some(_)) => return write!(f, "\n  Kin checked no further places."),
            (false, None) => {
                write!(f, "\n  Kin checked {corners} corners of the box of {of} tolerances")?
            }
        }
        write!(f, " and {inside} places inside")?;
        match all_corners {
            true => write!(f, "."),
            false => write!(f, ". Corners that Kin did not check may be worse."),
        }
    }
}
