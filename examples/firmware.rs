//! A four-bar as a file of C for a controller. Lengths in m, angles in rad.
//!
//! What to see: `out/firmware/four_bar.c` contains the whole kinematics; its comment lists drivers,
//! coordinates and equations. The crank and the base remain fields of a structure. With a C
//! compiler `cc` the example compiles the file and lets it test itself, as a controller does.
//!
//! `cargo run --release --example firmware`

use std::process::Command;

use kin::emit::{self, Options};
use kin::prelude::*;

const OUT: &str = "out/firmware";

/// Tests the file and turns the crank by one revolution.
const MAIN: &str = r#"#include <stdio.h>

#include "four_bar.c"

int main(void)
{
    four_bar_state s;
    four_bar_dimensions d = four_bar_nominal;
    double qd[four_bar_COORDINATES], qdd[four_bar_COORDINATES], m[four_bar_MEASURES];
    const double speed = 6.0, rest = 0.0;
    int step, code;
    printf("self test: %d\n", four_bar_selftest());
    d.crank = 1.02; /* as measured on this machine */
    code = four_bar_start(&s, &d);
    for (step = 1; step <= 628 && code == four_bar_OK; step++) {
        const double u = 0.01 * step;
        code = four_bar_to(&s, &u);
        if (step % 157 == 0) {
            four_bar_rates(&s, &speed, &rest, qd, qdd);
            four_bar_measures(s.q, m);
            printf("crank %.2f rad: rocker %.6f rad, %+.6f rad/s\n", u, m[0], qd[8]);
        }
    }
    printf("%s\n", four_bar_text(code));
    return code;
}
"#;

fn main() -> kin::Result<()> {
    // 1. The mechanism, with named lengths.
    let mut m = Mechanism::new("four bar");
    let a = m.dimension("crank", 1.0)?.unit("m");
    let d = m.dimension("base", 4.0)?.unit("m");
    let crank = m.link("crank", a)?;
    let coupler = m.link("coupler", 3.5)?;
    let rocker = m.link("rocker", 3.0)?;
    m.add("O", revolute(Ground, crank, vec2(0.0, 0.0), crank.start()))?;
    m.add("A", revolute(crank, coupler, crank.end(), coupler.start()))?;
    m.add("B", revolute(coupler, rocker, coupler.end(), rocker.end()))?;
    m.add("C", revolute(Ground, rocker, (d, 0.0), rocker.start()))?;
    m.add("motor", drive_angle(crank, Law::ramp(TAU)))?;
    m.prefer(rocker, deg(100.0));
    let system = m.build()?;

    // 2. The file, with two lengths free.
    let options = Options {
        free: ["crank", "base"].map(str::to_string).to_vec(),
        measures: vec!["rocker.theta".to_string()],
        ..Options::default()
    };
    let text = emit::c(&system, &options)?;
    println!("{} lines of C in {OUT}/four_bar.c", text.lines().count());

    // 3. What a controller does with it.
    let run = || -> std::io::Result<()> {
        std::fs::create_dir_all(OUT)?;
        std::fs::write(format!("{OUT}/four_bar.c"), text)?;
        std::fs::write(format!("{OUT}/main.c"), MAIN)?;
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c99", "-O2", "main.c", "-o", "controller", "-lm"]).current_dir(OUT);
        match compiler.status() {
            Ok(status) if status.success() => {
                Command::new(format!("{OUT}/controller")).status().map(|_| ())
            }
            _ => {
                println!("NOT RUN: there is no C compiler `cc`");
                Ok(())
            }
        }
    };
    run().unwrap_or_else(|error| println!("{OUT}: {error}"));
    Ok(())
}
