//! Reads a text to a graph with every derivative, and to the other properties of a constraint.

use kin::emitted::graph::Table;
use kin::extend::{Dependence, Entry, Measured};
use kin_graph::Node;
use kin_graph::differentiate::Derivatives;
use kin_language::formula::{Outside, Written, local_column, parameter_name};
use kin_language::lower::{Attachment, Lowered};
use kin_language::parse::{self, Argument, ConstraintFn, Demand, Kind, Role, SecondReader};
use kin_language::{constants, limits, lower};
use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;
use syn::{Attribute, Expr, File, Item, ItemFn, Stmt};

use crate::mistake::Mistakes;
use crate::names::interned;
use crate::plain;
use crate::signature::Signature;
use crate::stage::Stage;
use crate::unknown::understood;

/// An equation that Kin has read, for constraints on any bodies.
pub struct Read {
    pub text: String,
    pub name: String,
    pub description: String,
    pub signature: Signature,
    pub is_driver: bool,
    /// The rows; each lives as long as the program.
    pub rows: Vec<&'static str>,
    pub pattern: Vec<Entry>,
    pub constants: Vec<Option<f64>>,
    pub dependence: Dependence,
    /// Slots whose sine or cosine is read.
    pub trig: Vec<usize>,
    /// C, then C_q.
    pub values: Stage,
    pub residual: Stage,
    pub velocity: Stage,
    pub acceleration: Stage,
    /// Each law that the equation evaluates, with its argument.
    pub asked: Stage,
    pub asked_laws: Vec<usize>,
    /// The components of the points and directions, and what they are.
    pub local: Stage,
    pub attachments: Vec<Attachment>,
    pub formula: Asked,
    pub measures: Vec<Measured>,
    pub measured: Vec<(Asked, Option<[Asked; 2]>)>,
    pub requirements: Vec<(Condition, String)>,
    pub branches: Vec<(Condition, String)>,
}

/// A condition of an attribute.
pub enum Condition {
    /// The condition is true if this number is not zero.
    NotZero(Asked),
    /// The law of that number repeats after this period.
    Periodic(usize, Asked),
    /// The law of that number is smooth.
    Smooth(usize),
}

/// Something that is read as a formula, with the places of the numbers and laws that it asks for.
pub struct Asked {
    pub table: Table,
    pub numbers: Vec<usize>,
    pub laws: Vec<usize>,
}

/// Longer texts are refused.
const LONGEST: usize = 1 << 16;
/// The stack of the thread that reads: what limits let through takes less.
const STACK: usize = 64 << 20;

/// Reads the equation from a text.
pub fn read(text: &str) -> Result<Read, Mistakes> {
    Ok(Read { text: text.to_owned(), ..read_with(text, of_item)? })
}

/// Reads a text by `of_item`, which receives the function of the text.
///
/// Kin reads in a separate thread, which frees the memory of the tokens when it ends.
pub fn read_with<T: Send>(
    text: &str,
    of_item: impl Fn((TokenStream, ItemFn, Role)) -> syn::Result<T> + Sync,
) -> Result<T, Mistakes> {
    if text.len() > LONGEST {
        return Err(Mistakes::whole(format!(
            "the text has {} bytes, but Kin reads at most {LONGEST}",
            text.len()
        )));
    }
    let work = || item(text).and_then(&of_item).map_err(|error| Mistakes::of(error, text));
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        thread.map_or_else(|_| work(), |thread| thread.join().unwrap_or_else(|_| Err(lost())))
    })
}

fn lost() -> Mistakes {
    Mistakes::whole("Kin cannot read the text")
}

