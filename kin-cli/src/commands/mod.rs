//! The commands, a file each where they are long.

mod ask;
mod circuit;
mod drag;
mod emit;
mod forces;
mod import;
mod map;
mod pose;
mod run;
mod shell;
mod sweep;

pub use ask::{assemblies, check, diagnose, measure, prove, sensitivities, tolerance};
pub use circuit::circuit;
pub use drag::drag;
pub use emit::emit;
pub use forces::forces;
pub use import::import;
pub use map::map;
pub use pose::pose;
pub use run::{run, watch};
pub use shell::{completions, manual, schema};
pub use sweep::sweep;
