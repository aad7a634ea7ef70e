//! What the functions under test are bound to: a few scenes, materials and maps, on both sides.

use glam::{DVec2, DVec4, Mat4, Vec3};
use tam_shaders::cpu::builtin::pack2x16unorm;
use tam_shaders::cpu::lib::columns::columns_per_tone;
use tam_shaders::cpu::lib::edges::LineStyle;
use tam_shaders::cpu::lib::material::Material;
use tam_shaders::cpu::lib::mesh::Mesh;
use tam_shaders::cpu::lib::mesh_types::{FaceFrame, Vertex};
use tam_shaders::cpu::lib::patches::{NO_SEED, OVERLAPS, Overlap, TURNS, carried_overlap, fetched, pack_place};
use tam_shaders::cpu::lib::scene::Scene;
use tam_shaders::cpu::lib::threshold::ROWS_PER_LEVEL;
use tam_shaders::cpu::{Bindings, MapImage, MapLevel, Options};
use tam_shaders::types::{self, Edge, NO_FACE, NO_NORMAL, PatchCorner};
use wgpu::util::DeviceExt;

use crate::draw::{Case, Draw};
use crate::gpu::Gpu;

/// Towards the first light of every scene.
pub(crate) const LIGHT: [f64; 3] = [0.36, 0.48, 0.8];
/// Tones of the columns of the six-column material.
pub(crate) const TONES: [f32; 7] = [0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 0.95];
/// Faces of the mesh; all triples of its vertices.
pub(crate) const FACES: usize = 64;
const VERTICES: usize = 48;
/// Corners that see patches.
pub(crate) const CORNERS: usize = 96;
/// Seeds of the patches.
const SEEDS: usize = 20;

/// One scene with one object.
pub(crate) struct Setting {
    pub(crate) scene: types::Scene,
    pub(crate) material: types::Material,
    pub(crate) style: types::LineStyle,
    pub(crate) vertices: Vec<types::Vertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) neighbours: Vec<u32>,
    pub(crate) edges: Vec<Edge>,
    pub(crate) face_normals: Vec<[f32; 4]>,
    pub(crate) face_planes: Vec<[f32; 4]>,
    pub(crate) face_frames: Vec<types::FaceFrame>,
    pub(crate) seed_turns: Vec<[f32; 4]>,
    pub(crate) map: MapImage,
    pub(crate) distribution: Vec<Vec<[f32; 2]>>,
    pub(crate) twin: Twin,
}

/// The same in 64 bits.
pub(crate) struct Twin {
    scene: Scene,
    material: Material,
    pub(crate) style: LineStyle,
    vertices: Vec<Vertex>,
    face_normals: Vec<DVec4>,
    face_planes: Vec<DVec4>,
    face_frames: Vec<FaceFrame>,
    seed_turns: Vec<DVec4>,
    distribution: Vec<Vec<DVec2>>,
}

