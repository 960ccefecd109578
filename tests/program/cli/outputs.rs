//! Files that are written over others, and disks without room: a file is whole or as it was, and nothing else is left.

use super::desk::*;
use std::path::Path;

/// Returns the names of all entries of a folder, also hidden ones.
fn entries(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
#[cfg(unix)]
fn a_write_protected_file_is_refused_by_every_command_and_stays() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    for (line, name) in [
        ("convert tolkowsky kept/a.obj", "a.obj"),
        ("sheet tolkowsky --out kept/a.pdf", "a.pdf"),
        ("sweep tolkowsky --over table=53:54:1 --of return-even --out kept/a.csv", "a.csv"),
        ("export tolkowsky --views profile --format svg --out kept", "tolkowsky-profile.svg"),
        ("retarget tolkowsky --material quartz --rule critical-angle --no-light --out kept/a.toml", "a.toml"),
    ] {
        std::fs::create_dir_all(desk.at("kept")).unwrap();
        let path = desk.at(format!("kept/{name}"));
        std::fs::write(&path, "precious").unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o444)).unwrap();
        let stderr = desk.refused(line, 3);
        assert!(stderr.contains(name) && stderr.contains("write-protected"), "{line}: {stderr}");
        assert_eq!(desk.read(&format!("kept/{name}")), "precious", "{line}");
        assert_eq!(entries(&desk.at("kept")), [name], "{line}");
        // A mode of its own stays.
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600)).unwrap();
        let (code, _, stderr) = desk.run(line);
        assert_eq!((code, path.metadata().unwrap().permissions().mode() & 0o777), (0, 0o600), "{stderr}");
        std::fs::remove_dir_all(desk.at("kept")).unwrap();
    }
}

#[test]
fn comments_of_the_file_that_is_read_are_not_lost_unasked() {
    let desk = Desk::new();
    desk.write("a.toml", format!("# mine\n{}", desk.done("cuts tolkowsky")));
    let before = desk.read("a.toml");
    for line in [
        "convert a.toml a.toml",
        "convert a.toml ./a.toml",
        "retarget a.toml --material quartz --rule critical-angle --no-light --out a.toml",
    ] {
        assert!(desk.refused(line, 2).contains("its comments would be lost"), "{line}");
        assert_eq!(desk.read("a.toml"), before);
    }
    desk.done("convert a.toml b.toml");
    desk.done("convert b.toml b.toml");
    desk.done("convert a.toml a.toml --drop-comments");
    assert_eq!(desk.read("a.toml"), desk.read("b.toml"));
}

#[test]
fn a_mesh_is_not_written_over_by_its_own_facets() {
    let desk = Desk::new();
    assert_eq!(desk.run("convert tolkowsky a.stl").0, 0);
    let before = std::fs::read(desk.at("a.stl")).unwrap();
    for line in ["convert a.stl a.stl", "convert a.stl ./a.stl"] {
        assert!(desk.refused(line, 2).contains("this is the mesh that is read"), "{line}");
        assert_eq!(std::fs::read(desk.at("a.stl")).unwrap(), before);
    }
}

/// Commands that write files of more than 512 bytes, and the folder or file that they write.
#[cfg(unix)]
const WRITERS: [&str; 8] = [
    "convert tolkowsky out/a.stl",
    "convert tolkowsky out/a.asc",
    "sheet tolkowsky --out out/a.pdf",
    "sweep tolkowsky --over table=53:65:0.5 --of return-even --unresolved 0.2 --out out/a.csv",
    "sweep tolkowsky --over table=53:65:0.5 --of return-even --unresolved 0.2 --out out/a.parquet",
    "export cube.toml --views aset --size 200 --format png,exr,svg --out out",
    "render tolkowsky --size 64 --samples 1 --out out/a.exr",
    "spin cube.toml --frames 2 --size 32 --samples 1 --out out/a.png",
];

#[test]
#[cfg(unix)]
fn a_limit_on_the_size_of_files_is_an_error_and_leaves_nothing_behind() {
    let desk = Desk::new();
    for line in WRITERS {
        let _ = std::fs::remove_dir_all(desk.at("out"));
        std::fs::create_dir(desk.at("out")).unwrap();
        let old = ["a.csv", "a.stl", "a.asc", "a.pdf", "a.parquet", "a.exr", "a.png", "cube-aset.png"];
        old.iter().for_each(|name| desk.write(&format!("out/{name}"), "old"));
        // In shells of POSIX the unit is 512 bytes.
        let mut limited = std::process::Command::new("sh");
        limited.args(["-c", "ulimit -f 1; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_brillianteer")]);
        let output = limited.args(line.split_whitespace()).current_dir(desk.at("")).output().unwrap();
        let (code, _, stderr) = outcome(line, &output);
        if line.contains(".csv") {
            // The rows that fit are whole.
            let rows = desk.read("out/a.csv");
            assert!(rows.starts_with("file,table") && rows.ends_with('\n') && rows.len() <= 512, "{rows}");
        } else {
            for name in old {
                assert_eq!(desk.read(&format!("out/{name}")), "old", "{line}: {name}");
            }
        }
        assert!(code == 3 && stderr.contains("out/") && stderr.contains("large"), "{line}: {code}: {stderr}");
        assert_eq!(entries(&desk.at("out")).len(), old.len(), "{line}: {:?}", entries(&desk.at("out")));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_leaves_old_files_and_no_new_ones() {
    let desk = Desk::new();
    std::fs::create_dir(desk.at("out")).unwrap();
    let within = |script: &str| {
        let mut command = std::process::Command::new("unshare");
        let program = env!("CARGO_BIN_EXE_brillianteer");
        command.args(["--map-root-user", "--mount", "sh", "-c", script, program]).current_dir(desk.at(""));
        command.output()
    };
    let mount = "mount -t tmpfs -o size=16k none out && ";
    if !within(&format!("{mount} true")).is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: no file system of its own can be mounted here");
        return;
    }
    // Room is left for a folder's entries and for no content.
    let full = "head -c 12288 /dev/zero > out/filler; printf old > out/a.csv; ";
    for line in [
        "sweep tolkowsky --over table=53:65:0.5 --of return-even --unresolved 0.2 --out out/a.csv",
        "sweep tolkowsky --over table=53:60:1 --of return-even --unresolved 0.2 --out out/b.csv",
        "convert tolkowsky out/b.toml",
        "sheet tolkowsky --out out/b.pdf",
    ] {
        let script = format!("{mount} {full} \"$0\" {line} 2> stderr; echo $?; ls -A out; cat out/a.csv");
        let said = String::from_utf8(within(&script).unwrap().stdout).unwrap();
        assert_eq!(said, "3\na.csv\nfiller\nold", "{line}: {}", desk.read("stderr"));
    }
}
