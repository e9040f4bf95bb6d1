//! Computes the effect of time alone on a constraint, with constant coordinates.

use std::collections::HashMap;

use super::{Block, Equations, Instant};
use crate::model::constraint::Route;
use crate::model::formula::Table;
use crate::model::formula::sides::{Numbers, choices, kinks};
use crate::model::formula::time::can_jump;

/// A row that was satisfied and now exceeds its allowance by this factor has jumped. \[-\]
const FAR: f64 = 100.0;

/// ∂C_i/∂q_j of a row; the number if it is constant.
#[derive(Clone)]
struct Slope {
    column: usize,
    constant: Option<f64>,
}

impl Equations {
    /// Returns the constraints whose C can change with the time at constant q.
    pub(crate) fn moved_by_time(&self) -> impl Iterator<Item = usize> {
        // Hand-written constraints need not declare this; `find_drivers` has tested them.
        let moves = |block: &Block| {
            let facts = block.constraint.facts();
            facts.dependence.c_on_t && (block.drives || facts.route() != Route::Hand)
        };
        self.blocks.iter().enumerate().filter(move |(_, block)| moves(block)).map(|(k, _)| k)
    }

    /// Returns the constraints whose C can jump when coordinates move, or for which this is
    /// unknown.
    pub(crate) fn jumping(&self) -> &[usize] {
        self.jumping.get_or_init(|| {
            // Constraints of one kind share their formula.
            let mut known: HashMap<*const Table, bool> = HashMap::new();
            let mut jumps = |block: &Block| {
                let jumps = block.constraint.formula(|table, _, _| {
                    let can = || {
                        table.formula().rows.len() != block.rows().len()
                            || can_jump(table.formula())
                    };
                    *known.entry(std::ptr::from_ref(table)).or_insert_with(can)
                });
                jumps.unwrap_or(true) && block.constraint.facts().dependence.curved
            };
            (0..self.blocks.len()).filter(|k| jumps(&self.blocks[*k])).collect()
        })
    }

    /// The constraints with conditions or other kinks. On the dual route they are not known, and
    /// the constraint counts as having none.
    pub(crate) fn switching(&self) -> &[usize] {
        self.switching.get_or_init(|| {
            let switches = |block: &Block| {
                block.constraint.formula(|table, _, _| table.may_switch()).unwrap_or(false)
            };
            (0..self.blocks.len()).filter(|k| switches(&self.blocks[*k])).collect()
        })
    }

    /// True if each coordinate is given by a row, c q_j + rest = 0 with the same c for good and a
    /// rest of coordinates that are given before it. Then there is one position at each time, none
    /// is singular, and there is no other branch.
    pub(crate) fn is_explicit(&self) -> bool {
        *self.explicit.get_or_init(|| self.jumping().is_empty() && self.gives_all())
    }

    fn gives_all(&self) -> bool {
        let mut slopes = vec![Vec::<Slope>::new(); self.rows];
        let mut readers = Vec::<Vec<usize>>::new();
        for (&(row, column), constant) in self
            .entries
            .iter()
            .zip(&self.constants)
            .filter_map(|(entry, constant)| entry.as_ref().map(|entry| (entry, constant)))
        {
            readers.resize_with(readers.len().max(column + 1), Vec::new);
            match slopes[row].iter_mut().find(|slope| slope.column == column) {
                Some(slope) => slope.constant = slope.constant.zip(*constant).map(|(a, b)| a + b),
                None => {
                    slopes[row].push(Slope { column, constant: *constant });
                    readers[column].push(row);
                }
            }
        }
        // A row with one unknown coordinate determines it.
        let mut open: Vec<usize> = slopes.iter().map(Vec::len).collect();
        let mut given = vec![false; readers.len()];
        let mut count = 0;
        let mut next: Vec<usize> = (0..self.rows).filter(|row| open[*row] == 1).collect();
        while let Some(row) = next.pop() {
            let Some(slope) = slopes[row].iter().find(|slope| !given[slope.column]) else {
                return false;
            };
            if slope.constant.is_none_or(|c| c == 0.0) {
                return false;
            }
            given[slope.column] = true;
            count += 1;
            for &reader in &readers[slope.column] {
                open[reader] -= 1;
                next.extend((open[reader] == 1).then_some(reader));
            }
        }
        count == self.rows
    }

    /// Returns true if a constraint that can jump is far from satisfied at q. The instant must be
    /// at q; `allowed` contains the allowance of each row.
    pub(crate) fn has_jumped(&self, q: &[f64], instant: &mut Instant, allowed: &[f64]) -> bool {
        self.set_position(q, instant);
        self.jumping().iter().map(|k| &self.blocks[*k]).any(|block| {
            let mut c = vec![0.0; block.rows().len()];
            block.constraint.residual(&self.at(block, instant), &mut c);
            c.iter().zip(&allowed[block.rows.range()]).any(|(c, allowed)| c.abs() > FAR * allowed)
        })
    }

