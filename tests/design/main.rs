//! Sensitivities by parameters, forward and adjoint, against 60-digit references
//! (`tests/data/README.md`); and derivatives that do not exist.

// Its mechanisms are those of other files.
#[allow(dead_code)]
#[path = "../data/mod.rs"]
mod data;
#[path = "../data/engines.rs"]
mod engines;
mod gallery;
mod gradients;
mod laws;
mod model;
mod objective;
mod redundant;
mod refused;
mod toggles;

use data::{error, numbers, rows};
use kin::SolverOptions;
use kin::prelude::*;
use kin::results::{Extreme, Measure, Quantity};
use kin::solver::Stop;
use model::{Model, model};
use serde_json::Value;

use crate::engines::Engines;

const FILES: [&str; 8] = [
    "cam_knife",
    "fourbar_open",
    "quick_return_shaper",
    "rssr",
    "slider_crank_bodies",
    "slider_crank_loop",
    "slider_crank_spline_law",
    "two_link_ellipse",
];

/// The times of the references themselves, which are few: their equations are walked with dual
/// numbers. And as many parts of each step: derivatives by a tape of the whole mechanism.
const PARTS: [usize; 2] = [1, 12];

/// Limits of q, q̇ and q̈ by a parameter, relative to 1 + the largest number.
const LIMITS: [f64; 3] = [1e-12, 1e-11, 1e-10];

fn run(model: &Model, times: &[f64]) -> Motion {
    let stop = Stop::Converged { tolerance: 1e-15 };
    model.system.run_both_with(times, &SolverOptions::new().stop(stop)).expect("a motion")
}

/// The times with so many parts of each step.
fn refined(times: &[f64], parts: usize) -> Vec<f64> {
    let step = |pair: &[f64]| {
        let from = pair[0];
        let to = pair[1];
        (0..parts).map(move |k| from + (to - from) * k as f64 / parts as f64)
    };
    times.windows(2).flat_map(step).chain(times.last().copied()).collect()
}

fn names(list: &Value) -> Vec<String> {
    list.as_array()
        .expect("a list")
        .iter()
        .map(|name| name.as_str().expect("a name").to_string())
        .collect()
}

/// Σ factor · ∂/∂p over the system's parameters behind one of the file.
fn total(model: &Model, parameter: &str, of: impl Fn(&str) -> Vec<f64>) -> Vec<f64> {
    let mut sum: Vec<f64> = Vec::new();
    for (name, factor) in model.behind(parameter) {
        let own = of(name);
        sum.resize(own.len(), 0.0);
        sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += factor * own);
    }
    sum
}

#[test]
fn coordinates_and_rates_by_each_parameter_of_the_references() {
    for (name, parts) in FILES.into_iter().flat_map(|name| PARTS.map(|parts| (name, parts))) {
        let model = model(name);
        let motion = run(&model, &refined(&numbers(&model.file, "time"), parts));
        let found = model.system.sensitivities(&motion, model.parameters()).expect("sensitivities");
        let compiled = found.compiled();
        assert!(
            if parts == 1 { compiled == 0 } else { 10 * compiled > 9 * motion.len() },
            "{name}: {compiled}"
        );
        let mut worst = [0.0_f64; 3];
        for parameter in names(&model.file["sensitivity_parameters"]) {
            if model.behind(&parameter).is_empty() {
                continue; // a point of the file's outputs only
            }
            for (order, field) in ["q", "qd", "qdd"].into_iter().enumerate() {
                let exact = rows(&model.file["sensitivity"][&parameter], field).concat();
                let of = |name: &str| {
                    let by = found.by(name).expect("a parameter");
                    let row = |k: usize| [by.q(k), by.qd(k), by.qdd(k)][order].to_vec();
                    (0..motion.len()).step_by(parts).flat_map(row).collect()
                };
                let off = error(&total(&model, &parameter, of), &exact);
                assert!(off <= LIMITS[order], "{name}: {field} by {parameter} is off by {off:.1e}");
                worst[order] = worst[order].max(off);
            }
        }
        println!(
            "{name}, {compiled} compiled: q {:.1e}, qd {:.1e}, qdd {:.1e}",
            worst[0], worst[1], worst[2]
        );
    }
}

/// An output as a measure.
type Output<'a> = Box<dyn Fn(&Motion) -> kin::Result<Quantity> + 'a>;

