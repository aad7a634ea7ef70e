//! Surfaces in files, so that a mesh that is opened again need not be solved again.
//!
//! A file knows by a hash for which mesh and options it was made, and by another whether it is whole. It holds the
//! field, patches and stripes in the form in which shaders read them; nodes are made anew.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, Vec2};
use tam_shaders::cpu::lib::patches::PLACE_RANGE;

use super::build::{Surface, SurfaceOptions};
use super::field::Field;
use super::graph::Graph;
use super::patches::{Entry, MAX_ENTRIES, Patches, Seed};
use super::stripes::{StripePhases, Stripes};
use crate::mesh::Mesh;
use crate::params::Follow;

/// First bytes of a file, with the version of the format.
const MAGIC: &[u8; 8] = b"TAMSURF2";
/// Magic, key and hash of the rest.
const HEAD: usize = 8 + 32 + 32;
/// Largest file that is read, in bytes.
const MAX_BYTES: u64 = 4 << 30;

/// For which mesh and options a surface is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key([u8; 32]);

/// Why a file of a surface cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// It cannot be read or written.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// It is no file of a surface.
    #[error("it holds no surface of this version")]
    Format,
    /// It is not whole.
    #[error("it is damaged")]
    Damaged,
}

#[derive(serde::Serialize, serde::Deserialize)]
struct Stored {
    field: Field,
    patches: Option<StoredPatches>,
    lapped: Option<StoredPatches>,
    stripes: Option<[Vec<u32>; 2]>,
}

#[derive(serde::Serialize, serde::Deserialize)]
struct StoredPatches {
    seeds: Vec<Seed>,
    starts: Vec<u32>,
    /// Of each entry its seed.
    entry_seeds: Vec<u32>,
    /// Three an entry: its places, as shaders read them.
    places: Vec<u32>,
    /// Three an entry: its distances or alphas.
    shares: Vec<u16>,
    /// Of each entry its rows; empty without stripes.
    rows: Vec<u32>,
    tiles_per_unit: f64,
    follow: Follow,
    lapped: bool,
}

