//! Reads joints, and the limits of their measures.

use kin::joints::spatial;
use kin::mechanism::IntoConstraint;
use kin::{Axis, SpatialBody, Vec3};

use super::parts::Marker;
use super::{Reading, refused};
use crate::formula::Formula;
use crate::imported::Mistake;
use crate::tree::Tree;

/// A joint from the file: its path, and its markers with their paths.
pub struct Joint {
    pub path: String,
    pub markers: [String; 2],
    pub name: String,
    pub kind: String,
    pub i: Marker,
    pub j: Marker,
}

/// Kinds of joints that are read.
const KINDS: [&str; 20] = [
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
    "AngleJoint",
    "ConstantVelocityJoint",
    "LineInPlaneJoint",
    "SphSphJoint",
    "CylSphJoint",
    "RevCylJoint",
    "GearJoint",
    "ScrewJoint",
    "RackPinionJoint",
];

/// Why a motion or a limit is left out.
pub(super) const NO_JOINT: &str = "Kin reads no joint with this name or between these markers";

/// Axes with a smaller sine between them are parallel.   \[-\]
const PARALLEL: f64 = 1e-9;

/// A line in a plane: h_j · (r_Pi − r_Pj) = 0 and h_j · h_i = 0.    \[m, –\]
#[kin::constraint]
fn line_in_plane(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, h_i: Vec3, h_j: Vec3) -> (f64, f64) {
    let h = j.direction(h_j);
    (h.dot(i.point(u_i) - j.point(u_j)), h.dot(i.direction(h_i)))
}

/// The distance of a plane from marker I along its z; 0 where none is given.
fn offset(of: &Tree<'_>) -> Result<f64, Mistake> {
    of.get("offset").map_or(Ok(0.0), |_| of.numbers::<1>("offset").map(|[offset]| offset))
}

/// The distance of the markers; 0 where none is given.
fn distance(of: &Tree<'_>) -> Result<f64, Mistake> {
    of.get("distanceIJ")
        .map_or(Ok(0.0), |_| of.numbers::<1>("distanceIJ").map(|[distance]| distance.abs()))
}

impl Reading {
    /// Adds a joint to the mechanism.
    ///
    /// Body J of the file is body i of Kin, because the file measures J relative to I.
    pub fn joint(&mut self, of: &Tree<'_>) -> Result<(), Mistake> {
        let kind = of.text;
        if !KINDS.contains(&kind) {
            self.leave(of, "Kin does not read joints of this kind", true);
            return Ok(());
        }
        let Some([i, j]) = self.markers.of(of)? else {
            self.leave(of, "the block does not name two markers", true);
            return Ok(());
        };
        if let Some(reason) = self.on_one_body(&i, &j) {
            self.leave(of, &reason, false);
            return Ok(());
        }
        let (name, line) = self.name_of(of);
        if !self.add_joint(of, (&name, line), [i, j])? {
            return Ok(());
        }
        let path = format!("{}/{name}", self.root);
        let markers = [of.value("MarkerI")?.0.to_string(), of.value("MarkerJ")?.0.to_string()];
        self.joints.push(Joint { path, name, kind: kind.to_string(), markers, i, j });
        Ok(())
    }

