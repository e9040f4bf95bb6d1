//! Joints, and limits of what they measure.

use kin::{Axis, IntoConstraint, Vec3, spatial};

use super::parts::Marker;
use super::{Reading, refused};
use crate::formula::Formula;
use crate::imported::Mistake;
use crate::tree::Tree;

/// A joint that was read: its path, and its markers.
pub struct Joint {
    pub path: String,
    pub name: String,
    pub kind: String,
    pub i: Marker,
    pub j: Marker,
}

/// Kinds of joints that are read.
const KINDS: [&str; 12] = [
    "RevoluteJoint",
    "CylindricalJoint",
    "TranslationalJoint",
    "SphericalJoint",
    "UniversalJoint",
    "PlanarJoint",
    "FixedJoint",
    "PointInLineJoint",
    "PointInPlaneJoint",
    "ParallelAxesJoint",
    "PerpendicularJoint",
    "GearJoint",
];

/// Why a gear is left out.
const NO_FRAME: &str = "no body holds the axes of both wheels by a revolute or cylindrical joint";

impl Reading {
    /// Adds a joint. Body J of the file is body i of Kin, since the file measures J in I.
    pub fn joint(&mut self, of: &Tree<'_>) -> Result<(), Mistake> {
        let kind = of.text;
        if !KINDS.contains(&kind) {
            self.leave(of, "joints of this kind are not read", true);
            return Ok(());
        }
        let (name, line) = of.value("Name")?;
        let (i, j) = (self.markers.named(of, "MarkerI")?, self.markers.named(of, "MarkerJ")?);
        let (h_i, h_j) = (i.axis(2), self.along(&i, &j));
        let p = |m: &Marker| kin::EulerParameters::from_rotation(m.a);
        let p_ij = p(&i) * p(&j).conjugate();
        let (a, b) = (j.body, i.body);
        match kind {
            "RevoluteJoint" => {
                self.add(name, line, spatial::revolute(a, b, j.u, i.u, h_j, h_i).zero(j.axis(0), i.axis(0)))?;
            }
            "CylindricalJoint" => {
                // Its forces are those about marker J, as in OndselSolver: the axis across which it holds is
                // that of body I, turned round so that turn and slide are those of J in I.
                let joint = spatial::cylindrical(b, a, i.u, j.u, -h_i, -h_j).zero(i.axis(0), j.axis(0));
                self.add(name, line, joint)?;
            }
            "TranslationalJoint" => {
                self.add(name, line, spatial::prismatic(a, b, j.u, i.u, h_j, p_ij))?;
            }
            "SphericalJoint" => self.add(name, line, spatial::spherical(a, b, j.u, i.u))?,
            "UniversalJoint" => {
                self.add(name, line, spatial::universal(a, b, j.u, i.u, j.axis(2), i.axis(2)))?
            }
            "PlanarJoint" => {
                let joint = spatial::planar(a, b, j.u, i.u, h_j, h_i).zero(j.axis(0), i.axis(0));
                self.add(name, line, joint)?;
            }
            "FixedJoint" => self.add(name, line, spatial::weld(a, b, j.u, i.u, p_ij))?,
            "PointInLineJoint" => self.add(name, line, spatial::point_on_line(a, b, j.u, i.u, h_i))?,
            "PointInPlaneJoint" => self.add(name, line, spatial::point_in_plane(a, b, j.u, i.u, h_i))?,
            "ParallelAxesJoint" => self.add(name, line, spatial::parallel(a, b, h_j, h_i))?,
            "PerpendicularJoint" => {
                self.add(name, line, spatial::perpendicular(a, b, j.axis(2), i.axis(2)))?
            }
            // Kinds that are known: what is left is `GearJoint`.
            _ => return self.gear(of, name, line, [i, j]),
        }
        let path = format!("/{}/{name}", self.mechanism.name());
        self.joints.push(Joint { path, name: name.to_string(), kind: kind.to_string(), i, j });
        Ok(())
    }