/// The function of a text and what its `#[constraint(…)]` or `#[force(…)]` says, with what stands
/// beside it put into its body: functions and constants that it calls.
fn item(text: &str) -> syn::Result<(TokenStream, ItemFn, Role)> {
    let tokens: TokenStream = text
        .parse()
        .map_err(|error: proc_macro2::LexError| syn::Error::new(error.span(), NO_TOKENS))?;
    limits::check(&tokens)?;
    let file: File = syn::parse2(tokens).map_err(|error| match error.to_string().as_str() {
        // A word that begins no item reads like the call of a macro.
        "expected `!`" => syn::Error::new(
            error.span(),
            "write a function, such as `fn slot(i: Planar, k: f64) -> f64 { … }`",
        ),
        _ => error,
    })?;
    let mut found: Vec<ItemFn> = Vec::new();
    let mut beside: Vec<Item> = Vec::new();
    for item in file.items {
        match item {
            // The entry of a program, where a whole file of it is read.
            Item::Fn(function)
                if function.sig.ident == "main" && function.sig.inputs.is_empty() => {}
            Item::Fn(function) => found.push(function),
            Item::Use(_) => {}
            Item::Struct(mut other) if other.attrs.iter().any(is_mark) => {
                other.attrs.clear();
                let first = other.to_token_stream().into_iter().next();
                let at = first.map_or_else(Span::call_site, |token| token.span());
                return Err(syn::Error::new(at, "write this attribute above a function"));
            }
            other => beside.push(other),
        }
    }
    let marked = found.iter().position(|function| function.attrs.iter().any(is_mark));
    let Some(which) = marked.or(found.len().checked_sub(1)) else {
        return Err(syn::Error::new(Span::call_site(), NO_FUNCTION));
    };
    let mut function = found.remove(which);
    let (marks, others) = function.attrs.into_iter().partition(is_mark);
    function.attrs = others;
    let marks: Vec<Attribute> = marks;
    let said = marks
        .first()
        .and_then(|mark| mark.meta.require_list().ok().map(|list| list.tokens.clone()));
    found.iter_mut().for_each(plain::make);
    plain::make_inside(&mut function);
    let beside: Vec<Item> = found.into_iter().map(Item::Fn).chain(beside).collect();
    let body = std::mem::take(&mut function.block.stmts);
    function.block.stmts = beside.iter().cloned().map(Stmt::Item).chain(body).collect();
    constants::put(&mut function, &beside);
    let is_force = marks.first().is_some_and(|mark| is_called(mark, "force"));
    let role = if is_force { Role::Force } else { Role::Equation };
    Ok((said.unwrap_or_default(), function, role))
}

const NO_TOKENS: &str =
    "the text is not Rust: a bracket or quote is not closed, or a character has no meaning";
const NO_FUNCTION: &str = "write the equation as a function, `fn name(i: Planar, …) -> f64 { … }`";

fn is_mark(attribute: &Attribute) -> bool {
    ["constraint", "law", "force"].iter().any(|name| is_called(attribute, name))
}

fn is_called(attribute: &Attribute, name: &str) -> bool {
    attribute.path().segments.last().is_some_and(|last| last.ident == name)
}

fn of_item((said, item, role): (TokenStream, ItemFn, Role)) -> syn::Result<Read> {
    let mut source = parse::constraint(said, item.to_token_stream())?;
    (source.role, source.second_reader) = (role, SecondReader::Nobody);
    let source = parse::in_role(source, role)?;
    let signature = Signature::of(&source.arguments)?;
    let mut lowered = understood(lower::constraint(&source))?;
    let rows: Vec<Node> = lowered.rows.iter().map(|row| row.node).collect();
    let local = |column| local_column(&source.arguments, column);
    let derived = Derivatives::new(&mut lowered.graph, &rows, local);
    let promises = derived.promises(&lowered.graph);
    let places =
        || Places { signature: &signature, name: &source.name, arguments: &source.arguments };
    let attributes = Attributes { places: places(), source: &source };
    let places = places();
    let formula = places.asked(&lowered)?;
    let stage = |nodes: &[Node]| places.stage(&lowered, nodes);
    let values: Vec<Node> =
        derived.rows.iter().copied().chain(derived.jacobian.iter().map(|entry| entry.2)).collect();
    let laws = lowered.laws_asked();
    let points: Vec<Node> =
        lowered.attachments.iter().flat_map(|one| one.local.iter().copied()).collect();
    let too_many = |text: String| syn::Error::new(source.name.span(), text);
    let row_names = lowered.rows.iter().map(|row| interned(&row.name).map_err(too_many));
    let read = Read {
        text: String::new(),
        name: syn::ext::IdentExt::unraw(&source.name).to_string(),
        description: kin_language::parse::description(&source.attributes),
        is_driver: source.arguments.iter().any(|argument| argument.kind == Kind::Time),
        rows: row_names.collect::<syn::Result<_>>()?,
        pattern: derived
            .jacobian
            .iter()
            .map(|(row, column, _)| Entry::new(*row, *column))
            .collect(),
        dependence: Dependence {
            c_on_t: promises.c_on_t,
            c_q_on_t: promises.c_q_on_t,
            c_t: promises.c_t,
            q_d: promises.q_d,
            curved: promises.curved,
        },
        constants: promises.constants,
        trig: derived.trig(&lowered.graph),
        values: stage(&values)?,
        residual: stage(&derived.rows)?,
        velocity: stage(&derived.velocity_rhs)?,
        acceleration: stage(&derived.acceleration_rhs)?,
        asked: stage(&laws.iter().map(|(_, x)| *x).collect::<Vec<Node>>())?,
        asked_laws: laws
            .iter()
            .map(|(law, _)| places.law(&lowered, *law))
            .collect::<syn::Result<_>>()?,
        local: stage(&points)?,
        formula,
        measures: attributes.measures()?,
        measured: attributes.measured()?,
        requirements: attributes.demands(&source.requirements)?,
        branches: attributes.demands(&source.branches)?,
        attachments: lowered.attachments,
        signature: signature.clone(),
    };
    Ok(read)
}

