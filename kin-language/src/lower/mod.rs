//! Second stage: reads the body by abstract interpretation over typed values. Each expression
//! becomes a `Value` over the scalar graph. An expression that the interpreter cannot read is
//! [`Unreadable`] and sends the whole constraint to the dual route. The interpreter collects a
//! mistake and continues.

pub mod alone;
mod apply;
mod arguments;
mod assign;
mod borrow;
mod branch;
mod call;
mod coerce;
mod endless;
mod expression;
mod flow;
mod function;
mod generic;
mod integer;
mod join;
mod loops;
mod matching;
mod method;
mod operator;
mod own;
mod paths;
mod pattern;
pub mod place;
mod rotation;
mod rows;
mod rustc;
mod scope;
mod state;
mod statement;
pub mod template;
mod typed;
mod value;

use std::collections::HashMap;

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;

use crate::error::Mistakes;
use crate::parse::{Argument, ConstraintFn, SecondReader, Shape};
use kin_graph::{Graph, Input, Node, Op};

pub use arguments::component_paths;
use flow::{Frame, Guard};
pub use place::Expressions;
pub use rows::{Row, names_as_written};
use scope::{Scopes, Slot, Store};
use template::Template;
use value::Value;

/// The body as a graph, with the data that emitted code needs about the inputs of the graph.
pub struct Lowered {
    pub graph: Graph,
    pub rows: Vec<Row>,
    /// The expressions by which emitted code reads each numeric parameter, indexed by the number of
    /// the parameter.
    pub parameters: Vec<TokenStream>,
    /// Values that only rustc can compute and that depend on no coordinate, indexed by the number
    /// in the graph.
    pub opaques: Vec<OpaqueValue>,
    /// The laws in the rows, indexed by the number in [`Op::Law`].
    pub laws: Vec<Template>,
    /// Values that only rustc can compute and that carry derivatives, indexed by the number in the
    /// graph.
    pub leaves: Vec<OpaqueValue>,
    /// The expressions to which the nodes belong.
    pub expressions: Expressions,
    /// Points and directions that do not move in their bodies.
    pub attachments: Vec<Attachment>,
    /// Items of the body that emitted code repeats: imports, types, and constants whose value is
    /// unknown here.
    pub items: Vec<syn::Item>,
    /// The result of a second reading without rounded constants, if the equation then differs.
    pub as_written: Option<Box<Lowered>>,
}

impl Lowered {
    /// Returns each law in the rows, with the node of its argument.
    pub fn laws_asked(&self) -> Vec<(usize, Node)> {
        let rows: Vec<Node> = self.rows.iter().map(|row| row.node).collect();
        let mut asked: Vec<(usize, Node)> = Vec::new();
        for node in self.graph.reachable(&rows) {
            if let Op::Law(law, x, _) = self.graph.op(node)
                && !asked.contains(&(law, x))
            {
                asked.push((law, x));
            }
        }
        asked
    }
}

/// A local point or direction of a body that depends on no coordinate and not on time.
#[derive(Clone, PartialEq)]
pub struct Attachment {
    /// The slot of the body.
    pub slot: usize,
    pub is_point: bool,
    pub local: Vec<Node>,
}

/// A value that only rustc can compute, with the shape that its place needs.
pub struct OpaqueValue {
    pub template: Template,
    pub kind: OpaqueKind,
}

/// The kind that the interpreter assumes for an opaque value.
#[derive(Clone, PartialEq, Debug)]
pub enum OpaqueKind {
    Numbers(Shape),
    Condition,
}

/// The reason why the body has no graph.
pub enum Failure {
    Mistakes(syn::Error),
    Unreadable(Unreadable),
}

/// An expression that may be good Rust, but that the interpreter cannot read.
pub struct Unreadable {
    pub span: Span,
    pub what: String,
}

impl Unreadable {
    fn new(at: &dyn ToTokens, what: impl Into<String>) -> Self {
        Unreadable { span: first_span(at), what: what.into() }
    }
}

