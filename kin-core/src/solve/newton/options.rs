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

/// SolverOptions of runs, single positions, sweeps, diagnoses and searches for assemblies.
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
    /// A program where one can be made and pays, for which there have to be a thousand times at
    /// least, or 32 after a call of [`crate::System::compile`], which makes one without the jerk;
    /// else plain steps. Plain too are runs without prediction, and with [`Stop::ResidualOnly`],
    /// and all runs on a machine without AVX2 and FMA, AVX-512 or Neon. The times of all cases of a
    /// sweep count together, where each has 24 at least. [`crate::Motion::engine`] tells how many
    /// times a program has computed, [`crate::Motion::why_not_compiled`] what stood in the way of
    /// one.
    ///
    /// A program is kept for the next run that begins at the same time and position, until anything
    /// is set in the system.
    #[default]
    Auto,
    /// Constraint by constraint, one time after the other.
    StepByStep,
    /// All equations as one program ([`crate::System::compile`]), many times at once. Every time is
    /// judged as plain steps are; where there is an objection plain steps go on from the last time
    /// that was accepted. Numbers agree to the tolerance of [`SolverOptions::stop`], not to the
    /// last digit.
    ///
    /// Where an equation chooses another side of an `if` of coordinates, or a `floor` of them
    /// jumps, the block of times ends and plain steps go on. A value of time that only rustc can
    /// read is asked for each time.
    ///
    /// A mechanism that cannot be compiled is an error that names why not: it has more equations
    /// than coordinates, an equation that is not known as a formula, or a function of coordinates
    /// that only rustc can read.
    Compiled,
}

/// How a run follows its branch.
///
/// A step that cannot be shown to stay on its branch is taken in smaller ones, which are not kept:
/// a coarse grid gives the same motion as a fine one. Each drive is asked for its bounds between
/// both times ([`crate::model::law::LawFunction::over`]): a motor that goes out and comes back
/// within a step is followed. A law of one's own without bounds, and constraints on the dual route
/// or written by hand in which time stands, are sampled at the eighths of each step instead; what
/// they do between those is not seen. A run takes ten million smaller steps times coordinates at
/// most, some seconds' worth, and twenty for each of its times. Where more would lead to the next
/// time, the run ends with [`crate::Error::CannotFollow`]: give times that are nearer to one
/// another, or a larger [`SolverOptions::effort`]. A toggle ends the run with
/// [`crate::Error::Toggle`] at its time; change points are passed, and told by
/// [`crate::Motion::singular_positions`]. Mechanisms with redundant equations are checked by
/// prediction alone: at a singular position their runs end.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Follow {
    /// Nothing is checked: whatever position Newton's method finds is taken. On a coarse grid it
    /// can be one of another assembly.
    Unchecked,
    /// Checked; at a change point the run goes on smoothly (q̇ and q̈ do not jump).
    #[default]
    Smooth,
    /// Checked; at the change points with these numbers, counted from 0 in the order in which the
    /// run meets them, it turns into the other branch.
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
                    "the allowed misfit is {misfit}; give a share of the size from 0 to 0.1"
                ),
            });
        }
        if !(self.effort.is_finite() && self.effort > 0.0) {
            let effort = self.effort;
            return Err(Error::InvalidOptions {
                reason: format!("the effort is {effort}; give a positive number such as 10"),
            });
        }
        let (Stop::Converged { tolerance } | Stop::ResidualOnly(tolerance)) = self.stop;
        if tolerance.is_finite() && tolerance > 0.0 {
            return Ok(());
        }
        Err(Error::InvalidOptions {
            reason: format!("the tolerance is {tolerance}; give a positive number such as 1e-13"),
        })
    }
}

/// Steps between two times that are shorter than this are rounding.
pub(super) fn resolution(from: f64, to: f64) -> f64 {
    8.0 * f64::EPSILON * from.abs().max(to.abs())
}
