//! Parts with their masses, and markers by their paths.

use std::collections::HashMap;

use kin::{EulerParameters, Mat3, SpatialBody, SpatialPose, Vec3};

use super::{Reading, refused};
use crate::imported::Mistake;
use crate::tree::Tree;

/// Rows of a matrix may miss length 1 and right angles by this: files are written by hand and rounded.
const ROUNDED: f64 = 1e-4;

/// A frame on a body.
#[derive(Clone, Copy)]
pub struct Marker {
    pub body: SpatialBody,
    /// Its origin in the body's frame.   \[m\]
    pub u: Vec3,
    /// Its axes in the body's frame, as columns.
    pub a: Mat3,
    /// The axes of the body where it stands in the file.
    pub stand: Mat3,
    /// The marker's origin there, in global coordinates.   \[m\]
    pub place: Vec3,
}

impl Marker {
    /// One of its axes, 0 for x, in the body's frame.
    pub fn axis(&self, k: usize) -> Vec3 {
        self.a.column(k)
    }

    /// The same where the part stands in the file.
    pub fn global(&self, k: usize) -> Vec3 {
        self.stand * self.axis(k)
    }
}

/// Markers by their paths, such as `/Assembly1/Part1/Marker2`.
#[derive(Default)]
pub struct Markers(HashMap<String, Marker>);

impl Markers {
    /// The marker that a line of this text names.
    pub fn named(&self, of: &Tree<'_>, text: &str) -> Result<Marker, Mistake> {
        let (path, line) = of.value(text)?;
        self.0.get(path).copied().ok_or_else(|| Mistake::at(line, format!("there is no marker `{path}`")))
    }

    /// Takes the markers of the reference points of a part, or of the assembly.
    fn take(&mut self, path: &str, of: &Tree<'_>, own: Own) -> Result<(), Mistake> {
        for point in of.all("RefPoints") {
            let (r, a) = frame(point)?;
            for marker in point.all("Markers") {
                let (u, axes) = frame(marker)?;
                let (name, line) = marker.value("Name")?;
                let (u, a) = (own.r + own.a * (r + a * u), own.a * a * axes);
                let place = own.place + own.stand * u;
                let found = Marker { body: own.body, u, a, stand: own.stand, place };
                if self.0.insert(format!("{path}/{name}"), found).is_some() {
                    return Err(Mistake::at(line, format!("there are two markers `{path}/{name}`")));
                }
            }
        }
        Ok(())
    }
}

/// A body that holds markers, the frame in it that they are given in, and where it stands.
struct Own {
    body: SpatialBody,
    r: Vec3,
    a: Mat3,
    stand: Mat3,
    place: Vec3,
}

/// Position and rotation matrix of something.
fn frame(of: &Tree<'_>) -> Result<(Vec3, Mat3), Mistake> {
    let (r, rows) = (of.numbers::<3>("Position3D")?, of.matrix("RotationMatrix")?);
    let a = Mat3::from(rows);
    let off = a * a.transpose() - Mat3::identity();
    let worst = off.to_array().iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    if worst < ROUNDED {
        return Ok((Vec3::from(r), a));
    }
    let line = of.need("RotationMatrix")?.line;
    Err(Mistake::at(
        line,
        format!("this is no rotation matrix: its rows miss length 1 and right angles by {worst:.1e}"),
    ))
}

impl Reading {
    /// The ground, which is the assembly itself, and all parts.
    pub fn parts(&mut self, assembly: &Tree<'_>, name: &str) -> Result<(), Mistake> {
        let path = format!("/{name}");
        let ground = SpatialBody::from(self.mechanism.ground());
        let on = frame(assembly)?;
        let own = Own { body: ground, r: on.0, a: on.1, stand: Mat3::identity(), place: Vec3::zeros() };
        self.markers.take(&path, assembly, own)?;
        self.shapes(assembly);
        for part in assembly.all("Parts") {
            self.part(part, &path, on)?;
        }
        Ok(())
    }

    fn part(&mut self, part: &Tree<'_>, path: &str, on: (Vec3, Mat3)) -> Result<(), Mistake> {
        if part.text != "Part" {
            self.leave(part, "it is no part", true);
            return Ok(());
        }
        let ((name, line), (r, a)) = (part.value("Name")?, frame(part)?);
        let pose = SpatialPose::new(on.0 + on.1 * r, EulerParameters::from_rotation(on.1 * a));
        let body = self.mechanism.spatial(name, pose).map_err(refused(line))?;
        let place = on.0 + on.1 * r;
        let own = Own { body, r: Vec3::zeros(), a: Mat3::identity(), stand: on.1 * a, place };
        self.markers.take(&format!("{path}/{name}"), part, own)?;
        self.shapes(part);
        match part.get("PrincipalMassMarker") {
            Some(masses) => self.masses(masses, body),
            None => Ok(()),
        }
    }

    /// J = A diag(J1, J2, J3) Aᵀ, A the principal axes.
    fn masses(&mut self, of: &Tree<'_>, body: SpatialBody) -> Result<(), Mistake> {
        let ([mass], (centre, a)) = (of.numbers::<1>("Mass")?, frame(of)?);
        if mass == 0.0 {
            self.leave(of, "its mass is zero: the part weighs nothing", false);
            return Ok(());
        }
        let [x, y, z] = of.numbers::<3>("MomentOfInertias")?;
        let principal = Mat3::from([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
        self.mechanism.mass(body, mass, centre, a * principal * a.transpose()).map_err(refused(of.line))
    }

    /// Curves that contacts run on matter; what a part looks like does not.
    fn shapes(&mut self, of: &Tree<'_>) {
        for (text, reason, matters) in [
            ("RefCurves", "curves are not read", true),
            ("RefSurfaces", "surfaces are not read", true),
            ("FeatureOrder", "shapes are not read", false),
        ] {
            if let Some(shapes) = of.get(text).filter(|shapes| !shapes.inside.is_empty()) {
                self.leave(shapes, reason, matters);
            }
        }
    }
}
