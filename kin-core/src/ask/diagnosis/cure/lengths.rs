//! Which lengths do not fit where a mechanism cannot be closed: those of which another value lets
//! it close and move, the likeliest first.

use super::super::order;
use super::super::search_under_way::Search;
use super::dimension::{self, Dimension, Of};
use super::fit::{self, Fitted};
use crate::model::verdict::{Resize, Size};
use crate::solve::assembly::search::Found;

/// Dimensions that are tried at most, and told at most.
const TRIED: usize = 24;
const MOST_SHOWN: usize = 3;

/// Mechanisms of more coordinates are not examined for their lengths.
const EXAMINED: usize = 400;

/// A length that is this many times the middle one of all, or as many times smaller, is out of
/// scale: a unit or a decimal point is wrong.   \[-\]
const OUT_OF_SCALE: f64 = 30.0;

/// The dimensions that would do, where the constraints that take part cannot be met together;
/// nothing where only what is out of scale is asked for and nothing is.
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
    // Of two that are as likely the one is told whose constraint is the first to be called
    // superfluous.
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
    // Where a dimension is out of scale, it is the one thing to change.
    let only = if fits.first().is_some_and(|first| !first.0) { 1 } else { MOST_SHOWN };
    fits.into_iter().take(only).map(|(_, _, resize)| resize).collect()
}

/// How unlikely a change is: the larger it is and the further it leads away from the middle one of
/// all lengths; points are less often wrong than lengths.   \[-\]
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
    // A zero is written on purpose.
    let origin = if dimension.size() == 0.0 { ORIGIN } else { 0.0 };
    let point = origin + if matches!(dimension.of, Of::Point(..)) { POINT } else { 0.0 };
    (1.0 + LARGE) * fitted.change - gain + point
}

fn ratio(a: f64, b: f64) -> f64 {
    (a / b).max(b / a)
}

/// The middle one of all lengths that are not zero, the larger one of two.
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
