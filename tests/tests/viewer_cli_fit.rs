//! `tam-viewer fit`: what is recommended holds, what is cheaper fails, and files are those of the recommended map.

use std::fs;

use serde_json::Value;
use tam_gen::{Job, Preset};
use tam_tests::command::{Run, listing, tam_gen, tam_viewer};
use tam_tests::gpu::{Stage, renderer};
use tam_viewer::fit::FitRange;
use tam_viewer::maps::HatchMap;
use tam_viewer::measure::{MeasureOptions, ink, tone};
use tam_viewer::mesh::prepare;
use tam_viewer::mesh::sample::Sample;
use tam_viewer::{RenderParams, Scene};
use tempfile::tempdir;

const ERROR: f64 = 0.03;

const SPHERE: [&str; 11] = [
    "fit",
    "--mesh",
    "sphere",
    "--triangles",
    "800",
    "--mapping",
    "triplanar",
    "--size",
    "160x160",
    "--camera-range",
    "0.7:1.4",
];

fn fitted(folder: &std::path::Path, more: &[&str]) -> Run {
    tam_viewer(folder, &[&SPHERE[..], more].concat())
}

fn number(of: &Value, name: &str) -> f64 {
    of[name].as_f64().unwrap_or_else(|| panic!("{name} is no number in {of}"))
}

#[test]
fn what_is_recommended_holds_and_what_is_cheaper_fails() {
    let folder = tempdir().expect("a folder");
    let run = fitted(folder.path(), &["--error", "0.03", "--out", "out", "--json"]);
    assert_eq!(run.status, 0, "{run:?}");
    let json = run.json();
    let (now, best) = (&json["now"], &json["fitted"]);
    assert!(number(best, "error") <= ERROR && number(&json, "views") >= 9.0, "{json}");
    assert!(number(best, "bytes") < number(now, "bytes"), "{json}");
    assert!(number(&best["map"], "size") < number(&now["map"], "size"), "{json}");
    let failing = json["failing"].as_array().expect("what fails");
    assert!(!failing.is_empty(), "nothing smaller was tried: {json}");
    for tried in failing {
        let missed = tried["missed_levels"].is_object();
        assert!(number(tried, "error") > ERROR || missed, "{tried}");
        assert!(missed || number(tried, "cost_ratio") <= number(best, "cost_ratio"), "{tried}");
    }

    // Drawn anew from the files, at places that were not searched.
    let preset = Preset::load(folder.path().join("out/pencil-fitted.toml")).expect("a preset");
    assert_eq!(f64::from(preset.map.size), number(&best["map"], "size"));
    let params: RenderParams = serde_json::from_value(best["params"].clone()).expect("parameters");
    let renderer = renderer();
    let map = HatchMap::from_preset("fitted", &preset, &Job::default()).expect("it generates");
    let mut stage = Stage { map: renderer.map(map), renderer, size: 160 };
    let mesh = prepare(Sample::Sphere.build(800)).expect("a sphere").mesh;
    let mut scene = Scene::of(&mesh);
    let places: Vec<_> = mesh.positions.iter().map(|place| place.as_dvec3()).collect();
    scene.camera.frame_points(&places, 1.0, 0.07);
    let range = FitRange { distance: [0.7, 1.4], orbit_deg: [0.0, 0.0], light_deg: [-30.0, 30.0] };
    for view in range.views(&mesh, &scene, [160, 160], &[0.4, 0.9]).expect("views") {
        let pixels = stage.draw(&view.scene, &params, &mesh);
        let ink = ink(&pixels, &view.aov, &mesh, &view.scene);
        let found = tone(&ink, &view.aov, MeasureOptions::default().tone_sigma_px).expect("it is seen").ink.rmse;
        // The finder's own camera frames a little differently.
        assert!(found < 1.2 * ERROR, "{found} at {}", view.name);
    }

    let files = listing(&folder.path().join("out"));
    for name in ["fit.json", "fit.png", "pencil-fitted.ktx2", "pencil-fitted.toml"] {
        assert!(files.contains(&name.to_owned()), "{name} is not in {files:?}");
    }
    let check = tam_gen(folder.path(), &["check", "out/pencil-fitted.ktx2"]);
    assert_eq!(check.status, 0, "{check:?}");
}

#[test]
fn what_cannot_be_fitted_is_told_and_nothing_is_written() {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("taken"), "mine").expect("a file");
    let before = listing(folder.path());
    for (more, status, expected) in [
        (&["--out", "taken"][..], 1, &["taken is a file"][..]),
        (&["--light-range", "30:-30"], 2, &["smaller number comes first"]),
        (&["--orbit-range", "a:b"], 2, &["no number"]),
        (&["--methods", "phong"], 2, &["draws no strokes"]),
        (&["--error", "0.0001", "--out", "out"], 1, &["no way stays within 0.0001", "allow a greater --error"]),
    ] {
        let run = fitted(folder.path(), &[more, &["--pairs", "5"]].concat());
        assert_eq!(run.status, status, "{more:?}: {run:?}");
        for part in expected {
            assert!(run.stderr.contains(part), "{more:?}: {part:?} is missing in\n{}", run.stderr);
        }
        assert_eq!(listing(folder.path()), before, "{more:?} wrote something");
    }
}
