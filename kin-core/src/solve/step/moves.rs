//! Steps of a follower: one at a time, with everything that the last one has left.

use std::sync::OnceLock;

use super::Stepper;
use crate::coordinates::MechanismId;
use crate::coordinates::layout::Layout;
use crate::solve::options::SolverOptions;
use crate::solve::step::advance::{Asked, Stepping};
use crate::system::System;
use crate::system::evaluate::Equations;

/// The solver of a follower between two moves: the present position with its factored C_q.
pub(crate) struct Moves {
    /// `None` after a step that did not end well.
    stepper: Option<Stepper<'static>>,
    /// True if the laws of time act so that the ends of any step show everything.
    straight: bool,
}

/// One move along a straight line in the values of drivers, in which the time goes from −h to 0.
#[derive(Clone, Copy)]
pub(crate) struct Move {
    /// The length of the move, above zero.
    pub h: f64,
    /// True if the drivers have the velocities of the last move.
    pub goes_on: bool,
}

impl Moves {
    /// Begins at a position q at time −h. Laws that move all drivers at once, each at another
    /// velocity, must be in place. Returns `None` if C_q is singular there, or if there are more
    /// equations than coordinates.
    pub(crate) fn begin(
        system: &System,
        options: &SolverOptions,
        q: &[f64],
        h: f64,
    ) -> Option<Self> {
        if system.is_redundant() {
            return None;
        }
        let mut stepper = Stepper::new(system, options);
        stepper.begin_from(-h, q).ok()?;
        let Stepper { newton, check, .. } = &mut stepper;
        let straight = check
            .as_mut()
            .is_none_or(|check| check.ends_always_suffice(system.equations(), &newton.instant));
        Some(Moves { stepper: Some(idle(stepper)), straight })
    }

    /// Makes one tested step from the last position, along the present laws. Returns the position
    /// at the end of the move, or `None` if anything objects.
    pub(crate) fn step(
        &mut self,
        system: &System,
        options: &SolverOptions,
        Move { h, goes_on }: Move,
    ) -> Option<&[f64]> {
        let kept = self.stepper.take()?;
        let mut stepper = kept.on(system, options);
        let ended = stepper.moved_on(h, goes_on, self.straight);
        self.stepper = ended.then(|| idle(stepper));
        self.stepper.as_ref().map(|stepper| &stepper.newton.q[..])
    }
}

impl Stepper<'_> {
    fn moved_on(&mut self, h: f64, goes_on: bool, straight: bool) -> bool {
        let equations = self.newton.system.equations();
        if !goes_on {
            self.predictor.forget();
            equations.set_time(-h, &mut self.newton.instant);
            if self.newton.rates().is_err() {
                return false;
            }
        }
        if !straight {
            self.check.iter_mut().for_each(|check| check.forget_laws(equations));
        }
        // The numbers of the time are those of other laws.
        self.newton.instant.forget_time();
        self.newton.steps_before = self.newton.steps;
        let asked = Asked { from: -h, to: 0.0 };
        self.keep();
        if self.attempt(h, 0.0, asked).is_err() || !self.passed.is_empty() {
            return false;
        }
        self.confirm();
        (self.last, self.untouched) = (Some(0.0), true);
        true
    }
}

/// A stepper that waits, with a system that has no equations in place of its own.
#[inline(always)]
fn idle(stepper: Stepper<'_>) -> Stepper<'static> {
    static NONE: OnceLock<(System, SolverOptions)> = OnceLock::new();
    let (system, options) = NONE.get_or_init(|| {
        let layout = Layout::new(MechanismId::ANY);
        let equations = Equations::new(&layout, Vec::new());
        let system = System::new(String::new(), layout, equations, Vec::new(), Vec::new());
        (system, SolverOptions::default())
    });
    stepper.on(system, options)
}
