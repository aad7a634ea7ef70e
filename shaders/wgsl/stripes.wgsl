// Engraving: one line field over the whole surface, as wide as the tone asks, and a second one across it in the dark.
// Knöppel and others, "Stripe patterns on surfaces", 2015.
//!include lib/surface.wgsl
//!include lib/light.wgsl
//!include lib/mapping.wgsl
//!include lib/barycentric.wgsl
//!include lib/stripes.wgsl

@group(3) @binding(4) var<storage, read> stripes_along: array<StripePhases>;
@group(3) @binding(5) var<storage, read> stripes_across: array<StripePhases>;

// Where a fragment is in its face, and how that changes to the next pixel.
struct Place {
    weights: vec3f,
    dx: vec3f,
    dy: vec3f,
}

fn place_in_face(face: u32, p: vec3f, dx: vec3f, dy: vec3f) -> Place {
    return Place(corner_weights(face, p), corner_slopes(face, dx), corner_slopes(face, dy));
}

fn stripes_ink(s: StripePhases, place: Place, d: f32) -> f32 {
    let slope = vec2f(stripe_slope(s, place.weights, place.dx), stripe_slope(s, place.weights, place.dy));
    return doubled_ink(stripe_phase(s, place.weights), length(slope), material.line_period_px, d);
}

// Ink of both fields.
fn crossed_ink(face: u32, place: Place, d: f32) -> f32 {
    let shares = crossed_darkness(d, material.cross_from);
    let ink = stripes_ink(stripes_along[face], place, shares.x);
    if shares.y <= 0.0 {
        return ink;
    }
    return 1.0 - (1.0 - ink) * (1.0 - stripes_ink(stripes_across[face], place, shares.y));
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> VertexOut {
    return surface_vertex(index);
}

@fragment
fn fragment(in: FragmentIn, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let point = surface_point(in, front);
    let p = frame_place(point.p_world);
    let place = place_in_face(point.face, p, dpdx(p), dpdy(p));
    let d = darkness(reflectance(), point.p_world, point.normal, point.view);
    return drawn(crossed_ink(point.face, place, d));
}
