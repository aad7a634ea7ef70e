//! `tam-gen completions` and `tam-gen man`.

use clap::CommandFactory;
use tam_gen::command::shell::{self, CompletionsArgs, ManArgs};
use tam_gen::command::{Failure, Output};

use super::Outcome;
use super::args::Cli;

pub(super) const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  tam-gen completions bash > ~/.local/share/bash-completion/completions/tam-gen
  tam-gen completions zsh > ~/.zfunc/_tam-gen
  tam-gen completions fish > ~/.config/fish/completions/tam-gen.fish";

pub(super) const MAN_EXAMPLES: &str = "\
Examples:
  tam-gen man | man -l -                               read it
  tam-gen man -o ~/.local/share/man/man1               install the pages of all commands";

pub(super) fn completions(args: &CompletionsArgs, output: &Output) -> Result<Outcome, Failure> {
    shell::completions(Cli::command(), args, output)?;
    Ok(Outcome::Holds)
}

pub(super) fn man(args: &ManArgs, output: &Output) -> Result<Outcome, Failure> {
    shell::man(Cli::command(), args, output)?;
    Ok(Outcome::Holds)
}
