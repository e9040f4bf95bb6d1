use kin::prelude::*;

#[constraint]
fn level(self, h: f64) -> f64 {
    self.theta - h
}

fn main() {}
