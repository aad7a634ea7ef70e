// The vertex stages of methods that draw with all mappings and need nothing more of their vertices.
//!include lib/patched.wgsl

@vertex
fn vertex(in: VertexIn) -> PatchedOut {
    return patched_vertex(in);
}

@vertex
fn vertex_uv(in: UvIn) -> PatchedOut {
    return patched_uv(in);
}

@vertex
fn vertex_corner(in: CornerIn) -> PatchedOut {
    return patched_corner(in);
}

@vertex
fn vertex_turning(in: TurningIn) -> PatchedOut {
    return patched_turning(in);
}

@vertex
fn vertex_lapped(in: LappedIn) -> LappedOut {
    return lapped_vertex(in);
}

@vertex
fn vertex_face(@builtin(vertex_index) index: u32) -> PatchedOut {
    return patched_face(index);
}
