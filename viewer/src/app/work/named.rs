//! What threads hand to each other, named by what went into it: the same content has the same name wherever it was made,
//! so that what is kept of it is found again after it was loaded anew, and needs no common memory.

use std::fmt;
use std::io::Write as _;
use std::ops::Deref;
use std::sync::Arc;

use crate::maps::HatchMap;
use crate::mesh::Mesh;
use crate::surface::{Surface, SurfaceOptions};

/// The hash of all that a thing was made from.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Name([u8; 32]);

/// A thing that does not change any more, with its name. Two of one name are equal.
pub struct Named<T> {
    name: Name,
    thing: Arc<T>,
}

impl<T> Named<T> {
    /// The thing itself, for whoever keeps it without its name.
    pub fn shared(&self) -> &Arc<T> {
        &self.thing
    }

    fn new(thing: T, parts: Parts) -> Self {
        Self { name: Name(*parts.0.finalize().as_bytes()), thing: Arc::new(thing) }
    }
}

impl Named<Mesh> {
    /// A mesh, named by all that it holds but what it is called.
    pub(crate) fn mesh(mesh: Mesh) -> Self {
        let mut parts = Parts::of("mesh");
        parts.add(bytemuck::cast_slice(&mesh.positions));
        parts.add(bytemuck::cast_slice(&mesh.normals));
        parts.add(bytemuck::cast_slice(&mesh.uvs));
        parts.add(bytemuck::cast_slice(&mesh.points));
        parts.add(bytemuck::cast_slice(&mesh.normal_groups));
        parts.add(bytemuck::cast_slice(&mesh.sources));
        parts.add(bytemuck::cast_slice(&mesh.midpoints));
        parts.add(bytemuck::cast_slice(&mesh.triangles));
        parts.add_debug(&(&mesh.parts, &mesh.placement, &mesh.animation));
        Self::new(mesh, parts)
    }

    /// These parts of it.
    pub(crate) fn only(&self, numbers: &[usize]) -> Self {
        let mut parts = Parts::of("parts of a mesh");
        parts.add(&self.name.0);
        parts.add_debug(&numbers);
        Self::new(self.thing.only(numbers), parts)
    }

    /// The same mesh, cut finer.
    pub(crate) fn cut(&self, finer: Mesh) -> Self {
        let mut parts = Parts::of("cut mesh");
        parts.add(&self.name.0);
        parts.add(bytemuck::cast_slice(&finer.midpoints));
        Self::new(finer, parts)
    }
}

impl Named<Surface> {
    /// What these options made of a mesh.
    pub(crate) fn surface(mesh: &Named<Mesh>, options: &SurfaceOptions, surface: Surface) -> Self {
        let mut parts = Parts::of("surface");
        parts.add(&mesh.name.0);
        parts.add(&serde_json::to_vec(options).unwrap_or_default());
        Self::new(surface, parts)
    }
}

impl Named<HatchMap> {
    /// A map, named by its preset and by what was made of it already; by its texels, where it has no preset.
    pub(crate) fn map(map: HatchMap) -> Self {
        let mut parts = Parts::of("map");
        parts.add_debug(&(map.texels, map.has_fine()));
        if let Some(preset) = &map.preset {
            parts.add(preset.to_toml().as_bytes());
        } else {
            parts.add_debug(&map.grid.tones);
            map.grid.levels.iter().flat_map(|level| &level.cells).for_each(|cell| parts.add(cell));
            let levels = map.stroke_map.iter().flat_map(|strokes| &strokes.levels);
            levels.for_each(|level| parts.add(&level.threshold));
        }
        Self::new(map, parts)
    }
}

/// What goes into a name, each part apart from the next.
struct Parts(blake3::Hasher);

impl Parts {
    /// Of a thing of this kind.
    fn of(kind: &str) -> Self {
        let mut parts = Self(blake3::Hasher::new());
        parts.add(kind.as_bytes());
        parts
    }

    fn add(&mut self, bytes: &[u8]) {
        self.0.update(&(bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
    }

    /// What can be told from others by its printed form alone, as all numbers can.
    fn add_debug(&mut self, thing: &dyn fmt::Debug) {
        // A hash takes whatever it is given.
        let _ = write!(self.0, "{thing:?};");
    }
}

impl<T> Clone for Named<T> {
    fn clone(&self) -> Self {
        Self { name: self.name, thing: Arc::clone(&self.thing) }
    }
}

impl<T> Deref for Named<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.thing
    }
}

impl<T> PartialEq for Named<T> {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl<T> fmt::Debug for Named<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", std::any::type_name::<T>(), blake3::Hash::from_bytes(self.name.0).to_hex())
    }
}

#[cfg(test)]
mod tests {
    use tam_gen::{Job, Preset};

    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;

    fn cube() -> Mesh {
        prepare(Sample::Cube.build(200)).expect("a cube").mesh
    }

    #[test]
    fn a_mesh_loaded_twice_has_one_name_and_any_change_gives_another() {
        let mesh = Named::mesh(cube());
        let called_otherwise = Mesh { name: "other".to_owned(), ..cube() };
        assert_eq!(mesh, Named::mesh(called_otherwise));
        for change in [
            (|mesh: &mut Mesh| mesh.positions[3].x += 1e-6) as fn(&mut Mesh),
            |mesh| mesh.normals[0] = -mesh.normals[0],
            |mesh| mesh.uvs[5].y += 0.5,
            |mesh| mesh.triangles.swap(0, 1),
            |mesh| mesh.parts[0].colour = [0.5; 3],
            |mesh| mesh.placement.scale *= 2.0,
        ] {
            let mut other = cube();
            change(&mut other);
            assert_ne!(mesh, Named::mesh(other));
        }
    }

    #[test]
    fn what_is_made_of_a_mesh_is_named_by_the_mesh_and_by_how() {
        let mesh = Named::mesh(cube());
        let mut finer = [0.5, 0.25].map(|edge| mesh.cut(mesh.subdivided(edge)));
        assert_ne!(finer[0], finer[1]);
        finer[1] = mesh.cut(mesh.subdivided(0.5));
        assert_eq!(finer[0], finer[1]);
        assert_eq!(mesh.only(&[0]), mesh.only(&[0]));
        assert_ne!(mesh.only(&[0]), mesh, "a part is no whole, even where it is all of it");
    }

    #[test]
    fn a_map_is_named_by_its_preset_and_by_what_was_made_of_it() {
        let mut preset = Preset::default();
        (preset.map.size, preset.map.coarsest) = (64, 32);
        let made = |preset: &Preset| HatchMap::from_preset("test", preset, &Job::default()).expect("a map");
        let map = Named::map(made(&preset));
        assert_eq!(map, Named::map(made(&preset)));
        let fine = made(&preset);
        fine.fine().expect("finer tones");
        assert_ne!(map, Named::map(fine), "whoever has one without waits for its finer tones");
        let without = |seed| {
            let mut map = made(&Preset { seed, ..preset.clone() });
            map.preset = None;
            Named::map(map)
        };
        assert_eq!(without(1), without(1));
        assert_ne!(without(1), without(2));
    }
}