/// The places that names of parameters have in the signature of a function.
pub struct Places<'a> {
    pub signature: &'a Signature,
    pub name: &'a Ident,
    pub arguments: &'a [Argument],
}

impl Places<'_> {
    fn number(&self, lowered: &Lowered, k: usize) -> syn::Result<usize> {
        let name = parameter_name(&lowered.parameters[k], self.arguments);
        self.signature.number(&name).ok_or_else(|| self.unknown(&name))
    }

    fn law(&self, lowered: &Lowered, k: usize) -> syn::Result<usize> {
        let name = lowered.laws[k].key().replace(' ', "");
        let name = name.trim_start_matches("self.").trim_start_matches("r#");
        self.signature.law(name).ok_or_else(|| self.unknown(name))
    }

    fn unknown(&self, name: &str) -> syn::Error {
        syn::Error::new(
            self.name.span(),
            format!("`{name}` is not a number or law of the signature"),
        )
    }

    fn stage(&self, lowered: &Lowered, nodes: &[Node]) -> syn::Result<Stage> {
        let numbers = (0..lowered.parameters.len()).map(|k| self.number(lowered, k));
        let numbers = numbers.collect::<syn::Result<Vec<usize>>>()?;
        let laws = (0..lowered.laws.len())
            .map(|k| self.law(lowered, k))
            .collect::<syn::Result<Vec<usize>>>()?;
        Ok(Stage::of(&lowered.graph, nodes, |k| numbers[k], |k| laws[k]))
    }

    /// Returns the formula of a function that Kin has read.
    pub fn asked(&self, folded: &Lowered) -> syn::Result<Asked> {
        let written = Written::of(self.arguments, folded);
        let lowered = written.lowered;
        let numbers = written.parameters.iter().map(|&k| self.number(lowered, k));
        let laws = written.outside.iter().map(|outside| match outside {
            Outside::Law(k) => self.law(lowered, *k),
            Outside::Opaque(_) | Outside::Leaf(_) => Err(self.unknown(&self.name.to_string())),
        });
        let numbers = numbers.collect::<syn::Result<_>>()?;
        let laws = laws.collect::<syn::Result<_>>()?;
        Ok(Asked { numbers, laws, table: Table::read(written.formula) })
    }
}

/// The attributes of a constraint.
struct Attributes<'a> {
    places: Places<'a>,
    source: &'a ConstraintFn,
}

impl Attributes<'_> {
    /// An expression of an attribute.
    fn value(&self, expression: &Expr) -> syn::Result<Asked> {
        self.places.asked(&understood(lower::value(self.source, &constants::put_into(expression)))?)
    }

    fn demands(&self, all: &[Demand]) -> syn::Result<Vec<(Condition, String)>> {
        all.iter()
            .map(|demand| Ok((self.condition(&demand.condition)?, demand.text.clone())))
            .collect()
    }

    fn condition(&self, condition: &Expr) -> syn::Result<Condition> {
        if let Expr::MethodCall(call) = condition
            && let Some(law) =
                self.places.signature.law(&call.receiver.to_token_stream().to_string())
        {
            match (call.method.to_string().as_str(), call.args.len()) {
                ("is_periodic", 1) => {
                    return Ok(Condition::Periodic(law, self.value(&call.args[0])?));
                }
                ("is_smooth", 0) => return Ok(Condition::Smooth(law)),
                _ => {}
            }
        }
        let holds = syn::parse_quote!(if #condition { 1.0 } else { 0.0 });
        Ok(Condition::NotZero(self.value(&holds)?))
    }

    fn measures(&self) -> syn::Result<Vec<Measured>> {
        let measures = self.source.measures.iter().map(|measure| {
            let interned = |text: &str| {
                interned(text).map_err(|why| syn::Error::new(measure.name.span(), why))
            };
            let name = syn::ext::IdentExt::unraw(&measure.name).to_string();
            Ok(Measured {
                name: interned(&name)?,
                unit: interned(&measure.unit)?,
                turns: measure.turns,
            })
        });
        measures.collect()
    }

    fn measured(&self) -> syn::Result<Vec<(Asked, Option<[Asked; 2]>)>> {
        let measures = self.source.measures.iter().map(|measure| {
            let ends = match &measure.ends {
                Some((from, to)) => Some([self.value(from)?, self.value(to)?]),
                None => None,
            };
            Ok((self.value(&measure.value)?, ends))
        });
        measures.collect()
    }
}
