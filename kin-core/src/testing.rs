//! Constraints written by hand, for the tests of the solver alone.

mod awkward;
pub mod functions;
mod large;
mod models;
mod refused;
mod whole;

use crate::coordinates::{Argument, Coordinate, PlanarBody, Target, Trig};
use crate::law::Law;
use crate::model::blame::{Asked, Blame, Input, Part};
use crate::model::constraint::{Constraint, Entry, Facts, Parameters, Parts, Written};
use crate::model::mechanism::Pose;
use crate::model::state::{At, Rates};
use crate::numbers::algebra::Vec2;

/// The facts of a constraint written by hand: its kind, its rows and its pattern.
macro_rules! facts {
    ($kind:literal, $rows:expr, [$(($row:literal, $column:literal)),+]) => {
        fn facts(&self) -> Facts<'_> {
            const FACTS: Facts<'static> = Facts {
                rows: &$rows,
                pattern: &[$(Entry::new($row, $column)),+],
                ..Facts::of($kind)
            };
            FACTS
        }
    };
}

/// A constraint shows a trait of its own that it implements.
macro_rules! shows {
    (Parameters) => {
        fn parts(&self) -> Parts<'_> {
            Parts { parameters: Some(self), ..Parts::default() }
        }

        fn parameters_mut(&mut self) -> Option<&mut dyn Parameters> {
            Some(self)
        }
    };
    (Written) => {
        fn parts(&self) -> Parts<'_> {
            Parts { written: Some(self), ..Parts::default() }
        }
    };
}

fn planar(name: &'static str, body: PlanarBody) -> Argument {
    Argument { name, target: Target::Planar(body) }
}

fn coord(name: &'static str, coordinate: Coordinate, trig: Trig) -> Argument {
    Argument { name, target: Target::Coord(coordinate, trig) }
}

/// R_i + A_i u_i − R_j − A_j u_j
#[derive(Clone)]
pub struct Revolute {
    pub i: PlanarBody,
    pub j: PlanarBody,
    pub u_i: Vec2,
    pub u_j: Vec2,
}

pub fn revolute(
    i: impl Into<PlanarBody>,
    j: impl Into<PlanarBody>,
    u_i: Vec2,
    u_j: Vec2,
) -> Revolute {
    Revolute { i: i.into(), j: j.into(), u_i, u_j }
}

impl Constraint for Revolute {
    facts!(
        "revolute",
        ["x", "y"],
        [(0, 0), (0, 2), (0, 3), (0, 5), (1, 1), (1, 2), (1, 4), (1, 5)]
    );

    fn arguments(&self) -> Vec<Argument> {
        vec![planar("i", self.i), planar("j", self.j)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let a = at.planar(0).point(self.u_i);
        let b = at.planar(1).point(self.u_j);
        c.copy_from_slice(&[a.x - b.x, a.y - b.y]);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        let a = at.planar(0).direction(self.u_i);
        let b = at.planar(1).direction(self.u_j);
        c_q.copy_from_slice(&[1.0, -a.y, -1.0, b.y, 1.0, a.x, -1.0, -b.x]);
    }

    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs.fill(0.0);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        let a = at.planar(0).direction(self.u_i);
        let b = at.planar(1).direction(self.u_j);
        let wi = qd.planar(0).theta.powi(2);
        let wj = qd.planar(1).theta.powi(2);
        q_d.copy_from_slice(&[wi * a.x - wj * b.x, wi * a.y - wj * b.y]);
    }

    shows!(Parameters);
}

impl Parameters for Revolute {
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("u_i.x", self.u_i.x);
        visit("u_i.y", self.u_i.y);
        visit("u_j.x", self.u_j.x);
        visit("u_j.y", self.u_j.y);
    }

    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        match name {
            "u_i.x" => self.u_i.x = value,
            "u_j.x" => self.u_j.x = value,
            _ => return false,
        }
        true
    }
}

/// θ − f(t)
#[derive(Clone)]
pub struct DriveAngle {
    pub b: PlanarBody,
    pub law: Law,
}

pub fn drive_angle(b: impl Into<PlanarBody>, law: Law) -> DriveAngle {
    DriveAngle { b: b.into(), law }
}

impl Constraint for DriveAngle {
    facts!("drive_angle", ["1"], [(0, 2)]);

    fn arguments(&self) -> Vec<Argument> {
        vec![planar("b", self.b)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        c[0] = at.planar(0).theta - self.law.at(at.t);
    }

    fn jacobian(&self, _: &At<'_>, c_q: &mut [f64]) {
        c_q[0] = 1.0;
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = self.law.jet(at.t)[1];
    }

    fn acceleration_rhs(&self, at: &At<'_>, _: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        q_d[0] = t_dot * t_dot * self.law.jet(at.t)[2];
    }

    shows!(Parameters);
}

impl Parameters for DriveAngle {
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.law.parameters(&mut |name, value| visit(&format!("law.{name}"), value));
    }

    fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        // It shows what it has and lets nothing be changed.
        let _ = (name, value);
        false
    }
}

/// q − pose
#[derive(Clone)]
pub struct Fixed {
    pub b: PlanarBody,
    pub pose: Pose,
}

impl Constraint for Fixed {
    facts!("fixed", ["x", "y", "theta"], [(0, 0), (1, 1), (2, 2)]);

    fn arguments(&self) -> Vec<Argument> {
        vec![planar("b", self.b)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let b = at.planar(0);
        c.copy_from_slice(&[b.r.x - self.pose.x, b.r.y - self.pose.y, b.theta - self.pose.theta]);
    }

    fn jacobian(&self, _: &At<'_>, c_q: &mut [f64]) {
        c_q.fill(1.0);
    }

    fn velocity_rhs(&self, _: &At<'_>, rhs: &mut [f64]) {
        rhs.fill(0.0);
    }

    fn acceleration_rhs(&self, _: &At<'_>, _: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d.fill(0.0);
    }
}

/// l2 cos ωt + l3 cos θ3 − x,  l2 sin ωt + l3 sin θ3 − h
#[derive(Clone)]
pub struct SliderCrank {
    pub theta3: Coordinate,
    pub x: Coordinate,
    pub l: [f64; 3],
    pub omega: f64,
}

impl Constraint for SliderCrank {
    facts!("slider_crank", ["x", "y"], [(0, 0), (0, 1), (1, 0)]);

    fn arguments(&self) -> Vec<Argument> {
        vec![coord("theta3", self.theta3, Trig::Used), coord("x", self.x, Trig::Unused)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        let [l2, l3, h] = self.l;
        let (s, co) = (self.omega * at.t).sin_cos();
        let b = at.coord(0);
        c.copy_from_slice(&[l2 * co + l3 * b.cos - at.coord(1).value, l2 * s + l3 * b.sin - h]);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        let b = at.coord(0);
        c_q.copy_from_slice(&[-self.l[1] * b.sin, -1.0, self.l[1] * b.cos]);
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        let (s, c) = (self.omega * at.t).sin_cos();
        let v = self.l[0] * self.omega;
        rhs.copy_from_slice(&[v * s, -v * c]);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        let (s, c) = (self.omega * at.t).sin_cos();
        let v = self.l[0] * (self.omega * t_dot).powi(2);
        let w = self.l[1] * qd.coord(0).powi(2);
        q_d.copy_from_slice(&[v * c + w * at.coord(0).cos, v * s + w * at.coord(0).sin]);
    }
}

/// √x − 1 − t: not finite for x < 0, infinite slope at 0.
#[derive(Clone)]
pub struct Root(pub Coordinate);

impl Constraint for Root {
    facts!("root", ["1"], [(0, 0)]);

    fn arguments(&self) -> Vec<Argument> {
        vec![coord("x", self.0, Trig::Unused)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        c[0] = at.coord(0).value.sqrt() - 1.0 - at.t;
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        c_q[0] = 0.5 / at.coord(0).value.sqrt();
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = if at.t < 2.0 { 1.0 } else { f64::NAN };
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, _: f64, q_d: &mut [f64]) {
        q_d[0] = 0.25 * qd.coord(0).powi(2) / at.coord(0).value.powf(1.5);
    }

    shows!(Written);
}

impl Written for Root {
    fn blame(&self, asked: &Asked<'_>) -> Option<Blame> {
        (asked.q[0] < 0.0).then(|| Blame {
            expression: "x.sqrt()".into(),
            source: None,
            part: Part::Value,
            value: f64::NAN,
            operands: vec![asked.q[0]],
            inputs: vec![Input::Column(0)],
        })
    }
}

/// x − q_k − f(t), on two bare coordinates.
#[derive(Clone)]
pub struct Follow {
    pub x: Coordinate,
    pub other: Coordinate,
    pub law: Law,
}

impl Constraint for Follow {
    facts!("follow", ["1"], [(0, 0), (0, 1)]);

    fn arguments(&self) -> Vec<Argument> {
        vec![coord("x", self.x, Trig::Unused), coord("other", self.other, Trig::Unused)]
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        c[0] = at.coord(0).value - at.coord(1).value - self.law.at(at.t);
    }

    fn jacobian(&self, _: &At<'_>, c_q: &mut [f64]) {
        c_q.copy_from_slice(&[1.0, -1.0]);
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        rhs[0] = self.law.jet(at.t)[1];
    }

    fn acceleration_rhs(&self, at: &At<'_>, _: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        q_d[0] = t_dot * t_dot * self.law.jet(at.t)[2];
    }
}
