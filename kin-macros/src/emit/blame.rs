//! What tells where an equation fails to be finite: on the symbolic route the steps of its rows as a table, on the dual route a list of the
//! body's expressions. Data, but for what only the user's program can compute: it costs next to nothing to compile and nothing to run.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::kernel::{Kernel, number};
use super::{own, template};
use crate::differentiate::local_column;
use crate::graph::{Column, Comparison, Function, Input, LeafUse, Node, Op, Part};
use crate::lower::place::Expression;
use crate::lower::{Lowered, OpaqueKind};
use crate::parse::{Argument, Kind};

/// `graph` of the symbolic route, which `blame` stands on, and the jerk, and proofs.
pub fn symbolic(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let Written { graph, values, outside } = Written::of(arguments, lowered);
    quote! {
        #[cold]
        fn graph(&self, with: &mut dyn FnMut(&::kin::rt::graph::Graph, &[f64], ::kin::rt::graph::Outside<'_>)) {
            use ::kin::rt::graph::*;
            const GRAPH: &Graph = &#graph;
            with(GRAPH, &#values, #outside);
        }
    }
}

/// `over` of a law: its steps, its variable being column 0.
pub fn law(parameters: &[Argument], lowered: &Lowered) -> TokenStream {
    let Written { graph, values, outside } = Written::of(parameters, lowered);
    let x = own("x");
    quote! {
        #[cold]
        fn over(&self, #x: &::kin::rt::graph::Series) -> ::core::option::Option<::kin::rt::graph::Series> {
            use ::kin::rt::graph::*;
            const GRAPH: &Graph = &#graph;
            GRAPH.law_over(#x, &#values, #outside)
        }
    }
}

/// The table of an equation, the values of its parameters, and what computes what the table cannot.
struct Written {
    graph: TokenStream,
    values: TokenStream,
    outside: TokenStream,
}

impl Written {
    fn of(arguments: &[Argument], lowered: &Lowered) -> Self {
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let mut table =
            Table { arguments, lowered, steps: vec![], numbers: HashMap::new(), expressions: vec![], parameters: vec![], outside: vec![] };
        for node in lowered.graph.reachable(&rows) {
            let step = table.step(node);
            table.push(node, step);
        }
        let rows = rows.iter().map(|&row| table.of(row)).collect::<Vec<_>>();
        let expressions = listed(table.expressions.iter().map(|&k| &lowered.expressions.all[k]));
        let names = table.parameters.iter().map(|&k| parameter_name(&lowered.parameters[k], arguments));
        let values = table.parameters.iter().map(|&k| &lowered.parameters[k]);
        let steps = &table.steps;
        let graph = quote! {
            Graph {
                file: ::core::file!(),
                expressions: &[#(#expressions),*],
                steps: &[#(#steps),*],
                rows: &[#(#rows),*],
                parameters: &[#(#names),*],
            }
        };
        Written { graph, values: quote!([#(#values),*]), outside: table.outside() }
    }
}

/// `blame` of the dual route.
pub fn dual(expressions: &[Expression]) -> TokenStream {
    let expressions = listed(expressions.iter());
    quote! {
        #[cold]
        fn blame(&self, asked: &::kin::rt::Asked<'_>) -> ::core::option::Option<::kin::rt::Blame> {
            const BODY: ::kin::rt::graph::Body = ::kin::rt::graph::Body { file: ::core::file!(), expressions: &[#(#expressions),*] };
            ::kin::rt::graph::traced(self, asked, BODY)
        }
    }
}

/// Expressions with line and column.
fn listed<'a>(expressions: impl Iterator<Item = &'a Expression>) -> Vec<TokenStream> {
    expressions
        .map(|Expression { text, line, column }| {
            let (line, column) = (literal(*line), literal(*column));
            quote!((#text, #line, #column))
        })
        .collect()
}

/// What a parameter is called in `set_parameter`.
fn parameter_name(path: &TokenStream, arguments: &[Argument]) -> String {
    let text = path.to_string().replace(' ', "");
    let name = text.trim_start_matches("self.").replace("r#", "");
    let is_axis = |argument: &Argument| argument.kind == Kind::Axis && name.starts_with(&format!("{}.h.", argument.name));
    if arguments.iter().any(is_axis) { name.replacen(".h.", ".", 1) } else { name }
}

/// What only the user's program can compute.
#[derive(Clone, Copy, PartialEq)]
enum Outside {
    Law(usize),
    Opaque(usize),
    Leaf(usize),
}

/// The table while it is being written.
struct Table<'a> {
    arguments: &'a [Argument],
    lowered: &'a Lowered,
    steps: Vec<TokenStream>,
    /// The step of each node.
    numbers: HashMap<Node, usize>,
    /// Numbers of the expressions and parameters that are in it.
    expressions: Vec<usize>,
    parameters: Vec<usize>,
    outside: Vec<Outside>,
}

impl Table<'_> {
    fn push(&mut self, node: Node, step: TokenStream) {
        let expression = self.lowered.expressions.of(node).map_or(usize::from(u16::MAX), |k| place(&mut self.expressions, k));
        let expression = literal(expression);
        self.numbers.insert(node, self.steps.len());
        self.steps.push(quote!((#expression, #step)));
    }

    /// The step of a node that has one.
    fn of(&self, node: Node) -> Literal {
        literal(self.numbers.get(&node).copied().unwrap_or_default())
    }

    fn step(&mut self, node: Node) -> TokenStream {
        let graph = &self.lowered.graph;
        let of = |node: Node| self.of(node);
        let two = |name: &str, a: Node, b: Node| {
            let (name, a, b) = (word(name), of(a), of(b));
            quote!(Call2(#name, #a, #b))
        };
        let pair = |name: &str, a: Node, b: Node| {
            let (name, a, b) = (word(name), of(a), of(b));
            quote!(#name(#a, #b))
        };
        match graph.op(node) {
            Op::Input(input) => self.input(node, input),
            Op::Constant(bits) => {
                let value = number(f64::from_bits(bits));
                quote!(Constant(#value))
            }
            Op::Truth(holds) => {
                let value = number(if holds { 1.0 } else { 0.0 });
                quote!(Constant(#value))
            }
            Op::Add(a, b) => two("Sum", a, b),
            Op::Sub(a, b) => two("Difference", a, b),
            Op::Mul(a, b) => two("Product", a, b),
            Op::Div(a, b) => two("Quotient", a, b),
            Op::Call2(f, a, b) => two(&format!("{f:?}"), a, b),
            Op::Call(f, a) => {
                let a = of(a);
                call(f, &a)
            }
            Op::Neg(a) => {
                let a = of(a);
                quote!(Negated(#a))
            }
            Op::Not(a) => {
                let a = of(a);
                quote!(Not(#a))
            }
            Op::Powi(a, n) => {
                let (a, n) = (of(a), Literal::i32_unsuffixed(n));
                quote!(Power(#a, #n))
            }
            Op::Select(c, a, b) => {
                let (c, a, b) = (of(c), of(a), of(b));
                quote!(Select(#c, #a, #b))
            }
            Op::Compare(comparison, a, b) => {
                let (comparison, a, b) = (compared(comparison), of(a), of(b));
                quote!(Compare(#comparison, #a, #b))
            }
            Op::And(a, b) => pair("Both", a, b),
            Op::Or(a, b) => pair("Either", a, b),
            Op::Law(law, x, order) => {
                let (x, order) = (of(x), Literal::u8_unsuffixed(order));
                let law = literal(place(&mut self.outside, Outside::Law(law)));
                quote!(Law(#law, #x, #order))
            }
            Op::Opaque(number, component) => self.foreign(node, Outside::Opaque(number), component),
            Op::Leaf(LeafUse { leaf, output, .. }) => self.foreign(node, Outside::Leaf(leaf), output),
            // Made by the scheduler, which works on a kernel's own nodes.
            Op::Fma(..) => quote!(Constant(f64::NAN)),
        }
    }

    fn foreign(&mut self, node: Node, what: Outside, component: usize) -> TokenStream {
        let operands: Vec<Literal> = self.lowered.graph.operands(node).into_iter().map(|operand| self.of(operand)).collect();
        let (number, component) = (literal(place(&mut self.outside, what)), literal(component));
        quote!(Foreign(#number, &[#(#operands),*], #component))
    }

    fn input(&mut self, node: Node, input: Input) -> TokenStream {
        match input {
            Input::Parameter(k) => {
                let k = literal(place(&mut self.parameters, k));
                quote!(Parameter(#k))
            }
            Input::State(argument, part) => {
                let coordinate = if matches!(part, Part::Sin | Part::Cos) { Part::Theta } else { part };
                let column = literal(local_column(self.arguments, Column { argument, part: coordinate }));
                let f = match part {
                    Part::Sin => Function::Sin,
                    Part::Cos => Function::Cos,
                    _ => return quote!(Column(#column)),
                };
                self.push(node, quote!(Column(#column)));
                call(f, &self.of(node))
            }
            Input::Time => quote!(Time),
            Input::Variable => quote!(Column(0)),
            // Not of an equation's own value.
            Input::Rate(..) | Input::TimeRate | Input::Timed(_) => quote!(Constant(f64::NAN)),
        }
    }

    /// The function that computes what the table cannot.
    fn outside(&self) -> TokenStream {
        if self.outside.is_empty() {
            return quote!(&nothing_outside);
        }
        let (number, x, to) = (own("number"), own("x"), own("to"));
        let cases = self.outside.iter().enumerate().map(|(k, what)| {
            let (k, code) = (literal(k), self.computed(*what, &x, &to));
            quote!(#k => { #code })
        });
        quote!(&|#number, #x, #to| match #number { #(#cases)* _ => {} })
    }

    fn computed(&self, what: Outside, x: &Ident, to: &Ident) -> TokenStream {
        match what {
            Outside::Law(law) => {
                let law = template::place(&self.lowered.laws[law]);
                quote!(give_law(&#law, #x, #to))
            }
            Outside::Opaque(number) => self.opaque(number, x, to),
            Outside::Leaf(leaf) => self.leaf(leaf, x, to),
        }
    }

    fn opaque(&self, number: usize, x: &Ident, to: &Ident) -> TokenStream {
        let (graph, values) = (&self.lowered.graph, own("values"));
        let count = match &self.lowered.opaques[number].kind {
            OpaqueKind::Numbers(shape) => shape.len(),
            OpaqueKind::Condition => 1,
        };
        let given = graph.opaques[number].iter().enumerate().map(|(k, &node)| {
            let k = literal(k);
            (node, if super::kernel::is_condition(self.lowered, node) { quote!((#x[#k].re != 0.0)) } else { quote!(#x[#k].re) })
        });
        let kernel = Kernel::from_given(self.lowered, self.arguments, given.collect());
        let outputs = (0..count).filter_map(|k| {
            let (node, k) = (graph.existing(Op::Opaque(number, k))?, literal(k));
            Some((quote!(#values[#k]), node))
        });
        let (code, count) = (kernel.write(&outputs.collect::<Vec<_>>()).tokens, literal(count));
        quote! {
            let mut #values = [0.0; #count];
            #code
            give(&#values, #to)
        }
    }

    fn leaf(&self, leaf: usize, x: &Ident, to: &Ident) -> TokenStream {
        let leaf = &self.lowered.graph.leaves[leaf];
        let (function, value) = (template::leaf_name(leaf.call), own("value"));
        let kind = &self.lowered.leaves[leaf.call].kind;
        let OpaqueKind::Numbers(shape) = kind else { return quote!() };
        let inputs = (0..leaf.arguments.len()).map(literal).map(|k| quote!(::kin::rt::Real(#x[#k])));
        let ty = template::shape_type(shape, &quote!(::kin::rt::Real<::kin::rt::Dual3_64>));
        let results = (0..shape.len()).map(|k| template::component(&value, kind, k));
        quote! {
            let #value: #ty = self.#function([#(#inputs),*]);
            #(#to.push(#results.0);)*
        }
    }
}

/// The place of an item in a list, which it is put into if it is not there.
fn place<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    list.iter().position(|known| *known == item).unwrap_or_else(|| {
        list.push(item);
        list.len() - 1
    })
}

fn call(f: Function, of: &Literal) -> TokenStream {
    let f = word(&format!("{f:?}"));
    quote!(Call(#f, #of))
}

fn compared(comparison: Comparison) -> Ident {
    word(&format!("{comparison:?}"))
}

fn word(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
