//! Reads parts with their masses, and markers by their paths.

use std::collections::HashMap;

use kin::{EulerParameters, Mat3, SpatialBody, SpatialPose, Vec3};

use super::{Reading, refused};
use crate::imported::{LeftOut, Mistake};
use crate::tree::Tree;

/// Rows of a matrix may miss length 1 and right angles by this: files are written by hand and
/// rounded.
const ROUNDED: f64 = 1e-4;

/// A frame that is fixed on a body.
#[derive(Clone, Copy)]
pub struct Marker {
    pub body: SpatialBody,
    /// The origin of the marker in the body's frame. \[m\]
    pub u: Vec3,
    /// The axes of the marker in the body's frame, as columns.
    pub a: Mat3,
    /// The axes of the body in its pose in the file.
    pub stand: Mat3,
    /// The origin of the marker in the pose of the file, in global coordinates. \[m\]
    pub place: Vec3,
}

impl Marker {
    /// Returns axis k of the marker (0 for x) in the body's frame.
    pub fn axis(&self, k: usize) -> Vec3 {
        self.a.column(k)
    }

    /// Returns axis k of the marker (0 for x) in global components, in the pose of the file.
    pub fn global(&self, k: usize) -> Vec3 {
        self.stand * self.axis(k)
    }
}

/// Markers by their paths, such as `/Assembly1/Part1/Marker2`.
#[derive(Default)]
pub struct Markers(HashMap<String, Marker>);

impl Markers {
    /// Returns the markers I and J of a joint or a motion, or `None` if the joint or motion does
    /// not name both.
    ///
    /// Errors: no marker has the path.
    pub fn of(&self, of: &Tree<'_>) -> Result<Option<[Marker; 2]>, Mistake> {
        let (Ok(i), Ok(j)) = (of.value("MarkerI"), of.value("MarkerJ")) else { return Ok(None) };
        let named = |(path, line): (&str, usize)| {
            let known = self.0.get(path).copied();
            known.ok_or_else(|| Mistake::at(line, format!("no marker has the name `{path}`")))
        };
        Ok(Some([named(i)?, named(j)?]))
    }
}

/// A body that holds markers, the frame in it that they are given in, and where it stands.
#[derive(Clone, Copy)]
struct Own {
    body: SpatialBody,
    r: Vec3,
    a: Mat3,
    stand: Mat3,
    place: Vec3,
}

impl Own {
    /// The marker at a place of the frame, with these axes in it.
    fn marker(&self, r: Vec3, a: Mat3) -> Marker {
        let u = self.r + self.a * r;
        let a = self.a * a;
        Marker { body: self.body, u, a, stand: self.stand, place: self.place + self.stand * u }
    }
}

/// Position and rotation matrix of something.
fn frame(of: &Tree<'_>) -> Result<(Vec3, Mat3), Mistake> {
    let r = of.numbers::<3>("Position3D")?;
    let rows = of.matrix("RotationMatrix")?;
    let a = Mat3::from(rows);
    let off = a * a.transpose() - Mat3::identity();
    let worst = off.to_array().iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    if worst < ROUNDED {
        return Ok((Vec3::from(r), a));
    }
    let line = of.need("RotationMatrix")?.line;
    Err(Mistake::at(
        line,
        format!(
            "the matrix is not a rotation: the rows deviate from length 1 and right angles by {worst:.1e}"
        ),
    ))
}

impl Reading {
    /// Adds the ground, which is the assembly itself, and all parts.
    pub fn parts(&mut self, assembly: &Tree<'_>) -> Result<(), Mistake> {
        let path = self.root.clone();
        let ground = SpatialBody::from(self.mechanism.ground());
        let on = frame(assembly)?;
        let own =
            Own { body: ground, r: on.0, a: on.1, stand: Mat3::identity(), place: Vec3::zeros() };
        self.take(&path, assembly, own)?;
        self.shapes(assembly);
        for part in assembly.all("Parts") {
            self.part(part, &path, on)?;
        }
        Ok(())
    }

    /// Takes the markers of the reference points of a part, or of the assembly.
    fn take(&mut self, path: &str, of: &Tree<'_>, own: Own) -> Result<(), Mistake> {
        for point in of.all("RefPoints") {
            let (r, a) = frame(point)?;
            for marker in point.all("Markers") {
                let (u, axes) = frame(marker)?;
                let Ok((name, line)) = marker.value("Name") else {
                    self.leave(
                        marker,
                        "the marker has no name, so no joint can use the marker",
                        false,
                    );
                    continue;
                };
                let path = format!("{path}/{name}");
                if self.markers.0.insert(path.clone(), own.marker(r + a * u, a * axes)).is_some() {
                    return Err(Mistake::at(line, format!("two markers have the name `{path}`")));
                }
            }
        }
        Ok(())
    }

    fn part(&mut self, part: &Tree<'_>, path: &str, on: (Vec3, Mat3)) -> Result<(), Mistake> {
        if part.text != "Part" {
            self.leave(part, "the block is not a part", true);
            return Ok(());
        }
        let (mut name, line) = self.name_of(part);
        if name == "ground" {
            name = "ground part".to_string();
            let reason = format!("the ground has it; Kin reads this part as `{name}`");
            let left = LeftOut { line, name: "the name `ground`".into(), reason, matters: false };
            self.left_out.push(left);
        }
        let (r, a) = frame(part)?;
        let pose = SpatialPose::new(on.0 + on.1 * r, EulerParameters::from_rotation(on.1 * a));
        let body = self.mechanism.spatial(&name, pose).map_err(refused(line))?;
        let place = on.0 + on.1 * r;
        let own = Own { body, r: Vec3::zeros(), a: Mat3::identity(), stand: on.1 * a, place };
        // Joints name a part without a name by its empty name.
        let path = format!("{path}/{}", part.value("Name").map_or("", |(name, _)| name));
        self.take(&path, part, own)?;
        self.shapes(part);
        let Some(masses) = part.get("PrincipalMassMarker") else { return Ok(()) };
        let (centre, a) = frame(masses)?;
        if let Ok((name, _)) = masses.value("Name") {
            self.markers.0.entry(format!("{path}/{name}")).or_insert(own.marker(centre, a));
        }
        self.masses(masses, body, (centre, a))
    }

    /// J = A diag(J1, J2, J3) Aᵀ, A the principal axes.
    fn masses(
        &mut self,
        of: &Tree<'_>,
        body: SpatialBody,
        (centre, a): (Vec3, Mat3),
    ) -> Result<(), Mistake> {
        let [mass] = of.numbers::<1>("Mass")?;
        if mass == 0.0 {
            self.leave(of, "the mass is zero, so the part weighs nothing", false);
            return Ok(());
        }
        let [x, y, z] = of.numbers::<3>("MomentOfInertias")?;
        let principal = Mat3::from([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
        self.mechanism
            .mass(body, mass, centre, a * principal * a.transpose())
            .map_err(refused(of.line))
    }

    /// Curves that contacts run on matter; what a part looks like does not.
    fn shapes(&mut self, of: &Tree<'_>) {
        for (text, reason, matters) in [
            ("RefCurves", "Kin does not read curves", true),
            ("RefSurfaces", "Kin does not read surfaces", true),
            ("FeatureOrder", "Kin does not read shapes", false),
        ] {
            if let Some(shapes) = of.get(text).filter(|shapes| !shapes.inside.is_empty()) {
                self.leave(shapes, reason, matters);
            }
        }
    }
}
