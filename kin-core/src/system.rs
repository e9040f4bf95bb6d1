//! A mechanism made ready for solving: fixed order of coordinates and equations, fixed pattern of C_q.

pub(crate) mod evaluate;
pub(crate) mod parameters;
pub(crate) mod scale;
mod states;

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::assembly::{Assembly, AssemblyOptions, Label, modes};
use crate::constraint::Constraint;
use crate::coordinates::Target;
use crate::diagnosis::{self, Diagnosis, Start};
use crate::error::{Error, Result};
use crate::layout::Layout;
use crate::linear::{Linear, Singular};
use crate::measure::Limit;
use crate::model::Model;
use crate::motion::{Motion, Series};
use crate::newton::{self, Newton, Options, Report, Steps, assembly, redundant};
use crate::sweep::Sweep;
use evaluate::{Bad, Equations, Instant, finite};

/// A system C(q, t) = 0 of m equations in n coordinates, m ≥ n; built by [`crate::Mechanism::build`].
///
/// Coordinates come in the order in which bodies and bare coordinates were declared, equations in the order in which constraints were
/// added, the norm constraints |p|² = 1 of spatial bodies (named `BODY.p`) after them.
#[derive(Clone)]
pub struct System {
    name: String,
    layout: Arc<Layout>,
    equations: Equations,
    /// Names of the equations.
    rows: Arc<[String]>,
    initial: Vec<f64>,
    preferred: Vec<(usize, f64)>,
    links: Vec<f64>,
    /// The linear solver with the elimination recorded at the initial guess, if C_q is regular there.
    linear: Linear,
    /// Ranges that measures should keep to.
    pub(crate) limits: Vec<Limit>,
}

/// Position, velocity and acceleration at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Time t.   \[s\]
    pub t: f64,
    /// q, C(q, t) = 0.   \[m, rad\]
    pub q: Vec<f64>,
    /// q̇, C_q q̇ = −C_t.   \[m/s, rad/s\]
    pub qd: Vec<f64>,
    /// q̈, C_q q̈ = Q_d.   \[m/s², rad/s²\]
    pub qdd: Vec<f64>,
    /// What Newton's iteration did.
    pub report: Report,
}

impl System {
    pub(crate) fn new(
        name: String,
        layout: Layout,
        equations: Equations,
        initial: Vec<f64>,
        preferred: Vec<(usize, f64)>,
        links: Vec<f64>,
    ) -> Self {
        let linear = prepared(&layout, &equations, &initial, &links);
        let rows = (0..equations.rows).map(|row| equations.equation(row)).collect();
        System { name, layout: Arc::new(layout), equations, rows, initial, preferred, links, linear, limits: Vec::new() }
    }

    /// Name of the mechanism.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of coordinates n.
    pub fn n_coordinates(&self) -> usize {
        self.layout.len()
    }

    /// Number of equations m; more than n if some repeat others.
    pub fn n_equations(&self) -> usize {
        self.equations.rows
    }

    /// Names of the coordinates in their order, such as `crank.R_x`, `crank.theta`, `platform.e0`, `theta3`.
    pub fn coordinate_names(&self) -> &[String] {
        &self.layout.names
    }

