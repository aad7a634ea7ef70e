//! Pictures of a surface for inspection: which way its field runs, where it has no direction, and how patches lie.

use csscolorparser::Color;
use glam::{DVec2, DVec3, DVec4, Vec4};
use image::{Rgba, RgbaImage};
use tiny_skia::{Color as Ink, FillRule, LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

use crate::measure::{Aov, Strokes, Surface as Seen};
use crate::mesh::Mesh;
use crate::reference::ReferenceError;
use crate::scene::Scene;
use crate::surface::patches::Entry;
use crate::surface::{Patches, Surface};

/// Distance of the field's strokes on the screen, in pixels.
const STEP_PX: f64 = 11.0;

/// Length of a stroke to both sides of its middle.
const HALF_LENGTH_PX: f64 = 8.0;

/// A view of a surface that can be drawn in several ways.
pub struct Inspection<'a> {
    surface: &'a Surface,
    aov: Aov,
    scene: Scene,
    clip_from_mesh: glam::Mat4,
}

impl<'a> Inspection<'a> {
    /// A view of a mesh and its surface.
    ///
    /// # Errors
    /// [`ReferenceError::Size`] for a picture without pixels, or with more than 65536 in one direction.
    pub fn new(mesh: &Mesh, surface: &'a Surface, scene: &Scene, size: [u32; 2]) -> Result<Self, ReferenceError> {
        let strokes = Strokes { graph: &surface.graph, field: &surface.field };
        let aov = Aov::new(mesh, scene, size, Some(strokes))?;
        let radius = mesh.positions.iter().map(|p| p.length()).fold(0.0, f32::max);
        let shared = scene.shared(size, radius.into());
        let [clip, world] =
            [shared.clip_from_world, shared.world_from_mesh].map(|m| glam::Mat4::from_cols_array_2d(&m));
        Ok(Self { surface, aov, scene: scene.clone(), clip_from_mesh: clip * world })
    }

    /// The field as short strokes; singularities as dots: where the field turns with its surroundings (index +½) red,
    /// where it turns against them (-½) blue.
    pub fn field(&self) -> RgbaImage {
        let mut picture = self.canvas(|seen| {
            let shade = 0.78 + 0.2 * seen.facing.clamp(0.0, 1.0);
            DVec3::splat(shade)
        });
        let [width, height] = self.aov.size.map(f64::from);
        let rows = (height / STEP_PX) as usize;
        for row in 0..rows {
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            for column in 0..(width / STEP_PX) as usize {
                let middle = DVec2::new(column as f64 + shift, row as f64 + 0.5) * STEP_PX;
                if let Some(line) = self.streamline(middle) {
                    stroke(&mut picture, &line, [20, 24, 32], 1.1);
                }
            }
        }
        for (face, index) in self.surface.field.indices(&self.surface.graph).into_iter().enumerate() {
            if index == 0 {
                continue;
            }
            let corners = self.surface.graph.triangles[face].map(|node| self.surface.graph.positions[node as usize]);
            let colour = if index > 0 { [214, 40, 40] } else { [30, 90, 220] };
            if let Some(place) = self.visible((corners[0] + corners[1] + corners[2]) / 3.0) {
                dot(&mut picture, place, 4.5, colour);
            }
        }
        finished(&picture)
    }

    /// The patches, each in a colour of its own, mixed as they pass into each other; seeds as dots, with the axis along
    /// which their strokes lie.
    pub fn patches(&self, patches: &Patches) -> RgbaImage {
        let mut picture = self.canvas(|seen| {
            let weights = weights(patches.of(seen.face as usize), seen.weights);
            let mixed: DVec3 = weights.map(|(seed, weight)| colour_of(seed) * weight).sum();
            mixed * (0.7 + 0.3 * seen.facing.clamp(0.0, 1.0))
        });
        let graph = &self.surface.graph;
        for seed in &patches.seeds {
            let node = seed.node as usize;
            let Some(place) = self.visible(graph.positions[node]) else { continue };
            let along = graph.direction(node, seed.angle_rad) * 1e-3 * graph.diagonal();
            if let Some(next) = self.projected(graph.positions[node] + along) {
                let axis = (next - place).normalize_or_zero() * 9.0;
                stroke(&mut picture, &[place - axis, place + axis], [20, 24, 32], 1.6);
            }
            dot(&mut picture, place, 3.0, [20, 24, 32]);
        }
        finished(&picture)
    }

