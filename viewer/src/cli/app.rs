//! `tam-viewer app`, and `tam-viewer` alone.

use std::path::PathBuf;

use tam_gen::command::Failure;
use tam_viewer::app::{Options, WindowOptions, default_session, run as open};

use tam_viewer::scene_file::value;

const EXAMPLES: &str = "\
Examples:
  tam-viewer                                  the window, as it was left
  tam-viewer app mine.toml hand.obj           with a preset and a mesh
  tam-viewer app --session other.json         with a session of its own
  tam-viewer app --window 1280x720 --screenshot window.png
                                              draws the window into a picture, and quits";

/// What the window starts with.
#[derive(Debug, Default, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct AppArgs {
    /// Presets, meshes and guides to open
    files: Vec<PathBuf>,
    /// Size of the window in points [default: as it was left]
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    window: Option<[u32; 2]>,
    /// Keep the session in this file [default: in the user's folder for data]
    #[arg(long, value_name = "FILE", conflicts_with = "fresh")]
    session: Option<PathBuf>,
    /// Start anew, and leave no session
    #[arg(long)]
    fresh: bool,
    /// Draw the window into this picture when everything is there, and quit; starts anew unless a session is named
    #[arg(long, value_name = "FILE.png")]
    screenshot: Option<PathBuf>,
}

pub(super) fn run(args: &AppArgs) -> Result<(), Failure> {
    let kept = !args.fresh && args.screenshot.is_none();
    let session = args.session.clone().or_else(|| default_session().filter(|_| kept));
    let options = WindowOptions {
        app: Options { session, files: args.files.clone(), ..Options::default() },
        size: args.window.map(|size| size.map(|side| side as f32)),
        picture: args.screenshot.clone(),
    };
    open(options).map_err(|error| Failure::Work {
        kind: "window",
        message: error.to_string(),
        help: Some("a window needs a display; `tam-viewer render --help` shows what works without one".to_owned()),
    })
}
