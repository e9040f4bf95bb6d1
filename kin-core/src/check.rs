//! Checking a constraint of one's own: symbolic code against dual numbers, term by term, and both against central differences of the
//! function as it was written.

use nalgebra::{DMatrix, DVector};

use crate::dual_route::Equation;
use crate::terms::{Terms, dual_terms, terms};

/// How far apart two routes are, at the worst.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Largest difference of a term between the constraint's own route and dual numbers, relative to 1 + the largest entry of the term.
    pub routes: f64,
    /// Largest difference of C_q, C_t, and of Q_d from central differences, relative as above.
    pub differences: f64,
    /// Number of states compared. States where the function or a derivative is not finite are left out.
    pub states: usize,
}

/// A term that two routes do not agree on.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error(
    "`{kind}`: {term} by {left} and by {right} differ by {difference:.2e} (relative) at q = {q:?}, qd = {qd:?}, t = {t}; \
     derivatives are taken from one side at kinks: check the state, or report the constraint"
)]
pub struct Mismatch {
    /// Kind of the constraint.
    pub kind: String,
    /// The term, such as `C_q`.
    pub term: &'static str,
    /// One route.
    pub left: &'static str,
    /// The other route.
    pub right: &'static str,
    /// Largest difference relative to 1 + the largest entry.
    pub difference: f64,
    /// Local coordinates.
    pub q: Vec<f64>,
    /// Local rates.
    pub qd: Vec<f64>,
    /// Time.   \[s\]
    pub t: f64,
}

impl std::fmt::Debug for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}

/// Largest relative difference between routes that counts as rounding.
pub const ROUTES_TOLERANCE: f64 = 1e-12;
/// Largest relative difference from central differences (step 1e-5) that counts as their own error.
pub const DIFFERENCES_TOLERANCE: f64 = 1e-6;

/// Asserts that all routes to the derivatives of `equation` agree, at 24 states spread over ±2 (m, rad, /s) and t in 0..4 s.
///
/// For a test: panics with the term and the state where they do not agree. [`compare`] returns the same as a value.
pub fn derivatives<E: Equation<N, M> + Clone, const N: usize, const M: usize>(equation: E) {
    if let Err(mismatch) = compare::<E, N, M>(&equation) {
        panic!("{mismatch}");
    }
}

/// Compares all routes to the derivatives of `equation` at 24 states; the first disagreement is the error.
pub fn compare<E: Equation<N, M> + Clone, const N: usize, const M: usize>(equation: &E) -> Result<Report, Box<Mismatch>> {
    let mut report = Report { routes: 0.0, differences: 0.0, states: 0 };
    let mut spread = Spread(0x9E37_79B9_7F4A_7C15);
    for _ in 0..24 {
        let (q, qd) = (spread.vector::<N>(), spread.vector::<N>());
        let t = spread.next() + 2.0;
        at_state::<E, N, M>(equation, &q, &qd, t, &mut report)?;
    }
    Ok(report)
}

/// Compares all routes at one state of one's own choice.
pub fn at<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
) -> Result<Report, Box<Mismatch>> {
    let mut report = Report { routes: 0.0, differences: 0.0, states: 0 };
    at_state::<E, N, M>(equation, q, qd, t, &mut report)?;
    Ok(report)
}

fn at_state<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
    report: &mut Report,
) -> Result<(), Box<Mismatch>> {
    let own = terms(equation, q, qd, t);
    let dual = dual_terms::<E, N, M>(equation, q, qd, t);
    let central = Central::new::<E, N, M>(equation, q, qd, t);
    if !own.is_finite() && !dual.is_finite() {
        return Ok(());
    }
    report.states += 1;
    let mismatch = |term, right, difference| {
        let (kind, left) = (equation.kind().to_owned(), "its own route");
        Box::new(Mismatch { kind, term, left, right, difference, q: q.to_vec(), qd: qd.to_vec(), t })
    };
    // The three parts of Q_d come from one right side, so they are exact to rounding of the largest of them.
    let parts = [&own.c_qqd_qd, &own.c_tt, &own.c_qt_qd, &own.q_d].iter().map(|v| v.amax()).fold(0.0, f64::max);
    for (term, a, b) in pairs(&own, &dual) {
        let scale = if matches!(term, "(C_q qd)_q qd" | "C_qt qd" | "C_tt" | "Q_d") { parts } else { b.amax() };
        let difference = (&a - &b).amax() / (1.0 + scale);
        report.routes = report.routes.max(difference);
        if difference.is_nan() || difference > ROUTES_TOLERANCE {
            return Err(mismatch(term, "dual numbers", difference));
        }
    }
    if let Some((term, difference)) = broken_promise::<E, N, M>(equation, q, qd, t, &dual) {
        return Err(Box::new(Mismatch { left: "what it promises", ..*mismatch(term, "dual numbers", difference) }));
    }
    if !central.reliable {
        return Ok(());
    }
    for (term, a, b) in
        [("C_q", own.c_q.clone(), &central.c_q), ("C_t", column(&own.c_t), &central.c_t), ("Q_d", column(&own.q_d), &central.q_d)]
    {
        let difference = (&a - b).amax() / (1.0 + b.amax());
        report.differences = report.differences.max(difference);
        if difference.is_nan() || difference > DIFFERENCES_TOLERANCE {
            return Err(mismatch(term, "central differences", difference));
        }
    }
    Ok(())
}

