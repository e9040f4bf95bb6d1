//! Splits the equations into groups that must be solved together.
//!
//! Each group has as many unknown coordinates as equations, after the preceding groups are solved.
//! For example, a driven crank is one group, and the loop that the crank moves is another group.

use crate::coordinates::Target;
use crate::coordinates::layout::{Kind, Place};
use crate::program::blocks;
use crate::system::scaled::Model;

/// Some rows and columns of C_q.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    /// The constraints with a row in the group.
    pub constraints: Vec<usize>,
    /// The values of C_q in the group, as (index among all values, row, column in the group).
    pub entries: Vec<(usize, usize, usize)>,
    /// True if all these values are constant: then the equations have exactly one solution.
    pub is_affine: bool,
    /// The first of four Euler parameters that are all in the group, for each such body.
    pub turns: Vec<usize>,
    /// The angles of planar bodies in the group.
    pub angles: Vec<usize>,
    /// The constraints that can close with an axis turned by 180°, and whose bodies are known after
    /// this group.
    pub branches: Vec<usize>,
}

impl Group {
    fn new(model: &Model<'_>, rows: Vec<usize>, columns: Vec<usize>) -> Self {
        let equations = model.equations;
        let [row_in, column_in] =
            [(&rows, model.m()), (&columns, model.n())].map(|(all, length)| {
                let mut places = vec![None; length];
                all.iter().enumerate().for_each(|(k, place)| places[*place] = Some(k));
                places
            });
        let inside = |(place, entry): (usize, &Option<(usize, usize)>)| {
            let (row, column) = (*entry)?;
            Some((place, row_in[row]?, column_in[column]?))
        };
        let entries: Vec<_> = equations.entries.iter().enumerate().filter_map(inside).collect();
        let is_square = rows.len() == columns.len();
        let constraints = equations.blocks.iter().enumerate();
        let of_kind = |kind: Kind| model.layout.items.iter().filter(move |item| item.kind == kind);
        Group {
            constraints: constraints
                .filter(|(_, block)| block.rows().any(|row| row_in[row].is_some()))
                .map(|(k, _)| k)
                .collect(),
            is_affine: is_square
                && entries.iter().all(|(place, _, _)| equations.constants[*place].is_some()),
            angles: of_kind(Kind::Planar)
                .map(|item| item.first + 2)
                .filter(|column| column_in[*column].is_some())
                .collect(),
            turns: of_kind(Kind::Spatial)
                .map(|item| item.first + 3)
                .filter(|first| (*first..first + 4).all(|column| column_in[column].is_some()))
                .collect(),
            branches: Vec::new(),
            rows,
            columns,
            entries,
        }
    }

    /// Returns true if the group contains the angle, or all Euler parameters, of the body with this
    /// first coordinate.
    pub(super) fn turns_body(&self, first: usize) -> bool {
        self.turns.contains(&(first + 3)) || self.angles.contains(&(first + 2))
    }

    /// Returns true if there are as many equations as coordinates.
    pub(super) fn is_square(&self) -> bool {
        self.rows.len() == self.columns.len()
    }
}

/// Returns the groups, each after those on which it depends. It returns a single group if equations
/// and coordinates do not pair up.
pub(super) fn groups(model: &Model<'_>) -> Vec<Group> {
    let mut groups = apart(model).unwrap_or_else(|| {
        vec![Group::new(model, (0..model.m()).collect(), (0..model.n()).collect())]
    });
    let mut group_of = vec![0; model.n()];
    for (k, group) in groups.iter().enumerate() {
        group.columns.iter().for_each(|column| group_of[*column] = k);
    }
    for &block in model.equations.branches() {
        let last = columns_of(model, block).map(|column| group_of[column]).max();
        groups[last.unwrap_or(0)].branches.push(block);
    }
    groups
}

/// Returns the groups with as many equations as coordinates, or `None` if they do not pair up.
fn apart(model: &Model<'_>) -> Option<Vec<Group>> {
    let equations = model.equations;
    if model.m() != model.n() || model.n() == 0 {
        return None;
    }
    let mut pattern: Vec<Vec<usize>> = vec![Vec::new(); model.m()];
    for (entry, constant) in equations.entries.iter().zip(&equations.constants) {
        if let Some((row, column)) = entry.filter(|_| *constant != Some(0.0)) {
            pattern[row].push(column);
        }
    }
    let found = blocks(&pattern)?;
    Some(found.into_iter().map(|(rows, columns)| Group::new(model, rows, columns)).collect())
}

/// Returns the coordinates of the bodies of a constraint.
fn columns_of<'a>(model: &'a Model<'_>, block: usize) -> impl Iterator<Item = usize> + 'a {
    let arguments = model.equations.blocks[block].constraint.arguments();
    arguments.into_iter().flat_map(|argument| {
        let count = match argument.target {
            Target::Planar(_) => 3,
            Target::Spatial(_) => 7,
            Target::Coord(..) => 1,
        };
        match model.layout.place(&argument.target) {
            Some(Place::Own { first, .. }) => first..first + count,
            _ => 0..0,
        }
    })
}
