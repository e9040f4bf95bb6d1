//! Defines the options with which Kin solves positions, such as the stop rule and the engine.

use crate::model::loads::LoadSharing;
use crate::numbers::lanes::limit;
use crate::outcome::error::{Error, Result};
use crate::solve::assembly::{AssemblyOptions, SearchOptions};

/// The rule by which Newton's iteration has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The scaled residual and the scaled next correction C_q⁻¹ C are both at most `tolerance`.
    /// \[-\]
    ///
    /// Kin divides row i by max_j |∂C_i/∂q_j| s_j and coordinate j by s_j. The size s_j is 1 for an
    /// angle, and the typical length of the model for a length. So a tolerance of 1e-13 means 1e-13
    /// rad for angles and 1e-13 of the typical length for lengths, in any unit. Kin always allows
    /// the residual that rounding of q causes. Kin also accepts a correction that no longer
    /// decreases when the residual is only rounding. A tolerance below 1e-15 does not improve
    /// results. A larger tolerance saves steps and causes errors of its size in q, and larger
    /// errors in q̇ and q̈.
    Converged {
        /// The tolerance, default 1e-13.
        tolerance: f64,
    },
    /// The largest residual max |C_i| of the unscaled rows is below this bound, in the unit of the
    /// row. Published comparisons of solvers use this rule.
    ResidualOnly(f64),
}

impl Default for Stop {
    fn default() -> Self {
        Stop::Converged { tolerance: 1e-13 }
    }
}

/// Options of runs, single positions, sweeps, diagnoses and searches for assemblies.
///
/// Every field has a default and a setter of the same name.
///
/// ```
/// use kin::{Engine, SolverOptions};
///
/// let options = SolverOptions::new().jerk(true).engine(Engine::StepByStep);
/// assert!(options.jerk && options.predict);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolverOptions {
    /// The largest number of Newton steps in one attempt (default 50).
    pub max_iterations: usize,
    /// The stop rule of Newton's iteration.
    pub stop: Stop,
    /// True (default) if Newton's iteration starts from a prediction at each time. The prediction
    /// is q + h q̇ + ½ h² q̈ of the previous time. After three equal steps the prediction is a
    /// polynomial through all three times, if this polynomial was nearer at the previous time. If
    /// false, Newton's iteration starts from q of the previous time.
    pub predict: bool,
    /// True (default) if the solver tries other ways when Newton's iteration fails. The solver then
    /// damps the iteration, searches from other starts at the first time, and makes smaller steps
    /// of time at later times. If false, the run fails at this time, except that
    /// [`SolverOptions::follow`] may still make smaller steps.
    pub rescue: bool,
    /// The largest number of halvings of one step of time, for runs with `rescue` and
    /// [`Follow::Unchecked`] (default 12). Kin does not halve a step between times that differ only
    /// by rounding.
    pub halvings: u32,
    /// The options of the search for the first position, and of the diagnosis if no first position
    /// exists.
    pub search: SearchOptions,
    /// The options of the search for all assemblies ([`crate::System::assemblies`]).
    pub assemblies: AssemblyOptions,
    /// True if a run also solves for the jerk q⃛ (default false). The equation is C_q q⃛ = −g‴(0)
    /// with g(s) = C(q + s q̇ + ½ s² q̈, t + s), with the same matrix as for q̇ and q̈.
    pub jerk: bool,
    /// The misfit that redundant equations may have, as a share of the norm of each equation
    /// (default 0). \[-\] For an equation of lengths, the norm is the mechanism's size. The default
    /// 0 allows only rounding (1e-10). Mechanisms with rounded dimensions, such as an imported
    /// assembly, need a larger value. With a larger value positions are least-squares solutions,
    /// and [`crate::Motion::misfit`] reports the misfit.
    pub allowed_misfit: f64,
    /// The check that each step stays on its branch, and the branch that a run takes where branches
    /// cross (default [`Follow::Smooth`]).
    pub follow: Follow,
    /// The engine that computes the times of a run, the cases of a sweep, and forces (default
    /// [`Engine::Auto`]). With the default, [`crate::Solver::run_in_parts`] uses the step-by-step
    /// solver. Single positions use the step-by-step solver unless the program has called
    /// [`crate::System::compile`].
    pub engine: Engine,
    /// The rule by which redundant constraints share forces (default [`LoadSharing::NotGiven`]).
    pub sharing: LoadSharing,
    /// The largest memory of the motion of a run, in bytes (default 2³⁰, 1 GiB). \[B\] A motion has
    /// three or four numbers of 8 bytes for each coordinate and time. A run that needs more memory
    /// returns an error before it begins. [`crate::Solver::run_in_parts`] needs only the memory of
    /// one part.
    pub memory: usize,
    /// The largest work of a run on smaller steps of time and on a diagnosis after a failure, as a
    /// multiple of the usual limit (default 1). \[-\] The usual limit takes some seconds. A run
    /// that needs more work ends with [`CannotFollow`](crate::error::FailureKind::CannotFollow).
    /// Kin counts operations and not time, so a run ends at the same step on each machine.
    pub effort: f64,
}

