//! Pictures on the screen.

use std::collections::HashMap;
use std::sync::{Arc, Weak};

use eframe::egui_wgpu::RenderState;
use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use super::work::Canvas;

/// Pictures of the device, and uploaded ones by name, of which one is uploaded again when its content changes.
pub(crate) struct Textures {
    window: RenderState,
    canvases: HashMap<u64, (Weak<Canvas>, TextureId)>,
    uploaded: HashMap<String, (usize, TextureHandle)>,
}

impl Textures {
    /// Of a window that draws like this.
    pub(crate) fn new(window: RenderState) -> Self {
        Self { window, canvases: HashMap::new(), uploaded: HashMap::new() }
    }

    /// A picture that is on the device already; it is made known once.
    pub(crate) fn of(&mut self, canvas: &Arc<Canvas>) -> TextureId {
        if let Some((_, known)) = self.canvases.get(&canvas.id()) {
            return *known;
        }
        let mut renderer = self.window.renderer.write();
        // Those that are gone were last seen in a frame before.
        self.canvases.retain(|_, (canvas, texture)| {
            let stays = canvas.strong_count() > 0;
            if !stays {
                renderer.free_texture(texture);
            }
            stays
        });
        let texture =
            renderer.register_native_texture(&self.window.device, canvas.shown(), eframe::wgpu::FilterMode::Linear);
        self.canvases.insert(canvas.id(), (Arc::downgrade(canvas), texture));
        texture
    }

    /// A picture that is made now, if its version is another than the last; sharp texels.
    pub(crate) fn sharp(
        &mut self,
        ctx: &Context,
        name: &str,
        version: usize,
        make: impl FnOnce() -> ColorImage,
    ) -> TextureHandle {
        let options = TextureOptions {
            magnification: egui::TextureFilter::Nearest,
            minification: egui::TextureFilter::Linear,
            ..TextureOptions::default()
        };
        match self.uploaded.get_mut(name) {
            Some((known, texture)) if *known == version => texture.clone(),
            Some((known, texture)) => {
                *known = version;
                texture.set(make(), options);
                texture.clone()
            }
            None => {
                let texture = ctx.load_texture(name, make(), options);
                self.uploaded.insert(name.to_owned(), (version, texture.clone()));
                texture
            }
        }
    }
}
