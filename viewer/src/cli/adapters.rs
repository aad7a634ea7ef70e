//! `tam-viewer adapters`.

use serde_json::json;
use tam_gen::command::{Failure, Output};
use tam_viewer::gpu::{Gpu, GpuError};

use super::report;

const EXAMPLES: &str = "\
Examples:
  tam-viewer adapters                          which there are, the one that would be used first
  tam-viewer render --adapter llvmpipe         another one
  WGPU_ADAPTER_NAME=llvmpipe tam-viewer render the same";

#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct AdaptersArgs {}

pub(super) fn run(_: &AdaptersArgs, output: &Output) -> Result<(), Failure> {
    let mut adapters = Gpu::adapters();
    if adapters.is_empty() {
        return Err(report::gpu(GpuError::NoAdapter));
    }
    // What the variable asks for goes before the fastest kind.
    if let Ok(wanted) = std::env::var("WGPU_ADAPTER_NAME") {
        adapters.sort_by_key(|adapter| !adapter.name.to_lowercase().contains(&wanted.to_lowercase()));
    }
    let lines = adapters.iter().zip(0..).map(|(adapter, index)| {
        let mark = if index == 0 { "*" } else { " " };
        let note = if adapter.is_software() { "; computes on the processor" } else { "" };
        format!("{mark} {adapter}: {}{note}\n", adapter.driver)
    });
    output.result(&lines.collect::<String>(), || json!({ "adapters": adapters, "chosen": adapters[0].name }))
}
