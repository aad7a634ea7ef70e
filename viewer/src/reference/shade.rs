//! The passes that shade surfaces: what their vertices hand on, and their fragments.

use glam::{DVec2, DVec3, DVec4};
use tam_shaders::cpu::face_frame_vertex::HatchOut;
use tam_shaders::cpu::lib::faced::faced_vertex;
use tam_shaders::cpu::lib::patched::lapped_vertex;
use tam_shaders::cpu::lib::patches::{OVERLAPS, Overlap};
use tam_shaders::cpu::lib::stages::{Carried, stage};
use tam_shaders::cpu::lib::striped::{line_vertex, stroke_vertex};
use tam_shaders::cpu::lib::surface::{FragmentIn, VertexOut};
use tam_shaders::cpu::six_way::{Weights, vertex_weights, weighted_tone};
use tam_shaders::cpu::{
    Bindings, Quad, debug, face_frame, face_frame_vertex, fine_tone, phong, six_way, stripes, stroke_map,
};
use tam_shaders::{Feed, Pass};

use super::ReferenceError;

/// A pass that shades surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shader {
    Phong,
    SixWay,
    FaceFrame,
    FaceFrameVertex,
    StrokeMap,
    FineTone,
    Stripes,
    Debug,
}

/// What a vertex hands on; each pass fills what it has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corner {
    pub(super) clip: DVec4,
    p_world: DVec3,
    normal: DVec3,
    uv: DVec2,
    six: Weights,
    tone: f64,
    overlap: Overlap,
    over: Overlap,
    ring: DVec4,
    rows: [u32; OVERLAPS],
    hatch: HatchOut,
}

impl Shader {
    pub(super) fn of(pass: Pass) -> Result<Self, ReferenceError> {
        match pass {
            Pass::Phong => Ok(Self::Phong),
            Pass::SixWay => Ok(Self::SixWay),
            Pass::FaceFrame => Ok(Self::FaceFrame),
            Pass::FaceFrameVertex => Ok(Self::FaceFrameVertex),
            Pass::StrokeMap => Ok(Self::StrokeMap),
            Pass::FineTone => Ok(Self::FineTone),
            Pass::Stripes => Ok(Self::Stripes),
            Pass::Debug => Ok(Self::Debug),
            Pass::FaceGeometry | Pass::FaceFrames | Pass::LineEdges | Pass::Lines => {
                Err(ReferenceError::NoSurface(pass))
            }
        }
    }

    /// A corner of a triangle, from what its vertex carries.
    pub(super) fn corner(self, b: &Bindings<'_>, feed: Feed, carried: &Carried) -> Corner {
        if self == Self::FaceFrameVertex {
            let hatch = face_frame_vertex::vertex(b, carried.index);
            return Corner { clip: hatch.clip, hatch, ..Corner::default() };
        }
        let Carried { vertex, patches, seeds, lines, rows, index, .. } = carried;
        let mut over = Overlap::default();
        let (surface, overlap, ring) = match feed {
            Feed::Lapped => {
                let (surface, lapped) = lapped_vertex(b, vertex, [patches, &carried.over]);
                over = lapped.then;
                (surface, lapped.first, DVec4::ZERO)
            }
            Feed::Lines => {
                let (surface, ring) = line_vertex(b, vertex, lines);
                (surface, Overlap::default(), ring)
            }
            Feed::Strokes => stroke_vertex(b, vertex, (patches, *seeds), lines),
            Feed::Faced => (faced_vertex(b, *index).0, Overlap::default(), DVec4::ZERO),
            _ => {
                let (surface, overlap) = stage(b, feed, carried);
                (surface, overlap, DVec4::ZERO)
            }
        };
        let six = if self == Self::SixWay { vertex_weights(b, &surface) } else { Weights::default() };
        let tone = if self == Self::SixWay { weighted_tone(b.material, &six) } else { 0.0 };
        let VertexOut { clip, p_world, normal, uv } = surface;
        Corner { clip, p_world, normal, uv, six, tone, overlap, over, ring, rows: *rows, hatch: HatchOut::default() }
    }

