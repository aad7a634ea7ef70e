//! The command line: parse, turn into options, call the library.

mod args;
mod chart;
mod check;
mod generate;
mod presets;
mod sheet;
mod shell;
mod summary;
mod template;
mod watch;

use std::process::ExitCode;
use tam_gen::command::schema::schema;
use tam_gen::command::{Failure, Output, in_pool, interrupt, refused_arguments, start_log};

use clap::Parser;
use tam_gen::preset;

use args::{Cli, Command};

/// How a command that did its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// All is well.
    Holds,
    /// The work is done, and a constraint does not hold.
    ConstraintFails,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Holds => Self::SUCCESS,
            Outcome::ConstraintFails => Self::from(1),
        }
    }
}

/// Runs the command that the process was started with.
pub(crate) fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refused_arguments(&error),
    };
    let output = cli.common.output();
    start_log(cli.common.verbose);
    match in_pool(cli.common.threads, || dispatch(&cli.command, &output)) {
        Ok(outcome) => outcome.into(),
        Err(failure) => {
            output.failure(&failure);
            ExitCode::from(if matches!(failure, Failure::Interrupted) { interrupt::STATUS } else { 2 })
        }
    }
}

fn dispatch(command: &Command, output: &Output) -> Result<Outcome, Failure> {
    match command {
        Command::Generate(args) => generate::run(args, output),
        Command::Check(args) => check::run(args, output),
        Command::Sheet(args) => sheet::run(args, output),
        Command::Chart(args) => chart::run(args, output),
        Command::Presets(args) => presets::run(args, output),
        Command::Schema(args) => schema(&preset::schema_text(), args, output).map(|()| Outcome::Holds),
        Command::Watch(args) => watch::run(args, output),
        Command::Completions(args) => shell::completions(args, output),
        Command::Man(args) => shell::man(args, output),
    }
}
