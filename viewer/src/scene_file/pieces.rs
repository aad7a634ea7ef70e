//! The objects of a scene file on their meshes: what is drawn with one look at one place, and what it is cut out of.

use glam::DMat4;

use super::value::unknown;
use super::{LookEntry, PartEntry, Place, SceneFile};
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
        self.looks.iter().zip(parts).map(|(look, part)| look.material(colour_of(part.colour))).collect()
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
            let mesh = mesh_of(index);
            for name in object.parts.keys().filter(|name| !mesh.parts.iter().any(|part| part.name == **name)) {
                return Err(format!("object `{}`: {}", object.name, unknown_part(name, &mesh.parts)));
            }
            let first = pieces.len();
            let none = PartEntry::default();
            for (number, part) in mesh.parts.iter().enumerate() {
                let PartEntry { place, look } = object.parts.get(&part.name).unwrap_or(&none);
                let look = look.over(&object.look).over(&self.look);
                if !look.is_visible() {
                    continue;
                }
                let at = place.as_ref().map_or(DMat4::IDENTITY, Place::world_from_mesh);
                let world_from_mesh = object.place.unwrap_or_default().world_from_mesh() * at * object.stretched();
                let common = shared(&look);
                let alike = |piece: &&mut Piece| piece.world_from_mesh == world_from_mesh && piece.look == common;
                match pieces[first..].iter_mut().find(alike) {
                    Some(piece) => {
                        piece.parts.push(number);
                        piece.looks.push(look);
                    }
                    None => pieces.push(Piece {
                        object: index,
                        parts: vec![number],
                        world_from_mesh,
                        look: common,
                        looks: vec![look],
                    }),
                }
            }
        }
        Ok(pieces)
    }
}

/// What is said about a part that is not there.
pub fn unknown_part(name: &str, parts: &[Part]) -> String {
    let mut names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).filter(|name| !name.is_empty()).collect();
    names.dedup();
    if names.is_empty() {
        return format!("no part is called `{name}`; the parts of the mesh have no names");
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
    fn parts_that_are_not_there_bring_the_nearest() {
        let chair = chair();
        let text = "[[object]]\nmesh = \"chair\"\n[object.part.saet]\nrotate = 3\n";
        let problem = file(text).pieces(|_| &chair).expect_err("no such part");
        assert!(problem.contains("`chair`") && problem.contains("did you mean `seat`?"), "{problem}");
    }
}
