// Smooth tone from an array of many columns. Webb and others, "Fine tone control in hardware hatching", NPAR 2002, the
// volume scheme: the tone picks a place among the columns, per fragment, and the two that bracket it are mixed.
//!include lib/surface.wgsl
//!include lib/stages.wgsl
//!include lib/light.wgsl
//!include lib/columns.wgsl
//!include lib/blend.wgsl

fn pattern_ink(uv: vec2f, scale: Scale, d: f32) -> f32 {
    return column_ink(uv, scale.level, column_coordinate(d));
}

@fragment
fn fragment(in: FragmentIn, patched: PatchedIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = patched_point(in, patched, front);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(surface_ink(point, overlap_of(patched), d));
}

@fragment
fn fragment_lapped(in: FragmentIn, lapped: LappedFragment, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(lapped_ink(lapped_of(lapped), map_scale(mean_footprint(point)), d));
}