    /// Colour of one fragment of a quad, linear light. `weights` are those of the corners at each fragment, `place_px`
    /// is its middle on the screen.
    #[expect(clippy::too_many_arguments, reason = "what the rasteriser knows of a fragment")]
    pub(super) fn fragment(
        self,
        b: &Bindings<'_>,
        feed: Feed,
        corners: &[Corner; 3],
        face: u32,
        weights: &Quad<DVec3>,
        place_px: DVec2,
        lane: usize,
        front: bool,
    ) -> DVec4 {
        let quad = weights.map(|weights| FragmentIn {
            p_world: mixed(*weights, corners.map(|corner| corner.p_world)),
            normal: mixed(*weights, corners.map(|corner| corner.normal)),
            uv: mixed(*weights, corners.map(|corner| corner.uv)),
            overlap: Overlap::mixed(*weights, corners.map(|corner| corner.overlap)),
            over: Overlap::mixed(*weights, corners.map(|corner| corner.over)),
            tone: mixed(*weights, corners.map(|corner| corner.tone)),
            ring: mixed(*weights, corners.map(|corner| corner.ring)),
            rows: corners[0].rows,
            face,
        });
        match self {
            Self::Phong => phong::fragment(b, &quad[lane], front),
            Self::FineTone if feed == Feed::Lapped => fine_tone::fragment_lapped(b, &quad[lane], front),
            Self::FineTone => fine_tone::fragment(b, &quad, lane, front),
            Self::StrokeMap if feed == Feed::Lapped => stroke_map::fragment_lapped(b, &quad[lane], front),
            Self::StrokeMap => stroke_map::fragment(b, &quad, lane, front),
            Self::Stripes if feed == Feed::Strokes => stripes::fragment_strokes(b, &quad, lane, front),
            Self::Stripes => stripes::fragment(b, &quad, lane, front),
            Self::Debug if feed == Feed::Lapped => debug::fragment_lapped(b, &quad, place_px, lane, front),
            Self::Debug if feed == Feed::Lines => debug::fragment_lines(b, &quad, place_px, lane, front),
            Self::Debug if feed == Feed::Faced => debug::fragment_faces(b, &quad[lane], front),
            Self::Debug => debug::fragment(b, &quad, place_px, lane, front),
            Self::FaceFrame => face_frame::fragment(b, &quad[lane], front),
            Self::SixWay if feed == Feed::Lapped => six_way::fragment_lapped(b, &quad[lane], front),
            Self::SixWay => {
                let six = Weights {
                    light: mixed(weights[lane], corners.map(|corner| corner.six.light)),
                    dark: mixed(weights[lane], corners.map(|corner| corner.six.dark)),
                };
                six_way::fragment(b, &quad, &six, lane, front)
            }
            Self::FaceFrameVertex => {
                let hatches = corners.map(|corner| corner.hatch);
                face_frame_vertex::fragment(b, &mixed_hatch(weights[lane], &hatches), front)
            }
        }
    }
}

fn mixed<T: std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>>(weights: DVec3, [a, b, c]: [T; 3]) -> T {
    a * weights.x + b * weights.y + c * weights.z
}

fn mixed_hatch(weights: DVec3, corners: &[HatchOut; 3]) -> HatchOut {
    HatchOut {
        clip: corners[0].clip,
        p_world: mixed(weights, corners.map(|corner| corner.p_world)),
        normal: mixed(weights, corners.map(|corner| corner.normal)),
        st: std::array::from_fn(|i| mixed(weights, corners.map(|corner| corner.st[i]))),
        contributions: std::array::from_fn(|i| mixed(weights, corners.map(|corner| corner.contributions[i]))),
        normals_oct: corners[0].normals_oct,
        shares: corners[0].shares,
    }
}
