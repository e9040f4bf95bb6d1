//! Plants faults within the passes that make a program: a node or a number in the result of a pass
//! is wrong.

use kin_graph::{Graph, Node};

use crate::program::Differences;
use crate::program::cofactors::Cofactors;
use crate::program::eliminate::{Elimination, Pivot};
use crate::program::gather::{Whole, gather};
use crate::program::reduce::Reduced;
use crate::program::refusal::Refusal;
use crate::program::stages::{Pose, Program, eliminated, finished, slopes};
use crate::program::substitute::{Explicit, Order, substitute};
use crate::system::System;

/// The pass that makes a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pass {
    Gather,
    Substitute,
    Eliminate,
    /// The elimination, for q̇ only.
    Rates,
    /// The elimination, for q̈ only.
    SecondRates,
    /// The elimination, for q⃛ only.
    ThirdRates,
}

/// Every pass.
pub(crate) const PASSES: [Pass; 6] = [
    Pass::Gather,
    Pass::Substitute,
    Pass::Eliminate,
    Pass::Rates,
    Pass::SecondRates,
    Pass::ThirdRates,
];

/// The change of a node, or of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wrong {
    /// It has the wrong sign.
    Sign,
    /// It is wrong by a thousandth.
    Slight,
    /// It is zero.
    Lost,
    /// It has the place of its neighbour and vice versa: another column, row or order.
    Place,
    /// A pivot, or a row that determines a coordinate, is recorded with the row of the next one.
    Row,
    /// It is recorded with the column of the next one.
    Column,
}

/// Every change.
pub(crate) const WRONGS: [Wrong; 6] =
    [Wrong::Sign, Wrong::Slight, Wrong::Lost, Wrong::Place, Wrong::Row, Wrong::Column];

/// Returns the program of a system with q⃛, in which place k of the result of a pass is wrong.
/// Returns `None` if there is no such place.
pub(crate) fn with_fault(
    system: &System,
    pose: Pose<'_>,
    (pass, wrong): (Pass, Wrong),
    k: usize,
) -> Option<Result<Program, Refusal>> {
    let mut whole = gather(system, true, Differences::default()).expect("gathers");
    if pass == Pass::Gather {
        miscopy(&mut whole, wrong, k)?;
    }
    let values = slopes(&whole, pose);
    let mut order = substitute(&mut whole, &values, pose.sizes);
    if pass == Pass::Substitute {
        misgive(&mut whole.graph, &mut order, wrong, k)?;
    }
    let (mut reduced, values) = Reduced::new(&whole, &order);
    let [right, mut spoilt] = match [(); 2].map(|()| eliminated(&mut reduced, &whole, &order, pose))
    {
        [Ok(right), Ok(same)] => [right, same],
        [Err(reason), _] | [_, Err(reason)] => {
            return Some(Err(Refusal::whole(reason)));
        }
    };
    if !matches!(pass, Pass::Gather | Pass::Substitute) {
        spoil(&mut reduced.graph, &mut spoilt, wrong, k)?;
    }
    let stages = match pass {
        Pass::Gather | Pass::Substitute => [&right; 4],
        Pass::Eliminate => [&spoilt; 4],
        Pass::Rates => [&right, &spoilt, &right, &right],
        Pass::SecondRates => [&right, &right, &spoilt, &right],
        Pass::ThirdRates => [&right, &right, &right, &spoilt],
    };
    Some(Ok(finished(&whole, &order, (reduced, values), stages)))
}

/// Changes the residuals of rows, their slopes and further derivatives, or the recorded rows and
/// columns.
fn miscopy(whole: &mut Whole, wrong: Wrong, k: usize) -> Option<()> {
    let Whole { graph, rows, .. } = whole;
    match wrong {
        Wrong::Row => {
            let (row, next) = neighbours(rows, k)?;
            std::mem::swap(&mut row.slopes, &mut next.slopes);
            Some(())
        }
        Wrong::Column => exchange(rows.iter_mut().map(|row| columns(&mut row.slopes)).collect(), k),
        _ => {
            let nodes = rows.iter_mut().flat_map(|row| {
                let own = [&mut row.residual, &mut row.by_time, &mut row.second];
                own.into_iter()
                    .chain(&mut row.third)
                    .chain(row.slopes.iter_mut().map(|(_, slope)| slope))
            });
            change(graph, nodes.collect(), wrong, k)
        }
    }
}

fn columns(cells: &mut [(usize, Node)]) -> Vec<&mut usize> {
    cells.iter_mut().map(|(column, _)| column).collect()
}

