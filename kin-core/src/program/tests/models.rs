//! The mechanisms of the gallery, and a few that it lacks.

use crate::data::Registry;
use crate::joints::{drivers::drive_angle, planar::revolute};
use crate::{Ground, Law, Mechanism, System, deg, vec2};

/// Every mechanism of the gallery that is made of the library's constraints.
fn gallery() -> Vec<(String, System)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/examples");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the gallery")
        .map(|file| file.expect("a file").path())
        .collect();
    paths.sort();
    let system = |path: &std::path::PathBuf| {
        let mechanism = Mechanism::read_json(path, &Registry::new()).ok()?;
        Some((path.file_stem()?.to_string_lossy().into_owned(), mechanism.build().ok()?))
    };
    paths.iter().filter_map(system).collect()
}

/// All that passes are tried on.
pub(crate) fn systems() -> impl Iterator<Item = (String, System)> {
    let own = [("four-bar", four_bar(1.0)), ("chain", chain(12))];
    gallery().into_iter().chain(own.map(|(name, system)| (name.to_string(), system)))
}

/// The four-bar of the workloads, its crank's length given.
pub(crate) fn four_bar(crank_length: f64) -> System {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", crank_length).expect("a link");
    let coupler = m.link("coupler", 3.5).expect("a link");
    let rocker = m.link("rocker", 3.0).expect("a link");
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start())).expect("adds");
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start())).expect("adds");
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end())).expect("adds");
    m.add("C", revolute(Ground, rocker, vec2(4.0, 0.0), rocker.start())).expect("adds");
    m.add("motor", drive_angle(crank, Law::ramp(6.0))).expect("adds");
    m.prefer(rocker, deg(100.0));
    m.build().expect("builds")
}

/// A chain of links, each driven against the one before.
fn chain(links: usize) -> System {
    let mut m = Mechanism::new("chain");
    let mut last: Option<crate::Link> = None;
    for k in 0..links {
        let link = m.link(&format!("link {k}"), 1.0).expect("a link");
        let law = Law::sine(0.3, 1.0, 0.1 * k as f64);
        match last {
            None => {
                m.add("pin 0", revolute(Ground, link, vec2(0.0, 0.0), link.start())).expect("adds")
            }
            Some(last) => m
                .add(&format!("pin {k}"), revolute(last, link, last.end(), link.start()))
                .expect("adds"),
        };
        m.add(&format!("motor {k}"), drive_angle(link, law)).expect("adds");
        last = Some(link);
    }
    m.build().expect("builds")
}
