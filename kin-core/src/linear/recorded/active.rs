//! Stores the active part of a matrix while Kin records its elimination: entries by rows and
//! columns, and lines by their number of entries.
//!
//! An entry of the active part has the name *cell*.

/// The index that means no cell, no term, no line.
pub(crate) const NONE: u32 = u32::MAX;

/// One remaining entry: constant + Σ terms.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    pub row: u32,
    pub column: u32,
    /// Its value, scaled by its row and column.
    pub value: f64,
    /// Its constant part, unscaled.
    pub constant: f64,
    /// The first of its terms; `NONE` if it has none.
    pub terms: u32,
    /// Its positions in the lists of its row and of its column.
    at: [u32; 2],
}

/// The side of a line: row or column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    Row,
    Column,
}

/// The remaining cells.
pub(crate) struct Active {
    pub cells: Vec<Cell>,
    /// The cells of each row, and of each column.
    lines: [Vec<Vec<u32>>; 2],
    pub counts: [Counts; 2],
    /// For each row the largest |value|; negative if it must be computed again.
    tops: Vec<f64>,
    /// For each column the cell of the marked row; `NONE` if there is none.
    mark: Vec<u32>,
}

impl Active {
    pub(crate) fn new(n: usize) -> Self {
        Active {
            cells: Vec::new(),
            lines: [vec![Vec::new(); n], vec![Vec::new(); n]],
            counts: [Counts::new(n), Counts::new(n)],
            tops: vec![-1.0; n],
            mark: vec![NONE; n],
        }
    }

    pub(crate) fn line(&self, side: Side, k: u32) -> &[u32] {
        &self.lines[side as usize][k as usize]
    }

    /// Inserts a cell of value zero.
    pub(crate) fn insert(&mut self, row: u32, column: u32) -> u32 {
        let id = self.cells.len() as u32;
        let [rows, columns] = &mut self.lines;
        let row_list = &mut rows[row as usize];
        let column_list = &mut columns[column as usize];
        let at = [row_list.len() as u32, column_list.len() as u32];
        row_list.push(id);
        column_list.push(id);
        self.cells.push(Cell { row, column, value: 0.0, constant: 0.0, terms: NONE, at });
        id
    }

    /// Removes a cell from its row and column.
    pub(crate) fn remove(&mut self, cell: u32) {
        self.detach(Side::Row, cell);
        self.detach(Side::Column, cell);
    }

    /// Removes a cell from its row or its column.
    fn detach(&mut self, side: Side, cell: u32) {
        let Cell { row, column, at, .. } = self.cells[cell as usize];
        let line = if side == Side::Row { row } else { column };
        let list = &mut self.lines[side as usize][line as usize];
        let place = at[side as usize];
        list.swap_remove(place as usize);
        if let Some(&moved) = list.get(place as usize) {
            self.cells[moved as usize].at[side as usize] = place;
        }
        if side == Side::Row {
            self.tops[row as usize] = -1.0;
        }
    }

    /// Removes the row and the column of a pivot. Returns the other cells of its column, and those
    /// of its row.
    pub(crate) fn take_out(&mut self, pivot: u32) -> (Vec<u32>, Vec<u32>) {
        let Cell { row, column, .. } = self.cells[pivot as usize];
        self.counts[Side::Row as usize].remove(row);
        self.counts[Side::Column as usize].remove(column);
        let mut upper = std::mem::take(&mut self.lines[Side::Row as usize][row as usize]);
        let mut lower = std::mem::take(&mut self.lines[Side::Column as usize][column as usize]);
        upper.retain(|cell| *cell != pivot);
        lower.retain(|cell| *cell != pivot);
        for &cell in &upper {
            self.detach(Side::Column, cell);
            self.recount(Side::Column, self.cells[cell as usize].column);
        }
        for &cell in &lower {
            self.detach(Side::Row, cell);
            self.recount(Side::Row, self.cells[cell as usize].row);
        }
        (lower, upper)
    }

    /// Moves a line to the list of its number of cells, to be examined again.
    pub(crate) fn recount(&mut self, side: Side, line: u32) {
        let count = self.line(side, line).len();
        self.counts[side as usize].put(line, count as u32);
    }

    /// Records the cell of the row in each column.
    pub(crate) fn mark(&mut self, row: u32) {
        for &cell in &self.lines[Side::Row as usize][row as usize] {
            self.mark[self.cells[cell as usize].column as usize] = cell;
        }
    }

    /// Returns the cell of the marked row in this column.
    pub(crate) fn marked(&self, column: u32) -> Option<u32> {
        Some(self.mark[column as usize]).filter(|cell| *cell != NONE)
    }

    /// Removes the marks of the row, whose values have changed.
    pub(crate) fn unmark(&mut self, row: u32) {
        for &cell in &self.lines[Side::Row as usize][row as usize] {
            self.mark[self.cells[cell as usize].column as usize] = NONE;
        }
        self.tops[row as usize] = -1.0;
        self.recount(Side::Row, row);
    }

    /// Removes a cell that is always zero from the marked row.
    pub(crate) fn vanish(&mut self, cell: u32) {
        let column = self.cells[cell as usize].column;
        self.mark[column as usize] = NONE;
        self.remove(cell);
        self.recount(Side::Column, column);
    }

    /// Returns the largest |value| of a row.
    pub(crate) fn top(&mut self, row: u32) -> f64 {
        if self.tops[row as usize] < 0.0 {
            let cells = self.line(Side::Row, row).iter();
            self.tops[row as usize] =
                cells.fold(0.0, |top, &cell| self.cells[cell as usize].value.abs().max(top));
        }
        self.tops[row as usize]
    }
}

/// The lines by their number of cells, in doubly linked lists, so that every change takes constant
/// time.
pub(crate) struct Counts {
    /// The first line with each number of cells, indexed by that number; `NONE` if there is no such
    /// line.
    first: Vec<u32>,
    /// The line after each line in its list; `NONE` after the last one.
    next: Vec<u32>,
    /// The line before each line in its list; `NONE` before the first one.
    previous: Vec<u32>,
    /// The list that contains each line; `NONE` if no list does.
    list: Vec<u32>,
}

impl Counts {
    fn new(n: usize) -> Self {
        Counts {
            first: vec![NONE; n + 1],
            next: vec![NONE; n],
            previous: vec![NONE; n],
            list: vec![NONE; n],
        }
    }

    pub(crate) fn first(&self, count: usize) -> u32 {
        self.first.get(count).copied().unwrap_or(NONE)
    }

    pub(crate) fn next(&self, line: u32) -> u32 {
        self.next[line as usize]
    }

    /// Moves a line to the front of the list of its number of cells.
    fn put(&mut self, line: u32, count: u32) {
        self.remove(line);
        let front = std::mem::replace(&mut self.first[count as usize], line);
        if front != NONE {
            self.previous[front as usize] = line;
        }
        self.next[line as usize] = front;
        self.previous[line as usize] = NONE;
        self.list[line as usize] = count;
    }

    /// Removes a line until it changes.
    pub(crate) fn remove(&mut self, line: u32) {
        let k = line as usize;
        let list = std::mem::replace(&mut self.list[k], NONE);
        if list == NONE {
            return;
        }
        let next = self.next[k];
        let previous = self.previous[k];
        match previous {
            NONE => self.first[list as usize] = next,
            _ => self.next[previous as usize] = next,
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }
}
