//! Defines laws: functions of one variable with their derivatives.
//!
//! Laws describe motors, cam profiles and other prescribed curves.

mod basic;
mod breaks;
mod combine;
mod hung;
mod jump;
mod motion;
mod parts;
mod pieces;
mod points;
mod quintic;
mod rise;
mod sequence;
mod shapes;
mod spline;

pub use crate::outcome::motion::Break;
pub(crate) use breaks::MOST_BREAKS;
pub use jump::{Beyond, LawRange};
pub use points::Ends;

use std::fmt;
use std::sync::Arc;

use kin_graph::{Graph, Node};

use pieces::Pieces;

use crate::dimensions::{Bindings, Dimension};
use crate::numbers::enclosure::Series;
use crate::numbers::real::{Dual, Real};

/// A function f of one variable with its derivatives.
///
/// To define a law, implement this trait for a type, then wrap a value of the type with
/// [`Law::new`].
pub trait LawFunction: Send + Sync {
    /// Returns \[f, f′, f″, f‴\] at x. The unit of a derivative is the unit of f divided by powers
    /// of the unit of x.
    fn jet(&self, x: f64) -> [f64; 4];

    /// Returns the kind of the law, such as `ramp`.
    fn kind(&self) -> &str {
        "law"
    }

    /// Returns a description of the law for lists and documents.
    fn description(&self) -> &str {
        ""
    }

    /// Returns the function as text in Kin's language, `fn lift(x: f64, h: f64) -> f64 { … }`.
    ///
    /// Mechanism files contain this text, so that a program that does not know the kind of the law
    /// can read the law. The default `None` means that the law has no such text.
    fn text(&self) -> Option<&str> {
        None
    }

    /// Returns f⁗(x), or NaN if the fourth derivative is unknown.
    ///
    /// Kin evaluates the fourth derivative only for the jerk of an equation that contains the slope
    /// of a law.
    fn fourth(&self, x: f64) -> f64 {
        let _ = x;
        f64::NAN
    }

    /// Returns the breaks between `from` and `to`, ends included, in increasing order of x.
    ///
    /// By default the list is empty, as for a smooth law. The laws of the library return at most
    /// the first 10 000 breaks, because a law that repeats can have any number of breaks.
    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        let _ = (from, to);
        Vec::new()
    }

    /// Returns the break between `from` and `to` in which the lowest derivative jumps.
    ///
    /// The method works even if [`LawFunction::breaks`] would return too many breaks.
    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        breaks::sharpest(self.breaks(from, to))
    }

    /// Returns true if the law has no break anywhere.
    fn is_smooth(&self) -> bool {
        true
    }

    /// Returns the range of arguments for which the law is defined.
    ///
    /// The default `None` means that the law is defined for all arguments.
    fn range(&self) -> Option<LawRange> {
        None
    }

    /// Returns the range of the tables in the law.
    ///
    /// Outside this range a table continues as a straight line. A run that leaves the range reports
    /// a warning.
    ///
    /// The default `None` means that the law has no table, or that its tables repeat.
    fn table_range(&self) -> Option<LawRange> {
        None
    }

    /// Returns the reason if the parameters are invalid, otherwise `None`.
    ///
    /// The error of a mechanism that uses the law contains this text.
    fn refusal(&self) -> Option<String> {
        None
    }

    /// Passes each numeric parameter and its name to `visit`.
    ///
    /// A mechanism returns an error for a law with a parameter that is not finite.
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        let _ = visit;
    }

    /// Returns the laws that this law contains, each with the prefix of its parameter names.
    fn parts(&self) -> Vec<(String, Law)> {
        Vec::new()
    }

    /// Returns the numbers that define the law but are not parameters, such as the x values of a
    /// table.
    fn fixed_numbers(&self) -> Vec<(String, f64)> {
        Vec::new()
    }

    /// Returns bounds of the law for [`crate::System::prove`].
    ///
    /// With the default `None` Kin cannot prove a motion that this law drives.
    ///
    /// Implement this method in one of two ways: evaluate the formula with [`Series`] instead of
    /// numbers, or pass bounds of the derivatives to [`Series::chain`]. A proof relies on these
    /// bounds and names the law. [`crate::ask::check::law`] compares values of the law with the
    /// bounds.
    ///
    /// ```
    /// use kin::prelude::*;
    /// use kin::extend::{LawFunction, Series};
    /// /// x²
    /// struct Square;
    /// impl LawFunction for Square {
    ///     fn jet(&self, x: f64) -> [f64; 4] {
    ///         [x * x, 2.0 * x, 2.0, 0.0]
    ///     }
    ///     fn over(&self, x: &Series) -> Option<Series> {
    ///         Some(*x * *x)
    ///     }
    /// }
    /// kin::check::law(&Law::new(Square), -1.0, 2.0);
    /// ```
    fn over(&self, x: &Series) -> Option<Series> {
        let _ = x;
        None
    }

    /// Adds the law at x to a graph and returns its node, so that a compiled program can compute
    /// the law.
    ///
    /// With the default `None` the program calls [`LawFunction::jet`].
    #[doc(hidden)]
    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let _ = (graph, x);
        None
    }

    /// Returns the law as polynomials between knots, so that a printed file can contain the law as
    /// a table.
    #[doc(hidden)]
    fn pieces(&self) -> Option<Pieces> {
        None
    }

    /// Returns the kinds of the laws whose stated bounds a proof relies on.
    ///
    /// The default list contains the kind of the law itself. A law with a formula that Kin knows
    /// returns an empty list.
    #[doc(hidden)]
    fn trusted(&self) -> Vec<String> {
        vec![self.kind().to_string()]
    }

    /// Returns ∂f/∂p as a law of x, where p is the parameter with this name.
    ///
    /// With the default `None` a sensitivity with respect to the parameter is an error that
    /// contains the name.
    fn by_parameter(&self, name: &str) -> Option<Law> {
        let _ = name;
        None
    }

    /// Returns the law with one parameter changed, or `None` if the law has no parameter with this
    /// name.
    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let _ = (name, value);
        None
    }
}

