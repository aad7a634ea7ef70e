//! Reading Wavefront OBJ.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::{Vec2, Vec3};

use crate::mesh::table::{Table, join};
use crate::mesh::{MeshError, NONE, RawMesh, RawPart};

use super::text::{Words, integer, shown};
use super::{Kind, Resolve, mtl};

/// Reads polygons with their positions, normals and texture coordinates; objects, groups and materials become parts.
///
/// Polygons are cut into fans. A corner that refers to a vertex that is not there keeps an index out of range, which
/// preparation drops and counts; missing normals are zero. Materials that are not found are noted.
pub(super) fn read(bytes: &[u8], resolve: Resolve) -> Result<RawMesh, MeshError> {
    let mut reader = Reader::new(bytes.len());
    for (at, line) in lines(bytes) {
        reader.line(at, &line)?;
    }
    if reader.file_positions.is_empty() {
        let what = format!("it begins with \"{}\" and has no vertex (\"v\") lines", shown(bytes));
        return Err(MeshError::WrongKind { kind: Kind::Obj, what });
    }
    Ok(reader.finish(resolve))
}

/// Lines with their numbers from 1; a backslash at the end joins the next.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut lines = bytes.split(|&byte| byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (at, first) = lines.next()?;
        let mut line = Cow::Borrowed(first);
        while let Some(joined) = line.trim_ascii_end().strip_suffix(b"\\") {
            let length = joined.len();
            let mut whole = line.into_owned();
            whole.truncate(length);
            whole.push(b' ');
            let next = lines.next();
            whole.extend_from_slice(next.map_or(&[], |(_, next)| next));
            line = Cow::Owned(whole);
            if next.is_none() {
                break;
            }
        }
        Some((at + 1, line))
    })
}

/// Indices of a corner into the file's positions, texture coordinates and normals, from 0; `NONE` for none.
type Corner = [u32; 3];

struct Reader {
    file_positions: Vec<Vec3>,
    file_uvs: Vec<Vec2>,
    file_normals: Vec<Vec3>,
    /// Distinct corners: the vertices.
    corners: Vec<Corner>,
    table: Table,
    /// Per position the last of its corners.
    last: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    polygon: Vec<u32>,
    /// First triangle, name and material of each part.
    parts: Vec<(usize, String, String)>,
    group: String,
    material: String,
    libraries: Vec<String>,
}

impl Reader {
    fn new(bytes: usize) -> Self {
        Self {
            file_positions: Vec::new(),
            file_uvs: Vec::new(),
            file_normals: Vec::new(),
            corners: Vec::new(),
            // A vertex takes some sixty bytes of text, with its share of the faces.
            table: Table::new(bytes / 64),
            last: Vec::new(),
            triangles: Vec::new(),
            polygon: Vec::new(),
            parts: Vec::new(),
            group: String::new(),
            material: String::new(),
            libraries: Vec::new(),
        }
    }

