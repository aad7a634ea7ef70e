//! The command `tam-viewer`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
