//! Finds the smallest change that makes a mechanism exactly constrained.

use crate::outcome::verdict::{Change, Class, Dependency, Freedom, Gap};

use super::super::examined::Examined;
use super::super::order;
use super::freed::{for_freedoms, out_of_line};
use super::trial::Trial;

/// Returns the rows to remove for redundant equations, and the coordinates to drive for freedoms. A
/// dependency or freedom of this pose alone requires another pose, not another model.
pub(crate) fn least(
    examined: &Examined<'_>,
    gaps: &[Gap],
    dependencies: &[Dependency],
    freedoms: &[Freedom],
) -> Vec<Change> {
    let drivers = gaps.iter().all(|gap| gap.rows.iter().all(|row| examined.model().drives(*row)));
    let mut changes: Vec<Change> = Vec::new();
    match examined.cures {
        [] => changes.extend(gaps.iter().map(|gap| for_gap(examined, gap, dependencies))),
        [Change::Resize { any }] if drivers => {
            changes.extend(gaps.iter().map(|gap| for_gap(examined, gap, dependencies)));
            if let [Change::Limit { or, .. }] = &mut changes[..] {
                or.clone_from(any);
            }
        }
        [allow @ Change::Allow { .. }] => {
            changes.push(allow.clone());
            changes.extend(gaps.iter().map(|gap| for_gap(examined, gap, dependencies)));
        }
        cures => {
            // With the cure everything closes and moves, so it explains everything else that is
            // wrong at this pose.
            changes.extend_from_slice(cures);
            if examined.model().m() >= examined.model().n() {
                return changes;
            }
        }
    }
    let gone = |row: usize| gaps.iter().any(|gap| gap.rows.contains(&row));
    let lasting = dependencies.iter().filter(|found| found.class != Class::OnlyHere);
    let mut rows = Vec::new();
    let mut conflicts = Vec::new();
    for found in lasting {
        match found.terms.first() {
            Some(own) if gone(own.row) => {}
            Some(own) if found.class != Class::Redundant && examined.model().drives(own.row) => {
                conflicts.push((own.constraint.clone(), found))
            }
            Some(own) => rows.push(own.row),
            None => {}
        }
    }
    conflicts.dedup_by(|a, b| a.0 == b.0);
    changes.extend(conflicts.into_iter().map(|(constraint, found)| Change::Remove {
        or: others(examined, &constraint, &[found]),
        constraint,
    }));
    changes.extend(leave_out(examined, &rows));
    changes.extend(for_freedoms(examined, freedoms));
    if changes.is_empty() && gaps.is_empty() {
        changes.extend(out_of_line(examined, freedoms));
        changes.extend(loosened(examined, dependencies));
    }
    changes
}

/// For a mechanism without a driver whose joints hold it at a special position only: returns the
/// joints of which one could hold less.
fn loosened(examined: &Examined<'_>, dependencies: &[Dependency]) -> Option<Change> {
    let model = examined.model();
    let is_driven = (0..model.m()).any(|row| model.drives(row));
    let mut constraints: Vec<String> =
        dependencies.iter().flat_map(Dependency::constraints).map(str::to_string).collect();
    constraints.sort_by(|a, b| order::natural(a, b));
    constraints.dedup();
    (!is_driven && !constraints.is_empty()).then_some(Change::Loosen { constraints })
}