    pub(super) fn add(&mut self, name: &str, line: usize, joint: impl IntoConstraint) -> Result<(), Mistake> {
        self.mechanism.add(name, joint).map(|_| ()).map_err(refused(line))
    }

    /// The axis of marker J the way that the one of marker I points where the parts stand: z, or −z.
    pub(super) fn along(&self, i: &Marker, j: &Marker) -> Vec3 {
        if i.global(2).dot(j.global(2)) < 0.0 { -j.axis(2) } else { j.axis(2) }
    }

    /// Pair of wheels by their radii, in the frame that holds both of their axes.
    fn gear(&mut self, of: &Tree<'_>, name: &str, line: usize, [i, j]: [Marker; 2]) -> Result<(), Mistake> {
        let [r_i, r_j] = [of.numbers::<1>("radiusI")?[0], of.numbers::<1>("radiusJ")?[0]];
        let held = |wheel: &Marker| -> Vec<(Marker, Marker)> {
            let turning = self
                .joints
                .iter()
                .filter(|j| ["RevoluteJoint", "CylindricalJoint"].contains(&j.kind.as_str()));
            let ways = turning.flat_map(|joint| [(joint.i, joint.j), (joint.j, joint.i)]);
            ways.filter(|(own, _)| own.body == wheel.body).collect()
        };
        let (of_i, of_j) = (held(&i), held(&j));
        let both = of_i.iter().flat_map(|a| of_j.iter().map(move |b| (a, b)));
        let Some(((w_i, f_i), (w_j, f_j))) = both.into_iter().find(|((_, a), (_, b))| a.body == b.body)
        else {
            self.leave(of, NO_FRAME, true);
            return Ok(());
        };
        let frame = f_i.body;
        // Turns count from where the wheels stand.
        let axis = |own: &Marker, held: &Marker| {
            let x = held.stand.transpose() * own.global(0);
            [Axis::new(self.along(held, own), own.axis(0)), Axis::new(held.axis(2), x)]
        };
        let ([h_i, a_i], [h_j, a_j]) = (axis(w_i, f_i), axis(w_j, f_j));
        let s = self.mechanism.length(&format!("{name}.s"), 0.0).map_err(refused(line))?;
        let gear = spatial::gear_by_radii(i.body, j.body, frame, s, h_i, h_j, a_i, a_j, r_i, r_j, 0.0);
        self.add(name, line, gear)
    }

    /// Adds a limit of a turn or a slide.
    pub fn limit(&mut self, of: &Tree<'_>) -> Result<(), Mistake> {
        let measure = match of.text {
            "RotationLimit" => "angle",
            "TranslationLimit" => "slide",
            _ => {
                self.leave(of, "limits of this kind are not read", false);
                return Ok(());
            }
        };
        let ((path, line), (end, at), (way, _)) =
            (of.value("MotionJoint")?, of.value("Limit")?, of.value("Type")?);
        let joint = self.joints.iter().find(|joint| joint.path == path);
        let joint = joint.ok_or_else(|| Mistake::at(line, format!("there is no joint `{path}`")))?;
        let has = match joint.kind.as_str() {
            "RevoluteJoint" | "PlanarJoint" => measure == "angle",
            "TranslationalJoint" => measure == "slide",
            "CylindricalJoint" => true,
            _ => false,
        };
        let name = format!("{}.{measure}", joint.name);
        if !has {
            self.leave(of, "its joint does not measure that", false);
            return Ok(());
        }
        let value = Formula::read(end).map_err(|reason| Mistake::at(at, reason))?;
        let value = value.constant().ok_or_else(|| Mistake::at(at, "a limit does not change with time"))?;
        let known = self.limits.get(&name).copied().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let (from, to) = match way {
            "=>" | ">=" => (value, known.1),
            "=<" | "<=" => (known.0, value),
            _ => return Err(Mistake::at(of.line, format!("`{way}` is no kind of limit: `=>` or `=<`"))),
        };
        self.limits.insert(name.clone(), (from, to));
        self.mechanism.limit(&name, from, to).map_err(refused(at))
    }
}