impl Setting {
    /// Six uneven columns and one directional light; 64 even columns and a light of each kind; two columns, a mesh that
    /// is moved, turned and stretched, and lights on both sides.
    pub(crate) fn all() -> Vec<Self> {
        let directional = light(0, Vec3::ZERO, -light_direction(), 0.8, 1.0);
        let positional = light(1, Vec3::new(1.5, 2.0, 1.0), Vec3::X, 0.5, 1.0);
        let spot = light(2, Vec3::new(-2.0, 3.0, 2.0), Vec3::new(0.5, -0.7, -0.51).normalize(), 0.9, 6.0);
        let opposite = light(0, Vec3::ZERO, light_direction(), 0.4, 1.0);
        let even: Vec<f32> = (0..=64).map(|k| k as f32 / 64.0).collect();
        let moved = Mat4::from_translation(Vec3::new(0.4, -0.2, 0.7))
            * Mat4::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), 0.9)
            * Mat4::from_scale(Vec3::new(1.3, 0.8, 0.6));
        vec![
            Self::new(1, &[directional], &TONES, Mat4::IDENTITY),
            Self::new(2, &[directional, positional, spot], &even, Mat4::from_scale(Vec3::splat(0.7))),
            Self::new(3, &[spot, directional, opposite], &[0.0, 0.25, 0.9], moved),
        ]
    }

    fn new(seed: u64, lights: &[types::Light], tones: &[f32], world_from_mesh: Mat4) -> Self {
        let draw = |index| Draw::new("setting", seed, index);
        let scene = scene(lights, world_from_mesh);
        let material = material(tones);
        let style = types::LineStyle {
            colour: [0.1, 0.2, 0.3, 0.9],
            width_px: 2.5,
            crease_cosine: 0.4,
            contours: u32::from(seed != 2),
            borders: u32::from(seed != 2),
            creases: 1,
            edges: u32::from(seed == 3),
            ..Default::default()
        };
        let direction = |i: usize, slot: u64| draw(i).direction(slot + 1000).as_vec3();
        let vertex = |i| types::Vertex {
            position: draw(i).place_within(1010, 1.0).as_vec3().into(),
            normal_oct: tam_shaders::cpu::octahedral::oct_encode(direction(i, 20).as_dvec3()),
        };
        // Every face takes a vertex, the one seven further on, and any; the last faces have no area.
        let corner = |face: usize, k: usize| match k {
            0 => face % VERTICES,
            1 => (face + 7) % VERTICES,
            _ if face + 4 > FACES => face % VERTICES,
            _ => (face + 8 + draw(face).pick(1030, VERTICES - 9)) % VERTICES,
        };
        let neighbour = |i: usize| match draw(i).pick(1031, 5) {
            0 => NO_FACE,
            _ => draw(i).pick(1032, FACES) as u32,
        };
        let frame = |i: usize| {
            let (normal, along) = (direction(i, 40), direction(i, 50));
            let tangent = along.cross(normal).try_normalize().unwrap_or(Vec3::X);
            let bitangent = normal.cross(tangent);
            let shares = [1033, 1034, 1035].map(|slot| draw(i).unit(slot));
            let shares = tam_shaders::cpu::lib::face_frame::pack_shares(shares.into());
            types::FaceFrame {
                tangent: tangent.into(),
                bitangent_x: bitangent.x,
                bitangent_yz: [bitangent.y, bitangent.z],
                shares,
                normal_oct: match i + 4 > FACES {
                    true => NO_NORMAL,
                    false => tam_shaders::cpu::octahedral::oct_encode(normal.as_dvec3()),
                },
            }
        };
        let plane = |i: usize| {
            let draw = draw(i + FACES);
            draw.place_within(1036, 1.0).extend(draw.between(1039, -0.5, 1.0)).as_vec4().into()
        };
        let edge = |i: usize| Edge {
            a: draw(i).pick(1050, VERTICES) as u32,
            b: if i == 0 { draw(0).pick(1050, VERTICES) } else { draw(i).pick(1051, VERTICES) } as u32,
            left: draw(i).pick(1052, FACES) as u32,
            right: neighbour(i + 900),
        };
        let vertices: Vec<_> = (0..VERTICES).map(vertex).collect();
        let has_area = |i: usize| if i + 4 > FACES { 0.0 } else { 1.0 };
        let face_normals: Vec<[f32; 4]> = (0..FACES).map(|i| direction(i, 40).extend(has_area(i)).into()).collect();
        let face_planes: Vec<[f32; 4]> = (0..2 * FACES).map(plane).collect();
        let face_frames: Vec<_> = (0..FACES).map(frame).collect();
        let turn = |i: usize| -> [f32; 4] {
            let (uv, draw) = (draw(i).tile(1092, 1.0), draw(i));
            DVec4::new(uv.x, uv.y, draw.between(1094, -3.2, 3.2), draw.between(1095, 0.0, 0.5)).as_vec4().into()
        };
        let seed_turns: Vec<[f32; 4]> = (0..TURNS * SEEDS).map(turn).collect();
        let map = noise_map(seed, tones.len() - 1);
        let distribution = distribution(seed);
        let pair = |pair: &[f32; 2]| DVec2::from(pair.map(f64::from));
        let twin = Twin {
            scene: (&scene).into(),
            material: (&material).into(),
            style: (&style).into(),
            vertices: vertices.iter().map(Vertex::from).collect(),
            face_normals: face_normals.iter().map(|normal| DVec4::from(normal.map(f64::from))).collect(),
            face_planes: face_planes.iter().map(|plane| DVec4::from(plane.map(f64::from))).collect(),
            face_frames: face_frames.iter().map(FaceFrame::from).collect(),
            seed_turns: seed_turns.iter().map(|turn| DVec4::from(turn.map(f64::from))).collect(),
            distribution: distribution.iter().map(|row| row.iter().map(pair).collect()).collect(),
        };
        Self {
            scene,
            material,
            style,
            vertices,
            indices: (0..3 * FACES).map(|i| corner(i / 3, i % 3) as u32).collect(),
            neighbours: (0..3 * FACES).map(neighbour).collect(),
            edges: (0..FACES).map(edge).collect(),
            face_normals,
            face_planes,
            face_frames,
            seed_turns,
            map,
            distribution,
            twin,
        }
    }

    /// What the twins read.
    pub(crate) fn bindings(&self, options: Options) -> Bindings<'_> {
        Bindings {
            options,
            scene: &self.twin.scene,
            mesh: Mesh {
                vertices: &self.twin.vertices,
                indices: &self.indices,
                neighbours: &self.neighbours,
                face_normals: &self.twin.face_normals,
                face_planes: &self.twin.face_planes,
                face_frames: &self.twin.face_frames,
            },
            material: &self.twin.material,
            map: &self.map,
            distribution: &self.twin.distribution,
            turns: &self.twin.seed_turns,
        }
    }
}

