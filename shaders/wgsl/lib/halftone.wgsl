// Lines of variable width. Freudenberg, "Real-Time Stroke Textures", SIGGRAPH 2001 sketch: a halftone pattern compared
// with the wanted intensity, made soft by a slope. The number of lines follows the screen by doubling: old lines stay
// at whole phases and new ones appear between them, with exact tone at every stage.

// Widths of the old and of the new lines, in units of their common distance, when the new ones are grown by f, 0..=1.
// Their mean is d, and they never overlap: half of both is d at most.
fn line_widths(d: f32, f: f32) -> vec2f {
    return vec2f(d * (2.0 - f), d * f);
}

// Share of a pixel that a line covers: the pixel is a box 1 / k wide at distance x >= 0 from the line's middle.
fn line_coverage(x: f32, width: f32, k: f32) -> f32 {
    return clamp(0.5 + k * (0.5 * width - x), 0.0, 1.0) - clamp(0.5 - k * (0.5 * width + x), 0.0, 1.0);
}

// Ink of lines at the phase, one old line per unit; phase_per_px is the slope of the phase on the screen.
fn line_ink(phase: f32, phase_per_px: f32, d: f32, f: f32) -> f32 {
    let widths = line_widths(d, f);
    let x = 2.0 * abs(phase - round(phase));
    let k = 0.5 / max(phase_per_px, 1e-6);
    return clamp(line_coverage(x, widths.x, k) + line_coverage(1.0 - x, widths.y, k), 0.0, 1.0);
}

// Lines across t, spaced between line_period_px and twice that on the screen; t_per_px is the slope of t there.
fn halftone_ink(t: f32, t_per_px: f32, line_period_px: f32, d: f32) -> f32 {
    // Lines per tile at which the finest lines stand line_period_px apart; half as many old ones.
    let wanted = 1.0 / max(t_per_px * line_period_px, 1e-6);
    let octave = floor(log2(wanted));
    let f = clamp(wanted / exp2(octave) - 1.0, 0.0, 1.0);
    let lines = exp2(octave);
    return line_ink(t * lines, t_per_px * lines, d, f);
}

// As the sketch has it: a halftone pattern that is fixed to the surface, to be thresholded with a fixed slope.
fn halftone_threshold(t: f32, lines: f32) -> f32 {
    let phase = t * lines;
    return 2.0 * abs(phase - round(phase));
}
