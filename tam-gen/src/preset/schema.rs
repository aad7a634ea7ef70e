//! The JSON schema of preset files, made from the very structs that read them.

use std::sync::LazyLock;

use serde_json::{Map, Value, json};

use super::{Preset, Range};

static SCHEMA: LazyLock<Value> = LazyLock::new(build);

/// The JSON schema of a preset file, for editors that complete and check TOML by one.
pub fn schema() -> &'static Value {
    &SCHEMA
}

/// The schema as text, with the newline that ends a file.
pub fn schema_text() -> String {
    format!("{:#}\n", schema())
}

fn build() -> Value {
    let mut schema = schemars::schema_for!(Preset).to_value();
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".into(), json!("tam-gen preset"));
    }
    drop_null(&mut schema);
    for (table, definition) in [
        ("map", "MapOptions"),
        ("placement", "PlacementOptions"),
        ("stroke", "StrokeOptions"),
        ("tip", "TipOptions"),
        ("families", "FamilyOptions"),
        ("stroke", "FamilyOptions"),
    ] {
        if let Some(properties) = schema.pointer_mut(&format!("/$defs/{definition}/properties")) {
            for (key, property) in properties.as_object_mut().into_iter().flatten() {
                if let (Some(range), Some(property)) = (Range::find(table, key), property.as_object_mut()) {
                    add_unit(property, range);
                }
            }
        }
    }
    schema
}

/// Ends the description with the range and its unit, which editors show when hovering.
fn add_unit(property: &mut Map<String, Value>, range: &Range) {
    if let Some(Value::String(description)) = property.get_mut("description") {
        description.push_str(&format!(" From {}.", range.describe()));
    }
}

/// Takes out `null`, which Rust's options allow and TOML cannot say.
fn drop_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            if let Some(Value::Array(types)) = object.get_mut("type") {
                types.retain(|name| name != "null");
                if let [only] = &types[..] {
                    let only = only.clone();
                    object.insert("type".into(), only);
                }
            }
            if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
                choices.retain(|choice| choice.get("type").is_none_or(|name| name != "null"));
                if let [only] = &choices[..] {
                    let only = only.as_object().cloned().unwrap_or_default();
                    object.remove("anyOf");
                    object.extend(only);
                }
            }
            if object.get("default").is_some_and(Value::is_null) {
                object.remove("default");
            }
            object.values_mut().for_each(drop_null);
        }
        Value::Array(items) => items.iter_mut().for_each(drop_null),
        _ => {}
    }
}
