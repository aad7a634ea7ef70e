// Colours by hue that look equally light. Ottosson, "A perceptual color space for image processing", 2020,
// https://bottosson.github.io/posts/oklab: Oklab in polar coordinates.

const TAU: f32 = 6.2831853;

// Linear light of a lightness 0..=1, a chroma 0..=0.4 and a hue in turns; what no screen shows is clamped.
fn oklch(lightness: f32, chroma: f32, hue: f32) -> vec3f {
    let a = chroma * cos(TAU * hue);
    let b = chroma * sin(TAU * hue);
    let root = vec3f(
        lightness + 0.3963377774 * a + 0.2158037573 * b,
        lightness - 0.1055613458 * a - 0.0638541728 * b,
        lightness - 0.0894841775 * a - 1.2914855480 * b,
    );
    let cones = root * root * root;
    let rgb = vec3f(
        dot(vec3f(4.0767416621, -3.3077115913, 0.2309699292), cones),
        dot(vec3f(-1.2684380046, 2.6097574011, -0.3413193965), cones),
        dot(vec3f(-0.0041960863, -0.7034186147, 1.7076147010), cones),
    );
    return clamp(rgb, vec3f(0.0), vec3f(1.0));
}
