//! Creates motions from rest to rest within limits: trapezoidal velocity and the S-curve.

use super::{Break, Law, LawFunction, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::{Interval, Series, piecewise};

impl Law {
    /// Returns a motion from rest to rest with trapezoidal velocity: constant acceleration,
    /// constant speed, constant deceleration.
    ///
    /// If the distance is short, the motion has no phase of constant speed. The law is 0 before x =
    /// 0 and equals the distance after the motion. The acceleration jumps at the ends of each
    /// phase. A negative distance gives the motion in the other direction.
    pub fn trapezoidal(
        distance: impl IntoNumber,
        speed: impl IntoNumber,
        acceleration: impl IntoNumber,
    ) -> Law {
        Law::hanging(|to| {
            let distance = to.number("distance", distance);
            let speed = to.number("speed", speed);
            Move::new(distance, speed, to.number("acceleration", acceleration), None)
        })
    }

    /// Returns a motion from rest to rest in seven pieces of constant jerk, limited in speed,
    /// acceleration and jerk.
    ///
    /// If the distance is short, the motion has fewer pieces. The law is 0 before x = 0 and equals
    /// the distance after the motion. The jerk jumps at the ends of each piece. Source: Biagiotti
    /// and Melchiorri, *Trajectory Planning*, section 3.4.
    pub fn s_curve(
        distance: impl IntoNumber,
        speed: impl IntoNumber,
        acceleration: impl IntoNumber,
        jerk: impl IntoNumber,
    ) -> Law {
        Law::hanging(|to| {
            let distance = to.number("distance", distance);
            let speed = to.number("speed", speed);
            let acceleration = to.number("acceleration", acceleration);
            let jerk = to.number("jerk", jerk);
            Move::new(distance, speed, acceleration, Some(jerk))
        })
    }
}

/// A motion in pieces of constant jerk, or of constant acceleration if the jerk has no limit.
#[derive(Clone)]
struct Move {
    distance: f64,
    speed: f64,
    acceleration: f64,
    /// The limit of the jerk. With `None` the acceleration jumps.
    jerk: Option<f64>,
    pieces: Vec<Piece>,
    /// The argument at which the motion comes to rest.
    end: f64,
}

/// A cubic that begins at x = start: s + v τ + a τ²/2 + j τ³/6 with τ = x − start.
#[derive(Clone, Copy)]
struct Piece {
    start: f64,
    s: f64,
    v: f64,
    a: f64,
    j: f64,
}

impl Move {
    fn new(distance: f64, speed: f64, acceleration: f64, jerk: Option<f64>) -> Self {
        let mut motion = Move { distance, speed, acceleration, jerk, pieces: Vec::new(), end: 0.0 };
        if motion.is_sound() {
            match jerk {
                None => motion.trapezoid(),
                Some(jerk) => motion.seven_pieces(jerk),
            }
        }
        motion
    }

    fn is_sound(&self) -> bool {
        let above_zero = |x: f64| x.is_finite() && x > 0.0;
        self.distance.is_finite()
            && above_zero(self.speed)
            && above_zero(self.acceleration)
            && self.jerk.is_none_or(above_zero)
    }

    fn trapezoid(&mut self) {
        let d = self.distance.abs();
        let v = self.speed;
        let a = self.acceleration;
        let (ramp, cruise) =
            if d * a > v * v { (v / a, d / v - v / a) } else { ((d / a).sqrt(), 0.0) };
        let sign = self.distance.signum();
        self.fill(&[(ramp, sign * a, 0.0), (cruise, 0.0, 0.0), (ramp, -sign * a, 0.0)]);
    }

    fn seven_pieces(&mut self, jerk: f64) {
        let d = self.distance.abs();
        let v = self.speed;
        let a = self.acceleration;
        // The ramp to full speed has a phase of jerk, t_j long, at each end.
        let (mut t_j, mut ramp) = if v * jerk >= a * a {
            (a / jerk, a / jerk + v / a)
        } else {
            ((v / jerk).sqrt(), 2.0 * (v / jerk).sqrt())
        };
        let cruise = d / v - ramp;
        if cruise < 0.0 {
            (t_j, ramp) = if d >= 2.0 * a.powi(3) / (jerk * jerk) {
                let t_j = a / jerk;
                (t_j, 0.5 * t_j + (0.25 * t_j * t_j + d / a).sqrt())
            } else {
                let t_j = (0.5 * d / jerk).cbrt();
                (t_j, 2.0 * t_j)
            };
        }
        let j = self.distance.signum() * jerk;
        let flat = ramp - 2.0 * t_j;
        let up = [(t_j, 0.0, j), (flat, 0.0, 0.0), (t_j, 0.0, -j)];
        let down = [(t_j, 0.0, -j), (flat, 0.0, 0.0), (t_j, 0.0, j)];
        self.fill(&[up.as_slice(), &[(cruise, 0.0, 0.0)], &down].concat());
    }

    /// Appends pieces from triples (duration, jump of acceleration if the jerk has no limit, jerk).
    /// It omits pieces without duration.
    fn fill(&mut self, parts: &[(f64, f64, f64)]) {
        let mut next = Piece { start: 0.0, s: 0.0, v: 0.0, a: 0.0, j: 0.0 };
        for &(duration, a, j) in parts.iter().filter(|part| part.0 > 0.0) {
            let piece = Piece { a: if self.jerk.is_none() { a } else { next.a }, j, ..next };
            // Merges two neighbouring pieces of the same jerk.
            if self.jerk.is_none() || self.pieces.last().is_none_or(|last| last.j != j) {
                self.pieces.push(piece);
            }
            let [s, v, a, _] = piece.jet(piece.start + duration);
            next = Piece { start: piece.start + duration, s, v, a, j: 0.0 };
        }
        self.end = next.start;
    }
}

impl Piece {
    fn jet(&self, x: f64) -> [f64; 4] {
        let t = x - self.start;
        let Piece { s, v, a, j, .. } = *self;
        [s + t * (v + t * (a / 2.0 + t * j / 6.0)), v + t * (a + t * j / 2.0), a + t * j, j]
    }
}

impl LawFunction for Move {
    fn jet(&self, x: f64) -> [f64; 4] {
        if x >= self.end {
            return [self.distance, 0.0, 0.0, 0.0];
        }
        let piece = self.pieces.iter().rev().find(|piece| x >= piece.start);
        piece.map_or([0.0; 4], |piece| piece.jet(x))
    }

    fn kind(&self) -> &str {
        if self.jerk.is_some() { "s_curve" } else { "trapezoidal" }
    }

    fn description(&self) -> &str {
        match self.jerk {
            Some(_) => {
                "S-curve from rest to rest over a distance, with limits of speed, acceleration and jerk. The curve has seven pieces of constant jerk."
            }
            None => {
                "Trapezoidal velocity from rest to rest over a distance: the acceleration is constant until the speed reaches its limit."
            }
        }
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let seams: Vec<f64> =
            self.pieces.iter().map(|piece| piece.start).chain([self.end]).collect();
        piecewise(x, &seams, &|k, x| {
            let Some(before) = k.checked_sub(1) else { return Some(x.times(0.0)) };
            let Some(piece) = self.pieces.get(before) else {
                return Some(x.times(0.0).plus(self.distance));
            };
            // The piece begins where the piece before ends, except for rounding. A piece at rest or
            // without acceleration begins exactly.
            let near = |x: f64, size: f64| {
                Series::constant(Interval::near(x, if x == 0.0 { 0.0 } else { size }))
            };
            let s = near(piece.s, self.distance);
            let v = near(piece.v, self.speed);
            let a = near(piece.a, self.acceleration);
            let t = x.plus(-piece.start);
            Some(
                s + t
                    * (v + t
                        * (a.times(0.5)
                            + t * Series::constant(Interval::from(piece.j) / Interval::from(6.0)))),
            )
        })
    }

    fn fourth(&self, _: f64) -> f64 {
        0.0
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        let order = if self.jerk.is_some() { 3 } else { 2 };
        let places = self
            .pieces
            .iter()
            .map(|piece| piece.start)
            .chain((!self.pieces.is_empty()).then_some(self.end));
        places.filter(|x| (from..=to).contains(x)).map(|x| Break { x, order }).collect()
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn refusal(&self) -> Option<String> {
        (!self.is_sound()).then(|| {
            format!(
                "{}: speed, acceleration and jerk must be above zero; give the sign of the motion to the distance",
                self.kind()
            )
        })
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("distance", self.distance);
        visit("speed", self.speed);
        visit("acceleration", self.acceleration);
        if let Some(jerk) = self.jerk {
            visit("jerk", jerk);
        }
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let changed = |[d, v, a]: [f64; 3], j| Some(Law::new(Move::new(d, v, a, j)));
        match (name, self.jerk) {
            ("distance", j) => changed([value, self.speed, self.acceleration], j),
            ("speed", j) => changed([self.distance, value, self.acceleration], j),
            ("acceleration", j) => changed([self.distance, self.speed, value], j),
            ("jerk", Some(_)) => {
                changed([self.distance, self.speed, self.acceleration], Some(value))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
