//! Creates lines, polynomials, sines and Fourier series.

use std::f64::consts::FRAC_PI_2;

use kin_graph::{Function, Graph, Node};

use super::{Law, LawFunction, trusted_parts};
use crate::dimensions::IntoNumber;
use crate::numbers::enclosure::Series;

impl Law {
    /// Returns the constant law f(x) = c.
    pub fn constant(c: impl IntoNumber) -> Law {
        Law::hanging(|to| Polynomial {
            kind: "constant",
            names: &["c"],
            c: vec![to.number("c", c)],
        })
    }

    /// Returns the law of constant rate f(x) = rate · x.
    pub fn ramp(rate: impl IntoNumber) -> Law {
        Law::hanging(|to| Ramp { rate: to.number("rate", rate) })
    }

    /// Returns the straight line f(x) = f0 + rate · x.
    pub fn linear(f0: impl IntoNumber, rate: impl IntoNumber) -> Law {
        Law::hanging(|to| {
            let c = vec![to.number("f0", f0), to.number("rate", rate)];
            Polynomial { kind: "linear", names: &["f0", "rate"], c }
        })
    }

    /// Returns the polynomial f(x) = c\[0\] + c\[1\] x + c\[2\] x² + ….
    ///
    /// If the list of coefficients is empty, the law is zero.
    pub fn polynomial(c: &[impl IntoNumber]) -> Law {
        Law::hanging(|to| Polynomial {
            kind: "polynomial",
            names: &[],
            c: to.list("c", 0, c.iter().copied()),
        })
    }

    /// Returns the harmonic law f(x) = mean + amplitude · sin x.
    pub fn harmonic(mean: impl IntoNumber, amplitude: impl IntoNumber) -> Law {
        Law::hanging(|to| {
            let mean = to.number("mean", mean);
            let amplitude = to.number("amplitude", amplitude);
            Sine { kind: "harmonic", mean, amplitude, omega: 1.0, phase: 0.0 }
        })
    }

    /// Returns the sine law f(x) = amplitude · sin(omega · x + phase).
    pub fn sine(amplitude: impl IntoNumber, omega: impl IntoNumber, phase: impl IntoNumber) -> Law {
        Law::hanging(|to| {
            let amplitude = to.number("amplitude", amplitude);
            let omega = to.number("omega", omega);
            Sine { kind: "sine", mean: 0.0, amplitude, omega, phase: to.number("phase", phase) }
        })
    }

    /// Returns the Fourier series f(x) = mean + Σ a_k cos(k · omega · x) + b_k sin(k · omega · x).
    ///
    /// The index k = 1, 2, … counts the pairs (a_k, b_k).
    pub fn fourier<N: IntoNumber>(
        mean: impl IntoNumber,
        omega: impl IntoNumber,
        pairs: &[(N, N)],
    ) -> Law {
        Law::hanging(|to| {
            let mean = to.number("mean", mean);
            let omega = to.number("omega", omega);
            let a = to.list("a", 1, pairs.iter().map(|pair| pair.0));
            let b = to.list("b", 1, pairs.iter().map(|pair| pair.1));
            Fourier { mean, omega, pairs: a.into_iter().zip(b).collect() }
        })
    }
}

/// The law rate · x.
struct Ramp {
    rate: f64,
}

impl LawFunction for Ramp {
    fn jet(&self, x: f64) -> [f64; 4] {
        [self.rate * x, self.rate, 0.0, 0.0]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let rate = graph.constant(self.rate);
        Some(graph.mul(rate, x))
    }

    fn kind(&self) -> &str {
        "ramp"
    }

    fn description(&self) -> &str {
        "Constant rate from zero: f(x) = rate · x."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(x.times(self.rate))
    }

    fn fourth(&self, _: f64) -> f64 {
        0.0
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("rate", self.rate);
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        (name == "rate").then(|| Law::ramp(1.0))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        (name == "rate").then(|| Law::ramp(value))
    }
}

/// The law Σ c_k x^k.
#[derive(Clone)]
struct Polynomial {
    kind: &'static str,
    /// Names of the coefficients. A coefficient beyond the end of the list is named `c[k]`.
    names: &'static [&'static str],
    c: Vec<f64>,
}

