//! Each kind of joint by what it lets move: a part is displaced along and about the axes of marker
//! I.

use kin::joints::spatial;
use kin::{EulerParameters, Ground, Mat3, Vec3, vec3};

use crate::own::{SAME, frame, joint, marker, part};

/// How z of J stands to the axes of I.
#[derive(Clone, Copy, PartialEq)]
enum Stands {
    Alike,
    /// Along x.
    Across,
    /// The other way.
    Back,
}

/// A kind of joint: which of Tx, Ty, Tz, Rx, Ry, Rz of marker J in the axes of marker I it leaves
/// free; `place` of J as I sees it, and the lines that the kind has of its own.
struct Kind {
    name: &'static str,
    free: [u8; 6],
    stands: Stands,
    place: [f64; 3],
    own: Option<(&'static str, &'static str)>,
}

const fn kind(name: &'static str, free: [u8; 6], stands: Stands) -> Kind {
    Kind { name, free, stands, place: [0.0; 3], own: None }
}

const fn with(of: Kind, place: [f64; 3], own: (&'static str, &'static str)) -> Kind {
    Kind { place, own: Some(own), ..of }
}

use Stands::{Across, Alike, Back};

const KINDS: [Kind; 22] = [
    kind("RevoluteJoint", [0, 0, 0, 0, 0, 1], Alike),
    kind("CylindricalJoint", [0, 0, 1, 0, 0, 1], Alike),
    kind("TranslationalJoint", [0, 0, 1, 0, 0, 0], Alike),
    kind("SphericalJoint", [0, 0, 0, 1, 1, 1], Alike),
    // z of I turns by itself, and so does z of J, which is x of I.
    kind("UniversalJoint", [0, 0, 0, 1, 0, 1], Across),
    kind("PlanarJoint", [1, 1, 0, 0, 0, 1], Alike),
    with(kind("PlanarJoint", [1, 1, 0, 0, 0, 1], Alike), [0.1, 0.3, -0.2], ("offset", "-0.2")),
    kind("FixedJoint", [0, 0, 0, 0, 0, 0], Alike),
    kind("PointInLineJoint", [0, 0, 1, 1, 1, 1], Alike),
    kind("PointInPlaneJoint", [1, 1, 0, 1, 1, 1], Alike),
    with(kind("PointInPlaneJoint", [1, 1, 0, 1, 1, 1], Across), [0.1, 0.3, 0.4], ("offset", "0.4")),
    kind("ParallelAxesJoint", [1, 1, 1, 0, 0, 1], Alike),
    kind("PerpendicularJoint", [1, 1, 1, 1, 0, 1], Across),
    with(
        kind("AngleJoint", [1, 1, 1, 1, 0, 1], Across),
        [0.0; 3],
        ("theIzJz", "1.5707963267948966"),
    ),
    kind("ConstantVelocityJoint", [0, 0, 0, 1, 1, 0], Back),
    with(kind("LineInPlaneJoint", [1, 1, 0, 1, 0, 1], Across), [0.2, 0.1, 0.3], ("offset", "0.3")),
    with(kind("SphSphJoint", [0, 1, 1, 1, 1, 1], Alike), [-0.3, 0.0, 0.0], ("distanceIJ", "0.3")),
    with(kind("CylSphJoint", [1, 0, 1, 1, 1, 1], Across), [0.0, 0.4, 0.2], ("distanceIJ", "0.4")),
    with(kind("RevCylJoint", [0, 1, 1, 0, 0, 1], Alike), [0.3, 0.0, 0.2], ("distanceIJ", "0.3")),
    with(kind("RevCylJoint", [0, 1, 1, 0, 0, 1], Back), [0.3, 0.0, 0.2], ("distanceIJ", "0.3")),
    with(kind("ScrewJoint", [1, 1, 0, 1, 1, 0], Alike), [0.0, 0.0, 0.13], ("pitch", "0.2")),
    with(
        kind("RackPinionJoint", [0, 1, 1, 1, 1, 0], Back),
        [0.13, 0.3, 0.0],
        ("pitchRadius", "-0.3"),
    ),
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
    let turn = vec3(rx, ry, rz);
    let size = vec3(rx, ry, rz).norm();
    let turn = if size > 0.0 { turned(turn * (1.0 / size), size) } else { Mat3::identity() };
    let stands = match kind.stands {
        Alike => Mat3::identity(),
        // y along z, x along y.
        Across => Mat3::from([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
        Back => Mat3::from([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
    };
    let a = a_i * turn * stands * a_j.transpose();
    (Vec3::from(AT_I) + a_i * (vec3(x, y, z) + Vec3::from(kind.place)) - a * Vec3::from(AT_J), a)
}

fn file(kind: &Kind, a_i: Mat3, a_j: Mat3) -> String {
    let (r, a) = placed(kind, a_i, a_j, [0.0; 6]);
    let own = kind
        .own
        .map(|(name, value)| format!("\t\t\t\t{name}\n\t\t\t\t\t{value}\n"))
        .unwrap_or_default();
    format!(
        "Assembly\n\tName\n\t\taskew\n{}\tRefPoints\n{}\tParts\n{}\tConstraintSets\n\t\tJoints\n{}{own}\t\tMotions\n",
        frame(1, [0.0; 3], SAME),
        marker(2, "I", AT_I, rows(a_i)),
        part("part", r.to_array(), rows(a), &[marker(4, "J", AT_J, rows(a_j))]),
        joint(kind.name, "joint", "I", "part/J"),
    )
}

/// Displacements that the kind leaves free change its equations in the second order alone, the
/// others in the first.
#[test]
fn every_kind_of_joint_leaves_free_what_its_name_says() {
    const STEP: f64 = 1e-4;
    let axis = vec3(0.48, -0.6, 0.64);
    let a_i = turned(axis, 0.9);
    let a_j = turned(vec3(0.0, 0.6, 0.8), -0.5);
    for kind in &KINDS {
        let text = file(kind, a_i, a_j);
        let read =
            kin_import::asmt(&text).unwrap_or_else(|mistake| panic!("{}: {mistake}", kind.name));
        assert_eq!(read.left_out, [], "{}", kind.name);
        let mut m = read.mechanism;
        let body = m.spatial_named("part").expect("the part");
        // Held elsewhere too, so that there are as many equations as it takes to ask.
        let zero = vec3(0.0, 0.0, 0.0);
        m.add("held", spatial::weld(body, Ground, zero, zero, EulerParameters::identity()))
            .expect("a joint");
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
            assert!(
                if free == 1 { first < 1e-3 } else { first > 0.1 },
                "{}: direction {k}: {first:e}",
                kind.name
            );
        }
        assert_eq!(own, equations(kind), "{}: equations", kind.name);
    }
}

/// How many equations a kind has: what couples a way with a turn holds two directions by one.
fn equations(kind: &Kind) -> usize {
    let coupled = usize::from(["ScrewJoint", "RackPinionJoint"].contains(&kind.name));
    kind.free.iter().filter(|free| **free == 0).count() - coupled
}

/// Numbers with which a joint holds nothing, or another thing than its name says, leave it out by
/// name.
#[test]
fn joints_whose_numbers_make_no_sense_are_left_out_by_name() {
    let told = |of: Kind| {
        let text = file(&of, Mat3::identity(), Mat3::identity());
        let left = kin_import::asmt(&text).expect("an assembly").left_out;
        let left: Vec<String> =
            left.iter().filter(|left| left.matters).map(ToString::to_string).collect();
        left.concat()
    };
    let free = [0; 6];
    for (of, reason) in [
        (kind("ScrewJoint", free, Alike), "the pitch of the screw is zero"),
        (
            with(kind("RackPinionJoint", free, Alike), [0.0; 3], ("pitchRadius", "0")),
            "a pitch radius is zero",
        ),
        (kind("AngleJoint", free, Alike), "the axes are parallel"),
        (
            kind("ConstantVelocityJoint", free, Alike),
            "the z-axes of the two markers must point in opposite directions",
        ),
        (kind("SphSphJoint", free, Alike), "the distance is zero"),
        (kind("NoRotationJoint", free, Alike), "Kin does not read joints of this kind"),
    ] {
        let name = of.name;
        let told = told(of);
        assert!(
            told.contains(&format!("{name} `joint`")) && told.contains(reason),
            "{name}: {told}"
        );
    }
}

/// A shaft that turns screws a nut along, which carries a rack that turns a wheel, from where all
/// stand.
#[test]
fn a_screw_and_a_rack_carry_on_from_where_they_stand() {
    const SAME: Mat3 = Mat3::identity();
    let along = Mat3::from([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    // x of the way is z of the axis: y, z and x of the assembly are its x, y and z.
    let way = rows(along.transpose());
    let shaft = turned(vec3(1.0, 0.0, 0.0), 0.4);
    let wheel = turned(vec3(0.0, 0.0, 1.0), -0.7);
    let parts = [
        part("shaft", [0.0; 3], rows(shaft), &[marker(4, "axis", [0.0; 3], way)]),
        part(
            "nut",
            [0.33, 0.0, 0.0],
            rows(SAME),
            &[marker(4, "axis", [0.0; 3], way), marker(4, "rack", [0.0, 0.1, 0.0], rows(SAME))],
        ),
        part("wheel", [0.2, 0.35, 0.0], rows(wheel), &[marker(4, "axis", [0.0; 3], rows(SAME))]),
    ];
    let text = format!(
        "Assembly\n\tName\n\t\taskew\n{}\tRefPoints\n{}{}\tParts\n{}\tConstraintSets\n\t\tJoints\n{}{}{}{}\
         \t\t\t\tpitch\n\t\t\t\t\t-0.05\n{}\t\t\t\tpitchRadius\n\t\t\t\t\t0.25\n\t\tMotions\n\t\t\tRotationalMotion\n\
         \t\t\t\tName\n\t\t\t\t\tmotor\n\t\t\t\tMotionJoint\n\t\t\t\t\t/askew/turn\n\t\t\t\tRotationZ\n\t\t\t\t\t0.4+3*time\n",
        frame(1, [0.0; 3], rows(SAME)),
        marker(2, "way", [0.0; 3], way),
        marker(2, "wheel", [0.2, 0.35, 0.0], rows(SAME)),
        parts.concat(),
        joint("RevoluteJoint", "turn", "way", "shaft/axis"),
        joint("TranslationalJoint", "slide", "way", "nut/axis"),
        joint("RevoluteJoint", "hub", "wheel", "wheel/axis"),
        joint("ScrewJoint", "screw", "nut/axis", "shaft/axis"),
        joint("RackPinionJoint", "mesh", "nut/rack", "wheel/axis"),
    );
    let read = kin_import::asmt(&text).expect("an assembly");
    assert_eq!(read.left_out, []);
    let [nut, wheel] =
        ["nut", "wheel"].map(|name| read.mechanism.spatial_named(name).expect("a part"));
    let system = read.mechanism.build().expect("a system");
    let motion = system.run(kin::linspace(0.0, 8.0, 81)).expect("a motion");
    let path = motion.point(nut, (0.0, 0.0, 0.0)).expect("a point");
    let spokes = motion.point(wheel, (1.0, 0.0, 0.0)).expect("a point");
    for (k, t) in motion.times().iter().enumerate() {
        // 2π z − p θ stays, z the way of the shaft in the nut: the nut goes the other way.
        let way = 0.05 * 3.0 * t / std::f64::consts::TAU;
        assert!((path.r()[k].x - 0.33 - way).abs() < 1e-12, "{t}: {}", path.r()[k].x - 0.33);
        // x + r θ stays, x the way of the wheel in the rack.
        let (sin, cos) = (-0.7 + way / 0.25).sin_cos();
        assert!((spokes.r()[k] - vec3(0.2 + cos, 0.35 + sin, 0.0)).norm() < 1e-12, "{t}");
    }
}
