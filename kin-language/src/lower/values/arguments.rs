//! The arguments of a signature as values: states, laws, and the numbers of parameters.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};

use super::{Template, Value, Values};
use crate::parse::{Argument, ConstraintFn, Kind, Shape, literal_length};
use crate::vocabulary::is_integer;
use kin_graph::{Input, Node};

impl Values {
    /// Binds the arguments of a constraint, and the lengths in its signature.
    pub fn declare_signature(&mut self, source: &ConstraintFn) {
        self.signature.second_reader = source.second_reader;
        self.signature.lengths.clone_from(&source.lengths);
        self.declare_arguments(&source.arguments);
        for (name, length) in &source.lengths {
            let value = Value::count(length.base10_parse().unwrap_or_default());
            self.scopes.declare_item(name.to_string(), value);
        }
    }

    /// Binds the arguments of the signature; states are numbered in its order, a `[Coord; N]`
    /// counting N.
    pub fn declare_arguments(&mut self, arguments: &[Argument]) {
        let mut slot = 0;
        for argument in arguments {
            let name = &argument.name;
            let value = match &argument.kind {
                Kind::Planar => Value::Planar(slot),
                Kind::Spatial => Value::Spatial(slot),
                Kind::Coord => self.coordinate(slot),
                Kind::Planars(n) => {
                    Value::Array((0..*n).map(|k| Value::Planar(slot + k)).collect())
                }
                Kind::Spatials(n) => {
                    Value::Array((0..*n).map(|k| Value::Spatial(slot + k)).collect())
                }
                Kind::Coords(n) => {
                    Value::Array((0..*n).map(|k| self.coordinate(slot + k)).collect())
                }
                Kind::Time => Value::Scalar(self.graph.input(Input::Time)),
                Kind::Law => Value::Law(Template::Parameter(name.clone())),
                Kind::Axis => self.axis(name),
                Kind::Numbers(shape) => self.parameter(&quote!(self.#name), shape),
                Kind::Other => {
                    self.signature.parameter_types.insert(name.to_string(), argument.ty.clone());
                    let ty = argument.ty.to_token_stream().to_string();
                    if ty == "bool" || is_integer(&ty) {
                        self.signature.no_numbers.insert(name.to_string(), ty);
                    }
                    Value::Opaque(Template::Parameter(name.clone()))
                }
            };
            self.declare_bound(name, argument.mutable, value);
            slot += argument.kind.slots();
        }
    }

    /// The unit vectors of an axis.
    pub fn axis(&mut self, name: &Ident) -> Value {
        let fields = [quote!(h), quote!(f), quote!(g)];
        Value::Axis(fields.map(|field| {
            match self.parameter(&quote!(self.#name.#field), &Shape::Vector(3)) {
                Value::Vector(v) => v,
                _ => vec![],
            }
        }))
    }

    /// Makes the value of a numeric parameter, with one input for each number, at `path` in emitted
    /// code.
    pub fn parameter(&mut self, path: &TokenStream, shape: &Shape) -> Value {
        let paths = component_paths(path, shape);
        let nodes: Vec<Node> = paths
            .into_iter()
            .map(|path| {
                self.signature.parameters.push(path);
                self.graph.input(Input::Parameter(self.signature.parameters.len() - 1))
            })
            .collect();
        Value::from_numbers(shape, &mut nodes.into_iter()).unwrap_or(Value::Poison)
    }

    /// Returns the elements of a parameter whose type is an array of integers or conditions; the
    /// type gives their number.
    pub fn integers_of(&self, template: &Template) -> Option<Vec<Value>> {
        let Template::Parameter(name) = template else { return None };
        let syn::Type::Array(array) = self.signature.parameter_types.get(&name.to_string())? else {
            return None;
        };
        let element = array.elem.to_token_stream().to_string();
        let n = literal_length(&array.len).filter(|_| element == "bool" || is_integer(&element))?;
        let at = |k: usize| {
            let k = Template::Tokens(proc_macro2::Literal::usize_unsuffixed(k).to_token_stream());
            Value::Opaque(Template::Index(Box::new(template.clone()), Box::new(k)))
        };
        Some((0..n).map(at).collect())
    }

    /// Returns true if a value is a parameter of the type `Option`.
    pub fn is_option(&self, template: &Template) -> bool {
        let Template::Parameter(name) = template else { return false };
        let named = |ty: &syn::Type| matches!(ty, syn::Type::Path(path) if path.path.segments.last().is_some_and(|last| last.ident == "Option"));
        self.signature.parameter_types.get(&name.to_string()).is_some_and(named)
    }
}

/// Returns the expressions by which emitted code reads each number of a value at `path`.
pub fn component_paths(path: &TokenStream, shape: &Shape) -> Vec<TokenStream> {
    let fields = |names: &[&str]| -> Vec<TokenStream> {
        names
            .iter()
            .map(|name| Ident::new(name, Span::call_site()))
            .map(|name| quote!(#path.#name))
            .collect()
    };
    match shape {
        Shape::Scalar => vec![path.clone()],
        Shape::Vector(2) => fields(&["x", "y"]),
        Shape::Vector(_) => fields(&["x", "y", "z"]),
        Shape::Euler => fields(&["e0", "e1", "e2", "e3"]),
        Shape::Matrix(2) => fields(&["m11", "m12", "m21", "m22"]),
        Shape::Matrix(_) => {
            fields(&["m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"])
        }
        Shape::Array(inner, n) => {
            indexed(*n).flat_map(|k| component_paths(&quote!(#path[#k]), inner)).collect()
        }
        Shape::Tuple(all) => indexed(all.len())
            .zip(all)
            .flat_map(|(k, s)| component_paths(&quote!(#path.#k), s))
            .collect(),
        Shape::Any => vec![],
    }
}

fn indexed(n: usize) -> impl Iterator<Item = proc_macro2::Literal> {
    (0..n).map(proc_macro2::Literal::usize_unsuffixed)
}
