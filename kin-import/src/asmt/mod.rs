//! Reads `.asmt` files, the files of OndselSolver.
//!
//! A file is an assembly of parts. Parts and the assembly itself (the ground) contain reference
//! points, and reference points contain markers. Joints and motions name two markers, I and J, by
//! their paths. The axis of a joint is the z-axis of its markers. Angles and displacements are
//! those of J relative to I.

mod couplings;
mod joints;
mod motions;
mod parts;

use kin::{Mechanism, Vec3, linspace};

use crate::imported::{Imported, LeftOut, Mistake};
use crate::tree::Tree;
use parts::Markers;

/// More times than this are not given.
const MOST_TIMES: f64 = 1e6;

/// Reads the text of an `.asmt` file.
///
/// Parts become spatial bodies with their masses. Joints and motions become constraints with their
/// names, and limits become limits of measures. The units are metre, second and kilogram.
///
/// ```
/// # fn main() -> Result<(), kin_import::Mistake> {
/// let text = "freeCAD: 3D CAD\nAssembly\n\tName\n\t\tempty\n\tPosition3D\n\t\t0 0 0\n\
///             \tRotationMatrix\n\t\t1 0 0\n\t\t0 1 0\n\t\t0 0 1\n";
/// let imported = kin_import::asmt(text)?;
/// assert!(imported.left_out.is_empty());
/// # Ok(())
/// # }
/// ```
///
/// Errors, each with its line: the text is not an `.asmt` file; a number is invalid; no marker has
/// a path; Kin cannot read a law.
///
/// Parts of the file that Kin cannot represent are not errors: [`Imported::left_out`] lists them.
/// The list also contains incomplete parts: an empty name, a motion without a joint, a joint
/// between two markers of one body.
pub fn asmt(text: &str) -> Result<Imported, Mistake> {
    let file = Tree::read(text)?;
    let assembly = file.get("Assembly").ok_or_else(|| {
        Mistake::at(
            0,
            "the file has no line `Assembly`, so the file is not of OndselSolver (.asmt)",
        )
    })?;
    let name = assembly.value("Name").map_or("", |(name, _)| name);
    let mut reading = Reading {
        root: format!("/{name}"),
        mechanism: Mechanism::new(if name.is_empty() { "assembly" } else { name }),
        markers: Markers::default(),
        joints: Vec::new(),
        limits: Default::default(),
        left_out: Vec::new(),
    };
    if name.is_empty() {
        reading.left_out.push(LeftOut::name_of(assembly, "assembly"));
    }
    reading.mechanism.units("m", "s").mass("kg");
    reading.parts(assembly)?;
    if let Some(sets) = assembly.get("ConstraintSets") {
        reading.sets(sets)?;
    }
    for force in assembly.all("ForceTorques") {
        reading.leave(force, "Kin does not read loads of these files", true);
    }
    if assembly.get("ConstantGravity").is_some() {
        reading.mechanism.gravity(Vec3::from(assembly.numbers::<3>("ConstantGravity")?));
    }
    let times = times(assembly)?;
    reading.left_out.sort_by_key(|left| left.line);
    Ok(Imported { mechanism: reading.mechanism, left_out: reading.left_out, times })
}

/// A file on its way to a mechanism.
struct Reading {
    /// The path of the assembly.
    root: String,
    mechanism: Mechanism,
    markers: Markers,
    joints: Vec<joints::Joint>,
    /// Both ends of each measure that has one.
    limits: std::collections::HashMap<String, (f64, f64)>,
    left_out: Vec<LeftOut>,
}

impl Reading {
    fn sets(&mut self, sets: &Tree<'_>) -> Result<(), Mistake> {
        for joint in sets.all("Joints") {
            self.joint(joint)?;
        }
        for motion in sets.all("Motions") {
            self.motion(motion)?;
        }
        for limit in sets.all("Limits") {
            self.limit(limit)?;
        }
        for other in sets.all("GeneralConstraintSets") {
            self.leave(other, "Kin does not read general constraints of these files", true);
        }
        let known = ["Joints", "Motions", "Limits", "GeneralConstraintSets"];
        for other in sets.inside.iter().filter(|other| !known.contains(&other.text)) {
            self.leave(other, "Kin does not know this block", true);
        }
        Ok(())
    }

    /// The name of a block, and its line. A block without a name is called after its kind and its
    /// line, which is noted.
    fn name_of(&mut self, of: &Tree<'_>) -> (String, usize) {
        if let Ok((name, line)) = of.value("Name") {
            return (name.to_string(), line);
        }
        let name = format!("{} at line {}", of.text, of.line);
        self.left_out.push(LeftOut::name_of(of, &name));
        (name, of.line)
    }

    /// Notes something that is left out.
    fn leave(&mut self, what: &Tree<'_>, reason: &str, matters: bool) {
        let name = match what.value("Name") {
            Ok((name, _)) => format!("{} `{name}`", what.text),
            Err(_) => what.text.to_string(),
        };
        self.left_out.push(LeftOut { line: what.line, name, reason: reason.to_string(), matters });
    }
}

impl LeftOut {
    /// The empty name of a block, which Kin calls otherwise.
    fn name_of(of: &Tree<'_>, name: &str) -> LeftOut {
        let reason = format!("the name is empty. Kin reads the block as `{name}`");
        LeftOut { line: of.line, name: format!("the name of {}", of.text), reason, matters: false }
    }
}

/// The mistake that a mechanism tells, at a line.
fn refused(line: usize) -> impl Fn(kin::Error) -> Mistake {
    move |error| Mistake::at(line, error.to_string())
}

/// The times at which the other program writes its results.
fn times(assembly: &Tree<'_>) -> Result<Vec<f64>, Mistake> {
    let Some(parameters) = assembly.get("SimulationParameters") else { return Ok(Vec::new()) };
    let number = |name: &str| parameters.numbers::<1>(name).map(|[value]| value);
    let from = number("tstart")?;
    let to = number("tend")?;
    let step = number("hout")?;
    let count = ((to - from) / step).round();
    if !(0.0..MOST_TIMES).contains(&count) {
        let line = parameters.line;
        return Err(Mistake::at(
            line,
            format!("no times go from {from} to {to} in steps of {step}"),
        ));
    }
    Ok(linspace(from, to, count as usize + 1))
}
