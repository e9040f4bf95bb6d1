//! Planar bodies one after the other, each on those before it by some joint, its freedoms driven;
//! dyads between.

use super::*;

/// y = k x² in body j.      [m]
#[constraint]
fn parabolic_slot(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, k: f64) -> f64 {
    let s = j.local(i.point(u_i)) - u_j;
    s.y - k * s.x * s.x
}

/// The angles of three bodies add up, written as a loop rather than a formula: runs on dual
/// numbers.      [rad]
#[constraint]
fn summed(bodies: [Coord; 2], factors: [f64; 2], sum: f64) -> f64 {
    let mut total = 0.0 * bodies[0];
    let mut k = 0;
    while k < 2 {
        total = total + factors[k] * bodies[k];
        k += 1;
    }
    total - sum
}

/// A body and where it is when the mechanism is closed.
#[derive(Clone, Copy)]
struct Placed {
    body: PlanarBody,
    r: Vec2,
    theta: f64,
}

impl Placed {
    /// A global direction, or point, as the body sees it.
    fn direction(&self, v: Vec2) -> Vec2 {
        let (s, c) = self.theta.sin_cos();
        vec2(c * v.x + s * v.y, -s * v.x + c * v.y)
    }

    fn local(&self, p: Vec2) -> Vec2 {
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
    fn point(&mut self) -> Vec2 {
        vec2(self.random.number(), self.random.number())
    }

    fn direction(&mut self) -> Vec2 {
        let (s, c) = (4.0 * self.random.number()).sin_cos();
        vec2(c, s)
    }

    /// One that was there before.
    fn earlier(&mut self) -> Placed {
        self.bodies[self.random.below(self.bodies.len())]
    }

    fn body(&mut self, name: &str) -> Placed {
        let r = self.point();
        let theta = 3.0 * self.random.number();
        let mut off = |x: f64| x + OFF * self.random.number();
        let body = self.m.planar(name, pose(off(r.x), off(r.y), off(theta))).unwrap();
        self.exact.extend([r.x, r.y, theta]);
        Placed { body, r, theta }
    }

    fn pin(&mut self, name: &str, a: Placed, b: Placed, at: Vec2) {
        self.m.add(name, revolute(a.body, b.body, a.local(at), b.local(at))).unwrap();
    }

    fn drive_turn(&mut self, i: Placed, j: Placed) {
        let law = self.random.law(i.theta - j.theta);
        self.drivers.push(law, move |law| drive_relative_angle(i.body, j.body, law));
    }

    fn drive_point(&mut self, i: Placed) {
        let at = self.point();
        let n = self.direction();
        let law = self.random.law(n.dot(at));
        self.drivers.push(law, move |law| drive_point_along(i.body, i.local(at), n, law));
    }

    /// Two links and three pins that are far from a line.
    fn dyad(&mut self, unit: usize) {
        let i = self.earlier();
        let j = self.earlier();
        let a = self.body(&format!("link {unit}a"));
        let b = self.body(&format!("link {unit}b"));
        let pins = [self.point(), self.point(), self.point()];
        for (k, (first, second)) in [(i, a), (a, b), (b, j)].into_iter().enumerate() {
            self.pin(&format!("pin {unit}.{k}"), first, second, pins[k]);
        }
        self.bodies.extend([a, b]);
    }

    /// Three rods between two bodies.
    fn rods(&mut self, unit: usize, i: Placed, j: Placed) {
        for k in 0..3 {
            let p = self.point();
            let q = self.point();
            let rod = distance(i.body, j.body, i.local(p), j.local(q), (p - q).norm());
            self.m.add(&format!("rod {unit}.{k}"), rod).unwrap();
        }
    }

    /// A wheel that turns with an earlier body.
    fn wheel(&mut self, unit: usize, i: Placed, j: Placed, at: Vec2) {
        self.pin(&format!("joint {unit}"), i, j, at);
        let k = self.bodies[1 + self.random.below(self.bodies.len() - 1)];
        let ratio = 0.5 + self.random.number().abs();
        let sum = i.theta + ratio * k.theta;
        self.m
            .add(
                &format!("wheels {unit}"),
                summed([i.body.theta(), k.body.theta()], [1.0, ratio], sum),
            )
            .unwrap();
    }

    /// A body on an earlier one; its freedoms are driven.
    fn unit(&mut self, unit: usize) {
        let j = self.earlier();
        let i = self.body(&format!("body {unit}"));
        let at = self.point();
        let h = self.direction();
        let name = format!("joint {unit}");
        let u_i = i.local(at);
        let u_j = j.local(at);
        let mut turns = 0;
        let mut points = 0;
        match self.random.below(9) {
            0 => {
                self.pin(&name, i, j, at);
                turns = 1;
            }
            1 => {
                self.m
                    .add(
                        &name,
                        prismatic(i.body, j.body, u_i, u_j, i.direction(h), i.theta - j.theta),
                    )
                    .unwrap();
                let along = j.direction(h.perp());
                let law = self.random.law(0.0);
                self.drivers
                    .push(law, move |law| drive_slide(i.body, j.body, u_i, u_j, along, law));
            }
            2 => {
                self.m.add(&name, point_on_line(i.body, j.body, u_i, u_j, j.direction(h))).unwrap();
                (turns, points) = (1, 1);
            }
            3 => {
                self.m
                    .add(&name, pin_in_slot(i.body, j.body, u_i, j.local(at - h), j.local(at + h)))
                    .unwrap();
                points = 2;
            }
            4 => {
                self.m
                    .add(&name, point_on_circle(i.body, j.body, u_i, j.local(at + h * 0.7), 0.7))
                    .unwrap();
                (turns, points) = (1, 1);
            }
            5 => self.rods(unit, i, j),
            6 => {
                self.m.add(&name, weld(i.body, j.body, u_i, u_j, i.theta - j.theta)).unwrap();
            }
            7 => {
                let k = 1.5;
                let s = j.direction(h);
                let vertex = u_j - vec2(s.x, k * s.x * s.x);
                self.m.add(&name, parabolic_slot(i.body, j.body, u_i, vertex, k)).unwrap();
                (turns, points) = (1, 1);
            }
            _ => self.wheel(unit, i, j, at),
        }
        (0..turns).for_each(|_| self.drive_turn(i, j));
        (0..points).for_each(|_| self.drive_point(i));
        self.bodies.push(i);
    }
}

fn made(seed: u64, fault: Fault) -> (Mechanism, Vec<f64>) {
    let m = Mechanism::new("random");
    let ground = Placed { body: m.ground().into(), r: vec2(0.0, 0.0), theta: 0.0 };
    let mut all = Making {
        m,
        random: Random::new(seed),
        bodies: vec![ground],
        drivers: Drivers::default(),
        exact: Vec::new(),
    };
    let first = all.body("crank");
    let at = all.point();
    all.pin("pin", ground, first, at);
    all.drive_turn(first, ground);
    all.bodies.push(first);
    for unit in 0..1 + all.random.below(5) {
        if all.random.below(3) == 0 { all.dyad(unit) } else { all.unit(unit) }
    }
    let Making { mut m, mut random, drivers, exact, .. } = all;
    drivers.add(&mut m, fault, &mut random);
    (m, exact)
}

pub fn mechanism(seed: u64, fault: Fault) -> Mechanism {
    regular(seed, fault, made)
}
