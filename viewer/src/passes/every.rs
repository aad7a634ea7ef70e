//! Every pipeline there is, tried on a device: what a device with few limits can draw.

use tam_shaders::cpu::DebugView as Shown;
use tam_shaders::{Feed, Pass};

use super::debug;
use super::faces::Faces;
use super::lines::Lines;
use super::shading::{Variant, method_variant, module, shading_pipeline};
use crate::gpu::{Gpu, Layouts, MapKind, TargetFormats};
use crate::params::{Blend, FaceFrameForm, Follow, Form, Mapping, Method, RenderParams};

/// A pipeline that was tried.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tried {
    /// Its pass.
    pub pass: Pass,
    /// What its vertices carry; of compute passes and lines nothing.
    pub feed: Option<Feed>,
    /// Its constants.
    pub constants: Vec<(&'static str, u32)>,
    /// What the device says where it has no such pipeline.
    pub error: Option<String>,
}

/// Makes every pipeline on a device, for targets of these formats: all methods in all mappings and forms, all views, lines, and
/// the compute passes.
pub fn try_pipelines(gpu: &Gpu, formats: TargetFormats) -> Vec<Tried> {
    let mut tried: Vec<Tried> = every_variant().into_iter().map(|variant| try_variant(gpu, formats, variant)).collect();
    let mut others = |pass, make: &dyn Fn(&Layouts)| {
        let error = said(gpu, || make(&Layouts::new(gpu)));
        tried.push(Tried { pass, feed: None, constants: Vec::new(), error });
    };
    others(Pass::FaceFrames, &|layouts| Faces::default().make(gpu, layouts));
    others(Pass::Lines, &|layouts| Lines::default().make(gpu, layouts, formats));
    tried
}

fn try_variant(gpu: &Gpu, formats: TargetFormats, variant: Variant) -> Tried {
    // Layouts that are made within tell why there are none.
    let error = said(gpu, || {
        let (layouts, module) = (Layouts::new(gpu), module(gpu, variant.pass));
        shading_pipeline(gpu, &layouts, &module, &variant, formats, false);
    });
    let Variant { pass, feed, constants, .. } = variant;
    Tried { pass, feed: Some(feed), constants, error }
}

/// What a device says against something that is made on it.
fn said(gpu: &Gpu, make: impl FnOnce()) -> Option<String> {
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    make();
    pollster::block_on(scope.pop()).map(|error| error.to_string())
}

/// Every way to shade that differs.
fn every_variant() -> Vec<Variant> {
    let mut variants: Vec<Variant> = Vec::new();
    let mut add = |variant: Variant| {
        if !variants.contains(&variant) {
            variants.push(variant);
        }
    };
    for method in Method::ALL {
        for form in [Form::Hardened, Form::Literal] {
            for mapping in Mapping::ALL {
                let base = RenderParams { method, form, mapping, ..RenderParams::default() };
                for blend in [Blend::Union, Blend::Linear] {
                    for follow in [Follow::Surface, Follow::Light] {
                        add(method_variant(&RenderParams { blend, follow, ..base }));
                    }
                }
                for face_frame in [FaceFrameForm::Fetched, FaceFrameForm::Vertex, FaceFrameForm::VertexFetched] {
                    add(method_variant(&RenderParams { face_frame, ..base }));
                }
                add(method_variant(&RenderParams { variety: 0.5, ..base }));
                for follow in [Follow::Surface, Follow::Light] {
                    for shown in Shown::ALL {
                        add(debug::shown_as(shown, MapKind::Columns, &RenderParams { follow, ..base }));
                    }
                }
            }
        }
    }
    variants
}
