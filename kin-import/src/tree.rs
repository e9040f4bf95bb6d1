//! Reads lines by their indentation: a line contains the lines below it that are indented further.

use crate::imported::Mistake;

/// Deeper files are refused.
const DEEPEST: usize = 64;

/// A line and the lines that it contains.
#[derive(Debug, Default)]
pub struct Tree<'a> {
    /// The number of the line, counted from 1.
    pub line: usize,
    pub text: &'a str,
    pub inside: Vec<Tree<'a>>,
}

impl<'a> Tree<'a> {
    /// Reads the lines of a text that is indented by tabs.
    ///
    /// Errors: a line is indented too far.
    pub fn read(text: &'a str) -> Result<Tree<'a>, Mistake> {
        let mut open = vec![Tree::default()];
        for (k, line) in text.lines().enumerate() {
            let inside = line.trim_start_matches('\t');
            if inside.trim().is_empty() {
                continue;
            }
            let depth = line.len() - inside.len();
            let line = k + 1;
            if depth > DEEPEST || depth >= open.len() {
                return Err(Mistake::at(line, "the line is indented further than its block"));
            }
            close(&mut open, depth + 1);
            open.push(Tree { line, text: inside.trim(), inside: Vec::new() });
        }
        close(&mut open, 1);
        Ok(open.pop().unwrap_or_default())
    }

    /// Returns the first contained line with this text.
    pub fn get(&self, text: &str) -> Option<&Tree<'a>> {
        self.inside.iter().find(|tree| tree.text == text)
    }

    /// Returns the first contained line with this text.
    ///
    /// Errors: no contained line has this text.
    pub fn need(&self, text: &str) -> Result<&Tree<'a>, Mistake> {
        self.get(text)
            .ok_or_else(|| Mistake::at(self.line, format!("`{}` has no `{text}`", self.text)))
    }

    /// Returns the lines in the contained line with this text, or an empty list if no line has this
    /// text.
    pub fn all(&self, text: &str) -> &[Tree<'a>] {
        self.get(text).map_or(&[], |tree| &tree.inside)
    }

    /// Returns the value in the contained line with this text.
    pub fn value(&self, text: &str) -> Result<(&'a str, usize), Mistake> {
        let held = self.need(text)?;
        let value = held.inside.first();
        value
            .map(|value| (value.text, value.line))
            .ok_or_else(|| Mistake::at(held.line, format!("`{text}` has no value")))
    }

    /// Returns the numbers in the contained line with this text.
    pub fn numbers<const N: usize>(&self, text: &str) -> Result<[f64; N], Mistake> {
        let (value, line) = self.value(text)?;
        numbers(value, line)
    }

    /// Returns the rows of a matrix in the contained line with this text.
    pub fn matrix(&self, text: &str) -> Result<[[f64; 3]; 3], Mistake> {
        let held = self.need(text)?;
        let [x, y, z] = held.inside.as_slice() else {
            return Err(Mistake::at(
                held.line,
                format!("`{text}` has {} rows, not 3", held.inside.len()),
            ));
        };
        Ok([numbers(x.text, x.line)?, numbers(y.text, y.line)?, numbers(z.text, z.line)?])
    }
}

/// Puts what is deeper into what holds it.
fn close(open: &mut Vec<Tree<'_>>, depth: usize) {
    while open.len() > depth {
        if let Some(last) = open.pop()
            && let Some(holder) = open.last_mut()
        {
            holder.inside.push(last);
        }
    }
}

fn numbers<const N: usize>(text: &str, line: usize) -> Result<[f64; N], Mistake> {
    let number = |word: &str| {
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| Mistake::at(line, format!("`{word}` is not a number")))
    };
    let all = text.split_whitespace().map(number).collect::<Result<Vec<f64>, Mistake>>()?;
    let count = all.len();
    all.try_into()
        .map_err(|_| Mistake::at(line, format!("the line needs {N} numbers, but has {count}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_hold_what_is_indented_further() {
        let tree = Tree::read("a\n\tb\n\t\t1.0\t2 \n\tc\nd\n").unwrap();
        assert_eq!(tree.inside.len(), 2);
        let a = tree.need("a").unwrap();
        assert_eq!(a.numbers::<2>("b").unwrap(), [1.0, 2.0]);
        assert_eq!(
            a.numbers::<3>("b").unwrap_err().to_string(),
            "line 3: the line needs 3 numbers, but has 2"
        );
        assert_eq!(a.value("c").unwrap_err().to_string(), "line 4: `c` has no value");
        assert!(Tree::read("a\n\t\tb\n").is_err());
        assert!(Tree::read("").unwrap().inside.is_empty());
    }
}
