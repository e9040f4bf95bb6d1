//! Where messages are read: advice names a call of Rust, a keyword of Python or a flag of the command.

use std::sync::atomic::{AtomicU8, Ordering};

/// Where messages are read. A program keeps [`Surface::Rust`]; the wheel and the command choose theirs once,
/// when they start ([`Surface::choose`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Surface {
    /// Names of the crate, such as `Options::closure(1e-8)`.
    #[default]
    Rust,
    /// Names of the wheel, such as `closure=1e-8`.
    Python,
    /// Flags of the command, such as `--closure 1e-8`.
    Command,
}

static CHOSEN: AtomicU8 = AtomicU8::new(Surface::Rust as u8);

impl Surface {
    /// Makes all messages of this process speak to these readers.
    pub fn choose(self) {
        CHOSEN.store(self as u8, Ordering::Relaxed);
    }

    /// The readers of this process.
    pub fn chosen() -> Surface {
        match CHOSEN.load(Ordering::Relaxed) {
            1 => Surface::Python,
            2 => Surface::Command,
            _ => Surface::Rust,
        }
    }

    /// How a closure error is allowed.
    pub(crate) fn closure(self, share: f64) -> String {
        match self {
            Surface::Rust => format!("`Options::closure({share:e})`"),
            Surface::Python => format!("`run(times, closure={share:e})`"),
            Surface::Command => format!("`--closure {share:e}`"),
        }
    }

    /// Where the motion before a failure is.
    pub(crate) fn motion_before(self, until: &str) -> String {
        match self {
            Surface::Rust => format!("The motion up to t = {until} is in this error: `error.motion()`."),
            Surface::Python => format!("The motion up to t = {until} is in this error: `error.motion`."),
            Surface::Command => format!("The files hold the motion up to t = {until}."),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_surface_has_its_words() {
        let words = [Surface::Rust, Surface::Python, Surface::Command].map(|surface| surface.closure(3e-8));
        assert_eq!(words, ["`Options::closure(3e-8)`", "`run(times, closure=3e-8)`", "`--closure 3e-8`"]);
    }
}
