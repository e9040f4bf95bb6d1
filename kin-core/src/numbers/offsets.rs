//! Where the numbers of an argument begin.

/// Where the state and the rates of one argument of a constraint begin, among those of all.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Offsets {
    /// Number of the first number of its state.
    pub state: u32,
    /// Number of its first rate.
    pub rates: u32,
}

impl Offsets {
    /// The offsets of an argument.
    pub const fn new(state: u32, rates: u32) -> Self {
        Offsets { state, rates }
    }
}