/// A corner of a triangle, the same in all settings: four patches anywhere on the tile, the last of which may not be there,
/// which seeds they have, and of each two rows with a sign and a number of up to 100.
#[derive(Clone, Copy)]
pub(crate) struct Corner {
    pub(crate) patches: PatchCorner,
    pub(crate) seeds: [u32; OVERLAPS],
    pub(crate) rows: [u32; OVERLAPS],
}

impl Corner {
    pub(crate) fn new(i: usize) -> Self {
        let draw = Draw::new("corner", 7, i);
        let behind = |slot: u64| DVec2::new(0.5 * draw.unit(slot), if draw.pick(slot + 1, 3) == 0 { 1.0 } else { 0.1 });
        let places = std::array::from_fn::<_, OVERLAPS, _>(|i| pack_place(draw.tile(1100 + 2 * i as u64, 2.0)));
        let seed = |slot| if draw.pick(slot, 8) == 0 { NO_SEED } else { draw.pick(slot + 10, SEEDS) as u32 };
        let half = |slot| ((draw.pick(slot, 400) as i32 - 200) & 0xffff) as u32;
        Self {
            patches: PatchCorner { places, behind: [pack2x16unorm(behind(1110)), pack2x16unorm(behind(1112))] },
            seeds: [1130, 1131, 1132, 1133].map(seed),
            rows: [1150, 1152, 1154, 1156].map(|slot| half(slot) | half(slot + 1) << 16),
        }
    }

    /// What a vertex sees that carries it.
    pub(crate) fn overlap(&self, options: Options) -> Overlap {
        let (places, behind) = fetched(&self.patches);
        carried_overlap(options.mapping, places, behind, self.seeds)
    }
}

/// All corners, four vectors each.
fn corner_words() -> Vec<[u32; 4]> {
    let words = |i| {
        let Corner { patches: PatchCorner { places, behind: [ab, cd] }, seeds, rows } = Corner::new(i);
        [places, [ab, cd, 0, 0], seeds, rows]
    };
    (0..CORNERS).flat_map(words).collect()
}

fn light_direction() -> Vec3 {
    Vec3::from(LIGHT.map(|component| component as f32))
}

