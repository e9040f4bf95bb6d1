//! Proves one step of a motion: pieces that pass Krawczyk's test, joined to one another and to both
//! computed positions.

use super::bounds::{Bounds, taylor};
use super::krawczyk::{Around, Fault, Piece, Test};
use crate::numbers::enclosure::interval::{Interval, up};
use crate::numbers::enclosure::series::{ORDER, Series};
use crate::solve::motion::Motion;

/// The largest number of bisections of a step, and of tests in a step.
const DEEPEST: u32 = 14;
const MOST: usize = 256;

/// The polynomials of the positions between two times over 0 ≤ u ≤ 1, with the time t0 + u dt.
pub(super) struct Curve {
    c: Vec<[f64; 6]>,
    t0: f64,
    dt: Interval,
}

/// A failure and its time.
pub(super) type Failure = (f64, Fault);

impl Curve {
    /// Returns the curve of step k.
    pub(super) fn between(motion: &Motion, k: usize) -> Self {
        let t0 = motion.times()[k];
        let t1 = motion.times()[k + 1];
        Curve { c: motion.quintics(k), t0, dt: Interval::from(t1) - Interval::from(t0) }
    }

    /// Returns a curve with a constant position.
    pub(super) fn still(q: &[f64], t: f64) -> Self {
        Curve {
            c: q.iter().map(|q| [*q, 0.0, 0.0, 0.0, 0.0, 0.0]).collect(),
            t0: t,
            dt: Interval::from(0.0),
        }
    }

    /// Returns the distance of the end u from a given position.
    fn distance(&self, u: f64, q: &[f64]) -> Vec<f64> {
        let at = |c: &[f64; 6]| shifted(&c.map(Interval::from), Interval::from(u))[0];
        self.c.iter().zip(q).map(|(c, q)| (at(c) - Interval::from(*q)).mag()).collect()
    }

    /// Returns bounds around the curve from u0 to u1.
    pub(super) fn around(&self, test: &Test<'_>, [u0, u1]: [f64; 2]) -> Result<Around, Fault> {
        // This is exact, because the ends are dyadic fractions.
        let middle = 0.5 * (u0 + u1);
        let half = 0.5 * (u1 - u0);
        let mut powers = [Interval::from(1.0); 6];
        (1..6).for_each(|k| powers[k] = powers[k - 1] * Interval::from(half));
        let at: Vec<[Interval; 6]> = self
            .c
            .iter()
            .map(|c| {
                let c = shifted(&c.map(Interval::from), Interval::from(middle));
                std::array::from_fn(|k| c[k] * powers[k])
            })
            .collect();
        let series = |c: &[Interval; 6]| Series::of(c, ORDER + 1);
        let over: Vec<Series> =
            at.iter().map(|c| series(&shifted(c, Interval::ball(1.0)))).collect();
        let time = |u: Interval| {
            Series::variable(
                Interval::from(self.t0) + u * self.dt,
                Interval::from(half) * self.dt,
                ORDER + 1,
            )
        };
        let t = time(Interval::from(middle));
        let t_over = time(Interval::new(u0, u1));
        let here = test
            .bounds
            .residual(&at.iter().map(series).collect::<Vec<_>>(), t)
            .map_err(Fault::Unknown)?;
        let everywhere = test.bounds.residual(&over, t_over).map_err(Fault::Unknown)?;
        let c: Vec<Interval> = here
            .iter()
            .zip(&everywhere)
            .map(|(here, everywhere)| taylor(here, everywhere))
            .collect();
        let q: Vec<Interval> = over.iter().map(Series::value).collect();
        let middle = (at.iter().map(|c| c[0].mid()).collect(), t.value().mid());
        test.around(&Piece { middle, q: &q, t: t_over.value(), c: &c })
    }

    /// Returns the time at u.
    fn time(&self, u: f64) -> f64 {
        (Interval::from(self.t0) + Interval::from(u) * self.dt).mid()
    }
}

/// Returns the coefficients of c0 + c1 x + … about another x, as bounds if that x is an interval.
fn shifted(c: &[Interval; 6], by: Interval) -> [Interval; 6] {
    let mut c = *c;
    for k in 0..5 {
        for j in (k..5).rev() {
            c[j] = c[j] + by * c[j + 1];
        }
    }
    c
}

/// Returns true if the solutions of two tests at one time are equal: the solution of one is in the
/// region in which the other has no second solution. `apart` is the distance of their positions.
fn joined(a: &Around, b: &Around, apart: &[f64]) -> bool {
    let within = |a: &Around, b: &Around| {
        a.inner
            .iter()
            .zip(apart)
            .zip(&b.outer)
            .all(|((inner, apart), outer)| up(inner + apart) <= *outer)
    };
    within(a, b) || within(b, a)
}

/// A chain of joined pieces: its last piece, the permitted distance of the next positions, and the
/// bounds that hold for all.
struct Chain {
    last: Around,
    apart: Vec<f64>,
    whole: Option<Around>,
}

impl Chain {
    /// Appends a piece if it is joined to the last one.
    fn append(&mut self, here: &Around) -> bool {
        if !joined(&self.last, here, &self.apart) {
            return false;
        }
        self.whole = Some(self.whole.take().map_or_else(|| here.clone(), |whole| whole.with(here)));
        self.last = here.clone();
        self.apart.fill(0.0);
        true
    }
}

