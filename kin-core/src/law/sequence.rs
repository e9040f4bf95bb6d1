//! Laws one after the other, and over and over.

use super::breaks::{left_jet, merged, order_of_jump};
use super::{Break, Law, LawFunction, trusted_parts};
use crate::proof::{Interval, Series, piecewise, repeated};

impl Law {
    /// Parts one after the other from x = `start` on, each for its length and with its own variable counted from its beginning: over a part that
    /// begins at x_k the law is f_k(x − x_k). Before the first and after the last the end values are held.
    ///
    /// Parts must meet in value; a mechanism refuses a sequence that jumps. Where a derivative jumps there is a break.
    ///
    /// ```
    /// use kin::prelude::*;
    /// // up in 1 s, dwell 0.5 s, down in 1 s
    /// let (up, down) = (Law::cycloidal(0.02, 1.0), Law::constant(0.02) - Law::cycloidal(0.02, 1.0));
    /// let law = Law::sequence(0.0, [(1.0, up), (0.5, Law::constant(0.02)), (1.0, down)]);
    /// assert!(law.refusal().is_none() && law.at(1.25) == 0.02 && law.at(9.0).abs() < 1e-17);
    /// ```
    pub fn sequence(start: f64, parts: impl IntoIterator<Item = (f64, Law)>) -> Law {
        Law::new(Sequence { start, parts: parts.into_iter().collect() })
    }

    /// The part of this law over 0 ≤ x < period, over and over: the profile of a cam over one turn, with period 2π.
    ///
    /// Its ends must meet in value; a mechanism refuses a law that jumps. Where a derivative jumps there is a break.
    pub fn periodic(&self, period: f64) -> Law {
        Law::new(Periodic { law: self.clone(), period })
    }
}

#[derive(Clone)]
struct Sequence {
    start: f64,
    /// Lengths and laws.
    parts: Vec<(f64, Law)>,
}

impl Sequence {
    /// Each part with its beginning and its length.
    fn placed(&self) -> impl Iterator<Item = (f64, f64, &Law)> {
        let mut next = self.start;
        self.parts.iter().map(move |(length, law)| {
            let begin = next;
            next += length;
            (begin, *length, law)
        })
    }

    /// The part at x, or the value that is held.
    fn part(&self, x: f64) -> Result<(f64, &Law), f64> {
        let mut held = f64::NAN;
        for (k, (begin, length, law)) in self.placed().enumerate() {
            if k == 0 && x < begin {
                return Err(law.at(0.0));
            }
            if x < begin + length {
                return Ok((begin, law));
            }
            held = law.at(length);
        }
        Err(held)
    }
}

impl LawFunction for Sequence {
    fn jet(&self, x: f64) -> [f64; 4] {
        match self.part(x) {
            Ok((begin, law)) => law.jet(x - begin),
            Err(held) => [held, 0.0, 0.0, 0.0],
        }
    }

    fn kind(&self) -> &str {
        "sequence"
    }

    fn description(&self) -> &str {
        "Laws one after the other, each over its length: f(x) = f_k(x − x_k)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let placed: Vec<(f64, f64, &Law)> = self.placed().collect();
        let end = placed.last().map(|(begin, length, _)| begin + length);
        let seams: Vec<f64> = placed.iter().map(|(begin, ..)| *begin).chain(end).collect();
        piecewise(x, &seams, &|k, x| {
            let held = |law: &Law, x0: f64| Some(x.times(0.0) + law.over(&Series::constant(Interval::from(x0)))?);
            match (k.checked_sub(1).map(|k| placed.get(k)), placed.first(), placed.last()) {
                (Some(Some((begin, _, law))), ..) => law.over(&x.plus(-begin)),
                (None, Some((_, _, law)), _) => held(law, 0.0),
                (Some(None), _, Some((_, length, law))) => held(law, *length),
                _ => None,
            }
        })
    }

