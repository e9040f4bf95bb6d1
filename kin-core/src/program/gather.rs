//! Gathers all equations of a system in one graph.
//!
//! The graph uses the coordinates of the system, folds constant parameters, and shares a node
//! between equal expressions of different constraints.

mod free;
mod timed;

use std::collections::HashMap;
use std::rc::Rc;

use kin_graph::differentiate::Partial;
use kin_graph::{Graph, Input, Node, Op};

use super::kind::{Kind, SELF, TIMED};
use super::refusal::{Obstacle, Refusal};
use crate::coordinates::layout::Place;
use crate::law::Law;
use crate::model::constraint::Constraint;
use crate::model::formula::{Given, Outside, Table, copied, nothing_outside};
use crate::numbers::real::Dual3_64;
use crate::system::System;
pub(crate) use free::{Case, Differences, Free};

use free::LawPlace;
use timed::timed;

/// All rows, with the inputs of their graph.
pub(crate) struct Whole {
    /// The graph of all rows.
    pub graph: Graph,
    /// The rows, by their indices in the system.
    pub rows: Vec<Row>,
    /// The laws of the graph, by their indices.
    pub laws: Vec<Law>,
    /// The number of coordinates.
    pub n: usize,
    /// The nodes that select branches depending on coordinates: see [`Kind::sides`].
    pub sides: Vec<Node>,
    /// The distances of branch selections from their changes: see [`Kind::gaps`].
    pub gaps: Vec<Node>,
    /// The numbers and laws that differ from case to case.
    pub free: Free,
    /// True if rows contain the terms of the jerk.
    jerk: bool,
    /// For each coordinate its value if it is constant, otherwise `None`. An empty list means that
    /// all coordinates move.
    still: Vec<Option<f64>>,
    /// The kinds that were read, by the addresses of their formulas.
    kinds: HashMap<usize, Rc<Kind>>,
}

/// One row of the system, in coordinates of the system.
pub(crate) struct Row {
    /// C.
    pub residual: Node,
    /// ∂C/∂q_j as (j, node).
    pub slopes: Vec<(usize, Node)>,
    /// The coordinates on which the row depends through steps only, without a slope.
    pub steps: Vec<usize>,
    /// C_t.
    pub by_time: Node,
    /// g″(0) along the velocities, which is −Q_d.
    pub second: Node,
    /// g‴(0) along velocities and accelerations; `None` unless the jerk is computed.
    pub third: Option<Node>,
}

/// Gathers the equations of a system, with or without the terms of the jerk. Returns an error with
/// the name of an unreadable constraint. Numbers that differ from case to case become inputs.
pub(crate) fn gather(
    system: &System,
    jerk: bool,
    differences: Differences,
) -> Result<Whole, Refusal> {
    let free = Free::new(differences);
    gathered(system, Whole { jerk, free, ..Whole::new(system.n_coordinates()) })
}

/// Gathers the equations with some coordinates constant at these values.
pub(crate) fn gather_where(system: &System, still: Vec<Option<f64>>) -> Result<Whole, Refusal> {
    gathered(system, Whole { still, ..Whole::new(system.n_coordinates()) })
}

fn gathered(system: &System, mut whole: Whole) -> Result<Whole, Refusal> {
    for (number, block) in system.equations().blocks.iter().enumerate() {
        whole.free.enter(number);
        let rows = whole.rows_of(system, block.constraint.as_ref());
        whole.rows.extend(rows.map_err(|reason| Refusal::one(&block.name, reason))?);
    }
    Ok(whole)
}

/// The inputs of one constraint.
pub(crate) struct Leaves<'a> {
    /// For each local column its coordinate, number or node.
    pub columns: &'a [Column],
    /// The values of the parameters of the formula.
    pub parameters: &'a [f64],
    /// The values and laws that only the user's program can compute.
    pub outside: Outside<'a>,
    /// Values of time alone that only the user's program can compute, as (node, law). Their indices
    /// begin at [`TIMED`].
    pub timed: &'a [(Node, Law)],
    /// Values of free parameters that only the user's program can compute, as (function,
    /// component).
    pub of_parameters: &'a [(usize, usize)],
}

