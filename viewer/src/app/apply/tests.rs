use super::*;
use crate::Method;

fn model() -> Model {
    let mut state = State::default();
    let source = state.document.source.key();
    state.saved.insert(source, state.document.preset.clone());
    Model { state, history: History::default(), layout: default_layout() }
}

fn change(model: &mut Model) {
    let mut preset = model.state.document.preset.clone();
    preset.stroke.width_px += 1.0;
    assert!(apply(model, Command::SetPreset(Box::new(preset))).is_empty());
}

#[test]
fn changes_are_not_lost_without_a_question() {
    let mut model = model();
    assert!(!model.state.is_unsaved());
    change(&mut model);
    assert!(model.state.is_unsaved());
    let changed = model.state.document.clone();
    for command in [Command::NewPreset, Command::OpenShipped("brush".into()), Command::Quit] {
        assert!(apply(&mut model, command.clone()).is_empty());
        assert_eq!(model.state.transient.dialog, Some(Dialog::Unsaved(Box::new(command))));
        assert_eq!(model.state.document, changed);
    }
    apply(&mut model, Command::Discard(Box::new(Command::OpenShipped("brush".into()))));
    assert_eq!(model.state.preset_name(), "brush");
    assert!(!model.state.is_unsaved() && model.state.transient.dialog.is_none());
    assert_eq!(apply(&mut model, Command::Quit), [Effect::Close]);
}

#[test]
fn a_saved_preset_is_read_back_and_reverted_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut model = model();
    change(&mut model);
    let asked = apply(&mut model, Command::Save);
    assert_eq!(asked, [Effect::Ask(Ask::SavePreset("pencil".into()))], "what is shipped is not overwritten");
    apply(&mut model, Command::SaveAs(Some(folder.path().join("mine"))));
    let path = folder.path().join("mine.toml");
    assert_eq!(model.state.document.source, PresetSource::File(path.clone()));
    assert!(!model.state.is_unsaved());
    assert_eq!(Preset::load(&path).expect("a preset"), model.state.document.preset);
    let saved = model.state.document.preset.clone();
    change(&mut model);
    apply(&mut model, Command::Revert);
    assert_eq!(model.state.document.preset, saved);
    apply(&mut model, Command::OpenShipped("woodcut".into()));
    apply(&mut model, Command::OpenFiles(vec![path]));
    assert_eq!(model.state.document.preset, saved);
}

#[test]
fn what_cannot_be_saved_or_opened_is_told_and_nothing_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut model = model();
    change(&mut model);
    let before = model.state.document.clone();
    // A folder stands where the file is to go.
    let taken = folder.path().join("taken.toml");
    std::fs::create_dir(&taken).expect("a writable folder");
    apply(&mut model, Command::SaveAs(Some(taken)));
    assert_eq!(model.state.document, before);
    assert!(model.state.is_unsaved());
    for name in ["nothing.json", "nothing.xyz"] {
        apply(&mut model, Command::OpenFiles(vec![folder.path().join(name)]));
    }
    std::fs::write(folder.path().join("bad.toml"), "stroke = { width_px = -3 }").expect("a writable folder");
    for name in ["nothing.toml", "bad.toml"] {
        let open = Command::OpenPreset(Some(folder.path().join(name)));
        apply(&mut model, Command::Discard(Box::new(open)));
    }
    assert_eq!(model.state.document, before);
    let told = &model.state.transient.notices;
    assert_eq!(told.len(), 5, "{told:?}");
    assert!(told.iter().all(|notice| notice.severity == Severity::Error), "{told:?}");
    assert!(told.iter().any(|notice| notice.text.contains("0.3 to 128 px")), "{told:?}");
}

