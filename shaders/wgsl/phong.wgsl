// The yardstick: the wanted tone itself, as continuous grey, per fragment. It binds the same geometry and adjacency
// as the hatching passes. Suarez and others, "GPU real time hatching", 2013, section 4; Phong 1975.
//!include lib/surface.wgsl
//!include lib/light.wgsl

@vertex
fn vertex(in: VertexIn) -> VertexOut {
    return surface_vertex(in, vec2f(0.0));
}

@fragment
fn fragment(in: FragmentIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    return drawn(darkness(reflectance(), point.p_world, point.normal, point.view));
}