impl Leaves<'_> {
    fn law(&self, number: usize) -> Option<Law> {
        if let Some(k) = number.checked_sub(TIMED) {
            return self.timed.get(k).map(|(_, law)| law.clone());
        }
        Given::by(self.outside, number, &[]).law().cloned()
    }

    fn place(&self, number: usize) -> LawPlace {
        let timed = number.checked_sub(TIMED).and_then(|k| self.timed.get(k));
        timed.map_or(LawPlace::Law(number), |(node, _)| LawPlace::Node(*node))
    }

    /// Returns the index of the law that represents a value of free parameters.
    fn of_parameters(&self, number: usize, component: usize) -> Option<usize> {
        let known = self.of_parameters.iter().position(|known| *known == (number, component))?;
        Some(TIMED + self.timed.len() - self.of_parameters.len() + known)
    }

    fn foreign(&self, number: usize, component: usize, operands: &[f64]) -> f64 {
        let operands: Vec<Dual3_64> = operands.iter().map(|x| Dual3_64::from_re(*x)).collect();
        Given::by(self.outside, number, &operands).number(component).re
    }
}

/// The meaning of a local column.
#[derive(Clone, Copy)]
pub(crate) enum Column {
    Coordinate(usize),
    /// A number: a coordinate of the ground.
    Fixed(f64),
    /// An existing node.
    Node(Node),
}

/// Returns the meaning of the local columns of a constraint.
pub(crate) fn columns(system: &System, constraint: &dyn Constraint) -> Option<Vec<Column>> {
    let mut columns = Vec::new();
    for argument in constraint.arguments() {
        let count = argument.target.columns();
        match system.layout().place(&argument.target)? {
            Place::Own { first, .. } => {
                columns.extend((first..first + count).map(Column::Coordinate))
            }
            // A spatial body that is the ground has the Euler parameters (1, 0, 0, 0); a coordinate
            // of the ground has its value.
            Place::Ground(_) if count == 7 => {
                columns.extend((0..7).map(|k| Column::Fixed(if k == 3 { 1.0 } else { 0.0 })))
            }
            Place::Ground(_) if count == 3 => columns.extend([Column::Fixed(0.0); 3]),
            Place::Ground(value) => columns.push(Column::Fixed(value)),
        }
    }
    Some(columns)
}

impl Whole {
    /// Creates the graph of this number of coordinates, without rows.
    pub(crate) fn new(n: usize) -> Self {
        let kinds = HashMap::new();
        let still = vec![None; n];
        let (rows, laws, sides, gaps, free) = Default::default();
        Whole {
            graph: Graph::default(),
            rows,
            laws,
            n,
            sides,
            gaps,
            free,
            jerk: false,
            still,
            kinds,
        }
    }

    /// Returns the node of a coordinate.
    pub(crate) fn coordinate(&mut self, column: usize) -> Node {
        match self.still.get(column).copied().flatten() {
            Some(value) => self.graph.constant(value),
            None => self.graph.input(Input::State(column, SELF)),
        }
    }

    /// Returns the node of the velocity or acceleration of a coordinate; it is zero for a constant
    /// coordinate.
    pub(crate) fn moving(&mut self, column: usize, input: Input) -> Node {
        match self.still.get(column).copied().flatten() {
            Some(_) => self.graph.zero(),
            None => self.graph.input(input),
        }
    }

    /// Copies nodes of a constraint's graph, operands before their results. The result is indexed
    /// by the old nodes.
    pub(crate) fn copy(
        &mut self,
        from: &Graph,
        nodes: &[Node],
        leaves: &Leaves<'_>,
    ) -> Result<Vec<Node>, Obstacle> {
        let mut places = vec![Node::default(); from.len()];
        for &node in nodes {
            places[node.index()] = self.node(from, node, &places, leaves)?;
        }
        Ok(places)
    }

