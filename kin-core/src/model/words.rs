//! Writes numbers, times and lists of names for messages.

use crate::model::units::Units;

/// "3 equations", "1 equation".
pub(crate) fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

/// "2.4 GB", to three digits.
pub(crate) fn bytes(n: f64) -> String {
    let units = [(1e12, "TB"), (1e9, "GB"), (1e6, "MB"), (1e3, "kB")];
    let (size, unit) = units.into_iter().find(|(size, _)| n >= *size).unwrap_or((1.0, "bytes"));
    let digits = 2 - ((n / size).max(1.0).log10().floor() as usize).min(2);
    format!("{:.digits$} {unit}", n / size)
}

/// Rounds a time to nine digits, without the noise of binary fractions.
pub(crate) fn time(t: f64) -> f64 {
    format!("{t:.8e}").parse().unwrap_or(t)
}

/// A time with its unit: "0.31 s".
pub(crate) fn at(t: f64, units: &Units) -> String {
    format!("{} {}", time(t), units.time())
}

/// " row y", or nothing for a constraint of one row.
pub(crate) fn row(row: &str) -> String {
    if row.is_empty() { String::new() } else { format!(" row {row}") }
}

/// "`a`, `b` and 3 more".
pub(crate) fn list(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let quoted: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let all = quoted.join(", ");
    if names.len() > SHOWN { format!("{all} and {} more", names.len() - SHOWN) } else { all }
}
