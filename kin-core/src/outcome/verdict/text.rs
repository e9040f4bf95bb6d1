//! Writes the report for people.

use std::collections::HashSet;
use std::fmt::{Display, Formatter, Result};

use super::advice::{In, cause};
use super::change::Change;
use super::dependency::{Class, Dependency, Level, Term};
use super::diagnosis::Diagnosis;
use super::elsewhere::Elsewhere;
use super::freedom::{BodyMotion, Freedom, How, Persistence, Play};
use super::gap::{Asks, Gap};
use super::gap_line::GapLine;
use super::repeats;
use crate::outcome::words::{capital, count, different, joined, list, number, of_coordinate, time};

/// The largest number of dependencies and of freedoms in a report.
pub(super) const SHOWN: usize = 6;

impl Display for Diagnosis {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let can = if self.can_be_driven() { "can be driven" } else { "cannot be driven" };
        let n = count(self.coordinates, "coordinate");
        let m = count(self.equations, "equation");
        write!(
            f,
            "the mechanism \"{}\" {can} at t = {} {}: {n}, {m}, rank {}",
            self.mechanism,
            time(self.t),
            self.units.time(),
            self.rank
        )?;
        match self.nearby_rank {
            rank if rank > self.rank => write!(f, " here and {rank} at nearby poses.")?,
            _ if self.dependencies.is_empty() && self.freedoms.is_empty() => write!(f, ".")?,
            _ if self.moves => write!(f, " here and at nearby poses.{}", self.of_rank())?,
            _ => write!(f, "; the mechanism cannot move to other poses.")?,
        }
        write!(f, "{}", self.details())
    }
}

/// All lines except the first.
struct Details<'a>(&'a Diagnosis);

impl Display for Details<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        self.0.write_details(f)
    }
}

impl Diagnosis {
    /// Writes what the rank means: " So 1 degree of freedom has no driver."
    fn of_rank(&self) -> String {
        let free = match self.coordinates.saturating_sub(self.rank) {
            0 => None,
            1 => Some("1 degree of freedom has no driver".to_string()),
            many => Some(format!("{many} degrees of freedom have no driver")),
        };
        let dependent = match self.equations.saturating_sub(self.rank) {
            0 => None,
            1 => Some("1 equation depends on other equations".to_string()),
            many => Some(format!("{many} equations depend on other equations")),
        };
        let both: Vec<String> = free.into_iter().chain(dependent).collect();
        if both.is_empty() { String::new() } else { format!(" So {}.", joined(&both, "and")) }
    }

    /// Returns the report without its first line; each line begins on a new one.
    pub(crate) fn details(&self) -> impl Display {
        Details(self)
    }

    fn write_details(&self, f: &mut Formatter<'_>) -> Result {
        if self.count_misleads() && self.gaps.is_empty() {
            f.write_str(
                "\n  The numbers of equations and coordinates agree only by chance: a redundant equation hides a missing equation.",
            )?;
        }
        if self.gaps.is_empty() {
            self.special(f)?;
        }
        let reported =
            |change: &&Change| !(self.gaps.is_empty() && matches!(change, Change::Resize { .. }));
        let causes: Vec<String> = self
            .changes
            .iter()
            .filter(reported)
            .filter_map(|change| cause(change, self.units.length()))
            .collect();
        lines(f, &causes, "cause", "causes")?;
        self.gaps.iter().try_for_each(|gap| write!(f, "\n  {}", GapLine(gap, self)))?;
        if self.is_cured() {
            return self.advice(f);
        }
        // The line of a gap includes its conflict of positions and the other equations of the
        // constraint.
        let open = |found: &Dependency| {
            found
                .terms
                .first()
                .is_some_and(|own| self.gaps.iter().any(|gap| gap.rows.contains(&own.row)))
        };
        let reported = |found: &Dependency| {
            open(found)
                || matches!(found.class, Class::Contradictory { level: Level::Position, .. })
        };
        let dependencies: Vec<&Dependency> =
            self.dependencies.iter().filter(|found| !reported(found)).collect();
        lines(f, &repeats::gathered(&dependencies), "dependency", "dependencies")?;
        // If there is a gap, only lasting freedoms are real. The others exist because the gap is
        // smallest there.
        let joined = self.joined();
        let joins = |freedom: &Freedom| {
            let mut names = freedom.motions.iter().flat_map(|motion| &motion.names);
            names.all(|name| joined.contains(name.as_str()))
        };
        let real = |freedom: &&Freedom| {
            (self.gaps.is_empty() || freedom.persistence == Persistence::Always) && !joins(freedom)
        };
        let unit = self.units.length();
        let reported = |freedom| WithUnit { reported: freedom, unit };
        let freedoms: Vec<_> = self.freedoms.iter().filter(real).map(reported).collect();
        lines(f, &freedoms, "freedom", "freedoms")?;
        self.advice(f)
    }

