//! Kernels over lanes: what `#[constraint(lanes)]` emits, and the compiled copies for each kind of machine.

use std::marker::PhantomData;

use pulp::NullaryFnOnce;

use super::Level;
use super::number::Wide;

/// The instant as the kernels of one constraint see it, for several mechanisms.
#[derive(Clone, Copy)]
pub struct LaneAt<'a, S: Level> {
    /// What the lanes are made of.
    pub simd: S,
    states: &'a [Wide<S>],
    known: &'a [Wide<S>],
    /// The constraint of each lane.
    own: &'a [&'a dyn InLanes],
}

impl<'a, S: Level> LaneAt<'a, S> {
    /// States of the arguments one after the other, the numbers that [`InLanes`] has made of parameters and of the time, and the
    /// constraint itself in each lane.
    pub fn new(simd: S, states: &'a [Wide<S>], known: &'a [Wide<S>], own: &'a [&'a dyn InLanes]) -> Self {
        LaneAt { simd, states, known, own }
    }

    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(&self, x: f64) -> Wide<S> {
        Wide::splat(self.simd, x)
    }

    /// All states as an array of known length.
    #[inline(always)]
    pub fn states<const N: usize>(&self) -> Option<&'a [Wide<S>; N]> {
        self.states.first_chunk()
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
        for (lane, constraint) in self.own.iter().enumerate().take(Wide::<S>::LANES) {
            let (own_x, mut own_y) = (x.map(|x| x.as_slice()[lane]), [0.0; M]);
            constraint.evaluate(number, &own_x, &mut own_y);
            y.iter_mut().zip(own_y).for_each(|(y, own)| y.as_mut_slice()[lane] = own);
        }
        y
    }
}

/// The rates of one constraint's columns, for several mechanisms.
#[derive(Clone, Copy)]
pub struct LaneRates<'a, S: Level>(pub &'a [Wide<S>]);

impl<'a, S: Level> LaneRates<'a, S> {
    /// The rates of all columns as an array of known length.
    #[inline(always)]
    pub fn columns<const N: usize>(&self) -> Option<&'a [Wide<S>; N]> {
        self.0.first_chunk()
    }
}

/// What a constraint does for kernels over lanes with plain numbers, in each lane by itself.
pub trait InLanes: Send + Sync {
    /// The kernels.
    fn kernels(&self) -> LaneKernels;

    /// How many numbers the kernels want that depend on parameters alone, and how many that depend on the time too.
    fn n_known(&self) -> [usize; 2];

    /// The numbers that depend on parameters alone; default none.
    fn of_parameters(&self, known: &mut [f64]) {
        let _ = known;
    }

    /// The numbers that depend on the time too; default none.
    fn of_time(&self, t: f64, known: &mut [f64]) {
        let _ = (t, known);
    }

    /// What depends on coordinates and only f64 can do, such as a law or a function of the user's, by its number; default nothing.
    fn evaluate(&self, number: usize, x: &[f64], y: &mut [f64]) {
        let _ = (number, x, y);
    }
}

/// C, C_q, −C_t and Q_d over lanes. Methods are written `#[inline(always)]`: they are compiled for each kind of machine.
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

/// From the instant to C and the values of C_q.
type Linearize<S> = fn(&LaneAt<'_, S>, &mut [Wide<S>], &mut [Wide<S>]);

/// Kernels as functions for one kind of machine.
pub struct Table<S: Level> {
    pub(crate) linearize: Linearize<S>,
    pub(crate) velocity_rhs: fn(&LaneAt<'_, S>, &mut [Wide<S>]),
    pub(crate) acceleration_rhs: fn(&LaneAt<'_, S>, &LaneRates<'_, S>, &mut [Wide<S>]),
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

/// A kernel on its way into the function that has the machine's instructions.
struct Call<A, K>(A, PhantomData<K>);

fn linearize<S: Level, K: LaneKernel>(at: &LaneAt<'_, S>, c: &mut [Wide<S>], c_q: &mut [Wide<S>]) {
    at.simd.vectorize(Call((at, c, c_q), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<(&LaneAt<'_, S>, &mut [Wide<S>], &mut [Wide<S>]), K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (at, c, c_q) = self.0;
        K::linearize(at, c, c_q);
    }
}

fn velocity_rhs<S: Level, K: LaneKernel>(at: &LaneAt<'_, S>, rhs: &mut [Wide<S>]) {
    at.simd.vectorize(Call((at, rhs), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<(&LaneAt<'_, S>, &mut [Wide<S>]), K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (at, rhs) = self.0;
        K::velocity_rhs(at, rhs);
    }
}

fn acceleration_rhs<S: Level, K: LaneKernel>(at: &LaneAt<'_, S>, qd: &LaneRates<'_, S>, q_d: &mut [Wide<S>]) {
    at.simd.vectorize(Call((at, qd, q_d), PhantomData::<K>));
}

impl<S: Level, K: LaneKernel> NullaryFnOnce for Call<(&LaneAt<'_, S>, &LaneRates<'_, S>, &mut [Wide<S>]), K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (at, qd, q_d) = self.0;
        K::acceleration_rhs(at, qd, q_d);
    }
}
