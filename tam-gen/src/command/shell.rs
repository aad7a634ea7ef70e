//! Completions and manual pages of a command.

use std::path::{Path, PathBuf};

use clap_complete::Shell;
use clap_mangen::Man;
use serde_json::json;

use super::words::path_text;
use super::{Failure, Output, files};

/// Which completions.
#[derive(Debug, clap::Args)]
pub struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Where manual pages go.
#[derive(Debug, clap::Args)]
pub struct ManArgs {
    /// Folder to write the pages of all commands into [default: the main page on standard output]
    #[arg(short, long = "output", value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace pages that are there already
    #[arg(long)]
    force: bool,
}

/// Prints the completions of a command for a shell.
///
/// # Errors
/// Standard output takes nothing.
pub fn completions(mut command: clap::Command, args: &CompletionsArgs, output: &Output) -> Result<(), Failure> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(args.shell, &mut command, name, &mut script);
    let text = String::from_utf8_lossy(&script);
    output.result(&text, || json!({ "shell": args.shell.to_string(), "script": text }))
}

/// Prints the manual page of a command, or writes those of it and all below it.
///
/// # Errors
/// The pages cannot be written, or are there already.
pub fn man(mut command: clap::Command, args: &ManArgs, output: &Output) -> Result<(), Failure> {
    command.build();
    let Some(dir) = &args.out else {
        let page = render(&command)?;
        return output.result(&page, || json!({ "page": page }));
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
    output.object(&json!({ "files": paths }))
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
