//! Encodes a column of numbers in few characters: as whole multiples of a step, with second
//! differences, seven bits in each byte, and base64.
//!
//! A smooth motion needs about one byte for each number. The function `column` in `assets/data.js`
//! decodes the column.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Finest steps that a range is cut into, whatever is asked for: 2⁴⁰, far below what a page can
/// show.
const MOST_STEPS: f64 = (1_u64 << 40) as f64;
/// Values that are not below this are not shown: differences of larger numbers may not be numbers.
const LARGEST: f64 = 1e300;

/// The column, each number within half a `step` of what it was (coarser if the range is more than
/// 2⁴⁰ steps); what is not finite, or beyond 10³⁰⁰, is a gap.
pub(super) fn packed(values: &[f64], step: f64) -> Value {
    let is_shown = |x: &f64| x.abs() < LARGEST;
    let (low, high) = values
        .iter()
        .copied()
        .filter(is_shown)
        .fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
    let range = (high - low).max(0.0);
    let step = if step > 0.0 && step.is_finite() { step } else { 1.0 }.max(range / MOST_STEPS);
    let offset = if low > high { 0.0 } else { low };
    let mut bytes = Vec::with_capacity(values.len());
    let mut last = 0_i64;
    let mut slope = 0_i64;
    let mut count = 0_usize;
    for x in values {
        if !is_shown(x) {
            bytes.push(0);
            (last, slope, count) = (0, 0, 0);
            continue;
        }
        let whole = ((x - offset) / step).round() as i64;
        let change = if count == 0 { whole } else { whole - last - slope };
        slope = if count == 0 { 0 } else { whole - last };
        (last, count) = (whole, count + 1);
        write(&mut bytes, change);
    }
    json!({ "o": offset, "s": step, "d": STANDARD.encode(bytes) })
}

/// Zigzag plus one, the lowest seven bits first.
fn write(bytes: &mut Vec<u8>, change: i64) {
    let mut code = ((change << 1) ^ (change >> 63)) as u64 + 1;
    while code > 127 {
        bytes.push((code & 127) as u8 | 128);
        code >>= 7;
    }
    bytes.push(code as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unpacks a column as the page's script does.
    fn unpacked(packed: &Value) -> Vec<f64> {
        let bytes = STANDARD.decode(packed["d"].as_str().unwrap()).unwrap();
        let offset = packed["o"].as_f64().unwrap();
        let step = packed["s"].as_f64().unwrap();
        let mut values = Vec::new();
        let mut at = 0;
        let mut last = 0.0;
        let mut slope = 0.0;
        let mut known = 0;
        while at < bytes.len() {
            let mut code = 0.0;
            let mut factor = 1.0;
            loop {
                code += f64::from(bytes[at] & 127) * factor;
                factor *= 128.0;
                at += 1;
                if bytes[at - 1] < 128 {
                    break;
                }
            }
            if code == 0.0 {
                values.push(f64::NAN);
                known = 0;
                continue;
            }
            code -= 1.0;
            let change = if code % 2.0 == 1.0 { -(code + 1.0) / 2.0 } else { code / 2.0 };
            slope = match known {
                0 => 0.0,
                1 => change,
                _ => slope + change,
            };
            last = if known == 0 { change } else { last + slope };
            known += 1;
            values.push(offset + step * last);
        }
        values
    }

    fn comes_back(values: &[f64], step: f64, tolerance: f64) -> usize {
        let packed = packed(values, step);
        let back = unpacked(&packed);
        assert_eq!(back.len(), values.len());
        for (x, y) in values.iter().zip(back) {
            assert!(
                if x.abs() < LARGEST { (x - y).abs() <= tolerance } else { y.is_nan() },
                "{x} became {y}"
            );
        }
        packed["d"].as_str().unwrap().len()
    }

    #[test]
    fn a_motion_of_ten_thousand_frames_is_small() {
        let values: Vec<f64> = (0..10_000)
            .map(|k| (f64::from(k) * 0.002).sin() + 0.3 * (f64::from(k) * 0.011).cos())
            .collect();
        let size = comes_back(&values, 1e-6, 0.51e-6);
        assert!(size < 20_000, "{size}");
    }

    #[test]
    fn gaps_and_awkward_numbers_come_back() {
        let nan = f64::NAN;
        let inf = f64::INFINITY;
        comes_back(&[], 1e-6, 0.0);
        comes_back(&[nan, nan], 1e-6, 0.0);
        comes_back(&[nan, 1.0, 2.0, 4.0, inf, -3.0, nan, nan, 0.5, 0.25], 1e-6, 1e-6);
        comes_back(&[5.0; 7], 1e-6, 0.0);
        comes_back(&[0.0, 1e12, -1e12], 1e-6, 3.0);
        comes_back(&[0.0, 1e-300, -1e-300], 1e-306, 1e-305);
        comes_back(&[f64::MAX, f64::MIN, 0.0], 1.0, 0.0);
        comes_back(&[9e299, -9e299, 0.0], 1.0, 1e288);
        comes_back(&[1.0, 2.0], 0.0, 1.0);
    }
}