impl Key {
    /// The key of a mesh and of what is made of it.
    pub fn new(mesh: &Mesh, options: &SurfaceOptions) -> Self {
        let mut hasher = blake3::Hasher::new();
        let mut add = |bytes: &[u8]| {
            hasher.update(&(bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        add(env!("CARGO_PKG_VERSION").as_bytes());
        add(bytemuck::cast_slice(&mesh.positions));
        add(bytemuck::cast_slice(&mesh.normals));
        add(bytemuck::cast_slice(&mesh.uvs));
        add(bytemuck::cast_slice(&mesh.normal_groups));
        add(bytemuck::cast_slice(&mesh.triangles));
        add(&serde_json::to_vec(options).unwrap_or_default());
        Self(*hasher.finalize().as_bytes())
    }
}

/// The surface of a file; `None` if it was made for another mesh or other options.
///
/// # Errors
/// [`StoreError`]: the file cannot be read, is none of a surface, or is damaged.
pub fn read(path: &Path, mesh: &Mesh, options: &SurfaceOptions) -> Result<Option<Surface>, StoreError> {
    if std::fs::metadata(path)?.len() > MAX_BYTES {
        return Err(StoreError::Format);
    }
    parse(&std::fs::read(path)?, mesh, options)
}

/// The surface of a file's bytes, as [`read`].
///
/// # Errors
/// [`StoreError::Format`] and [`StoreError::Damaged`].
pub fn parse(bytes: &[u8], mesh: &Mesh, options: &SurfaceOptions) -> Result<Option<Surface>, StoreError> {
    if bytes.len() < HEAD || &bytes[..8] != MAGIC {
        return Err(StoreError::Format);
    }
    if blake3::hash(&bytes[HEAD..]).as_bytes() != &bytes[40..HEAD] {
        return Err(StoreError::Damaged);
    }
    if bytes[8..40] != Key::new(mesh, options).0 {
        return Ok(None);
    }
    let stored: Stored = postcard::from_bytes(&bytes[HEAD..]).map_err(|_| StoreError::Damaged)?;
    let graph = Graph::new(mesh);
    let faces = mesh.triangles.len();
    let of_nodes = [stored.field.angles_rad.len(), stored.field.strengths.len()];
    let patches = stored.patches.map(|patches| patches.checked(faces, graph.len())).transpose()?;
    let lapped = stored.lapped.map(|patches| patches.checked(faces, graph.len())).transpose()?;
    let stripes = stored.stripes.map(|lines| stripes(&lines, faces)).transpose()?;
    let asked = [options.patches.is_some(), options.lapped.is_some(), options.stripes.is_some()];
    let numbers = stored.field.angles_rad.iter().chain(&stored.field.strengths).all(|number| number.is_finite());
    if !numbers || of_nodes != [graph.len(); 2] || asked != [patches.is_some(), lapped.is_some(), stripes.is_some()] {
        return Err(StoreError::Damaged);
    }
    let (graph, field) = (Arc::new(graph), Arc::new(stored.field));
    Ok(Some(Surface { graph, field, patches, lapped, stripes }))
}

/// Writes a surface to a file, at once or not at all.
///
/// # Errors
/// [`StoreError::Io`] if it cannot be written.
pub fn write(path: &Path, mesh: &Mesh, options: &SurfaceOptions, surface: &Surface) -> Result<(), StoreError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(&to_bytes(mesh, options, surface)?)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// The bytes of a file.
///
/// # Errors
/// [`StoreError::Io`] if there is not enough memory.
pub fn to_bytes(mesh: &Mesh, options: &SurfaceOptions, surface: &Surface) -> Result<Vec<u8>, StoreError> {
    let words = |lines: &[StripePhases]| bytemuck::cast_slice::<_, u32>(lines).to_vec();
    let stored = Stored {
        field: Field::clone(&surface.field),
        patches: surface.patches.as_ref().map(StoredPatches::new),
        lapped: surface.lapped.as_ref().map(StoredPatches::new),
        stripes: surface.stripes.as_ref().map(|stripes| [words(&stripes.along), words(&stripes.across)]),
    };
    let body = postcard::to_stdvec(&stored).map_err(std::io::Error::other)?;
    let mut bytes = Vec::with_capacity(HEAD + body.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&Key::new(mesh, options).0);
    bytes.extend_from_slice(blake3::hash(&body).as_bytes());
    bytes.extend_from_slice(&body);
    Ok(bytes)
}

impl StoredPatches {
    fn new(patches: &Patches) -> Self {
        Self {
            seeds: patches.seeds.clone(),
            starts: patches.starts.clone(),
            entry_seeds: patches.entries.iter().map(|entry| entry.seed).collect(),
            places: patches.entries.iter().flat_map(Entry::place_codes).collect(),
            shares: patches.entries.iter().flat_map(|entry| entry.share_codes(patches.lapped)).collect(),
            rows: patches.rows.clone(),
            tiles_per_unit: patches.tiles_per_unit,
            follow: patches.follow,
            lapped: patches.lapped,
        }
    }

    fn checked(self, faces: usize, nodes: usize) -> Result<Patches, StoreError> {
        let count = self.entry_seeds.len();
        let ends = self.starts.first() == Some(&0) && self.starts.last().is_some_and(|last| *last as usize == count);
        let steps = self.starts.windows(2).all(|pair| {
            pair[1].checked_sub(pair[0]).is_some_and(|entries| (1..=MAX_ENTRIES as u32).contains(&entries))
        });
        let seeds = self.entry_seeds.iter().all(|seed| *seed == u32::MAX || (*seed as usize) < self.seeds.len())
            && self.seeds.iter().all(|seed| (seed.node as usize) < nodes);
        let lengths = self.starts.len() == faces + 1
            && [self.places.len(), self.shares.len()] == [3 * count; 2]
            && [0, count].contains(&self.rows.len());
        if !(ends && steps && seeds && lengths && self.tiles_per_unit.is_normal() && self.tiles_per_unit > 0.0) {
            return Err(StoreError::Damaged);
        }
        let (places, shares) = (self.places.as_chunks::<3>().0, self.shares.as_chunks::<3>().0);
        let entry = |((seed, places), shares): ((&u32, &[u32; 3]), &[u16; 3])| Entry {
            seed: *seed,
            uv: places.map(place),
            behind: Entry::shares_of(*shares, self.lapped),
        };
        Ok(Patches {
            entries: self.entry_seeds.iter().zip(places).zip(shares).map(entry).collect(),
            rows: self.rows,
            seeds: self.seeds,
            starts: self.starts,
            tiles_per_unit: self.tiles_per_unit,
            follow: self.follow,
            lapped: self.lapped,
        })
    }
}

/// The place of a code; packed again it gives the same code.
fn place(code: u32) -> Vec2 {
    let half = |bits: u32| f64::from(bits as u16 as i16) / 32767.0 * PLACE_RANGE;
    DVec2::new(half(code & 0xffff), half(code >> 16)).as_vec2()
}

fn stripes(lines: &[Vec<u32>; 2], faces: usize) -> Result<Stripes, StoreError> {
    let words = size_of::<StripePhases>() / 4;
    if lines[0].len() != words * faces || ![0, words * faces].contains(&lines[1].len()) {
        return Err(StoreError::Damaged);
    }
    let [along, across] = [0, 1].map(|k| bytemuck::pod_collect_to_vec::<u32, StripePhases>(&lines[k]));
    Ok(Stripes { along, across })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::surface::Corners;
    use crate::surface::{FieldOptions, LappedOptions, PatchOptions, StripeOptions};

    fn all() -> SurfaceOptions {
        SurfaceOptions {
            patches: Some(PatchOptions::default()),
            lapped: Some(LappedOptions::default()),
            stripes: Some(StripeOptions::default()),
            ..SurfaceOptions::default()
        }
    }

    fn mesh(triangles: usize) -> Mesh {
        prepare(Sample::Torus.build(triangles)).expect("a torus").mesh
    }

    #[test]
    fn what_was_written_draws_the_same() {
        let mesh = mesh(600);
        let surface = Surface::new(&mesh, &all()).expect("a field");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("torus.surface");
        write(&path, &mesh, &all(), &surface).expect("it is written");
        let back = read(&path, &mesh, &all()).expect("it is read").expect("it is for this mesh");
        assert_eq!(back.field, surface.field);
        assert_eq!(back.stripes, surface.stripes);
        for (found, expected) in [(&back.patches, &surface.patches), (&back.lapped, &surface.lapped)] {
            let [found, expected] = [found, expected].map(|patches| patches.as_ref().expect("patches"));
            assert_eq!((&found.starts, &found.rows), (&expected.starts, &expected.rows));
            let carried = [found, expected].map(|patches| Corners::of_patches(&mesh.triangles, patches));
            assert!(carried[0] == carried[1], "what corners carry");
            let shares = |patches: &Patches| patches.entries.iter().map(|entry| entry.behind).collect::<Vec<_>>();
            assert!(shares(found) == shares(expected), "to the last bit");
            assert_eq!(found.seeds, expected.seeds);
        }
    }

    #[test]
    fn other_meshes_and_options_are_told_apart() {
        let (mesh, other) = (mesh(600), mesh(800));
        let surface = Surface::new(&mesh, &all()).expect("a field");
        let bytes = to_bytes(&mesh, &all(), &surface).expect("bytes");
        assert!(parse(&bytes, &other, &all()).expect("whole").is_none());
        let smooth = FieldOptions { smoothing: 2.0, ..FieldOptions::default() };
        assert!(parse(&bytes, &mesh, &SurfaceOptions { field: smooth, ..all() }).expect("whole").is_none());
    }

    #[test]
    fn whole_files_that_belong_to_no_surface_are_damaged() {
        let mesh = mesh(200);
        let surface = Surface::new(&mesh, &all()).expect("a field");
        let wrong: [fn(&mut Surface); 4] = [
            |surface| Arc::make_mut(&mut surface.field).angles_rad[3] = f64::NAN,
            |surface| surface.patches.as_mut().expect("patches").seeds[0].node = 1_000,
            |surface| surface.lapped.as_mut().expect("patches").entries[0].seed = 1_000,
            |surface| surface.patches.as_mut().expect("patches").tiles_per_unit = f64::INFINITY,
        ];
        for (i, spoil) in wrong.iter().enumerate() {
            let mut surface = surface.clone();
            spoil(&mut surface);
            let bytes = to_bytes(&mesh, &all(), &surface).expect("bytes");
            assert!(matches!(parse(&bytes, &mesh, &all()), Err(StoreError::Damaged)), "{i}");
        }
    }

    #[test]
    fn damaged_files_are_noticed() {
        let mesh = mesh(200);
        let surface = Surface::new(&mesh, &all()).expect("a field");
        let bytes = to_bytes(&mesh, &all(), &surface).expect("bytes");
        for end in [0, 7, 50, HEAD, bytes.len() / 2, bytes.len() - 1] {
            assert!(parse(&bytes[..end], &mesh, &all()).is_err(), "{end} bytes");
        }
        for at in (0..bytes.len()).step_by(97) {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            let found = parse(&changed, &mesh, &all());
            // A changed key is that of another mesh.
            assert!(found.is_err() || found.is_ok_and(|found| found.is_none()), "byte {at}");
        }
    }
}
