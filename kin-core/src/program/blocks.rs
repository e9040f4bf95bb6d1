//! Finds the diagonal blocks of a square pattern in an order in which each block can be solved
//! after those before it.

/// Returns the rows and columns of each block, or `None` if rows and columns cannot be paired.
/// Columns may be arbitrary numbers.
pub(crate) fn blocks(pattern: &[Vec<usize>]) -> Option<Vec<(Vec<usize>, Vec<usize>)>> {
    let matched = Matching::of(pattern)?;
    if pattern.iter().flatten().any(|column| !matched.row_of.contains_key(column)) {
        return None;
    }
    let mut search = Search {
        pattern,
        matched: &matched,
        order: vec![0; pattern.len()],
        low: vec![0; pattern.len()],
        next: 1,
        stack: vec![],
        on: vec![false; pattern.len()],
        blocks: vec![],
    };
    let n = pattern.len();
    (0..n).for_each(|row| search.visit(row));
    Some(
        search
            .blocks
            .into_iter()
            .map(|rows| {
                let columns = rows.iter().map(|row| matched.column_of[*row]).collect();
                (rows, columns)
            })
            .collect(),
    )
}

/// A pairing of rows and columns: one entry of each row, each in another column.
struct Matching {
    /// The column of each row; `usize::MAX` if it has none yet.
    column_of: Vec<usize>,
    /// The row of each column that has one.
    row_of: std::collections::HashMap<usize, usize>,
}

impl Matching {
    /// Finds a pairing along augmenting paths.
    fn of(pattern: &[Vec<usize>]) -> Option<Matching> {
        let mut matching =
            Matching { column_of: vec![usize::MAX; pattern.len()], row_of: Default::default() };
        for start in 0..pattern.len() {
            matching.augment(pattern, start)?;
        }
        Some(matching)
    }

    /// Searches breadth-first for a free column, starting from a row.
    fn augment(&mut self, pattern: &[Vec<usize>], start: usize) -> Option<()> {
        let (mut from, mut open) =
            (std::collections::HashMap::new(), std::collections::VecDeque::from([start]));
        while let Some(row) = open.pop_front() {
            for &column in &pattern[row] {
                if from.contains_key(&column) {
                    continue;
                }
                from.insert(column, row);
                match self.row_of.get(&column) {
                    Some(next) => open.push_back(*next),
                    None => {
                        self.turn(&from, column, start);
                        return Some(());
                    }
                }
            }
        }
        None
    }

    /// Reverses the pairing along a path that ends at a free column.
    fn turn(
        &mut self,
        from: &std::collections::HashMap<usize, usize>,
        mut column: usize,
        start: usize,
    ) {
        loop {
            let row = from[&column];
            let before = std::mem::replace(&mut self.column_of[row], column);
            self.row_of.insert(column, row);
            if row == start {
                return;
            }
            column = before;
        }
    }
}

/// Tarjan's search for rows that depend on one another. It completes a block after all blocks on
/// which the block depends.
struct Search<'a> {
    pattern: &'a [Vec<usize>],
    matched: &'a Matching,
    order: Vec<usize>,
    low: Vec<usize>,
    next: usize,
    stack: Vec<usize>,
    on: Vec<bool>,
    blocks: Vec<Vec<usize>>,
}

impl Search<'_> {
    /// Visits a row and all rows on which it depends. It uses an explicit stack, because a chain
    /// can be long.
    fn visit(&mut self, start: usize) {
        if self.order[start] > 0 {
            return;
        }
        self.enter(start);
        let mut path = vec![(start, 0)];
        while let Some((row, place)) = path.last_mut() {
            let row = *row;
            let Some(column) = self.pattern[row].get(*place) else {
                path.pop();
                self.leave(row);
                if let Some((above, _)) = path.last() {
                    self.low[*above] = self.low[*above].min(self.low[row]);
                }
                continue;
            };
            *place += 1;
            let next = self.matched.row_of[column];
            if self.order[next] == 0 {
                self.enter(next);
                path.push((next, 0));
            } else if self.on[next] {
                self.low[row] = self.low[row].min(self.order[next]);
            }
        }
    }

    fn enter(&mut self, row: usize) {
        (self.order[row], self.low[row]) = (self.next, self.next);
        self.next += 1;
        self.stack.push(row);
        self.on[row] = true;
    }

    fn leave(&mut self, row: usize) {
        if self.low[row] != self.order[row] {
            return;
        }
        let from = self.stack.iter().rposition(|known| *known == row).unwrap_or_default();
        let mut block = self.stack.split_off(from);
        block.iter().for_each(|row| self.on[*row] = false);
        block.sort_unstable();
        self.blocks.push(block);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_come_after_what_they_read() {
        // 0 and 2 read one another through columns 7 and 9, and column 5, which row 1 gives.
        let pattern = [vec![5, 7, 9], vec![5], vec![7, 9]];
        assert_eq!(blocks(&pattern), Some(vec![(vec![1], vec![5]), (vec![0, 2], vec![7, 9])]));
    }

    #[test]
    fn a_path_turns_what_was_matched_before() {
        let pattern = [vec![1, 2], vec![1], vec![2, 3]];
        assert_eq!(
            blocks(&pattern),
            Some(vec![(vec![1], vec![1]), (vec![0], vec![2]), (vec![2], vec![3])])
        );
    }

    #[test]
    fn rows_that_share_one_column_have_no_blocks() {
        assert_eq!(blocks(&[vec![4], vec![4]]), None);
        assert_eq!(blocks(&[vec![]]), None);
        assert_eq!(blocks(&[vec![4, 5]]), None);
        assert_eq!(blocks(&[]), Some(vec![]));
    }
}
