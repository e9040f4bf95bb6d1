//! The common part of the workloads W1 to W5: a sweep over a grid of times, by several routes, with
//! its error.

use std::hint::black_box;
use std::time::Duration;

use kin::extend::by_dual;
use kin::extend::dual_route::Equation;
use kin::prelude::*;
use kin::solver::Stop;
use kin::{Engine, Follow, SolverOptions};

use crate::design;
use crate::measure::{Contestant, Figure, cpu, median, race};

/// q, q̇ and q̈ of every step, one after the other.
pub struct Table {
    pub n: usize,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    /// Newton steps of the whole sweep.
    pub iterations: usize,
}

impl Table {
    pub fn new(n: usize, steps: usize) -> Self {
        let room = || Vec::with_capacity(n * steps);
        Table { n, q: room(), qd: room(), qdd: room(), iterations: 0 }
    }

    #[inline]
    pub fn push(&mut self, q: &[f64], qd: &[f64], qdd: &[f64]) {
        self.q.extend_from_slice(q);
        self.qd.extend_from_slice(qd);
        self.qdd.extend_from_slice(qdd);
    }

    /// Number of steps, and (q, q̇, q̈) of each.
    pub fn len(&self) -> usize {
        self.q.len() / self.n
    }

    pub fn at(&self, k: usize) -> (&[f64], &[f64], &[f64]) {
        let range = k * self.n..(k + 1) * self.n;
        (&self.q[range.clone()], &self.qd[range.clone()], &self.qdd[range])
    }

    fn of(motion: &Motion) -> Self {
        let mut table = Table::new(motion.names().len(), motion.len());
        (0..motion.len()).for_each(|k| table.push(motion.q(k), motion.qd(k), motion.qdd(k)));
        table.iterations = motion.iterations().iter().sum();
        table
    }
}

/// How a sweep is solved.
pub enum Solver {
    Hand(Box<dyn Fn() -> Table>),
    Kin(Box<System>, SolverOptions),
    /// Each position alone by `solve_at`, from the last one.
    Singly(Box<System>, SolverOptions),
}

pub struct Route {
    pub peer: &'static str,
    solver: Solver,
}

/// One workload of the kind: its routes, its error and what that may be.
pub struct Workload {
    pub name: String,
    pub dt: f64,
    pub steps: usize,
    /// For W4: links, among which the time of a step is divided too.
    pub links: Option<usize>,
    pub routes: Vec<Route>,
    pub error: Box<dyn Fn(&Table) -> f64>,
    pub allowed: f64,
    /// A system from nothing, for the time that takes.
    pub build: Box<dyn Fn() -> System>,
}

/// The workloads' protocol: from the last solution, until the residual is below 1e-10.
pub fn as_defined() -> SolverOptions {
    SolverOptions::new()
        .stop(Stop::ResidualOnly(1e-10))
        .predict(false)
        .rescue(false)
        .follow(Follow::Unchecked)
}

/// By hand, and Kin's routes: as defined, with prediction as well, as defined with each step
/// checked to stay on its branch, as it comes (`SolverOptions::default()`, compiled before), the
/// same by plain steps, those unchecked, with the jerk by a program and by plain steps, single
/// positions one after the other by the program and by plain steps, and on dual numbers as defined.
pub fn routes(hand: impl Fn() -> Table + 'static, model: impl Fn(bool) -> System) -> Vec<Route> {
    let kin =
        |peer, dual, options| Route { peer, solver: Solver::Kin(Box::new(model(dual)), options) };
    vec![
        by_hand(hand),
        kin("kin", false, as_defined()),
        kin("kin-predictor", false, as_defined().predict(true)),
        kin("kin-checked", false, as_defined().follow(Follow::Smooth)),
        compiled(kin("kin-default", false, SolverOptions::default())),
        kin("kin-plain", false, SolverOptions::new().engine(Engine::StepByStep)),
        kin(
            "kin-unchecked",
            false,
            SolverOptions::new().follow(Follow::Unchecked).engine(Engine::StepByStep),
        ),
        kin("kin-jerk", false, SolverOptions::new().jerk(true).engine(Engine::Compiled)),
        kin("kin-jerk-plain", false, SolverOptions::new().jerk(true).engine(Engine::StepByStep)),
        singly("kin-singly", model(false), SolverOptions::default()),
        singly("kin-singly-plain", model(false), SolverOptions::new().engine(Engine::StepByStep)),
        kin("kin-dual", true, as_defined()),
    ]
}

/// Single positions, from a system that is compiled as far as they can make use of that.
fn singly(peer: &'static str, system: System, options: SolverOptions) -> Route {
    system.compile().unwrap_or_else(|error| panic!("{error}"));
    Route { peer, solver: Solver::Singly(Box::new(system), options) }
}

/// Each position alone, from the last one, the first from where the system starts.
fn positions(system: &System, options: &SolverOptions, times: &[f64]) -> Table {
    let mut q = system.initial().to_vec();
    let mut table = Table::new(system.n_coordinates(), times.len());
    for t in times {
        let found = system
            .solver()
            .options(options.clone())
            .solve_at(*t, &q)
            .unwrap_or_else(|error| panic!("{error}"));
        table.push(&found.q, &found.qd, &found.qdd);
        table.iterations += found.report.iterations;
        q = found.q;
    }
    table
}

/// The program is there before the run begins; the time that takes is a figure of its own.
fn compiled(route: Route) -> Route {
    if let Solver::Kin(system, _) = &route.solver {
        system.compile().unwrap_or_else(|error| panic!("{error}"));
    }
    route
}

pub fn by_hand(hand: impl Fn() -> Table + 'static) -> Route {
    Route { peer: "hand", solver: Solver::Hand(Box::new(hand)) }
}

