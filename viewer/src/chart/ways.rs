//! Every way to draw a scene that is worth measuring.

use crate::params::{Form, Mapping, Method, RenderParams};

use super::maps::MapChoice;

/// How much the strokes of varied stripes differ.
pub const VARIETY: f64 = 0.6;

/// A way to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// How it is drawn; without lines over the strokes.
    pub params: RenderParams,
    /// With which of the maps; methods that sample none have the first.
    pub map: usize,
}

/// Which ways there are.
#[derive(Clone, Copy, Debug)]
pub struct WaysOptions<'a> {
    /// What all have in common.
    pub base: RenderParams,
    /// The methods; `phong` is first in any case, as it is the yardstick.
    pub methods: &'a [Method],
    /// The mappings, for methods that take one.
    pub mappings: &'a [Mapping],
    /// The maps, the one that is used where nothing is said of it first.
    pub maps: &'a [MapChoice],
    /// Whether there is a stroke map in each of them.
    pub stroke_maps: bool,
    /// Whether there are stripes across the field, and patches that varied ones need.
    pub stripes: [bool; 2],
}

/// All ways, the yardstick first: each method with each mapping, as its source prints it and hardened, on each map that
/// makes a difference to it. Maps of other tones than the first are drawn by the hardened forms of methods that mix
/// columns.
pub fn ways(options: &WaysOptions<'_>) -> Vec<Way> {
    let base = RenderParams { silhouettes: None, ..options.base };
    let mut ways = vec![Way { params: RenderParams { method: Method::Phong, form: Form::Hardened, ..base }, map: 0 }];
    for method in options.methods {
        match method {
            Method::Phong => {}
            Method::Stripes => ways.extend(stripes(&base, options.stripes)),
            Method::StrokeMap if !options.stroke_maps => {}
            method if method.takes_mapping() => {
                for mapping in options.mappings {
                    let params = RenderParams { method: *method, mapping: *mapping, ..base };
                    ways.extend(forms(&params, options.maps));
                }
            }
            method => ways.extend(forms(&RenderParams { method: *method, ..base }, options.maps)),
        }
    }
    ways
}

/// Both forms of a method on every map that it tells apart.
fn forms(params: &RenderParams, maps: &[MapChoice]) -> Vec<Way> {
    let of = |form: Form| {
        let told_apart = move |map: &usize| {
            let (own, first) = (&maps[*map], &maps[0]);
            let sized = own.size != first.size && own.tones == first.tones;
            let toned = own.tones != first.tones && form == Form::Hardened;
            *map == 0 || (sized && samples_map(params.method)) || (toned && mixes_columns(params.method))
        };
        (0..maps.len()).filter(told_apart).map(move |map| Way { params: RenderParams { form, ..*params }, map })
    };
    of(Form::Hardened).chain(of(Form::Literal)).collect()
}

fn stripes(base: &RenderParams, [crossing, varied]: [bool; 2]) -> Vec<Way> {
    let plain = RenderParams { method: Method::Stripes, form: Form::Hardened, cross_from: None, variety: 0.0, ..*base };
    let cross_from = base.cross_from.or(RenderParams::default().cross_from);
    let mut all = vec![plain];
    if crossing {
        all.push(RenderParams { cross_from, ..plain });
    }
    if varied {
        all.push(RenderParams { variety: VARIETY, ..plain });
    }
    all.push(RenderParams { form: Form::Literal, ..plain });
    all.into_iter().map(|params| Way { params, map: 0 }).collect()
}

fn samples_map(method: Method) -> bool {
    !matches!(method, Method::Phong | Method::Halftone | Method::Stripes)
}

/// Whether the map's own tones count; `fine-tone` makes columns of its own, stroke maps have none.
fn mixes_columns(method: Method) -> bool {
    matches!(method, Method::SixWay | Method::FaceFrame)
}

impl Way {
    /// Whether it samples a map at all.
    pub fn samples_map(&self) -> bool {
        samples_map(self.params.method)
    }

    /// Whether the map's own tones count.
    pub fn mixes_columns(&self) -> bool {
        mixes_columns(self.params.method)
    }

    /// Method, mapping and form in words, for a picture of it.
    pub fn name(&self) -> String {
        let RenderParams { method, mapping, form, .. } = self.params;
        let mut name = method.name().to_owned();
        if method.takes_mapping() {
            name += &format!(", {}", mapping.name());
        }
        if method == Method::Stripes && self.params.cross_from.is_some() {
            name += ", crossed";
        }
        if method == Method::Stripes && self.params.variety > 0.0 {
            name += ", varied";
        }
        if form == Form::Literal {
            name += ", literal";
        }
        name
    }

    /// The same with the map's size, and its tones where they are not those of the first map.
    pub fn label(&self, maps: &[MapChoice]) -> String {
        let mut label = self.name();
        if samples_map(self.params.method) {
            label += &format!(", {} px", maps[self.map].size);
            if maps[self.map].tones != maps[0].tones {
                label += &format!(", {} tones", maps[self.map].tones);
            }
        }
        label
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn all() -> (Vec<Way>, [MapChoice; 3]) {
        let map = |size, tones| MapChoice { size, tones };
        let maps = [map(256, 6), map(128, 6), map(256, 12)];
        let options = WaysOptions {
            base: RenderParams::default(),
            methods: &Method::ALL,
            mappings: &[Mapping::Uv, Mapping::Patches],
            maps: &maps,
            stroke_maps: true,
            stripes: [true, true],
        };
        (ways(&options), maps)
    }

    #[test]
    fn every_way_has_a_label_of_its_own_and_the_yardstick_is_first() {
        let (ways, maps) = all();
        let labels: BTreeSet<String> = ways.iter().map(|way| way.label(&maps)).collect();
        assert_eq!(labels.len(), ways.len(), "{labels:?}");
        assert_eq!(ways[0].name(), "phong");
        for label in ["stripes, crossed", "six-way, patches, 256 px, 12 tones", "stroke-map, uv, literal, 128 px"] {
            assert!(labels.contains(label), "{label} is not in {labels:?}");
        }
    }

    #[test]
    fn maps_that_make_no_difference_are_left_out() {
        let (ways, _) = all();
        let of = |method: Method| ways.iter().filter(move |way| way.params.method == method);
        assert!(of(Method::Halftone).chain(of(Method::Stripes)).all(|way| way.map == 0));
        assert!(of(Method::FineTone).all(|way| way.map < 2) && of(Method::SixWay).any(|way| way.map == 2));
        assert!(ways.iter().all(|way| way.params.silhouettes.is_none()));
    }
}
