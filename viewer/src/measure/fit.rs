//! The slope of a power law.

/// d log y / d log x, by least squares through all points with positive numbers. None with fewer than two different x.
pub fn log_slope(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let usable = |(x, y): &(f64, f64)| *x > 0.0 && *y > 0.0 && x.is_finite() && y.is_finite();
    let logs: Vec<(f64, f64)> = points.into_iter().filter(usable).map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean = |side: fn(&(f64, f64)) -> f64| logs.iter().map(side).sum::<f64>() / count;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let (mut variance, mut covariance) = (0.0, 0.0);
    for log in &logs {
        variance += (log.0 - x).powi(2);
        covariance += (log.0 - x) * (log.1 - y);
    }
    (variance > 1e-12).then(|| covariance / variance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponent_of_a_power_law_is_found() {
        for exponent in [-0.5, 0.0, 1.0, 3.0] {
            let slope = log_slope([0.1, 0.2, 0.7, 5.0].map(|x: f64| (x, 4.0 * x.powf(exponent))));
            assert!((slope.expect("four points") - exponent).abs() < 1e-9, "{slope:?}");
        }
        assert_eq!(log_slope([(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(log_slope([(1.0, 2.0), (2.0, 0.0)]), None);
    }
}
