//! Covers boxes of dimensions and times with sheets that are joined to one another.

use std::cell::Cell;
use std::rc::Rc;

use super::super::source::Source;
use super::equations::Equations;
use super::sheet::{Fault, Sheet, sheet};
use crate::numbers::enclosure::interval::{Interval, down, up};
use crate::outcome::error::{Error, Result};
use crate::outcome::words::value;
use crate::system::System;

/// The largest number of boxes before the proof fails.
const MOST: usize = 6000;

/// The largest number of bisections of a box.
const DEEPEST: usize = 40;

/// The pose of one place of a feature.
pub(super) struct Covered {
    pub q: Vec<f64>,
    /// The velocities of the coordinates. The velocities determine the side along which Kin divides
    /// a box.
    pub qd: Vec<f64>,
}

/// The data of all boxes.
pub(super) struct Cover<'a> {
    pub system: &'a System,
    pub equations: Equations<'a>,
    pub names: &'a [String],
    pub sources: &'a [Source],
    /// The nominal dimensions.
    pub nominal: Vec<f64>,
    pub sizes: Vec<f64>,
    /// For each dimension the largest change of a coordinate, in units of its size.
    pub weights: Vec<f64>,
    pub places: Vec<Covered>,
    /// The measure, for messages.
    pub what: String,
    pub tried: Cell<usize>,
}

/// A box with a sheet for each place. Its sides are the dimensions, then a span of time for each
/// place.
pub(super) struct Node {
    pub sides: Vec<Interval>,
    pub sheets: Vec<Rc<Sheet>>,
}

impl Node {
    fn holds(&self, point: &[f64]) -> bool {
        self.sides.iter().zip(point).all(|(side, x)| side.contains(*x))
    }
}

