//! The command is there and says which version it is; the other tests of it are in the workspace's package `tests`,
//! for which this test makes `cargo test --workspace` build it.

#[test]
fn the_command_states_its_version() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_tam-viewer")).arg("--version").output();
    let stdout = output.expect("the command runs").stdout;
    assert_eq!(String::from_utf8_lossy(&stdout).trim(), format!("tam-viewer {}", env!("CARGO_PKG_VERSION")));
}
