//! All measures of a rendered scene, in one call.

use tam_gen::{Job, Preset};
use tam_viewer::gpu::GpuMesh;
use tam_viewer::maps::HatchMap;
use tam_viewer::measure::{
    Aov, LightSwimming, MeasureOptions, Measures, MotionCoherence, Plane, Popping, Strokes, Track, flicker, ink,
    largest_change, light_swimming, measures, motion_coherence, popping,
};
use tam_viewer::mesh::Mesh;
use tam_viewer::surface::{FieldOptions, FieldSource, Surface, SurfaceOptions};
use tam_viewer::{RenderParams, Scene};

use crate::gpu::{Stage, renderer, surface_options};

/// A pen of one family along u: direction and length of its strokes mean something at every tone.
const PEN: &str = r#"
schedule = ["a", "a", "a", "a", "a", "a"]

[map]
size = 256

[stroke]
length_min = 0.25
length_max = 0.6
width_px = 2.0
angle_jitter_deg = 2.0

[families]
a = { angle_deg = 0 }
"#;

/// Mean length of the pen's strokes over their ink, in tiles: what [`tam_viewer::measure::run_length`] finds on a flat
/// quad in light tones, where strokes do not touch.
pub const PEN_LENGTH: f64 = (0.6 * 0.6 + 0.6 * 0.25 + 0.25 * 0.25) / 3.0 / (0.5 * (0.25 + 0.6));

/// A mesh with the directions that strokes should have on it, and how it is drawn.
pub struct Subject {
    /// The mesh.
    pub mesh: Mesh,
    /// Its surface, with the wanted directions.
    pub surface: Surface,
    /// How it is drawn; silhouette lines are left out.
    pub params: RenderParams,
    /// Windows of the measures.
    pub options: MeasureOptions,
}

/// A picture and what was wanted.
pub struct Shot {
    /// What is known of each pixel.
    pub aov: Aov,
    /// Drawn ink.
    pub ink: Plane,
    /// What the picture shows.
    pub measures: Measures,
}

/// What changes while the scene does.
#[derive(Debug)]
pub struct Motion {
    /// Between the first frame and the last; none without ink.
    pub coherence: Option<MotionCoherence>,
    /// The same, less what the tone changes: meant for light steps.
    pub swimming: Option<LightSwimming>,
    /// Over steps that are halved again and again; none where nothing changes.
    pub popping: Option<Popping>,
    /// Mean over all frames of the finest steps.
    pub flicker: f64,
}

/// A stage with the pen's map.
///
/// # Panics
/// If there is no adapter.
pub fn pen_stage(size: u32) -> Stage {
    let preset = Preset::from_toml(PEN, "pen").expect("a valid preset");
    let renderer = renderer();
    let map = HatchMap::from_preset("pen", &preset, &Job::default()).expect("it generates");
    Stage { map: renderer.map(map), renderer, size }
}

impl Subject {
    /// A mesh whose strokes should follow `source`.
    ///
    /// # Panics
    /// If there is no such field.
    pub fn new(mesh: Mesh, source: FieldSource, params: RenderParams) -> Self {
        let field = FieldOptions { source, ..FieldOptions::default() };
        let surface = Surface::new(&mesh, &SurfaceOptions { field, ..surface_options(&params) }).expect("a field");
        let params = RenderParams { silhouettes: None, ..params };
        Self { mesh, surface, params, options: MeasureOptions::default() }
    }

    /// What is wanted in a scene.
    ///
    /// # Panics
    /// If the picture has no pixels.
    pub fn aov(&self, scene: &Scene, size: u32) -> Aov {
        let strokes = Strokes { graph: &self.surface.graph, field: &self.surface.field };
        Aov::new(&self.mesh, scene, [size; 2], Some(strokes)).expect("a picture with pixels")
    }

    /// Draws a scene and measures the picture.
    ///
    /// # Panics
    /// If it cannot be drawn.
    pub fn shoot(&self, stage: &mut Stage, scene: &Scene) -> Shot {
        let mesh = stage.upload(&self.params, &self.mesh, Some(&self.surface));
        let (aov, ink) = self.draw(stage, scene, &mesh);
        Shot { measures: measures(&ink, &aov, &self.options), aov, ink }
    }

    /// Draws a scene that changes, `scene(t)` for t in 0 ..= 1, in 2, 4, … steps, up to 2^`halvings`.
    ///
    /// # Panics
    /// If it cannot be drawn, or `halvings` is 0.
    pub fn film(&self, stage: &mut Stage, scene: impl Fn(f64) -> Scene, halvings: u32) -> Motion {
        assert!(halvings > 0, "popping needs two lengths of steps, flicker three frames");
        let count = 1_usize << halvings;
        let scenes: Vec<Scene> = (0..=count).map(|i| scene(i as f64 / count as f64)).collect();
        let mesh = stage.upload(&self.params, &self.mesh, Some(&self.surface));
        let frames: Vec<(Aov, Plane)> = scenes.iter().map(|scene| self.draw(stage, scene, &mesh)).collect();
        let track = |from: usize, to: usize| Track::new(&frames[from].0, &frames[to].0, &self.mesh, &scenes[to]);
        let window_px = 2.0 * self.options.stroke_sigma_px;
        let changes = (1..=halvings).map(|halving| {
            let stride = count >> halving;
            let change = |from: usize| {
                let track = track(from, from + stride);
                largest_change(&frames[from].1, &frames[from + stride].1, &track, window_px)
            };
            (stride as f64 / count as f64, (0..count).step_by(stride).map(change).fold(0.0, f64::max))
        });
        let second = |i: usize| {
            let inks = [i - 1, i, i + 1].map(|frame| &frames[frame].1);
            flicker(inks, &track(i, i - 1), &track(i, i + 1))
        };
        let (first, last) = (&frames[0], &frames[count]);
        let sigma_px = self.options.tone_sigma_px;
        Motion {
            coherence: motion_coherence(&first.1, &last.1, &track(0, count), sigma_px),
            swimming: light_swimming(&first.1, &last.1, [&first.0, &last.0], sigma_px),
            popping: popping(&changes.collect::<Vec<_>>()),
            flicker: (1..count).map(second).sum::<f64>() / (count - 1) as f64,
        }
    }

    fn draw(&self, stage: &mut Stage, scene: &Scene, mesh: &GpuMesh) -> (Aov, Plane) {
        let aov = self.aov(scene, stage.size);
        let pixels = stage.draw_uploaded(scene, &self.params, mesh);
        let ink = ink(&pixels, &aov, &self.mesh, scene);
        (aov, ink)
    }
}
