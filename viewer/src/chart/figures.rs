//! The figures of one way to draw.

use super::cost::{Cost, Setting, cost};
use super::maps::Maps;
use super::views::{HALVINGS, View, Views, ZOOM};
use super::ways::Way;
use crate::gpu::{GpuError, GpuMap, Picture};
use crate::measure::{
    MeasureOptions, Plane, direction, edge_continuity, ink, largest_change, light_swimming, motion_coherence, popping,
    run_length, tone, zoom,
};
use crate::mesh::Mesh;
use crate::params::{Method, RenderParams};
use crate::renderer::{RenderError, Renderer};
use crate::scene::Scene;

/// How far ink is looked for: in the nearer picture, half a stroke of 2 px seen so much larger, and a pixel; in the
/// farther one, half a stroke.
const REACH_PX: [f64; 2] = [1.0 + ZOOM, 1.0];

/// Cost and errors of one way. What cannot be measured is left out: `phong` has no strokes, crisp patterns may have no
/// edges to cross.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Figures {
    /// Frames, beside those of `phong`.
    pub cost: Cost,
    /// Of all buffers of the mesh that it reads, and of the map's textures.
    pub bytes: u64,
    /// Root mean square of the error of tone, in L*.
    pub tone_rmse: Option<f64>,
    /// Its mean, in L*: above 0 it is too light.
    pub tone_bias: Option<f64>,
    /// Mean angle between the strokes of one family and the wanted direction, in degrees.
    pub direction_deg: Option<f64>,
    /// Mean unbroken length of the strokes of one family, in pixels.
    pub run_px: Option<f64>,
    /// Changes of the ink across edges over those inside faces; 1 is ideal.
    pub edge_continuity: Option<f64>,
    /// Change of strokes while the camera turns by 2°: 0 rigid, 1 unrelated.
    pub orbit_change: Option<f64>,
    /// The same while the view comes nearer by a twentieth.
    pub zoom_change: Option<f64>,
    /// Change of strokes under a light that turns by 1°, less that of the tone.
    pub swimming: Option<f64>,
    /// Slope of the greatest change over the step of the light: 1 continuous, 0 pops.
    pub popping_slope: Option<f64>,
    /// The greatest change at the smallest step, 0 ..= 1.
    pub popping_rest: Option<f64>,
    /// Share of strokes that die in a zoom by 2.
    pub deaths: Option<f64>,
    /// Share of strokes that are born in it.
    pub births: Option<f64>,
    /// Share that would die by chance.
    pub deaths_by_chance: Option<f64>,
}

