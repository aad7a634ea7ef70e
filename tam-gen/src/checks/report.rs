//! Findings: what was measured, what is allowed, and the verdict.

use std::fmt;

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use super::Constraint;

/// What a measure may be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limit {
    /// At most this, inclusive.
    AtMost(f64),
    /// From the first to the second, inclusive.
    Between(f64, f64),
}

impl Limit {
    /// Whether a measured number is allowed; NaN is not.
    pub fn allows(self, measured: f64) -> bool {
        match self {
            Self::AtMost(most) => measured <= most,
            Self::Between(least, most) => (least..=most).contains(&measured),
        }
    }

    /// How near a measured number comes to the limit: at most 1 inside it, more outside.
    pub fn excess(self, measured: f64) -> f64 {
        match self {
            Self::AtMost(0.0) => 1.0 + measured,
            Self::AtMost(most) => measured / most,
            Self::Between(least, most) => (measured / most).max(least / measured.max(1e-12)),
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AtMost(most) => write!(f, "≤ {}", number(*most)),
            Self::Between(least, most) => write!(f, "{} .. {}", number(*least), number(*most)),
        }
    }
}

/// Whether a constraint holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It holds.
    Pass,
    /// It does not.
    Fail,
    /// It cannot be judged on this map, or with what is known about it.
    NotJudged {
        /// What is missing.
        why: String,
    },
}

impl Verdict {
    /// In words: `pass`, `fail`, `not judged`.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::NotJudged { .. } => "not judged",
        }
    }

    pub(super) fn of(measured: f64, limit: Limit) -> Self {
        if limit.allows(measured) { Self::Pass } else { Self::Fail }
    }
}

/// One constraint in one cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CellFinding {
    /// Level of the cell, 0 finest.
    pub level: usize,
    /// Column of the cell, 0 lightest.
    pub column: usize,
    /// What was measured there, in the unit of the finding.
    pub measured: f64,
    /// What is allowed there.
    pub limit: Limit,
    /// The cell's own verdict.
    pub verdict: Verdict,
    /// Where the constraint is one of texels and fails: the offending ones, as indices into the cell's rows.
    #[serde(skip)]
    pub texels: Vec<u32>,
}

impl CellFinding {
    pub(super) fn new(level: usize, column: usize, measured: f64, limit: Limit) -> Self {
        let verdict = Verdict::of(measured, limit);
        Self { level, column, measured, limit, verdict, texels: Vec::new() }
    }

    /// Adds the offending texels if the cell fails; `mask` is made only then.
    pub(super) fn marked(mut self, mask: impl FnOnce() -> Vec<bool>) -> Self {
        if self.verdict == Verdict::Fail {
            self.texels = (0_u32..).zip(mask()).filter_map(|(texel, offends)| offends.then_some(texel)).collect();
        }
        self
    }
}

/// One constraint over a whole map.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Which one.
    pub constraint: Constraint,
    /// What was measured, where it comes nearest to its limit or leaves it furthest behind; 0 if not judged.
    pub measured: f64,
    /// What is allowed there.
    pub limit: Limit,
    /// Unit of both; empty for plain ratios and tones.
    pub unit: &'static str,
    /// Whether it holds.
    pub verdict: Verdict,
    /// Where, and how bad, in words.
    pub detail: String,
    /// The cells that were judged.
    pub cells: Vec<CellFinding>,
}

impl Finding {
    pub(super) fn not_judged(constraint: Constraint, why: impl Into<String>) -> Self {
        let verdict = Verdict::NotJudged { why: why.into() };
        let limit = Limit::AtMost(0.0);
        Self { constraint, measured: 0.0, limit, unit: "", verdict, detail: String::new(), cells: Vec::new() }
    }

    pub(super) fn new(constraint: Constraint, measured: f64, limit: Limit, unit: &'static str) -> Self {
        let verdict = Verdict::of(measured, limit);
        Self { constraint, measured, limit, unit, verdict, detail: String::new(), cells: Vec::new() }
    }

