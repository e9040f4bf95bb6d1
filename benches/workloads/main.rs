//! The workloads: `cargo bench --bench workloads -- W6 [more names]` prints one JSON line a figure; no name: all of them.
//!
//! `once W6-planar_revolute kin 10` runs one route alone, for counting instructions.

mod measure;
mod w6;
mod w6_hand;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["once", name, route, batches] => once(name, route, batches),
        [] => run("W6"),
        _ => words.iter().for_each(|name| run(name)),
    }
}

fn run(name: &str) {
    match name {
        "W6" => w6::run().iter().for_each(measure::Figure::print),
        other => eprintln!("there is no workload `{other}`; there is W6"),
    }
}

fn once(name: &str, route: &str, batches: &str) {
    let joint = name.strip_prefix("W6-").unwrap_or(name);
    if w6::once(joint, route, batches.parse().unwrap_or(1)).is_none() {
        eprintln!("there is no joint `{joint}` in W6");
    }
}
