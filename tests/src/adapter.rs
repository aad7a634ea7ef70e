//! The software adapter, so that results do not depend on the machine; `WGPU_ADAPTER_NAME` asks for another.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Where Vulkan drivers are registered.
const REGISTRIES: [&str; 2] = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"];

/// The file that registers Mesa's software driver, where it is installed.
pub fn software_driver() -> Option<PathBuf> {
    let entries = REGISTRIES.iter().filter_map(|folder| fs::read_dir(folder).ok()).flatten().flatten();
    entries.map(|entry| entry.path()).find(|path| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("lvp_icd"))
            && path.extension().is_some_and(|extension| extension == "json")
    })
}

/// Makes a command use the software adapter, unless the environment chose one.
pub fn pin(command: &mut Command) {
    let chosen = ["VK_ICD_FILENAMES", "WGPU_ADAPTER_NAME"].iter().any(|name| std::env::var_os(name).is_some());
    if let Some(driver) = software_driver().filter(|_| !chosen) {
        command.env("VK_ICD_FILENAMES", driver);
    }
    // Mesa's layer that sorts devices looks for a Wayland display, and complains where there is none.
    command.env("NODEVICE_SELECT", "1");
}