/// A function of one variable with its derivatives up to the third.
///
/// Clones share the function, so cloning is cheap.
///
/// A constructor always returns a law, also for invalid parameters. [`Law::refusal`] says what is
/// invalid: each parameter must be finite, a table must increase, and parts must meet in value. A
/// mechanism returns an error for an invalid law.
#[derive(Clone)]
pub struct Law(Arc<dyn LawFunction>, Bound);

/// The parameters of a law that depend on dimensions, by their names. Most laws have none.
type Bound = Option<Arc<Vec<(String, Dimension)>>>;

impl Law {
    /// Creates a law from a user-defined [`LawFunction`].
    pub fn new(function: impl LawFunction + 'static) -> Self {
        Law(Arc::new(function), None)
    }

    /// Creates a law whose parameters depend on dimensions.
    ///
    /// The function `make` records the parameters by their names.
    #[doc(hidden)]
    pub fn hanging<F: LawFunction + 'static>(make: impl FnOnce(&mut Bindings) -> F) -> Self {
        let mut bound = Bindings::NONE;
        let function = make(&mut bound);
        Law::new(function).hung_on(bound.take())
    }

    /// Returns the law with the given parameters bound to dimensions.
    pub(crate) fn hung_on(self, bound: Vec<(String, Dimension)>) -> Self {
        Law(self.0, (!bound.is_empty()).then(|| Arc::new(bound)))
    }

    /// Passes each parameter that depends on a dimension to `show`, including the parameters of
    /// parts.
    pub(crate) fn each_hung(&self, show: &mut dyn FnMut(&str, Dimension)) {
        self.1.iter().flat_map(|bound| bound.iter()).for_each(|(name, number)| show(name, *number));
        for (part, law) in self.parts() {
            law.each_hung(&mut |name, number| show(&format!("{part}.{name}"), number));
        }
    }

    /// Returns \[f, f′, f″, f‴\] at x.
    pub fn jet(&self, x: f64) -> [f64; 4] {
        self.0.jet(x)
    }

    /// Adds the law at x to a graph and returns its node, if the law has a formula.
    pub(crate) fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        self.0.written(graph, x)
    }

    /// Returns the law as polynomials between knots, if it is a spline.
    pub(crate) fn pieces(&self) -> Option<Pieces> {
        self.0.pieces()
    }

    /// Returns true if the other law is a clone of this law.
    pub(crate) fn is(&self, other: &Law) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// Returns f(x) for an `f64` or a dual number.
    pub fn at<X: LawArgument>(&self, x: X) -> X {
        x.through(self)
    }

    /// Returns f′(x) for an `f64` or a dual number.
    pub fn slope<X: LawArgument>(&self, x: X) -> X {
        x.through_slope(self)
    }

    /// Returns ∂f/∂p as a law of x, where p is the parameter with this name, or `None` if the
    /// derivative is unknown.
    pub fn by_parameter(&self, name: &str) -> Option<Law> {
        self.0.by_parameter(name)
    }

    /// Returns the kind of the law, such as `ramp`.
    pub fn kind(&self) -> &str {
        self.0.kind()
    }

    /// Returns a description of the law for lists and documents.
    pub fn description(&self) -> &str {
        self.0.description()
    }

    /// Returns f⁗(x), or NaN if the fourth derivative is unknown.
    pub fn fourth(&self, x: f64) -> f64 {
        self.0.fourth(x)
    }

    /// Returns interval bounds of the law, if they are known.
    pub(crate) fn over(&self, x: &Series) -> Option<Series> {
        self.0.over(x)
    }

    /// Returns the kinds of the laws whose stated bounds a proof relies on.
    #[doc(hidden)]
    pub fn trusted(&self) -> Vec<String> {
        self.0.trusted()
    }

    /// Returns the function as text in Kin's language, if the law has such a text.
    pub fn text(&self) -> Option<&str> {
        self.0.text()
    }

    /// Returns the breaks between `from` and `to`, in increasing order of x: the arguments at which
    /// a derivative up to the third jumps.
    ///
    /// The range includes both ends. The list has at most 10 000 entries.
    pub fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        self.0.breaks(from.min(to), to.max(from))
    }

    /// Returns the break between `from` and `to` in which the lowest derivative jumps.
    pub fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        self.0.sharpest_break(from.min(to), to.max(from))
    }

    /// Returns true if no derivative up to the third jumps anywhere.
    pub fn is_smooth(&self) -> bool {
        self.0.is_smooth()
    }

    /// Returns the range of arguments for which the law is defined, such as the range of its table.
    ///
    /// `None` means that the law is defined for all arguments.
    pub fn range(&self) -> Option<LawRange> {
        self.0.range()
    }

    /// Returns true if the law is a single table whose ends depend on no parameter.
    pub(crate) fn is_table(&self) -> bool {
        matches!(self.kind(), "spline" | "quintic_spline")
    }

    /// Returns the reason if the parameters are invalid, otherwise `None`.
    pub fn refusal(&self) -> Option<String> {
        let mut bad = None;
        self.parameters(&mut |name, value| {
            if !value.is_finite() && bad.is_none() {
                bad = Some(format!("{name} is {value}. Give a finite number"));
            }
        });
        bad.or_else(|| self.0.refusal())
    }

    /// Returns true if f(x + period) = f(x) at all samples.
    ///
    /// Kin compares the value and the first three derivatives at 24 arguments, each to nine digits
    /// of the largest sample.
    pub fn is_periodic(&self, period: f64) -> bool {
        let places = || (0..24).map(|k| period * (f64::from(k) * 0.618_033_988_749_894_9).fract());
        let jets: Vec<[[f64; 4]; 2]> =
            places().map(|x| [self.jet(x), self.jet(x + period)]).collect();
        let size = |k: usize| {
            jets.iter()
                .flatten()
                .fold(0.0_f64, |size, jet| size.max(jet.get(k).map_or(0.0, |f| f.abs())))
        };
        (0..4).all(|k| {
            // x is rounded, so the value of a steep law has an error too.
            let next = if k < 3 {
                size(k + 1)
            } else {
                places().fold(0.0_f64, |size, x| size.max(self.fourth(x).abs()))
            };
            let allowed = 1e-9 * size(k) + 8.0 * f64::EPSILON * period * next;
            jets.iter().all(|[a, b]| (a[k] - b[k]).abs() <= allowed)
        })
    }

    /// Passes each numeric parameter and its name to `visit`.
    ///
    /// In a combined law the prefixes `first.`, `second.`, `outer.` and `inner.` distinguish the
    /// parts.
    pub fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.0.parameters(visit);
    }

    /// Returns the laws that this law contains, each with the prefix of its parameter names, such
    /// as `first` and `second`.
    pub fn parts(&self) -> Vec<(String, Law)> {
        self.0.parts()
    }

    /// Returns the numbers that define the law but are not parameters, such as the x values of a
    /// table.
    pub fn fixed_numbers(&self) -> Vec<(String, f64)> {
        self.0.fixed_numbers()
    }

    /// Sets one numeric parameter by a name from [`Law::parameters`].
    ///
    /// Returns false if the law has no parameter with this name, or if the law is fixed. Existing
    /// clones of the law keep the old value.
    pub fn set_parameter(&mut self, name: &str, value: f64) -> bool {
        match self.0.with_parameter(name, value) {
            Some(law) => {
                let bound = self.1.iter().flat_map(|bound| bound.iter());
                *self = law.hung_on(bound.filter(|(known, _)| known != name).cloned().collect());
                true
            }
            None => false,
        }
    }
}

