//! What a frame costs, beside the yardstick.

use std::time::Duration;

use crate::gpu::{GpuMap, GpuMesh, Target};
use crate::params::{Method, RenderParams};
use crate::renderer::{RenderError, Renderer};
use crate::scene::Scene;
use crate::timer::FrameTimer;

/// What frames are drawn of, and into.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// The mesh, with its surface.
    pub mesh: &'a GpuMesh,
    /// The picture.
    pub target: &'a Target,
    /// Measures the frames.
    pub timer: &'a FrameTimer,
}

/// Frames of a way between frames of `phong`.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Cost {
    /// Median over the pairs of the way's time over that of `phong`.
    pub ratio: f64,
    /// Median time of a frame.
    pub frame_ms: f64,
    /// Median time of a frame of `phong`.
    pub phong_ms: f64,
}

/// Draws pairs of frames, `phong` and the way in turn, so that what slows the device slows both; those before the first
/// counted pair make pipelines. `pairs` ≥ 1.
///
/// # Errors
/// As [`Renderer::render`].
pub fn cost(
    renderer: &mut Renderer,
    setting: &Setting<'_>,
    scene: &Scene,
    params: &RenderParams,
    map: &GpuMap,
    pairs: u32,
) -> Result<Cost, RenderError> {
    let mut frame = |params: &RenderParams| {
        let Setting { mesh, target, timer } = *setting;
        timer.time::<RenderError>(renderer, |renderer, timer| {
            renderer.render_timed(scene, params, mesh, &[map], target, Some(timer))
        })
    };
    // In the same form, as the other form's faces would be computed anew for each frame.
    let phong = RenderParams { method: Method::Phong, ..*params };
    frame(&phong)?;
    frame(params)?;
    let (mut ratios, mut frames, mut yardsticks) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..pairs.max(1) {
        let (yardstick, own) = (milliseconds(frame(&phong)?), milliseconds(frame(params)?));
        ratios.push(own / yardstick.max(1e-6));
        frames.push(own);
        yardsticks.push(yardstick);
    }
    Ok(Cost { ratio: median(ratios), frame_ms: median(frames), phong_ms: median(yardsticks) })
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
