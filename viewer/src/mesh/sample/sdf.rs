//! Signed distance functions: negative inside. Primitives are exact or first-order near their surface; sums of them
//! by smooth minimum keep that.
//!
//! Source: J. C. Hart, "Sphere tracing", The Visual Computer 12, 1996, appendix; smooth minimum with finite support
//! after the polynomial blends of A. Ricci's constructive geometry, The Computer Journal 16, 1973.

use glam::Vec3;

/// To a sphere.
pub(super) fn sphere(p: Vec3, centre: Vec3, radius: f32) -> f32 {
    p.distance(centre) - radius
}

/// To an ellipsoid along the axes: the implicit function divided by its gradient, so first-order at the surface.
pub(super) fn ellipsoid(p: Vec3, centre: Vec3, radii: Vec3) -> f32 {
    let q = (p - centre) / radii;
    let level = q.length();
    let gradient = (q / radii).length();
    if gradient < 1e-6 { -radii.min_element() } else { level * (level - 1.0) / gradient }
}

/// To the hull of two spheres.
pub(super) fn round_cone(p: Vec3, a: Vec3, b: Vec3, radius_a: f32, radius_b: f32) -> f32 {
    let axis = b - a;
    let length = axis.length();
    let from_a = p - a;
    let along = from_a.dot(axis) / length;
    let across = (from_a.length_squared() - along * along).max(0.0).sqrt();
    // In the half plane through the axis the side is a line that leans by `lean` towards the smaller sphere.
    let lean = ((radius_a - radius_b) / length).clamp(-1.0, 1.0);
    let upright = (1.0 - lean * lean).sqrt();
    let foot = along * upright - across * lean;
    if foot < 0.0 {
        from_a.length() - radius_a
    } else if foot > length * upright {
        p.distance(b) - radius_b
    } else {
        across * upright + along * lean - radius_a
    }
}

/// To the points within `radius` of a segment.
pub(super) fn capsule(p: Vec3, a: Vec3, b: Vec3, radius: f32) -> f32 {
    let axis = b - a;
    let t = ((p - a).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    p.distance(a + axis * t) - radius
}

/// Union whose concave edge is filled by a round of about `width`; equal to the minimum where the two differ by more.
pub(super) fn unite(a: f32, b: f32, width: f32) -> f32 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.min(b) - overlap * overlap / (4.0 * width)
}

/// `a` without `b`, its new edge rounded by about `width`.
pub(super) fn subtract(a: f32, b: f32, width: f32) -> f32 {
    intersect(a, -b, width)
}

/// What is in both, the edge rounded by about `width`.
pub(super) fn intersect(a: f32, b: f32, width: f32) -> f32 {
    -unite(-a, -b, width)
}

/// 1 at 0, smoothly down to 0 from `width` on.
pub(super) fn bump(x: f32, width: f32) -> f32 {
    let inside = (1.0 - (x / width).powi(2)).max(0.0);
    inside * inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_cone_meets_its_spheres_and_its_side() {
        let (a, b) = (Vec3::ZERO, Vec3::new(0.0, 4.0, 0.0));
        let distance = |p| round_cone(p, a, b, 1.0, 0.5);
        assert!((distance(Vec3::new(0.0, -2.0, 0.0)) - 1.0).abs() < 1e-6);
        assert!((distance(Vec3::new(0.0, 5.0, 0.0)) - 0.5).abs() < 1e-6);
        // The side touches both spheres: a point one unit off along its normal is one unit away.
        let normal = Vec3::new((1.0f32 - 0.125 * 0.125).sqrt(), 0.125, 0.0);
        let mid = (a + normal + b + normal * 0.5) / 2.0;
        assert!(distance(mid).abs() < 1e-6);
        assert!((distance(mid + normal) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn blends_keep_what_is_far_and_fill_the_seam() {
        assert_eq!(unite(0.3, 2.0, 0.5), 0.3);
        assert!((unite(0.2, 0.2, 0.4) - 0.1).abs() < 1e-6);
        assert_eq!(subtract(0.3, 2.0, 0.5), 0.3);
        assert!(subtract(-1.0, -0.5, 0.1) > 0.0);
    }
}
