//! Holds the state of a constraint's arguments at one instant.
//!
//! Kin computes the state of a body once and shares it among all constraints on the body.

use crate::coordinates::Trig;
use crate::numbers::algebra::{EulerParameters, Mat2, Mat3, Scalar, Vec2, Vec3};

pub use crate::numbers::Offsets;

/// The state of a planar body: the coordinates (R_x, R_y, θ) with sin θ and cos θ. \[m, rad\]
///
/// `T` is `f64`, or `Real<D>` if a constraint runs on dual numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarState<T = f64> {
    /// R, the origin of the body frame in the global frame.   \[m\]
    pub r: Vec2<T>,
    /// θ, counter-clockwise from the global x-axis. The angle counts full revolutions. \[rad\]
    pub theta: T,
    /// sin θ
    pub sin: T,
    /// cos θ
    pub cos: T,
}

impl<T: Scalar> PlanarState<T> {
    /// Creates the state at the coordinates (R_x, R_y, θ).
    pub fn new(q: [T; 3]) -> Self {
        let (sin, cos) = q[2].sin_cos();
        PlanarState { r: Vec2::new(q[0], q[1]), theta: q[2], sin, cos }
    }

    /// Creates the state of the ground: the global frame.
    pub fn ground() -> Self {
        let zero = T::from(0.0);
        let one = T::from(1.0);
        PlanarState { r: Vec2::new(zero, zero), theta: zero, sin: zero, cos: one }
    }

    /// Returns the rotation matrix A = [cos θ, −sin θ; sin θ, cos θ] from the body frame to the
    /// global frame.
    pub fn a(&self) -> Mat2<T> {
        Mat2::new(self.cos, -self.sin, self.sin, self.cos)
    }

    /// Returns r_P = R + A ū, the global position of the point with local position ū. \[m\]
    pub fn point(&self, u: impl Into<Vec2<T>>) -> Vec2<T> {
        self.r + self.direction(u)
    }

    /// Returns h = A h̄, the global components of a direction fixed in the body.
    pub fn direction(&self, h: impl Into<Vec2<T>>) -> Vec2<T> {
        let h = h.into();
        Vec2::new(self.cos * h.x - self.sin * h.y, self.sin * h.x + self.cos * h.y)
    }

    /// Returns ū = Aᵀ (p − R), the local position of the global point p. \[m\]
    pub fn local(&self, p: impl Into<Vec2<T>>) -> Vec2<T> {
        let d = p.into() - self.r;
        Vec2::new(self.cos * d.x + self.sin * d.y, self.cos * d.y - self.sin * d.x)
    }
}

/// The state of a spatial body: the coordinates (R, e0, e1, e2, e3) with the rotation matrix A(p).
/// \[m, –\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialState<T = f64> {
    /// R, the origin of the body frame in the global frame.   \[m\]
    pub r: Vec3<T>,
    /// Euler parameters p = (e0, e), scalar first.
    pub p: EulerParameters<T>,
    /// The rotation matrix A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ from the body frame to the global
    /// frame.
    pub a: Mat3<T>,
}

impl<T: Scalar> SpatialState<T> {
    /// Creates the state at the coordinates (R_x, R_y, R_z, e0, e1, e2, e3).
    pub fn new(q: [T; 7]) -> Self {
        let p = EulerParameters::new(q[3], q[4], q[5], q[6]);
        SpatialState { r: Vec3::new(q[0], q[1], q[2]), p, a: p.rotation() }
    }

    /// Creates the state of the ground: the global frame.
    pub fn ground() -> Self {
        let zero = T::from(0.0);
        let one = T::from(1.0);
        Self::new([zero, zero, zero, one, zero, zero, zero])
    }

    /// Returns the rotation matrix A(p) from the body frame to the global frame.
    pub fn a(&self) -> Mat3<T> {
        self.a
    }

    /// Returns r_P = R + A ū, the global position of the point with local position ū. \[m\]
    pub fn point(&self, u: impl Into<Vec3<T>>) -> Vec3<T> {
        self.r + self.a * u.into()
    }

    /// Returns h = A h̄, the global components of a direction fixed in the body.
    pub fn direction(&self, h: impl Into<Vec3<T>>) -> Vec3<T> {
        self.a * h.into()
    }

