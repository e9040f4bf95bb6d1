//! The positions at which the numbers of an argument begin.

/// The positions at which the state and the rates of one argument of a constraint begin, among
/// those of all arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Offsets {
    /// Index of the first number of the state.
    pub state: u32,
    /// Index of the first rate.
    pub rates: u32,
}

impl Offsets {
    /// Makes the offsets of an argument.
    pub const fn new(state: u32, rates: u32) -> Self {
        Offsets { state, rates }
    }
}
