//! Examines a mechanism, from the pose to the verdict.

use super::cure::change;
use super::examined::{Examined, Side, acting};
use super::generic::{Nearby, Walk};
use super::rank::{Orders, ranked};
use super::{contradiction, dependency, elsewhere, freedom};
use crate::linear::Echelon;
use crate::outcome::error::Result;
use crate::outcome::verdict::{Dependency, Diagnosis, Freedom, Gap, Persistence};
use crate::solve::assembly::SearchOptions;
use crate::solve::explain::Start;
use crate::system::scaled::Model;

/// Examines a mechanism at time t.
pub(crate) fn diagnose(
    model: Model<'_>,
    start: Start<'_>,
    t: f64,
    options: &SearchOptions,
) -> Result<Diagnosis> {
    options.check()?;
    let place = contradiction::place(model, start, t, options)?;
    let q = &place.q;
    let measures = &place.measures;
    let point = model.linearize(q, t).map_err(|bad| model.not_finite(bad, q, t))?;
    // The open rows are those of the reported gaps. At a smallest gap other coefficients have fewer
    // correct digits.
    let open: Vec<usize> = place.gaps.iter().flat_map(|gap| gap.rows.iter().copied()).collect();
    let walk = Walk { model: &model, measures, open: &open, without: &[], steps: options.steps };
    let orders = Orders::new(&model).after(&open, &[]);
    let here = ranked(&model, &point.values, measures, &orders, walk.least());
    let full = here.rank == model.n().min(model.m());
    let nearby = if full { None } else { walk.nearby(q, t, options.poses, &orders) };
    let most = nearby.as_ref().filter(|nearby| nearby.ranked.rank > here.rank);
    let here = match most {
        // Dependencies that also hold at nearby poses are reported first, those of this pose alone
        // after them.
        Some(Nearby { ranked: most, .. }) => {
            let rows: Vec<usize> = most.dependent.iter().map(|(row, _)| *row).collect();
            let columns: Vec<usize> = most.free.iter().map(|(column, _)| *column).collect();
            ranked(&model, &point.values, measures, &orders.after(&rows, &columns), walk.least())
        }
        None => here,
    };
    let acting = acting(&model);
    let examined = Examined {
        walk,
        q,
        t,
        here,
        nearby: nearby.as_ref(),
        gaps: &place.gaps,
        cures: &place.cures,
        acting,
    };
    Ok(examined.diagnosis(full))
}

impl Examined<'_> {
    fn diagnosis(&self, full: bool) -> Diagnosis {
        let model = self.model();
        let persistence = freedom::persistences(self);
        let dependencies = dependency::all(self, &persistence);
        let gaps = self.lasting(&dependencies);
        let freedoms = freedom::all(self, &persistence);
        let changes = change::least(self, &gaps, &dependencies, &freedoms);
        let drivers = (0..model.m()).filter(|row| model.drives(*row)).count();
        Diagnosis {
            mechanism: model.name.to_string(),
            t: self.t,
            units: model.layout.words.clone(),
            q: self.q.to_vec(),
            coordinates: model.n(),
            equations: model.m(),
            drivers,
            gruebler: model.n() as isize - (model.m() - drivers) as isize,
            mobility: self.mobility(&freedoms),
            rank: self.here.rank,
            nearby_rank: self.nearby_rank(),
            moves: full || self.nearby.is_some(),
            gap: self.here.gap,
            gaps,
            dependencies,
            freedoms,
            elsewhere: if self.here.rank < self.nearby_rank() && self.gaps.is_empty() {
                elsewhere::elsewhere(self)
            } else {
                None
            },
            changes,
        }
    }

    /// Returns the gaps and marks those that exist at nearby poses too.
    fn lasting(&self, dependencies: &[Dependency]) -> Vec<Gap> {
        let lasting = |gap: &Gap| {
            let mut all =
                dependencies.iter().enumerate().filter(|(k, _)| self.persists(*k, Side::Rows));
            all.any(|(_, found)| found.terms.iter().any(|term| gap.rows.contains(&term.row)))
        };
        self.gaps.iter().map(|gap| Gap { lasting: lasting(gap), ..gap.clone() }).collect()
    }

    /// Returns n minus the rank of the joints, at a nearby pose if there is one. A freedom of first
    /// order only does not count.
    fn mobility(&self, freedoms: &[Freedom]) -> usize {
        let model = self.model();
        let (q, t) = self.nearby.map_or((self.q, self.t), |nearby| (&nearby.q, nearby.t));
        let Ok(point) = model.linearize(q, t) else { return 0 };
        let joints = model.scaled(&point.values, self.measures(), &|row| !model.drives(row));
        let rank = Echelon::new(joints, model.n(), self.walk.least()).rank();
        let stiff = freedoms
            .iter()
            .filter(|freedom| freedom.persistence == Persistence::Infinitesimal)
            .count();
        (model.n() - rank).saturating_sub(stiff)
    }
}
