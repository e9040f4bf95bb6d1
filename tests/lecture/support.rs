//! Random states, the lecture's matrices, and the comparison of terms.

use kin::extend::dual_route::Equation;
use kin::extend::{Route, Routed, Terms, dual_terms, terms};
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};

/// Largest difference that counts as rounding, relative to 1 + the largest term.
pub const TOLERANCE: f64 = 1e-13;

/// States at which every joint is compared.
pub const STATES: usize = 1000;

pub type V2 = Vector2<f64>;

/// A = [cos θ, −sin θ; sin θ, cos θ]   ("Transformation 2")
pub fn a(theta: f64) -> Matrix2<f64> {
    Matrix2::new(theta.cos(), -theta.sin(), theta.sin(), theta.cos())
}

/// A_θ = [−sin θ, −cos θ; cos θ, −sin θ]   ("Velocity")
pub fn a_theta(theta: f64) -> Matrix2<f64> {
    Matrix2::new(-theta.sin(), -theta.cos(), theta.cos(), -theta.sin())
}

/// Every term of a constraint, derived by hand; those that are not given are zero.
#[derive(Clone, Debug)]
pub struct Hand {
    pub c: DVector<f64>,
    pub c_q: DMatrix<f64>,
    /// C_q q̇, which the lecture writes out.
    pub c_q_qd: DVector<f64>,
    pub c_t: DVector<f64>,
    pub c_qqd_qd: DVector<f64>,
    pub c_qt_qd: DVector<f64>,
    pub c_tt: DVector<f64>,
    pub q_d: DVector<f64>,
}

impl Hand {
    /// m rows, n columns, nothing in them.
    pub fn new(m: usize, n: usize) -> Self {
        let zero = DVector::zeros(m);
        let [c, c_q_qd, c_t, c_qqd_qd, c_qt_qd, c_tt, q_d] = std::array::from_fn(|_| zero.clone());
        Hand { c, c_q: DMatrix::zeros(m, n), c_q_qd, c_t, c_qqd_qd, c_qt_qd, c_tt, q_d }
    }
}

/// A column of numbers.
pub fn column(values: &[f64]) -> DVector<f64> {
    DVector::from_row_slice(values)
}

/// A column of one vector of the plane.
pub fn column_of(v: V2) -> DVector<f64> {
    column(&[v.x, v.y])
}

/// Worst differences met so far, told at the end of the test.
pub struct Comparison {
    what: &'static str,
    worst: [f64; 2],
    states: [usize; 2],
}

impl Comparison {
    pub fn of(what: &'static str) -> Self {
        Comparison { what, worst: [0.0; 2], states: [0; 2] }
    }

    /// Every term of both routes at one state against those derived by hand.
    pub fn check<E, const N: usize, const M: usize>(
        &mut self,
        constraint: &E,
        q: &[f64],
        qd: &[f64],
        t: f64,
        hand: &Hand,
    ) where
        E: Equation<N, M> + Clone,
    {
        assert_eq!(constraint.route(), Route::Symbolic, "{}", self.what);
        let qd = &column(qd);
        self.same("symbolic", 0, &terms(constraint, q, qd.as_slice(), t), qd, hand);
        self.same("dual", 1, &dual_terms(constraint, q, qd.as_slice(), t), qd, hand);
    }

    /// Every term of one route (0: symbolic, 1: dual) against those derived by hand.
    pub fn same(&mut self, route: &str, k: usize, found: &Terms, qd: &DVector<f64>, hand: &Hand) {
        let flat = |m: &DMatrix<f64>| column(m.as_slice());
        self.states[k] += 1;
        assert_eq!(found.c_q.shape(), hand.c_q.shape(), "{}: shape of C_q", self.what);
        for (term, found, hand) in [
            ("C", &found.c, &hand.c),
            ("C_q", &flat(&found.c_q), &flat(&hand.c_q)),
            ("C_q qd", &(&found.c_q * qd), &hand.c_q_qd),
            ("C_t", &found.c_t, &hand.c_t),
            ("(C_q qd)_q qd", &found.c_qqd_qd, &hand.c_qqd_qd),
            ("C_qt qd", &found.c_qt_qd, &hand.c_qt_qd),
            ("C_tt", &found.c_tt, &hand.c_tt),
            ("Q_d", &found.q_d, &hand.q_d),
        ] {
            let error = difference(found, hand);
            assert!(
                error <= TOLERANCE,
                "{}, {route}: {term} differs by {error:.1e}\nfound {found}by hand {hand}",
                self.what
            );
            self.worst[k] = self.worst[k].max(error);
        }
    }
}

impl Drop for Comparison {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let states = self.states[0];
            let [symbolic, dual] = self.worst;
            assert!(
                states > 0 && self.states[1] == states,
                "{}: {:?} states compared",
                self.what,
                self.states
            );
            println!(
                "{}: {states} states, worst {symbolic:.1e} symbolic, {dual:.1e} dual",
                self.what
            );
        }
    }
}

/// max |found − hand| / (1 + max |hand|); infinite where lengths differ or a number is none.
pub fn difference(found: &DVector<f64>, hand: &DVector<f64>) -> f64 {
    if found.len() != hand.len() {
        return f64::INFINITY;
    }
    let worst = (found - hand)
        .iter()
        .fold(0.0_f64, |m, d| if d.is_nan() { f64::INFINITY } else { m.max(d.abs()) });
    worst / (1.0 + hand.amax())
}

/// SplitMix64: the same states in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// Uniform between −size and size.
    pub fn within(&mut self, size: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        size * (2.0 * ((z >> 11) as f64 / (1_u64 << 53) as f64) - 1.0)
    }

    /// Each uniform between −size and size.
    pub fn array<const N: usize>(&mut self, size: f64) -> [f64; N] {
        std::array::from_fn(|_| self.within(size))
    }

    /// Each uniform between −size and size.
    pub fn vector(&mut self, size: f64) -> V2 {
        V2::new(self.within(size), self.within(size))
    }

    /// Coordinates of planar bodies, R within 2 m and θ within two turns; rates within 3 m/s and 3
    /// rad/s.
    pub fn bodies<const N: usize>(&mut self) -> ([f64; N], [f64; N]) {
        let q = std::array::from_fn(|k| {
            self.within(if k % 3 == 2 { 4.0 * std::f64::consts::PI } else { 2.0 })
        });
        (q, self.array(3.0))
    }
}
