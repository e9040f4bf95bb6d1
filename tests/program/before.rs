//! The motions of the examples, as the last commit before the rooms of the core wrote them, beside
//! those of today's by either engine.

use std::collections::BTreeMap;

use kin::Engine;
use kin::prelude::*;
use serde::Deserialize;

use crate::gallery::mechanisms;

/// The motion of one example: first and last time and their number, names of its coordinates, and
/// q, q̇ and q̈ at some of the times, by their numbers.
#[derive(Deserialize)]
struct Before {
    times: (f64, f64, usize),
    names: Vec<String>,
    rows: BTreeMap<usize, [Vec<f64>; 3]>,
}

fn before() -> BTreeMap<String, Before> {
    let text = include_str!("../data/before_the_rooms.json");
    serde_json::from_str(text).expect("the motions")
}

/// This one turns at its change points, by options of its own.
const TURNS: &str = "16_change_points";

/// How far q, q̇ and q̈ may be off, against 1 or their size: rounding of other steps and sums.
const ALLOWED: [f64; 3] = [1e-11, 1e-10, 1e-9];

#[test]
fn examples_move_as_before_the_rooms() {
    let before = before();
    let mut seen = 0;
    for (name, system) in mechanisms().into_iter().filter(|(name, _)| name != TURNS) {
        let Some(Before { times: (first, last, count), names, rows }) = before.get(&name) else {
            continue;
        };
        assert_eq!(&system.coordinate_names(), names, "{name}");
        seen += 1;
        for engine in [Engine::StepByStep, Engine::Compiled] {
            let options = kin::SolverOptions::new().engine(engine);
            let motion = system
                .solver()
                .options(options.clone())
                .run(linspace(*first, *last, *count))
                .expect("runs");
            for (k, orders) in rows {
                for (order, (was, is)) in
                    orders.iter().zip([motion.q(*k), motion.qd(*k), motion.qdd(*k)]).enumerate()
                {
                    let size = was.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
                    for (j, (was, is)) in was.iter().zip(is).enumerate() {
                        let off = (was - is).abs() / size;
                        assert!(
                            off <= ALLOWED[order],
                            "{name}: {} of order {order} at time {k} is off by {off:e}",
                            names[j]
                        );
                    }
                }
            }
        }
    }
    assert!(seen >= 20, "{seen} examples are not all");
}
