//! Names and texts in files that would like to be more than names: they do not come into terminals,
//! pictures or pages.

use serde_json::json;

use crate::{code, data, done, file, four_bar, place, words};

/// A four-bar whose crank has this name, everywhere.
fn named(name: &str, at: &str) -> String {
    let quoted = json!(name).to_string();
    let text =
        four_bar().to_string().replace("\"four-bar\"", &quoted).replace("\"crank\"", &quoted);
    file(at, &text)
}

#[test]
fn names_that_move_the_cursor_are_refused_and_shown_harmlessly() {
    for (k, name) in
        ["a\u{1b}[2J", "a\u{9b}31m", "a\nb", "a\u{202e}b", "a\rb", "\u{7}"].iter().enumerate()
    {
        let m = named(name, &format!("cursor_{k}.json"));
        for format in ["text", "json"] {
            let output = done(&["check", &m, "--error-format", format]);
            assert_eq!(code(&output), 5);
            let told = words(&output);
            assert!(told.contains("control character"), "{told}");
            assert!(
                !told.chars().any(|c| c.is_control() && c != '\n' || c == '\u{202e}'),
                "{told:?}"
            );
        }
    }
}

#[test]
fn texts_of_equations_that_move_the_cursor_are_shown_harmlessly() {
    let text = crate::SLOT.replace("s.y - k", "s.\\u001b[31mw - \\u202ek");
    let output = done(&["check", &file("cursor.json", &text)]);
    assert_eq!(code(&output), 5);
    assert!(
        !words(&output).chars().any(|c| c.is_control() && c != '\n' || c == '\u{202e}'),
        "{}",
        words(&output)
    );
}

#[test]
fn names_that_are_code_stay_names() {
    let name = "</script></style><script>alert(1)</script>\"'><img src=x onerror=alert(1)>&lt;";
    let m = named(name, "code.json");
    let [svg, page] =
        ["code.svg", "code.html"].map(|name| place(name).to_string_lossy().into_owned());
    let point = format!("<b>={name}:0,0");
    data(&["run", &m, "--times", "0:1:11", "--svg", &svg, "--page", &page, "--point", &point]);
    for path in [svg, page] {
        let text = std::fs::read_to_string(path).expect("readable");
        for code in ["<script>alert", "<img", "<b>", "</script></style>"] {
            assert!(!text.contains(code), "{code} in\n{}", &text[..2000.min(text.len())]);
        }
    }
}