    fn line(&mut self, at: usize, line: &[u8]) -> Result<(), MeshError> {
        let damaged = |what: &str| MeshError::damaged(format!("{what} in line {at}: \"{}\"", shown(line)));
        let mut words = Words::new(line);
        match words.next() {
            Some(b"v") => match [words.number(), words.number(), words.number()] {
                [Some(x), Some(y), Some(z)] => self.file_positions.push(Vec3::new(x, y, z)),
                _ => return Err(damaged("a vertex without three numbers")),
            },
            Some(b"vn") => match [words.number(), words.number(), words.number()] {
                [Some(x), Some(y), Some(z)] => self.file_normals.push(Vec3::new(x, y, z)),
                _ => return Err(damaged("a normal without three numbers")),
            },
            // One number is a place on a curve's texture; the second is zero then.
            Some(b"vt") => match words.number() {
                Some(u) => self.file_uvs.push(Vec2::new(u, words.number().unwrap_or(0.0))),
                None => return Err(damaged("a texture coordinate without a number")),
            },
            Some(b"f") => self.face(words).ok_or_else(|| damaged("a face that cannot be read"))?,
            Some(b"o" | b"g") => {
                self.group = mtl::shown_name(words.rest());
                self.begin_part();
            }
            Some(b"usemtl") => {
                self.material = mtl::shown_name(words.rest());
                self.begin_part();
            }
            Some(b"mtllib") => self.libraries.push(mtl::shown_name(words.rest())),
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, words: Words) -> Option<()> {
        self.polygon.clear();
        for word in words.take_while(|word| word[0] != b'#') {
            let mut numbers = word.split(|&byte| byte == b'/');
            let position = self.index(numbers.next()?, self.file_positions.len())?;
            let uv = self.optional_index(numbers.next(), self.file_uvs.len())?;
            let normal = self.optional_index(numbers.next(), self.file_normals.len())?;
            let corner = [position, uv, normal];
            let vertex = self.vertex(corner);
            self.polygon.push(vertex);
        }
        let (&first, rest) = self.polygon.split_first()?;
        self.triangles.extend(rest.windows(2).map(|pair| [first, pair[0], pair[1]]));
        (rest.len() >= 2).then_some(())
    }

    /// The vertex of a corner. Mostly the corners at a position are alike: the last one there saves the search.
    fn vertex(&mut self, corner: Corner) -> u32 {
        let position = corner[0] as usize;
        let last = self.last.get(position).copied().filter(|&last| self.corners[last as usize] == corner);
        if let Some(last) = last {
            return last;
        }
        let (vertex, new) = self.table.find_or_insert(join(&corner), |other| self.corners[other as usize] == corner);
        if new {
            self.corners.push(corner);
        }
        if position < self.file_positions.len() {
            // Positions that no corner has had yet are looked up under the first corner, in vain.
            self.last.resize(self.file_positions.len(), 0);
            self.last[position] = vertex;
        }
        vertex
    }

    /// An index from 0: positive ones count from 1, negative ones from the end so far. Those that are nowhere become
    /// one that stays out of range.
    fn index(&self, word: &[u8], count: usize) -> Option<u32> {
        let given = integer(word)?;
        let index = if given < 0 { count as i64 + given } else { given - 1 };
        Some(u32::try_from(index).ok().filter(|&index| index != NONE).unwrap_or(NONE - 1))
    }

    fn optional_index(&self, word: Option<&[u8]>, count: usize) -> Option<u32> {
        match word {
            None | Some([]) => Some(NONE),
            Some(word) => self.index(word, count),
        }
    }

    /// What follows belongs to another part, if it differs in group or material.
    fn begin_part(&mut self) {
        let begin = self.triangles.len();
        if self.parts.last().is_some_and(|part| part.0 == begin) {
            self.parts.pop();
        }
        if self.parts.last().is_none_or(|part| (&part.1, &part.2) != (&self.group, &self.material)) {
            self.parts.push((begin, self.group.clone(), self.material.clone()));
        }
    }

    fn finish(self, resolve: Resolve) -> RawMesh {
        // The bytes given need not be a whole file: a corner may refer forward, so only now is its place known.
        let beyond = self.file_positions.len() as u32;
        let mut vertex_of = vec![beyond; self.corners.len()];
        let mut raw = RawMesh::default();
        let has_uvs = self.corners.iter().any(|corner| (corner[1] as usize) < self.file_uvs.len());
        let has_normals = self.corners.iter().any(|corner| (corner[2] as usize) < self.file_normals.len());
        for (&[position, uv, normal], vertex) in self.corners.iter().zip(&mut vertex_of) {
            let Some(&position) = self.file_positions.get(position as usize) else {
                *vertex = NONE;
                continue;
            };
            *vertex = raw.positions.len() as u32;
            raw.positions.push(position);
            if has_uvs {
                raw.uvs.push(self.file_uvs.get(uv as usize).copied().unwrap_or_default());
            }
            if has_normals {
                raw.normals.push(self.file_normals.get(normal as usize).copied().unwrap_or_default());
            }
        }
        raw.triangles =
            self.triangles.iter().map(|triangle| triangle.map(|vertex| vertex_of[vertex as usize])).collect();

        let mut colours = HashMap::new();
        for library in &self.libraries {
            match resolve(library) {
                Ok(bytes) => colours.extend(mtl::colours(&bytes)),
                Err(error) => raw.notes.push(format!("The materials in \"{library}\" were not found: {error}.")),
            }
        }
        let begins = self.parts.first().is_none_or(|part| part.0 > 0).then(|| (0, String::new(), String::new()));
        let parts: Vec<_> = begins.into_iter().chain(self.parts).collect();
        let ends = parts.iter().skip(1).map(|part| part.0).chain([raw.triangles.len()]).collect::<Vec<_>>();
        for ((start, group, material), end) in parts.into_iter().zip(ends).filter(|(part, end)| part.0 < *end) {
            let colour = colours.get(&material).copied();
            let name = if group.is_empty() { material } else { group };
            raw.parts.push(RawPart { name, colour, triangles: start..end });
        }
        raw
    }
}
