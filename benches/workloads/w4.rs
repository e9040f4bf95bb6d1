//! W4: the driven serial chain, N = 10, 100, 1000, 10000 links.

use kin::prelude::*;

use crate::hand::chain::{exact, run};
use crate::sweep::{Table, Workload, add, build, routes};

const DT: f64 = 0.01;
const LINKS: [usize; 4] = [10, 100, 1000, 10_000];

/// The angle from one body to the next follows a law: θ_i − θ_{i−1} − φ(t) = 0.
#[constraint(symbolic)]
fn drive_between(body: Planar, before: Planar, law: Law, t: Time) -> f64 {
    body.theta - before.theta - law.at(t)
}

/// The workloads of that name: all of W4, or one such as `W4-N100`.
pub fn workloads(name: &str) -> Vec<Workload> {
    LINKS
        .iter()
        .filter(|links| name == "W4" || name == format!("W4-N{links}"))
        .map(|&links| workload(links))
        .collect()
}

/// Names of its parts.
pub fn names() -> impl Iterator<Item = String> {
    LINKS.iter().map(|links| format!("W4-N{links}"))
}

fn workload(links: usize) -> Workload {
    // Runs that are long enough for a program to be what is measured.
    let steps = (100_000 / links).max(200).min(400_000 / links);
    let start = exact(links, 0.0);
    let hand = move || run(&start, steps, DT);
    let routes = routes(hand, |dual| model(links, dual));
    Workload {
        name: format!("W4-N{links}"),
        dt: DT,
        steps,
        links: Some(links),
        routes,
        error: Box::new(move |table| error(table, links)),
        allowed: 1e-6,
        build: Box::new(move || model(links, false)),
    }
}

fn model(links: usize, dual: bool) -> System {
    let mut m = Mechanism::new("chain");
    let mut before = None;
    for i in 0..links {
        let link = m.link(&format!("link{i}"), 1.0).unwrap_or_else(|error| panic!("{error}"));
        let (body, end) = before
            .map_or((PlanarBody::from(m.ground()), vec2(0.0, 0.0)), |link: Link| {
                (link.body(), link.end())
            });
        add(&mut m, dual, &format!("pin{i}"), revolute(body, link, end, link.start()));
        add(
            &mut m,
            dual,
            &format!("motor{i}"),
            drive_between(link, body, Law::sine(0.3, 1.0, 0.1 * i as f64)),
        );
        before = Some(link);
    }
    build(m, &exact(links, 0.0)[0])
}

/// The largest error of all coordinates and derivatives, against a recursion from the ground.
fn error(table: &Table, links: usize) -> f64 {
    let step = |k: usize| {
        let [q, qd, qdd] = exact(links, k as f64 * DT);
        let found = table.at(k);
        let pairs = [(q, found.0), (qd, found.1), (qdd, found.2)];
        pairs
            .iter()
            .flat_map(|(exact, found)| exact.iter().zip(*found))
            .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()))
    };
    (0..table.len()).map(step).fold(0.0, f64::max)
}
