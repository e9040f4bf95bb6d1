//! Questions about a mechanism and its motion.

use kin::design::{Feature, Samples, Sampling};
use kin::{Motion, System};

use crate::arguments::{
    Asked, Assemblies, Check, Diagnose, Distribution, Measure, Prove, Sensitivities, Tolerance,
};
use crate::fault::Fault;
use crate::model;
use crate::output::{digits, put, table};
use crate::say::{Say, Written};

/// Reads, builds and assembles.
pub fn check(asked: &Check, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let found = system
        .solver()
        .options(kin::SolverOptions::new().allowed_misfit(asked.misfit.share))
        .position(asked.at)?;
    say.note(&format!(
        "{}: {} coordinates, {} equations; assembled at t = {} {}, |C| ≤ {:.0e}",
        system.name(),
        system.n_coordinates(),
        system.n_equations(),
        asked.at,
        system.unit_words().time(),
        largest(&system.residual(&found.q, asked.at)?)
    ));
    if !asked.names {
        return Ok(());
    }
    let row = |what: &str, name: String, value: String| vec![what.to_string(), name, value];
    let dimensions = system
        .dimensions()
        .into_iter()
        .map(|(name, value)| row("dimension", name, value.to_string()));
    let parameters = system
        .parameters()
        .into_iter()
        .map(|(name, value)| row("parameter", name, value.to_string()));
    let coordinates = system.coordinate_names().iter().zip(&found.q);
    let coordinates = coordinates.map(|(name, q)| row("coordinate", name.clone(), q.to_string()));
    let measures = system.measures().into_iter().map(|name| row("measure", name, String::new()));
    let rows = dimensions.chain(parameters).chain(coordinates).chain(measures);
    table("-", &["what", "name", "value"].map(str::to_string), rows)
}

