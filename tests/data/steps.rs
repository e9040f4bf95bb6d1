//! Random mechanisms whose equations have steps and kinks: `floor`, `%`, `min`, `max`, `abs`,
//! `signum`, `if`; at rest on a step or not, moved and scaled, on even, jittered, reversed, huge
//! and tiny times.

use kin::prelude::*;

use crate::engines::{ends_apart, is_undefined};

/// z = x + a step of height s wherever r (x − c) / u is a whole number.
#[constraint]
fn stair(x: Coord, z: Coord, c: f64, u: f64, r: f64, s: f64) -> f64 {
    z - x - s * u * (r * (x - c) / u).floor()
}

/// The same, and y is not given by it.
#[constraint]
fn implicit_stair(x: Coord, y: Coord, c: f64, u: f64, r: f64, s: f64) -> f64 {
    let w = (y - c) / u;
    u * (w + 0.3 * w.sin() - s * (r * (x - c) / u).floor()) - (x - c)
}

/// w³ + 1.2 w = v of distances v and w from c.
#[constraint]
fn cubic(x: Coord, y: Coord, c: f64, u: f64) -> f64 {
    let w = (y - c) / u;
    u * (w * w * w + 1.2 * w) - (x - c)
}

#[constraint]
fn folded(x: Coord, y: Coord, c: f64, u: f64, a: f64, b: f64) -> f64 {
    y - c - u * ((x - c) / u - a).abs().max(b)
}

#[constraint]
fn lower(x: Coord, y: Coord, c: f64, u: f64, a: f64) -> f64 {
    let v = (x - c) / u;
    y - c - u * (v + 0.5 * v.min(a))
}

#[constraint]
fn saw(x: Coord, y: Coord, c: f64, u: f64, p: f64, s: f64) -> f64 {
    let v = (x - c) / u;
    y - x - s * u * (v % p + v.rem_euclid(0.7 * p))
}

#[constraint]
fn sign(x: Coord, y: Coord, c: f64, u: f64, a: f64, s: f64) -> f64 {
    y - x - s * u * ((x - c) / u - a).signum()
}

#[constraint]
fn sides(x: Coord, y: Coord, c: f64, u: f64, a: f64, s: f64) -> f64 {
    let v = (x - c) / u - a;
    if v < 0.0 { y - c + u * v } else { y - c - u * (0.5 * v + s) }
}

/// One of these mechanisms, with all that is asked of it.
pub struct Case {
    /// All of it in words, for messages.
    pub words: String,
    pub system: System,
    pub times: Vec<f64>,
    /// A number that a sweep varies, and its value.
    #[allow(dead_code)]
    pub varied: (String, f64),
    /// How far rates may be apart, as a share of the largest: what is left of positions that are
    /// moved far off.
    pub loose: f64,
}

struct Random(fastrand::Rng);

impl Random {
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.0.usize(0..all.len())]
    }

    /// A law of lengths of some units over so much time from t₀, in words too.
    fn law(&mut self, [t_0, span]: [f64; 2]) -> (Law, String) {
        let height = self.one_of(&[1.0, 2.0, -1.0, 0.5, 0.7]);
        let share = self.one_of(&[0.25, 0.5, 0.8]);
        let length = share * span;
        match self.0.usize(0..6) {
            0 => (
                Law::cycloidal(height, length).shifted(t_0),
                format!("cycloidal {height} in {share}"),
            ),
            1 => {
                let back = Law::constant(height) - Law::polynomial_345(height, 0.5 * length);
                let parts = [(length, Law::cycloidal(height, length)), (0.5 * length, back)];
                (Law::sequence(t_0, parts), format!("to {height} and back in {share}"))
            }
            2 => {
                let amplitude = self.within(0.3, 2.0);
                let turns = self.within(0.5, 4.0);
                let phase = self.one_of(&[0.0, 0.3, -1.0]);
                let law = Law::sine(amplitude, TAU * turns / span, phase).shifted(t_0);
                (law, format!("sine {amplitude} {turns} {phase}"))
            }
            3 => (
                Law::linear(height, self.one_of(&[0.0, 3.0]) / span).shifted(t_0),
                format!("linear {height}"),
            ),
            4 => {
                let rate = self.within(-3.0, 3.0);
                (Law::ramp(rate / span).shifted(t_0), format!("ramp {rate}"))
            }
            _ => {
                // Rests on a whole number, then leaves it.
                let rest = Law::constant(height);
                let on =
                    Law::constant(height) + Law::cycloidal(self.one_of(&[0.6, -0.6]), 0.3 * span);
                let parts = [
                    (0.3 * span, Law::cycloidal(height, 0.3 * span)),
                    (0.2 * span, rest),
                    (0.3 * span, on),
                ];
                (Law::sequence(t_0, parts), format!("to {height}, rests, and on"))
            }
        }
    }

    fn times(&mut self, [t_0, span]: [f64; 2]) -> Vec<f64> {
        let n = self.one_of(&[5, 24, 60, 121, 240]);
        let mut times = linspace(t_0, t_0 + span, n);
        if self.0.bool() {
            let h = span / n as f64;
            times.iter_mut().skip(1).for_each(|t| *t += h * 0.6 * (self.0.f64() - 0.5));
        }
        if self.0.usize(0..4) == 0 {
            times.reverse();
        }
        times
    }

    /// Adds one equation that gives y of x; gives its name in words and a number to vary.
    fn equation(
        &mut self,
        m: &mut Mechanism,
        k: usize,
        [x, y]: [Coordinate; 2],
        [c, u]: [f64; 2],
    ) -> [String; 2] {
        let name = format!("e{k}");
        let r = self.one_of(&[1.0, 2.0, 3.0, 0.5, 6.5]);
        let s = self.one_of(&[0.1, 0.01, 0.3]);
        let a = self.one_of(&[0.0, 0.5, 1.0, -0.2]);
        let b = self.one_of(&[0.1, 0.0]);
        let number = self.0.usize(0..8);
        let kind =
            ["stair", "implicit", "cubic", "folded", "lower", "saw", "sign", "sides"][number];
        let (word, varied) = match number {
            0 => (m.add(&name, stair(x, y, c, u, r, s)), "s"),
            1 => (m.add(&name, implicit_stair(x, y, c, u, r, 0.3 * s)), "s"),
            2 => (m.add(&name, cubic(x, y, c, u)), ""),
            3 => (m.add(&name, folded(x, y, c, u, a, b)), "b"),
            4 => (m.add(&name, lower(x, y, c, u, a)), "a"),
            5 => (m.add(&name, saw(x, y, c, u, r, s)), "s"),
            6 => (m.add(&name, sign(x, y, c, u, a, s)), "s"),
            _ => (m.add(&name, sides(x, y, c, u, a, 0.3 * s)), "s"),
        };
        word.expect("adds");
        [
            format!("{name} {kind} r {r} s {s} a {a} b {b}"),
            if varied.is_empty() { String::new() } else { format!("{name}.{varied}") },
        ]
    }
}

