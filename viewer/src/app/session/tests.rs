use serde_json::{Value, json};

use super::*;
use crate::Method;

fn found(path: &Path) -> Session {
    match read(path) {
        Ok(Found::Whole(session)) => *session,
        Ok(Found::Nothing) => panic!("there is nothing"),
        Ok(Found::Part(_, problem)) | Err(problem) => panic!("{problem}"),
    }
}

/// A session in which everything differs from what is there at first, as it is written.
fn changed() -> Value {
    let mut state = State::default();
    state.document.preset.stroke.width_px = 3.25;
    state.document.look.params.method = Method::Stripes;
    state.document.look.smoothing = 2.5;
    state.camera.distance = 9.0;
    state.settings.zoom = 1.25;
    state.settings.recent_meshes.push(PathBuf::from("bunny.obj"));
    serde_json::to_value(Session { state, layout: default_layout(), closed: true }).expect("a session has a JSON form")
}

/// What is read of it, and the places that are left as at first.
fn parts_of(session: &Value) -> (Session, Vec<String>) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    std::fs::write(&path, session.to_string()).expect("a writable folder");
    match read(&path) {
        Ok(Found::Part(session, SessionError::Parts { left, .. })) => (*session, left),
        Ok(_) => panic!("it is read whole"),
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn a_session_comes_back_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("deep/session.json");
    assert!(matches!(read(&path), Ok(Found::Nothing)));
    let mut state = State::default();
    state.document.preset.stroke.width_px = 3.25;
    state.settings.recent_meshes.push(PathBuf::from("bunny.obj"));
    let session = Session { state: state.clone(), layout: default_layout(), closed: false };
    write(&path, &session).expect("a writable folder");
    let back = found(&path);
    assert_eq!(back.state, state);
    assert!(is_whole(&back.layout) && !back.closed);
}

#[test]
fn what_is_no_session_is_an_error_and_a_torn_layout_is_mended() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    for text in ["", "{", "[]", "{}", "{\"state\": 3}"] {
        std::fs::write(&path, text).expect("a writable folder");
        assert!(matches!(read(&path), Err(SessionError::Content { .. })), "{text:?}");
    }
    let mut layout = default_layout();
    let view = layout.tiles.find_pane(&Pane::View).expect("a view");
    layout.remove_recursively(view);
    write(&path, &Session { state: State::default(), layout, closed: true }).expect("a writable folder");
    assert!(is_whole(&found(&path).layout));
}

#[test]
fn one_unknown_word_costs_no_more_than_what_it_stands_for() {
    let whole: Session = serde_json::from_value(changed()).expect("a session");
    let mut session = changed();
    session["state"]["document"]["look"]["params"]["method"] = json!("from-the-future");
    let (read, left) = parts_of(&session);
    assert_eq!(left, ["document.look.params.method"]);
    let mut expected = whole.state.clone();
    expected.document.look.params.method = State::default().document.look.params.method;
    assert_eq!(read.state, expected);

    // What is gone in one part leaves the others alone, and the panels too.
    let mut session = changed();
    session["state"]["camera"]["distance"] = json!("far");
    session["state"]["settings"]["theme"] = json!({ "of-the": "future" });
    session["state"]["document"]["mesh"] = json!({ "hologram": 3 });
    session["state"]["saved"]["file:gone.toml"] = json!(3);
    session["layout"] = json!(null);
    let (read, mut left) = parts_of(&session);
    left.sort();
    let places = ["camera.distance", "document.mesh.hologram", "layout", "saved.file:gone.toml", "settings.theme"];
    assert_eq!(left, places);
    let mut expected = whole.state;
    expected.camera.distance = State::default().camera.distance;
    assert_eq!(read.state, expected);
    assert!(is_whole(&read.layout) && read.closed);
}

#[test]
fn a_message_names_a_few_places_and_counts_the_rest() {
    let left = ["a", "b", "c", "d", "e", "f", "g", "h"].map(str::to_owned).to_vec();
    assert_eq!(in_words(&left[..2]), "a, b");
    assert_eq!(in_words(&left), "a, b, c, d, e, f and 2 more");
}

#[test]
fn what_is_put_aside_replaces_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    for (number, text) in [(1, "first"), (2, "second")] {
        std::fs::write(&path, text).expect("a writable folder");
        let aside = put_aside(&path).expect("a writable folder");
        assert_eq!(aside, folder.path().join(format!("session.unread-{number}.json")));
        assert!(!path.exists());
    }
    let kept = |name| std::fs::read_to_string(folder.path().join(name)).expect("it is kept");
    assert_eq!((kept("session.unread-1.json"), kept("session.unread-2.json")), ("first".into(), "second".into()));
}

#[test]
fn a_session_has_one_owner_until_that_is_gone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("deep/session.json");
    let first = Lock::take(&path);
    assert!(matches!(first, Owner::This(_)));
    assert!(matches!(Lock::take(&path), Owner::Another));
    assert!(matches!(Lock::take(&folder.path().join("deep/other.json")), Owner::This(_)), "each session has its own");
    drop(first);
    assert!(matches!(Lock::take(&path), Owner::This(_)));
}
