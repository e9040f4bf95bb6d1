//! Effects of time alone on a constraint, its coordinates held.

use std::collections::HashMap;

use super::{Block, Equations, Instant};
use crate::model::constraint::Route;
use crate::model::formula::Table;
use crate::model::formula::time::can_jump;

/// A row that was met and is off by more than this, by its measure, has jumped.   \[-\]
const FAR: f64 = 1e-6;

impl Equations {
    /// The constraints whose C can change with the time at the same q.
    pub(crate) fn moved_by_time(&self) -> impl Iterator<Item = usize> {
        // Those written by hand need not say so, and have been looked at: see `find_drivers`.
        let moves = |block: &Block| {
            let facts = block.constraint.facts();
            facts.dependence.c_on_t && (block.drives || facts.route() != Route::Hand)
        };
        self.blocks.iter().enumerate().filter(move |(_, block)| moves(block)).map(|(k, _)| k)
    }

    /// The constraints whose C can jump where coordinates move, or of which that is not known.
    pub(crate) fn jumping(&self) -> &[usize] {
        self.jumping.get_or_init(|| {
            // Constraints of one kind share their table.
            let mut known: HashMap<*const Table, bool> = HashMap::new();
            let mut jumps = |block: &Block| {
                let jumps = block.constraint.formula(|table, _, _| {
                    let can =
                        || table.formula().rows.len() != block.rows().len() || can_jump(table.formula());
                    *known.entry(std::ptr::from_ref(table)).or_insert_with(can)
                });
                jumps.unwrap_or(true) && block.constraint.facts().dependence.curved
            };
            (0..self.blocks.len()).filter(|k| jumps(&self.blocks[*k])).collect()
        })
    }

    /// True if a constraint that can jump is far from being met at q, which the instant is set to; rows by
    /// their measures.
    pub(crate) fn has_jumped(
        &self,
        q: &[f64],
        instant: &mut Instant,
        per_norm: &[f64],
        c: &mut [f64],
    ) -> bool {
        self.set_position(q, instant);
        self.jumping().iter().map(|k| &self.blocks[*k]).any(|block| {
            let c = &mut c[block.rows.range()];
            block.constraint.residual(&self.at(block, instant), c);
            c.iter().zip(&per_norm[block.rows.range()]).any(|(c, unit)| (c * unit).abs() > FAR)
        })
    }

    /// The coordinates of a constraint, one argument after the other.
    pub(crate) fn columns_of(&self, block: &Block, instant: &Instant) -> Vec<f64> {
        let (at, arguments) = (self.at(block, instant), block.constraint.arguments());
        let all = arguments
            .iter()
            .enumerate()
            .flat_map(|(k, argument)| at.coordinates(k, argument.target.columns()));
        all.copied().collect()
    }

    /// C, C_t and C_tt of a constraint at another time, the position of the instant held; the instant is of
    /// no use to others then.
    pub(crate) fn held(&self, block: &Block, t: f64, instant: &mut Instant) -> [Vec<f64>; 3] {
        block.constraint.at_time(t, &mut instant.timed[block.timed.range()]);
        instant.t = t;
        let (at, no_rates) = (self.at(block, instant), self.plan.no_rates());
        let [mut c, mut c_t, mut c_tt] = [0; 3].map(|_| vec![0.0; block.rows().len()]);
        block.constraint.residual(&at, &mut c);
        block.constraint.velocity_rhs(&at, &mut c_t);
        block.constraint.acceleration_rhs(&at, &self.rates(block, &no_rates), 1.0, &mut c_tt);
        c_t.iter_mut().chain(&mut c_tt).for_each(|x| *x = -*x);
        [c, c_t, c_tt]
    }
}
