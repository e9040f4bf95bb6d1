//! Implements the constructors of the graph, which fold and simplify exactly: zeros, ones, signs,
//! common factors, constants.
//!
//! No simplification uses a tolerance. Kin folds constants as f64 computes them; in a graph without
//! rounding only if the result is exact. `0 · x → 0` and `x − x → 0` hide a NaN or infinity in x.
//! All other simplifications keep the value up to rounding.

use super::{Graph, Input, Node, Op, Part};
use crate::{Function, Function2};

impl Graph {
    pub fn constant(&mut self, value: f64) -> Node {
        // −0.0 and 0.0 are one constant, so that a structural zero is recognised.
        let value = if value == 0.0 { 0.0 } else { value };
        self.intern(Op::Constant(value.to_bits()))
    }

    pub fn zero(&mut self) -> Node {
        self.constant(0.0)
    }

    pub fn is_zero(&self, a: Node) -> bool {
        self.constant_value(a) == Some(0.0)
    }

    fn is_one(&self, a: Node) -> bool {
        self.constant_value(a) == Some(1.0)
    }

    /// The result of an operation on constants as f64 computes it, unless it is rounded and the
    /// graph is as written.
    fn folded(&mut self, result: f64, exact: bool) -> Option<Node> {
        self.rounded |= !exact;
        (exact || !self.as_written).then(|| self.constant(result))
    }

    /// x, if `a` is −x (or a negative constant).
    fn negated(&mut self, a: Node) -> Option<Node> {
        match self.op(a) {
            Op::Neg(x) => Some(x),
            Op::Constant(bits) if f64::from_bits(bits) < 0.0 => {
                Some(self.constant(-f64::from_bits(bits)))
            }
            _ => None,
        }
    }

