//! A device of its own on which ways to draw are timed and drawn, apart from the view's.

use super::named::Named;
use crate::chart::Setting;
use crate::gpu::{Gpu, GpuError, GpuMesh, GpuOptions, PixelFormat, Target};
use crate::mesh::Mesh;
use crate::surface::Surface;
use crate::{FrameTimer, RenderError, Renderer};

/// A renderer with the mesh that was last laid on it.
pub(super) struct Stand {
    renderer: Renderer,
    timer: FrameTimer,
    laid: Option<Laid>,
}

struct Laid {
    source: Named<Mesh>,
    surface: Option<Named<Surface>>,
    mesh: GpuMesh,
    target: Target,
}

impl Stand {
    /// Opens the adapter.
    pub(super) fn open() -> Result<Self, GpuError> {
        let renderer = Renderer::new(Gpu::open(&GpuOptions::default())?);
        Ok(Self { timer: FrameTimer::new(&renderer.gpu), renderer, laid: None })
    }

    /// Whether costs here say little about those on a graphics card.
    pub(super) fn is_software(&self) -> bool {
        self.renderer.gpu.adapter.is_software()
    }

    /// Takes a mesh, unless it is there already, and gives what is drawn with. Pictures have one sample a pixel and half
    /// floats, so that small changes are not lost in steps of their own.
    pub(super) fn with(
        &mut self,
        mesh: &Named<Mesh>,
        surface: Option<&Named<Surface>>,
        size_px: [u32; 2],
    ) -> Result<(&mut Renderer, Setting<'_>), RenderError> {
        let Self { renderer, timer, laid } = self;
        let same = |laid: &Laid| (&laid.source, laid.surface.as_ref(), laid.target.size) == (mesh, surface, size_px);
        let kept = laid.take().filter(same);
        let laid = match kept {
            Some(kept) => laid.insert(kept),
            None => {
                let mut uploaded = renderer.mesh(mesh)?;
                if let Some(surface) = surface {
                    renderer.attach(&mut uploaded, surface)?;
                }
                let target = renderer.target(size_px, 1, PixelFormat::Linear16)?;
                let (source, surface) = (mesh.clone(), surface.cloned());
                laid.insert(Laid { source, surface, mesh: uploaded, target })
            }
        };
        Ok((renderer, Setting { mesh: &laid.mesh, target: &laid.target, timer }))
    }
}

/// Whether a device has to be opened again after this.
pub(super) fn is_lost(error: &RenderError) -> bool {
    matches!(error, RenderError::Gpu(GpuError::Lost(_) | GpuError::Failed(_)))
}
