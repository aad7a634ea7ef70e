//! Sparse symmetric systems on a graph, solved by faer.

use faer::prelude::Solve;
use faer::sparse::{SparseColMat, SymbolicSparseColMat, Triplet};
use faer::traits::ComplexField;
use faer::{Col, Side};

use super::graph::Graph;

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

impl Factor<f64> {
    /// Factorises a matrix with one row per node: its diagonal, and an entry for each link.
    pub(crate) fn of_links(graph: &Graph, diagonal: &[f64], off: &[f64]) -> Result<Self, SolveError> {
        let mut lower = LowerColumns::new(graph.len(), graph.links.len());
        let mut links = graph.links.iter().zip(off).peekable();
        for (node, own) in diagonal.iter().enumerate() {
            lower.push(node, *own);
            while let Some((link, entry)) = links.next_if(|(link, _)| link.a as usize == node) {
                lower.push(link.b as usize, *entry);
            }
            lower.end_column();
        }
        lower.factorised()
    }
}

/// The lower triangle of a matrix, column by column, rows increasing; links are sorted so.
struct LowerColumns {
    starts: Vec<usize>,
    rows: Vec<usize>,
    entries: Vec<f64>,
}

impl LowerColumns {
    fn new(size: usize, off_diagonal: usize) -> Self {
        let mut starts = Vec::with_capacity(size + 1);
        starts.push(0);
        let count = size + off_diagonal;
        Self { starts, rows: Vec::with_capacity(count), entries: Vec::with_capacity(count) }
    }

    fn push(&mut self, row: usize, entry: f64) {
        self.rows.push(row);
        self.entries.push(entry);
    }

    fn end_column(&mut self) {
        self.starts.push(self.rows.len());
    }

    fn factorised(self) -> Result<Factor<f64>, SolveError> {
        let size = self.starts.len() - 1;
        let pattern = SymbolicSparseColMat::new_checked(size, size, self.starts, None, self.rows);
        let llt = SparseColMat::new(pattern, self.entries).sp_cholesky(Side::Lower).map_err(|_| SolveError { size })?;
        Ok(Factor { llt, size })
    }
}
