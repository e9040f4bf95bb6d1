//! Proves worst cases: bounds of a feature over all mechanisms whose dimensions are within their
//! tolerances.
//!
//! # What a proof shows
//! At each point of the box of tolerances, and at each time of the spans, the mechanism has one
//! position. This position continues the motion to the dimensions of the point, without a singular
//! position on the way. `low` and `high` are bounds of the feature over all of these positions. For
//! an extreme the bound is the largest (smallest) value within a span of time around the extreme.
//! The measure rises at one end of the span and falls at the other end, so all mechanisms have
//! their extreme inside the span.
//!
//! # How
//! * **A sheet** (`sheet.rs`) is the position over a box as q + S Δ and a remainder of second
//!   order, by Krawczyk's test. So the bounds are exact to first order.
//! * **Kin bisects a box without a sheet** along the dimension or time with which coordinates move
//!   most (`cover.rs`). Where the halves meet, both must have the same solution. If a box has no
//!   sheet after 40 bisections, the proof fails, and the error names the box.
//! * **Kin bisects the box with the worst bound** until the bound is near an attained value.
//!
//! The proof makes the same assumptions as proofs of motions ([`crate::ask::proof`]).

mod cover;
mod equations;
mod sheet;

use std::cell::Cell;

use super::super::feature::{Followed, Term, first};
use super::source::Source;
use super::text::digits;
use crate::ask::measure::Measure;
use crate::numbers::enclosure::interval::{Interval, ZERO, up};
use crate::outcome::error::surface::Surface;
use crate::outcome::error::{Error, Result};
use cover::{Cover, Covered, Node};
use equations::Equations;

/// Bounds are refined until their distance from an attained value is this share of the worst case.
/// \[-\]
const NEAR: f64 = 0.005;

/// The largest number of bisections for this, for each bound.
const FINE: usize = 250;

/// The spans of time around an extreme. They reach [`SPAN`] times as far as the extreme moves to
/// first order, and at least over the share [`LEAST`] of the motion. If necessary they grow by the
/// factor [`WIDER`], up to the share [`WIDEST`] of the motion. \[-\]
const SPAN: f64 = 2.5;
const LEAST: f64 = 1e-5;
const WIDER: f64 = 3.0;
const WIDEST: f64 = 0.05;

/// Bounds of a feature over all mechanisms whose dimensions are within their tolerances.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Proved {
    /// The lower bound. \[unit of the measure\]
    pub low: f64,
    /// The upper bound. \[unit of the measure\]
    pub high: f64,
    /// The user-defined laws whose stated bounds the proof relies on, each with its constraint.
    pub trusted: Vec<String>,
}

impl Proved {
    /// Returns the distance from a value to the bound that is further away. \[unit of the measure\]
    pub fn off(&self, from: f64) -> f64 {
        up((self.high - from).max(from - self.low))
    }
}

/// A place of the feature: its sign, and the span of its extreme.
struct Turn {
    sign: f64,
    t: f64,
    /// The span, and true if the feature is the largest value in it; `None` for a fixed time.
    span: Option<([f64; 2], bool)>,
    /// The largest distance that a span may reach.
    widest: f64,
    /// The derivatives of its time by dimensions.
    moves: Vec<f64>,
    /// The solution over the span at the nominal dimensions.
    trail: Vec<Node>,
}

struct Proof<'a> {
    cover: Cover<'a>,
    turns: Vec<Turn>,
    coordinate: usize,
    slopes: &'a [f64],
    nominal: f64,
}

