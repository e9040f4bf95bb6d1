//! Laws made of laws: sums, multiples and compositions, exact to the third derivative.

use std::ops::{Add, Mul, Neg, Sub};

use super::{Law, LawFunction};

impl Law {
    /// f(g(x)), this law after `inner`.
    pub fn compose(&self, inner: &Law) -> Law {
        Law::new(Composed { outer: self.clone(), inner: inner.clone() })
    }

    /// f(x − x0): the same curve, x0 later.
    pub fn shifted(&self, x0: f64) -> Law {
        self.compose(&Law::linear(-x0, 1.0))
    }
}

impl Add for Law {
    type Output = Law;

    fn add(self, other: Law) -> Law {
        Law::new(Sum { first: self, second: other })
    }
}

impl Sub for Law {
    type Output = Law;

    fn sub(self, other: Law) -> Law {
        self + (-other)
    }
}

impl Neg for Law {
    type Output = Law;

    fn neg(self) -> Law {
        -1.0 * self
    }
}

impl Mul<Law> for f64 {
    type Output = Law;

    fn mul(self, law: Law) -> Law {
        Law::new(Multiple { factor: self, law })
    }
}

impl Mul<f64> for Law {
    type Output = Law;

    fn mul(self, factor: f64) -> Law {
        factor * self
    }
}

/// f + g
struct Sum {
    first: Law,
    second: Law,
}

impl LawFunction for Sum {
    fn jet(&self, x: f64) -> [f64; 4] {
        let (f, g) = (self.first.jet(x), self.second.jet(x));
        std::array::from_fn(|k| f[k] + g[k])
    }

    fn kind(&self) -> &str {
        "sum"
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("first".to_string(), self.first.clone()), ("second".to_string(), self.second.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        show(&self.first, "first", visit);
        show(&self.second, "second", visit);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let (mut first, mut second) = (self.first.clone(), self.second.clone());
        (set(&mut first, "first", name, value) || set(&mut second, "second", name, value)).then(|| first + second)
    }
}

/// factor · f
struct Multiple {
    factor: f64,
    law: Law,
}

impl LawFunction for Multiple {
    fn jet(&self, x: f64) -> [f64; 4] {
        self.law.jet(x).map(|f| self.factor * f)
    }

    fn kind(&self) -> &str {
        "multiple"
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("law".to_string(), self.law.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        visit("factor", self.factor);
        show(&self.law, "law", visit);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        if name == "factor" {
            return Some(value * self.law.clone());
        }
        let mut law = self.law.clone();
        set(&mut law, "law", name, value).then(|| self.factor * law)
    }
}

/// f(g(x))
struct Composed {
    outer: Law,
    inner: Law,
}

impl LawFunction for Composed {
    /// The chain rule to the third order (Faà di Bruno).
    fn jet(&self, x: f64) -> [f64; 4] {
        let [g, g1, g2, g3] = self.inner.jet(x);
        let [f, f1, f2, f3] = self.outer.jet(g);
        [f, f1 * g1, f2 * g1 * g1 + f1 * g2, f3 * g1 * g1 * g1 + 3.0 * f2 * g1 * g2 + f1 * g3]
    }

    fn kind(&self) -> &str {
        "composed"
    }

    fn parts(&self) -> Vec<(String, Law)> {
        vec![("outer".to_string(), self.outer.clone()), ("inner".to_string(), self.inner.clone())]
    }

    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        show(&self.outer, "outer", visit);
        show(&self.inner, "inner", visit);
    }

    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let (mut outer, mut inner) = (self.outer.clone(), self.inner.clone());
        (set(&mut outer, "outer", name, value) || set(&mut inner, "inner", name, value)).then(|| outer.compose(&inner))
    }
}

/// Shows the parameters of a part under its own name.
fn show(law: &Law, part: &str, visit: &mut dyn FnMut(&str, f64)) {
    law.parameters(&mut |name, value| visit(&format!("{part}.{name}"), value));
}

/// Sets a parameter of a part, if the name begins with the part's.
fn set(law: &mut Law, part: &str, name: &str, value: f64) -> bool {
    name.strip_prefix(part).and_then(|rest| rest.strip_prefix('.')).is_some_and(|rest| law.set_parameter(rest, value))
}
