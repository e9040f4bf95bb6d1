//! Files of other programs.

use crate::arguments::Import;
use crate::fault::Fault;
use crate::model::{named, text};
use crate::output;
use crate::say::Say;

/// Makes a mechanism file of a file of another program. Notes say what is left out, and at which
/// times the other program solves it.
pub fn import(asked: &Import, say: &Say) -> Result<(), Fault> {
    let imported = kin_import::asmt(&text(&asked.file)?)
        .map_err(|mistake| Fault::File(format!("{}: {mistake}", named(&asked.file))))?;
    let data = imported.mechanism.data()?;
    output::put(&asked.output, |to| {
        serde_json::to_writer_pretty(&mut *to, &data)?;
        to.write_all(b"\n")
    })?;
    imported.left_out.iter().for_each(|left| say.note(&left.to_string()));
    if let [first, .., last] = imported.times.as_slice() {
        say.note(&format!("its times: --times {first}:{last}:{}", imported.times.len()));
    }
    Ok(())
}
