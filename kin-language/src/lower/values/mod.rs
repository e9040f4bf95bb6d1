//! The third room: the values of the body's expressions, and functions of them over the graph. None
//! of them reads an expression of the body or applies a function of it.

mod algebra;
mod arguments;
mod branches;
mod casts;
mod coerce;
mod declared;
mod fields;
mod function;
pub mod generic;
pub mod integer;
mod join;
mod operators;
mod ordered;
mod patterns;
mod places;
mod rotation;
mod rustc;
mod state;
mod value;

pub use arguments::component_paths;
pub use branches::Branching;
pub use coerce::{is_arithmetic, named};
pub use declared::{Own, takes_itself};
pub use fields::name_at_use;
pub use function::{Closure, Function};
pub use integer::IntegerType;
pub use operators::comparison;
pub use ordered::{is_order, order_named};
pub use patterns::{Blank, binds, is_constant, is_open, names, rest_of};
pub use rustc::{PERHAPS, WIDE};
pub use state::transpose;
pub use value::{Adt, Components, Endless, Value, entry, position};

use std::collections::HashMap;

use proc_macro2::{Ident, TokenStream};
use quote::ToTokens;

pub use super::opaque::Template;
use super::opaque::{Expressions, Parts};
use super::scope;
pub use super::scope::{Name, Place, Step};
use crate::error::Mistakes;
pub use crate::error::{Unreadable, counted, first_span};
use crate::parse::SecondReader;
use kin_graph::{Graph, Node};
use scope::{Frames, Scopes, Slot, Store};

/// The most turns of a loop that the interpreter unrolls.
pub const MOST_TURNS: i64 = 4_096;

/// A value, or the end of the reading.
pub type Read<T = Value> = Result<T, Unreadable>;

/// A local point or direction of a body that depends on no coordinate and not on time.
#[derive(Clone, PartialEq)]
pub struct Attachment {
    /// The slot of the body.
    pub slot: usize,
    pub is_point: bool,
    pub local: Vec<Node>,
}

/// The graph, and all that is known about the values of the body at the present position.
#[derive(Default)]
pub struct Values {
    pub graph: Graph,
    pub scopes: Scopes<Value>,
    pub store: Store<Value>,
    /// The frames around the present position, and the conditions that hold there.
    pub flow: Frames<Value>,
    /// The parts that only rustc can compute.
    pub parts: Parts,
    /// The expressions to which the nodes belong.
    pub expressions: Expressions,
    pub mistakes: Mistakes,
    /// The types that the body declares.
    pub own: Own,
    pub signature: Signature,
    /// Rotation matrices by their entries, each with its Euler parameters.
    pub rotations: HashMap<Vec<Node>, Vec<Node>>,
    pub attachments: Vec<Attachment>,
}

/// The facts about values that the signature gives, and the second reader of the body.
#[derive(Default)]
pub struct Signature {
    pub second_reader: SecondReader,
    /// In a text, the variables without `mut`, by their slots. Empty for a program.
    pub fixed: HashMap<Slot, String>,
    /// The lengths that the attribute gives to constants.
    pub lengths: Vec<(Ident, syn::LitInt)>,
    /// The types of the parameters that only rustc knows, by name.
    pub parameter_types: HashMap<String, syn::Type>,
    /// The types of the parameters that are integers or conditions, by name.
    pub no_numbers: HashMap<String, String>,
    /// The expressions by which emitted code reads each numeric parameter, indexed by the number of
    /// the parameter.
    pub parameters: Vec<TokenStream>,
}

impl Values {
    pub fn new(graph: Graph) -> Self {
        let mut scopes = Scopes::default();
        scopes.push();
        Values { graph, scopes, ..Values::default() }
    }

    /// Adds a mistake at `tokens`; the reading continues with a substitute value.
    pub fn mistake(&mut self, tokens: &dyn ToTokens, message: impl std::fmt::Display) -> Value {
        self.mistakes.add(tokens, message);
        Value::Poison
    }
}

impl AsMut<Values> for Values {
    fn as_mut(&mut self) -> &mut Values {
        self
    }
}