impl Cover<'_> {
    /// Returns the box of all tolerances.
    pub(super) fn whole(&self) -> Vec<Interval> {
        let mut all: Vec<Interval> = self.nominal.iter().map(|x| Interval::from(*x)).collect();
        for source in self.sources {
            for k in &source.parts {
                let x = self.nominal[*k];
                let t = source.tolerance;
                all[*k] = Interval::new(down(x - t), up(x + t));
            }
        }
        all
    }

    /// Returns the nominal dimensions as a box.
    pub(super) fn point(&self) -> Vec<Interval> {
        self.nominal.iter().map(|x| Interval::from(*x)).collect()
    }

    /// Returns sheets for these places over a box; each is a single solution. `guesses` are
    /// positions near those at its centre.
    pub(super) fn over(
        &self,
        which: &[usize],
        sides: &[Interval],
        guesses: &[Vec<f64>],
        depth: usize,
    ) -> Result<Vec<Node>> {
        if self.is_outside(sides) {
            return Ok(Vec::new());
        }
        let fault = match self.tried(which, sides, guesses) {
            Ok(node) => return Ok(vec![node]),
            Err(fault) => fault,
        };
        let cut = self.widest(which, sides).filter(|_| depth < DEEPEST && self.tried.get() < MOST);
        let Some(cut) = cut else { return Err(self.refusal(&fault, sides)) };
        let mut halves = Vec::new();
        for half in halved(sides, cut) {
            halves.push(self.over(which, &half, guesses, depth + 1)?);
        }
        let right = halves.pop().unwrap_or_default();
        let mut left = halves.pop().unwrap_or_default();
        if !left.is_empty() && !right.is_empty() && !self.are_joined(&left, &right) {
            return Err(self.refusal(&Fault::Singular, sides));
        }
        left.extend(right);
        Ok(left)
    }

    /// Returns the halves of a box with sheets, with separate sheets of the same solutions. Returns
    /// `None` if there are no such sheets.
    pub(super) fn cut(&self, which: &[usize], node: &Node, cut: usize) -> Option<Vec<Node>> {
        let mut all = Vec::new();
        for half in halved(&node.sides, cut) {
            if self.is_outside(&half) {
                continue;
            }
            let guesses: Vec<Vec<f64>> = node.sheets.iter().map(|sheet| sheet.q.clone()).collect();
            let found = self.tried(which, &half, &guesses).ok()?;
            let point: Vec<f64> = half.iter().map(|x| x.mid()).collect();
            self.is_one(&found, node, &point).then_some(())?;
            all.push(found);
        }
        Some(all)
    }

    /// Returns true if two boxes have the same solutions at a common point.
    pub(super) fn is_one(&self, a: &Node, b: &Node, point: &[f64]) -> bool {
        let d = self.names.len();
        let at = |place: usize| [&point[..d], &point[d + place..=d + place]].concat();
        let both = a.sheets.iter().zip(&b.sheets).enumerate();
        a.holds(point)
            && b.holds(point)
            && both.into_iter().all(|(k, (a, b))| a.is_joined(b, &at(k)))
    }

    /// Returns true if the solutions of some box and its neighbour on the other side are equal.
    /// Each side is one solution and both contain the whole face between them, so they are equal
    /// along the face.
    fn are_joined(&self, left: &[Node], right: &[Node]) -> bool {
        let pairs = left.iter().flat_map(|a| right.iter().map(move |b| (a, b)));
        let common = |a: &Node, b: &Node| {
            let all = a.sides.iter().zip(&b.sides).map(|(a, b)| a.common(*b));
            let common: Vec<Interval> = all.collect::<Option<_>>()?;
            (!self.is_outside(&common)).then_some(common)
        };
        pairs.into_iter().any(|(a, b)| {
            let point = common(a, b).map(|all| all.iter().map(|x| x.mid()).collect::<Vec<f64>>());
            point.is_some_and(|point| self.is_one(a, b, &point))
        })
    }

    /// Returns true if no point of a box is in the disc of a clearance.
    fn is_outside(&self, sides: &[Interval]) -> bool {
        let least = |k: &usize| (sides[*k] - Interval::from(self.nominal[*k])).sqr().lo();
        self.sources.iter().filter(|source| source.parts.len() > 1).any(|source| {
            source.parts.iter().map(least).fold(0.0, |sum, x| down(sum + x))
                > up(source.tolerance.powi(2))
        })
    }

    fn tried(
        &self,
        which: &[usize],
        sides: &[Interval],
        guesses: &[Vec<f64>],
    ) -> std::result::Result<Node, Fault> {
        self.tried.set(self.tried.get() + 1);
        let d = self.names.len();
        let off = self.names.iter().zip(&sides[..d]).zip(&self.nominal);
        let system = self.system.off(off.map(|((name, side), x)| (name, side.mid() - x)));
        let system = system.ok_or(Fault::Singular)?;
        let mut sheets = Vec::new();
        for (number, guess) in (0..which.len()).zip(guesses) {
            let mut region = sides[..d].to_vec();
            region.push(sides[d + number]);
            let pose =
                system.next_to(sides[d + number].mid(), guess).map_err(|_| Fault::Singular)?;
            sheets.push(Rc::new(sheet(&self.equations, &self.sizes, &region, pose.q(0))?));
        }
        Ok(Node { sides: sides.to_vec(), sheets })
    }

    /// Returns the side along which coordinates move most, or `None` if none does.
    fn widest(&self, which: &[usize], sides: &[Interval]) -> Option<usize> {
        let d = self.names.len();
        let fast = |place: &Covered| {
            let sizes = place.qd.iter().zip(&self.sizes);
            sizes.fold(0.0_f64, |m, (v, size)| m.max((v / size).abs()))
        };
        let weight = |k: usize| match k.checked_sub(d) {
            None => self.weights[k],
            Some(number) => fast(&self.places[which[number]]),
        };
        let reach = |k: usize| weight(k).max(f64::MIN_POSITIVE) * sides[k].radius();
        let widest = (0..sides.len()).max_by(|a, b| reach(*a).total_cmp(&reach(*b)))?;
        (!sides[widest].is_thin()).then_some(widest)
    }

    /// Builds the error that nothing is proved, with the place.
    fn refusal(&self, fault: &Fault, sides: &[Interval]) -> Error {
        let d = self.names.len();
        let at = self
            .names
            .iter()
            .zip(sides)
            .map(|(name, side)| format!("{name} = {}", value(side.mid())));
        let times = sides[d..].iter().map(|side| format!("t = {}", value(side.mid())));
        let at = at.chain(times).collect::<Vec<_>>().join(", ");
        let reason = match fault {
            Fault::Singular => format!(
                "near {at} the pose may be singular: some mechanisms within the tolerances may not assemble, or may change branch. `samples` counts these mechanisms"
            ),
            Fault::Unknown(unknown) => {
                let equation = self.system.equations().equation(unknown.row);
                let expression = unknown.expression.as_ref();
                let expression = expression
                    .map(|(text, _)| format!(": `{text}` jumps near this value, or has no slope"));
                format!(
                    "near {at} Kin knows no bounds of `{equation}`{}",
                    expression.unwrap_or_default()
                )
            }
        };
        self.refused(reason)
    }

    pub(super) fn refused(&self, reason: String) -> Error {
        Error::CannotBeProved { what: format!("the worst case of {}", self.what), reason }
    }
}

/// Returns both halves of a box.
fn halved(sides: &[Interval], cut: usize) -> [Vec<Interval>; 2] {
    let middle = sides[cut].mid();
    let half = |side: Interval| {
        let mut half = sides.to_vec();
        half[cut] = side;
        half
    };
    [half(Interval::new(sides[cut].lo(), middle)), half(Interval::new(middle, sides[cut].hi()))]
}
