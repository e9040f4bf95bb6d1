//! Writes a motion as a CSV table.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use super::{MARKS, Motion};
use crate::outcome::error::{Error, Result};

/// Calls `write` to write a file, and creates missing folders.
///
/// Errors: Kin cannot write the folder or file; the error contains the path.
pub(crate) fn to_file(
    path: &Path,
    write: impl FnOnce(BufWriter<File>) -> std::io::Result<()>,
) -> Result<()> {
    let written = || {
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)?;
        }
        write(BufWriter::new(File::create(path)?))
    };
    written().map_err(|source| Error::File { path: path.to_path_buf(), source })
}

/// Protects a header or another text of a table from spreadsheets, which compute a text that begins
/// with `=`, `+`, `-`, `@`, a tab or a carriage return as a formula. Such a text gets a leading
/// `'`.
pub(crate) fn as_text(text: String) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) { format!("'{text}") } else { text }
}

impl Motion {
    /// Writes the motion as a CSV file and creates missing folders.
    ///
    /// The columns are t, all q, all q̇, all q̈ (and all q⃛ if the run computed the jerk) in the
    /// order of the coordinates, and the derived quantities. Headers are `t [s]`, `crank.R_x [m]`,
    /// `crank.R_x' [m/s]`, `crank.R_x'' [m/s^2]`, `crank.R_x''' [m/s^3]`. Numbers have 17
    /// significant digits. If a header begins like a formula of a spreadsheet (`=`, `+`, `-`, `@`),
    /// Kin writes `'` before it.
    ///
    /// Errors: Kin cannot write the folder or file; the error contains the path.
    pub fn write_csv(&self, path: impl AsRef<Path>) -> Result<()> {
        to_file(path.as_ref(), |to| self.write_csv_to(to))
    }

    /// Writes the table of [`Motion::write_csv`] to a writer, such as standard output.
    ///
    /// Errors: those of the writer.
    pub fn write_csv_to(&self, to: impl Write) -> std::io::Result<()> {
        let mut table = csv::Writer::from_writer(to);
        self.table(&mut table)?;
        table.flush()
    }

    /// Writes the header and the rows.
    fn table(&self, table: &mut csv::Writer<impl Write>) -> std::io::Result<()> {
        table.write_record(self.headers().into_iter().map(as_text)).map_err(reason)?;
        let mut text = String::new();
        for k in 0..self.len() {
            let outputs = self.outputs().iter().filter_map(|output| output.values().get(k));
            let row = self
                .times()
                .get(k)
                .into_iter()
                .chain(self.q(k))
                .chain(self.qd(k))
                .chain(self.qdd(k))
                .chain(self.qddd(k))
                .chain(outputs);
            for value in row {
                text.clear();
                digits(&mut text, *value);
                table.write_field(&text).map_err(reason)?;
            }
            table.write_record(None::<&[u8]>).map_err(reason)?;
        }
        Ok(())
    }

    /// Returns the header of each column of the CSV table.
    pub fn headers(&self) -> Vec<String> {
        let mut all = vec![format!("t [{}]", self.unit_words().time())];
        let orders = if self.has_jerk() { 4 } else { 3 };
        for (order, mark) in MARKS.into_iter().enumerate().take(orders) {
            let coordinates = self.layout.names.iter().enumerate();
            all.extend(coordinates.map(|(column, name)| {
                format!("{name}{mark} [{}]", self.layout.unit(column, order))
            }));
        }
        all.extend(
            self.outputs().iter().map(|output| format!("{} [{}]", output.name(), output.unit())),
        );
        all
    }
}

/// Returns the reason of the operating system. The conversion of `csv` would lose its kind.
pub(crate) fn reason(error: csv::Error) -> std::io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(reason) => reason,
        other => std::io::Error::other(format!("{other:?}")),
    }
}

/// Writes 17 significant digits: enough to read the same number back.
fn digits(text: &mut String, value: f64) {
    use std::fmt::Write;
    // −0 + 0 is 0, which reads better. Writing to a String does not fail.
    let _ = write!(text, "{:.16e}", value + 0.0);
}

#[cfg(test)]
mod tests {
    use crate::joints::drivers::drive;
    use crate::{Law, Mechanism};

    #[test]
    fn a_header_is_no_formula_of_a_spreadsheet() {
        let mut m = Mechanism::new("m");
        for (k, name) in ["=1+1", "+a", "-b", "@SUM(A1)", "plain", "a=b"].into_iter().enumerate() {
            let x = m.length(name, 0.0).unwrap();
            m.add(&format!("d{k}"), drive(x, Law::constant(-1.0))).unwrap();
        }
        let motion = m.build().unwrap().run([0.0]).unwrap();
        let mut table = Vec::new();
        motion.write_csv_to(&mut table).unwrap();
        let text = String::from_utf8(table).unwrap();
        let header = text.lines().next().unwrap();
        assert!(
            header.starts_with(
                "t [s],'=1+1 [m],'+a [m],'-b [m],'@SUM(A1) [m],plain [m],a=b [m],'=1+1' [m/s],"
            ),
            "{header}"
        );
        // Names stay what they are, and so do numbers below zero.
        assert_eq!(motion.headers()[1], "=1+1 [m]");
        assert!(text.lines().nth(1).unwrap().contains(",-1.0000000000000000e0,"), "{text}");
    }
}
