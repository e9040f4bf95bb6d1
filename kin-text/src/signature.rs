//! Stores the signature of an equation without its tokens: bodies, and parameters with their
//! numbers by name.

use kin::extend::dual_route::ArgumentKind;
use kin_language::formula::parameter_name;
use kin_language::lower::component_paths;
use kin_language::parse::{Argument, Kind, Shape};
use proc_macro2::TokenStream;
use quote::quote;

use crate::names::interned;

/// The bodies and coordinates of a function, and its parameters.
#[derive(Clone, Debug)]
pub struct Signature {
    /// Name and kind, a `[Coord; N]` counting N.
    pub slots: Vec<(&'static str, ArgumentKind)>,
    pub parameters: Vec<Parameter>,
    /// The name of every number of the parameters, in order.
    pub numbers: Vec<String>,
}

/// A parameter of the function.
#[derive(Clone, Debug)]
pub struct Parameter {
    pub name: String,
    pub kind: ParameterKind,
}

/// The kind of value of a parameter.
#[derive(Clone, Debug)]
pub enum ParameterKind {
    /// So many numbers from `first` on.
    Numbers {
        shape: Shape,
        first: usize,
    },
    /// Nine numbers from `first` on.
    Axis {
        first: usize,
    },
    Law(usize),
}

impl Signature {
    /// Creates the signature from the arguments of a function.
    ///
    /// Errors: a parameter has a type that only rustc knows; the error is at the type.
    pub fn of(arguments: &[Argument]) -> syn::Result<Self> {
        let mut all = Signature { slots: vec![], parameters: vec![], numbers: vec![] };
        let mut laws = 0;
        for argument in arguments {
            let name = syn::ext::IdentExt::unraw(&argument.name).to_string();
            if argument.kind.slots() > 0 {
                let interned =
                    interned(&name).map_err(|text| syn::Error::new(argument.name.span(), text))?;
                all.slots
                    .extend((0..argument.kind.slots()).map(|_| (interned, slot(&argument.kind))));
                continue;
            }
            let first = all.numbers.len();
            let kind = match &argument.kind {
                Kind::Time => continue,
                Kind::Numbers(shape) => {
                    all.declare(component_paths(&path(argument), shape), arguments);
                    ParameterKind::Numbers { shape: shape.clone(), first }
                }
                Kind::Axis => {
                    let own = path(argument);
                    for field in [quote!(#own.h), quote!(#own.f), quote!(#own.g)] {
                        all.declare(component_paths(&field, &Shape::Vector(3)), arguments);
                    }
                    ParameterKind::Axis { first }
                }
                Kind::Law => {
                    laws += 1;
                    ParameterKind::Law(laws - 1)
                }
                _ => return Err(syn::Error::new_spanned(&argument.ty, UNKNOWN)),
            };
            all.parameters.push(Parameter { name, kind });
        }
        Ok(all)
    }

    fn declare(&mut self, paths: Vec<TokenStream>, arguments: &[Argument]) {
        self.numbers.extend(paths.iter().map(|path| parameter_name(path, arguments)));
    }

    /// Returns the index of the number with this name.
    pub fn number(&self, name: &str) -> Option<usize> {
        self.numbers.iter().position(|known| known == name)
    }

    /// Returns the names of the laws in order.
    pub fn laws(&self) -> impl Iterator<Item = &str> {
        let laws = self
            .parameters
            .iter()
            .filter(|parameter| matches!(parameter.kind, ParameterKind::Law(_)));
        laws.map(|parameter| parameter.name.as_str())
    }

    /// Returns the index of the law with this name.
    pub fn law(&self, name: &str) -> Option<usize> {
        self.parameters.iter().find_map(|parameter| match parameter.kind {
            ParameterKind::Law(k) if parameter.name == name => Some(k),
            _ => None,
        })
    }
}

const UNKNOWN: &str = "write a parameter as an `f64`, a vector, a matrix, an array, a tuple, an `Axis` or a `Law`. Write a body or coordinate as `Planar`, `Spatial` or `Coord`";

fn path(argument: &Argument) -> TokenStream {
    let name = &argument.name;
    quote!(self.#name)
}

fn slot(kind: &Kind) -> ArgumentKind {
    match kind {
        Kind::Planar | Kind::Planars(_) => ArgumentKind::Planar,
        Kind::Spatial | Kind::Spatials(_) => ArgumentKind::Spatial,
        _ => ArgumentKind::Coord,
    }
}
