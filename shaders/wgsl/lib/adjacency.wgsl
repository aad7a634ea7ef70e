// The blend of a face with its neighbours. Suarez and others, "GPU real time hatching", 2013, algorithms 2 and 3.
// The hatching parameters are linear in the corner, V·T and V·B, so a fragment can compute them from its own place as
// well; projecting the opposite corner on the neighbour's plane changes nothing, since T and B lie in that plane.
//!include lib/columns.wgsl
//!include lib/light.wgsl
//!include lib/mapping.wgsl

// Contribution of a neighbour: the cosine of the normals on the shared edge, -1 at the corner opposite to it, linear
// between; `opposite` is that corner's barycentric weight. A hardened blend ends at 0.
fn contribution(cosine: f32, opposite: f32) -> f32 {
    let f = cosine * (1.0 - opposite) - opposite;
    if FORM == FORM_LITERAL {
        return f;
    }
    return max(f, 0.0);
}

// Ink of one face of the four at its own tone. The paper takes the nearest of the tones and lets them pop; the
// hardened form mixes the two that bracket it.
fn contributed_ink(point: Point, n: vec3f, patterns: array<Pattern, 3>, level: f32) -> f32 {
    let d = darkness(reflectance(), point.p_world, n, point.view);
    var x = column_coordinate(d);
    if FORM == FORM_LITERAL {
        x = round(x);
        return column_ink(patterns[0].uv, level, x);
    }
    // Nearly always the frame alone has a share. The loop is tested at its end, as that of the lights.
    let count = select(3u, 1u, patterns[0].weight > 0.999);
    var ink = 0.0;
    var pattern = patterns[0];
    var i = 0u;
    loop {
        ink += pattern.weight * column_ink(pattern.uv, level, x);
        i++;
        if i >= count {
            break;
        }
        pattern = patterns[2];
        if i == 1u {
            pattern = patterns[1];
        }
    }
    return ink;
}
