//! Defines numbers over the lanes of SIMD registers: one operation computes several times of a run.
//!
//! The crate `pulp` detects the registers of the machine at run time (AVX-512: 8 lanes, AVX2 with
//! FMA: 4, Neon: 2) and contains the unsafe code. A token of `pulp` exists only if the machine has
//! the instructions. The code of this module is generic over the token.

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

/// The values of the variable: the number of times that are computed at once in two registers, and
/// the lanes of one register.
const VALUES: [(&str, usize); 4] = [("16", 8), ("8", 4), ("4", 2), ("off", 0)];

/// The SIMD registers in which a compiled program computes many times of a run or of a case at
/// once.
///
/// A program uses two registers. The environment variable `KIN_LANES` limits the registers, for
/// tests that need the results of another machine. The value `16`, `8` or `4` is the largest number
/// of times at once; `off` disables programs. With any other value the run returns an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lanes {
    /// The widest registers of the machine.
    #[default]
    Best,
    /// No registers: the step-by-step solver computes one time after the other.
    Off,
    /// Registers with this number of lanes: 8 (AVX-512), 4 (AVX2 with FMA) or 2 (Neon, or half
    /// registers of AVX2).
    Only(usize),
}

/// A task that runs with the widest lanes or with the selected ones.
pub(crate) trait WithLevel {
    type Output;
    fn run<S: Level>(self, simd: S) -> Self::Output;
}

/// An empty task, which finds out whether the machine has the lanes.
struct Nothing;

impl WithLevel for Nothing {
    type Output = ();

    fn run<S: Level>(self, _: S) {}
}

impl Lanes {
    /// Returns true if the machine has the selected lanes.
    pub(crate) fn are_there(self) -> bool {
        self.dispatch(Nothing).is_ok()
    }

    /// Runs the task with the selected lanes. The function returns the task as the error if the
    /// machine does not have the lanes, or if the selection is [`Lanes::Off`].
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

/// Returns the largest number of lanes of a register that the environment allows, or the error in
/// the variable. The first call reads the variable; later calls return the same.
pub(crate) fn limit() -> &'static Result<usize, String> {
    static LIMIT: OnceLock<Result<usize, String>> = OnceLock::new();
    LIMIT.get_or_init(|| {
        std::env::var_os(VARIABLE)
            .map_or(Ok(usize::MAX), |value| limit_of(&value.to_string_lossy()))
    })
}

/// Returns the limit for one value of the variable.
fn limit_of(value: &str) -> Result<usize, String> {
    let known = VALUES.iter().find(|(name, _)| *name == value).map(|(_, lanes)| *lanes);
    known.ok_or_else(|| {
        let all = VALUES.map(|(name, _)| format!("`{name}`")).join(", ");
        format!(
            "the environment variable {VARIABLE} is `{value}`. Set {VARIABLE} to one of {all}, or remove {VARIABLE} to use the widest registers of the machine"
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
