//! A source file, the places in it at which something can be changed, and the file with all of that
//! in it.

use std::collections::BTreeMap;
use std::ops::Range;

/// How the alternatives of a place are put into the code.
#[derive(Clone, Copy, PartialEq)]
pub enum Shape {
    /// Instead of an expression.
    Instead,
    /// A statement that can be left out.
    Statement,
    /// Returned at the beginning of a function.
    Early,
    /// A match arm that is never taken: at the end of its pattern, or around its guard.
    Arm,
}

/// A place in a file, and what may stand there instead.
pub struct Site {
    pub range: Range<usize>,
    pub shape: Shape,
    pub function: String,
    /// Where a constant is read: the file in which it is defined. All uses of it change together.
    pub constant: Option<String>,
    pub alternatives: Vec<Alternative>,
    /// The number of its first mutant.
    pub first: usize,
}

#[derive(Clone)]
pub struct Alternative {
    /// Rust source.
    pub text: String,
    /// How it is told to people.
    pub label: String,
    /// False after the compiler has refused it.
    pub compiles: bool,
}

impl Alternative {
    pub fn new(text: impl Into<String>, label: impl Into<String>) -> Self {
        Alternative { text: text.into(), label: label.into(), compiles: true }
    }
}

/// A file with its places, outer ones before those inside them.
pub struct Source {
    /// From the root of the repository.
    pub path: String,
    pub text: String,
    pub sites: Vec<Site>,
}

/// One change of one place.
#[derive(Clone)]
pub struct Mutant {
    pub number: usize,
    /// The number of the first mutant of its place.
    pub site: usize,
    pub path: String,
    pub line: usize,
    pub function: String,
    /// The code, `⟦…⟧` around what is changed.
    pub code: String,
    pub label: String,
}

impl Mutant {
    /// The name by which the list knows it, without a line, so that it stays the same while the
    /// file changes elsewhere.
    pub fn key(&self) -> String {
        format!("{} | {} | {} | {}", self.path, self.function, self.code, self.label)
    }

    /// All changes of its place.
    pub fn place(&self) -> String {
        format!("{} | {} | {} | *", self.path, self.function, self.code)
    }
}

/// Gives every mutant its number, counted from 1.
pub fn number(sources: &mut [Source]) {
    let mut next = 1;
    let mut constants: BTreeMap<(String, String), usize> = BTreeMap::new();
    for site in sources.iter_mut().flat_map(|source| &mut source.sites) {
        site.first = next;
        if let Some(file) = &site.constant {
            site.first = *constants.entry((file.clone(), site.function.clone())).or_insert(next);
        }
        if site.first == next {
            next += site.alternatives.len();
        }
    }
}

/// All mutants, each once.
fn all(sources: &[Source]) -> BTreeMap<usize, (Mutant, bool)> {
    let mut all: BTreeMap<usize, (Mutant, bool)> = BTreeMap::new();
    let mut seen: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (source, site) in
        sources.iter().flat_map(|source| source.sites.iter().map(move |site| (source, site)))
    {
        for (k, alternative) in site.alternatives.iter().enumerate() {
            let mut mutant = Mutant {
                number: site.first + k,
                site: site.first,
                path: site.constant.as_ref().unwrap_or(&source.path).clone(),
                line: source.text[..site.range.start].matches('\n').count() + 1,
                function: site.function.clone(),
                code: source.excerpt(site),
                label: alternative.label.clone(),
            };
            // places that look alike are counted
            let like = seen.entry(mutant.place()).or_default();
            if !like.contains(&mutant.site) {
                like.push(mutant.site);
            }
            if like.len() > 1 {
                mutant.code += &format!(" #{}", like.len());
            }
            let known = all.entry(mutant.number).or_insert((mutant, false));
            known.1 |= alternative.compiles;
        }
    }
    all
}

/// All mutants that compile.
pub fn mutants(sources: &[Source]) -> Vec<Mutant> {
    all(sources).into_values().filter_map(|(mutant, compiles)| compiles.then_some(mutant)).collect()
}