    /// Adds the constraint of a joint. True if motions and limits can be of this joint: not of a
    /// coupling, nor of a joint that is left out.
    fn add_joint(
        &mut self,
        of: &Tree<'_>,
        (name, line): (&str, usize),
        [i, j]: [Marker; 2],
    ) -> Result<bool, Mistake> {
        let h_i = i.axis(2);
        let h_j = self.along(&i, &j);
        let p = |m: &Marker| kin::EulerParameters::from_rotation(m.a);
        let p_ij = p(&i) * p(&j).conjugate();
        let a = j.body;
        let b = i.body;
        match of.text {
            "RevoluteJoint" => {
                self.add(
                    name,
                    line,
                    spatial::revolute(a, b, j.u, i.u, h_j, h_i).zero(j.axis(0), i.axis(0)),
                )?;
            }
            "CylindricalJoint" => {
                // Its forces are those about marker J, as in OndselSolver: the axis across which it
                // holds is that of body I, turned round so that turn and slide are those of J in I.
                let joint =
                    spatial::cylindrical(b, a, i.u, j.u, -h_i, -h_j).zero(i.axis(0), j.axis(0));
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
                let at = i.u + h_i * offset(of)?;
                let joint = spatial::planar(a, b, j.u, at, h_j, h_i).zero(j.axis(0), i.axis(0));
                self.add(name, line, joint)?;
            }
            "FixedJoint" => self.add(name, line, spatial::weld(a, b, j.u, i.u, p_ij))?,
            "PointInLineJoint" => {
                self.add(name, line, spatial::point_on_line(a, b, j.u, i.u, h_i))?
            }
            "PointInPlaneJoint" => {
                let at = i.u + h_i * offset(of)?;
                self.add(name, line, spatial::point_in_plane(a, b, j.u, at, h_i))?
            }
            "ParallelAxesJoint" => self.add(name, line, spatial::parallel(a, b, h_j, h_i))?,
            "PerpendicularJoint" => {
                self.add(name, line, spatial::perpendicular(a, b, j.axis(2), i.axis(2)))?
            }
            "GearJoint" => return self.gear(of, name, line, [i, j]).map(|()| false),
            "ScrewJoint" => return self.screw(of, name, line, [i, j]).map(|()| false),
            "RackPinionJoint" => return self.rack(of, name, line, [i, j]).map(|()| false),
            // Kinds that are known: what is left depends on its numbers.
            _ => {
                if let Some(reason) = self.by_numbers(of, name, line, [&i, &j])? {
                    self.leave(of, reason, true);
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// The reason why something between two markers holds and moves nothing; `None` where it does.
    pub(super) fn on_one_body(&self, i: &Marker, j: &Marker) -> Option<String> {
        let is_ground = i.body == SpatialBody::from(self.mechanism.ground());
        let on = if is_ground { "the ground" } else { "one part" };
        (i.body == j.body).then(|| format!("both markers are on {on}, so the block moves nothing"))
    }

    /// The joint that a motion or a limit is of: the one that its line `MotionJoint` names, else
    /// the one between its own two markers. `None` where no joint that was read is meant.
    pub(super) fn joint_of(&self, of: &Tree<'_>) -> Option<&Joint> {
        if let Ok((path, _)) = of.value("MotionJoint") {
            return self.joints.iter().find(|joint| joint.path == path);
        }
        let markers = [of.value("MarkerI").ok()?.0, of.value("MarkerJ").ok()?.0];
        self.joints.iter().find(|joint| joint.markers == markers)
    }

    /// Adds a joint that some numbers have no place for; gives the reason why it is left out.
    fn by_numbers(
        &mut self,
        of: &Tree<'_>,
        name: &str,
        line: usize,
        [i, j]: [&Marker; 2],
    ) -> Result<Option<&'static str>, Mistake> {
        let a = j.body;
        let b = i.body;
        let [z_i, z_j] = [i, j].map(|m| Axis::new(m.axis(2), m.axis(0)));
        match of.text {
            "AngleJoint" => {
                let [angle] = of.get("theIzJz").map_or(Ok([0.0]), |_| of.numbers("theIzJz"))?;
                // Its equation is that of a cosine.
                let angle = angle.cos().acos();
                if angle.sin() < PARALLEL {
                    return Ok(Some(
                        "the axes are parallel, so the angle between the axes has no slope",
                    ));
                }
                self.add(name, line, spatial::angle(a, b, z_j, z_i, angle))?;
            }
            "ConstantVelocityJoint" => {
                // x_I · y_J + y_I · x_J = 0 carries turns on where z of the markers oppose.
                if i.global(2).dot(j.global(2)) > 0.0 {
                    return Ok(Some(
                        "the z-axes of the two markers must point in opposite directions",
                    ));
                }
                let z_j = Axis::new(-j.axis(2), j.axis(0));
                self.add(name, line, spatial::constant_velocity(a, b, j.u, i.u, z_j, z_i))?;
            }
            "LineInPlaneJoint" => {
                let at = i.u + i.axis(2) * offset(of)?;
                self.add(name, line, line_in_plane(a, b, j.u, at, j.axis(2), i.axis(2)))?;
            }
            kind => {
                let distance = distance(of)?;
                if distance == 0.0 {
                    return Ok(Some("the distance is zero, so the equation has no slope"));
                }
                match kind {
                    "SphSphJoint" => {
                        self.add(name, line, spatial::distance(a, b, j.u, i.u, distance))?
                    }
                    "CylSphJoint" => {
                        let joint = spatial::spherical_cylindrical(a, b, j.u, i.u, z_i, distance);
                        self.add(name, line, joint)?;
                    }
                    _ => {
                        let h_j = Axis::new(self.along(i, j), j.axis(0));
                        let joint =
                            spatial::revolute_cylindrical(a, b, j.u, i.u, h_j, z_i, distance, 0.0);
                        self.add(name, line, joint)?;
                    }
                }
            }
        }
        Ok(None)
    }

    pub(super) fn add(
        &mut self,
        name: &str,
        line: usize,
        joint: impl IntoConstraint,
    ) -> Result<(), Mistake> {
        self.mechanism.add(name, joint).map(|_| ()).map_err(refused(line))
    }

    /// The axis of marker J the way that the one of marker I points where the parts stand: z, or
    /// −z.
    pub(super) fn along(&self, i: &Marker, j: &Marker) -> Vec3 {
        if i.global(2).dot(j.global(2)) < 0.0 { -j.axis(2) } else { j.axis(2) }
    }

    /// Adds a limit of a rotation or a slide to the mechanism.
    pub fn limit(&mut self, of: &Tree<'_>) -> Result<(), Mistake> {
        let measure = match of.text {
            "RotationLimit" => "angle",
            "TranslationLimit" => "slide",
            _ => {
                self.leave(of, "Kin does not read limits of this kind", false);
                return Ok(());
            }
        };
        let (end, at) = of.value("Limit")?;
        let (way, _) = of.value("Type")?;
        let Some(joint) = self.joint_of(of) else {
            self.leave(of, NO_JOINT, false);
            return Ok(());
        };
        let has = match joint.kind.as_str() {
            "RevoluteJoint" | "PlanarJoint" => measure == "angle",
            "TranslationalJoint" => measure == "slide",
            "CylindricalJoint" => true,
            _ => false,
        };
        let name = format!("{}.{measure}", joint.name);
        if !has {
            self.leave(of, "the joint does not measure this quantity", false);
            return Ok(());
        }
        let value = Formula::read(end).map_err(|reason| Mistake::at(at, reason))?;
        let value = value
            .constant()
            .ok_or_else(|| Mistake::at(at, "Kin does not read a limit that changes with time"))?;
        let known = self.limits.get(&name).copied().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let (from, to) = match way {
            "=>" | ">=" => (value, known.1),
            "=<" | "<=" => (known.0, value),
            _ => {
                return Err(Mistake::at(
                    of.line,
                    format!("`{way}` is not a kind of limit: write `=>` or `=<`"),
                ));
            }
        };
        self.limits.insert(name.clone(), (from, to));
        self.mechanism.limit(&name, from, to).map_err(refused(at))
    }
}
