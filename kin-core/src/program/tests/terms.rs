//! The gathered graph has the C, C_q, C_t, Q_d and g‴(0) of the system, at poses that need not
//! close.

use kin_graph::{Input, LeafUse, Node, Source};

use super::models::systems;
use crate::System;
use crate::numbers::random::Random;
use crate::program::Differences;
use crate::program::gather::{Whole, gather};
use crate::program::kind::SECOND;
use crate::program::stages::{law_at, numbers};

struct At<'a> {
    t: f64,
    q: &'a [f64],
    qd: &'a [f64],
    qdd: &'a [f64],
    whole: &'a Whole,
}

impl Source<f64> for At<'_> {
    fn input(&self, input: Input) -> f64 {
        match input {
            Input::State(j, _) => self.q[j],
            Input::Rate(j, SECOND) => self.qdd[j],
            Input::Rate(j, _) => self.qd[j],
            Input::Time => self.t,
            other => unreachable!("{other:?}"),
        }
    }

    fn law(&self, law: usize, x: f64, order: u8) -> f64 {
        law_at(&self.whole.laws, law, x, order)
    }

    fn opaque(&self, _: usize, _: usize, _: Vec<f64>) -> f64 {
        unreachable!("foreign values are folded")
    }

    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        unreachable!("formulas have no leaves")
    }
}

/// The largest difference of C, C_q, −C_t, Q_d and −g‴(0), each by the largest number of its kind.
fn difference(system: &System, whole: &Whole, seed: u64) -> f64 {
    let n = system.n_coordinates();
    let mut random = Random::new(seed);
    let q: Vec<f64> = system.initial().iter().map(|q| q + 0.05 * random.number()).collect();
    let t = 0.3 + 0.1 * random.number();
    let [qd, qdd] = [(); 2].map(|()| (0..n).map(|_| random.number()).collect::<Vec<f64>>());
    let equations = system.equations();
    let model = system.model();
    let point = model.linearize(&q, t).expect("finite");
    let mut by_time = vec![0.0; equations.rows];
    equations.velocity_rhs(&equations.instant_at(t, &q), &mut by_time);
    let second = model.second_order(&q, t, &qd, 1.0).expect("finite");
    let third = model.jerk_rhs(&q, t, &qd, &qdd).expect("known").expect("finite");
    let mut c_q = vec![vec![0.0; n]; equations.rows];
    model.entries(&point.values).for_each(|(row, column, value)| c_q[row][column] += value);
    let at = At { t, q: &q, qd: &qd, qdd: &qdd, whole };
    let of = |nodes: Vec<Node>| numbers(&whole.graph, &nodes, &at);
    let rows = |of: fn(&crate::program::gather::Row) -> Node| {
        whole.rows.iter().map(of).collect::<Vec<Node>>()
    };
    let mut own = vec![vec![0.0; n]; equations.rows];
    for (row, own) in whole.rows.iter().zip(&mut own) {
        let values = of(row.slopes.iter().map(|(_, slope)| *slope).collect());
        row.slopes.iter().zip(values).for_each(|((column, _), value)| own[*column] = value);
    }
    let pairs = [
        (point.c, of(rows(|row| row.residual))),
        (by_time, of(rows(|row| row.by_time)).iter().map(|x| -x).collect()),
        (second, of(rows(|row| row.second)).iter().map(|x| -x).collect()),
        (third, of(rows(|row| row.third.expect("asked for"))).iter().map(|x| -x).collect()),
        (c_q.concat(), own.concat()),
    ];
    let far = |(a, b): &(Vec<f64>, Vec<f64>)| {
        let size = a.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        a.iter().zip(b).fold(0.0_f64, |m, (x, y)| {
            if (x - y).abs() <= m * size { m } else { (x - y).abs() / size }
        })
    };
    pairs.iter().map(far).fold(0.0, |m, x| if x <= m { m } else { x })
}

#[test]
fn gathered_terms_are_those_of_the_system() {
    let mut gathered = 0;
    for (name, system) in systems() {
        match gather(&system, true, Differences::default()) {
            Ok(whole) => {
                gathered += 1;
                assert_eq!(whole.rows.len(), system.n_equations(), "{name}");
                for seed in 0..5 {
                    let off = difference(&system, &whole, seed);
                    assert!(off < 1e-12, "{name}: {off:e}");
                }
            }
            Err(refusal) => panic!("{name}: {refusal:?}"),
        }
    }
    assert!(gathered > 15, "{gathered}");
}
