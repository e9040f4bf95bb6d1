//! `kin forces`: what drives must give and joints hold, as tables, words and pictures.

use kin::SolverOptions;
use kin::System;
use kin::forces::LoadSharing;
use kin_view::{Figure, Scene};

use crate::arguments::Forces;
use crate::fault::Fault;
use crate::model;
use crate::output::put;
use crate::say::{Say, Written};

/// Efforts of drives, forces of joints and energies over time, and the balance of powers in words.
pub fn forces(asked: &Forces, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (motion, early) = model::motion(&system, &asked.motion, false)?;
    say.warnings(&motion, Written::Nowhere);
    let sharing = if asked.least_norm { LoadSharing::LeastNorm } else { LoadSharing::NotGiven };
    let forces =
        system.solver().options(SolverOptions::new().sharing(sharing.clone())).forces(&motion)?;
    for name in forces.drives() {
        match forces.drive(name) {
            Ok(drive) => {
                let effort = drive.effort();
                let rms = short(drive.effort().rms());
                say.note(&format!("{name}: at most {}, {rms} {} RMS", drive.peak(), effort.unit()));
            }
            Err(error) => say.note(&error.to_string()),
        }
    }
    say.note(&forces.balance().to_string());
    forces.growth()?.iter().for_each(|growth| say.note(&growth.to_string()));
    put(&asked.csv, |to| forces.write_csv_to(to))?;
    if let Some(file) = &asked.json {
        put(file, |to| Ok(serde_json::to_writer(to, &forces.data())?))?;
    }
    let why = early.as_ref().map(Fault::why_early).unwrap_or_default();
    pictures(asked, &system, &forces, &why)?;
    early.map_or(Ok(()), Err)
}

/// Writes the pictures that the command line names. `why` is why the run ended early, which the
/// page says.
fn pictures(
    asked: &Forces,
    system: &System,
    forces: &kin::forces::Forces<'_>,
    why: &str,
) -> Result<(), Fault> {
    let motion = forces.motion();
    let write = |to: &str, text: &str| put(to, |to| to.write_all(text.as_bytes()));
    if let Some(to) = &asked.chart {
        write(to, &Figure::of_forces(forces).svg())?;
    }
    if asked.svg.is_none() && asked.page.is_none() {
        return Ok(());
    }
    let scene = Scene::new(system).forces(forces);
    if let Some(to) = &asked.svg {
        write(to, scene.pose(motion, hardest(forces))?.svg())?;
    }
    if let Some(to) = &asked.page {
        write(
            to,
            &scene.page(motion)?.asked(&asked.motion.times.0).ended(why).forces(forces).html(),
        )?;
    }
    Ok(())
}

/// The time at which the first drive gives most, or the first time.
fn hardest(forces: &kin::forces::Forces<'_>) -> f64 {
    let drives = forces.drives();
    let peak = drives.first().and_then(|name| forces.drive(name).ok()).map(|drive| drive.peak().t);
    peak.or(forces.motion().times().first().copied()).unwrap_or(0.0)
}

/// Five digits, as in words.
fn short(x: f64) -> f64 {
    format!("{x:.4e}").parse().unwrap_or(x)
}
