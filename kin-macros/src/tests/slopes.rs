//! Derivatives of mangled bodies, as far as they are read: C_q, −C_t and Q_d of the graph against
//! differences of its own rows.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;

use super::attributes::Attributed;
use super::mangled::{SplitMix, bodies, mangled};
use kin_graph::differentiate::Derivatives;
use kin_graph::{Column, Graph, Input, LeafUse, Node, Part, Source, evaluate};
use kin_language::formula::local_column;
use kin_language::{limits, lower, parse};

/// How many bodies are tried.
const STREAMS: usize = 800;

/// Differences by these steps have to agree before they are believed.
const STEPS: [f64; 2] = [2e-3, 7e-4];

/// Relative differences that are believed, and that fail.
const BELIEVED: f64 = 1e-5;
const WRONG: f64 = 1e-3;

/// Coordinates and rates by their columns, parameters by their numbers, and the time.
#[derive(Clone, Default)]
struct State {
    q: BTreeMap<(usize, Part), f64>,
    qd: BTreeMap<(usize, Part), f64>,
    parameters: Vec<f64>,
    t: f64,
}

impl Source<f64> for State {
    fn input(&self, input: Input) -> f64 {
        let of = |all: &BTreeMap<(usize, Part), f64>, slot, part| all.get(&(slot, part)).copied();
        let known = match input {
            Input::State(slot, Part::Sin) => of(&self.q, slot, Part::Theta).map(f64::sin),
            Input::State(slot, Part::Cos) => of(&self.q, slot, Part::Theta).map(f64::cos),
            Input::State(slot, part) => of(&self.q, slot, part),
            Input::Rate(slot, part) => of(&self.qd, slot, part),
            Input::Time => Some(self.t),
            Input::TimeRate => Some(1.0),
            Input::Parameter(k) => self.parameters.get(k).copied(),
            Input::Column(_) | Input::Timed(_) => None,
        };
        known.unwrap_or(f64::NAN)
    }

    // Values of the user's program are not known here: what is computed of them is not compared.
    fn law(&self, _: usize, _: f64, _: u8) -> f64 {
        f64::NAN
    }

    fn opaque(&self, _: usize, _: usize, _: Vec<f64>) -> f64 {
        f64::NAN
    }

    fn leaf(&self, _: LeafUse, _: Vec<f64>) -> f64 {
        f64::NAN
    }
}

impl State {
    fn random(columns: &[Column], parameters: usize, random: &mut SplitMix) -> State {
        let mut number = || random.below(1 << 20) as f64 / f64::from(1 << 19) * 2.0 - 2.0;
        let mut each =
            |_: &str| columns.iter().map(|of| ((of.argument, of.part), number())).collect();
        let q = each("q");
        let qd = each("q̇");
        State { q, qd, parameters: (0..parameters).map(|_| number()).collect(), t: number() }
    }

    /// The state at s on its way: along one coordinate, along t, or with all rates.
    fn at(&self, way: Way, s: f64) -> State {
        let mut moved = self.clone();
        match way {
            Way::Coordinate(column) => {
                moved.q.entry((column.argument, column.part)).and_modify(|x| *x += s);
            }
            Way::Time => moved.t += s,
            Way::Rates => {
                moved.t += s;
                moved.q.iter_mut().for_each(|(of, x)| *x += s * self.qd[of]);
            }
        }
        moved
    }
}

#[derive(Clone, Copy)]
enum Way {
    Coordinate(Column),
    Time,
    Rates,
}

/// A derivative of a row by differences, if two steps agree: the first one, or the second one along
/// rates.
fn by_differences(g: &Graph, row: Node, state: &State, way: Way) -> Option<f64> {
    let value = |s: f64| evaluate(g, &[row], &state.at(way, s)).number(row).unwrap_or(f64::NAN);
    let middle = value(0.0);
    let [a, b] = STEPS.map(|h| {
        let of = |h: f64| match way {
            Way::Rates => (value(h) - 2.0 * middle + value(-h)) / (h * h),
            _ => (value(h) - value(-h)) / (2.0 * h),
        };
        (4.0 * of(h / 2.0) - of(h)) / 3.0
    });
    let size = 1.0 + middle.abs() + a.abs();
    ((a - b).abs() < BELIEVED * size).then_some(b)
}

/// Compares all derivatives at some states; how many were compared, or the text of the first that
/// is wrong.
fn compared(item: &TokenStream, random: &mut SplitMix) -> Result<usize, String> {
    let read =
        limits::check(item).and_then(|()| parse::constraint(TokenStream::new(), item.clone()));
    let Some((source, mut lowered)) = read
        .ok()
        .and_then(|source| lower::constraint(&source).ok().map(|lowered| (source, lowered)))
    else {
        return Ok(0);
    };
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let local = |column| local_column(&source.arguments, column);
    let derived = Derivatives::new(&mut lowered.graph, &rows, local);
    let g = &lowered.graph;
    let columns = g.columns(&rows);
    let entry = |&(row, local, node): &(usize, usize, Node)| {
        let column =
            columns.iter().find(|column| local_column(&source.arguments, **column) == local);
        column.map(|&column| (row, Way::Coordinate(column), node, 1.0))
    };
    let right_side = |way: Way, side: &[Node]| -> Vec<_> {
        side.iter().enumerate().map(|(k, &n)| (k, way, n, -1.0)).collect()
    };
    let mut all: Vec<(usize, Way, Node, f64)> = derived.jacobian.iter().filter_map(entry).collect();
    all.extend(right_side(Way::Time, &derived.velocity_rhs));
    all.extend(right_side(Way::Rates, &derived.acceleration_rhs));
    let mut count = 0;
    for _ in 0..3 {
        let state = State::random(&columns, lowered.parameters.len(), random);
        for &(row, way, node, sign) in &all {
            let found = sign * evaluate(g, &[node], &state).number(node).unwrap_or(f64::NAN);
            let Some(known) = by_differences(g, rows[row], &state, way) else { continue };
            if (found - known).abs() > WRONG * (1.0 + known.abs()) || found.is_nan() {
                return Err(format!("row {row}: {found}, and {known} by differences, of\n{item}"));
            }
            count += 1;
        }
    }
    Ok(count)
}

/// `KIN_STREAMS=4000` tries as many of them.
#[test]
fn mangled_bodies_that_are_read_have_the_slopes_of_their_rows() {
    let streams = std::env::var("KIN_STREAMS").ok().and_then(|n| n.parse().ok()).unwrap_or(STREAMS);
    let (originals, mut random): (Vec<Attributed>, _) = (bodies(), SplitMix(0x0051_09E5));
    let mut read = 0;
    let mut numbers = 0;
    for k in 0..streams {
        let mut item = originals[random.below(originals.len())].item.clone();
        for _ in 0..k % 3 {
            item = mangled(&item, &mut random);
        }
        match compared(&item, &mut random) {
            Ok(count) => (read, numbers) = (read + usize::from(count > 0), numbers + count),
            Err(wrong) => panic!("{wrong}"),
        }
    }
    assert!(read > streams / 4 && numbers > 10 * read, "{numbers} derivatives of {read} bodies");
}
