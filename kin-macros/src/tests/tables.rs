//! Tables as they are emitted: however they are searched, one piece is computed, and its numbers
//! are read from a row that is found once.

use proc_macro2::{TokenStream, TokenTree};

use super::attributes::{Attributed, attributed, compiled};

/// The text of a function of an expansion.
fn function(constraint: &Attributed, name: &str) -> String {
    let file = compiled(constraint.expand())
        .unwrap_or_else(|error| panic!("{}: {error}", constraint.name));
    let text = prettyplease::unparse(&file);
    let begin = text
        .find(&format!("fn {name}("))
        .unwrap_or_else(|| panic!("{}: no {name}", constraint.name));
    let rest = &text[begin..];
    rest[..rest.find("\n        }\n").unwrap_or(rest.len())].to_string()
}

/// The functions of the language's tests of tables.
fn tables() -> Vec<Attributed> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/language/tables.rs");
    let source = std::fs::read_to_string(path).unwrap_or_default();
    let tokens: Vec<TokenTree> =
        source.parse().map(TokenStream::into_iter).into_iter().flatten().collect();
    let of = |three: &[TokenTree]| match three {
        [TokenTree::Ident(word), _, TokenTree::Group(group)] if word == "twice" => {
            let inside: Vec<TokenTree> = group.stream().into_iter().collect();
            let name = inside.get(1).map(ToString::to_string).unwrap_or_default();
            let item = inside.into_iter().skip_while(|token| token.to_string() != "fn").collect();
            Some(Attributed {
                name,
                mark: "constraint".to_string(),
                arguments: TokenStream::new(),
                item,
            })
        }
        _ => None,
    };
    tokens.windows(3).filter_map(of).collect()
}

#[test]
fn however_a_table_is_searched_its_numbers_are_looked_up() {
    let all = tables();
    assert_eq!(all.len(), 12);
    for constraint in all {
        let text = function(&constraint, "linearize");
        let name = &constraint.name;
        assert!(text.contains("let row0: usize"), "{name}: {text}");
        // Of a table in a table the outer one is a choice.
        let branches = text.matches("= if ").count();
        let most = match name.as_str() {
            "of_parameters" => 1,
            "by_cell" => 2,
            _ => 0,
        };
        assert!(branches <= most, "{name}: {branches} branches in {text}");
        // Few knots are compared one after the other.
        assert!(
            text.contains("emitted::first(") && !text.contains("partition_point"),
            "{name}: {text}"
        );
    }
}

/// A spline of so many pieces, as a table of constants.
fn spline(n: usize) -> Attributed {
    let knots: Vec<String> = (0..n).map(|k| format!("{}.5", k)).collect();
    let pieces: Vec<String> = (0..n).map(|k| format!("[{k}.25, 0.3, -{k}.7, 0.2]")).collect();
    let knots = knots.join(", ");
    let pieces = pieces.join(", ");
    let last = n - 1;
    let text = format!(
        "#[constraint] fn spline(x: Coord, y: Coord) -> f64 {{
            const KNOTS: [f64; {n}] = [{knots}];
            const PIECES: [[f64; 4]; {n}] = [{pieces}];
            for k in 0..{n} {{
                if x < KNOTS[k] || k == {last} {{
                    let ([a, b, c, d], s) = (PIECES[k], x - KNOTS[k]);
                    return y - (a + s * (b + s * (c + s * d)));
                }}
            }}
            0.0
        }}"
    );
    let found = attributed(text.parse().unwrap_or_else(|error| panic!("{error}")));
    found.into_iter().next().unwrap_or_else(|| panic!("no constraint"))
}

#[test]
fn a_longer_table_is_a_longer_table_and_no_more_code() {
    let calls = |n: usize, name: &str| {
        let text = spline(n).expand().to_string();
        let begin = text.find(&format!("fn {name}")).unwrap_or_else(|| panic!("no {name}"));
        let body = &text[begin..];
        let end = body[1..].find("fn ").map_or(body.len(), |end| end + 1);
        assert_eq!(body[..end].contains("partition_point"), n == 200, "{}", &body[..end]);
        ["fma (", "put (", "if ", "let "].map(|word| body[..end].matches(word).count())
    };
    for name in ["linearize", "acceleration_rhs"] {
        assert_eq!(calls(20, name), calls(200, name));
    }
}
