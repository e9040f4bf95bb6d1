//! Defines the positions at which the numbers of an argument begin.

/// The positions at which the state and the velocities of one argument of a constraint begin, in
/// the lists of all arguments.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Offsets {
    /// The index of the first number of the state.
    pub state: u32,
    /// The index of the first velocity.
    pub rates: u32,
}

impl Offsets {
    /// Creates the offsets of an argument.
    pub const fn new(state: u32, rates: u32) -> Self {
        Offsets { state, rates }
    }
}
