//! Second stage: reads the body by abstract interpretation over typed values. Each expression
//! becomes a `Value` over the scalar graph; what cannot be read is [`Unreadable`] and sends the
//! whole constraint to the dual route; a mistake is collected and reading goes on.

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

/// The body as a graph, with everything emitted code needs to know about its inputs.
pub struct Lowered {
    pub graph: Graph,
    pub rows: Vec<Row>,
    /// How emitted code reads each numeric parameter.
    pub parameters: Vec<TokenStream>,
    pub opaques: Vec<OpaqueValue>,
    pub laws: Vec<Template>,
    pub leaves: Vec<OpaqueValue>,
    /// The expressions that the nodes are of.
    pub expressions: Expressions,
    /// Points and directions that do not move in their bodies.
    pub attachments: Vec<Attachment>,
    /// Items of the body that emitted code repeats: imports, types, constants whose value is not
    /// known here.
    pub items: Vec<syn::Item>,
    /// The same read once more without rounding constants, where that makes a difference.
    pub as_written: Option<Box<Lowered>>,
}

impl Lowered {
    /// Each law that the rows ask, and where.
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
    /// The body, by its slot.
    pub slot: usize,
    pub is_point: bool,
    pub local: Vec<Node>,
}

/// A value that only rustc can compute, with the shape its place asks for.
pub struct OpaqueValue {
    pub template: Template,
    pub kind: OpaqueKind,
}

/// The kind that an opaque value is taken for.
#[derive(Clone, PartialEq, Debug)]
pub enum OpaqueKind {
    Numbers(Shape),
    Condition,
}

/// Why the body has no graph.
pub enum Failure {
    Mistakes(syn::Error),
    Unreadable(Unreadable),
}

/// An expression that is good Rust, perhaps, but not for this interpreter.
pub struct Unreadable {
    pub span: Span,
    pub what: String,
}

impl Unreadable {
    fn new(at: &dyn ToTokens, what: impl Into<String>) -> Self {
        Unreadable { span: first_span(at), what: what.into() }
    }
}

/// Where an expression begins.
fn first_span(at: &dyn ToTokens) -> Span {
    at.to_token_stream().into_iter().next().map_or_else(Span::call_site, |token| token.span())
}

/// Either a value or the end of reading.
type Read<T = Value> = Result<T, Unreadable>;

/// Beyond this many nodes straight-line code is no longer a good idea: rustc needs seconds and a
/// deep stack for it.
const MOST_NODES: usize = 4_000;
/// Loops are unrolled up to this many turns.
const MOST_TURNS: i64 = 4_096;
/// Functions of the body's own call each other this deep.
const MOST_CALLS: usize = 48;
/// Expressions are read this often, counting each turn of a loop.
const MOST_EXPRESSIONS: usize = 1_000_000;
/// Of how many parts an expression may be that only rustc understands.
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

/// Reads an expression over the arguments of `source`, a number: the value of an attribute. The
/// items at the beginning of the body are in sight.
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

/// Reads the body of a law: a function of the first argument, a number.
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

/// Reads with constants folded as f64 does, for kernels, and once more with those as they are
/// written, if that is another equation.
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
    /// The frames that are being read and can be left, outermost first.
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
    /// Rotation matrices, each with the Euler parameters that it is made of.
    rotations: HashMap<Vec<Node>, Vec<Node>>,
    attachments: Vec<Attachment>,
    repeated_items: Vec<syn::Item>,
    /// Types that the body declares.
    own: own::Own,
    /// Of a text, variables without `mut`, by their slots.
    fixed: HashMap<Slot, String>,
    second_reader: SecondReader,
    /// The lengths that the attribute gives to constants.
    lengths: Vec<(Ident, syn::LitInt)>,
    /// Types of parameters that only rustc knows.
    parameter_types: HashMap<String, syn::Type>,
    /// Parameters that are integers or conditions, with their types.
    no_numbers: HashMap<String, String>,
    /// The facts that are known where something is read: conditions of the branches around it.
    path: Vec<Guard>,
    /// The type that the function itself returns.
    output: Option<syn::Type>,
    /// Number of the scope of the function's own block.
    body_depth: usize,
    /// How deep in calls of the body's own functions.
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

    /// The value of the function's body.
    fn function_body(&mut self, body: &syn::Block, output: &syn::Type) -> Read {
        self.body_depth = self.scopes.depth() + 1;
        self.output = Some(output.clone());
        let value = self.body(body)?;
        match self.loaded(value) {
            value @ Value::Generator(_) => self.typed(value, output, body),
            Value::Never => Err(Unreadable::new(body, "a body without a value")),
            value => Ok(value),
        }
    }

    /// All that was read. A mistake is worth more than the remark that something else cannot be
    /// read.
    fn finish(mut self, rows: Result<Vec<Row>, Failure>) -> Result<Lowered, Failure> {
        self.mistakes.finish().map_err(Failure::Mistakes)?;
        if self.opaques.is_empty() && self.leaves.is_empty() && self.laws.is_empty() {
            // Nothing that is left to rustc can speak of them.
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

    /// Notes a mistake at `tokens`; reading goes on without its value.
    fn mistake(&mut self, tokens: &dyn ToTokens, message: impl std::fmt::Display) -> Value {
        self.mistakes.add(tokens, message);
        Value::Poison
    }
}

/// "`vec2` takes 2 numbers, not 1"
fn counted(what: &str, takes: usize, of: &str, given: usize) -> String {
    format!("{what} takes {takes} {of}{}, not {given}", if takes == 1 { "" } else { "s" })
}
