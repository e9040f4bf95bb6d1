//! The rule table: the derivative of every function, one line each. With u the argument and y = f(u):

use crate::{Comparison, Function, Function2, Graph, Node, Op};

/// dy/du of y = f(u).
///
/// At kinks the documented side: `abs` at 0 takes +1; the steps (`floor`, `signum`, …) have derivative 0
/// everywhere.
#[rustfmt::skip]
pub fn derivative(g: &mut Graph, f: Function, u: Node, y: Node) -> Node {
    let mut e = Expressions(g);
    match f {
        Function::Sin   => e.call(Function::Cos, u),                                      // cos u
        Function::Cos   => { let s = e.call(Function::Sin, u); e.0.neg(s) }               // −sin u
        Function::Tan   => { let y2 = e.square(y); e.plus(y2, 1.0) }                      // 1 + y²
        Function::Asin  => { let r = e.one_minus_square(u); e.inverse_root(r) }           // 1/√(1 − u²)
        Function::Acos  => { let r = e.one_minus_square(u); let d = e.inverse_root(r); e.0.neg(d) } // −1/√(1 − u²)
        Function::Atan  => { let u2 = e.square(u); let r = e.plus(u2, 1.0); e.inverse(r) }    // 1/(1 + u²)
        Function::Sinh  => e.call(Function::Cosh, u),                                     // cosh u
        Function::Cosh  => e.call(Function::Sinh, u),                                     // sinh u
        Function::Tanh  => e.one_minus_square(y),                                         // 1 − y²
        Function::Asinh if e.0.bursts(u) => { let (one, two) = (e.0.constant(1.0), Function2::Hypot); let r = e.0.call2(two, u, one); e.inverse(r) } // the same, u² being too large
        Function::Asinh => { let u2 = e.square(u); let r = e.plus(u2, 1.0); e.inverse_root(r) }   // 1/√(u² + 1)
        Function::Acosh => { let u2 = e.square(u); let r = e.plus(u2, -1.0); e.inverse_root(r) }  // 1/√(u² − 1)
        Function::Atanh => { let r = e.one_minus_square(u); e.inverse(r) }                // 1/(1 − u²)
        Function::Exp   => y,                                                             // y
        Function::Exp2  => e.times(std::f64::consts::LN_2, y),                            // y ln 2
        Function::ExpM1 => e.plus(y, 1.0),                                                // y + 1
        Function::Ln    => e.inverse(u),                                                  // 1/u
        Function::Ln1p  => { let r = e.plus(u, 1.0); e.inverse(r) }                       // 1/(1 + u)
        Function::Log2  => { let r = e.times(std::f64::consts::LN_2, u); e.inverse(r) }   // 1/(u ln 2)
        Function::Log10 => { let r = e.times(std::f64::consts::LN_10, u); e.inverse(r) }  // 1/(u ln 10)
        Function::Sqrt  => { let r = e.times(2.0, y); e.inverse(r) }                      // 1/(2 y)
        Function::Cbrt  => { let y2 = e.square(y); let r = e.times(3.0, y2); e.inverse(r) }   // 1/(3 y²)
        Function::Abs   => e.side(u),                                                     // +1 if u ≥ 0, else −1
        Function::Fract => e.0.constant(1.0),                                             // 1
        Function::Signum | Function::Floor | Function::Ceil | Function::Round | Function::Trunc => e.0.zero(), // 0
    }
}

/// (∂z/∂u, ∂z/∂v) of z = f(u, v).
///
/// Not of `max` and `min`, which have the tangent of the one that is taken ([`takes_first`]).
#[rustfmt::skip]
pub fn derivatives2(g: &mut Graph, f: Function2, u: Node, v: Node, z: Node) -> (Node, Node) {
    let mut e = Expressions(g);
    match f {
        Function2::Atan2     => { let r = e.sum_of_squares(u, v); let m = e.0.neg(u); (e.0.div(v, r), e.0.div(m, r)) } // (v, −u)/(u² + v²)
        Function2::Hypot     => (e.0.div(u, z), e.0.div(v, z)),                               // (u, v)/z
        Function2::Powf      => e.power(u, v, z),                                             // (v u^(v−1), z ln u)
        Function2::Max | Function2::Min => { let first = takes_first(e.0, z); e.choice(first) } // (1, 0) if u is taken, else (0, 1)
        Function2::Rem       => { let n = e.quotient(u, v, Function::Trunc); (e.0.constant(1.0), e.0.neg(n)) } // (1, −trunc(u/v))
        Function2::RemEuclid => { let n = e.0.call2(Function2::DivEuclid, u, v); (e.0.constant(1.0), e.0.neg(n)) } // (1, −⌊u/v⌋)
        Function2::DivEuclid => (e.0.zero(), e.0.zero()),                                     // 0
    }
}

