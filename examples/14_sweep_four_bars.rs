//! Ten thousand four-bars at once. Lengths in m, angles in rad, time in s.
//!
//! What to see: the map, `swing.svg`, has ten thousand four-bars, all with the same crank and
//! ground, coupler to the right and rocker upwards; the colour is how far the rocker swings. Blank
//! are those whose crank cannot turn all the way round (Grashof's rule, found without being told):
//! that is no error of the sweep, each four-bar has its row and status in the file. The page shows
//! the one that swings widest. Cases run on all cores, by one program of all of them, many times of
//! a case at once.
//!
//! `cargo run --release --example 14_sweep_four_bars`

use std::io::Write;

use kin::prelude::*;
use kin_view::{Map, Scene};

const OUT: &str = "out/14_sweep_four_bars";
const SIDE: usize = 100; // four-bars along either side of the map
const COUNT: usize = SIDE * SIDE;
const LEAST: f64 = 1.5; // m: coupler and rocker go from here
const MOST: f64 = 5.5; // to here

/// Crank, coupler, rocker, distance of the ground pins.   [m]
type Links = [f64; 4];

// 1. One four-bar, frames at mid-link; the crank turns once in 2π seconds.
fn four_bar([a, b, c, d]: Links) -> kin::Result<(Mechanism, Link)> {
    let mut m = Mechanism::new("four-bar");
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", b)?;
    let rocker = m.link("rocker", c)?;
    m.add("O", revolute(m.ground(), crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(m.ground(), rocker, vec2(d, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(1.0)))?;
    m.prefer(rocker, deg(100.0));
    Ok((m, rocker))
}

// 2. What differs from case to case, by name, and the numbers of one case: a link of length 2 u
//    reaches from −u to u.
const NAMES: [&str; 7] =
    ["O.u_j.x", "A.u_i.x", "A.u_j.x", "B.u_i.x", "B.u_j.x", "C.u_j.x", "C.u_i.x"];

fn case([a, b, c, d]: Links) -> [f64; 7] {
    [-a / 2.0, a / 2.0, -b / 2.0, b / 2.0, c / 2.0, -c / 2.0, d]
}

/// What is kept of one motion: swing of the rocker [rad], its greatest acceleration [rad/s²].
struct Kept {
    swing: f64,
    acceleration: f64,
}

fn main() -> kin::Result<()> {
    let links: Vec<Links> = (0..COUNT).map(links_of).collect();
    let cases: Vec<_> = links.iter().copied().map(case).collect();
    let times = linspace(0.0, TAU, 361);
    let (mechanism, rocker) = four_bar([1.0, 3.5, 3.0, 4.0])?;
    mechanism.write_json(format!("{OUT}/mechanism.json"))?;
    let system = mechanism.build()?;

    // 3. The sweep. Of each motion two numbers are kept; of a failure, its message.
    let sweep = system.sweep(NAMES)?.progress(|done, all| eprint!("\r{done} of {all} four-bars"));
    let results = sweep.run(&cases, &times, |_, motion| {
        let rocker = motion
            .and_then(|motion| motion.coordinate(rocker.theta()))
            .map_err(|error| error.to_string())?;
        let greatest = rocker.second_rate.max().max(-rocker.second_rate.min());
        Ok(Kept { swing: rocker.value.max() - rocker.value.min(), acceleration: greatest })
    })?;
    eprintln!();

    // 4. Results: a row for each four-bar, and the motion of the one that swings widest.
    write(&links, &results).map_err(|source| kin::Error::File { path: OUT.into(), source })?;
    let turning: Vec<(&Links, &Kept)> = links
        .iter()
        .zip(&results)
        .filter_map(|(links, kept)| Some((links, kept.as_ref().ok()?)))
        .collect();
    println!(
        "{} four-bars: the crank of {} turns all the way round, {} lock",
        COUNT,
        turning.len(),
        COUNT - turning.len()
    );
    if let Some(([a, b, c, d], widest)) =
        turning.iter().max_by(|x, y| x.1.swing.total_cmp(&y.1.swing))
    {
        println!(
            "widest swing {:.1}° with links {a:.3}, {b:.3}, {c:.3} m, pins {d:.3} m apart,",
            widest.swing.to_degrees()
        );
        println!("  at up to {:.2} rad/s² for a crank at 1 rad/s", widest.acceleration);
        let (mechanism, rocker) = four_bar([*a, *b, *c, *d])?;
        let system = mechanism.build()?;
        let mut motion = system.run(&times)?;
        let scene = Scene::new(&system);
        motion.add_point("C", rocker, rocker.start())?;
        motion.write_csv(format!("{OUT}/motion.csv"))?;
        scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
        scene
            .page(&motion)?
            .coordinate("Rocker", &motion.coordinate(rocker.theta())?)
            .save(format!("{OUT}/index.html"))?;
    }
    let swings =
        results.iter().map(|kept| kept.as_ref().map_or(f64::NAN, |kept| kept.swing.to_degrees()));
    let map = Map::new("How far the rocker swings", "swing [°]")
        .along_x("coupler [m]", LEAST, MOST, SIDE)
        .along_y("rocker [m]", LEAST, MOST, SIDE);
    map.values(swings).save(format!("{OUT}/swing.svg"))?;
    println!("wrote {OUT}/: four_bars.csv, swing.svg, motion.csv, animated.svg, index.html");
    Ok(())
}

fn write(links: &[Links], results: &[Result<Kept, String>]) -> std::io::Result<()> {
    std::fs::create_dir_all(OUT)?;
    let mut file = std::io::BufWriter::new(std::fs::File::create(format!("{OUT}/four_bars.csv"))?);
    writeln!(
        file,
        "crank [m],coupler [m],rocker [m],ground [m],swing [rad],greatest acceleration [rad/s^2],status"
    )?;
    for ([a, b, c, d], kept) in links.iter().zip(results) {
        write!(file, "{a:.6},{b:.6},{c:.6},{d:.6},")?;
        match kept {
            Ok(Kept { swing, acceleration }) => {
                writeln!(file, "{swing:.9},{acceleration:.9},done")?
            }
            Err(message) => writeln!(
                file,
                ",,\"{}\"",
                message.lines().next().unwrap_or_default().replace('"', "'")
            )?,
        }
    }
    file.flush()
}

/// Links of four-bar k: crank and ground alike, coupler and rocker over a square.
fn links_of(k: usize) -> Links {
    let part = |k: usize| LEAST + (MOST - LEAST) * k as f64 / (SIDE - 1) as f64;
    [1.0, part(k % SIDE), part(k / SIDE), 4.0]
}
