//! A file written for these tests: a slider-crank whose assembly stands askew, whose axes oppose.

use kin::{Mechanism, SpatialBody};
use kin_import::{Imported, asmt};

/// Lines of a frame, indented by `depth`.
pub fn frame(depth: usize, r: [f64; 3], rows: [[f64; 3]; 3]) -> String {
    let tabs = "\t".repeat(depth);
    let line = |v: [f64; 3]| format!("{tabs}\t{}\t{} {}\n", v[0], v[1], v[2]);
    format!("{tabs}Position3D\n{}{tabs}RotationMatrix\n{}", line(r), rows.map(line).concat())
}

pub const SAME: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Half a turn about x: its z opposes.
const BACK: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
/// z along x.
const ALONG: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

pub fn marker(depth: usize, name: &str, r: [f64; 3], rows: [[f64; 3]; 3]) -> String {
    let tabs = "\t".repeat(depth);
    // Half of the way is that of its reference point.
    let half = r.map(|x| 0.5 * x);
    format!(
        "{tabs}RefPoint\n{}{tabs}\tMarkers\n{tabs}\t\tMarker\n{tabs}\t\t\tName\n{tabs}\t\t\t\t{name}\n{}",
        frame(depth + 1, half, SAME),
        frame(depth + 3, half, rows)
    )
}

pub fn part(name: &str, r: [f64; 3], rows: [[f64; 3]; 3], markers: &[String]) -> String {
    format!(
        "\t\tPart\n\t\t\tName\n\t\t\t\t{name}\n{}\t\t\tPrincipalMassMarker\n\t\t\t\tName\n\t\t\t\t\tMassMarker\n{}\
         \t\t\t\tMass\n\t\t\t\t\t2.0\n\t\t\t\tMomentOfInertias\n\t\t\t\t\t0.1\t0.2 0.25\n\t\t\tRefPoints\n{}",
        frame(3, r, rows),
        frame(4, [0.1, 0.0, 0.0], SAME),
        markers.concat()
    )
}

pub fn joint(kind: &str, name: &str, i: &str, j: &str) -> String {
    format!(
        "\t\t\t{kind}\n\t\t\t\tName\n\t\t\t\t\t{name}\n\t\t\t\tMarkerI\n\t\t\t\t\t/askew/{i}\n\
         \t\t\t\tMarkerJ\n\t\t\t\t\t/askew/{j}\n"
    )
}

/// Crank 1, rod 3; the assembly is turned by a quarter about x and moved.
pub fn text(law: &str, more_joints: &str) -> String {
    let angle = 0.5_f64;
    let quarter = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
    let turned = |a: f64| [[a.cos(), -a.sin(), 0.0], [a.sin(), a.cos(), 0.0], [0.0, 0.0, 1.0]];
    let pin = [angle.cos(), angle.sin(), 0.0];
    let lean = -(angle.sin() / 3.0).asin();
    let slider = [angle.cos() + 3.0 * lean.cos(), 0.0, 0.0];
    let parts = [
        part(
            "crank",
            [0.0; 3],
            turned(angle),
            &[marker(4, "O", [0.0; 3], BACK), marker(4, "A", [1.0, 0.0, 0.0], SAME)],
        ),
        part(
            "rod",
            pin,
            turned(lean),
            &[marker(4, "A", [0.0; 3], BACK), marker(4, "B", [3.0, 0.0, 0.0], SAME)],
        ),
        part(
            "slider",
            slider,
            SAME,
            &[marker(4, "B", [0.0; 3], SAME), marker(4, "way", [0.0; 3], ALONG)],
        ),
    ];
    format!(
        "freeCAD: 3D CAD\nAssembly\n\tName\n\t\taskew\n{}\tRefPoints\n{}{}\tParts\n{}\tConstraintSets\n\t\tJoints\n\
         {}{}{}{}{more_joints}\t\tMotions\n\t\t\tRotationalMotion\n\t\t\t\tName\n\t\t\t\t\tmotor\n\t\t\t\tMotionJoint\n\
         \t\t\t\t\t/askew/J1\n\t\t\t\tRotationZ\n\t\t\t\t\t{law}\n\t\tLimits\n\t\t\tTranslationLimit\n\t\t\t\tName\n\
         \t\t\t\t\tend\n\t\t\t\tMotionJoint\n\t\t\t\t\t/askew/J4\n\t\t\t\tLimit\n\t\t\t\t\t3.9\n\t\t\t\tType\n\
         \t\t\t\t\t=<\n\tForceTorques\n\tConstantGravity\n\t\t0 0 -9.81\n\tSimulationParameters\n\t\ttstart\n\t\t\t0.0\n\
         \t\ttend\n\t\t\t2.0\n\t\thout\n\t\t\t0.1\n",
        frame(1, [0.3, -0.2, 0.7], quarter),
        marker(2, "O", [0.0; 3], SAME),
        marker(2, "way", [0.0; 3], ALONG),
        parts.concat(),
        joint("RevoluteJoint", "J1", "O", "crank/O"),
        joint("RevoluteJoint", "J2", "crank/A", "rod/A"),
        joint("RevoluteJoint", "J3", "rod/B", "slider/B"),
        joint("CylindricalJoint", "J4", "way", "slider/way"),
    )
}

