//! One joint with random parameters, whatever its type, and random numbers from a seed.

use kin::check::{Mismatch, Report};
use kin::extend::dual_route::Equation;
use kin::extend::terms;
use kin::prelude::*;
use nalgebra::{DMatrix, DVector};

/// The tests' view of a joint.
pub trait Sample {
    fn constraint(&self) -> &dyn Constraint;
    /// The same on the dual route.
    fn by_dual(&self) -> Box<dyn Constraint>;
    fn compare(&self, seed: u64) -> Result<Report, Box<Mismatch>>;
    fn at(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Report, Box<Mismatch>>;
}

struct Of<E, const N: usize, const M: usize>(E);

pub fn sample<E: Equation<N, M> + Clone + 'static, const N: usize, const M: usize>(
    joint: E,
) -> Box<dyn Sample> {
    Box::new(Of::<E, N, M>(joint))
}

impl<E: Equation<N, M> + Clone, const N: usize, const M: usize> Sample for Of<E, N, M> {
    fn constraint(&self) -> &dyn Constraint {
        &self.0
    }

    fn by_dual(&self) -> Box<dyn Constraint> {
        Box::new(kin::extend::by_dual(self.0.clone()))
    }

    fn compare(&self, seed: u64) -> Result<Report, Box<Mismatch>> {
        kin::check::compare_from::<E, N, M>(&self.0, seed)
    }

    fn at(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Report, Box<Mismatch>> {
        let fixed = |values: &[f64]| std::array::from_fn(|k| values[k]);
        kin::check::at::<E, N, M>(&self.0, &fixed(q), &fixed(qd), t)
    }
}

/// Kind and first column of an argument.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Argument {
    Planar(usize),
    Spatial(usize),
    Coord(usize),
}

/// The arguments of a joint in order.
pub fn arguments(joint: &dyn Constraint) -> Vec<Argument> {
    let mut column = 0;
    let of = |argument: kin::extend::coordinates::Argument| {
        let first = column;
        column += argument.target.columns();
        match argument.target.columns() {
            3 => Argument::Planar(first),
            7 => Argument::Spatial(first),
            _ => Argument::Coord(first),
        }
    };
    joint.arguments().into_iter().map(of).collect()
}

pub fn columns(joint: &dyn Constraint) -> usize {
    joint.arguments().iter().map(|argument| argument.target.columns()).sum()
}

/// C, and C_q, with the norms of the bodies' Euler parameters below.
pub fn with_norms(joint: &dyn Constraint, q: &[f64], t: f64) -> (DVector<f64>, DMatrix<f64>) {
    let own = terms(joint, q, &[], t);
    let spatial = arguments(joint)
        .into_iter()
        .filter_map(|a| if let Argument::Spatial(first) = a { Some(first + 3) } else { None });
    let mut c = own.c;
    let mut c_q = own.c_q;
    for first in spatial {
        let row = c.len();
        let p = &q[first..first + 4];
        c = c.push(p.iter().map(|e| e * e).sum::<f64>() - 1.0);
        c_q = c_q.insert_row(row, 0.0);
        (0..4).for_each(|k| c_q[(row, first + k)] = 2.0 * p[k]);
    }
    (c, c_q)
}

/// A random pose with C = 0, by Newton steps of least length from random poses.
pub fn on_manifold(joint: &dyn Constraint, random: &mut Random, t: f64) -> Vec<f64> {
    for _ in 0..200 {
        let mut q = random.pose(joint);
        for _ in 0..60 {
            let (c, c_q) = with_norms(joint, &q, t);
            if c.amax() < 1e-14 {
                return q;
            }
            let Ok(step) = c_q.svd(true, true).solve(&c, 1e-12) else { break };
            let length = step.amax().max(1.0);
            q.iter_mut().zip(step.iter()).for_each(|(q, dq)| *q -= dq / length);
        }
        if with_norms(joint, &q, t).0.amax() < 1e-12 {
            return q;
        }
    }
    panic!("`{}` has no pose", joint.facts().kind);
}

/// Random numbers from a seed.
pub struct Random(fastrand::Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(fastrand::Rng::with_seed(seed))
    }

    /// Between a and b.
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.0.f64()
    }

    /// Within ±2.
    pub fn number(&mut self) -> f64 {
        self.between(-2.0, 2.0)
    }

    /// A length well above zero.
    pub fn length(&mut self) -> f64 {
        self.between(0.4, 1.6)
    }

    pub fn v2(&mut self) -> Vec2 {
        vec2(self.number(), self.number())
    }

    pub fn v3(&mut self) -> Vec3 {
        vec3(self.number(), self.number(), self.number())
    }

    pub fn axis(&mut self) -> Axis {
        Axis::new(self.v3(), self.v3())
    }

    /// Euler parameters of length one.
    pub fn turn(&mut self) -> EulerParameters {
        EulerParameters::from([self.number(), self.number(), self.number(), self.number()])
            .normalize()
    }

    /// A smooth law of any size.
    pub fn law(&mut self) -> Law {
        let sine = Law::sine(self.number(), self.length(), self.number());
        Law::polynomial(&[self.number(), self.number(), 0.3 * self.number(), 0.1 * self.number()])
            + sine
    }

    /// A law between 1 and 3, 2π-periodic.
    pub fn profile(&mut self) -> Law {
        Law::constant(2.0)
            + Law::sine(self.between(0.05, 0.15), 2.0, self.number())
            + Law::sine(self.between(0.1, 0.3), 1.0, self.number())
    }

    /// As many numbers as the joint has columns, within ±2.
    pub fn numbers(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.number()).collect()
    }

    /// A pose of all arguments, Euler parameters of length one.
    pub fn pose(&mut self, joint: &dyn Constraint) -> Vec<f64> {
        let mut q = self.numbers(columns(joint));
        for argument in arguments(joint) {
            if let Argument::Spatial(first) = argument {
                q[first + 3..first + 7].copy_from_slice(&self.turn().to_array());
            }
        }
        q
    }
}
