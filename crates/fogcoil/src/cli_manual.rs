//! `completions` and `man`: the program described by itself.

use std::path::{Path, PathBuf};

use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use fogcoil::Error;
use fogcoil::output::{self, Content};

use crate::cli::Cli;
use crate::print;
use crate::progress::Progress;

pub(crate) fn completions(shell: Shell) -> Result<(), Error> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "fogcoil", &mut script);
    print(&String::from_utf8_lossy(&script))
}

/// Prints the program's page, or writes it and one for each command into a folder.
pub(crate) fn man(dir: Option<&Path>, progress: &Progress) -> Result<(), Error> {
    let mut program = Cli::command();
    program.build();
    let Some(dir) = dir else { return print(&page(program)?) };
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    let named = commands.map(|command| {
        let name: &'static str = format!("fogcoil-{}", command.get_name()).leak();
        command.name(name)
    });
    let pages: Vec<Command> = std::iter::once(program.clone()).chain(named).collect();
    let pages: Vec<(PathBuf, String)> =
        pages.into_iter().map(|c| Ok((dir.join(format!("{}.1", c.get_name())), page(c)?))).collect::<Result<_, Error>>()?;
    output::make_folder(dir)?;
    let files: Vec<(&Path, Content)> = pages.iter().map(|(path, text)| (path.as_path(), Content::Text(text.clone()))).collect();
    progress.save(&files)
}

fn page(mut command: Command) -> Result<String, Error> {
    let mut page = Vec::new();
    // the page's own synopsis would show options without their values
    let usage = command.render_usage().to_string();
    let command = command.override_usage(usage.trim_start_matches("Usage: ").to_owned());
    Man::new(command).source(concat!("fogcoil ", env!("CARGO_PKG_VERSION"))).render(&mut page).map_err(Error::Stdout)?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}
