// The mesh as storage buffers, for passes that look at faces and their neighbours.
//!include lib/mesh_types.wgsl

@group(1) @binding(0) var<storage, read> vertices: array<Vertex>;
@group(1) @binding(2) var<storage, read> indices: array<u32>;
@group(1) @binding(3) var<storage, read> neighbours: array<u32>;
// Face normal in xyz, in the space of the frames; w is 1 where the face has an area, else 0.
@group(1) @binding(4) var<storage, read> face_normals: array<vec4f>;
// Two per face: barycentric weight of corner 0 and of corner 1 as dot(xyz, p) + w.
@group(1) @binding(5) var<storage, read> face_planes: array<vec4f>;
@group(1) @binding(6) var<storage, read> face_frames: array<FaceFrame>;
