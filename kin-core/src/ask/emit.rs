//! Prints a mechanism as a file of C: positions by the values of its drivers.

use kin_graph::Input;
use kin_graph::text::{C, Dialect, Kin, identifier};

use crate::ask::follower::Follower;
use crate::coordinates::units::Unit;
use crate::law::{Law, LawFunction};
use crate::outcome::error::{Error, Result};
use crate::outcome::named_value::NamedValue;
use crate::program::{
    Differences, Obstacle, Pose, Refusal, Sample, Sheet, Straight, Symbol, Tape, Whole, equations,
    file, program_of_cases, schedule, straight,
};
use crate::solve::compiled;
use crate::solve::newton::{Newton, first_position};
use crate::solve::options::SolverOptions;
use crate::system::{System, stop};

/// The tolerance of Newton's method in the file. \[-\]
const TOLERANCE: f64 = 1e-13;

/// The file accepts a position if no equation is off by more than this many times the tolerance of
/// its rows: positions after the last correction are exact within rounding.
const LEEWAY: f64 = 8.0;

/// The largest number of steps of a file.
const LONGEST: usize = 40_000;

/// The number of positions in the test of a file, and the way between two of them, in units of the
/// size of a driver.
const SAMPLES: usize = 3;
const WAY: f64 = 0.003;

/// Options of a printed file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The prefix of all names in the file. The default `None` means the name of the mechanism.
    pub name: Option<String>,
    /// The named dimensions that the file leaves free; the file contains the values of the others.
    pub free: Vec<String>,
    /// The coordinates that the file returns as measures, in this order.
    pub measures: Vec<String>,
    /// The time at which the mechanism is assembled: there the file starts. \[s\]
    pub t0: f64,
}

/// Returns a mechanism as one file of C99 that needs no library but `<math.h>` and no heap.
///
/// The functions of the file begin with the name of the mechanism, here `NAME`:
///
/// * `NAME_start(&s)` sets the state to the position assembled at the time t0;
/// * `NAME_to(&s, u)` finds the position at the values u of the drivers, near the last one. It
///   returns a code, and leaves the state, if the step is too long to be sure of the branch, or
///   leads to a singular position;
/// * `NAME_rates(&s, ud, udd, qd, qdd)` computes q̇ and q̈ for u̇ and ü;
/// * `NAME_at(&s, t)` and `NAME_rates_at(&s, t, qd, qdd)` do the same at a time, if the laws of all
///   drivers are formulas;
/// * `NAME_text(code)` says a code in words, and `NAME_selftest()` returns 0 if the compiled file
///   computes what Kin computes.
///
/// The drivers are those of [`System::follower`]. If an equation reads time in another way than by
/// a law of time alone, the only driver is the time. The units are those of the mechanism. The
/// comment at the beginning of the file lists drivers, coordinates, dimensions and equations.
///
/// ```
/// use kin::prelude::*;
///
/// let mut m = Mechanism::new("crank");
/// let crank = m.link("crank", 0.4)?;
/// m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
/// m.add("motor", drive_angle(crank, Law::ramp(2.0)))?;
/// let text = kin::emit::c(&m.build()?, &kin::emit::Options::default())?;
/// assert!(text.contains("int crank_to(crank_state *s, const double u[])"));
/// # Ok::<(), kin::Error>(())
/// ```
///
/// Errors: those of [`System::position`]; a dimension or measure that does not exist or is named
/// twice.
/// [`Error::CannotEmit`]: Kin does not know a law or an equation as a formula; equations are
/// redundant.
pub fn c(system: &System, options: &Options) -> Result<String> {
    check_names(system, options)?;
    let way = Way::new(system, options.t0)?;
    let driven = way.system(system);
    let drivers = way.drivers(system);
    let laws = way.laws();
    let solver = SolverOptions::default();
    let places = system.places(&options.free)?;
    let mut differences = Differences::new(&driven, &driven.varied(&places));
    differences.note(&driven.nudged(&options.free, &places));
    let refused = |refusal: Refusal| refusal_of(system, &refusal);
    compiled::can_be(&driven).map_err(refused)?;
    let mut newton = Newton::new(&driven, &solver);
    newton.q.copy_from_slice(way.q());
    first_position::resume(&mut newton, options.t0)?;
    let pose = Pose { t: options.t0, q: &newton.q, sizes: &newton.sizes };
    let program = program_of_cases(&driven, pose, false, differences.clone()).map_err(refused)?;
    let tape = schedule(program);
    check(system, &driven, &tape, laws)?;
    let slots = tape.slots();
    let mut free = Vec::new();
    for name in &options.free {
        let symbol = dimension(system, name);
        let field = unique(identifier(name), free.iter().map(|(_, field): &(_, String)| field));
        free.push((symbol, field));
    }
    let field = |name: &str| {
        let found = free.iter().find(|(symbol, _)| symbol.name == name);
        found.map(|(_, field)| format!("d->{field}"))
    };
    let own = |name: &str| options.free.iter().find(|known| *known == name).cloned();
    let expressions = parameters(&driven, slots, &C, &field)?;
    let names = parameters(&driven, slots, &Kin, &own)?;
    let named: Vec<(String, Law)> =
        drivers.iter().map(|own| own.name.clone()).zip(laws.iter().cloned()).collect();
    let formulas = equations(&driven, differences, &named, &names).map_err(refused)?;
    let sheet = Sheet {
        name: identifier(options.name.as_deref().unwrap_or(system.name())),
        title: system.name().to_string(),
        drivers,
        driver_laws: laws,
        coordinates: coordinates(system, &newton.q),
        folded: system
            .dimensions()
            .into_iter()
            .filter(|(name, _)| !options.free.contains(name))
            .map(|(name, _)| dimension(system, &name))
            .collect(),
        free,
        parameters: expressions,
        values: tape.case(&driven).map(|case| case.parameters).unwrap_or_default(),
        equations: driven.names_of_equations().iter().cloned().zip(formulas).collect(),
        sizes: newton.sizes.clone(),
        turns: system.layout().units.iter().map(|unit| *unit != Unit::Metre).collect(),
        allowed: allowed(&newton),
        tolerance: TOLERANCE,
        rounding: TOLERANCE * stop::rounding(TOLERANCE),
        pivot: newton.linear.smallest_pivot(),
        measures: measures(system, &options.measures)?,
        laws: way.of_time(system),
        samples: way.samples(system, &newton.sizes),
        tape: &tape,
    };
    Ok(file(&sheet))
}

