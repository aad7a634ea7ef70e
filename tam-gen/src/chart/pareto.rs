//! Which of many ways are worth their cost.

/// Indices of the points that no other beats: none is at most as large on both axes and smaller on one. By growing x,
/// and so by falling y; of equal points the first. Points with a number that is not finite are on no front.
///
/// Pareto's efficiency (1906), both axes counted as costs.
pub fn pareto_front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).filter(|i| points[*i].iter().all(|x| x.is_finite())).collect();
    // The sort is stable, so equal points stay in their order.
    order.sort_by(|a, b| points[*a][0].total_cmp(&points[*b][0]).then(points[*a][1].total_cmp(&points[*b][1])));
    let mut least = f64::INFINITY;
    order.retain(|i| {
        let better = points[*i][1] < least;
        least = least.min(points[*i][1]);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_holds_what_nothing_beats_by_growing_cost() {
        let points = [[3.0, 1.0], [1.0, 4.0], [2.0, 5.0], [2.0, 2.0], [4.0, 1.0], [3.0, 3.0]];
        assert_eq!(pareto_front(&points), [1, 3, 0]);
    }

    #[test]
    fn equal_points_count_once_and_what_is_no_number_never() {
        let points = [[f64::NAN, 0.0], [1.0, 1.0], [1.0, 1.0], [0.5, f64::INFINITY], [1.0, 2.0]];
        assert_eq!(pareto_front(&points), [1]);
        assert_eq!(pareto_front(&[]), [0; 0]);
    }

    #[test]
    fn every_other_point_is_beaten_by_one_of_the_front() {
        let points: Vec<[f64; 2]> = (0..200_u32).map(|i| [f64::from(i * 89 % 233), f64::from(i * 144 % 377)]).collect();
        let front = pareto_front(&points);
        let beats = |a: [f64; 2], b: [f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
        for i in 0..points.len() {
            let beaten = front.iter().any(|j| beats(points[*j], points[i]));
            assert_eq!(beaten, !front.contains(&i), "{:?}", points[i]);
        }
    }
}
