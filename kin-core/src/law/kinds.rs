//! The kinds of laws that ship: one constructor, one formula, one jet each.

use super::{Law, LawFunction};

impl Law {
    /// f(x) = c.
    pub fn constant(c: f64) -> Law {
        Law::new(Polynomial { kind: "constant", names: &["c"], c: vec![c] })
    }

    /// f(x) = rate · x.
    pub fn ramp(rate: f64) -> Law {
        Law::new(Ramp { rate })
    }

    /// f(x) = f0 + rate · x.
    pub fn linear(f0: f64, rate: f64) -> Law {
        Law::new(Polynomial { kind: "linear", names: &["f0", "rate"], c: vec![f0, rate] })
    }

    /// f(x) = c\[0\] + c\[1\] x + c\[2\] x² + …; zero for no coefficient.
    pub fn polynomial(c: &[f64]) -> Law {
        Law::new(Polynomial { kind: "polynomial", names: &[], c: c.to_vec() })
    }

    /// f(x) = mean + amplitude · sin x.
    pub fn harmonic(mean: f64, amplitude: f64) -> Law {
        Law::new(Sine { kind: "harmonic", mean, amplitude, omega: 1.0, phase: 0.0 })
    }

    /// f(x) = amplitude · sin(omega · x + phase).
    pub fn sine(amplitude: f64, omega: f64, phase: f64) -> Law {
        Law::new(Sine { kind: "sine", mean: 0.0, amplitude, omega, phase })
    }
}

/// rate · x
struct Ramp {
    rate: f64,
}

impl LawFunction for Ramp {
    fn jet(&self, x: f64) -> [f64; 4] {
        [self.rate * x, self.rate, 0.0, 0.0]
    }

    fn kind(&self) -> &str {
        "ramp"
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("rate", self.rate);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        (name == "rate").then(|| Law::ramp(value))
    }
}

/// Σ c_k x^k
#[derive(Clone)]
struct Polynomial {
    kind: &'static str,
    /// Names of the coefficients; `c[k]` where there is none.
    names: &'static [&'static str],
    c: Vec<f64>,
}

impl Polynomial {
    fn name(&self, k: usize) -> String {
        self.names.get(k).map_or_else(|| format!("c[{k}]"), |name| name.to_string())
    }
}

impl LawFunction for Polynomial {
    /// Horner's rule for f, f′, f″/2, f‴/6 at once.
    fn jet(&self, x: f64) -> [f64; 4] {
        let step = |[f, f1, f2, f3]: [f64; 4], c: &f64| [f * x + c, f1 * x + f, f2 * x + f1, f3 * x + f2];
        let [f, f1, f2, f3] = self.c.iter().rev().fold([0.0; 4], step);
        [f, f1, 2.0 * f2, 6.0 * f3]
    }

    fn kind(&self) -> &str {
        self.kind
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.c.iter().enumerate().for_each(|(k, c)| visit(&self.name(k), *c));
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        let k = (0..self.c.len()).find(|&k| self.name(k) == name)?;
        *changed.c.get_mut(k)? = value;
        Some(Law::new(changed))
    }
}

/// mean + amplitude · sin(omega · x + phase)
#[derive(Clone)]
struct Sine {
    kind: &'static str,
    mean: f64,
    amplitude: f64,
    omega: f64,
    phase: f64,
}

impl LawFunction for Sine {
    fn jet(&self, x: f64) -> [f64; 4] {
        let w = self.omega;
        let (s, c) = (w * x + self.phase).sin_cos();
        let (s, c) = (self.amplitude * s, self.amplitude * c);
        [self.mean + s, w * c, -w * w * s, -w * w * w * c]
    }

    fn kind(&self) -> &str {
        self.kind
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        if self.kind == "harmonic" {
            visit("mean", self.mean);
            visit("amplitude", self.amplitude);
        } else {
            visit("amplitude", self.amplitude);
            visit("omega", self.omega);
            visit("phase", self.phase);
        }
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        *match (name, self.kind) {
            ("amplitude", _) => &mut changed.amplitude,
            ("mean", "harmonic") => &mut changed.mean,
            ("omega", "sine") => &mut changed.omega,
            ("phase", "sine") => &mut changed.phase,
            _ => return None,
        } = value;
        Some(Law::new(changed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Law> {
        vec![
            Law::constant(-3.0),
            Law::ramp(2.5),
            Law::linear(0.4, -1.5),
            Law::polynomial(&[1.0, -2.0, 0.5, 3.0, -0.25]),
            Law::polynomial(&[]),
            Law::harmonic(0.3, 0.05),
            Law::sine(2.0, 3.0, 0.5),
            2.0 * (Law::harmonic(0.3, 0.05) + Law::ramp(1.0)) - 0.5 * Law::sine(1.0, 2.0, 0.0),
            Law::sine(2.0, 3.0, 0.5).compose(&Law::polynomial(&[0.1, 1.0, 0.5])),
            -Law::polynomial(&[0.0, 0.0, 0.0, 1.0]).shifted(0.5),
        ]
    }

    /// Each derivative against the central difference of the one before.
    #[test]
    fn each_jet_is_consistent() {
        for law in all() {
            for x in [-1.7, 0.0, 0.3, 2.0] {
                let h = 1e-5;
                let (jet, after, before) = (law.jet(x), law.jet(x + h), law.jet(x - h));
                for order in 0..3 {
                    let difference = (after[order] - before[order]) / (2.0 * h);
                    let exact = jet[order + 1];
                    assert!((difference - exact).abs() < 2e-7 * (1.0 + exact.abs()), "{law:?} at {x}, order {order}: {difference} {exact}");
                }
            }
        }
    }

    #[test]
    fn each_parameter_can_be_read_and_set() {
        for law in all() {
            let mut names = Vec::new();
            law.parameters(&mut |name, _| names.push(name.to_string()));
            for name in names {
                let mut changed = law.clone();
                assert!(changed.set_parameter(&name, 0.125), "{law:?}: {name}");
                let mut value = None;
                changed.parameters(&mut |known, x| value = value.or((known == name).then_some(x)));
                assert_eq!(value, Some(0.125), "{law:?}: {name}");
            }
            assert!(!law.clone().set_parameter("nonsense", 1.0));
        }
    }

    #[test]
    fn values_are_those_of_the_formula() {
        assert_eq!(Law::polynomial(&[1.0, 2.0, 3.0]).jet(2.0), [17.0, 14.0, 6.0, 0.0]);
        assert_eq!(Law::linear(1.0, 2.0).at(3.0), 7.0);
        assert_eq!(Law::harmonic(0.3, 0.05).at(0.0), 0.3);
        assert_eq!(Law::constant(4.0).jet(1.0), [4.0, 0.0, 0.0, 0.0]);
    }
}
