//! Where the numbers of an equation come from: of each node the innermost expression that was being
//! read when it was made.

use std::collections::HashMap;
use std::ops::Range;

use proc_macro2::{Delimiter, LineColumn, TokenStream, TokenTree};
use quote::ToTokens;

use super::template::Template;
use kin_graph::Node;

/// An expression as the user wrote it, and where: line and column counted from 1.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Expression {
    pub text: String,
    pub line: usize,
    pub column: usize,
}

/// All expressions that are known, each once, and what belongs to them.
#[derive(Default)]
pub struct Expressions {
    pub all: Vec<Expression>,
    index: HashMap<Expression, usize>,
    /// By the node's number.
    nodes: Vec<Option<usize>>,
    /// By the template's key: an expression that only rustc understands becomes numbers later than
    /// it is read.
    templates: HashMap<String, usize>,
}

impl Expressions {
    /// The number of an expression.
    pub fn number(&mut self, tokens: &dyn ToTokens) -> usize {
        let expression = Expression::new(tokens);
        *self.index.entry(expression.clone()).or_insert_with(|| {
            self.all.push(expression);
            self.all.len() - 1
        })
    }

    /// An expression has been read: nodes made by it that are of no expression inside of it are its
    /// own.
    pub fn ended(&mut self, tokens: &dyn ToTokens, made: Range<usize>) {
        if made.clone().any(|node| self.nodes.get(node).copied().flatten().is_none()) {
            let number = self.number(tokens);
            self.give(made, number);
        }
    }

    /// Nodes that are of no expression yet belong to one from now on.
    pub fn give(&mut self, made: Range<usize>, expression: usize) {
        self.nodes.resize(self.nodes.len().max(made.end), None);
        self.nodes[made].iter_mut().for_each(|node| *node = node.or(Some(expression)));
    }

    /// The expression that a node is of.
    pub fn of(&self, node: Node) -> Option<usize> {
        self.nodes.get(node.index()).copied().flatten()
    }

    /// An expression that only rustc understands has been read.
    pub fn note(&mut self, template: &Template, tokens: &dyn ToTokens) {
        let key = template.key();
        if !self.templates.contains_key(&key) {
            let number = self.number(tokens);
            self.templates.insert(key, number);
        }
    }

    /// The expression that became a template.
    pub fn of_template(&self, template: &Template) -> Option<usize> {
        self.templates.get(&template.key()).copied()
    }
}

impl Expression {
    fn new(tokens: &dyn ToTokens) -> Self {
        let at = super::first_span(tokens).start();
        Expression {
            text: as_written(tokens.to_token_stream()),
            line: at.line,
            column: at.column + 1,
        }
    }
}

/// The text of tokens: on one line, without comments, with blanks where the user has them (as far
/// as places are known), and no longer than a line.
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

/// A text, and where its last token ends in the file.
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
                    // Of a group that has been parsed only the span of the whole is left.
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