/// Draws a way into all views and measures the pictures; the picture of the still one beside.
///
/// `mesh` is the one that was uploaded, with whatever surface the way needs attached; the target has one sample a pixel
/// and the size of the views. `pairs` of frames are timed.
///
/// # Errors
/// As [`Renderer::render`].
pub fn measure_way(
    renderer: &mut Renderer,
    setting: &Setting<'_>,
    mesh: &Mesh,
    maps: &Maps,
    views: &Views,
    way: &Way,
    pairs: u32,
) -> Result<(Figures, Picture), RenderError> {
    let options = MeasureOptions::default();
    let params = &way.params;
    // Taken anew for each way, so that the bytes are those of this method's textures alone.
    let (map, single) = (renderer.map(maps.whole.clone()), renderer.map(maps.single.clone()));
    let cost = cost(renderer, setting, &views.still.scene, params, &map, pairs)?;
    let bytes = setting.mesh.bytes_for(params) + method_bytes(renderer, maps, setting, views, params)?;

    let picture = draw(renderer, setting, &views.still.scene, params, &map)?;
    let still = ink(&picture.linear(), &views.still.aov, mesh, &views.still.scene);
    let tone = tone(&still, &views.still.aov, options.tone_sigma_px).map(|tone| tone.lightness);
    let mut figures = Figures {
        cost,
        bytes,
        tone_rmse: tone.map(|errors| errors.rmse),
        tone_bias: tone.map(|errors| errors.bias),
        ..Figures::default()
    };
    if params.method == Method::Phong {
        return Ok((figures, picture));
    }
    let mut shown = |view: &View, params: &RenderParams, map: &GpuMap| -> Result<Plane, RenderError> {
        let pixels = draw(renderer, setting, &view.scene, params, map)?.linear();
        Ok(ink(&pixels, &view.aov, mesh, &view.scene))
    };
    // Lines that cross have two directions.
    let one_way = RenderParams { cross_from: None, ..*params };
    let single = shown(&views.still, &one_way, &single)?;
    figures.direction_deg = direction(&single, &views.still.aov, options.stroke_sigma_px).mean_deg;
    figures.run_px = run_length(&single, &views.still.aov).mean_px;
    figures.edge_continuity = edge_continuity(&still, &views.still.aov).ratio;

    let [turned, nearer, zoomed] = [&views.turned, &views.nearer, &views.zoomed].map(|view| shown(view, params, &map));
    let change = |after: &Plane, track| motion_coherence(&still, after, track, options.tone_sigma_px);
    figures.orbit_change = change(&turned?, &views.to_turned).map(|moved| moved.change);
    figures.zoom_change = change(&nearer?, &views.to_nearer).map(|moved| moved.change);
    let zoomed = zoomed?;
    let tracks = [&views.to_zoomed, &views.from_zoomed];
    let aovs = [&views.still.aov, &views.zoomed.aov];
    if let Some(zoom) = zoom([&still, &zoomed], aovs, tracks, REACH_PX, options.tone_sigma_px) {
        figures.deaths = Some(zoom.deaths);
        figures.births = Some(zoom.births);
        figures.deaths_by_chance = Some(zoom.deaths_by_chance);
    }
    sweep(renderer, setting, mesh, views, params, &map, still, &mut figures)?;
    Ok((figures, picture))
}

/// Popping and swimming under the turning light.
#[expect(clippy::too_many_arguments, reason = "what is drawn, with what, into what, and what was drawn before")]
fn sweep(
    renderer: &mut Renderer,
    setting: &Setting<'_>,
    mesh: &Mesh,
    views: &Views,
    params: &RenderParams,
    map: &GpuMap,
    still: Plane,
    figures: &mut Figures,
) -> Result<(), RenderError> {
    let options = MeasureOptions::default();
    let mut inks = vec![still];
    for scene in &views.sweep[1..] {
        let pixels = draw(renderer, setting, scene, params, map)?.linear();
        inks.push(ink(&pixels, &views.still.aov, mesh, scene));
    }
    let steps = inks.len() - 1;
    let changes = (1..=HALVINGS).map(|halving| {
        let stride = steps >> halving;
        let change =
            |from: usize| largest_change(&inks[from], &inks[from + stride], &views.stay, 2.0 * options.stroke_sigma_px);
        (stride as f64 / steps as f64, (0..steps).step_by(stride).map(change).fold(0.0, f64::max))
    });
    let popping = popping(&changes.collect::<Vec<_>>());
    figures.popping_slope = popping.map(|popping| popping.slope);
    figures.popping_rest = popping.map(|popping| popping.remainder);
    let swimming = light_swimming(&inks[0], &inks[steps], [&views.still.aov, &views.swept], options.tone_sigma_px);
    figures.swimming = swimming.map(|swimming| swimming.swimming);
    Ok(())
}

/// Bytes of the textures of one method.
fn method_bytes(
    renderer: &mut Renderer,
    maps: &Maps,
    setting: &Setting<'_>,
    views: &Views,
    params: &RenderParams,
) -> Result<u64, RenderError> {
    if matches!(params.method, Method::Phong | Method::Halftone | Method::Stripes) {
        return Ok(0);
    }
    let own = renderer.map(maps.whole.clone());
    renderer.render(&views.still.scene, params, setting.mesh, &[&own], setting.target)?;
    Ok(own.bytes())
}

fn draw(
    renderer: &mut Renderer,
    setting: &Setting<'_>,
    scene: &Scene,
    params: &RenderParams,
    map: &GpuMap,
) -> Result<Picture, RenderError> {
    renderer.render(scene, params, setting.mesh, &[map], setting.target)?;
    setting.target.read(&renderer.gpu).map_err(|error: GpuError| error.into())
}