impl Polynomial {
    /// Returns f, f′, f″/2, f‴/6, f⁗/24 at x.
    fn taylor(&self, x: f64) -> [f64; 5] {
        let step = |[f, f1, f2, f3, f4]: [f64; 5], c: &f64| {
            [f * x + c, f1 * x + f, f2 * x + f1, f3 * x + f2, f4 * x + f3]
        };
        self.c.iter().rev().fold([0.0; 5], step)
    }

    fn name(&self, k: usize) -> String {
        self.names.get(k).map_or_else(|| format!("c[{k}]"), |name| name.to_string())
    }
}

impl LawFunction for Polynomial {
    /// Horner's rule for the value and all derivatives in one pass.
    fn jet(&self, x: f64) -> [f64; 4] {
        let [f, f1, f2, f3, _] = self.taylor(x);
        [f, f1, 2.0 * f2, 6.0 * f3]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let zero = graph.zero();
        let step = |sum, c: &f64| {
            let product = graph.mul(sum, x);
            let c = graph.constant(*c);
            graph.add(product, c)
        };
        Some(self.c.iter().rev().fold(zero, step))
    }

    fn kind(&self) -> &str {
        self.kind
    }

    fn description(&self) -> &str {
        match self.kind {
            "constant" => "Constant value: f(x) = c.",
            "linear" => "Straight line: f(x) = f0 + rate · x.",
            _ => "Polynomial: f(x) = c[0] + c[1] x + c[2] x² + ….",
        }
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(self.c.iter().rev().fold(x.times(0.0), |sum, c| (sum * *x).plus(*c)))
    }

    fn fourth(&self, x: f64) -> f64 {
        24.0 * self.taylor(x)[4]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.c.iter().enumerate().for_each(|(k, c)| visit(&self.name(k), *c));
    }

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let mut power = vec![0.0; self.c.len()];
        *power.get_mut((0..self.c.len()).find(|&k| self.name(k) == name)?)? = 1.0;
        Some(Law::polynomial(&power))
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        let k = (0..self.c.len()).find(|&k| self.name(k) == name)?;
        *changed.c.get_mut(k)? = value;
        Some(Law::new(changed))
    }
}

