//! Meshes that are not closed, smooth, oriented and centred, as the sources take them to be.

use glam::{DMat4, DVec3, Vec3, dvec3, vec3};

use super::case::{Case, Hardened, Limit, Literal, Side, StabilityError};
use super::figures::{beyond_count, difference, inked_count, nan_count};
use super::shapes::{dim, light_from, loaded, sample, slanting, square, unmended};
use super::stand::{Stand, View, both, face_frame};
use crate::mesh::Mesh;
use crate::mesh::sample::Sample;
use crate::params::{Form, RenderParams};
use crate::scene::Scene;

/// Of the cases that count pixels that are no numbers.
const WHOLE_FACES: &str = "A face that is no number has hundreds of pixels here; one that is mended, none.";
const NAN_PX: &str = "pixels that are no number";
const BEYOND_PX: &str = "pixels whiter than paper or blacker than ink";
const CHANGED: &str = "mean difference of ink from the picture as it should be";

pub(super) const CASES: [Case; 12] = [
    Case {
        name: "faces without neighbours",
        method: "face-frame",
        failure: "At a border the adjacency primitive repeats a corner: a triangle without area, whose normal is 0 / 0, \
                  and the blend with it.",
        figure: NAN_PX,
        literal: Literal::Fails(Limit::Above(100.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: WHOLE_FACES,
        run: |stand| {
            let (positions, triangles) = square();
            let mesh = loaded(&positions, &triangles)?;
            broken(stand, [&mesh, &mesh])
        },
    },
    Case {
        name: "a mesh of one triangle",
        method: "face-frame",
        failure: "It has no neighbour at all.",
        figure: NAN_PX,
        literal: Literal::Fails(Limit::Above(100.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: WHOLE_FACES,
        run: |stand| {
            let (positions, _) = square();
            let mesh = loaded(&positions[..3], &[[0, 1, 2]])?;
            broken(stand, [&mesh, &mesh])
        },
    },
    Case {
        name: "three faces on an edge",
        method: "face-frame",
        failure: "None of the other two is the neighbour: the edge is a border to each.",
        figure: NAN_PX,
        literal: Literal::Fails(Limit::Above(100.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: WHOLE_FACES,
        run: |stand| {
            let (mut positions, mut triangles) = square();
            positions.push(vec3(0.3, 0.4, 0.9));
            triangles.push([0, 2, 4]);
            let mesh = loaded(&positions, &triangles)?;
            broken(stand, [&mesh, &mesh])
        },
    },
    Case {
        name: "a face that loses its area while it moves",
        method: "face-frame",
        failure: "Its normal is 0 / 0, and three neighbours blend with it.",
        figure: "pixels that are no number, over 8 views around it",
        literal: Literal::Fails(Limit::Above(10.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "Only the three neighbours show it, some pixels in some of the views.",
        run: collapsed,
    },
    Case {
        name: "faces wound both ways",
        method: "face-frame",
        failure: "Normals of neighbours point to opposite sides: they count against each other, and are lit from behind.",
        figure: CHANGED,
        literal: Literal::Fails(Limit::Above(0.1)),
        hardened: Hardened::Holds,
        holds: Limit::Below(2e-3),
        reason: "Turned faces start at another corner, which rounds otherwise, no more; every third one unlit is far off.",
        run: flipped,
    },
    Case {
        name: "vertices stored once for each face",
        method: "face-frame",
        failure: "Faces that share no vertex index are not found to be neighbours: every edge is a border.",
        figure: NAN_PX,
        literal: Literal::Fails(Limit::Above(100.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: WHOLE_FACES,
        run: |stand| {
            let mesh = sample(Sample::Torus, 800)?;
            let corners = mesh.triangles.iter().flatten();
            let positions: Vec<Vec3> = corners.map(|vertex| mesh.positions[*vertex as usize]).collect();
            let soup: Vec<[u32; 3]> =
                (0..mesh.triangles.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
            broken(stand, [&unmended(&positions, &soup), &loaded(&positions, &soup)?])
        },
    },
    Case {
        name: "vertices that are no numbers",
        method: "face-frame",
        failure: "Faces with them cannot be drawn, nor anything that is computed from all vertices.",
        figure: "inked pixels of a square with two such faces beside it",
        literal: Literal::Fails(Limit::Below(1.0)),
        hardened: Hardened::Holds,
        holds: Limit::Above(100.0),
        reason: "The camera's range is taken from all vertices: one that is no number takes the whole picture with it. The \
                 square alone has thousands of pixels, half of them inked.",
        run: no_numbers,
    },
    Case {
        name: "neighbours that face away",
        method: "face-frame",
        failure: "The cosine between the normals, -1/3 on a tetrahedron, is a weight below 0, and the sum of weights \
                  passes 0.",
        figure: BEYOND_PX,
        literal: Literal::Fails(Limit::Above(100.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "A mean with weights of 0 and more cannot leave the range of what it is of.",
        run: |stand| {
            let positions = [vec3(1.0, 1.0, 1.0), vec3(-1.0, -1.0, 1.0), vec3(-1.0, 1.0, -1.0), vec3(1.0, -1.0, -1.0)];
            let mesh = loaded(&positions, &[[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]])?;
            beyond(stand, &dim(light_from(dvec3(0.2, 0.5, 0.4))), &mesh)
        },
    },
    Case {
        name: "right angles of a cube",
        method: "face-frame",
        failure: "The weight of a neighbour falls from 0 at the shared edge to -1 at the opposite corner.",
        figure: BEYOND_PX,
        literal: Literal::Fails(Limit::Above(20.0)),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "A mean with weights of 0 and more cannot leave the range of what it is of.",
        run: |stand| {
            let mut scene = dim(slanting());
            scene.camera.azimuth_deg = 35.0;
            scene.camera.elevation_deg = 30.0;
            beyond(stand, &scene, &sample(Sample::Cube, 12)?)
        },
    },
    Case {
        name: "poles of a uv sphere",
        method: "face-frame",
        failure: "Slivers meet at one point.",
        figure: "pixels that are no number, seen on both poles",
        literal: Literal::Holds("loading keeps no triangle without area, and every sliver has neighbours"),
        hardened: Hardened::Holds,
        holds: Limit::Below(1.0),
        reason: "A hole at the pole is one pixel at least.",
        run: poles,
    },
    Case {
        name: "vertices far from the origin",
        method: "face-frame",
        failure: "Coordinates in 32 bits leave no digits for the place within the tile.",
        figure: CHANGED,
        literal: Literal::Fails(Limit::Above(0.1)),
        hardened: Hardened::Holds,
        holds: Limit::Below(5e-3),
        reason: "Both meshes are rounded to the steps of 1/16 at 10⁶ already: what is left is the rounding of centre and \
                 scale.",
        run: far_away,
    },
    Case {
        name: "a placement that stretches",
        method: "face-frame",
        failure: "Frames are computed before the mesh is placed, so that strokes are stretched with it.",
        figure: "mean difference of ink from the mesh stretched beforehand",
        literal: Literal::Fails(Limit::Above(0.05)),
        hardened: Hardened::Holds,
        holds: Limit::Below(0.02),
        reason: "Smooth normals come from the stretched mesh in one and from the matrix in the other, and decide the \
                 level only.",
        run: stretched,
    },
];

/// Pixels that are no number of a mesh as it is and of the loaded one, in the literal and in the hardened form.
fn broken(stand: &mut Stand, meshes: [&Mesh; 2]) -> Result<[Side; 2], StabilityError> {
    let mut stage = stand.stage()?;
    let scene = dim(slanting());
    both(|form| {
        let (params, mesh) = (face_frame(form), meshes[usize::from(form == Form::Hardened)]);
        let figure = nan_count(&stage.draw((&scene, &params, mesh))?) as f64;
        stage.side_of(figure, &[(&scene, &params, mesh)])
    })
}

fn beyond(stand: &mut Stand, scene: &Scene, mesh: &Mesh) -> Result<[Side; 2], StabilityError> {
    let mut stage = stand.stage()?;
    both(|form| {
        let params = face_frame(form);
        let figure = beyond_count(&stage.draw((scene, &params, mesh))?) as f64;
        stage.side_of(figure, &[(scene, &params, mesh)])
    })
}

/// Corners of one face fall together: its own area is gone, and three neighbours read it.
fn collapsed(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mut mesh = sample(Sample::Torus, 400)?;
    let [a, b, c] = mesh.triangles[200];
    for vertex in [b, c] {
        mesh.positions[vertex as usize] = mesh.positions[a as usize];
    }
    let seen_from = |azimuth: u32| {
        let mut scene = dim(slanting());
        scene.camera.elevation_deg = 60.0;
        scene.camera.azimuth_deg = f64::from(azimuth) * 45.0;
        scene
    };
    let mut stage = stand.stage()?;
    // Shown where the literal form shows it most.
    let mut worst = (0, 0);
    both(|form| {
        let (params, mut sum) = (face_frame(form), 0);
        for azimuth in 0..8 {
            let found = nan_count(&stage.draw((&seen_from(azimuth), &params, &mesh))?);
            sum += found;
            worst = worst.max((found, azimuth));
        }
        stage.side_of(sum as f64, &[(&seen_from(worst.1), &params, &mesh)])
    })
}

fn no_numbers(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let (mut positions, mut triangles) = square();
    positions.extend([vec3(f32::NAN, 0.0, 0.0), vec3(f32::INFINITY, 1.0, 0.0)]);
    triangles.extend([[0, 1, 4], [1, 2, 5]]);
    let meshes = [unmended(&positions, &triangles), loaded(&positions, &triangles)?];
    let scene = dim(slanting());
    let mut stage = stand.stage()?;
    both(|form| {
        let (params, mesh) = (face_frame(form), &meshes[usize::from(form == Form::Hardened)]);
        let figure = inked_count(&stage.draw((&scene, &params, mesh))?);
        stage.side_of(figure, &[(&scene, &params, mesh)])
    })
}

/// The figure and pictures of a wanted view and a drawn one, by form.
fn against(stand: &mut Stand, literal: [View<'_>; 2], hardened: [View<'_>; 2]) -> Result<[Side; 2], StabilityError> {
    let mut stage = stand.stage()?;
    both(|form| {
        let [wanted, drawn] = if form == Form::Literal { literal } else { hardened };
        let figure = difference(&stage.draw(wanted)?, &stage.draw(drawn)?);
        stage.side_of(figure, &[drawn])
    })
}

fn flipped(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let sphere = sample(Sample::Sphere, 600)?;
    // Points instead of vertices: the uv seam is no boundary here.
    let mut points = vec![Vec3::ZERO; sphere.point_count];
    for (vertex, point) in sphere.points.iter().enumerate() {
        points[*point as usize] = sphere.positions[vertex];
    }
    let right: Vec<[u32; 3]> =
        sphere.triangles.iter().map(|corners| corners.map(|vertex| sphere.points[vertex as usize])).collect();
    let turned = |(i, [a, b, c]): (usize, &[u32; 3])| if i % 3 == 0 { [*a, *c, *b] } else { [*a, *b, *c] };
    let wrong: Vec<[u32; 3]> = right.iter().enumerate().map(turned).collect();
    let (whole, mended, as_it_is) = (loaded(&points, &right)?, loaded(&points, &wrong)?, unmended(&points, &wrong));
    let scene = dim(slanting());
    let [literal, hardened] = [Form::Literal, Form::Hardened].map(face_frame);
    let wanted = (&scene, &hardened, &whole);
    against(stand, [wanted, (&scene, &literal, &as_it_is)], [wanted, (&scene, &hardened, &mended)])
}

fn poles(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let mesh = sample(Sample::Sphere, 2000)?;
    let scenes = [-90.0, 90.0].map(|elevation_deg| {
        let mut scene = dim(slanting());
        scene.camera.elevation_deg = elevation_deg;
        scene
    });
    let mut stage = stand.stage()?;
    both(|form| {
        let params = face_frame(form);
        let views = scenes.each_ref().map(|scene| (scene, &params, &mesh));
        let found = nan_count(&stage.draw(views[0])?) + nan_count(&stage.draw(views[1])?);
        stage.side_of(found as f64, &views)
    })
}

/// Steps of f32 at 10⁶ are 1/16: a mesh of the usual size would be rubble, so this one is larger.
fn far_away(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let torus = sample(Sample::Torus, 800)?;
    let far: Vec<Vec3> = torus.positions.iter().map(|p| *p * 1000.0 + 1e6).collect();
    let rounded: Vec<Vec3> = far.iter().map(|p| (*p - 1e6) / 1000.0).collect();
    let scene = dim(slanting());
    let (near, brought_back) = (loaded(&rounded, &torus.triangles)?, loaded(&far, &torus.triangles)?);
    let mut as_it_is = unmended(&far, &torus.triangles);
    as_it_is.neighbours.clone_from(&near.neighbours);
    let mut far_scene = scene.clone();
    far_scene.camera.target = DVec3::splat(1e6);
    far_scene.camera.distance *= 1000.0;
    let [literal, hardened] =
        [Form::Literal, Form::Hardened].map(|form| RenderParams { tiles_per_unit: 1.5, ..face_frame(form) });
    let far_params = RenderParams { tiles_per_unit: 1.5e-3, ..literal };
    against(
        stand,
        [(&scene, &literal, &near), (&far_scene, &far_params, &as_it_is)],
        [(&scene, &hardened, &near), (&scene, &hardened, &brought_back)],
    )
}

fn stretched(stand: &mut Stand) -> Result<[Side; 2], StabilityError> {
    let torus = sample(Sample::Torus, 800)?;
    let stretch = dvec3(0.5, 1.0, 1.4);
    let mut stretched = torus.clone();
    for position in &mut stretched.positions {
        *position *= stretch.as_vec3();
    }
    let mut normals = Vec::new();
    stretched.normals_of(&stretched.positions, &mut normals);
    stretched.normals = normals;
    let by_vertex = dim(slanting());
    let mut by_matrix = by_vertex.clone();
    by_matrix.world_from_mesh = DMat4::from_scale(stretch);
    let [literal, hardened] = [Form::Literal, Form::Hardened].map(face_frame);
    let sides = |params| [(&by_vertex, params, &stretched), (&by_matrix, params, &torus)];
    against(stand, sides(&literal), sides(&hardened))
}