/// Returns the change that closes a gap: a smaller range of a driver, one driver less, or another
/// dimension.
fn for_gap(examined: &Examined<'_>, gap: &Gap, dependencies: &[Dependency]) -> Change {
    let model = examined.model();
    let constraint = gap.constraint.clone();
    let sets: Vec<&Dependency> = dependencies
        .iter()
        .filter(|found| found.terms.iter().any(|term| gap.rows.contains(&term.row)))
        .collect();
    if gap.rows.iter().all(|row| model.drives(*row)) {
        if !gap.lasting {
            return Change::Limit { constraint, asks: gap.asks.clone(), or: Vec::new() };
        }
        let mut or = others(examined, &constraint, &sets);
        or.retain(|name| can_go(examined, name));
        return Change::Remove { or, constraint };
    }
    if let Some(step) = gap.steps.iter().find(|step| step.constraint == gap.constraint) {
        return Change::Smooth { step: step.clone() };
    }
    let own = |found: &&Dependency| {
        found.terms.first().map(|term| term.row).filter(|row| gap.rows.contains(row))
    };
    let mut rows: Vec<usize> = sets.iter().filter_map(own).collect();
    rows.sort_unstable();
    rows.retain(|row| works_without(examined, &[*row]));
    let name = |row: &usize| {
        model.equations.block_of(*row).map(|(block, local)| block.row(local).to_string())
    };
    let or_drop = rows.iter().filter_map(name).collect();
    Change::Fit { constraint, missing: gap.size(), or_drop, of: gap.rows.len() }
}

/// Returns true if everything else closes without a constraint, and moves along it if it is a
/// driver.
fn can_go(examined: &Examined<'_>, name: &str) -> bool {
    let block = examined.model().equations.blocks.iter().find(|block| block.name == name);
    block.is_some_and(|block| works_without(examined, &block.rows().collect::<Vec<_>>()))
}

/// Returns true if the mechanism closes without these equations and each driver among them had
/// something to drive. If there is no driver among them, every remaining driver must have something
/// to drive.
fn works_without(examined: &Examined<'_>, rows: &[usize]) -> bool {
    let model = examined.model();
    let trial = Trial { model: *model, t: examined.t, without: rows, steps: examined.walk.steps };
    let own: Vec<usize> = rows.iter().copied().filter(|row| model.drives(*row)).collect();
    let drivers = if own.is_empty() { super::trial::drivers(model, rows) } else { own };
    trial.closed(examined.q).is_some_and(|found| trial.moves(&found, &drivers))
}

/// Returns the constraints that the user could remove instead of a conflicting driver: other
/// drivers, or joints of one row if there are none.
fn others(examined: &Examined<'_>, own: &str, sets: &[&Dependency]) -> Vec<String> {
    let names = |wanted: &dyn Fn(usize) -> bool| {
        let mut all: Vec<String> = Vec::new();
        for term in sets
            .iter()
            .flat_map(|found| &found.terms)
            .filter(|term| term.constraint != own && wanted(term.row))
        {
            if !all.contains(&term.constraint) {
                all.push(term.constraint.clone());
            }
        }
        all
    };
    let model = examined.model();
    let drivers = names(&|row| model.drives(row));
    if !drivers.is_empty() {
        return drivers;
    }
    names(&|row| model.equations.block_of(row).is_some_and(|(block, _)| block.rows().len() == 1))
}

/// Groups the rows by constraint.
fn leave_out(examined: &Examined<'_>, rows: &[usize]) -> Vec<Change> {
    let mut changes = Vec::new();
    for block in &examined.model().equations.blocks {
        let own: Vec<usize> = rows
            .iter()
            .filter(|row| block.rows().contains(row))
            .map(|row| row - block.rows().start)
            .collect();
        if own.is_empty() {
            continue;
        }
        let constraint = block.name.clone();
        changes.push(if own.len() == block.rows().len() {
            Change::Remove { constraint, or: Vec::new() }
        } else {
            let mut own = own;
            own.sort_unstable();
            let instead = instead(block.constraint.facts().kind, block.rows().len(), &own)
                .map(str::to_string);
            Change::Drop {
                constraint,
                rows: own.iter().map(|local| block.row(*local).to_string()).collect(),
                instead,
            }
        });
    }
    changes
}

/// Returns the joint that remains if rows are removed from a planar joint of the library.
fn instead(kind: &str, of: usize, rows: &[usize]) -> Option<&'static str> {
    match (kind, of, rows) {
        ("prismatic", 2, [0]) => Some("a point on a line"),
        ("prismatic", 2, [1]) => Some("a constraint of the angle alone"),
        ("revolute", 2, [_]) => Some("a point on a line"),
        _ => None,
    }
}
