//! Creates sequences of laws, and laws that repeat.

use std::sync::OnceLock;

use super::breaks::{self, Seam, Sizes, merged, sharpest};
use super::{Beyond, Break, Law, LawFunction, LawRange, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::{Interval, Series, piecewise, repeated};

impl Law {
    /// Returns a law whose parts follow each other from x = `start`, each part over its length.
    ///
    /// The argument of a part counts from the beginning of the part: over a part that begins at x_k
    /// the law is f_k(x − x_k). Before the first part the law holds its first value, and after the
    /// last part its last value.
    ///
    /// Consecutive parts must have the same value where they meet. A mechanism returns an error for
    /// a sequence whose value jumps. If a derivative jumps, the law has a break.
    ///
    /// ```
    /// use kin::prelude::*;
    /// // up in 1 s, dwell 0.5 s, down in 1 s
    /// let up = Law::cycloidal(0.02, 1.0);
    /// let down = Law::constant(0.02) - Law::cycloidal(0.02, 1.0);
    /// let law = Law::sequence(0.0, [(1.0, up), (0.5, Law::constant(0.02)), (1.0, down)]);
    /// assert!(law.refusal().is_none() && law.at(1.25) == 0.02 && law.at(9.0).abs() < 1e-17);
    /// ```
    pub fn sequence<L: IntoNumber>(
        start: impl IntoNumber,
        parts: impl IntoIterator<Item = (L, Law)>,
    ) -> Law {
        Law::hanging(|to| {
            let start = to.number("start", start);
            let parts = parts.into_iter().enumerate();
            let parts = parts
                .map(|(k, (length, law))| (to.number(&format!("part[{k}].length"), length), law));
            Sequence::new(start, parts.collect())
        })
    }

    /// Returns a law that repeats the part of this law over 0 ≤ x < period.
    ///
    /// For the profile of a cam the period is 2π.
    ///
    /// The law must have the same value at both ends of the period. A mechanism returns an error
    /// for a law whose value jumps. If a derivative jumps, the law has a break.
    pub fn periodic(&self, period: impl IntoNumber) -> Law {
        Law::hanging(|to| {
            let period = to.number("period", period);
            Periodic { law: self.clone(), period, seam: OnceLock::new() }
        })
    }
}

#[derive(Clone)]
struct Sequence {
    start: f64,
    /// The parts in order, each with its length.
    parts: Vec<(f64, Law)>,
    /// The start of the first part, the places where two parts meet, and the end of the last part.
    /// They are computed once.
    seams: OnceLock<Vec<Joint>>,
}

/// A seam: its place, the lowest derivative that jumps there, and the values on both sides.
#[derive(Clone, Copy)]
struct Joint {
    x: f64,
    order: Option<usize>,
    values: (f64, f64),
}

impl Sequence {
    fn new(start: f64, parts: Vec<(f64, Law)>) -> Self {
        Sequence { start, parts, seams: OnceLock::new() }
    }

    /// Returns the seams in order. There is one more seam than parts.
    fn seams(&self) -> &[Joint] {
        self.seams.get_or_init(|| {
            let sizes: Vec<Sizes> =
                self.parts.iter().map(|(length, law)| Sizes::of(law, *length)).collect();
            let mut all = Vec::new();
            for (k, (begin, length, law)) in self.placed().enumerate() {
                let right = law.jet(0.0);
                let seam = match k.checked_sub(1).map(|before| (&self.parts[before], sizes[before]))
                {
                    None => Seam::before(right[0], right, sizes[k], length),
                    Some(((before, law), size)) => {
                        Seam::after(law, *before, size, (right, sizes[k], length.min(*before)))
                    }
                };
                all.push(Joint { x: begin, order: seam.order(), values: (seam.end(), right[0]) });
            }
            if let (Some((begin, length, law)), Some(size)) = (self.placed().last(), sizes.last()) {
                let held = law.at(length);
                let seam = Seam::after(
                    law,
                    length,
                    *size,
                    ([held, 0.0, 0.0, 0.0], Sizes::default(), length),
                );
                all.push(Joint {
                    x: begin + length,
                    order: seam.order(),
                    values: (seam.end(), held),
                });
            }
            all
        })
    }

    /// Returns the breaks at the seams.
    fn joints(&self, from: f64, to: f64) -> impl Iterator<Item = Break> {
        let jump = |seam: &Joint| seam.order.map(|order| Break { x: seam.x, order });
        self.seams().iter().filter_map(jump).filter(move |found| (from..=to).contains(&found.x))
    }

    /// Returns the breaks or poles inside each part between two places. `list` lists those of one
    /// part. Breaks at the ends of a part belong to the seams.
    fn own<I: IntoIterator<Item = Break>>(
        &self,
        from: f64,
        to: f64,
        list: impl Fn(&Law, f64, f64) -> I,
    ) -> Vec<Break> {
        let mut all = Vec::new();
        for (begin, length, law) in self.placed() {
            let edge = 1e-14 * length;
            let from = (from - begin).max(edge);
            let to = (to - begin).min(length - edge);
            if from <= to {
                all.extend(list(law, from, to).into_iter().map(|b| Break { x: begin + b.x, ..b }));
            }
        }
        all
    }

    /// Returns each part with its start and its length.
    fn placed(&self) -> impl Iterator<Item = (f64, f64, &Law)> {
        let mut next = self.start;
        self.parts.iter().map(move |(length, law)| {
            let begin = next;
            next += length;
            (begin, *length, law)
        })
    }

    /// Returns the part at x, or the constant value outside. The end of the last part belongs to
    /// that part.
    fn part(&self, x: f64) -> Result<(f64, &Law), f64> {
        let mut held = f64::NAN;
        let last = self.parts.len().saturating_sub(1);
        for (k, (begin, length, law)) in self.placed().enumerate() {
            // Only the first part has x before its start; every other part begins where the part
            // before ends.
            if x < begin {
                return Err(law.at(0.0));
            }
            if x < begin + length || (k == last && x == begin + length) {
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
        "Sequence of laws, each over its length: f(x) = f_k(x − x_k), where part k begins at x_k."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let placed: Vec<(f64, f64, &Law)> = self.placed().collect();
        let end = placed.last().map(|(begin, length, _)| begin + length);
        let seams: Vec<f64> = placed.iter().map(|(begin, ..)| *begin).chain(end).collect();
        piecewise(x, &seams, &|k, x| {
            let held = |law: &Law, x0: f64| {
                Some(x.times(0.0) + law.over(&Series::constant(Interval::from(x0)))?)
            };
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
        let mut all = self.own(from, to, |law, from, to| law.breaks(from, to));
        all.extend(self.joints(from, to));
        merged(all)
    }

    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        sharpest(
            self.own(from, to, |law, from, to| law.sharpest_break(from, to))
                .into_iter()
                .chain(self.joints(from, to)),
        )
    }

    fn is_smooth(&self) -> bool {
        false
    }

    fn range(&self) -> Option<LawRange> {
        let (begin, length, _) = self.placed().last()?;
        Some(LawRange { from: self.start, to: begin + length, beyond: Beyond::Held })
    }

    /// A part can be longer than its table. Beyond the last part the value is held, which is no end
    /// of a table.
    fn table_range(&self) -> Option<LawRange> {
        let mut from = f64::NEG_INFINITY;
        let mut to = f64::INFINITY;
        for (k, (begin, length, law)) in self.placed().enumerate() {
            let Some(range) = law.table_range() else { continue };
            let edge = 1e-9 * length;
            if k == 0 && range.from > edge {
                from = begin + range.from;
            }
            if range.to < length - edge {
                to = to.min(begin + range.to);
            }
        }
        let has_end = from.is_finite() || to.is_finite();
        has_end.then_some(LawRange { from, to, beyond: Beyond::Line })
    }

    fn refusal(&self) -> Option<String> {
        if self.parts.is_empty() {
            return Some(
                "sequence: the list of parts is empty. Give at least one part".to_string(),
            );
        }
        let number = |k: usize| format!("part {} of the sequence", k + 1);
        for (k, (length, law)) in self.parts.iter().enumerate() {
            if *length <= 0.0 {
                return Some(format!(
                    "{} has the length {length}. Give a value above zero",
                    number(k)
                ));
            }
            if let Some(why) = law.refusal() {
                return Some(format!("{}: {why}", number(k)));
            }
        }
        // The first and the last seam join the sequence to the constant values outside.
        let between = self.seams().iter().enumerate().take(self.parts.len()).skip(1);
        let mut said = between.filter(|(_, seam)| seam.order == Some(0)).map(|(k, seam)| {
            let (end, begin) = seam.values;
            format!("parts {k} and {} of the sequence do not meet: part {k} ends at {end}, and the next part begins at {begin}", k + 1)
        });
        said.next()
    }

    fn parts(&self) -> Vec<(String, Law)> {
        self.parts
            .iter()
            .enumerate()
            .map(|(k, (_, law))| (format!("part[{k}].law"), law.clone()))
            .collect()
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("start", self.start);
        for (k, (length, law)) in self.parts.iter().enumerate() {
            visit(&format!("part[{k}].length"), *length);
            law.parameters(&mut |name, value| visit(&format!("part[{k}].law.{name}"), value));
        }
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = Sequence::new(self.start, self.parts.clone());
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

/// Returns x modulo the period, with 0 ≤ result < period. For a small negative number `rem_euclid`
/// alone returns the period itself, because it rounds.
pub(super) fn within(x: f64, period: f64) -> f64 {
    let rest = x.rem_euclid(period);
    if rest >= period { 0.0 } else { rest }
}

#[derive(Clone)]
struct Periodic {
    law: Law,
    period: f64,
    /// The seam between the end of a period and the next period: the lowest derivative that jumps,
    /// and the value at the end. It is computed once.
    seam: OnceLock<(Option<usize>, f64)>,
}

impl Periodic {
    fn seam(&self) -> (Option<usize>, f64) {
        *self.seam.get_or_init(|| {
            let sizes = Sizes::of(&self.law, self.period);
            let seam =
                Seam::after(&self.law, self.period, sizes, (self.law.jet(0.0), sizes, self.period));
            (seam.order(), seam.end())
        })
    }

    /// Returns the breaks of the first period.
    fn one(&self) -> Vec<Break> {
        let mut one = self.law.breaks(0.0, self.period);
        one.retain(|b| b.x > 1e-14 * self.period && b.x < self.period * (1.0 - 1e-14));
        one.extend(self.seam().0.map(|order| Break { x: 0.0, order }));
        merged(one)
    }
}

impl LawFunction for Periodic {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.law.jet(within(x, self.period))
    }

    fn kind(&self) -> &str {
        "periodic"
    }

    fn description(&self) -> &str {
        "Periodic law: it repeats the first period of another law without end."
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
        breaks::repeated(&self.one(), 0.0, self.period, from, to)
    }

    fn is_smooth(&self) -> bool {
        self.breaks(0.0, self.period).is_empty()
    }

    fn refusal(&self) -> Option<String> {
        if self.period <= 0.0 {
            return Some(format!(
                "periodic: the period must be above zero (period = {})",
                self.period
            ));
        }
        self.law.refusal().or_else(|| {
            let (order, end) = self.seam();
            let begin = self.law.at(0.0);
            let apart = || {
                format!(
                    "the law does not repeat after {}: the period begins at {begin} and ends at {end}",
                    self.period
                )
            };
            (order == Some(0)).then(apart)
        })
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("law".to_string(), self.law.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("period", self.period);
        super::parts::show(&self.law, "law", visit);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        Some(super::parts::by_part(&self.law, "law", name)?.periodic(self.period))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        if name == "period" {
            return Some(self.law.periodic(value));
        }
        let mut law = self.law.clone();
        super::parts::set(&mut law, "law", name, value).then(|| law.periodic(self.period))
    }
}

#[cfg(test)]
mod tests;
