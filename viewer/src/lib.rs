//! Headless rendering of tonal art maps; its passes come with the renderer.
