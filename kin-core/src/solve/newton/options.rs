//! How positions are solved: the stop rule and the means, and the report of what was done.

use crate::model::error::{Error, Result};
use crate::model::loads::LoadSharing;
use crate::numbers::lanes::limit;
use crate::solve::assembly::{AssemblyOptions, SearchOptions};

/// When Newton's iteration has converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The scaled residual is at most `tolerance` *and* so is the scaled next correction C_q⁻¹ C,
    /// with the matrix at hand.
    ///
    /// Row i is measured by max_j |∂C_i/∂q_j| s_j and coordinate j by s_j, where s_j is 1 for an
    /// angle and the typical length of the model for a length: a tolerance of 1e-13 means 1e-13 rad
    /// and 1e-13 of a lever, in mm as in km. The error of a row that comes from rounding of q
    /// itself is always allowed; a correction that no longer shrinks while the residual is rounding
    /// is accepted. Smaller: no better results below 1e-15; larger: fewer steps, errors of that
    /// size in q and larger ones in q̇ and q̈.   \[-\]
    Converged {
        /// The tolerance, default 1e-13.
        tolerance: f64,
    },
    /// max |C_i| < the bound, rows unscaled as they are written, in the unit of the row: the
    /// protocol of published comparisons.
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
    /// Newton steps at one attempt before it is given up; default 50.
    pub max_iterations: usize,
    /// The stop rule.
    pub stop: Stop,
    /// True (default): Newton's iteration starts at each time from q + h q̇ + ½ h² q̈ of the time
    /// before. After three equal steps it starts from a polynomial through all three times, where
    /// that has been nearer. False: it starts from q of the time before.
    pub predict: bool,
    /// True (default): where Newton's iteration fails, the solver damps it, searches from other
    /// starts (first time), and approaches in smaller steps of time (later times). False: the run
    /// fails there, except for what [`SolverOptions::follow`] checks.
    pub rescue: bool,
    /// Halvings of one step of time before the run is given up, where steps are rescued and not
    /// checked; default 12. Times that differ by rounding only are not halved any more.
    pub halvings: u32,
    /// The search for the first position, and the diagnosis where there is none.
    pub search: SearchOptions,
    /// The search for all assemblies ([`crate::System::assemblies`]).
    pub assemblies: AssemblyOptions,
    /// True: the run solves for the jerk q⃛ too, C_q q⃛ = −g‴(0) with
    /// g(s) = C(q + s q̇ + ½ s² q̈, t + s), with the matrix of q̇ and q̈. Default false.
    pub jerk: bool,
    /// The misfit that redundant equations may have, as a share of the norm of each equation: of
    /// the mechanism's size where a row is a length. The default 0 allows rounding (1e-10) and no
    /// more. Parts of ordinary accuracy, such as an imported assembly, need more. Positions are
    /// then those of least squares, and [`crate::Motion::misfit`] reports the misfit.   \[-\]
    pub allowed_misfit: f64,
    /// The check that each step stays on its branch, and the branch that a run takes where branches
    /// cross; default [`Follow::Smooth`].
    pub follow: Follow,
    /// The engine that computes the times of a run, the cases of a sweep, and forces; default
    /// [`Engine::Auto`]. [`crate::Solver::run_in_parts`] goes step by step unless
    /// [`Engine::Compiled`] is set. Single positions do so unless [`crate::System::compile`] was
    /// called.
    pub engine: Engine,
    /// The rule by which redundant constraints share forces; default: none.
    pub sharing: LoadSharing,
    /// Bytes that the motion of a run may take, three or four numbers a coordinate and time;
    /// default 2³⁰ (1 GiB). A run that needs more is refused before it begins;
    /// [`crate::Solver::run_in_parts`] needs the memory of one part.   \[B\]
    pub memory: usize,
    /// How much work a run may spend on smaller steps of time, which are no results, and after a
    /// failure on its diagnosis, as a multiple of the usual; default 1, some seconds' worth. A run
    /// that needs more ends with [`crate::Error::CannotFollow`]. The work is counted, not timed, so
    /// a run ends alike on each machine.   \[-\]
    pub effort: f64,
}

/// The engines that compute the times of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Engine {
    /// Uses the compiled program where it is possible and faster, else the step-by-step solver. The
    /// program is faster from about a thousand times on, or from 32 after a call of
    /// [`crate::System::compile`]. In a sweep the times of all cases count together, if each case
    /// has at least 24.
    ///
    /// Runs without prediction, runs with [`Stop::ResidualOnly`], and all runs on a machine without
    /// AVX2 and FMA, AVX-512 or Neon go step by step. [`crate::Motion::engine`] says how many times
    /// the program computed, [`crate::Motion::why_not_compiled`] why it did not.
    ///
    /// Kin keeps the program for the next run that begins at the same time and position, until you
    /// set a value of the system.
    #[default]
    Auto,
    /// Evaluates constraint by constraint, one time after the other.
    StepByStep,
    /// Computes many times at once by one program of all equations ([`crate::System::compile`]).
    /// Each time passes the same checks as in the step-by-step solver. If a check fails, the
    /// step-by-step solver continues from the last accepted time. Numbers agree to the tolerance of
    /// [`SolverOptions::stop`], not to the last digit.
    ///
    /// Where an equation takes another branch of an `if` of coordinates, or a `floor` of
    /// coordinates jumps, the step-by-step solver continues. Kin evaluates a function of time that
    /// only rustc can read once for each time.
    ///
    /// Errors: a mechanism that cannot be compiled. The error names why: more equations than
    /// coordinates, an equation that Kin does not know as a formula, or a function of coordinates
    /// that only rustc can read.
    Compiled,
}

/// How a run follows its branch.
///
/// If a run cannot show that a step stays on its branch, it takes smaller steps in between, which
/// it does not keep. So a coarse grid gives the same motion as a fine one.
///
/// * *Drives:* Kin evaluates the bounds of each drive between both times
///   ([`crate::extend::LawFunction::over`]), so it follows a motor that goes out and comes back
///   within a step. Without bounds Kin samples at the eighths of the step, and does not see what
///   happens between the samples. This concerns user-defined laws without bounds, and constraints
///   on the dual route or by hand that contain time.
/// * *Work:* a run takes at most ten million smaller steps times coordinates, some seconds' worth,
///   and twenty for each of its times. A run that needs more ends with
///   [`crate::Error::CannotFollow`]. Then give closer times or a larger [`SolverOptions::effort`].
/// * *Singular positions:* a toggle ends the run with [`crate::Error::Toggle`] at its time. A run
///   passes change points, and [`crate::Motion::singular_positions`] lists them. With redundant
///   equations Kin checks steps by prediction alone, and the run ends at a singular position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Follow {
    /// Accepts each position that Newton's method finds, without a check. On a coarse grid this can
    /// be a position of another assembly.
    Unchecked,
    /// Checks each step. At a change point the run continues smoothly (q̇ and q̈ do not jump).
    #[default]
    Smooth,
    /// Checks each step. At the change points with these numbers the run takes the other branch;
    /// they count from 0 in the order of the run.
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
    /// Returns the defaults.
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
