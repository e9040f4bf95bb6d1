//! Computes the force and torque of constraints and loads on a body over time.

use super::acted::BodyWrench;
use super::acting::Now;
use super::calls::Forces;
use super::wrench::{Stand, Wrench};
use crate::coordinates::Target;
use crate::coordinates::layout::{Kind, Place};
use crate::model::body::Body;
use crate::model::constraint::Attached;
use crate::model::loads::HasTorque;
use crate::numbers::algebra::Vec3;
use crate::outcome::error::{Error, Result};
use crate::outcome::motion::Series;

/// The source of forces on bodies.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    Constraint(usize),
    Load(usize),
    /// Friction in a joint, by its index among the joints with friction.
    Friction(usize),
}

/// The forces and torques of a constraint, of a sum of several constraints, or of a load on its
/// bodies.
pub struct Reaction<'f> {
    forces: &'f Forces<'f>,
    name: String,
    sources: Vec<Source>,
}

impl<'f> Reaction<'f> {
    pub(super) fn new(forces: &'f Forces<'f>, name: &str, sources: Vec<Source>) -> Self {
        Reaction { forces, name: name.to_string(), sources }
    }

    /// Returns the force and torque on one body.
    ///
    /// For the ground pass `PlanarBody::from(ground)` or `SpatialBody::from(ground)`. The force on
    /// the ground is the opposite of the sum of the forces on the bodies.
    ///
    /// Errors: the body belongs to another mechanism; the constraint or load does not act on the
    /// body.
    pub fn on<B: Body>(&self, body: B) -> Result<BodyWrench<'f, B::Vector>>
    where
        B::Vector: HasTorque,
    {
        let forces = self.forces;
        let target = body.target();
        let layout = forces.system.layout();
        let motion = forces.motion;
        let place = layout.place(&target).ok_or_else(|| Error::ForeignBody {
            mechanism: forces.system.name().to_string(),
            place: self.name.clone(),
            argument: "body".to_string(),
        })?;
        let item = match place {
            Place::Own { item, .. } => Some(item),
            Place::Ground(_) => None,
        };
        let on =
            item.map_or("the ground".to_string(), |item| format!("`{}`", layout.items[item].name));
        let touched = self.touched();
        if let Some(item) = item
            && !touched.contains(&item)
        {
            let bodies: Vec<&str> =
                touched.iter().map(|item| layout.items[*item].name.as_str()).collect();
            let where_to = match bodies.is_empty() {
                true => "The constraint acts on no body".to_string(),
                false => {
                    format!("Choose a body on which the constraint acts: {}", bodies.join(", "))
                }
            };
            let reason = format!("the constraint does not act on {on}. {where_to}");
            return Err(Error::InvalidParameters {
                constraint: self.name.clone(),
                kind: "reaction".to_string(),
                reason,
            });
        }
        let mut wrenches = vec![];
        let mut open = vec![];
        let mut stands = vec![];
        let mut points = vec![];
        let point = self.point(&target);
        for k in 0..motion.len() {
            let all = self.generalised(k);
            let mut all = all.iter().map(|by_q| wrench(forces, item, &touched, k, by_q));
            let stand = stand(forces, item, k);
            let own = all.next().unwrap_or_default();
            let at = match &point {
                Some((holder, u)) => self::stand(forces, *holder, k).point(*u),
                None => stand.r,
            };
            wrenches.push(own.moved(stand.r, at));
            open.push(all.map(|open| open.moved(stand.r, at)).collect());
            stands.push(stand);
            points.push(at);
        }
        let name = self.name.clone();
        let kind = Default::default();
        Ok(BodyWrench { forces, name, on, wrenches, open, stands, points, fixed: false, kind })
    }

    /// Returns the power Q · q̇ that the constraints or the load put into the mechanism. \[W\]
    pub fn power(&self) -> Series {
        let motion = self.forces.motion;
        let at = |k: usize| -> f64 {
            let all = self.generalised(k);
            all.first()
                .map_or(0.0, |by_q| by_q.iter().zip(motion.qd(k)).map(|(q, qd)| q * qd).sum())
        };
        let values = (0..motion.len()).map(at).collect();
        let unit = motion.unit_words().power();
        Series::new(format!("{}.power", self.name), unit, motion.clock(), values)
    }

    /// Returns the force and torque on the first of its bodies about its point at time k, and those
    /// of the vectors of the null space. The list is empty if it acts on no body.
    pub(super) fn at_its_point(&self, k: usize) -> Vec<Wrench> {
        let forces = self.forces;
        let touched = self.touched();
        let Some(item) = touched.first().copied() else { return Vec::new() };
        let layout = forces.system.layout();
        let target = layout.target(item);
        let stand = stand(forces, Some(item), k);
        let at = match self.point(&target) {
            Some((holder, u)) => self::stand(forces, holder, k).point(u),
            None => stand.r,
        };
        let all = self.generalised(k);
        all.iter()
            .map(|by_q| wrench(forces, Some(item), &touched, k, by_q).moved(stand.r, at))
            .collect()
    }

