//! `tam-viewer stability`.

mod page;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use serde_json::{Value, json};
use tam_gen::chart::figure;
use tam_gen::command::words::{counted, duration, milliseconds, path_text};
use tam_gen::command::{Failure, Output, Progress, files, interrupt};
use tam_viewer::Renderer;
use tam_viewer::gpu::Gpu;
use tam_viewer::stability::{CAUSES, Hardened, Literal, Outcome, Stand, Verdict, cases};

use super::report as failure;
use super::view::AdapterArgs;

const EXAMPLES: &str = "\
Examples:
  tam-viewer stability                                 a line for each case
  tam-viewer stability --report stability.html         and a page with pictures of both forms
  tam-viewer stability --adapter llvmpipe --json       on another adapter, for machines

Exit status: 0 if every case is as it says it is, also those that are known to fail still; 1 if one is not.";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct StabilityArgs {
    /// Write a page with figures and pictures of all cases
    #[arg(long, value_name = "FILE.html")]
    report: Option<PathBuf>,
    /// Replace a report that is there already
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    adapter: AdapterArgs,
}

pub(super) fn run(args: &StabilityArgs, output: &Output) -> Result<ExitCode, Failure> {
    let started = Instant::now();
    if let Some(path) = &args.report {
        files::check_free(path, args.force)?;
    }
    interrupt::catch();
    let mut stand = Stand::new(Renderer::new(Gpu::open(&args.adapter.options()).map_err(failure::gpu)?));
    let outcomes = outcomes(&mut stand, output)?;
    let summary = summary(&outcomes);
    let adapter = &stand.renderer().gpu.adapter;
    if let Some(path) = &args.report {
        let page = page::html(&outcomes, adapter, &summary)?;
        files::write(path, page.as_bytes(), args.force)?;
    }
    let mut text: String = outcomes.iter().map(line).collect();
    text += &format!("\n{summary}; took {}\n", duration(started.elapsed()));
    if let Some(path) = &args.report {
        text += &format!("written: {}\n", path.display());
    }
    output.say(&text)?;
    output.object(&json!({
        "adapter": adapter,
        "cases": outcomes.iter().map(object).collect::<Vec<_>>(),
        "report_page": args.report.as_deref().map(path_text),
        "milliseconds": milliseconds(started.elapsed()),
    }))?;
    let expected = outcomes.iter().all(|outcome| outcome.verdict() != Verdict::Unexpected);
    Ok(if expected { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn outcomes(stand: &mut Stand, output: &Output) -> Result<Vec<Outcome>, Failure> {
    let progress = Progress::new("drawing", output.quiet || output.json);
    let count = cases().count();
    let mut outcomes = Vec::with_capacity(count);
    for case in cases() {
        interrupt::stop_if_happened()?;
        progress.set(outcomes.len() as f32 / count as f32);
        outcomes.push(case.outcome(stand).map_err(failure::stability)?);
    }
    Ok(outcomes)
}

/// How many cases ended how.
fn summary(outcomes: &[Outcome]) -> String {
    let of = |verdict: Verdict| outcomes.iter().filter(|outcome| outcome.verdict() == verdict).count();
    let mut words = counted(outcomes.len(), "case");
    for (verdict, mark) in [Verdict::Held, Verdict::NothingToMend, Verdict::StillFailing, Verdict::Unexpected]
        .into_iter()
        .zip([':', ',', ',', ','])
    {
        words += &format!("{mark} {} {}", of(verdict), verdict.words());
    }
    words
}

/// A figure as it is shown.
fn shown(value: f64) -> String {
    if value.is_nan() { "no number".to_owned() } else { figure(Some(value)) }
}

/// For people.
fn line(outcome: &Outcome) -> String {
    let [literal, hardened] = [&outcome.literal, &outcome.hardened].map(|side| shown(side.figure));
    let words = outcome.verdict().words();
    format!("{words:<16} {:<48} literal {literal:>9}, hardened {hardened:>9}\n", outcome.case.name)
}

/// For machines.
fn object(outcome: &Outcome) -> Value {
    let case = outcome.case;
    let cause = CAUSES.iter().find(|cause| cause.cases.iter().any(|other| other.name == case.name));
    json!({
        "name": case.name,
        "cause": cause.map(|cause| cause.name),
        "method": case.method,
        "failure": case.failure,
        "figure": case.figure,
        "literal": outcome.literal.figure,
        "hardened": outcome.hardened.figure,
        "fails": match case.literal {
            Literal::Fails(limit) => Some(limit.to_string()),
            Literal::Holds(_) => None,
        },
        "holds": case.holds.to_string(),
        "known_to_fail": matches!(case.hardened, Hardened::StillFails(_)),
        "verdict": outcome.verdict(),
    })
}
