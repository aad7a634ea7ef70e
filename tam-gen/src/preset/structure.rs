//! Unknown keys and wrong types of a preset file, all of them at once.
//!
//! Reading stops at the first of these, so a file that cannot be read is walked along the schema. What is wrong is
//! taken out on the way, so that the rest can be read and checked as well.

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Range;
use super::options::RANGES;
use super::place::{Place, Step, nearest};
use super::schema::schema;
use crate::problems::{PROBLEMS_MAX, Problem};

/// Reports whatever in the table no preset can hold, and takes it out.
pub(super) fn check(source: &str, table: &mut DeTable<'_>) -> Vec<Problem> {
    let mut walk = Walk { source, problems: Vec::new() };
    walk.table(&Place::ROOT, schema(), table);
    walk.problems
}

/// The range that a place must keep to, if a number belongs there.
pub(super) fn range_at(place: &Place) -> Option<&'static Range> {
    match place.steps() {
        [.., Step::Key(table), Step::Key(key)] if table == "tip" => Range::find("tip", key),
        [Step::Key(table), Step::Key(key)] => Range::find(table, key),
        [Step::Key(table), Step::Key(_), Step::Key(key)] if table == "families" => {
            Range::find("families", key).or_else(|| Range::find("stroke", key))
        }
        _ => None,
    }
}

struct Walk<'s> {
    source: &'s str,
    problems: Vec<Problem>,
}

impl Walk<'_> {
    fn table(&mut self, at: &Place, node: &Value, table: &mut DeTable<'_>) {
        let node = resolve(node);
        for (key, mut value) in std::mem::take(table) {
            let word = key.get_ref().as_ref();
            let known = node.get("properties").and_then(|properties| properties.get(word));
            if self.problems.len() >= PROBLEMS_MAX {
                return;
            }
            match known.or_else(|| node.get("additionalProperties").filter(|node| node.is_object())) {
                Some(node) => {
                    if self.value(&at.key(word), node, &mut value) {
                        table.insert(key, value);
                    }
                }
                None => self.unknown(at, node, &key),
            }
        }
    }

    /// Whether the value can stay.
    fn value(&mut self, at: &Place, node: &Value, value: &mut Spanned<DeValue<'_>>) -> bool {
        let node = resolve(node);
        let span = value.span();
        if let Some(choices) = node.get("anyOf").and_then(Value::as_array) {
            let fitting = choices.iter().find(|choice| accepts(resolve(choice), value.get_ref()));
            return match fitting {
                Some(choice) => self.value(at, choice, value),
                None => self.wrong_type(at, node, value),
            };
        }
        if let Some(names) = names(node) {
            return match value.get_ref() {
                DeValue::String(name) if names.contains(&name.as_ref()) => true,
                DeValue::String(name) => {
                    let meant = nearest(name, names.iter().copied());
                    let problem = Problem::general(at.to_string(), format!("{at} has no choice {name:?}"))
                        .at_span(self.source, span)
                        .expected(one_of(&names))
                        .help(meant.map(|meant| format!("did you mean {meant:?}?")));
                    self.problems.push(problem);
                    false
                }
                _ => self.wrong_type(at, node, value),
            };
        }
        if !accepts(node, value.get_ref()) {
            return self.wrong_type(at, node, value);
        }
        match value.get_mut() {
            DeValue::Table(table) => self.table(at, node, table),
            DeValue::Array(items) => {
                let item_node = node.get("items").unwrap_or(&Value::Null);
                for (index, item) in items.iter_mut().enumerate() {
                    if !self.value(&at.item(index), item_node, item) {
                        return false;
                    }
                }
            }
            DeValue::Integer(integer) => {
                let number = i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX);
                let (min, max) = limits(node);
                if !(min..=max).contains(&number) {
                    let range = range_at(at).map_or_else(|| format!("{min} to {max}"), Range::describe);
                    let problem = Problem::general(at.to_string(), format!("{at} is out of range"))
                        .at_span(self.source, span)
                        .expected(range);
                    self.problems.push(problem);
                    return false;
                }
            }
            _ => {}
        }
        true
    }

    fn wrong_type(&mut self, at: &Place, node: &Value, value: &Spanned<DeValue<'_>>) -> bool {
        let mut expected = type_in_words(node);
        if let Some(range) = range_at(at) {
            expected = format!("{expected}, {}", range.describe());
        }
        let found = match value.get_ref() {
            DeValue::Float(_) => "a number with a fraction",
            DeValue::Integer(_) => "a whole number",
            DeValue::String(_) => "text",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        let problem = Problem::general(at.to_string(), format!("{at} is {found}, which does not belong there"))
            .at_span(self.source, value.span())
            .expected(expected);
        self.problems.push(problem);
        false
    }

    fn unknown(&mut self, at: &Place, node: &Value, key: &Spanned<toml::de::DeString<'_>>) {
        let word = key.get_ref().as_ref();
        let known: Vec<&str> =
            node.get("properties").and_then(Value::as_object).into_iter().flatten().map(|(key, _)| &**key).collect();
        let holder = if at.steps().is_empty() { "a preset".to_owned() } else { format!("[{at}]") };
        let mut problem = Problem::general(at.key(word).to_string(), format!("{holder} has no key {word:?}"))
            .at_span(self.source, key.span());
        let elsewhere = RANGES.iter().find(|range| range.key == word);
        problem = match (nearest(word, known.iter().copied()), elsewhere) {
            (Some(meant), _) => problem.expected(format!("did you mean `{meant}`?")),
            (None, _) if !at.steps().is_empty() && is_at_top(word) => {
                problem.expected(format!("`{word}` belongs at the top, before the first [table]"))
            }
            (None, Some(range)) => problem.expected(format!("`{word}` belongs in [{}]", range.table)),
            (None, None) => problem.expected("unknown key"),
        };
        self.problems.push(problem.help(format!("the keys of {holder} are {}", known.join(", "))));
    }
}

