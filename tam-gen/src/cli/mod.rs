//! The command line: parse, turn into options, call the library.

mod args;
mod check;
mod failure;
mod files;
mod generate;
mod interrupt;
mod output;
mod presets;
mod progress;
mod schema;
mod sheet;
mod shell;
mod source;
mod summary;
mod template;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use failure::Failure;
use output::Output;

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
        Err(error) => return output::refused_arguments(&error),
    };
    let output = Output { json: cli.common.json, quiet: cli.common.quiet };
    start_log(cli.common.verbose);
    match in_pool(cli.common.threads, || dispatch(&cli.command, &output)) {
        Ok(outcome) => outcome.into(),
        Err(failure) => {
            output.failure(&failure);
            failure.exit_code()
        }
    }
}

fn dispatch(command: &Command, output: &Output) -> Result<Outcome, Failure> {
    match command {
        Command::Generate(args) => generate::run(args, output),
        Command::Check(args) => check::run(args, output),
        Command::Sheet(args) => sheet::run(args, output),
        Command::Presets(args) => presets::run(args, output),
        Command::Schema(args) => schema::run(args, output),
        Command::Watch(args) => watch::run(args, output),
        Command::Completions(args) => shell::completions(args, output),
        Command::Man(args) => shell::man(args, output),
    }
}

/// Runs the work in a pool of so many threads, or in the usual one.
fn in_pool(threads: Option<u16>, work: impl FnOnce() -> Result<Outcome, Failure> + Send) -> Result<Outcome, Failure> {
    let Some(threads) = threads else { return work() };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build()
        .map_err(|error| Failure::usage(format!("--threads {threads}: {error}"), "use fewer threads"))?;
    pool.install(work)
}

fn start_log(verbose: u8) {
    let level = match verbose {
        0 => tracing::Level::WARN,
        1 => tracing::Level::INFO,
        _ => tracing::Level::DEBUG,
    };
    tracing_subscriber::fmt().with_max_level(level).with_writer(std::io::stderr).with_target(false).init();
}