/// An output of the file; `None` of the one that no measure is.
fn output<'a>(model: &'a Model, name: &str) -> Option<Output<'a>> {
    let list = model.file["outputs"].as_array().expect("outputs");
    let output = list.iter().find(|output| output["name"] == name).expect("an output").clone();
    let planar =
        |name: &Value| model.planar.iter().find(|(known, _)| name == known).map(|(_, body)| *body);
    if let Some(local) = output["local"].as_array() {
        let value = |text: &Value| {
            let text = text.as_str().expect("a text");
            text.parse::<f64>().unwrap_or_else(|_| data::number(&model.file["parameters"], text))
        };
        let u: Vec<f64> = local.iter().map(value).collect();
        let axis = output["component"].as_u64().expect("a component");
        if let Some(body) = planar(&output["body"]) {
            let n = [vec2(1.0, 0.0), vec2(0.0, 1.0)][axis as usize];
            return Some(Box::new(move |m| Ok(m.point(body, vec2(u[0], u[1]))?.along(n))));
        }
        let body = model.spatial.iter().find(|(known, _)| output["body"] == *known)?.1;
        let n = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)][axis as usize];
        return Some(Box::new(move |m| Ok(m.point(body, vec3(u[0], u[1], u[2]))?.along(n))));
    }
    let expression = output["expr"].as_str().expect("an expression").to_string();
    match expression.as_str() {
        "fore_theta - upper_theta" => {
            let [upper, fore] = [model.planar[0].1, model.planar[1].1];
            Some(Box::new(move |m| m.relative_angle(fore, upper)))
        }
        "acos(cos(rocker_theta - coupler_theta))" => {
            let [coupler, rocker] = [model.planar[1].1, model.planar[2].1];
            Some(Box::new(move |m| m.relative_angle(rocker, coupler)))
        }
        "2*atan2(rocker_e3, rocker_e0)" => None,
        other => {
            let name =
                other.replace("_Rx", ".R_x").replace("_Ry", ".R_y").replace("_theta", ".theta");
            Some(Box::new(move |m| m.named(&name)))
        }
    }
}

/// True if the output itself reads a parameter of the file: the place of its point.
fn is_local(model: &Model, output: &Value, parameter: &str) -> bool {
    output["local"].as_array().is_some_and(|local| local.iter().any(|text| text == parameter))
        || model.behind(parameter).is_empty()
}

#[test]
fn outputs_by_each_parameter_of_the_references() {
    for name in FILES {
        let model = model(name);
        let motion = run(&model, &numbers(&model.file, "time"));
        let found = model.system.sensitivities(&motion, model.parameters()).expect("sensitivities");
        for output in model.file["outputs"].as_array().expect("outputs") {
            let of = self::output(&model, output["name"].as_str().expect("a name"));
            let Some(of) = of else { continue };
            let all = found.of(|m: &Motion| of(m)).expect("derivatives");
            for parameter in names(&model.file["sensitivity_parameters"]) {
                if is_local(&model, output, &parameter) {
                    continue;
                }
                for (order, field) in ["value", "d1", "d2"].into_iter().enumerate() {
                    let exact = numbers(&output["dp"][&parameter], field);
                    let of = |name: &str| {
                        let by = all.iter().find(|by| by.name == name).expect("a parameter");
                        [&by.value, &by.rate, &by.second_rate][order].clone()
                    };
                    let off = error(&total(&model, &parameter, of), &exact);
                    let what = &output["name"];
                    assert!(
                        off <= LIMITS[order],
                        "{name}: {field} of {what} by {parameter}: {off:.1e}"
                    );
                }
            }
        }
    }
}

/// Times and values of extremes and their derivatives, from a grid of 200 steps over the
/// reference's span.
#[test]
fn extremes_by_each_parameter_of_the_references() {
    for name in FILES {
        let model = model(name);
        for event in model.file["events"].as_array().expect("events") {
            let output = event["output"].as_str().expect("an output");
            let Some(of) = self::output(&model, output) else { continue };
            let what = |m: &Motion| of(m);
            let start = numbers(&model.file, "time")[0];
            let span = numbers(event, "between");
            let motion = run(&model, &linspace(start.min(span[0]), span[1], 201));
            let is_max = event["kind"] == "maximum";
            let all = model.system.extremes(&motion, what).expect("extremes");
            let t = data::number(event, "t");
            let value = data::number(event, "value");
            let near =
                |extreme: &&Extreme| extreme.is_max == is_max && (extreme.t - t).abs() < 1e-6;
            let extreme = all.all().iter().find(near).expect("the extreme");
            assert!(
                (extreme.t - t).abs() <= 1e-12 * (1.0 + t.abs()),
                "{name} {output}: {}",
                extreme.t - t
            );
            assert!(
                (extreme.value - value).abs() <= 1e-12 * (1.0 + value.abs()),
                "{name} {output}"
            );
            let found =
                model.system.sensitivities(&motion, model.parameters()).expect("sensitivities");
            let by = found.extreme(what, extreme).expect("derivatives");
            let parameters = names(&model.file["sensitivity_parameters"]);
            let known = parameters.iter().filter(|p| !model.behind(p).is_empty());
            for parameter in known {
                let of = |name: &str| {
                    let by = by.iter().find(|by| by.name == name).expect("a parameter");
                    vec![by.t, by.value]
                };
                let exact = &event["dp"][parameter.as_str()];
                let exact = [data::number(exact, "t"), data::number(exact, "value")];
                let off = error(&total(&model, parameter, of), &exact);
                assert!(
                    off <= 1e-10,
                    "{name}: {} by {parameter} is off by {off:.1e}",
                    event["name"]
                );
            }
        }
    }
}