    /// Says that the pose is special, and names a pose that is not: another time, value or
    /// dimension.
    fn special(&self, f: &mut Formatter<'_>) -> Result {
        if self.rank < self.nearby_rank {
            f.write_str("\n  This pose is a toggle or change point.")?;
        }
        let stiff = || {
            self.freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Infinitesimal)
        };
        let mut names: Vec<String> = Vec::new();
        for name in stiff().flat_map(|freedom| &freedom.motions).flat_map(|motion| &motion.names) {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        if names.is_empty() {
            return Ok(());
        }
        let verb = if names.len() == 1 { "yields" } else { "yield" };
        let all = list(&names);
        write!(
            f,
            "\n  The structure is rigid but shaky: {all} {verb} slightly, as bars in line do, and then no further."
        )?;
        let plays = stiff().filter_map(|freedom| freedom.play.as_ref());
        plays
            .reduce(|a, b| if b.moves > a.moves { b } else { a })
            .map_or(Ok(()), |play| self.play(f, play))
    }

    /// Says which pose is not singular: one at another time, with another value or dimension.
    fn instead(&self, f: &mut Formatter<'_>) -> Result {
        if self.rank >= self.nearby_rank || !self.gaps.is_empty() {
            return Ok(());
        }
        match &self.elsewhere {
            Some(Elsewhere::Time(at)) => {
                let units = self.units.time();
                write!(f, "\n  Begin at t = {} {units}, or leave out this time.", time(*at))
            }
            Some(Elsewhere::Drive { constraint, asks }) => {
                let Asks { coordinate, asked, stands, .. } = asks;
                let [_, stands] = different(*asked, *stands);
                let stands = asks.with_unit(&stands);
                write!(
                    f,
                    "\n  Let `{constraint}` begin at another value, such as {coordinate} = {stands}{}.",
                    of_coordinate(coordinate, self.units.length())
                )
            }
            None => f.write_str("\n  Begin at another pose, or leave out this time."),
        }
    }

    /// Writes ": a play of 0.0001 m in the joints lets `b` move by 0.0071 m and turn by 0.0301 rad,
    /// …".
    fn play(&self, f: &mut Formatter<'_>, Play { body, play, moves, turns }: &Play) -> Result {
        let length = self.units.length();
        write!(f, "\n  A play of {play} {length} in every joint lets `{body}` ")?;
        match (*moves > 1e-3 * play, *turns > 0.0) {
            (true, true) => {
                write!(f, "move by {} {length} and turn by {} rad", number(*moves), number(*turns))?
            }
            (_, true) => write!(f, "turn by {} rad", number(*turns))?,
            _ => write!(f, "move by {} {length}", number(*moves))?,
        }
        f.write_str(". A quarter of this play allows half of this motion.")
    }

    /// Returns true if Kin has tested a change with which everything closes and moves. Its cause
    /// explains all other faults at this pose.
    fn is_cured(&self) -> bool {
        self.equations >= self.coordinates
            && self.changes.iter().any(|change| {
                cause(change, "").is_some()
                    && !matches!(change, Change::Join { .. } | Change::Pin { .. })
            })
    }

    /// Returns the bodies with no or one constraint that a change already names.
    fn joined(&self) -> HashSet<&str> {
        let mut all = HashSet::new();
        for change in &self.changes {
            match change {
                Change::Join { body } => all.extend([body.as_str()]),
                Change::Pin { bodies, .. } => all.extend(bodies.iter().map(String::as_str)),
                _ => {}
            }
        }
        all
    }

    /// Returns the unit of the gap that a change closes; empty if the gap is no length.
    fn unit_of_gap(&self, change: &Change) -> &str {
        let Change::Fit { constraint, .. } = change else { return "" };
        let is_own = |gap: &&Gap| gap.constraint == *constraint && gap.is_between_points();
        self.gaps.iter().find(is_own).map_or("", |_| self.units.length())
    }

    fn advice(&self, f: &mut Formatter<'_>) -> Result {
        self.instead(f)?;
        if self.changes.is_empty() {
            return Ok(());
        }
        let unit = self.units.length();
        // Another change, for users who do not want to allow a contradiction.
        let is_other = |k: usize| k > 0 && matches!(self.changes[k - 1], Change::Allow { .. });
        let sentence = |(k, change): (usize, &Change)| {
            let text = In { change, unit, gap: self.unit_of_gap(change) }.to_string();
            let text = if is_other(k) {
                format!("if you do not allow the contradiction, {text}")
            } else {
                text
            };
            capital(&text) + "."
        };
        let shown: Vec<String> =
            self.changes.iter().take(SHOWN).enumerate().map(sentence).collect();
        write!(f, "\n  {}", shown.join(" "))?;
        match self.changes.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            1 => f.write_str(" 1 more change is necessary."),
            more => write!(f, " {more} more changes are necessary."),
        }
    }
}

fn lines(f: &mut Formatter<'_>, all: &[impl Display], one: &str, many: &str) -> Result {
    all.iter().take(SHOWN).try_for_each(|line| write!(f, "\n  {line}"))?;
    if all.len() > SHOWN {
        write!(f, "\n ")?;
    }
    more(f, all.len(), one, many)
}

fn more(f: &mut Formatter<'_>, all: usize, one: &str, many: &str) -> Result {
    match all.saturating_sub(SHOWN) {
        0 => Ok(()),
        1 => write!(f, " and 1 more {one}"),
        rest => write!(f, " and {rest} more {many}"),
    }
}