/// The condition under which `max` or `min` takes the first of two: it is not beyond the other, or that is
/// not a number.
pub fn takes_first(g: &mut Graph, z: Node) -> Node {
    let (comparison, u, v) = match g.op(z) {
        Op::Call2(Function2::Min, u, v) => (Comparison::LessEqual, u, v),
        Op::Call2(_, u, v) => (Comparison::GreaterEqual, u, v),
        _ => return g.bool(true),
    };
    let (wins, alone) = (g.compare(comparison, u, v), g.compare(Comparison::NotEqual, v, v));
    g.or(wins, alone)
}

/// n uⁿ⁻¹, the derivative of uⁿ.
pub fn power_derivative(g: &mut Graph, u: Node, n: i32) -> Node {
    let (factor, power) = (g.constant(f64::from(n)), g.powi(u, n.saturating_sub(1)));
    g.mul(factor, power)
}

/// Short names for the expressions of the table.
struct Expressions<'a>(&'a mut Graph);

impl Expressions<'_> {
    fn call(&mut self, f: Function, u: Node) -> Node {
        self.0.call(f, u)
    }

    fn square(&mut self, u: Node) -> Node {
        self.0.mul(u, u)
    }

    fn plus(&mut self, u: Node, c: f64) -> Node {
        let c = self.0.constant(c);
        self.0.add(u, c)
    }

    fn times(&mut self, c: f64, u: Node) -> Node {
        let c = self.0.constant(c);
        self.0.mul(c, u)
    }

    fn one_minus_square(&mut self, u: Node) -> Node {
        let (one, square) = (self.0.constant(1.0), self.square(u));
        self.0.sub(one, square)
    }

    fn sum_of_squares(&mut self, u: Node, v: Node) -> Node {
        let (u2, v2) = (self.square(u), self.square(v));
        self.0.add(u2, v2)
    }

    fn inverse(&mut self, u: Node) -> Node {
        let one = self.0.constant(1.0);
        self.0.div(one, u)
    }

    fn inverse_root(&mut self, u: Node) -> Node {
        let root = self.call(Function::Sqrt, u);
        self.inverse(root)
    }

    fn quotient(&mut self, u: Node, v: Node, round: Function) -> Node {
        let ratio = self.0.div(u, v);
        self.call(round, ratio)
    }

    fn side(&mut self, u: Node) -> Node {
        let (zero, plus, minus) = (self.0.zero(), self.0.constant(1.0), self.0.constant(-1.0));
        let positive = self.0.compare(Comparison::GreaterEqual, u, zero);
        self.0.select(positive, plus, minus)
    }

    fn choice(&mut self, first: Node) -> (Node, Node) {
        let (zero, one) = (self.0.zero(), self.0.constant(1.0));
        (self.0.select(first, one, zero), self.0.select(first, zero, one))
    }

    /// An exponent that depends on nothing has no derivative, so its logarithm must not spoil u ≤ 0; of one
    /// that does z ln u goes to 0 with z.
    fn power(&mut self, u: Node, v: Node, z: Node) -> (Node, Node) {
        let one = self.0.constant(1.0);
        let lower = self.0.sub(v, one);
        let power = self.0.call2(Function2::Powf, u, lower);
        let by_u = self.0.mul(v, power);
        let by_v = if self.0.depends(v).varies() {
            let (zero, ln) = (self.0.zero(), self.call(Function::Ln, u));
            let (some, product) = (self.0.compare(Comparison::NotEqual, z, zero), self.0.mul(z, ln));
            self.0.select(some, product, zero)
        } else {
            self.0.zero()
        };
        (by_u, by_v)
    }
}
