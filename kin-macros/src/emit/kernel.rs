//! Straight-line code for some outputs of the graph: which nodes get a name, in which order, and how each is written.

use std::collections::{HashMap, HashSet};

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, quote};

use super::template;
use crate::graph::{Comparison, Function, Function2, Graph, Input, Leaf, LeafNumber, LeafUse, Node, Op, Part};
use crate::lower::{Lowered, OpaqueKind};
use crate::parse::{Argument, Kind};
use crate::schedule::{self, order};

/// Nested this deep, an expression gets a name although it is used once.
const DEEPEST: usize = 5;

/// One emitted function body.
pub struct Kernel<'a> {
    lowered: &'a Lowered,
    /// How each state argument is named, by its slot.
    slots: Vec<Slot>,
    /// How often each node is used, by its number.
    uses: Vec<usize>,
    /// What stands for a node that has a name.
    named: HashMap<Node, TokenStream>,
    /// How deep the expression of each node without a name is, by its number.
    depth: Vec<usize>,
    statements: Vec<TokenStream>,
    temporaries: usize,
    operations: usize,
    /// Evaluations of laws, opaque values and leaves that already have a name.
    evaluations: HashMap<String, Ident>,
    /// Whether something is multiplied and added in one operation.
    fused: bool,
    /// Parts of states (true) and rates that are read, by slot.
    read: HashSet<(usize, Part, bool)>,
    /// What is returned where states are missing.
    missing: TokenStream,
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
    /// Code for `outputs` after the scheduler has had a look at it.
    pub fn scheduled(lowered: &'a mut Lowered, arguments: &[Argument], outputs: &[(TokenStream, Node)]) -> Code {
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        let nodes = schedule::prepare(&mut lowered.graph, &nodes);
        let outputs: Vec<_> = outputs.iter().zip(nodes).map(|((place, _), node)| (place.clone(), node)).collect();
        Kernel::emit(lowered, arguments, &outputs)
    }

    /// Code that computes `outputs` and writes each to the place given with it.
    pub fn emit(lowered: &'a Lowered, arguments: &[Argument], outputs: &[(TokenStream, Node)]) -> Code {
        let mut kernel = Kernel::new(lowered, arguments);
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        kernel.count_uses(&nodes);
        let in_order = super::own("in_order");
        for group in order(&lowered.graph, &nodes) {
            group.nodes.into_iter().for_each(|node| kernel.name(node));
            let (place, node) = &outputs[group.output];
            let value = kernel.expression(*node);
            kernel.statements.push(quote!(#place = #value;));
            if group.computes {
                kernel.statements.push(quote!(#in_order();));
            }
        }
        kernel.statements.insert(0, quote!(let #in_order = ::kin::rt::in_order;));
        kernel.finish(quote!())
    }

    /// Code that returns the text of the first risk whose numbers are not all finite.
    pub fn emit_checks(lowered: &'a Lowered, arguments: &[Argument], checks: &[(String, Vec<Node>)]) -> Code {
        let mut kernel = Kernel { missing: quote!(::core::option::Option::None), ..Kernel::new(lowered, arguments) };
        let nodes: Vec<Node> = checks.iter().flat_map(|(_, nodes)| nodes.clone()).collect();
        kernel.count_uses(&nodes);
        kernel.graph().reachable(&nodes).into_iter().for_each(|node| kernel.name(node));
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
            lowered,
            slots,
            uses: vec![0; lowered.graph.len()],
            named: HashMap::new(),
            depth: vec![0; lowered.graph.len()],
            statements: Vec::new(),
            temporaries: 0,
            operations: 0,
            evaluations: HashMap::new(),
            fused: false,
            read: HashSet::new(),
            missing: quote!(),
        }
    }

    fn graph(&self) -> &'a Graph {
        &self.lowered.graph
    }

    fn finish(self, outputs: TokenStream) -> Code {
        let bindings = self.bindings();
        let statements = self.statements;
        let fma = super::own("fma");
        let fma = if self.fused { quote!(let #fma = ::kin::rt::fma;) } else { quote!() };
        let items = &self.lowered.items;
        let items = if items.is_empty() { quote!() } else { quote!(#(#[allow(unused)] #items)*) };
        Code { tokens: quote!(#items #fma #bindings #(#statements)* #outputs), operations: self.operations }
    }

    /// The states and rates as arrays of known length, if any of their numbers is read.
    fn bindings(&self) -> TokenStream {
        let read = |states: bool| self.read.iter().any(|(_, _, state)| *state == states);
        let states: usize = self.slots.iter().map(|slot| slot.state_parts().len()).sum();
        let rates: usize = self.slots.iter().map(|slot| slot.columns().len()).sum();
        let states = binding("state", quote!(at.states), states, read(true), &self.missing);
        let rates = binding("rate", quote!(qd.columns), rates, read(false), &self.missing);
        quote!(#states #rates)
    }

    /// The name of a number of a state or of the rates, read just before it is needed first: registers are few.
    fn reading(&mut self, slot: usize, part: Part, of_state: bool) -> Ident {
        let parts = |slot: &Slot| if of_state { slot.state_parts() } else { slot.columns() };
        let name = if of_state { self.slots[slot].state(part) } else { self.slots[slot].rate(part) };
        if self.read.insert((slot, part, of_state)) {
            let first: usize = self.slots[..slot].iter().map(|slot| parts(slot).len()).sum();
            let place = parts(&self.slots[slot]).iter().position(|&p| p == part).unwrap_or(0);
            let place = Literal::usize_unsuffixed(first + place);
            let source = super::own(if of_state { "state" } else { "rate" });
            self.statements.push(quote!(let #name = #source[#place];));
        }
        name
    }

    fn count_uses(&mut self, outputs: &[Node]) {
        for &node in outputs {
            self.uses[node.index()] += 1;
        }
        for node in self.graph().reachable(outputs).into_iter().rev() {
            // Minus x is written out as often as it is used.
            let times = if let Op::Neg(_) = self.graph().op(node) { self.uses[node.index()] } else { 1 };
            self.graph().each_operand(node, |operand| self.uses[operand.index()] += times);
        }
    }

    fn name(&mut self, node: Node) {
        if self.named.contains_key(&node) || self.is_leaf_of_expression(node) {
            return;
        }
        if let Op::Neg(a) = self.graph().op(node) {
            // A sign is written where it is needed: it belongs to the operation there.
            self.depth[node.index()] = self.depth[a.index()];
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
        let depth = 1 + self.graph().operands(node).iter().map(|n| self.depth[n.index()]).max().unwrap_or(0);
        if self.uses[node.index()] > 1 || depth > DEEPEST {
            let value = self.written(node);
            let name = self.temporary(value);
            self.named.insert(node, quote!(#name));
        } else {
            self.depth[node.index()] = depth;
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
        let find = |f| self.graph().existing(Op::Call(f, angle)).filter(|n| self.uses[n.index()] > 0);
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
                Op::Input(_) | Op::Call(..) | Op::Call2(..) | Op::Powi(..) | Op::Fma(..) => {
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
            Op::Constant(bits) => number(f64::from_bits(bits)),
            Op::Truth(value) => quote!(#value),
            Op::Add(a, b) => self.infix(a, quote!(+), b),
            Op::Sub(a, b) => self.infix(a, quote!(-), b),
            Op::Mul(a, b) => self.infix(a, quote!(*), b),
            Op::Div(a, b) => self.infix(a, quote!(/), b),
            Op::Fma(a, b, c) => {
                self.fused = true;
                let (fma, a, b, c) = (super::own("fma"), self.expression(a), self.expression(b), self.expression(c));
                quote!(#fma(#a, #b, #c))
            }
            Op::And(a, b) => self.infix(a, quote!(&&), b),
            Op::Or(a, b) => self.infix(a, quote!(||), b),
            Op::Compare(comparison, a, b) => self.infix(a, sign(comparison), b),
            Op::Neg(a) => {
                let a = self.operand(a);
                quote!(-#a)
            }
            Op::Not(a) => {
                let a = self.operand(a);
                quote!(!#a)
            }
            Op::Call(f, a) => {
                let (a, name) = (self.expression(a), Ident::new(f.method(), Span::call_site()));
                quote!(f64::#name(#a))
            }
            Op::Call2(Function2::Rem, a, b) => self.infix(a, quote!(%), b),
            Op::Call2(f, a, b) => {
                let (a, b, name) = (self.expression(a), self.expression(b), Ident::new(f.method(), Span::call_site()));
                quote!(f64::#name(#a, #b))
            }
            Op::Powi(a, n) => {
                let (a, n) = (self.expression(a), Literal::i32_unsuffixed(n));
                quote!(f64::powi(#a, #n))
            }
            Op::Select(c, a, b) => {
                let (c, a, b) = (self.expression(c), self.expression(a), self.expression(b));
                quote!(if #c { #a } else { #b })
            }
            // These have names before they are written.
            Op::Law(..) | Op::Opaque(..) | Op::Leaf(_) => quote!(f64::NAN),
        }
    }

    fn infix(&mut self, a: Node, sign: TokenStream, b: Node) -> TokenStream {
        let (a, b) = (self.operand(a), self.operand(b));
        quote!(#a #sign #b)
    }

    fn input(&mut self, input: Input) -> TokenStream {
        match input {
            Input::Time => quote!(at.t),
            Input::TimeRate => quote!(t_dot),
            Input::Variable => quote!(x),
            Input::Parameter(k) => self.lowered.parameters[k].clone(),
            Input::State(slot, part) => self.reading(slot, part, true).to_token_stream(),
            Input::Rate(slot, part) => self.reading(slot, part, false).to_token_stream(),
        }
    }

    /// Nodes that come out of an evaluation with several results: laws, opaque values, leaves.
    fn evaluation(&mut self, node: Node) -> Option<TokenStream> {
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
        let Leaf { call, arguments } = self.graph().leaves[of.leaf].clone();
        let (leaf, function) = (&self.lowered.leaves[call], template::leaf_name(call));
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
                r.chain(p).collect()
            }
            _ => vec![Part::Theta, Part::Sin, Part::Cos],
        }
    }

    /// The coordinates among them.
    fn columns(&self) -> Vec<Part> {
        self.state_parts().into_iter().filter(|part| !matches!(part, Part::Sin | Part::Cos)).collect()
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
        };
        Ident::new(&text, Span::mixed_site())
    }

    fn rate(&self, part: Part) -> Ident {
        Ident::new(&format!("{}_d", self.state(part)), Span::mixed_site())
    }
}

/// `let Some(state) = at.states::<10>() else { return };`
fn binding(name: &str, source: TokenStream, length: usize, is_read: bool, missing: &TokenStream) -> TokenStream {
    let (name, length) = (super::own(name), Literal::usize_unsuffixed(length));
    if is_read { quote!(let ::core::option::Option::Some(#name) = #source::<#length>() else { return #missing };) } else { quote!() }
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
    let temporary = prefix.len() < name.len() && matches!(prefix, "t" | "s" | "c" | "o" | "law" | "leaf");
    let own = matches!(name, "at" | "qd" | "c" | "c_q" | "q_d" | "rhs" | "t_dot" | "x" | "f");
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
