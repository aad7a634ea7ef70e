//! The only place that prints.
#![allow(clippy::print_stdout, reason = "printing is what a command line is for")]

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

use serde_json::{Value, json};

use super::Failure;

/// How results are printed.
#[derive(Debug, Clone, Copy)]
pub struct Output {
    /// One JSON object on standard output, and nothing else there.
    pub json: bool,
    /// Nothing but errors.
    pub quiet: bool,
}

impl Output {
    /// Prints for people, who may have asked for silence.
    ///
    /// # Errors
    /// Standard output takes nothing.
    pub fn say(&self, text: &str) -> Result<(), Failure> {
        if self.json || self.quiet { Ok(()) } else { print(text) }
    }

    /// Prints what the command was asked to print: as `text` for people, as `value` for machines.
    ///
    /// # Errors
    /// Standard output takes nothing.
    pub fn result(&self, text: &str, value: impl FnOnce() -> Value) -> Result<(), Failure> {
        if self.json { self.object(&value()) } else { print(text) }
    }

    /// Prints an object for machines, if they asked for one.
    ///
    /// # Errors
    /// Standard output takes nothing.
    pub fn object(&self, value: &Value) -> Result<(), Failure> {
        if self.json { print(&format!("{value}\n")) } else { Ok(()) }
    }

    /// Reports a failure: for machines on standard output, for people on standard error.
    pub fn failure(&self, failure: &Failure) {
        if self.json {
            // If standard output cannot take it, the exit status still tells.
            let _ = print(&format!("{}\n", json!({ "error": failure.to_json() })));
        } else {
            let _ = writeln!(stderr(), "{}", failure.report(colours()));
        }
    }

    /// Says something on standard error while work goes on.
    pub fn remark(&self, text: &str) {
        if !self.quiet {
            let _ = writeln!(stderr(), "{text}");
        }
    }
}

/// Whether standard error shows colours.
pub fn colours() -> bool {
    stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

fn print(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// Prints bytes on standard output. Whoever stopped listening is not told more; other trouble is reported.
///
/// # Errors
/// Standard output takes nothing.
pub fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Output { message: format!("cannot write to standard output: {error}"), help: None })
        }
        _ => Ok(()),
    }
}

/// Ends a run whose arguments ask for help, or make no sense.
pub fn refused_arguments(error: &clap::Error) -> ExitCode {
    let json = std::env::args_os().skip(1).any(|arg| arg == "--json");
    if error.use_stderr() && json {
        let message = error.render().to_string();
        let message = message.trim().strip_prefix("error: ").unwrap_or(message.trim()).to_owned();
        Output { json, quiet: false }.failure(&Failure::Usage { message, help: None });
    } else {
        let _ = error.print();
    }
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}
