//! `kin sweep`: many cases of one mechanism, a row each.
//!
//! Each case is run by itself, as `kin run` with its numbers set does it, so that its row does not
//! depend on other cases, on threads or on the requested part of the whole.

use std::sync::OnceLock;

use kin::results::Warning;
use kin::{SolverOptions, System};
use rayon::prelude::*;

use crate::arguments::Sweep;
use crate::fault::Fault;
use crate::model;
use crate::output::{self, digits};
use crate::points::Setting;
use crate::say::{Say, Written};

/// Cases that are run before their rows are written.
const BLOCK: usize = 256;

/// The cases of a file: names, and for each case the numbers as they are written and as they are
/// read.
struct Cases {
    names: Vec<String>,
    rows: Vec<Vec<(String, f64)>>,
}

/// Runs all cases, or a part of them, and writes a row each as they are done. A case that fails is
/// a row that says why.
pub fn sweep(asked: &Sweep, say: &Say) -> Result<(), Fault> {
    if asked.model.file == "-" && asked.cases == "-" {
        return Err(Fault::Usage(
            "mechanism and cases cannot both come from standard input".to_string(),
        ));
    }
    let system = model::system(&asked.model)?;
    let Cases { names, rows } = cases(&asked.cases)?;
    let keep: Vec<String> =
        if asked.keep.is_empty() { system.coordinate_names().to_vec() } else { asked.keep.clone() };
    let times = &asked.motion.times.0;
    let options = model::options(&asked.motion, false);
    known(&system, &names, &keep, times.first())?;
    let range = asked.shard.map_or(0..rows.len(), |shard| shard.cases(rows.len()));
    let job = Job {
        system: &system,
        names: &names,
        keep: &keep,
        times,
        options: &options,
        first: range.start,
        warnings: OnceLock::new(),
    };
    let mut table = csv::Writer::from_writer(output::open(&asked.out)?);
    let failed = |error: csv::Error| output::failed(&asked.out, &output::reason(error));
    table.write_record(job.header().iter().map(|name| output::as_text(name))).map_err(failed)?;
    let all = range.len();
    let mut done = 0;
    let mut warnings = None;
    say.progress(done, all, "cases");
    for block in range.collect::<Vec<usize>>().chunks(BLOCK) {
        let run = |k: &usize| job.row(*k, &rows[*k]);
        let written: Vec<Vec<String>> = block.par_iter().map(run).collect();
        written.iter().try_for_each(|row| table.write_record(row)).map_err(failed)?;
        table.flush().map_err(|error| output::failed(&asked.out, &error))?;
        if let (None, Some(found)) = (warnings, job.warnings.get()) {
            say.each_warning(found, Written::Nowhere, &format!("case {}: ", job.first));
            warnings = Some(found);
        }
        done += block.len();
        say.progress(done, all, "cases");
    }
    Ok(())
}

/// The cases of a file. Errors: no table, a number that is none, by its line.
fn cases(file: &str) -> Result<Cases, Fault> {
    let text = model::text(file)?;
    let fail = |why: String| Fault::File(format!("{}: {why}", model::named(file)));
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|error| fail(error.to_string()))?;
    let names: Vec<String> =
        headers.iter().map(|header| output::of_text(header).to_string()).collect();
    if names.iter().all(String::is_empty) {
        return Err(fail("its first line names no parameter".to_string()));
    }
    if names.iter().any(|name| name.contains(';')) {
        return Err(fail(SEMICOLONS.to_string()));
    }
    if names.iter().all(|name| crate::times::number(name).is_ok()) {
        return Err(fail(format!(
            "its first line has numbers, {}, but no names. Name the parameter of each column in the first line",
            names.join(",")
        )));
    }
    if let Some(name) =
        names.iter().enumerate().find_map(|(k, name)| names[..k].contains(name).then_some(name))
    {
        return Err(fail(format!("its first line names `{name}` twice")));
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| fail(unread(&error)))?;
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().any(|text| text.contains(';')) {
            return Err(fail(format!("line {line}: {SEMICOLONS}")));
        }
        let number = |(name, text): (&String, &str)| {
            let parsed = crate::times::number(text);
            parsed
                .map(|x| (text.to_string(), x))
                .map_err(|why| fail(format!("line {line}: `{name}`: {why}")))
        };
        rows.push(names.iter().zip(&record).map(number).collect::<Result<_, _>>()?);
    }
    if rows.is_empty() {
        return Err(fail(
            "it has a first line of names, but no case. Write a line of numbers for each case"
                .to_string(),
        ));
    }
    Ok(Cases { names, rows })
}

