//! The same pictures on the CPU, in `f64`: what a GPU should draw, and with many samples per pixel, what it should draw
//! if it had no pixels.
//!
//! ```text
//! mesh, scene ─► vertices (twin) ─► triangles, pixel by pixel ─► fragments (twin) ─► mean of the samples
//! ```
//!
//! Shading is by the twins of the shaders ([`tam_shaders::cpu`]), triangles are found here, and nothing of wgpu is
//! used.

mod maps;
pub(crate) mod raster;
mod shade;
#[cfg(test)]
mod tests;

use std::ops::Range;

use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;
use tam_shaders::cpu::lib::material::Material;
use tam_shaders::cpu::lib::mesh::Mesh as MeshView;
use tam_shaders::cpu::lib::mesh_types::{FaceFrame, Vertex};
use tam_shaders::cpu::lib::patches::{NO_SEED, OVERLAPS};
use tam_shaders::cpu::lib::scene::Scene;
use tam_shaders::cpu::lib::stages::Carried;
use tam_shaders::cpu::{Bindings, MapImage, Options, face_frames, face_geometry, octahedral};
use tam_shaders::{Feed, Pass, types};

use crate::mesh::Mesh;
use crate::surface::Corners;
use crate::surface::corners::Stand;
pub use maps::{column_pairs, six_columns, thresholds};
use raster::{Hit, Triangle};
use shade::{Corner, Shader};

/// Why a picture cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// The pass does not shade surfaces, or not one fragment at a time.
    #[error("the pass {} does not shade surfaces", .0.name())]
    NoSurface(Pass),
    /// The draw names triangles that the mesh lacks.
    #[error("triangles {wanted:?} of a mesh that has {count}")]
    NoSuchTriangles {
        /// Those asked for.
        wanted: Range<u32>,
        /// Those there are.
        count: u32,
    },
    /// The picture or its samples are none, or more than this counts.
    #[error("a picture of {} by {} pixels with {samples} by {samples} samples each", .size[0], .size[1])]
    Size {
        /// Width and height.
        size: [f32; 2],
        /// Samples of a pixel in each direction.
        samples: u32,
    },
}

/// A mesh in the form that the twins read.
#[derive(Clone, Debug)]
pub struct Reference {
    vertices: Vec<Vertex>,
    uvs: Vec<DVec2>,
    indices: Vec<u32>,
    neighbours: Vec<u32>,
}

/// Triangles that are drawn with one material.
#[derive(Clone, Debug)]
pub struct Draw<'a> {
    /// Triangles of the mesh; `first_face` of the material is taken from here.
    pub triangles: Range<u32>,
    /// The material.
    pub material: &'a types::Material,
    /// What the pass samples; see [`column_pairs`], [`six_columns`] and [`thresholds`].
    pub map: &'a MapImage,
    /// Rows of the distribution table, shares and their rates, for stroke maps.
    pub distribution: &'a [Vec<DVec2>],
    /// What the corners of the whole mesh carry, for feeds that draw with them.
    pub corners: Option<&'a Corners>,
    /// How its patches are turned with the light; empty where they lie still.
    pub turns: &'a [DVec4],
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct How {
    /// The pass that shades.
    pub pass: Pass,
    /// What its vertices carry.
    pub feed: Feed,
    /// Constants of its pipeline.
    pub options: Options,
    /// Samples of a pixel in each direction, evenly spaced; 1 is the middle of the pixel, as a GPU without
    /// multisampling.
    pub samples: u32,
}

/// A picture, by rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Linear light, the mean over the samples that show the mesh; all 0 where none does.
    pub colours: Vec<DVec4>,
    /// Share of the samples that show the mesh, 0 ..= 1.
    pub coverage: Vec<f64>,
    /// Triangle of the mesh seen at the middle sample, or `NO_FACE`.
    pub faces: Vec<u32>,
}

impl Reference {
    /// Takes a mesh. Positions and uv are those of the GPU's buffers; normals are rounded to the same codes.
    pub fn new(mesh: &Mesh) -> Self {
        let vertex = |(position, normal): (&glam::Vec3, &glam::Vec3)| Vertex {
            position: position.as_dvec3(),
            normal_oct: octahedral::oct_encode(normal.as_dvec3()),
        };
        let uvs: Vec<DVec2> = mesh.uvs.iter().map(|uv| uv.as_dvec2()).collect();
        Self {
            vertices: mesh.positions.iter().zip(&mesh.normals).map(vertex).collect(),
            uvs,
            indices: mesh.triangles.as_flattened().to_vec(),
            neighbours: mesh.neighbours.as_flattened().to_vec(),
        }
    }