    fn canvas(&self, colour: impl Fn(&Seen) -> DVec3) -> Pixmap {
        let [width, height] = self.aov.size;
        let mut picture = RgbaImage::new(width, height);
        let paper = Rgba([252, 252, 250, 255]);
        for (pixel, seen) in picture.pixels_mut().zip(&self.aov.pixels) {
            *pixel = seen.as_ref().map_or(paper, |seen| {
                let [r, g, b] = (colour(seen).clamp(DVec3::ZERO, DVec3::ONE) * 255.0).to_array().map(|c| c as u8);
                Rgba([r, g, b, 255])
            });
        }
        let size = tiny_skia::IntSize::from_wh(width, height);
        let empty = || Pixmap::new(1, 1).unwrap_or_else(|| unreachable!("a pixel is no empty picture"));
        size.and_then(|size| Pixmap::from_vec(picture.into_raw(), size)).unwrap_or_else(empty)
    }

    /// The field followed to both sides of a place on the screen; `None` beside the mesh and where there is no direction.
    fn streamline(&self, middle: DVec2) -> Option<Vec<DVec2>> {
        let first = DVec2::from_angle(self.aov.at(middle)?.stroke_rad?);
        let mut line = Vec::new();
        for way in [-1.0, 1.0] {
            let (mut place, mut heading) = (middle, first * way);
            let mut side = vec![middle];
            for _ in 0..HALF_LENGTH_PX as usize {
                place += heading;
                let Some(angle) = self.aov.at(place).and_then(|seen| seen.stroke_rad) else { break };
                let along = DVec2::from_angle(angle);
                heading = if along.dot(heading) < 0.0 { -along } else { along };
                side.push(place);
            }
            if way < 0.0 {
                side.reverse();
                line = side;
            } else {
                line.extend(side.into_iter().skip(1));
            }
        }
        (line.len() > 2).then_some(line)
    }

    fn projected(&self, p_mesh: DVec3) -> Option<DVec2> {
        let clip: Vec4 = self.clip_from_mesh * p_mesh.as_vec3().extend(1.0);
        let clip: DVec4 = clip.as_dvec4();
        let [width, height] = self.aov.size.map(f64::from);
        let place = DVec2::new(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w) * DVec2::new(width, height);
        (clip.w > 0.0 && place.is_finite()).then_some(place)
    }

    /// Where a place of the mesh is on the screen, if nothing hides it.
    fn visible(&self, p_mesh: DVec3) -> Option<DVec2> {
        let place = self.projected(p_mesh)?;
        let p_world = self.scene.world_from_mesh.transform_point3(p_mesh);
        let seen = self.aov.at(place)?;
        (seen.p_world.distance(p_world) < 6.0 * seen.px_world / seen.facing.max(0.1)).then_some(place)
    }
}

/// Seeds and weights at a place of a triangle, as the shaders have them.
fn weights(entries: &[Entry], corners: DVec3) -> impl Iterator<Item = (u32, f64)> {
    let behind = |entry: &Entry| DVec3::from(entry.behind.map(f64::from)).dot(corners);
    let least = entries.iter().map(behind).fold(f64::INFINITY, f64::min);
    let raw: Vec<(u32, f64)> =
        entries.iter().map(|entry| (entry.seed, (1.0 - (behind(entry) - least)).max(0.0))).collect();
    let sum: f64 = raw.iter().map(|(_, weight)| weight).sum();
    raw.into_iter().map(move |(seed, weight)| (seed, weight / sum))
}

/// A colour by number: the golden angle keeps neighbours apart.
fn colour_of(seed: u32) -> DVec3 {
    let hue = f64::from(seed % 4096) * 137.507_764;
    let lightness = [0.62, 0.74, 0.84][seed as usize % 3];
    let colour = Color::from_hsla((hue % 360.0) as f32, 0.55, lightness, 1.0);
    DVec3::new(colour.r.into(), colour.g.into(), colour.b.into())
}

fn paint(colour: [u8; 3]) -> Paint<'static> {
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color(Ink::from_rgba8(colour[0], colour[1], colour[2], 255));
    paint
}

fn stroke(picture: &mut Pixmap, line: &[DVec2], colour: [u8; 3], width: f32) {
    let mut path = PathBuilder::new();
    for (k, place) in line.iter().map(|place| place.as_vec2()).enumerate() {
        if k == 0 { path.move_to(place.x, place.y) } else { path.line_to(place.x, place.y) }
    }
    if let Some(path) = path.finish() {
        let pen = Stroke { width, line_cap: LineCap::Round, ..Stroke::default() };
        picture.stroke_path(&path, &paint(colour), &pen, Transform::identity(), None);
    }
}

fn dot(picture: &mut Pixmap, place: DVec2, radius: f32, colour: [u8; 3]) {
    let place = place.as_vec2();
    for (radius, colour) in [(radius + 1.5, [255, 255, 255]), (radius, colour)] {
        if let Some(path) = PathBuilder::from_circle(place.x, place.y, radius) {
            picture.fill_path(&path, &paint(colour), FillRule::Winding, Transform::identity(), None);
        }
    }
}

fn finished(picture: &Pixmap) -> RgbaImage {
    RgbaImage::from_raw(picture.width(), picture.height(), picture.data().to_vec()).unwrap_or_default()
}