/// Proves a worst case.
pub(super) fn proved<M: Measure>(
    followed: &Followed<'_, M>,
    sources: &[Source],
    names: &[String],
    slopes: &[f64],
) -> Result<Proved> {
    let system = followed.system;
    let motion = followed.motion;
    let coordinate = followed.what.coordinate(system).ok_or_else(|| Error::CannotBeProved {
        what: format!("the worst case of {}", followed.name),
        reason: format!(
            "Kin has bounds of coordinates only. {}, and an equation that defines the coordinate",
            Surface::chosen().coordinate()
        ),
    })?;
    let nominal = names.iter().map(|name| system.parameter(name)).collect::<Result<Vec<f64>>>()?;
    let sizes = system.sizes_of(motion);
    let mut weights = vec![0.0_f64; names.len()];
    let mut places = Vec::new();
    let mut turns = Vec::new();
    for term in &followed.terms {
        let by = system.sensitivities(&term.pose, names)?;
        for (weight, by) in weights.iter_mut().zip(by.all()) {
            *weight =
                by.q(0).iter().zip(&sizes).fold(*weight, |m, (x, size)| m.max((x / size).abs()));
        }
        let second = first(followed.what.of(system, &term.pose)?.second_rate.values());
        let moves = by.all().iter().map(|by| -by.qd(0)[coordinate] / second).collect();
        turns.push(turn(term, moves, sources, motion.times()));
        places.push(Covered { q: term.pose.q(0).to_vec(), qd: term.pose.qd(0).to_vec() });
    }
    let equations = Equations::new(system, names)?;
    let what = followed.name.clone();
    let tried = Cell::new(0);
    let cover =
        Cover { system, equations, names, sources, nominal, sizes, weights, places, what, tried };
    let mut proof = Proof { cover, turns, coordinate, slopes, nominal: followed.nominal };
    proof.trails()?;
    let [low, high] = [proof.bound(-1.0)?, proof.bound(1.0)?];
    Ok(Proved { low, high, trusted: proof.cover.equations.trusted() })
}

fn turn(term: &Term, moves: Vec<f64>, sources: &[Source], times: &[f64]) -> Turn {
    let reach: f64 = sources.iter().map(|source| source.off(|k| moves[k])).sum();
    let whole = times.first().zip(times.last()).map_or(1.0, |(from, to)| (to - from).abs());
    let reach = SPAN * reach + LEAST * whole;
    // If the acceleration vanishes too, an extreme may move anywhere.
    let reach = if reach.is_finite() { reach } else { WIDEST * whole };
    let span = term.turn.map(|is_max| ([term.t - reach, term.t + reach], is_max));
    Turn { sign: term.sign, t: term.t, span, widest: WIDEST * whole, moves, trail: Vec::new() }
}

