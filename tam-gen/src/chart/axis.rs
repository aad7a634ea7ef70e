//! Axes: what they show, and the numbers at their ticks.

/// An axis; less is better on both.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is measured, and in which unit.
    pub label: String,
    /// Logarithmic from this number (> 0) on, to which smaller ones are raised; `None`: even, from 0.
    pub log_from: Option<f64>,
    /// A number that all are compared with, and its name.
    pub mark: Option<(f64, String)>,
}

impl Axis {
    /// What the axis shows: all numbers, and room at the ends for dots and labels.
    pub fn range(&self, numbers: impl Iterator<Item = f64>) -> [f64; 2] {
        let mark = self.mark.iter().map(|(number, _)| *number);
        let numbers = numbers.filter(|number| number.is_finite()).chain(mark);
        let (least, most) = numbers.fold((f64::INFINITY, 0.0_f64), |(least, most), x| (least.min(x), most.max(x)));
        match self.log_from {
            Some(from) => {
                let (least, most) = (if least.is_finite() { least.max(from) } else { from }, most.max(2.0 * from));
                // A tenth of the way, and no less than a tenth of the number.
                let room = libm::pow(most / least, 0.08).max(1.1);
                [least / room, most * room]
            }
            None => [0.0, if most > 0.0 { 1.1 * most } else { 1.0 }],
        }
    }
}

/// A number at a tick: ticks are 1, 2 or 5 times a power of ten.
pub fn tick(number: f64) -> String {
    let size = number.abs();
    if number != 0.0 && !(1e-4..1e6).contains(&size) {
        return format!("{number:.0e}");
    }
    let text = format!("{number:.5}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_show_all_numbers_with_room_at_the_ends() {
        let axis = |log_from| Axis { label: "cost".into(), log_from, mark: Some((1.0, "yardstick".into())) };
        let [least, most] = axis(Some(0.1)).range([2.0, 30.0, f64::NAN].into_iter());
        assert!((0.5..1.0).contains(&least) && (30.0..60.0).contains(&most), "{least} {most}");
        assert_eq!(axis(None).range([4.0].into_iter()), [0.0, 4.4]);
        let empty = axis(Some(0.1)).range(std::iter::empty());
        assert!(empty[0] > 0.0 && empty[1] > empty[0], "{empty:?}");
    }

    #[test]
    fn ticks_are_short() {
        assert_eq!([0.0, 0.5, 20.0, 1e-5, 2e6].map(tick), ["0", "0.5", "20", "1e-5", "2e6"]);
    }
}
