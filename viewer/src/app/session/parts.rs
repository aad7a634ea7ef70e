//! What of a session can be read, where not all of it can.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::super::layout::{default_layout, is_whole};
use super::super::state::State;
use super::Session;

/// What the fields of a session hold, with what is there at first in place of what cannot be read, and the names of that.
pub(super) fn session(mut fields: Map<String, Value>) -> (Session, Vec<String>) {
    let mut left = Vec::new();
    let (state, unread) = readable(State::default(), fields.remove("state").unwrap_or_default());
    left.extend(unread);
    let layout = fields.remove("layout").and_then(|layout| serde_json::from_value(layout).ok());
    let layout = layout.filter(is_whole).unwrap_or_else(|| {
        left.push("layout".to_owned());
        default_layout()
    });
    // Whether it was lost is not known then, and nothing is said of it.
    let closed = fields.get("closed").and_then(Value::as_bool).unwrap_or_else(|| {
        left.push("closed".to_owned());
        true
    });
    (Session { state, layout, closed }, left)
}

/// `at_first`, with all of `found` in it that can be read there, and the names of what cannot.
fn readable<T: Serialize + DeserializeOwned>(at_first: T, found: Value) -> (T, Vec<String>) {
    let (mut left, mut path) = (Vec::new(), Vec::new());
    let Ok(mut whole) = serde_json::to_value(&at_first) else { return (at_first, left) };
    take::<T>(&mut whole, &mut path, found, &mut left);
    (T::deserialize(&whole).unwrap_or(at_first), left)
}

/// Puts `found` into `whole` at a path; where that cannot be read, each of its fields on its own.
fn take<T: DeserializeOwned>(whole: &mut Value, path: &mut Vec<String>, found: Value, left: &mut Vec<String>) {
    let before = put(whole, path, Some(found.clone()));
    if T::deserialize(&*whole).is_ok() {
        return;
    }
    match (before, found) {
        (Some(Value::Object(fields)), Value::Object(found)) => {
            put(whole, path, Some(Value::Object(fields)));
            for (name, value) in found {
                path.push(name);
                take::<T>(whole, path, value, left);
                path.pop();
            }
        }
        (before, _) => {
            put(whole, path, before);
            left.push(path.join("."));
        }
    }
}

/// Puts a value to a path, or takes away what is there. Returns what was there.
fn put(whole: &mut Value, path: &[String], value: Option<Value>) -> Option<Value> {
    let Some((last, above)) = path.split_last() else {
        return Some(std::mem::replace(whole, value.unwrap_or_default()));
    };
    let fields = above.iter().try_fold(whole, |value, name| value.get_mut(name))?.as_object_mut()?;
    match value {
        Some(value) => fields.insert(last.clone(), value),
        None => fields.remove(last),
    }
}
