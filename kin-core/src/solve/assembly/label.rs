//! Names one assembly of a mechanism.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

use crate::coordinates::Target;
use crate::coordinates::layout::{Kind, Layout, Place};
use crate::coordinates::units::Unit;
use crate::linear::{Echelon, RANK};
use crate::model::state::SpatialState;
use crate::system::scaled::{Measures, Model};

/// The name of one assembly: a vector of signs, and an ordinal among the assemblies with the same
/// signs, such as `+-+ 2`.
///
/// The first sign is the sign of det C_q, which changes only at singular positions. Redundant
/// mechanisms do not have this sign. One sign follows for each pair of moving bodies that a
/// constraint joins, in the order of the constraints, and for each spatial body that is joined to
/// the ground. For planar bodies i and j the sign is the sign of sin(θ_j − θ_i), which says on
/// which side the elbow is. For spatial bodies the sign is + if the angle of the relative rotation
/// is less than a right angle: tr(A_iᵀ A_j) > 1.
///
/// Ordinals count from 1. Kin sorts the assemblies with the same signs by the first coordinate that
/// differs by more than 1e-6 rad, or by more than 1e-6 of the model's length. Kin compares angles
/// between −π and π. The Euler parameters p and −p describe the same pose, so Kin compares the one
/// whose first nonzero number is positive.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Label {
    /// The signs, +1 or −1.
    pub signs: Vec<i8>,
    /// The ordinal among assemblies with the same signs, from 1.
    pub ordinal: usize,
}

impl Display for Label {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        self.signs.iter().try_for_each(|sign| f.write_str(if *sign > 0 { "+" } else { "-" }))?;
        write!(f, "{}{}", if self.signs.is_empty() { "" } else { " " }, self.ordinal)
    }
}

impl serde::Serialize for Label {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl FromStr for Label {
    type Err = crate::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let unknown = || crate::Error::UnknownName {
            what: "label of the form `+-+ 2`",
            name: text.to_string(),
            known: Vec::new(),
        };
        let (signs, ordinal) = text.trim().rsplit_once(' ').unwrap_or(("", text.trim()));
        let sign = |c: char| match c {
            '+' => Some(1),
            '-' | '−' => Some(-1),
            _ => None,
        };
        let signs =
            signs.trim().chars().map(sign).collect::<Option<Vec<i8>>>().ok_or_else(unknown)?;
        let ordinal = ordinal.parse().ok().filter(|k| *k > 0).ok_or_else(unknown)?;
        Ok(Label { signs, ordinal })
    }
}

/// Returns q with angles between −π and π, one of the two signs of Euler parameters, and lengths in
/// units of the model's length. It is equal for equal poses.
pub(super) fn canonical(layout: &Layout, measures: &Measures, q: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = q.iter().zip(&measures.sizes).map(|(q, size)| q / size).collect();
    for (x, _) in all.iter_mut().zip(&layout.units).filter(|(_, unit)| **unit == Unit::Radian) {
        let (sin, cos) = x.sin_cos();
        // −π and π are the same angle.
        *x = if sin.abs() < SAME && cos < 0.0 { std::f64::consts::PI } else { sin.atan2(cos) };
    }
    for item in layout.items.iter().filter(|item| item.kind == Kind::Spatial) {
        let p = &mut all[item.first + 3..item.first + 7];
        if p.iter().find(|e| e.abs() > SAME).is_some_and(|e| *e < 0.0) {
            p.iter_mut().for_each(|e| *e = -*e);
        }
    }
    all
}

/// Coordinates closer than this are equal. \[-\]
pub(super) const SAME: f64 = 1e-6;

/// Labels assemblies and sorts them: by signs, + before −, then by coordinates.
pub(super) fn labelled(
    model: &Model<'_>,
    measures: &Measures,
    found: Vec<Vec<f64>>,
    t: f64,
) -> Vec<(Label, Vec<f64>)> {
    let mut all: Vec<(Vec<i8>, Vec<f64>, Vec<f64>)> = found
        .into_iter()
        .map(|q| (signs(model, measures, &q, t), canonical(model.layout, measures, &q), q))
        .collect();
    let by_coordinates = |a: &[f64], b: &[f64]| {
        let different = a.iter().zip(b).find(|(a, b)| (*a - *b).abs() > SAME);
        different.map_or(std::cmp::Ordering::Equal, |(a, b)| a.total_cmp(b))
    };
    all.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| by_coordinates(&a.1, &b.1)));
    let mut labelled: Vec<(Label, Vec<f64>)> = Vec::new();
    for (signs, _, q) in all {
        let ordinal = labelled
            .last()
            .filter(|(label, _)| label.signs == signs)
            .map_or(1, |(label, _)| label.ordinal + 1);
        labelled.push((Label { signs, ordinal }, q));
    }
    labelled
}

fn signs(model: &Model<'_>, measures: &Measures, q: &[f64], t: f64) -> Vec<i8> {
    let mut signs = Vec::new();
    if model.m() == model.n()
        && let Ok(point) = model.linearize(q, t)
    {
        signs.push(
            Echelon::new(model.scaled(&point.values, measures, &|_| true), model.n(), RANK).sign(),
        );
    }
    let mut known: Vec<(Option<usize>, Option<usize>)> = Vec::new();
    for block in &model.equations.blocks {
        let bodies: Vec<(Target, Option<usize>)> = block
            .constraint
            .arguments()
            .iter()
            .filter_map(|a| body(model.layout, &a.target))
            .collect();
        let [(target, i), (_, j)] = bodies[..] else { continue };
        let spatial = matches!(target, Target::Spatial(_));
        let pair = (i.min(j), i.max(j));
        if known.contains(&pair) || (pair.0.is_none() && !spatial) {
            continue;
        }
        known.push(pair);
        signs.push(if spatial { spatial_sign(q, i, j) } else { planar_sign(q, i, j) });
    }
    signs
}

/// Returns a body, and its first coordinate unless it is the ground.
fn body(layout: &Layout, target: &Target) -> Option<(Target, Option<usize>)> {
    if matches!(target, Target::Coord(..)) {
        return None;
    }
    match layout.place(target)? {
        Place::Own { first, .. } => Some((*target, Some(first))),
        Place::Ground(_) => Some((*target, None)),
    }
}

fn planar_sign(q: &[f64], i: Option<usize>, j: Option<usize>) -> i8 {
    let angle = |first: Option<usize>| first.map_or(0.0, |first| q[first + 2]);
    if (angle(j) - angle(i)).sin() < 0.0 { -1 } else { 1 }
}

fn spatial_sign(q: &[f64], i: Option<usize>, j: Option<usize>) -> i8 {
    let a = |first: Option<usize>| match first.and_then(|first| q.get(first..)?.first_chunk::<7>())
    {
        Some(q) => SpatialState::<f64>::new(*q).a,
        None => SpatialState::<f64>::ground().a,
    };
    let relative = a(i).transpose() * a(j);
    if relative.m11 + relative.m22 + relative.m33 < 1.0 { -1 } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn label_is_what_it_is_written_as() {
        for label in
            [Label { signs: vec![1, -1, 1], ordinal: 2 }, Label { signs: vec![], ordinal: 1 }]
        {
            assert_eq!(label.to_string().parse::<Label>().unwrap(), label);
        }
        for wrong in ["", "+ -1", "+x 1", "+-", "+ 0", "+ + 1"] {
            assert!(wrong.parse::<Label>().is_err(), "{wrong}");
        }
    }
}
