//! Reads couplings of rotations and displacements: gears, screws, racks.

use std::f64::consts::TAU;

use kin::joints::spatial;
use kin::{Axis, Vec3};

use super::parts::Marker;
use super::{Reading, refused};
use crate::imported::Mistake;
use crate::tree::Tree;

/// Why couplings are left out.
const NO_FRAME: &str = "no body holds the axes of both wheels by a revolute or cylindrical joint";
const NO_PITCH: &str = "the pitch of the screw is zero";
const NO_RADIUS: &str = "a pitch radius is zero";

/// The turn of marker J in I about z of I, and its way along x, y and z of I, where the parts
/// stand.
fn stands(i: &Marker, j: &Marker) -> (f64, Vec3) {
    let x = j.global(0);
    let d = j.place - i.place;
    let turn = x.dot(i.global(1)).atan2(x.dot(i.global(0)));
    (turn, Vec3::new(d.dot(i.global(0)), d.dot(i.global(1)), d.dot(i.global(2))))
}

impl Reading {
    /// Pair of wheels by their radii, in the frame that holds both of their axes.
    pub(super) fn gear(
        &mut self,
        of: &Tree<'_>,
        name: &str,
        line: usize,
        [i, j]: [Marker; 2],
    ) -> Result<(), Mistake> {
        let [r_i, r_j] = [of.numbers::<1>("radiusI")?[0], of.numbers::<1>("radiusJ")?[0]];
        let held = |wheel: &Marker| -> Vec<(Marker, Marker)> {
            let turning = self
                .joints
                .iter()
                .filter(|j| ["RevoluteJoint", "CylindricalJoint"].contains(&j.kind.as_str()));
            let ways = turning.flat_map(|joint| [(joint.i, joint.j), (joint.j, joint.i)]);
            ways.filter(|(own, _)| own.body == wheel.body).collect()
        };
        let of_i = held(&i);
        let of_j = held(&j);
        let both = of_i.iter().flat_map(|a| of_j.iter().map(move |b| (a, b)));
        let Some(((w_i, f_i), (w_j, f_j))) =
            both.into_iter().find(|((_, a), (_, b))| a.body == b.body)
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
        let [h_i, a_i] = axis(w_i, f_i);
        let [h_j, a_j] = axis(w_j, f_j);
        let s = self.mechanism.length(&format!("{name}.s"), 0.0).map_err(refused(line))?;
        let gear =
            spatial::gear_by_radii(i.body, j.body, frame, s, h_i, h_j, a_i, a_j, r_i, r_j, 0.0);
        self.add(name, line, gear)
    }

    /// The thread of a screw: 2π z − p θ stays as it is where the parts stand, z the way and θ the
    /// turn of J along and about z of I, p the pitch.
    pub(super) fn screw(
        &mut self,
        of: &Tree<'_>,
        name: &str,
        line: usize,
        [i, j]: [Marker; 2],
    ) -> Result<(), Mistake> {
        let [pitch] = of.get("pitch").map_or(Ok([0.0]), |_| of.numbers("pitch"))?;
        if pitch == 0.0 {
            self.leave(of, NO_PITCH, true);
            return Ok(());
        }
        let (turn, way) = stands(&i, &j);
        let h = self.along(&i, &j);
        let x = j.axis(0);
        let (sin, cos) = (TAU * way.z / pitch - turn).sin_cos();
        let h_j = Axis::new(h, x * cos + h.cross(x) * sin);
        let thread =
            spatial::thread(j.body, i.body, j.u, i.u, h_j, Axis::new(i.axis(2), i.axis(0)), pitch);
        self.add(name, line, thread)
    }

    /// Rack and pinion: x + r θ stays as it is where the parts stand, x the way of J along x of I,
    /// which is the rack, and θ its turn about z of I.
    pub(super) fn rack(
        &mut self,
        of: &Tree<'_>,
        name: &str,
        line: usize,
        [i, j]: [Marker; 2],
    ) -> Result<(), Mistake> {
        let [radius] = of.get("pitchRadius").map_or(Ok([0.0]), |_| of.numbers("pitchRadius"))?;
        if radius == 0.0 {
            self.leave(of, NO_RADIUS, true);
            return Ok(());
        }
        let (turn, way) = stands(&i, &j);
        let h_j = Axis::new(self.along(&i, &j), j.axis(0));
        let h_i = Axis::new(i.axis(2), i.axis(0));
        let phase = turn + way.x / radius;
        self.add(
            name,
            line,
            spatial::rack_and_pinion(j.body, i.body, j.u, i.u, h_j, h_i, radius, phase),
        )
    }
}
