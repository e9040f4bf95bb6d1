//! W1: the two-link manipulator of the lecture, nine coordinates.

use kin::extend::dual_route::Equation;
use kin::prelude::*;

use crate::hand::two_link::{TWO_LINK, run};
use crate::sweep::{Table, Workload, add, build, routes, weigh};

const DT: f64 = 0.01;
const STEPS: usize = 2401;

/// The same with the joint between the links from text.
pub fn with_text() -> Workload {
    let routes = routes(|| run(STEPS, DT), model_with_text);
    let build: Box<dyn Fn() -> System> = Box::new(|| model_with_text(false));
    Workload { name: TEXT.to_string(), routes, build, ..workload() }
}

pub const TEXT: &str = "W1-text";

pub fn workload() -> Workload {
    Workload {
        name: "W1".to_string(),
        dt: DT,
        steps: STEPS,
        links: None,
        routes: routes(|| run(STEPS, DT), model),
        error: Box::new(error),
        allowed: 1e-9,
        build: Box::new(|| model(false)),
    }
}

fn model(dual: bool) -> System {
    modelled(dual, |m, body2, body3, [u_i, u_j]| {
        add(m, dual, "A", revolute(body2, body3, u_i, u_j))
    })
}

/// Whatever route is asked for, the one joint is from text.
fn model_with_text(dual: bool) -> System {
    const REVOLUTE: &str = "fn pin(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2) -> Vec2 { i.point(u_i) - j.point(u_j) }";
    let equation =
        kin_text::Equation::read(REVOLUTE).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    modelled(dual, |m, body2, body3, [u_i, u_j]| {
        let pin = equation.on(body2).on(body3).with("u_i", u_i).with("u_j", u_j).constraint();
        pin.and_then(|pin| m.add("A", pin)).map_or_else(|error| panic!("{error}"), drop);
    })
}

fn modelled(dual: bool, pin: impl Fn(&mut Mechanism, PlanarBody, PlanarBody, [Vec2; 2])) -> System {
    let [l2, l3] = TWO_LINK.l;
    let mut m = Mechanism::new("two-link manipulator");
    let body = |m: &mut Mechanism, name| {
        m.planar(name, pose(0.0, 0.0, 0.0)).unwrap_or_else(|error| panic!("{error}"))
    };
    let body1 = body(&mut m, "body1");
    let body2 = body(&mut m, "body2");
    let body3 = body(&mut m, "body3");
    add(&mut m, dual, "ground", fixed(body1, vec2(0.0, 0.0), 0.0));
    add(&mut m, dual, "O", revolute(body1, body2, vec2(0.0, 0.0), vec2(-0.5 * l2, 0.0)));
    pin(&mut m, body2, body3, [vec2(0.5 * l2, 0.0), vec2(-0.5 * l3, 0.0)]);
    add(&mut m, dual, "link2", motor(body2, 0));
    add(&mut m, dual, "link3", motor(body3, 1));
    weigh(&mut m, [body1, body2, body3]);
    build(m, &TWO_LINK.position(0.0))
}

fn motor(body: PlanarBody, k: usize) -> impl Equation<3, 1> + 'static {
    drive_angle(body, Law::linear(TWO_LINK.theta0[k], TWO_LINK.omega[k]))
}

/// The largest error of R3, of Ṙ3's x and of R̈3.
fn error(table: &Table) -> f64 {
    let [h, g] = TWO_LINK.l.map(|l| 0.5 * l);
    let [v, w] = TWO_LINK.omega;
    let step = |k: usize| {
        let (q, qd, qdd) = table.at(k);
        let exact = TWO_LINK.position(k as f64 * DT);
        let a = [2.0 * h * exact[5].cos(), 2.0 * h * exact[5].sin()];
        let b = [g * exact[8].cos(), g * exact[8].sin()];
        let errors = [
            q[6] - exact[6],
            q[7] - exact[7],
            qd[6] + v * a[1] + w * b[1],
            qdd[6] + v * v * a[0] + w * w * b[0],
            qdd[7] + v * v * a[1] + w * w * b[1],
        ];
        errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()))
    };
    (0..table.len()).map(step).fold(0.0, f64::max)
}