/// The way in which a file gets its positions.
enum Way {
    /// By the values of these drivers; the laws stand for the values.
    Drivers(Box<Follower>, Vec<Law>),
    /// By the time, from this position at t0.
    Time { t0: f64, q: Vec<f64> },
}

impl Way {
    /// Returns the way by drivers, or by time if an equation reads time in another way than by a
    /// law of time alone.
    fn new(system: &System, t0: f64) -> Result<Self> {
        match system.follower(t0) {
            Ok(follower) if follower.frozen().is_empty() => {
                let law = |own: NamedValue| Law::new(DriverLaw(own.value));
                let laws = follower.drivers().into_iter().map(law).collect();
                Ok(Way::Drivers(Box::new(follower), laws))
            }
            Ok(_) | Err(Error::InvalidOptions { .. }) => {
                Ok(Way::Time { t0, q: system.position(t0)?.q })
            }
            Err(error) => Err(error),
        }
    }

    /// Returns the system with laws that stand for the values of drivers.
    fn system(&self, system: &System) -> System {
        match self {
            Way::Drivers(follower, laws) => follower.with_laws(laws),
            Way::Time { .. } => system.clone(),
        }
    }

    fn q(&self) -> &[f64] {
        match self {
            Way::Drivers(follower, _) => &follower.q,
            Way::Time { q, .. } => q,
        }
    }

    fn laws(&self) -> &[Law] {
        match self {
            Way::Drivers(_, laws) => laws,
            Way::Time { .. } => &[],
        }
    }

    fn drivers(&self, system: &System) -> Vec<Symbol> {
        match self {
            Way::Drivers(follower, _) => {
                let symbol = |own: NamedValue| Symbol {
                    name: own.name,
                    unit: own.unit.unwrap_or_else(|| "-".to_string()),
                    value: own.value,
                };
                follower.drivers().into_iter().map(symbol).collect()
            }
            Way::Time { t0, .. } => {
                let unit = system.unit_words().time().to_string();
                vec![Symbol { name: "t".to_string(), unit, value: *t0 }]
            }
        }
    }

