//! The objects of a scene file on their meshes: what is drawn with one look at one place, and what it is cut out of.

use glam::DMat4;

use super::value::unknown;
use super::{LookEntry, ObjectEntry, PartEntry, SceneFile};
use crate::mesh::{Mesh, Part};
use crate::scene::Material;

/// Parts of a mesh that are drawn alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Number of its object in the file.
    pub object: usize,
    /// The parts of the mesh, in rising order.
    pub parts: Vec<usize>,
    /// Where they stand.
    pub world_from_mesh: DMat4,
    /// How they are drawn, but for what each part has of its own.
    pub look: LookEntry,
    /// How each of the parts is drawn: materials and maps differ.
    pub looks: Vec<LookEntry>,
}

impl Piece {
    /// Whether it is all of its mesh.
    pub fn is_whole(&self, mesh: &Mesh) -> bool {
        self.parts.len() == mesh.parts.len()
    }

    /// Materials of the parts, coloured as the mesh says unless `colour_of` says otherwise; all with the first map.
    pub fn materials(&self, mesh: &Mesh, colour_of: impl Fn([f32; 3]) -> [f32; 3]) -> Vec<Material> {
        let parts = self.parts.iter().map(|part| &mesh.parts[*part]);
        let plain = |part: &Part| Material { colour: colour_of(part.colour), ..Material::default() };
        self.looks.iter().zip(parts).map(|(look, part)| look.material(&plain(part))).collect()
    }
}

/// A look without what parts of one piece may have of their own: materials, maps, and whether they are seen at all.
fn shared(look: &LookEntry) -> LookEntry {
    LookEntry {
        map: None,
        rotate_deg: None,
        scale: None,
        shift: None,
        colour: None,
        specular: None,
        lit: None,
        ..look.clone()
    }
}

impl SceneFile {
    /// What is drawn of each object, on its mesh; parts that are not visible are left out.
    ///
    /// # Errors
    /// A part that the mesh has not.
    pub fn pieces<'m>(&self, mesh_of: impl Fn(usize) -> &'m Mesh) -> Result<Vec<Piece>, String> {
        let mut pieces: Vec<Piece> = Vec::new();
        for (index, object) in self.objects.iter().enumerate() {
            let of_object = object.pieces(&self.look, mesh_of(index));
            let of_object = of_object.map_err(|problem| format!("object `{}`: {problem}", object.name))?;
            pieces.extend(of_object.into_iter().map(|piece| Piece { object: index, ..piece }));
        }
        Ok(pieces)
    }
}

impl ObjectEntry {
    /// What is drawn of it on its mesh, where `base` is said of all objects.
    ///
    /// # Errors
    /// A part that the mesh has not.
    pub fn pieces(&self, base: &LookEntry, mesh: &Mesh) -> Result<Vec<Piece>, String> {
        let mut of_parts: Vec<Vec<&PartEntry>> = vec![Vec::new(); mesh.parts.len()];
        for (name, entry) in &self.parts {
            let numbers = part_numbers(name, &mesh.parts);
            if numbers.is_empty() {
                return Err(unknown_part(name, &mesh.parts));
            }
            numbers.into_iter().for_each(|number| of_parts[number].push(entry));
        }
        let whole = self.look.over(base);
        let stands = self.place.unwrap_or_default().world_from_mesh();
        let mut pieces: Vec<Piece> = Vec::new();
        for (number, entries) in of_parts.into_iter().enumerate() {
            let look = entries.iter().fold(whole.clone(), |look, entry| entry.look.over(&look));
            if !look.is_visible() {
                continue;
            }
            let at = entries.iter().rev().find_map(|entry| entry.place).unwrap_or_default();
            let world_from_mesh = stands * at.world_from_mesh() * self.stretched();
            let common = shared(&look);
            let alike = |piece: &&mut Piece| piece.world_from_mesh == world_from_mesh && piece.look == common;
            match pieces.iter_mut().find(alike) {
                Some(piece) => {
                    piece.parts.push(number);
                    piece.looks.push(look);
                }
                None => pieces.push(Piece {
                    object: 0,
                    parts: vec![number],
                    world_from_mesh,
                    look: common,
                    looks: vec![look],
                }),
            }
        }
        Ok(pieces)
    }
}

/// What a part is called in a file: by its name where no other has it, else by its number.
pub fn part_name(number: usize, parts: &[Part]) -> String {
    let name = parts.get(number).map_or("", |part| part.name.as_str());
    let alone = !name.is_empty() && parts.iter().filter(|part| part.name == name).count() == 1;
    if alone { name.to_owned() } else { format!("#{}", number + 1) }
}

