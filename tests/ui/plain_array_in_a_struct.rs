//! A coordinate put into a struct over f64, where dual numbers stand in for the compiler.

use std::ops::{Index, IndexMut};

use kin::prelude::*;

macro_rules! twice {
    ($x:expr) => {
        2.0 * $x
    };
}

struct Grid {
    cells: [f64; 4],
    scale: f64,
}

impl Index<(usize, usize)> for Grid {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.cells[2 * i + j]
    }
}

impl IndexMut<(usize, usize)> for Grid {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.cells[2 * i + j]
    }
}

#[constraint]
fn determinant(a: Coord, b: Coord) -> f64 {
    let mut m = Grid { cells: [1.0, a, b, 2.0], scale: 1.0 };
    m[(0, 0)] += a * b;
    m[(0, 1)] = twice!(a);
    m.scale /= b;
    m.scale * (m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)])
}

fn main() {}
