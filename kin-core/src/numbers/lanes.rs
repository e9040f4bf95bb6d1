//! Numbers over the lanes of SIMD registers: several times of a run at once.
//!
//! `pulp` finds out at run time what the machine has (AVX-512: 8 lanes, AVX2 with FMA: 4, Neon: 2) and holds
//! whatever is unsafe about it: its tokens exist only where the instructions do. Code is generic over the
//! token.

pub(crate) mod lanewise;
mod level;
mod number;
mod trig;

pub use level::Level;
pub(crate) use number::whole;
pub use number::{Mask, Wide};

/// The registers in which a program computes many times of a run, or of each case of a sweep, at once: two
/// of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lanes {
    /// The widest that the machine has.
    #[default]
    Best,
    /// None: plain steps, one time after the other.
    Off,
    /// Registers of so many lanes: 8 (AVX-512), 4 (AVX2 with FMA) or 2 (Neon).
    Only(usize),
}

/// Something that is done with the widest lanes, or with those that are asked for.
pub(crate) trait WithLevel {
    type Output;
    fn run<S: Level>(self, simd: S) -> Self::Output;
}

/// Nothing, to find out whether there are lanes.
struct Nothing;

impl WithLevel for Nothing {
    type Output = ();

    fn run<S: Level>(self, _: S) {}
}

impl Lanes {
    /// True if the machine has the lanes that are meant.
    pub(crate) fn are_there(self) -> bool {
        self.dispatch(Nothing).is_ok()
    }

    /// Does it with the lanes that are meant; gives it back where the machine does not have them, or none are
    /// wanted.
    pub(crate) fn dispatch<W: WithLevel>(self, work: W) -> Result<W::Output, W> {
        let wanted = |lanes: usize| self == Lanes::Best || self == Lanes::Only(lanes);
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new().filter(|_| wanted(8)) {
                return Ok(work.run(simd));
            }
            if let Some(simd) = pulp::x86::V3::try_new().filter(|_| wanted(4)) {
                return Ok(work.run(simd));
            }
        }
        #[cfg(target_arch = "aarch64")]
        if let Some(simd) = pulp::aarch64::Neon::try_new().filter(|_| wanted(2)) {
            return Ok(work.run(simd));
        }
        let _ = wanted;
        Err(work)
    }
}
