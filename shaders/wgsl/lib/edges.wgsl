// Edges of the mesh, and which of them are lines. Praun and others, "Real-Time Hatching", 2001, section 2: silhouettes
// complete hatched drawings. An edge is a contour where one face is seen from the front and the other from behind, so
// contours lie exactly where the drawn mesh ends.

struct LineStyle {
    // Linear light; alpha is opacity.
    colour: vec4f,
    width_px: f32,
    // Edges whose face normals have a smaller dot product are creases.
    crease_cosine: f32,
    contours: u32,
    borders: u32,
    creases: u32,
    // Not 0: every edge is a line.
    edges: u32,
    _pad_a: u32,
    _pad_b: u32,
}

struct Edge {
    // Vertices of its two ends.
    a: u32,
    b: u32,
    // Faces on its two sides; the second may be NO_FACE.
    left: u32,
    right: u32,
}

@group(1) @binding(0) var<storage, read> vertices: array<Vertex>;
// Face normal in xyz, in the space of the frames; w is 1 where the face has an area, else 0.
@group(1) @binding(4) var<storage, read> face_normals: array<vec4f>;
@group(0) @binding(2) var<uniform> style: LineStyle;
@group(2) @binding(0) var<storage, read> edges: array<Edge>;

fn faces_camera(face: u32, p_world: vec3f) -> bool {
    return dot(face_normals[face].xyz, to_camera(p_world)) > 0.0;
}

const LINE_NONE: u32 = 0u;
// In the middle of its edge.
const LINE_CENTRED: u32 = 1u;
// Contours: beside the edge, on the side where the surface ends. The other side rises towards the camera and would
// hide its half of the line.
const LINE_RIGHT: u32 = 2u;
const LINE_LEFT: u32 = 3u;

fn line_kind(edge: Edge, p_world: vec3f) -> u32 {
    if style.edges != 0u {
        return LINE_CENTRED;
    }
    // A face without area has no normal to judge by.
    if face_normals[edge.left].w == 0.0 {
        return LINE_NONE;
    }
    if edge.right == NO_FACE {
        return select(LINE_NONE, LINE_CENTRED, style.borders != 0u);
    }
    if face_normals[edge.right].w == 0.0 {
        return LINE_NONE;
    }
    let front = faces_camera(edge.left, p_world);
    if style.contours != 0u && front != faces_camera(edge.right, p_world) {
        return select(LINE_LEFT, LINE_RIGHT, front);
    }
    let sharp = dot(face_normals[edge.left].xyz, face_normals[edge.right].xyz) < style.crease_cosine;
    return select(LINE_NONE, LINE_CENTRED, style.creases != 0u && sharp);
}

fn end_world(vertex: u32) -> vec3f {
    return (scene.world_from_mesh * vec4f(vertices[vertex].position, 1.0)).xyz;
}
