//! Finds numbers that look like angles in degrees, where Kin expects radians.
//!
//! Kin reports an angle that is a multiple of 15 between 15 and 3600. Such numbers are common
//! angles in degrees. In radians these numbers are 2.4 revolutions or more, and users write large
//! angles as multiples of π. Kin reports an angular velocity that is a multiple of 45 between 45
//! and 36 000 but not a multiple of 50, or any multiple of 360. Angular velocities of 10, 50, 100,
//! 150, 300 or 314.16 rad/s are common, so Kin does not report them. Kin cannot know the intention
//! of the user, so each warning is a question.

use std::cell::OnceCell;
use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use super::laws::{self, Role};
use crate::coordinates::Target;
use crate::coordinates::layout::Place;
use crate::coordinates::units::Unit;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::outcome::error::surface::Surface;
use crate::outcome::motion::warning::MOST;
use crate::outcome::motion::{Warning, WarningKind};
use crate::system::System;
use crate::system::evaluate::Instant;

/// Numbers that differ by this share of them are the same.   \[-\]
const SAME: f64 = 1e-6;

/// Instants at which the effect of a law's number is looked for: at most of them a law has
/// some.   \[s\]
const INSTANTS: [f64; 4] = [0.7361, 0.0173, 5.291, 97.13];

/// Numbers of one law that are tried for their effect, and slopes that can be used: others are lost
/// in rounding.
const TRIED: usize = 4;
const SLOPES: RangeInclusive<f64> = 1e-3..=1e6;

/// True of a number that is an angle in degrees as a rule.
fn looks_like_an_angle(x: f64) -> bool {
    (15.0..=3600.0).contains(&x.abs()) && x % 15.0 == 0.0
}

/// True of a guess or a preferred value that is in degrees as a rule: nobody draws a whole number
/// of radians beyond two turns.
fn looks_like_a_drawn_angle(x: f64) -> bool {
    (15.0..=3600.0).contains(&x.abs()) && x.fract() == 0.0
}

/// True of a number that is a speed in degrees a time as a rule.
fn looks_like_a_speed(x: f64) -> bool {
    let is_multiple = |of: f64| x % of == 0.0;
    (45.0..=36_000.0).contains(&x.abs())
        && (is_multiple(360.0) || is_multiple(45.0) && !is_multiple(50.0))
}

/// The warnings about all numbers of a system: guesses and preferred values, limits, numbers of
/// constraints, laws. At most [`MOST`].
pub(super) fn warnings(system: &System) -> Vec<Warning> {
    let mut found = Vec::new();
    guesses(system, &mut found);
    limits(system, &mut found);
    let search = Search::new(system);
    for block in 0..system.equations().blocks.len() {
        if found.len() >= MOST {
            break;
        }
        let asked = search.block(block);
        asked.laws(&mut found);
        asked.parameters(&mut found);
    }
    found.truncate(MOST);
    found
}

/// Guesses of angles; what is preferred is the guess too.
fn guesses(system: &System, found: &mut Vec<Warning>) {
    let layout = system.layout();
    let angles = layout.units.iter().zip(system.initial()).enumerate();
    let odd =
        angles.filter(|(_, (unit, x))| **unit == Unit::Radian && looks_like_a_drawn_angle(**x));
    for (column, (_, x)) in odd.take(MOST) {
        let name = layout.names[column].as_str();
        let preferred = system.preferred().iter().any(|(known, _)| *known == column);
        let what = if preferred { "preferred value" } else { "guess" };
        let text = format!("The {what} of `{name}` is {}. {}", amount(*x), did_you_mean(*x));
        found.push(Warning::new(WarningKind::Degrees, &[name], text));
    }
    for asked in system.asked.iter().filter(|asked| asked.is_angle) {
        let name = measure_name(system, asked.block, asked.number);
        if looks_like_a_drawn_angle(asked.value) {
            let x = asked.value;
            let text =
                format!("The preferred value of `{name}` is {}. {}", amount(x), did_you_mean(x));
            found.push(Warning::new(WarningKind::Degrees, &[&name], text));
        }
    }
}

fn measure_name(system: &System, block: usize, number: usize) -> String {
    let block = &system.equations().blocks[block];
    let measure = block.constraint.facts().measures.get(number).map_or("", |measure| measure.name);
    format!("{}.{measure}", block.name)
}

