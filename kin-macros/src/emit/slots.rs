//! State arguments in emitted code: the names of their numbers, and where they are read.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use kin_graph::Part;
use kin_language::parse::{Argument, Kind};

/// One state argument in emitted code.
pub struct Slot {
    name: String,
    kind: Kind,
}

impl Slot {
    pub fn kind(&self) -> &Kind {
        &self.kind
    }

    /// A name for each number of the state, in the order in which a constraint reads them.
    pub fn state_parts(&self) -> Vec<Part> {
        match self.kind {
            Kind::Planar => vec![Part::R(0), Part::R(1), Part::Theta, Part::Sin, Part::Cos],
            Kind::Spatial => {
                let r = (0..3).map(Part::R);
                let p = (0..4).map(Part::P);
                r.chain(p).collect()
            }
            _ => vec![Part::Theta, Part::Sin, Part::Cos],
        }
    }

    /// The coordinates among them.
    pub fn columns(&self) -> Vec<Part> {
        self.state_parts()
            .into_iter()
            .filter(|part| !matches!(part, Part::Sin | Part::Cos))
            .collect()
    }

    pub fn state(&self, part: Part) -> Ident {
        let name = &self.name;
        let bare = !matches!(self.kind, Kind::Planar | Kind::Spatial);
        let text = match part {
            Part::R(k) => format!("{name}_{}", ["x", "y", "z"][k]),
            Part::Theta if bare => name.clone(),
            Part::Theta => format!("{name}_theta"),
            Part::Sin => format!("{name}_sin"),
            Part::Cos => format!("{name}_cos"),
            Part::P(k) => format!("{name}_e{k}"),
        };
        Ident::new(&text, Span::mixed_site())
    }

    pub fn rate(&self, part: Part) -> Ident {
        Ident::new(&format!("{}_d", self.state(part)), Span::mixed_site())
    }
}

/// `let Some([i_x, _, i_theta, ..]) = at.state(0) else { return };`: the numbers of argument `k`'s
/// state, or of its rates, by name.
pub fn binding(
    k: usize,
    of_state: bool,
    names: impl Iterator<Item = Option<Ident>>,
) -> TokenStream {
    let k = Literal::usize_unsuffixed(k);
    let numbers = if of_state { quote!(at.state) } else { quote!(qd.of) };
    super::chunk(names, quote!(#numbers(#k)))
}

/// The state arguments, one a slot, with names that nothing else in emitted code has.
pub fn slots(arguments: &[Argument]) -> Vec<Slot> {
    let plain = |argument: &Argument| argument.name.to_string().trim_start_matches("r#").to_owned();
    let names: Vec<String> = arguments.iter().map(plain).collect();
    let mut slots = Vec::new();
    for (argument, name) in arguments.iter().zip(&names) {
        let extends = |other: &String| {
            name.strip_prefix(other.as_str()).is_some_and(|rest| rest.starts_with('_'))
        };
        let base = if is_taken(name) || names.iter().any(extends) {
            format!("{name}_arg")
        } else {
            name.clone()
        };
        for k in 0..argument.kind.slots() {
            let (kind, several) = match argument.kind {
                Kind::Planars(_) => (Kind::Planar, true),
                Kind::Spatials(_) => (Kind::Spatial, true),
                Kind::Coords(_) => (argument.kind.clone(), true),
                _ => (argument.kind.clone(), false),
            };
            let name = if several { format!("{base}_{k}") } else { base.clone() };
            slots.push(Slot { name, kind });
        }
    }
    slots
}

/// The beginnings of names of temporaries and outputs; a number follows.
const TEMPORARIES: &[&str] =
    &["t", "s", "c", "o", "law", "leaf", "known", "call", "c_", "c_q_", "q_d_", "rhs_", "x_"];

/// Names of the emitted functions' own arguments and temporaries, and keywords that came as raw
/// identifiers.
fn is_taken(name: &str) -> bool {
    let prefix = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let temporary = prefix.len() < name.len() && TEMPORARIES.contains(&prefix);
    let own = matches!(
        name,
        "at" | "qd"
            | "c"
            | "c_q"
            | "q_d"
            | "rhs"
            | "t_dot"
            | "x"
            | "f"
            | "timed"
            | "known"
            | "own"
            | "fma"
            | "put"
    );
    temporary || own || syn::parse_str::<Ident>(name).is_err()
}