    /// Returns ū = Aᵀ (p − R), the local position of the global point p. \[m\]
    pub fn local(&self, p: impl Into<Vec3<T>>) -> Vec3<T> {
        self.a.transpose() * (p.into() - self.r)
    }
}

/// The state of a scalar coordinate. \[m or rad\]
///
/// The state contains sine and cosine only if a constraint reads them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordState {
    /// The value of the coordinate.
    pub value: f64,
    /// The sine of the value if a constraint reads the sine, otherwise 0.
    pub sin: f64,
    /// The cosine of the value if a constraint reads the cosine, otherwise 0.
    pub cos: f64,
}

impl CoordState {
    /// Creates the state at `value`, with sine and cosine if `trig` says that a constraint reads
    /// them.
    pub fn new(value: f64, trig: Trig) -> Self {
        let (sin, cos) = if trig == Trig::Used { value.sin_cos() } else { (0.0, 0.0) };
        CoordState { value, sin, cos }
    }
}

/// The velocities of a planar body: (Ṙ_x, Ṙ_y, θ̇). \[m/s, rad/s\]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarRate {
    /// Ṙ   \[m/s\]
    pub r: [f64; 2],
    /// θ̇   \[rad/s\]
    pub theta: f64,
}

/// The velocities of a spatial body: (Ṙ, ė0, ė1, ė2, ė3). \[m/s, 1/s\]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpatialRate {
    /// Ṙ   \[m/s\]
    pub r: [f64; 3],
    /// ṗ   \[1/s\]
    pub p: [f64; 4],
}

/// The number of values in the state of a planar body.
pub const PLANAR_STATE: usize = 5;
/// The number of values in the state of a spatial body.
pub const SPATIAL_STATE: usize = 7;
/// The number of values in the state of a scalar coordinate.
pub const COORD_STATE: usize = 3;

impl PlanarState {
    /// Returns (R_x, R_y, θ, sin θ, cos θ), the layout that a constraint reads.
    pub fn to_array(&self) -> [f64; PLANAR_STATE] {
        [self.r.x, self.r.y, self.theta, self.sin, self.cos]
    }

    fn from_array([x, y, theta, sin, cos]: [f64; PLANAR_STATE]) -> Self {
        PlanarState { r: Vec2::new(x, y), theta, sin, cos }
    }
}

impl SpatialState {
    /// Returns (R, e0..e3), the layout that a constraint reads.
    ///
    /// The array does not contain A, because a constraint computes the needed parts of A faster
    /// from p.
    pub fn to_array(&self) -> [f64; SPATIAL_STATE] {
        let r = self.r;
        let p = self.p;
        [r.x, r.y, r.z, p.e0, p.e1, p.e2, p.e3]
    }
}

impl CoordState {
    /// Returns (value, sine, cosine), the layout that a constraint reads.
    pub fn to_array(&self) -> [f64; COORD_STATE] {
        [self.value, self.sin, self.cos]
    }
}

/// The instant at which a constraint is evaluated: the time and the states of its arguments.
///
/// Kin computes the states once for each Newton iterate. All constraints on a body and all terms of
/// the constraints share the state of the body. The index of an argument is its position in the
/// signature; a `[Coord; N]` counts as N arguments.
#[derive(Clone, Copy, Debug)]
pub struct At<'a> {
    /// The time t. \[s\]
    pub t: f64,
    states: &'a [f64],
    arguments: &'a [Offsets],
    timed: &'a [f64],
}

impl<'a> At<'a> {
    /// Creates the instant from the time, the states of all bodies, and the place of each argument
    /// in the states.
    ///
    /// [`PlanarState::to_array`] and its spatial and scalar variants give the layout of a state.
    #[inline]
    pub fn new(t: f64, states: &'a [f64], arguments: &'a [Offsets]) -> Self {
        At { t, states, arguments, timed: &[] }
    }

    /// Adds the numbers that [`crate::Constraint::at_time`] has computed from the time.
    ///
    /// If `timed` is missing, constraints compute the numbers themselves.
    #[must_use]
    #[inline]
    pub fn with_timed(self, timed: &'a [f64]) -> Self {
        At { timed, ..self }
    }

    /// Returns the same positions at another time.
    pub(crate) fn at_time(self, t: f64) -> Self {
        At { t, ..self }
    }