    /// Returns the laws of the drivers and their derivatives as a tape of time, if all are formulas
    /// that do not depend on dimensions.
    fn of_time(&self, system: &System) -> Option<Straight> {
        let Way::Drivers(follower, _) = self else { return None };
        let mut whole = Whole::new(0);
        let t = whole.graph.input(Input::Time);
        let mut outputs = Vec::new();
        for law in follower.laws_of(system) {
            let law = law?;
            let mut hangs = false;
            law.each_hung(&mut |_, _| hangs = true);
            if hangs {
                return None;
            }
            for order in 0..3 {
                outputs.push(whole.law_at(law.clone(), t, order)?);
            }
        }
        whole.laws.is_empty().then(|| straight(whole.graph, Vec::new(), &outputs))
    }

    /// Returns positions along a short way from the start, as far as the library gets.
    fn samples(&self, system: &System, sizes: &[f64]) -> Vec<Sample> {
        let length = sizes.iter().copied().fold(f64::INFINITY, f64::min).min(1.0);
        let start = self.drivers(system);
        let mut follower = match self {
            Way::Drivers(follower, _) => Some(follower.clone()),
            Way::Time { .. } => None,
        };
        let mut q = self.q().to_vec();
        let mut samples = Vec::new();
        for number in 1..=SAMPLES {
            let step = |k: usize| WAY * length * (number as f64 + 0.3 * (k as f64).sin());
            let u: Vec<f64> = (0..start.len()).map(|k| start[k].value + step(k)).collect();
            let rate = |k: usize| [1.0 + 0.1 * k as f64, 0.5 - 0.2 * k as f64];
            let rates: Vec<[f64; 2]> = (0..u.len()).map(rate).collect();
            let found = match &mut follower {
                Some(follower) => moved(follower, &start, &u, &rates),
                None => at_time(system, u[0], &q, rates[0]),
            };
            let Some([next, qd, qdd]) = found else { break };
            q.clone_from(&next);
            let ud = rates.iter().map(|rate| rate[0]).collect();
            let udd = rates.iter().map(|rate| rate[1]).collect();
            samples.push(Sample { u, ud, udd, q: next, qd, qdd });
        }
        samples
    }
}

/// Moves a follower, and returns q, q̇ and q̈ there for these velocities and accelerations.
fn moved(
    follower: &mut Follower,
    drivers: &[Symbol],
    u: &[f64],
    rates: &[[f64; 2]],
) -> Option<[Vec<f64>; 3]> {
    let names = || drivers.iter().map(|own| own.name.clone());
    follower.to(names().zip(u.iter().copied())).ok()?;
    let found = follower.rates(names().zip(rates.iter().copied())).ok()?;
    Some([follower.q.clone(), found.qd, found.qdd])
}

/// Returns q, q̇ and q̈ at a time near the pose `q`, where the clock goes with these rates.
fn at_time(system: &System, t: f64, q: &[f64], [ud, udd]: [f64; 2]) -> Option<[Vec<f64>; 3]> {
    let found = system.solver().solve_at(t, q).ok()?;
    let qdd = found.qd.iter().zip(&found.qdd).map(|(qd, qdd)| ud * ud * qdd + udd * qd).collect();
    Some([found.q, found.qd.iter().map(|qd| ud * qd).collect(), qdd])
}

/// A driver whose value the printed file reads as an input.
struct DriverLaw(f64);

impl LawFunction for DriverLaw {
    fn jet(&self, _: f64) -> [f64; 4] {
        [self.0, 0.0, 0.0, 0.0]
    }

    fn kind(&self) -> &str {
        "driver"
    }
}

/// Returns an error if a free dimension does not exist, or if a name appears twice.
fn check_names(system: &System, options: &Options) -> Result<()> {
    let lists = [("free dimensions", &options.free), ("measures", &options.measures)];
    for (what, names) in lists {
        let again = (1..names.len()).find(|k| names[..*k].contains(&names[*k]));
        if let Some(k) = again {
            let reason = format!("the {what} name `{}` twice. Remove one of the two", names[k]);
            return Err(Error::InvalidOptions { reason });
        }
    }
    let known: Vec<String> = system.dimensions().into_iter().map(|(name, _)| name).collect();
    match options.free.iter().find(|name| !known.contains(name)) {
        Some(name) => Err(Error::UnknownName { what: "dimension", name: name.clone(), known }),
        None => Ok(()),
    }
}

/// Builds the error for a part of a mechanism that cannot be printed.
fn cannot(what: &str, reason: &str) -> Error {
    Error::CannotEmit { what: what.to_string(), reason: reason.to_string() }
}

