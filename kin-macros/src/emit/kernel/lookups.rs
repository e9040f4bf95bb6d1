//! Numbers that are looked up: a table stands beside the code, its row is found once, and each
//! number is read from there.

use super::progression::Progression;
use super::*;
use kin_graph::Input;
use kin_graph::schedule::{Lookup, Test};

/// So many knots are compared one after the other: of 19 knots that takes 213 instructions where
/// halving takes 302 (C, C_q and Q_d of a cubic spline).
const SHORT: usize = 32;

impl Kernel<'_> {
    /// The number that a node is in the row of its table, if it is one.
    pub(super) fn looked_up(&mut self, node: Node) -> Option<TokenStream> {
        let (number, column) = self.branches.cell(node)?;
        let row = self.row(number);
        let lookup = self.branches.lookup(number);
        let constants = constants(self.graph(), lookup);
        if let Some(place) = constants.iter().position(|known| *known == column) {
            let cells = table("cells", number);
            let place = Literal::usize_unsuffixed(place);
            return Some(quote!(#cells[#row][#place]));
        }
        let places = self.places(&lookup.columns[column])?;
        Some(Progression::of(&places)?.at(&quote!(#row)))
    }

    /// True if all numbers of a table can be read by their row.
    pub(super) fn is_readable(&self, lookup: &Lookup) -> bool {
        let is_readable = |nodes: &Vec<Node>| {
            let constant = nodes.iter().all(|&node| self.graph().constant_value(node).is_some());
            constant || self.places(nodes).is_some_and(|places| Progression::of(&places).is_some())
        };
        self.numbers == Numbers::Plain
            && lookup.knots.iter().chain(&lookup.columns).all(is_readable)
    }

    /// The name of the row of a table, found where it is asked for first.
    fn row(&mut self, number: usize) -> Ident {
        let key = format!("row {number}");
        if let Some(name) = self.evaluations.get(&key) {
            return name.clone();
        }
        let searched: Vec<Node> = self.branches.lookup(number).searched().collect();
        let searched: Vec<TokenStream> =
            searched.into_iter().map(|node| self.searched(node)).collect();
        let lookup = self.branches.lookup(number);
        let g = self.graph();
        let n = lookup.knots[0].len();
        let mut code = cells(g, lookup, &table("cells", number));
        let n = Literal::usize_unsuffixed(n);
        let mut tests: Vec<Searched> = Vec::new();
        for (k, (knots, x)) in lookup.knots.iter().zip(searched).enumerate() {
            let knots = match self.places(knots).and_then(|places| Progression::of(&places)) {
                Some(places) => Knots::Parameters(places),
                None => {
                    let name = table(&format!("knots{k}_"), number);
                    let numbers = knots.iter().map(|&knot| number_of(g, knot));
                    code.extend(quote!(static #name: [f64; #n] = [#(#numbers),*];));
                    Knots::Table(name)
                }
            };
            tests.push(Searched { test: lookup.tests[k], x, knots });
        }
        let begins = lookup.begins(g).filter(|_| lookup.knots[0].len() > SHORT);
        let row = found(&tests, begins, &n);
        self.statements.push(code);
        self.evaluated(key, "row", &quote!(usize), |_| quote!(::core::cmp::Ord::min(#row, #n)))
    }

    /// A name for the number that is looked for: it is compared many times.
    fn searched(&mut self, node: Node) -> TokenStream {
        let value = self.expression(node);
        if self.named.contains_key(&node) || self.is_leaf_of_expression(node) {
            return value;
        }
        let name = self.temporary(value);
        self.give_name(node, quote!(#name));
        quote!(#name)
    }

    /// The places of parameters, if nodes are some.
    fn places(&self, nodes: &[Node]) -> Option<Vec<TokenStream>> {
        let place = |node: &Node| match self.graph().op(*node) {
            Op::Input(Input::Parameter(k)) => Some(self.lowered.parameters[k].clone()),
            _ => None,
        };
        nodes.iter().map(place).collect()
    }
}

/// A test as it is written.
struct Searched {
    test: Test,
    x: TokenStream,
    knots: Knots,
}

enum Knots {
    Table(Ident),
    Parameters(Progression),
}

impl Searched {
    /// True where it holds, or where it does not.
    fn with(&self, knot: &TokenStream, holds: bool) -> TokenStream {
        let x = &self.x;
        let sign = sign(self.test.comparison);
        let test =
            if self.test.on_the_left { quote!(#x #sign #knot) } else { quote!(#knot #sign #x) };
        if self.test.negated == holds { quote!(!(#test)) } else { quote!((#test)) }
    }

    fn at(&self, row: &TokenStream) -> TokenStream {
        match &self.knots {
            Knots::Table(name) => self.with(&quote!(#name[#row]), true),
            Knots::Parameters(places) => self.with(&places.at(row), true),
        }
    }
}

/// The first row whose tests hold: by halving where the knots are in order, else one after the
/// other.
fn found(tests: &[Searched], begins: Option<Vec<bool>>, n: &Literal) -> TokenStream {
    let row = super::super::own("k");
    let all = |of: &mut dyn Iterator<Item = &Searched>| {
        let tests = of.map(|test| test.at(&quote!(#row)));
        let tests: Vec<TokenStream> = tests.collect();
        quote!(#(#tests)&&*)
    };
    let begins = begins.unwrap_or_default();
    let of = |begin: bool| {
        tests.iter().zip(&begins).filter(move |(_, begins)| **begins == begin).map(|(test, _)| test)
    };
    let beginning: Vec<&Searched> = of(true).collect();
    let first = match (beginning.as_slice(), begins.is_empty()) {
        ([], false) => quote!(0),
        ([test @ Searched { knots: Knots::Table(name), .. }], _) => {
            let knot = super::super::own("knot");
            let not_yet = test.with(&quote!(#knot), false);
            quote!(#name.partition_point(|&#knot| #not_yet))
        }
        _ => {
            let holds = all(&mut tests.iter());
            return quote!(::kin::emitted::first(#n, |#row| #holds));
        }
    };
    if of(false).next().is_none() {
        return first;
    }
    let ends = all(&mut of(false));
    quote!({ let #row = #first; if #row < #n && #ends { #row } else { #n } })
}

/// The columns of a table that are constants.
fn constants(g: &Graph, lookup: &Lookup) -> Vec<usize> {
    let is_constant = |&column: &usize| {
        lookup.columns[column].iter().all(|&node| g.constant_value(node).is_some())
    };
    (0..lookup.columns.len()).filter(is_constant).collect()
}

/// The table of the columns that are constants, where there are any.
fn cells(g: &Graph, lookup: &Lookup, name: &Ident) -> TokenStream {
    let columns = constants(g, lookup);
    if columns.is_empty() {
        return quote!();
    }
    let length = lookup.columns[columns[0]].len();
    let rows = (0..length).map(|row| {
        let cells = columns.iter().map(|&column| number_of(g, lookup.columns[column][row]));
        quote!([#(#cells),*])
    });
    let width = Literal::usize_unsuffixed(columns.len());
    let length = Literal::usize_unsuffixed(length);
    quote!(static #name: [[f64; #width]; #length] = [#(#rows),*];)
}

fn number_of(g: &Graph, node: Node) -> TokenStream {
    number(g.constant_value(node).unwrap_or(f64::NAN))
}

fn table(name: &str, number: usize) -> Ident {
    super::super::own(&format!("{name}{number}"))
}
