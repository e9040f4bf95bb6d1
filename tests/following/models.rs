//! Mechanisms with closed forms.

use kin::prelude::*;

/// The lengths of a four-bar: the link that is driven and the two others, as they follow one
/// another round the loop, and the ground.
#[derive(Clone, Copy, Debug)]
pub struct FourBar {
    pub driven: f64,
    pub next: f64,
    pub last: f64,
    pub ground: f64,
    /// True if the driven link is the coupler: the two others are cranks then.
    pub by_coupler: bool,
}

impl FourBar {
    /// How far the two links that follow have to reach.
    fn span(&self, angle: f64) -> f64 {
        (self.driven * angle.cos() - self.ground).hypot(self.driven * angle.sin())
    }

    /// The angles of the two other links where the driven one stands at `angle`, on the side on
    /// which the loop turns left (1.0) or right. (The order of links round the loop does not matter
    /// to angles: that of a driven coupler is the same.)
    pub fn angles(&self, angle: f64, side: f64) -> Option<[f64; 2]> {
        let FourBar { driven, next, last, ground, .. } = *self;
        let x = ground - driven * angle.cos();
        let y = -driven * angle.sin();
        let span = x.hypot(y);
        let cosine = (next * next + span * span - last * last) / (2.0 * next * span);
        (cosine.abs() <= 1.0).then(|| {
            let first = y.atan2(x) + side * cosine.acos();
            let px = driven * angle.cos() + next * first.cos();
            let py = driven * angle.sin() + next * first.sin();
            [first, py.atan2(px - ground)]
        })
    }

    /// The next angle beyond `from` at which the other two links are in line, if the driven link
    /// turns left (1.0) or right (−1.0).
    pub fn toggle(&self, from: f64, sense: f64) -> Option<f64> {
        let FourBar { driven, next, last, ground, .. } = *self;
        let mut all = Vec::new();
        for span in [next + last, (next - last).abs()] {
            let cosine =
                (driven * driven + ground * ground - span * span) / (2.0 * driven * ground);
            if cosine.abs() <= 1.0 {
                all.extend([cosine.acos(), -cosine.acos()]);
            }
        }
        let ahead = |angle: f64| (sense * (angle - from)).rem_euclid(TAU);
        all.into_iter().map(ahead).min_by(f64::total_cmp).map(|ahead| from + sense * ahead)
    }

    /// How near the driven link's turn comes to a toggle, as a share of the links; below zero where
    /// it reaches one.
    pub fn clearance(&self) -> f64 {
        let spans = [self.span(0.0), self.span(PI)];
        let least = spans[0].min(spans[1]);
        let most = spans[0].max(spans[1]);
        (self.next + self.last - most).min(least - (self.next - self.last).abs())
            / (self.next + self.last)
    }

    /// The mechanism in absolute coordinates, driven by the angle of the first link, by the law,
    /// and assembled on the side.
    pub fn system(
        &self,
        law: Law,
        start: f64,
        side: f64,
    ) -> kin::Result<(System, [PlanarBody; 3])> {
        let lengths = if self.by_coupler {
            [self.next, self.driven, self.last]
        } else {
            [self.driven, self.next, self.last]
        };
        let mut m = Mechanism::new("four-bar");
        let [a, b, c] = [
            m.link("crank", lengths[0])?,
            m.link("coupler", lengths[1])?,
            m.link("rocker", lengths[2])?,
        ];
        m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start()))?;
        m.add("A", revolute(a, b, a.end(), b.start()))?;
        m.add("B", revolute(b, c, b.end(), c.end()))?;
        m.add("C", revolute(c, Ground, c.start(), vec2(self.ground, 0.0)))?;
        m.add("motor", drive_angle(if self.by_coupler { b } else { a }, law))?;
        m.set_initial(&self.pose(start, side).unwrap_or([0.0; 9]))?;
        Ok((m.build()?, [a.into(), b.into(), c.into()]))
    }

    /// q of crank, coupler and rocker at an angle of the driven one.
    pub fn pose(&self, angle: f64, side: f64) -> Option<[f64; 9]> {
        let FourBar { driven, next, last, ground, by_coupler } = *self;
        let [first, theta4] = self.angles(angle, side)?;
        let one = (driven, angle);
        let two = (next, first);
        let [(a, theta2), (b, theta3)] = if by_coupler { [two, one] } else { [one, two] };
        let half =
            |length: f64, angle: f64| (0.5 * length * angle.cos(), 0.5 * length * angle.sin());
        let a = half(a, theta2);
        let b = half(b, theta3);
        let c = half(last, theta4);
        Some([
            a.0,
            a.1,
            theta2,
            2.0 * a.0 + b.0,
            2.0 * a.1 + b.1,
            theta3,
            ground + c.0,
            c.1,
            theta4,
        ])
    }

    /// How far q is from the pose on that side, angles up to whole turns.
    pub fn error(&self, q: &[f64], side: f64) -> f64 {
        let Some(pose) = self.pose(q[if self.by_coupler { 5 } else { 2 }], side) else {
            return f64::INFINITY;
        };
        let turn = |k: usize, d: f64| if k % 3 == 2 { (d + PI).rem_euclid(TAU) - PI } else { d };
        q.iter()
            .zip(pose)
            .enumerate()
            .fold(0.0, |most, (k, (q, pose))| turn(k, q - pose).abs().max(most))
    }
}

/// A slider-crank with its slider on the x axis, driven by the crank's angle.
pub fn slider_crank(crank: f64, rod: f64, law: Law, start: f64) -> kin::Result<System> {
    let mut m = Mechanism::new("slider-crank");
    let a = m.link("crank", crank)?;
    let b = m.link("rod", rod)?;
    let slider = m.planar("slider", pose(0.0, 0.0, 0.0))?;
    m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start()))?;
    m.add("A", revolute(a, b, a.end(), b.start()))?;
    m.add("B", revolute(b, slider, b.end(), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(slider, Ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0))?;
    m.add("motor", drive_angle(a, law))?;
    let x = crank * start.cos();
    let y = crank * start.sin();
    let phi = (-y / rod).asin();
    let u = 0.5 * rod * phi.cos();
    let v = 0.5 * rod * phi.sin();
    m.set_initial(&[0.5 * x, 0.5 * y, start, x + u, y + v, phi, x + 2.0 * u, 0.0, 0.0])?;
    m.build()
}
