//! Files of other programs.

use crate::{code, done, fed, words};

/// A part that turns about z, in the form of OndselSolver, with a contact that has no place here.
const PART: &str = "freeCAD: 3D CAD
Assembly
\tName
\t\tfan
\tPosition3D
\t\t0 0 0
\tRotationMatrix
\t\t1 0 0
\t\t0 1 0
\t\t0 0 1
\tRefPoints
\t\tRefPoint
\t\t\tPosition3D
\t\t\t\t0 0 0
\t\t\tRotationMatrix
\t\t\t\t1 0 0
\t\t\t\t0 1 0
\t\t\t\t0 0 1
\t\t\tMarkers
\t\t\t\tMarker
\t\t\t\t\tName
\t\t\t\t\t\tO
\t\t\t\t\tPosition3D
\t\t\t\t\t\t0 0 0
\t\t\t\t\tRotationMatrix
\t\t\t\t\t\t1 0 0
\t\t\t\t\t\t0 1 0
\t\t\t\t\t\t0 0 1
\tParts
\t\tPart
\t\t\tName
\t\t\t\tblade
\t\t\tPosition3D
\t\t\t\t0 0 0
\t\t\tRotationMatrix
\t\t\t\t1 0 0
\t\t\t\t0 1 0
\t\t\t\t0 0 1
\t\t\tRefPoints
\t\t\t\tRefPoint
\t\t\t\t\tPosition3D
\t\t\t\t\t\t0 0 0
\t\t\t\t\tRotationMatrix
\t\t\t\t\t\t1 0 0
\t\t\t\t\t\t0 1 0
\t\t\t\t\t\t0 0 1
\t\t\t\t\tMarkers
\t\t\t\t\t\tMarker
\t\t\t\t\t\t\tName
\t\t\t\t\t\t\t\tO
\t\t\t\t\t\t\tPosition3D
\t\t\t\t\t\t\t\t0 0 0
\t\t\t\t\t\t\tRotationMatrix
\t\t\t\t\t\t\t\t1 0 0
\t\t\t\t\t\t\t\t0 1 0
\t\t\t\t\t\t\t\t0 0 1
\tConstraintSets
\t\tJoints
\t\t\tRevoluteJoint
\t\t\t\tName
\t\t\t\t\thub
\t\t\t\tMarkerI
\t\t\t\t\t/fan/O
\t\t\t\tMarkerJ
\t\t\t\t\t/fan/blade/O
\t\t\tCurveCurveContact
\t\t\t\tName
\t\t\t\t\tcam
\t\tMotions
\t\t\tRotationalMotion
\t\t\t\tName
\t\t\t\t\tmotor
\t\t\t\tMotionJoint
\t\t\t\t\t/fan/hub
\t\t\t\tRotationZ
\t\t\t\t\t2.0d*pi*time
\tSimulationParameters
\t\ttstart
\t\t\t0.0
\t\ttend
\t\t\t1.0
\t\thout
\t\t\t0.01
";

#[test]
fn a_file_of_ondsel_becomes_a_mechanism_that_runs() {
    let imported = fed(&["import", "-"], PART);
    assert_eq!(code(&imported), 0, "{}", words(&imported));
    let told = words(&imported);
    assert!(
        told.contains(
            "Kin leaves out CurveCurveContact `cam`: Kin does not read joints of this kind"
        ),
        "{told}"
    );
    assert!(told.contains("its times: --times 0:1:101"), "{told}");
    let file = String::from_utf8(imported.stdout).expect("text");
    let run = fed(&["run", "-", "--times", "0:1:5", "--csv", "-"], &file);
    assert_eq!(code(&run), 0, "{}", words(&run));
    assert_eq!(String::from_utf8(run.stdout).expect("text").lines().count(), 6);
}

#[test]
fn a_file_that_is_none_is_told_with_its_line() {
    let spoilt = fed(&["import", "-"], &PART.replace("2.0d*pi*time", "2.0d*pi*speed"));
    assert_eq!(code(&spoilt), 5);
    let told = words(&spoilt);
    assert!(
        told.contains("standard input: line ")
            && told.contains("Kin does not know `speed` in a formula"),
        "{told}"
    );
    let none = done(&["import", "no such file.asmt"]);
    assert_eq!(code(&none), 5, "{}", words(&none));
}
