use kin::prelude::*;

#[constraint]
fn on_cam(cam: Planar, follower: Planar, tip: Vec2, profile: Law) -> f64 {
    let p = cam.local(follower.point(tip));
    p.norm() - profile.at(p.y.atan2(p.x))
}

#[constraint]
fn slider_crank(theta3: Coord, x: Coord, t: Time, l2: f64, l3: f64, h: f64, omega: f64) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x,
     l2 * theta2.sin() + l3 * theta3.sin() - h]
}
fn own<D: Dual>(x: Real<D>) -> Real<D> { x.sin() * 2.0 + x * x }
const LIFT: f64 = 0.3;
struct Unclone;
#[derive(Clone)]
struct Gains { k: f64 }
fn plain_helper(x: f64) -> f64 { x + 1.0 }

#[constraint(symbolic)]
fn leafy(a: Coord, b: Spatial, t: Time, g: Gains, n: usize, u: Vec3) -> (f64, Vec3) {
    let s = own(a * t) + LIFT * a + plain_helper(g.k) * a;
    let mut v = b.point(u);
    if a > 0.0 { v.x += t * a; } else { v = v * 2.0; }
    for k in 0..3 { v[k] += b.p.e1 * (k as f64) * g.k; }
    let m = match n { 0 => a, 1 | 2 => -a, _ => 2.0 * a };
    (s + m, v)
}

#[constraint]
fn looping(a: Coord, n: usize) -> f64 {
    let mut s = 0.0;
    for k in 0..n { s += a * (k as f64); }
    s.sin()
}

#[law]
fn bump(x: f64, h: f64) -> f64 { h * (1.0 - x.cos()) }

#[test]
fn derivatives_are_right() {
    kin::check::derivatives(on_cam(kin::any_planar(), kin::any_planar(), vec2(0.0, -0.1), bump(0.3)));
    kin::check::derivatives(slider_crank(kin::any_coord(), kin::any_coord(), 1.0, 2.0, 3.0, 4.0));
    let l = leafy(kin::any_coord(), kin::any_spatial(), Gains { k: 2.0 }, 1, vec3(0.1, 0.2, 0.3));
    assert_eq!(l.route(), Route::Symbolic);
    kin::check::derivatives(l);
    let l = looping(kin::any_coord(), 4);
    assert_eq!(l.route(), Route::Dual);
    kin::check::derivatives(l);
    kin::check::derivatives(revolute(kin::any_planar(), kin::any_planar(), vec2(0.1, 0.2), vec2(0.3, -0.4)));
    kin::check::derivatives(prismatic(kin::any_planar(), kin::any_planar(), vec2(0.1, 0.2), vec2(0.3, -0.4), vec2(0.3, 1.0), 0.2));
}
