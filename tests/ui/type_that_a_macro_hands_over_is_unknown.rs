use kin::prelude::*;

macro_rules! slider {
    ($body:ty) => {
        #[constraint]
        fn slider(i: $body, height: f64) -> f64 {
            i.r.y - height
        }
    };
}

slider!(Plannar);

fn main() {}
