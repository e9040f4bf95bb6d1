//! Kernels over lanes: what `#[constraint(lanes)]` emits, and the compiled copies for each kind of machine.

use std::marker::PhantomData;

use pulp::NullaryFnOnce;

use super::Level;
use super::number::Wide;

/// What all constraints read at one instant, for several mechanisms.
pub struct LaneInstant<'a, S: Level> {
    pub(crate) simd: S,
    /// States of bodies and bare coordinates, each of them once.
    pub(crate) states: &'a [Wide<S>],
    /// Rates of coordinates, then those of the ground.
    pub(crate) rates: &'a [Wide<S>],
    /// The numbers that [`InLanes`] has made of parameters and of the time.
    pub(crate) known: &'a [Wide<S>],
    /// Of every argument, where its state and its rates begin.
    pub(crate) arguments: &'a [[u32; 2]],
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
    /// What the lanes are made of.
    pub simd: S,
    states: &'a [Wide<S>],
    known: &'a [Wide<S>],
    arguments: &'a [[u32; 2]],
    own: &'a [Vec<&'a dyn InLanes>],
    number: u32,
}

impl<'a, S: Level> LaneInstant<'a, S> {
    #[inline(always)]
    fn at(&self, block: &LaneBlock) -> LaneAt<'a, S> {
        LaneAt {
            simd: self.simd,
            states: self.states,
            known: from(self.known, block.known),
            arguments: from(self.arguments, block.arguments),
            own: self.own,
            number: block.number,
        }
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
        chunk(self.states, self.arguments.get(argument)?[0])
    }

    /// What is known of parameters and time as an array of known length.
    #[inline(always)]
    pub fn known<const N: usize>(&self) -> Option<&'a [Wide<S>; N]> {
        self.known.first_chunk()
    }

    /// What only f64 can do, lane by lane: [`InLanes::evaluate`].
    #[inline(always)]
    pub fn evaluate<const N: usize, const M: usize>(&self, number: usize, x: [Wide<S>; N]) -> [Wide<S>; M] {
        let mut y = [self.splat(0.0); M];
        let lanes = self.own.get(self.number as usize).map(Vec::as_slice).unwrap_or_default();
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
    arguments: &'a [[u32; 2]],
}

impl<'a, S: Level> LaneRates<'a, S> {
    /// The rates of an argument, by its number, as an array of known length.
    #[inline(always)]
    pub fn of<const N: usize>(&self, argument: usize) -> Option<&'a [Wide<S>; N]> {
        chunk(self.rates, self.arguments.get(argument)?[1])
    }
}

/// The N numbers that begin there (32 bits: the end does not overflow, so one check will do).
#[inline(always)]
fn chunk<T, const N: usize>(all: &[T], first: u32) -> Option<&[T; N]> {
    all.get(first as usize..first as usize + N)?.first_chunk()
}

/// What begins there, with all that follows.
#[inline(always)]
fn from<T>(all: &[T], first: u32) -> &[T] {
    all.get(first as usize..).unwrap_or_default()
}

/// The same, to be written.
#[inline(always)]
fn from_mut<T>(all: &mut [T], first: u32) -> &mut [T] {
    all.get_mut(first as usize..).unwrap_or_default()
}

/// What a constraint does for kernels over lanes with plain numbers, in each lane by itself.
pub trait InLanes: Send + Sync {
    /// The kernels.
    fn kernels(&self) -> LaneKernels;

    /// How many numbers the kernels want that depend on parameters alone, and how many that depend on the time too.
    fn n_known(&self) -> [usize; 2];

    /// The numbers that depend on parameters alone.
    fn of_parameters(&self, known: &mut [f64]);

    /// The numbers that depend on the time too.
    fn of_time(&self, t: f64, known: &mut [f64]);

    /// What depends on coordinates and only f64 can do, such as a law or a function of the user's, by its number.
    fn evaluate(&self, number: usize, x: &[f64], y: &mut [f64]);
}

