//! Describes the singular positions of a motion for its report.

use crate::outcome::motion::{Branch, SingularKind, SingularPosition};
use crate::solve::newton::Newton;
use crate::system::System;
use crate::system::singular::{self, Singular};

/// Pivots below this value vanish at the same singular position, because q is accurate to half of
/// its digits there. \[-\]
const AT_ONCE: f64 = 1e-7;

impl SingularPosition {
    /// Creates the singular position at q and t, with names from the null vectors of C_q.
    pub(super) fn new(
        system: &System,
        kind: SingularKind,
        t: f64,
        q: &[f64],
        branches: Vec<Branch>,
    ) -> Self {
        let model = system.model();
        let values = model
            .linearize(q, t)
            .map(|point| point.values)
            .unwrap_or_else(|_| vec![0.0; model.equations.entries.len()]);
        let Singular { movable, dependent, .. } =
            singular::singular_within(&model, &values, &model.measure(q, t), AT_ONCE);
        SingularPosition { t, kind, q: q.to_vec(), movable, dependent, branches }
    }
}

/// Drivers that move nothing by more than this within a step of time are at rest. \[-\]
const STILL: f64 = 1e-12;
/// If a coordinate that enters all equations linearly is this many times as fast as the others, its
/// displacement is its scale. \[-\]
const OUTRUN: f64 = 100.0;

/// The scales of the curve through (q, t).
pub(super) struct Scales {
    pub sizes: Vec<f64>,
    pub time: f64,
}

/// Returns the sizes of coordinates for the check of steps, and the scale of time.
///
/// Along a coordinate with a constant column of C_q no equation bends, so its size is arbitrary. If
/// such a coordinate moves fast (a feed, a carriage), the others must not seem at rest. Its size is
/// then its displacement while the fastest of the others moves by its size.
pub(super) fn scales(newton: &Newton<'_>, q: &[f64], t: f64, h: f64) -> Scales {
    let time = time(newton, q, t, h);
    let mut sizes = newton.sizes.clone();
    let equations = newton.system.equations();
    let mut is_linear = vec![true; sizes.len()];
    for (entry, constant) in equations.entries.iter().zip(&equations.constants) {
        if let (Some((_, column)), None) = (entry, constant) {
            is_linear[*column] = false;
        }
    }
    let paces = newton.qd.iter().zip(&sizes).zip(&is_linear).filter(|(_, is_linear)| !**is_linear);
    let fastest = paces.fold(0.0_f64, |most, ((qd, size), _)| most.max((qd / size).abs()));
    let slower = fastest.recip().min(h.abs());
    if !(slower > OUTRUN * time && slower.is_finite()) {
        return Scales { sizes, time };
    }
    for ((size, qd), _) in
        sizes.iter_mut().zip(newton.qd.iter()).zip(&is_linear).filter(|(_, is_linear)| **is_linear)
    {
        *size = size.max(qd.abs() * slower);
    }
    Scales { sizes, time: slower }
}

/// Returns the scale of time: the time in which the fastest driver moves something of order 1, or
/// the step of time if all drivers rest or begin to move.
pub(super) fn time(newton: &Newton<'_>, q: &[f64], t: f64, h: f64) -> f64 {
    let c_t = newton.system.model().c_t(q, t).unwrap_or_default();
    let fastest = c_t
        .iter()
        .zip(newton.linear.norms())
        .fold(0.0_f64, |most, (c_t, norm)| most.max((c_t / norm).abs()));
    if fastest.is_finite() && fastest * h.abs() > STILL { fastest.recip() } else { h.abs() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::options::SolverOptions;
    use crate::{Mechanism, constraint};

    /// a x = k t, and y beside it, on which time does less.
    #[constraint]
    fn moved(x: Coord, y: Coord, t: Time, a: f64, k: f64) -> [f64; 2] {
        [a * x - k * t, y - 1e-3 * t]
    }

    /// The time that the fastest driver needs to move something of order 1; the step where all
    /// stand still, or where that time is not a number.
    #[test]
    fn the_measure_of_time() {
        let measure = |a: f64, k: f64, h: f64| {
            let mut m = Mechanism::new("moved");
            let [x, y] = ["x", "y"].map(|name| m.length(name, 0.0).expect("a new name"));
            m.add("c", moved(x, y, a, k)).expect("adds");
            let system = m.build().expect("builds");
            let options = SolverOptions::default();
            let mut newton = Newton::new(&system, &options);
            newton.linearize(0.0).expect("is regular");
            (time(&newton, &[0.0, 0.0], 0.0, h), newton.linear.norms().to_vec())
        };
        for (a, k) in [(1.0, 3.0), (0.5, -20.0), (1e-6, 1e-4)] {
            let (found, norms) = measure(a, k, 0.1);
            let exact = (norms[0] / k.abs()).min(norms[1] / 1e-3);
            assert!((found / exact - 1.0).abs() < 1e-14, "{a} {k}: {found} {exact}");
        }
        assert_eq!((measure(1e-20, 1e300, 0.1).0, measure(1e-20, 1e300, -0.1).0), (0.1, 0.1));
        // A driver that is nearly at rest at the beginning of a step tells little about the rest of
        // it.
        assert_eq!(measure(1.0, 1e-4, 1e-10).0, 1e-10);
        let still = {
            let mut m = Mechanism::new("still");
            let x = m.length("x", 1.0).expect("a new name");
            m.add("c", crate::joints::drivers::drive(x, crate::Law::constant(1.0))).expect("adds");
            m.build().expect("builds")
        };
        let options = SolverOptions::default();
        let mut newton = Newton::new(&still, &options);
        newton.linearize(0.0).expect("is regular");
        assert_eq!([0.25, -0.25].map(|h| time(&newton, &[1.0], 0.0, h)), [0.25, 0.25]);
    }
}
