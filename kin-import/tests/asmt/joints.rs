//! Each kind of joint by what it lets move: a part is displaced along and about the axes of marker I.

use kin::{EulerParameters, Ground, Mat3, Vec3, spatial, vec3};

use crate::own::{SAME, frame, joint, marker, part};

/// A kind of joint: which of Tx, Ty, Tz, Rx, Ry, Rz of marker J in the axes of marker I it leaves free;
/// `across` where z of J stands along x of I.
struct Kind {
    name: &'static str,
    free: [bool; 6],
    across: bool,
}

const fn kind(name: &'static str, free: [u8; 6], across: bool) -> Kind {
    let mut all = [false; 6];
    let mut k = 0;
    while k < 6 {
        all[k] = free[k] == 1;
        k += 1;
    }
    Kind { name, free: all, across }
}

const KINDS: [Kind; 11] = [
    kind("RevoluteJoint", [0, 0, 0, 0, 0, 1], false),
    kind("CylindricalJoint", [0, 0, 1, 0, 0, 1], false),
    kind("TranslationalJoint", [0, 0, 1, 0, 0, 0], false),
    kind("SphericalJoint", [0, 0, 0, 1, 1, 1], false),
    // z of I turns by itself, and so does z of J, which is x of I.
    kind("UniversalJoint", [0, 0, 0, 1, 0, 1], true),
    kind("PlanarJoint", [1, 1, 0, 0, 0, 1], false),
    kind("FixedJoint", [0, 0, 0, 0, 0, 0], false),
    kind("PointInLineJoint", [0, 0, 1, 1, 1, 1], false),
    kind("PointInPlaneJoint", [1, 1, 0, 1, 1, 1], false),
    kind("ParallelAxesJoint", [1, 1, 1, 0, 0, 1], false),
    kind("PerpendicularJoint", [1, 1, 1, 1, 0, 1], true),
];

/// The markers' places: of I in the assembly, of J in the part.
const AT_I: [f64; 3] = [0.3, -0.2, 0.7];
const AT_J: [f64; 3] = [0.25, 0.1, -0.4];

fn turned(axis: Vec3, angle: f64) -> Mat3 {
    EulerParameters::from_axis_angle(axis, angle).rotation()
}

fn rows(a: Mat3) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|k| a.row(k).to_array())
}

/// Place and turn of the part whose marker J is displaced by `by` in the axes of marker I.
fn placed(kind: &Kind, a_i: Mat3, a_j: Mat3, by: [f64; 6]) -> (Vec3, Mat3) {
    let [x, y, z, rx, ry, rz] = by;
    let (turn, size) = (vec3(rx, ry, rz), vec3(rx, ry, rz).norm());
    let turn = if size > 0.0 { turned(turn * (1.0 / size), size) } else { Mat3::identity() };
    // z along x: y along z, x along y.
    let stands = if kind.across {
        Mat3::from([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    } else {
        Mat3::identity()
    };
    let a = a_i * turn * stands * a_j.transpose();
    (Vec3::from(AT_I) + a_i * vec3(x, y, z) - a * Vec3::from(AT_J), a)
}

fn file(kind: &Kind, a_i: Mat3, a_j: Mat3) -> String {
    let (r, a) = placed(kind, a_i, a_j, [0.0; 6]);
    format!(
        "Assembly\n\tName\n\t\taskew\n{}\tRefPoints\n{}\tParts\n{}\tConstraintSets\n\t\tJoints\n{}\t\tMotions\n",
        frame(1, [0.0; 3], SAME),
        marker(2, "I", AT_I, rows(a_i)),
        part("part", r.to_array(), rows(a), &[marker(4, "J", AT_J, rows(a_j))]),
        joint(kind.name, "joint", "I", "part/J"),
    )
}

/// Displacements that the kind leaves free change its equations in the second order alone, the others in the
/// first.
#[test]
fn every_kind_of_joint_leaves_free_what_its_name_says() {
    const STEP: f64 = 1e-4;
    let axis = vec3(0.48, -0.6, 0.64);
    let (a_i, a_j) = (turned(axis, 0.9), turned(vec3(0.0, 0.6, 0.8), -0.5));
    for kind in &KINDS {
        let text = file(kind, a_i, a_j);
        let read = kin_import::asmt(&text).unwrap_or_else(|mistake| panic!("{}: {mistake}", kind.name));
        assert_eq!(read.left_out, [], "{}", kind.name);
        let mut m = read.mechanism;
        let body = m.spatial_named("part").expect("the part");
        // Held elsewhere too, so that there are as many equations as it takes to ask.
        let zero = vec3(0.0, 0.0, 0.0);
        m.add("held", spatial::weld(body, Ground, zero, zero, EulerParameters::identity())).expect("a joint");
        let system = m.build().expect("a system");
        let own = system.n_equations() - 7;
        let off = |by: [f64; 6]| {
            let (r, a) = placed(kind, a_i, a_j, by);
            let p = EulerParameters::from_rotation(a);
            let q = [r.x, r.y, r.z, p.e0, p.e1, p.e2, p.e3];
            let c = system.residual(&q, 0.0).expect("numbers");
            c[..own].iter().fold(0.0_f64, |most, c| most.max(c.abs()))
        };
        assert!(off([0.0; 6]) < 1e-14, "{}: {:e} where it stands", kind.name, off([0.0; 6]));
        for (k, free) in kind.free.into_iter().enumerate() {
            let mut by = [0.0; 6];
            by[k] = STEP;
            let first = off(by) / STEP;
            assert!(if free { first < 1e-3 } else { first > 0.1 }, "{}: direction {k}: {first:e}", kind.name);
        }
        assert_eq!(own, kind.free.iter().filter(|free| !**free).count(), "{}: equations", kind.name);
    }
}
