//! Numbers over the lanes of SIMD registers: several times of a run at once.
//!
//! `pulp` finds out at run time what the machine has (AVX-512: 8 lanes, AVX2 with FMA: 4, Neon: 2)
//! and holds whatever is unsafe about it: its tokens exist only where the instructions do. Code is
//! generic over the token.

pub(crate) mod lanewise;
mod level;
mod number;
mod trig;

pub use level::Level;
pub(crate) use number::whole;
pub use number::{Mask, Wide};

use std::sync::OnceLock;

/// The environment variable that limits lanes: see [`Lanes`].
const VARIABLE: &str = "KIN_LANES";

/// Its values: how many times are computed at once, in two registers of half as many lanes.
const VALUES: [(&str, usize); 4] = [("16", 8), ("8", 4), ("4", 2), ("off", 0)];

/// The registers in which a program computes many times of a run, or of each case of a sweep, at
/// once: two of them.
///
/// The environment variable `KIN_LANES` limits all of them, for tests of what another machine would
/// compute: `16`, `8` or `4` times at once at most, or `off`. Any other value is an error of the
/// run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lanes {
    /// The widest that the machine has.
    #[default]
    Best,
    /// None: plain steps, one time after the other.
    Off,
    /// Registers of so many lanes: 8 (AVX-512), 4 (AVX2 with FMA) or 2 (Neon, or half registers of
    /// AVX2).
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

    /// Does it with the lanes that are meant; gives it back where the machine does not have them,
    /// or none are wanted.
    pub(crate) fn dispatch<W: WithLevel>(self, work: W) -> Result<W::Output, W> {
        let most = limit().as_ref().map_or(0, |most| *most);
        let wanted =
            |lanes: usize| lanes <= most && (self == Lanes::Best || self == Lanes::Only(lanes));
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = pulp::x86::V4::try_new().filter(|_| wanted(8)) {
                return Ok(work.run(simd));
            }
            if let Some(simd) = pulp::x86::V3::try_new().filter(|_| wanted(4)) {
                return Ok(work.run(simd));
            }
            if let Some(simd) = pulp::x86::V3::try_new().filter(|_| wanted(2)) {
                return Ok(work.run(pulp::x86::V3_128b(simd)));
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

/// The most lanes of a register that the environment allows, as it was when lanes were first
/// chosen; what is wrong with the variable, if something is.
pub(crate) fn limit() -> &'static Result<usize, String> {
    static LIMIT: OnceLock<Result<usize, String>> = OnceLock::new();
    LIMIT.get_or_init(|| {
        std::env::var_os(VARIABLE)
            .map_or(Ok(usize::MAX), |value| limit_of(&value.to_string_lossy()))
    })
}

/// The same for a value of the variable.
fn limit_of(value: &str) -> Result<usize, String> {
    let known = VALUES.iter().find(|(name, _)| *name == value).map(|(_, lanes)| *lanes);
    known.ok_or_else(|| {
        let all = VALUES.map(|(name, _)| format!("`{name}`")).join(", ");
        format!(
            "the environment variable {VARIABLE} is `{value}`, which is no number of times that a program \
             computes at once; set it to one of {all}, or remove it to use the widest registers of the machine"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_one_of_four_and_any_other_is_named_with_them() {
        let all = VALUES.map(|(name, _)| limit_of(name));
        assert_eq!(all, [Ok(8), Ok(4), Ok(2), Ok(0)]);
        for wrong in ["", "32", "Off", "2 "] {
            let words = limit_of(wrong).expect_err("no width");
            assert!(words.contains(&format!("KIN_LANES is `{wrong}`")), "{words}");
            assert!(words.contains("`16`, `8`, `4`, `off`"), "{words}");
        }
    }
}
