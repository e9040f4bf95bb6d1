//! Mechanisms with a known answer.

use kin::prelude::*;

/// Five-row revolute: a common point, and the axis h_i of body i perpendicular to two directions of
/// body j.      [m, –]
#[constraint]
pub fn hinge(
    i: Spatial,
    j: Spatial,
    u_i: Vec3,
    u_j: Vec3,
    h_i: Vec3,
    a_j: Vec3,
    b_j: Vec3,
) -> (Vec3, f64, f64) {
    let point = i.point(u_i) - j.point(u_j);
    let axis = i.direction(h_i);
    let first = axis.dot(j.direction(a_j));
    let second = axis.dot(j.direction(b_j));
    (point, first, second)
}

/// Spherical joint: a common point.      [m]
#[constraint]
pub fn ball(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3) -> Vec3 {
    i.point(u_i) - j.point(u_j)
}

/// The angle of a body about a ground axis: the direction h of the body stays at the angle f(t) in
/// the plane of a and b.      [–]
#[constraint]
pub fn turn(body: Spatial, h: Vec3, a: Vec3, b: Vec3, law: Law, t: Time) -> f64 {
    let angle = law.at(t);
    body.direction(h).dot(b * angle.cos() - a * angle.sin())
}

pub struct Parallelogram {
    pub mechanism: Mechanism,
    pub cranks: [Link; 3],
    pub coupler: PlanarBody,
}

/// Three equal cranks at (0, 0), (2, 0), (0.8, −0.5) carry one coupler; the third is `third` times
/// as long. No driver yet.
pub fn parallelogram(third: f64, angle: f64) -> Parallelogram {
    let mut m = Mechanism::new("parallelogram");
    let ground = m.ground();
    let pivots = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(0.8, -0.5)];
    let tip = vec2(angle.cos(), angle.sin());
    let cranks = [0, 1, 2].map(|k| {
        let length = if k == 2 { third } else { 1.0 };
        let link = m.link(&format!("crank {}", k + 1), length).unwrap();
        m.set_pose(
            link,
            pose(pivots[k].x + 0.5 * length * tip.x, pivots[k].y + 0.5 * length * tip.y, angle),
        )
        .unwrap();
        link
    });
    let coupler = m.planar("coupler", pose(tip.x, tip.y, 0.0)).unwrap();
    for (k, (crank, pivot)) in cranks.iter().zip(pivots).enumerate() {
        m.add(&format!("O{}", k + 1), revolute(ground, *crank, pivot, crank.start())).unwrap();
        m.add(&format!("A{}", k + 1), revolute(*crank, coupler, crank.end(), pivot)).unwrap();
    }
    Parallelogram { mechanism: m, cranks, coupler }
}

/// The page's four-bar without its motor, with the links placed near an assembly.
pub fn four_bar() -> (Mechanism, [Link; 3]) {
    let mut m = Mechanism::new("four-bar");
    let ground = m.ground();
    let crank = m.link("crank", 1.0).unwrap();
    let coupler = m.link("coupler", 3.5).unwrap();
    let rocker = m.link("rocker", 3.0).unwrap();
    m.set_pose(crank, pose(0.3, 0.4, 0.9)).unwrap();
    m.set_pose(coupler, pose(2.0, 1.7, 0.5)).unwrap();
    m.set_pose(rocker, pose(3.6, 1.3, 1.7)).unwrap();
    m.add("O", revolute(ground, crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(ground, rocker, vec2(4.0, 0.0), rocker.start())).unwrap();
    (m, [crank, coupler, rocker])
}
