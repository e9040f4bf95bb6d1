//! Straight-line code for some outputs of the graph: which nodes get a name, in which order, and how each is written.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::{template, timed};
use crate::graph::{Comparison, Function, Function2, Graph, Input, LeafNumber, LeafUse, Node, Op, Part};
use crate::lower::{Lowered, OpaqueKind};
use crate::parse::{Argument, Kind};

/// Nested this deep, an expression gets a name although it is used once.
const DEEPEST: usize = 5;

/// What the numbers of emitted code are.
#[derive(Clone, Copy, PartialEq)]
enum Numbers {
    /// f64.
    Plain,
    /// One f64 for each lane.
    Wide,
}

/// Nodes that come out of an evaluation in plain numbers, lane by lane: its number, the place among its results, and how many there are.
pub type Evaluations = HashMap<Node, (usize, usize, usize)>;

/// One emitted function body.
pub struct Kernel<'a> {
    numbers: Numbers,
    lane_by_lane: Evaluations,
    lowered: &'a Lowered,
    /// How each state argument is named, by its slot.
    slots: Vec<Slot>,
    uses: HashMap<Node, usize>,
    /// What stands for a node that has a name.
    named: HashMap<Node, TokenStream>,
    depth: HashMap<Node, usize>,
    statements: Vec<TokenStream>,
    temporaries: usize,
    operations: usize,
    /// Evaluations of laws, opaque values and leaves that already have a name.
    evaluations: HashMap<String, Ident>,
    /// Parts of states and rates that are read, by slot.
    states: Vec<(usize, Part)>,
    rates: Vec<(usize, Part)>,
    /// What is returned where states are missing.
    missing: TokenStream,
    /// Nodes that were evaluated once a time, and whether they are read.
    timed: &'a [Node],
    reads_timed: bool,
}

/// One state argument in emitted code.
struct Slot {
    name: String,
    kind: Kind,
}

/// The code, and how many arithmetic operations and function calls it makes.
pub struct Code {
    pub tokens: TokenStream,
    pub operations: usize,
}

impl<'a> Kernel<'a> {
    /// Code that computes `outputs` and writes each to the place given with it; nodes in `timed` (sorted) were evaluated before.
    pub fn emit(lowered: &'a Lowered, arguments: &[Argument], timed: &'a [Node], outputs: &[(TokenStream, Node)]) -> Code {
        Kernel { timed, ..Kernel::new(lowered, arguments) }.write(outputs)
    }

    /// A kernel in which some nodes have a name already; what these are computed from is not looked at.
    pub fn from_given(lowered: &'a Lowered, arguments: &[Argument], given: HashMap<Node, TokenStream>) -> Self {
        Kernel { named: given, ..Kernel::new(lowered, arguments) }
    }

    /// The same over lanes.
    pub fn over_lanes(lowered: &'a Lowered, arguments: &[Argument], given: HashMap<Node, TokenStream>, lane_by_lane: Evaluations) -> Self {
        Kernel { numbers: Numbers::Wide, lane_by_lane, ..Kernel::from_given(lowered, arguments, given) }
    }