/// Limits of angles.
fn limits(system: &System, found: &mut Vec<Warning>) {
    let layout = system.layout();
    let is_angle = |name: &str| match layout.names.iter().position(|known| known == name) {
        Some(column) => layout.units[column] == Unit::Radian,
        None => system.place_of(name).is_some_and(|place| place.measured.unit == "rad"),
    };
    for limit in &system.limits {
        let [from, to] = limit.ends;
        let odd = [from, to].into_iter().find(|end| looks_like_an_angle(*end));
        let (Some(end), true) = (odd, is_angle(&limit.name)) else { continue };
        let name = &limit.name;
        let text = format!("A limit of `{name}` is {}. {}", amount(end), did_you_mean(end));
        found.push(Warning::new(WarningKind::Degrees, &[name], text));
    }
}

/// "90 rad (14 turns)"
fn amount(x: f64) -> String {
    format!("{x} rad ({})", turns(x))
}

/// "14 turns", "2.4 turns"
fn turns(x: f64) -> String {
    let turns = x.abs() / TAU;
    if turns < 10.0 { format!("{turns:.1} turns") } else { format!("{turns:.0} turns") }
}

fn did_you_mean(x: f64) -> String {
    format!("Angles are in radians; if degrees are meant, give {}.", Surface::chosen().angle(x))
}

/// The constraints of a system at a pose like no other, for the effect of their numbers.
pub(super) struct Search<'a> {
    system: &'a System,
    /// The system at each of [`INSTANTS`], made when it is first needed.
    instants: [OnceCell<Instant>; 4],
}

impl<'a> Search<'a> {
    pub(super) fn new(system: &'a System) -> Self {
        Search { system, instants: [const { OnceCell::new() }; 4] }
    }

    /// One of its constraints.
    pub(super) fn block(&self, block: usize) -> Asked<'_> {
        Asked { search: self, system: self.system, block }
    }

    fn instant(&self, k: usize) -> &Instant {
        // At a guess angles are zero as a rule: numbers that multiply them would show no effect.
        let offset = |k: usize| 0.377 + 0.211 * ((k as f64) * 0.618_033_988_749_894_9).fract();
        self.instants[k].get_or_init(|| {
            let guess = self.system.initial().iter().enumerate();
            let q: Vec<f64> = guess.map(|(k, q)| q + offset(k)).collect();
            self.system.equations().instant_at(INSTANTS[k], &q)
        })
    }
}

/// One constraint whose numbers are looked at.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    search: &'a Search<'a>,
    system: &'a System,
    block: usize,
}

/// A number of a law.
struct Number {
    name: String,
    role: Role,
    value: f64,
    /// Kind of the innermost law that has it, where that is all of the law.
    alone: Option<String>,
}