/// Returns bounds around a step's curve. Those around the computed positions at its ends are known.
pub(super) fn step(
    bounds: &Bounds<'_>,
    sizes: &[f64],
    motion: &Motion,
    k: usize,
    ends: [&Around; 2],
) -> Result<Around, Failure> {
    let curve = Curve::between(motion, k);
    let test = Test { bounds, sizes };
    let to_first = curve.distance(0.0, motion.q(k));
    let to_last = curve.distance(1.0, motion.q(k + 1));
    let mut open = vec![[0.0, 1.0]];
    let mut tested = 0;
    let mut chain = Chain { last: ends[0].clone(), apart: to_first, whole: None };
    while let Some([u0, u1]) = open.pop() {
        tested += 1;
        let reaches_end = |here: &Around| u1 < 1.0 || joined(here, ends[1], &to_last);
        match curve.around(&test, [u0, u1]) {
            Ok(here) if reaches_end(&here) && chain.append(&here) => {}
            found if u1 - u0 <= 0.5_f64.powi(DEEPEST as i32) || tested >= MOST => {
                let at = curve.time(0.5 * (u0 + u1));
                let unjoined = || Fault::Singular(motion.q(k).to_vec(), at);
                return Err((at, found.err().unwrap_or_else(unjoined)));
            }
            _ => {
                let middle = 0.5 * (u0 + u1);
                open.extend([[middle, u1], [u0, middle]]);
            }
        }
    }
    chain.whole.ok_or_else(|| (curve.t0, Fault::Singular(motion.q(k).to_vec(), curve.t0)))
}

impl Around {
    /// Returns the bounds that hold for both.
    fn with(mut self, other: &Around) -> Around {
        self.inner.iter_mut().zip(&other.inner).for_each(|(a, b)| *a = a.max(*b));
        self.outer.iter_mut().zip(&other.outer).for_each(|(a, b)| *a = a.min(*b));
        self.free.iter_mut().zip(&other.free).for_each(|(a, b)| *a = a.min(*b));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joints::drivers::drive;
    use crate::{Law, Mechanism};

    fn around<const N: usize>(inner: [f64; N], outer: [f64; N]) -> Around {
        Around::new(inner.to_vec(), outer.to_vec())
    }

    /// The solution of one has to lie where the other one has no second: in all coordinates, with
    /// what the positions are apart.
    #[test]
    fn solutions_are_the_same_where_one_is_alone_in_the_box_of_the_other() {
        let a = around([0.1, 0.1], [0.2, 0.2]);
        let b = around([0.15, 0.15], [0.3, 0.3]);
        assert!(joined(&a, &b, &[0.0; 2]) && joined(&b, &a, &[0.0; 2]));
        assert!(
            joined(&a, &b, &[0.19; 2])
                && !joined(&a, &b, &[0.21; 2])
                && !joined(&a, &b, &[0.0, 0.21])
                && !joined(&a, &b, &[0.21, 0.0])
        );
        let wide = around([1.0], [2.0]);
        let narrow = around([1e-9], [1e-3]);
        assert!(joined(&wide, &narrow, &[0.0]) && joined(&narrow, &wide, &[0.0]));
        let one = around([1.0, 1e-3], [2.0, 2e-3]);
        let other = around([1e-3, 1.0], [2e-3, 2.0]);
        assert!(!joined(&one, &other, &[0.0; 2]));
    }

    /// Rounding errors count: a solution at the very edge is not within.
    #[test]
    fn edges_of_boxes_are_beyond_them() {
        let a = around([1.0], [1.0]);
        let b = around([9.0], [1.0]);
        assert!(!joined(&a, &b, &[1e-17]) && joined(&around([0.5], [1.0]), &b, &[1e-17]));
    }

    /// Each piece is joined to the one before it, and what is told of all holds for each.
    #[test]
    fn pieces_are_joined_to_their_neighbours() {
        let start = around([1e-9, 1e-9], [5.0, 5.0]);
        let one = around([1.0, 1e-3], [2.0, 2e-3]);
        let other = around([1e-3, 1.0], [2e-3, 2.0]);
        let chain = |apart: f64| Chain { last: start.clone(), apart: vec![apart; 2], whole: None };
        let mut pieces = chain(0.1);
        assert!(chain(0.1).append(&other) && pieces.append(&one) && !pieces.append(&other));
        assert_eq!(pieces.whole, Some(one.clone()));
        // The distance is that of the first piece alone.
        assert!(!chain(9.0).append(&one) && pieces.append(&around([1.5, 1e-4], [1.9, 1e-2])));
        assert_eq!(pieces.whole, Some(around([1.5, 1e-3], [1.9, 2e-3])));
        assert_eq!(Curve::still(&[1.0, 2.0], 0.0).distance(0.0, &[1.5, 2.0])[0], 0.5_f64.next_up());
    }

    /// Both computed positions are asked whether theirs is the solution of the step.
    #[test]
    fn a_step_is_joined_to_both_positions() {
        let mut m = Mechanism::new("slider");
        let x = m.length("x", 1.0).unwrap();
        m.add("motor", drive(x, Law::linear(1.0, 1.0))).unwrap();
        let system = m.build().unwrap();
        let motion = system.run([0.0, 1.0]).unwrap();
        let bounds = Bounds::new(&system).unwrap();
        let sizes = [1.0];
        let test = Test { bounds: &bounds, sizes: &sizes };
        let own = [0, 1].map(|k| {
            Curve::still(motion.q(k), motion.times()[k]).around(&test, [0.0, 1.0]).unwrap()
        });
        let elsewhere = around([5.0], [1e-30]);
        assert!(step(&bounds, &sizes, &motion, 0, [&own[0], &own[1]]).is_ok());
        assert!(step(&bounds, &sizes, &motion, 0, [&elsewhere, &own[1]]).is_err());
        assert!(step(&bounds, &sizes, &motion, 0, [&own[0], &elsewhere]).is_err());
    }
}