fn body(m: &Mechanism, name: &str) -> SpatialBody {
    m.spatial_named(name).expect("a body")
}

#[test]
fn a_slider_crank_moves_as_its_closed_form_says() {
    let Imported { mechanism, left_out, times, .. } =
        asmt(&text("0.5 + 0.8d*sin(2*time)", "")).expect("a file");
    assert_eq!(left_out, []);
    assert_eq!(times.len(), 21);
    let slider = body(&mechanism, "slider");
    let system = mechanism.build().expect("a system");
    let motion = system.run(&times).expect("a motion");
    let path = motion.point(slider, (0.0, 0.0, 0.0)).expect("a point");
    for (t, r) in times.iter().zip(path.r()) {
        let (sin, cos) = (0.5 + 0.8 * (2.0 * t).sin()).sin_cos();
        let x = cos + (9.0 - sin * sin).sqrt();
        assert!(
            (r.x - 0.3 - x).abs() < 1e-12 && (r.y + 0.2).abs() < 1e-12 && (r.z - 0.7).abs() < 1e-12
        );
    }
    let passed: Vec<String> = motion.events().iter().map(ToString::to_string).collect();
    assert!(passed.iter().any(|event| event.contains("J4.slide")), "{passed:?}");
    let forces = system.forces(&motion).expect("forces");
    assert!(forces.balance().worst() < 1e-12, "{}", forces.balance());
    assert!(forces.drive("motor").expect("a driver").peak().value.abs() > 1.0);
}

#[test]
fn the_mechanism_goes_into_a_file_and_comes_back() {
    let m = asmt(&text("0.5 + 0.8d*sin(2*time)", "")).expect("a file").mechanism;
    let data = m.data().expect("data");
    let again = Mechanism::from_data(&data, &kin_text::registry()).expect("the same");
    let ends = [m, again]
        .map(|m| m.build().expect("a system").run([0.0, 0.7]).expect("a motion").q(1).to_vec());
    assert_eq!(ends[0], ends[1]);
}

#[test]
fn what_is_left_out_is_told_by_name() {
    let contact = joint("CurveCurveContact", "cam", "crank/A", "rod/A");
    let left_out = asmt(&text("time", &contact)).expect("a file").left_out;
    assert_eq!(left_out.len(), 1);
    assert!(left_out[0].matters);
    let told = left_out[0].to_string();
    assert!(
        told.contains(
            "Kin leaves out CurveCurveContact `cam`: Kin does not read joints of this kind"
        ),
        "{told}"
    );
    assert!(told.starts_with("line "), "{told}");
}

#[test]
fn a_part_named_ground_is_read_under_another_name() {
    let text = text("time", "").replace("crank", "ground");
    let read = asmt(&text).expect("a file");
    let told = read.left_out.iter().map(|one| one.to_string()).collect::<String>();
    assert!(told.contains("Kin reads this part as `ground part`"), "{told}");
    assert!(read.left_out.iter().all(|one| !one.matters));
}

#[test]
fn mistakes_are_told_with_their_lines() {
    let told = |text: String| asmt(&text).map(|_| ()).unwrap_err().to_string();
    assert!(told("{}".to_string()).starts_with("the file has no line `Assembly`"));
    let law = told(text("2*speed", ""));
    assert!(
        law.contains("`RotationZ`: Kin does not know `speed` in a formula")
            && law.starts_with("line "),
        "{law}"
    );
    let marker = told(text("time", "").replace("\t/askew/rod/B", "\t/askew/rod/C"));
    assert!(marker.contains("no marker has the name `/askew/rod/C`"), "{marker}");
    let number = told(text("time", "").replace("\t2.0\n\t\t\t\tMoment", "\theavy\n\t\t\t\tMoment"));
    assert!(number.contains("`heavy` is not a number"), "{number}");
    let twice = told(text("time", "").replace("\t\t\t\trod\n", "\t\t\t\tcrank\n"));
    assert!(twice.contains("crank"), "{twice}");
    let mass = told(text("time", "").replace("0.1\t0.2 0.25", "0.1\t0.2 0.35"));
    assert!(mass.contains("more than the sum of the others"), "{mass}");
    let skew = told(text("time", "").replacen("1\t0 0", "1\t0.1 0", 1));
    assert!(skew.contains("the matrix is not a rotation"), "{skew}");
}

#[test]
fn spoiled_files_are_mistakes_and_not_panics() {
    let whole = text("0.5 + 0.8d*sin(2*time)", "");
    let lines: Vec<&str> = whole.lines().collect();
    for k in 0..lines.len() {
        let without: Vec<&str> =
            lines.iter().enumerate().filter(|(n, _)| *n != k).map(|(_, line)| *line).collect();
        let _ = asmt(&without.join("\n"));
        let _ = asmt(&lines[..k].join("\n"));
        let nan: Vec<&str> = lines
            .iter()
            .enumerate()
            .map(|(n, line)| if n == k { "\t\t\t\tNaN" } else { *line })
            .collect();
        let _ = asmt(&nan.join("\n"));
    }
}
