//! The structs and constants that Rust and WGSL share are the same on both sides, as naga sees every composed pass.

use std::any::type_name;
use std::mem::{offset_of, size_of};

use naga::{ArraySize, Expression, Literal, Module, ScalarKind, Type, TypeInner};
use tam_shaders::cpu::lib::{colour, directions, edges, face_frame, patches, scene, stripes, strokes, threshold};
use tam_shaders::cpu::{
    self, Blend, DebugView, Follow, Form, Frames, Mapping, PatternKind, debug, face_geometry, line_edges, lines,
};
use tam_shaders::types::{
    Edge, FaceFrame, Light, LineStyle, MAX_COLUMNS, MAX_LIGHTS, Material, NO_FACE, NO_NORMAL, Scene, Vertex,
};
use tam_shaders::{Pass, compose};

/// A struct as one of the two sides describes it.
#[derive(Clone, Debug, PartialEq)]
struct Record {
    name: String,
    size: usize,
    members: Vec<Member>,
}

/// Offset and type, the type as Rust writes it.
#[derive(Clone, Debug, PartialEq)]
struct Member {
    name: String,
    offset: usize,
    kind: String,
}

/// Type of a field, without the paths of its crates.
fn kind_of<T, F>(_: impl Fn(&T) -> &F) -> String {
    type_name::<F>().replace("tam_shaders::types::", "")
}

macro_rules! record {
    ($record:ident { $($member:ident),* $(,)? }) => {
        Record {
            name: stringify!($record).into(),
            size: size_of::<$record>(),
            members: vec![$(Member {
                name: stringify!($member).into(),
                offset: offset_of!($record, $member),
                kind: kind_of(|record: &$record| &record.$member),
            }),*],
        }
    };
}

/// The structs of `types.rs`. A member that is missing here is missed in the comparison with WGSL.
fn records() -> Vec<Record> {
    vec![
        record!(Light { position, kind, direction, cos_cutoff, intensity, exponent, _pad }),
        record!(Scene {
            clip_from_world,
            world_from_mesh,
            mesh_from_world,
            world_from_mesh_normal,
            camera_world,
            pixel_world_at_1,
            camera_forward,
            light_count,
            viewport_px,
            ambient,
            parallel_from,
            paper,
            ink,
            lights,
        }),
        record!(Vertex { position, normal_oct }),
        record!(FaceFrame { tangent, bitangent_x, bitangent_yz, shares, normal_oct }),
        record!(Material {
            colour,
            ambient,
            diffuse,
            specular,
            shininess,
            tile_from_surface,
            shift_uv,
            tile_scale,
            size_px,
            level_count,
            level_bias,
            column_count,
            first_face,
            slope,
            line_period_px,
            distribution_entries,
            cross_from,
            variety,
            columns_per_tone,
            _pad_a,
            _pad_b,
            tones,
        }),
        record!(LineStyle { colour, width_px, crease_cosine, contours, borders, creases, edges, _pad_a, _pad_b }),
        record!(Edge { a, b, left, right }),
    ]
}

fn module(pass: Pass) -> Module {
    let source = compose(pass);
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(&source)))
}

/// A WGSL type as Rust writes the type that is laid out alike; strides that Rust has no word for are told.
fn rust_kind(module: &Module, ty: &Type) -> String {
    let scalar = |kind| match kind {
        ScalarKind::Float => "f32",
        ScalarKind::Uint => "u32",
        ScalarKind::Sint => "i32",
        other => panic!("{other:?} is not shared"),
    };
    match ty.inner {
        TypeInner::Scalar(of) => scalar(of.kind).into(),
        TypeInner::Vector { size, scalar: of } => format!("[{}; {}]", scalar(of.kind), size as u32),
        TypeInner::Matrix { columns, rows, scalar: of } => {
            assert_ne!(rows as u32, 3, "columns of three are padded");
            format!("[[{}; {}]; {}]", scalar(of.kind), rows as u32, columns as u32)
        }
        TypeInner::Array { base, size: ArraySize::Constant(length), stride } => {
            let base = &module.types[base];
            let packed = base.inner.size(module.to_ctx());
            let gap = if stride == packed { String::new() } else { format!(" every {stride} bytes") };
            format!("[{}; {length}]{gap}", rust_kind(module, base))
        }
        TypeInner::Struct { .. } => ty.name.clone().expect("structs are named"),
        ref other => panic!("{other:?} is not shared"),
    }
}

/// The struct of this name, as a pass knows it.
fn reflected(module: &Module, name: &str) -> Option<Record> {
    let (_, ty) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name))?;
    let TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is no struct") };
    let member = |member: &naga::StructMember| Member {
        name: member.name.clone().expect("members are named"),
        offset: member.offset as usize,
        kind: rust_kind(module, &module.types[member.ty]),
    };
    Some(Record { name: name.into(), size: *span as usize, members: members.iter().map(member).collect() })
}

