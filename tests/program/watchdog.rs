//! Runs a program and notices when it waits for ever: every thread sleeps and none has used the processor for a while.
//! How long the work takes does not matter, so a busy machine raises no false alarm.
#![cfg(all(feature = "cli", target_os = "linux"))]

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

/// How long all threads of a program sleep before it counts as stuck. No command waits this long for a file or a driver.
const STILL: Duration = Duration::from_secs(20);

/// The processor time, in hundredths of a second, after which a program counts as endless. No line of a test takes a tenth of it.
const MOST_TICKS: u64 = 60_000;

/// What one look at the threads of a process shows.
#[derive(PartialEq)]
struct Sighting {
    /// True where no thread runs, waits for the processor, or waits for a disk.
    all_sleep: bool,
    /// The time on the processor that the process has used so far, in ticks of the system.
    ticks: u64,
}

fn threads(process: u32) -> Vec<PathBuf> {
    let folder = std::fs::read_dir(format!("/proc/{process}/task")).into_iter().flatten().flatten();
    folder.map(|thread| thread.path()).collect()
}

fn text(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_default()
}

/// Returns the fields of a `stat` file that follow the name of the thread, which may hold spaces.
fn fields(stat: &str) -> Vec<&str> {
    stat.rsplit_once(") ").map_or(vec![], |(_, rest)| rest.split_whitespace().collect())
}

fn sighting(process: u32) -> Sighting {
    let stats: Vec<String> = threads(process).iter().map(|thread| text(thread, "stat")).collect();
    let state = |stat: &String| fields(stat).first().is_some_and(|state| *state == "S");
    let ticks = |stat: &String| -> u64 {
        fields(stat).get(11..13).into_iter().flatten().filter_map(|t| t.parse::<u64>().ok()).sum()
    };
    Sighting { all_sleep: stats.iter().all(state), ticks: stats.iter().map(ticks).sum() }
}

/// Returns who waits, and for what: the stacks where gdb is installed, else the system call that each thread is in.
fn who_waits(process: u32) -> String {
    let stacks = Command::new("gdb")
        .args(["-p", &process.to_string(), "-batch", "-ex", "thread apply all bt 24"])
        .output();
    let mut report = String::new();
    for thread in threads(process) {
        let (name, call) = (text(&thread, "comm"), text(&thread, "syscall"));
        let waits = text(&thread, "wchan");
        let _ = writeln!(report, "{}: in {waits}, system call {}", name.trim(), call.trim());
    }
    if let Ok(stacks) = stacks {
        report.push_str(&String::from_utf8_lossy(&stacks.stdout));
    }
    report
}

/// Waits until a program ends, until all of its threads wait for ever, or until it has worked for [`MOST_TICKS`].
///
/// # Errors
/// Returns what the threads do where the program would never end; it has been killed then.
pub fn ended(program: &mut Child) -> Result<ExitStatus, String> {
    let (mut last, mut since) = (sighting(program.id()), Instant::now());
    loop {
        if let Some(status) = program.try_wait().unwrap() {
            return Ok(status);
        }
        let now = sighting(program.id());
        let is_endless = now.ticks > MOST_TICKS;
        if !is_endless && (now != last || !now.all_sleep) {
            (last, since) = (now, Instant::now());
        } else if is_endless || since.elapsed() > STILL {
            let report = who_waits(program.id());
            program.kill().unwrap();
            program.wait().unwrap();
            return Err(report);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_program_that_waits_for_ever_is_found_and_one_that_works_is_not() {
    let mut stuck = Command::new("sleep").arg("1000").spawn().unwrap();
    let report = ended(&mut stuck).unwrap_err();
    assert!(report.contains("sleep: in "), "{report}");
    let mut busy =
        Command::new("sh").args(["-c", "k=0; while [ $k -lt 300000 ]; do k=$((k+1)); done"]).spawn().unwrap();
    assert!(ended(&mut busy).unwrap().success());
}
