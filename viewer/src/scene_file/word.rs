//! Words of scene files and of the command line: how each is read, written and described.

use std::fmt;

use serde::Serialize;
use serde::de::{DeserializeOwned, IntoDeserializer};

use super::value::unknown;
use crate::ranges::Range;

/// A word, and where its value goes in a `T`.
pub struct Word<T> {
    /// Its name in files; the command line puts two dashes before it.
    pub name: &'static str,
    /// What its values are.
    pub kind: Kind,
    /// What it says, in one line.
    pub about: &'static str,
    pub(super) set: fn(&mut T, &str) -> Result<(), String>,
    pub(super) get: fn(&T) -> Option<Given>,
}

/// What values are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number.
    Number(Range),
    /// A number, or `none`.
    NumberOrNone(Range),
    /// Numbers between commas, so named.
    Numbers(&'static str),
    /// One of these names.
    Name(&'static [&'static str]),
    /// True or false.
    Switch,
    /// A colour of CSS, or its linear red, green and blue.
    Colour,
    /// A text of the form named.
    Text(&'static str),
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(range) => write!(f, "{range}"),
            Self::NumberOrNone(range) => write!(f, "{range}, or none"),
            Self::Name(names) => f.write_str(&names.join(", ")),
            Self::Switch => f.write_str("true or false"),
            Self::Colour => f.write_str("a CSS colour"),
            Self::Numbers(form) | Self::Text(form) => f.write_str(form),
        }
    }
}

/// A value as it is written.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// A number.
    Number(f64),
    /// Numbers.
    Numbers(Vec<f64>),
    /// A word or a path.
    Text(String),
    /// True or false.
    Switch(bool),
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Numbers(numbers) => {
                let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
                f.write_str(&texts.join(","))
            }
            Self::Text(text) => f.write_str(text),
            Self::Switch(on) => write!(f, "{on}"),
        }
    }
}

impl<T> Word<T> {
    /// Sets the value of the word of this name.
    pub(super) fn set(words: &[Self], holder: &mut T, name: &str, text: &str) -> Result<(), String> {
        match words.iter().find(|word| word.name == name) {
            Some(word) => (word.set)(holder, text),
            None => Err(unknown("setting", name, words.iter().map(|word| word.name))),
        }
    }
}

/// A value of an enumeration by its name.
pub(super) fn named<T: DeserializeOwned>(what: &str, name: &str, names: &[&str]) -> Result<T, String> {
    let found: Result<T, serde::de::value::Error> = T::deserialize(name.into_deserializer());
    found.map_err(|_| unknown(what, name, names.iter().copied()))
}

/// The name of such a value.
pub(super) fn name_of<T: Serialize>(value: &T) -> Given {
    let name = serde_json::to_value(value).ok();
    Given::Text(name.as_ref().and_then(|name| name.as_str()).unwrap_or_default().to_owned())
}

/// `true` or `false`.
pub(super) fn switch(text: &str) -> Result<bool, String> {
    match text {
        "true" | "yes" | "on" => Ok(true),
        "false" | "no" | "off" => Ok(false),
        _ => Err(format!("{text:?} is neither true nor false")),
    }
}
