use kin::prelude::*;

#[derive(Clone, PartialEq)]
enum Profile {
    Flat,
    Round(f64),
}

#[constraint]
fn follower(x: Coord, profile: Profile) -> f64 {
    match profile {
        Profile::Flat => x,
        Profile::Rond(r) => x - r,
    }
}

fn main() {}
