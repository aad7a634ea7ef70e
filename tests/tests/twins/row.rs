//! One function under test, and the harness that compares it with its twin.

use std::sync::Arc;

use glam::DVec4;
use tam_shaders::cpu::{Bindings, Form, Options, Quad};
use tam_shaders::{Pass, compose};

use crate::draw::{Case, Draw};
use crate::gpu::{CASES, Gpu, SIDE};
use crate::setting::{Setting, Uploaded};

/// Unit round-off of 32-bit numbers.
pub(crate) const U: f64 = 1.0 / (1 << 24) as f64;
/// What may be allowed on top in most cases; see [`Row::stretched`].
const STRETCHED_MOST: f64 = 0.1;
/// The twin of a call: given all four cases of a quad and which is asked for.
pub(crate) type Twin = Arc<dyn Fn(&Bindings<'_>, &Quad<Case>, usize) -> DVec4 + Send + Sync>;
/// Whether a case is left out.
type Undecided = fn(&Bindings<'_>, &Case) -> bool;
/// Allowed on top for one case.
type Stretched = fn(&Bindings<'_>, &Case) -> f64;

/// A function and its twin.
pub(crate) struct Row {
    /// Its name in WGSL.
    pub(crate) name: &'static str,
    pass: Pass,
    call: &'static str,
    /// Constants of the pipelines it is compared in.
    pub(crate) options: Vec<Options>,
    inputs: fn(&Draw) -> Case,
    /// What must come out.
    pub(crate) twin: Twin,
    absolute: f64,
    relative: f64,
    stretched: Option<Stretched>,
    undecided: Undecided,
}

/// A row that is compared in the hardened form.
pub(crate) fn row(name: &'static str, pass: Pass, call: &'static str, inputs: fn(&Draw) -> Case) -> Row {
    Row {
        name,
        pass,
        call,
        options: vec![Options::default()],
        inputs,
        twin: Arc::new(|_, _, _| DVec4::NAN),
        absolute: 0.0,
        relative: 0.0,
        stretched: None,
        undecided: |_, _| false,
    }
}

impl Row {
    /// Compares with a function of one fragment.
    pub(crate) fn twin(mut self, twin: impl Fn(&Bindings<'_>, &Case) -> DVec4 + Send + Sync + 'static) -> Self {
        self.twin = Arc::new(move |b, quad, lane| twin(b, &quad[lane]));
        self
    }

    /// Compares with a function of the whole quad.
    pub(crate) fn quad_twin(
        mut self,
        twin: impl Fn(&Bindings<'_>, &Quad<Case>, usize) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        self.twin = Arc::new(twin);
        self
    }

    /// Greatest difference allowed: `absolute + relative * |twin|`, in every component. The call says why.
    pub(crate) fn within(mut self, absolute: f64, relative: f64) -> Self {
        (self.absolute, self.relative) = (absolute, relative);
        self
    }

    /// Allows on top what the errors of a case's inputs become in the result, for functions so steep in places that one
    /// bound for all cases would allow anything. In one case out of four at most it may be more than [`STRETCHED_MOST`].
    pub(crate) fn stretched(mut self, by: Stretched) -> Self {
        self.stretched = Some(by);
        self
    }

    /// Compares in these pipelines.
    pub(crate) fn in_options(mut self, options: impl IntoIterator<Item = Options>) -> Self {
        self.options = options.into_iter().collect();
        self
    }

    /// Compares in both forms.
    pub(crate) fn in_both_forms(self) -> Self {
        self.in_options([Form::Hardened, Form::Literal].map(|form| Options { form, ..Options::default() }))
    }

    /// Leaves out cases so near to a jump that rounding decides on which side they are; one in ten at most.
    pub(crate) fn except_where(mut self, undecided: Undecided) -> Self {
        self.undecided = undecided;
        self
    }

    /// What went wrong, a line for each pipeline and setting: the worst case and how many there are.
    pub(crate) fn failures(&self, gpu: &Gpu, settings: &[Setting]) -> Vec<String> {
        let source = self.source();
        let mut failures = Vec::new();
        for (i, setting) in settings.iter().enumerate() {
            let draws: Vec<Draw> = (0..CASES).map(|index| Draw::new(self.name, i as u64, index)).collect();
            let cases: Vec<Case> =
                draws.iter().map(|draw| (self.inputs)(draw).map(|v| v.as_vec4().as_dvec4())).collect();
            let uploaded = Uploaded::new(gpu, setting, &cases);
            for options in &self.options {
                let found = gpu.draw(&source, *options, &|name: &str| uploaded.resource(name));
                let compared = self.compare(&setting.bindings(*options), &draws, &cases, &found);
                failures
                    .extend(compared.err().map(|error| format!("{} in {options:?}, setting {i}: {error}", self.name)));
            }
        }
        failures
    }

    fn compare(&self, b: &Bindings<'_>, draws: &[Draw], cases: &[Case], found: &[[f32; 4]]) -> Result<(), String> {
        let (mut left_out, mut loose, mut wrong, mut worst) = (0, 0, 0, (1.0, String::new()));
        for (draw, found) in draws.iter().zip(found) {
            let case = &cases[draw.index];
            if (self.undecided)(b, case) {
                left_out += 1;
                continue;
            }
            let lane = draw.lane();
            let first = draw.index - lane % 2 - lane / 2 * SIDE as usize;
            let quad = Quad::from_fn(|lane| cases[first + lane % 2 + lane / 2 * SIDE as usize]);
            let twin = (self.twin)(b, &quad, lane);
            let found = DVec4::from(found.map(f64::from));
            let stretched = self.stretched.map_or(0.0, |stretched| stretched(b, case));
            loose += usize::from(stretched > STRETCHED_MOST);
            let allowed = self.absolute + stretched + self.relative * twin.abs();
            let share = ((found - twin).abs() / allowed).to_array();
            // Not a number is wrong too.
            if !share.iter().all(|share| *share <= 1.0) {
                wrong += 1;
                let share =
                    share.into_iter().map(|share| if share.is_nan() { f64::MAX } else { share }).fold(0.0, f64::max);
                if share > worst.0 {
                    worst = (share, format!("{found} for {twin}, {share:.2} of what is allowed, at {case:?}"));
                }
            }
        }
        if wrong > 0 {
            return Err(format!("{wrong} of {CASES} cases differ, worst {}", worst.1));
        }
        if left_out * 10 > CASES {
            return Err(format!("{left_out} of {CASES} cases are left out"));
        }
        if loose * 4 > CASES {
            return Err(format!("{loose} of {CASES} cases say little"));
        }
        Ok(())
    }

    fn source(&self) -> String {
        let pass = compose(self.pass);
        let call = self.call;
        let with = |name: &str, helper: &'static str| if pass.contains(name) { helper } else { "" };
        let helper = format!("{}{}", with("struct Point {", POINT), with("struct Pattern {", PATTERN));
        let framed = if pass.contains("struct Point {") { with("> face_frames: ", FRAMED) } else { "" };
        let helper = helper + framed;
        let helper = helper + with("struct Overlap {", OVERLAP) + with("struct Stroke {", STROKE);
        format!(
            "{pass}{HARNESS}{helper}@fragment\nfn harness(@builtin(position) place: vec4f) -> @location(0) vec4f {{\n\
            let at = u32(place.y) * {SIDE}u + u32(place.x);\n\
            let a = cases[at].a;\nlet b = cases[at].b;\nlet c = cases[at].c;\nlet d = cases[at].d;\n\
            return {call};\n}}\n"
        )
    }
}

const HARNESS: &str = "
struct Case { a: vec4f, b: vec4f, c: vec4f, d: vec4f }
@group(3) @binding(20) var<storage, read> cases: array<Case>;
@vertex
fn harness_vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 2.0 - 1.0, 1.0 - f32(i >> 1u) * 2.0, 0.0, 1.0);
}
";

/// A surface point of a case; see [`crate::tables::point`].
const POINT: &str = "
fn case_point(a: vec4f, b: vec4f, c: vec4f, d: vec4f) -> Point {
    return Point(a.xyz, b.xyz, c.xyz, a.w, d.xy, vec2u(0u));
}
";

/// The same with the frame of its face; see [`crate::tables::framed_point`].
const FRAMED: &str = "
fn framed_point(a: vec4f, b: vec4f, c: vec4f, d: vec4f) -> Point {
    let frame = face_frames[u32(d.z)];
    return Point(a.xyz, b.xyz, c.xyz, a.w, d.xy, vec2u(frame.shares, frame.normal_oct));
}
";

/// What a corner carries; see [`crate::setting::Corner`].
const OVERLAP: &str = "
@group(3) @binding(21) var<storage, read> case_corners: array<vec4u>;
fn case_overlap(corner: u32) -> Overlap {
    let places = case_corners[4u * corner];
    let behind = case_corners[4u * corner + 1u];
    return carried_overlap(
        vec4f(unpack2x16snorm(places.x), unpack2x16snorm(places.y)),
        vec4f(unpack2x16snorm(places.z), unpack2x16snorm(places.w)),
        vec4f(unpack2x16unorm(behind.x), unpack2x16unorm(behind.y)),
        case_corners[4u * corner + 2u],
    );
}
fn case_rows(corner: u32) -> vec4u {
    return case_corners[4u * corner + 3u];
}
";

/// A stroke as one vector.
const STROKE: &str = "
fn stroked(s: Stroke) -> vec4f {
    return vec4f(s.swell, s.waver, 0.0, 0.0);
}
";

/// A pattern as one vector.
const PATTERN: &str = "
fn patterned(p: Pattern) -> vec4f {
    return vec4f(p.uv, p.weight, 0.0);
}
";