/// Returns the span at which an expression begins.
fn first_span(at: &dyn ToTokens) -> Span {
    at.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| token.span())
}

/// A value, or the end of the reading.
type Read<T = Value> = Result<T, Unreadable>;

/// The most nodes of a graph. With more, rustc needs seconds and a deep stack for the straight-line
/// code.
const MOST_NODES: usize = 4_000;
/// The most turns of a loop that the interpreter unrolls.
const MOST_TURNS: i64 = 4_096;
/// The greatest depth of calls among the functions of the body.
const MOST_CALLS: usize = 48;
/// The most expressions that the interpreter reads, counting each turn of a loop.
const MOST_EXPRESSIONS: usize = 1_000_000;
/// The most parts of an expression that only rustc understands.
const MOST_PARTS: usize = 250;

/// Reads the body of `source`.
pub fn constraint(source: &ConstraintFn) -> Result<Lowered, Failure> {
    with_constants(&|graph| {
        let mut reader = Reader::new(graph);
        reader.declare_signature(source);
        let value =
            reader.function_body(&source.body, &source.output_type).map_err(Failure::Unreadable);
        let rows = value.map(|value| reader.rows(source, &value));
        reader.finish(rows)
    })
}

/// Reads the value of an attribute: an expression for a number over the arguments of `source`. The
/// items at the beginning of the body are in scope.
pub fn value(source: &ConstraintFn, expression: &syn::Expr) -> Result<Lowered, Failure> {
    with_constants(&|graph| {
        let mut reader = Reader::new(graph);
        reader.declare_signature(source);
        let items = source
            .body
            .stmts
            .iter()
            .take_while(|statement| matches!(statement, syn::Stmt::Item(_)));
        let body = syn::parse_quote!({ #(#items)* #expression });
        let value =
            reader.function_body(&body, &syn::parse_quote!(f64)).map_err(Failure::Unreadable);
        let row = value.map(|value| reader.scalar(value, expression));
        reader.finish(row.map(|node| vec![Row { name: String::new(), node }]))
    })
}

/// Reads the body of a law: a function of its first argument, which is a number.
pub fn law(
    variable: &Ident,
    parameters: &[Argument],
    body: &syn::Block,
    second_reader: SecondReader,
) -> Result<Lowered, Failure> {
    with_constants(&|graph| {
        let mut reader = Reader::new(graph);
        reader.second_reader = second_reader;
        let x = reader.graph.input(Input::Column(0));
        reader.declare(variable.to_string(), Value::Scalar(x));
        reader.declare_arguments(parameters);
        let value =
            reader.function_body(body, &syn::parse_quote!(f64)).map_err(Failure::Unreadable);
        let row = value.map(|value| reader.scalar(value, body));
        reader.finish(row.map(|node| vec![Row { name: String::new(), node }]))
    })
}

/// Reads with constants folded as f64 does, for kernels. If that rounds a constant, the function
/// reads a second time and keeps the constants as the user wrote them.
fn with_constants(read: &dyn Fn(Graph) -> Result<Lowered, Failure>) -> Result<Lowered, Failure> {
    let mut lowered = read(Graph::default())?;
    if lowered.graph.is_rounded() {
        lowered.as_written = read(Graph::as_written()).ok().map(Box::new);
    }
    Ok(lowered)
}

/// The interpreter.
struct Reader {
    graph: Graph,
    scopes: Scopes,
    store: Store,
    /// The frames around the present position, outermost first.
    frames: Vec<Frame>,
    mistakes: Mistakes,
    parameters: Vec<TokenStream>,
    opaques: Vec<OpaqueValue>,
    opaque_index: HashMap<String, usize>,
    laws: Vec<Template>,
    law_index: HashMap<String, usize>,
    leaves: Vec<OpaqueValue>,
    leaf_index: HashMap<String, usize>,
    expressions: Expressions,
    /// Rotation matrices by their entries, each with its Euler parameters.
    rotations: HashMap<Vec<Node>, Vec<Node>>,
    attachments: Vec<Attachment>,
    repeated_items: Vec<syn::Item>,
    /// The types that the body declares.
    own: own::Own,
    /// In a text, the variables without `mut`, by their slots. Empty for a program.
    fixed: HashMap<Slot, String>,
    second_reader: SecondReader,
    /// The lengths that the attribute gives to constants.
    lengths: Vec<(Ident, syn::LitInt)>,
    /// The types of the parameters that only rustc knows, by name.
    parameter_types: HashMap<String, syn::Type>,
    /// The types of the parameters that are integers or conditions, by name.
    no_numbers: HashMap<String, String>,
    /// The conditions that hold at the present position, from the branches and frames around it.
    path: Vec<Guard>,
    /// The declared type of the function's value.
    output: Option<syn::Type>,
    /// The number of the scope of the function's block.
    body_depth: usize,
    /// The present depth of calls among the functions of the body.
    calls: usize,
    expressions_read: usize,
}

impl Reader {
    fn new(graph: Graph) -> Self {
        let mut scopes = Scopes::default();
        scopes.push();
        Reader {
            graph,
            scopes,
            store: Store::default(),
            frames: Vec::new(),
            mistakes: Mistakes::default(),
            parameters: Vec::new(),
            opaques: Vec::new(),
            opaque_index: HashMap::new(),
            laws: Vec::new(),
            law_index: HashMap::new(),
            leaves: Vec::new(),
            leaf_index: HashMap::new(),
            expressions: Expressions::default(),
            rotations: HashMap::new(),
            attachments: Vec::new(),
            repeated_items: Vec::new(),
            own: own::Own::default(),
            fixed: HashMap::new(),
            second_reader: SecondReader::Rustc,
            lengths: Vec::new(),
            parameter_types: HashMap::new(),
            no_numbers: HashMap::new(),
            path: Vec::new(),
            output: None,
            body_depth: 0,
            calls: 0,
            expressions_read: 0,
        }
    }

    /// Returns the value of the function's body.
    fn function_body(&mut self, body: &syn::Block, output: &syn::Type) -> Read {
        self.body_depth = self.scopes.depth() + 1;
        self.output = Some(output.clone());
        let value = self.body(body)?;
        match self.loaded(value) {
            value @ Value::Generator(_) => self.typed(value, output, body),
            Value::Never => Err(Unreadable::new(body, "a function body without a value")),
            value => Ok(value),
        }
    }

    /// Returns the result of the reading. If there is a mistake, the function reports it rather
    /// than an unreadable expression.
    fn finish(mut self, rows: Result<Vec<Row>, Failure>) -> Result<Lowered, Failure> {
        self.mistakes.finish().map_err(Failure::Mistakes)?;
        if self.opaques.is_empty() && self.leaves.is_empty() && self.laws.is_empty() {
            // Only the code for opaque values, leaves and laws can use these items.
            self.repeated_items.clear();
        }
        Ok(Lowered {
            rows: rows?,
            graph: self.graph,
            parameters: self.parameters,
            opaques: self.opaques,
            laws: self.laws,
            leaves: self.leaves,
            expressions: self.expressions,
            attachments: self.attachments,
            items: self.repeated_items,
            as_written: None,
        })
    }

    /// Adds a mistake at `tokens`; the reading continues with a substitute value.
    fn mistake(&mut self, tokens: &dyn ToTokens, message: impl std::fmt::Display) -> Value {
        self.mistakes.add(tokens, message);
        Value::Poison
    }
}

/// Returns a message such as "`vec2` takes 2 numbers, not 1".
fn counted(what: &str, takes: usize, of: &str, given: usize) -> String {
    format!("{what} takes {takes} {of}{}, not {given}", if takes == 1 { "" } else { "s" })
}