/// Returns the kinds of the parts whose stated bounds a proof relies on, for a law with a formula
/// that Kin knows.
fn trusted_parts(law: &dyn LawFunction) -> Vec<String> {
    law.parts().iter().flat_map(|(_, part)| part.trusted()).collect()
}

impl fmt::Debug for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut all = f.debug_struct(self.kind());
        self.parameters(&mut |name, value| {
            all.field(name, &value);
        });
        all.finish()
    }
}

/// A number at which a law can be evaluated: an `f64`, or a [`Real`] if a constraint runs on dual
/// numbers.
pub trait LawArgument {
    /// Returns f(self) with the derivatives that a number of this type carries.
    fn through(self, law: &Law) -> Self;

    /// Returns f′(self) with the derivatives that a number of this type carries.
    fn through_slope(self, law: &Law) -> Self;
}

impl LawArgument for f64 {
    fn through(self, law: &Law) -> f64 {
        law.jet(self)[0]
    }

    fn through_slope(self, law: &Law) -> f64 {
        law.jet(self)[1]
    }
}

impl<D: Dual> LawArgument for Real<D> {
    fn through(self, law: &Law) -> Self {
        self.chain(law.jet(self.value()))
    }

    fn through_slope(self, law: &Law) -> Self {
        let [_, f1, f2, f3] = law.jet(self.value());
        // If nothing moves, the product does not need the fourth derivative, which can be unknown.
        let f4 = if self.0.is_at_rest() { 0.0 } else { law.fourth(self.value()) };
        self.chain([f1, f2, f3, f4])
    }
}

#[cfg(test)]
mod tests;
