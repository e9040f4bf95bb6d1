//! Reads expressions: sums, products, signs, powers, brackets and calls.
//!
//! The languages differ in their words and in the meaning of names; a [`Language`] states both.

/// The parts of an expression's text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Token<'a> {
    /// A text that begins like a number.
    Number(&'a str),
    Name(&'a str),
    /// A name in backticks; `None` if the closing backtick is missing.
    Quoted(Option<&'a str>),
    /// Any other character.
    Sign(char),
}

/// The values and rules of a language of expressions.
pub trait Language {
    /// The value of an expression.
    type Value;

    /// The signs that a language allows before an operand.
    const SIGNS: &'static [char] = &['-'];

    /// The operators between factors, besides `*` and `/`: `%` or none.
    const REMAINDER: bool = false;

    /// True if `a ^ b` is a power.
    const POWER: bool = false;

    /// True if a name can stand in backticks.
    const QUOTES: bool = false;

    /// The largest depth of nested brackets. It keeps the recursive reader within the stack.
    const DEEPEST: usize;

    /// Returns the number of bytes of a number at the beginning of the text.
    fn number_length(text: &str) -> usize;

    /// Returns true if a name can contain this character, as its first one or later.
    fn is_in_name(letter: char, first: bool) -> bool;

    /// Returns the words for a mistake.
    fn words(mistake: Mistake<'_>) -> String;

    /// Returns the value of a number. Errors: the text is no number.
    fn number(&mut self, text: &str) -> Result<Self::Value, String>;

    /// Returns the meaning of a name; `called` if a bracket follows. Errors: the name has none.
    fn name(&mut self, name: &str, called: bool) -> Result<Meaning<Self::Value>, String>;

    /// Returns the value of a function. Errors: there is no such function of these arguments.
    fn call(&mut self, name: &str, arguments: Vec<Self::Value>) -> Result<Self::Value, String>;

    /// Returns −a.
    fn negative(&mut self, a: Self::Value) -> Self::Value;

    /// Returns two numbers joined by one of the operators `+ - * / % ^`.
    fn two(&mut self, a: Self::Value, operator: char, b: Self::Value) -> Self::Value;
}

/// The meaning of a name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Meaning<V> {
    Value(V),
    /// A function, whose arguments follow in brackets.
    Function,
}

/// A mistake in an expression, apart from those of names and numbers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mistake<'a> {
    /// The text ends where an operand must follow.
    Ends,
    /// This part of the text cannot stand where it stands.
    Unexpected(&'a str),
    /// A bracket is not closed.
    OpenBracket,
    /// A closing backtick is missing.
    OpenQuote,
    /// Brackets are nested deeper than [`Language::DEEPEST`].
    Deep,
}

/// The tokens of a text in a language.
pub struct Tokens<'a, L> {
    rest: &'a str,
    language: std::marker::PhantomData<L>,
}

impl<'a, L: Language> Tokens<'a, L> {
    pub fn new(text: &'a str) -> Self {
        Tokens { rest: text, language: std::marker::PhantomData }
    }

    /// Returns the next token with its length, without the spaces before it.
    fn peek(&mut self) -> Option<(Token<'a>, usize)> {
        self.rest = self.rest.trim_start();
        let first = self.rest.chars().next()?;
        if first.is_ascii_digit() || first == '.' {
            let length = L::number_length(self.rest);
            return Some((Token::Number(&self.rest[..length]), length));
        }
        if first == '`' && L::QUOTES {
            let inner = &self.rest[1..];
            return Some(match inner.find('`') {
                Some(end) => (Token::Quoted(Some(&inner[..end])), end + 2),
                None => (Token::Quoted(None), self.rest.len()),
            });
        }
        if L::is_in_name(first, true) {
            let end = self.rest.find(|c| !L::is_in_name(c, false)).unwrap_or(self.rest.len());
            return Some((Token::Name(&self.rest[..end]), end));
        }
        Some((Token::Sign(first), first.len_utf8()))
    }

    /// Takes the next character and returns true if it is this sign.
    fn takes(&mut self, sign: char) -> bool {
        let there = matches!(self.peek(), Some((Token::Sign(next), _)) if next == sign);
        if there {
            self.rest = &self.rest[sign.len_utf8()..];
        }
        there
    }
}

impl<'a, L: Language> Iterator for Tokens<'a, L> {
    type Item = Token<'a>;

    fn next(&mut self) -> Option<Token<'a>> {
        let (token, length) = self.peek()?;
        self.rest = &self.rest[length..];
        Some(token)
    }
}

