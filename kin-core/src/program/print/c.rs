//! Prints a mechanism as one file of C99.

use std::collections::BTreeMap;
use std::fmt::Write;

use kin_graph::text::{C, Dialect, Infix, Piece};

use super::listing::{Line, Listing, Name, Value};
use super::operation::operation;
use super::pieces::laws;
use crate::law::Law;
use crate::program::tape::{Straight, Tape};

/// The text around the printed stages. Words between `@` are replaced.
const TEMPLATE: &str = include_str!("template.c");

/// The largest number of Newton steps.
const STEPS: usize = 12;

/// The stages of a tape in order: numbers of parameters alone, of the drivers, the correction, and
/// the rest.
const STAGES: [(&str, &str); 4] = [
    ("setup", "Numbers that depend on dimensions alone."),
    ("drive", "Numbers that depend on the drivers alone."),
    ("correct", "The correction of Newton's method."),
    (
        "rest",
        "The position, its velocities and accelerations, the equations as written, the pivots.",
    ),
];

/// A coordinate, driver or dimension in the comment of a file.
#[derive(Clone, Debug)]
pub(crate) struct Symbol {
    pub name: String,
    pub unit: String,
    pub value: f64,
}

/// A position that the library computed, with velocities and accelerations for given ones of the
/// drivers.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub u: Vec<f64>,
    pub ud: Vec<f64>,
    pub udd: Vec<f64>,
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
}

/// All data of a file.
pub(crate) struct Sheet<'a> {
    /// The prefix of all names of the file.
    pub name: String,
    /// The name of the mechanism.
    pub title: String,
    pub drivers: Vec<Symbol>,
    /// The laws of the drivers in the tape; empty if the only driver is the time.
    pub driver_laws: &'a [Law],
    pub coordinates: Vec<Symbol>,
    /// The dimensions whose values the file contains.
    pub folded: Vec<Symbol>,
    /// The dimensions that the file leaves free, with their names in C.
    pub free: Vec<(Symbol, String)>,
    /// For each free parameter of the tape its expression in C of the dimensions `d->NAME`.
    pub parameters: Vec<String>,
    /// The values of the free parameters.
    pub values: Vec<f64>,
    /// The name and the formula of each equation; `None` for a long formula.
    pub equations: Vec<(String, Option<String>)>,
    pub tape: &'a Tape,
    /// The size of each coordinate.
    pub sizes: Vec<f64>,
    /// For each coordinate true if it is an angle.
    pub turns: Vec<bool>,
    /// How far each equation may be off.
    pub allowed: Vec<f64>,
    /// The tolerance of the stop rule, and the permitted correction as a share of a coordinate.
    pub tolerance: f64,
    pub rounding: f64,
    /// The smallest pivot at the start, relative to the largest.
    pub pivot: f64,
    /// The requested measures: their names and coordinates.
    pub measures: Vec<(String, usize)>,
    /// The laws of the drivers and their first two derivatives, if they are formulas of time.
    pub laws: Option<Straight>,
    pub samples: Vec<Sample>,
}

impl Sheet<'_> {
    /// Returns true if the only driver is the time.
    pub(super) fn is_by_time(&self) -> bool {
        self.driver_laws.is_empty()
    }
}

/// Returns a text without anything that ends a comment or begins another one.
fn comment(text: &str) -> String {
    let plain = |c: char| if c.is_control() || c == '\\' || c == '?' { '_' } else { c };
    let visible = |c: char| if c.is_ascii() || c.is_alphanumeric() { plain(c) } else { '_' };
    text.chars().map(visible).collect::<String>().replace("*/", "*_").replace("/*", "/_")
}

/// Returns a string literal.
fn literal(text: &str) -> String {
    let mut literal = String::from("\"");
    for byte in text.chars().take(200).collect::<String>().bytes() {
        match byte {
            b' ' | b'.' | b'_' | b'-' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' => {
                literal.push(char::from(byte))
            }
            _ => {
                let _ = write!(literal, "\\{byte:03o}");
            }
        }
    }
    literal + "\""
}

