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

/// A list as bytes.
pub fn list<'py>(py: Python<'py>, numbers: &[f64]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, numbers.len() * SIZE, |bytes| {
        for (place, number) in bytes.chunks_exact_mut(SIZE).zip(numbers) {
            place.copy_from_slice(&number.to_ne_bytes());
        }
        Ok(())
    })
}

pub fn vec2([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

pub fn vec3([x, y, z]: [f64; 3]) -> Vec3 {
    Vec3::new(x, y, z)
}
