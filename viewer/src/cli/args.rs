//! The arguments of the command line, and their help.

use clap::{Parser, Subcommand};
use tam_gen::command::schema::SchemaArgs;
use tam_gen::command::shell::{CompletionsArgs, ManArgs};
use tam_gen::command::{Common, STYLES};

const EXAMPLES: &str = "\
Examples:
  tam-viewer                                          opens the window
  tam-viewer render                                   torus-knot.png: a knot in pencil
  tam-viewer render --mesh ./mine.obj --map engraving
  tam-viewer compare --mesh torus-knot                all methods side by side, with what they cost
  tam-viewer turntable --path light -o light.gif      the light goes around
  tam-viewer meshes                                   meshes that need no file

Exit status:
  0    all is well
  1    something the work needs is not as it should be: adapter, mesh, map, or the place to write; or a case of
       `stability` is not as it says
  2    the arguments make no sense
  130  interrupted: nothing was written";

const COMPLETIONS_EXAMPLES: &str = "\
Examples:
  tam-viewer completions bash > ~/.local/share/bash-completion/completions/tam-viewer
  tam-viewer completions zsh > ~/.zfunc/_tam-viewer
  tam-viewer completions fish > ~/.config/fish/completions/tam-viewer.fish";

const SCHEMA_EXAMPLES: &str = "\
Examples:
  tam-viewer schema -o scene.schema.json     beside your scenes, whose first line then says
                                             #:schema ./scene.schema.json
Editors with TOML support (Even Better TOML, taplo) complete and check scenes by it.

A scene file says in the words of the options what is drawn, what all objects have in common first:
  map = \"pencil\"
  camera = [40, 10]
  light = [\"-30,60\", \"at:2,1,2,0.5\"]
  [[object]]
  mesh = \"chair\"
  [object.part.seat]
  method = \"stripes\"
  [[object]]
  name = \"pot\"
  mesh = \"teapot\"
  place = [0, 0.6, 0.1, 40, 0.4]
Files are named as seen from the scene file.";

const MAN_EXAMPLES: &str = "\
Examples:
  tam-viewer man | man -l -                            read it
  tam-viewer man -o ~/.local/share/man/man1            install the pages of all commands";

/// Makes stroke materials live on any mesh, and renders meshes with them to pictures.
///
/// Without a command the window opens.
#[derive(Debug, Parser)]
#[command(name = "tam-viewer", version, styles = STYLES, after_help = EXAMPLES, max_term_width = 120)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Open the window, with files
    #[cfg(feature = "app")]
    App(super::app::AppArgs),
    /// Draw a mesh to a picture
    Render(Box<super::render::RenderArgs>),
    /// Draw all methods side by side on one sheet, with what a frame costs
    Compare(Box<super::compare::CompareArgs>),
    /// Chart what all methods cost against how far they are from what is wanted
    Chart(Box<super::chart::ChartArgs>),
    /// Find the least that a scene needs: method, columns, levels and resolution within an error of tone
    Fit(Box<super::fit::FitArgs>),
    /// Draw the cases where methods fail, as printed and hardened, and measure both
    Stability(super::stability::StabilityArgs),
    /// Draw frames of a moving camera, light or mesh
    Turntable(Box<super::turntable::TurntableArgs>),
    /// Draw the direction field and the patches of a mesh, to inspect them
    Field(Box<super::field::FieldArgs>),
    /// Print the JSON schema of scene files
    #[command(after_help = SCHEMA_EXAMPLES)]
    Schema(SchemaArgs),
    /// List the sample meshes, or draw them all
    Meshes(super::meshes::MeshesArgs),
    /// List the graphics adapters
    Adapters(super::adapters::AdaptersArgs),
    /// Print completions for a shell
    #[command(after_help = COMPLETIONS_EXAMPLES)]
    Completions(CompletionsArgs),
    /// Print the manual page, or write those of all commands
    #[command(after_help = MAN_EXAMPLES)]
    Man(ManArgs),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        <Cli as clap::CommandFactory>::command().debug_assert();
    }
}
