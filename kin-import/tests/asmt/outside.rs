//! Files of OndselSolver and what it computes of them: positions, rates, accelerations, reactions,
//! efforts. They are another project's and not copied here: `KIN_OUTSIDE` names the folder that
//! holds them, and without it nothing is compared.

use std::path::PathBuf;

use kin::SolverOptions;
use kin::forces::{Forces, LoadSharing};
use kin::{Axis, Mechanism, Motion, SpatialBody, System, Vec3};
use serde_json::Value;

use crate::written::written;

/// The folder, if it is at hand.
fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("KIN_OUTSIDE").map(PathBuf::from);
    if folder.is_none() {
        println!("note: KIN_OUTSIDE names no folder of OndselSolver's files: nothing is compared");
    }
    folder
}

fn json(path: PathBuf) -> Value {
    let text = std::fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn vectors(value: &Value) -> Vec<Vec3> {
    let all = value.as_array().expect("vectors").iter().map(numbers);
    all.map(|v| Vec3::new(v[0], v[1], v[2])).collect()
}

/// A model with its references.
struct Model {
    name: &'static str,
    mechanism: Mechanism,
    kinematics: Value,
    forces: Value,
}

fn model(name: &'static str) -> Option<Model> {
    let folder = folder()?;
    let text =
        std::fs::read_to_string(folder.join(format!("robots/asmt/{name}.asmt"))).expect("a file");
    let imported = kin_import::asmt(&text).expect("an assembly");
    let left: Vec<String> =
        imported.left_out.iter().filter(|left| left.matters).map(ToString::to_string).collect();
    assert!(left.is_empty(), "{name}: {left:?}");
    let kinematics = json(folder.join(format!("ondsel_{name}.json")));
    let forces = json(folder.join(format!("forces/ondsel_{name}.json")));
    Some(Model { name, mechanism: imported.mechanism, kinematics, forces })
}

/// The largest difference, and the largest number.
#[derive(Default)]
struct Compared {
    off: f64,
    largest: f64,
}

impl Compared {
    fn take(&mut self, found: Vec3, exact: Vec3) {
        let off = (found - exact).norm();
        self.off = if off.is_nan() { f64::INFINITY } else { self.off.max(off) };
        self.largest = self.largest.max(exact.norm());
    }

    fn check(&self, what: &str, tolerance: f64) {
        println!("{what}: off by {:.1e} of {:.3}", self.off, self.largest);
        assert!(self.largest > 0.0, "{what}: nothing is compared");
        assert!(self.off <= tolerance * (1.0 + self.largest), "{what}: off by {:e}", self.off);
    }
}

impl Model {
    fn body(&self, name: &str) -> SpatialBody {
        match name {
            "ground" => SpatialBody::from(self.mechanism.ground()),
            name => self.mechanism.spatial_named(name).unwrap_or_else(|| panic!("no body {name}")),
        }
    }

    /// Positions, rates and accelerations at the times whose numbers are `kept`.
    fn moves(
        &self,
        motion: &Motion,
        [position, rate, second]: [f64; 3],
        kept: impl Fn(usize) -> bool,
    ) {
        let [mut r, mut v, mut a, mut turns] = [(); 4].map(|()| Compared::default());
        for reference in self.kinematics["reference"].as_array().expect("bodies") {
            let body = self.body(reference["body"].as_str().expect("a name"));
            let series = |field: &str| vectors(&reference[field]);
            let point = |u: [f64; 3]| motion.point(body, Vec3::from(u)).expect("a point");
            let o = point([0.0; 3]);
            let x = point([1.0, 0.0, 0.0]);
            let rotation = motion.rotation(body).expect("a body");
            let known: [Vec<Vec3>; 6] = ["r", "ex", "v", "omega", "a", "alpha"].map(series);
            for k in (0..motion.len()).filter(|k| kept(*k)) {
                r.take(o.r()[k], known[0][k]);
                r.take(x.r()[k] - o.r()[k], known[1][k]);
                v.take(o.v()[k], known[2][k]);
                v.take(rotation.omega()[k], known[3][k]);
                a.take(o.a()[k], known[4][k]);
                turns.take(rotation.alpha()[k], known[5][k]);
            }
        }
        r.check(&format!("{}: positions", self.name), position);
        v.check(&format!("{}: rates", self.name), rate);
        a.check(&format!("{}: accelerations", self.name), second);
        turns.check(&format!("{}: angular accelerations", self.name), second);
    }

    /// Reactions on body I at marker I: all of them, or the components that are unique.
    fn reactions(
        &self,
        forces: &Forces<'_>,
        all: bool,
        tolerance: f64,
        kept: impl Fn(usize) -> bool,
    ) {
        let [mut force, mut torque] = [(); 2].map(|()| Compared::default());
        for exact in self.forces["reactions"].as_array().expect("reactions") {
            let name = exact["name"].as_str().expect("a name");
            let u = numbers(&exact["marker_i"]["u"]);
            let body = self.body(exact["body_i"].as_str().expect("a body"));
            let acted = forces.reaction(name).expect("a joint").on(body).expect("a body of it");
            let acted = acted.at(Vec3::new(u[0], u[1], u[2]));
            let exact_force = vectors(&exact["force"]);
            let exact_torque = vectors(&exact["torque"]);
            for (n, component) in ["F_x", "F_y", "F_z", "T_x", "T_y", "T_z"].into_iter().enumerate()
            {
                let unique = exact["unique"].get(n).is_none_or(|flag| flag == true);
                let found = acted.component(component);
                assert_eq!(found.is_ok(), all || unique, "{}: {name} {component}", self.name);
                let Ok(found) = found else { continue };
                let (known, of) =
                    if n < 3 { (&exact_force, &mut force) } else { (&exact_torque, &mut torque) };
                for k in (0..found.values().len()).filter(|k| kept(*k)) {
                    let along = |x: f64| Vec3::new(x, 0.0, 0.0);
                    of.take(along(found.values()[k]), along(known[k].to_array()[n % 3]));
                }
            }
        }
        force.check(&format!("{}: forces", self.name), tolerance);
        torque.check(&format!("{}: torques", self.name), tolerance);
    }

    /// Efforts and powers of drives.
    fn efforts(&self, forces: &Forces<'_>, tolerance: f64, kept: impl Fn(usize) -> bool) {
        let mut efforts = Compared::default();
        let mut powers = Compared::default();
        for exact in self.forces["drivers"].as_array().expect("drivers") {
            let drive = forces.drive(exact["name"].as_str().expect("a name")).expect("a driver");
            let along = |x: f64| Vec3::new(x, 0.0, 0.0);
            let power = numbers(&exact["power"]);
            let effort = exact["effort"].as_array().map(|_| numbers(&exact["effort"]));
            for k in (0..power.len()).filter(|k| kept(*k)) {
                powers.take(along(drive.power().values()[k]), along(power[k]));
                if let Some(effort) = &effort {
                    efforts.take(along(drive.effort().values()[k]), along(effort[k]));
                }
            }
        }
        efforts.check(&format!("{}: efforts", self.name), tolerance);
        powers.check(&format!("{}: powers", self.name), tolerance);
    }

    /// The equation that holds a torque which Ondsel takes for zero: one about x of marker J holds
    /// its y across the axis of I, and one about y its x.
    fn dropped(&self, row: &Value) -> String {
        let reactions = self.forces["reactions"].as_array().expect("reactions");
        let joint = reactions.iter().find(|joint| joint["name"] == row["joint"]).expect("a joint");
        let rows: Vec<Vec<f64>> =
            joint["marker_i"]["R"].as_array().expect("rows").iter().map(numbers).collect();
        let column = |k: usize| Vec3::new(rows[0][k], rows[1][k], rows[2][k]);
        // The zero of the angle turns f in body J as x of marker I is turned from Kin's own f.
        let share = Axis::along(column(2)).f.dot(column(0)).abs();
        assert!(!(1e-9..=1.0 - 1e-9).contains(&share), "{row}: {share}");
        let across = (row["torque_axis_of_marker_j"] == "x") == (share > 0.5);
        let name = match (joint["type"].as_str(), across) {
            (Some("cylindrical"), _) => "1",
            (_, true) => "g",
            (_, false) => "f",
        };
        format!("{}.{name}", row["joint"].as_str().expect("a joint"))
    }

    fn system(&self) -> (System, Motion) {
        let system = self.mechanism.clone().build().expect("a system");
        let motion = system.run(numbers(&self.forces["times"])).expect("a motion");
        (system, motion)
    }

    /// Everything; with the rows that Ondsel drops left out, all of its numbers.
    fn check(&self, tolerance: f64) {
        let (system, motion) = self.system();
        self.moves(&motion, [1e-10, 1e-9, 1e-8], |_| true);
        let forces = system.forces(&motion).expect("forces");
        self.reactions(&forces, false, tolerance, |_| true);
        self.efforts(&forces, tolerance, |_| true);
        println!("{}: {}", self.name, forces.balance());
        assert!(forces.balance().worst() < 1e-11, "{}", forces.balance());
        let dropped = self.forces["dropped_by_source"].as_array().expect("rows").iter();
        let mut dropped: Vec<String> = dropped.map(|row| self.dropped(row)).collect();
        // Of the two bending moments of a cylindrical joint that one which is redundant.
        let mut forces = system
            .solver()
            .options(SolverOptions::new().sharing(LoadSharing::Without(dropped.clone())))
            .forces(&motion);
        if forces.is_err()
            && let Some(row) = dropped.iter_mut().find(|row| row.ends_with(".1"))
        {
            *row = row.replace(".1", ".2");
            forces = system
                .solver()
                .options(SolverOptions::new().sharing(LoadSharing::Without(dropped)))
                .forces(&motion);
        }
        let forces = forces.expect("forces");
        self.reactions(&forces, true, tolerance, |_| true);
    }
}

#[test]
fn four_bar() {
    if let Some(model) = model("fourbar") {
        model.check(1e-9);
    }
}

#[test]
fn crank_and_slider() {
    if let Some(model) = model("crank_slider") {
        model.check(1e-9);
    }
}

#[test]
fn piston() {
    if let Some(model) = model("piston") {
        model.check(1e-9);
    }
}

#[test]
fn backhoe() {
    if let Some(model) = model("00backhoe") {
        model.check(1e-9);
    }
}

/// A wobble plate with six pistons: universal joints, balls, slides. One of its markers has a
/// matrix whose rows are too short by 1.2e-6, and so are the forces that the file lists of its
/// joint.
#[test]
fn wobble_pump() {
    let Some(folder) = folder() else { return };
    let kinematics = json(folder.join("ondsel_wobpump.json"));
    let forces = json(folder.join("forces/ondsel_wobpump.json"));
    let imported = kin_import::asmt(&written(&kinematics, &forces)).expect("an assembly");
    assert!(imported.left_out.is_empty(), "{:?}", imported.left_out);
    let model = Model { name: "wobpump", mechanism: imported.mechanism, kinematics, forces };
    let (system, motion) = model.system();
    model.moves(&motion, [1e-10, 1e-9, 1e-8], |_| true);
    let forces = system.forces(&motion).expect("forces");
    model.reactions(&forces, false, 1e-6, |_| true);
    model.efforts(&forces, 1e-6, |_| true);
}

/// A screw, and a rack with its pinion.
#[test]
fn rack_and_screw() {
    let Some(folder) = folder() else { return };
    let kinematics = json(folder.join("ondsel_rackscrew.json"));
    let forces = json(folder.join("forces/ondsel_rackscrew.json"));
    let imported = kin_import::asmt(&written(&kinematics, &forces)).expect("an assembly");
    assert!(imported.left_out.iter().all(|left| !left.matters), "{:?}", imported.left_out);
    let model = Model { name: "rackscrew", mechanism: imported.mechanism, kinematics, forces };
    let (system, motion) = model.system();
    model.moves(&motion, [1e-10, 1e-9, 1e-8], |_| true);
    let forces = system.forces(&motion).expect("forces");
    model.reactions(&forces, false, 1e-9, |_| true);
}

/// Two shafts that are bent by 59 degrees. Accelerations of the second one in the file are not the
/// derivatives of its rates.
#[test]
fn constant_velocity() {
    let Some(folder) = folder() else { return };
    let kinematics = json(folder.join("ondsel_constvel_fixed.json"));
    let list = |of: &str| kinematics[of].as_array().expect("a list").clone();
    let mass = |body: &Value| {
        let same = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        serde_json::json!({ "name": body["name"], "mass": 1, "centre": [0, 0, 0], "axes": same, "principal": [1, 1, 1] })
    };
    let masses: Vec<Value> = list("bodies").iter().map(mass).collect();
    let forces =
        serde_json::json!({ "bodies": masses, "gravity": [0, 0, 0], "times": kinematics["times"] });
    let imported = kin_import::asmt(&written(&kinematics, &forces)).expect("an assembly");
    assert!(imported.left_out.is_empty(), "{:?}", imported.left_out);
    let model = Model { name: "constvel", mechanism: imported.mechanism, kinematics, forces };
    let (_, motion) = model.system();
    model.moves(&motion, [1e-10, 1e-9, 1e3], |_| true);
}

/// Corners of its laws, where arctan turns in a hundredth of a second: the file's own accelerations
/// are wrong there by 6e-8 of themselves.
#[test]
fn robot() {
    let Some(model) = model("robot") else { return };
    let corner = |t: f64| (t - t.round()).abs() < 1e-9;
    let (system, motion) = model.system();
    let times = numbers(&model.forces["times"]);
    let kept = |k: usize| !corner(times[k]);
    model.moves(&motion, [1e-10, 1e-9, 1e-8], kept);
    let forces = system.forces(&motion).expect("forces");
    model.reactions(&forces, false, 1e-9, kept);
    model.efforts(&forces, 1e-9, kept);
    model.reactions(&forces, false, 1e-6, |_| true);
    println!("robot: {}", forces.balance());
}

/// Wheels of radii 1 and 2. The file holds the pose after a run, in which the second wheel has made
/// half a turn: from there both turn as in the series.
#[test]
fn gears() {
    let Some(folder) = folder() else { return };
    let text = std::fs::read_to_string(folder.join("robots/asmt/Gears.asmt")).expect("a file");
    let imported = kin_import::asmt(&text).expect("an assembly");
    let kinematics = json(folder.join("ondsel_Gears.json"));
    assert_eq!(imported.times.len(), 101);
    let motion = imported
        .mechanism
        .clone()
        .build()
        .expect("a system")
        .run(&imported.times)
        .expect("a motion");
    let mut turns = Compared::default();
    let mut ways = Compared::default();
    for reference in kinematics["reference"].as_array().expect("bodies") {
        let name = reference["body"].as_str().expect("a name");
        let body = imported.mechanism.spatial_named(name).expect("a body");
        let rotation = motion.rotation(body).expect("a body");
        let [o, x] = [0.0, 1.0].map(|x| motion.point(body, (x, 0.0, 0.0)).expect("a point"));
        let half = if name == "Part2" { -1.0 } else { 1.0 };
        for (k, exact) in vectors(&reference["omega"]).into_iter().enumerate() {
            turns.take(rotation.omega()[k], exact);
        }
        for (k, exact) in vectors(&reference["ex"]).into_iter().enumerate() {
            ways.take((x.r()[k] - o.r()[k]) * half, exact);
        }
    }
    turns.check("Gears: rates", 1e-9);
    ways.check("Gears: directions", 1e-10);
}

/// Files that no series is compared with are read, and what they have too much is told.
#[test]
fn the_other_files_are_read() {
    let Some(folder) = folder() else { return };
    let read = |name: &str| {
        let text = std::fs::read_to_string(folder.join(format!("robots/asmt/{name}.asmt")))
            .expect("a file");
        kin_import::asmt(&text).expect("an assembly")
    };
    let cam = read("camfollower");
    let told: Vec<String> =
        cam.left_out.iter().filter(|left| left.matters).map(ToString::to_string).collect();
    println!("{told:#?}");
    assert!(told.iter().any(|told| told.contains("CurveCurveContact `Joint3`")), "{told:?}");
    assert!(read("parm").mechanism.build().is_ok());
    let limits = read("pistonWithLimits").mechanism.data().expect("data").limits;
    let names: Vec<&str> = limits.iter().map(|limit| limit.measure.as_str()).collect();
    assert_eq!(names, ["Joint1.angle", "Joint4.slide"]);
    assert_eq!((limits[0].from, limits[0].to, limits[1].to), (Some(0.0), None, Some(1.2)));
}