fn light(kind: u32, position: Vec3, direction: Vec3, intensity: f32, exponent: f32) -> types::Light {
    types::Light {
        position: position.into(),
        kind,
        direction: direction.into(),
        cos_cutoff: 0.7,
        intensity,
        exponent,
        _pad: [0.0; 2],
    }
}

fn scene(lights: &[types::Light], world_from_mesh: Mat4) -> types::Scene {
    let camera = Vec3::new(0.7, 0.9, 4.0);
    let forward = (-camera).normalize();
    let view = glam::camera::rh::view::look_to_mat4(camera, forward, Vec3::Y);
    let projection = glam::camera::rh::proj::directx::perspective(0.8, 1.5, 0.1, 20.0);
    let mut all = [types::Light::default(); types::MAX_LIGHTS];
    all[..lights.len()].copy_from_slice(lights);
    let cofactors = world_from_mesh.inverse().transpose() * world_from_mesh.determinant();
    types::Scene {
        clip_from_world: (projection * view).to_cols_array_2d(),
        world_from_mesh: world_from_mesh.to_cols_array_2d(),
        mesh_from_world: world_from_mesh.inverse().to_cols_array_2d(),
        world_from_mesh_normal: cofactors.to_cols_array_2d(),
        camera_world: camera.into(),
        pixel_world_at_1: 0.002,
        camera_forward: forward.into(),
        light_count: lights.len() as u32,
        viewport_px: [600.0, 400.0],
        ambient: 0.3,
        parallel_from: 0.0,
        paper: [0.9, 0.85, 0.8, 1.0],
        ink: [0.02, 0.05, 0.1, 1.0],
        lights: all,
    }
}

fn material(tones: &[f32]) -> types::Material {
    let mut all = [[1.0; 4]; 17];
    all.as_flattened_mut()[..tones.len()].copy_from_slice(tones);
    types::Material {
        colour: [0.7, 0.8, 0.9, 1.0],
        ambient: 0.6,
        diffuse: 0.9,
        specular: 0.25,
        shininess: 12.0,
        tile_from_surface: [1.2, -0.5, 0.5, 1.2],
        shift_uv: [0.125, -0.3],
        tile_scale: 1.3,
        size_px: 16.0,
        level_count: 3.0,
        level_bias: -0.25,
        column_count: tones.len() as u32 - 1,
        first_face: 0,
        slope: 4.0,
        line_period_px: 5.0,
        distribution_entries: 9.0,
        cross_from: 0.4,
        variety: 0.7,
        columns_per_tone: columns_per_tone(&tones[1..].iter().map(|tone| f64::from(*tone)).collect::<Vec<_>>()) as f32,
        _pad_a: 0.0,
        _pad_b: 0.0,
        tones: all,
    }
}

/// 16, 8 and 4 texels of noise, the hardest map to filter. Layer k holds columns k and k + 1 in its first two channels,
/// as methods with many columns read it; there is no white column, so that every channel counts.
fn noise_map(seed: u64, columns: usize) -> MapImage {
    let level = |size: u32| {
        let noise = |column: usize, i: usize| {
            Draw::new("noise", seed + u64::from(size), i).pick(1000 + column as u64, 256) as u8
        };
        let texel = |layer: usize, i| [noise(layer, i), noise(layer + 1, i), noise(layer + 100, i), 255];
        let layer = |layer| (0..(size * size) as usize).map(|i| texel(layer, i)).collect();
        MapLevel { size, layers: (0..columns.max(2)).map(layer).collect() }
    };
    MapImage { levels: [16, 8, 4].map(level).to_vec(), ..MapImage::default() }
}

/// Rows for three levels that increase from 0 to 1, with rates of any kind.
fn distribution(seed: u64) -> Vec<Vec<[f32; 2]>> {
    let row = |row: usize| {
        let draw = Draw::new("distribution", seed, row);
        let power = draw.between(1000, 0.4, 2.5);
        (0..9).map(|i| [(i as f64 / 8.0).powf(power) as f32, draw.between(1001 + i, 0.0, 8.0) as f32]).collect()
    };
    (0..=2 * ROWS_PER_LEVEL).map(row).collect()
}