/// Returns numbers as the content of a table; C has no empty tables.
fn table(numbers: &[f64]) -> String {
    match numbers {
        [] => "0.0".to_string(),
        _ => numbers.iter().map(|x| C.number(*x).text).collect::<Vec<_>>().join(", "),
    }
}

/// Returns lines broken between the numbers of a table, as C compilers and people read them.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::from("   ")];
    for word in text.split(' ') {
        if lines.last().is_some_and(|line| line.len() + word.len() > 94) {
            lines.push(String::from("   "));
        }
        if let Some(line) = lines.last_mut() {
            *line += " ";
            *line += word;
        }
    }
    format!("\n{}\n", lines.join("\n"))
}

/// Returns the content of a table on lines of its own.
pub(super) fn rows(numbers: &[f64]) -> String {
    wrapped(&table(numbers))
}

/// Returns a table of whole numbers.
fn whole(numbers: impl Iterator<Item = usize>) -> String {
    let all: Vec<String> = numbers.map(|number| number.to_string()).collect();
    if all.is_empty() { "0".to_string() } else { wrapped(&all.join(", ")) }
}

/// Prints the file.
pub(crate) fn file(sheet: &Sheet<'_>) -> String {
    let mut listing = Listing::of(sheet.tape, sheet.driver_laws);
    let outputs = outputs(sheet.tape, &listing);
    let all: Vec<Value> =
        outputs.iter().flatten().flat_map(|output| output.values.iter().copied()).collect();
    listing.keep(&all);
    let read: Vec<Vec<Value>> = outputs
        .iter()
        .map(|own| own.iter().flat_map(|output| output.values.iter().copied()).collect())
        .collect();
    let crossing = listing.crossing(&read);
    let printer = Printer { sheet, crossing: &crossing };
    let mut stages = String::new();
    let mut calls = String::new();
    for (k, lines) in listing.stages.iter().enumerate() {
        let own = &outputs[k];
        if lines.is_empty() && own.iter().all(|output| output.values.is_empty()) {
            continue;
        }
        stages += &printer.stage(k, lines, own);
        let _ = writeln!(calls, "    @N@_{}(k);", STAGES[k].0);
    }
    let stages = laws(&sheet.tape.laws, &stages) + &stages;
    let mut text = TEMPLATE.to_string();
    let tape = sheet.tape;
    let guards = tape.guards.concat().len();
    let mut put = |word: &str, by: &str| text = text.replace(&format!("@{word}@"), by);
    put("stages", &stages);
    put("calls", calls.trim_end());
    put("newton", &printer.newton(&stages));
    put("start", &printer.start());
    put("more", &printer.more());
    put("selftest", &printer.selftest());
    put("types", &printer.types());
    put("predict", &printer.predict());
    put("load", &printer.load());
    put("torn_tables", &printer.torn_tables());
    let is_free = !sheet.free.is_empty();
    put(
        "usage_start",
        match is_free {
            true => " *     int code = @N@_start(&s, &@N@_nominal); the assembled position",
            false => " *     int code = @N@_start(&s);    the assembled position",
        },
    );
    put(
        "start_arguments",
        if is_free { "@N@_state *s, const @N@_dimensions *d" } else { "@N@_state *s" },
    );
    put(
        "state_fields",
        &match is_free {
            true => format!(
                "    double p[{}]; /* numbers of the dimensions */\n",
                tape.parameters.len().max(1)
            ),
            false => String::new(),
        },
    );
    put("prototypes", &printer.prototypes());
    put("comment", &printer.comment());
    put("title", &comment(&sheet.title));
    put("version", env!("CARGO_PKG_VERSION"));
    let size = |n: usize| n.max(1).to_string();
    put("drivers", &sheet.drivers.len().to_string());
    put("coordinates", &sheet.coordinates.len().to_string());
    put("measures", &sheet.measures.len().to_string());
    put("p", &size(tape.parameters.len()));
    put("y", &size(tape.torn.len()));
    put("w", &size(crossing.len()));
    put("left", &size(tape.left.len()));
    put("c", &size(tape.verify.len()));
    put("g", &size(guards));
    put("c_count", &tape.verify.len().to_string());
    put("g_count", &guards.to_string());
    put("blocks", &size(tape.guards.len()));
    put("block_count", &tape.guards.len().to_string());
    put("block_sizes", &whole(tape.guards.iter().map(Vec::len)));
    put("sizes", &rows(&sheet.sizes));
    put("turns", &whole(sheet.turns.iter().map(|turns| usize::from(*turns))));
    put("allowed", &rows(&sheet.allowed));
    put("marks", &rows(&tape.chosen.concat()));
    put("u0", &table(&sheet.drivers.iter().map(|own| own.value).collect::<Vec<_>>()));
    put("q0", &rows(&sheet.coordinates.iter().map(|own| own.value).collect::<Vec<_>>()));
    put("pivot", &C.number(sheet.pivot).text);
    put("is_checked", if guards > 0 { "1" } else { "0" });
    let used: Vec<String> = C::HELPERS
        .iter()
        .filter(|(name, _)| text.contains(&format!("{name}(")))
        .map(|(_, definition)| format!("{definition}\n"))
        .collect();
    text.replace("@helpers@", &used.concat()).replace("@N@", &sheet.name)
}

