//! Points at which functions are looked at: ordinary ones, those that their entries name with their
//! neighbours, nasty ones, and the worst that are known.

use std::f64::consts::FRAC_PI_2;

use kin_graph::Function;
use kin_graph::functions::Place;

use super::derivatives;
use super::digits::Digits;

const ORDINARY: [f64; 16] =
    [-7.3, -2.3, -1.2, -0.8, -0.4, -0.1, 0.05, 0.35, 0.7, 0.95, 1.1, 1.7, 2.5, 4.7, 11.0, 40.0];

const NASTY: [f64; 22] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    2.0,
    -2.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    1e-9,
    -1e-9,
    1e5,
    -1e9,
    709.5,
    1e300,
    -1e300,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// A point, and what is exact there.
pub struct Point {
    pub x: f64,
    /// The value and its derivatives: none where there is no value, the value alone where its slope
    /// is infinite.
    pub exact: Vec<Digits>,
}

impl Point {
    fn new(f: Function, x: f64) -> Self {
        let [from, to] = f.facts().domain;
        let has_value = x.is_finite() && from <= x && x <= to && !is_among(f.facts().poles, x);
        let mut exact = if has_value { derivatives(f, x) } else { Vec::new() };
        if f.facts().steep.contains(&x) {
            exact.truncate(1);
        }
        Point { x, exact }
    }

    /// The value, where there is one.
    pub fn value(&self) -> Option<&Digits> {
        self.exact.first()
    }

    /// True if f has one slope to both sides of it.
    pub fn is_smooth(&self, f: Function) -> bool {
        let facts = f.facts();
        let x = self.x;
        let jumps = facts.jumps.is_some_and(|steps| steps(x.next_down()) != steps(x.next_up()));
        let [from, to] = facts.domain;
        // Where a function turns smoothly its slope is 0.
        let turns = facts.extrema.iter().any(|(place, _)| *place == Place::At(x));
        let is_kink = turns && self.exact.get(1).is_some_and(|slope| *slope != Digits::new(0.0));
        self.exact.len() > 1 && !jumps && !is_kink && from < x && x < to
    }
}

/// True if a number is one of these places.
fn is_among(places: &[Place], x: f64) -> bool {
    places.contains(&Place::At(x)) || x == 0.0 && places.contains(&Place::At(0.0))
}

/// Some of the numbers next to a place.
pub fn numbers(place: Place) -> Vec<f64> {
    match place {
        Place::At(x) => vec![x],
        Place::Quarters { first, every } => {
            let turns = [-100.0, -2.0, -1.0, 0.0, 1.0, 2.0, 1e4];
            turns.iter().map(|k| (first + k * every) * FRAC_PI_2).collect()
        }
    }
}

/// All points of a function, in order, each once.
pub fn of(f: Function) -> Vec<Point> {
    let facts = f.facts();
    let extrema = facts.extrema.iter().map(|(place, _)| *place);
    let places = facts.poles.iter().copied().chain(extrema).flat_map(numbers);
    let named: Vec<f64> = places.chain(facts.steep.iter().copied()).chain(facts.domain).collect();
    let beside = named.iter().flat_map(|x| {
        [*x, x.next_up(), x.next_down(), x + 1e-8 * (1.0 + x.abs()), x - 1e-8 * (1.0 + x.abs())]
    });
    let worst = worst_arguments()
        .filter(|(name, ..)| name == f.name())
        .map(|(_, arguments, ..)| arguments[0]);
    let mut all: Vec<f64> = ORDINARY.into_iter().chain(NASTY).chain(beside).chain(worst).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by_key(|x| x.to_bits());
    all.into_iter().map(|x| Point::new(f, x)).collect()
}

/// The worst arguments that are known of functions, with their values as a sum of two f64s
/// (`numbers/enclosure/tests/accuracy/generate.py`).
pub fn worst_arguments() -> impl Iterator<Item = (String, Vec<f64>, f64, f64)> {
    let text = include_str!("../../numbers/enclosure/tests/accuracy/functions.txt");
    text.lines().map(|line| {
        let mut words = line.split(' ');
        let name = words.next().expect("a name").to_string();
        let bits = |word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
        let mut numbers: Vec<f64> = words.map(bits).collect();
        let rest = numbers.pop().expect("the rest");
        let nearest = numbers.pop().expect("the nearest");
        (name, numbers, nearest, rest)
    })
}
