//! The emitted constraint: a struct of the function's name, its constructor, `impl Constraint` and `impl Equation`.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::kernel::{Code, Kernel};
use super::{rewrite, template};
use crate::differentiate::{Jets, Partial};
use crate::graph::{Column, Graph, Input, LeafNumber, Node, Op, Part};
use crate::lower::Lowered;
use crate::parse::{Argument, ConstraintFn, Kind, Shape};

/// What both routes need to know.
struct Frame<'a> {
    source: &'a ConstraintFn,
    n: usize,
    row_names: Vec<String>,
    pattern: Vec<(usize, usize)>,
    /// Slots whose sine or cosine is read.
    trig: Vec<usize>,
}

/// The constraint on the symbolic route.
pub fn symbolic(source: &ConstraintFn, mut lowered: Lowered) -> TokenStream {
    let derived = Derived::new(&mut lowered, &source.arguments);
    let row_names = lowered.rows.iter().map(|row| row.name.clone()).collect();
    let pattern = derived.jacobian.iter().map(|(row, column, _)| (*row, *column)).collect();
    let trig = derived.trig(&lowered);
    let frame = Frame { trig, ..Frame::new(source, row_names, pattern) };
    let (kernels, constants) = (kernels(&frame, &lowered, &derived), constants(&lowered.graph, &derived));
    let kernels = quote!(#constants #kernels);
    let leaves: Vec<TokenStream> = lowered
        .leaves
        .iter()
        .enumerate()
        .map(|(k, leaf)| template::leaf_function(&lowered.graph, k, leaf, &lowered.items.iter().map(|i| quote!(#i)).collect::<Vec<_>>()))
        .collect();
    frame.emit(quote!(::kin::Route::Symbolic), &kernels, &leaves)
}

/// The constraint on the dual route.
pub fn dual(source: &ConstraintFn) -> TokenStream {
    let row_names = row_names(&source.output);
    let n = columns(&source.arguments);
    let pattern = (0..row_names.len()).flat_map(|row| (0..n).map(move |column| (row, column))).collect();
    let kernels = quote! {
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
    };
    Frame::new(source, row_names, pattern).emit(quote!(::kin::Route::Dual), &kernels, &[])
}

/// After a mistake: something that type-checks wherever the constraint is used, so that one mistake gives one message.
pub fn dummy(source: &ConstraintFn) -> TokenStream {
    let (m, n) = (rows(&source.output).max(1), columns(&source.arguments));
    let frame = Frame { source, n, row_names: vec![String::new(); m], pattern: vec![], trig: vec![] };
    let kernels = quote! {
        fn residual(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn jacobian(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn velocity_rhs(&self, _: &::kin::rt::At<'_>, _: &mut [f64]) {}
        fn acceleration_rhs(&self, _: &::kin::rt::At<'_>, _: &::kin::rt::Rates<'_>, _: f64, _: &mut [f64]) {}
    };
    let equations = quote! {
        fn evaluate<__D: ::kin::rt::Dual>(&self, _: &[::kin::rt::Real<__D>; #n], t: ::kin::rt::Real<__D>) -> [::kin::rt::Real<__D>; #m] {
            [t; #m]
        }
        fn plain(&self, _: &[f64; #n], t: f64) -> [f64; #m] {
            [t; #m]
        }
    };
    frame.emit_with(quote!(::kin::Route::Dual), &kernels, &[], &equations)
}

/// Every derivative of the rows that emitted code computes.
struct Derived {
    /// (row, local column, value), structural non-zeros only.
    jacobian: Vec<(usize, usize, Node)>,
    /// −C_t; empty where nothing depends on time.
    velocity_rhs: Vec<Node>,
    /// −g″(0)
    acceleration_rhs: Vec<Node>,
    /// Numbers that must be finite, with the user's text.
    checks: Vec<(String, Vec<Node>)>,
}

impl Derived {
    fn new(lowered: &mut Lowered, arguments: &[Argument]) -> Self {
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let g = &mut lowered.graph;
        let jacobian = jacobian(g, &rows, arguments);
        let mut velocity_rhs = Vec::new();
        if rows.iter().any(|&row| g.depends(row).on_t) {
            let mut by_time = Partial::by_time();
            for &row in &rows {
                let c_t = by_time.of(g, row);
                velocity_rhs.push(g.neg(c_t));
            }
        }
        let mut jets = Jets::default();
        let mut acceleration_rhs = Vec::new();
        for &row in &rows {
            let second = jets.of(g, row).second;
            acceleration_rhs.push(g.neg(second));
        }
        let checks = lowered.risks.iter().map(|risk| (risk.text.clone(), checked(&mut lowered.graph, risk.node))).collect();
        Derived { jacobian, velocity_rhs, acceleration_rhs, checks }
    }

    /// Slots whose sine or cosine some output reads.
    fn trig(&self, lowered: &Lowered) -> Vec<usize> {
        let mut outputs: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        outputs.extend(self.jacobian.iter().map(|entry| entry.2));
        outputs.extend(self.velocity_rhs.iter().chain(&self.acceleration_rhs));
        outputs.extend(self.checks.iter().flat_map(|(_, nodes)| nodes));
        let reads = |node: Node| match lowered.graph.op(node) {
            Op::Input(Input::State(slot, Part::Sin | Part::Cos)) => Some(slot),
            _ => None,
        };
        lowered.graph.reachable(&outputs).into_iter().filter_map(reads).collect()
    }
}

fn jacobian(g: &mut Graph, rows: &[Node], arguments: &[Argument]) -> Vec<(usize, usize, Node)> {
    let columns = g.columns(rows);
    let mut partials: Vec<Partial> = columns.iter().map(|&column| Partial::by_column(column)).collect();
    let mut entries = Vec::new();
    for (k, &row) in rows.iter().enumerate() {
        for (column, partial) in columns.iter().zip(&mut partials) {
            let value = partial.of(g, row);
            if !g.is_zero(value) {
                entries.push((k, local_column(arguments, *column), value));
            }
        }
    }
    entries
}

/// Number of a column among those of all arguments.
fn local_column(arguments: &[Argument], column: Column) -> usize {
    let (mut slot, mut first) = (0, 0);
    for argument in arguments {
        let slots = argument.kind.slots();
        if column.argument < slot + slots {
            return first
                + match (&argument.kind, column.part) {
                    (Kind::Planar, Part::Theta) => 2,
                    (_, Part::R(k)) => k,
                    (_, Part::P(k)) => 3 + k,
                    _ => column.argument - slot,
                };
        }
        slot += slots;
        first += argument.kind.columns();
    }
    first
}

/// A risky operation's value and its derivatives by its own operands.
fn checked(g: &mut Graph, node: Node) -> Vec<Node> {
    let mut all = vec![node];
    match g.op(node) {
        Op::Call(f, a) if g.depends(a).varies() => all.push(crate::differentiate::derivative(g, f, a, node)),
        Op::Call2(f, a, b) => {
            let (by_a, by_b) = crate::differentiate::derivatives2(g, f, a, b, node);
            all.extend([(a, by_a), (b, by_b)].into_iter().filter(|(x, _)| g.depends(*x).varies()).map(|(_, d)| d));
        }
        Op::Law(law, x, order) => all.push(g.law(law, x, order + 1)),
        Op::Leaf(of) => {
            for k in 0..g.leaves[of.leaf].arguments.len() {
                all.push(g.leaf_output(of.leaf, of.output, LeafNumber::Partial(k)));
            }
        }
        _ => {}
    }
    all.retain(|&n| g.constant_value(n).is_none());
    all
}

fn kernels(frame: &Frame, lowered: &Lowered, derived: &Derived) -> TokenStream {
    let arguments = &frame.source.arguments;
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let (m, entries) = (literal(rows.len()), literal(derived.jacobian.len()));
    let place = |name: &str, k: usize| {
        let (name, k) = (proc_macro2::Ident::new(name, proc_macro2::Span::call_site()), literal(k));
        quote!(#name[#k])
    };
    let outputs = |name: &str, nodes: &[Node]| -> Vec<(TokenStream, Node)> { nodes.iter().enumerate().map(|(k, &n)| (place(name, k), n)).collect() };
    let c = outputs("c", &rows);
    let values: Vec<Node> = derived.jacobian.iter().map(|entry| entry.2).collect();
    let c_q = outputs("c_q", &values);
    let both: Vec<_> = c.iter().chain(&c_q).cloned().collect();

    let residual = commented("C", Kernel::emit(lowered, arguments, &c));
    let jacobian = commented("C_q", Kernel::emit(lowered, arguments, &c_q));
    let linearize = commented("C and C_q", Kernel::emit(lowered, arguments, &both));
    let right_side = commented("Q_d for t_dot = 1", Kernel::emit(lowered, arguments, &outputs("q_d", &derived.acceleration_rhs)));
    let velocity = velocity(&m, Kernel::emit(lowered, arguments, &outputs("rhs", &derived.velocity_rhs)), derived);
    let not_finite = not_finite(lowered, arguments, &derived.checks);
    let ((residual_doc, residual), (jacobian_doc, jacobian)) = (residual, jacobian);
    let ((linearize_doc, linearize), (right_doc, right_side)) = (linearize, right_side);
    quote! {
        #[doc = #residual_doc]
        fn residual(&self, at: &::kin::rt::At<'_>, c: &mut [f64]) {
            let ::core::option::Option::Some(c) = c.first_chunk_mut::<#m>() else { return };
            #residual
        }
        #[doc = #jacobian_doc]
        #[inline]
        fn jacobian(&self, at: &::kin::rt::At<'_>, c_q: &mut [f64]) {
            let ::core::option::Option::Some(c_q) = c_q.first_chunk_mut::<#entries>() else { return };
            #jacobian
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
        #not_finite
    }
}

/// The entries of C_q that are numbers for good, for the solver; nothing where there are none.
fn constants(g: &Graph, derived: &Derived) -> TokenStream {
    let known: Vec<Option<f64>> = derived.jacobian.iter().map(|entry| g.constant_value(entry.2).filter(|c| c.is_finite())).collect();
    if known.iter().all(Option::is_none) {
        return quote!();
    }
    let known = known.into_iter().map(|constant| match constant {
        Some(constant) => {
            let (sign, size) = (constant.is_sign_negative().then(|| quote!(-)), Literal::f64_unsuffixed(constant.abs()));
            quote!(::core::option::Option::Some(#sign #size))
        }
        None => quote!(::core::option::Option::None),
    });
    quote! {
        fn constants(&self) -> &[::core::option::Option<f64>] {
            &[#(#known),*]
        }
    }
}

fn commented(what: &str, code: Code) -> (String, TokenStream) {
    (format!(" {what}: {} operations", code.operations), code.tokens)
}

/// −C_t; a constraint without time only clears the place.
fn velocity(m: &Literal, code: Code, derived: &Derived) -> TokenStream {
    if derived.velocity_rhs.is_empty() {
        return quote! {
            fn velocity_rhs(&self, _at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
                rhs.iter_mut().take(#m).for_each(|value| *value = 0.0);
            }
        };
    }
    let (doc, code) = commented("−C_t", code);
    quote! {
        #[doc = #doc]
        fn velocity_rhs(&self, at: &::kin::rt::At<'_>, rhs: &mut [f64]) {
            let ::core::option::Option::Some(rhs) = rhs.first_chunk_mut::<#m>() else { return };
            #code
        }
    }
}

fn not_finite(lowered: &Lowered, arguments: &[Argument], checks: &[(String, Vec<Node>)]) -> TokenStream {
    let checks: Vec<(String, Vec<Node>)> = checks.iter().filter(|(_, nodes)| !nodes.is_empty()).cloned().collect();
    if checks.is_empty() {
        return quote!();
    }
    let code = Kernel::emit_checks(lowered, arguments, &checks).tokens;
    quote! {
        #[cold]
        fn not_finite(&self, at: &::kin::rt::At<'_>) -> ::core::option::Option<&str> {
            #code
            ::core::option::Option::None
        }
    }
}

impl<'a> Frame<'a> {
    fn new(source: &'a ConstraintFn, row_names: Vec<String>, pattern: Vec<(usize, usize)>) -> Self {
        Frame { source, n: columns(&source.arguments), row_names, pattern, trig: vec![] }
    }

    fn emit(&self, route: TokenStream, kernels: &TokenStream, leaves: &[TokenStream]) -> TokenStream {
        self.emit_with(route, kernels, leaves, &self.equations())
    }

    fn emit_with(&self, route: TokenStream, kernels: &TokenStream, leaves: &[TokenStream], equations: &TokenStream) -> TokenStream {
        let source = self.source;
        let (name, n, m) = (&source.name, self.n, self.row_names.len());
        let declaration = self.declaration();
        let kind = syn::ext::IdentExt::unraw(name).to_string();
        let (row_names, pattern) = (&self.row_names, self.pattern.iter().map(|(row, column)| (literal(*row), literal(*column))));
        let pattern: Vec<TokenStream> = pattern.map(|(row, column)| quote!((#row, #column))).collect();
        let described = self.arguments();
        let (visit, set) = super::parameter_methods(&source.arguments);
        let kinds = source.arguments.iter().flat_map(kinds);
        let checks = super::parameter_checks(&source.arguments);
        let leaves = if leaves.is_empty() { quote!() } else { quote!(impl #name { #(#leaves)* }) };
        quote! {
            #declaration

            #[allow(unused, clippy::all, clippy::pedantic, clippy::nursery)]
            const _: () = {
                #checks
                #leaves
                impl ::kin::Constraint for #name {
                    fn kind(&self) -> &str {
                        #kind
                    }
                    fn route(&self) -> ::kin::Route {
                        #route
                    }
                    fn arguments(&self) -> ::std::vec::Vec<::kin::rt::Argument> {
                        #described
                    }
                    fn rows(&self) -> &[&str] {
                        &[#(#row_names),*]
                    }
                    fn pattern(&self) -> &[(usize, usize)] {
                        &[#(#pattern),*]
                    }
                    #kernels
                    #visit
                    #set
                }
                impl ::kin::rt::Equation<#n, #m> for #name {
                    const ARGUMENTS: &'static [::kin::rt::ArgumentKind] = &[#(#kinds),*];
                    #equations
                }
            };
        }
    }

    /// The struct and its constructor.
    fn declaration(&self) -> TokenStream {
        let source = self.source;
        let (visibility, name, attributes) = (&source.visibility, &source.name, &source.attributes);
        let fields: Vec<&Argument> = source.arguments.iter().filter(|a| a.kind.is_field()).collect();
        let names: Vec<_> = fields.iter().map(|a| &a.name).collect();
        let types = fields.iter().map(|a| super::field_type(a));
        let inputs = fields.iter().map(|argument| {
            let (name, ty) = (&argument.name, super::field_type(argument));
            match argument.kind {
                Kind::Planar | Kind::Spatial | Kind::Coord => quote!(#name: impl ::core::convert::Into<#ty>),
                _ => quote!(#name: #ty),
            }
        });
        let values = fields.iter().map(|argument| {
            let name = &argument.name;
            match argument.kind {
                Kind::Planar | Kind::Spatial | Kind::Coord => quote!(#name: ::core::convert::Into::into(#name)),
                _ => quote!(#name),
            }
        });
        let docs = super::documentation(attributes);
        let heading = format!(" The constraint that [`fn@{name}`] makes.\n\n");
        quote! {
            #[doc = #heading]
            #(#docs)*
            #[allow(non_camel_case_types)]
            #[derive(Clone)]
            #visibility struct #name {
                #(#names: #types),*
            }

            #(#attributes)*
            #[allow(clippy::too_many_arguments)]
            #[must_use]
            #visibility fn #name(#(#inputs),*) -> #name {
                #name { #(#values),* }
            }
        }
    }

    /// The arguments with their names, for messages and for the solver.
    fn arguments(&self) -> TokenStream {
        let mut slot = 0;
        let mut all = Vec::new();
        for argument in &self.source.arguments {
            let name = &argument.name;
            let text = syn::ext::IdentExt::unraw(name).to_string();
            let trig = self.trig(slot);
            slot += argument.kind.slots();
            let target = match argument.kind {
                Kind::Planar => quote!(::kin::rt::Target::Planar(self.#name)),
                Kind::Spatial => quote!(::kin::rt::Target::Spatial(self.#name)),
                Kind::Coord => quote!(::kin::rt::Target::Coord(self.#name, #trig)),
                Kind::Coords(n) => {
                    for k in 0..n {
                        let (trig, k) = (self.trig(slot - n + k), literal(k));
                        all.push(quote!(::kin::rt::Argument { name: #text, target: ::kin::rt::Target::Coord(self.#name[#k], #trig) }));
                    }
                    continue;
                }
                _ => continue,
            };
            all.push(quote!(::kin::rt::Argument { name: #text, target: #target }));
        }
        quote!(::std::vec![#(#all),*])
    }

    fn trig(&self, slot: usize) -> TokenStream {
        if self.trig.contains(&slot) { quote!(::kin::rt::Trig::Used) } else { quote!(::kin::rt::Trig::Unused) }
    }

    /// The two copies of the user's body.
    fn equations(&self) -> TokenStream {
        let source = self.source;
        let (n, m) = (self.n, self.row_names.len());
        let (plain_states, dual_states) = (states(&source.arguments, &quote!(f64)), states(&source.arguments, &quote!(::kin::rt::Real<__D>)));
        let (plain_parameters, dual_parameters) = (super::plain_bindings(&source.arguments), super::dual_bindings(&source.arguments));
        let (plain_body, dual_body) = (rewrite::plain(&source.body, &source.arguments), rewrite::dual(&source.body, &source.arguments));
        let (plain_type, dual_type) = (&source.output_type, rewrite::lifted_type(&source.output_type));
        quote! {
            fn evaluate<__D: ::kin::rt::Dual>(&self, q: &[::kin::rt::Real<__D>; #n], t: ::kin::rt::Real<__D>) -> [::kin::rt::Real<__D>; #m] {
                #(#dual_states)*
                #(#dual_parameters)*
                let value = (move || -> #dual_type #dual_body)();
                ::kin::rt::rows(value)
            }
            #[inline]
            fn plain(&self, q: &[f64; #n], t: f64) -> [f64; #m] {
                #(#plain_states)*
                #(#plain_parameters)*
                let value = (move || -> #plain_type #plain_body)();
                ::kin::rt::rows(value)
            }
        }
    }
}

/// The user's names for bodies, coordinates and time, bound to states made of `q` and `t`.
fn states(arguments: &[Argument], scalar: &TokenStream) -> Vec<TokenStream> {
    let mut first = 0;
    let mut all = Vec::new();
    for argument in arguments {
        let (name, mutable, count) = (&argument.name, super::mutable(argument), argument.kind.columns());
        let q: Vec<Literal> = (first..first + count).map(literal).collect();
        first += count;
        all.push(match argument.kind {
            Kind::Planar => quote!(let #mutable #name = ::kin::rt::PlanarState::<#scalar>::new([#(q[#q]),*]);),
            Kind::Spatial => quote!(let #mutable #name = ::kin::rt::SpatialState::<#scalar>::new([#(q[#q]),*]);),
            Kind::Coord => quote!(let #mutable #name: #scalar = #(q[#q])*;),
            Kind::Coords(_) => quote!(let #mutable #name: [#scalar; #count] = [#(q[#q]),*];),
            Kind::Time => quote!(let #mutable #name: #scalar = t;),
            _ => continue,
        });
    }
    all
}

fn kinds(argument: &Argument) -> Vec<TokenStream> {
    let kind = match argument.kind {
        Kind::Planar => quote!(::kin::rt::ArgumentKind::Planar),
        Kind::Spatial => quote!(::kin::rt::ArgumentKind::Spatial),
        _ => quote!(::kin::rt::ArgumentKind::Coord),
    };
    vec![kind; argument.kind.slots()]
}

fn columns(arguments: &[Argument]) -> usize {
    arguments.iter().map(|a| a.kind.columns()).sum()
}

/// Number of rows of a returned type.
fn rows(output: &Shape) -> usize {
    match output {
        Shape::Array(inner, n) if **inner == Shape::Any => *n,
        Shape::Array(inner, n) => n * rows(inner),
        Shape::Tuple(all) => all.iter().map(rows).sum(),
        Shape::Any => 1,
        shape => shape.len(),
    }
}

fn row_names(output: &Shape) -> Vec<String> {
    match output {
        Shape::Vector(n) => ["x", "y", "z"][..*n].iter().map(ToString::to_string).collect(),
        shape => (1..=rows(shape)).map(|k| k.to_string()).collect(),
    }
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