/// The parts of a name, or the one of a number from 1 after a `#`.
pub fn part_numbers(name: &str, parts: &[Part]) -> Vec<usize> {
    let named: Vec<usize> = (0..parts.len()).filter(|number| parts[*number].name == name).collect();
    if !named.is_empty() {
        return named;
    }
    let number = name.strip_prefix('#').and_then(|number| number.parse::<usize>().ok());
    number.and_then(|number| number.checked_sub(1)).filter(|number| *number < parts.len()).into_iter().collect()
}

/// What is said about a part that is not there.
pub fn unknown_part(name: &str, parts: &[Part]) -> String {
    let mut names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).filter(|name| !name.is_empty()).collect();
    names.dedup();
    if names.is_empty() {
        return format!("no part is called `{name}`; they have no names, and are called #1 to #{}", parts.len());
    }
    unknown("part", name, names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::prepare;
    use crate::mesh::sample::Sample;
    use crate::{Form, Method};

    fn chair() -> Mesh {
        prepare(Sample::Chair.build(4000)).expect("a chair").mesh
    }

    fn file(text: &str) -> SceneFile {
        let mut file = SceneFile::from_toml(text, "scene.toml").expect("it makes sense");
        file.name_objects();
        file
    }

    #[test]
    fn parts_that_differ_in_material_alone_stay_together() {
        let chair = chair();
        let seat = &chair.parts[1].name;
        let whole = file(&format!(
            "form = \"literal\"\n[[object]]\nmesh = \"chair\"\n[object.part.{seat:?}]\nrotate = 30\nmap = \"woodcut\"\n"
        ));
        let pieces = whole.pieces(|_| &chair).expect("the parts are there");
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].is_whole(&chair));
        assert_eq!(pieces[0].look.form, Some(Form::Literal));
        let materials = pieces[0].materials(&chair, |colour| colour);
        assert_eq!((materials[0].rotation_deg, materials[1].rotation_deg), (0.0, 30.0));
        assert_eq!(pieces[0].looks[1].map, Some("woodcut".into()));
    }

    #[test]
    fn parts_with_another_method_or_place_are_pieces_of_their_own_and_hidden_ones_none() {
        let chair = chair();
        let [back, seat] = [0, 1].map(|k| chair.parts[k].name.clone());
        let text = format!(
            "[[object]]\nmesh = \"chair\"\nplace = [1, 0, 0]\n[object.part.{back:?}]\nvisible = false\n\
             [object.part.{seat:?}]\nmethod = \"stripes\"\nplace = [0, 1, 0]\n[[object]]\nmesh = \"chair\"\n"
        );
        let pieces = file(&text).pieces(|_| &chair).expect("the parts are there");
        assert!(pieces.iter().all(|piece| piece.object == 1 || !piece.parts.contains(&0)));
        let seat = pieces.iter().find(|piece| piece.parts == [1]).expect("the seat alone");
        assert_eq!(seat.look.method, Some(Method::Stripes));
        assert_eq!(seat.world_from_mesh.w_axis.truncate().to_array(), [1.0, 1.0, 0.0]);
        assert!(pieces.last().expect("the second").is_whole(&chair));
    }

    #[test]
    fn parts_without_a_name_of_their_own_go_by_their_number() {
        let mut chair = chair();
        chair.parts[2].name.clear();
        let twin = chair.parts[1].name.clone();
        chair.parts[3].name = twin;
        let names: Vec<String> = (0..4).map(|number| part_name(number, &chair.parts)).collect();
        assert_eq!(
            (names[0].as_str(), &names[1..]),
            ("seat", &["#2".to_owned(), "#3".to_owned(), "#4".to_owned()][..])
        );
        for (number, name) in names.iter().enumerate() {
            assert_eq!(part_numbers(name, &chair.parts), [number]);
        }
        assert_eq!(part_numbers("#0", &chair.parts), [0_usize; 0]);
        assert_eq!(part_numbers("#99", &chair.parts), [0_usize; 0]);
    }

    #[test]
    fn parts_that_are_not_there_bring_the_nearest() {
        let chair = chair();
        let text = "[[object]]\nmesh = \"chair\"\n[object.part.saet]\nrotate = 3\n";
        let problem = file(text).pieces(|_| &chair).expect_err("no such part");
        assert!(problem.contains("`chair`") && problem.contains("did you mean `seat`?"), "{problem}");
    }
}