    /// Returns the rows of a constraint as nodes, for an equation, a load or a mass.
    pub(crate) fn rows_of(
        &mut self,
        system: &System,
        constraint: &dyn Constraint,
    ) -> Result<Vec<Row>, Obstacle> {
        let columns = columns(system, constraint).ok_or(Obstacle::OtherMechanism)?;
        let done = constraint.formula(|table, parameters, outside| {
            let kind = self.kind(table, constraint.facts().rows.len())?;
            let mut nodes = kind.timed.clone();
            let foreign = if self.free.differs() { &kind.foreign[..] } else { &[] };
            nodes.extend(foreign.iter().map(|(_, node)| *node));
            let of_parameters: Vec<(usize, usize)> =
                foreign.iter().map(|(value, _)| *value).collect();
            let timed = &timed(constraint, &nodes)[..];
            let of_parameters = &of_parameters[..];
            let leaves = Leaves { columns: &columns, parameters, outside, timed, of_parameters };
            self.rows_of_kind(&kind, &leaves)
        });
        done.unwrap_or(Err(Obstacle::NoFormula))
    }

    /// Returns C of a constraint of one row at these nodes as coordinates.
    pub(crate) fn value_of(
        &mut self,
        constraint: &dyn Constraint,
        coordinates: &[Node],
    ) -> Result<Node, Obstacle> {
        let columns: Vec<Column> = coordinates.iter().map(|node| Column::Node(*node)).collect();
        let done = constraint.formula(|table, parameters, outside| {
            let kind = self.kind(table, 1)?;
            let row = kind.rows.first().ok_or(Obstacle::NoFormula)?.residual;
            let timed = timed(constraint, &kind.timed);
            let leaves = Leaves {
                columns: &columns,
                parameters,
                outside,
                timed: &timed,
                of_parameters: &[],
            };
            let places = self.copy(&kind.graph, &kind.graph.reachable(&[row]), &leaves)?;
            Ok(places[row.index()])
        });
        done.unwrap_or(Err(Obstacle::NoFormula))
    }

    /// Returns the kind of constraints with this formula, which is read once.
    fn kind(&mut self, table: &Table, rows: usize) -> Result<Rc<Kind>, Obstacle> {
        let key = std::ptr::from_ref(table) as usize;
        let kind = match self.kinds.get(&key) {
            Some(known) => known.clone(),
            None => Rc::new(Kind::of(table.formula(), rows, self.jerk)?),
        };
        self.kinds.insert(key, kind.clone());
        Ok(kind)
    }

    fn rows_of_kind(&mut self, kind: &Kind, leaves: &Leaves<'_>) -> Result<Vec<Row>, Obstacle> {
        let places = self.copy(&kind.graph, &kind.nodes, leaves)?;
        let mut rows = Vec::new();
        for row in &kind.rows {
            let of = |node: Node| places[node.index()];
            let mut slopes: Vec<(usize, Node)> = Vec::new();
            for (column, slope) in &row.slopes {
                let Some(Column::Coordinate(j)) = leaves.columns.get(*column) else { continue };
                // An equation can contain a body twice; then its columns are summed.
                match slopes.iter_mut().find(|(known, _)| known == j) {
                    Some((_, sum)) => *sum = self.graph.add(*sum, of(*slope)),
                    None => slopes.push((*j, of(*slope))),
                }
            }
            slopes.retain(|(_, slope)| !self.graph.is_zero(*slope));
            slopes.sort_by_key(|(column, _)| *column);
            let coordinate = |column: &usize| match leaves.columns.get(*column) {
                Some(Column::Coordinate(j)) => Some(*j),
                _ => None,
            };
            let steps = row.columns.iter().filter_map(coordinate);
            let steps = steps.filter(|j| slopes.iter().all(|(known, _)| known != j)).collect();
            let by_time = of(row.by_time);
            let second = of(row.second);
            let residual = of(row.residual);
            let third = row.third.map(of);
            rows.push(Row { residual, slopes, steps, by_time, second, third });
        }
        let sides = kind.sides.iter().map(|side| places[side.index()]);
        self.sides.extend(sides.filter(|side| self.graph.known_value(*side).is_none()));
        self.gaps.extend(kind.gaps.iter().map(|gap| places[gap.index()]));
        Ok(rows)
    }

