//! Derives the dimensions that a designer uses (lengths of bodies, points, numbers) from the
//! parameters of constraints.

use crate::coordinates::layout::Place;
use crate::model::constraint::{Attached, Constraint};
use crate::system::evaluate::Equations;
use crate::system::scaled::Model;

/// A parameter of a constraint, as (constraint, index of the parameter).
pub(crate) type Slot = (usize, usize);

/// A point of a constraint, given by its components in a body.
#[derive(Clone, Debug)]
pub(crate) struct PointAt {
    /// The index of the constraint; `first` is the index of the first parameter with a component.
    pub block: usize,
    pub first: usize,
    /// The name of the dimension in the constraint, such as `u_i`.
    pub name: String,
    /// The index of the argument that is its body; `item` is the body's item, `None` for the
    /// ground.
    pub argument: usize,
    pub item: Option<usize>,
    pub value: Vec<f64>,
}

/// A dimension: something in a mechanism that has a size.
#[derive(Clone, Debug)]
pub(crate) struct Dimension {
    pub of: Of,
    /// The present value.
    pub value: Vec<f64>,
    /// The parameters that depend on it: the parameter, the component on which it depends, the
    /// factor.
    pub slots: Vec<(Slot, usize, f64)>,
}

/// The owner of a dimension.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Of {
    /// The length of a body between its two ends, by the item of the body.
    Length(usize),
    /// A number of a constraint, by name.
    Number(usize, String),
    /// A point of a constraint.
    Point(usize, String, Option<usize>),
}

/// Returns every point of every constraint.
pub(crate) fn points(model: &Model<'_>) -> Vec<PointAt> {
    let blocks = model
        .equations
        .blocks
        .iter()
        .enumerate()
        .filter(|(_, block)| block.constraint.facts().kind != "euler_norm");
    blocks.flat_map(|(k, block)| points_of(model, k, block.constraint.as_ref())).collect()
}

/// Returns the vectors among the parameters that are points of bodies. Kin takes them from the
/// attachments of the constraint, or else from their names (`u_i` of `i`).
fn points_of(model: &Model<'_>, block: usize, constraint: &dyn Constraint) -> Vec<PointAt> {
    let arguments = constraint.arguments();
    let mut attached: Vec<(usize, [f64; 3])> = Vec::new();
    for attachment in constraint.attachments() {
        if let Attached::Point(u) = attachment.what {
            attached.push((attachment.argument, [u.x, u.y, u.z]));
        }
    }
    let mut found = Vec::new();
    for (first, name, value) in vectors(constraint) {
        let is = |(_, point): &(usize, [f64; 3])| value.iter().zip(point).all(|(a, b)| a == b);
        let by_name = |argument: usize| {
            name.rsplit_once('_').is_some_and(|(_, end)| end == arguments[argument].name)
        };
        let taken = attached
            .iter()
            .position(|known| is(known) && by_name(known.0))
            .or_else(|| attached.iter().position(is));
        let Some((argument, _)) = taken.map(|k| attached.remove(k)) else { continue };
        let item =
            match arguments.get(argument).and_then(|argument| model.layout.place(&argument.target))
            {
                Some(Place::Own { item, .. }) => Some(item),
                Some(Place::Ground(_)) => None,
                None => continue,
            };
        found.push(PointAt { block, first, name, argument, item, value });
    }
    found
}

/// Returns the parameters that are components of vectors, as (index of the first, name, values).
fn vectors(constraint: &dyn Constraint) -> Vec<(usize, String, Vec<f64>)> {
    let mut all: Vec<(usize, String, Vec<f64>)> = Vec::new();
    let mut number = 0;
    constraint.parameters(&mut |name, value| {
        match name.rsplit_once('.') {
            Some((vector, "x")) => all.push((number, vector.to_string(), vec![value])),
            Some((vector, "y" | "z")) => {
                if let Some((_, _, values)) = all.last_mut().filter(|(first, known, values)| {
                    known == vector && first + values.len() == number
                }) {
                    values.push(value);
                }
            }
            _ => {}
        }
        number += 1;
    });
    all.retain(|(_, _, values)| values.len() > 1);
    all
}

/// Returns every dimension that the user could change: lengths of bodies first, then numbers, then
/// points.
pub(crate) fn all(model: &Model<'_>) -> Vec<Dimension> {
    let points = points(model);
    let mut dimensions = Vec::new();
    let mut used = vec![false; points.len()];
    for item in 0..model.layout.items.len() {
        if let Some(length) = length(item, &points, &mut used) {
            dimensions.push(length);
        }
    }
    for (block, own) in model
        .equations
        .blocks
        .iter()
        .enumerate()
        .filter(|(_, own)| own.constraint.facts().kind != "euler_norm")
    {
        let mut number = 0;
        own.constraint.parameters(&mut |name, value| {
            if !name.contains(['.', '[']) {
                let of = Of::Number(block, name.to_string());
                dimensions.push(Dimension {
                    of,
                    value: vec![value],
                    slots: vec![((block, number), 0, 1.0)],
                });
            }
            number += 1;
        });
    }
    dimensions
        .extend(points.into_iter().zip(used).filter(|(_, used)| !used).map(|(point, _)| at(point)));
    dimensions
}

