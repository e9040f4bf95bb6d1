//! What a constraint sees: the state of its arguments at one instant, evaluated once and shared by all constraints on a body.

use crate::algebra::{EulerParameters, Mat2, Mat3, Scalar, Vec2, Vec3};

/// State of a planar body: coordinates (R_x, R_y, θ) with sin θ and cos θ.   \[m, rad\]
///
/// `T` is `f64`, or `Real<D>` where a constraint runs on dual numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarState<T = f64> {
    /// R, the origin of the body frame in the global frame.   \[m\]
    pub r: Vec2<T>,
    /// θ, counter-clockwise from the global x-axis, never wrapped.   \[rad\]
    pub theta: T,
    /// sin θ
    pub sin: T,
    /// cos θ
    pub cos: T,
}

impl<T: Scalar> PlanarState<T> {
    /// The state at coordinates (R_x, R_y, θ).
    pub fn new(q: [T; 3]) -> Self {
        let (sin, cos) = q[2].sin_cos();
        PlanarState { r: Vec2::new(q[0], q[1]), theta: q[2], sin, cos }
    }

    /// The state of the ground: the global frame itself.
    pub fn ground() -> Self {
        let (zero, one) = (T::from(0.0), T::from(1.0));
        PlanarState { r: Vec2::new(zero, zero), theta: zero, sin: zero, cos: one }
    }

    /// A = [cos θ, −sin θ; sin θ, cos θ], body to global (lecture, "Transformation 2").
    pub fn a(&self) -> Mat2<T> {
        Mat2::new(self.cos, -self.sin, self.sin, self.cos)
    }

    /// r_P = R + A ū, global position of the point with local position ū.   \[m\]
    pub fn point(&self, u: impl Into<Vec2<T>>) -> Vec2<T> {
        self.r + self.direction(u)
    }

    /// h = A h̄, global components of a direction fixed in the body.
    pub fn direction(&self, h: impl Into<Vec2<T>>) -> Vec2<T> {
        let h = h.into();
        Vec2::new(self.cos * h.x - self.sin * h.y, self.sin * h.x + self.cos * h.y)
    }

    /// ū = Aᵀ (p − R), local position of the global point p.   \[m\]
    pub fn local(&self, p: impl Into<Vec2<T>>) -> Vec2<T> {
        let d = p.into() - self.r;
        Vec2::new(self.cos * d.x + self.sin * d.y, self.cos * d.y - self.sin * d.x)
    }
}

/// State of a spatial body: coordinates (R, e0, e1, e2, e3) with the rotation matrix A(p).   \[m, –\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialState<T = f64> {
    /// R, the origin of the body frame in the global frame.   \[m\]
    pub r: Vec3<T>,
    /// Euler parameters p = (e0, e), scalar first.
    pub p: EulerParameters<T>,
    /// A = (2 e0² − 1) I + 2 e eᵀ + 2 e0 ẽ, body to global.
    pub a: Mat3<T>,
}

impl<T: Scalar> SpatialState<T> {
    /// The state at coordinates (R_x, R_y, R_z, e0, e1, e2, e3).
    pub fn new(q: [T; 7]) -> Self {
        let p = EulerParameters::new(q[3], q[4], q[5], q[6]);
        SpatialState { r: Vec3::new(q[0], q[1], q[2]), p, a: p.rotation() }
    }

    /// The state of the ground: the global frame itself.
    pub fn ground() -> Self {
        let (zero, one) = (T::from(0.0), T::from(1.0));
        Self::new([zero, zero, zero, one, zero, zero, zero])
    }

    /// A(p), body to global.
    pub fn a(&self) -> Mat3<T> {
        self.a
    }

    /// r_P = R + A ū, global position of the point with local position ū.   \[m\]
    pub fn point(&self, u: impl Into<Vec3<T>>) -> Vec3<T> {
        self.r + self.a * u.into()
    }

    /// h = A h̄, global components of a direction fixed in the body.
    pub fn direction(&self, h: impl Into<Vec3<T>>) -> Vec3<T> {
        self.a * h.into()
    }

    /// ū = Aᵀ (p − R), local position of the global point p.   \[m\]
    pub fn local(&self, p: impl Into<Vec3<T>>) -> Vec3<T> {
        self.a.transpose() * (p.into() - self.r)
    }
}

/// State of a bare coordinate; sine and cosine only where a constraint asks for them.   \[m or rad\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordState {
    /// The value of the coordinate.
    pub value: f64,
    /// sin of the value, if some constraint on it needs it (else 0).
    pub sin: f64,
    /// cos of the value, if some constraint on it needs it (else 0).
    pub cos: f64,
}

impl CoordState {
    /// The state at `value`; with sine and cosine if `trig`.
    pub fn new(value: f64, trig: bool) -> Self {
        let (sin, cos) = if trig { value.sin_cos() } else { (0.0, 0.0) };
        CoordState { value, sin, cos }
    }
}

/// Rates of a planar body: (Ṙ_x, Ṙ_y, θ̇).   \[m/s, rad/s\]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanarRate {
    /// Ṙ   \[m/s\]
    pub r: [f64; 2],
    /// θ̇   \[rad/s\]
    pub theta: f64,
}