/// Strokes, swings and the times between dead centres: differences of two extremes.
#[test]
fn differences_of_extremes_by_each_parameter_of_the_references() {
    let mut compared = 0;
    for name in FILES {
        let model = model(name);
        let all = |field: &str| model.file[field].as_array().expect("a list").clone();
        for combination in all("combinations") {
            let definition = combination["definition"].as_str().expect("a definition");
            let words: Vec<&str> = definition.split(' ').collect();
            let &[of, "of", first, "minus", _, "of", second] = &words[..] else {
                panic!("{definition}")
            };
            let event = |name: &str| {
                let event = all("events").into_iter().find(|event| event["name"] == name);
                event.expect("an event")
            };
            let events = [event(first), event(second)];
            let output = events[0]["output"].as_str().expect("an output");
            let Some(measure) = self::output(&model, output) else { continue };
            let what = |m: &Motion| measure(m);
            let start = numbers(&model.file, "time")[0];
            let end = events.iter().map(|event| numbers(event, "between")[1]).fold(start, f64::max);
            let motion =
                run(&model, &linspace(start.min(numbers(&events[0], "between")[0]), end, 201));
            let extremes = model.system.extremes(&motion, what).expect("extremes");
            let extreme = |event: &Value| {
                let near = |extreme: &&Extreme| (extreme.t - data::number(event, "t")).abs() < 1e-6;
                *extremes.all().iter().find(near).expect("the extreme")
            };
            let [first, second] = [extreme(&events[0]), extreme(&events[1])];
            let value = if of == "t" { first.t - second.t } else { first.value - second.value };
            assert!(
                (value - data::number(&combination, "value")).abs() < 2e-12,
                "{name}: {definition}"
            );
            let found =
                model.system.sensitivities(&motion, model.parameters()).expect("sensitivities");
            let by = found.between(what, &first, &second).expect("derivatives");
            for parameter in combination["dp"].as_object().expect("derivatives").keys() {
                if model.behind(parameter).is_empty() {
                    continue;
                }
                let of = |name: &str| {
                    let by = by.iter().find(|by| by.name == name).expect("a parameter");
                    vec![if of == "t" { by.t } else { by.value }]
                };
                let exact = data::number(&combination["dp"], parameter);
                let off = error(&total(&model, parameter, of), &[exact]);
                assert!(off <= 1e-10, "{name}: {definition} by {parameter} is off by {off:.1e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 40, "{compared}");
}

/// Σ (y − target)² + α ẏ² + β ÿ² by all parameters at once, against the references and the forward
/// way.
#[test]
fn gradients_of_functionals_through_the_adjoint() {
    for (name, parts) in FILES.into_iter().flat_map(|name| PARTS.map(|parts| (name, parts))) {
        let model = model(name);
        let file = &model.file["functional"];
        let motion = run(&model, &refined(&numbers(&model.file, "time"), parts));
        let target = numbers(file, "target");
        let definition = file["definition"].as_str().expect("a definition");
        let output = definition.rsplit("y = ").next().expect("an output");
        let Some(of) = self::output(&model, output) else { continue };
        let y = of.of(&model.system, &motion).expect("the output");
        let weights = |k: usize| {
            if !k.is_multiple_of(parts) {
                return [0.0; 3];
            }
            let values = [&y.value, &y.rate, &y.second_rate].map(|series| series.values()[k]);
            let factors = [1.0, data::number(file, "alpha"), data::number(file, "beta")];
            [
                2.0 * (values[0] - target[k / parts]),
                2.0 * factors[1] * values[1],
                2.0 * factors[2] * values[2],
            ]
        };
        let parameters = model.parameters();
        let found = model.system.sensitivities(&motion, &parameters).expect("sensitivities");
        let forward: Vec<f64> = found
            .of(|m: &Motion| of(m))
            .expect("derivatives")
            .iter()
            .map(|by| {
                let term = |k: usize| {
                    let [a, b, c] = weights(k);
                    a * by.value[k] + b * by.rate[k] + c * by.second_rate[k]
                };
                (0..motion.len()).map(term).sum()
            })
            .collect();
        let adjoint = model
            .system
            .gradient(&motion, &parameters, |m: &Motion| of(m), weights)
            .expect("a gradient");
        let off = error(&adjoint, &forward);
        assert!(off <= 1e-12, "{name}: forward and adjoint differ by {off:.1e}");
        let listed = model.file["outputs"].as_array().expect("outputs").iter();
        let listed = listed.clone().find(|one| one["name"] == output).expect("an output");
        for parameter in names(&model.file["sensitivity_parameters"]) {
            if is_local(&model, listed, &parameter) {
                continue;
            }
            let of = |name: &str| {
                vec![
                    adjoint
                        [parameters.iter().position(|known| *known == name).expect("a parameter")],
                ]
            };
            let sum = total(&model, &parameter, of);
            let exact = data::number(&file["gradient"], &parameter);
            assert!(error(&sum, &[exact]) <= 1e-11, "{name}: the gradient by {parameter}");
        }
    }
}