    /// Appends the branches of all constraints at the instant, as numbers that are constant on each
    /// branch. Constraints without a known formula have none.
    pub(crate) fn choices(&self, instant: &Instant, to: &mut Vec<f64>) {
        to.clear();
        for block in self.jumping().iter().map(|k| &self.blocks[*k]) {
            self.choices_of(block, instant, to);
        }
    }

    /// The same, and the sides of kinks (`abs`, `max`, `min`) as 0 and 1.
    pub(crate) fn sides(&self, instant: &Instant, to: &mut Vec<f64>) {
        self.choices(instant, to);
        for block in self.switching().iter().map(|k| &self.blocks[*k]) {
            let q = self.columns_of(block, instant);
            let t = instant.t;
            block.constraint.formula(|table, parameters, outside| {
                kinks(table.formula(), &Numbers { q: &q, t, parameters, outside }, to);
            });
        }
    }

    /// The choices of one constraint, appended to a list.
    pub(crate) fn choices_of(&self, block: &Block, instant: &Instant, to: &mut Vec<f64>) {
        let q = self.columns_of(block, instant);
        let t = instant.t;
        block.constraint.formula(|table, parameters, outside| {
            choices(table.formula(), &Numbers { q: &q, t, parameters, outside }, to);
        });
    }

    /// Returns the coordinates of a constraint, argument after argument.
    pub(crate) fn columns_of(&self, block: &Block, instant: &Instant) -> Vec<f64> {
        let at = self.at(block, instant);
        let arguments = block.constraint.arguments();
        let all = arguments
            .iter()
            .enumerate()
            .flat_map(|(k, argument)| at.coordinates(k, argument.target.columns()));
        all.copied().collect()
    }

    /// Returns C, C_t and C_tt of a constraint at another time and the position of the instant.
    /// Afterwards the instant is no longer valid for other constraints.
    pub(crate) fn held(&self, block: &Block, t: f64, instant: &mut Instant) -> [Vec<f64>; 3] {
        block.constraint.at_time(t, &mut instant.timed[block.timed.range()]);
        instant.t = t;
        let at = self.at(block, instant);
        let no_rates = self.plan.no_rates();
        let [mut c, mut c_t, mut c_tt] = [0; 3].map(|_| vec![0.0; block.rows().len()]);
        block.constraint.residual(&at, &mut c);
        block.constraint.velocity_rhs(&at, &mut c_t);
        block.constraint.acceleration_rhs(&at, &self.rates(block, &no_rates), 1.0, &mut c_tt);
        c_t.iter_mut().chain(&mut c_tt).for_each(|x| *x = -*x);
        [c, c_t, c_tt]
    }
}

#[cfg(test)]
mod tests {
    use crate::joints::drivers::{drive, drive_angle};
    use crate::joints::planar::revolute;
    use crate::{Ground, Law, Mechanism, System, constraint, vec2};

    fn chain(close: bool) -> System {
        let mut m = Mechanism::new("chain");
        let [a, b] = ["a", "b"].map(|name| m.link(name, 1.0).expect("a link"));
        m.add("O", revolute(Ground, a, vec2(0.0, 0.0), a.start())).expect("adds");
        m.add("A", revolute(a, b, a.end(), b.start())).expect("adds");
        m.add("turn", drive_angle(b, Law::ramp(-2.0))).expect("adds");
        let motor = if close {
            m.add("motor", drive(b.x(), Law::ramp(0.1)))
        } else {
            m.add("motor", drive_angle(a, Law::ramp(1.0)))
        };
        motor.expect("adds");
        m.build().expect("builds")
    }

    /// A row that jumps determines x.
    #[constraint]
    fn by_steps(x: Coord, y: Coord) -> f64 {
        x + y.floor()
    }

    fn alone(stepped: bool) -> System {
        let mut m = Mechanism::new("alone");
        let [x, y] = ["x", "y"].map(|name| m.length(name, 0.0).expect("a length"));
        m.add("y", drive(y, Law::ramp(1.0))).expect("adds");
        if stepped {
            m.add("x", by_steps(x, y))
        } else {
            m.add("x", drive(x, Law::sine(1.0, 1.0, 0.0)))
        }
        .expect("adds");
        m.build().expect("builds")
    }

    #[test]
    fn chains_are_explicit_and_loops_and_jumps_are_not() {
        let found = [chain(false), chain(true), alone(false), alone(true)]
            .map(|system| system.equations().is_explicit());
        assert_eq!(found, [true, false, true, false]);
    }
}
