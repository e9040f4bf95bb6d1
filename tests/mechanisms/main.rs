//! Known mechanisms, made of the library's joints, against closed forms and identities written
//! here.

mod drawn;
mod machines;
mod planar;
mod preferred;
mod shafts;
mod spatial_loops;

#[path = "../data/engines.rs"]
mod engines;
#[path = "../data/own.rs"]
mod own;

use kin::Motion;

/// max |found − exact| over the run, of what is computed at each time.
pub fn worst(motion: &Motion, mut difference: impl FnMut(usize, f64) -> f64) -> f64 {
    motion
        .times()
        .iter()
        .enumerate()
        .map(|(k, t)| difference(k, *t).abs())
        .fold(0.0, |m, d| if d <= m { m } else { d })
}
