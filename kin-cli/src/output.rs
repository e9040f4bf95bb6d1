//! Where data go: a file, or the standard output for `-`.

use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use crate::fault::Fault;

/// Has `write` write to the file of that name, making folders that are missing, or to the standard output.
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
        _ if to == "-" => Fault::File(format!("cannot write to the standard output: {error}")),
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

/// Writes a table as CSV.
pub fn table(to: &str, header: &[String], rows: impl Iterator<Item = Vec<String>>) -> Result<(), Fault> {
    put(to, |to| {
        let mut table = csv::Writer::from_writer(to);
        table.write_record(header).map_err(reason)?;
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
