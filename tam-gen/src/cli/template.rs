//! A preset with every option explained, to start from.

use serde_json::Value;
use tam_gen::Preset;
use tam_gen::preset::schema;

const HEAD: &str = "\
# A preset of tam-gen. What is left out keeps its default.
#   tam-gen watch THIS_FILE       regenerates the map on every save
#   tam-gen schema -o preset.schema.json
# writes the schema by which editors complete and check this file; name it in the first line:
#   #:schema ./preset.schema.json
";

/// The preset as TOML with a remark above every option: what it does, and its range.
pub(super) fn commented(preset: &Preset) -> String {
    let mut text = String::from(HEAD);
    let mut table = Vec::new();
    let mut explained = Vec::new();
    for line in preset.to_toml().lines() {
        if let Some(header) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            table = header.split('.').map(str::to_owned).collect();
            if let Some(remark) = description(&table, None) {
                explain(&mut text, &mut explained, &remark);
            }
        } else if let Some((key, _)) = line.split_once(" = ")
            && let Some(remark) = description(&table, Some(key))
        {
            explain(&mut text, &mut explained, &remark);
        }
        text.push_str(line);
        text.push('\n');
    }
    text
}

/// Adds a remark; the second family needs none of the first one's again.
fn explain(text: &mut String, explained: &mut Vec<String>, remark: &str) {
    if explained.iter().any(|known| known == remark) {
        return;
    }
    explained.push(remark.to_owned());
    for line in wrapped(remark, 100) {
        text.push_str("# ");
        text.push_str(&line);
        text.push('\n');
    }
}

/// What the schema says about a table, or a key in it.
fn description(table: &[String], key: Option<&str>) -> Option<String> {
    let mut node = schema();
    for step in table.iter().map(String::as_str).chain(key) {
        let properties = resolved(node);
        node = properties
            .get("properties")
            .and_then(|keys| keys.get(step))
            .or_else(|| properties.get("additionalProperties"))?;
    }
    let described = node.get("description").or_else(|| resolved(node).get("description"))?.as_str()?;
    Some(described.to_owned() + &choices(resolved(node)))
}

/// The words that an option may be, and what each of them means.
fn choices(node: &Value) -> String {
    let choices = node.get("oneOf").and_then(Value::as_array);
    let text = |choice: &Value, key: &str| choice.get(key).and_then(Value::as_str).map(str::to_owned);
    choices
        .into_iter()
        .flatten()
        .filter_map(|choice| Some(format!(" \"{}\": {}", text(choice, "const")?, text(choice, "description")?)))
        .collect()
}

fn resolved(node: &Value) -> &Value {
    match node.get("$ref").and_then(Value::as_str) {
        Some(reference) => schema().pointer(reference.trim_start_matches('#')).unwrap_or(node),
        None => node,
    }
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_commented_preset_is_the_preset_with_every_option_explained() {
        let preset = Preset::default();
        let text = commented(&preset);
        let flat = text.replace("\n# ", " ");
        assert_eq!(Preset::from_toml(&text, "template").as_ref(), Ok(&preset));
        for range in tam_gen::preset::RANGES.iter().filter(|range| range.table != "tip") {
            assert!(text.contains(&format!("\n{} = ", range.key)), "{} is missing", range.key);
            assert!(flat.contains(&range.describe()), "the range of {} is missing", range.key);
        }
        assert!(flat.contains("\"praun\": "), "the choices of placement.method are missing");
    }
}
