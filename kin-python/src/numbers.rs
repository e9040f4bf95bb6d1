//! Numbers on their way between NumPy and Kin: lists of f64 as bytes in the machine's order, which
//! `numpy.frombuffer` reads where they lie.

use kin::{Vec2, Vec3};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault;

/// Bytes of a list of f64.
const SIZE: usize = size_of::<f64>();

/// The numbers in these bytes. Errors: a length that no list of f64 has.
pub fn read(bytes: &[u8]) -> PyResult<Vec<f64>> {
    let chunks = bytes.chunks_exact(SIZE);
    if !chunks.remainder().is_empty() {
        return Err(fault::value("the bytes are no list of 64-bit numbers"));
    }
    Ok(chunks.map(|chunk| f64::from_ne_bytes(chunk.try_into().unwrap_or_default())).collect())
}

/// `count` numbers as bytes, from lists one after the other.
pub fn written<'py, 'a>(
    py: Python<'py>,
    count: usize,
    lists: impl IntoIterator<Item = &'a [f64]>,
) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, count * SIZE, |bytes| {
        let mut places = bytes.chunks_exact_mut(SIZE);
        for (number, place) in lists.into_iter().flatten().zip(&mut places) {
            place.copy_from_slice(&number.to_ne_bytes());
        }
        Ok(())
    })
}

/// One list as bytes.
pub fn list<'py>(py: Python<'py>, numbers: &[f64]) -> PyResult<Bound<'py, PyBytes>> {
    written(py, numbers.len(), [numbers])
}

pub fn vec2([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

pub fn vec3([x, y, z]: [f64; 3]) -> Vec3 {
    Vec3::new(x, y, z)
}