/// The names of those that do not.
pub fn refused(sources: &[Source]) -> Vec<String> {
    all(sources)
        .into_values()
        .filter_map(|(mutant, compiles)| (!compiles).then(|| mutant.key()))
        .collect()
}

/// Leaves out what the compiler has refused before.
pub fn refuse(sources: &mut [Source], refused: &[String]) {
    let known: Vec<usize> = all(sources)
        .into_values()
        .filter(|(mutant, _)| refused.contains(&mutant.key()))
        .map(|(mutant, _)| mutant.number)
        .collect();
    for site in sources.iter_mut().flat_map(|source| &mut source.sites) {
        let first = site.first;
        site.alternatives
            .iter_mut()
            .enumerate()
            .for_each(|(k, alternative)| alternative.compiles &= !known.contains(&(first + k)));
    }
}

impl Source {
    /// The code of a place with a little of what stands around it.
    fn excerpt(&self, site: &Site) -> String {
        const AROUND: usize = 28;
        if site.shape == Shape::Early || site.constant.is_some() {
            return "all of it".to_string();
        }
        let inside: Vec<char> = self.text[site.range.clone()]
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .chars()
            .collect();
        let shown: String = match inside.len() {
            0..=60 => inside.iter().collect(),
            n => inside[..36].iter().chain(&[' ', '…', ' ']).chain(&inside[n - 20..]).collect(),
        };
        let line_start = self.text[..site.range.start].rfind('\n').map_or(0, |at| at + 1);
        let before: Vec<char> =
            self.text[line_start..site.range.start].trim_start().chars().collect();
        let before: String = before[before.len().saturating_sub(AROUND)..].iter().collect();
        let after: String = self.text[site.range.end..]
            .lines()
            .next()
            .unwrap_or_default()
            .chars()
            .take(AROUND)
            .collect();
        format!("{before}⟦{shown}⟧{}", after.trim_end())
    }

    /// The file with all its mutants in it, each between comments with its number.
    pub fn instrumented(&self) -> String {
        self.render(0..self.text.len(), &self.sites)
    }

    fn render(&self, range: Range<usize>, mut sites: &[Site]) -> String {
        let mut text = String::new();
        let mut at = range.start;
        while let Some((site, others)) = sites.split_first() {
            let inside =
                others.iter().take_while(|inner| inner.range.start < site.range.end).count();
            text += &self.text[at..site.range.start];
            text += &site.wrap(&self.render(site.range.clone(), &others[..inside]));
            (at, sites) = (site.range.end, &others[inside..]);
        }
        text + &self.text[at..range.end]
    }
}

impl Site {
    /// The code here, and what may stand instead; the code comes first, so that types are found
    /// from it.
    fn wrap(&self, original: &str) -> String {
        let first = self.first;
        let count = self.alternatives.len();
        let compiling =
            || self.alternatives.iter().enumerate().filter(|(_, alternative)| alternative.compiles);
        if compiling().next().is_none() {
            return original.to_string();
        }
        let arms = |keyword: &str| -> String {
            let arm = |(k, alternative): (usize, &Alternative)| {
                let number = first + k;
                format!("{} => {keyword}/*<{number}*/{}/*>*/, ", k + 1, alternative.text)
            };
            compiling().map(arm).collect()
        };
        let at = format!("crate::mutants::at({first}, {count})");
        let text = match self.shape {
            Shape::Instead => {
                format!(
                    "(match {at} {{ 0 => {original}, {}_ => ::std::unreachable!() }})",
                    arms("")
                )
            }
            Shape::Statement => format!("if {at} == 0 {{ {original} }}"),
            Shape::Early => format!(" match {at} {{ {}_ => {{}} }}", arms("return ")),
            Shape::Arm if original.is_empty() => format!(" if {at} == 0"),
            Shape::Arm => format!("{at} == 0 && ({original})"),
        };
        format!("/*[{first}*/{text}/*]*/")
    }
}