    /// Copies one operation of a constraint's graph.
    fn node(
        &mut self,
        from: &Graph,
        node: Node,
        places: &[Node],
        leaves: &Leaves<'_>,
    ) -> Result<Node, Obstacle> {
        let of = |node: Node| places[node.index()];
        Ok(match from.op(node) {
            Op::Input(Input::State(k, _)) => match leaves.columns.get(k) {
                Some(Column::Coordinate(j)) => self.coordinate(*j),
                Some(Column::Fixed(value)) => self.graph.constant(*value),
                Some(Column::Node(node)) => *node,
                None => return Err(Obstacle::NoFormula),
            },
            Op::Input(Input::Rate(k, part)) => match leaves.columns.get(k) {
                Some(Column::Coordinate(j)) => self.moving(*j, Input::Rate(*j, part)),
                Some(Column::Fixed(_)) => self.graph.zero(),
                Some(Column::Node(_)) | None => return Err(Obstacle::NoFormula),
            },
            Op::Input(Input::Parameter(k)) => {
                let value = *leaves.parameters.get(k).ok_or(Obstacle::NoFormula)?;
                match self.free.parameter(k) {
                    Some(input) => self.graph.input(input),
                    None => self.graph.constant(value),
                }
            }
            Op::Input(Input::Time) => self.graph.input(Input::Time),
            Op::Input(Input::TimeRate) => self.graph.constant(1.0),
            Op::Law(number, x, order) => {
                let law = leaves.law(number).ok_or(Obstacle::NoFormula)?;
                match self.free.law(leaves.place(number), &law, &mut self.laws) {
                    Some(number) => self.graph.law(number, of(x), order),
                    None => self.law_at(law, of(x), order).ok_or(Obstacle::NoFormula)?,
                }
            }
            Op::Opaque(number, component) => {
                let operands: Option<Vec<f64>> = from.opaques[number]
                    .iter()
                    .map(|operand| self.graph.known_value(of(*operand)))
                    .collect();
                match (operands, leaves.of_parameters(number, component)) {
                    (Some(operands), _) => {
                        let value = leaves.foreign(number, component, &operands);
                        self.graph.constant(value)
                    }
                    (None, Some(number)) => {
                        let law = leaves.law(number).ok_or(Obstacle::ForeignFunction)?;
                        let own = self.free.law(leaves.place(number), &law, &mut self.laws);
                        // The law is constant in time.
                        let never = self.graph.zero();
                        own.map(|own| self.graph.law(own, never, 0))
                            .ok_or(Obstacle::ForeignFunction)?
                    }
                    (None, None) => return Err(Obstacle::ForeignFunction),
                }
            }
            op => self.graph.rebuilt(op, of).ok_or(Obstacle::NoFormula)?,
        })
    }

    /// Returns a derivative of a law at a node, from its formula if it has one.
    pub(crate) fn law_at(&mut self, law: Law, x: Node, order: u8) -> Option<Node> {
        match written(&law, order) {
            Some((own, f)) => {
                copied(&own, f, &mut self.graph, &nothing_outside, &mut |_, _| Some(x))
            }
            None => {
                let number = self.law(law);
                Some(self.graph.law(number, x, order))
            }
        }
    }

    /// Returns the index of a law. Equal laws share an index.
    fn law(&mut self, law: Law) -> usize {
        self.laws.iter().position(|known| known.is(&law)).unwrap_or_else(|| {
            self.laws.push(law);
            self.laws.len() - 1
        })
    }
}

/// Returns a derivative of a law as a graph of its variable, if the law has a formula.
fn written(law: &Law, order: u8) -> Option<(Graph, Node)> {
    let mut graph = Graph::default();
    let x = graph.input(Input::Column(0));
    let mut f = law.written(&mut graph, x)?;
    for _ in 0..order {
        f = Partial::by_variable().of(&mut graph, f);
    }
    Some((graph, f))
}