#[test]
fn shared_structs_are_laid_out_alike_in_every_pass() {
    let records = records();
    let mut uses = vec![0; records.len()];
    for pass in Pass::ALL {
        let module = module(pass);
        for (record, uses) in records.iter().zip(&mut uses) {
            if let Some(reflected) = reflected(&module, &record.name) {
                assert_eq!(&reflected, record, "{}", pass.name());
                *uses += 1;
            }
        }
    }
    for (record, uses) in records.iter().zip(uses) {
        assert_ne!(uses, 0, "no pass knows {}", record.name);
    }
}

#[test]
fn a_changed_struct_is_noticed() {
    let module = module(Pass::SixWay);
    for record in records() {
        let Some(reflected) = reflected(&module, &record.name) else { continue };
        for i in 0..record.members.len() {
            let mut renamed = record.clone();
            renamed.members[i].name.push('s');
            let mut moved = record.clone();
            moved.members[i].offset += 4;
            let mut retyped = record.clone();
            retyped.members[i].kind = "i32".into();
            let mut dropped = record.clone();
            dropped.members.remove(i);
            let swapped = (i > 0).then(|| {
                let mut swapped = record.clone();
                swapped.members.swap(i - 1, i);
                swapped
            });
            for changed in [renamed, moved, retyped, dropped].into_iter().chain(swapped) {
                assert_ne!(reflected, changed);
            }
        }
        assert_ne!(reflected, Record { size: record.size + 16, ..record });
    }
}

#[test]
fn an_array_with_gaps_is_no_packed_array() {
    // Uniform arrays of scalars have a stride of 16 bytes only by declaration; vectors of three always have it.
    let module = naga::front::wgsl::parse_str("struct Light { lights: array<vec3f, 8> }").expect("valid WGSL");
    let light = reflected(&module, "Light").expect("it is there");
    assert_eq!(light.members[0].kind, "[[f32; 3]; 8] every 16 bytes");
}

/// The constants, and overrides' defaults, that several passes declare, with their numbers.
fn numbers(module: &Module) -> Vec<(String, f64)> {
    let number = |init| match module.global_expressions[init] {
        Expression::Literal(Literal::F32(number)) => f64::from(number),
        Expression::Literal(Literal::U32(number)) => f64::from(number),
        ref other => panic!("{other:?} is no number"),
    };
    let constants = module.constants.iter().map(|(_, constant)| (constant.name.clone(), Some(constant.init)));
    let overrides = module.overrides.iter().map(|(_, over)| (over.name.clone(), over.init));
    constants.chain(overrides).filter_map(|(name, init)| Some((name?, number(init?)))).collect()
}

