//! Runs all examples and writes an index of their pages: out/index.html.
//!
//! `cargo run --release --example gallery`

use std::process::Command;

use kin_view::Gallery;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let folder = env!("CARGO_MANIFEST_DIR");
    let mut names: Vec<String> = std::fs::read_dir(folder)?
        .filter_map(|file| file.ok()?.file_name().to_str()?.strip_suffix(".rs").map(String::from))
        .filter(|name| name.starts_with(|first: char| first.is_ascii_digit()))
        .collect();
    names.sort();

    let mut gallery = Gallery::new(
        "Kin: a gallery of mechanisms",
        "Each mechanism is one program of a page; click to see it move.",
    );
    for name in &names {
        println!("== {name}");
        run(name)?;
        let (title, text) = described(&std::fs::read_to_string(format!("{folder}/{name}.rs"))?);
        gallery = gallery.entry(name, &title, &text);
    }
    gallery.save("out")?;
    println!("\nwrote out/index.html: {} pages", names.len());
    Ok(())
}

/// Runs one example, built like this one.
fn run(name: &str) -> Result<(), Failure> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let profile: &[&str] = if cfg!(debug_assertions) { &[] } else { &["--release"] };
    let status =
        Command::new(cargo).args(["run", "--quiet", "--example", name]).args(profile).status()?;
    if status.success() { Ok(()) } else { Err(format!("the example {name} failed").into()) }
}

/// The title and the paragraph of what to see, from the first comment of a program.
fn described(program: &str) -> (String, String) {
    let comment: Vec<&str> =
        program.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim).collect();
    let title = comment
        .first()
        .and_then(|line| line.split_once(". ").map_or(Some(*line), |(first, _)| Some(first)));
    let paragraphs = comment.split(|line| line.is_empty()).map(|lines| lines.join(" "));
    let text =
        paragraphs.filter_map(|text| text.strip_prefix("What to see: ").map(String::from)).next();
    let mut letters = text.unwrap_or_default().chars().collect::<Vec<_>>();
    letters
        .first_mut()
        .into_iter()
        .for_each(|first| *first = first.to_uppercase().next().unwrap_or(*first));
    (title.unwrap_or_default().trim_end_matches('.').to_string(), letters.into_iter().collect())
}
