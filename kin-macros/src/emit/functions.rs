//! The formulas of `impl Constraint`, on either route, and what is promised of them.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::kernel::{Code, Kernel};
use super::timed::{self, Timed};
use super::{facts, route};
use kin_graph::Node;
use kin_graph::differentiate::Derivatives;
use kin_language::lower::Lowered;
use kin_language::parse::Argument;

/// The code that a route gives to the traits of a constraint.
pub struct Parts {
    /// Fields of `Facts`.
    pub facts: TokenStream,
    /// Methods of `impl Constraint`.
    pub formulas: TokenStream,
    /// Methods of `impl Written`.
    pub written: TokenStream,
}

/// `residual`, `jacobian`, `linearize`, `velocity_rhs` and `acceleration_rhs`; the formula.
pub fn symbolic(arguments: &[Argument], lowered: &mut Lowered, derived: &Derivatives) -> Parts {
    let rows = &derived.rows;
    let m = literal(rows.len());
    let entries = literal(derived.jacobian.len());
    let (to_c, c) = outputs("c", quote!(c.first_chunk_mut()), rows, |_| true);
    let values: Vec<Node> = derived.jacobian.iter().map(|entry| entry.2).collect();
    let (to_c_q, c_q) = outputs("c_q", quote!(c_q.first_chunk_mut()), &values, |_| true);
    let both: Vec<_> = c.iter().cloned().chain(c_q).collect();
    let (to_rhs, rhs) =
        outputs("rhs", quote!(rhs.first_chunk_mut()), &derived.velocity_rhs, |_| true);
    let (to_q_d, q_d) =
        outputs("q_d", quote!(q_d.first_chunk_mut()), &derived.acceleration_rhs, |_| true);
    let all: Vec<Node> = both.iter().chain(&rhs).chain(&q_d).map(|output| output.1).collect();
    let linear = derived.is_linear(&lowered.graph);
    let timed = Timed::new(lowered, &all, derived, linear);
    let on_t = rows.iter().any(|row| lowered.graph.depends(*row).on_t);
    let mut kernel =
        |outputs: &[(Ident, Node)]| Kernel::scheduled(lowered, arguments, &timed, outputs);
    // Where only the time has changed a constraint may be asked for C alone; all others seldom are.
    let alone = !linear && on_t;
    let residual = alone.then(|| kernel(&c).tokens).map(|residual| quote!(#to_c #residual));
    let residual = residual.unwrap_or_else(|| quote!(self.linearize(at, c, &mut [0.0; #entries]);));
    let linearize = commented("C and C_q", kernel(&both));
    let right_side = commented("Q_d for t_dot = 1", kernel(&q_d));
    let velocity = (!rhs.is_empty()).then(|| (to_rhs, kernel(&rhs)));
    let velocity = self::velocity(&m, velocity);
    let at_time = timed::function(lowered, &timed);
    let numbers_of_time = timed::facts(&timed);
    let promises = facts::promises(&derived.promises(&lowered.graph));
    let reason = route::read(lowered);
    let facts = quote!(reason: #reason, #promises #numbers_of_time);
    let (linearize_doc, linearize) = linearize;
    let (right_doc, right_side) = right_side;
    let formulas = quote! {
        #at_time
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            #residual
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; #m], c_q);
        }
        #[doc = #linearize_doc]
        fn linearize(&self, at: &::kin::emitted::At<'_>, c: &mut [f64], c_q: &mut [f64]) {
            #to_c
            #to_c_q
            #linearize
        }
        #velocity
        #[doc = #right_doc]
        fn acceleration_rhs(&self, at: &::kin::emitted::At<'_>, qd: &::kin::emitted::Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
            #to_q_d
            #right_side
        }
    };
    Parts { facts, formulas, written: super::blame::symbolic(arguments, lowered) }
}

/// References to the places of a list by name,
/// `let Some([c_0, c_1]) = c.first_chunk_mut() else { return };`, and what is written behind those
/// that are `wanted`.
pub fn outputs(
    list: &str,
    places: TokenStream,
    nodes: &[Node],
    wanted: impl Fn(Node) -> bool,
) -> (TokenStream, Vec<(Ident, Node)>) {
    let name = |k: usize| super::own(&format!("{list}_{k}"));
    let all: Vec<Option<(Ident, Node)>> =
        nodes.iter().enumerate().map(|(k, &node)| wanted(node).then(|| (name(k), node))).collect();
    let names = all.iter().map(|output| output.as_ref().map(|(name, _)| name.clone()));
    (super::chunk(names, places), all.into_iter().flatten().collect())
}

fn commented(what: &str, code: Code) -> (String, TokenStream) {
    (format!(" {what}: {} operations", code.operations), code.tokens)
}

/// −C_t; a constraint without time only clears the place.
fn velocity(m: &Literal, code: Option<(TokenStream, Code)>) -> TokenStream {
    let Some((to_rhs, code)) = code else {
        return quote! {
            fn velocity_rhs(&self, _at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
                ::kin::emitted::no_velocity(rhs, #m);
            }
        };
    };
    let (doc, code) = commented("−C_t", code);
    quote! {
        #[doc = #doc]
        fn velocity_rhs(&self, at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            #to_rhs
            #code
        }
    }
}

/// `laws`: each law that the equation asks, and where; nothing where there is none.
pub fn laws(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let asked = lowered.laws_asked();
    if asked.is_empty() {
        return quote!();
    }
    let nodes: Vec<Node> = asked.iter().map(|(_, x)| *x).collect();
    let (code, values) = Kernel::plain(lowered, arguments).values(&nodes);
    let code = code.tokens;
    let shown = asked.iter().enumerate().map(|(k, (law, _))| {
        let x = super::own(&format!("x_{k}"));
        let place = super::template::place(&lowered.laws[*law]);
        let name = kin_language::error::tidy(&place.to_string()).replace(' ', "");
        let name = name.trim_start_matches("self.");
        quote!(visit(#name, &#place, #x);)
    });
    let names = (0..asked.len()).map(|k| super::own(&format!("x_{k}")));
    quote! {
        fn laws(&self, at: &::kin::emitted::At<'_>, visit: &mut dyn FnMut(&str, &::kin::Law, f64)) {
            #code
            let [#(#names),*] = [#(#values),*];
            #(#shown)*
        }
    }
}

/// All of them by dual numbers.
pub fn dual() -> TokenStream {
    quote! {
        fn residual(&self, at: &::kin::emitted::At<'_>, c: &mut [f64]) {
            ::kin::extend::dual_route::residual(self, at, c);
        }
        fn jacobian(&self, at: &::kin::emitted::At<'_>, c_q: &mut [f64]) {
            ::kin::extend::dual_route::jacobian(self, at, c_q);
        }
        fn velocity_rhs(&self, at: &::kin::emitted::At<'_>, rhs: &mut [f64]) {
            ::kin::extend::dual_route::velocity_rhs(self, at, rhs);
        }
        fn acceleration_rhs(&self, at: &::kin::emitted::At<'_>, qd: &::kin::emitted::Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
            ::kin::extend::dual_route::acceleration_rhs(self, at, qd, t_dot, q_d);
        }
        fn jerk_rhs(&self, at: &::kin::emitted::At<'_>, qd: &::kin::emitted::Rates<'_>, qdd: &::kin::emitted::Rates<'_>, rhs: &mut [f64]) -> bool {
            ::kin::extend::dual_route::jerk_rhs(self, at, qd, qdd, rhs)
        }
    }
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
