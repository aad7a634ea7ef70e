//! Pictures on the screen.

use std::collections::HashMap;
use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

/// Uploaded pictures, by name; one is uploaded again when its content changes.
#[derive(Default)]
pub(crate) struct Textures {
    uploaded: HashMap<String, (usize, TextureHandle)>,
}

impl Textures {
    /// A picture that was made elsewhere; `version` tells contents apart.
    pub(crate) fn of(&mut self, ctx: &Context, name: &str, version: usize, image: &Arc<ColorImage>) -> TextureHandle {
        self.made(ctx, name, version, TextureOptions::LINEAR, || (**image).clone())
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
        self.made(ctx, name, version, options, make)
    }

    fn made(
        &mut self,
        ctx: &Context,
        name: &str,
        version: usize,
        options: TextureOptions,
        make: impl FnOnce() -> ColorImage,
    ) -> TextureHandle {
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