/// Returns element k and the next one.
fn neighbours<T>(all: &mut [T], k: usize) -> Option<(&mut T, &mut T)> {
    let (first, rest) = all.split_at_mut_checked(k + 1)?;
    Some((first.last_mut()?, rest.first_mut()?))
}

/// Exchanges pair k of all neighbours in these lists.
fn exchange(lists: Vec<Vec<&mut usize>>, mut k: usize) -> Option<()> {
    for mut list in lists {
        let pairs = list.len().saturating_sub(1);
        if k < pairs {
            let (one, next) = neighbours(&mut list, k)?;
            std::mem::swap(*one, *next);
            return Some(());
        }
        k -= pairs;
    }
    None
}

/// Makes node k wrong.
fn change(graph: &mut Graph, mut nodes: Vec<&mut Node>, wrong: Wrong, k: usize) -> Option<()> {
    if wrong == Wrong::Place {
        let (node, next) = neighbours(&mut nodes, k)?;
        std::mem::swap(*node, *next);
        return Some(());
    }
    let node = nodes.get_mut(k)?;
    **node = match wrong {
        Wrong::Sign => graph.neg(**node),
        Wrong::Slight => {
            let factor = graph.constant(1.001);
            graph.mul(factor, **node)
        }
        _ => graph.zero(),
    };
    Some(())
}

/// Changes the rows that determine coordinates: their factors, then their rests, their order, their
/// rows and columns; finally one of them stays in place of another.
fn misgive(graph: &mut Graph, order: &mut Order, wrong: Wrong, k: usize) -> Option<()> {
    let given = order.explicit.len();
    if matches!(wrong, Wrong::Row | Wrong::Column) {
        let is_row = wrong == Wrong::Row;
        let given = order.explicit.iter_mut();
        let own = given.map(|Explicit { row, column, .. }| if is_row { row } else { column });
        return exchange(vec![own.collect()], k);
    }
    if wrong == Wrong::Place && k + 1 < given {
        order.explicit.swap(k, k + 1);
        return Some(());
    }
    if wrong == Wrong::Place {
        *order.rows.get_mut(k + 1 - given)? = order.explicit.first()?.row;
        return Some(());
    }
    let Some(own) = order.explicit.get_mut(k) else {
        let rests = order.explicit.iter_mut().map(|own| &mut own.rest).collect();
        return change(graph, rests, wrong, k - given);
    };
    own.factor *= match wrong {
        Wrong::Sign => -1.0,
        Wrong::Slight => 1.001,
        _ => 1e-3,
    };
    Some(())
}

/// Changes the entries, multipliers, cofactors and pivots of an elimination; then the order of its
/// pivots; then the recorded rows and columns.
fn spoil(graph: &mut Graph, all: &mut Elimination<'_>, wrong: Wrong, k: usize) -> Option<()> {
    if matches!(wrong, Wrong::Row | Wrong::Column) {
        let lists = all.blocks.iter_mut().map(|block| {
            let Cofactors { rows, columns, .. } = &mut block.cofactors;
            let is_row = wrong == Wrong::Row;
            let pivots = block.pivots.iter_mut();
            let own = pivots.map(|Pivot { row, column, .. }| if is_row { row } else { column });
            own.chain(if is_row { rows } else { columns }).collect()
        });
        return exchange(lists.collect(), k);
    }
    let listed = all.given.iter_mut().chain(&mut all.multipliers).flatten().map(|(_, node)| node);
    let cells = all.cells.iter_mut().flat_map(|cells| cells.values_mut());
    let blocks = all.blocks.iter_mut().flat_map(|block| {
        let cofactors = &mut block.cofactors;
        let pivots = block.pivots.iter_mut().flat_map(|pivot| {
            let sides = pivot.lower.iter_mut().chain(&mut pivot.upper).map(|(_, node)| node);
            [&mut pivot.inverse, &mut pivot.guard].into_iter().chain(sides)
        });
        let own = [&mut cofactors.inverse, &mut cofactors.determinant].into_iter();
        cofactors.adjugate.iter_mut().flatten().chain(own).chain(pivots)
    });
    let nodes: Vec<&mut Node> = listed.chain(cells).chain(blocks).collect();
    let count = nodes.len();
    if let Some(()) = change(graph, nodes, wrong, k) {
        return Some(());
    }
    let mut pivots: Vec<_> = all.blocks.iter_mut().flat_map(|block| &mut block.pivots).collect();
    let (pivot, next) = neighbours(&mut pivots, (k + 1).checked_sub(count)?)?;
    (wrong == Wrong::Place).then(|| std::mem::swap(*pivot, *next))
}