/// Builds the error for a mechanism without a program.
fn refusal_of(system: &System, refusal: &Refusal) -> Error {
    let Refusal { constraint, reason } = refusal;
    let cure = match *reason {
        Obstacle::Redundant => ". Remove the redundant equations that a diagnosis names",
        _ => "",
    };
    let what = match constraint.as_str() {
        "" => format!("\"{}\"", system.name()),
        name => format!("`{name}`"),
    };
    cannot(&what, &format!("{reason}{cure}"))
}

/// Returns an error if the tape contains a law that is no formula, or is too long.
fn check(system: &System, driven: &System, tape: &Tape, drivers: &[Law]) -> Result<()> {
    let [steps, _] = tape.size();
    if steps > LONGEST {
        let reason = format!(
            "the file would have {steps} lines of arithmetic, and compilers need minutes from {LONGEST} on. Print parts of the mechanism"
        );
        return Err(cannot(&format!("\"{}\"", system.name()), &reason));
    }
    let Some(law) = tape.law_without_text(drivers) else { return Ok(()) };
    let start = driven.equations().instant_at(0.0, driven.initial());
    for block in &driven.equations().blocks {
        let mut found = None;
        block.constraint.laws(&driven.equations().at(block, &start), &mut |name, own, _| {
            if own.is(law) {
                found = Some(name.to_string());
            }
        });
        if let Some(name) = found {
            let reason = format!(
                "Kin does not know the law `{name}` ({}) as a formula or as a table. Use a law of the library that is one, such as a polynomial or a cubic spline",
                law.kind()
            );
            return Err(cannot(&format!("`{}`", block.name), &reason));
        }
    }
    let reason = "a value is known to the program only. Write it as a formula";
    Err(cannot(&format!("\"{}\"", system.name()), reason))
}

/// Returns a name that is not among the known ones.
fn unique<'a>(name: String, known: impl Iterator<Item = &'a String> + Clone) -> String {
    let mut own = name.clone();
    let mut number = 2;
    while known.clone().any(|other| *other == own) {
        own = format!("{name}_{number}");
        number += 1;
    }
    own
}

fn dimension(system: &System, name: &str) -> Symbol {
    let value = system.parameter(name).unwrap_or(f64::NAN);
    Symbol { name: name.to_string(), unit: system.unit_of_dimension(name), value }
}

fn coordinates(system: &System, q: &[f64]) -> Vec<Symbol> {
    let units = system.layout().unit_words();
    let all = system.coordinate_names().iter().zip(units).zip(q);
    all.map(|((name, unit), value)| Symbol { name: name.clone(), unit, value: *value }).collect()
}

/// Returns the text of each free parameter as an expression of the free dimensions; `named` gives
/// their texts.
fn parameters(
    system: &System,
    slots: &[(usize, usize)],
    dialect: &dyn Dialect,
    named: &dyn Fn(&str) -> Option<String>,
) -> Result<Vec<String>> {
    let text = |(block, index): &(usize, usize)| {
        system.parameter_text(*block, *index, dialect, named).ok_or_else(|| {
            let name = &system.equations().blocks[*block].name;
            cannot(
                &format!("`{name}`"),
                "one of its numbers, such as a part of an axis, is no expression of the free dimensions. Leave other dimensions free",
            )
        })
    };
    slots.iter().map(text).collect()
}

/// Returns the columns of the requested measures.
fn measures(system: &System, names: &[String]) -> Result<Vec<(String, usize)>> {
    let known = system.coordinate_names();
    let column = |name: &String| {
        let found = known.iter().position(|known| known == name);
        match found {
            Some(column) => Ok((name.clone(), column)),
            None if system.is_measure(name) => Err(cannot(
                &format!("`{name}`"),
                "Kin knows no formula of the measure. Name a coordinate, such as `rocker.theta`",
            )),
            None => Err(system.no_measure(name)),
        }
    };
    names.iter().map(column).collect()
}

/// Returns how far each equation may be off: its share of the tolerance, and the rounding of
/// coordinates that are up to their size away from the start.
fn allowed(newton: &Newton<'_>) -> Vec<f64> {
    let entries = newton.system.equations().entries.iter().zip(newton.linear.values());
    let entries =
        entries.filter_map(|(entry, value)| entry.map(|(row, column)| (row, column, *value)));
    let far: Vec<f64> =
        newton.q.iter().zip(&newton.sizes).map(|(q, size)| q.abs() + size).collect();
    let mut allowed = Vec::new();
    let tolerance = LEEWAY * TOLERANCE;
    stop::allowances(tolerance, newton.linear.norms(), entries, &far, &mut allowed);
    allowed
}
