//! Spatial bodies one after the other, each on an earlier one by some joint of the library or by
//! rods, its freedoms driven.

use kin::joints::drivers::spatial as drivers;

use kin::joints::spatial;

use super::*;
use crate::models::hinge;

/// A body and where it is when the mechanism is closed.
#[derive(Clone, Copy)]
struct Placed {
    body: SpatialBody,
    r: Vec3,
    p: EulerParameters,
}

impl Placed {
    /// A global direction, or point, as the body sees it.
    fn direction(&self, v: Vec3) -> Vec3 {
        self.p.rotation().transpose() * v
    }

    fn local(&self, p: Vec3) -> Vec3 {
        self.direction(p - self.r)
    }
}

struct Making {
    m: Mechanism,
    random: Random,
    /// The ground first.
    bodies: Vec<Placed>,
    drivers: Drivers,
    exact: Vec<f64>,
}

impl Making {
    fn vector(&mut self) -> Vec3 {
        vec3(self.random.number(), self.random.number(), self.random.number())
    }

    fn unit_vector(&mut self) -> Vec3 {
        loop {
            let v = self.vector();
            if (0.1..1.0).contains(&v.norm()) {
                return v * v.norm().recip();
            }
        }
    }

    fn body(&mut self, name: &str) -> Placed {
        let r = self.vector();
        let axis = self.unit_vector();
        let angle = 3.0 * self.random.number();
        let exact = SpatialPose::turned(r, axis, angle);
        let guess = SpatialPose::turned(
            r + self.vector() * OFF,
            axis + self.vector() * OFF,
            angle + OFF * self.random.number(),
        );
        let body = self.m.spatial(name, guess).unwrap();
        let p = exact.p;
        self.exact.extend([r.x, r.y, r.z, p.e0, p.e1, p.e2, p.e3]);
        Placed { body, r, p }
    }

    /// Drives so many coordinates of points.
    fn drive_points(&mut self, i: Placed, count: usize) {
        for _ in 0..count {
            let at = self.vector() * 1.5;
            let n = self.unit_vector();
            let law = self.random.law(n.dot(at));
            self.drivers
                .push(law, move |law| drivers::drive_point_along(i.body, i.local(at), n, law));
        }
    }

    fn drive_turn(&mut self, i: Placed, j: Placed, h: [Axis; 2]) {
        let law = self.random.law(0.0);
        self.drivers.push(law, move |law| drivers::drive_turn(i.body, j.body, h[0], h[1], law));
    }

    fn drive_slide(&mut self, i: Placed, j: Placed, u: [Vec3; 2], h_j: Axis) {
        let law = self.random.law(0.0);
        self.drivers
            .push(law, move |law| drivers::drive_slide(i.body, j.body, u[0], u[1], h_j, law));
    }

    /// Rods between points of two bodies.
    fn rods(&mut self, unit: usize, i: Placed, j: Placed, count: usize) {
        for k in 0..count {
            let p = i.r + self.vector();
            let q = j.r + self.vector() * 1.5;
            let rod = spatial::distance(i.body, j.body, i.local(p), j.local(q), (p - q).norm());
            self.m.add(&format!("rod {unit}.{k}"), rod).unwrap();
        }
    }

    /// A body on an earlier one.
    fn unit(&mut self, unit: usize) {
        let j = self.bodies[self.random.below(self.bodies.len())];
        let i = self.body(&format!("body {unit}"));
        let at = self.vector();
        let z = self.unit_vector();
        let x = self.unit_vector();
        let place = Place { name: format!("joint {unit}"), i, j, at, z, x };
        if self.random.below(2) == 0 {
            self.lower_pair(&place)
        } else {
            self.other(unit, &place)
        }
        self.bodies.push(i);
    }

    fn lower_pair(&mut self, place: &Place) {
        let Place { name, i, j, .. } = place;
        let i = *i;
        let j = *j;
        let u = place.points();
        let h = place.axes();
        let a = i.body;
        let b = j.body;
        match self.random.below(7) {
            0 => {
                self.m.add(name, spatial::revolute(a, b, u[0], u[1], h[0], h[1].h)).unwrap();
                self.drive_turn(i, j, h);
            }
            1 => {
                self.m.add(name, spatial::prismatic(a, b, u[0], u[1], h[0], place.turn())).unwrap();
                self.drive_slide(i, j, u, h[1]);
            }
            2 => {
                self.m.add(name, spatial::cylindrical(a, b, u[0], u[1], h[0], h[1].h)).unwrap();
                self.drive_turn(i, j, h);
                self.drive_slide(i, j, u, h[1]);
            }
            3 => {
                self.m.add(name, spatial::spherical(a, b, u[0], u[1])).unwrap();
                self.drive_points(i, 3);
            }
            4 => {
                self.m.add(name, spatial::planar(a, b, u[0], u[1], h[0], h[1].h)).unwrap();
                self.drive_turn(i, j, h);
                self.drive_points(i, 2);
            }
            5 => {
                self.m.add(name, spatial::screw(a, b, u[0], u[1], h[0], h[1], 0.5)).unwrap();
                self.drive_turn(i, j, h);
            }
            _ => {
                self.m.add(name, spatial::weld(a, b, u[0], u[1], place.turn())).unwrap();
            }
        }
    }

