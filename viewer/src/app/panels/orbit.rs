//! Camera and light under the mouse.

use egui::{Modifiers, PointerButton, Vec2};
use glam::{DVec2, DVec3};

use crate::app::pick::Ray;
use crate::app::state::Navigation;
use crate::scene::{Light, LightKind};
use crate::{Camera, ranges};

/// Degrees that a drag by a point turns.
const DEGREES_PER_POINT: f64 = 0.4;

/// What a drag does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drag {
    Turn,
    Shift,
    Zoom,
    Light,
}

/// What a drag with this button does.
pub(super) fn meaning(navigation: Navigation, button: PointerButton, held: Modifiers) -> Option<Drag> {
    use PointerButton::{Middle, Primary, Secondary};
    // The light is on the right button in every scheme, but where that zooms.
    match (navigation, button) {
        (Navigation::Simple, Primary) if held.shift => Some(Drag::Shift),
        (Navigation::Simple, Primary) => Some(Drag::Turn),
        (Navigation::Simple, Middle) => Some(Drag::Shift),
        (Navigation::Blender, Middle) if held.shift => Some(Drag::Shift),
        (Navigation::Blender, Middle) if held.command => Some(Drag::Zoom),
        (Navigation::Blender, Middle) => Some(Drag::Turn),
        (Navigation::Maya, Primary) if held.alt => Some(Drag::Turn),
        (Navigation::Maya, Middle) if held.alt => Some(Drag::Shift),
        (Navigation::Maya, Secondary) if held.alt => Some(Drag::Zoom),
        (_, Primary) if held.shift => Some(Drag::Light),
        (_, Secondary) => Some(Drag::Light),
        _ => None,
    }
}

/// The camera after a drag by `by`, in points, in a view of this height; it turns about `pivot`, which stays where it is
/// seen, and without one about its target.
pub(super) fn dragged(camera: &Camera, drag: Drag, by: Vec2, height: f32, pivot: Option<DVec3>) -> Camera {
    let mut moved = *camera;
    let (dx, dy) = (f64::from(by.x), f64::from(by.y));
    match drag {
        Drag::Turn => {
            // Where the picture is turned, so are the ways about the upright axis and over the top.
            let (sin, cos) = camera.roll_deg.to_radians().sin_cos();
            let (dx, dy) = (dx * cos - dy * sin, dx * sin + dy * cos);
            moved.azimuth_deg = (camera.azimuth_deg - dx * DEGREES_PER_POINT).rem_euclid(360.0);
            moved.elevation_deg = (camera.elevation_deg + dy * DEGREES_PER_POINT).clamp(-90.0, 90.0);
            if let Some(pivot) = pivot {
                let from_target = pivot - camera.target;
                let [right, up] = camera.axes();
                let seen = [from_target.dot(right), from_target.dot(up), from_target.dot(camera.forward())];
                let [right, up] = moved.axes();
                moved.target = within(pivot - right * seen[0] - up * seen[1] - moved.forward() * seen[2]);
            }
        }
        Drag::Shift => {
            let [right, up] = camera.axes();
            let unit = camera.pixel_at_1(height.max(1.0) as u32) * camera.distance;
            moved.target = within(camera.target - right * (dx * unit) + up * (dy * unit));
        }
        Drag::Zoom => return zoomed(camera, -dy, None),
        Drag::Light => {}
    }
    moved
}

/// The camera nearer (> 0) or further, by points of a wheel or a drag; `pivot` stays where it is seen, and without one the
/// target.
pub(super) fn zoomed(camera: &Camera, points: f64, pivot: Option<DVec3>) -> Camera {
    let distance = camera.distance * (-points * 0.004).exp();
    let distance = distance.clamp(ranges::DISTANCE.min, ranges::DISTANCE.max);
    let pivot = pivot.unwrap_or(camera.target);
    let target = within(pivot + (camera.target - pivot) * (distance / camera.distance));
    Camera { distance, target, ..*camera }
}