/// The engines that compute the times of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Engine {
    /// Uses the compiled program if possible and faster, otherwise the step-by-step solver.
    ///
    /// The program is faster for runs of at least about 1000 times, or at least 32 times after a
    /// call of [`crate::System::compile`]. In a sweep Kin counts the times of all cases together,
    /// if each case has at least 24 times.
    ///
    /// Three kinds of runs use the step-by-step solver: runs without prediction, runs with
    /// [`Stop::ResidualOnly`], and all runs on a machine without AVX2 and FMA, AVX-512 or Neon.
    /// [`crate::Motion::engine`] says how many times the program computed.
    /// [`crate::Motion::why_not_compiled`] says why the run used no program.
    ///
    /// Kin keeps the program for the next run that begins at the same time and position, until you
    /// set a value of the system.
    #[default]
    Auto,
    /// Evaluates the constraints one by one, one time after the other.
    StepByStep,
    /// Computes many times at once by one program of all equations ([`crate::System::compile`]).
    ///
    /// Each time passes the same checks as in the step-by-step solver. If a check fails, the
    /// step-by-step solver continues from the last accepted time. The results of both engines agree
    /// to the tolerance of [`SolverOptions::stop`], not to the last digit.
    ///
    /// If an equation takes another branch of an `if` of coordinates, or if a `floor` of
    /// coordinates jumps, the step-by-step solver continues. If only rustc can read a function of
    /// time, Kin evaluates the function once for each time.
    ///
    /// Errors: Kin cannot compile the mechanism, because it has more equations than coordinates, an
    /// equation without a formula, or a function of coordinates that only rustc can read. The error
    /// names the reason.
    Compiled,
}

/// How a run follows its branch.
///
/// If a run cannot show that a step stays on its branch, the run makes smaller steps, which are not
/// part of the motion. So a coarse grid of times gives the same motion as a fine grid.
///
/// * *Drives:* Kin evaluates the bounds of each drive between both times
///   ([`crate::extend::LawFunction::over`]), so Kin follows a motor that moves forward and returns
///   within a step. If a drive has no bounds, Kin samples at the eighths of the step and can miss a
///   motion between the samples. User-defined laws without bounds, and constraints with time that
///   are hand-written or on the dual route, have no bounds.
/// * *Work:* the number of smaller steps times the number of coordinates is at most ten million,
///   which takes some seconds. In addition, a run may make twenty smaller steps for each of its
///   times. A run that needs more steps ends with
///   [`CannotFollow`](crate::error::FailureKind::CannotFollow). In this case give closer times or a
///   larger [`SolverOptions::effort`].
/// * *Singular positions:* a toggle ends the run with
///   [`Toggle`](crate::error::FailureKind::Toggle). A run passes change points, and
///   [`crate::Motion::singular_positions`] lists them. With redundant equations Kin checks steps by
///   prediction alone, and the run ends at a singular position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Follow {
    /// Accepts each position that Newton's method finds, without a check. On a coarse grid the
    /// position can belong to another assembly.
    Unchecked,
    /// Checks each step, and continues smoothly at change points (q̇ and q̈ do not jump).
    #[default]
    Smooth,
    /// Checks each step, and takes the other branch at the change points with these indices. The
    /// indices count from 0 in the order of the run.
    OtherBranchAt(Vec<usize>),
}

impl Follow {
    /// True if the run turns into the other branch at the change point of that number.
    pub(crate) fn turns(&self, number: usize) -> bool {
        matches!(self, Follow::OtherBranchAt(numbers) if numbers.contains(&number))
    }
}