#[test]
fn another_mesh_leaves_what_belongs_to_the_last_one() {
    let mut model = model();
    model.state.document.materials = vec![crate::Material::default(); 3];
    model.state.transient.frame_mesh = false;
    let mesh = MeshSource::sample(crate::mesh::sample::Sample::Hand);
    apply(&mut model, Command::SetMesh(mesh.clone()));
    assert_eq!(model.state.document.mesh, mesh);
    assert!(model.state.document.materials.is_empty() && model.state.transient.frame_mesh);
    apply(&mut model, Command::KeepMesh);
    assert_eq!((&model.state.document.mesh, model.state.document.materials.len()), (&MeshSource::default(), 3));
    let path = PathBuf::from("nowhere.obj");
    assert!(apply(&mut model, Command::OpenMesh(Some(path.clone()))).is_empty());
    assert_eq!(apply(&mut model, Command::OpenMesh(Some(path.clone()))), [Effect::ReloadMesh]);
    assert_eq!(model.state.settings.recent_meshes, [path]);
}

#[test]
fn looks_and_locks_are_set_as_asked() {
    let mut model = model();
    let mut look = model.state.document.look.clone();
    look.params.method = Method::Stripes;
    apply(&mut model, Command::SetLook(Box::new(look.clone())));
    assert_eq!(model.state.document.look, look);
    apply(&mut model, Command::Lock("width_px".into(), true));
    apply(&mut model, Command::Randomise);
    let first = model.state.document.preset.clone();
    assert_eq!(first.stroke.width_px, Document::default().preset.stroke.width_px);
    apply(&mut model, Command::Randomise);
    assert_ne!(model.state.document.preset, first);
    apply(&mut model, Command::Lock("width_px".into(), false));
    assert!(model.state.settings.locked.is_empty());
}

#[test]
fn a_file_that_is_not_named_in_full_is_replaced_only_after_a_question() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut model = model();
    change(&mut model);
    type Save = fn(Option<PathBuf>) -> Command;
    let kinds: [(Save, &str); 4] = [
        (Command::SaveAs, "toml"),
        (Command::SaveGuides, "json"),
        (Command::SavePicture, "png"),
        (Command::SaveTurntable, "png"),
    ];
    for (save, extension) in kinds {
        let short = folder.path().join("mine");
        let path = folder.path().join(format!("mine.{extension}"));
        std::fs::write(&path, "older").expect("a writable folder");
        let before = model.state.document.clone();
        assert_eq!(apply(&mut model, save(Some(short))), []);
        let whole = Box::new(save(Some(path.clone())));
        assert_eq!(model.state.transient.dialog, Some(Dialog::Replace(path.clone(), whole.clone())));
        assert_eq!(std::fs::read_to_string(&path).expect("it is there"), "older");
        assert_eq!(model.state.document, before);
        let effects = apply(&mut model, Command::Replace(whole));
        assert!(model.state.transient.dialog.is_none());
        let replaced = std::fs::read_to_string(&path).expect("it is there") != "older";
        assert!(replaced || !effects.is_empty(), "{extension} is written, or left to a worker");
    }
}

#[test]
fn pictures_and_turntables_without_extension_become_png() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut model = model();
    let (short, whole) = (folder.path().join("round"), folder.path().join("round.png"));
    let picture = apply(&mut model, Command::SavePicture(Some(short.clone())));
    assert_eq!(picture, [Effect::SavePicture(whole.clone())]);
    // A folder of that name is not meant, and stays as it is.
    std::fs::create_dir(&short).expect("a writable folder");
    let turntable = apply(&mut model, Command::SaveTurntable(Some(short)));
    assert_eq!(turntable, [Effect::SaveTurntable(whole)]);
    // What has no name at all is left to whoever writes it.
    let nothing = Command::SavePicture(Some(PathBuf::from("..")));
    assert_eq!(apply(&mut model, nothing), [Effect::SavePicture(PathBuf::from(".."))]);
    let gif = folder.path().join("round.gif");
    let turntable = apply(&mut model, Command::SaveTurntable(Some(gif.clone())));
    assert_eq!(turntable, [Effect::SaveTurntable(gif)]);
}
