//! Derivatives of equations that ask a law for its slope: those by coordinates take its fourth
//! derivative.

use kin::prelude::*;

use crate::engines::Engines;

/// y is the slope of the law at x.      [m]
#[constraint]
fn as_steep(x: Coord, y: Coord, law: Law) -> f64 {
    y - law.slope(x)
}

#[test]
fn the_slope_of_a_law_where_its_argument_moves_with_the_parameter() {
    let rate = 0.7_f64;
    let omega = 1.3_f64;
    let start = 0.2;
    let mut m = Mechanism::new("slope");
    let speed = m.dimension("speed", rate).expect("a dimension");
    let x = m.length("x", start).expect("x");
    let y = m.length("y", omega).expect("y");
    m.add("drive", drive(x, Law::linear(start, speed))).expect("adds");
    m.add("steep", as_steep(x, y, Law::sine(1.0, omega, 0.0))).expect("adds");
    let system = m.build().expect("builds");
    // One by the walk over the equations, one by the tape of the whole mechanism.
    for times in [linspace(0.0, 2.0, 5), linspace(0.0, 2.0, 80)] {
        let motion = system.run_both(&times).expect("a motion");
        let by =
            system.sensitivities(&motion, ["speed", "steep.law.amplitude"]).expect("derivatives");
        let mut sum = [0.0; 2];
        for (k, t) in times.iter().enumerate() {
            // y = f′(x), x = start + rate t, f = sin ω x
            let (s, c) = (omega * (start + rate * t)).sin_cos();
            let [f2, f3, f4] = [-omega.powi(2) * s, -omega.powi(3) * c, omega.powi(4) * s];
            let exact = [f2 * t, f2 + rate * t * f3, 2.0 * rate * f3 + rate * rate * t * f4];
            let [one, other] = [0, 1].map(|name| &by.all()[name]);
            let found = [one.q(k)[1], one.qd(k)[1], one.qdd(k)[1]];
            for (found, exact) in found.into_iter().zip(exact) {
                assert!((found - exact).abs() < 1e-12, "{t}: {found} {exact}");
            }
            let exact = [omega * c, rate * f2, rate * rate * f3];
            for (found, exact) in
                [other.q(k)[1], other.qd(k)[1], other.qdd(k)[1]].into_iter().zip(exact)
            {
                assert!((found - exact).abs() < 1e-12, "{t}: {found} {exact}");
            }
            sum[0] += one.qdd(k)[1];
            sum[1] += other.qdd(k)[1];
        }
        let gradient =
            system.gradient(&motion, ["speed", "steep.law.amplitude"], "y", |_| [0.0, 0.0, 1.0]);
        for (found, exact) in gradient.expect("a gradient").into_iter().zip(sum) {
            assert!((found - exact).abs() < 1e-11 * times.len() as f64, "{found} {exact}");
        }
    }
}
