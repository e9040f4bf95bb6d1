//! A parallel ankle with two motors, with its closed form.

use kin::prelude::*;

/// A parallel ankle: two cranks on the shank move the foot by rods. The foot turns by a pitch
/// about y and a roll about x. Lengths in m.
#[derive(Clone, Copy, Debug)]
pub struct Ankle {
    pub arm: f64,
    pub rod: f64,
    /// The axis of the cranks, above the ankle and before the heel.
    pub axis: [f64; 2],
    /// The balls on the foot: behind the ankle and to both sides.
    pub heel: [f64; 2],
}

/// One that is symmetric at rest.
pub const ANKLE: Ankle = Ankle { arm: 0.04, rod: 0.15, axis: [-0.01, 0.15], heel: [0.05, 0.03] };

impl Ankle {
    /// The system with both motors at zero.
    pub fn system(&self) -> kin::Result<System> {
        self.mechanism()?.build()
    }

    /// The mechanism with both motors at zero.
    pub fn mechanism(&self) -> kin::Result<Mechanism> {
        let Ankle { arm, rod, axis: [x, z], heel: [back, side] } = *self;
        let mut m = Mechanism::new("ankle");
        let zero = vec3(0.0, 0.0, 0.0);
        let along_y = vec3(0.0, 1.0, 0.0);
        let along_x = vec3(1.0, 0.0, 0.0);
        let cross = m.spatial("cross", SpatialPose::at(zero))?;
        let foot = m.spatial("foot", SpatialPose::at(zero))?;
        m.add("pitch", spatial::revolute(cross, Ground, zero, zero, along_y, along_y))?;
        let inertia = Mat3::from_rows([[2e-3, 0.0, 0.0], [0.0, 4e-3, 0.0], [0.0, 0.0, 5e-3]]);
        m.mass(foot, 1.1, vec3(0.03, 0.002, -0.05), inertia)?;
        m.gravity(vec3(0.0, 0.0, -9.81));
        m.add("roll", spatial::revolute(foot, cross, zero, zero, along_x, along_x))?;
        for (name, y) in [("left", side), ("right", -side)] {
            let at = vec3(x, y, z);
            let crank = m.spatial(&format!("{name} crank"), SpatialPose::at(at))?;
            let joint = spatial::revolute(crank, Ground, zero, at, along_y, along_y);
            m.add(&format!("{name} axis"), joint)?;
            let ball = vec3(-back, y, 0.0);
            let link = spatial::distance(crank, foot, vec3(-arm, 0.0, 0.0), ball, rod);
            m.add(&format!("{name} rod"), link)?;
            let motor = spatial::drive_turn(crank, Ground, along_y, along_y, Law::constant(0.0));
            m.add(&format!("{name} motor"), motor)?;
        }
        Ok(m)
    }

    /// The angles of both motors at a pitch and a roll, on the branch at rest.
    pub fn motors(&self, pitch: f64, roll: f64) -> Option<[f64; 2]> {
        let Ankle { arm, rod, .. } = *self;
        let [left, right] = [1.0, -1.0].map(|side| {
            let d = self.ball(side, pitch, roll)[0] - self.middle(side);
            let level = (arm * arm + d.dot(d) - rod * rod) / (2.0 * arm);
            let cosine = level / d.x.hypot(d.z);
            (cosine.abs() <= 1.0).then(|| d.z.atan2(-d.x) + cosine.acos())
        });
        Some([left?, right?])
    }

    /// ∂(left, right motor) / ∂(pitch, roll) there.
    pub fn slopes(&self, pitch: f64, roll: f64) -> Option<[[f64; 2]; 2]> {
        let motors = self.motors(pitch, roll)?;
        Some(std::array::from_fn(|k| {
            let side = [1.0, -1.0][k];
            let angle = motors[k];
            let [ball, by_pitch, by_roll] = self.ball(side, pitch, roll);
            let end = self.middle(side) + self.arm * vec3(-angle.cos(), 0.0, angle.sin());
            let turn = self.arm * vec3(angle.sin(), 0.0, angle.cos());
            let rod = end - ball;
            [by_pitch, by_roll].map(|slope| rod.dot(slope) / rod.dot(turn))
        }))
    }

    fn middle(&self, side: f64) -> Vec3 {
        vec3(self.axis[0], side * self.heel[1], self.axis[1])
    }

    /// The ball on the foot, with its derivatives by pitch and by roll.
    fn ball(&self, side: f64, pitch: f64, roll: f64) -> [Vec3; 3] {
        let [back, half] = self.heel;
        let rolled = vec3(-back, side * half * roll.cos(), side * half * roll.sin());
        let by_roll = vec3(0.0, -side * half * roll.sin(), side * half * roll.cos());
        let (sin, cos) = pitch.sin_cos();
        let turned = |v: Vec3| vec3(cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x);
        let by_pitch = vec3(cos * rolled.z - sin * rolled.x, 0.0, -cos * rolled.x - sin * rolled.z);
        [turned(rolled), by_pitch, turned(by_roll)]
    }
}