    /// Renders a scene; the picture's size is the scene's viewport. The same on every machine and for any number of
    /// threads.
    ///
    /// # Errors [`ReferenceError`]: the pass is none that shades surfaces, triangles that do not exist, or a picture
    /// without pixels.
    pub fn render(&self, scene: &types::Scene, draws: &[Draw<'_>], how: &How) -> Result<Picture, ReferenceError> {
        let shader = Shader::of(how.pass)?;
        let size = size_of(scene, how.samples)?;
        let scene = Scene::from(scene);
        let computed = self.compute(&scene, how.options);
        let materials = draws.iter().map(|draw| self.material(draw)).collect::<Result<Vec<_>, _>>()?;
        let bindings: Vec<Bindings<'_>> = draws
            .iter()
            .zip(&materials)
            .map(|(draw, material)| Bindings {
                options: how.options,
                scene: &scene,
                mesh: self.view(&computed),
                material,
                map: draw.map,
                distribution: draw.distribution,
                turns: draw.turns,
            })
            .collect();
        let samples = how.samples as usize;
        let grid = [size[0] as usize * samples, size[1] as usize * samples];
        let drawn = |(i, draw): (usize, &Draw<'_>)| {
            let b = bindings[i];
            let triangle = move |(face, carried): (u32, [Carried; 3])| {
                let corners = carried.map(|carried| shader.corner(&b, how.feed, &carried));
                Triangle::new(corners.map(|corner: Corner| corner.clip), grid).map(|shape| Drawn {
                    shape,
                    corners,
                    face,
                    draw: i,
                })
            };
            self.carried(draw, how.feed).into_par_iter().filter_map(triangle).collect::<Vec<_>>()
        };
        let triangles: Vec<Drawn> = draws.iter().enumerate().flat_map(drawn).collect();
        let shapes: Vec<&Triangle> = triangles.iter().map(|triangle| &triangle.shape).collect();
        let rows = raster::visible(&shapes, grid);
        let pixels: Vec<(DVec4, f64)> = (0..size[1] as usize)
            .into_par_iter()
            .flat_map_iter(|y| {
                let (rows, triangles, bindings) = (&rows, &triangles, &bindings);
                (0..size[0] as usize).map(move |x| {
                    let mut sum = DVec4::ZERO;
                    let mut covered = 0_u32;
                    for sample in 0..samples * samples {
                        let at = [x * samples + sample % samples, y * samples + sample / samples];
                        let Some(Hit { triangle, .. }) = rows[at[1]][at[0]] else { continue };
                        let triangle = &triangles[triangle as usize];
                        sum += triangle.shade((shader, how.feed), &bindings[triangle.draw], at, [x, y], samples);
                        covered += 1;
                    }
                    let share = f64::from(covered) / (samples * samples) as f64;
                    (sum / f64::from(covered.max(1)), share)
                })
            })
            .collect();
        let (colours, coverage) = pixels.into_iter().unzip();
        let seen = |i: usize| {
            let [x, y] = [i % size[0] as usize, i / size[0] as usize].map(|at| at * samples + samples / 2);
            rows[y][x].map_or(types::NO_FACE, |hit: Hit| triangles[hit.triangle as usize].face)
        };
        let faces = (0..size[0] as usize * size[1] as usize).map(seen).collect();
        Ok(Picture { size, colours, coverage, faces })
    }

    /// The buffers that compute passes fill.
    fn compute(&self, scene: &Scene, options: Options) -> Computed {
        let faces = self.indices.len() / 3;
        let mut computed = Computed {
            face_normals: vec![DVec4::ZERO; faces],
            face_planes: vec![DVec4::ZERO; 2 * faces],
            face_frames: vec![FaceFrame::default(); faces],
        };
        let Computed { face_normals, face_planes, face_frames } = &mut computed;
        face_geometry::main(options.form, scene, &self.vertices, &self.indices, face_normals, face_planes);
        // The literal form asks for the first light.
        if !scene.lights.is_empty() {
            face_frames::main(options.form, scene, &self.vertices, &self.indices, face_normals, face_frames);
        }
        computed
    }

    /// The triangles that are drawn, each with its triangle of the mesh and what its corners carry.
    fn carried(&self, draw: &Draw<'_>, feed: Feed) -> Vec<(u32, [Carried; 3])> {
        let first = draw.triangles.start;
        let corners = draw.corners.filter(|_| !matches!(feed, Feed::Vertices | Feed::Uvs) && !feed.is_pulled());
        let of_face = |face: u32| match corners {
            None => {
                let carried = [0, 1, 2].map(|k| {
                    let vertex = self.indices[(3 * face + k) as usize] as usize;
                    let uv = self.uvs.get(vertex).copied().unwrap_or_default();
                    Carried { vertex: self.vertices[vertex], uv, index: 3 * (face - first) + k, ..Carried::default() }
                });
                vec![(face, carried)]
            }
            Some(corners) => {
                let range = corners.range_of(face..face + 1);
                let indices = &corners.indices[range.start as usize..range.end as usize];
                let triangle = |indices: &[u32; 3]| (face, indices.map(|index| self.corner(corners, index as usize)));
                indices.as_chunks::<3>().0.iter().map(triangle).collect()
            }
        };
        draw.triangles.clone().into_par_iter().flat_map_iter(of_face).collect()
    }

    fn corner(&self, corners: &Corners, i: usize) -> Carried {
        let Corners { stands, patches, over, seeds, lines, rows, .. } = corners;
        let vertex = match stands[i] {
            Stand::Vertex(vertex) => self.vertices[vertex as usize],
            Stand::Middle(face) => {
                let corners = [0, 1, 2].map(|k| self.vertices[self.indices[(3 * face + k) as usize] as usize]);
                let normals = corners.iter().map(|corner| octahedral::oct_decode(corner.normal_oct));
                Vertex {
                    position: corners.iter().map(|corner| corner.position).sum::<DVec3>() / 3.0,
                    normal_oct: octahedral::oct_encode(normals.sum::<DVec3>().normalize_or(DVec3::Y)),
                }
            }
        };
        Carried {
            vertex,
            patches: patches.get(i).copied().unwrap_or_default(),
            over: over.get(i).copied().unwrap_or_default(),
            seeds: seeds.get(i).copied().unwrap_or([NO_SEED; OVERLAPS]),
            lines: lines.get(i).copied().unwrap_or_default(),
            rows: rows.get(i).copied().unwrap_or_default(),
            ..Carried::default()
        }
    }

    fn view<'a>(&'a self, computed: &'a Computed) -> MeshView<'a> {
        MeshView {
            vertices: &self.vertices,
            indices: &self.indices,
            neighbours: &self.neighbours,
            face_normals: &computed.face_normals,
            face_planes: &computed.face_planes,
            face_frames: &computed.face_frames,
        }
    }

    fn material(&self, draw: &Draw<'_>) -> Result<Material, ReferenceError> {
        let count = (self.indices.len() / 3) as u32;
        if draw.triangles.start > draw.triangles.end || draw.triangles.end > count {
            return Err(ReferenceError::NoSuchTriangles { wanted: draw.triangles.clone(), count });
        }
        Ok(Material { first_face: draw.triangles.start, ..draw.material.into() })
    }
}

struct Computed {
    face_normals: Vec<DVec4>,
    face_planes: Vec<DVec4>,
    face_frames: Vec<FaceFrame>,
}

/// A triangle on the screen with what its fragments need.
struct Drawn {
    shape: Triangle,
    corners: [Corner; 3],
    face: u32,
    draw: usize,
}

impl Drawn {
    /// Colour of a sample. The quad of a fragment is that of its pixel, a whole pixel from one fragment to the next.
    fn shade(
        &self,
        (shader, feed): (Shader, Feed),
        b: &Bindings<'_>,
        at: [usize; 2],
        pixel: [usize; 2],
        samples: usize,
    ) -> DVec4 {
        let lane = pixel[0] % 2 + pixel[1] % 2 * 2;
        let step = samples as f64;
        let weights = tam_shaders::cpu::Quad::from_fn(|other| {
            let across = (other % 2) as f64 - (lane % 2) as f64;
            let down = (other / 2) as f64 - (lane / 2) as f64;
            self.shape.weights(DVec2::new(at[0] as f64 + 0.5 + step * across, at[1] as f64 + 0.5 + step * down))
        });
        let place_px = (DVec2::new(at[0] as f64, at[1] as f64) + 0.5) / step;
        shader.fragment(b, feed, &self.corners, self.face, &weights, place_px, lane, self.shape.front)
    }
}

fn size_of(scene: &types::Scene, samples: u32) -> Result<[u32; 2], ReferenceError> {
    let size = scene.viewport_px;
    let sides = size.map(|side| side as u32);
    let most = sides.map(|side| u64::from(side) * u64::from(samples)).into_iter().max().unwrap_or(0);
    let is_whole = size.iter().zip(sides).all(|(side, whole)| *side == whole as f32 && whole > 0);
    if !is_whole || samples == 0 || most > 1 << 16 {
        return Err(ReferenceError::Size { size, samples });
    }
    Ok(sides)
}
