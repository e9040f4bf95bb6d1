//! Couplings of turns and slides. Angles of planar bodies are never wrapped, so any number of turns
//! is counted.

use super::terms::{self, TERMS};
use crate::model::coordinates::{Coordinate, Ground};
use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Pair of gears on an arm: r_i (θ_i − θ_arm − φ) + r_j (θ_j − θ_arm) = 0.      \[m\]
///
/// Removes 1 freedom. `i`, `j`: the wheels, whose axles sit on `arm` (the ground for axles that
/// stand still); `r_i`, `r_j`: their pitch radii; `phase`: φ, the angle of i beside the arm when j
/// is in line with it. Norton, *Design of Machinery*, ch. 9.
///
/// Signs: seen from the arm the wheels turn against each other; all angles are counter-clockwise
/// positive.
#[constraint]
#[require(r_i > 0.0 && r_j > 0.0, "pitch radii are above zero")]
pub fn gear(i: Planar, j: Planar, arm: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - arm.theta - phase) + r_j * (j.theta - arm.theta)
}

/// Gear in a ring on an arm: r_i (θ_i − θ_arm − φ) − r_j (θ_j − θ_arm) = 0.      \[m\]
///
/// Removes 1 freedom. `i`: the wheel with pitch radius `r_i`; `j`: the ring with inner teeth, pitch
/// radius `r_j`; `arm`, `phase`: as for [`gear`](fn@gear). Norton, ch. 9.
///
/// Signs: seen from the arm wheel and ring turn the same way; all angles are counter-clockwise
/// positive.
#[constraint]
#[require(r_i > 0.0 && r_j > r_i, "the ring's pitch radius is above the wheel's, and both are above zero")]
pub fn internal_gear(i: Planar, j: Planar, arm: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - arm.theta - phase) - r_j * (j.theta - arm.theta)
}

/// Belt or chain over two pulleys: r_i (θ_i − θ_frame − φ) − r_j (θ_j − θ_frame) = 0.      \[m\]
///
/// Removes 1 freedom. `i`, `j`: the pulleys with axles on `frame`; `r_i`, `r_j`: their pitch radii,
/// one below zero for a crossed belt; `phase`: as for [`gear`](fn@gear). The belt neither slips nor
/// stretches. Norton, ch. 9.
///
/// Signs: seen from the frame an open belt turns both pulleys the same way, a crossed one against
/// each other; all angles are counter-clockwise positive.
#[constraint]
#[require(r_i != 0.0 && r_j != 0.0, "a pulley needs a radius")]
pub fn belt(i: Planar, j: Planar, frame: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - frame.theta - phase) - r_j * (j.theta - frame.theta)
}

/// Rack and pinion: h_j · (s − ū_j) + r (θ_i − θ_j − φ) = 0, s the pinion's centre as the rack sees
/// it.
///    \[m\]
///
/// Removes 1 freedom. `i`: the pinion, centre `u_i`, pitch radius `radius`: r; `j`: the rack, a
/// point `u_j` and the direction `h_j` of its pitch line, of any length; `phase`: φ, the angle of
/// the pinion in the rack when its centre stands over `u_j`. Norton, ch. 9. Measures: `slide`, the
/// way of the centre along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the pinion is to the left of h_j (a negative radius: to its right). As it goes along h_j
/// in the rack it turns clockwise; a pinion that turns counter-clockwise in place sends the rack
/// along h_j. The angle is counter-clockwise positive.
#[constraint]
#[require(radius != 0.0, "a pinion needs a radius")]
#[require(h_j.norm() > 0.0, "the rack needs a direction with a length above zero")]
#[measure(slide = h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm(), "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn rack_and_pinion(
    i: Planar,
    j: Planar,
    u_i: Vec2,
    u_j: Vec2,
    h_j: Vec2,
    radius: f64,
    phase: f64,
) -> f64 {
    let s = j.local(i.point(u_i)) - u_j;
    h_j.normalize().dot(s) + radius * (i.theta - j.theta - phase)
}

/// Wheel that rolls without slip: h_j × (s − ū_j) − r = 0 and h_j · (s − ū_j) + r (θ_i − θ_j −
/// φ) = 0.
///    \[m, m\]
///
/// Removes 2 freedoms: contact, and slip. `i`: the wheel, centre `u_i`, `radius`: r; `j`: the
/// track, a point `u_j` and the direction `h_j` of its line, of any length; `phase`: φ, the angle
/// of the wheel in the track when its centre stands over `u_j`. Haug, section 3.4. Measures:
/// `slide`, the way of the centre along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the wheel is to the left of h_j; along h_j it turns clockwise. The angle is
/// counter-clockwise positive.
#[constraint]
#[require(radius > 0.0, "a wheel needs a radius above zero")]
#[require(h_j.norm() > 0.0, "the track needs a direction with a length above zero")]
#[measure(slide = h_j.dot(j.local(i.point(u_i)) - u_j) / h_j.norm(), "m")]
#[measure(angle = i.theta - j.theta, "rad")]
pub fn rolling(
    i: Planar,
    j: Planar,
    u_i: Vec2,
    u_j: Vec2,
    h_j: Vec2,
    radius: f64,
    phase: f64,
) -> (f64, f64) {
    let s = j.local(i.point(u_i)) - u_j;
    let h = h_j.normalize();
    let contact = h.cross(s) - radius;
    let slip = h.dot(s) + radius * (i.theta - j.theta - phase);
    (contact, slip)
}

/// Linear coupling of two coordinates: k_a a + k_b b − c = 0.      \[unit of c\]
///
/// Removes 1 freedom. `a`, `b`: bare coordinates or those of bodies (`wheel.theta()`, `rack.x()`).
/// Of more than two: [`linear_coupling`](fn@linear_coupling). Norton, ch. 9.
///
/// Signs: those of the coordinates; with k_a = k_b they go against each other.
#[constraint]
#[require(k_a != 0.0 && k_b != 0.0, "a factor of zero couples nothing")]
pub fn coupling(a: Coord, b: Coord, k_a: f64, k_b: f64, c: f64) -> f64 {
    k_a * a + k_b * b - c
}

/// Linear coupling of two to six coordinates: Σ k_n q_n − c = 0.
///
/// A differential whose cage turns by half of what its two wheels turn:
/// `linear_coupling([left, right, cage], [1.0, 1.0, -2.0], 0.0)`. To drive a sum, couple it with a
/// separate coordinate and drive that. The constraint itself is [`type@linear_coupling`].
#[must_use]
pub fn linear_coupling<const N: usize>(
    q: [impl Into<Coordinate>; N],
    k: [f64; N],
    c: f64,
) -> linear_coupling {
    const {
        assert!(
            2 <= N && N <= TERMS,
            "`linear_coupling` takes two to six coordinates: give the sum of some of them a coordinate of its own"
        )
    };
    let mut given = q.into_iter().map(Into::into);
    // The places left over are filled with coordinates of the ground, which stand still at zero.
    let coordinates =
        std::array::from_fn(|_| given.next().unwrap_or(Coordinate::Planar(Ground.into(), 0)));
    terms::linear_coupling(
        coordinates,
        std::array::from_fn(|n| k.get(n).copied().unwrap_or(0.0)),
        c,
    )
}

/// The constraint that [`fn@linear_coupling`] makes.
#[allow(non_camel_case_types)]
pub type linear_coupling = terms::linear_coupling;
