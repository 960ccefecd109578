//! The program: parses the arguments, calls the library, prints, and sets the exit code.

use std::process::ExitCode;

/// The program's allocator. Tracing beams fills much memory in small steps, for which the system's allocator takes a third
/// longer.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    have_runtime_folder();
    #[cfg(target_os = "linux")]
    spare_memory_on_many_cores();
    brillianteer::cli::main(editor())
}

/// Returns the function that opens the editor's window; `None` where the program is built without the editor (feature
/// `app`).
fn editor() -> Option<brillianteer::cli::EditorOpener> {
    #[cfg(feature = "app")]
    return Some(|file, mesh| {
        use brillianteer::app::WindowError;
        use brillianteer::base::Failure;
        brillianteer::app::run(file, mesh).map_err(|error| match &error {
            WindowError::NoSuchPainter(_) => Failure::Usage(error.to_string()),
            WindowError::NoDisplay(_) | WindowError::NoWindow(_) => Failure::NoWindow(error.to_string()),
            // Without a window the program writes files instead, but not after a window was lost in which someone has
            // worked.
            WindowError::Lost(_) => Failure::Output(error.to_string()),
        })
    });
    #[cfg(not(feature = "app"))]
    None
}

/// The number of threads from which memory is spared.
#[cfg(target_os = "linux")]
const MANY_THREADS: usize = 8;

/// The number of the allocator's option for the time after which pages that are no longer used go back to the system, ms
/// (`mi_option_purge_delay`, which the binding does not name).
#[cfg(target_os = "linux")]
const PURGE_DELAY: i32 = 15;

/// Asks the system for pages of 4 KiB alone where many threads will trace light, and the allocator to give pages back soon.
///
/// Every thread fills pages of its own. With huge pages of 2 MiB, a thread takes 3 to 5 MiB however little it holds: 200 MiB
/// for 64 threads. With few threads, huge pages cost little and save a tenth of the time of short commands. Pages that the
/// allocator gives back after its usual second make a search with 32 threads hold 860 MiB, where 590 are in use.
#[cfg(target_os = "linux")]
fn spare_memory_on_many_cores() {
    // Rayon reads the same variable. It is asked for its number only later, because that starts its threads.
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = asked.filter(|&threads| threads > 0).unwrap_or_else(cores);
    if threads >= MANY_THREADS {
        // Where the system refuses, the program only takes more memory.
        let _ = rustix::thread::disable_transparent_huge_pages(true);
        // SAFETY: the call writes one number that the allocator reads at each purge, and the program has one thread yet.
        #[expect(unsafe_code, reason = "the binding of the allocator has no safe function for its options")]
        unsafe {
            libmimalloc_sys::mi_option_set(PURGE_DELAY, 10);
        }
    }
}

/// Sets `XDG_RUNTIME_DIR`, the folder for sockets, where the session does not set it, as under cron, in containers and after
/// `su`.
///
/// Drivers look there for a Wayland screen, wanted or not, and complain on standard error where the variable is missing. As
/// GLib does then, this takes the user's folder for caches.
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
