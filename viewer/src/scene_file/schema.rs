//! The JSON schema of scene files, made from the very words that read them.

use std::sync::LazyLock;

use serde_json::{Map, Value, json};

use super::object::PartEntry;
use super::read::LIGHT;
use super::word::{Kind, Word};
use super::{LookEntry, OBJECTS_MAX, ObjectEntry, ViewEntry};
use crate::scene::MAX_LIGHTS;

static SCHEMA: LazyLock<Value> = LazyLock::new(build);

/// The JSON schema of a scene file, for editors that complete and check TOML by one.
pub fn schema() -> &'static Value {
    &SCHEMA
}

/// The schema as text, with the newline that ends a file.
pub fn schema_text() -> String {
    format!("{:#}\n", schema())
}

fn build() -> Value {
    let light = json!({ "anyOf": [{ "type": "string" }, numbers()] });
    let mut part = properties(PartEntry::WORDS);
    part.extend(properties(LookEntry::WORDS));
    let mut object = properties(ObjectEntry::WORDS);
    object.extend(properties(LookEntry::WORDS));
    let parts = json!({
        "description": "Parts of the mesh that differ, by their names in the file.",
        "type": "object",
        "additionalProperties": table(part, &[]),
    });
    object.insert("part".into(), parts);
    let mut top = properties(ViewEntry::WORDS);
    top.extend(properties(LookEntry::WORDS));
    top.insert(
        "light".into(),
        json!({
            "description": format!("Lights: {LIGHT}."),
            "anyOf": [light.clone(), { "type": "array", "items": light, "maxItems": MAX_LIGHTS }],
        }),
    );
    top.insert(
        "object".into(),
        json!({
            "description": "The objects, in order.",
            "type": "array",
            "minItems": 1,
            "maxItems": OBJECTS_MAX,
            "items": table(object, &["mesh"]),
        }),
    );
    let mut schema = table(top, &["object"]);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("tam-viewer scene");
    schema
}

fn table(properties: Map<String, Value>, required: &[&str]) -> Value {
    json!({ "type": "object", "properties": properties, "required": required, "additionalProperties": false })
}

fn numbers() -> Value {
    json!({ "type": "array", "items": { "type": "number" } })
}

fn properties<T>(words: &[Word<T>]) -> Map<String, Value> {
    words.iter().map(|word| (word.name.to_owned(), property(word))).collect()
}

fn property<T>(word: &Word<T>) -> Value {
    let mut property = match word.kind {
        Kind::Number(range) => json!({ "type": "number", "minimum": range.min, "maximum": range.max }),
        Kind::NumberOrNone(range) => json!({
            "anyOf": [{ "type": "number", "minimum": range.min, "maximum": range.max }, { "const": "none" }],
        }),
        Kind::Numbers(_) => json!({ "anyOf": [numbers(), { "type": "string" }] }),
        Kind::Name(names) => json!({ "enum": names }),
        Kind::Switch => json!({ "type": "boolean" }),
        Kind::Colour => json!({ "anyOf": [{ "type": "string" }, numbers()] }),
        Kind::Text(_) if word.name == "field" => json!({ "anyOf": [{ "type": "string" }, numbers()] }),
        Kind::Text(_) => json!({ "type": "string" }),
    };
    property["description"] = format!("{}: {}.", word.about, word.kind).into();
    property
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_knows_every_word() {
        let schema = schema();
        for word in LookEntry::WORDS {
            for place in
                ["", "/properties/object/items", "/properties/object/items/properties/part/additionalProperties"]
            {
                let known = schema.pointer(&format!("{place}/properties/{}", word.name));
                assert!(known.is_some_and(|known| known["description"].is_string()), "{place} {}", word.name);
            }
        }
        assert_eq!(schema["properties"]["tiles"]["maximum"], 100.0);
        assert_eq!(schema["properties"]["method"]["enum"][1], "six-way");
    }
}