/// Rates of a spatial body: (Ṙ, ė0, ė1, ė2, ė3).   \[m/s, 1/s\]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpatialRate {
    /// Ṙ   \[m/s\]
    pub r: [f64; 3],
    /// ṗ   \[1/s\]
    pub p: [f64; 4],
}

/// All states of a system at one instant. The first planar and the first spatial state are the ground's.
#[derive(Clone, Debug)]
pub struct States {
    /// Planar bodies, ground first.
    pub planar: Vec<PlanarState>,
    /// Spatial bodies, ground first.
    pub spatial: Vec<SpatialState>,
    /// Coordinates that constraints name on their own.
    pub coords: Vec<CoordState>,
}

impl Default for States {
    fn default() -> Self {
        States { planar: vec![PlanarState::ground()], spatial: vec![SpatialState::ground()], coords: Vec::new() }
    }
}

/// All rates of a system at one instant, in the order of [`States`]; those of the ground are zero.
#[derive(Clone, Debug)]
pub struct RateStates {
    /// Planar bodies, ground first.
    pub planar: Vec<PlanarRate>,
    /// Spatial bodies, ground first.
    pub spatial: Vec<SpatialRate>,
    /// Coordinates that constraints name on their own.
    pub coords: Vec<f64>,
}

impl Default for RateStates {
    fn default() -> Self {
        RateStates { planar: vec![PlanarRate::default()], spatial: vec![SpatialRate::default()], coords: Vec::new() }
    }
}

/// The instant as one constraint sees it: time, and the states of its own arguments by their position in its signature
/// (a `[Coord; N]` counts as N arguments).
#[derive(Clone, Copy)]
pub struct At<'a> {
    /// Time t.   \[s\]
    pub t: f64,
    states: &'a States,
    slots: &'a [usize],
}

impl<'a> At<'a> {
    /// Time t, all states, and where in them each argument's state stands.
    pub fn new(t: f64, states: &'a States, slots: &'a [usize]) -> Self {
        At { t, states, slots }
    }

    /// State of argument `k`, a planar body; the ground's if there is no such argument.
    #[inline]
    pub fn planar(&self, k: usize) -> &'a PlanarState {
        find(self.slots, k, &self.states.planar).unwrap_or_else(|| missing(&PLANAR_GROUND))
    }

    /// State of argument `k`, a spatial body; the ground's if there is no such argument.
    #[inline]
    pub fn spatial(&self, k: usize) -> &'a SpatialState {
        find(self.slots, k, &self.states.spatial).unwrap_or_else(|| missing(&SPATIAL_GROUND))
    }

    /// State of argument `k`, a bare coordinate; zero if there is no such argument.
    #[inline]
    pub fn coord(&self, k: usize) -> &'a CoordState {
        find(self.slots, k, &self.states.coords).unwrap_or_else(|| missing(&ZERO))
    }
}

/// What argument `k` refers to.
#[inline]
fn find<'a, T>(slots: &[usize], k: usize, all: &'a [T]) -> Option<&'a T> {
    all.get(*slots.get(k)?)
}

/// Kept out of the way, so that the common case is a compare and a load.
#[cold]
fn missing<T>(instead: &'static T) -> &'static T {
    instead
}

static ZERO: CoordState = CoordState { value: 0.0, sin: 0.0, cos: 1.0 };

static PLANAR_GROUND: PlanarState = PlanarState { r: Vec2 { x: 0.0, y: 0.0 }, theta: 0.0, sin: 0.0, cos: 1.0 };

static SPATIAL_GROUND: SpatialState = SpatialState {
    r: Vec3 { x: 0.0, y: 0.0, z: 0.0 },
    p: EulerParameters { e0: 1.0, e1: 0.0, e2: 0.0, e3: 0.0 },
    a: Mat3 { m11: 1.0, m12: 0.0, m13: 0.0, m21: 0.0, m22: 1.0, m23: 0.0, m31: 0.0, m32: 0.0, m33: 1.0 },
};

/// The rates of one constraint's arguments, by their position in its signature.
#[derive(Clone, Copy)]
pub struct Rates<'a> {
    rates: &'a RateStates,
    slots: &'a [usize],
}

impl<'a> Rates<'a> {
    /// All rates, and where in them each argument's rates stand.
    pub fn new(rates: &'a RateStates, slots: &'a [usize]) -> Self {
        Rates { rates, slots }
    }

    /// Rates of argument `k`, a planar body; zero if there is no such argument.
    #[inline]
    pub fn planar(&self, k: usize) -> &'a PlanarRate {
        static STILL: PlanarRate = PlanarRate { r: [0.0; 2], theta: 0.0 };
        find(self.slots, k, &self.rates.planar).unwrap_or_else(|| missing(&STILL))
    }

    /// Rates of argument `k`, a spatial body; zero if there is no such argument.
    #[inline]
    pub fn spatial(&self, k: usize) -> &'a SpatialRate {
        static STILL: SpatialRate = SpatialRate { r: [0.0; 3], p: [0.0; 4] };
        find(self.slots, k, &self.rates.spatial).unwrap_or_else(|| missing(&STILL))
    }

    /// Rate of argument `k`, a bare coordinate; zero if there is no such argument.
    #[inline]
    pub fn coord(&self, k: usize) -> f64 {
        find(self.slots, k, &self.rates.coords).copied().unwrap_or(0.0)
    }
}