/// Returns the distance of a point from the origin of its body as a dimension. For a point at the
/// origin it returns the position.
fn at(point: PointAt) -> Dimension {
    let size = point.value.iter().map(|x| x * x).sum::<f64>().sqrt();
    let of = Of::Point(point.block, point.name, point.item);
    let slot = |k: usize| (point.block, point.first + k);
    if size > 0.0 {
        let slots = point.value.iter().enumerate().map(|(k, x)| (slot(k), 0, x / size)).collect();
        return Dimension { of, value: vec![size], slots };
    }
    Dimension {
        of,
        slots: (0..point.value.len()).map(|k| (slot(k), k, 1.0)).collect(),
        value: point.value,
    }
}

/// Returns the length of a body with points at (±a, 0, 0), as a link has. Marks the points at its
/// ends as used.
fn length(item: usize, points: &[PointAt], used: &mut [bool]) -> Option<Dimension> {
    let end = |point: &PointAt| {
        point.item == Some(item)
            && point.value[0] != 0.0
            && point.value[1..].iter().all(|x| *x == 0.0)
    };
    let ends: Vec<(usize, f64)> = points
        .iter()
        .enumerate()
        .filter(|(_, point)| end(point))
        .map(|(k, point)| (k, point.value[0]))
        .collect();
    let half = ends.iter().find(|(_, x)| *x > 0.0 && ends.iter().any(|(_, other)| *other == -x))?.1;
    let own = ends.into_iter().filter(|(_, x)| x.abs() == half);
    let slots = own.map(|(k, x)| {
        used[k] = true;
        ((points[k].block, points[k].first), 0, 0.5_f64.copysign(x))
    });
    Some(Dimension { of: Of::Length(item), slots: slots.collect(), value: vec![2.0 * half] })
}

impl Dimension {
    /// Writes another value to the equations. Returns false if a constraint refuses it.
    pub(crate) fn put(&self, equations: &mut Equations, value: &[f64]) -> bool {
        let offsets =
            self.slots.iter().map(|&(slot, k, factor)| (slot, factor * (value[k] - self.value[k])));
        let given: Vec<(Slot, f64)> = offsets.collect();
        given.into_iter().all(|(slot, offset)| {
            self.base(slot).is_some_and(|base| set(equations, slot, base + offset))
        }) && self.blocks().all(|block| equations.blocks[block].constraint.refusal().is_none())
    }

    /// Returns the present value of a parameter that depends on this dimension.
    fn base(&self, slot: Slot) -> Option<f64> {
        let (_, k, factor) = self.slots.iter().find(|(known, _, _)| *known == slot)?;
        Some(factor * self.value[*k])
    }

    /// Returns the point as a free position, if changing its distance is not enough.
    pub(crate) fn anywhere(&self) -> Option<Dimension> {
        let (Of::Point(..), [_]) = (&self.of, &self.value[..]) else { return None };
        let slots =
            self.slots.iter().enumerate().map(|(k, (slot, _, _))| (*slot, k, 1.0)).collect();
        Some(Dimension { of: self.of.clone(), slots, value: self.components(&self.value) })
    }

    /// Returns a value in the form of a report: for a point its components.
    pub(crate) fn components(&self, value: &[f64]) -> Vec<f64> {
        match self.of {
            Of::Point(..) => self.slots.iter().map(|(_, k, factor)| factor * value[*k]).collect(),
            _ => value.to_vec(),
        }
    }

    /// Returns true for a length, which can be compared with other lengths.
    pub(crate) fn is_length(&self) -> bool {
        const OTHERS: [&str; 6] = ["angle", "theta", "phase", "ratio", "pitch", "phi"];
        !matches!(&self.of, Of::Number(_, name) if OTHERS.iter().any(|other| name.contains(other)))
    }

    /// Returns the size.
    pub(crate) fn size(&self) -> f64 {
        self.value.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    /// Returns the constraints that it changes.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = usize> + '_ {
        self.slots.iter().map(|((block, _), _, _)| *block)
    }
}

/// Sets a parameter. Returns false if that is impossible.
pub(crate) fn set(equations: &mut Equations, (block, index): Slot, value: f64) -> bool {
    let Some(block) = equations.blocks.get_mut(block) else { return false };
    value.is_finite() && block.constraint.set_parameter_at(index, value)
}
