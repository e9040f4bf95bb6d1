//! Defines couplings of rotations and displacements.
//!
//! Kin does not wrap the angles of planar bodies, so a coupling counts full revolutions.

use super::terms::{self, TERMS};
use crate::coordinates::{Coordinate, Ground};
use crate::numbers::algebra::Vec2;
use kin_macros::constraint;

/// Meshes two external gears on an arm: r_i (θ_i − θ_arm − φ) + r_j (θ_j − θ_arm) = 0. \[m\]
///
/// Removes 1 freedom. `i` and `j` are the wheels. `arm` is the body that carries both axles; use
/// the ground for axles at rest. `r_i` and `r_j` are the pitch radii \[m\]. `phase` is φ, the angle
/// of i relative to the arm when j is in line with the arm \[rad\]. Source: Norton, *Design of
/// Machinery*, ch. 9.
///
/// Signs: relative to the arm the wheels turn in opposite directions. All angles are
/// counter-clockwise positive.
#[constraint]
#[require(r_i > 0.0 && r_j > 0.0, "the pitch radii must be above zero")]
pub fn gear(i: Planar, j: Planar, arm: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - arm.theta - phase) + r_j * (j.theta - arm.theta)
}

/// Meshes a gear with a ring on an arm: r_i (θ_i − θ_arm − φ) − r_j (θ_j − θ_arm) = 0. \[m\]
///
/// Removes 1 freedom. `i` is the wheel with the pitch radius `r_i` \[m\]. `j` is the ring with
/// internal teeth and the pitch radius `r_j` \[m\]. `arm` is the body that carries both axles.
/// `phase` is φ, the angle of i relative to the arm when j is in line with the arm \[rad\]. Source:
/// Norton, ch. 9.
///
/// Signs: relative to the arm the wheel and the ring turn in the same direction. All angles are
/// counter-clockwise positive.
#[constraint]
#[require(r_i > 0.0 && r_j > r_i, "the pitch radius of the ring must be larger than the pitch radius of the wheel, and both must be above zero")]
pub fn internal_gear(i: Planar, j: Planar, arm: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - arm.theta - phase) - r_j * (j.theta - arm.theta)
}

/// Couples two pulleys by a belt or chain: r_i (θ_i − θ_frame − φ) − r_j (θ_j − θ_frame) = 0. \[m\]
///
/// Removes 1 freedom. `i` and `j` are the pulleys. `frame` is the body that carries both axles.
/// `r_i` and `r_j` are the pitch radii \[m\]; for a crossed belt give one negative radius. `phase`
/// is φ, the angle of i relative to the frame when j is in line with the frame \[rad\]. The belt
/// neither slips nor stretches. Source: Norton, ch. 9.
///
/// Signs: relative to the frame an open belt turns both pulleys in the same direction, a crossed
/// belt in opposite directions. All angles are counter-clockwise positive.
#[constraint]
#[require(r_i != 0.0 && r_j != 0.0, "the radius of a pulley must not be zero")]
pub fn belt(i: Planar, j: Planar, frame: Planar, r_i: f64, r_j: f64, phase: f64) -> f64 {
    r_i * (i.theta - frame.theta - phase) - r_j * (j.theta - frame.theta)
}

/// Meshes a pinion with a rack: h_j · (s − ū_j) + r (θ_i − θ_j − φ) = 0, where s is the pinion's
/// centre in the rack's frame. \[m\]
///
/// Removes 1 freedom. `i` is the pinion, `u_i` its centre \[m\] and `radius` its pitch radius r
/// \[m\]. `j` is the rack, `u_j` a point of its pitch line \[m\] and `h_j` the direction of the
/// pitch line, of any length. `phase` is φ, the angle of the pinion relative to the rack when the
/// pinion's centre is over `u_j` \[rad\]. Source: Norton, ch. 9. Measures: `slide`, the
/// displacement of the centre along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the pinion is to the left of h_j; with a negative radius it is to the right. When the
/// pinion moves along h_j in the rack, it turns clockwise. A pinion that turns counter-clockwise in
/// place moves the rack along h_j. The angle is counter-clockwise positive.
#[constraint]
#[require(radius != 0.0, "the radius of the pinion must not be zero")]
#[require(h_j.norm() > 0.0, "the direction of the rack must not be zero")]
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

/// Rolls a wheel on a straight track without slip: h_j × (s − ū_j) − r = 0 and h_j · (s − ū_j) + r
/// (θ_i − θ_j − φ) = 0. \[m, m\]
///
/// Removes 2 freedoms: the first row keeps contact, the second prevents slip. The vector s is the
/// wheel's centre in the frame of the track. `i` is the wheel, `u_i` its centre \[m\] and `radius`
/// its radius r \[m\]. `j` is the track, `u_j` a point of its line \[m\] and `h_j` the direction of
/// the line, of any length. `phase` is φ, the angle of the wheel relative to the track when the
/// wheel's centre is over `u_j` \[rad\]. Source: Haug, section 3.4. Measures: `slide`, the
/// displacement of the centre along h_j; `angle`, θ_i − θ_j.
///
/// Signs: the wheel is to the left of h_j. When the wheel moves along h_j, it turns clockwise. The
/// angle is counter-clockwise positive.
#[constraint]
#[require(radius > 0.0, "the radius of the wheel must be above zero")]
#[require(h_j.norm() > 0.0, "the direction of the track must not be zero")]
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

/// Couples two coordinates linearly: k_a a + k_b b − c = 0. \[unit of c\]
///
/// Removes 1 freedom. `a` and `b` are scalar coordinates or coordinates of bodies (`wheel.theta()`,
/// `rack.x()`). `k_a` and `k_b` are the factors, and `c` is the sum. For more than two coordinates
/// use [`linear_coupling`](fn@linear_coupling). Source: Norton, ch. 9.
///
/// Signs: with k_a = k_b the coordinates move in opposite directions.
#[constraint]
#[require(k_a != 0.0 && k_b != 0.0, "the factors must not be zero")]
pub fn coupling(a: Coord, b: Coord, k_a: f64, k_b: f64, c: f64) -> f64 {
    k_a * a + k_b * b - c
}

/// Couples two to six coordinates linearly: Σ k_n q_n − c = 0.
///
/// For example, the cage of a differential turns by half of the sum of the angles of its two
/// wheels: `linear_coupling([left, right, cage], [1.0, 1.0, -2.0], 0.0)`. To drive a sum, couple
/// the sum with a separate coordinate and drive the separate coordinate. The function returns the
/// constraint [`type@linear_coupling`].
#[must_use]
pub fn linear_coupling<const N: usize>(
    q: [impl Into<Coordinate>; N],
    k: [f64; N],
    c: f64,
) -> linear_coupling {
    const {
        assert!(
            2 <= N && N <= TERMS,
            "`linear_coupling` takes two to six coordinates: add a coordinate for the sum of some of these coordinates"
        )
    };
    let mut given = q.into_iter().map(Into::into);
    // Coordinates of the ground fill the unused places. They are always zero.
    let coordinates =
        std::array::from_fn(|_| given.next().unwrap_or(Coordinate::Planar(Ground.into(), 0)));
    terms::linear_coupling(
        coordinates,
        std::array::from_fn(|n| k.get(n).copied().unwrap_or(0.0)),
        c,
    )
}

/// The constraint that [`fn@linear_coupling`] returns.
#[allow(non_camel_case_types)]
pub type linear_coupling = terms::linear_coupling;