/// The numbers that a stage writes into one field of the work structure.
struct Output {
    field: &'static str,
    values: Vec<Value>,
}

/// Returns the outputs of each stage.
fn outputs(tape: &Tape, listing: &Listing) -> [Vec<Output>; 4] {
    let of = |field, places: &[u32]| Output {
        field,
        values: places.iter().map(|place| listing.at(*place)).collect(),
    };
    let correct = vec![of("dy", &tape.correction), of("left", &tape.left)];
    let rest = vec![
        of("q", &tape.values),
        of("dq", &tape.corrections),
        of("qd", &tape.rates),
        of("qdd", &tape.second_rates),
        of("c", &tape.verify),
        of("g", &tape.guards.concat()),
    ];
    [Vec::new(), Vec::new(), correct, rest]
}

/// The printer of one file.
pub(super) struct Printer<'a> {
    pub sheet: &'a Sheet<'a>,
    /// The results that a later stage reads, with their places in `w`.
    crossing: &'a BTreeMap<Name, usize>,
}

impl Printer<'_> {
    /// Returns the text of a number that a stage reads.
    fn value(&self, stage: usize, value: Value) -> Piece {
        match value {
            Value::Number(x) => C.number(x),
            Value::Time if self.sheet.is_by_time() => Piece::atom("k->u[0]"),
            Value::Time => Piece::atom("t"),
            Value::Torn(k) => Piece::atom(format!("k->y[{k}]")),
            Value::Parameter(k) => Piece::atom(format!("k->p[{k}]")),
            Value::Driver(k, order) => {
                Piece::atom(format!("k->{}[{k}]", ["u", "ud", "udd"][usize::from(order)]))
            }
            Value::Result(name) if name.stage == stage => Piece::atom(format!("x{}", name.number)),
            Value::Result(name) => match self.crossing.get(&name) {
                Some(place) => Piece::atom(format!("k->w[{place}]")),
                None => C.number(f64::NAN),
            },
        }
    }

    /// Prints a stage as a function.
    fn stage(&self, number: usize, lines: &[Line], outputs: &[Output]) -> String {
        let (name, doc) = STAGES[number];
        let mut text = format!("/* {doc} */\nstatic void @N@_{name}(struct @N@_work *k)\n{{\n");
        for line in lines {
            let own = line.name.number;
            let piece = operation(&C, line, |value| self.value(number, value));
            let _ = writeln!(text, "    const double x{own} = {};", piece.text);
        }
        for line in lines {
            if let Some(place) = self.crossing.get(&line.name) {
                let _ = writeln!(text, "    k->w[{place}] = x{};", line.name.number);
            }
        }
        for Output { field, values } in outputs {
            for (k, value) in values.iter().enumerate() {
                let own = self.output(number, field, (k, *value), outputs);
                let coordinate = self.sheet.coordinates.get(k).filter(|_| *field == "q");
                let remark = coordinate
                    .map_or(String::new(), |own| format!(" /* {} */", comment(&own.name)));
                let _ = writeln!(text, "    k->{field}[{k}] = {own};{remark}");
            }
        }
        text + "}\n\n"
    }

    /// Returns the text of an output. The tape computes derivatives by the time; if the time is a
    /// driver, these are derivatives by u.
    fn output(
        &self,
        stage: usize,
        field: &str,
        (k, value): (usize, Value),
        outputs: &[Output],
    ) -> String {
        let own = self.value(stage, value);
        if !self.sheet.is_by_time() {
            return own.text;
        }
        let factor = |text: &str, x: &Piece| C.infix(&Piece::atom(text), Infix::Product, x);
        match field {
            "qd" => factor("k->ud[0]", &own).text,
            "qdd" => {
                let rates = outputs.iter().find(|output| output.field == "qd");
                let rate = rates.map_or(Value::Number(0.0), |output| output.values[k]);
                let square = factor("k->ud[0]", &factor("k->ud[0]", &own));
                let rest = factor("k->udd[0]", &self.value(stage, rate));
                C.infix(&square, Infix::Sum, &rest).text
            }
            _ => own.text,
        }
    }

    /// Prints the body of Newton's method; `stages` shows which stages there are.
    fn newton(&self, stages: &str) -> String {
        let tape = self.sheet.tape;
        let begin: String = ["setup", "drive"]
            .into_iter()
            .filter(|own| stages.contains(&format!("@N@_{own}(struct")))
            .map(|own| format!("    @N@_{own}(k);\n"))
            .collect();
        let correct = stages.contains("@N@_correct(struct");
        let last = "    for (i = 0; i < @N@_COORDINATES; i++) {\n        k->q[i] += k->dq[i];\n    }\n    return @N@_OK;";
        if tape.torn.is_empty() {
            let correct = if correct { "    @N@_correct(k);\n" } else { "" };
            return format!("    int i;\n{begin}{correct}    @N@_rest(k);\n{last}");
        }
        // The last correction of equations that can jump is applied before they are evaluated.
        let (at_end, last) = match tape.jumps() {
            true => (
                "            for (i = 0; i < @torn@; i++) {\n                k->y[i] += k->dy[i];\n            }\n            @N@_correct(k);\n",
                "    return @N@_OK;",
            ),
            false => ("", last),
        };
        let n = tape.torn.len();
        let tolerance = C.number(self.sheet.tolerance).text;
        let rounding = C.number(self.sheet.rounding).text;
        let left = tape.left.len();
        let body = format!(
            "    double previous = HUGE_VAL;
    int step, i;
{begin}    for (step = 0; ; step++) {{
        double largest = 0.0;
        int within = 1;
        @N@_correct(k);
        for (i = 0; i < {n}; i++) {{
            const double size = @N@_size[@N@_torn[i]];
            const double change = fabs(k->dy[i]);
            if (!isfinite(change)) {{
                return @N@_SINGULAR;
            }}
            within = within && change <= {tolerance} * size + {rounding} * fabs(k->y[i]);
            largest = fmax(largest, change / size);
        }}
        for (i = 0; i < {left}; i++) {{
            within = within && fabs(k->left[i]) <= 0.5 * @N@_allowed[@N@_row[i]];
        }}
        if (within || (largest > 0.5 * previous && largest <= 1e-9)) {{
{at_end}            break;
        }}
        if (step == {STEPS}) {{
            return @N@_NOT_CONVERGED;
        }}
        previous = largest;
        for (i = 0; i < {n}; i++) {{
            k->y[i] += k->dy[i];
        }}
    }}
    @N@_rest(k);
{last}"
        );
        body.replace("@torn@", &n.to_string())
    }

    fn torn_tables(&self) -> String {
        let tape = self.sheet.tape;
        if tape.torn.is_empty() {
            return String::new();
        }
        format!(
            "/* The coordinates that Newton's method computes, and the equations that it solves. */\nstatic const int @N@_torn[{}] = {{{}}};\nstatic const int @N@_row[{}] = {{{}}};\n",
            tape.torn.len(),
            whole(tape.columns.iter().copied()),
            tape.rows.len().max(1),
            whole(tape.rows.iter().copied()),
        )
    }

    fn predict(&self) -> String {
        match self.sheet.tape.torn.len() {
            0 => String::new(),
            n => format!(
                "    for (i = 0; i < {n}; i++) {{
        const int j = @N@_torn[i];
        k.y[i] = s->q[j] + v[j] + 0.5 * a[j];
    }}"
            ),
        }
    }

    fn load(&self) -> String {
        let tape = self.sheet.tape;
        let mut text = String::from(
            "    int i;
    for (i = 0; i < @N@_DRIVERS; i++) {
        k->u[i] = s->u[i];
    }",
        );
        if !tape.torn.is_empty() {
            let _ = write!(
                text,
                "\n    for (i = 0; i < {}; i++) {{\n        k->y[i] = s->q[@N@_torn[i]];\n    }}",
                tape.torn.len()
            );
        }
        if !self.sheet.free.is_empty() {
            let _ = write!(
                text,
                "\n    for (i = 0; i < {}; i++) {{\n        k->p[i] = s->p[i];\n    }}",
                tape.parameters.len()
            );
        }
        text
    }

    fn types(&self) -> String {
        if self.sheet.free.is_empty() {
            return String::new();
        }
        let mut text = String::from("/* The free dimensions. */\ntypedef struct {\n");
        for (symbol, field) in &self.sheet.free {
            let Symbol { name, unit, .. } = symbol;
            let _ =
                writeln!(text, "    double {field}; /* {} [{}] */", comment(name), comment(unit));
        }
        let values: Vec<f64> = self.sheet.free.iter().map(|(own, _)| own.value).collect();
        let _ = write!(
            text,
            "}} @N@_dimensions;\n\n/* Their values in the mechanism. */\nconst @N@_dimensions @N@_nominal = {{{}}};\n\n",
            table(&values)
        );
        text
    }

    fn prototypes(&self) -> String {
        let mut text = String::new();
        if self.sheet.laws.is_some() {
            text += "int @N@_at(@N@_state *s, double t);\nint @N@_rates_at(const @N@_state *s, double t, double qd[], double qdd[]);\n";
        }
        if !self.sheet.measures.is_empty() {
            text += "void @N@_measures(const double q[], double m[]);\nconst char *@N@_measure_name(int measure);\n";
        }
        text
    }

    /// Prints the start: a table, or Newton's method from the table if dimensions are free.
    fn start(&self) -> String {
        let fill = "    for (i = 0; i < @N@_DRIVERS; i++) {
        s->u[i] = @N@_u0[i];
    }
    for (i = 0; i < @N@_COORDINATES; i++) {
        s->q[i] = @N@_q0[i];
    }
