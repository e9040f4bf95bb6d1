//! Mistakes that people make in mechanisms, each with what it is told: word for word in
//! `docs/mistakes.md` and in `more.md` here (`KIN_BLESS=1 cargo test --test mistakes` writes both
//! anew; look at the difference). The first thing named is the one that a designer would change
//! first, and the advice of the message is followed: the mechanism then moves.

mod closing;
#[path = "../data/engines.rs"]
mod engines;
mod given;
mod motors;
mod page;
mod planar;
mod running;
mod space;

use kin::prelude::*;

use crate::engines::Engines;

/// A mistake and its cure.
struct Mistake {
    /// The mistake.
    title: &'static str,
    /// The line at fault.
    line: &'static str,
    /// The thing that a designer would change first, by the name that the message must give before
    /// all others.
    culprit: &'static str,
    /// The message about the mistake (true), or the motion where the message has been followed
    /// (false).
    told: fn(bool) -> Told,
}

/// A motion, or a message.
type Told = Result<Motion, String>;

fn all() -> Vec<Mistake> {
    [motors::all(), closing::all(), planar::all(), space::all(), running::all(), given::all()]
        .into_iter()
        .flatten()
        .collect()
}

/// The result of a run over the first second.
fn run(m: Mechanism) -> Told {
    m.build()
        .and_then(|system| system.run_both(linspace(0.0, 1.0, 21)))
        .map_err(|error| error.to_string())
}

/// The summary of a run in which a mistake passes without an error.
fn summary(m: Mechanism, wrong: bool) -> Told {
    let motion = run(m)?;
    if wrong { Err(motion.summary()) } else { Ok(motion) }
}

/// The lecture's four-bar with these lengths, without motor.
fn four_bar([crank, coupler, rocker]: [f64; 3], ground: f64) -> (Mechanism, [Link; 3]) {
    let mut m = Mechanism::new("four-bar");
    let links = [("crank", crank), ("coupler", coupler), ("rocker", rocker)]
        .map(|(name, length)| m.link(name, length).unwrap());
    let [crank, coupler, rocker] = links;
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start())).unwrap();
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).unwrap();
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).unwrap();
    m.add("C", revolute(m.ground(), rocker, vec2(ground, 0.0), rocker.start())).unwrap();
    (m, links)
}

/// The same with a motor on its crank.
fn driven([crank, coupler, rocker]: [f64; 3], ground: f64, begin: f64) -> Mechanism {
    let (mut m, [crank, ..]) = four_bar([crank, coupler, rocker], ground);
    m.add("motor", drive_angle(crank, Law::linear(begin, 1.0))).unwrap();
    m
}