    /// A finding that fails if any cell fails, and reports the worst one as `describe` words it.
    pub(super) fn of_cells(
        constraint: Constraint,
        unit: &'static str,
        cells: Vec<CellFinding>,
        describe: impl FnOnce(&CellFinding) -> String,
    ) -> Self {
        // The first of equals, so that the finest level and lightest column is named.
        let excess = |cell: &CellFinding| cell.limit.excess(cell.measured);
        let worse = |worst: Option<usize>, i: usize| match worst {
            Some(worst) if excess(&cells[worst]) >= excess(&cells[i]) => Some(worst),
            _ => Some(i),
        };
        let Some(worst) = (0..cells.len()).fold(None, worse).map(|i| &cells[i]) else {
            return Self::not_judged(constraint, "the map has no cells to judge");
        };
        let detail = describe(worst);
        Self { detail, cells: cells.clone(), ..Self::new(constraint, worst.measured, worst.limit, unit) }
    }

    /// Whether the constraint does not fail.
    pub fn holds(&self) -> bool {
        self.verdict != Verdict::Fail
    }

    /// Where and why, in words; for a constraint that was not judged what is missing.
    pub fn explanation(&self) -> &str {
        match &self.verdict {
            Verdict::NotJudged { why } => why,
            _ => &self.detail,
        }
    }
}

/// All findings about a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// One finding for each constraint, in the order of [`Constraint::ALL`].
    pub findings: Vec<Finding>,
}

impl Report {
    /// Whether no constraint fails.
    pub fn holds(&self) -> bool {
        self.findings.iter().all(Finding::holds)
    }

    /// The constraints that fail.
    pub fn failing(&self) -> Vec<Constraint> {
        self.findings.iter().filter(|finding| !finding.holds()).map(|finding| finding.constraint).collect()
    }

    /// The finding about one constraint.
    pub fn get(&self, constraint: Constraint) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.constraint == constraint)
    }

    pub(super) fn get_mut(&mut self, constraint: Constraint) -> Option<&mut Finding> {
        self.findings.iter_mut().find(|finding| finding.constraint == constraint)
    }

    /// The findings as aligned plain text: constraint, measured, limit, verdict, where.
    pub fn table(&self) -> String {
        let heads = ["constraint", "measured", "limit", "verdict", "where"].map(String::from);
        let rows: Vec<[String; 5]> = std::iter::once(heads).chain(self.findings.iter().map(row)).collect();
        let width = |i: usize| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or(0);
        let widths = [width(0), width(1), width(2), width(3)];
        let mut table = String::new();
        for row in &rows {
            for (cell, width) in row.iter().zip(widths) {
                table += &format!("{cell:<width$}  ");
            }
            table += row[4].as_str();
            table.truncate(table.trim_end().len());
            table.push('\n');
        }
        table
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.table())
    }
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut report = serializer.serialize_struct("Report", 2)?;
        report.serialize_field("holds", &self.holds())?;
        report.serialize_field("findings", &self.findings)?;
        report.end()
    }
}

fn row(finding: &Finding) -> [String; 5] {
    let judged = !matches!(finding.verdict, Verdict::NotJudged { .. });
    let or_dash = |text: String| if judged { text } else { "-".into() };
    [
        finding.constraint.name().into(),
        or_dash(with_unit(number(finding.measured), finding.unit)),
        or_dash(with_unit(finding.limit.to_string(), finding.unit)),
        finding.verdict.word().into(),
        finding.explanation().into(),
    ]
}

pub(super) fn with_unit(text: String, unit: &str) -> String {
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// A number with about four significant digits, as short as it can be read.
pub(super) fn number(number: f64) -> String {
    let size = number.abs();
    let text = match size {
        _ if number == 0.0 || !number.is_finite() => return format!("{number}"),
        _ if size < 1e-3 => return format!("{number:.1e}"),
        _ if size < 1.0 => format!("{number:.4}"),
        _ if size < 100.0 => format!("{number:.2}"),
        _ => format!("{number:.0}"),
    };
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}
