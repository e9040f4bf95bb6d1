//! The fourth room: what the rules in the table of methods compute over the graph, and
//! constructors. The table is `walk/table.rs`, because some rules apply functions.

pub mod components;
pub mod constructors;
pub mod lists;
pub mod numbers;

use quote::ToTokens;
use syn::{Expr, ExprMethodCall};

use super::values::{Read, Value, Values};
use crate::error::{Unreadable, counted};
use kin_graph::Node;

/// A method call: its name, the values of its arguments, and their expressions for messages.
pub struct Call<'a> {
    pub name: String,
    pub arguments: Vec<Value>,
    pub places: Vec<&'a Expr>,
    pub whole: &'a ExprMethodCall,
}

impl ToTokens for Call<'_> {
    fn to_tokens(&self, tokens: &mut proc_macro2::TokenStream) {
        self.whole.to_tokens(tokens);
    }
}

impl Call<'_> {
    /// Returns the remark on a call that the interpreter cannot read.
    pub fn unreadable(&self, what: impl Into<String>) -> Unreadable {
        Unreadable::new(&self.whole.method, what)
    }

    pub fn not_of_a_list(&self) -> Unreadable {
        self.unreadable(format!("`{}` of an array or iterator", self.name))
    }

    /// Returns an error unless there are `count` arguments.
    pub fn takes(&self, count: usize) -> Read<()> {
        let fits = self.arguments.len() == count;
        fits.then_some(()).ok_or_else(|| self.unreadable("this method"))
    }
}

impl Values {
    pub fn unknown(&mut self, call: &Call, receiver: &str, cure: &str) -> Value {
        self.mistake(&call.whole.method, format!("{receiver} has no method `{}`{cure}", call.name))
    }

    /// Returns true if there are `count` arguments, else reports a mistake.
    pub fn counted(&mut self, count: usize, call: &Call) -> bool {
        let found = call.arguments.len();
        if found != count {
            let text = counted(&format!("`{}`", call.name), count, "argument", found);
            self.mistake(&call.whole.method, text);
        }
        found == count
    }

    /// Returns the arguments as numbers, if there are `count` of them.
    pub fn scalars_of(&mut self, count: usize, call: &Call) -> Option<Vec<Node>> {
        if !self.counted(count, call) {
            return None;
        }
        Some(
            call.arguments
                .iter()
                .zip(&call.places)
                .map(|(value, place)| self.scalar(value.clone(), place))
                .collect(),
        )
    }
}
