//! The cost of a diagnosis, in time of the processor: other programs may run beside it. Builds
//! without optimisation are given thirty times as long.

use std::time::Duration;

use kin::prelude::*;
use rustix::time::{ClockId, clock_gettime};

use crate::plan::{Joint, View, chain};

/// Time of the processor in this thread.
fn now() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// Driven links in a row, the last one let go and the first one driven twice, from a guess that is
/// off.
fn examined(links: usize) -> (kin::diagnosis::Diagnosis, Duration) {
    let angles: Vec<f64> = (0..links).map(|k| 0.4 * (0.7 * k as f64).sin()).collect();
    let mut motors: Vec<Joint> = angles
        .iter()
        .enumerate()
        .map(|(k, angle)| Joint::Motor(k, *angle, 1.0))
        .take(links - 1)
        .collect();
    motors.push(Joint::Motor(0, angles[0], 1.0));
    let mut plan = chain(&angles, None, &motors);
    plan.links.iter_mut().enumerate().for_each(|(k, (_, q))| q[2] += 0.02 * (k as f64).cos());
    let system: System = plan.mechanism(&View::plain()).build().unwrap();
    let begun = now();
    let found = system.diagnose(0.0).unwrap();
    (found, now() - begun)
}

fn limited(links: usize, seconds: f64) {
    let (found, time) = examined(links);
    println!("{} coordinates in {time:?}", 3 * links);
    assert_eq!(
        (found.coordinates, found.rank, found.nearby_rank),
        (3 * links, 3 * links - 1, 3 * links - 1)
    );
    assert_eq!(found.redundancies().next().unwrap().terms.len(), 2);
    assert_eq!(
        found.lasting_freedoms().next().unwrap().motions[0].names,
        [format!("link {links}")]
    );
    let limit = if cfg!(debug_assertions) { 30.0 * seconds } else { seconds };
    assert!(time.as_secs_f64() < limit, "{time:?}");
}

#[test]
fn three_hundred_coordinates_within_a_second() {
    limited(100, 1.0);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "slow without optimisation")]
fn three_thousand_coordinates_within_half_a_minute() {
    limited(1000, 30.0);
}

/// Ten times three cranks and a coupler, turned together by one motor. The third crank holds its
/// coupler at a point, or only on a line: then no equation is superfluous, and away from where the
/// line is along the crank the motion is the same.
fn cranks(redundant: bool) -> System {
    let mut m = Mechanism::new("cranks");
    let pivots = [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(0.8, -0.5)];
    let mut turned: Option<PlanarBody> = None;
    for n in 0..10 {
        let coupler = m.planar(&format!("coupler {n}"), pose(0.5, 0.8, 0.0)).unwrap();
        let cranks = [1, 2, 3].map(|k| m.link(&format!("crank {n}.{k}"), 1.0).unwrap());
        for (k, (crank, pivot)) in cranks.iter().zip(pivots).enumerate() {
            m.add(&format!("O{n}.{k}"), revolute(m.ground(), *crank, pivot, crank.start()))
                .unwrap();
            if k < 2 || redundant {
                m.add(&format!("A{n}.{k}"), revolute(*crank, coupler, crank.end(), pivot)).unwrap();
            } else {
                m.add(
                    &format!("A{n}.{k}"),
                    point_on_line(*crank, coupler, crank.end(), pivot, vec2(1.0, 0.2)),
                )
                .unwrap();
            }
        }
        let driven = match turned {
            None => m.add("motor", drive_angle(cranks[0], Law::linear(0.6, 1.0))),
            Some(before) => m.add(
                &format!("belt {n}"),
                coupling(before.theta(), cranks[0].theta(), 1.0, -1.0, 0.0),
            ),
        };
        driven.unwrap();
        turned = Some(cranks[0].into());
    }
    m.build().unwrap()
}

/// A run takes so long for each Newton step with all that belongs to it.   \[s\]
fn step(system: &System) -> f64 {
    let times = kin::linspace(0.0, 1.0, 1000);
    let begun = now();
    let plain = kin::SolverOptions::new().engine(kin::Engine::StepByStep);
    let motion = system.solver().options(plain.clone()).run(&times).unwrap();
    let steps: usize = motion.iterations().iter().skip(1).map(|steps| steps + 1).sum();
    (now() - begun).as_secs_f64() / steps as f64
}

/// The median of ratios taken side by side.
#[test]
fn redundant_step_takes_at_most_twice_a_square_one() {
    let redundant = cranks(true);
    let square = cranks(false);
    let mut ratios: Vec<f64> = (0..if cfg!(debug_assertions) { 3 } else { 15 })
        .map(|_| step(&redundant) / step(&square))
        .collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = ratios[ratios.len() / 2];
    println!("{ratio:.2} of {ratios:.2?}");
    assert!(ratio < if cfg!(debug_assertions) { 4.0 } else { 2.0 }, "{ratios:.2?}");
}

/// Bodies that nothing holds.
fn free_bodies(count: usize) -> (kin::diagnosis::Diagnosis, Duration) {
    let mut m = Mechanism::new("heap");
    for k in 0..count {
        m.planar(&format!("body {k}"), pose(0.1 * k as f64, 0.0, 0.0)).unwrap();
    }
    let begun = now();
    let found = m.diagnose(0.0).unwrap();
    (found, now() - begun)
}

/// The text tells a few and how many more there are; the fields have all of them.
#[test]
fn diagnosis_of_many_free_bodies_is_short_to_print() {
    let (found, time) = free_bodies(3000);
    let text = found.to_string();
    println!("{} characters in {time:?}", text.len());
    assert!(text.len() < 3000 && text.contains("2994 more"), "{text}");
    assert_eq!((found.freedoms.len(), found.changes.len()), (9000, 3000));
    assert!(time.as_secs_f64() < if cfg!(debug_assertions) { 30.0 } else { 1.0 }, "{time:?}");
}

#[test]
fn twenty_thousand_free_bodies_are_diagnosed_in_time() {
    let (found, time) = free_bodies(20_000);
    println!("{time:?}");
    assert!(found.to_string().len() < 3000 && found.freedoms.len() == 60_000);
    assert!(time.as_secs_f64() < if cfg!(debug_assertions) { 60.0 } else { 5.0 }, "{time:?}");
}