    /// Units of the coordinates in their order: `m`, `rad` or `-`.
    pub fn coordinate_units(&self) -> Vec<&'static str> {
        self.layout.units.iter().map(|unit| unit.text(0)).collect()
    }

    /// The planar and spatial bodies with their names, in the order of declaration.
    pub fn bodies(&self) -> Vec<(&str, Target)> {
        self.layout.bodies()
    }

    /// The constraints with their names, in their order; the norm constraints of spatial bodies come last.
    pub fn constraints(&self) -> impl Iterator<Item = (&str, &dyn Constraint)> {
        self.equations.blocks.iter().map(|block| (block.name.as_str(), block.constraint.as_ref()))
    }

    /// The 2-norm condition number of C_q at each time of a motion of this system, rows and columns measured as the solver does, so that
    /// it does not depend on units; estimated from below, seldom by more than 2. Infinite where C_q is singular.   \[-\]
    ///
    /// Errors: a motion of another system.
    pub fn condition(&self, motion: &Motion) -> Result<Series> {
        let values = (0..motion.len()).map(|k| self.condition_at(motion.q(k), motion.times()[k])).collect::<Result<_>>()?;
        Ok(Series::new("condition number", "-", motion.times(), values))
    }

    fn condition_at(&self, q: &[f64], t: f64) -> Result<f64> {
        if redundant::is_redundant(self) {
            return Ok(self.condition_of_all_rows(self.jacobian(q, t)?, q, t));
        }
        let mut linear = self.linearized(q, t)?;
        Ok(if linear.factor().is_ok() { linear.condition() } else { f64::INFINITY })
    }

    /// The same where there are more rows than columns, by singular values.
    fn condition_of_all_rows(&self, mut c_q: DMatrix<f64>, q: &[f64], t: f64) -> f64 {
        let measures = self.model().measure(q, t);
        c_q.column_iter_mut().zip(&measures.sizes).for_each(|(mut column, size)| column *= *size);
        c_q.row_iter_mut().zip(&measures.norms).for_each(|(mut row, norm)| row /= *norm);
        let singular = c_q.singular_values();
        singular.max() / singular.min()
    }

    /// Names of the constraints in their order.
    pub fn constraint_names(&self) -> Vec<&str> {
        self.equations.blocks.iter().map(|block| block.name.as_str()).collect()
    }

    /// Names of the equations in their order: `A.x`, `A.y`; a constraint of one row gives its own name.
    pub fn equation_names(&self) -> Vec<String> {
        self.rows.to_vec()
    }

    pub(crate) fn names_of_equations(&self) -> &Arc<[String]> {
        &self.rows
    }

    /// The initial guess of q, preferred values included.   \[m, rad\]
    pub fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// Gives another initial guess of q (length n); preferred values stay preferred.
    pub fn set_initial(&mut self, q: &[f64]) -> Result<()> {
        self.check(q, "initial guess")?;
        self.initial.copy_from_slice(q);
        self.linear.forget();
        Ok(())
    }

    /// C(q, t), in the unit of each row. Errors: wrong length, not finite.
    pub fn residual(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut c = vec![0.0; self.n_equations()];
        self.finite(self.equations.residual(&instant, &mut c), &instant)?;
        Ok(c)
    }

    /// C_q(q, t), m × n. Errors: wrong length, not finite.
    pub fn jacobian(&self, q: &[f64], t: f64) -> Result<DMatrix<f64>> {
        let mut values = vec![0.0; self.equations.entries.len()];
        self.linearize(&self.instant(q, t)?, &mut values)?;
        let mut c_q = DMatrix::zeros(self.n_equations(), self.n_coordinates());
        for (entry, value) in self.equations.entries.iter().zip(values) {
            if let Some(place) = *entry {
                c_q[place] += value;
            }
        }
        Ok(c_q)
    }

    /// C_t(q, t), in the unit of each row a second. Errors: wrong length, not finite.
    pub fn c_t(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        let mut rhs = vec![0.0; self.n_equations()];
        self.equations.velocity_rhs(&instant, &mut rhs);
        self.finite(finite(&rhs, "C_t"), &instant)?;
        Ok(rhs.into_iter().map(|x| 0.0 - x).collect())
    }

    /// Q_d = −(C_q q̇)_q q̇ − 2 C_qt q̇ − C_tt, in the unit of each row a second squared. Errors: wrong length, not finite.
    pub fn acceleration_rhs(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let mut instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.equations.set_rates(qd, &mut instant);
        let mut q_d = vec![0.0; self.n_equations()];
        self.equations.acceleration_rhs(&instant, &mut q_d);
        self.finite(finite(&q_d, "Q_d"), &instant)?;
        Ok(q_d)
    }

    /// q̇ at a position q, from C_q q̇ = −C_t. Errors: wrong length, not finite, singular.
    pub fn velocity(&self, q: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs: Vec<f64> = self.c_t(q, t)?.into_iter().map(|x| -x).collect();
        let qd = self.solved(q, t, &rhs)?;
        self.check(&qd, "velocities")?;
        Ok(qd)
    }

    /// q̈ at a position q and velocity q̇, from C_q q̈ = Q_d. Errors: wrong length, not finite, singular.
    pub fn acceleration(&self, q: &[f64], qd: &[f64], t: f64) -> Result<Vec<f64>> {
        let q_d = self.acceleration_rhs(q, qd, t)?;
        let qdd = self.solved(q, t, &q_d)?;
        self.check(&qdd, "accelerations")?;
        Ok(qdd)
    }

    /// −g‴(0) with g(s) = C(q + s q̇ + ½ s² q̈, t + s): the right side of C_q q⃛, in the unit of each row a second cubed.
    ///
    /// Errors: wrong length, not finite, a hand-written constraint without [`Constraint::jerk_rhs`].
    pub fn jerk_rhs(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let instant = self.instant(q, t)?;
        self.check(qd, "velocities")?;
        self.check(qdd, "accelerations")?;
        let rhs = self.model().jerk_rhs(q, t, qd, qdd)?;
        rhs.map_err(|bad| self.equations.not_finite(bad, &instant))
    }

    /// q⃛ at a position q, velocity q̇ and acceleration q̈, from C_q q⃛ = −g‴(0). Errors: those of [`System::jerk_rhs`], singular.
    pub fn jerk(&self, q: &[f64], qd: &[f64], qdd: &[f64], t: f64) -> Result<Vec<f64>> {
        let rhs = self.jerk_rhs(q, qd, qdd, t)?;
        let qddd = self.solved(q, t, &rhs)?;
        self.check(&qddd, "jerk")?;
        Ok(qddd)
    }

    /// Position, velocity and acceleration at time t, assembled from the initial guess into the preferred assembly.
    /// Errors: no convergence, singular, not finite.
    pub fn position(&self, t: f64) -> Result<Solution> {
        if redundant::is_redundant(self) {
            return redundant::at(self, time(t)?, None);
        }
        let options = Options::default();
        let mut newton = Newton::new(self, &options);
        let outcome = assembly::assemble(&mut newton, time(t)?).map_err(|error| error.explained(self))?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at time t by damped Newton steps from q0 (length n), nothing preferred.
    /// Errors: wrong length, no convergence, singular, not finite.
    pub fn solve_at(&self, t: f64, q0: &[f64]) -> Result<Solution> {
        self.check(q0, "start")?;
        if redundant::is_redundant(self) {
            return redundant::at(self, time(t)?, Some(q0));
        }
        let options = Options::default();
        let mut newton = Newton::new(self, &options);
        newton.q.copy_from_slice(q0);
        let outcome = assembly::from_start(&mut newton, time(t)?, Steps::Damped)?;
        Ok(newton.solution(t, outcome))
    }

    /// Position, velocity and acceleration at each of the times, which must only increase or only decrease.   \[s\]
    ///
    /// Errors: no convergence, singular, not finite; each carries the motion up to it ([`Error::motion`]).
    pub fn run(&self, times: impl AsRef<[f64]>) -> Result<Motion> {
        self.run_with(times, &Options::default())
    }

    /// The same with other options.
    pub fn run_with(&self, times: impl AsRef<[f64]>, options: &Options) -> Result<Motion> {
        let mut motion = newton::sweep::run(self, times.as_ref(), options)?;
        self.note_limits(&mut motion);
        Ok(motion)
    }

    /// Many cases of this system: in each of them the named parameters (such as `A.u_i.x`) and initial values (such as `rocker.theta`) are
    /// others. See [`Sweep`].
    ///
    /// Errors: a name that is neither a parameter nor a coordinate.
    pub fn sweep(&self, names: impl IntoIterator<Item = impl AsRef<str>>) -> Result<Sweep<'_>> {
        Sweep::new(self, names)
    }

    /// An error by name unless every constraint knows its part of the jerk.
    pub(crate) fn knows_jerk(&self) -> Result<()> {
        let still = vec![0.0; self.n_coordinates()];
        self.model().jerk_rhs(&self.initial, 0.0, &still, &still).map(|_| ())
    }

    /// Whether no law of its constraints has a break; a run has to look for those time by time.
    pub(crate) fn is_smooth(&self) -> bool {
        let (mut smooth, instant) = (true, self.equations.instant_at(0.0, &self.initial));
        for block in &self.equations.blocks {
            block.constraint.laws(&instant.of(block), &mut |_, law, _| smooth &= law.is_smooth());
        }
        smooth
    }

    /// Whether a position that closes is meant by all constraints, none of which has, say, its axis turned by 180°.
    pub(crate) fn is_meant(&self, t: f64, q: &[f64]) -> bool {
        let instant = self.equations.instant_at(t, q);
        self.equations.blocks.iter().all(|block| block.constraint.wrong_branch(&instant.of(block)).is_none())
    }

    /// What the mechanism is at time t, assembled from the initial guess: counts, rank, dependencies and freedoms by name.
    ///
    /// Errors: t not finite, nothing finite near the guess.
    pub fn diagnose(&self, t: f64) -> Result<Diagnosis> {
        diagnosis::diagnose(self.model(), Start::Guess(&self.initial), time(t)?)
    }

    /// The same at a pose q (length n), brought onto C = 0 first where it is off.
    ///
    /// Errors: wrong length, not finite.
    pub fn diagnose_at(&self, t: f64, q: &[f64]) -> Result<Diagnosis> {
        self.check(q, "pose")?;
        diagnosis::diagnose(self.model(), Start::Pose(q), time(t)?)
    }

    /// All assemblies that are found at time t, in the order of their labels; the same each time.
    ///
    /// The search goes on until nothing new turns up for a while, so for difficult mechanisms ask for more patience
    /// ([`System::assemblies_with`]). None is an empty list.
    ///
    /// Errors: t not finite, a mechanism that is free to move.
    pub fn assemblies(&self, t: f64) -> Result<Vec<Assembly>> {
        self.assemblies_with(t, &AssemblyOptions::default())
    }

    /// The same with other options.
    pub fn assemblies_with(&self, t: f64, options: &AssemblyOptions) -> Result<Vec<Assembly>> {
        modes::all(self.model(), &self.initial, time(t)?, options)
    }

    /// The assembly of a label that [`System::assemblies`] gave out.
    ///
    /// Errors: those of [`System::assemblies`]; no assembly of that name.
    pub fn assembly(&self, t: f64, label: &Label) -> Result<Assembly> {
        let all = self.assemblies(t)?;
        let known = || all.iter().map(|assembly| assembly.label.to_string()).collect();
        let found = all.iter().find(|assembly| assembly.label == *label).cloned();
        found.ok_or_else(|| Error::UnknownName { what: "assembly", name: label.to_string(), known: known() })
    }

    pub(crate) fn model(&self) -> Model<'_> {
        Model { name: &self.name, layout: &self.layout, equations: &self.equations, preferred: &self.preferred, links: &self.links }
    }

    pub(crate) fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    pub(crate) fn equations(&self) -> &Equations {
        &self.equations
    }

    /// A linear solver for C_q, with all that never changes in its place, and measured at the initial guess where that has been done.
    pub(crate) fn linear(&self) -> Linear {
        self.linear.clone()
    }

    pub(crate) fn preferred(&self) -> &[(usize, f64)] {
        &self.preferred
    }

    pub(crate) fn links(&self) -> &[f64] {
        &self.links
    }

    /// Name of the constraint and of its row for a global row.
    pub(crate) fn row_name(&self, row: usize) -> (String, String) {
        let found = self.equations.block_of(row);
        found.map(|(block, local)| (block.name.clone(), block.row(local).to_string())).unwrap_or_default()
    }

    /// The error for a singular matrix at time t.
    pub(crate) fn singular(&self, t: f64, found: &Singular, unmet: Option<String>) -> Error {
        let mut movable: Vec<String> = found.columns.iter().filter_map(|&k| Some(self.layout.owner(k)?.name.clone())).collect();
        movable.dedup();
        let dependent = found.rows.iter().map(|&row| self.equations.equation(row)).collect();
        Error::SingularAt {
            t,
            n: self.n_coordinates(),
            rank: found.rank,
            pivot: found.pivot,
            movable,
            dependent,
            unmet,
            diagnosis: None,
            motion: None,
        }
    }

    /// The instant at q and t, if they are well given.
    fn instant(&self, q: &[f64], t: f64) -> Result<Instant> {
        self.check(q, "coordinates")?;
        Ok(self.equations.instant_at(time(t)?, q))
    }

    /// The values of C_q at an instant.
    fn linearize(&self, instant: &Instant, values: &mut [f64]) -> Result<()> {
        let mut c = vec![0.0; self.n_equations()];
        self.equations.set_constants(values);
        self.equations.linearize(instant, &mut c, values);
        self.finite(self.equations.finite(&c, values), instant)
    }

    fn check(&self, q: &[f64], what: &str) -> Result<()> {
        let (expected, found) = (self.n_coordinates(), q.len());
        if expected != found {
            return Err(Error::WrongLength { what: what.to_string(), expected, found });
        }
        match q.iter().position(|x| !x.is_finite()) {
            Some(k) => Err(self.layout.not_finite(k, q[k])),
            None => Ok(()),
        }
    }

    fn finite(&self, result: std::result::Result<(), Bad>, instant: &Instant) -> Result<()> {
        result.map_err(|bad| self.equations.not_finite(bad, instant))
    }

    /// C_q⁻¹ times the right side, with the sizes of that point; in the sense of least squares where there are more equations.
    fn solved(&self, q: &[f64], t: f64, rhs: &[f64]) -> Result<Vec<f64>> {
        if redundant::is_redundant(self) {
            return redundant::solved(self, q, t, rhs);
        }
        let mut linear = self.linearized(q, t)?;
        linear.factor().map_err(|found| self.singular(t, &found, None))?;
        linear.rhs_mut().copy_from_slice(rhs);
        linear.solve();
        Ok(linear.solution().to_vec())
    }

    /// C_q(q, t) with the sizes of that point, ready to be factored.
    fn linearized(&self, q: &[f64], t: f64) -> Result<Linear> {
        let instant = self.instant(q, t)?;
        let mut linear = self.linear();
        linear.forget();
        self.linearize(&instant, linear.values_mut())?;
        let sizes = scale::sizes(&self.layout, &self.equations, linear.values(), q, &self.links);
        linear.set_sizes(&sizes);
        linear.measure();
        Ok(linear)
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

/// The linear solver, its elimination recorded at the initial guess and t = 0.
fn prepared(layout: &Layout, equations: &Equations, initial: &[f64], links: &[f64]) -> Linear {
    let mut linear = Linear::new(layout.len(), equations.entries.iter().copied(), &equations.constants);
    if equations.rows != layout.len() {
        return linear;
    }
    let mut c = vec![0.0; equations.rows];
    equations.set_constants(linear.values_mut());
    equations.linearize(&equations.instant_at(0.0, initial), &mut c, linear.values_mut());
    if equations.finite(&c, linear.values()).is_ok() {
        linear.set_sizes(&scale::sizes(layout, equations, linear.values(), initial, links));
        linear.prepare();
    }
    linear
}

fn time(t: f64) -> Result<f64> {
    if t.is_finite() { Ok(t) } else { Err(Error::InvalidTimes { reason: format!("t is {t}; give a finite time") }) }
}
