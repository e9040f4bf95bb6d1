//! Laws: functions of one variable with their derivatives, for motors, cam profiles and other
//! prescribed curves.

mod basic;
mod breaks;
mod combine;
mod jump;
mod motion;
mod parts;
mod points;
mod quintic;
mod rise;
mod sequence;
mod shapes;
mod spline;

pub(crate) use breaks::MOST_BREAKS;
pub use jump::{Beyond, Break, LawRange};
pub use points::Ends;

use std::fmt;
use std::sync::Arc;

use kin_graph::{Graph, Node};

use crate::model::dimension::{Bindings, Dimension};
use crate::numbers::enclosure::Series;
use crate::numbers::real::{Dual, Real};

/// A function f of one variable that knows its derivatives; implement it for a law of one's own,
/// then wrap it with [`Law::new`].
pub trait LawFunction: Send + Sync {
    /// \[f, f′, f″, f‴\] at x, in the unit of f per powers of the unit of x.
    fn jet(&self, x: f64) -> [f64; 4];

    /// Kind of the law, such as `ramp`.
    fn kind(&self) -> &str {
        "law"
    }

    /// Description of the law, in the words of its documentation.
    fn description(&self) -> &str {
        ""
    }

    /// Its function as text in Kin's language, `fn lift(x: f64, h: f64) -> f64 { … }`, where that
    /// is all it is: mechanism files carry it, for readers that do not know its kind.
    fn text(&self) -> Option<&str> {
        None
    }

    /// f⁗(x), where it is known; not a number where it is not. Only the jerk of an equation that
    /// reads a law's slope asks for it.
    fn fourth(&self, x: f64) -> f64 {
        let _ = x;
        f64::NAN
    }

    /// The breaks between `from` and `to`, both included, in increasing order of x; none by
    /// default: a smooth law. Of more than ten thousand the laws of the library give as many: one
    /// that repeats has any number of them.
    fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        let _ = (from, to);
        Vec::new()
    }

    /// The break between `from` and `to` in which the lowest derivative jumps, also where there are
    /// too many to list them.
    fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        breaks::sharpest(self.breaks(from, to))
    }

    /// True if there is no break anywhere.
    fn is_smooth(&self) -> bool {
        true
    }

    /// The arguments that it is made for; `None` (default) where it is made for all.
    fn range(&self) -> Option<LawRange> {
        None
    }

    /// The arguments of the tables in it, beyond which a table goes on as a straight line: a run
    /// that goes beyond them reports a warning. `None` (default) where there is no table, or where
    /// tables repeat.
    fn table_range(&self) -> Option<LawRange> {
        None
    }

    /// Why its parameters make no sense, if so: what uses the law is refused with these words.
    fn refusal(&self) -> Option<String> {
        None
    }

    /// Shows each numeric parameter with its name; a value that is not finite is refused where the
    /// law is used.
    fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        let _ = visit;
    }

    /// The laws that it is made of, by the names that their parameters begin with.
    fn parts(&self) -> Vec<(String, Law)> {
        Vec::new()
    }

    /// Numbers that make it the law it is but are no parameters, such as where the points of a
    /// table stand.
    fn fixed_numbers(&self) -> Vec<(String, f64)> {
        Vec::new()
    }

    /// The law of a function of which bounds are known, for [`crate::System::prove`]; `None`
    /// (default) where those of the law are not: then nothing can be proved of a motion that it
    /// drives.
    ///
    /// Either the formula once more, on [`Series`] instead of numbers, or bounds of the derivatives
    /// through [`Series::chain`]. These bounds are taken for true, and a proof says so;
    /// [`crate::ask::check::law`] tries them at random.
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

    /// Itself at x as nodes of a graph, so that a program computes it with all else; `None`
    /// (default) where it has to be asked.
    #[doc(hidden)]
    fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        let _ = (graph, x);
        None
    }

    /// The laws on whose word its bounds rest, by their kinds: itself, unless Kin knows its
    /// formula.
    #[doc(hidden)]
    fn trusted(&self) -> Vec<String> {
        vec![self.kind().to_string()]
    }

    /// ∂f/∂p as a law of x, p being the parameter of that name; `None` (default) where it is not
    /// known: then sensitivities by that parameter are refused by name.
    fn by_parameter(&self, name: &str) -> Option<Law> {
        let _ = name;
        None
    }

    /// The same law with one parameter changed; `None` if there is none of that name.
    fn with_parameter(&self, name: &str, value: f64) -> Option<Law> {
        let _ = (name, value);
        None
    }
}

/// A function of one variable with its derivatives up to the third: cheap to clone, the same for
/// everyone who holds it.
///
/// Constructors give laws, not results: what makes no sense (a parameter that is not finite, a
/// table that does not increase, parts that do not meet) is told by [`Law::refusal`], and refused
/// by name where a mechanism is to use the law.
#[derive(Clone)]
pub struct Law(Arc<dyn LawFunction>, Bound);

/// The parameters of a law that hang on dimensions, by their names; of most laws there are none.
type Bound = Option<Arc<Vec<(String, Dimension)>>>;

impl Law {
    /// A law of one's own.
    pub fn new(function: impl LawFunction + 'static) -> Self {
        Law(Arc::new(function), None)
    }

