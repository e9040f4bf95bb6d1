//! Straight-line code for some outputs of the graph: which nodes get a name, in which order, and
//! how each is written.

mod branches;
mod dual;
mod evaluations;
mod inputs;
mod lookups;
mod operations;
mod progression;
mod words;

use std::collections::{HashMap, HashSet, hash_map::Entry};

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

pub use words::number;
use words::sign;

use super::slots::{Slot, binding, slots};
use super::timed::{self, Timed};
use kin_graph::schedule::{self, Branches, Group};
use kin_graph::{Function, Function2, Graph, Node, Op, Part};
use kin_language::lower::{Lowered, OpaqueKind};
use kin_language::parse::Argument;

/// Nested this deep, an expression gets a name although it is used once.
const DEEPEST: usize = 5;

/// The type of numbers in emitted code.
#[derive(Clone, Copy, PartialEq)]
enum Numbers {
    /// f64.
    Plain,
    /// `Real<__D>`, of the states by the user's names.
    Dual,
}

/// One emitted function body.
pub struct Kernel<'a> {
    numbers: Numbers,
    lowered: &'a Lowered,
    /// How each state argument is named, by its slot.
    slots: Vec<Slot>,
    /// The choices of which only the branch that is taken is computed.
    branches: Branches,
    /// How often each node is used, by its number.
    uses: Vec<usize>,
    /// The expression that stands for a node that has a name.
    named: HashMap<Node, TokenStream>,
    /// Nodes in the order in which they were named.
    names: Vec<Node>,
    /// How deep the expression of each node without a name is, by its number.
    depth: Vec<usize>,
    statements: Vec<TokenStream>,
    temporaries: usize,
    operations: usize,
    /// Evaluations of laws, opaque values and leaves that already have a name.
    evaluations: HashMap<String, Ident>,
    /// True if something is multiplied and added in one operation.
    fused: bool,
    /// Parts of states (true) and rates that are read, by slot.
    read: HashSet<(usize, Part, bool)>,
    /// True if outputs are written one after the other, as they stand.
    scheduled: bool,
    /// How many numbers were evaluated once a time, and whether they are read.
    timed: usize,
    reads_timed: bool,
    /// Of dual numbers, where each state argument is read, by its slot.
    places: Vec<TokenStream>,
}

/// The code, and how many arithmetic operations and function calls it makes.
pub struct Code {
    pub tokens: TokenStream,
    pub operations: usize,
}

impl<'a> Kernel<'a> {
    /// Code for `outputs` after the scheduler has had a look at it; what is in `timed` was
    /// evaluated before.
    pub fn scheduled(
        lowered: &'a mut Lowered,
        arguments: &[Argument],
        timed: &Timed,
        outputs: &[(Ident, Node)],
    ) -> Code {
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        let nodes = timed::read(&mut lowered.graph, timed, &nodes);
        let nodes = schedule::prepare(&mut lowered.graph, &nodes);
        let outputs: Vec<_> =
            outputs.iter().zip(nodes).map(|((place, _), node)| (place.clone(), node)).collect();
        Kernel { scheduled: true, timed: timed.len(), ..Kernel::new(lowered, arguments) }
            .write(&outputs)
    }

    /// Code in plain numbers, as it comes.
    pub fn plain(lowered: &'a Lowered, arguments: &[Argument]) -> Self {
        Kernel::new(lowered, arguments)
    }

    /// A kernel in which some nodes have a name already; what these are computed from is not looked
    /// at.
    pub fn from_given(
        lowered: &'a Lowered,
        arguments: &[Argument],
        given: HashMap<Node, TokenStream>,
    ) -> Self {
        Kernel { named: given, ..Kernel::new(lowered, arguments) }
    }

    /// Code in dual numbers: the states have the user's names, the time is `t`.
    pub fn over_duals(lowered: &'a Lowered, arguments: &'a [Argument]) -> Self {
        Kernel {
            numbers: Numbers::Dual,
            places: dual::places(arguments),
            ..Kernel::new(lowered, arguments)
        }
    }

    /// Code before the values of `nodes`, and these as expressions, conditions as 1 or 0.
    pub fn values(mut self, nodes: &[Node]) -> (Code, Vec<TokenStream>) {
        self.look_at(nodes);
        let mut values: Vec<TokenStream> = vec![quote!(); nodes.len()];
        for group in self.order(nodes) {
            group.nodes.into_iter().for_each(|node| self.name(node));
            values[group.output] = self.output(nodes[group.output]);
        }
        (self.finish(), values)
    }