#[test]
fn constants_are_the_same_in_rust_and_in_every_pass() {
    let single = |number: f64| f64::from(number as f32);
    let expected = [
        ("MAX_LIGHTS", MAX_LIGHTS as f64),
        ("NO_FACE", f64::from(NO_FACE)),
        ("NO_NORMAL", f64::from(NO_NORMAL)),
        ("LIGHT_DIRECTIONAL", f64::from(scene::LIGHT_DIRECTIONAL)),
        ("LIGHT_POSITIONAL", f64::from(scene::LIGHT_POSITIONAL)),
        ("LIGHT_SPOT", f64::from(scene::LIGHT_SPOT)),
        ("FORM", Form::default() as u32 as f64),
        ("FORM_HARDENED", Form::Hardened as u32 as f64),
        ("FORM_LITERAL", Form::Literal as u32 as f64),
        ("MAPPING", Mapping::default() as u32 as f64),
        ("MAPPING_UV", Mapping::Uv as u32 as f64),
        ("MAPPING_FRAMES", Mapping::Frames as u32 as f64),
        ("MAPPING_TRIPLANAR", Mapping::Triplanar as u32 as f64),
        ("MAPPING_PATCHES", Mapping::Patches as u32 as f64),
        ("MAPPING_LAPPED", Mapping::Lapped as u32 as f64),
        ("FOLLOW", Follow::default() as u32 as f64),
        ("FOLLOW_SURFACE", Follow::Surface as u32 as f64),
        ("FOLLOW_LIGHT", Follow::Light as u32 as f64),
        ("TURNS", patches::TURNS as f64),
        ("NO_SEED", f64::from(patches::NO_SEED)),
        ("PLACE_RANGE", patches::PLACE_RANGE),
        ("BEHIND_RANGE", patches::BEHIND_RANGE),
        ("BLEND", Blend::default() as u32 as f64),
        ("BLEND_UNION", Blend::Union as u32 as f64),
        ("BLEND_LINEAR", Blend::Linear as u32 as f64),
        ("PATTERN", PatternKind::default() as u32 as f64),
        ("PATTERN_STROKES", PatternKind::Strokes as u32 as f64),
        ("PATTERN_LINES", PatternKind::Lines as u32 as f64),
        ("FRAMES", Frames::default() as u32 as f64),
        ("FRAMES_HERE", Frames::Here as u32 as f64),
        ("FRAMES_FETCHED", Frames::Fetched as u32 as f64),
        ("SINE_BAND", single(face_frame::SINE_BAND)),
        ("MAX_SLOPE", single(threshold::MAX_SLOPE)),
        ("ROWS_PER_LEVEL", threshold::ROWS_PER_LEVEL as f64),
        ("FADE_FROM", single(stripes::FADE_FROM)),
        ("FADE_TO", single(stripes::FADE_TO)),
        ("ALONG", f64::from(cpu::stripes::ALONG)),
        ("ACROSS", f64::from(cpu::stripes::ACROSS)),
        ("EVEN_FROM", single(cpu::stripes::EVEN_FROM)),
        ("STROKE_TILES", single(strokes::STROKE_TILES)),
        ("GREATEST_GAP", single(strokes::GREATEST_GAP)),
        ("GREATEST_DIFFERENCE", single(strokes::GREATEST_DIFFERENCE)),
        ("PROFILE_MEAN", single(strokes::PROFILE_MEAN)),
        ("GREATEST_WAVER", single(strokes::GREATEST_WAVER)),
        ("TAU", single(colour::TAU)),
        ("LEAST_GRADIENT", single(directions::LEAST_GRADIENT)),
        ("DEBUG", DebugView::default() as u32 as f64),
        ("DEBUG_NONE", DebugView::None as u32 as f64),
        ("DEBUG_TONE", DebugView::Tone as u32 as f64),
        ("DEBUG_LEVEL", DebugView::Level as u32 as f64),
        ("DEBUG_COLUMNS", DebugView::Columns as u32 as f64),
        ("DEBUG_FRAMES", DebugView::Frames as u32 as f64),
        ("DEBUG_STRIPES", DebugView::Stripes as u32 as f64),
        ("DEBUG_ADJACENCY", DebugView::Adjacency as u32 as f64),
        ("DEBUG_TRIANGLES", DebugView::Triangles as u32 as f64),
        ("ISOLINE_PX", single(debug::ISOLINE_PX)),
        ("LEAST_SLOPE", single(debug::LEAST_SLOPE)),
        ("HATCH_PX", single(debug::HATCH_PX)),
        ("TICK_PX", single(debug::TICK_PX)),
        ("TICK_REACH_PX", single(debug::TICK_REACH_PX)),
        ("NONE_GREY", single(debug::NONE_GREY)),
        ("LEAST_AREA", single(face_geometry::LEAST_AREA)),
        ("PULL_WIDTHS", single(lines::PULL_WIDTHS)),
        ("CONTOUR_CLEAR", single(lines::CONTOUR_CLEAR)),
        ("CONTOUR_HIDDEN_PX", single(lines::CONTOUR_HIDDEN_PX)),
        ("END_INSET_PX", single(lines::END_INSET_PX)),
        ("BLOCK_EDGES", line_edges::BLOCK_EDGES as f64),
        ("BLOCK_LANES", line_edges::BLOCK_LANES as f64),
        ("SUMMING_LANES", line_edges::SUMMING_LANES as f64),
        ("LINE_NONE", edges::LineKind::None as u32 as f64),
        ("LINE_CENTRED", edges::LineKind::Centred as u32 as f64),
        ("LINE_RIGHT", edges::LineKind::Right as u32 as f64),
        ("LINE_LEFT", edges::LineKind::Left as u32 as f64),
    ];
    let mut seen = Vec::new();
    for pass in Pass::ALL {
        for (name, number) in numbers(&module(pass)) {
            let known = expected.iter().find(|(known, _)| *known == name);
            let (_, known) = known.unwrap_or_else(|| panic!("{}: {name} has no twin", pass.name()));
            assert_eq!(number, *known, "{}: {name}", pass.name());
            seen.push(name);
        }
    }
    for (name, _) in expected {
        assert!(seen.iter().any(|seen| seen == name), "no pass declares {name}");
    }
}

#[test]
fn tone_vectors_hold_white_and_the_most_columns() {
    let tones = Material { tones: [[0.0; 4]; 17], ..bytemuck::Zeroable::zeroed() }.tones;
    assert!(tones.as_flattened().len() > MAX_COLUMNS, "white and {MAX_COLUMNS} columns");
    assert!(tones.as_flattened().len() <= MAX_COLUMNS + 4, "no vector more than needed");
}