    fn other(&mut self, unit: usize, place: &Place) {
        let Place { name, i, j, z, .. } = place;
        let i = *i;
        let j = *j;
        let u = place.points();
        let h = place.axes();
        let a = i.body;
        let b = j.body;
        let across = j.direction(z.cross(place.x).normalize());
        let far = |m: &mut Self| place.at + m.unit_vector();
        match self.random.below(9) {
            0 => {
                self.m.add(name, spatial::universal(a, b, u[0], u[1], h[0].h, across)).unwrap();
                self.drive_points(i, 2);
            }
            1 => {
                self.m.add(name, spatial::constant_velocity(a, b, u[0], u[1], h[0], h[1])).unwrap();
                self.drive_points(i, 2);
            }
            2 => {
                self.rods(unit, i, j, 5);
                self.drive_points(i, 1);
            }
            3 => {
                self.m.add(name, spatial::point_on_line(a, b, u[0], u[1], h[1])).unwrap();
                self.rods(unit, i, j, 3);
                self.drive_points(i, 1);
            }
            4 => {
                self.m.add(name, spatial::point_in_plane(a, b, u[0], u[1], h[1].h)).unwrap();
                self.m
                    .add(&format!("square {unit}"), spatial::perpendicular(a, b, h[0].h, across))
                    .unwrap();
                self.drive_points(i, 4);
            }
            5 => {
                // The ball is across the hinge from its point.
                let ball = place.at + place.x.cross(*z).normalize();
                self.m
                    .add(name, spatial::revolute_spherical(a, b, u[0], j.local(ball), h[0].h, 1.0))
                    .unwrap();
                self.drive_points(i, 4);
            }
            6 => {
                let ball = far(self);
                let off = (ball - place.at) - *z * z.dot(ball - place.at);
                self.m
                    .add(
                        name,
                        spatial::spherical_cylindrical(a, b, i.local(ball), u[1], h[1], off.norm()),
                    )
                    .unwrap();
                self.drive_points(i, 5);
            }
            7 => {
                self.m
                    .add(name, hinge(a, b, u[0], u[1], h[0].h, across, across.cross(h[1].h)))
                    .unwrap();
                self.drive_turn(i, j, h);
            }
            _ => {
                self.m.add(name, spatial::parallel(a, b, h[0], h[1].h)).unwrap();
                self.drive_turn(i, j, h);
                self.drive_points(i, 3);
            }
        }
    }
}

/// Where a joint is: a global point, its axis, and a direction by which angles are counted.
struct Place {
    name: String,
    i: Placed,
    j: Placed,
    at: Vec3,
    z: Vec3,
    x: Vec3,
}

impl Place {
    fn points(&self) -> [Vec3; 2] {
        [self.i.local(self.at), self.j.local(self.at)]
    }

    fn axes(&self) -> [Axis; 2] {
        [self.i, self.j].map(|body| Axis::new(body.direction(self.z), body.direction(self.x)))
    }

    /// Body i as body j sees it.
    fn turn(&self) -> EulerParameters {
        self.j.p.conjugate().product(self.i.p)
    }
}

fn made(seed: u64, fault: Fault) -> (Mechanism, Vec<f64>) {
    let m = Mechanism::new("random in space");
    let ground = Placed {
        body: m.ground().into(),
        r: vec3(0.0, 0.0, 0.0),
        p: EulerParameters::new(1.0, 0.0, 0.0, 0.0),
    };
    let mut all = Making {
        m,
        random: Random::new(seed),
        bodies: vec![ground],
        drivers: Drivers::default(),
        exact: Vec::new(),
    };
    for unit in 0..1 + all.random.below(3) {
        all.unit(unit);
    }
    if all.drivers.0.is_empty() {
        let last = all.body("handle");
        all.drive_points(last, 6);
    }
    let Making { mut m, mut random, drivers, exact, .. } = all;
    drivers.add(&mut m, fault, &mut random);
    (m, exact)
}

pub fn mechanism(seed: u64, fault: Fault) -> Mechanism {
    regular(seed, fault, made)
}