    /// Switches to another constraint at the same instant.
    #[inline(always)]
    pub(crate) fn turn(&mut self, arguments: &'a [Offsets], timed: &'a [f64]) {
        (self.arguments, self.timed) = (arguments, timed);
    }

    /// Returns the values that the constraint has computed from the time alone, if they are
    /// present.
    #[inline]
    pub fn timed(&self) -> &'a [f64] {
        self.timed
    }

    /// Returns the N numbers of the state of argument `k`, for compiled code.
    #[doc(hidden)]
    #[inline(always)]
    pub fn state<const N: usize>(&self, k: usize) -> Option<&'a [f64; N]> {
        numbers(self.states, self.arguments.get(k)?.state)
    }

    /// Returns the n coordinates of argument `k`, with which its state begins, or an empty slice if
    /// there is no such argument.
    pub(crate) fn coordinates(&self, k: usize, n: usize) -> &'a [f64] {
        self.arguments
            .get(k)
            .and_then(|begin| self.states.get(begin.state as usize..)?.get(..n))
            .unwrap_or_default()
    }

    /// Returns the state of argument `k`, a planar body, or the state of the ground if there is no
    /// such argument.
    pub fn planar(&self, k: usize) -> PlanarState {
        self.state(k).copied().map_or_else(PlanarState::ground, PlanarState::from_array)
    }

    /// Returns the state of argument `k`, a spatial body, or the state of the ground if there is no
    /// such argument.
    pub fn spatial(&self, k: usize) -> SpatialState {
        self.state(k).copied().map_or_else(SpatialState::ground, SpatialState::new)
    }

    /// Returns the state of argument `k`, a scalar coordinate, or zero if there is no such
    /// argument.
    pub fn coord(&self, k: usize) -> CoordState {
        let [value, sin, cos] = self.state(k).copied().unwrap_or([0.0, 0.0, 1.0]);
        CoordState { value, sin, cos }
    }
}

/// The velocities (or higher derivatives) of the arguments of one constraint.
#[derive(Clone, Copy, Debug)]
pub struct Rates<'a> {
    rates: &'a [f64],
    arguments: &'a [Offsets],
}

impl<'a> Rates<'a> {
    /// Creates the value from the derivatives of all coordinates and the place of each argument in
    /// this list.
    #[inline]
    pub fn new(rates: &'a [f64], arguments: &'a [Offsets]) -> Self {
        Rates { rates, arguments }
    }

    /// Returns the N derivatives of argument `k`, for compiled code.
    #[doc(hidden)]
    #[inline(always)]
    pub fn of<const N: usize>(&self, k: usize) -> Option<&'a [f64; N]> {
        numbers(self.rates, self.arguments.get(k)?.rates)
    }

    /// Returns the n derivatives of argument `k`, or an empty slice if there is no such argument.
    pub(crate) fn columns(&self, k: usize, n: usize) -> &'a [f64] {
        self.arguments
            .get(k)
            .and_then(|begin| self.rates.get(begin.rates as usize..)?.get(..n))
            .unwrap_or_default()
    }

    /// Returns the derivatives of argument `k`, a planar body, or zero if there is no such
    /// argument.
    pub fn planar(&self, k: usize) -> PlanarRate {
        let [x, y, theta] = self.of(k).copied().unwrap_or_default();
        PlanarRate { r: [x, y], theta }
    }

    /// Returns the derivatives of argument `k`, a spatial body, or zero if there is no such
    /// argument.
    pub fn spatial(&self, k: usize) -> SpatialRate {
        let [x, y, z, e0, e1, e2, e3] = self.of(k).copied().unwrap_or_default();
        SpatialRate { r: [x, y, z], p: [e0, e1, e2, e3] }
    }

    /// Returns the derivative of argument `k`, a scalar coordinate, or zero if there is no such
    /// argument.
    pub fn coord(&self, k: usize) -> f64 {
        self.of(k).map_or(0.0, |&[rate]| rate)
    }
}

/// Returns the N numbers from index `begin` on. `begin` has 32 bits, so the end does not overflow
/// and one check suffices.
#[inline(always)]
fn numbers<const N: usize>(all: &[f64], begin: u32) -> Option<&[f64; N]> {
    all.get(begin as usize..begin as usize + N)?.first_chunk()
}
