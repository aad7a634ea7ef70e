//! Rounding to whole numbers in the inner loops. Without SSE 4.1, which a portable binary does without, the standard
//! functions are calls of some twenty instructions.

/// The largest whole number not above `x`, for `x` well inside the range of `i32`.
#[inline]
pub(crate) fn floor(x: f32) -> i32 {
    let towards_zero = x as i32;
    towards_zero - i32::from(towards_zero as f32 > x)
}

/// The smallest whole number not below `x`, for `x` well inside the range of `i32`.
#[inline]
pub(crate) fn ceil(x: f32) -> i32 {
    -floor(-x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_are_those_of_the_standard_functions() {
        for i in -4000..4000 {
            for x in [i as f32 / 8.0, i as f32 * 1.000_1, (i as f32).next_up(), (i as f32).next_down()] {
                assert_eq!((floor(x), ceil(x)), (x.floor() as i32, x.ceil() as i32), "{x}");
            }
        }
    }
}
