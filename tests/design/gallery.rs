//! All mechanisms of the gallery: derivatives by their parameters against differences of runs,
//! extrapolated.

use kin::data::Registry;
use kin::prelude::*;

use crate::engines::Engines;

#[path = "../data/own.rs"]
mod own;

/// How far each example is looked at where that is not 1 s: none of them to a singular position.
/// [s]
const SECONDS: [(&str, f64); 3] =
    [("16_change_points", 0.2), ("20_geneva_drive", 0.4), ("02_two_link_manipulator", 20.0)];

/// Parameters of each mechanism that are compared.
const COMPARED: usize = 4;

/// q, q̇ and q̈ at each time, one list an order.
fn orders(motion: &Motion) -> [Vec<f64>; 3] {
    let all = |of: &dyn Fn(usize) -> Vec<f64>| (0..motion.len()).flat_map(of).collect();
    [
        all(&|k| motion.q(k).to_vec()),
        all(&|k| motion.qd(k).to_vec()),
        all(&|k| motion.qdd(k).to_vec()),
    ]
}

/// The derivatives by one parameter from runs with h and h/2 more and less (Richardson); `None`
/// where the mechanism has no such motion.
fn differences(system: &System, times: &[f64], name: &str, h: f64) -> Option<[Vec<f64>; 3]> {
    let value = system.parameter(name).ok()?;
    let at = |step: f64| {
        let mut moved = system.clone();
        moved.set(name, value + step).ok()?;
        moved.run_both(times).ok().map(|motion| orders(&motion))
    };
    let central = |h: f64| {
        let plus = at(h)?;
        let minus = at(-h)?;
        let slope = |order: usize| -> Vec<f64> {
            plus[order].iter().zip(&minus[order]).map(|(a, b)| (a - b) / (2.0 * h)).collect()
        };
        Some([slope(0), slope(1), slope(2)])
    };
    let wide = central(h)?;
    let narrow = central(0.5 * h)?;
    let both = |order: usize| {
        wide[order]
            .iter()
            .zip(&narrow[order])
            .map(|(wide, narrow)| (4.0 * narrow - wide) / 3.0)
            .collect()
    };
    Some([both(0), both(1), both(2)])
}

/// The largest difference of each order, by the largest derivative of that order or 1.
fn apart(exact: &[Vec<f64>; 3], found: &[Vec<f64>; 3]) -> [f64; 3] {
    [0, 1, 2].map(|order| {
        let size = exact[order].iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        let off = exact[order].iter().zip(&found[order]).map(|(a, b)| (a - b).abs());
        off.fold(0.0, f64::max) / size
    })
}

/// A mechanism of the gallery, read from its file.
fn system(path: &std::path::Path) -> System {
    let registry = Registry::new()
        .with::<own::slider_crank>()
        .with::<own::parabolic_slot>()
        .with::<own::geneva>();
    Mechanism::read_json(path, &registry).expect("reads").build().expect("builds")
}

#[test]
fn derivatives_of_the_gallery_are_those_of_its_runs() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/examples");
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the gallery")
        .map(|file| file.expect("a file").path())
        .collect();
    paths.sort();
    assert!(paths.len() >= 22);
    for path in paths {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let mut system = system(&path);
        let seconds =
            SECONDS.iter().find(|(known, _)| *known == name).map_or(1.0, |(_, seconds)| *seconds);
        // Odd numbers, off the knots of splines and the dwells of cams.
        let times: Vec<f64> = (0..12).map(|k| seconds * (f64::from(k) + 0.137) / 12.3).collect();
        let motion = system.run_both(&times).expect("a motion");
        system.set_initial(motion.q(0)).expect("a pose");
        let parameters = system.parameters();
        let stride = (parameters.len() / 23).max(1);
        let mut compared = 0;
        let mut refused = 0;
        let mut worst = [0.0_f64; 3];
        for (parameter, value) in parameters.iter().step_by(stride) {
            let by = system.sensitivities(&motion, [parameter]);
            let steps = [3e-3, 1e-3, 1e-4].map(|h| h * value.abs().max(0.1));
            let Ok(by) = by else {
                let told = by.err().expect("an error").to_string();
                assert!(
                    told.contains(&format!("Kin cannot compute a derivative by `{parameter}`")),
                    "{name}: {told}"
                );
                refused += 1;
                continue;
            };
            if compared == COMPARED {
                break;
            }
            let one = &by.all()[0];
            let all = |of: &dyn Fn(usize) -> Vec<f64>| (0..motion.len()).flat_map(of).collect();
            let exact = [
                all(&|k| one.q(k).to_vec()),
                all(&|k| one.qd(k).to_vec()),
                all(&|k| one.qdd(k).to_vec()),
            ];
            let found = steps.map(|h| differences(&system, &times, parameter, h));
            let off: Vec<[f64; 3]> =
                found.iter().flatten().map(|found| apart(&exact, found)).collect();
            let Some(least) = off.iter().copied().reduce(|a, b| [0, 1, 2].map(|k| a[k].min(b[k])))
            else {
                panic!("{name}: no motion beside this value of {parameter}");
            };
            assert!(
                least.iter().zip([1e-8, 1e-8, 1e-7]).all(|(off, limit)| *off < limit),
                "{name}: by {parameter} {least:?}"
            );
            worst = [0, 1, 2].map(|k| worst[k].max(least[k]));
            compared += 1;
        }
        println!("{name}: {compared} compared, {refused} refused, off by {worst:?}");
        assert!(compared >= 2, "{name}: {compared} compared, {refused} refused");
    }
}