/// Whether a key belongs to no table.
fn is_at_top(word: &str) -> bool {
    schema().get("properties").is_some_and(|keys| keys.get(word).is_some())
}

/// Follows a reference to the definition it names.
fn resolve(node: &Value) -> &Value {
    match node.get("$ref").and_then(Value::as_str) {
        Some(reference) => schema().pointer(reference.trim_start_matches('#')).unwrap_or(node),
        None => node,
    }
}

fn accepts(node: &Value, value: &DeValue<'_>) -> bool {
    match node.get("type").and_then(Value::as_str) {
        Some("object") => value.is_table(),
        Some("array") => value.is_array(),
        Some("string") => value.is_str(),
        Some("boolean") => value.is_bool(),
        Some("integer") => value.is_integer(),
        Some("number") => value.is_integer() || value.is_float(),
        _ => false,
    }
}

/// The words that a choice allows.
fn names(node: &Value) -> Option<Vec<&str>> {
    let choices = node.get("oneOf").or_else(|| node.get("enum"))?.as_array()?;
    choices.iter().map(|choice| choice.get("const").unwrap_or(choice).as_str()).collect()
}

fn one_of(names: &[&str]) -> String {
    format!("one of {}", names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", "))
}

fn limits(node: &Value) -> (i128, i128) {
    let limit = |key, fallback| node.get(key).and_then(Value::as_i64).map_or(fallback, i128::from);
    (limit("minimum", i128::from(i64::MIN)), limit("maximum", i128::from(i64::MAX)))
}

fn type_in_words(node: &Value) -> String {
    if let Some(names) = names(node) {
        return one_of(&names);
    }
    if let Some(choices) = node.get("anyOf").and_then(Value::as_array) {
        return choices.iter().map(|choice| type_in_words(resolve(choice))).collect::<Vec<_>>().join(" or ");
    }
    match node.get("type").and_then(Value::as_str) {
        Some("object") => "a table".to_owned(),
        Some("array") => {
            let items = node.get("items").map_or_else(String::new, |items| type_in_words(resolve(items)));
            let items = items.strip_prefix("a ").unwrap_or(&items);
            format!("a list (of {items} each)")
        }
        Some("string") => "text in quotes".to_owned(),
        Some("boolean") => "true or false".to_owned(),
        Some("integer") => "a whole number".to_owned(),
        _ => "a number".to_owned(),
    }
}
