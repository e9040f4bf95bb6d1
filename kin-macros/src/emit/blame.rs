//! What tells where an equation fails to be finite: on the symbolic route the steps of its rows as a table, on the dual route a list of the
//! body's expressions. Data, but for what only the user's program can compute: it costs next to nothing to compile and nothing to run.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::kernel::Kernel;
use super::{own, template};
use crate::derivatives::local_column;
use kin_graph::{Column, Input, LeafUse, Node, Op, Part};
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
            fn outside(&self, #number: usize, #x: &[::kin::rt::graph::Dual3_64], #to: &mut ::kin::rt::graph::Given) {
                #outside
            }
        }
    });
    quote! {
        #[cold]
        fn table(&self) -> ::core::option::Option<(&'static ::kin::rt::graph::Graph, ::std::vec::Vec<f64>)> {
            static TABLE: ::kin::rt::graph::Table = #table;
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
    let outside = outside.map_or_else(|| quote!(::kin::rt::graph::nothing_outside), |outside| quote!(|#number, #x, #to| #outside));
    quote! {
        #[cold]
        fn over(&self, #x: &::kin::rt::graph::Series) -> ::core::option::Option<::kin::rt::graph::Series> {
            static TABLE: ::kin::rt::graph::Table = #table;
            TABLE.graph().law_over(#x, &#values, &#outside)
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

/// What is asked for by its number, what it is computed from, and where it goes.
fn outside_names() -> [Ident; 3] {
    ["number", "x", "to"].map(own)
}

impl Written {
    /// The equation as it was written, if it could be read so.
    fn of(arguments: &[Argument], folded: &Lowered) -> Self {
        let lowered = folded.as_written.as_deref().unwrap_or(folded);
        let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
        let has_leaves = lowered.leaves.len() == folded.leaves.len();
        let mut table = Table {
            arguments,
            lowered,
            has_leaves,
            steps: vec![],
            numbers: HashMap::new(),
            expressions: vec![],
            parameters: vec![],
            outside: vec![],
        };
        for node in lowered.graph.reachable(&rows) {
            let step = table.step(node);
            table.push(node, &step);
        }
        let text = table.text(&rows);
        let values = table.parameters.iter().map(|&k| &lowered.parameters[k]);
        Written {
            table: quote!(::kin::rt::graph::Table::new(::core::file!(), #text)),
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

/// The table while it is being written: lines that `kin_core::blame::table` reads.
struct Table<'a> {
    arguments: &'a [Argument],
    lowered: &'a Lowered,
    /// Whether the functions of its leaves are emitted under the numbers that they have here.
    has_leaves: bool,
    steps: Vec<String>,
    /// The step of each node.
    numbers: HashMap<Node, usize>,
    /// Numbers of the expressions and parameters that are in it.
    expressions: Vec<usize>,
    parameters: Vec<usize>,
    outside: Vec<Outside>,
}

impl Table<'_> {
    /// The whole table as one literal: to the compiler one token.
    fn text(&self, rows: &[Node]) -> Literal {
        let mut text = String::new();
        for Expression { text: written, line, column } in self.expressions.iter().map(|&k| &self.lowered.expressions.all[k]) {
            text.push_str(&format!("\nat {line} {column} {}", written.replace('\n', " ")));
        }
        text.push_str("\nparameters");
        for &k in &self.parameters {
            text.push_str(&format!(" {}", parameter_name(&self.lowered.parameters[k], self.arguments)));
        }
        if self.lowered.graph.is_rounded() && !self.lowered.graph.keeps_constants() {
            text.push_str("\nrounded");
        }
        text.push_str("\nrows");
        for &row in rows {
            text.push_str(&format!(" {}", self.of(row)));
        }
        for step in &self.steps {
            text.push('\n');
            text.push_str(step);
        }
        readable(&text)
    }

    fn push(&mut self, node: Node, step: &str) {
        let expression = self.lowered.expressions.of(node).map(|k| place(&mut self.expressions, k));
        let expression = expression.map_or_else(|| "-".to_owned(), |number| number.to_string());
        self.numbers.insert(node, self.steps.len());
        self.steps.push(format!("{expression} {step}"));
    }

    /// The step of a node that has one.
    fn of(&self, node: Node) -> usize {
        self.numbers.get(&node).copied().unwrap_or_default()
    }

    fn step(&mut self, node: Node) -> String {
        let graph = &self.lowered.graph;
        let of =
            |name: &str, operands: &[Node]| operands.iter().fold(name.to_owned(), |step, operand| format!("{step} {}", self.of(*operand)));
        match graph.op(node) {
            Op::Input(input) => self.input(node, input),
            Op::Constant(bits) => format!("Constant {:?}", f64::from_bits(bits)),
            Op::Decimal(k) => {
                let decimal = &graph.decimals[k];
                format!("Decimal {:?} {}", decimal.nearest, u8::from(decimal.above))
            }
            Op::Truth(holds) => format!("Constant {}", u8::from(holds)),
            Op::Add(a, b) => of("Sum", &[a, b]),
            Op::Sub(a, b) => of("Difference", &[a, b]),
            Op::Mul(a, b) => of("Product", &[a, b]),
            Op::Div(a, b) => of("Quotient", &[a, b]),
            Op::Call2(f, a, b) => of(&format!("{f:?}"), &[a, b]),
            Op::Call(f, a) => of(&format!("{f:?}"), &[a]),
            Op::Neg(a) => of("Negated", &[a]),
            Op::Not(a) => of("Not", &[a]),
            Op::Powi(a, n) => format!("Power {} {n}", self.of(a)),
            Op::Select(c, a, b) => of("Select", &[c, a, b]),
            Op::Compare(comparison, a, b) => of(&format!("{comparison:?}"), &[a, b]),
            Op::And(a, b) => of("Both", &[a, b]),
            Op::Or(a, b) => of("Either", &[a, b]),
            Op::Law(law, x, order) => {
                let law = place(&mut self.outside, Outside::Law(law));
                format!("Law {law} {} {order}", self.of(x))
            }
            Op::Opaque(number, component) => self.foreign(node, Outside::Opaque(number), component),
            Op::Leaf(LeafUse { leaf, output, .. }) => self.foreign(node, Outside::Leaf(leaf), output),
            // Made by the scheduler, which works on a kernel's own nodes.
            Op::Fma(..) => "Constant NaN".to_owned(),
        }
    }

    fn foreign(&mut self, node: Node, what: Outside, component: usize) -> String {
        let number = place(&mut self.outside, what);
        let operands = self.lowered.graph.operands(node);
        operands.iter().fold(format!("Foreign {number} {component}"), |step, operand| format!("{step} {}", self.of(*operand)))
    }

    fn input(&mut self, node: Node, input: Input) -> String {
        match input {
            Input::Parameter(k) => format!("Parameter {}", place(&mut self.parameters, k)),
            Input::State(argument, part) => {
                let coordinate = if matches!(part, Part::Sin | Part::Cos) { Part::Theta } else { part };
                let column = format!("Column {}", local_column(self.arguments, Column { argument, part: coordinate }));
                if coordinate == part {
                    return column;
                }
                self.push(node, &column);
                format!("{part:?} {}", self.of(node))
            }
            Input::Time => "Time".to_owned(),
            Input::Variable => "Column 0".to_owned(),
            // Not of an equation's own value.
            Input::Rate(..) | Input::TimeRate | Input::Timed(_) => "Constant NaN".to_owned(),
        }
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
                quote!(::kin::rt::graph::give_law(&#law, #x, #to))
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
            (node, if super::kernel::is_condition(self.lowered, node) { quote!((#x[#k].re != 0.0)) } else { quote!(#x[#k].re) })
        });
        let kernel = Kernel::from_given(self.lowered, self.arguments, given.collect());
        let found: Vec<Option<Node>> = (0..count).map(|k| graph.existing(Op::Opaque(number, k))).collect();
        let (code, values) = kernel.values(&found.iter().copied().flatten().collect::<Vec<Node>>());
        let (code, mut values) = (code.tokens, values.into_iter());
        let values = found.iter().map(|node| node.and_then(|_| values.next()).unwrap_or_else(|| quote!(0.0)));
        quote! {
            #code
            ::kin::rt::graph::give(&[#(#values),*], #to)
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
        let inputs = (0..leaf.arguments.len()).map(literal).map(|k| quote!(::kin::rt::Real(#x[#k])));
        let ty = template::shape_type(shape, &quote!(::kin::rt::Real<::kin::rt::Dual3_64>));
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
