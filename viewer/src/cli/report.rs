//! Errors of the library as a user needs them: what is wrong, and the way out.

use tam_gen::command::Failure;
use tam_viewer::RenderError;
use tam_viewer::gpu::{GpuError, MapError};
use tam_viewer::mesh::MeshError;
use tam_viewer::stability::StabilityError;
use tam_viewer::surface::SurfaceError;
use tam_viewer::surface::guides::GuideError;
use tam_viewer::surface::store::StoreError;
use tam_viewer::turntable::WriteError;

fn work(kind: &'static str, error: &dyn std::error::Error, help: impl Into<Option<&'static str>>) -> Failure {
    Failure::Work { kind, message: error.to_string(), help: help.into().map(str::to_owned) }
}

pub(super) fn gpu(error: GpuError) -> Failure {
    let help = match &error {
        GpuError::NoAdapter => "install it, then `tam-viewer adapters` lists what was found",
        GpuError::NoSuchAdapter { .. } => "--adapter takes a part of one of these names, in any case",
        GpuError::Device { .. } | GpuError::Unfit { .. } => {
            "`tam-viewer adapters` lists the others, --adapter chooses one"
        }
        GpuError::TooLarge { .. } => "choose a smaller --size, mesh or map, or another --adapter",
        GpuError::Lost(_) | GpuError::Failed(_) => {
            "try again; smaller pictures, meshes and maps need less memory, and --adapter chooses another device"
        }
    };
    work("adapter", &error, help)
}

pub(super) fn render(error: RenderError) -> Failure {
    match error {
        RenderError::Gpu(error) => gpu(error),
        RenderError::Map(error) => map(error),
        RenderError::NoUv => work("mesh", &error, "--mapping triplanar and --mapping frames need none"),
        RenderError::NoStorage { .. } => work(
            "adapter",
            &error,
            "leave out lines (--lines none), and draw with --mapping uv, triplanar or patches; or choose another --adapter",
        ),
        RenderError::NoMap
        | RenderError::NoSurface(_)
        | RenderError::Placement
        | RenderError::Camera(_)
        | RenderError::Format { .. } => work("scene", &error, None),
    }
}

pub(super) fn map(error: MapError) -> Failure {
    match error {
        MapError::Gpu(error) => gpu(error),
        MapError::Generate(error) => error.into(),
        MapError::NoStrokeMap { .. } => work(
            "source",
            &error,
            "give a preset, or a NAME.ktx2 with its NAME.strokemap.ktx2 beside it; or choose another --method",
        ),
        MapError::TooManyColumns { .. } | MapError::NotRising { .. } => {
            work("source", &error, "`tam-gen check` tells what is wrong with the map")
        }
    }
}

pub(super) fn guides(path: &std::path::Path, error: &GuideError) -> Failure {
    Failure::Work {
        kind: "guides",
        message: format!("{}: {error}", path.display()),
        help: Some(r#"a file of guides is {"version": 1, "guides": [{"points": [[x, y, z], …]}, …]}"#.into()),
    }
}

pub(super) fn surface(error: SurfaceError) -> Failure {
    if matches!(error, SurfaceError::Cancelled) {
        return Failure::Interrupted;
    }
    work("surface", &error, "a smaller mesh needs less memory; --mapping triplanar needs no field")
}

pub(super) fn mesh(error: MeshError) -> Failure {
    work("mesh", &error, "OBJ, glTF, GLB, PLY and STL files are read; `tam-viewer meshes` lists samples that need none")
}

pub(super) fn write(error: WriteError) -> Failure {
    let help = match &error {
        WriteError::Exists(_) => "--force replaces it; or name another place with --out",
        WriteError::TooLarge(_) => "choose a smaller --size, or a .png",
        _ => "check the space left and the permissions, or choose another place with --out",
    };
    Failure::Output { message: error.to_string(), help: Some(help.to_owned()) }
}

pub(super) fn reference(error: &tam_viewer::reference::ReferenceError) -> Failure {
    work("picture", error, "choose another --side")
}

pub(super) fn stability(error: StabilityError) -> Failure {
    match error {
        StabilityError::Render(error) => render(error),
        StabilityError::Mesh(error) => mesh(error),
        StabilityError::Surface(error) => surface(error),
        StabilityError::Reference(error) => reference(&error),
        StabilityError::Generate(error) => error.into(),
        StabilityError::Preset(_) | StabilityError::Nothing(_) => {
            work("case", &error, "--adapter draws with another device")
        }
    }
}

pub(super) fn store(path: &std::path::Path, error: &StoreError) -> Failure {
    Failure::Work {
        kind: "surface",
        message: format!("{}: {error}", path.display()),
        help: Some("name another file with --surface; one that does not exist is written".into()),
    }
}
