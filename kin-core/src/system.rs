//! Stores a mechanism in the form that solvers use: a fixed order of coordinates and equations and
//! a fixed pattern of C_q.

mod axes;
mod cache;
pub(crate) mod dimensions;
pub(crate) mod drivers;
pub(crate) mod evaluate;
pub(crate) mod measures;
pub(crate) mod parameters;
pub(crate) mod scale;
pub(crate) mod scaled;
pub(crate) mod singular;
mod solution;
mod states;
pub(crate) mod stop;
mod terms;

use std::sync::Arc;

use crate::coordinates::Target;
use crate::coordinates::layout::{Layout, Place};
use crate::coordinates::units::Units;
use crate::linear::Linear;
use crate::model::constraint::Constraint;
use crate::model::loads::Loads;
use crate::model::mechanism::Limit;
use crate::outcome::error::{Error, FailureKind, Result};
use crate::system::scaled::Model;
use cache::Cache;
use dimensions::Dimensions;
use evaluate::Equations;
pub use solution::{Report, Solution};

/// A system C(q, t) = 0 of m equations in n coordinates, m ≥ n. [`crate::Mechanism::build`] creates
/// it.
///
/// The coordinates are in the order in which the program declared bodies and scalar coordinates.
/// The equations are in the order in which the program added constraints. The norm constraints |p|²
/// = 1 of spatial bodies (named `BODY.p`) come last.
#[derive(Clone)]
pub struct System {
    name: String,
    layout: Arc<Layout>,
    equations: Equations,
    /// The names of the equations, one for each row.
    rows: Arc<[String]>,
    initial: Vec<f64>,
    preferred: Vec<(usize, f64)>,
    /// The preferred measures of joints.
    pub(crate) asked: Vec<PreferredMeasure>,
    /// The lengths of all links as (item, length between the pins). \[m\]
    lengths: Vec<(usize, f64)>,
    /// The lengths of the planar links. \[m\]
    links: Vec<f64>,
    dimensions: Option<Dimensions>,
    /// The linear solver. If C_q is regular at the initial guess, its elimination is recorded
    /// there.
    linear: Linear,
    /// The permitted ranges of measures.
    pub(crate) limits: Vec<Limit>,
    /// Axes of which components were set.
    axes: Vec<axes::Given>,
    cache: Cache,
    /// Masses, gravity and loads. Only the computation of forces uses them.
    pub(crate) loads: Arc<Loads>,
}

/// A preferred measure of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreferredMeasure {
    pub block: usize,
    pub number: usize,
    pub is_angle: bool,
    pub value: f64,
}

impl System {
    pub(crate) fn new(
        name: String,
        layout: Layout,
        mut equations: Equations,
        initial: Vec<f64>,
        preferred: Vec<(usize, f64)>,
    ) -> Self {
        let lengths = layout.links.clone();
        let links = layout.planar(&lengths);
        equations.find_drivers(&initial);
        let linear = prepared(&layout, &equations, &initial, &links);
        let rows = (0..equations.rows).map(|row| equations.equation(row)).collect();
        let asked = Vec::new();
        let limits = Vec::new();
        System {
            name,
            layout: Arc::new(layout),
            equations,
            rows,
            initial,
            preferred,
            asked,
            lengths,
            links,
            dimensions: None,
            linear,
            limits,
            axes: Vec::new(),
            cache: Cache::default(),
            loads: Arc::default(),
        }
    }

    /// Returns the name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of coordinates n.
    pub fn n_coordinates(&self) -> usize {
        self.layout.len()
    }

    /// Returns true if there are more equations than coordinates.
    pub(crate) fn is_redundant(&self) -> bool {
        self.n_equations() > self.n_coordinates()
    }

    /// Returns the number of equations m.
    ///
    /// If some equations are redundant, m is larger than the number of coordinates n.
    pub fn n_equations(&self) -> usize {
        self.equations.rows
    }

    /// Returns the names of the coordinates in order, such as `crank.R_x`, `crank.theta`,
    /// `platform.e0`, `theta3`.
    pub fn coordinate_names(&self) -> &[String] {
        &self.layout.names
    }

    /// Returns the units of the coordinates in order: `m` (or the name from
    /// [`crate::Mechanism::units`]), `rad` or `-`.
    pub fn coordinate_units(&self) -> Vec<String> {
        self.layout.unit_words()
    }

    /// Returns the names of the units of length and time.
    pub fn unit_words(&self) -> &Units {
        &self.layout.words
    }

    /// Returns the length between the two pins of a link, or `None` for a body that is not a link.
    /// \[m\]
    pub fn link_length(&self, body: &Target) -> Option<f64> {
        let Some(Place::Own { item, .. }) = self.layout.place(body) else { return None };
        self.lengths.iter().find(|(known, _)| *known == item).map(|(_, length)| *length)
    }

    /// Returns the planar and spatial bodies with their names, in the order of declaration.
    pub fn bodies(&self) -> Vec<(&str, Target)> {
        self.layout.bodies()
    }

    /// Returns the constraints with their names, in the order of the equations.
    ///
    /// The norm constraints of spatial bodies come last.
    pub fn constraints(&self) -> impl Iterator<Item = (&str, &dyn Constraint)> {
        self.equations.blocks.iter().map(|block| (block.name.as_str(), block.constraint.as_ref()))
    }

    /// Returns the names of the constraints in the order of the equations.
    pub fn constraint_names(&self) -> Vec<&str> {
        self.equations.blocks.iter().map(|block| block.name.as_str()).collect()
    }

    /// Returns the names of the equations in order, such as `A.x`, `A.y`.
    ///
    /// The equation of a constraint with one row has the name of the constraint alone.
    pub fn equation_names(&self) -> Vec<String> {
        self.rows.to_vec()
    }

