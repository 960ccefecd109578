//! The program: parse, call, print, exit code.

use std::process::ExitCode;

/// Tracing beams fills much memory in small steps, which the system's allocator does a third slower.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    have_runtime_folder();
    brillianteer::cli::main(editor())
}

/// What opens the window, where this program has one.
fn editor() -> Option<brillianteer::cli::EditorOpener> {
    #[cfg(feature = "app")]
    return Some(|file, mesh| {
        use brillianteer::app::WindowError;
        use brillianteer::io::Failure;
        brillianteer::app::run(file, mesh).map_err(|error| match &error {
            WindowError::NoSuchPainter(_) => Failure::Usage(error.to_string()),
            WindowError::NoDisplay(_) | WindowError::NoWindow(_) => Failure::NoWindow(error.to_string()),
            // Files take the place of a window that never opened, and not of one in which someone has worked.
            WindowError::Lost(_) => Failure::Output(error.to_string()),
        })
    });
    #[cfg(not(feature = "app"))]
    None
}

/// Names a folder for sockets where the session names none, as under cron, in containers and after `su`. Drivers look there
/// for a Wayland screen, whether one is wanted or not, and complain on standard error where the variable lacks. The one that
/// is taken then is GLib's: the user's folder for caches.
fn have_runtime_folder() {
    const NAME: &str = "XDG_RUNTIME_DIR";
    let is_folder = |path: &std::ffi::OsString| std::path::Path::new(path).is_absolute();
    let is_missing = cfg!(all(unix, not(target_vendor = "apple")))
        && !std::env::var_os(NAME).is_some_and(|p| is_folder(&p));
    if !is_missing {
        return;
    }
    let in_home = || std::path::Path::new(&std::env::var_os("HOME")?).join(".cache").into_os_string().into();
    let folder = std::env::var_os("XDG_CACHE_HOME").or_else(in_home).filter(is_folder);
    // SAFETY: the program has no other thread yet that could read the environment at the same time.
    #[expect(unsafe_code, reason = "the driver reads the process's own environment, which only this changes")]
    unsafe {
        std::env::set_var(NAME, folder.unwrap_or_else(|| "/".into()));
    }
}
