//! `tam-gen completions` and `tam-gen man`.

use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;
use serde_json::json;

use super::args::Cli;
use super::failure::Failure;
use super::output::Output;
use super::summary::path_text;
use super::{Outcome, files};

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  tam-gen completions bash > ~/.local/share/bash-completion/completions/tam-gen
  tam-gen completions zsh > ~/.zfunc/_tam-gen
  tam-gen completions fish > ~/.config/fish/completions/tam-gen.fish";

const MAN_EXAMPLES: &str = "\
Examples:
  tam-gen man | man -l -                               read it
  tam-gen man -o ~/.local/share/man/man1               install the pages of all commands";

#[derive(Debug, clap::Args)]
#[command(after_help = COMPLETIONS_EXAMPLES)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

#[derive(Debug, clap::Args)]
#[command(after_help = MAN_EXAMPLES)]
pub(super) struct ManArgs {
    /// Folder to write the pages of all commands into [default: the main page on standard output]
    #[arg(short, long = "output", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace pages that are there already
    #[arg(long)]
    force: bool,
}

pub(super) fn completions(args: &CompletionsArgs, output: &Output) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "tam-gen", &mut script);
    let text = String::from_utf8_lossy(&script);
    output.result(&text, || json!({ "shell": args.shell.to_string(), "script": text }))?;
    Ok(Outcome::Holds)
}

pub(super) fn man(args: &ManArgs, output: &Output) -> Result<Outcome, Failure> {
    let mut command = Cli::command();
    command.build();
    let Some(dir) = &args.out else {
        let page = render(&command)?;
        output.result(&page, || json!({ "page": page }))?;
        return Ok(Outcome::Holds);
    };
    let mut pages = Vec::new();
    collect(&command, &mut pages)?;
    let pages: Vec<(PathBuf, String)> = pages.into_iter().map(|(name, page)| (dir.join(name), page)).collect();
    for (path, _) in &pages {
        files::check_free(path, args.force)?;
    }
    for (path, page) in &pages {
        files::write(path, page.as_bytes(), args.force)?;
    }
    let paths: Vec<String> = pages.iter().map(|(path, _)| path_text(path)).collect();
    output.say(&format!("{}\n", paths.join("\n")))?;
    output.object(&json!({ "files": paths }))?;
    Ok(Outcome::Holds)
}

/// The pages of a command and of those below it, by file name.
fn collect(command: &clap::Command, pages: &mut Vec<(String, String)>) -> Result<(), Failure> {
    let name = command.get_display_name().unwrap_or(command.get_name());
    pages.push((format!("{name}.1"), render(command)?));
    for below in command.get_subcommands().filter(|below| below.get_name() != "help") {
        collect(below, pages)?;
    }
    Ok(())
}

fn render(command: &clap::Command) -> Result<String, Failure> {
    let mut page = Vec::new();
    Man::new(command.clone())
        .render(&mut page)
        .map_err(|error| Failure::write(Path::new("the manual page"), &error))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}
