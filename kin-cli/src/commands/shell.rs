//! Completions for shells, manual pages, and the schema for editors.

use clap::CommandFactory;
use clap_complete::Shell;

use crate::arguments::Arguments;
use crate::fault::Fault;
use crate::output;

/// The completions of a shell.
pub fn completions(shell: Shell) -> Result<(), Fault> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "kin", &mut text);
    output::put("-", |to| to.write_all(&text))
}

/// The JSON Schema of mechanism files.
pub fn schema() -> Result<(), Fault> {
    let schema = kin::data::schema(&kin_text::registry());
    output::put("-", |to| {
        serde_json::to_writer_pretty(&mut *to, &schema)?;
        to.write_all(b"\n")
    })
}

/// The manual page of the whole, or of one command.
pub fn manual(of: Option<&str>) -> Result<(), Fault> {
    let mut all = Arguments::command();
    all.build();
    let page = match of {
        None => all,
        Some(name) => {
            let found = all.find_subcommand(name).cloned();
            found.ok_or_else(|| {
                Fault::Usage(format!("there is no command `{name}`. `kin help` lists all"))
            })?
        }
    };
    output::put("-", |to| clap_mangen::Man::new(page).render(&mut Box::new(to)))
}
