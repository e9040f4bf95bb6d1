//! Reads motions: rotations, displacements and whole poses by laws as text.

use kin::joints::drivers::spatial as drivers;
use kin::{Axis, EulerParameters, Law, Mat3, Vec3};

use super::Reading;
use super::joints::NO_JOINT;
use super::parts::Marker;
use crate::formula::Formula;
use crate::imported::Mistake;
use crate::tree::Tree;

impl Reading {
    /// Adds a motion to the mechanism, as a driver.
    pub fn motion(&mut self, of: &Tree<'_>) -> Result<(), Mistake> {
        if !["RotationalMotion", "TranslationalMotion", "GeneralMotion"].contains(&of.text) {
            self.leave(of, "Kin does not read motions of this kind", true);
            return Ok(());
        }
        let Some([i, j]) = self.markers_of(of)? else {
            self.leave(of, NO_JOINT, true);
            return Ok(());
        };
        if let Some(reason) = self.on_one_body(&i, &j) {
            self.leave(of, &reason, true);
            return Ok(());
        }
        match of.text {
            "RotationalMotion" => {
                let law = law(of, "RotationZ")?;
                let h_i = Axis::new(i.axis(2), i.axis(0));
                let h_j = Axis::new(self.along(&i, &j), j.axis(0));
                let (name, line) = self.name_of(of);
                self.add(&name, line, drivers::drive_turn(j.body, i.body, h_j, h_i, law))
            }
            "TranslationalMotion" => {
                let law = law(of, "TranslationZ")?;
                let (name, line) = self.name_of(of);
                self.add(
                    &name,
                    line,
                    drivers::drive_slide(j.body, i.body, j.u, i.u, i.axis(2), law),
                )
            }
            _ => self.general(of, [i, j]),
        }
    }

    /// The markers of the joint that a motion moves, or its own, as in OndselSolver where
    /// `MotionJoint` says nothing; `None` where it has neither.
    fn markers_of(&self, of: &Tree<'_>) -> Result<Option<[Marker; 2]>, Mistake> {
        match of.value("MotionJoint") {
            Ok(_) => Ok(self.joint_of(of).map(|joint| [joint.i, joint.j])),
            Err(_) => self.markers.of(of),
        }
    }

    /// Six laws: the way of J as I sees it, and three turns in an order.
    fn general(&mut self, of: &Tree<'_>, [i, j]: [Marker; 2]) -> Result<(), Mistake> {
        let way = [law(of, "rIJI1")?, law(of, "rIJI2")?, law(of, "rIJI3")?];
        let turns = [law(of, "angIJJ1")?, law(of, "angIJJ2")?, law(of, "angIJJ3")?];
        let order = of.numbers::<3>("RotationOrder")?;
        let Some((frame, sign, places)) = ordered(order) else {
            self.leave(
                of,
                "Kin does not read a sequence of rotations that has one axis twice",
                true,
            );
            return Ok(());
        };
        // The same motion between frames whose z, y and x are the first, second and third axis.
        let p = |marker: &Marker| EulerParameters::from_rotation(marker.a * frame);
        let [yaw, pitch, roll] = turns;
        let [x, y, z] = places.map(|(k, sign)| scaled(&way[k], sign));
        let driver = drivers::drive_motion(
            j.body,
            i.body,
            j.u,
            i.u,
            p(&j),
            p(&i),
            x,
            y,
            z,
            yaw,
            pitch,
            scaled(&roll, sign),
        );
        let (name, line) = self.name_of(of);
        self.add(&name, line, driver)
    }
}

fn scaled(law: &Law, sign: f64) -> Law {
    if sign < 0.0 { law.clone() * sign } else { law.clone() }
}

/// For turns about three axes, one after the other as they move along: the frame whose z, y and x
/// these are, the sign of x, and which component of a way its x, y and z are. `None` where one axis
/// comes twice.
type Ordered = (Mat3, f64, [(usize, f64); 3]);

fn ordered(order: [f64; 3]) -> Option<Ordered> {
    let axis = |number: f64| [1.0, 2.0, 3.0].iter().position(|known| *known == number);
    let [first, second, third] = [axis(order[0])?, axis(order[1])?, axis(order[2])?];
    if first == second || second == third || first == third {
        return None;
    }
    let unit = |k: usize| Vec3::from(std::array::from_fn(|m| if m == k { 1.0 } else { 0.0 }));
    let z = unit(first);
    let y = unit(second);
    let x = y.cross(z);
    let sign = x.dot(unit(third));
    Some((Mat3::from_columns([x, y, z]), sign, [(third, sign), (second, 1.0), (first, 1.0)]))
}

/// The law in the line of that text.
fn law(of: &Tree<'_>, text: &str) -> Result<Law, Mistake> {
    let (formula, line) = of.value(text)?;
    let law = Formula::read(formula).and_then(|formula| formula.law());
    law.map_err(|reason| Mistake::at(line, format!("`{text}`: {reason}")))
}
