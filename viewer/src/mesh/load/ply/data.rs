//! The numbers after the header of a PLY file.

use crate::mesh::MeshError;

use super::super::text::{Words, short_number, shown};
use super::header::{Element, Encoding, Scalar, Shape};

/// Reads numbers one after the other.
pub(super) struct Data<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

impl<'a> Data<'a> {
    pub(super) fn new(bytes: &'a [u8], encoding: Encoding) -> Self {
        Self { rest: bytes, encoding }
    }

    /// Bytes not read yet.
    pub(super) fn remaining(&self) -> usize {
        self.rest.len()
    }

    /// Fewest bytes that one element can take.
    pub(super) fn least_bytes(&self, element: &Element) -> u64 {
        // In text a digit; the white space after it may be missing at the end.
        let scalar = |scalar: Scalar| if self.encoding == Encoding::Text { 1 } else { scalar.bytes() as u64 };
        let property = |shape: Shape| match shape {
            Shape::Scalar(value) => scalar(value),
            Shape::List { count, .. } => scalar(count),
        };
        element.properties.iter().map(|element| property(element.shape)).sum()
    }

    /// The next number.
    pub(super) fn scalar(&mut self, scalar: Scalar) -> Result<f64, MeshError> {
        Ok(match self.encoding {
            Encoding::Text => self.word()?,
            Encoding::LittleEndian => match scalar {
                Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
                Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
                Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
                Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
                Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
                Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
                Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
                Scalar::F64 => f64::from_le_bytes(self.take()?),
            },
            Encoding::BigEndian => match scalar {
                Scalar::I8 => f64::from(i8::from_be_bytes(self.take()?)),
                Scalar::U8 => f64::from(u8::from_be_bytes(self.take()?)),
                Scalar::I16 => f64::from(i16::from_be_bytes(self.take()?)),
                Scalar::U16 => f64::from(u16::from_be_bytes(self.take()?)),
                Scalar::I32 => f64::from(i32::from_be_bytes(self.take()?)),
                Scalar::U32 => f64::from(u32::from_be_bytes(self.take()?)),
                Scalar::F32 => f64::from(f32::from_be_bytes(self.take()?)),
                Scalar::F64 => f64::from_be_bytes(self.take()?),
            },
        })
    }

    /// The next list's numbers.
    pub(super) fn list(&mut self, count: Scalar, item: Scalar, mut each: impl FnMut(f64)) -> Result<(), MeshError> {
        let count = self.scalar(count)?;
        // A wrong count runs out of data soon: nothing is reserved for it.
        if !(count >= 0.0 && count.fract() == 0.0) {
            return Err(MeshError::damaged(format!("a list of {count} numbers")));
        }
        for _ in 0..count as u64 {
            each(self.scalar(item)?);
        }
        Ok(())
    }

    fn word(&mut self) -> Result<f64, MeshError> {
        let mut words = Words::new(self.rest);
        let word = words.next().ok_or_else(|| MeshError::damaged("it ends within its data"))?;
        self.rest = words.rest();
        let number = short_number(word).or_else(|| std::str::from_utf8(word).ok()?.parse().ok());
        number.ok_or_else(|| MeshError::damaged(format!("\"{}\" where a number is expected", shown(word))))
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], MeshError> {
        let (taken, rest) =
            self.rest.split_first_chunk().ok_or_else(|| MeshError::damaged("it ends within its data"))?;
        self.rest = rest;
        Ok(*taken)
    }
}