    pub(crate) fn names_of_equations(&self) -> &Arc<[String]> {
        &self.rows
    }

    /// Returns the initial guess of q, including preferred values. \[m, rad\]
    pub fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// Sets the initial guess of q (length n). \[m, rad\]
    ///
    /// The preferred values of the mechanism remain preferred.
    pub fn set_initial(&mut self, q: &[f64]) -> Result<()> {
        self.check(q, "initial guess")?;
        self.initial.copy_from_slice(q);
        self.forget();
        Ok(())
    }

    /// Returns an error, by name, unless every constraint knows its part of the jerk.
    pub(crate) fn knows_jerk(&self) -> Result<()> {
        let still = vec![0.0; self.n_coordinates()];
        self.model().jerk_rhs(&self.initial, 0.0, &still, &still).map(|_| ())
    }

    /// True if no law of its constraints has a break; a run has to look for those time by time.
    pub(crate) fn is_smooth(&self) -> bool {
        let mut smooth = true;
        let instant = self.equations.instant_at(0.0, &self.initial);
        for block in &self.equations.blocks {
            block.constraint.laws(&self.equations.at(block, &instant), &mut |_, law, _| {
                smooth &= law.is_smooth()
            });
        }
        smooth
    }

    pub(crate) fn model(&self) -> Model<'_> {
        self.model_within(0.0)
    }

    /// The same, where redundant equations may contradict one another by a share of their norms.
    pub(crate) fn model_within(&self, misfit: f64) -> Model<'_> {
        let System { name, layout, equations, preferred, links, .. } = self;
        Model { name, layout, equations, preferred, links, misfit, work: None }
    }

    pub(crate) fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    pub(crate) fn equations(&self) -> &Equations {
        &self.equations
    }

    /// Returns a linear solver for C_q that already contains all constants. If the system has
    /// recorded an elimination at the initial guess, the solver contains it too.
    pub(crate) fn linear(&self) -> Linear {
        self.linear.clone()
    }

    /// Returns the indices of the constraints with conditions or other kinks.
    pub(crate) fn switching(&self) -> &[usize] {
        self.equations.switching()
    }

    pub(crate) fn preferred(&self) -> &[(usize, f64)] {
        &self.preferred
    }

    /// Prefers a value of one coordinate and guesses it.
    pub(crate) fn prefer_column(&mut self, column: usize, value: f64) {
        self.initial[column] = value;
        self.preferred.retain(|(known, _)| *known != column);
        self.preferred.push((column, value));
        self.forget();
    }

    /// Discards everything derived from the system, because something was set.
    pub(crate) fn forget(&mut self) {
        self.linear.forget();
        self.cache.forget();
    }

    /// Discards what other rooms derive from the system, because time acts in another way. The
    /// recorded elimination remains: it depends on C_q alone.
    pub(crate) fn forget_derived(&mut self) {
        self.cache.forget();
    }

    /// Returns the values that other rooms derive from the system and keep.
    pub(crate) fn cache(&self) -> &Cache {
        &self.cache
    }

    pub(crate) fn links(&self) -> &[f64] {
        &self.links
    }

    /// Returns the names of the constraint and of the row of a global row.
    pub(crate) fn row_name(&self, row: usize) -> (String, String) {
        let found = self.equations.block_of(row);
        found
            .map(|(block, local)| (block.name.clone(), block.row(local).to_string()))
            .unwrap_or_default()
    }

    /// Builds the error for a singular matrix at a pose and time.
    pub(crate) fn singular(&self, t: f64, q: &[f64], unmet: Option<String>) -> Error {
        let model = self.model();
        let point = match model.linearize(q, t) {
            Ok(point) => point,
            Err(bad) => return model.not_finite(bad, q, t),
        };
        let found = singular::singular(&model, &point.values, &model.measure(q, t));
        let kind = FailureKind::SingularAt {
            n: self.n_coordinates(),
            rank: found.rank,
            pivot: found.pivot,
            movable: found.movable,
            dependent: found.dependent,
            unmet,
            drawn: false,
        };
        kind.at(t, &self.layout.words)
    }

    pub(crate) fn check(&self, q: &[f64], what: &str) -> Result<()> {
        let expected = self.n_coordinates();
        let found = q.len();
        if expected != found {
            return Err(Error::WrongLength { what: what.to_string(), expected, found });
        }
        match q.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(Error::initial_not_finite(&self.layout, k, q[k])),
            None => Ok(()),
        }
    }
}

impl std::fmt::Debug for System {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("System")
            .field("name", &self.name)
            .field("coordinates", &self.layout.names)
            .field("constraints", &self.constraint_names())
            .finish()
    }
}

/// Returns the linear solver with its elimination recorded at the initial guess and t = 0.
fn prepared(layout: &Layout, equations: &Equations, initial: &[f64], links: &[f64]) -> Linear {
    let mut linear =
        Linear::new(layout.len(), equations.entries.iter().copied(), &equations.constants);
    if equations.rows != layout.len() {
        return linear;
    }
    let mut c = vec![0.0; equations.rows];
    equations.set_constants(linear.values_mut());
    equations.linearize(initial, &equations.instant_at(0.0, initial), &mut c, linear.values_mut());
    if equations.finite(&c, linear.values()).is_ok() {
        linear.set_sizes(&scale::sizes(layout, equations, linear.values(), (initial, 0.0), links));
        linear.prepare();
    }
    linear
}

pub(crate) fn time(t: f64) -> Result<f64> {
    if t.is_finite() {
        Ok(t)
    } else {
        Err(Error::InvalidTimes { reason: format!("t is {t}. Give a finite time") })
    }
}
