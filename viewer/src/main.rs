//! The command `tam-viewer`.

mod cli;

fn main() -> std::process::ExitCode {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    give_back_large_arrays();
    cli::run()
}

/// From now on large arrays go back to the system as soon as they are dropped. By default the C library learns from the
/// first one to keep what is smaller, once per thread, which is a quarter of all memory for a mesh of a million triangles.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn give_back_large_arrays() {
    const LARGE_BYTES: i32 = 4 << 20;
    #[allow(unsafe_code, reason = "the C library is told by nothing else")]
    // SAFETY: it takes numbers alone, and no other thread runs yet.
    let known = unsafe { libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE_BYTES) };
    debug_assert_eq!(known, 1, "1 says that it is a setting that there is");
}