/// Reads an expression and returns its value. Errors: the first mistake, in the words of the
/// language.
pub fn read<L: Language>(text: &str, language: &mut L) -> Result<L::Value, String> {
    let mut reader = Reader { tokens: Tokens::new(text), depth: 0, language };
    let value = reader.sum()?;
    match reader.unexpected() {
        None => Ok(value),
        Some(mistake) => Err(L::words(mistake)),
    }
}

/// The rest of a text, with its language.
struct Reader<'a, 'l, L> {
    tokens: Tokens<'a, L>,
    depth: usize,
    language: &'l mut L,
}

impl<'a, L: Language> Reader<'a, '_, L> {
    /// Returns the mistake of the next token, if there is one.
    fn unexpected(&mut self) -> Option<Mistake<'a>> {
        let (_, length) = self.tokens.peek()?;
        Some(Mistake::Unexpected(&self.tokens.rest[..length]))
    }

    fn sum(&mut self) -> Result<L::Value, String> {
        self.joined(&['+', '-'], Self::product)
    }

    fn product(&mut self) -> Result<L::Value, String> {
        let operators: &[char] = if L::REMAINDER { &['*', '/', '%'] } else { &['*', '/'] };
        self.joined(operators, Self::signed)
    }

    /// Reads operands with operators between them, from left to right.
    fn joined(
        &mut self,
        operators: &[char],
        operand: impl Fn(&mut Self) -> Result<L::Value, String>,
    ) -> Result<L::Value, String> {
        let mut value = operand(self)?;
        while let Some(&operator) = operators.iter().find(|sign| self.tokens.takes(**sign)) {
            let right = operand(self)?;
            value = self.language.two(value, operator, right);
        }
        Ok(value)
    }

    fn signed(&mut self) -> Result<L::Value, String> {
        let mut negative = false;
        while let Some(sign) = L::SIGNS.iter().find(|sign| self.tokens.takes(**sign)) {
            negative ^= *sign == '-';
        }
        let value = self.power()?;
        Ok(if negative { self.language.negative(value) } else { value })
    }

    fn power(&mut self) -> Result<L::Value, String> {
        let base = self.single()?;
        if !L::POWER || !self.tokens.takes('^') {
            return Ok(base);
        }
        let negative = self.tokens.takes('-');
        let power = self.single()?;
        let power = if negative { self.language.negative(power) } else { power };
        Ok(self.language.two(base, '^', power))
    }

    fn single(&mut self) -> Result<L::Value, String> {
        let Some((token, length)) = self.tokens.peek() else {
            return Err(L::words(Mistake::Ends));
        };
        if token == Token::Sign('(') {
            return self.bracketed(Self::sum);
        }
        let text = &self.tokens.rest[..length];
        self.tokens.rest = &self.tokens.rest[length..];
        match token {
            Token::Number(text) => self.language.number(text),
            Token::Quoted(Some(name)) => self.named(name, false),
            Token::Quoted(None) => Err(L::words(Mistake::OpenQuote)),
            Token::Name(name) => {
                let called = matches!(self.tokens.peek(), Some((Token::Sign('('), _)));
                self.named(name, called)
            }
            Token::Sign(_) => Err(L::words(Mistake::Unexpected(text))),
        }
    }

    fn named(&mut self, name: &str, called: bool) -> Result<L::Value, String> {
        match self.language.name(name, called)? {
            Meaning::Value(value) => Ok(value),
            Meaning::Function => {
                let arguments = self.bracketed(|reader| {
                    let mut all = vec![reader.sum()?];
                    while reader.tokens.takes(',') {
                        all.push(reader.sum()?);
                    }
                    Ok(all)
                })?;
                self.language.call(name, arguments)
            }
        }
    }

    /// Reads the content of brackets.
    fn bracketed<T>(
        &mut self,
        inside: impl FnOnce(&mut Self) -> Result<T, String>,
    ) -> Result<T, String> {
        self.depth += 1;
        if self.depth > L::DEEPEST {
            return Err(L::words(Mistake::Deep));
        }
        self.tokens.takes('(');
        let value = inside(self)?;
        self.depth -= 1;
        if self.tokens.takes(')') { Ok(value) } else { Err(L::words(Mistake::OpenBracket)) }
    }
}
