//! Sparse symmetric systems on a graph, solved by faer.

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, SparseColMatRef, SymbolicSparseColMat, Triplet};
use faer::traits::ComplexField;
use faer::{Col, Side};

use super::graph::Graph;

/// A factorised Hermitian positive definite matrix.
pub(crate) struct Factor<T> {
    llt: Llt<usize, T>,
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

/// Where matrices with one row per node have entries, on their diagonals and for each link; and in which order their
/// unknowns are best eliminated. Found once for all of a graph.
#[derive(Clone, Debug)]
pub(crate) struct Pattern {
    places: SymbolicSparseColMat<usize>,
    order: SymbolicLlt<usize>,
}

impl Pattern {
    pub(super) fn new(graph: &Graph) -> Result<Self, SolveError> {
        let size = graph.len();
        let mut starts = Vec::with_capacity(size + 1);
        let mut rows = Vec::with_capacity(size + graph.links.len());
        let mut links = graph.links.iter().peekable();
        starts.push(0);
        // The lower triangle, column by column, rows increasing; links are sorted so.
        for node in 0..size {
            rows.push(node);
            while let Some(link) = links.next_if(|link| link.a as usize == node) {
                rows.push(link.b as usize);
            }
            starts.push(rows.len());
        }
        let places = SymbolicSparseColMat::new_checked(size, size, starts, None, rows);
        let order = SymbolicLlt::try_new(places.as_ref(), Side::Lower).map_err(|_| SolveError { size })?;
        Ok(Self { places, order })
    }
}

impl<T: ComplexField> Factor<T> {
    /// Factorises a matrix with one row per node, Hermitian: its diagonal, and for each link the entry in the row of its
    /// second node and the column of its first.
    pub(crate) fn of_links(graph: &Graph, diagonal: &[T], off: &[T]) -> Result<Self, SolveError> {
        let size = graph.len();
        let Pattern { places, order } = graph.pattern()?;
        let mut entries = Vec::with_capacity(diagonal.len() + off.len());
        let mut links = graph.links.iter().zip(off).peekable();
        for (node, own) in diagonal.iter().enumerate() {
            entries.push(own.clone());
            while let Some((_, entry)) = links.next_if(|(link, _)| link.a as usize == node) {
                entries.push(entry.clone());
            }
        }
        let matrix = SparseColMatRef::new(places.as_ref(), &entries);
        let llt = Llt::try_new_with_symbolic(order.clone(), matrix, Side::Lower).map_err(|_| SolveError { size })?;
        Ok(Self { llt, size })
    }
}
