//! The report for people.

use std::fmt::{Display, Formatter, Result};

use super::advice::cause;
use super::change::Change;
use super::dependency::{Class, Dependency, Level, Term};
use super::diagnosis::Diagnosis;
use super::elsewhere::Elsewhere;
use super::freedom::{BodyMotion, Freedom, How, Persistence};
use super::gap::{Against, Asks, Gap};
use super::repeats;
use crate::model::words::{count, list, time};

/// Dependencies and freedoms that are written out.
pub(super) const SHOWN: usize = 6;

impl Display for Diagnosis {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let can = if self.can_be_driven() { "can be driven" } else { "cannot be driven" };
        let (n, m) = (count(self.coordinates, "coordinate"), count(self.equations, "equation"));
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
            _ if self.moves => write!(f, " here and at nearby poses.")?,
            _ => write!(f, "; it cannot move to other poses.")?,
        }
        write!(f, "{}", self.details())
    }
}

/// All but the first line.
struct Details<'a>(&'a Diagnosis);

impl Display for Details<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        self.0.write_details(f)
    }
}

impl Diagnosis {
    /// The report without its first line, each line on a new one.
    pub(crate) fn details(&self) -> impl Display {
        Details(self)
    }

    fn write_details(&self, f: &mut Formatter<'_>) -> Result {
        if self.count_misleads() && self.gaps.is_empty() {
            write!(f, "\n  The count is right by chance: what is superfluous hides what is missing.")?;
        }
        if self.gaps.is_empty() {
            self.special(f)?;
        }
        let told = |change: &&Change| !(self.gaps.is_empty() && matches!(change, Change::Resize { .. }));
        self.changes.iter().filter(told).filter_map(cause).try_for_each(|cause| write!(f, "\n  {cause}"))?;
        self.gaps.iter().try_for_each(|gap| write!(f, "\n  {}", GapLine(gap, self)))?;
        if self.is_cured() {
            return self.advice(f);
        }
        // A conflict of positions is told with its gap, and so are other equations of the same constraint.
        let open = |found: &Dependency| {
            found.terms.first().is_some_and(|own| self.gaps.iter().any(|gap| gap.rows.contains(&own.row)))
        };
        let told = |found: &Dependency| {
            open(found) || matches!(found.class, Class::Contradictory { level: Level::Position, .. })
        };
        let dependencies: Vec<&Dependency> = self.dependencies.iter().filter(|found| !told(found)).collect();
        lines(f, &repeats::gathered(&dependencies), "dependency", "dependencies")?;
        // Beside a gap only lasting freedoms are real: the others are there because the gap is the smallest.
        let real = |freedom: &&Freedom| {
            (self.gaps.is_empty() || freedom.persistence == Persistence::Always) && !self.joins(freedom)
        };
        lines(f, &self.freedoms.iter().filter(real).collect::<Vec<_>>(), "freedom", "freedoms")?;
        self.advice(f)
    }

    /// Says that the pose is a special one, and which pose is not: one at another time, with another value or
    /// dimension.
    fn special(&self, f: &mut Formatter<'_>) -> Result {
        if self.rank < self.nearby_rank {
            match &self.elsewhere {
                Some(Elsewhere::Time(at)) => {
                    let units = self.units.time();
                    write!(
                        f,
                        "\n  A toggle or change point: begin at t = {} {units}, or step over this time.",
                        time(*at)
                    )?;
                }
                Some(Elsewhere::Drive { constraint, asks: Asks { coordinate, stands, .. } }) => {
                    write!(
                        f,
                        "\n  A toggle or change point: let `{constraint}` begin at another value, such as {coordinate} = {stands:.3}."
                    )?;
                }
                None => write!(f, "\n  A toggle or change point: begin, or step, elsewhere.")?,
            }
        }
        let stiff = self.freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Infinitesimal);
        let names: Vec<String> =
            stiff.flat_map(|freedom| &freedom.motions).flat_map(|motion| motion.names.clone()).collect();
        if !names.is_empty() {
            let (give, move_on) = if names.len() == 1 { ("gives", "moves") } else { ("give", "move") };
            write!(
                f,
                "\n  special position: {} {give} a little, as bars in line do, and {move_on} no further.",
                list(&names)
            )?;
        }
        Ok(())
    }

    /// True if a change has been tried with which everything closes and moves: its cause then explains all
    /// other faults at this pose.
    fn is_cured(&self) -> bool {
        self.equations >= self.coordinates
            && self.changes.iter().any(|change| {
                cause(change).is_some() && !matches!(change, Change::Join { .. } | Change::Pin { .. })
            })
    }

    /// True if the freedom is that of a body that no constraint holds, which a change already tells.
    fn joins(&self, freedom: &Freedom) -> bool {
        let names = freedom.motions.iter().flat_map(|motion| &motion.names);
        let joined = |name: &String| {
            self.changes.iter().any(|change| match change {
                Change::Join { body } => body == name,
                Change::Pin { bodies, .. } => bodies.contains(name),
                _ => false,
            })
        };
        names.into_iter().all(joined)
    }

    fn advice(&self, f: &mut Formatter<'_>) -> Result {
        if self.changes.is_empty() {
            return Ok(());
        }
        let shown: Vec<String> = self.changes.iter().take(SHOWN).map(ToString::to_string).collect();
        write!(f, "\n  Least change: {}", shown.join("; "))?;
        more(f, self.changes.len(), "change", "changes")?;
        f.write_str(".")
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

/// A gap, with the constraints it is in conflict with.
struct GapLine<'a>(&'a Gap, &'a Diagnosis);

impl Display for GapLine<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let GapLine(gap, diagnosis) = self;
        let sets = diagnosis
            .dependencies
            .iter()
            .filter(|found| found.terms.iter().any(|term| gap.rows.contains(&term.row)));
        let mut others: Vec<String> = Vec::new();
        for name in sets.flat_map(|found| found.constraints()).filter(|name| *name != gap.constraint) {
            if !others.iter().any(|known| known == name) {
                others.push(name.to_string());
            }
        }
        let with = match others.is_empty() {
            true => "with all others met".to_string(),
            false => format!("with {}", self.named(&others)),
        };
        let (name, what) = (&gap.constraint, if gap.lasting { "contradictory" } else { "out of reach" });
        match &gap.asks {
            Some(asks) => {
                let (coordinate, [asked, stands]) = (&asks.coordinate, different(asks.asked, asks.stands));
                let turn = if asks.is_more_than_a_turn() { ", more than a turn from its guess" } else { "" };
                write!(
                    f,
                    "{what}: `{name}` asks for {coordinate} = {asked}{turn}; {with} it stands at {stands}."
                )
            }
            None => write!(
                f,
                "{what}: `{name}` cannot be met; {with} it is off by {} at the least.",
                number(gap.size())
            ),
        }?;
        match gap.starts {
            0 | 1 => Ok(()),
            starts => write!(f, " (The nearest of {starts} starts.)"),
        }
    }
}