    /// The law whose parameters hang on dimensions, those which `make` notes by their names.
    #[doc(hidden)]
    pub fn hanging<F: LawFunction + 'static>(make: impl FnOnce(&mut Bindings) -> F) -> Self {
        let mut bound = Bindings::NONE;
        let function = make(&mut bound);
        Law::new(function).hung_on(bound.take())
    }

    /// The same law, of which these parameters, by their names, hang on dimensions.
    pub(crate) fn hung_on(self, bound: Vec<(String, Dimension)>) -> Self {
        Law(self.0, (!bound.is_empty()).then(|| Arc::new(bound)))
    }

    /// Shows each parameter that hangs on dimensions by its name, those of its parts too.
    pub(crate) fn each_hung(&self, show: &mut dyn FnMut(&str, Dimension)) {
        self.1.iter().flat_map(|bound| bound.iter()).for_each(|(name, number)| show(name, *number));
        for (part, law) in self.parts() {
            law.each_hung(&mut |name, number| show(&format!("{part}.{name}"), number));
        }
    }

    /// \[f, f′, f″, f‴\] at x.
    pub fn jet(&self, x: f64) -> [f64; 4] {
        self.0.jet(x)
    }

    /// Itself at x as nodes of a graph, if it is known so.
    pub(crate) fn written(&self, graph: &mut Graph, x: Node) -> Option<Node> {
        self.0.written(graph, x)
    }

    /// True if it is the same law: a clone.
    pub(crate) fn is(&self, other: &Law) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }

    /// f(x), for a plain number or any dual number.
    pub fn at<X: LawArgument>(&self, x: X) -> X {
        x.through(self)
    }

    /// f′(x), for a plain number or any dual number.
    pub fn slope<X: LawArgument>(&self, x: X) -> X {
        x.through_slope(self)
    }

    /// ∂f/∂p as a law of x, p being the parameter of that name, where it is known.
    pub fn by_parameter(&self, name: &str) -> Option<Law> {
        self.0.by_parameter(name)
    }

    /// Kind of the law.
    pub fn kind(&self) -> &str {
        self.0.kind()
    }

    /// Description of the law, in the words of its documentation.
    pub fn description(&self) -> &str {
        self.0.description()
    }

    /// f⁗(x), where it is known.
    pub fn fourth(&self, x: f64) -> f64 {
        self.0.fourth(x)
    }

    /// The law of a function with interval bounds, where they are known.
    pub(crate) fn over(&self, x: &Series) -> Option<Series> {
        self.0.over(x)
    }

    /// The laws on whose word these bounds rest.
    #[doc(hidden)]
    pub fn trusted(&self) -> Vec<String> {
        self.0.trusted()
    }

    /// Its function as text in Kin's language, if it has one.
    pub fn text(&self) -> Option<&str> {
        self.0.text()
    }

    /// Where derivatives up to the third jump between `from` and `to`, both included, in increasing
    /// order of x; of more than ten thousand places as many.
    pub fn breaks(&self, from: f64, to: f64) -> Vec<Break> {
        self.0.breaks(from.min(to), to.max(from))
    }

    /// The break between `from` and `to` in which the lowest derivative jumps.
    pub fn sharpest_break(&self, from: f64, to: f64) -> Option<Break> {
        self.0.sharpest_break(from.min(to), to.max(from))
    }

    /// True if no derivative up to the third jumps anywhere.
    pub fn is_smooth(&self) -> bool {
        self.0.is_smooth()
    }

    /// The arguments that the law is made for, such as those of its table; `None` where it is made
    /// for all.
    pub fn range(&self) -> Option<LawRange> {
        self.0.range()
    }

    /// True if it is a table alone, whose ends depend on no parameter.
    pub(crate) fn is_table(&self) -> bool {
        matches!(self.kind(), "spline" | "quintic_spline")
    }

    /// Why its parameters make no sense, if so.
    pub fn refusal(&self) -> Option<String> {
        let mut bad = None;
        self.parameters(&mut |name, value| {
            if !value.is_finite() && bad.is_none() {
                bad = Some(format!("{name} is {value}; give a finite number"));
            }
        });
        bad.or_else(|| self.0.refusal())
    }

    /// True if f(x + period) = f(x) for all that can be seen: values and first three derivatives at
    /// 24 places, each to nine digits of the largest of its kind.
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
            // x is rounded, and with a steep law so is f.
            let next = if k < 3 {
                size(k + 1)
            } else {
                places().fold(0.0_f64, |size, x| size.max(self.fourth(x).abs()))
            };
            let allowed = 1e-9 * size(k) + 8.0 * f64::EPSILON * period * next;
            jets.iter().all(|[a, b]| (a[k] - b[k]).abs() <= allowed)
        })
    }

    /// Shows each numeric parameter with its name; the parts of a combined law are told apart by
    /// `first.`, `second.`, `outer.`, `inner.`.
    pub fn parameters(&self, visit: &mut dyn FnMut(&str, f64)) {
        self.0.parameters(visit);
    }

    /// The laws that it is made of, by the names that their parameters begin with: `first`,
    /// `second`.
    pub fn parts(&self) -> Vec<(String, Law)> {
        self.0.parts()
    }

    /// Numbers that make it the law it is but are no parameters, such as where the points of a
    /// table stand.
    pub fn fixed_numbers(&self) -> Vec<(String, f64)> {
        self.0.fixed_numbers()
    }

    /// Sets one numeric parameter by the name [`Law::parameters`] gives it; false if there is none
    /// of that name, or the law is fixed. Clones made before keep the old value.
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

/// Whose word a law rests on of which Kin knows the formula: that of its parts.
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

/// A number that a law can be asked at: `f64`, or [`Real`] where a constraint runs on dual numbers.
pub trait LawArgument {
    /// f(self), with the derivatives that the kind of number carries.
    fn through(self, law: &Law) -> Self;

    /// f′(self), with the derivatives that the kind of number carries.
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
        // Where nothing moves the fourth derivative, which may not be known, is not asked for.
        let f4 = if self.0.is_at_rest() { 0.0 } else { law.fourth(self.value()) };
        self.chain([f1, f2, f3, f4])
    }
}

#[cfg(test)]
mod tests;