impl Display for Dependency {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Some((own, others)) = self.terms.split_first() else { return Ok(()) };
        let name = &own.equation;
        match self.class {
            Class::Redundant => {
                write!(f, "`{name}` is redundant but consistent: `{name}`{}.", Sum(others))
            }
            Class::OnlyHere => {
                write!(
                    f,
                    "`{name}` depends on other equations at this pose only: `{name}`{}.",
                    Sum(others)
                )
            }
            Class::Contradictory { level, residual } => {
                let what = match level {
                    Level::Position => "contradict one another",
                    Level::Velocity => "require different velocities",
                    Level::Acceleration => "require different accelerations",
                };
                let names: Vec<String> =
                    self.constraints().iter().map(ToString::to_string).collect();
                let off = number(residual.abs());
                let per = match level {
                    Level::Position => "",
                    Level::Velocity => " per unit of time",
                    Level::Acceleration => " per unit of time squared",
                };
                write!(
                    f,
                    "{} {what}: the relation `{name}`{} is violated by {off} (in the unit of `{name}`{per}).",
                    list(&names),
                    Sum(others)
                )
            }
        }
    }
}

/// Writes " = 1.00 × `a` − 0.50 × `b`".
struct Sum<'a>(&'a [Term]);

impl Display for Sum<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Sum(terms) = self;
        if terms.is_empty() {
            return f.write_str(" does not change with any coordinate");
        }
        for (k, term) in terms.iter().take(SHOWN).enumerate() {
            let coefficient = -term.coefficient;
            let sign = match (k, coefficient < 0.0) {
                (0, false) => " = ",
                (0, true) => " = −",
                (_, false) => " + ",
                (_, true) => " − ",
            };
            write!(f, "{sign}{} × `{}`", number(coefficient.abs()), term.equation)?;
        }
        match terms.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            rest => write!(f, " + {}", count(rest, "more term")),
        }
    }
}

/// A freedom or a motion whose points have a unit of length; none where it is empty.
struct WithUnit<'a, T> {
    reported: &'a T,
    unit: &'a str,
}

impl Display for Freedom {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        WithUnit { reported: self, unit: "" }.fmt(f)
    }
}

impl Display for WithUnit<'_, Freedom> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let WithUnit { reported, unit } = *self;
        let one = |motion| WithUnit { reported: motion, unit }.to_string();
        let mut shown: Vec<String> = reported.motions.iter().take(SHOWN).map(one).collect();
        match reported.motions.len().saturating_sub(SHOWN) {
            0 => {}
            1 => shown.push("1 more body moves".to_string()),
            rest => shown.push(format!("{rest} more bodies move")),
        }
        let what = joined(&shown, "and");
        match reported.persistence {
            Persistence::Always => write!(f, "Nothing drives this freedom: {what}")?,
            Persistence::OnlyHere => write!(f, "At this pose only, this motion is free: {what}")?,
            Persistence::Infinitesimal => {
                write!(f, "To first order only, this motion is free: {what}")?
            }
        }
        let is_global = |motion: &BodyMotion| !matches!(motion.how, How::Changes { .. });
        let is_any_global = reported.motions.iter().take(SHOWN).any(is_global);
        f.write_str(if is_any_global { " (in global coordinates)." } else { "." })
    }
}

impl Display for BodyMotion {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        WithUnit { reported: self, unit: "" }.fmt(f)
    }
}

impl Display for WithUnit<'_, BodyMotion> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let several = self.reported.names.len() > 1;
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        write!(f, "{} ", list(&self.reported.names))?;
        let verb = |one: &str| {
            if several { one.trim_end_matches('s').to_string() } else { one.to_string() }
        };
        match self.reported.how {
            How::TurnsAbout { point: [x, y], .. } => {
                write!(f, "{} about ({}, {}){unit}", verb("turns"), number(x), number(y))
            }
            How::Slides { along: [x, y], .. } => {
                write!(f, "{} along ({}, {})", verb("slides"), number(x), number(y))
            }
            How::SlidesInSpace { along, .. } => {
                write!(f, "{} along {}", verb("slides"), Vector(along))
            }
            How::Screws { point, axis, pitch: 0.0, .. } => {
                write!(
                    f,
                    "{} about the axis through {}{unit} along {}",
                    verb("turns"),
                    Vector(point),
                    Vector(axis)
                )
            }
            How::Screws { point, axis, pitch, .. } => {
                let pitch = number(pitch);
                write!(
                    f,
                    "{} about the axis through {}{unit} along {}, by {pitch}{unit} per radian",
                    verb("screws"),
                    Vector(point),
                    Vector(axis)
                )
            }
            How::Changes { .. } => write!(f, "{}", verb("changes")),
        }
    }
}

struct Vector([f64; 3]);

impl Display for Vector {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let largest = self.0.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let [x, y, z] = self.0.map(|x| number(if x.abs() < 1e-6 * largest { 0.0 } else { x }));
        write!(f, "({x}, {y}, {z})")
    }
}
