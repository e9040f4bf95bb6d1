//! Finds the first position of a mechanism with more equations than coordinates.

use super::Position;
use super::errors::unmet;
use super::solver::{Solver, scales};
use crate::numbers::padded::Padded;
use crate::outcome::error::Result;
use crate::solve::assembly::search::{self, Found};
use crate::solve::explain::{Explain, Start};
use crate::solve::follow::Drive;
use crate::solve::newton::Outcome;
use crate::solve::options::{Follow, SolverOptions};
use crate::solve::step::advance::Effort;
use crate::solve::step::predictor::Predictor;
use crate::system::System;
use crate::system::scaled::{Measures, Point};

impl<'a> Position<'a> {
    fn new(
        system: &'a System,
        (options, explain): (&'a SolverOptions, Option<Explain>),
        t: f64,
        (q, measures): (Vec<f64>, Measures),
    ) -> Self {
        let model = system.model_within(options.allowed_misfit);
        let n = model.n();
        let equations = model.equations;
        let mut point =
            Point { c: vec![0.0; model.m()], values: vec![0.0; equations.entries.len()] };
        equations.set_constants(&mut point.values);
        let [row_shares, shares] = [&measures.norms, &measures.sizes]
            .map(|sizes| sizes.iter().map(|size| size.recip()).collect::<Vec<_>>());
        let turns: Vec<f64> =
            (0..n).map(|column| f64::from(u8::from(model.turns(column)))).collect();
        let zeros = || Padded::new(n, 0.0);
        Position {
            scales: scales(&model, &measures),
            solver: Solver::new(&model),
            instant: equations.instant(),
            point,
            system,
            model,
            options,
            explain,
            measures,
            row_shares: Padded::from(&row_shares[..]),
            shares: Padded::from(&shares[..]),
            turns: Padded::from(&turns[..]),
            predictor: Predictor::new(n),
            rhs: Padded::new(model.m(), 0.0),
            x: zeros(),
            t,
            last: zeros(),
            q: Padded::from(&q[..]),
            qd: zeros(),
            qdd: zeros(),
            qddd: vec![],
            steps: 0,
            iterations: 0,
            worst: 0,
            misfit: 0.0,
            drive: Some(Drive::new(equations)),
            effort: Effort::new(n, options.effort),
        }
    }

    /// Assembles from the guess, into the preferred assembly.
    pub(super) fn assembled(
        system: &'a System,
        options: &'a SolverOptions,
        t: f64,
        explain: Option<Explain>,
    ) -> Result<(Self, Outcome)> {
        let model = system.model_within(options.allowed_misfit);
        let mut found = search::search(model, system.initial(), t, &|_| true, &options.search);
        if let Some(q) = system.nearer(
            found.as_ref().filter(|found| found.met).map(|found| &found.place.q[..]),
            t,
            &options.search,
        ) {
            found = search::descend(model, &q, t, &|_| true, false, options.search.steps);
        }
        Self::found(system, options, t, found, (system.initial(), explain))
    }

    /// Assembles from a start, without preferences.
    pub(super) fn from_start(
        system: &'a System,
        options: &'a SolverOptions,
        t: f64,
        (start, explain): (&[f64], Explain),
    ) -> Result<(Self, Outcome)> {
        let found = search::descend(
            system.model_within(options.allowed_misfit),
            start,
            t,
            &|_| true,
            false,
            options.search.steps,
        );
        Self::found(system, options, t, found, (start, Some(explain)))
    }

    /// Solves from a position that satisfies the equations at that time, at least nearly.
    pub(super) fn near(
        system: &'a System,
        options: &'a SolverOptions,
        t: f64,
        start: &[f64],
    ) -> Result<(Self, Outcome)> {
        let model = system.model_within(options.allowed_misfit);
        let steps = options.search.steps;
        let found = search::descend(model, start, t, &|_| true, false, steps);
        Self::found(system, options, t, found, (start, None))
    }

    fn found(
        system: &'a System,
        options: &'a SolverOptions,
        t: f64,
        found: Option<Found>,
        (start, explain): (&[f64], Option<Explain>),
    ) -> Result<(Self, Outcome)> {
        let model = system.model_within(options.allowed_misfit);
        let Some(found) = found.filter(|found| found.met) else {
            return Err(match explain {
                Some(explain) => (explain.cannot_be_driven)(model, Start::Guess(start), t, options),
                None => unmet(system, start, t, 0, None),
            });
        };
        let steps = found.place.steps;
        let q = found.place.q;
        let measures = match options.follow {
            Follow::Unchecked => found.measures,
            _ => model.measure_steps(&q, t, &found.measures),
        };
        let mut position = Position::new(system, (options, explain), t, (q, measures));
        let solved = position.solve(t).and_then(|outcome| position.rates(t).map(|()| outcome));
        let Some(outcome) = solved else { return Err(position.blamed(true, t)) };
        match position.wrong() {
            None => Ok((position, Outcome { iterations: outcome.iterations + steps, ..outcome })),
            Some(error) => Err(error),
        }
    }
}
