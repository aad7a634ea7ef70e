//! Which ways to draw the open scene are measured, and in which order.

use super::super::subject::{Subject, bare};
use crate::chart::{MapChoice, Way, WaysOptions, ways};
use crate::{Follow, Form, Mapping, Method, RenderParams};

/// Triangles up to which surfaces are made.
pub(super) const SURFACE_TRIANGLES: usize = super::super::engine::SURFACE_TRIANGLES;

/// All ways: the present one first, then hardened forms before printed ones, and those with the cheapest frames before
/// others. Those on a surface are left out on very large meshes, `lapped` patches unless they are there already.
pub(super) fn plan(subject: &Subject, lapped: bool) -> Vec<Way> {
    let present = bare(&subject.look.params);
    let has_surface = subject.mesh.triangles.len() <= SURFACE_TRIANGLES;
    let serves = |mapping: &Mapping| match mapping {
        Mapping::Uv => !subject.mesh.uvs.is_empty(),
        Mapping::Patches => has_surface,
        Mapping::Lapped => has_surface && lapped,
        Mapping::Frames | Mapping::Triplanar => true,
    };
    let mappings: Vec<Mapping> = Mapping::ALL.into_iter().filter(serves).collect();
    let methods: Vec<Method> =
        Method::ALL.into_iter().filter(|method| has_surface || *method != Method::Stripes).collect();
    let choice = MapChoice { size: subject.preset.map.size, tones: subject.map.grid.columns() as u32 };
    let plain = RenderParams { cross_from: RenderParams::default().cross_from, variety: 0.0, ..present };
    let mut all = ways(&WaysOptions {
        base: RenderParams { cross_from: present.cross_from, ..plain },
        methods: &methods,
        mappings: &mappings,
        maps: &[choice],
        stroke_maps: subject.map.stroke_map.is_some(),
        // The strokes of varied stripes lie on patches, and cannot turn.
        stripes: [true, present.follow == Follow::Surface],
    });
    all.retain(|way| way.params.method != Method::Phong);
    // What only stripes know makes no other way another one.
    for way in all.iter_mut().filter(|way| way.params.method != Method::Stripes) {
        (way.params.cross_from, way.params.variety) = (plain.cross_from, plain.variety);
    }
    let present = if present.method == Method::Stripes { present } else { plain };
    let present = Way { params: present, map: 0 };
    let shown = |way: &Way| way.name() == present.name();
    match all.iter_mut().find(|way| shown(way)) {
        // Stripes may vary more or less than those that are offered.
        Some(way) => *way = present,
        None if is_drawable(&present, &methods, &mappings) => all.push(present),
        None => {}
    }
    all.sort_by_key(|way| (!shown(way), way.params.form == Form::Literal, expense(&way.params)));
    all
}

fn is_drawable(way: &Way, methods: &[Method], mappings: &[Mapping]) -> bool {
    let RenderParams { method, mapping, follow, variety, .. } = way.params;
    let turns = method == Method::Stripes && variety > 0.0 && follow == Follow::Light;
    method != Method::Phong
        && methods.contains(&method)
        && (!method.takes_mapping() || mappings.contains(&mapping))
        && !turns
}

/// A rank of ways by what their frames cost, as the benches found it.
fn expense(params: &RenderParams) -> u32 {
    let method = match params.method {
        Method::Phong | Method::Halftone => 0,
        Method::SixWay => 1,
        Method::StrokeMap => 2,
        Method::FineTone => 3,
        Method::Stripes if params.variety > 0.0 => 14,
        Method::Stripes => 2,
        Method::FaceFrame => 20,
    };
    let mapping = match params.needed_mapping() {
        None | Some(Mapping::Uv) => 0,
        Some(Mapping::Triplanar) => 4,
        Some(Mapping::Frames) => 8,
        Some(Mapping::Patches) => 12,
        Some(Mapping::Lapped) => 16,
    };
    method + mapping
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::super::named::Named;
    use super::super::super::subject::tests::cube;
    use super::*;

    fn names(ways: &[Way]) -> Vec<String> {
        ways.iter().map(Way::name).collect()
    }

    #[test]
    fn the_present_way_is_first_and_printed_forms_are_last() {
        let mut subject = cube();
        (subject.look.params.method, subject.look.params.mapping) = (Method::FineTone, Mapping::Patches);
        let ways = plan(&subject, false);
        assert_eq!(ways[0].name(), "fine-tone, patches");
        let printed = ways.iter().position(|way| way.params.form == Form::Literal).expect("printed forms");
        assert!(ways[printed..].iter().all(|way| way.params.form == Form::Literal));
        let place = |name: &str| names(&ways).iter().position(|other| other == name).expect("it is measured");
        assert!(place("halftone, triplanar") < place("six-way, patches"));
        assert!(place("stripes") < place("face-frame"));
        assert_eq!(names(&ways).iter().collect::<BTreeSet<_>>().len(), ways.len(), "each once");
        assert!(!names(&ways).contains(&"phong".to_owned()), "the yardstick is no way to hatch");
    }

    #[test]
    fn ways_that_the_scene_does_not_allow_are_left_out() {
        let has = |subject: &Subject, lapped: bool, word: &str| {
            names(&plan(subject, lapped)).iter().any(|name| name.contains(word))
        };
        let mut subject = cube();
        assert!(has(&subject, false, "uv") && !has(&subject, false, "lapped") && has(&subject, true, "lapped"));
        let mut mesh = (*subject.mesh).clone();
        mesh.uvs.clear();
        subject.mesh = Named::mesh(mesh.clone());
        assert!(!has(&subject, false, "uv"));
        subject.look.params.follow = Follow::Light;
        assert!(has(&subject, false, "patches") && !has(&subject, false, "varied"));
        mesh.triangles = vec![[0; 3]; SURFACE_TRIANGLES + 1];
        subject.mesh = Named::mesh(mesh);
        for word in ["patches", "stripes", "lapped"] {
            assert!(!has(&subject, true, word), "{word}");
        }
        assert!(has(&subject, true, "triplanar"), "ways without surfaces are left");
    }

    #[test]
    fn stripes_are_measured_as_they_are_shown() {
        let mut subject = cube();
        let params = &mut subject.look.params;
        (params.method, params.variety, params.cross_from) = (Method::Stripes, 0.25, None);
        let ways = plan(&subject, false);
        assert_eq!((ways[0].name().as_str(), ways[0].params.variety), ("stripes, varied", 0.25));
        subject.look.params.cross_from = Some(0.4);
        let ways = plan(&subject, false);
        assert_eq!(ways[0].name(), "stripes, crossed, varied", "also as the list does not offer them");
    }
}
