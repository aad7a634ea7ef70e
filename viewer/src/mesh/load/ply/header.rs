//! The header of a PLY file.

use crate::mesh::MeshError;

use super::super::Kind;
use super::super::text::{Words, integer, shown};

/// How the data are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Size in a binary file.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// One number, or a count and that many.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug)]
pub(super) struct Property {
    name: String,
    pub(super) shape: Shape,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Index of a property.
    pub(super) fn column(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Bytes up to the data.
    pub(super) length: usize,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, MeshError> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut length = 0;
        for (at, ended) in bytes.split_inclusive(|&byte| byte == b'\n').enumerate() {
            length += ended.len();
            let line = ended.trim_ascii();
            if at == 0 {
                if line != b"ply" {
                    let what = format!("it begins with \"{}\"", shown(line));
                    return Err(MeshError::WrongKind { kind: Kind::Ply, what });
                }
                continue;
            }
            let damaged = || MeshError::damaged(format!("line {} of its header: \"{}\"", at + 1, shown(line)));
            let words: Vec<&[u8]> = Words::new(line).collect();
            match words[..] {
                [b"format", name, _] => {
                    encoding = Some(match name {
                        b"ascii" => Encoding::Text,
                        b"binary_little_endian" => Encoding::LittleEndian,
                        b"binary_big_endian" => Encoding::BigEndian,
                        _ => return Err(damaged()),
                    });
                }
                [b"element", name, count] => {
                    let count = integer(count).and_then(|count| u64::try_from(count).ok()).ok_or_else(damaged)?;
                    elements.push(Element { name: shown(name), count, properties: Vec::new() });
                }
                [b"property", b"list", count, item, name] => {
                    let (count, item) = (Scalar::named(count), Scalar::named(item));
                    let shape = count.zip(item).map(|(count, item)| Shape::List { count, item }).ok_or_else(damaged)?;
                    let element = elements.last_mut().ok_or_else(damaged)?;
                    element.properties.push(Property { name: shown(name), shape });
                }
                [b"property", scalar, name] => {
                    let shape = Scalar::named(scalar).map(Shape::Scalar).ok_or_else(damaged)?;
                    let element = elements.last_mut().ok_or_else(damaged)?;
                    element.properties.push(Property { name: shown(name), shape });
                }
                [b"end_header"] if ended.ends_with(b"\n") => {
                    let encoding = encoding.ok_or_else(|| MeshError::damaged("its header has no format line"))?;
                    return Ok(Self { encoding, elements, length });
                }
                [b"comment" | b"obj_info", ..] | [] => {}
                _ => return Err(damaged()),
            }
        }
        Err(MeshError::damaged("its header has no end (\"end_header\")"))
    }
}
