//! Rows of `lib/light.wgsl`, `lib/columns.wgsl`, `lib/material.wgsl` and `lib/octahedral.wgsl`.

use glam::DVec4;
use tam_shaders::Pass;
use tam_shaders::cpu::builtin::unpack2x16snorm;
use tam_shaders::cpu::lib::columns::{column_coordinate, map_level, map_scale};
use tam_shaders::cpu::lib::light::{Reflectance, arriving, darkness, luminance, to_light};
use tam_shaders::cpu::lib::material::{column_tone, reflectance, tile_uv};
use tam_shaders::cpu::lib::octahedral::{oct_decode, oct_encode, oct_fold};
use tam_shaders::cpu::{Bindings, octahedral};

use super::{any_point, one, three, two, xy};
use crate::draw::{Case, Draw, OWN};
use crate::row::{Row, U, row};

pub(crate) fn rows() -> Vec<Row> {
    vec![
        // A subtraction, a dot product of three and a square root.
        row(
            "to_light",
            Pass::Phong,
            "vec4f(to_light(scene.lights[u32(a.w) % scene.light_count], a.xyz), 0.0)",
            lit_place,
        )
        .twin(|b, case| three(to_light(&b.scene.lights[light_of(b, case[0].w)], case[0].truncate())))
        .within(16.0 * U, 0.0),
        // The power by logarithms of drivers is good to 1e-5; the exponent is 6.
        row(
            "arriving",
            Pass::Phong,
            "vec4f(arriving(scene.lights[u32(a.w) % scene.light_count], a.xyz), 0.0, 0.0, 0.0)",
            |draw| [draw.direction(OWN).extend(draw.pick(OWN + 9, 8) as f64), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO],
        )
        .twin(|b, case| one(arriving(&b.scene.lights[light_of(b, case[0].w)], case[0].truncate())))
        .except_where(|b, case| {
            let light = &b.scene.lights[light_of(b, case[0].w)];
            ((-case[0].truncate()).dot(light.direction) - light.cos_cutoff).abs() < 4.0 * U
        })
        .within(6e-5, 0.0),
        // Powers up to 30, of a cosine: 30 times the error of its direction, and of the logarithm.
        row(
            "luminance",
            Pass::Phong,
            "vec4f(luminance(Reflectance(d.x, d.y, d.z, d.w), a.xyz, b.xyz, c.xyz), 0.0, 0.0, 0.0)",
            shaded,
        )
        .twin(|b, case| {
            one(luminance(b.scene, any_reflectance(case), case[0].truncate(), case[1].truncate(), case[2].truncate()))
        })
        .except_where(grazing)
        .within(4e-4, 0.0),
        row(
            "darkness",
            Pass::Phong,
            "vec4f(darkness(Reflectance(d.x, d.y, d.z, d.w), a.xyz, b.xyz, c.xyz), 0.0, 0.0, 0.0)",
            shaded,
        )
        .twin(|b, case| {
            one(darkness(b.scene, any_reflectance(case), case[0].truncate(), case[1].truncate(), case[2].truncate()))
        })
        .except_where(grazing)
        .within(4e-4, 0.0),
        // The distance of two tones is 1/64 at least: a difference of them is off by 64 round-offs; the sum by its own.
        row("column_coordinate", Pass::FineTone, "vec4f(column_coordinate(a.x), 0.0, 0.0, 0.0)", any_tone)
            .twin(|b, case| one(column_coordinate(b.options.form, b.material, case[0].x)))
            .in_both_forms()
            .within(130.0 * U, 2.0 * U),
        // Drivers' logarithms are good to 1e-5.
        row("map_level", Pass::FineTone, "vec4f(map_level(a.y), 0.0, 0.0, 0.0)", any_tone)
            .twin(|b, case| one(map_level(b.material, case[0].y)))
            .within(2e-5, 0.0),
        row(
            "map_scale",
            Pass::FineTone,
            "vec4f(map_scale(a.y).tiles_per_px, map_scale(a.y).level, 0.0, 0.0)",
            any_tone,
        )
        .twin(|b, case| {
            let scale = map_scale(b.material, case[0].y);
            DVec4::new(scale.tiles_per_px, scale.level, 0.0, 0.0)
        })
        .within(2e-5, 0.0),
        // Read as they are.
        row("column_tone", Pass::FineTone, "vec4f(column_tone(u32(a.z)), 0.0, 0.0, 0.0)", any_tone)
            .twin(|b, case| one(column_tone(b.material, case[0].z as u32)))
            .within(1e-30, 0.0),
        row(
            "reflectance",
            Pass::FineTone,
            "vec4f(reflectance().ambient, reflectance().diffuse, reflectance().specular, reflectance().shininess)",
            any_tone,
        )
        .twin(|b, _| {
            let r = reflectance(b.material);
            DVec4::new(r.ambient, r.diffuse, r.specular, r.shininess)
        })
        .within(1e-30, 0.0),
        // Two products and two sums of numbers below 4.
        row("tile_uv", Pass::FineTone, "vec4f(tile_uv(a.xy), 0.0, 0.0)", any_tile)
            .twin(|b, case| two(tile_uv(b.material, xy(case[0]))))
            .within(16.0 * U, 0.0),
        row("oct_fold", Pass::Phong, "vec4f(oct_fold(a.xy), 0.0, 0.0)", any_tile)
            .twin(|_, case| two(oct_fold(xy(case[0]))))
            .within(4.0 * U, 0.0),
        // One step of the code, where rounding decides.
        row("oct_encode", Pass::Phong, "vec4f(unpack2x16snorm(oct_encode(a.xyz)), 0.0, 0.0)", |draw| {
            let zero = f64::from(draw.pick(OWN + 5, 50) != 0);
            [three(draw.direction(OWN) * zero), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
        })
        .twin(|_, case| two(unpack2x16snorm(oct_encode(case[0].truncate()))))
        .within(1.01 / 32767.0, 0.0),
        // Codes are read exactly; 1 - |x| - |y| loses two round-offs of 1 for a vector of length 0.58 at least.
        row("oct_decode", Pass::Phong, "vec4f(oct_decode(u32(a.x) | (u32(a.y) << 16u)), 0.0)", |draw| {
            let half = |slot| draw.pick(slot, 65536) as f64;
            [DVec4::new(half(OWN), half(OWN + 1), 0.0, 0.0), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
        })
        .twin(|_, case| three(oct_decode(octahedral_code(case))))
        .within(16.0 * U, 0.0),
    ]
}

fn octahedral_code(case: &Case) -> u32 {
    debug_assert_eq!(octahedral::oct_encode(glam::DVec3::ZERO), 0);
    case[0].x as u32 | (case[0].y as u32) << 16
}

fn light_of(b: &Bindings<'_>, number: f64) -> usize {
    number as usize % b.scene.lights.len()
}

/// Anywhere, or exactly at the positional light.
fn lit_place(draw: &Draw) -> Case {
    let place = if draw.pick(OWN + 8, 20) == 0 { glam::DVec3::new(1.5, 2.0, 1.0) } else { draw.place_within(OWN, 1.5) };
    [place.extend(draw.pick(OWN + 9, 8) as f64), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
}

fn shaded(draw: &Draw) -> Case {
    let [place, normal, view, _] = any_point(draw);
    let strength = |slot| draw.between(slot, 0.0, 1.0);
    [
        place,
        normal,
        view,
        DVec4::new(strength(OWN + 50), strength(OWN + 51), strength(OWN + 52), draw.between(OWN + 53, 1.0, 30.0)),
    ]
}

fn any_reflectance(case: &Case) -> Reflectance {
    let [ambient, diffuse, specular, shininess] = case[3].to_array();
    Reflectance { ambient, diffuse, specular, shininess }
}

/// Whether a highlight starts at this very place: where a light grazes, or a spot ends.
pub(crate) fn grazing(b: &Bindings<'_>, case: &Case) -> bool {
    b.scene.lights.iter().any(|light| {
        let l = to_light(light, case[0].truncate());
        let at_edge = ((-l).dot(light.direction) - light.cos_cutoff).abs() < 8.0 * U;
        case[1].truncate().dot(l).abs() < 8.0 * U || light.kind == 2 && at_edge
    })
}

fn any_tone(draw: &Draw) -> Case {
    let column = draw.pick(OWN + 9, 65) as f64;
    [DVec4::new(draw.tone(OWN), draw.scale(OWN + 5, 1e-4, 10.0), column, 0.0), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
}

fn any_tile(draw: &Draw) -> Case {
    [two(draw.tile(OWN, 1.0)), DVec4::ZERO, DVec4::ZERO, DVec4::ZERO]
}