/// The nearest point that a camera may look at.
fn within(target: DVec3) -> DVec3 {
    let limit = ranges::COORDINATE;
    target.clamp(DVec3::splat(limit.min), DVec3::splat(limit.max))
}

/// The point of the plane through the target on a line of sight.
pub(super) fn on_target_plane(camera: &Camera, ray: &Ray) -> DVec3 {
    let along = ray.along.dot(camera.forward());
    ray.from + ray.along * ((camera.target - ray.from).dot(camera.forward()) / along)
}

/// Towards a light, unit, as seen from what the camera looks at.
pub(super) fn towards(light: &Light, camera: &Camera) -> DVec3 {
    match light.kind {
        LightKind::Directional { direction } => (-direction).normalize_or(DVec3::Y),
        LightKind::Positional { position } | LightKind::Spot { position, .. } => {
            (position - camera.target).normalize_or(DVec3::Y)
        }
    }
}

/// The light turned about what the camera looks at, to a direction; its distance stays.
pub(super) fn turned(light: &Light, camera: &Camera, towards: DVec3) -> Light {
    let towards = towards.normalize_or(DVec3::Y);
    let mut turned = *light;
    match &mut turned.kind {
        LightKind::Directional { direction } => *direction = -towards,
        LightKind::Positional { position } => {
            *position = camera.target + towards * position.distance(camera.target);
        }
        LightKind::Spot { position, direction, .. } => {
            *position = camera.target + towards * position.distance(camera.target);
            *direction = -towards;
        }
    }
    turned
}

/// The light after a drag anywhere: it turns as the camera would.
pub(super) fn light_dragged(light: &Light, camera: &Camera, by: Vec2) -> Light {
    let [right, up] = camera.axes();
    let (dx, dy) = (f64::from(by.x) * DEGREES_PER_POINT, f64::from(by.y) * DEGREES_PER_POINT);
    let turn = glam::DQuat::from_axis_angle(up, dx.to_radians()) * glam::DQuat::from_axis_angle(right, dy.to_radians());
    turned(light, camera, turn * towards(light, camera))
}

