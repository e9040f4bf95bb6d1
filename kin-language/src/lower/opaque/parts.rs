//! The parts of the equation that only rustc can compute, each once: values, leaves with
//! derivatives, and laws.

use std::collections::HashMap;

use super::Template;
use crate::parse::Shape;
use kin_graph::{Graph, Node};

/// A value that only rustc can compute, with the shape that its place needs.
pub struct OpaqueValue {
    pub template: Template,
    pub kind: OpaqueKind,
}

/// The kind that the interpreter assumes for an opaque value.
#[derive(Clone, PartialEq, Debug)]
pub enum OpaqueKind {
    Numbers(Shape),
    Condition,
}

/// The opaque parts of an equation.
#[derive(Default)]
pub struct Parts {
    /// Values that depend on no coordinate, indexed by the number in the graph.
    pub opaques: Vec<OpaqueValue>,
    opaque_index: HashMap<String, usize>,
    /// The laws in the rows, indexed by the number in [`Op::Law`](kin_graph::Op::Law).
    pub laws: Vec<Template>,
    law_index: HashMap<String, usize>,
    /// Values that carry derivatives, indexed by the number in the graph.
    pub leaves: Vec<OpaqueValue>,
    leaf_index: HashMap<String, usize>,
}

impl Parts {
    pub fn is_empty(&self) -> bool {
        self.opaques.is_empty() && self.leaves.is_empty() && self.laws.is_empty()
    }

    /// Returns the number of a value that depends on no coordinate.
    pub fn opaque(&mut self, graph: &mut Graph, template: Template, kind: OpaqueKind) -> usize {
        let nodes = template.nodes();
        let key = format!("{} as {kind:?}", template.key());
        *self.opaque_index.entry(key).or_insert_with(|| {
            self.opaques.push(OpaqueValue { template, kind });
            graph.opaques.push(nodes);
            self.opaques.len() - 1
        })
    }

    /// Returns the number of a value that carries derivatives.
    pub fn leaf(&mut self, graph: &mut Graph, template: Template, kind: OpaqueKind) -> usize {
        let key = format!("{} as {kind:?}", template.key());
        *self.leaf_index.entry(key).or_insert_with(|| {
            let number = graph.leaf(self.leaves.len(), template.nodes());
            self.leaves.push(OpaqueValue { template, kind });
            number
        })
    }

    /// Returns the number of a law.
    pub fn law(&mut self, law: Template) -> usize {
        *self.law_index.entry(law.key()).or_insert_with(|| {
            self.laws.push(law);
            self.laws.len() - 1
        })
    }
}

/// Guards a template that may panic: emitted code does not compute it where a branch around it is
/// not taken, as far as that depends on parameters only. `conditions` hold at the present position.
pub fn guarded(graph: &mut Graph, template: Template, conditions: Vec<Node>) -> Template {
    if !template.may_panic() {
        return template;
    }
    let always = graph.bool(true);
    let constant =
        conditions.into_iter().filter(|&c| !graph.depends(c).varies()).collect::<Vec<_>>();
    let all = constant.into_iter().fold(always, |all, c| graph.and(all, c));
    match graph.truth(all) {
        Some(_) => template,
        None => Template::When(all, Box::new(template)),
    }
}

#[cfg(test)]
mod tests {
    use super::{OpaqueKind, Parts, guarded};
    use crate::lower::opaque::Template;
    use kin_graph::{Graph, Input};
    use quote::quote;

    #[test]
    fn a_part_has_one_number_for_each_kind() {
        let mut graph = Graph::default();
        let mut parts = Parts::default();
        let mut number = |kind| parts.opaque(&mut graph, Template::Tokens(quote!(K)), kind);
        let scalar = OpaqueKind::Numbers(crate::parse::Shape::Scalar);
        assert_eq!(number(scalar.clone()), 0);
        assert_eq!(number(OpaqueKind::Condition), 1);
        assert_eq!(number(scalar), 0);
        assert!(!parts.is_empty());
    }

    #[test]
    fn what_may_panic_waits_for_its_condition() {
        let mut graph = Graph::default();
        let k = graph.input(Input::Parameter(0));
        let zero = graph.zero();
        let holds = graph.compare(kin_graph::Comparison::Less, k, zero);
        let call: Template = {
            let f = Template::path(&syn::parse_quote!(f));
            Template::Call(Box::new(f), vec![], proc_macro2::Span::call_site())
        };
        assert!(matches!(guarded(&mut graph, call.clone(), vec![holds]), Template::When(..)));
        assert!(matches!(guarded(&mut graph, call, vec![]), Template::Call(..)));
    }
}