    /// Code that computes `outputs` and writes each to the place given with it, conditions as 1 or 0.
    pub fn write(mut self, outputs: &[(TokenStream, Node)]) -> Code {
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        self.name_all(&nodes);
        let writes: Vec<TokenStream> = outputs
            .iter()
            .map(|(place, node)| {
                let value = self.expression(*node);
                if is_condition(self.lowered, *node) { quote!(#place = if #value { 1.0 } else { 0.0 };) } else { quote!(#place = #value;) }
            })
            .collect();
        self.finish(quote!(#(#writes)*))
    }

    /// Code that returns the text of the first risk whose numbers are not all finite.
    pub fn emit_checks(lowered: &'a Lowered, arguments: &[Argument], checks: &[(String, Vec<Node>)]) -> Code {
        let mut kernel = Kernel { missing: quote!(::core::option::Option::None), ..Kernel::new(lowered, arguments) };
        let nodes: Vec<Node> = checks.iter().flat_map(|(_, nodes)| nodes.clone()).collect();
        kernel.name_all(&nodes);
        let tests: Vec<TokenStream> = checks
            .iter()
            .map(|(text, nodes)| {
                let values: Vec<TokenStream> = nodes.iter().map(|&n| kernel.expression(n)).collect();
                quote!(if ![#(#values),*].into_iter().all(f64::is_finite) { return ::core::option::Option::Some(#text); })
            })
            .collect();
        kernel.finish(quote!(#(#tests)*))
    }

    fn new(lowered: &'a Lowered, arguments: &[Argument]) -> Self {
        let slots = slots(arguments);
        Kernel {
            numbers: Numbers::Plain,
            lane_by_lane: HashMap::new(),
            lowered,
            slots,
            uses: HashMap::new(),
            named: HashMap::new(),
            depth: HashMap::new(),
            statements: Vec::new(),
            temporaries: 0,
            operations: 0,
            evaluations: HashMap::new(),
            states: Vec::new(),
            rates: Vec::new(),
            missing: quote!(),
            timed: &[],
            reads_timed: false,
        }
    }

    fn graph(&self) -> &'a Graph {
        &self.lowered.graph
    }

    fn finish(self, outputs: TokenStream) -> Code {
        let mut bindings = self.bindings();
        bindings.extend(self.reads_timed.then(|| timed::binding(self.timed.len())));
        let statements = self.statements;
        let items = &self.lowered.items;
        let items = if items.is_empty() { quote!() } else { quote!(#(#[allow(unused)] #items)*) };
        Code { tokens: quote!(#items #(#bindings)* #(#statements)* #outputs), operations: self.operations }
    }

    /// The states and rates that are read, each number by a name.
    fn bindings(&self) -> Vec<TokenStream> {
        let (mut states, mut rates) = (Vec::new(), Vec::new());
        for (k, slot) in self.slots.iter().enumerate() {
            states.extend(slot.state_parts().into_iter().map(|part| self.states.contains(&(k, part)).then(|| slot.state(part))));
            rates.extend(slot.columns().into_iter().map(|part| self.rates.contains(&(k, part)).then(|| slot.rate(part))));
        }
        let (n, m) = (Literal::usize_unsuffixed(states.len()), Literal::usize_unsuffixed(rates.len()));
        let states = binding(quote!(at.states::<#n>()), states, &self.missing);
        let rates = binding(quote!(qd.columns::<#m>()), rates, &self.missing);
        states.into_iter().chain(rates).collect()
    }

    /// Gives a name to every node that needs one, operands first.
    fn name_all(&mut self, outputs: &[Node]) {
        let known = |node: Node| self.named.contains_key(&node) || self.timed.binary_search(&node).is_ok();
        let order = self.graph().reachable_from(outputs, known);
        let computed: Vec<Node> = order.iter().copied().filter(|&node| !known(node)).collect();
        for &node in outputs {
            *self.uses.entry(node).or_default() += 1;
        }
        for node in computed {
            for operand in self.graph().operands(node) {
                *self.uses.entry(operand).or_default() += 1;
            }
        }
        for node in order {
            self.name(node);
        }
    }

    fn name(&mut self, node: Node) {
        if self.named.contains_key(&node) || self.is_leaf_of_expression(node) {
            return;
        }
        if let Ok(k) = self.timed.binary_search(&node) {
            let k = Literal::usize_unsuffixed(k);
            self.reads_timed = true;
            self.named.insert(node, quote!(timed[#k]));
            return;
        }
        if let Some(value) = self.evaluation(node) {
            self.named.insert(node, value);
            return;
        }
        self.operations += 1;
        if let Op::Call(Function::Sin | Function::Cos, angle) = self.graph().op(node)
            && self.pair(angle)
        {
            return;
        }
        let depth = 1 + self.graph().operands(node).iter().map(|n| self.depth.get(n).copied().unwrap_or(0)).max().unwrap_or(0);
        if self.uses[&node] > 1 || depth > DEEPEST {
            let value = self.written(node);
            let name = self.temporary(value);
            self.named.insert(node, quote!(#name));
        } else {
            self.depth.insert(node, depth);
        }
    }

    fn is_leaf_of_expression(&self, node: Node) -> bool {
        matches!(self.graph().op(node), Op::Input(_) | Op::Constant(_) | Op::Truth(_))
    }

    fn temporary(&mut self, value: TokenStream) -> Ident {
        let name = Ident::new(&format!("t{}", self.temporaries), Span::mixed_site());
        self.temporaries += 1;
        self.statements.push(quote!(let #name = #value;));
        name
    }

    /// Sine and cosine of one angle are one call, where both are needed.
    fn pair(&mut self, angle: Node) -> bool {
        let find = |f| self.graph().existing(Op::Call(f, angle)).filter(|n| self.uses.contains_key(n));
        let (Some(sin), Some(cos)) = (find(Function::Sin), find(Function::Cos)) else { return false };
        let of = self.expression(angle);
        let (s, c) = (format!("s{}", self.temporaries), format!("c{}", self.temporaries));
        let [s, c] = [s, c].map(|name| Ident::new(&name, Span::mixed_site()));
        self.temporaries += 1;
        self.statements.push(quote!(let (#s, #c) = #of.sin_cos();));
        self.named.insert(sin, quote!(#s));
        self.named.insert(cos, quote!(#c));
        true
    }

    /// What stands for `node` in an expression.
    pub fn expression(&mut self, node: Node) -> TokenStream {
        match self.named.get(&node) {
            Some(name) => name.clone(),
            None => self.written(node),
        }
    }

    /// As an operand: in parentheses if it is more than a name.
    fn operand(&mut self, node: Node) -> TokenStream {
        let simple = self.named.contains_key(&node)
            || match self.graph().op(node) {
                Op::Constant(bits) => f64::from_bits(bits) >= 0.0,
                Op::Input(_) | Op::Call(..) | Op::Call2(..) | Op::Powi(..) => {
                    !matches!(self.graph().op(node), Op::Call2(Function2::Rem, ..))
                }
                _ => false,
            };
        let value = self.expression(node);
        if simple { value } else { quote!((#value)) }
    }

    fn written(&mut self, node: Node) -> TokenStream {
        match self.graph().op(node) {
            Op::Input(input) => self.input(input),
            Op::Constant(bits) => self.constant(f64::from_bits(bits)),
            Op::Truth(value) if self.numbers == Numbers::Wide => quote!(::kin::rt::Mask::splat(at.simd, #value)),
            Op::Truth(value) => quote!(#value),
            Op::Add(a, b) => self.infix(a, quote!(+), b),
            Op::Sub(a, b) => self.infix(a, quote!(-), b),
            Op::Mul(a, b) => self.infix(a, quote!(*), b),
            Op::Div(a, b) => self.infix(a, quote!(/), b),
            Op::And(a, b) => self.infix(a, if self.numbers == Numbers::Plain { quote!(&&) } else { quote!(&) }, b),
            Op::Or(a, b) => self.infix(a, if self.numbers == Numbers::Plain { quote!(||) } else { quote!(|) }, b),
            Op::Compare(comparison, a, b) if self.numbers == Numbers::Plain => self.infix(a, sign(comparison), b),
            Op::Compare(comparison, a, b) => self.function(comparison_method(comparison), &[a, b]),
            Op::Neg(a) => {
                let a = self.operand(a);
                quote!(-#a)
            }
            Op::Not(a) => {
                let a = self.operand(a);
                quote!(!#a)
            }
            Op::Call(f, a) => self.function(f.method(), &[a]),
            Op::Call2(Function2::Rem, a, b) => self.infix(a, quote!(%), b),
            Op::Call2(f, a, b) => self.function(f.method(), &[a, b]),
            Op::Powi(a, n) => {
                let (ty, a, n) = (self.number_type(), self.expression(a), Literal::i32_unsuffixed(n));
                quote!(#ty::powi(#a, #n))
            }
            Op::Select(c, a, b) => {
                let (c, a, b) = (self.expression(c), self.expression(a), self.expression(b));
                match self.numbers {
                    Numbers::Plain => quote!(if #c { #a } else { #b }),
                    Numbers::Wide => quote!(::kin::rt::Mask::select(#c, #a, #b)),
                }
            }
            // These have names before they are written.
            Op::Law(..) | Op::Opaque(..) | Op::Leaf(_) => quote!(f64::NAN),
        }
    }

    fn constant(&self, value: f64) -> TokenStream {
        let value = number(value);
        if self.numbers == Numbers::Plain { value } else { quote!(at.splat(#value)) }
    }

    fn number_type(&self) -> TokenStream {
        if self.numbers == Numbers::Plain { quote!(f64) } else { quote!(::kin::rt::Wide) }
    }

    /// A function of the numbers' type.
    fn function(&mut self, name: &str, arguments: &[Node]) -> TokenStream {
        let (ty, name) = (self.number_type(), Ident::new(name, Span::call_site()));
        let arguments: Vec<TokenStream> = arguments.iter().map(|&n| self.expression(n)).collect();
        quote!(#ty::#name(#(#arguments),*))
    }

    fn infix(&mut self, a: Node, sign: TokenStream, b: Node) -> TokenStream {
        let (a, b) = (self.operand(a), self.operand(b));
        quote!(#a #sign #b)
    }

    fn input(&mut self, input: Input) -> TokenStream {
        match input {
            Input::Time => quote!(at.t),
            Input::TimeRate if self.numbers == Numbers::Wide => quote!(at.splat(1.0)),
            Input::TimeRate => quote!(t_dot),
            Input::Variable => quote!(x),
            Input::Parameter(k) => self.lowered.parameters[k].clone(),
            Input::State(slot, part) => {
                self.states.push((slot, part));
                let name = self.slots[slot].state(part);
                quote!(#name)
            }
            Input::Rate(slot, part) => {
                self.rates.push((slot, part));
                let name = self.slots[slot].rate(part);
                quote!(#name)
            }
        }
    }

    /// Nodes that come out of an evaluation with several results: laws, opaque values, leaves.
    fn evaluation(&mut self, node: Node) -> Option<TokenStream> {
        if let Some(&(number, slot, count)) = self.lane_by_lane.get(&node) {
            return Some(self.evaluated_lane_by_lane(node, number, slot, count));
        }
        match self.graph().op(node) {
            Op::Law(law, x, order) => {
                let law_place = template::place(&self.lowered.laws[law]);
                let x_value = self.expression(x);
                let key = format!("law {law} {x:?}");
                let name = self.evaluated(key, "law", &quote!([f64; 4]), |_| quote!(#law_place.jet(#x_value)));
                let order = Literal::usize_unsuffixed(usize::from(order));
                Some(quote!(#name[#order]))
            }
            Op::Opaque(number, component) => {
                let value = &self.lowered.opaques[number];
                // The type is what the macro took the value for: where that is wrong, rustc says so at the user's token.
                let ty = template::kind_type(&value.kind);
                let ty = quote!(::kin::rt::If<__SOUND, #ty>);
                let key = format!("opaque {number}");
                let name = self.evaluated(key, "o", &ty, |kernel| template::plain(&value.template, &mut |n| kernel.expression(n)));
                Some(template::component(&name, &value.kind, component))
            }
            Op::Leaf(of) => Some(self.leaf(of)),
            _ => None,
        }
    }

    /// One number of an evaluation that each lane makes by itself.
    fn evaluated_lane_by_lane(&mut self, node: Node, number: usize, slot: usize, count: usize) -> TokenStream {
        let inputs: Vec<TokenStream> = self
            .graph()
            .operands(node)
            .into_iter()
            .map(|input| {
                let value = self.expression(input);
                if is_condition(self.lowered, input) { quote!(::kin::rt::Mask::as_numbers(#value)) } else { value }
            })
            .collect();
        let [n, m, k, slot] = [inputs.len(), count, number, slot].map(Literal::usize_unsuffixed);
        let ty = quote!([::kin::rt::Wide<__S>; #m]);
        let name = self.evaluated(format!("evaluation {number}"), "call", &ty, |_| quote!(at.evaluate::<#n, #m>(#k, [#(#inputs),*])));
        if is_condition(self.lowered, node) { quote!(#name[#slot].is_true()) } else { quote!(#name[#slot]) }
    }

    /// The name of an evaluation of a type, the same one each time.
    fn evaluated(&mut self, key: String, prefix: &str, ty: &TokenStream, value: impl FnOnce(&mut Self) -> TokenStream) -> Ident {
        if let Some(name) = self.evaluations.get(&key) {
            return name.clone();
        }
        self.operations += 1;
        let name = Ident::new(&format!("{prefix}{}", self.evaluations.len()), Span::mixed_site());
        let value = value(self);
        self.statements.push(quote!(let #name: #ty = #value;));
        self.evaluations.insert(key, name.clone());
        name
    }

    fn leaf(&mut self, of: LeafUse) -> TokenStream {
        let leaf = &self.lowered.leaves[of.leaf];
        let function = template::leaf_name(of.leaf);
        let arguments = self.graph().leaves[of.leaf].arguments.clone();
        let directions = &self.graph().directions;
        let (key, field) = match of.what {
            LeafNumber::Value => (format!("leaf {} value", of.leaf), quote!(.0)),
            LeafNumber::Partial(k) => (format!("leaf {} by {k}", of.leaf), quote!(.0.eps)),
            LeafNumber::First(d) => (format!("leaf {} along {d}", of.leaf), quote!(.0.v1)),
            LeafNumber::Second(d) => (format!("leaf {} along {d}", of.leaf), quote!(.0.v2)),
        };
        let scalar = match of.what {
            LeafNumber::Value => quote!(::kin::rt::Real<f64>),
            LeafNumber::Partial(_) => quote!(::kin::rt::Real<::kin::rt::Dual64>),
            LeafNumber::First(_) | LeafNumber::Second(_) => quote!(::kin::rt::Real<::kin::rt::Dual2_64>),
        };
        let OpaqueKind::Numbers(shape) = &leaf.kind else { return quote!(f64::NAN) };
        let name = self.evaluated(key, "leaf", &template::shape_type(shape, &scalar), |kernel| {
            let values: Vec<TokenStream> = arguments
                .iter()
                .enumerate()
                .map(|(k, &a)| {
                    let x = kernel.expression(a);
                    match of.what {
                        LeafNumber::Value => quote!(::kin::rt::Real(#x)),
                        LeafNumber::Partial(by) => {
                            let seed = number(if by == k { 1.0 } else { 0.0 });
                            quote!(::kin::rt::Real(::kin::rt::Dual64::new(#x, #seed)))
                        }
                        LeafNumber::First(d) | LeafNumber::Second(d) => {
                            let (first, second) = (kernel.expression(directions[d].first[k]), kernel.expression(directions[d].second[k]));
                            quote!(::kin::rt::Real(::kin::rt::Dual2_64::new(#x, #first, #second)))
                        }
                    }
                })
                .collect();
            quote!(self.#function([#(#values),*]))
        });
        let component = template::component(&name, &leaf.kind, of.output);
        quote!(#component #field)
    }
}

impl Slot {
    /// A name for each number of the state, in the order in which a constraint reads them.
    fn state_parts(&self) -> Vec<Part> {
        match self.kind {
            Kind::Planar => vec![Part::R(0), Part::R(1), Part::Theta, Part::Sin, Part::Cos],
            Kind::Spatial => {
                let (r, p) = ((0..3).map(Part::R), (0..4).map(Part::P));
                r.chain(p).chain((0..9).map(|k| Part::A(k / 3, k % 3))).collect()
            }
            _ => vec![Part::Theta, Part::Sin, Part::Cos],
        }
    }

    /// The coordinates among them.
    fn columns(&self) -> Vec<Part> {
        self.state_parts().into_iter().filter(|part| !matches!(part, Part::Sin | Part::Cos | Part::A(..))).collect()
    }

    fn state(&self, part: Part) -> Ident {
        let name = &self.name;
        let bare = !matches!(self.kind, Kind::Planar | Kind::Spatial);
        let text = match part {
            Part::R(k) => format!("{name}_{}", ["x", "y", "z"][k]),
            Part::Theta if bare => name.clone(),
            Part::Theta => format!("{name}_theta"),
            Part::Sin => format!("{name}_sin"),
            Part::Cos => format!("{name}_cos"),
            Part::P(k) => format!("{name}_e{k}"),
            Part::A(r, c) => format!("{name}_a{}{}", r + 1, c + 1),
        };
        Ident::new(&text, Span::mixed_site())
    }

    fn rate(&self, part: Part) -> Ident {
        Ident::new(&format!("{}_d", self.state(part)), Span::mixed_site())
    }
}

/// `let [i_x, i_y, _, i_sin, i_cos, …] = …`: the numbers that are read, by name.
fn binding(source: TokenStream, names: Vec<Option<Ident>>, missing: &TokenStream) -> Option<TokenStream> {
    names.iter().any(Option::is_some).then(|| {
        let places = names.iter().map(|name| name.as_ref().map_or(quote!(_), |name| quote!(#name)));
        quote!(let ::core::option::Option::Some(&[#(#places),*]) = #source else { return #missing };)
    })
}

/// The state arguments, one a slot, with names that nothing else in emitted code has.
fn slots(arguments: &[Argument]) -> Vec<Slot> {
    let plain = |argument: &Argument| argument.name.to_string().trim_start_matches("r#").to_owned();
    let names: Vec<String> = arguments.iter().map(plain).collect();
    let mut slots = Vec::new();
    for (argument, name) in arguments.iter().zip(&names) {
        let extends = |other: &String| name.strip_prefix(other.as_str()).is_some_and(|rest| rest.starts_with('_'));
        let base = if is_taken(name) || names.iter().any(extends) { format!("{name}_arg") } else { name.clone() };
        for k in 0..argument.kind.slots() {
            let name = if matches!(argument.kind, Kind::Coords(_)) { format!("{base}_{k}") } else { base.clone() };
            slots.push(Slot { name, kind: argument.kind.clone() });
        }
    }
    slots
}

/// Names of the emitted functions' own arguments and temporaries, and keywords that came as raw identifiers.
fn is_taken(name: &str) -> bool {
    let prefix = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let temporary = prefix.len() < name.len() && matches!(prefix, "t" | "s" | "c" | "o" | "law" | "leaf" | "known" | "call");
    let own = matches!(name, "at" | "qd" | "c" | "c_q" | "q_d" | "rhs" | "t_dot" | "x" | "f" | "timed" | "own");
    temporary || own || syn::parse_str::<Ident>(name).is_err()
}

/// A number as a literal.
pub fn number(value: f64) -> TokenStream {
    if value.is_nan() {
        return quote!(f64::NAN);
    }
    if value.is_infinite() {
        return if value > 0.0 { quote!(f64::INFINITY) } else { quote!(f64::NEG_INFINITY) };
    }
    let size = Literal::f64_unsuffixed(value.abs());
    if value < 0.0 { quote!(-#size) } else { quote!(#size) }
}

/// Whether a node is a condition and not a number.
pub fn is_condition(lowered: &Lowered, node: Node) -> bool {
    match lowered.graph.op(node) {
        Op::Compare(..) | Op::And(..) | Op::Or(..) | Op::Not(_) | Op::Truth(_) => true,
        Op::Opaque(number, _) => lowered.opaques[number].kind == OpaqueKind::Condition,
        _ => false,
    }
}

fn comparison_method(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Less => "lt",
        Comparison::LessEqual => "le",
        Comparison::Greater => "gt",
        Comparison::GreaterEqual => "ge",
        Comparison::Equal => "equal",
        Comparison::NotEqual => "differ",
    }
}

fn sign(comparison: Comparison) -> TokenStream {
    match comparison {
        Comparison::Less => quote!(<),
        Comparison::LessEqual => quote!(<=),
        Comparison::Greater => quote!(>),
        Comparison::GreaterEqual => quote!(>=),
        Comparison::Equal => quote!(==),
        Comparison::NotEqual => quote!(!=),
    }
}
