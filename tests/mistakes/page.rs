//! The pages, and what is asked of every message.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::time::Instant;

use super::{Mistake, all};

/// So many are in the documentation; the others are in this folder.
const IN_DOCS: usize = 25;

const HEAD: &str = "# Mistakes, and the messages of Kin\n\nEach section shows one mistake: the faulty line of the program, and the message that Kin prints for it. A test \
checks each message word for word. The test then follows the advice of the message, and the mechanism moves.\n\nA message names first what a designer would check first. \
A wrong point or unit comes before a driver or a length. A driver or a length comes before a joint.\n";

/// Every mistake with its message.
static MESSAGES: LazyLock<Vec<(Mistake, String)>> = LazyLock::new(|| {
    let told = |mistake: Mistake| {
        let begun = Instant::now();
        let message = (mistake.told)(true).expect_err(mistake.title);
        println!("{:>9.1?} {}", begun.elapsed(), mistake.title);
        (mistake, message)
    };
    all().into_iter().map(told).collect()
});

fn page(mistakes: &[(Mistake, String)]) -> String {
    let mut page = HEAD.to_string();
    for (mistake, message) in mistakes {
        write!(
            page,
            "\n## {}\n\n```rust,ignore\n{}\n```\n```text\n{message}\n```\n",
            mistake.title, mistake.line
        )
        .unwrap();
    }
    page
}

fn check(path: &Path, page: &str) {
    if std::env::var_os("KIN_BLESS").is_some() {
        std::fs::write(path, page).unwrap();
    }
    let known = std::fs::read_to_string(path).unwrap_or_default();
    for (k, (known, new)) in known.lines().zip(page.lines()).enumerate() {
        assert_eq!(known, new, "{}:{}", path.display(), k + 1);
    }
    assert_eq!(known.lines().count(), page.lines().count(), "{}", path.display());
}

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
fn messages_are_word_for_word() {
    let all = &*MESSAGES;
    assert!(all.len() >= 40, "{}", all.len());
    check(&here("docs/mistakes.md"), &page(&all[..IN_DOCS]));
    check(&here("tests/mistakes/more.md"), &page(&all[IN_DOCS..]));
}

/// Names in a message are in backticks; that of the mechanism is not.
#[test]
fn what_a_designer_would_change_is_named_first() {
    let first = |(Mistake { culprit, .. }, message): &&(Mistake, String)| {
        let name = message.find('`').unwrap_or(message.len());
        message.find(culprit).is_some_and(|at| at <= name + 1)
    };
    let others: Vec<String> = MESSAGES
        .iter()
        .filter(|told| !first(told))
        .map(|(mistake, message)| format!("{}: {message}", mistake.title))
        .collect();
    assert!(
        others.len() * 10 <= MESSAGES.len(),
        "{} of {}:\n{}",
        others.len(),
        MESSAGES.len(),
        others.join("\n")
    );
}

#[test]
fn what_is_advised_leaves_a_mechanism_that_moves() {
    for Mistake { title, told, .. } in all() {
        let motion = told(false).unwrap_or_else(|message| panic!("{title}: {message}"));
        let first = motion.q(0);
        let last = motion.q(motion.len() - 1);
        let moved = first.iter().zip(last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(motion.len() > 1 && moved > 1e-3, "{title}: {moved}");
    }
}
