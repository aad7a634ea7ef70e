//! Sparse symmetric systems on a graph, solved by faer.

use faer::prelude::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::traits::ComplexField;
use faer::{Col, Side};

/// A factorised Hermitian positive definite matrix.
pub(crate) struct Factor<T> {
    llt: faer::sparse::linalg::solvers::Llt<usize, T>,
    size: usize,
}

/// The matrix is not positive definite, holds no numbers, or is too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a sparse system of {size} unknowns could not be factorised")]
pub struct SolveError {
    /// Unknowns.
    pub size: usize,
}

impl<T: ComplexField> Factor<T> {
    /// Factorises a matrix given by its lower triangle; entries at one place add up.
    pub(crate) fn new(size: usize, lower: &[Triplet<usize, usize, T>]) -> Result<Self, SolveError> {
        let matrix = SparseColMat::try_new_from_triplets(size, size, lower).map_err(|_| SolveError { size })?;
        let llt = matrix.sp_cholesky(Side::Lower).map_err(|_| SolveError { size })?;
        Ok(Self { llt, size })
    }

    /// The solution of the system for a right-hand side.
    pub(crate) fn solve(&self, right: impl Fn(usize) -> T) -> Vec<T> {
        let mut x = Col::from_fn(self.size, right);
        self.llt.solve_in_place(x.as_mat_mut());
        x.iter().cloned().collect()
    }
}
