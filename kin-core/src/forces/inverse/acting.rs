//! Builds nodes of everything except constraints: inertial forces, weight, loads, energies and
//! powers.

use kin_graph::{Function, Function2, Graph, Input, Node};

use super::frame::{Frame, along_motion, coordinates};
use super::vectors::Vectors;
use crate::forces::acting::{Laid, Part, Way};
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::loads::{ForceAlong, OnBody};
use crate::numbers::algebra::Vec3;
use crate::program::{Obstacle, Refusal, Row, SELF, Whole};
use crate::system::System;

/// The generalised forces, energies and powers as nodes of the whole program.
pub(super) struct Acts<'w> {
    pub whole: &'w mut Whole,
    /// Q_e + Q_v − M q̈, one node for each coordinate.
    pub by_q: Vec<Node>,
    pub kinetic: Node,
    /// dT/dt, from differentiating T.
    pub rate: Node,
    pub potential: Node,
    /// The power of loads and weight.
    pub loads: Node,
    /// The largest power of any force on any coordinate.
    pub largest: Node,
}

impl<'w> Acts<'w> {
    /// Builds the nodes of all masses and loads of a system. Returns an error with the name of
    /// whatever has no nodes.
    pub(super) fn new(
        whole: &'w mut Whole,
        system: &System,
        loads: &[(&str, Laid<'_>)],
    ) -> Result<Self, Refusal> {
        let zero = whole.graph.zero();
        let by_q = vec![zero; whole.n];
        let [kinetic, rate, potential, powers, largest] = [zero; 5];
        let mut acts = Acts { whole, by_q, kinetic, rate, potential, loads: powers, largest };
        for (item, solid) in &system.loads.solids {
            let Some(item) = system.layout().items.get(*item) else { continue };
            let Some(count) = coordinates(item.kind) else { continue };
            acts.body(solid, system.loads.gravity, item.first, count);
        }
        for (name, point, mass) in &system.loads.points {
            let rows = acts
                .whole
                .rows_of(system, point.as_ref())
                .map_err(|reason| Refusal::one(name, reason))?;
            acts.point(&rows, *mass, system.loads.gravity);
        }
        for (name, load) in loads {
            acts.load(system, load).map_err(|reason| Refusal::one(name, reason))?;
        }
        Ok(acts)
    }

    pub(super) fn graph(&mut self) -> &mut Graph {
        &mut self.whole.graph
    }

    /// Adds a generalised force on one coordinate.
    pub(super) fn act(&mut self, column: usize, force: Node) {
        self.by_q[column] = self.whole.graph.add(self.by_q[column], force);
    }

    /// Returns the power of a force along a velocity, and includes it in the largest power.
    pub(super) fn power(&mut self, force: Node, rate: Node) -> Node {
        let graph = &mut self.whole.graph;
        let power = graph.mul(force, rate);
        if !graph.is_zero(power) {
            let size = graph.call(Function::Abs, power);
            self.largest = graph.call2(Function2::Max, self.largest, size);
        }
        power
    }

    /// Adds a point with mass: Q = −m r_qᵀ (r̈ − g).
    fn point(&mut self, rows: &[Row], mass: f64, gravity: [f64; 3]) {
        for (row, g) in rows.iter().zip(gravity) {
            let rate = self.rate_of(row);
            let second = self.second_of(row);
            let graph = self.graph();
            let [m, half, g, weight] = [mass, 0.5 * mass, g, mass * g].map(|x| graph.constant(x));
            let free = graph.sub(g, second);
            let force = graph.mul(m, free);
            for (column, slope) in &row.slopes {
                let own = self.graph().mul(force, *slope);
                self.act(*column, own);
            }
            self.power(force, rate);
            let graph = self.graph();
            let square = graph.mul(rate, rate);
            let work = graph.mul(rate, second);
            let [kinetic, growth] = [graph.mul(half, square), graph.mul(m, work)];
            let [power, height] = [graph.mul(weight, rate), graph.mul(weight, row.residual)];
            self.kinetic = self.whole.graph.add(self.kinetic, kinetic);
            self.rate = self.whole.graph.add(self.rate, growth);
            self.loads = self.whole.graph.add(self.loads, power);
            self.potential = self.whole.graph.sub(self.potential, height);
        }
    }

    /// Returns C_q q̇ + C_t of a row.
    fn rate_of(&mut self, row: &Row) -> Node {
        self.along(row, row.by_time, |column| Input::Rate(column, SELF))
    }

    /// Returns C_q q̈ − Q_d of a row.
    fn second_of(&mut self, row: &Row) -> Node {
        self.along(row, row.second, Input::Parameter)
    }

    fn along(&mut self, row: &Row, rest: Node, input: impl Fn(usize) -> Input) -> Node {
        row.slopes.iter().fold(rest, |sum, (column, slope)| {
            let rate = self.whole.moving(*column, input(*column));
            let product = self.whole.graph.mul(*slope, rate);
            self.whole.graph.add(sum, product)
        })
    }

    /// Adds a load; its parts are summed for each coordinate.
    fn load(&mut self, system: &System, load: &Laid<'_>) -> Result<(), Obstacle> {
        let zero = self.graph().zero();
        let mut own = vec![zero; self.whole.n];
        for part in &load.parts {
            let forces: Vec<(usize, Node)> = match part {
                Part::Potential(energy) => {
                    let row = self.row(system, energy.constraint)?;
                    self.potential = self.whole.graph.add(self.potential, row.residual);
                    row.slopes.iter().map(|(j, slope)| (*j, self.graph().neg(*slope))).collect()
                }
                Part::Along(Way::Row(x), force) => {
                    let row = self.row(system, x.constraint)?;
                    let rate = self.rate_of(&row);
                    let force = self.along_force(force, [row.residual, rate])?;
                    row.slopes
                        .iter()
                        .map(|(j, slope)| (*j, self.graph().mul(force, *slope)))
                        .collect()
                }
                Part::Along(Way::Coordinate(column, _), force) => {
                    let rate = self.whole.moving(*column, Input::Rate(*column, SELF));
                    let of = [self.whole.coordinate(*column), rate];
                    vec![(*column, self.along_force(force, of)?)]
                }
                Part::Along(Way::Measure(_), _) => return Err(Obstacle::LoadOnMeasure),
                Part::OnBody { on, first } => self.on_body(on, *first)?,
            };
            for (column, force) in forces {
                own[column] = self.graph().add(own[column], force);
            }
        }
        for (column, force) in own.into_iter().enumerate().filter(|(_, force)| *force != zero) {
            let rate = self.whole.moving(column, Input::Rate(column, SELF));
            let power = self.power(force, rate);
            self.loads = self.whole.graph.add(self.loads, power);
            self.act(column, force);
        }
        Ok(())
    }

    /// Returns the one row of an energy, of a length or of an angle.
    fn row(&mut self, system: &System, constraint: &dyn Constraint) -> Result<Row, Obstacle> {
        self.whole.rows_of(system, constraint)?.into_iter().next().ok_or(Obstacle::NoFormula)
    }

    /// Returns f(x, ẋ, t).
    fn along_force(&mut self, force: &ForceAlong, of: [Node; 2]) -> Result<Node, Obstacle> {
        let ForceAlong::Written(force) = force else { return Err(Obstacle::Closure) };
        self.whole.value_of(force.as_ref(), &of)
    }

    /// Returns Q of a force at a point and a torque.
    fn on_body(&mut self, on: &OnBody, first: usize) -> Result<Vec<(usize, Node)>, Obstacle> {
        let orders = along_motion(self.whole, first, on.target.columns());
        let graph = &mut self.whole.graph;
        let frame = Frame::new(graph, orders.each_ref().map(Vec::as_slice));
        let t = graph.input(Input::Time);
        let mut at = |laws: &[Law; 3]| {
            let mut nodes = [t; 3];
            for (node, law) in nodes.iter_mut().zip(laws) {
                *node = self.whole.law_at(law.clone(), t, 0).ok_or(Obstacle::NoFormula)?;
            }
            Ok::<_, Obstacle>(nodes)
        };
        let force = at(&on.force)?;
        let torque = at(&on.torque)?;
        let graph = &mut self.whole.graph;
        let [global, local, torque] = match on.fixed {
            true => [frame.global(graph, force), force, torque],
            false => [force, frame.local(graph, force), frame.local(graph, torque)],
        };
        let u = graph.vector(Vec3::from(on.point));
        let moment = graph.cross(u, local);
        let torque = graph.plus(torque, moment);
        Ok((first..).zip(frame.generalised(graph, global, torque)).collect())
    }
}
