//! The kinds of machine that kernels are compiled for.

use pulp::Simd;

use super::kernel::{LaneKernels, Table};

/// A kind of machine; a value of the type exists only where the machine is of that kind.
pub trait Level: Simd {
    /// Has the alignment of a register: numbers over lanes that lie across two cache lines cost twice.
    type Align: Copy + Send + Sync + 'static;

    /// The kernels compiled for it.
    fn table(kernels: &LaneKernels) -> Table<Self>;
}

macro_rules! levels {
    ($($(#[$when:meta])* $token:ty, $field:ident, $align:ident, $bytes:literal;)*) => {$(
        /// As long as a register.
        $(#[$when])*
        #[derive(Clone, Copy)]
        #[repr(align($bytes))]
        pub struct $align;

        $(#[$when])*
        impl Level for $token {
            type Align = $align;

            fn table(kernels: &LaneKernels) -> Table<Self> {
                kernels.$field
            }
        }
    )*};
}

levels! {
    #[cfg(target_arch = "x86_64")] pulp::x86::V4, v4, Align64, 64;
    #[cfg(target_arch = "x86_64")] pulp::x86::V3, v3, Align32, 32;
    #[cfg(target_arch = "aarch64")] pulp::aarch64::Neon, neon, Align16, 16;
    pulp::Scalar, scalar, Align8, 8;
}
