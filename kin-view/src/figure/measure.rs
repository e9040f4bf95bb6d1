//! Scales numbers of any size for an axis.

/// Numbers beyond this are brought nearer before they are drawn: differences of larger ones may be
/// no numbers.
pub const SANE: f64 = 1e100;

/// How numbers are brought onto an axis.
#[derive(Clone, Copy, PartialEq)]
pub enum Measure {
    /// Numbers as they are.
    Plain,
    /// In units of 10^k, which the label says.
    Power(i32),
    /// By their logarithm to the base 10: on a logarithmic axis that is too long to have a tick for
    /// each power of ten.
    Logarithm,
}

impl Measure {
    pub fn of(numbers: impl Iterator<Item = f64>) -> Measure {
        let largest = numbers.filter(|x| x.is_finite()).fold(0.0_f64, |size, x| size.max(x.abs()));
        let plain = largest == 0.0 || (SANE.recip()..=SANE).contains(&largest);
        if plain { Measure::Plain } else { Measure::Power(largest.log10().floor() as i32) }
    }

    pub fn of_number(self, x: f64) -> f64 {
        match self {
            Measure::Plain => x,
            // In two steps: 10^k itself may be too small for a number.
            Measure::Power(k) => x / 10f64.powi(k / 2) / 10f64.powi(k - k / 2),
            Measure::Logarithm => x.log10(),
        }
    }

    pub fn label(self, text: &str) -> String {
        match self {
            Measure::Plain => text.to_string(),
            Measure::Power(k) => format!("{text} · 1e{k}"),
            Measure::Logarithm => format!("log₁₀ {text}"),
        }
    }
}
