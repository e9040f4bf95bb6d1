//! The examination of a mechanism from pose to verdict.

use serde::{Deserialize, Serialize};

use super::change::{self, Change};
use super::contradiction;
use super::dependency::{self, Class, Dependency};
use super::elsewhere::{self, Elsewhere};
use super::freedom::{self, Freedom, Persistence};
use super::gap::Gap;
use super::generic::{Nearby, Walk};
use super::options::DiagnosisOptions;
use super::order;
use crate::linear::{Echelon, Sparse, reduced};
use crate::model::error::{Error, Result};
use crate::model::units::Units;
use crate::system::scaled::{Measures, Model};

/// What a mechanism is at one time and pose: data for programs; `Display` is a report for people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Diagnosis {
    /// Name of the mechanism.
    pub mechanism: String,
    /// The time.   \[s\]
    pub t: f64,
    /// What the units of length and time are called.
    #[serde(default, skip_serializing_if = "Units::is_default")]
    pub units: Units,
    /// The pose that was examined: assembled, or where the smallest gap was found.   \[m, rad\]
    pub q: Vec<f64>,
    /// Number of coordinates n.
    pub coordinates: usize,
    /// Number of equations m, those of Euler parameters included.
    pub equations: usize,
    /// How many of the equations are of driving constraints.
    pub drivers: usize,
    /// Freedoms by counting (Grübler): n less the equations that do not drive.
    pub gruebler: isize,
    /// Freedoms that the joints do leave: n less their rank at nearby poses.
    pub mobility: usize,
    /// Rank of C_q at the pose.
    pub rank: usize,
    /// Rank of C_q at nearby poses of the same assembly; that at the pose where there are none.
    pub nearby_rank: usize,
    /// Whether there are nearby poses, or no need to look for any because the rank is full.
    pub moves: bool,
    /// The smallest pivot that counted over the largest that did not: 1e6 and more is clear.   \[-\]
    #[serde(with = "crate::data::unbounded")]
    pub gap: f64,
    /// Constraints that cannot be met together with all others, with what is missing at the least.
    pub gaps: Vec<Gap>,
    /// Sets of equations that depend on one another.
    pub dependencies: Vec<Dependency>,
    /// Motions that nothing holds or drives.
    pub freedoms: Vec<Freedom>,
    /// Where to begin instead, at a position that is singular alone.
    #[serde(default)]
    pub elsewhere: Option<Elsewhere>,
    /// The least change after which the mechanism is exactly constrained; empty where nothing is to be changed or nothing helps.
    pub changes: Vec<Change>,
}

/// Where an examination begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start<'a> {
    /// A guess, from which the mechanism is assembled first.
    Guess(&'a [f64]),
    /// A pose at which C = 0 holds, or nearly.
    Pose(&'a [f64]),
}

/// Rank and null spaces at one pose, each vector with the row or column of its own.
pub(super) struct Ranked {
    pub rank: usize,
    pub gap: f64,
    /// y with yᵀ C_q = 0 in scaled units.
    pub dependent: Vec<(usize, Sparse)>,
    /// x with C_q x = 0 in scaled units.
    pub free: Vec<(usize, Sparse)>,
}

/// Rows and columns in the order in which they are called superfluous or free.
pub(super) struct Orders {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
}

impl Orders {
    fn new(model: &Model<'_>) -> Self {
        Orders { rows: order::of_rows(model), columns: order::of_columns(model) }
    }

    /// The same with these first.
    fn after(&self, rows: &[usize], columns: &[usize]) -> Orders {
        let first = |first: &[usize], all: &[usize]| first.iter().chain(all.iter().filter(|k| !first.contains(k))).copied().collect();
        Orders { rows: first(rows, &self.rows), columns: first(columns, &self.columns) }
    }
}

/// Rank at a pose, where pivots below `least` count as zero.
pub(super) fn ranked(model: &Model<'_>, values: &[f64], measures: &Measures, orders: &Orders, least: f64) -> Ranked {
    let found = Echelon::new(model.scaled(values, measures, &|_| true), model.n(), least);
    Ranked {
        rank: found.rank(),
        gap: found.smallest / found.left.max(f64::EPSILON),
        dependent: reduced(found.left_null_space(), model.m(), &orders.rows),
        free: reduced(found.null_space(), model.n(), &orders.columns),
    }
}

/// Examines a mechanism at time t.
pub(crate) fn diagnose(model: Model<'_>, start: Start<'_>, t: f64, options: &DiagnosisOptions) -> Result<Diagnosis> {
    options.check()?;
    let place = contradiction::place(model, start, t, options)?;
    let (q, measures) = (&place.q, &place.measures);
    let point = model.linearize(q, t).map_err(|bad| model.not_finite(bad, q, t))?;
    // What is open is what is told: at a smallest gap other coefficients are known to fewer digits.
    let open: Vec<usize> = place.gaps.iter().flat_map(|gap| gap.rows.iter().copied()).collect();
    let walk = Walk { model: &model, measures, open: &open, without: &[], steps: options.search.steps };
    let orders = Orders::new(&model).after(&open, &[]);
    let here = ranked(&model, &point.values, measures, &orders, walk.least());
    let full = here.rank == model.n().min(model.m());
    let nearby = if full { None } else { walk.nearby(q, t, options.poses, &orders) };
    let most = nearby.as_ref().filter(|nearby| nearby.ranked.rank > here.rank);
    let here = match most {
        // What holds at nearby poses is told first, what is so only here after it.
        Some(Nearby { ranked: most, .. }) => {
            let rows: Vec<usize> = most.dependent.iter().map(|(row, _)| *row).collect();
            let columns: Vec<usize> = most.free.iter().map(|(column, _)| *column).collect();
            ranked(&model, &point.values, measures, &orders.after(&rows, &columns), walk.least())
        }
        None => here,
    };
    Ok(Examined { walk, q, t, here, nearby: nearby.as_ref(), gaps: &place.gaps, cures: &place.cures }.told(full))
}

/// All that is known before it is put into words.
pub(super) struct Examined<'a> {
    pub walk: Walk<'a>,
    pub q: &'a [f64],
    pub t: f64,
    pub here: Ranked,
    pub nearby: Option<&'a Nearby>,
    pub gaps: &'a [Gap],
    /// What would close them, tried.
    pub cures: &'a [Change],
}

