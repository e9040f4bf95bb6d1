//! Faults within the passes that make a program: a node or a number of what one of them hands on is wrong.

use kin_graph::{Graph, Node};

use crate::program::eliminate::Elimination;
use crate::program::gather::{Refusal, Whole, gather};
use crate::program::reduce::Reduced;
use crate::program::stages::{Pose, Program, eliminated, finished, slopes};
use crate::program::substitute::{Order, substitute};
use crate::system::System;

/// The pass that makes a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pass {
    Gather,
    Substitute,
    Eliminate,
}

/// Every pass.
pub(crate) const PASSES: [Pass; 3] = [Pass::Gather, Pass::Substitute, Pass::Eliminate];

/// The change of a node, or of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wrong {
    /// It has lost its sign.
    Sign,
    /// It is off by a thousandth.
    Slight,
    /// It is zero.
    Lost,
    /// It stands in the place of its neighbour, and that in its own: another column, row, or order.
    Place,
}

/// Every change.
pub(crate) const WRONGS: [Wrong; 4] = [Wrong::Sign, Wrong::Slight, Wrong::Lost, Wrong::Place];

/// The program of a system, with place number k of what a pass hands on made wrong; `None` where there is no
/// such place.
pub(crate) fn with_fault(
    system: &System,
    pose: Pose<'_>,
    (pass, wrong): (Pass, Wrong),
    k: usize,
) -> Option<Result<Program, Refusal>> {
    let mut whole = gather(system).expect("gathers");
    if pass == Pass::Gather {
        let Whole { graph, rows, .. } = &mut whole;
        let nodes = rows.iter_mut().flat_map(|row| {
            let own = [&mut row.residual, &mut row.by_time, &mut row.second];
            own.into_iter().chain(row.slopes.iter_mut().map(|(_, slope)| slope))
        });
        change(graph, nodes.collect(), wrong, k)?;
    }
    let values = slopes(&whole, pose);
    let mut order = substitute(&mut whole, &values, pose.sizes);
    if pass == Pass::Substitute {
        misgive(&mut whole.graph, &mut order, wrong, k)?;
    }
    let (mut reduced, values) = Reduced::new(&whole, &order);
    let mut elimination = match eliminated(&mut reduced, &whole, &order, pose) {
        Ok(elimination) => elimination,
        Err(reason) => return Some(Err(Refusal { constraint: String::new(), reason })),
    };
    if pass == Pass::Eliminate {
        spoil(&mut reduced.graph, &mut elimination, wrong, k)?;
    }
    Some(Ok(finished(&whole, &order, (reduced, values), &elimination)))
}

/// Makes number k of these nodes wrong.
fn change(graph: &mut Graph, mut nodes: Vec<&mut Node>, wrong: Wrong, k: usize) -> Option<()> {
    if wrong == Wrong::Place {
        let (first, rest) = nodes.split_at_mut_checked(k + 1)?;
        std::mem::swap(*first.last_mut()?, *rest.first_mut()?);
        return Some(());
    }
    let node = nodes.get_mut(k)?;
    **node = match wrong {
        Wrong::Sign => graph.neg(**node),
        Wrong::Slight => {
            let factor = graph.constant(1.001);
            graph.mul(factor, **node)
        }
        Wrong::Lost | Wrong::Place => graph.zero(),
    };
    Some(())
}

/// The rows that give coordinates: their factors, then their rests; their order, and one that gives is left
/// once more in place of another.
fn misgive(graph: &mut Graph, order: &mut Order, wrong: Wrong, k: usize) -> Option<()> {
    let given = order.explicit.len();
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

/// The cells, multipliers, cofactors and pivots of an elimination; then the order of its pivots.
fn spoil(graph: &mut Graph, all: &mut Elimination<'_>, wrong: Wrong, k: usize) -> Option<()> {
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
    let (first, rest) = pivots.split_at_mut_checked((k + 1).checked_sub(count)? + 1)?;
    std::mem::swap(*first.last_mut()?, *rest.first_mut().filter(|_| wrong == Wrong::Place)?);
    Some(())
}
