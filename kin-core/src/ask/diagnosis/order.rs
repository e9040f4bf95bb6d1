//! Orders equations and coordinates by names alone, so that a report does not depend on the order
//! of declaration.

use std::cmp::Ordering;

use crate::coordinates::layout::Place;
use crate::coordinates::units::Unit;
use crate::system::scaled::Model;

/// Returns the rows in the order in which the report calls them superfluous: drivers, then joints,
/// the last name first. Norms of Euler parameters come after everything else.
pub(super) fn of_rows(model: &Model<'_>) -> Vec<usize> {
    let key = |row: usize| {
        let (name, local, class) = match model.equations.block_of(row) {
            Some((block, local)) if block.drives => (block.name.as_str(), local, 0),
            Some((block, local)) => (
                block.name.as_str(),
                local,
                if block.constraint.facts().kind == "euler_norm" { 2 } else { 1 },
            ),
            None => ("", 0, 2),
        };
        (class, name, local)
    };
    let mut rows: Vec<usize> = (0..model.m()).collect();
    rows.sort_by(|a, b| {
        let a = key(*a);
        let b = key(*b);
        a.0.cmp(&b.0).then_with(|| natural(b.1, a.1)).then(b.2.cmp(&a.2))
    });
    rows
}

/// Returns the columns in the order in which the report calls them free: angles, then lengths, then
/// Euler parameters. Within each kind, bodies that a joint connects to the ground come first,
/// because a motor is probable there; then names decide.
pub(in crate::ask) fn of_columns(model: &Model<'_>) -> Vec<usize> {
    let class = |column: usize| match model.layout.units[column] {
        Unit::Radian => 0,
        Unit::Metre => 1,
        Unit::One => 2,
    };
    let grounded = grounded(model);
    let mut columns: Vec<usize> = (0..model.n()).collect();
    columns.sort_by(|a, b| {
        let key = |column: usize| (class(column), !grounded[column]);
        key(*a)
            .cmp(&key(*b))
            .then_with(|| natural(&model.layout.names[*a], &model.layout.names[*b]))
    });
    columns
}

/// Returns for each column whether a joint connects its body to the ground.
fn grounded(model: &Model<'_>) -> Vec<bool> {
    let mut grounded = vec![false; model.n()];
    for block in model.equations.blocks.iter().filter(|block| !block.drives) {
        let arguments = block.constraint.arguments();
        let places: Vec<Place> =
            arguments.iter().filter_map(|argument| model.layout.place(&argument.target)).collect();
        if places.iter().any(|place| matches!(place, Place::Ground(_))) {
            let items = places.iter().filter_map(|place| match place {
                Place::Own { item, .. } => model.layout.items.get(*item),
                Place::Ground(_) => None,
            });
            items.for_each(|item| {
                grounded[item.first..item.first + item.kind.coordinates().len()].fill(true)
            });
        }
    }
    grounded
}

/// Compares names, with the numbers in them by value: `pin 2` before `pin 10`.
pub(super) fn natural(a: &str, b: &str) -> Ordering {
    let mut a = a;
    let mut b = b;
    loop {
        let x = digits(a);
        let y = digits(b);
        let order = match (x.is_empty(), y.is_empty()) {
            (false, false) => {
                let x = x.trim_start_matches('0');
                let y = y.trim_start_matches('0');
                x.len().cmp(&y.len()).then_with(|| x.cmp(y))
            }
            _ => a.chars().next().cmp(&b.chars().next()),
        };
        if order != Ordering::Equal || a.is_empty() {
            return order;
        }
        let skip = |text: &str, digits: &str| {
            digits.len().max(if digits.is_empty() {
                text.chars().next().map_or(0, char::len_utf8)
            } else {
                0
            })
        };
        (a, b) = (&a[skip(a, x)..], &b[skip(b, y)..]);
    }
}

fn digits(text: &str) -> &str {
    &text[..text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names = ["pin 10", "pin 2", "motor", "pin 2b", "motor 2", "pin 02", "é", ""];
        names.sort_by(|a, b| natural(a, b));
        assert_eq!(names, ["", "motor", "motor 2", "pin 2", "pin 02", "pin 2b", "pin 10", "é"]);
    }
}