/// The buffers and textures of a setting.
pub(crate) struct Uploaded {
    buffers: Vec<(&'static str, wgpu::Buffer)>,
    map: wgpu::TextureView,
    sampler: wgpu::Sampler,
    distribution: wgpu::TextureView,
    seed_turns: wgpu::TextureView,
}

impl Uploaded {
    /// Uploads a setting and the cases of a run.
    pub(crate) fn new(gpu: &Gpu, setting: &Setting, cases: &[Case]) -> Self {
        let buffer = |contents: &[u8], usage| {
            let usage = usage | wgpu::BufferUsages::COPY_SRC;
            gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let (uniform, storage) = (wgpu::BufferUsages::UNIFORM, wgpu::BufferUsages::STORAGE);
        let cases: Vec<f32> = cases.as_flattened().iter().flat_map(|v| v.as_vec4().to_array()).collect();
        let buffers = vec![
            ("scene", buffer(bytemuck::bytes_of(&setting.scene), uniform)),
            ("material", buffer(bytemuck::bytes_of(&setting.material), uniform)),
            ("style", buffer(bytemuck::bytes_of(&setting.style), uniform)),
            ("vertices", buffer(bytemuck::cast_slice(&setting.vertices), storage)),
            ("indices", buffer(bytemuck::cast_slice(&setting.indices), storage)),
            ("neighbours", buffer(bytemuck::cast_slice(&setting.neighbours), storage)),
            ("face_normals", buffer(bytemuck::cast_slice(&setting.face_normals), storage)),
            ("face_planes", buffer(bytemuck::cast_slice(&setting.face_planes), storage)),
            ("face_frames", buffer(bytemuck::cast_slice(&setting.face_frames), storage)),
            ("case_corners", buffer(bytemuck::cast_slice(&corner_words()), storage)),
            ("edges", buffer(bytemuck::cast_slice(&setting.edges), storage)),
            ("cases", buffer(bytemuck::cast_slice(&cases), storage)),
        ];
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self {
            buffers,
            map: map_view(gpu, &setting.map),
            sampler,
            distribution: table_view(gpu, &setting.distribution),
            seed_turns: turns_view(gpu, &setting.seed_turns),
        }
    }

    /// The buffer of a shader's variable.
    pub(crate) fn buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.buffers.iter().find(|(of, _)| *of == name).map(|(_, buffer)| buffer)
    }

    /// What a shader's variable is bound to.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match name {
            "map" => Some(wgpu::BindingResource::TextureView(&self.map)),
            "map_sampler" => Some(wgpu::BindingResource::Sampler(&self.sampler)),
            "distribution" => Some(wgpu::BindingResource::TextureView(&self.distribution)),
            "seed_turns" => Some(wgpu::BindingResource::TextureView(&self.seed_turns)),
            _ => self.buffer(name).map(wgpu::Buffer::as_entire_binding),
        }
    }
}

fn map_view(gpu: &Gpu, map: &MapImage) -> wgpu::TextureView {
    let (size, layers) = (map.levels[0].size, map.levels[0].layers.len() as u32);
    let by_layer = (0..layers as usize).flat_map(|layer| map.levels.iter().map(move |level| &level.layers[layer]));
    let texels: Vec<u8> = by_layer.flat_map(|layer| layer.as_flattened()).copied().collect();
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: layers },
        mip_level_count: map.levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, &texels);
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

fn table_view(gpu: &Gpu, rows: &[Vec<[f32; 2]>]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: rows[0].len() as u32, height: rows.len() as u32, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rg32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let entries: Vec<[f32; 2]> = rows.concat();
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(&entries));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Turns in rows of 15.
fn turns_view(gpu: &Gpu, turns: &[[f32; 4]]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: 15, height: turns.len() as u32 / 15, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(turns));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
