//! The arguments of the command line, and their help.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use tam_gen::command::schema::SchemaArgs;
use tam_gen::command::shell::{CompletionsArgs, ManArgs};
use tam_gen::command::{Common, STYLES};
use tam_gen::preset::{Overrides, PlacementMethod, Tones};

const SCHEMA_EXAMPLES: &str = "\
Examples:
  tam-gen schema -o preset.schema.json     beside your presets, whose first line then says
                                           #:schema ./preset.schema.json
Editors with TOML support (Even Better TOML, taplo) complete and check presets by it.";

const EXAMPLES: &str = "\
Examples:
  tam-gen generate pencil                   a map from a preset that comes with the tool, into out/
  tam-gen presets new mine                  mine.toml to start from, every option explained
  tam-gen watch mine.toml                   regenerate on every save
  tam-gen check out/mine.ktx2               is it a tonal art map?

Exit status:
  0    all is well
  1    done, but a constraint of tonal art maps does not hold
  2    bad input or arguments, or nowhere to write: nothing was written
  130  interrupted: nothing was written";

/// Generates, checks and exports tonal art maps: nested, mipmapped hatching textures whose tone is exact.
#[derive(Debug, Parser)]
#[command(name = "tam-gen", version, styles = STYLES, after_help = EXAMPLES, max_term_width = 120)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,
    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Generate a map from a preset, check it, and write it
    Generate(super::generate::GenerateArgs),
    /// Check whether a map is a tonal art map, whoever made it
    Check(super::check::CheckArgs),
    /// Draw a contact sheet of a map or preset
    Sheet(super::sheet::SheetArgs),
    /// Chart what ways of placing strokes cost against how even they lie
    Chart(super::chart::ChartArgs),
    /// List, show and start presets
    Presets(super::presets::PresetsArgs),
    /// Print the JSON schema of preset files
    #[command(after_help = SCHEMA_EXAMPLES)]
    Schema(SchemaArgs),
    /// Regenerate a map whenever its preset is saved
    Watch(super::watch::WatchArgs),
    /// Print completions for a shell
    #[command(after_help = super::shell::COMPLETIONS_EXAMPLES)]
    Completions(CompletionsArgs),
    /// Print the manual page, or write those of all commands
    #[command(after_help = super::shell::MAN_EXAMPLES)]
    Man(ManArgs),
}

/// What replaces a preset's own options.
#[derive(Debug, Args, Default)]
#[command(next_help_heading = "In place of what the preset says")]
pub(super) struct OverrideArgs {
    /// Side of the finest level, a power of two from 64 to 4096
    #[arg(long, value_name = "PX")]
    size: Option<u32>,
    /// Number of hand-built levels, each half the size of the one before
    #[arg(long, value_name = "N")]
    levels: Option<u32>,
    /// How many tones, evenly spaced, or which, lightest first: 12 or 0.1,0.3,0.6
    #[arg(long, value_name = "N|LIST", value_parser = tones, allow_negative_numbers = true)]
    tones: Option<Tones>,
    /// Same preset, same seed, same bytes
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// How strokes find their places
    #[arg(long, value_name = "METHOD", value_parser = placement())]
    placement: Option<PlacementMethod>,
    /// Candidates per stroke of the progressive placement
    #[arg(long, value_name = "N")]
    effort: Option<u32>,
}

impl OverrideArgs {
    pub(super) fn overrides(&self) -> Overrides {
        Overrides {
            size: self.size,
            levels: self.levels,
            tones: self.tones.clone(),
            seed: self.seed,
            placement: self.placement,
            effort: self.effort,
        }
    }

    /// Whether any option is replaced.
    pub(super) fn any(&self) -> bool {
        self.overrides() != Overrides::default()
    }
}

/// Reads a count of tones, or a list of them.
pub(super) fn tones(text: &str) -> Result<Tones, String> {
    if let Ok(count) = text.trim().parse() {
        return Ok(Tones::Count(count));
    }
    let number = |word: &str| word.trim().parse::<f64>().map_err(|_| format!("{word:?} is no number"));
    text.split(',').map(number).collect::<Result<_, _>>().map(Tones::List)
}

fn placement() -> impl TypedValueParser<Value = PlacementMethod> {
    PossibleValuesParser::new(PlacementMethod::ALL.map(PlacementMethod::name)).map(|name| {
        let named = PlacementMethod::ALL.into_iter().find(|method| method.name() == name);
        named.expect("the parser lets only these names through")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }

    #[test]
    fn tones_are_a_count_or_a_list() {
        assert_eq!(tones("12"), Ok(Tones::Count(12)));
        assert_eq!(tones("0.5"), Ok(Tones::List(vec![0.5])));
        assert_eq!(tones("0.1, 0.3,0.6"), Ok(Tones::List(vec![0.1, 0.3, 0.6])));
        assert!(tones("0.1,,0.3").is_err() && tones("").is_err() && tones("dark").is_err());
    }
}