impl Asked<'_> {
    fn name(&self) -> &str {
        &self.system.equations().blocks[self.block].name
    }

    fn constraint(&self) -> &dyn Constraint {
        self.system.equations().blocks[self.block].constraint.as_ref()
    }

    /// Each law with its name and its argument at one of [`INSTANTS`].
    fn each_law(&self, k: usize, visit: &mut dyn FnMut(&str, &Law, f64)) {
        let equations = self.system.equations();
        let block = &equations.blocks[self.block];
        self.constraint().laws(&equations.at(block, self.search.instant(k)), visit);
    }

    /// The warnings about its laws, one for each law.
    fn laws(&self, found: &mut Vec<Warning>) {
        let mut odd: Vec<(String, Law, f64, Vec<Number>)> = Vec::new();
        self.each_law(0, &mut |name, law, x| {
            let numbers = odd_numbers(law);
            if !numbers.is_empty() {
                odd.push((name.to_string(), law.clone(), x, numbers));
            }
        });
        for (name, law, x, numbers) in odd {
            let is_time = x == INSTANTS[0];
            let mut is_angle = None;
            let mut fits = |number: &Number| match number.role {
                Role::Phase => true,
                Role::Frequency => is_time,
                Role::Rate if !is_time => false,
                _ => *is_angle.get_or_insert_with(|| self.law_is_angle(&name, &law)),
            };
            if let Some(number) = numbers.iter().find(|number| fits(number)) {
                found.push(self.of_law(&name, number));
            }
        }
    }

    /// The warning about a number of a law.
    fn of_law(&self, law: &str, number: &Number) -> Warning {
        let driver = self.name();
        let bodies = self.bodies();
        let surface = Surface::chosen();
        let x = number.value;
        let path = format!("`{driver}.{law}.{}`", number.name);
        let constructor = number.alone.as_deref();
        let written =
            constructor.and_then(|kind| surface.law(kind, &surface.number(x))).map(|is| (true, is));
        let (alone, is) = written.unwrap_or_else(|| (false, format!("{path} is {x}")));
        let cause = if alone { format!("the law of the driver is {is}") } else { is };
        let time = self.system.unit_words().time();
        let does = match (number.role, &bodies[..]) {
            (Role::Rate, [body]) => {
                format!("`{driver}` turns `{body}` at {x} rad/{time} ({}/{time})", turns(x))
            }
            (Role::Rate, _) => {
                format!("`{driver}` turns at {x} rad/{time} ({}/{time})", turns(x))
            }
            (Role::Frequency, _) => {
                let periods = turns(x).replace("turns", "periods");
                format!("`{driver}` follows a sine of {x} rad/{time} ({periods}/{time})")
            }
            (Role::Phase, _) => format!("`{driver}` follows a sine of phase {}", amount(x)),
            (Role::Value, _) => format!("The law of `{driver}` has an angle of {}", amount(x)),
        };
        let angle = surface.angle(x);
        let bare = angle.trim_matches('`');
        let meant = match constructor.filter(|_| alone) {
            Some(kind) => surface.law(kind, bare).unwrap_or_else(|| angle.clone()),
            None => angle.clone(),
        };
        let text =
            format!("{does}: {cause}. Angles are in radians; if degrees are meant, give {meant}.");
        let names: Vec<&str> =
            std::iter::once(driver).chain(bodies.iter().map(String::as_str)).collect();
        Warning::new(WarningKind::Degrees, &names, text)
    }

    /// The warning about the first of its plain numbers that is an angle, or is added to one.
    fn parameters(&self, found: &mut Vec<Warning>) {
        let mut odd: Vec<(String, f64)> = Vec::new();
        self.constraint().parameters(&mut |name, value| {
            if looks_like_an_angle(value) && !name.contains(['.', '[']) {
                odd.push((name.to_string(), value));
            }
        });
        if odd.is_empty() {
            return;
        }
        let is_angle = |(name, value): &&(String, f64)| self.acts_as_angle(name, *value, 1.0, 0);
        if let Some((name, x)) = odd.iter().find(is_angle) {
            let name = format!("{}.{name}", self.name());
            let text = format!("`{name}` is {}. {}", amount(*x), did_you_mean(*x));
            found.push(Warning::new(WarningKind::Degrees, &[self.name(), &name], text));
        }
    }

    /// Names of the bodies and coordinates that it holds or drives.
    fn bodies(&self) -> Vec<String> {
        let layout = self.system.layout();
        let arguments = self.constraint().arguments();
        let named = arguments.iter().filter_map(|argument| {
            let Some(Place::Own { item, first }) = layout.place(&argument.target) else {
                return None;
            };
            Some(match argument.target {
                Target::Coord(..) => layout.names[first].clone(),
                _ => layout.items[item].name.clone(),
            })
        });
        named.collect()
    }

    /// True if the value of a law is an angle in this constraint. A number of the law shows it, if
    /// the value changes in proportion to that number.
    pub(super) fn law_is_angle(&self, name: &str, law: &Law) -> bool {
        let mut numbers = Vec::new();
        laws::each(law, &mut |number, role, value, _| {
            if matches!(role, Role::Value | Role::Rate) {
                numbers.push((number.to_string(), value));
            }
        });
        law.parameters(&mut |number, value| {
            if number == "factor" {
                numbers.push((number.to_string(), value));
            }
        });
        for k in 0..INSTANTS.len() {
            let mut x = f64::NAN;
            self.each_law(k, &mut |known, _, argument| {
                if known == name {
                    x = argument;
                }
            });
            for (number, value) in numbers.iter().take(TRIED) {
                let change = |by: f64| {
                    let mut moved = law.clone();
                    moved.set_parameter(number, value + by).then(|| moved.at(x) - law.at(x))
                };
                let Some(slope) = change(1.0).filter(|slope| SLOPES.contains(&slope.abs())) else {
                    continue;
                };
                let turns = change(4.0 * PI / slope).unwrap_or(f64::NAN);
                if (turns - 4.0 * PI).abs() <= SAME {
                    let path = format!("{name}.{number}");
                    return self.acts_as_angle(&path, *value, slope, k);
                }
            }
        }
        false
    }

    /// True if a number of the constraint is an angle, or makes one change by `slope` for each
    /// unit: C has the period 2π or 4π in that angle, or the angle is added to others in a row of
    /// angles alone.
    fn acts_as_angle(&self, name: &str, value: f64, slope: f64, instant: usize) -> bool {
        let instant = self.search.instant(instant);
        let c = |angle: f64| self.residual(name, value + angle / slope, instant);
        let (Some(c), Some(by_one), Some(by_turns)) = (c(0.0), c(1.0), c(4.0 * PI)) else {
            return false;
        };
        let change = |k: usize| by_one[k] - c[k];
        let near = |k: usize| (by_turns[k] - c[k]).abs() <= SAME * (1.0 + c[k].abs());
        if (0..c.len()).all(near) && (0..c.len()).any(|k| change(k).abs() > SAME) {
            return true;
        }
        (0..c.len()).any(|k| self.is_added_to_angle(k, change(k).abs(), instant))
    }

    /// C of the constraint alone with another value of that number; `None` where that makes no
    /// sense.
    fn residual(&self, name: &str, value: f64, instant: &Instant) -> Option<Vec<f64>> {
        let equations = self.system.equations();
        let block = &equations.blocks[self.block];
        let mut other = block.constraint.clone_boxed();
        if !other.set_parameter(name, value) {
            return None;
        }
        let mut c = vec![0.0; block.rows().len()];
        other.residual(&equations.at(block, instant).with_timed(&[]), &mut c);
        c.iter().all(|x| x.is_finite()).then_some(c)
    }

    /// True of a row in which all that changes are angles, one of which changes it as much as this
    /// number does.
    fn is_added_to_angle(&self, row: usize, change: f64, instant: &Instant) -> bool {
        let equations = self.system.equations();
        let block = &equations.blocks[self.block];
        let facts = block.constraint.facts();
        let mut values = vec![0.0; facts.pattern.len()];
        block.constraint.jacobian(&equations.at(block, instant).with_timed(&[]), &mut values);
        let global = equations.entries.get(block.values()).unwrap_or_default();
        let entries = facts.pattern.iter().zip(global).zip(values);
        let own = entries.filter(|((entry, _), value)| entry.row == row && *value != 0.0);
        let mut is_added = false;
        for ((_, global), value) in own {
            let Some((_, column)) = *global else { continue };
            if self.system.layout().units[column] != Unit::Radian {
                return false;
            }
            is_added |= (value.abs() - change).abs() <= SAME * change;
        }
        is_added && change > SAME
    }
}

