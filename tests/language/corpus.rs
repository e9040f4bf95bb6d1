//! Constraints as textbooks and other people's programs write them, each compiled twice.

mod chains;
mod complex;
mod contact;
mod curves;
mod drives;
mod flow;
mod idioms;
mod iterators;
mod machines;
mod robots;
mod rotations;
mod splines;
mod surfaces;
mod tables;
mod types;
mod unread;

/// Constraints that take the slow route, each for a reason that is asserted where it stands:
/// nothing that is written in them says how often their loops turn.
const SLOW: [&str; 1] = ["wrapped_angle"];

#[test]
fn the_corpus_is_large_and_hardly_any_of_it_is_slow() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/language/corpus");
    let files =
        std::fs::read_dir(folder).expect("readable").map(|file| file.expect("a file").path());
    let text: String = files.map(|path| std::fs::read_to_string(path).expect("readable")).collect();
    let on_route = |route: &str| -> Vec<String> {
        let begin = format!("twice! {{ {route} ");
        let parts = text.split(&begin).skip(1);
        parts.map(|part| part.chars().take_while(|c| *c != '(').collect()).collect()
    };
    let symbolic = on_route("Symbolic");
    let slow = on_route("Dual");
    assert!(
        slow.len() == SLOW.len() && slow.iter().zip(SLOW).all(|(a, b)| a.ends_with(b)),
        "{slow:?}"
    );
    assert!(symbolic.len() > 250 && 20 * slow.len() < symbolic.len(), "{}", symbolic.len());
}
