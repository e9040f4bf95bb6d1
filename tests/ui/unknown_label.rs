use kin::prelude::*;

#[constraint]
fn table(x: Coord) -> f64 {
    let mut sum = 0.0;
    'rows: for i in 0..3 {
        for j in 0..3 {
            if j > i {
                continue 'row;
            }
            sum += x * j as f64;
        }
    }
    sum
}

fn main() {}