/// The direction of a point on the ball about the view's middle, `at` in radii; `behind`: on its far side.
pub(super) fn on_ball(camera: &Camera, at: DVec2, behind: bool) -> DVec3 {
    let [right, up] = camera.axes();
    let length = at.length();
    let at = if length > 1.0 { at / length } else { at };
    let depth = (1.0 - at.length_squared()).max(0.0).sqrt();
    let towards_viewer = if behind { -depth } else { depth };
    right * at.x + up * at.y - camera.forward() * towards_viewer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Projection;

    fn cameras() -> impl Iterator<Item = Camera> {
        Projection::ALL
            .into_iter()
            .flat_map(|projection| [0.0, 35.0].map(|roll_deg| Camera { projection, roll_deg, ..Camera::default() }))
    }

    fn seen(camera: &Camera, point: DVec3) -> DVec2 {
        camera.clip_from_world([300, 200], 3.0).project_point3(point).truncate()
    }

    #[test]
    fn what_is_under_the_pointer_stays_there_while_the_wheel_turns() {
        for camera in cameras() {
            let ray = Ray::through(&camera, DVec2::new(0.5, -0.3), 1.5);
            for point in [DVec3::new(0.7, -0.4, 0.5), on_target_plane(&camera, &ray)] {
                for wheel in [60.0, -200.0] {
                    let moved = zoomed(&camera, wheel, Some(point));
                    assert!(seen(&moved, point).distance(seen(&camera, point)) < 1e-9, "{camera:?}");
                    assert!((moved.distance < camera.distance) == (wheel > 0.0));
                }
            }
        }
    }

    #[test]
    fn a_camera_turns_about_the_point_that_was_picked() {
        for camera in cameras() {
            let point = DVec3::new(0.7, -0.4, 0.5);
            let moved = dragged(&camera, Drag::Turn, egui::vec2(80.0, -40.0), 400.0, Some(point));
            assert!(seen(&moved, point).distance(seen(&camera, point)) < 1e-9, "{camera:?}");
            let depth = |camera: &Camera| (point - camera.place()).dot(camera.forward());
            assert!((depth(&moved) - depth(&camera)).abs() < 1e-9 && moved.distance == camera.distance);
            let about_target = dragged(&camera, Drag::Turn, egui::vec2(80.0, -40.0), 400.0, None);
            assert_eq!((about_target.target, about_target.azimuth_deg), (camera.target, moved.azimuth_deg));
        }
    }

    #[test]
    fn what_is_near_follows_the_mouse_however_the_picture_is_turned() {
        for roll_deg in [0.0, 35.0, 90.0, 180.0, -120.0] {
            let camera = Camera { elevation_deg: 0.0, roll_deg, ..Camera::default() };
            let near = camera.target - camera.forward();
            for by in [egui::vec2(12.0, 0.0), egui::vec2(0.0, 12.0), egui::vec2(-7.0, 9.0)] {
                let moved = dragged(&camera, Drag::Turn, by, 400.0, None);
                let went = seen(&moved, near) - seen(&camera, near);
                // Up on the screen is down for the mouse; the picture is wider than high.
                let went = DVec2::new(went.x * 1.5, went.y).normalize();
                let wanted = DVec2::new(f64::from(by.x), -f64::from(by.y)).normalize();
                assert!(went.dot(wanted) > 0.99, "{roll_deg}: {went} {wanted}");
            }
        }
    }

    #[test]
    fn a_shifted_camera_moves_the_mesh_with_the_mouse() {
        let camera = Camera::default();
        let by = egui::vec2(30.0, -20.0);
        let moved = dragged(&camera, Drag::Shift, by, 400.0, None);
        let place = |camera: &Camera| camera.clip_from_world([400, 400], 2.0).project_point3(DVec3::ZERO);
        let shift = (place(&moved) - place(&camera)).truncate() * 200.0;
        assert!((shift.x - 30.0).abs() < 0.5 && (shift.y - 20.0).abs() < 0.5, "{shift}");
    }

    #[test]
    fn a_light_on_the_ball_lies_under_the_mouse() {
        let camera = Camera::default();
        let [right, up] = camera.axes();
        for (x, y, behind) in [(0.3, 0.5, false), (-0.7, 0.1, true), (2.0, 0.0, false)] {
            let towards = on_ball(&camera, DVec2::new(x, y), behind);
            assert!((towards.length() - 1.0).abs() < 1e-9);
            let seen = DVec2::new(towards.dot(right), towards.dot(up));
            let wanted = DVec2::new(x, y) / DVec2::new(x, y).length().max(1.0);
            assert!(seen.distance(wanted) < 1e-9);
            assert!(behind == (towards.dot(camera.forward()) > 0.0) || x > 1.0);
        }
        let light = Light::at(DVec3::new(0.0, 3.0, 0.0));
        let moved = turned(&light, &camera, DVec3::X);
        assert!(
            matches!(moved.kind, LightKind::Positional { position } if position.distance(DVec3::new(3.0, 0.0, 0.0)) < 1e-9)
        );
    }

    #[test]
    fn no_drag_leaves_the_ranges() {
        let mut camera = Camera::default();
        for _ in 0..2000 {
            camera = zoomed(&camera, 500.0, None);
            camera = dragged(&camera, Drag::Turn, egui::vec2(1e4, 1e4), 100.0, Some(DVec3::splat(900.0)));
            camera = dragged(&camera, Drag::Shift, egui::vec2(-1e6, 1e6), 0.0, None);
        }
        assert!(ranges::DISTANCE.contains(camera.distance) && camera.elevation_deg == 90.0);
        assert!(ranges::COORDINATE.contains(camera.target.x) && camera.target.is_finite());
    }
}
