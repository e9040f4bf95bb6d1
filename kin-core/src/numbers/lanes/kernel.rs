//! Kernels over lanes: what `#[constraint(lanes)]` emits, and the compiled copies for each kind of machine.

use std::marker::PhantomData;

use pulp::NullaryFnOnce;

use super::Level;
use super::number::Wide;
use crate::numbers::Offsets;

/// The numbers that all constraints read at one instant, for several mechanisms.
pub struct LaneInstant<'a, S: Level> {
    pub(crate) simd: S,
    /// States of bodies and bare coordinates, each of them once.
    pub(crate) states: &'a [Wide<S>],
    /// Rates of coordinates, then those of the ground.
    pub(crate) rates: &'a [Wide<S>],
    /// The numbers that [`InLanes`] has made of parameters and of the time.
    pub(crate) known: &'a [Wide<S>],
    /// Of every argument, where its state and its rates begin.
    pub(crate) arguments: &'a [Offsets],
    /// Each constraint in every lane.
    pub(crate) own: &'a [Vec<&'a dyn InLanes>],
}

/// Where the numbers of one constraint begin among those of all, and which one it is.
#[derive(Clone, Copy, Debug)]
pub struct LaneBlock {
    pub(crate) number: u32,
    pub(crate) arguments: u32,
    pub(crate) known: u32,
    pub(crate) rows: u32,
    pub(crate) values: u32,
}

/// The instant as the kernels of one constraint see it, for several mechanisms.
#[derive(Clone, Copy)]
pub struct LaneAt<'a, S: Level> {
    /// The machine's instructions.
    pub simd: S,
    states: &'a [Wide<S>],
    known: &'a [Wide<S>],
    arguments: &'a [Offsets],
    own: &'a [Vec<&'a dyn InLanes>],
    block: LaneBlock,
}

impl<'a, S: Level> LaneInstant<'a, S> {
    #[inline(always)]
    fn at(&self, block: &LaneBlock) -> LaneAt<'a, S> {
        let LaneInstant { simd, states, known, arguments, own, .. } = *self;
        LaneAt { simd, states, known, arguments, own, block: *block }
    }
}

impl<'a, S: Level> LaneAt<'a, S> {
    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(&self, x: f64) -> Wide<S> {
        Wide::splat(self.simd, x)
    }

    /// The state of an argument, by its number, as an array of known length.
    #[inline(always)]
    pub fn state<const N: usize>(&self, argument: usize) -> Option<&'a [Wide<S>; N]> {
        chunk(self.states, self.arguments.get(self.block.arguments as usize + argument)?.state)
    }

    /// The values of parameters and time as an array of known length.
    #[inline(always)]
    pub fn known<const N: usize>(&self) -> Option<&'a [Wide<S>; N]> {
        chunk(self.known, self.block.known)
    }

    /// The constraint's own of all rows, to be written.
    #[inline(always)]
    pub fn rows<'x, const N: usize>(&self, all: &'x mut [Wide<S>]) -> Option<&'x mut [Wide<S>; N]> {
        chunk_mut(all, self.block.rows)
    }

    /// The constraint's own of all values of C_q, to be written.
    #[inline(always)]
    pub fn values<'x, const N: usize>(&self, all: &'x mut [Wide<S>]) -> Option<&'x mut [Wide<S>; N]> {
        chunk_mut(all, self.block.values)
    }

    /// Values that only f64 can compute, lane by lane: [`InLanes::evaluate`].
    #[inline(always)]
    pub fn evaluate<const N: usize, const M: usize>(&self, number: usize, x: [Wide<S>; N]) -> [Wide<S>; M] {
        let mut y = [self.splat(0.0); M];
        let lanes = self.own.get(self.block.number as usize).map(Vec::as_slice).unwrap_or_default();
        for (lane, constraint) in lanes.iter().enumerate().take(Wide::<S>::LANES) {
            let (own_x, mut own_y) = (x.map(|x| x.as_slice()[lane]), [0.0; M]);
            constraint.evaluate(number, &own_x, &mut own_y);
            y.iter_mut().zip(own_y).for_each(|(y, own)| y.as_mut_slice()[lane] = own);
        }
        y
    }
}

/// The rates of one constraint's arguments, for several mechanisms.
#[derive(Clone, Copy)]
pub struct LaneRates<'a, S: Level> {
    rates: &'a [Wide<S>],
    arguments: &'a [Offsets],
    first: u32,
}

impl<'a, S: Level> LaneRates<'a, S> {
    /// The rates of an argument, by its number, as an array of known length.
    #[inline(always)]
    pub fn of<const N: usize>(&self, argument: usize) -> Option<&'a [Wide<S>; N]> {
        chunk(self.rates, self.arguments.get(self.first as usize + argument)?.rates)
    }
}

/// The N numbers that begin there (32 bits: the end does not overflow, so one check will do).
#[inline(always)]
fn chunk<T, const N: usize>(all: &[T], first: u32) -> Option<&[T; N]> {
    all.get(first as usize..first as usize + N)?.first_chunk()
}

/// The same, to be written.
#[inline(always)]
fn chunk_mut<T, const N: usize>(all: &mut [T], first: u32) -> Option<&mut [T; N]> {
    all.get_mut(first as usize..first as usize + N)?.first_chunk_mut()
}

/// The part of a constraint's kernels over lanes that takes plain numbers, in each lane by itself.
pub trait InLanes: Send + Sync {
    /// The kernels.
    fn kernels(&self) -> LaneKernels;

