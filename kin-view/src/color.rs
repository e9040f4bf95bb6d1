//! Defines colours that colour-blind readers can distinguish.

/// Blue, vermilion, green, purple, orange, sky blue (Okabe and Ito), brown, violet.
pub(crate) const PALETTE: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6239", "#7b68c8"];