/// The law mean + amplitude · sin(omega · x + phase).
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
        let s = self.amplitude * s;
        let c = self.amplitude * c;
        [self.mean + s, w * c, -w * w * s, -w * w * w * c]
    }

    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let [mean, amplitude, omega, phase] =
            [self.mean, self.amplitude, self.omega, self.phase].map(|c| graph.constant(c));
        let turned = graph.mul(omega, x);
        let angle = graph.add(turned, phase);
        let sin = graph.call(Function::Sin, angle);
        let wave = graph.mul(amplitude, sin);
        Some(graph.add(mean, wave))
    }

    fn kind(&self) -> &str {
        self.kind
    }

    fn description(&self) -> &str {
        match self.kind {
            "harmonic" => "Harmonic: f(x) = mean + amplitude · sin x.",
            _ => "Sine: f(x) = amplitude · sin(omega · x + phase).",
        }
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        Some(x.times(self.omega).plus(self.phase).sin_cos().0.times(self.amplitude).plus(self.mean))
    }

    fn fourth(&self, x: f64) -> f64 {
        self.amplitude * self.omega.powi(4) * (self.omega * x + self.phase).sin()
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

    fn by_parameter(&self, name: &str) -> Option<Law> {
        let cosine = Law::sine(self.amplitude, self.omega, self.phase + FRAC_PI_2);
        match name {
            "mean" => Some(Law::constant(1.0)),
            "amplitude" => Some(Law::sine(1.0, self.omega, self.phase)),
            "omega" => Some(Law::ramp(1.0) * cosine),
            "phase" => Some(cosine),
            _ => None,
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

/// The law mean + Σ a_k cos(k omega x) + b_k sin(k omega x).
#[derive(Clone)]
struct Fourier {
    mean: f64,
    omega: f64,
    pairs: Vec<(f64, f64)>,
}

impl Fourier {
    /// Returns the value and the derivatives up to the fourth.
    fn derivatives(&self, x: f64) -> [f64; 5] {
        let mut all = [self.mean, 0.0, 0.0, 0.0, 0.0];
        for (k, (a, b)) in (1..).zip(&self.pairs) {
            let w = f64::from(k) * self.omega;
            let (sin, cos) = (w * x).sin_cos();
            let even = a * cos + b * sin;
            let odd = b * cos - a * sin;
            let terms = [even, w * odd, -w * w * even, -w * w * w * odd, w.powi(4) * even];
            all.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
        all
    }
}

impl LawFunction for Fourier {
    fn jet(&self, x: f64) -> [f64; 4] {
        let [f, f1, f2, f3, _] = self.derivatives(x);
        [f, f1, f2, f3]
    }

    fn kind(&self) -> &str {
        "fourier"
    }

    fn description(&self) -> &str {
        "Fourier series: f(x) = mean + Σ a_k cos(k · omega · x) + b_k sin(k · omega · x)."
    }

    fn trusted(&self) -> Vec<String> {
        trusted_parts(self)
    }

    fn over(&self, x: &Series) -> Option<Series> {
        let term = |(k, (a, b)): (f64, &(f64, f64))| {
            let (sin, cos) = x.times(self.omega).times(k).sin_cos();
            cos.times(*a) + sin.times(*b)
        };
        let harmonics = (1..).map(f64::from).zip(&self.pairs);
        Some(harmonics.map(term).fold(x.times(0.0).plus(self.mean), |sum, term| sum + term))
    }

    fn fourth(&self, x: f64) -> f64 {
        self.derivatives(x)[4]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("mean", self.mean);
        visit("omega", self.omega);
        for (k, (a, b)) in self.pairs.iter().enumerate() {
            visit(&format!("a[{}]", k + 1), *a);
            visit(&format!("b[{}]", k + 1), *b);
        }
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let mut changed = self.clone();
        let place = match name {
            "mean" => &mut changed.mean,
            "omega" => &mut changed.omega,
            _ => {
                let k = (0..self.pairs.len())
                    .find(|k| name.get(1..) == Some(&format!("[{}]", k + 1)))?;
                let (a, b) = &mut changed.pairs[k];
                match name.as_bytes().first()? {
                    b'a' => a,
                    b'b' => b,
                    _ => return None,
                }
            }
        };
        *place = value;
        Some(Law::new(changed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::tests::near;

    #[test]
    fn fourth_derivatives() {
        let law = Law::polynomial(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        // 24 · 5 + 120 · 6 x + 360 · 7 x²
        near(law.fourth(-1.5), 120.0 - 1080.0 + 5670.0, 1e-14);
        near(Law::sine(2.0, 3.0, 0.5).fourth(0.7), 162.0 * 2.6_f64.sin(), 1e-14);
        let fourier = Law::fourier(9.0, 2.0, &[(0.5, 0.25), (-1.0, 0.75)]);
        let [one, two] = [1.4_f64, 2.8].map(f64::sin_cos);
        near(
            fourier.fourth(0.7),
            16.0 * (0.5 * one.1 + 0.25 * one.0) + 256.0 * (0.75 * two.0 - two.1),
            1e-14,
        );
        assert_eq!((Law::ramp(2.0).fourth(1.0), Law::constant(2.0).fourth(1.0)), (0.0, 0.0));
    }

    #[test]
    fn kinds() {
        let all = [
            (Law::constant(1.0), "constant"),
            (Law::ramp(1.0), "ramp"),
            (Law::linear(0.0, 1.0), "linear"),
            (Law::polynomial(&[1.0]), "polynomial"),
            (Law::harmonic(0.0, 1.0), "harmonic"),
            (Law::sine(1.0, 1.0, 0.0), "sine"),
            (Law::fourier(0.0, 1.0, &[(0.0, 0.0); 0]), "fourier"),
        ];
        all.iter().for_each(|(law, kind)| assert_eq!(law.kind(), *kind));
    }
}
