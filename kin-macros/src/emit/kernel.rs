//! Straight-line code for some outputs of the graph: which nodes get a name, in which order, and how each is written.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::template;
use crate::graph::{Comparison, Function, Function2, Graph, Input, LeafNumber, LeafUse, Node, Op, Part};
use crate::lower::{Lowered, OpaqueKind};
use crate::parse::{Argument, Kind};

/// Nested this deep, an expression gets a name although it is used once.
const DEEPEST: usize = 5;

/// One emitted function body.
pub struct Kernel<'a> {
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
    states: Vec<bool>,
    rates: Vec<bool>,
}

/// One state argument in emitted code.
struct Slot {
    name: Ident,
    kind: Kind,
}

/// The code, and how many arithmetic operations and function calls it makes.
pub struct Code {
    pub tokens: TokenStream,
    pub operations: usize,
}

impl<'a> Kernel<'a> {
    /// Code that computes `outputs` and writes each to the place given with it.
    pub fn emit(lowered: &'a Lowered, arguments: &[Argument], outputs: &[(TokenStream, Node)]) -> Code {
        let mut kernel = Kernel::new(lowered, arguments);
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        kernel.name_all(&nodes);
        let writes: Vec<TokenStream> = outputs
            .iter()
            .map(|(place, node)| {
                let value = kernel.expression(*node);
                quote!(#place = #value;)
            })
            .collect();
        kernel.finish(quote!(#(#writes)*))
    }

    /// Code that returns the text of the first risk whose numbers are not all finite.
    pub fn emit_checks(lowered: &'a Lowered, arguments: &[Argument], checks: &[(String, Vec<Node>)]) -> Code {
        let mut kernel = Kernel::new(lowered, arguments);
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
        let unused = vec![false; slots.len()];
        Kernel {
            lowered,
            slots,
            uses: HashMap::new(),
            named: HashMap::new(),
            depth: HashMap::new(),
            statements: Vec::new(),
            temporaries: 0,
            operations: 0,
            evaluations: HashMap::new(),
            states: unused.clone(),
            rates: unused,
        }
    }

    fn graph(&self) -> &'a Graph {
        &self.lowered.graph
    }

    fn finish(self, outputs: TokenStream) -> Code {
        let bindings = self.slots.iter().enumerate().flat_map(|(k, slot)| slot.bindings(k, self.states[k], self.rates[k]));
        let (bindings, statements): (Vec<_>, _) = (bindings.collect(), self.statements);
        let items = &self.lowered.items;
        let items = if items.is_empty() { quote!() } else { quote!(#(#[allow(unused)] #items)*) };
        Code { tokens: quote!(#items #(#bindings)* #(#statements)* #outputs), operations: self.operations }
    }

    /// Gives a name to every node that needs one, operands first.
    fn name_all(&mut self, outputs: &[Node]) {
        let order = self.graph().reachable(outputs);
        for &node in outputs {
            *self.uses.entry(node).or_default() += 1;
        }
        for &node in &order {
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
        let find = |f| self.uses.keys().copied().find(|&n| self.graph().op(n) == Op::Call(f, angle));
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
                Op::Input(_) | Op::Call(..) | Op::Call2(..) | Op::Powi(..) => !matches!(self.graph().op(node), Op::Call2(Function2::Rem, ..)),
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
            Input::State(slot, part) => {
                self.states[slot] = true;
                self.slots[slot].state(part)
            }
            Input::Rate(slot, part) => {
                self.rates[slot] = true;
                self.slots[slot].rate(part)
            }
        }
    }

    /// Nodes that come out of an evaluation with several results: laws, opaque values, leaves.
    fn evaluation(&mut self, node: Node) -> Option<TokenStream> {
        match self.graph().op(node) {
            Op::Law(law, x, order) => {
                let law_place = template::place(&self.lowered.laws[law]);
                let x_value = self.expression(x);
                let key = format!("law {law} {x:?}");
                let name = self.evaluated(key, "law", |_| quote!(#law_place.jet(#x_value)));
                let order = Literal::usize_unsuffixed(usize::from(order));
                Some(quote!(#name[#order]))
            }
            Op::Opaque(number, component) => {
                let value = &self.lowered.opaques[number];
                let ty = template::kind_type(&value.kind);
                let name = self.evaluated(format!("opaque {number}"), "o", |kernel| template::plain(&value.template, &mut |n| kernel.expression(n)));
                // The type is what the macro took the value for: where that is wrong, rustc says so at the user's token.
                self.annotate(&name, &ty);
                Some(template::component(&name, &value.kind, component))
            }
            Op::Leaf(of) => Some(self.leaf(of)),
            _ => None,
        }
    }

    fn evaluated(&mut self, key: String, prefix: &str, value: impl FnOnce(&mut Self) -> TokenStream) -> Ident {
        if let Some(name) = self.evaluations.get(&key) {
            return name.clone();
        }
        self.operations += 1;
        let name = Ident::new(&format!("{prefix}{}", self.evaluations.len()), Span::mixed_site());
        let value = value(self);
        self.statements.push(quote!(let #name = #value;));
        self.evaluations.insert(key, name.clone());
        name
    }

    /// Puts a type on the `let` of an opaque value.
    fn annotate(&mut self, name: &Ident, ty: &TokenStream) {
        let (plain, typed) = (quote!(let #name =).to_string(), quote!(let #name: #ty =));
        if let Some(statement) = self.statements.iter_mut().find(|s| s.to_string().starts_with(&plain)) {
            let value: TokenStream = statement.clone().into_iter().skip(3).collect();
            *statement = quote!(#typed #value);
        }
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
        let name = self.evaluated(key, "leaf", |kernel| {
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
        debug_assert!(matches!(leaf.kind, OpaqueKind::Numbers(_)));
        quote!(#component #field)
    }
}

impl Slot {
    /// `let i = at.planar(0);` and `let i_rate = qd.planar(0);`, as far as they are needed.
    fn bindings(&self, k: usize, state: bool, rate: bool) -> Vec<TokenStream> {
        let getter = match self.kind {
            Kind::Planar => quote!(planar),
            Kind::Spatial => quote!(spatial),
            _ => quote!(coord),
        };
        let k = Literal::usize_unsuffixed(k);
        let (name, rate_name) = (&self.name, self.rate_name());
        let mut all = Vec::new();
        if state {
            all.push(quote!(let #name = at.#getter(#k);));
        }
        if rate {
            all.push(quote!(let #rate_name = qd.#getter(#k);));
        }
        all
    }

    fn rate_name(&self) -> Ident {
        Ident::new(&format!("{}_d", self.name), Span::mixed_site())
    }

    fn state(&self, part: Part) -> TokenStream {
        let name = &self.name;
        let bare = !matches!(self.kind, Kind::Planar | Kind::Spatial);
        match part {
            Part::R(0) => quote!(#name.r.x),
            Part::R(1) => quote!(#name.r.y),
            Part::R(_) => quote!(#name.r.z),
            Part::Theta if bare => quote!(#name.value),
            Part::Theta => quote!(#name.theta),
            Part::Sin => quote!(#name.sin),
            Part::Cos => quote!(#name.cos),
            Part::P(k) => {
                let field = format_ident!("e{k}");
                quote!(#name.p.#field)
            }
            Part::A(r, c) => {
                let field = format_ident!("m{}{}", r + 1, c + 1);
                quote!(#name.a.#field)
            }
        }
    }

    fn rate(&self, part: Part) -> TokenStream {
        let name = self.rate_name();
        let bare = !matches!(self.kind, Kind::Planar | Kind::Spatial);
        match part {
            Part::R(k) => {
                let k = Literal::usize_unsuffixed(k);
                quote!(#name.r[#k])
            }
            Part::P(k) => {
                let k = Literal::usize_unsuffixed(k);
                quote!(#name.p[#k])
            }
            _ if bare => quote!(#name),
            _ => quote!(#name.theta),
        }
    }
}

/// The state arguments, one a slot, with names that no temporary has.
fn slots(arguments: &[Argument]) -> Vec<Slot> {
    let mut slots = Vec::new();
    for argument in arguments {
        let plain = argument.name.to_string();
        let plain = plain.strip_prefix("r#").map_or(plain.clone(), |raw| format!("{raw}_"));
        let taken = ["at", "qd", "c", "c_q", "q_d", "rhs", "t_dot", "x"].contains(&plain.as_str());
        let numbered = plain.len() > 1 && plain.trim_end_matches(|c: char| c.is_ascii_digit()).len() < plain.len();
        let base = if taken || numbered { format!("{plain}_state") } else { plain };
        for k in 0..argument.kind.slots() {
            let name = if matches!(argument.kind, Kind::Coords(_)) { format!("{base}_{k}") } else { base.clone() };
            slots.push(Slot { name: Ident::new(&name, Span::mixed_site()), kind: argument.kind.clone() });
        }
    }
    slots
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