/// The first term that is not what [`Constraint::depends`](crate::Constraint::depends) or `constants` promises, and how far off it is.
fn broken_promise<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
    equation: &E,
    q: &[f64; N],
    qd: &[f64; N],
    t: f64,
    now: &Terms,
) -> Option<(&'static str, f64)> {
    let (depends, later) = (equation.depends(), dual_terms::<E, N, M>(equation, q, qd, t + 1.0));
    let constant = |(&(row, column), &constant): (&(usize, usize), &Option<f64>)| constant.map(|c| (now.c_q[(row, column)] - c).abs());
    let constants = equation.pattern().iter().zip(equation.constants()).filter_map(constant).fold(0.0, f64::max);
    let largest = |may: bool, difference: DMatrix<f64>| if may { 0.0 } else { difference.amax() };
    let found = [
        ("C at another t", largest(depends.c_on_t, column(&(&later.c - &now.c))), now.c.amax()),
        ("C_q at another t", largest(depends.c_q_on_t, &later.c_q - &now.c_q), now.c_q.amax()),
        ("C_t", largest(depends.c_t, column(&now.c_t)), 0.0),
        ("Q_d", largest(depends.q_d, column(&now.q_d)), 0.0),
        ("a constant of C_q", constants, now.c_q.amax()),
    ];
    let relative = found.map(|(term, difference, size)| (term, difference / (1.0 + size)));
    relative.into_iter().find(|(_, difference)| *difference > ROUTES_TOLERANCE)
}

fn column(v: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_column_slice(v.len(), 1, v.as_slice())
}

fn pairs(a: &Terms, b: &Terms) -> [(&'static str, DMatrix<f64>, DMatrix<f64>); 7] {
    [
        ("C", column(&a.c), column(&b.c)),
        ("C_q", a.c_q.clone(), b.c_q.clone()),
        ("C_t", column(&a.c_t), column(&b.c_t)),
        ("(C_q qd)_q qd", column(&a.c_qqd_qd), column(&b.c_qqd_qd)),
        ("C_qt qd", column(&a.c_qt_qd), column(&b.c_qt_qd)),
        ("C_tt", column(&a.c_tt), column(&b.c_tt)),
        ("Q_d", column(&a.q_d), column(&b.q_d)),
    ]
}

/// Central differences of the plain function: C_q and C_t from C, Q_d from C_q q̇ + C_t along the motion.
struct Central {
    c_q: DMatrix<f64>,
    c_t: DMatrix<f64>,
    q_d: DMatrix<f64>,
    /// Whether two step sizes agree: not so beside a kink or a singularity, where central differences say nothing.
    reliable: bool,
}

impl Central {
    fn new<E: Equation<N, M> + Clone, const N: usize, const M: usize>(equation: &E, q: &[f64; N], qd: &[f64; N], t: f64) -> Self {
        let fine = Self::with_step::<E, N, M>(equation, q, qd, t, 1e-5);
        let coarse = Self::with_step::<E, N, M>(equation, q, qd, t, 4e-5);
        let agree = |a: &DMatrix<f64>, b: &DMatrix<f64>| (a - b).amax() <= 0.3 * DIFFERENCES_TOLERANCE * (1.0 + a.amax());
        let reliable = agree(&fine.c_q, &coarse.c_q) && agree(&fine.c_t, &coarse.c_t) && agree(&fine.q_d, &coarse.q_d);
        Central { reliable, ..fine }
    }

    fn with_step<E: Equation<N, M> + Clone, const N: usize, const M: usize>(
        equation: &E,
        q: &[f64; N],
        qd: &[f64; N],
        t: f64,
        h: f64,
    ) -> Self {
        let slope = |direction: &[f64; N], along_t: f64| -> DVector<f64> {
            let value = |s: f64| {
                let moved = std::array::from_fn(|k| q[k] + s * direction[k]);
                DVector::from_row_slice(&equation.plain(&moved, t + s * along_t))
            };
            (value(h) - value(-h)) / (2.0 * h)
        };
        let columns: Vec<DVector<f64>> = (0..N).map(|k| slope(&std::array::from_fn(|i| f64::from(u8::from(i == k))), 0.0)).collect();
        let c_q = if N == 0 { DMatrix::zeros(M, 0) } else { DMatrix::from_columns(&columns) };
        // −d/ds (C_q q̇ + C_t) along (q̇, 1), from the first derivatives by dual numbers.
        let rate = |s: f64| {
            let moved: [f64; N] = std::array::from_fn(|k| q[k] + s * qd[k]);
            let at = dual_terms::<E, N, M>(equation, &moved, qd, t + s);
            at.c_q * DVector::from_row_slice(qd) + at.c_t
        };
        let q_d = -(rate(h) - rate(-h)) / (2.0 * h);
        Central { c_q, c_t: column(&slope(&[0.0; N], 1.0)), q_d: column(&q_d), reliable: true }
    }
}

/// Reproducible numbers spread over ±2 (SplitMix64).
struct Spread(u64);

impl Spread {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 * 4.0 - 2.0
    }

    fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.next())
    }
}