impl GapLine<'_> {
    /// "`motor` (crank.theta = 1.0000), `O`, `A`": drivers first, with what they ask for.
    fn named(&self, names: &[String]) -> String {
        let asks = |name: &String| self.0.against.iter().find(|against| against.constraint == *name);
        let drivers = names.iter().filter_map(asks).map(|Against { constraint, asks }| match asks {
            Some(asks) => {
                let turn = if asks.is_more_than_a_turn() { ", more than a turn from its guess" } else { "" };
                format!("`{constraint}` ({} = {:.4}{turn})", asks.coordinate, asks.asked)
            }
            None => format!("`{constraint}`"),
        });
        let drivers: Vec<String> = drivers.collect();
        let others: Vec<String> = names.iter().filter(|name| asks(name).is_none()).cloned().collect();
        let others = if others.is_empty() { None } else { Some(list(&others)) };
        drivers.into_iter().chain(others).collect::<Vec<_>>().join(", ")
    }
}

impl Display for Dependency {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Some((own, others)) = self.terms.split_first() else { return Ok(()) };
        let name = &own.equation;
        match self.class {
            Class::Redundant => write!(f, "redundant but consistent: `{name}`{}.", Sum(others)),
            Class::OnlyHere => write!(f, "dependent only here: `{name}`{}.", Sum(others)),
            Class::Contradictory { level, residual } => {
                let what = match level {
                    Level::Position => "cannot be met together",
                    Level::Velocity => "ask for different velocities",
                    Level::Acceleration => "ask for different accelerations",
                };
                let names: Vec<String> = self.constraints().iter().map(ToString::to_string).collect();
                let off = number(residual.abs());
                write!(
                    f,
                    "contradictory: {} {what}: `{name}`{}, and they are off by {off}.",
                    list(&names),
                    Sum(others)
                )
            }
        }
    }
}

/// " = 1.00 × `a` − 0.50 × `b`"
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

impl Display for Freedom {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let shown: Vec<String> = self.motions.iter().take(SHOWN).map(ToString::to_string).collect();
        let what = shown.join(", ");
        match self.persistence {
            Persistence::Always => write!(f, "freedom left: {what}")?,
            Persistence::OnlyHere => write!(f, "free only here: {what}")?,
            Persistence::Infinitesimal => write!(f, "gives a little, to first order only: {what}")?,
        }
        more(f, self.motions.len(), "body", "bodies")?;
        f.write_str(if self.persistence == Persistence::Always { "; nothing drives it." } else { "." })
    }
}

impl Display for BodyMotion {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let several = self.names.len() > 1;
        write!(f, "{} ", list(&self.names))?;
        let verb = |one: &str| if several { one.trim_end_matches('s').to_string() } else { one.to_string() };
        match self.how {
            How::TurnsAbout { point: [x, y], .. } => {
                write!(f, "{} about ({}, {})", verb("turns"), number(x), number(y))
            }
            How::Slides { along: [x, y], .. } => {
                write!(f, "{} along ({}, {})", verb("slides"), number(x), number(y))
            }
            How::SlidesInSpace { along, .. } => write!(f, "{} along {}", verb("slides"), Vector(along)),
            How::Screws { point, axis, pitch: 0.0, .. } => {
                write!(f, "{} about the axis through {} along {}", verb("turns"), Vector(point), Vector(axis))
            }
            How::Screws { point, axis, pitch, .. } => {
                let pitch = number(pitch);
                write!(
                    f,
                    "{} about the axis through {} along {}, {pitch} a radian",
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

/// Three decimals, or three digits of what is smaller; as a power of ten where it is far from 1.
pub(super) fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0.000".to_string(),
        size if (0.1..1e4).contains(&size) => format!("{x:.3}"),
        size if size < 1e-12 => "0.000".to_string(),
        size if (1e-4..0.1).contains(&size) => {
            format!("{x:.decimals$}", decimals = (2.0 - size.log10().floor()) as usize)
        }
        _ => format!("{x:.2e}"),
    }
}

/// Two numbers with as many decimals as tell them apart, four at least.
fn different(a: f64, b: f64) -> [String; 2] {
    let with = |decimals: usize| [format!("{a:.decimals$}"), format!("{b:.decimals$}")];
    (4..12).map(with).find(|[a, b]| a != b).unwrap_or_else(|| with(12))
}
