//! Twin of `lib/halftone.wgsl`: lines of variable width. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001 sketch.

use glam::DVec2;

/// Widths of the old and of the new lines, in units of their common distance, when the new ones are grown by `f`.
pub fn line_widths(d: f64, f: f64) -> DVec2 {
    DVec2::new(d * (2.0 - f), d * f)
}

/// Share of a pixel that a line covers: the pixel is a box `1 / k` wide at distance `x >= 0` from the line's middle.
pub fn line_coverage(x: f64, width: f64, k: f64) -> f64 {
    (0.5 + k * (0.5 * width - x)).clamp(0.0, 1.0) - (0.5 - k * (0.5 * width + x)).clamp(0.0, 1.0)
}

/// Ink of lines at the phase, one old line per unit; `phase_per_px` is the slope of the phase on the screen.
pub fn line_ink(phase: f64, phase_per_px: f64, d: f64, f: f64) -> f64 {
    let widths = line_widths(d, f);
    let x = 2.0 * (phase - phase.round_ties_even()).abs();
    let k = 0.5 / phase_per_px.max(1e-6);
    (line_coverage(x, widths.x, k) + line_coverage(1.0 - x, widths.y, k)).clamp(0.0, 1.0)
}

/// Lines across `t`, spaced between `line_period_px` and twice that on the screen; `t_per_px` is the slope of `t` there.
pub fn halftone_ink(t: f64, t_per_px: f64, line_period_px: f64, d: f64) -> f64 {
    let wanted = 1.0 / (t_per_px * line_period_px).max(1e-6);
    let octave = wanted.log2().floor();
    let f = (wanted / octave.exp2() - 1.0).clamp(0.0, 1.0);
    let lines = octave.exp2();
    line_ink(t * lines, t_per_px * lines, d, f)
}

/// As the sketch has it: a halftone pattern that is fixed to the surface, to be thresholded with a fixed slope.
pub fn halftone_threshold(t: f64, lines: f64) -> f64 {
    let phase = t * lines;
    2.0 * (phase - phase.round_ties_even()).abs()
}