/// C, C_q, −C_t and Q_d over lanes. Methods are written `#[inline(always)]`: they are compiled for each kind of machine.
pub trait LaneKernel {
    /// C and C_q together.
    fn linearize<S: Level>(at: &LaneAt<'_, S>, c: &mut [Wide<S>], c_q: &mut [Wide<S>]);

    /// The right side of C_q q̇ = −C_t.
    fn velocity_rhs<S: Level>(at: &LaneAt<'_, S>, rhs: &mut [Wide<S>]);

    /// Q_d.
    fn acceleration_rhs<S: Level>(at: &LaneAt<'_, S>, qd: &LaneRates<'_, S>, q_d: &mut [Wide<S>]);
}

/// From the instant to C and the values of C_q of several constraints.
type Linearize<S> = fn(&LaneInstant<'_, S>, &[LaneBlock], &mut [Wide<S>], &mut [Wide<S>]);

/// From the instant to a right side.
type RightSide<S> = fn(&LaneInstant<'_, S>, &[LaneBlock], &mut [Wide<S>]);

/// Kernels as functions for one kind of machine, each for several constraints at once: a call costs as much as half a kernel.
pub struct Table<S: Level> {
    pub(crate) linearize: Linearize<S>,
    pub(crate) velocity_rhs: RightSide<S>,
    pub(crate) acceleration_rhs: RightSide<S>,
}

impl<S: Level> Clone for Table<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Level> Copy for Table<S> {}

impl<S: Level> Table<S> {
    fn of<K: LaneKernel>() -> Self {
        Table { linearize: linearize::<S, K>, velocity_rhs: velocity_rhs::<S, K>, acceleration_rhs: acceleration_rhs::<S, K> }
    }

    /// Whether one call can serve constraints of both.
    pub(crate) fn is(&self, other: &Self) -> bool {
        std::ptr::fn_addr_eq(self.linearize, other.linearize)
            && std::ptr::fn_addr_eq(self.velocity_rhs, other.velocity_rhs)
            && std::ptr::fn_addr_eq(self.acceleration_rhs, other.acceleration_rhs)
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
    scalar pulp::Scalar;
}

/// A kernel on its way into the function that has the machine's instructions: which one, what it reads, and where it writes.
struct Call<'x, 'a, W, S: Level, K>(&'x LaneInstant<'a, S>, &'x [LaneBlock], W, PhantomData<K>);

/// C and C_q, to be written.
struct Both<'x, S: Level>(&'x mut [Wide<S>], &'x mut [Wide<S>]);

/// −C_t, to be written.
struct Velocity<'x, S: Level>(&'x mut [Wide<S>]);

/// Q_d, to be written.
struct Acceleration<'x, S: Level>(&'x mut [Wide<S>]);

fn linearize<S: Level, K: LaneKernel>(instant: &LaneInstant<'_, S>, blocks: &[LaneBlock], c: &mut [Wide<S>], c_q: &mut [Wide<S>]) {
    instant.simd.vectorize(Call(instant, blocks, Both(c, c_q), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<'_, '_, Both<'_, S>, S, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Call(instant, blocks, Both(c, c_q), _) = self;
        for block in blocks {
            K::linearize(&instant.at(block), from_mut(c, block.rows), from_mut(c_q, block.values));
        }
    }
}

fn velocity_rhs<S: Level, K: LaneKernel>(instant: &LaneInstant<'_, S>, blocks: &[LaneBlock], rhs: &mut [Wide<S>]) {
    instant.simd.vectorize(Call(instant, blocks, Velocity(rhs), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<'_, '_, Velocity<'_, S>, S, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Call(instant, blocks, Velocity(rhs), _) = self;
        for block in blocks {
            K::velocity_rhs(&instant.at(block), from_mut(rhs, block.rows));
        }
    }
}

fn acceleration_rhs<S: Level, K: LaneKernel>(instant: &LaneInstant<'_, S>, blocks: &[LaneBlock], q_d: &mut [Wide<S>]) {
    instant.simd.vectorize(Call(instant, blocks, Acceleration(q_d), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<'_, '_, Acceleration<'_, S>, S, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Call(instant, blocks, Acceleration(q_d), _) = self;
        for block in blocks {
            let at = instant.at(block);
            K::acceleration_rhs(&at, &LaneRates { rates: instant.rates, arguments: at.arguments }, from_mut(q_d, block.rows));
        }
    }
}
