//! Four neighbouring fragments that a GPU runs together, so that it can take differences between them.

use std::ops::{Index, Sub};

/// One record per fragment of a 2x2 block of pixels. A lane is `x + 2 y`, y pointing down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad<T>(pub [T; 4]);

impl<T> Quad<T> {
    /// A record for each lane.
    pub fn from_fn(record: impl FnMut(usize) -> T) -> Self {
        Self(std::array::from_fn(record))
    }

    /// A record made of each lane's.
    pub fn map<U>(&self, mut record: impl FnMut(&T) -> U) -> Quad<U> {
        Quad::from_fn(|lane| record(&self.0[lane]))
    }
}

impl<T: Copy + Sub<Output = T>> Quad<T> {
    /// `dpdxFine`: right minus left, in the lane's row. WGSL leaves it to the GPU whether `dpdx` is that of the lane's row or
    /// of the first row.
    pub fn dpdx(&self, lane: usize) -> T {
        self.0[lane | 1] - self.0[lane & 2]
    }

    /// `dpdyFine`: below minus above, in the lane's column.
    pub fn dpdy(&self, lane: usize) -> T {
        self.0[lane | 2] - self.0[lane & 1]
    }
}

impl<T> Index<usize> for Quad<T> {
    type Output = T;

    fn index(&self, lane: usize) -> &T {
        &self.0[lane]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_differences_within_the_row_and_the_column_of_a_lane() {
        let quad = Quad([1.0, 3.0, 10.0, 17.0]);
        assert_eq!([0, 1, 2, 3].map(|lane| quad.dpdx(lane)), [2.0, 2.0, 7.0, 7.0]);
        assert_eq!([0, 1, 2, 3].map(|lane| quad.dpdy(lane)), [9.0, 14.0, 9.0, 14.0]);
    }
}