    /// Returns the items of the bodies on which the source acts.
    pub(super) fn touched(&self) -> Vec<usize> {
        let layout = self.forces.system.layout();
        let mut found = Vec::new();
        let mut touch = |target: &Target| {
            let item = match layout.place(target) {
                Some(Place::Own { first, .. }) => {
                    layout.items.iter().rposition(|item| item.first <= first)
                }
                _ => None,
            };
            let is_body =
                |item: &usize| matches!(layout.items[*item].kind, Kind::Planar | Kind::Spatial);
            found.extend(item.filter(is_body).filter(|item| !found.contains(item)));
        };
        for source in &self.sources {
            match source {
                Source::Constraint(block) => {
                    let block = &self.forces.system.equations().blocks[*block];
                    block
                        .constraint
                        .arguments()
                        .iter()
                        .for_each(|argument| touch(&argument.target));
                }
                Source::Load(load) => {
                    self.forces.loads[*load].1.targets().iter().for_each(&mut touch)
                }
                Source::Friction(number) => {
                    self.forces.frictions.all[*number].bodies().iter().for_each(&mut touch)
                }
            }
        }
        found
    }

    /// Returns the point of one constraint on a body: the item of its owner, and its local
    /// position.
    fn point(&self, target: &Target) -> Option<(Option<usize>, Vec3)> {
        let [source] = self.sources.as_slice() else { return None };
        let layout = self.forces.system.layout();
        let item = |target: &Target| match layout.place(target) {
            Some(Place::Own { item, .. }) => Some(item),
            _ => None,
        };
        let (arguments, points) = match source {
            Source::Constraint(block) => {
                let constraint = &self.forces.system.equations().blocks[*block].constraint;
                let points =
                    constraint.attachments().into_iter().filter_map(|found| match found.what {
                        Attached::Point(u) => Some((found.argument, u)),
                        Attached::Direction(_) => None,
                    });
                (constraint.arguments(), points.collect::<Vec<_>>())
            }
            Source::Load(load) => self.forces.loads[*load].1.points(),
            Source::Friction(number) => {
                let (body, u) = self.forces.frictions.all[*number].point();
                return Some((item(&body), u));
            }
        };
        let owner = |(argument, u): &(usize, Vec3)| Some((arguments.get(*argument)?.target, *u));
        let all: Vec<(Target, Vec3)> = points.iter().filter_map(owner).collect();
        let own = all.iter().find(|(known, _)| item(known) == item(target));
        own.or(all.first()).map(|(known, u)| (item(known), *u))
    }

    /// Returns the generalised forces at time k on all coordinates, and those of each vector of the
    /// null space.
    fn generalised(&self, k: usize) -> Vec<Vec<f64>> {
        let forces = self.forces;
        let motion = self.forces.motion;
        let equations = forces.system.equations();
        let n = forces.system.n_coordinates();
        let lambda = forces.multipliers.at(k);
        let beside = forces.multipliers.beside(k);
        let mut all = vec![vec![0.0; n]; 1 + beside.open.len()];
        for source in &self.sources {
            match source {
                Source::Constraint(number) => {
                    let block = &equations.blocks[*number];
                    let values = forces.jacobian(*number, k);
                    let entries = &equations.entries[block.values()];
                    let vectors =
                        std::iter::once(lambda).chain(beside.open.iter().map(Vec::as_slice));
                    for (by_q, y) in all.iter_mut().zip(vectors) {
                        for (entry, value) in entries.iter().zip(&values) {
                            if let Some((row, column)) = entry {
                                by_q[*column] -= value * y[*row];
                            }
                        }
                    }
                }
                Source::Load(load) => {
                    let q = motion.q(k);
                    let qd = motion.qd(k);
                    let qdd = motion.qdd(k);
                    let now = Now { t: motion.times()[k], q, qd, qdd };
                    forces.loads[*load].1.add(now, &mut all[0]);
                }
                Source::Friction(number) => beside.rubs[*number].scatter(&mut all[0]),
            }
        }
        all
    }
}

/// Returns the position of a body, or of the ground.
fn stand(forces: &Forces<'_>, item: Option<usize>, k: usize) -> Stand {
    Stand::of(item.map_or(&[], |item| columns(forces, item, forces.motion.q(k))))
}

/// Returns the coordinates of a body from those of the mechanism.
fn columns<'q>(forces: &Forces<'_>, item: usize, all: &'q [f64]) -> &'q [f64] {
    let item = &forces.system.layout().items[item];
    all.get(item.first..item.first + item.kind.coordinates().len()).unwrap_or_default()
}

/// Returns the force and torque on a body about its origin. For the ground it returns the opposite
/// of all others, about the global origin.
fn wrench(
    forces: &Forces<'_>,
    item: Option<usize>,
    touched: &[usize],
    k: usize,
    by_q: &[f64],
) -> Wrench {
    let own = |item: usize| {
        let q = columns(forces, item, forces.motion.q(k));
        Wrench::of(q, columns(forces, item, by_q))
    };
    match item {
        Some(item) => own(item),
        None => {
            let at_origin =
                |item: &usize| own(*item).moved(stand(forces, Some(*item), k).r, Vec3::zeros());
            touched.iter().map(at_origin).fold(Wrench::default(), Wrench::plus).times(-1.0)
        }
    }
}
