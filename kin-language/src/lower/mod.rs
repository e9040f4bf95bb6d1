//! Second stage: reads the body by abstract interpretation over typed values. Each expression
//! becomes a `Value` over the scalar graph. An expression that the interpreter cannot read is
//! [`Unreadable`] and sends the whole constraint to the dual route. The interpreter collects a
//! mistake and continues.

pub mod alone;
mod methods;
mod opaque;
mod rows;
mod scope;
mod values;
mod walk;

use proc_macro2::{Ident, TokenStream};

pub use crate::error::Unreadable;
use crate::parse::{Argument, ConstraintFn, SecondReader};
use kin_graph::{Graph, Input, Node, Op};

pub use opaque::{Expression, Expressions, OpaqueKind, OpaqueValue, Template};
pub use rows::{Row, names_as_written};

pub use values::{Attachment, component_paths};
use values::{Read, Value};
use walk::Reader;

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

/// The reason why the body has no graph.
pub enum Failure {
    Mistakes(syn::Error),
    Unreadable(Unreadable),
}
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
        reader.signature.second_reader = second_reader;
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

impl Reader {
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
        let values = self.values;
        values.mistakes.finish().map_err(Failure::Mistakes)?;
        if values.parts.is_empty() {
            // Only the code for opaque values, leaves and laws can use these items.
            self.repeated_items.clear();
        }
        Ok(Lowered {
            rows: rows?,
            graph: values.graph,
            parameters: values.signature.parameters,
            opaques: values.parts.opaques,
            laws: values.parts.laws,
            leaves: values.parts.leaves,
            expressions: values.expressions,
            attachments: values.attachments,
            items: self.repeated_items,
            as_written: None,
        })
    }
}