impl Proof<'_> {
    /// Computes the solutions over the spans at the nominal dimensions, beginning at the computed
    /// positions. It shows that the measure has its extreme in each span for all dimensions. It
    /// widens a span until it can show this, up to a part of the motion.
    fn trails(&mut self) -> Result<()> {
        for k in 0..self.turns.len() {
            loop {
                self.turns[k].trail = self.trail(k)?;
                let Err(error) = self.turns_round(k) else { break };
                let turn = &mut self.turns[k];
                let Some(([from, to], _)) = &mut turn.span else { break };
                let reach = WIDER * (*to - *from) / 2.0;
                if reach.is_nan() || reach > turn.widest {
                    return Err(error);
                }
                (*from, *to) = (turn.t - reach, turn.t + reach);
            }
        }
        Ok(())
    }

    /// Computes the solution over one span at the nominal dimensions.
    fn trail(&self, k: usize) -> Result<Vec<Node>> {
        let turn = &self.turns[k];
        let place = &self.cover.places[k];
        let cover = &self.cover;
        let mut sides = cover.point();
        sides.push(
            turn.span.map_or(Interval::from(turn.t), |(span, _)| Interval::new(span[0], span[1])),
        );
        let trail = cover.over(&[k], &sides, std::slice::from_ref(&place.q), 0)?;
        let here = [&cover.nominal[..], &[turn.t]].concat();
        let own = trail.iter().find(|node| node.sheets[0].holds(&here));
        if own.is_some_and(|node| node.sheets[0].is_near(&place.q)) {
            return Ok(trail);
        }
        let reason =
            format!("the computed position at t = {} differs from the proved position", turn.t);
        Err(cover.refused(reason))
    }

    /// Returns an error unless the measure has its extreme in a span for all dimensions.
    fn turns_round(&self, k: usize) -> Result<()> {
        let Some((span, is_max)) = self.turns[k].span else { return Ok(()) };
        for (end, rises) in span.into_iter().zip([is_max, !is_max]) {
            let most = self.cover.tried.get() + FINE;
            for node in self.root(&[k], &[Interval::from(end)])? {
                self.turning(k, &node, rises, most)?;
            }
        }
        Ok(())
    }

    /// Returns the whole box of tolerances over these spans of time, with the same solutions as the
    /// trails.
    fn root(&self, which: &[usize], spans: &[Interval]) -> Result<Vec<Node>> {
        let cover = &self.cover;
        let mut sides = cover.whole();
        sides.extend(spans);
        let mut point = cover.nominal.clone();
        point.extend(which.iter().zip(spans).map(|(k, span)| {
            let t = self.turns[*k].t;
            if span.contains(t) { t } else { span.mid() }
        }));
        let guesses: Vec<Vec<f64>> = which.iter().map(|k| cover.places[*k].q.clone()).collect();
        let nodes = cover.over(which, &sides, &guesses, 0)?;
        let joined = which.iter().enumerate().all(|(number, k)| {
            let at = [&cover.nominal[..], &[point[cover.names.len() + number]]].concat();
            nodes.iter().any(|node| {
                self.turns[*k]
                    .trail
                    .iter()
                    .any(|own| own.sheets[0].is_joined(&node.sheets[number], &at))
            })
        });
        if joined {
            return Ok(nodes);
        }
        Err(cover.refused(
            "Kin cannot prove that the positions of the box belong to the motion".to_string(),
        ))
    }

    /// Returns an error unless the measure rises (falls) in the whole box of a node.
    fn turning(&self, k: usize, node: &Node, rises: bool, most: usize) -> Result<()> {
        let rate = node.sheets[0].slope(self.coordinate, self.cover.names.len());
        if if rises { rate.lo() > 0.0 } else { rate.hi() < 0.0 } {
            return Ok(());
        }
        let cut = self.most_bent(node, self.cover.names.len());
        let halves = cut.filter(|_| self.cover.tried.get() < most);
        let halves = halves.and_then(|cut| self.cover.cut(&[k], node, cut));
        let Some(halves) = halves else {
            let t = node.sides.last().map_or(f64::NAN, |side| side.mid());
            let reason = format!(
                "Kin cannot prove that the measure reverses before t = {} for all dimensions",
                digits(t, 5)
            );
            return Err(self.cover.refused(reason));
        };
        halves.iter().try_for_each(|node| self.turning(k, node, rises, most))
    }

    /// Returns the side of a box along which the measure is least linear.
    fn most_bent(&self, node: &Node, sides: usize) -> Option<usize> {
        let d = self.cover.names.len();
        let bent = |k: usize| {
            let of = |number: usize, side: usize| {
                node.sheets[number].bent[(self.coordinate, side)] * node.sides[k].radius()
            };
            match k.checked_sub(d) {
                None => (0..node.sheets.len()).map(|number| of(number, k)).sum::<f64>(),
                Some(number) => of(number, d),
            }
        };
        let cut = (0..sides).max_by(|a, b| bent(*a).total_cmp(&bent(*b)))?;
        (!node.sides[cut].is_thin()).then_some(cut)
    }

    /// Returns a bound of the feature: the largest value for `side` 1, the smallest for −1.
    ///
    /// The bounds over all of the span bound the largest value within it from above. The value at
    /// any time of the span bounds it from below; Kin takes a time near the extreme at the worst
    /// dimensions.
    fn bound(&self, side: f64) -> Result<f64> {
        let all: Vec<usize> = (0..self.turns.len()).collect();
        let spans: Vec<Interval> = self.turns.iter().map(|turn| self.span(turn, side)).collect();
        let mut nodes: Vec<(f64, bool, Node)> = Vec::new();
        let mut inner = f64::NEG_INFINITY;
        let mut add = |node: Node, nodes: &mut Vec<(f64, bool, Node)>| {
            let (outer, attained) = self.value(&node, side);
            inner = attained.map_or(inner, |attained| inner.max(attained));
            nodes.push((outer, true, node));
            inner
        };
        let mut best = f64::NEG_INFINITY;
        for node in self.root(&all, &spans)? {
            best = add(node, &mut nodes);
        }
        for _ in 0..FINE {
            let farthest = (0..nodes.len()).max_by(|a, b| nodes[*a].0.total_cmp(&nodes[*b].0));
            let Some(k) = farthest.filter(|k| nodes[*k].1) else { break };
            if nodes[k].0 - best <= NEAR * (nodes[k].0 - side * self.nominal).abs() {
                break;
            }
            let cut = self.most_bent(&nodes[k].2, nodes[k].2.sides.len());
            match cut.and_then(|cut| self.cover.cut(&all, &nodes[k].2, cut)) {
                Some(halves) => {
                    nodes.swap_remove(k);
                    halves.into_iter().for_each(|half| best = add(half, &mut nodes));
                }
                None => nodes[k].1 = false,
            }
        }
        let farthest = nodes.iter().map(|(outer, ..)| *outer).fold(f64::NEG_INFINITY, f64::max);
        if farthest.is_finite() {
            return Ok(side * farthest);
        }
        Err(self.cover.refused("the bounds of the measure are not finite".to_string()))
    }

    /// Returns the times over which a bound is taken.
    fn span(&self, turn: &Turn, side: f64) -> Interval {
        let Some(([from, to], is_max)) = turn.span else { return Interval::from(turn.t) };
        if is_max == (turn.sign * side > 0.0) {
            return Interval::new(from, to);
        }
        let worst = self.cover.sources.iter().flat_map(|source| source.worst(self.slopes));
        let moved: f64 = worst.map(|(k, by)| side * by * turn.moves[k]).sum();
        Interval::from((turn.t + moved).clamp(from, to))
    }

    /// Returns a bound of `side` times the feature over a node, and an attained value in the node.
    fn value(&self, node: &Node, side: f64) -> (f64, Option<f64>) {
        let d = self.cover.names.len();
        let j = self.coordinate;
        let mut rest = ZERO;
        let mut slopes = vec![ZERO; d];
        let mut change = ZERO;
        for (sheet, turn) in node.sheets.iter().zip(&self.turns) {
            let sign = Interval::from(side * turn.sign);
            let moved = |k: usize| sheet.region[k] - Interval::from(sheet.centre[k]);
            rest = rest + sign * (Interval::from(sheet.q[j]) + sheet.off[j]);
            change = change + sign * Interval::from(sheet.slopes[(j, d)]) * moved(d);
            for (k, slope) in slopes.iter_mut().enumerate() {
                *slope = *slope + sign * Interval::from(sheet.slopes[(j, k)]);
            }
        }
        let centre = &node.sheets[0].centre;
        let moved = |k: usize| node.sides[k] - Interval::from(centre[k]);
        let mut is_attained = true;
        for source in self.cover.sources {
            let along = source.parts.iter().fold(ZERO, |sum, k| sum + slopes[*k] * moved(*k));
            change = change
                + match source.parts[..] {
                    [_] => along,
                    _ => {
                        // The disc around the nominal dimensions.
                        let size =
                            source.parts.iter().fold(ZERO, |sum, k| sum + slopes[*k].sqr()).sqrt();
                        let middle = source.parts.iter().fold(ZERO, |sum, k| {
                            sum + slopes[*k]
                                * (Interval::from(self.cover.nominal[*k])
                                    - Interval::from(centre[*k]))
                        });
                        let disc = middle + Interval::ball(up(size.hi() * source.tolerance));
                        is_attained &= source
                            .parts
                            .iter()
                            .all(|k| node.sides[*k].radius() >= source.tolerance);
                        along.common(disc).unwrap_or(along)
                    }
                };
        }
        ((rest + change).hi(), is_attained.then(|| rest.lo() + change.hi()))
    }
}
