//! Options of every command, and what they set up.

use clap::builder::styling::{AnsiColor, Effects, Styles};

use super::{Failure, Output};

/// Colours of the help.
pub const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().effects(Effects::BOLD))
    .usage(AnsiColor::Green.on_default().effects(Effects::BOLD))
    .literal(AnsiColor::Cyan.on_default().effects(Effects::BOLD))
    .placeholder(AnsiColor::Cyan.on_default());

/// Options of every command.
#[derive(Debug, clap::Args)]
pub struct Common {
    /// Print one JSON object on standard output, also for errors
    #[arg(long, global = true, help_heading = "Common options")]
    pub json: bool,
    /// Print nothing but errors
    #[arg(long, short, global = true, help_heading = "Common options")]
    pub quiet: bool,
    /// Say on standard error what is being done; twice for more
    #[arg(long, short, global = true, action = clap::ArgAction::Count, help_heading = "Common options")]
    pub verbose: u8,
    /// Threads to use [default: as many as there are cores]; the result is the same for any number
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = "Common options")]
    pub threads: Option<u16>,
}

impl Common {
    /// How results are printed.
    pub fn output(&self) -> Output {
        Output { json: self.json, quiet: self.quiet }
    }
}

/// Runs the work in a pool of so many threads, or in the usual one.
///
/// # Errors
/// What the work returns, or that there can be no such pool.
pub fn in_pool<T: Send>(threads: Option<u16>, work: impl FnOnce() -> Result<T, Failure> + Send) -> Result<T, Failure> {
    let Some(threads) = threads else { return work() };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(threads))
        .build()
        .map_err(|error| Failure::usage(format!("--threads {threads}: {error}"), "use fewer threads"))?;
    pool.install(work)
}

/// Sends the log to standard error: warnings, or more the more often `--verbose` was given.
pub fn start_log(verbose: u8) {
    let level = match verbose {
        0 => tracing::Level::WARN,
        1 => tracing::Level::INFO,
        _ => tracing::Level::DEBUG,
    };
    tracing_subscriber::fmt().with_max_level(level).with_writer(std::io::stderr).with_target(false).init();
}