/// The reason for a table of a spreadsheet with decimal commas.
const SEMICOLONS: &str = "columns are separated by semicolons. Separate them by commas, and write decimal points, as in 0.5,1.25";

/// The reason why a line is no case.
fn unread(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            let hint = match *len == 2 * expected_len {
                true => ". If these are decimal commas, write decimal points, such as 0.5",
                false => ". Write one number for each name",
            };
            format!(
                "line {line} has {len} numbers, where the first line names {expected_len}{hint}"
            )
        }
        _ => error.to_string(),
    }
}

/// An error for names that the mechanism does not have, before anything is computed.
fn known(
    system: &System,
    names: &[String],
    keep: &[String],
    first: Option<&f64>,
) -> Result<(), Fault> {
    system.sweep(names).map_err(Fault::asked)?;
    let checked = first.map_or(Ok(()), |t| system.check_columns(keep, *t));
    checked.map_err(|error| match Fault::asked(error) {
        Fault::Usage(text) if system.has_forces() => Fault::Usage(format!(
            "{text}. The first line of `kin forces FILE` lists the columns of forces"
        )),
        other => other,
    })
}

/// Measures and coordinates.
fn of_motion(system: &System) -> Vec<String> {
    system.measures().into_iter().chain(system.coordinate_names().iter().cloned()).collect()
}

/// The run of each case.
struct Job<'a> {
    system: &'a System,
    names: &'a [String],
    keep: &'a [String],
    times: &'a [f64],
    options: &'a SolverOptions,
    /// The first case, and the warnings of its motion: those of the others are the same as a rule.
    first: usize,
    warnings: OnceLock<Vec<Warning>>,
}

impl Job<'_> {
    fn header(&self) -> Vec<String> {
        let kept = self.keep.iter().flat_map(|name| {
            [
                format!("{name} min"),
                format!("t of {name} min"),
                format!("{name} max"),
                format!("t of {name} max"),
            ]
        });
        ["case".to_string()]
            .into_iter()
            .chain(self.names.iter().cloned())
            .chain(["status".to_string()])
            .chain(kept)
            .collect()
    }

    fn row(&self, number: usize, case: &[(String, f64)]) -> Vec<String> {
        let mut row: Vec<String> = [number.to_string()].into_iter().collect();
        row.extend(case.iter().map(|(text, _)| text.clone()));
        match self.extremes(number, case) {
            Ok(all) => {
                row.push("done".to_string());
                row.extend(all.into_iter().map(digits));
            }
            Err(error) => {
                row.push(error.to_string().lines().next().unwrap_or_default().to_string());
                row.extend(self.keep.iter().flat_map(|_| [const { String::new() }; 4]));
            }
        }
        row
    }

    /// Value and time of the least and the greatest value of each thing that is kept.
    fn extremes(&self, number: usize, case: &[(String, f64)]) -> kin::Result<Vec<f64>> {
        let mut system = self.system.clone();
        for (name, (_, value)) in self.names.iter().zip(case) {
            model::set(&mut system, &Setting { name: name.clone(), value: *value })?;
        }
        let motion = system.solver().options(self.options.clone()).run(self.times)?;
        if number == self.first {
            self.warnings.get_or_init(|| motion.warnings().to_vec());
        }
        let of_motion = of_motion(&system);
        let has_forces = self.keep.iter().any(|name| !of_motion.contains(name));
        let forces = has_forces.then(|| system.forces(&motion)).transpose()?;
        let mut all = Vec::new();
        for name in self.keep {
            match &forces {
                Some(forces) if !of_motion.contains(name) => {
                    let found = forces.named(name)?;
                    all.extend([found.min(), found.at_min(), found.max(), found.at_max()]);
                }
                _ => {
                    let found = system.extremes(&motion, name)?;
                    let least = found.min();
                    let most = found.max();
                    all.extend([least.value, least.t, most.value, most.t]);
                }
            }
        }
        Ok(all)
    }
}