fn largest(all: &[f64]) -> f64 {
    all.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The verdict, as words; exit code 1 where the mechanism cannot be driven.
pub fn diagnose(asked: &Diagnose, say: &Say) -> Result<(), Fault> {
    let diagnosis = match asked.model.settings[..] {
        [] => model::mechanism(&asked.model.file)?.diagnose(asked.at)?,
        _ => model::system(&asked.model)?.diagnose(asked.at)?,
    };
    say.note(&diagnosis.to_string());
    if let Some(to) = &asked.json {
        put(to, |to| {
            serde_json::to_writer(&mut *to, &diagnosis)?;
            to.write_all(b"\n")
        })?;
    }
    if diagnosis.can_be_driven() { Ok(()) } else { Err(Fault::Reported) }
}

/// All assemblies at one time.
pub fn assemblies(asked: &Assemblies, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let all = system.assemblies(asked.at)?;
    let name = system.name();
    let complete = all.complete;
    let reason = &all.reason;
    say.note(&format!("{name}: {} assemblies found at t = {}", all.len(), asked.at));
    say.note(&format!("complete: {complete} ({reason})"));
    if let Some(to) = &asked.json {
        put(to, |to| {
            serde_json::to_writer(&mut *to, &all)?;
            to.write_all(b"\n")
        })?;
    }
    let header: Vec<String> = ["label".to_string()]
        .into_iter()
        .chain(system.coordinate_names().iter().cloned())
        .collect();
    let rows = all.iter().map(|one| {
        [one.label.to_string()].into_iter().chain(one.q.iter().map(|q| digits(*q))).collect()
    });
    table(&asked.csv, &header, rows)
}

/// Measures over time, and where they turn round.
pub fn measure(asked: &Measure, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (motion, early) = model::motion(&system, &asked.motion, false)?;
    say.warnings(&motion, Written::Nowhere);
    let mut header = vec![time_header(&motion)];
    let mut columns = vec![motion.times().to_vec()];
    for name in &asked.names {
        let found = system.measure(&motion, name).map_err(Fault::asked)?;
        for (series, mark) in [(&found.value, ""), (&found.rate, "'"), (&found.second_rate, "''")] {
            header.push(format!("{name}{mark} [{}]", series.unit()));
            columns.push(series.values().to_vec());
        }
        for drive in &asked.over {
            let advantage =
                system.mechanical_advantage(&motion, drive, name).map_err(Fault::asked)?;
            header.push(format!("{} [{}]", advantage.name(), advantage.unit()));
            columns.push(advantage.values().to_vec());
        }
        let extremes = system.extremes(&motion, name)?;
        let least = extremes.min();
        let most = extremes.max();
        let s = motion.unit_words().time().to_string();
        say.note(&format!(
            "{name}: from {} {unit} at t = {} {s} to {} {unit} at t = {} {s}",
            least.value,
            least.t,
            most.value,
            most.t,
            unit = extremes.unit(),
        ));
    }
    columns_of(&asked.csv, &header, &columns)?;
    early.map_or(Ok(()), Err)
}

fn time_header(motion: &Motion) -> String {
    format!("t [{}]", motion.unit_words().time())
}

/// A table by its columns.
fn columns_of(to: &str, header: &[String], columns: &[Vec<f64>]) -> Result<(), Fault> {
    let count = columns.first().map_or(0, Vec::len);
    let value = |column: &Vec<f64>, k: usize| digits(column.get(k).copied().unwrap_or(f64::NAN));
    table(to, header, (0..count).map(|k| columns.iter().map(|column| value(column, k)).collect()))
}

/// The proof in words; exit code 4 where a step is not proved.
pub fn prove(asked: &Prove, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (motion, early) = model::motion(&system, &asked.motion, false)?;
    say.warnings(&motion, Written::Nowhere);
    let proof = system.prove(&motion)?;
    if let Some(to) = &asked.csv {
        let header = ["from", "to", "proved", "within", "doubt"].map(str::to_string);
        let rows = proof.steps().iter().map(|step| {
            let (proved, within, doubt) = match &step.tube {
                Ok(tube) => ("yes", digits(largest(&tube.radius)), String::new()),
                Err(doubt) => ("no", String::new(), doubt.to_string()),
            };
            vec![digits(step.from), digits(step.to), proved.to_string(), within, doubt]
        });
        table(to, &header, rows)?;
    }
    match (early, proof.is_complete()) {
        (None, true) => {
            say.note(&proof.to_string());
            Ok(())
        }
        (None, false) => Err(Fault::NotProved(proof.to_string())),
        (Some(early), _) => {
            say.note(&proof.to_string());
            Err(early)
        }
    }
}

/// Derivatives of coordinates or measures by parameters, at fixed times.
pub fn sensitivities(asked: &Sensitivities, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (motion, early) = model::motion(&system, &asked.motion, false)?;
    say.note(&motion.summary());
    say.warnings(&motion, Written::InSummary);
    let by = system.sensitivities(&motion, &asked.parameters).map_err(Fault::asked)?;
    let mut header = vec![time_header(&motion)];
    let mut columns = vec![motion.times().to_vec()];
    let names: &[String] =
        if asked.measures.is_empty() { system.coordinate_names() } else { &asked.measures };
    for name in names {
        for one in by.of(name).map_err(Fault::asked)? {
            header.push(format!("d {name}/d {}", one.name));
            columns.push(one.value);
        }
    }
    columns_of(&asked.csv, &header, &columns)?;
    early.map_or(Ok(()), Err)
}

/// How far a measure may be off, as words, and as a table by dimension.
pub fn tolerance(asked: &Tolerance, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (motion, early) = model::motion(&system, &asked.motion, false)?;
    say.warnings(&motion, Written::Nowhere);
    let name = asked.name.as_str();
    let found = match asked.of {
        None => system.tolerance(&motion, name),
        Some(of) => {
            let extremes = system.extremes(&motion, name).map_err(Fault::asked)?;
            let feature: Feature = match of {
                Asked::Max => extremes.max().into(),
                Asked::Min => extremes.min().into(),
                Asked::Stroke => (&extremes).into(),
            };
            match asked.proved {
                true => system.tolerance_proved(&motion, name, feature),
                false => system.tolerance_of(&motion, name, feature),
            }
        }
    };
    let found = found.map_err(Fault::asked)?;
    say.note(&found.to_string());
    if let Some(proved) = &found.proved {
        say.note(&format!(
            "{}: proved from {} to {} {}",
            found.name, proved.low, proved.high, found.unit
        ));
    }
    let header = ["dimension", "tolerance", "derivative", "off", "share", "share of variance"];
    let rows = found.contributions.iter().map(|one| {
        let numbers =
            [one.tolerance, one.slope, one.off(), found.share(one), found.share_of_variance(one)];
        std::iter::once(one.name.clone()).chain(numbers.map(digits)).collect()
    });
    let samples = asked
        .samples
        .map(|count| samples(count, asked, &system, &motion, found.feature))
        .transpose()?;
    table(&asked.csv, &header.map(str::to_string), rows)?;
    if let Some(samples) = samples {
        say.note(&samples.to_string());
        if let Some(to) = &asked.samples_csv {
            let header = [format!("{} [{}]", samples.name(), samples.unit())];
            table(to, &header, samples.values().iter().map(|value| vec![digits(*value)]))?;
        }
    }
    early.map_or(Ok(()), Err)
}

/// The same feature in so many mechanisms made at random.
fn samples(
    count: usize,
    asked: &Tolerance,
    system: &System,
    motion: &Motion,
    of: Feature,
) -> Result<Samples, Fault> {
    let distribution = match asked.distribution {
        Distribution::Normal => kin::design::Distribution::Normal,
        Distribution::TruncatedNormal => kin::design::Distribution::TruncatedNormal,
        Distribution::Uniform => kin::design::Distribution::Uniform,
    };
    let sampling = Sampling { count, seed: asked.seed, distribution };
    system.samples(motion, asked.name.as_str(), of, &sampling).map_err(Fault::asked)
}
