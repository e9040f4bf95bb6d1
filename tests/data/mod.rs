//! Reading the reference data of this folder; README.md says what it is.

pub mod model;

use serde_json::Value;

/// One of the files, by its name without `.json`.
pub fn read(name: &str) -> Value {
    let path = format!("{}/tests/data/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The number in a field.
pub fn number(of: &Value, field: &str) -> f64 {
    of[field].as_f64().unwrap_or_else(|| panic!("no number `{field}` in {of}"))
}

/// The list of numbers in a field, of whatever length.
pub fn numbers(of: &Value, field: &str) -> Vec<f64> {
    list(&of[field]).unwrap_or_else(|| panic!("no numbers `{field}` in {of}"))
}

/// The list of N numbers in a field.
pub fn array<const N: usize>(of: &Value, field: &str) -> [f64; N] {
    numbers(of, field)
        .try_into()
        .unwrap_or_else(|_| panic!("`{field}` has not {N} numbers in {of}"))
}

/// The rows of numbers in a field.
pub fn rows(of: &Value, field: &str) -> Vec<Vec<f64>> {
    let rows = of[field].as_array().unwrap_or_else(|| panic!("no rows `{field}` in {of}"));
    rows.iter()
        .map(|row| list(row).unwrap_or_else(|| panic!("`{field}` has a row that is none: {row}")))
        .collect()
}

fn list(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// max |found − exact| / (1 + max |exact|); infinite where lengths differ or a number is none.
pub fn error(found: &[f64], exact: &[f64]) -> f64 {
    let size = exact.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let worst = found
        .iter()
        .zip(exact)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0_f64, |m, d| if d.is_nan() { f64::INFINITY } else { m.max(d) });
    if found.len() == exact.len() && !found.is_empty() {
        worst / (1.0 + size)
    } else {
        f64::INFINITY
    }
}