";
        if self.sheet.free.is_empty() {
            return format!(
                "int @N@_start(@N@_state *s)\n{{\n    int i;\n{fill}    return @N@_OK;\n}}\n"
            );
        }
        let mut text = String::from(
            "int @N@_start(@N@_state *s, const @N@_dimensions *d)\n{\n    struct @N@_work k;\n    int i, code;\n",
        );
        text += fill;
        for (k, expression) in self.sheet.parameters.iter().enumerate() {
            let _ = writeln!(text, "    s->p[{k}] = {expression};");
        }
        text + "    @N@_load(s, &k);
    for (i = 0; i < @N@_DRIVERS; i++) {
        k.ud[i] = 0.0;
        k.udd[i] = 0.0;
    }
    code = @N@_newton(&k);
    if (code == @N@_OK) {
        code = @N@_check(&k);
    }
    if (code == @N@_OK) {
        code = @N@_compare(@N@_mark, k.g);
    }
    for (i = 0; i < @N@_COORDINATES; i++) {
        s->q[i] = k.q[i];
    }
    return code;
}
"
    }

    /// Prints the laws of time and the measures.
    fn more(&self) -> String {
        let mut text = String::new();
        if let Some(tape) = &self.sheet.laws {
            text += &self.laws(tape);
        }
        if !self.sheet.measures.is_empty() {
            text += "void @N@_measures(const double q[], double m[])\n{\n";
            for (k, (name, column)) in self.sheet.measures.iter().enumerate() {
                let _ = writeln!(text, "    m[{k}] = q[{column}]; /* {} */", comment(name));
            }
            text += "}\n\nconst char *@N@_measure_name(int measure)\n{\n    switch (measure) {\n";
            for (k, (name, _)) in self.sheet.measures.iter().enumerate() {
                let _ = writeln!(text, "    case {k}:\n        return {};", literal(name));
            }
            text += "    default:\n        return \"unknown measure\";\n    }\n}\n\n";
        }
        text
    }

    fn laws(&self, tape: &Straight) -> String {
        let mut listing = Listing::of_time(tape);
        let outputs: Vec<Value> = tape.outputs.iter().map(|place| listing.at(*place)).collect();
        listing.keep(&outputs);
        let lines = &listing.stages[0];
        let mut text = String::from(
            "/* The laws of time of the drivers. */\nstatic void @N@_laws(double t, double u[], double ud[], double udd[])\n{\n",
        );
        for line in lines {
            let piece = operation(&C, line, |value| self.value(0, value));
            let _ = writeln!(text, "    const double x{} = {};", line.name.number, piece.text);
        }
        let reads = |value: &Value| *value == Value::Time;
        if !outputs.iter().chain(lines.iter().flat_map(|line| &line.operands)).any(reads) {
            text += "    (void)t;\n";
        }
        for (k, orders) in outputs.chunks(3).enumerate() {
            for (field, value) in ["u", "ud", "udd"].iter().zip(orders) {
                let _ = writeln!(text, "    {field}[{k}] = {};", self.value(0, *value).text);
            }
        }
        text + "}

int @N@_at(@N@_state *s, double t)
{
    double u[@N@_DRIVERS], ud[@N@_DRIVERS], udd[@N@_DRIVERS];
    @N@_laws(t, u, ud, udd);
    return @N@_to(s, u);
}

int @N@_rates_at(const @N@_state *s, double t, double qd[], double qdd[])
{
    double u[@N@_DRIVERS], ud[@N@_DRIVERS], udd[@N@_DRIVERS];
    @N@_laws(t, u, ud, udd);
    return @N@_rates(s, ud, udd, qd, qdd);
}

"
    }

    /// Prints the comment at the beginning: drivers, coordinates, dimensions and equations.
    fn comment(&self) -> String {
        let Sheet { drivers, coordinates, folded, free, measures, equations, .. } = self.sheet;
        let mut text = String::new();
        let mut list = |title: &str, name: &str, all: &mut dyn Iterator<Item = &Symbol>| {
            let mut lines = String::new();
            for (k, Symbol { name: own, unit, value }) in all.enumerate() {
                let _ = writeln!(
                    lines,
                    " *     {}{} [{}]  {}",
                    if name.is_empty() { String::new() } else { format!("{name}[{k}]  ") },
                    comment(own),
                    comment(unit),
                    C.number(*value).text,
                );
            }
            if !lines.is_empty() {
                let _ = write!(text, " * {title}\n{lines} *\n");
            }
        };
        list("Drivers, with their units and values at the start:", "u", &mut drivers.iter());
        list(
            "Coordinates, with their units and values at the start:",
            "q",
            &mut coordinates.iter(),
        );
        list("Free dimensions:", "", &mut free.iter().map(|(own, _)| own));
        list("Dimensions, whose values the file contains:", "", &mut folded.iter());
        for (k, (name, _)) in measures.iter().enumerate() {
            let _ = writeln!(text, " * Measure m[{k}]: {}", comment(name));
        }
        text += " * Equations; each expression is 0:\n";
        for (name, formula) in equations {
            let formula = formula.as_deref().unwrap_or("(a long expression)");
            let _ = writeln!(text, " *     {}: {}", comment(name), comment(formula));
        }
        text.trim_end().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use kin_graph::text::identifier;

    #[test]
    fn no_name_ends_a_comment_or_a_literal() {
        for text in ["*/ system(\"x\")", "**//", "/*/", "a\n*/", "??/\n", "\\\n", "/**/", "*\u{0}/"]
        {
            let plain = comment(text);
            assert!(!plain.contains("*/") && !plain.contains("/*"), "{plain}");
            assert!(!plain.contains(['\n', '\\', '?']), "{plain}");
            let inner = literal(text);
            let inner = &inner[1..inner.len() - 1];
            assert!(!inner.contains(['"', '\n', '?']), "{inner}");
        }
        assert_eq!(identifier("*/ system(\"x\")"), "system_x");
    }
}
