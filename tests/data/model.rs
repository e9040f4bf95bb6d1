//! Mechanisms built from their description in a file, every constraint on its own route or by dual
//! numbers.

use kin::extend::by_dual;
use kin::extend::dual_route::Equation;
use kin::prelude::*;
use kin::{Mechanism, Result, pose};
use serde_json::Value;

use super::{array, number, numbers};

/// The route that every constraint of a mechanism takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum By {
    /// Its own: symbolic for all that the files need.
    Symbols,
    /// `kin::extend::by_dual`.
    DualNumbers,
}

pub const BOTH: [By; 2] = [By::Symbols, By::DualNumbers];

/// The mechanism a file describes and its bodies: coordinates, equations and initial guess in the
/// file's order.
pub fn build(file: &Value, by: By) -> Result<(Mechanism, Vec<PlanarBody>)> {
    let mut m = Mechanism::new(text(file, "id"));
    let names = list(file, "bodies").iter().map(|body| text(body, "name"));
    let guess = numbers(file, "initial_guess");
    let poses = guess.chunks(3).map(|q| pose(q[0], q[1], q[2]));
    let bodies = names
        .clone()
        .zip(poses)
        .map(|(name, pose)| m.planar(name, pose))
        .collect::<Result<Vec<_>>>()?;
    let body = |of: &Value, field: &str| {
        names.clone().position(|name| name == text(of, field)).map(|k| bodies[k]).expect("a body")
    };
    for c in list(file, "constraints").iter().chain(list(file, "drivers")) {
        let name = text(c, "name");
        let j = body(c, "j");
        match text(c, "type") {
            "fixed" => {
                let [x, y, theta] = array(c, "pose");
                add(&mut m, by, name, fixed(j, vec2(x, y), theta))?;
            }
            "revolute" => {
                add(&mut m, by, name, revolute(body(c, "i"), j, vector(c, "pi"), vector(c, "pj")))?
            }
            "prismatic" => {
                let joint = prismatic(
                    body(c, "i"),
                    j,
                    vector(c, "pi"),
                    vector(c, "pj"),
                    vector(c, "hi"),
                    number(c, "theta0"),
                );
                add(&mut m, by, name, joint)?;
            }
            "coordinate" => {
                let coordinate =
                    [j.x(), j.y(), j.theta()][c["index"].as_u64().expect("an index") as usize];
                add(&mut m, by, name, drive(coordinate, driver(file, text(c, "f"))))?;
            }
            other => panic!("a constraint `{other}` in {c}"),
        }
    }
    Ok((m, bodies))
}

/// The driver's law f(t): the files know three.
pub fn driver(file: &Value, f: &str) -> Law {
    let p = |name: &str| number(&file["parameters"], name);
    match f {
        "th0 + w*t + al*t**2/2" => Law::polynomial(&[p("th0"), p("w"), p("al") / 2.0]),
        "w2*t + th20" => Law::linear(p("th20"), p("w2")),
        "w3*t + th30" => Law::linear(p("th30"), p("w3")),
        other => panic!("a driver f(t) = {other}"),
    }
}

/// Adds an equation, on the route asked for.
pub fn add<E: Equation<N, M> + 'static, const N: usize, const M: usize>(
    m: &mut Mechanism,
    by: By,
    name: &str,
    equation: E,
) -> Result<()> {
    assert_eq!(equation.route(), Route::Symbolic, "{name}");
    match by {
        By::Symbols => m.add(name, equation)?,
        By::DualNumbers => {
            let dual = by_dual(equation);
            assert_eq!(dual.route(), Route::Dual, "{name}");
            m.add(name, dual)?
        }
    };
    Ok(())
}

fn list<'a>(of: &'a Value, field: &str) -> &'a [Value] {
    of[field].as_array().unwrap_or_else(|| panic!("no list `{field}`"))
}

fn text<'a>(of: &'a Value, field: &str) -> &'a str {
    of[field].as_str().unwrap_or_else(|| panic!("no text `{field}` in {of}"))
}

fn vector(of: &Value, field: &str) -> Vec2 {
    let [x, y] = array(of, field);
    vec2(x, y)
}
