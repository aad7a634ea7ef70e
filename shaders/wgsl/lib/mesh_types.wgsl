// Records of a mesh's buffers.

struct Vertex {
    position: vec3f,
    // Octahedral, two 16-bit snorm.
    normal_oct: u32,
}

// The light-aligned frame of a face: see lib/face_frame.wgsl.
struct FaceFrame {
    tangent: vec3f,
    bitangent_x: f32,
    bitangent_yz: vec2f,
    // Shares of the frame, of its half turn and of the fixed frame: three 10-bit unorm, low bits first.
    shares: u32,
    // Normal of the face, octahedral, or NO_NORMAL where it has no area.
    normal_oct: u32,
}

// No normal has this code.
const NO_NORMAL: u32 = 0x80008000u;
const NO_FACE: u32 = 0xffffffffu;
