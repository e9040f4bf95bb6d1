//! Finds the wrong lengths in a mechanism that cannot close, the most likely one first.
//!
//! With another value of such a length the mechanism closes and moves.

use super::super::order;
use super::super::search_under_way::Search;
use super::dimension::{self, Dimension, Of};
use super::fit::{self, Fitted};
use crate::outcome::verdict::{Resize, Size};
use crate::solve::assembly::search::Found;

/// The largest number of dimensions to try, and to report.
const TRIED: usize = 24;
const MOST_SHOWN: usize = 3;

/// Mechanisms with more coordinates are not examined for their lengths, because each trial solves
/// all equations.
const EXAMINED: usize = 400;

/// A length is out of scale if it is larger than the median length by this factor, or smaller: then
/// a unit or a decimal point is wrong. \[-\]
const OUT_OF_SCALE: f64 = 30.0;

/// Returns the dimensions that work, if the constraints of the contradiction cannot be satisfied
/// together. If the caller asks only for dimensions out of scale and there are none, the list is
/// empty.
pub(crate) fn that_fit(
    search: &Search<'_>,
    found: &Found,
    part: &[usize],
    without: &[usize],
    out_of_scale: bool,
) -> Vec<Resize> {
    let model = &search.model;
    if model.n() > EXAMINED {
        return Vec::new();
    }
    let all = dimension::all(model);
    let scale = middle(&all);
    let drives = |dimension: &Dimension| {
        dimension.blocks().all(|block| model.equations.blocks[block].drives)
    };
    let takes_part = |dimension: &Dimension| dimension.blocks().any(|block| part.contains(&block));
    // A point at the origin of its body has no scale.
    let is_out = |dimension: &Dimension| {
        dimension.size() > 0.0
            && dimension.is_length()
            && scale.is_some_and(|middle| ratio(dimension.size(), middle) > OUT_OF_SCALE)
    };
    let likely = all.iter().filter(|dimension| {
        !drives(dimension) && takes_part(dimension) && (!out_of_scale || is_out(dimension))
    });
    let mut fits: Vec<(bool, f64, Resize)> = Vec::new();
    for dimension in likely.take(TRIED) {
        if search.clock.is_up() {
            break;
        }
        let fitted = |dimension: &Dimension| {
            let fitted =
                fit::fit(model, dimension, found, search.t, without, search.options.steps)?;
            Some((
                !is_out(dimension),
                unlikely(dimension, &fitted, scale),
                resize(search, dimension, fitted),
            ))
        };
        fits.extend(fitted(dimension).or_else(|| fitted(&dimension.anywhere()?)));
    }
    // Of two equally likely dimensions the report takes the one whose constraint it calls
    // superfluous first.
    let order: Vec<usize> = order::of_rows(model)
        .into_iter()
        .filter_map(|row| model.equations.block_index(row))
        .collect();
    let rank = |resize: &Resize| {
        let name = match &resize.of {
            Size::Number { constraint, .. } | Size::Point { constraint, .. } => constraint,
            Size::Length { .. } => return 0,
        };
        order
            .iter()
            .position(|block| model.equations.blocks[*block].name == *name)
            .unwrap_or(usize::MAX)
    };
    let about = |unlikely: f64| (unlikely * 20.0).round();
    fits.sort_by(|a, b| {
        a.0.cmp(&b.0)
            .then(about(a.1).total_cmp(&about(b.1)))
            .then_with(|| rank(&a.2).cmp(&rank(&b.2)))
    });
    // A dimension out of scale is the only one to change.
    let only = if fits.first().is_some_and(|first| !first.0) { 1 } else { MOST_SHOWN };
    fits.into_iter().take(only).map(|(_, _, resize)| resize).collect()
}

/// Returns how improbable a change is. It grows with the change and with the distance of the result
/// from the median length; points are wrong less often than lengths. \[-\]
fn unlikely(dimension: &Dimension, fitted: &Fitted, middle: Option<f64>) -> f64 {
    const POINT: f64 = 1.25;
    const ORIGIN: f64 = 0.25;
    const LARGE: f64 = 0.1;
    let size = fitted.value.iter().map(|x| x * x).sum::<f64>().sqrt();
    let gain =
        match middle.filter(|_| dimension.is_length() && dimension.size() > 0.0 && size > 0.0) {
            Some(middle) => ratio(dimension.size(), middle).ln() - ratio(size, middle).ln(),
            None => 0.0,
        };
    // Users write a zero on purpose.
    let origin = if dimension.size() == 0.0 { ORIGIN } else { 0.0 };
    let point = origin + if matches!(dimension.of, Of::Point(..)) { POINT } else { 0.0 };
    (1.0 + LARGE) * fitted.change - gain + point
}

fn ratio(a: f64, b: f64) -> f64 {
    (a / b).max(b / a)
}

/// Returns the median of all nonzero lengths; of two the larger one.
fn middle(all: &[Dimension]) -> Option<f64> {
    let lengths = all.iter().filter(|dimension| dimension.is_length());
    let mut sizes: Vec<f64> = lengths.map(Dimension::size).filter(|size| *size > 0.0).collect();
    sizes.sort_by(f64::total_cmp);
    (sizes.len() > 2).then(|| sizes[sizes.len() / 2])
}

fn resize(
    search: &Search<'_>,
    dimension: &Dimension,
    Fitted { value, exact, .. }: Fitted,
) -> Resize {
    let model = &search.model;
    let body = |item: usize| model.layout.items[item].name.clone();
    let constraint = |block: usize| model.equations.blocks[block].name.clone();
    let of = match &dimension.of {
        Of::Length(item) => Size::Length { body: body(*item) },
        Of::Number(block, name) => {
            Size::Number { constraint: constraint(*block), parameter: name.clone() }
        }
        Of::Point(block, name, item) => Size::Point {
            constraint: constraint(*block),
            parameter: name.clone(),
            body: item.map(body),
        },
    };
    Resize {
        of,
        is: dimension.components(&dimension.value),
        fits: dimension.components(&value),
        exact,
    }
}
