//! Random mechanisms with steps and kinks: whichever engine runs them, their verdicts, positions and events
//! are the same.

use kin::{Engine, Options};

use crate::steps::{Case, difference, random};

/// How many a test run takes; `KIN_CAMPAIGN=20000` is the whole campaign, for a release build.
fn count() -> u64 {
    std::env::var("KIN_CAMPAIGN").ok().and_then(|count| count.parse().ok()).unwrap_or(40)
}

#[test]
fn engines_agree_about_random_mechanisms_with_steps() {
    let (mut wrong, mut ran, mut failed) = (Vec::new(), 0, 0);
    for seed in 0..count() {
        let Case { words, system, times, loose, .. } = random(seed);
        let by = |engine| system.run_with(&times, &Options { engine, ..Options::default() });
        let plain = by(Engine::Plain);
        ran += usize::from(plain.is_ok());
        failed += usize::from(plain.is_err());
        let mut differ =
            difference(&plain, &by(Engine::Compiled), loose).map(|what| format!("compiled: {what}"));
        if differ.is_none() && system.compile().is_ok() {
            differ = difference(&plain, &by(Engine::Auto), loose).map(|what| format!("auto: {what}"));
        }
        wrong.extend(differ.map(|what| format!("{words}\n    {what}")));
    }
    println!("{ran} run, {failed} end with an error, engines differ about {}", wrong.len());
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        count(),
        wrong.iter().take(12).cloned().collect::<Vec<_>>().join("\n")
    );
    assert!(2 * ran > failed, "{ran} run and {failed} do not");
}
