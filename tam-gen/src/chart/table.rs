//! A table of figures, as it goes into a CSV file and onto a page.

use super::ChartError;

/// Rows of text below a heading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns, units included.
    pub heading: Vec<String>,
    /// As many cells in each as the heading has.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// As comma-separated values, RFC 4180, in UTF-8.
    ///
    /// # Errors
    /// A row has more or less cells than the heading.
    pub fn csv(&self) -> Result<Vec<u8>, ChartError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let rows = std::iter::once(&self.heading).chain(&self.rows);
        rows.into_iter().try_for_each(|row| writer.write_record(row)).map_err(|error| ChartError(error.to_string()))?;
        writer.into_inner().map_err(|error| ChartError(error.to_string()))
    }
}

/// A figure with four digits that count; nothing where there is none.
pub fn figure(value: Option<f64>) -> String {
    let Some(value) = value.filter(|value| value.is_finite()) else { return String::new() };
    let digits = if value == 0.0 { 0 } else { 3 - value.abs().log10().floor() as i32 };
    match digits {
        ..=0 => format!("{value:.0}"),
        1..=7 => format!("{value:.*}", digits as usize),
        _ => format!("{value:.3e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_with_commas_and_quotes_come_back_whole() {
        let row = vec!["stripes, \"crossed\"".to_owned(), "0.012".to_owned()];
        let table = Table { heading: vec!["way".into(), "error".into()], rows: vec![row.clone()] };
        let bytes = table.csv().expect("as many cells as columns");
        let mut reader = csv::Reader::from_reader(&bytes[..]);
        assert_eq!(reader.headers().expect("a heading"), table.heading.as_slice());
        assert_eq!(reader.records().next().expect("a row").expect("a good one"), row);
    }

    #[test]
    fn rows_of_another_length_are_refused() {
        let table = Table { heading: vec!["a".into(), "b".into()], rows: vec![vec!["1".into()]] };
        assert!(table.csv().is_err());
    }

    #[test]
    fn figures_keep_four_digits_and_no_more() {
        let written = [0.0, 1.0, 0.012_345_6, 123.456, 12_345.6, 3.283e-6, -0.5].map(|x| figure(Some(x)));
        assert_eq!(written, ["0", "1.000", "0.01235", "123.5", "12346", "3.283e-6", "-0.5000"]);
        assert_eq!((figure(None), figure(Some(f64::NAN))), (String::new(), String::new()));
    }
}
