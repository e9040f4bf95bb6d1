//! Completions and manual pages.

use crate::data;

const COMMANDS: [&str; 9] = [
    "run",
    "watch",
    "check",
    "diagnose",
    "assemblies",
    "measure",
    "prove",
    "sensitivities",
    "sweep",
];

#[test]
fn every_shell_completes_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let text = data(&["completions", shell]);
        for command in COMMANDS {
            assert!(text.contains(command), "{shell} does not know {command}");
        }
        assert!(text.contains("--times") || shell == "fish", "{shell}");
    }
}

#[test]
fn bash_takes_its_completions() {
    let script = data(&["completions", "bash"])
        + "\nCOMP_WORDS=(kin diag); COMP_CWORD=1; _kin kin diag kin; echo \"${COMPREPLY[@]}\"\n";
    let Ok(output) = std::process::Command::new("bash").args(["-c", &script]).output() else {
        return;
    };
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "diagnose");
}

#[test]
fn manual_pages_say_what_the_help_says() {
    let whole = data(&["manual"]);
    assert!(whole.contains(".TH kin 1") && whole.contains("Exit codes"), "{whole}");
    for command in COMMANDS {
        assert!(whole.contains(&format!("kin\\-{command}")), "{command}");
        let page = data(&["manual", command]);
        assert!(page.contains(".SH OPTIONS") && page.contains("error\\-format"), "{page}");
        assert!(data(&["help", command]).contains("Usage: kin"));
    }
}
