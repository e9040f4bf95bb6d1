//! Choices of which only the branch that is taken is computed: all values that hang on one
//! condition come out of one `if`.

use super::*;
use kin_graph::schedule::Choice;

impl Kernel<'_> {
    /// Writes a choice, and names its values.
    pub(super) fn choice(&mut self, choice: &Choice) {
        // An input that both a branch and the code behind it read gets its name before.
        for &node in &choice.reads {
            if self.is_leaf_of_expression(node) {
                self.expression(node);
            }
        }
        let condition = self.expression(choice.condition);
        let (if_so, if_not) = choice.selections.iter().map(|&node| self.branches_of(node)).unzip();
        let (if_so, if_not): (Vec<Node>, Vec<Node>) = (if_so, if_not);
        let if_so = self.branch(&if_so);
        let if_not = self.branch(&if_not);
        let names: Vec<Ident> =
            choice.selections.iter().map(|&node| self.name_of_choice(node)).collect();
        self.statements
            .push(quote!(let (#(#names),*) = if #condition { #if_so } else { #if_not };));
    }

    fn branches_of(&self, selection: Node) -> (Node, Node) {
        match self.graph().op(selection) {
            Op::Select(_, if_so, if_not) => (if_so, if_not),
            _ => (selection, selection),
        }
    }

    fn name_of_choice(&mut self, selection: Node) -> Ident {
        self.operations += 1;
        let name = self.next_name("t");
        self.give_name(selection, quote!(#name));
        name
    }

    /// Code of a branch, with its values as a tuple; what it names is forgotten behind it.
    fn branch(&mut self, values: &[Node]) -> TokenStream {
        let outside = std::mem::take(&mut self.statements);
        let names = self.names.len();
        let evaluations = self.evaluations.clone();
        let mut results = vec![quote!(); values.len()];
        for group in self.order(values) {
            group.nodes.into_iter().for_each(|node| self.name(node));
            results[group.output] = self.expression(values[group.output]);
        }
        self.evaluations = evaluations;
        for node in self.names.drain(names..) {
            self.named.remove(&node);
        }
        let statements = std::mem::replace(&mut self.statements, outside);
        quote!(#(#statements)* (#(#results),*))
    }
}