    fn fourth(&self, x: f64) -> f64 {
        self.part(x).map_or(0.0, |(begin, law)| law.fourth(x - begin))
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        let Some((_, first_length, first)) = self.placed().next() else { return Vec::new() };
        let mut all = Vec::new();
        let (mut left, mut length_before) = ([first.at(0.0), 0.0, 0.0, 0.0], first_length);
        let mut seam = |x: f64, left: [f64; 4], right: [f64; 4], length: f64| {
            if let Some(order) = order_of_jump(left, right, length).filter(|_| (from..=to).contains(&x)) {
                all.push(Break { x, order });
            }
        };
        let mut end = self.start;
        for (begin, length, law) in self.placed() {
            seam(begin, left, law.jet(0.0), length.min(length_before));
            (left, length_before, end) = (left_jet(law, length, length), length, begin + length);
        }
        seam(end, left, [left[0], 0.0, 0.0, 0.0], length_before);
        for (begin, length, law) in self.placed() {
            let inside = |b: &Break| b.x > 1e-12 * length && b.x < length * (1.0 - 1e-12);
            let own = law.breaks((from - begin).max(0.0), (to - begin).min(length));
            all.extend(own.into_iter().filter(inside).map(|b| Break { x: begin + b.x, ..b }));
        }
        merged(all)
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn refusal(&self) -> Option<String> {
        if self.parts.is_empty() {
            return Some("sequence: there is no part in it".to_string());
        }
        let number = |k: usize| format!("part {} of the sequence", k + 1);
        for (k, (length, law)) in self.parts.iter().enumerate() {
            if !(length.is_finite() && *length > 0.0) {
                return Some(format!("{} has the length {length}; give one above zero", number(k)));
            }
            if let Some(why) = law.refusal() {
                return Some(format!("{}: {why}", number(k)));
            }
        }
        let pairs = self.parts.windows(2).enumerate();
        let apart = pairs.filter(|(_, pair)| {
            let (length, next) = (pair[0].0, &pair[1].1);
            order_of_jump(left_jet(&pair[0].1, length, length), next.jet(0.0), length.min(pair[1].0)) == Some(0)
        });
        let mut said = apart.map(|(k, pair)| {
            let (end, begin) = (pair[0].1.at(pair[0].0), pair[1].1.at(0.0));
            format!("parts {} and {} of the sequence do not meet: the first ends at {end}, the second begins at {begin}", k + 1, k + 2)
        });
        said.next()
    }

    fn parts(&self) -> Vec<(String, Law)> {
        self.parts.iter().enumerate().map(|(k, (_, law))| (format!("part[{k}].law"), law.clone())).collect()
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("start", self.start);
        for (k, (length, law)) in self.parts.iter().enumerate() {
            visit(&format!("part[{k}].length"), *length);
            law.parameters(&mut |name, value| visit(&format!("part[{k}].law.{name}"), value));
        }
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        if name == "start" {
            changed.start = value;
            return Some(Law::new(changed));
        }
        let (number, rest) = name.strip_prefix("part[")?.split_once("].")?;
        let (length, law) = changed.parts.get_mut(number.parse::<usize>().ok()?)?;
        match rest {
            "length" => *length = value,
            rest => law.set_parameter(rest.strip_prefix("law.")?, value).then_some(())?,
        }
        Some(Law::new(changed))
    }
}

/// What x is beyond the last whole period: 0 ≤ … < period. (Of a number just below zero `rem_euclid` alone makes the period itself, by rounding.)
pub(super) fn within(x: f64, period: f64) -> f64 {
    let rest = x.rem_euclid(period);
    if rest >= period { 0.0 } else { rest }
}

#[derive(Clone)]
struct Periodic {
    law: Law,
    period: f64,
}

impl LawFunction for Periodic {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.law.jet(within(x, self.period))
    }

    fn kind(&self) -> &str {
        "periodic"
    }

    fn description(&self) -> &str {
        "The part of a law over one period, over and over."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        repeated(x, 0.0, self.period, &|x| self.law.over(x))
    }

    fn fourth(&self, x: f64) -> f64 {
        self.law.fourth(within(x, self.period))
    }

    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        if !(self.period > 0.0 && (to - from).is_finite() && (to - from) / self.period < 1e6) {
            return Vec::new();
        }
        let mut one = self.law.breaks(0.0, self.period);
        one.retain(|b| b.x > 1e-12 * self.period && b.x < self.period * (1.0 - 1e-12));
        let left = left_jet(&self.law, self.period, self.period);
        one.extend(order_of_jump(left, self.law.jet(0.0), self.period).map(|order| Break { x: 0.0, order }));
        let (first, last) = ((from / self.period).floor() as i64, (to / self.period).ceil() as i64);
        let all = (first..=last).flat_map(|turn| one.iter().map(move |b| Break { x: b.x + turn as f64 * self.period, ..*b }));
        merged(all.filter(|b| (from..=to).contains(&b.x)).collect())
    }

    fn is_smooth(&self) -> bool {
        self.breaks(0.0, self.period).is_empty()
    }

    fn refusal(&self) -> Option<String> {
        if self.period <= 0.0 {
            return Some(format!("periodic: the period is above zero (period = {})", self.period));
        }
        let (begin, end) = (self.law.jet(0.0), left_jet(&self.law, self.period, self.period));
        let apart = || format!("the law does not repeat after {}: it begins at {} and ends at {}", self.period, begin[0], end[0]);
        self.law.refusal().or_else(|| (order_of_jump(end, begin, self.period) == Some(0)).then(apart))
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("law".to_string(), self.law.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("period", self.period);
        super::combine::show(&self.law, "law", visit);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        if name == "period" {
            return Some(self.law.periodic(value));
        }
        let mut law = self.law.clone();
        super::combine::set(&mut law, "law", name, value).then(|| law.periodic(self.period))
    }
}