impl<'a> Examined<'a> {
    pub(super) fn model(&self) -> &'a Model<'a> {
        self.walk.model
    }

    pub(super) fn measures(&self) -> &'a Measures {
        self.walk.measures
    }

    /// Whether an equation belongs to a constraint that cannot be met.
    pub(super) fn open(&self, row: usize) -> bool {
        self.walk.open.contains(&row)
    }

    fn told(&self, full: bool) -> Diagnosis {
        let model = self.model();
        let dependencies = dependency::all(self);
        let gaps = self.lasting(&dependencies);
        let freedoms = freedom::all(self);
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
            elsewhere: if self.here.rank < self.nearby_rank() && self.gaps.is_empty() { elsewhere::elsewhere(self) } else { None },
            changes,
        }
    }

    /// The gaps, and whether they are there to stay.
    fn lasting(&self, dependencies: &[Dependency]) -> Vec<Gap> {
        let lasting = |gap: &Gap| {
            let mut all = dependencies.iter().enumerate().filter(|(k, _)| self.persists(*k, Side::Rows));
            all.any(|(_, found)| found.terms.iter().any(|term| gap.rows.contains(&term.row)))
        };
        self.gaps.iter().map(|gap| Gap { lasting: lasting(gap), ..gap.clone() }).collect()
    }

    pub(super) fn nearby_rank(&self) -> usize {
        self.nearby.map_or(self.here.rank, |nearby| nearby.ranked.rank.max(self.here.rank))
    }

    /// Whether what is so at this pose is so at nearby ones, for the k-th of the vectors.
    pub(super) fn persists(&self, k: usize, side: Side) -> bool {
        let lasting = match side {
            Side::Rows => self.model().m() - self.nearby_rank(),
            Side::Columns => self.model().n() - self.nearby_rank(),
        };
        k < lasting
    }

    /// n less the rank of the joints, at a nearby pose where there is one; what gives to first order only is no freedom.
    fn mobility(&self, freedoms: &[Freedom]) -> usize {
        let model = self.model();
        let (q, t) = self.nearby.map_or((self.q, self.t), |nearby| (&nearby.q, nearby.t));
        let Ok(point) = model.linearize(q, t) else { return 0 };
        let joints = model.scaled(&point.values, self.measures(), &|row| !model.drives(row));
        let rank = Echelon::new(joints, model.n(), self.walk.least()).rank();
        let stiff = freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Infinitesimal).count();
        (model.n() - rank).saturating_sub(stiff)
    }
}

/// Rows or columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    Rows,
    Columns,
}

impl Diagnosis {
    /// Whether the mechanism can be driven at this pose: nothing contradicts, nothing is left free.
    pub fn can_be_driven(&self) -> bool {
        self.rank == self.coordinates && self.contradictions().next().is_none() && self.gaps.is_empty()
    }

    /// Whether there are as many equations as coordinates, all independent.
    pub fn is_exactly_constrained(&self) -> bool {
        self.can_be_driven() && self.equations == self.coordinates
    }

    /// Dependencies between equations that can be met together, at this pose and nearby ones.
    pub fn redundancies(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| found.class == Class::Redundant)
    }

    /// Dependencies between equations that cannot be met together.
    pub fn contradictions(&self) -> impl Iterator<Item = &Dependency> {
        self.dependencies.iter().filter(|found| matches!(found.class, Class::Contradictory { .. }))
    }

    /// Freedoms that are left at nearby poses too: something is not driven.
    pub fn lasting_freedoms(&self) -> impl Iterator<Item = &Freedom> {
        self.freedoms.iter().filter(|freedom| freedom.persistence == Persistence::Always)
    }

    /// Whether the count is right only because a superfluous equation hides a missing one.
    pub fn count_misleads(&self) -> bool {
        self.equations == self.coordinates && self.nearby_rank < self.coordinates && self.moves
    }
}

impl Model<'_> {
    /// The error for what is not finite at a pose.
    pub(crate) fn not_finite(&self, bad: crate::system::evaluate::Bad, q: &[f64], t: f64) -> Error {
        self.equations.not_finite(bad, self.layout, &self.equations.instant_at(t, q))
    }
}
