//! Files with something incomplete in them: that is left out by name, and the rest is read.

use kin_import::{Imported, asmt};

use crate::own::{SAME, frame, joint, marker, part, text};

const LAW: &str = "0.5 + 0.8d*sin(2*time)";

/// The notes on what a file lacks, and q of its mechanism after 0.7 s.
fn read(text: &str) -> (Vec<String>, Vec<f64>) {
    let Imported { mechanism, left_out, .. } = asmt(text).expect("a file that is read");
    let motion = mechanism.build().and_then(|system| system.run([0.0, 0.7])).expect("a motion");
    (left_out.iter().map(ToString::to_string).collect(), motion.q(1).to_vec())
}

/// The file with one thing in its text changed.
fn changed(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn a_mass_marker_is_a_marker_that_a_joint_can_use() {
    // The arm turns about its mass marker, which `part` puts at x = 0.1.
    let file = format!(
        "Assembly\n\tName\n\t\taskew\n{}\tRefPoints\n{}\tParts\n{}\tConstraintSets\n\t\tJoints\n{}\
         \t\tMotions\n\t\t\tRotationalMotion\n\t\t\t\tName\n\t\t\t\t\tmotor\n\t\t\t\tMotionJoint\n\
         \t\t\t\t\t/askew/turn\n\t\t\t\tRotationZ\n\t\t\t\t\t3*time\n",
        frame(1, [0.0; 3], SAME),
        marker(2, "O", [0.0; 3], SAME),
        part("arm", [-0.1, 0.0, 0.0], SAME, &[]),
        joint("RevoluteJoint", "turn", "O", "arm/MassMarker"),
    );
    let (left_out, q) = read(&file);
    assert_eq!(left_out, [""; 0]);
    let (sin, cos) = (3.0_f64 * 0.7).sin_cos();
    assert!((q[0] + 0.1 * cos).abs() < 1e-12 && (q[1] + 0.1 * sin).abs() < 1e-12, "{q:?}");
}

#[test]
fn a_joint_without_a_name_is_read_and_called_after_its_line() {
    let whole = text(LAW, "");
    let (left_out, q) = read(&changed(&whole, "\t\t\t\t\tJ2\n", "\t\t\t\t\t\n"));
    let [told] = &left_out[..] else { panic!("{left_out:?}") };
    assert!(told.contains("Kin leaves out the name of RevoluteJoint: the name is empty"), "{told}");
    let line = told.trim_start_matches("line ").split(':').next().expect("a line");
    assert!(told.contains(&format!("`RevoluteJoint at line {line}`")), "{told}");
    assert_eq!(q, read(&whole).1);
    for (name, kind) in [("askew", "Assembly"), ("motor", "RotationalMotion")] {
        let nameless = whole.replace(&format!("Name\n\t\t{name}\n"), "Name\n");
        let nameless =
            nameless.replace(&format!("\t\t\t\t\t{name}\n"), "").replace("/askew/", "//");
        let nameless = if name == "askew" { nameless } else { nameless.replace("//", "/askew/") };
        let (left_out, q) = read(&nameless);
        assert!(
            left_out.len() == 1 && left_out[0].contains(&format!("the name of {kind}")),
            "{left_out:?}"
        );
        assert_eq!(q, read(&whole).1);
    }
}

#[test]
fn a_motion_of_no_joint_goes_by_its_markers_or_is_left_out_by_name() {
    let whole = text(LAW, "");
    let named = "\t\t\t\tMotionJoint\n\t\t\t\t\t/askew/J1\n";
    let markers =
        "\t\t\t\tMarkerI\n\t\t\t\t\t/askew/O\n\t\t\t\tMarkerJ\n\t\t\t\t\t/askew/crank/O\n";
    let empty = "\t\t\t\tMotionJoint\n\t\t\t\t\t\n";
    let (left_out, q) = read(&changed(&whole, named, &format!("{markers}{empty}")));
    assert_eq!((left_out, q), read(&whole));
    for other in [empty, "\t\t\t\tMotionJoint\n\t\t\t\t\t/askew/J9\n"] {
        let read = asmt(&changed(&whole, named, other)).expect("the rest");
        let [left] = &read.left_out[..] else { panic!("{:?}", read.left_out) };
        assert!(
            left.matters
                && left
                    .to_string()
                    .contains("Kin leaves out RotationalMotion `motor`: Kin reads no joint")
        );
        assert!(
            read.mechanism.build().expect("a system").run([0.0]).is_err(),
            "nothing drives the crank"
        );
    }
}

#[test]
fn a_limit_of_no_joint_is_left_out_by_name() {
    let whole = text(LAW, "");
    let named = "\t\t\t\tMotionJoint\n\t\t\t\t\t/askew/J4\n";
    let (left_out, q) = read(&changed(&whole, named, "\t\t\t\tMotionJoint\n\t\t\t\t\t\n"));
    assert!(
        left_out.len() == 1 && left_out[0].contains("Kin leaves out TranslationLimit `end`"),
        "{left_out:?}"
    );
    assert_eq!(q, read(&whole).1);
    let ends =
        "\t\t\t\tMarkerI\n\t\t\t\t\t/askew/way\n\t\t\t\tMarkerJ\n\t\t\t\t\t/askew/slider/way\n";
    assert_eq!(read(&changed(&whole, named, ends)), read(&whole));
}

#[test]
fn a_joint_between_two_markers_of_one_body_is_left_out_by_name() {
    for (i, j, on) in [("O", "way", "the ground"), ("crank/O", "crank/A", "one part")] {
        for kind in ["PlanarJoint", "RevoluteJoint", "GearJoint", "FixedJoint"] {
            let (left_out, q) = read(&text(LAW, &joint(kind, "mate", i, j)));
            let [told] = &left_out[..] else { panic!("{left_out:?}") };
            assert!(
                told.contains(&format!("Kin leaves out {kind} `mate`: both markers are on {on}"))
            );
            assert_eq!(q, read(&text(LAW, "")).1);
        }
    }
    let half =
        "\t\t\tRevoluteJoint\n\t\t\t\tName\n\t\t\t\t\thalf\n\t\t\t\tMarkerI\n\t\t\t\t\t/askew/O\n";
    let (left_out, _) = read(&text(LAW, half));
    assert!(
        left_out.len() == 1
            && left_out[0].contains("Kin leaves out RevoluteJoint `half`: the block does not name")
    );
}
