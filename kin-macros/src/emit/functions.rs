//! The functions of `impl Constraint` that compute something, on either route.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::{Code, Kernel};
use super::timed::{self, Timed};
use crate::differentiate::Derivatives;
use crate::graph::{Graph, Node, Op};
use crate::lower::Lowered;
use crate::parse::Argument;

/// `residual`, `jacobian`, `linearize`, `velocity_rhs`, `acceleration_rhs` and `blame`.
pub fn symbolic(arguments: &[Argument], lowered: &mut Lowered, derived: &Derivatives) -> TokenStream {
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let (m, entries) = (literal(rows.len()), literal(derived.jacobian.len()));
    let place = |name: &str, k: usize| {
        let (name, k) = (proc_macro2::Ident::new(name, proc_macro2::Span::call_site()), literal(k));
        quote!(#name[#k])
    };
    let outputs =
        |name: &str, nodes: &[Node]| -> Vec<(TokenStream, Node)> { nodes.iter().enumerate().map(|(k, &n)| (place(name, k), n)).collect() };
    let c = outputs("c", &rows);
    let values: Vec<Node> = derived.jacobian.iter().map(|entry| entry.2).collect();
    let c_q = outputs("c_q", &values);
    let both: Vec<_> = c.iter().chain(&c_q).cloned().collect();
    let (rhs, q_d) = (outputs("rhs", &derived.velocity_rhs), outputs("q_d", &derived.acceleration_rhs));
    let all: Vec<Node> = both.iter().chain(&rhs).chain(&q_d).map(|output| output.1).collect();
    let linear = is_linear(&lowered.graph, &rows, derived);
    let timed = Timed::new(lowered, &all, derived, linear);
    let mut kernel = |outputs: &[(TokenStream, Node)]| Kernel::scheduled(lowered, arguments, &timed, outputs);
    let residual = commented("C", kernel(&c));
    let linearize = commented("C and C_q", kernel(&both));
    let right_side = commented("Q_d for t_dot = 1", kernel(&q_d));
    let velocity = (!rhs.is_empty()).then(|| kernel(&rhs));
    let velocity = self::velocity(&m, velocity);
    let timed = timed::functions(lowered, &timed);
    let (constants, depends) = (constants(&lowered.graph, derived), depends(&lowered.graph, &rows, derived, linear));
    let blame = super::blame::symbolic(arguments, lowered);
    let ((residual_doc, residual), (linearize_doc, linearize), (right_doc, right_side)) = (residual, linearize, right_side);
    quote! {
        #constants
        #depends
        #timed
        #[doc = #residual_doc]
        fn residual(&self, at: &::kin::rt::At<'_>, c: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<#m>() else { return };
            #residual
        }
        #[doc = " C_q, and C on the way"]
        fn jacobian(&self, at: &::kin::rt::At<'_>, c_q: &mut [f64]) {
            self.linearize(at, &mut [0.0; #m], c_q);
        }
        #[doc = #linearize_doc]
        fn linearize(&self, at: &::kin::rt::At<'_>, c: &mut [f64], c_q: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<#m>() else { return };
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<#entries>() else { return };
            #linearize
        }
        #velocity
        #[doc = #right_doc]
        fn acceleration_rhs(&self, at: &::kin::rt::At<'_>, qd: &::kin::rt::Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
            let ::core::option::Option::Some(q_d) = q_d.first_chunk_mut::<#m>() else { return };
            #right_side
        }
        #blame
    }
}

/// The entries of C_q that are numbers for good, for the solver; nothing where there are none.
fn constants(g: &Graph, derived: &Derivatives) -> TokenStream {
    let known: Vec<Option<f64>> = derived.jacobian.iter().map(|entry| g.constant_value(entry.2).filter(|c| c.is_finite())).collect();
    if known.iter().all(Option::is_none) {
        return quote!();
    }
    let known = known.into_iter().map(|constant| match constant {
        Some(constant) => {
            let constant = super::kernel::number(constant);
            quote!(::core::option::Option::Some(#constant))
        }
        None => quote!(::core::option::Option::None),
    });
    quote! {
        fn constants(&self) -> &[::core::option::Option<f64>] {
            &[#(#known),*]
        }
    }
}

/// Which terms can change with t or be other than zero, for the solver.
fn depends(g: &Graph, rows: &[Node], derived: &Derivatives, linear: bool) -> TokenStream {
    let on_t = |n: &Node| g.depends(*n).on_t;
    let (c, c_q) = (rows.iter().any(on_t), derived.jacobian.iter().any(|entry| on_t(&entry.2)));
    let [c_t, q_d] = [&derived.velocity_rhs, &derived.acceleration_rhs].map(|side| side.iter().any(|&n| !g.is_zero(n)));
    let curved = !linear;
    quote! {
        fn depends(&self) -> ::kin::Dependence {
            ::kin::Dependence { c_on_t: #c, c_q_on_t: #c_q, c_t: #c_t, q_d: #q_d, curved: #curved }
        }
    }
}

/// Whether the rows are linear in the coordinates for good: with a gradient of numbers, and coordinates that enter by sums and products alone,
/// for steps and kinks have such gradients too.
fn is_linear(g: &Graph, rows: &[Node], derived: &Derivatives) -> bool {
    let smooth = |op: Op| matches!(op, Op::Input(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_));
    derived.jacobian.iter().all(|entry| g.constant_value(entry.2).is_some())
        && g.reachable(rows).into_iter().all(|node| !g.depends(node).on_q || smooth(g.op(node)))
}

fn commented(what: &str, code: Code) -> (String, TokenStream) {
    (format!(" {what}: {} operations", code.operations), code.tokens)
}

/// −C_t; a constraint without time only clears the place.
fn velocity(m: &Literal, code: Option<Code>) -> TokenStream {
    let Some(code) = code else {
        return quote! {
            fn velocity_rhs(&self, _at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
                ::kin::rt::no_velocity(rhs, #m);
            }
        };
    };
    let (doc, code) = commented("−C_t", code);
    quote! {
        #[doc = #doc]
        fn velocity_rhs(&self, at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            let ::core::option::Option::Some(rhs) = rhs.first_chunk_mut::<#m>() else { return };
            #code
        }
    }
}

/// `laws`: each law that the equation asks, and where; nothing where there is none.
pub fn laws(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let mut asked: Vec<(usize, Node)> = Vec::new();
    for node in lowered.graph.reachable(&rows) {
        if let Op::Law(law, x, _) = lowered.graph.op(node)
            && !asked.contains(&(law, x))
        {
            asked.push((law, x));
        }
    }
    if asked.is_empty() {
        return quote!();
    }
    let outputs: Vec<_> = asked
        .iter()
        .enumerate()
        .map(|(k, (_, x))| {
            let k = literal(k);
            (quote!(x[#k]), *x)
        })
        .collect();
    let code = Kernel::emit(lowered, arguments, &outputs).tokens;
    let shown = asked.iter().enumerate().map(|(k, (law, _))| {
        let (k, place) = (literal(k), super::template::place(&lowered.laws[*law]));
        let name = crate::lower::tidy(&place.to_string()).replace(' ', "");
        let name = name.trim_start_matches("self.");
        quote!(visit(#name, &#place, x[#k]);)
    });
    let n = literal(asked.len());
    quote! {
        fn laws(&self, at: &::kin::rt::At<'_>, visit: &mut dyn FnMut(&str, &::kin::Law, f64)) {
            let mut x = [0.0; #n];
            #code
            #(#shown)*
        }
    }
}

/// All of them by dual numbers.
pub fn dual() -> TokenStream {
    quote! {
        fn residual(&self, at: &::kin::rt::At<'_>, c: &mut [f64]) {
            ::kin::dual_route::residual(self, at, c);
        }
        fn jacobian(&self, at: &::kin::rt::At<'_>, c_q: &mut [f64]) {
            ::kin::dual_route::jacobian(self, at, c_q);
        }
        fn velocity_rhs(&self, at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            ::kin::dual_route::velocity_rhs(self, at, rhs);
        }
        fn acceleration_rhs(&self, at: &::kin::rt::At<'_>, qd: &::kin::rt::Rates<'_>, t_dot: f64, q_d: &mut [f64]) {
            ::kin::dual_route::acceleration_rhs(self, at, qd, t_dot, q_d);
        }
        fn jerk_rhs(&self, at: &::kin::rt::At<'_>, qd: &::kin::rt::Rates<'_>, qdd: &::kin::rt::Rates<'_>, rhs: &mut [f64]) -> bool {
            ::kin::dual_route::jerk_rhs(self, at, qd, qdd, rhs)
        }
    }
}

/// After a mistake: nothing is computed.
pub fn nothing() -> TokenStream {
    quote! {
        fn residual(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn jacobian(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn velocity_rhs(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn acceleration_rhs(&self, _: &::kin::rt::At<'_>, _: &::kin::rt::Rates<'_>, _: f64, _: &mut [f64]) {}
    }
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