    /// How many numbers the kernels want that depend on parameters alone, and how many that depend on the
    /// time too.
    fn n_known(&self) -> [usize; 2];

    /// The numbers that depend on parameters alone; default none.
    fn of_parameters(&self, known: &mut [f64]) {
        let _ = known;
    }

    /// The numbers that depend on the time too; default none.
    fn of_time(&self, t: f64, known: &mut [f64]) {
        let _ = (t, known);
    }

    /// A value that depends on coordinates and that only f64 can compute, such as a law or a function of the
    /// user's, by its number; default nothing.
    fn evaluate(&self, number: usize, x: &[f64], y: &mut [f64]) {
        let _ = (number, x, y);
    }
}

/// C, C_q, −C_t and Q_d over lanes, among those of all constraints. Methods are written `#[inline(always)]`:
/// they are compiled for each kind of machine.
pub trait LaneKernel {
    /// C and C_q together.
    fn linearize<S: Level>(at: &LaneAt<'_, S>, c: &mut [Wide<S>], c_q: &mut [Wide<S>]);

    /// The right side of C_q q̇ = −C_t; default nothing, of a constraint without time.
    #[inline(always)]
    fn velocity_rhs<S: Level>(at: &LaneAt<'_, S>, rhs: &mut [Wide<S>]) {
        let _ = (at, rhs);
    }

    /// Q_d.
    fn acceleration_rhs<S: Level>(at: &LaneAt<'_, S>, qd: &LaneRates<'_, S>, q_d: &mut [Wide<S>]);
}

/// A request to the constraints of a kind, and where the answer is written.
enum Asked<'x, S: Level> {
    /// C and the values of C_q.
    Linear(&'x mut [Wide<S>], &'x mut [Wide<S>]),
    /// −C_t
    Velocity(&'x mut [Wide<S>]),
    /// Q_d
    Acceleration(&'x mut [Wide<S>]),
}

/// Kernels as one function for one kind of machine, each for several constraints at once: a call costs as
/// much as half a kernel.
pub struct Table<S: Level>(fn(&LaneInstant<'_, S>, &[LaneBlock], Asked<'_, S>));

impl<S: Level> Clone for Table<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Level> Copy for Table<S> {}

impl<S: Level> Table<S> {
    fn of<K: LaneKernel>() -> Self {
        Table(|instant, blocks, asked| instant.simd.vectorize(Call(instant, blocks, asked, PhantomData::<K>)))
    }

    /// True if one call can serve constraints of both.
    pub(crate) fn is(&self, other: &Self) -> bool {
        std::ptr::fn_addr_eq(self.0, other.0)
    }

    /// C and the values of C_q of several constraints.
    pub(crate) fn linearize(
        &self,
        instant: &LaneInstant<'_, S>,
        blocks: &[LaneBlock],
        c: &mut [Wide<S>],
        c_q: &mut [Wide<S>],
    ) {
        (self.0)(instant, blocks, Asked::Linear(c, c_q));
    }

    /// −C_t
    pub(crate) fn velocity_rhs(
        &self,
        instant: &LaneInstant<'_, S>,
        blocks: &[LaneBlock],
        rhs: &mut [Wide<S>],
    ) {
        (self.0)(instant, blocks, Asked::Velocity(rhs));
    }

    /// Q_d
    pub(crate) fn acceleration_rhs(
        &self,
        instant: &LaneInstant<'_, S>,
        blocks: &[LaneBlock],
        q_d: &mut [Wide<S>],
    ) {
        (self.0)(instant, blocks, Asked::Acceleration(q_d));
    }
}

macro_rules! kernels {
    ($($(#[$when:meta])* $field:ident $token:ty;)*) => {
        /// The kernels of one constraint, compiled for each kind of machine.
        #[derive(Clone, Copy)]
        pub struct LaneKernels {
            $($(#[$when])* pub(super) $field: Table<$token>,)*
        }

        impl LaneKernels {
            /// The compiled copies.
            pub fn of<K: LaneKernel>() -> Self {
                LaneKernels { $($(#[$when])* $field: Table::of::<K>(),)* }
            }
        }
    };
}

kernels! {
    #[cfg(target_arch = "x86_64")] v4 pulp::x86::V4;
    #[cfg(target_arch = "x86_64")] v3 pulp::x86::V3;
    #[cfg(target_arch = "aarch64")] neon pulp::aarch64::Neon;
}

/// Kernels on their way into the function that has the machine's instructions: one for all three, what it
/// takes to get there is compiled once.
struct Call<'x, 'a, S: Level, K>(&'x LaneInstant<'a, S>, &'x [LaneBlock], Asked<'x, S>, PhantomData<K>);

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<'_, '_, S, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Call(instant, blocks, mut asked, _) = self;
        // One loop around all three: it is compiled for each kernel and each kind of machine.
        for block in blocks {
            let at = instant.at(block);
            match &mut asked {
                Asked::Linear(c, c_q) => K::linearize(&at, c, c_q),
                Asked::Velocity(rhs) => K::velocity_rhs(&at, rhs),
                Asked::Acceleration(q_d) => {
                    let rates = LaneRates {
                        rates: instant.rates,
                        arguments: instant.arguments,
                        first: block.arguments,
                    };
                    K::acceleration_rhs(&at, &rates, q_d);
                }
            }
        }
    }
}
