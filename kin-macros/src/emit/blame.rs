//! The data that tell where an equation fails to be finite: on the symbolic route the steps of its rows as a
//! table, on the dual route a list of the body's expressions. Data, but for what only the user's program can
//! compute: they cost next to nothing to compile and nothing to run.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::kernel::Kernel;
use super::{own, template};
use crate::derivatives::local_column;
use kin_graph::{Column, Formula, Function, Input, LeafUse, Node, Op, Part};
use kin_language::lower::place::Expression;
use kin_language::lower::{Lowered, OpaqueKind};
use kin_language::parse::{Argument, Kind};

/// `table` and `outside` of the symbolic route, which `blame` stands on, the jerk, and proofs.
pub fn symbolic(arguments: &[Argument], lowered: &Lowered) -> TokenStream {
    let Written { table, values, outside } = Written::of(arguments, lowered);
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

/// `over` of a law: its steps, its variable being column 0.
pub fn law(parameters: &[Argument], lowered: &Lowered) -> TokenStream {
    let Written { table, values, outside } = Written::of(parameters, lowered);
    let [number, x, to] = outside_names();
    let (count, laws) = (literal(lowered.laws.len()), lowered.laws.iter().map(template::place));
    let outside = outside.map_or_else(
        || quote!(::kin::emitted::graph::nothing_outside),
        |outside| quote!(|#number, #x, #to| #outside),
    );
    quote! {
        #[cold]
        fn over(&self, #x: &::kin::emitted::graph::Series) -> ::core::option::Option<::kin::emitted::graph::Series> {
            static TABLE: ::kin::emitted::graph::Table = #table;
            TABLE.law_over(#x, &#values, &#outside)
        }
        #[cold]
        fn trusted(&self) -> ::std::vec::Vec<::std::string::String> {
            let all: [::std::vec::Vec<::std::string::String>; #count] = [#(#laws.trusted()),*];
            all.concat()
        }
    }
}

/// The table of an equation, the values of its parameters, and what computes what the table cannot.
struct Written {
    table: TokenStream,
    values: TokenStream,
    /// By its number, from `x` into `to`; nothing where there is nothing of the kind.
    outside: Option<TokenStream>,
}

/// The number of a value that is asked for, its inputs, and the place that it goes to.
fn outside_names() -> [Ident; 3] {
    ["number", "x", "to"].map(own)
}

impl Written {
    /// The equation as it was written, if it could be read so.
    fn of(arguments: &[Argument], folded: &Lowered) -> Self {
        let lowered = folded.as_written.as_deref().unwrap_or(folded);
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let has_leaves = lowered.leaves.len() == folded.leaves.len();
        let mut formula = Formula::default();
        formula.is_rounded = lowered.graph.is_rounded() && !lowered.graph.keeps_constants();
        let mut table = Table {
            arguments,
            lowered,
            has_leaves,
            formula,
            nodes: HashMap::new(),
            parameters: vec![],
            outside: vec![],
        };
        for node in lowered.graph.reachable(&rows) {
            let same = table.node(node);
            table.nodes.insert(node, same);
        }
        table.formula.rows = rows.iter().map(|&row| table.of(row)).collect();
        table.formula.parameters =
            table.parameters.iter().map(|&k| parameter_name(&lowered.parameters[k], arguments)).collect();
        let text = readable(&table.formula.to_string());
        let values = table.parameters.iter().map(|&k| &lowered.parameters[k]);
        Written {
            table: quote!(::kin::emitted::graph::Table::new(::core::file!(), #text)),
            values: quote!([#(#values),*]),
            outside: table.outside(),
        }
    }
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
            let (line, column) = (literal(*line), literal(*column));
            quote!((#text, #line, #column))
        })
        .collect()
}

/// The name of a parameter in `set_parameter`.
fn parameter_name(path: &TokenStream, arguments: &[Argument]) -> String {
    let text = path.to_string().replace(' ', "");
    let name = text.trim_start_matches("self.").replace("r#", "");
    let is_axis = |argument: &Argument| {
        argument.kind == Kind::Axis && name.starts_with(&format!("{}.h.", argument.name))
    };
    if arguments.iter().any(is_axis) { name.replacen(".h.", ".", 1) } else { name }
}

/// A value that only the user's program can compute.
#[derive(Clone, Copy, PartialEq)]
enum Outside {
    Law(usize),
    Opaque(usize),
    Leaf(usize),
}

/// The formula of the rows while it is being made.
struct Table<'a> {
    arguments: &'a [Argument],
    lowered: &'a Lowered,
    /// True if the functions of its leaves are emitted under the numbers that they have here.
    has_leaves: bool,
    formula: Formula,
    /// The node of the formula that each node of the rows is.
    nodes: HashMap<Node, Node>,
    /// Numbers of the parameters that are in it.
    parameters: Vec<usize>,
    outside: Vec<Outside>,
}

impl Table<'_> {
    /// The formula's node of one that has been put there.
    fn of(&self, node: Node) -> Node {
        self.nodes.get(&node).copied().unwrap_or_default()
    }

    /// Puts a node into the formula, whose operands are there.
    fn node(&mut self, node: Node) -> Node {
        let graph = &self.lowered.graph;
        let op = match graph.op(node) {
            Op::Input(input) => self.input(node, input),
            Op::Law(law, x, order) => Op::Law(place(&mut self.outside, Outside::Law(law)), self.of(x), order),
            Op::Opaque(number, component) => return self.foreign(node, Outside::Opaque(number), component),
            Op::Leaf(LeafUse { leaf, output, .. }) => return self.foreign(node, Outside::Leaf(leaf), output),
            Op::Decimal(k) => {
                let decimal = &graph.decimals[k];
                let expression = self.expression(node);
                return self.formula.push_decimal(decimal.nearest, decimal.above, expression);
            }
            op => op.with_operands(|operand| self.of(operand)),
        };
        let expression = self.expression(node);
        self.formula.push(op, expression)
    }

    fn foreign(&mut self, node: Node, what: Outside, component: usize) -> Node {
        let number = place(&mut self.outside, what);
        let operands =
            self.lowered.graph.operands(node).into_iter().map(|operand| self.of(operand)).collect();
        let expression = self.expression(node);
        self.formula.push_opaque(number, component, operands, expression)
    }

    fn input(&mut self, node: Node, input: Input) -> Op {
        let not_of_a_formula = Op::Constant(f64::NAN.to_bits());
        match input {
            Input::Parameter(k) => Op::Input(Input::Parameter(place(&mut self.parameters, k))),
            Input::State(argument, part) => {
                let function = match part {
                    Part::Sin => Some(Function::Sin),
                    Part::Cos => Some(Function::Cos),
                    _ => None,
                };
                let coordinate = if function.is_some() { Part::Theta } else { part };
                let column = Op::Input(Input::Column(local_column(
                    self.arguments,
                    Column { argument, part: coordinate },
                )));
                let Some(function) = function else { return column };
                let expression = self.expression(node);
                Op::Call(function, self.formula.push(column, expression))
            }
            Input::Time | Input::Column(_) => Op::Input(input),
            Input::Rate(..) | Input::TimeRate | Input::Timed(_) => not_of_a_formula,
        }
    }

    /// The number in the formula of the expression that a node is of.
    fn expression(&mut self, node: Node) -> Option<usize> {
        let Expression { text, line, column } =
            &self.lowered.expressions.all[self.lowered.expressions.of(node)?];
        let expression =
            kin_graph::Expression { text: text.clone(), line: *line as u32, column: *column as u32 };
        Some(place(&mut self.formula.expressions, expression))
    }

    /// The function that computes what the table cannot.
    fn outside(&self) -> Option<TokenStream> {
        let [number, x, to] = outside_names();
        let cases = self.outside.iter().enumerate().map(|(k, what)| {
            let (k, code) = (literal(k), self.computed(*what, &x, &to));
            quote!(#k => { #code })
        });
        (!self.outside.is_empty()).then(|| quote!(match #number { #(#cases)* _ => {} }))
    }

    fn computed(&self, what: Outside, x: &Ident, to: &Ident) -> TokenStream {
        match what {
            Outside::Law(law) => {
                let law = template::place(&self.lowered.laws[law]);
                quote!(::kin::emitted::graph::give_law(&#law, #x, #to))
            }
            Outside::Opaque(number) => self.opaque(number, x, to),
            Outside::Leaf(leaf) => self.leaf(leaf, x, to),
        }
    }

    fn opaque(&self, number: usize, x: &Ident, to: &Ident) -> TokenStream {
        let graph = &self.lowered.graph;
        let count = match &self.lowered.opaques[number].kind {
            OpaqueKind::Numbers(shape) => shape.count(),
            OpaqueKind::Condition => 1,
        };
        let given = graph.opaques[number].iter().enumerate().map(|(k, &node)| {
            let k = literal(k);
            (
                node,
                if super::kernel::is_condition(self.lowered, node) {
                    quote!((#x[#k].re != 0.0))
                } else {
                    quote!(#x[#k].re)
                },
            )
        });
        let kernel = Kernel::from_given(self.lowered, self.arguments, given.collect());
        let found: Vec<Option<Node>> = (0..count).map(|k| graph.existing(Op::Opaque(number, k))).collect();
        let (code, values) = kernel.values(&found.iter().copied().flatten().collect::<Vec<Node>>());
        let (code, mut values) = (code.tokens, values.into_iter());
        let values = found.iter().map(|node| node.and_then(|_| values.next()).unwrap_or_else(|| quote!(0.0)));
        quote! {
            #code
            ::kin::emitted::graph::give(&[#(#values),*], #to)
        }
    }

    fn leaf(&self, leaf: usize, x: &Ident, to: &Ident) -> TokenStream {
        let leaf = &self.lowered.graph.leaves[leaf];
        let (function, value) = (template::leaf_name(leaf.call), own("value"));
        let kind = &self.lowered.leaves[leaf.call].kind;
        let OpaqueKind::Numbers(shape) = kind else { return quote!() };
        if !self.has_leaves {
            return quote!();
        }
        let inputs = (0..leaf.arguments.len()).map(literal).map(|k| quote!(::kin::emitted::Real(#x[#k])));
        let ty = template::shape_type(shape, &quote!(::kin::emitted::Real<::kin::emitted::Dual3_64>));
        let results = (0..shape.count()).map(|k| template::component(&value, kind, k));
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

/// A text over several lines as it stands, so that it can be read in the expansion.
fn readable(text: &str) -> Literal {
    let raw = format!("r##\"{text}\"##");
    raw.parse().unwrap_or_else(|_| Literal::string(text))
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
