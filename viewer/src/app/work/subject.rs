//! What ways to draw are measured on: the open scene, with its mesh and its map.

use tam_gen::Preset;

use super::named::Named;
use super::results::Results;
use super::surface::MadeSurface;
use crate::app::state::{Look, State, colours_of};
use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::scene::Lights;
use crate::surface::SurfaceOptions;
use crate::{RenderParams, Scene};

/// A scene that stands still. Two are the same where all ways to draw them cost and err the same.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    /// As it was loaded.
    pub mesh: Named<Mesh>,
    /// With the colours of paper and ink.
    pub scene: Scene,
    /// Of the pictures.
    pub size_px: [u32; 2],
    /// Of the map.
    pub name: String,
    pub preset: Preset,
    pub map: Named<HatchMap>,
    /// What all ways have in common; its method, mapping and form are only one of them.
    pub look: Look,
}

impl PartialEq for Subject {
    fn eq(&self, other: &Self) -> bool {
        // The map follows from its preset, whether or not finer columns were made of it since.
        self.mesh == other.mesh
            && (&self.scene, self.size_px, &self.name, &self.preset)
                == (&other.scene, other.size_px, &other.name, &other.preset)
            && common(&self.look) == common(&other.look)
    }
}

/// A look without what tells ways apart.
fn common(look: &Look) -> Look {
    let RenderParams { method, mapping, form, cross_from, variety, .. } = RenderParams::default();
    let params = RenderParams { method, mapping, form, cross_from, variety, ..bare(&look.params) };
    Look { params, ..look.clone() }
}

/// How strokes are drawn, without lines and colours over them.
pub(super) fn bare(params: &RenderParams) -> RenderParams {
    RenderParams { silhouettes: None, ..*params }
}

impl Subject {
    /// The open scene in the view's shape; `None` while map or mesh are still to be made. Pictures are as large as the
    /// view, and no larger than so many pixels.
    pub(super) fn of(state: &State, results: &Results, scene: &Scene, view_px: [u32; 2], most_px: f64) -> Option<Self> {
        let document = &state.document;
        let map = results.map.as_ref().filter(|map| !map.draft && map.preset == document.preset)?;
        let mesh = results.mesh.as_ref().filter(|mesh| mesh.source == document.mesh)?;
        if results.map_problem.is_some() {
            return None;
        }
        let mut scene = scene.clone();
        (scene.paper, scene.ink) = colours_of(&document.preset);
        Some(Self {
            mesh: mesh.mesh.clone(),
            scene,
            size_px: shrunk(view_px, most_px),
            name: state.preset_name(),
            preset: document.preset.clone(),
            map: map.hatch.clone(),
            look: document.look.fitted(&mesh.mesh),
        })
    }

    /// What all these ways together need of the surface; their field in any case.
    pub(super) fn surface_options<'a>(&self, ways: impl IntoIterator<Item = &'a RenderParams>) -> SurfaceOptions {
        let lights: &Lights = &self.scene.lights;
        let mut all = SurfaceOptions {
            field: self.look.field_options(lights, self.scene.world_from_mesh),
            ..SurfaceOptions::default()
        };
        for params in ways {
            let look = Look { params: *params, ..self.look.clone() };
            let Some(SurfaceOptions { patches, lapped, stripes, .. }) =
                look.surface_options(lights, self.scene.world_from_mesh)
            else {
                continue;
            };
            all.patches = all.patches.or(patches);
            all.lapped = all.lapped.or(lapped);
            all.stripes = all.stripes.or(stripes);
        }
        all
    }

    /// A surface with these options among those that were made.
    pub(super) fn made<'a>(&self, options: &SurfaceOptions, made: &'a [MadeSurface]) -> Option<&'a MadeSurface> {
        made.iter().find(|made| made.request.mesh == self.mesh && made.request.options == *options)
    }
}

/// Sides of a hidden view.
const HIDDEN_PX: [u32; 2] = [256; 2];

/// Pictures' sides are multiples of this, so that a view a little larger is no other scene.
const STEP_PX: f64 = 8.0;

/// A size of the same shape with no more than about so many pixels.
fn shrunk(size_px: [u32; 2], most_px: f64) -> [u32; 2] {
    let size_px = if size_px.contains(&0) { HIDDEN_PX } else { size_px };
    let [width, height] = size_px.map(f64::from);
    let scale = (most_px / (width * height)).sqrt().min(1.0);
    size_px.map(|side| ((f64::from(side) * scale / STEP_PX).round().max(4.0) * STEP_PX) as u32)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::{Form, Mapping, Method};

    /// A cube under a small map.
    pub(in super::super) fn cube() -> Subject {
        let mut preset = Preset::default();
        (preset.map.size, preset.map.coarsest) = (64, 32);
        let mesh = prepare(Sample::Cube.build(200)).expect("a cube").mesh;
        let map = HatchMap::from_preset("test", &preset, &tam_gen::Job::default()).expect("a map");
        let look = Look::default().fitted(&mesh);
        Subject {
            scene: Scene::of(&mesh),
            mesh: Named::mesh(mesh),
            size_px: [96, 64],
            name: "test".into(),
            preset,
            map: Named::map(map),
            look,
        }
    }

    #[test]
    fn another_way_to_draw_is_the_same_subject_and_another_light_is_not() {
        let subject = cube();
        let mut other = subject.clone();
        let params = &mut other.look.params;
        (params.method, params.mapping, params.form) = (Method::Stripes, Mapping::Uv, Form::Literal);
        (params.variety, params.cross_from, params.silhouettes) = (0.3, None, None);
        assert!(subject == other);
        for change in [
            (|subject: &mut Subject| subject.look.params.tiles_per_unit += 1.0) as fn(&mut Subject),
            |subject| subject.scene.camera.azimuth_deg += 1.0,
            |subject| subject.scene.lights.ambient += 0.1,
            |subject| subject.preset.stroke.width_px += 1.0,
            |subject| subject.mesh = subject.mesh.cut(subject.mesh.subdivided(0.1)),
        ] {
            let mut other = subject.clone();
            change(&mut other);
            assert!(subject != other);
        }
    }

    #[test]
    fn pictures_keep_the_shape_of_the_view() {
        assert_eq!(shrunk([1600, 800], 512.0 * 256.0), [512, 256]);
        assert_eq!(shrunk([300, 200], 1e9), [304, 200], "never larger, but for a step");
        assert_eq!(shrunk([0, 700], 256.0 * 256.0), HIDDEN_PX);
        assert!(shrunk([4000, 3], 1e4).into_iter().all(|side| side >= 32));
    }
}
