//! The command is there and says which version it is; the other tests of it are in the workspace's package `tests`,
//! for which this test makes `cargo test --workspace` build it.

#[test]
fn the_command_states_the_version_of_the_library() {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_tam-gen")).arg("--version").output();
    let stdout = output.expect("the command runs").stdout;
    assert_eq!(String::from_utf8_lossy(&stdout).trim(), format!("tam-gen {}", tam_gen::export::VERSION));
}