/// Adds a constraint on the symbolic or on the dual route.
pub fn add<E: Equation<N, M> + 'static, const N: usize, const M: usize>(
    m: &mut Mechanism,
    dual: bool,
    name: &str,
    equation: E,
) {
    let added = if dual { m.add(name, by_dual(equation)) } else { m.add(name, equation) };
    added.unwrap_or_else(|error| panic!("{error}"));
}

/// Gives planar bodies mass and weight, which a run does not read: forces do.
pub fn weigh(m: &mut Mechanism, bodies: [PlanarBody; 3]) {
    for (k, body) in bodies.into_iter().enumerate() {
        let given = m.mass(body, 1.0 + 0.5 * k as f64, vec2(0.1, 0.02), 0.2);
        given.unwrap_or_else(|error| panic!("{error}"));
    }
    m.gravity(vec2(0.0, -9.81));
}

/// A system that starts from the exact state.
pub fn build(mut mechanism: Mechanism, initial: &[f64]) -> System {
    mechanism
        .set_initial(initial)
        .and_then(|()| mechanism.build())
        .unwrap_or_else(|error| panic!("{error}"))
}

impl Workload {
    /// Errors first, then times; the figures are printed by the caller.
    pub fn run(&self, budget: Duration) -> Vec<Figure> {
        let times = self.times();
        let mut figures: Vec<Figure> =
            self.routes.iter().flat_map(|route| self.verify(route, &times)).collect();
        let contestant = |route| Contestant {
            peer: Route::peer(route),
            run: Box::new(|| self.solve(route, &times)),
        };
        let mut contestants: Vec<Contestant<'_>> = self.routes.iter().map(contestant).collect();
        for result in race(&mut contestants, budget) {
            let step = result.nanoseconds / self.steps as f64;
            let per_link = self.links.map(|links| step / links as f64);
            let text = per_link.map_or(String::new(), |x| format!(", {x:.1} ns a link"));
            eprintln!(
                "{:>10} {:<14} {step:>12.1} ns a step{text}, {:.2} of hand-written",
                self.name, result.peer, result.ratio
            );
            figures.push(self.figure(result.peer, "ns_per_step", step));
            figures.extend(per_link.map(|x| self.figure(result.peer, "ns_per_step_per_link", x)));
            figures.extend(
                (result.peer != "hand")
                    .then(|| self.figure(result.peer, "ratio_to_hand", result.ratio)),
            );
        }
        figures.extend(self.set_up());
        figures.extend(self.compile());
        figures
    }

    /// One route some times over and nothing else, for counting instructions.
    pub fn once(&self, peer: &str, repeats: usize) -> Option<()> {
        let times = self.times();
        let Some(route) = self.routes.iter().find(|route| route.peer == peer) else {
            return design::once(&(self.build)(), peer, &times, repeats);
        };
        (0..repeats).for_each(|_| self.solve(route, &times));
        Some(())
    }

    fn times(&self) -> Vec<f64> {
        (0..self.steps).map(|k| k as f64 * self.dt).collect()
    }

    fn solve(&self, route: &Route, times: &[f64]) {
        match &route.solver {
            Solver::Hand(sweep) => drop(black_box(sweep())),
            Solver::Kin(system, options) => drop(
                black_box(system.solver().options(options.clone()).run(times))
                    .unwrap_or_else(|error| panic!("{error}")),
            ),
            Solver::Singly(system, options) => drop(black_box(positions(system, options, times))),
        }
    }

    fn verify(&self, route: &Route, times: &[f64]) -> [Figure; 2] {
        let table = match &route.solver {
            Solver::Hand(sweep) => sweep(),
            Solver::Kin(system, options) => Table::of(
                &system
                    .solver()
                    .options(options.clone())
                    .run(times)
                    .unwrap_or_else(|error| panic!("{error}")),
            ),
            Solver::Singly(system, options) => positions(system, options, times),
        };
        assert_eq!(table.len(), self.steps, "{} by {}: steps", self.name, route.peer);
        let error = (self.error)(&table);
        let iterations = table.iterations as f64 / self.steps as f64;
        assert!(
            error <= self.allowed,
            "{} by {}: error {error:e}, allowed {:e}",
            self.name,
            route.peer,
            self.allowed
        );
        [
            self.figure(route.peer, "max_error", error),
            self.figure(route.peer, "iterations_per_step", iterations),
        ]
    }

    /// Declaring and building, apart from the sweep.
    fn set_up(&self) -> Option<Figure> {
        self.routes.iter().any(|route| route.peer == "kin").then(|| {
            let sample = || {
                let start = cpu();
                drop(black_box((self.build)()));
                (cpu() - start).as_secs_f64() * 1e6
            };
            let microseconds = median((0..11).map(|_| sample()).collect());
            eprintln!(
                "{:>10} {:<14} {microseconds:>12.1} µs to declare and build",
                self.name, "kin"
            );
            self.figure("kin", "setup_us", microseconds)
        })
    }

    /// The program and its tape, with the first position at which its elimination is chosen.
    fn compile(&self) -> Option<Figure> {
        self.routes.iter().find(|route| route.peer == "kin-default")?;
        let sample = || {
            let system = (self.build)();
            let start = cpu();
            black_box(system.compile()).ok()?;
            Some((cpu() - start).as_secs_f64() * 1e6)
        };
        let microseconds = median((0..11).map_while(|_| sample()).collect());
        eprintln!("{:>10} {:<14} {microseconds:>12.1} µs to compile", self.name, "kin-default");
        Some(self.figure("kin-default", "compile_us", microseconds))
    }

    fn figure(&self, peer: &str, metric: &str, value: f64) -> Figure {
        Figure::new(&self.name, peer, metric, value)
    }
}

impl Route {
    fn peer(&self) -> &'static str {
        self.peer
    }
}