    /// A result as a number.
    fn output(&mut self, node: Node) -> TokenStream {
        let value = self.expression(node);
        if is_condition(self.lowered, node) {
            quote!(if #value { 1.0 } else { 0.0 })
        } else {
            value
        }
    }

    /// Code that computes `outputs` and writes each behind the reference given with it.
    pub fn write(mut self, outputs: &[(Ident, Node)]) -> Code {
        let nodes: Vec<Node> = outputs.iter().map(|(_, node)| *node).collect();
        self.look_at(&nodes);
        let put = super::own("put");
        let groups = self.order(&nodes);
        let fenced = self.scheduled && groups.len() > 1;
        if fenced {
            self.statements.push(quote!(let #put = ::kin::emitted::put;));
        }
        for group in groups {
            group.nodes.into_iter().for_each(|node| self.name(node));
            let (place, node) = &outputs[group.output];
            let value = self.output(*node);
            self.statements.push(if fenced && group.computes {
                quote!(#put(#place, #value);)
            } else {
                quote!(*#place = #value;)
            });
        }
        self.finish()
    }

    fn new(lowered: &'a Lowered, arguments: &[Argument]) -> Self {
        let slots = slots(arguments);
        Kernel {
            numbers: Numbers::Plain,
            lowered,
            slots,
            branches: Branches::none(),
            uses: vec![0; lowered.graph.len()],
            named: HashMap::new(),
            names: Vec::new(),
            depth: vec![0; lowered.graph.len()],
            statements: Vec::new(),
            temporaries: 0,
            operations: 0,
            evaluations: HashMap::new(),
            fused: false,
            read: HashSet::new(),
            scheduled: false,
            timed: 0,
            reads_timed: false,
            places: vec![],
        }
    }

    fn graph(&self) -> &'a Graph {
        &self.lowered.graph
    }

    fn finish(self) -> Code {
        let bindings = self.bindings();
        let timed = self.reads_timed.then(|| timed::binding(self.timed));
        let statements = self.statements;
        let fma = super::own("fma");
        let fma = if self.fused { quote!(let #fma = ::kin::emitted::fma;) } else { quote!() };
        let items = &self.lowered.items;
        let items = if items.is_empty() { quote!() } else { quote!(#(#[allow(unused)] #items)*) };
        Code {
            tokens: quote!(#items #fma #timed #bindings #(#statements)*),
            operations: self.operations,
        }
    }

    /// The numbers of states and rates of arguments, of those that are read.
    fn bindings(&self) -> TokenStream {
        let of = |k: usize, of_state: bool| {
            let parts =
                if of_state { self.slots[k].state_parts() } else { self.slots[k].columns() };
            let read = |part: &Part| self.read.contains(&(k, *part, of_state));
            parts.iter().any(read).then(|| {
                binding(
                    k,
                    of_state,
                    parts.iter().map(|part| read(part).then(|| self.name_of(k, *part, of_state))),
                )
            })
        };
        let all = [true, false]
            .into_iter()
            .flat_map(|of_state| (0..self.slots.len()).filter_map(move |k| of(k, of_state)));
        all.collect()
    }

    /// The name of a number of a state or of the rates, read just before it is needed first:
    /// registers are few.
    fn reading(&mut self, slot: usize, part: Part, of_state: bool) -> Ident {
        let name = self.name_of(slot, part, of_state);
        if self.read.insert((slot, part, of_state)) {
            self.statements.push(quote!(let #name = *#name;));
        }
        name
    }

    fn name_of(&self, slot: usize, part: Part, of_state: bool) -> Ident {
        if of_state { self.slots[slot].state(part) } else { self.slots[slot].rate(part) }
    }

    /// Learns of `outputs` how often each node is used, and which choices are worth a branch.
    fn look_at(&mut self, outputs: &[Node]) {
        let known = |node: Node| self.named.contains_key(&node);
        self.branches =
            Branches::new(self.graph(), outputs, known, |table| self.is_readable(table));
        self.count_uses(outputs);
    }

    /// The nodes that `outputs` need and that are not known yet, in the order in which to compute
    /// them.
    fn order(&self, outputs: &[Node]) -> Vec<Group> {
        schedule::order(self.graph(), &self.branches, outputs, |node| {
            self.named.contains_key(&node)
        })
    }

    fn count_uses(&mut self, outputs: &[Node]) {
        for &node in outputs {
            self.uses[node.index()] += 1;
        }
        let known = |node: Node| self.named.contains_key(&node);
        // The numbers of a table are not computed.
        let given = |node: Node| known(node) || self.branches.cell(node).is_some();
        let order: Vec<Node> = self
            .graph()
            .reachable_from(outputs, given)
            .into_iter()
            .filter(|&node| !known(node))
            .collect();
        for node in order.into_iter().rev() {
            // Minus x is written out as often as it is used.
            let times =
                if let Op::Neg(_) = self.graph().op(node) { self.uses[node.index()] } else { 1 };
            match self.branches.cell(node) {
                Some((table, _)) => {
                    let searched = self.branches.lookup(table).searched();
                    searched.for_each(|operand| self.uses[operand.index()] += times);
                }
                None => {
                    self.graph().each_operand(node, |operand| self.uses[operand.index()] += times)
                }
            }
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
            self.give_name(node, value);
            return;
        }
        if let Some(choice) = self.branches.choice(node) {
            self.choice(&choice.clone());
            return;
        }
        self.operations += 1;
        if let Op::Call(Function::Sin | Function::Cos, angle) = self.graph().op(node)
            && self.pair(angle)
        {
            return;
        }
        let mut depth = 1;
        self.graph()
            .each_operand(node, |operand| depth = depth.max(1 + self.depth[operand.index()]));
        if self.uses[node.index()] > 1 || depth > DEEPEST {
            let value = self.written(node);
            let name = self.temporary(value);
            self.give_name(node, quote!(#name));
        } else {
            self.depth[node.index()] = depth;
        }
    }

    fn is_leaf_of_expression(&self, node: Node) -> bool {
        matches!(
            self.graph().op(node),
            Op::Input(_) | Op::Constant(_) | Op::Decimal(_) | Op::Truth(_)
        )
    }

    fn temporary(&mut self, value: TokenStream) -> Ident {
        let name = self.next_name("t");
        self.statements.push(quote!(let #name = #value;));
        name
    }

    fn next_name(&mut self, prefix: &str) -> Ident {
        self.temporaries += 1;
        Ident::new(&format!("{prefix}{}", self.temporaries - 1), Span::mixed_site())
    }

    fn give_name(&mut self, node: Node, name: TokenStream) {
        if let Entry::Vacant(place) = self.named.entry(node) {
            place.insert(name);
            self.names.push(node);
        }
    }

    /// Sine and cosine of one angle are one call, where both are needed.
    fn pair(&mut self, angle: Node) -> bool {
        let find =
            |f| self.graph().existing(Op::Call(f, angle)).filter(|n| self.uses[n.index()] > 0);
        let (Some(sin), Some(cos)) = (find(Function::Sin), find(Function::Cos)) else {
            return false;
        };
        let of = self.expression(angle);
        let s = format!("s{}", self.temporaries);
        let c = format!("c{}", self.temporaries);
        let [s, c] = [s, c].map(|name| Ident::new(&name, Span::mixed_site()));
        self.temporaries += 1;
        self.statements.push(match self.numbers {
            Numbers::Plain => quote!(let (#s, #c) = ::kin::emitted::math::sin_cos(#of);),
            _ => quote!(let (#s, #c) = #of.sin_cos();),
        });
        self.give_name(sin, quote!(#s));
        self.give_name(cos, quote!(#c));
        true
    }

    /// The code that stands for `node` in an expression.
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
                Op::Input(_)
                | Op::Decimal(_)
                | Op::Call(..)
                | Op::Call2(..)
                | Op::Powi(..)
                | Op::Fma(..) => !matches!(self.graph().op(node), Op::Call2(Function2::Rem, ..)),
                _ => false,
            };
        let value = self.expression(node);
        if simple { value } else { quote!((#value)) }
    }
}

/// True if a node is a condition and not a number.
pub fn is_condition(lowered: &Lowered, node: Node) -> bool {
    match lowered.graph.op(node) {
        Op::Compare(..) | Op::And(..) | Op::Or(..) | Op::Not(_) | Op::Truth(_) => true,
        Op::Opaque(number, _) => lowered.opaques[number].kind == OpaqueKind::Condition,
        _ => false,
    }
}
