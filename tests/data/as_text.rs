//! Compiled constraints beside the same equations read from text.

use std::sync::{Arc, Mutex};

use kin::Constraint;
use kin::data::{Describer, LawData};
use kin::extend::coordinates::{Argument, Target};
use kin::extend::state::{At, Rates};
use kin::extend::{Facts, Parts, jerk_rhs, terms};
use kin_text::{Equation, Making, On, Parameter, ReadConstraint};
use serde_json::Value;

/// The equation on the bodies and with the parameters of a compiled constraint.
pub fn like(equation: &Equation, compiled: &dyn Constraint) -> ReadConstraint {
    let mut describer = Describer::default();
    compiled.describe(&mut describer);
    let mut bodies = compiled.arguments().into_iter().map(|argument| match argument.target {
        Target::Planar(body) => On::Planar(body),
        Target::Spatial(body) => On::Spatial(body),
        Target::Coord(coordinate, _) => On::Coord(coordinate),
    });
    let first = equation.on(bodies.next().expect("an argument"));
    let making = bodies.fold(first, Making::on);
    let making = describer
        .parameters()
        .iter()
        .fold(making, |making, (name, value)| making.with(name, of_json(value)));
    making.constraint().unwrap_or_else(|error| panic!("{error}"))
}

fn of_json(value: &Value) -> Parameter {
    fn flat(value: &Value, to: &mut Vec<f64>) {
        match value {
            Value::Array(all) => all.iter().for_each(|part| flat(part, to)),
            number => to.push(number.as_f64().expect("a number")),
        }
    }
    if value.is_object() {
        let data: LawData = serde_json::from_value(value.clone()).expect("a law");
        return kin_text::registry().law(&data).expect("a law").into();
    }
    let mut numbers = Vec::new();
    flat(value, &mut numbers);
    numbers.into()
}

/// The numbers of a constraint at an instant: C_q, C, C_t, (C_q q̇)_q q̇, C_qt q̇, C_tt and Q_d;
/// and apart from them the right side for the jerk.
fn numbers(of: &dyn Constraint, [q, qd, qdd]: [&[f64]; 3], t: f64) -> [Vec<f64>; 2] {
    let all = terms(of, q, qd, t);
    let vectors = [&all.c, &all.c_t, &all.c_qqd_qd, &all.c_qt_qd, &all.c_tt, &all.q_d];
    let vectors = vectors.into_iter().flat_map(|vector| vector.iter().copied());
    let jerk = jerk_rhs(of, q, qd, qdd, t).expect("the jerk is known");
    [all.c_q.iter().copied().chain(vectors).collect(), jerk.iter().copied().collect()]
}

/// The largest difference of everything that a solver asks for, as a part of the largest
/// intermediate value; of the right side for the jerk, of the largest one that it has or is made
/// of.
pub fn difference(
    compiled: &dyn Constraint,
    read: &ReadConstraint,
    state: [&[f64]; 3],
    t: f64,
) -> f64 {
    let watched = Watched { read: read.clone(), largest: Arc::default() };
    let ours = numbers(&watched, state, t);
    let theirs = numbers(compiled, state, t);
    let mut size = *watched.largest.lock().expect("a number");
    let mut worst = 0.0_f64;
    for (ours, theirs) in ours.iter().zip(&theirs) {
        assert_eq!(ours.len(), theirs.len());
        size = ours.iter().map(|x| x.abs()).filter(|x| x.is_finite()).fold(size, f64::max);
        worst = ours.iter().zip(theirs).map(|(a, b)| apart(*a, *b, size)).fold(worst, f64::max);
    }
    worst
}

/// Difference of two numbers as a part of the largest number around.
pub fn apart(a: f64, b: f64, size: f64) -> f64 {
    let differ = a != b && !(a.is_nan() && b.is_nan());
    if differ {
        if (a - b).is_finite() { (a - b).abs() / size } else { f64::INFINITY }
    } else {
        0.0
    }
}

/// A constraint from text, and the largest value that was met on the way to its terms.
#[derive(Clone)]
struct Watched {
    read: ReadConstraint,
    largest: Arc<Mutex<f64>>,
}

impl Constraint for Watched {
    fn facts(&self) -> Facts<'_> {
        self.read.facts()
    }

    fn arguments(&self) -> Vec<Argument> {
        self.read.arguments()
    }

    fn residual(&self, at: &At<'_>, c: &mut [f64]) {
        self.read.residual(at, c);
    }

    fn jacobian(&self, at: &At<'_>, c_q: &mut [f64]) {
        self.read.jacobian(at, c_q);
    }

    fn velocity_rhs(&self, at: &At<'_>, rhs: &mut [f64]) {
        self.read.velocity_rhs(at, rhs);
    }

    fn acceleration_rhs(&self, at: &At<'_>, qd: &Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
        self.read.acceleration_rhs(at, qd, t_dot, q_d);
        let mut largest = self.largest.lock().expect("a number");
        *largest = largest.max(self.read.largest(at, qd, t_dot));
    }

    fn parts(&self) -> Parts<'_> {
        self.read.parts()
    }
}
