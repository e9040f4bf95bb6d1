//! Defines the instruction sets for which numbers over lanes are compiled.

use pulp::Simd;

/// An instruction set; a value of the type exists only on a machine with this instruction set.
pub trait Level: Simd {
    /// Has the alignment of a register: numbers over lanes that lie across two cache lines cost
    /// twice.
    type Align: Copy + Send + Sync + 'static;

    /// Returns the transpose of a 4 × 4 matrix, in registers if the machine supports it.
    #[inline(always)]
    fn turn(self, square: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
        let [a, b, c, d] = square;
        [
            [a[0], b[0], c[0], d[0]],
            [a[1], b[1], c[1], d[1]],
            [a[2], b[2], c[2], d[2]],
            [a[3], b[3], c[3], d[3]],
        ]
    }
}

/// By the shuffles of AVX.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn shuffle(simd: pulp::x86::V3, square: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    pulp::cast(simd.deinterleave_shfl_f64s(pulp::cast::<_, [pulp::f64x4; 4]>(square)))
}

macro_rules! levels {
    ($($(#[$when:meta])* $token:ty, $align:ident, $bytes:literal $(, $avx:expr)?;)*) => {$(
        /// As long as a register.
        $(#[$when])*
        #[derive(Clone, Copy)]
        #[repr(align($bytes))]
        pub struct $align;

        $(#[$when])*
        impl Level for $token {
            type Align = $align;
            $(
                #[inline(always)]
                fn turn(self, square: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
                    let avx: fn(Self) -> pulp::x86::V3 = $avx;
                    shuffle(avx(self), square)
                }
            )?
        }
    )*};
}

levels! {
    #[cfg(target_arch = "x86_64")] pulp::x86::V4, Align64, 64, |v4| *v4;
    #[cfg(target_arch = "x86_64")] pulp::x86::V3, Align32, 32, |v3| v3;
    #[cfg(target_arch = "x86_64")] pulp::x86::V3_128b, Align16, 16, |half| half.0;
    #[cfg(target_arch = "aarch64")] pulp::aarch64::Neon, Align16, 16;
}