/// Mechanism number `seed`.
pub fn random(seed: u64) -> Case {
    let mut random = Random(fastrand::Rng::with_seed(seed));
    let span = random.one_of(&[1.0, 1.0, 1.0, 1e6, 1e-6]);
    let t_0 = span * random.one_of(&[0.0, 0.0, 1e3]);
    let u = random.one_of(&[1.0, 1.0, 1e6, 1e-6]);
    let c = u * random.one_of(&[0.0, 0.0, 1.0, 1e3, 1e6]);
    let (law, mut words) = random.law([t_0, span]);
    words = format!("{seed}: span {span} t_0 {t_0} u {u} c {c} {words}");
    let mut m = Mechanism::new("steps");
    let mut x = m.length("x0", c).expect("a length");
    let law = Law::constant(c) + Law::constant(u) * law;
    m.add("motor", drive(x, law)).expect("adds");
    let mut varied = String::new();
    for k in 1..=random.0.usize(1..4) {
        let y = m.length(&format!("x{k}"), c).expect("a length");
        let [word, own] = random.equation(&mut m, k, [x, y], [c, u]);
        words += &format!("; {word}");
        varied = if own.is_empty() { varied } else { own };
        // Now and then all equations read the same coordinate.
        x = if random.0.usize(0..3) == 0 { x } else { y };
    }
    let times = random.times([t_0, span]);
    words += &format!("; {} times", times.len());
    let system = m.build().expect("builds");
    let all = system.parameters();
    let value = |name: &str| all.iter().find(|(own, _)| own == name).map(|(_, value)| *value);
    let varied = if varied.is_empty() { "e1.c".to_string() } else { varied };
    let own = value(&varied).unwrap_or_else(|| panic!("{varied} of {all:?}"));
    // The stop rule leaves 1e-13 of a length of 1, and rounding as much of what all is moved by.
    let loose = 1e-9 + (1e-13 + 1e-12 * c) / u;
    Case { words, system, times, varied: (varied, own), loose }
}

/// The first difference between two runs of a mechanism, in words.
///
/// Positions are compared at all times, derivatives at all but those at which they are undefined
/// within rounding of positions: on a kink of an equation or a break of a law.
pub fn difference(
    system: &System,
    times: &[f64],
    [one, other]: [&kin::Result<Motion>; 2],
    loose: f64,
) -> Option<String> {
    let (one, other) = match (one, other) {
        (Ok(one), Ok(other)) => (one, other),
        (Err(one), Err(other)) => return ends_apart(0.0, one, other, times),
        (Ok(_), Err(error)) => return Some(format!("only the first runs: {error}")),
        (Err(error), Ok(_)) => return Some(format!("only the second runs: {error}")),
    };
    let span = (times[times.len() - 1] - times[0]).abs();
    // Far from zero a time is rounded by so much.
    let near = (1e-9 + loose) * span + 8.0 * f64::EPSILON * times[0].abs();
    for (order, (far, rows)) in [1e-11, loose, 100.0 * loose]
        .into_iter()
        .zip([Motion::q, Motion::qd, Motion::qdd])
        .enumerate()
    {
        let size = (0..one.len())
            .flat_map(|k| rows(one, k))
            .fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
        for k in 0..one.len() {
            let off = |(a, b): (&f64, &f64)| {
                let gap = (a - b).abs();
                gap.is_nan() || gap > far * size
            };
            let Some(at) = rows(one, k).iter().zip(rows(other, k)).position(off) else { continue };
            if order > 0 && is_undefined(system, times, k, near) {
                continue;
            }
            let [a, b] = [one, other].map(|motion| rows(motion, k)[at]);
            return Some(format!("order {order} at time {k} of coordinate {at}: {a} and {b}"));
        }
    }
    let events = |motion: &Motion| {
        motion.events().iter().map(|e| (e.kind, e.text.clone())).collect::<Vec<_>>()
    };
    if events(one) != events(other) {
        let told = |motion: &Motion| {
            motion.events().iter().map(|e| format!("{} {}", e.t, e.text)).collect::<Vec<_>>()
        };
        return Some(format!("events {:?} and {:?}", told(one), told(other)));
    }
    let apart = one.events().iter().zip(other.events()).find(|(a, b)| (a.t - b.t).abs() > near);
    apart.map(|(a, b)| format!("times of events {} and {}: {}", a.t, b.t, a.text))
}