/// The numbers of a law that look like degrees.
fn odd_numbers(law: &Law) -> Vec<Number> {
    let mut numbers = Vec::new();
    laws::each(law, &mut |name, role, value, inner| {
        let is_odd = match role {
            Role::Value | Role::Phase => looks_like_an_angle(value),
            Role::Rate | Role::Frequency => looks_like_a_speed(value),
        };
        if is_odd {
            let alone = matches!(inner.kind(), "ramp" | "constant") && inner.is(law);
            let alone = alone.then(|| inner.kind().to_string());
            numbers.push(Number { name: name.to_string(), role, value, alone });
        }
    });
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both sides of the rule: what is reported, and what is usual in radians.
    #[test]
    fn round_numbers_of_degrees_are_told_from_radians() {
        for x in [15.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 180.0, 270.0, 360.0, 720.0, 3600.0] {
            assert!(looks_like_an_angle(x) && looks_like_an_angle(-x), "{x}");
        }
        for x in [0.0, 1.0, 2.0, 6.0, 10.0, 20.0, 50.0, PI, 15.0 * PI, 14.9, 1e9, f64::INFINITY] {
            assert!(!looks_like_an_angle(x) && !looks_like_an_angle(-x), "{x}");
        }
        for x in [15.0, 20.0, 37.0, 100.0, 360.0] {
            assert!(looks_like_a_drawn_angle(x) && looks_like_a_drawn_angle(-x), "{x}");
        }
        for x in [0.0, 1.0, 12.0, 15.5, 5.0 * TAU, 98.6, 1e9, f64::NAN] {
            assert!(!looks_like_a_drawn_angle(x), "{x}");
        }
        for x in [45.0, 90.0, 135.0, 180.0, 270.0, 360.0, 720.0, 1800.0, 3600.0, 36_000.0] {
            assert!(looks_like_a_speed(x) && looks_like_a_speed(-x), "{x}");
        }
        for x in [0.0, 1.0, 10.0, 15.0, 30.0, 50.0, 60.0, 100.0, 120.0, 150.0, 300.0, 314.16] {
            assert!(!looks_like_a_speed(x) && !looks_like_a_speed(-x), "{x}");
        }
        for x in [450.0, 500.0, 900.0, 1000.0, 100.0 * PI, TAU, 1e6, f64::NAN] {
            assert!(!looks_like_a_speed(x), "{x}");
        }
    }
}
