//! Colours told apart by every eye.

/// Blue, vermilion, green, purple, orange, sky blue (Okabe and Ito).
pub(crate) const PALETTE: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