    pub fn add(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.constant_value(a), self.constant_value(b))
            && let Some(sum) = self.folded(x + y, is_exact_sum(x, y))
        {
            return sum;
        }
        if self.is_zero(a) {
            return b; // 0 + b → b
        }
        if self.is_zero(b) {
            return a; // a + 0 → a
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => {
                let sum = self.add(x, y);
                return self.neg(sum); // −x + −y → −(x + y)
            }
            (_, Some(y)) => return self.sub(a, y), // a + −y → a − y
            (Some(x), _) => return self.sub(b, x), // −x + b → b − x
            _ => {}
        }
        if a == b {
            let two = self.constant(2.0);
            return self.mul(two, a); // a + a → 2 a
        }
        if let Some(factored) = self.factor(a, b, Graph::add) {
            return factored; // x y + x z → x (y + z)
        }
        self.intern(Op::Add(a.min(b), a.max(b)))
    }

    pub fn sub(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.constant_value(a), self.constant_value(b))
            && let Some(difference) = self.folded(x - y, is_exact_sum(x, -y))
        {
            return difference;
        }
        if a == b {
            return self.zero(); // a − a → 0
        }
        if self.is_zero(b) {
            return a; // a − 0 → a
        }
        if self.is_zero(a) {
            return self.neg(b); // 0 − b → −b
        }
        if let Some(y) = self.negated(b) {
            return self.add(a, y); // a − −y → a + y
        }
        if let Op::Neg(x) = self.op(a) {
            let sum = self.add(x, b);
            return self.neg(sum); // −x − b → −(x + b)
        }
        if let Some(factored) = self.factor(a, b, Graph::sub) {
            return factored; // x y − x z → x (y − z)
        }
        if let Some(other) = self.existing(Op::Sub(b, a)) {
            return self.intern(Op::Neg(other)); // a − b → −(b − a), if that is there
        }
        self.intern(Op::Sub(a, b))
    }

    pub fn neg(&mut self, a: Node) -> Node {
        match self.op(a) {
            Op::Constant(bits) => self.constant(-f64::from_bits(bits)),
            Op::Neg(x) => x, // −−x → x
            Op::Sub(x, y) => match self.existing(Op::Sub(y, x)) {
                Some(other) => other, // −(x − y) → y − x, if that is there
                None => self.intern(Op::Neg(a)),
            },
            _ => self.intern(Op::Neg(a)),
        }
    }

    pub fn mul(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.constant_value(a), self.constant_value(b))
            && let Some(product) = self.folded(x * y, is_exact_product(x, y, x * y))
        {
            return product;
        }
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero(); // 0 b → 0
        }
        if self.is_one(a) {
            return b; // 1 b → b
        }
        if self.is_one(b) {
            return a; // a 1 → a
        }
        match (self.negated(a), self.negated(b)) {
            (Some(x), Some(y)) => return self.mul(x, y), // −x · −y → x y
            (Some(x), None) => {
                let product = self.mul(x, b);
                return self.neg(product); // −x · b → −(x b)
            }
            (None, Some(y)) => {
                let product = self.mul(a, y);
                return self.neg(product); // a · −y → −(a y)
            }
            _ => {}
        }
        self.mul_positive(a, b)
    }

    /// Product of operands without outer sign: constants go to the left and are gathered.
    fn mul_positive(&mut self, a: Node, b: Node) -> Node {
        let (a, b) = if self.constant_value(b).is_some() { (b, a) } else { (a, b) };
        match (self.constant_value(a), self.op(b)) {
            (Some(x), Op::Mul(y, rest)) if self.constant_value(y).is_some() => {
                let y = self.constant_value(y).unwrap_or(1.0);
                match self.folded(x * y, is_exact_product(x, y, x * y)) {
                    Some(gathered) => self.mul(gathered, rest), // c (d x) → (c d) x
                    None => self.intern(Op::Mul(a, b)),
                }
            }
            (Some(_), _) => self.intern(Op::Mul(a, b)),
            _ => self.mul_variables(a, b),
        }
    }

    /// Product of two non-constants: their constant factors go to the front.
    fn mul_variables(&mut self, a: Node, b: Node) -> Node {
        let (ca, xa) = self.split_constant(a);
        let (cb, xb) = self.split_constant(b);
        if ca * cb != 1.0 && is_power_of_two(ca * cb) {
            let product = self.mul(xa, xb);
            let constant = self.constant(ca * cb);
            return self.mul(constant, product); // (c x) (d y) → (c d) (x y)
        }
        self.intern(Op::Mul(a.min(b), a.max(b)))
    }

    /// `a` as constant · rest, but only where the constant is a power of two: pulling it out is
    /// then exact.
    fn split_constant(&self, a: Node) -> (f64, Node) {
        match self.op(a) {
            Op::Mul(c, x) => match self.constant_value(c) {
                Some(c) if is_power_of_two(c) => (c, x),
                _ => (1.0, a),
            },
            _ => (1.0, a),
        }
    }

    pub fn div(&mut self, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.constant_value(a), self.constant_value(b))
            && y != 0.0
            && let Some(quotient) = self.folded(x / y, is_exact_product(x / y, y, x))
        {
            return quotient;
        }
        if self.is_zero(a) && !self.is_zero(b) {
            return a; // 0 / b → 0
        }
        if let Some(y) = self.constant_value(b)
            && is_power_of_two(y.abs())
        {
            let reciprocal = self.constant(1.0 / y);
            return self.mul(reciprocal, a); // a / 2ⁿ → 2⁻ⁿ a
        }
        if let Op::Neg(x) = self.op(a) {
            let quotient = self.div(x, b);
            return self.neg(quotient); // −x / b → −(x / b)
        }
        if let Op::Neg(y) = self.op(b) {
            let quotient = self.div(a, y);
            return self.neg(quotient); // a / −y → −(a / y)
        }
        self.intern(Op::Div(a, b))
    }

    pub fn powi(&mut self, a: Node, n: i32) -> Node {
        match n {
            0 => self.constant(1.0),
            1 => a,
            2 => self.mul(a, a),
            3 => {
                let square = self.mul(a, a);
                self.mul(square, a)
            }
            4 => {
                let square = self.mul(a, a);
                self.mul(square, square)
            }
            -1 => {
                let one = self.constant(1.0);
                self.div(one, a)
            }
            _ => match self.constant_value(a).and_then(|x| self.folded(x.powi(n), false)) {
                Some(power) => power,
                None => self.intern(Op::Powi(a, n)),
            },
        }
    }

    pub fn call(&mut self, f: Function, a: Node) -> Node {
        if let Some(x) = self.constant_value(a) {
            let y = f.value()(x);
            let exact = f.facts().is_exact() || f == Function::Sqrt && is_exact_product(y, y, x);
            if let Some(folded) = self.folded(y, exact) {
                return folded;
            }
        }
        match (f, self.op(a)) {
            // Sine and cosine of a coordinate are part of its state.
            (Function::Sin, Op::Input(Input::State(argument, Part::Theta))) => {
                self.input(Input::State(argument, Part::Sin))
            }
            (Function::Cos, Op::Input(Input::State(argument, Part::Theta))) => {
                self.input(Input::State(argument, Part::Cos))
            }
            (Function::Sin, Op::Neg(x)) => {
                let sin = self.call(Function::Sin, x);
                self.neg(sin) // sin(−x) → −sin x
            }
            (Function::Cos, Op::Neg(x)) => self.call(Function::Cos, x), // cos(−x) → cos x
            (Function::Cos, Op::Call(Function::Asin, x))
            | (Function::Sin, Op::Call(Function::Acos, x)) => {
                let rest = self.one_minus_square(x);
                self.call(Function::Sqrt, rest) // cos(arcsin x), sin(arccos x) → √(1 − x²)
            }
            (Function::Tan, Op::Call(Function::Atan, x)) => x, // tan(arctan x) → x
            _ => self.intern(Op::Call(f, a)),
        }
    }

    /// Returns 1 − x² as (1 − x)(1 + x), which keeps its digits if x is near 1.
    pub fn one_minus_square(&mut self, x: Node) -> Node {
        let one = self.constant(1.0);
        let below = self.sub(one, x);
        let above = self.add(one, x);
        self.mul(below, above)
    }

    pub fn call2(&mut self, f: Function2, a: Node, b: Node) -> Node {
        if let (Some(x), Some(y)) = (self.constant_value(a), self.constant_value(b))
            && let Some(folded) = self.folded(f.value()(x, y), f.facts().exact)
        {
            return folded;
        }
        match (f, self.constant_value(b)) {
            (Function2::Powf, Some(0.0)) => self.constant(1.0), // x⁰ → 1
            (Function2::Powf, Some(1.0)) => a,                  // x¹ → x
            (Function2::Powf, Some(2.0)) => self.mul(a, a),     // x² → x x
            _ => self.intern(Op::Call2(f, a, b)),
        }
    }

    pub fn law(&mut self, law: usize, x: Node, order: u8) -> Node {
        self.intern(Op::Law(law, x, order))
    }

    /// x (y ± z) for a = x y and b = x z, where they have factors in common.
    fn factor(
        &mut self,
        a: Node,
        b: Node,
        combine: fn(&mut Graph, Node, Node) -> Node,
    ) -> Option<Node> {
        if self.bursts(a) || self.bursts(b) {
            return None; // the rest could overflow where the terms do not
        }
        let (ca, xa) = self.split_constant(a);
        let (cb, xb) = self.split_constant(b);
        if ca != cb && ca != 1.0 && cb != 1.0 && is_power_of_two(ca.max(cb) / ca.min(cb)) {
            let least = self.constant(ca.min(cb));
            let a = self.constant(ca / ca.min(cb));
            let b = self.constant(cb / ca.min(cb));
            let a = self.mul(a, xa);
            let b = self.mul(b, xb);
            let rest = combine(self, a, b);
            return Some(self.mul(least, rest)); // 4 x + 2 y → 2 (2 x + y)
        }
        let is_product = |node| matches!(self.op(node), Op::Mul(..));
        if !is_product(a) && !is_product(b) {
            return None; // two different factors
        }
        let mut left = self.factors(a);
        let mut right = self.factors(b);
        let common = left.take_common(&mut right);
        if common.as_slice().is_empty() {
            return None;
        }
        let rest_a = self.product(left.as_slice());
        let rest_b = self.product(right.as_slice());
        let rest = combine(self, rest_a, rest_b);
        let common = self.product(common.as_slice());
        Some(self.mul(common, rest))
    }

    fn product(&mut self, factors: &[Node]) -> Node {
        let Some((&first, others)) = factors.split_first() else { return self.constant(1.0) };
        others.iter().fold(first, |all, &x| self.mul(all, x))
    }
}

/// Returns true if multiplication by x only changes the exponent.
pub fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x > 0.0 && x.to_bits() & ((1 << 52) - 1) == 0
}

/// True if f64 adds x and y without rounding (Knuth).
fn is_exact_sum(x: f64, y: f64) -> bool {
    let sum = x + y;
    let back = sum - x;
    sum.is_finite() && (x - (sum - back)) + (y - back) == 0.0
}

/// True if x y is this number.
fn is_exact_product(x: f64, y: f64, product: f64) -> bool {
    /// Above this what a product loses is a number of f64 too.
    const LEAST: f64 = 1e-250;
    let zero = product == 0.0 && (x == 0.0 || y == 0.0);
    zero || product.is_finite() && product.abs() > LEAST && x.mul_add(y, -product) == 0.0
}

#[cfg(test)]
mod tests;
