//! Every composed source is valid WGSL.

use tam_shaders::{Feed, Pass, compose};

#[test]
fn every_composed_source_validates() {
    for pass in Pass::ALL {
        let source = compose(pass);
        let module = naga::front::wgsl::parse_str(&source)
            .unwrap_or_else(|error| panic!("{}: {}", pass.name(), error.emit_to_string(&source)));
        let capabilities = naga::valid::Capabilities::empty();
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities)
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {}", pass.name(), error.emit_to_string(&source)));
    }
}

/// Passes and feeds with storage buffers in the vertex stage, and passes with some in an entry point of the fragment stage.
#[test]
fn only_what_looks_at_faces_reads_storage_buffers_and_fragments_only_in_the_literal_form_and_in_views_of_faces() {
    for pass in Pass::ALL {
        let source = compose(pass);
        let module = naga::front::wgsl::parse_str(&source).expect("it is valid");
        let mut validator =
            naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
        let info = validator.validate(&module).expect("it is valid");
        for (i, entry) in module.entry_points.iter().enumerate() {
            let uses = info.get_entry_point(i);
            let reads = module.global_variables.iter().any(|(variable, of)| {
                matches!(of.space, naga::AddressSpace::Storage { .. }) && !uses[variable].is_empty()
            });
            let pulled = Feed::ALL.iter().any(|feed| feed.is_pulled() && feed.vertex_entry() == entry.name);
            let may = match entry.stage {
                naga::ShaderStage::Fragment => pass == Pass::FaceFrame || entry.name == "fragment_faces",
                naga::ShaderStage::Vertex => pass == Pass::Lines || pulled,
                _ => true,
            };
            assert_eq!(reads, may, "{}: {}", pass.name(), entry.name);
        }
    }
}

/// Files of a folder below the crate, name and text, without directives of the composer.
fn sources(folder: &str) -> Vec<(String, Vec<String>)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut sources = Vec::new();
    for entry in std::fs::read_dir(&folder).expect("the folder exists") {
        let path = entry.expect("the folder can be read").path();
        if path.extension().is_some_and(|extension| extension == "wgsl") {
            let text = std::fs::read_to_string(&path).expect("sources are text");
            let lines = text.lines().filter(|line| !line.starts_with("//!")).map(str::to_owned);
            let stem = path.file_stem().expect("a file has a name").to_string_lossy().into_owned();
            sources.push((stem, lines.collect()));
        }
    }
    sources
}

#[test]
fn every_piece_is_included_by_some_pass_and_no_pass_has_one_twice() {
    let composed = Pass::ALL.map(compose);
    let pieces = sources("wgsl/lib");
    assert!(!pieces.is_empty());
    for (stem, lines) in pieces {
        // Heads of the files differ, so the first line tells the piece.
        let uses = composed.each_ref().map(|source| source.lines().filter(|line| *line == lines[0]).count());
        assert!(uses.iter().any(|uses| *uses > 0), "no pass includes lib/{stem}.wgsl");
        assert!(uses.iter().all(|uses| *uses <= 1), "a pass includes lib/{stem}.wgsl twice");
    }
}

#[test]
fn every_entry_file_is_a_pass_and_every_pass_and_piece_has_a_twin() {
    let mut entries: Vec<_> = sources("wgsl").into_iter().map(|(stem, _)| stem).collect();
    let mut passes = Pass::ALL.map(|pass| pass.name().to_owned()).to_vec();
    entries.sort();
    passes.sort();
    assert_eq!(entries, passes);
    let cpu = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cpu");
    for (folder, twins) in [("wgsl", cpu.clone()), ("wgsl/lib", cpu.join("lib"))] {
        for (stem, _) in sources(folder) {
            assert!(twins.join(format!("{stem}.rs")).is_file(), "{folder}/{stem}.wgsl has no twin");
        }
    }
}

/// Names of the functions that a text declares with this word before them.
fn functions(lines: &[String], word: &str) -> Vec<String> {
    let name = |line: &String| Some(line.trim_start().strip_prefix(word)?.split(['(', '<']).next()?.to_owned());
    lines.iter().filter_map(name).collect()
}

#[test]
fn every_function_has_a_twin_of_its_name() {
    let cpu = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cpu");
    for (folder, twins) in [("wgsl", cpu.clone()), ("wgsl/lib", cpu.join("lib"))] {
        for (stem, lines) in sources(folder) {
            let twin = std::fs::read_to_string(twins.join(format!("{stem}.rs"))).expect("there is a twin");
            let twins = functions(&twin.lines().map(str::to_owned).collect::<Vec<_>>(), "pub fn ");
            for function in functions(&lines, "fn ") {
                // Entry points of vertex stages are functions of pieces and no more.
                if Feed::ALL.iter().any(|feed| feed.vertex_entry() == function) {
                    continue;
                }
                assert!(twins.contains(&function), "{folder}/{stem}.wgsl: {function} has no twin");
            }
        }
    }
}
