//! The data that tell where an equation fails to be finite: on the symbolic route the steps of its
//! rows as a table, on the dual route a list of the body's expressions. Data, but for what only the
//! user's program can compute: they cost next to nothing to compile and nothing to run.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::kernel::Kernel;
use super::{own, template};
use kin_graph::{Node, Op};
use kin_language::formula::{Outside, Written};
use kin_language::lower::Expression;
use kin_language::lower::{Lowered, OpaqueKind};
use kin_language::parse::Argument;

/// `table` and `outside` of the symbolic route, which `blame` stands on, the jerk, and proofs.
pub fn symbolic(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let found = Table::of(arguments, lowered);
    let table = found.table();
    let values = found.values();
    let outside = found.outside();
    let [number, x, to] = outside_names();
    let outside = outside.map(|outside| {
        quote! {
            #[cold]
            fn outside(&self, #number: usize, #x: &[::kin::emitted::graph::Dual3_64], #to: &mut ::kin::emitted::graph::Given) {
                #outside
            }
        }
    });
    quote! {
        #[cold]
        fn table(&self) -> ::core::option::Option<(&'static ::kin::emitted::graph::Table, ::std::vec::Vec<f64>)> {
            static TABLE: ::kin::emitted::graph::Table = #table;
            TABLE.with(&#values)
        }
        #outside
    }
}

/// A law's own function that has its formula, in which its variable is column 0; and what the law
/// says of itself by it: bounds, the laws on whose word they rest, itself within the graph of a
/// mechanism, and its derivatives by parameters.
pub fn law(parameters: &[Argument], lowered: &Lowered) -> [TokenStream; 2] {
    let found = Table::of(parameters, lowered);
    let table = found.table();
    let values = found.values();
    let outside = found.outside();
    let [number, x, to] = outside_names();
    let outside = outside.map_or_else(
        || quote!(::kin::emitted::graph::nothing_outside),
        |outside| quote!(|#number, #x, #to| #outside),
    );
    let asked = quote!(&#values, &#outside);
    let formula = quote! {
        fn formula() -> &'static ::kin::emitted::graph::Table {
            static TABLE: ::kin::emitted::graph::Table = #table;
            &TABLE
        }
    };
    let methods = quote! {
        #[cold]
        fn over(&self, x: &::kin::emitted::graph::Series) -> ::core::option::Option<::kin::emitted::graph::Series> {
            Self::formula().law_over(x, #asked)
        }
        #[cold]
        fn written(&self, graph: &mut ::kin::emitted::graph::Graph, x: ::kin::emitted::graph::Node) -> ::core::option::Option<::kin::emitted::graph::Node> {
            Self::formula().law_in(graph, x, #asked)
        }
        #[cold]
        fn by_parameter(&self, name: &str) -> ::core::option::Option<::kin::Law> {
            Self::formula().law_by(name, #asked)
        }
        #[cold]
        fn trusted(&self) -> ::std::vec::Vec<::std::string::String> {
            Self::formula().law_trusted(&#outside)
        }
    };
    [formula, methods]
}

/// The table of an equation, the values of its parameters, and what computes what the table cannot.
struct Table<'a> {
    arguments: &'a [Argument],
    written: Written<'a>,
    /// True if the functions of its leaves are emitted under the numbers that they have here.
    has_leaves: bool,
}

/// The number of a value that is asked for, its inputs, and the place that it goes to.
fn outside_names() -> [Ident; 3] {
    ["number", "x", "to"].map(own)
}

/// `blame` of the dual route.
pub fn dual(expressions: &[Expression]) -> TokenStream {
    let expressions = listed(expressions.iter());
    quote! {
        #[cold]
        fn blame(&self, asked: &::kin::emitted::Asked<'_>) -> ::core::option::Option<::kin::emitted::Blame> {
            const BODY: ::kin::emitted::graph::Body = ::kin::emitted::graph::Body { file: ::core::file!(), expressions: &[#(#expressions),*] };
            ::kin::emitted::graph::traced(self, asked, BODY)
        }
    }
}

/// Expressions with line and column.
fn listed<'a>(expressions: impl Iterator<Item = &'a Expression>) -> Vec<TokenStream> {
    expressions
        .map(|Expression { text, line, column }| {
            let line = literal(*line);
            let column = literal(*column);
            quote!((#text, #line, #column))
        })
        .collect()
}

impl<'a> Table<'a> {
    fn of(arguments: &'a [Argument], folded: &'a Lowered) -> Self {
        let written = Written::of(arguments, folded);
        let has_leaves = written.lowered.leaves.len() == folded.leaves.len();
        Table { arguments, written, has_leaves }
    }

    /// The formula as text.
    fn table(&self) -> TokenStream {
        let text = readable(&self.written.formula.to_string());
        quote!(::kin::emitted::graph::Table::new(::core::file!(), #text))
    }

    /// The values of the parameters.
    fn values(&self) -> TokenStream {
        let values = self.written.parameters.iter().map(|&k| &self.written.lowered.parameters[k]);
        quote!([#(#values),*])
    }

    /// The function that computes what the table cannot.
    fn outside(&self) -> Option<TokenStream> {
        let [number, x, to] = outside_names();
        let cases = self.written.outside.iter().enumerate().map(|(k, what)| {
            let k = literal(k);
            let code = self.computed(*what, &x, &to);
            quote!(#k => { #code })
        });
        (!self.written.outside.is_empty()).then(|| quote!(match #number { #(#cases)* _ => {} }))
    }

    fn computed(&self, what: Outside, x: &Ident, to: &Ident) -> TokenStream {
        match what {
            Outside::Law(law) => {
                let law = template::place(&self.written.lowered.laws[law]);
                quote!(::kin::emitted::graph::give_law(&#law, #x, #to))
            }
            Outside::Opaque(number) => self.opaque(number, x, to),
            Outside::Leaf(leaf) => self.leaf(leaf, x, to),
        }
    }

    fn opaque(&self, number: usize, x: &Ident, to: &Ident) -> TokenStream {
        let graph = &self.written.lowered.graph;
        let count = match &self.written.lowered.opaques[number].kind {
            OpaqueKind::Numbers(shape) => shape.count(),
            OpaqueKind::Condition => 1,
        };
        let given = graph.opaques[number].iter().enumerate().map(|(k, &node)| {
            let k = literal(k);
            (
                node,
                if super::kernel::is_condition(self.written.lowered, node) {
                    quote!((#x[#k].re != 0.0))
                } else {
                    quote!(#x[#k].re)
                },
            )
        });
        let kernel = Kernel::from_given(self.written.lowered, self.arguments, given.collect());
        let found: Vec<Option<Node>> =
            (0..count).map(|k| graph.existing(Op::Opaque(number, k))).collect();
        let (code, values) = kernel.values(&found.iter().copied().flatten().collect::<Vec<Node>>());
        let code = code.tokens;
        let mut values = values.into_iter();
        let values = found
            .iter()
            .map(|node| node.and_then(|_| values.next()).unwrap_or_else(|| quote!(0.0)));
        quote! {
            #code
            ::kin::emitted::graph::give(&[#(#values),*], #to)
        }
    }

    fn leaf(&self, leaf: usize, x: &Ident, to: &Ident) -> TokenStream {
        let leaf = &self.written.lowered.graph.leaves[leaf];
        let function = template::leaf_name(leaf.call);
        let value = own("value");
        let kind = &self.written.lowered.leaves[leaf.call].kind;
        let OpaqueKind::Numbers(shape) = kind else { return quote!() };
        if !self.has_leaves {
            return quote!();
        }
        let inputs =
            (0..leaf.arguments.len()).map(literal).map(|k| quote!(::kin::emitted::Real(#x[#k])));
        let ty =
            template::shape_type(shape, &quote!(::kin::emitted::Real<::kin::emitted::Dual3_64>));
        let results = (0..shape.count()).map(|k| template::component(&value, kind, k));
        quote! {
            let #value: #ty = self.#function([#(#inputs),*]);
            #(#to.push(#results.0);)*
        }
    }
}

/// A text over several lines as it stands, so that it can be read in the expansion.
fn readable(text: &str) -> Literal {
    let raw = format!("r##\"{text}\"##");
    raw.parse().unwrap_or_else(|_| Literal::string(text))
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
