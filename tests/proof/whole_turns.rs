//! The examples' mechanisms, proved for as long as they run.

use kin::Registry;
use kin::prelude::*;

use crate::own;

/// Each example with its seconds and the number of its times.
const EXAMPLES: [(&str, f64, usize); 16] = [
    ("01_slider_crank", 1.0, 721),
    ("02_two_link_manipulator", 24.0, 2401),
    ("03_custom_constraint", 1.0, 361),
    ("04_four_bar", 1.0, 1001),
    ("05_quick_return", 1.0, 721),
    ("06_scotch_yoke", 2.0, 401),
    ("07_cam_follower", 2.0, 961),
    ("08_peaucellier", 2.0, 401),
    ("09_jansen_leg", 1.0, 361),
    ("10_drawn_path", 6.0, 601),
    ("11_epicyclic_gears", 8.0, 801),
    ("12_hookes_joint", 4.0, 401),
    ("13_stewart_platform", 8.0, 1601),
    ("14_sweep_four_bars", 6.0, 361),
    ("15_windscreen_wiper", 1.0, 361),
    ("16_change_points", 1.0, 361),
];

fn example(name: &str) -> System {
    let path = format!("{}/tests/data/examples/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let registry = Registry::new().with::<own::slider_crank>().with::<own::parabolic_slot>();
    Mechanism::read_json(path, &registry).expect("reads").build().expect("builds")
}

#[test]
fn explore() {
    for (name, seconds, times) in EXAMPLES {
        let system = example(name);
        let motion = match system.run(linspace(0.0, seconds, times)) {
            Ok(motion) => motion,
            Err(error) => {
                println!("{name}: {error}");
                continue;
            }
        };
        let begin = std::time::Instant::now();
        match system.prove(&motion) {
            Ok(proof) => println!("{name} ({:.2} s): {proof}", begin.elapsed().as_secs_f64()),
            Err(error) => println!("{name}: {error}"),
        }
    }
}
