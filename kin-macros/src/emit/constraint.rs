//! The emitted constraint: a struct of the function's name, its constructor, `impl Constraint` and
//! `impl Equation`.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{quote, quote_spanned};

use super::functions::Parts;
use super::kernel::Kernel;
use super::route::DualReason;
use super::{
    attachments, blame, demands, described, editor, facts, functions, measures, rewrite, template,
    unlinted, written,
};
use kin_graph::Node;
use kin_graph::differentiate::Derivatives;
use kin_language::formula::local_column;
use kin_language::lower::{Lowered, names_as_written};
use kin_language::parse::{Argument, ConstraintFn, Kind, Role};

/// The parts of the source that both routes need.
struct Frame<'a> {
    source: &'a ConstraintFn,
    n: usize,
    row_names: Vec<String>,
    pattern: Vec<(usize, usize)>,
    /// The equation over dual numbers: what computes it, and its rows.
    dual: Dual,
    /// Slots whose sine or cosine is read.
    trig: Vec<usize>,
}

/// The equation over dual numbers.
enum Dual {
    /// The user's body.
    Body(syn::Block),
    /// Out of the graph: the code before the rows, and these.
    Graph(TokenStream, Vec<TokenStream>),
}

/// The constraint on the symbolic route.
pub fn symbolic(source: &ConstraintFn, mut lowered: Lowered) -> TokenStream {
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let local = |column| local_column(&source.arguments, column);
    let derived = Derivatives::new(&mut lowered.graph, &rows, local);
    let row_names = lowered.rows.iter().map(|row| row.name.clone()).collect();
    let pattern = derived.jacobian.iter().map(|(row, column, _)| (*row, *column)).collect();
    let trig = derived.trig(&lowered.graph);
    let parts = functions::symbolic(&source.arguments, &mut lowered, &derived);
    let dual = if rewrite::is_sure(&source.body, &source.arguments) {
        Dual::Body(rewrite::dual(&source.body, &source.arguments))
    } else {
        let (code, rows) = Kernel::over_duals(&lowered, &source.arguments).values(&rows);
        Dual::Graph(code.tokens, rows)
    };
    let frame = Frame { trig, ..Frame::new(source, dual, row_names, pattern) };
    let written = &parts.written;
    let attachments = attachments::symbolic(&source.arguments, &lowered);
    let leaves: Vec<TokenStream> = lowered
        .leaves
        .iter()
        .enumerate()
        .map(|(k, leaf)| template::leaf_function(&lowered.graph, k, leaf, &lowered.items))
        .collect();
    frame.emit(&Parts { written: quote!(#written #attachments), ..parts }, &leaves, Some(&lowered))
}

/// The constraint on the dual route.
pub fn dual(source: &ConstraintFn, reason: &DualReason) -> TokenStream {
    let row_names = names_as_written(source);
    let n = super::columns(&source.arguments);
    let pattern =
        (0..row_names.len()).flat_map(|row| (0..n).map(move |column| (row, column))).collect();
    let (body, expressions) = rewrite::traced(&source.body, &source.arguments);
    let attachments = attachments::dual(source);
    let blame = blame::dual(&expressions.all);
    let explained = reason.explained();
    let warning = reason.warning(&source.name, source.warn_dual);
    let parts = Parts {
        facts: quote!(reason: #explained,),
        formulas: functions::dual(),
        written: quote!(#attachments #blame),
    };
    let constraint =
        Frame::new(source, Dual::Body(body), row_names, pattern).emit(&parts, &[], None);
    quote!(#constraint #warning)
}

impl<'a> Frame<'a> {
    fn new(
        source: &'a ConstraintFn,
        dual: Dual,
        row_names: Vec<String>,
        pattern: Vec<(usize, usize)>,
    ) -> Self {
        Frame {
            source,
            n: super::columns(&source.arguments),
            row_names,
            pattern,
            dual,
            trig: vec![],
        }
    }

    fn emit(
        &self,
        parts: &Parts,
        leaves: &[TokenStream],
        lowered: Option<&Lowered>,
    ) -> TokenStream {
        let source = self.source;
        let name = &source.name;
        let n = literal(self.n);
        let m = literal(self.row_names.len());
        let declaration = declaration(source);
        let equations = self.equations();
        let body = rewrite::plain(source.written(), &source.arguments);
        let used = demands::mentioned(source);
        let inputs = written::inputs(&source.arguments);
        let output = &source.output_type;
        let attributes = &source.attributes[..];
        let copy = written::Copy { inputs: &inputs, output, body: &body, used: &used, attributes };
        let written = written::written(name, &copy, &measures::written(source), lowered);
        let unlinted = unlinted();
        let edited = editor::constraint(source, &body);
        let leaves =
            if leaves.is_empty() { quote!() } else { quote!(#unlinted impl #name { #(#leaves)* }) };
        let kind = syn::ext::IdentExt::unraw(name).to_string();
        let kinds = source.arguments.iter().flat_map(super::kinds);
        let as_data = described::described(source, &kind, &n, &m);
        let constraint = self.constraint(&kind, parts, lowered);
        let lengths = lengths(source);
        quote! {
            #edited
            #declaration
            ::kin::emitted::outside_editor! { const _: () = {
                #lengths
                #written
                #leaves
                #constraint
                #as_data
                #unlinted
                impl ::kin::emitted::Equation<#n, #m> for #name {
                    const ARGUMENTS: &'static [::kin::emitted::ArgumentKind] = &[#(#kinds),*];
                    #equations
                }
            }; }
        }
    }

    /// `impl Constraint`, `impl Parameters` and `impl Written`.
    fn constraint(&self, kind: &str, parts: &Parts, lowered: Option<&Lowered>) -> TokenStream {
        let source = self.source;
        let unlinted = unlinted();
        let name = &source.name;
        let facts = facts::facts(source, kind, (&self.row_names, &self.pattern), &parts.facts);
        let arguments = self.arguments();
        let describe = described::describe(source, lowered);
        let (visit, set) = super::parameter_methods(&source.arguments);
        let take = described::take(source);
        let ends = measures::ends(source);
        let measure = measures::measure(source);
        let refusal = demands::refusal(source);
        let branch = demands::branch(source);
        let laws =
            lowered.map(|lowered| functions::laws(&source.arguments, lowered)).unwrap_or_default();
        let formulas = &parts.formulas;
        let written = &parts.written;
        quote! {
            #unlinted
            impl ::kin::Constraint for #name {
                fn facts(&self) -> ::kin::emitted::Facts<'_> {
                    const FACTS: ::kin::emitted::Facts<'static> = #facts;
                    FACTS
                }
                fn arguments(&self) -> ::std::vec::Vec<::kin::emitted::Argument> {
                    #arguments
                }
                #formulas
                #measure
                #branch
                fn parts(&self) -> ::kin::emitted::Parts<'_> {
                    ::kin::emitted::Parts {
                        parameters: ::core::option::Option::Some(self),
                        written: ::core::option::Option::Some(self),
                    }
                }
                fn parameters_mut(&mut self) -> ::core::option::Option<&mut dyn ::kin::emitted::Parameters> {
                    ::core::option::Option::Some(self)
                }
            }
            #unlinted
            impl ::kin::emitted::Parameters for #name {
                #visit
                #set
                #ends
                #refusal
                #take
                #describe
            }
            #unlinted
            impl ::kin::emitted::Written for #name {
                #laws
                #written
            }
        }
    }

    /// The arguments with their names, for messages and for the solver.
    fn arguments(&self) -> TokenStream {
        let mut slot = 0;
        let mut all = Vec::new();
        for argument in &self.source.arguments {
            let name = &argument.name;
            let text = syn::ext::IdentExt::unraw(name).to_string();
            let trig = self.trig(slot);
            slot += argument.kind.slots();
            let target = match argument.kind {
                Kind::Planar => quote!(::kin::emitted::Target::Planar(self.#name)),
                Kind::Spatial => quote!(::kin::emitted::Target::Spatial(self.#name)),
                Kind::Coord => quote!(::kin::emitted::Target::Coord(self.#name, #trig)),
                Kind::Coords(n) | Kind::Planars(n) | Kind::Spatials(n) => {
                    for k in 0..n {
                        let trig = self.trig(slot - n + k);
                        let k = literal(k);
                        let target = match argument.kind {
                            Kind::Planars(_) => quote!(Planar(self.#name[#k])),
                            Kind::Spatials(_) => quote!(Spatial(self.#name[#k])),
                            _ => quote!(Coord(self.#name[#k], #trig)),
                        };
                        all.push(
                            quote!(::kin::emitted::Argument { name: #text, target: ::kin::emitted::Target::#target }),
                        );
                    }
                    continue;
                }
                _ => continue,
            };
            all.push(quote!(::kin::emitted::Argument { name: #text, target: #target }));
        }
        quote!(::kin::emitted::arguments(&[#(#all),*]))
    }

    fn trig(&self, slot: usize) -> TokenStream {
        if self.trig.contains(&slot) {
            quote!(::kin::emitted::Trig::Used)
        } else {
            quote!(::kin::emitted::Trig::Unused)
        }
    }

    /// The user's body with dual numbers, and as it was written. The names that are not the user's
    /// are hygienic: an argument may be called `q`.
    fn equations(&self) -> TokenStream {
        let source = self.source;
        let n = literal(self.n);
        let m = literal(self.row_names.len());
        let q = super::own("q");
        let t = super::own("t");
        let value = super::own("value");
        let states = states(&source.arguments, &q, &t);
        let parameters = super::dual_bindings(&source.arguments);
        let ty = rewrite::lifted_type(&source.output_type);
        let prepared = quote!(#(#states)* #(#parameters)*);
        let measure = measures::evaluation(source, &n, [&q, &t], &prepared);
        let evaluation = written::silent(match &self.dual {
            Dual::Body(body) => quote! {
                #prepared
                let #value = (move || -> #ty #body)();
            },
            Dual::Graph(code, rows) => quote! {
                #(#states)*
                #code
                let #value: [::kin::emitted::Real<__D>; #m] = [#(#rows),*];
            },
        });
        let inputs = written_inputs(&source.arguments, &q, &t);
        quote! {
            fn evaluate<__D: ::kin::emitted::Dual>(&self, #q: &[::kin::emitted::Real<__D>; #n], #t: ::kin::emitted::Real<__D>) -> [::kin::emitted::Real<__D>; #m] {
                #evaluation
                ::kin::emitted::rows(#value)
            }
            #[inline]
            fn plain(&self, #q: &[f64; #n], #t: f64) -> [f64; #m] {
                let mut #q = ::kin::emitted::Columns(#q);
                ::kin::emitted::rows(__WRITTEN(#(#inputs),*))
            }
            #measure
        }
    }
}

/// That constants beside the function are what the attribute says of them.
fn lengths(source: &ConstraintFn) -> TokenStream {
    let checks = source.lengths.iter().map(|(name, length)| {
        let text = format!(
            "`#[constraint({name} = {length})]` is wrong, because `{name}` is not {length}"
        );
        quote_spanned!(name.span()=> const _: () = ::kin::emitted::held(#name == #length, #text);)
    });
    let handles = source
        .arguments
        .iter()
        .filter(|argument| argument.kind == Kind::Other && is_called_link(&argument.ty))
        .map(|argument| own(&argument.ty));
    quote!(#(#checks)* #(#handles)*)
}

fn own(ty: &syn::Type) -> TokenStream {
    let text =
        "write `Planar` or `Spatial`: inside the function the argument is the state of a body";
    let held = quote!(::kin::emitted::held(::kin::emitted::Named::<#ty>::IS_OWN, #text));
    quote_spanned!(syn::spanned::Spanned::span(ty)=> const _: () = { use ::kin::emitted::Own as _; #held };)
}

/// True if a type may be the handle of a body.
fn is_called_link(ty: &syn::Type) -> bool {
    matches!(ty, syn::Type::Path(path) if path.path.segments.last().is_some_and(|last| last.ident == "Link" || last.ident == "SpatialLink"))
}

/// The struct and its constructor.
pub fn declaration(source: &ConstraintFn) -> TokenStream {
    let visibility = &source.visibility;
    let name = &source.name;
    let attributes = &source.attributes;
    let fields: Vec<&Argument> = source.arguments.iter().filter(|a| a.kind.is_field()).collect();
    let names: Vec<_> = fields.iter().map(|a| &a.name).collect();
    let types = fields.iter().map(|a| super::field_type(a));
    let (inputs, values): (Vec<_>, Vec<_>) =
        fields.iter().map(|argument| super::constructor_input(argument)).unzip();
    let silent = fields.iter().map(|argument| super::warned_elsewhere(&argument.name));
    let [bindings, noted] = ["bindings", "noted"].map(super::own);
    let docs = super::documentation(attributes);
    let (mut field, mut value, mut prepared) = Default::default();
    if super::may_hang(fields.iter().copied()) {
        field = quote!(, __bindings: ::kin::emitted::Bindings);
        value = quote!(, __bindings: #noted);
        prepared = quote! {
            let mut #noted = ::kin::emitted::Bindings::NONE;
            let #bindings = &mut #noted;
        };
    }
    let constructor = match source.role {
        Role::Force => super::force::constructor(source, &prepared, &value),
        _ => quote! {
            #(#attributes)*
            #[allow(clippy::too_many_arguments)]
            #[must_use]
            #visibility fn #name(#(#silent #names: #inputs),*) -> #name {
                #prepared
                #name { #(#values),* #value }
            }
        },
    };
    let heading = format!(" The constraint that [`fn@{name}`] makes.");
    quote! {
        #[doc = #heading]
        #[doc = ""]
        #(#docs)*
        #[allow(non_camel_case_types, non_snake_case)]
        #[derive(Clone)]
        #visibility struct #name {
            #(#names: #types),*
            #field
        }

        #constructor
    }
}

/// The user's names for bodies, coordinates and time, bound to states made of the columns `q` and
/// the time `t`.
fn states(arguments: &[Argument], q: &Ident, t: &Ident) -> Vec<TokenStream> {
    let scalar = quote!(::kin::emitted::Real<__D>);
    let bound = arguments.iter().filter_map(|argument| {
        let name = &argument.name;
        let mutable = super::mutable(argument);
        let next = next(argument, q, t)?;
        let ty = match argument.kind {
            Kind::Planar => quote!(::kin::emitted::PlanarState<#scalar>),
            Kind::Spatial => quote!(::kin::emitted::SpatialState<#scalar>),
            Kind::Planars(n) => super::array(&quote!(::kin::emitted::PlanarState<#scalar>), n),
            Kind::Spatials(n) => super::array(&quote!(::kin::emitted::SpatialState<#scalar>), n),
            Kind::Coords(n) => super::array(&scalar, n),
            _ => scalar.clone(),
        };
        Some(quote!(let #mutable #name: #ty = #next;))
    });
    std::iter::once(quote!(let mut #q = ::kin::emitted::Columns(#q);)).chain(bound).collect()
}

/// The value of an argument that is no parameter, made of the columns that are left.
fn next(argument: &Argument, q: &Ident, t: &Ident) -> Option<TokenStream> {
    Some(match argument.kind {
        Kind::Planar => quote!(#q.planar()),
        Kind::Spatial => quote!(#q.spatial()),
        Kind::Coord => quote!(#q.coord()),
        Kind::Coords(_) => quote!(#q.coords()),
        Kind::Planars(_) => quote!(#q.planars()),
        Kind::Spatials(_) => quote!(#q.spatials()),
        Kind::Time => quote!(#t),
        _ => return None,
    })
}

/// The arguments that the function as it was written is called with.
fn written_inputs(arguments: &[Argument], q: &Ident, t: &Ident) -> Vec<TokenStream> {
    let inputs = arguments.iter().map(|argument| {
        let name = &argument.name;
        match argument.kind {
            Kind::Numbers(_) | Kind::Axis => quote!(self.#name),
            Kind::Law | Kind::Other => quote!(::core::clone::Clone::clone(&self.#name)),
            _ => next(argument, q, t).unwrap_or_default(),
        }
    });
    inputs.collect()
}

fn literal(k: usize) -> Literal {
    Literal::usize_unsuffixed(k)
}
