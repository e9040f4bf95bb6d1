//! `kin emit`: a mechanism as a file of C.

use kin::emit::{self, Options};

use crate::arguments::Emit;
use crate::fault::Fault;
use crate::{model, output};

/// Prints the mechanism and writes the file.
pub fn emit(asked: &Emit) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let options = Options {
        name: asked.name.clone(),
        free: asked.free.clone(),
        measures: asked.measures.clone(),
        t0: asked.at,
    };
    let text = emit::c(&system, &options).map_err(Fault::asked)?;
    output::put(&asked.output, |to| to.write_all(text.as_bytes()))
}
