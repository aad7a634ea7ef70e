//! The command line: parse, turn into options, call the library.

mod adapters;
#[cfg(feature = "app")]
mod app;
mod args;
mod chart;
mod compare;
mod field;
mod fit;
mod meshes;
mod object;
mod objects;
mod render;
mod report;
mod source;
mod stability;
mod stage;
mod subject;
mod surface;
mod turntable;
mod view;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use tam_gen::command::schema::schema;
use tam_gen::command::{Failure, Output, in_pool, interrupt, refused_arguments, shell, start_log};

use args::{Cli, Command};
use tam_viewer::scene_file;

/// Runs the command that the process was started with.
pub(crate) fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return refused_arguments(&error),
    };
    let output = cli.common.output();
    start_log(cli.common.verbose);
    // A window must be on the first thread of the process, which no pool has.
    #[cfg(feature = "app")]
    let done = match &cli.command {
        None => app::run(&app::AppArgs::default()).map(|()| ExitCode::SUCCESS),
        Some(Command::App(args)) => app::run(args).map(|()| ExitCode::SUCCESS),
        Some(command) => in_pool(cli.common.threads, || dispatch(command, &output)),
    };
    #[cfg(not(feature = "app"))]
    let done = match &cli.command {
        None => Err(Failure::usage("no command was given", "this build has no window; see --help")),
        Some(command) => in_pool(cli.common.threads, || dispatch(command, &output)),
    };
    match done {
        Ok(status) => status,
        Err(failure) => {
            output.failure(&failure);
            ExitCode::from(match failure {
                Failure::Interrupted => interrupt::STATUS,
                Failure::Usage { .. } => 2,
                _ => 1,
            })
        }
    }
}

/// The exit status of a command that did its work.
fn dispatch(command: &Command, output: &Output) -> Result<ExitCode, Failure> {
    let done = match command {
        #[cfg(feature = "app")]
        Command::App(args) => app::run(args),
        Command::Render(args) => render::run(args, output),
        Command::Compare(args) => compare::run(args, output),
        Command::Chart(args) => chart::run(args, output),
        Command::Fit(args) => fit::run(args, output),
        Command::Stability(args) => return stability::run(args, output),
        Command::Turntable(args) => turntable::run(args, output),
        Command::Field(args) => field::run(args, output),
        Command::Schema(args) => schema(&scene_file::schema_text(), args, output),
        Command::Meshes(args) => meshes::run(args, output),
        Command::Adapters(args) => adapters::run(args, output),
        Command::Completions(args) => shell::completions(Cli::command(), args, output),
        Command::Man(args) => shell::man(Cli::command(), args, output),
    };
    done.map(|()| ExitCode::SUCCESS)
}
