//! The source of each number of an equation: for each node, the innermost expression that made it.

use std::collections::HashMap;
use std::ops::Range;

use proc_macro2::{Delimiter, LineColumn, TokenStream, TokenTree};
use quote::ToTokens;

use super::Template;
use crate::error::first_span;
use kin_graph::Node;

/// An expression as the user wrote it, with its line and column, counted from 1.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Expression {
    pub text: String,
    pub line: usize,
    pub column: usize,
}

/// All known expressions, each once, with the nodes and templates that belong to them.
#[derive(Default)]
pub struct Expressions {
    pub all: Vec<Expression>,
    index: HashMap<Expression, usize>,
    /// The number of the expression, indexed by the node; `None` for a node without an expression.
    nodes: Vec<Option<usize>>,
    /// The number of the expression by the key of its template: an expression that only rustc
    /// understands becomes numbers later than the interpreter reads it.
    templates: HashMap<String, usize>,
}

impl Expressions {
    /// Returns the number of an expression, and adds the expression if it is new.
    pub fn number(&mut self, tokens: &dyn ToTokens) -> usize {
        let expression = Expression::new(tokens);
        *self.index.entry(expression.clone()).or_insert_with(|| {
            self.all.push(expression);
            self.all.len() - 1
        })
    }

    /// Ends an expression: those of the nodes `made` that belong to no inner expression belong to
    /// this one.
    pub fn ended(&mut self, tokens: &dyn ToTokens, made: Range<usize>) {
        if made.clone().any(|node| self.nodes.get(node).copied().flatten().is_none()) {
            let number = self.number(tokens);
            self.give(made, number);
        }
    }

    /// Assigns the nodes that belong to no expression yet to one.
    pub fn give(&mut self, made: Range<usize>, expression: usize) {
        self.nodes.resize(self.nodes.len().max(made.end), None);
        self.nodes[made].iter_mut().for_each(|node| *node = node.or(Some(expression)));
    }

    /// Returns the expression to which a node belongs.
    pub fn of(&self, node: Node) -> Option<usize> {
        self.nodes.get(node.index()).copied().flatten()
    }

    /// Records the expression of a template.
    pub fn note(&mut self, template: &Template, tokens: &dyn ToTokens) {
        let key = template.key();
        if !self.templates.contains_key(&key) {
            let number = self.number(tokens);
            self.templates.insert(key, number);
        }
    }

    /// Returns the expression that became a template.
    pub fn of_template(&self, template: &Template) -> Option<usize> {
        self.templates.get(&template.key()).copied()
    }
}

impl Expression {
    fn new(tokens: &dyn ToTokens) -> Self {
        let at = first_span(tokens).start();
        Expression {
            text: as_written(tokens.to_token_stream()),
            line: at.line,
            column: at.column + 1,
        }
    }
}

/// Returns the text of tokens on one line, without comments and at most one line long. Blanks are
/// those of the user, as far as the spans are known.
fn as_written(tokens: TokenStream) -> String {
    const LONGEST: usize = 100;
    let known = tokens
        .clone()
        .into_iter()
        .next()
        .is_some_and(|first| first.span().start() != first.span().end());
    let text = if known {
        let mut text = Text::default();
        text.append(tokens);
        text.written
    } else {
        crate::error::tidy(&tokens.to_string())
    };
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{} …", text[..end].trim_end()),
        None => text,
    }
}

/// A text, and the position in the file at which its last token ends.
#[derive(Default)]
struct Text {
    written: String,
    end: Option<LineColumn>,
}

impl Text {
    fn append(&mut self, tokens: TokenStream) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => {
                    let (open, close) = match group.delimiter() {
                        Delimiter::Parenthesis => ("(", ")"),
                        Delimiter::Bracket => ("[", "]"),
                        Delimiter::Brace => ("{", "}"),
                        Delimiter::None => ("", ""),
                    };
                    // A parsed group has kept only the span of the whole.
                    let start = group.span().start();
                    let end = group.span().end();
                    self.token(open, start, LineColumn { column: start.column + 1, ..start });
                    self.append(group.stream());
                    self.token(
                        close,
                        LineColumn { column: end.column.saturating_sub(1), ..end },
                        end,
                    );
                }
                token => self.token(&token.to_string(), token.span().start(), token.span().end()),
            }
        }
    }

    fn token(&mut self, token: &str, start: LineColumn, end: LineColumn) {
        if token.is_empty() {
            return;
        }
        let new_line = self.end.is_some_and(|end| end.line != start.line);
        let joined = self.end.is_none_or(|end| end == start)
            || new_line
                && (token.starts_with(['.', ')', ']']) || self.written.ends_with(['(', '[']));
        if !joined {
            self.written.push(' ');
        }
        self.written.push_str(token);
        self.end = Some(end);
    }
}

#[cfg(test)]
mod tests {
    use super::Expressions;
    use proc_macro2::TokenStream;

    #[test]
    fn a_node_belongs_to_the_innermost_expression() {
        let mut graph = kin_graph::Graph::default();
        let mut expressions = Expressions::default();
        let one = graph.constant(1.0);
        let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
        expressions.ended(&tokens("1.0"), 0..graph.len());
        let half = graph.constant(0.5);
        expressions.ended(&tokens("1.0 + 0.5"), 0..graph.len());
        let text = |node| expressions.of(node).map(|k| expressions.all[k].text.clone());
        assert_eq!(text(one).as_deref(), Some("1.0"));
        assert_eq!(text(half).as_deref(), Some("1.0 + 0.5"));
    }
}
