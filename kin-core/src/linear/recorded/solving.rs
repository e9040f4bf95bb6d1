//! Writes the program of forward and back substitution for a recorded elimination.

use super::active::NONE;
use super::program::Kind;
use super::record::{Inverse, Number, Recorder};

/// Writes the program: forward in the order of the pivots, then back.
///
/// A pivot without cells in U is complete after forward substitution. A pivot without cells in L
/// needs one step on the way back.
pub(crate) fn write(recorder: &mut Recorder<'_>) {
    for k in 0..recorder.pivots.len() {
        let pivot = &recorder.pivots[k];
        if pivot.upper.is_empty() || pivot.has_lower {
            let start = recorder.places.rhs + pivot.row;
            step(recorder, k, start, true, false);
        }
    }
    for k in (0..recorder.pivots.len()).rev() {
        let pivot = &recorder.pivots[k];
        if pivot.upper.is_empty() {
            continue;
        }
        let whole = !pivot.has_lower;
        let start = if whole {
            recorder.places.rhs + pivot.row
        } else {
            recorder.places.solution + pivot.column
        };
        step(recorder, k, start, whole, true);
    }
}

/// Writes x_k = (start − Σ l x − Σ u x) / pivot with the requested parts. A row of U that is used
/// alone is already divided.
fn step(recorder: &mut Recorder<'_>, k: usize, start: u32, with_lower: bool, with_upper: bool) {
    recorder.lists.clear();
    let row = recorder.pivots[k].row;
    let out = recorder.places.solution + recorder.pivots[k].column;
    let mut next = if with_lower { recorder.lower_first[row as usize] } else { NONE };
    while next != NONE {
        let (column, number, after) = recorder.lower[next as usize];
        operand(recorder, column, number);
        next = after;
    }
    if with_upper {
        for j in recorder.pivots[k].upper.clone() {
            let (column, number) = recorder.upper[j];
            operand(recorder, column, number);
        }
    }
    let inverse = if with_lower { recorder.pivots[k].inverse } else { Inverse::One };
    let (kind, scale) = match inverse {
        Inverse::One => (Kind::Plain, recorder.places.zero),
        Inverse::MinusOne => (Kind::Negated, recorder.places.zero),
        Inverse::At(scale) => (Kind::Scaled, scale),
    };
    let lists = &mut recorder.lists;
    if kind == Kind::Negated {
        std::mem::swap(&mut lists.plus, &mut lists.minus);
    }
    recorder.recording.solve.push(
        kind,
        [out, start, scale],
        &lists.products,
        &lists.plus,
        &lists.minus,
    );
}

/// Appends an operand: a number times the solution at a column, to be subtracted.
fn operand(recorder: &mut Recorder<'_>, column: u32, number: Number) {
    let x = recorder.places.solution + column;
    match number {
        Number::Constant(1.0) => recorder.lists.minus.push(x),
        Number::Constant(-1.0) => recorder.lists.plus.push(x),
        Number::Constant(c) => {
            let constant = recorder.constant(c);
            recorder.lists.products.push([constant, x]);
        }
        Number::At(k) => recorder.lists.products.push([k, x]),
    }
}