impl Default for SolverOptions {
    fn default() -> Self {
        SolverOptions {
            max_iterations: 50,
            stop: Stop::default(),
            predict: true,
            rescue: true,
            halvings: 12,
            search: SearchOptions::default(),
            assemblies: AssemblyOptions::default(),
            jerk: false,
            allowed_misfit: 0.0,
            follow: Follow::default(),
            engine: Engine::default(),
            sharing: LoadSharing::default(),
            memory: 1 << 30,
            effort: 1.0,
        }
    }
}

impl SolverOptions {
    /// Returns the default options.
    pub fn new() -> Self {
        Self::default()
    }

    setters! {
        /// Sets [`SolverOptions::max_iterations`].
        max_iterations: usize,
        /// Sets [`SolverOptions::stop`].
        stop: Stop,
        /// Sets [`SolverOptions::predict`].
        predict: bool,
        /// Sets [`SolverOptions::rescue`].
        rescue: bool,
        /// Sets [`SolverOptions::halvings`].
        halvings: u32,
        /// Sets [`SolverOptions::search`].
        search: SearchOptions,
        /// Sets [`SolverOptions::assemblies`].
        assemblies: AssemblyOptions,
        /// Sets [`SolverOptions::jerk`].
        jerk: bool,
        /// Sets [`SolverOptions::allowed_misfit`].
        allowed_misfit: f64,
        /// Sets [`SolverOptions::follow`].
        follow: Follow,
        /// Sets [`SolverOptions::engine`].
        engine: Engine,
        /// Sets [`SolverOptions::sharing`].
        sharing: LoadSharing,
        /// Sets [`SolverOptions::memory`].
        memory: usize,
        /// Sets [`SolverOptions::effort`].
        effort: f64,
    }

    /// An error if so many motions at once, each of so many times and coordinates, take more memory
    /// than is allowed.
    pub(crate) fn check_memory(
        &self,
        motions: usize,
        times: usize,
        coordinates: usize,
    ) -> Result<()> {
        let orders = if self.jerk { 4.0 } else { 3.0 };
        let word = std::mem::size_of::<f64>() as f64;
        // The time, its residual and its number of Newton steps stand beside the coordinates.
        let needed = motions as f64 * times as f64 * word * (3.0 + orders * coordinates as f64);
        if needed <= self.memory as f64 {
            return Ok(());
        }
        Err(Error::NeedsMemory { motions, times, coordinates, needed, allowed: self.memory })
    }

    /// The tolerance of corrections; any will do where the residual alone is the stop rule.
    pub(crate) fn tolerance(&self) -> f64 {
        match self.stop {
            Stop::Converged { tolerance } => tolerance,
            Stop::ResidualOnly(_) => f64::INFINITY,
        }
    }

    /// A step of time no longer than this is the last that is tried, of those between two times;
    /// times nearer to one another are hardly told apart.
    pub(crate) fn smallest_step(&self, from: f64, to: f64) -> f64 {
        let halved = (to - from).abs() * 0.5_f64.powi(self.halvings.min(1000) as i32);
        halved.max(resolution(from, to))
    }

    /// An error unless the tolerance is a positive finite number and there is something to do.
    pub(crate) fn check(&self) -> Result<()> {
        self.search.check()?;
        if let Err(reason) = limit() {
            return Err(Error::InvalidOptions { reason: reason.clone() });
        }
        if !(0.0..=0.1).contains(&self.allowed_misfit) {
            let misfit = self.allowed_misfit;
            return Err(Error::InvalidOptions {
                reason: format!(
                    "the allowed misfit is {misfit}. Give a fraction of the mechanism's size from 0 to 0.1"
                ),
            });
        }
        if !(self.effort.is_finite() && self.effort > 0.0) {
            let effort = self.effort;
            return Err(Error::InvalidOptions {
                reason: format!("the effort is {effort}. Give a positive number such as 10"),
            });
        }
        let (Stop::Converged { tolerance } | Stop::ResidualOnly(tolerance)) = self.stop;
        if tolerance.is_finite() && tolerance > 0.0 {
            return Ok(());
        }
        Err(Error::InvalidOptions {
            reason: format!("the tolerance is {tolerance}. Give a positive number such as 1e-13"),
        })
    }
}

/// Steps between two times that are shorter than this are rounding.
pub(super) fn resolution(from: f64, to: f64) -> f64 {
    8.0 * f64::EPSILON * from.abs().max(to.abs())
}
