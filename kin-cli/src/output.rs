//! Where data go: a file, or the standard output for `-`.

use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use crate::fault::Fault;

/// Has `write` write to the file of that name, making folders that are missing, or to the standard
/// output.
///
/// Errors: a file that cannot be written, by its path; a pipe that nobody reads any more.
pub fn put(to: &str, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Fault> {
    let written = if to == "-" { to_stdout(write) } else { to_file(Path::new(to), write) };
    written.map_err(|error| failed(to, &error))
}

/// The fault of writing there.
pub fn failed(to: &str, error: &io::Error) -> Fault {
    match error.kind() {
        ErrorKind::BrokenPipe if to == "-" => Fault::Pipe,
        _ if to == "-" => Fault::File(format!("cannot write to standard output: {error}")),
        _ => Fault::File(format!("cannot write {to}: {error}")),
    }
}

/// The same place, to be written to part by part.
pub fn open(to: &str) -> Result<Box<dyn Write>, Fault> {
    let opened: io::Result<Box<dyn Write>> = if to == "-" {
        Ok(Box::new(io::stdout()))
    } else {
        create(Path::new(to)).map(|file| Box::new(file) as _)
    };
    Ok(Box::new(BufWriter::new(opened.map_err(|error| failed(to, &error))?)))
}

fn to_stdout(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut to = BufWriter::new(io::stdout().lock());
    write(&mut to)?;
    to.flush()
}

fn to_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut to = BufWriter::new(create(path)?);
    write(&mut to)?;
    to.flush()
}

fn create(path: &Path) -> io::Result<File> {
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder)?;
    }
    File::create(path)
}

/// The system's own reason, of which the conversion that `csv` has would lose the kind.
pub fn reason(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(reason) => reason,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// A header or a text of a table as spreadsheets may read it: one that begins as a formula does
/// (`=`, `+`, `-`, `@`, a tab, a carriage return) is written with `'` before it.
pub fn as_text(text: &str) -> String {
    let is_formula = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    if is_formula { format!("'{text}") } else { text.to_string() }
}

/// The name that a header stands for: without the `'` that [`as_text`] puts before it.
pub fn of_text(header: &str) -> &str {
    header.strip_prefix('\'').filter(|name| as_text(name) == header).unwrap_or(header)
}

/// Writes a table of names and numbers as CSV.
pub fn table(
    to: &str,
    header: &[String],
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<(), Fault> {
    put(to, |to| {
        let mut table = csv::Writer::from_writer(to);
        table.write_record(header.iter().map(|name| as_text(name))).map_err(reason)?;
        for row in rows {
            table.write_record(&row).map_err(reason)?;
        }
        table.flush()
    })
}

/// 17 significant digits, as in the CSV of motions.
pub fn digits(value: f64) -> String {
    // −0 + 0 is 0, which reads better.
    format!("{:.16e}", value + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_no_formula_of_a_spreadsheet() {
        for name in ["=a.x", "+a", "-a", "@a", "\ta", "\ra"] {
            assert_eq!(as_text(name), format!("'{name}"));
        }
        for name in ["a.x", "'a", "a=b", "", "'=a"] {
            assert_eq!(as_text(name), name);
        }
        // Names of a table of cases are read as a table of results has them.
        for name in ["=a.x", "-a", "a.x", "'a"] {
            assert_eq!(of_text(&as_text(name)), name);
        }
    }
}
