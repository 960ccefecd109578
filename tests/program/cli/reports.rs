//! Reports as a user makes them: PDF and web page, one stone and several.

use super::desk::*;
use flate2::read::ZlibDecoder;
use std::collections::BTreeSet;
use std::io::Read;

/// Returns the contents of all compressed streams of a PDF, one after the other.
fn streams(pdf: &[u8]) -> Vec<String> {
    let find = |from: usize, what: &[u8]| {
        pdf[from..].windows(what.len()).position(|window| window == what).map(|at| from + at)
    };
    let (mut from, mut found) = (0, vec![]);
    while let Some(at) = find(from, b"stream\n").map(|at| at + 7) {
        let mut text = vec![];
        if ZlibDecoder::new(&pdf[at..]).read_to_end(&mut text).is_ok() {
            found.push(String::from_utf8_lossy(&text).into_owned());
        }
        from = find(at, b"endstream").unwrap() + 9;
    }
    found
}

/// Returns the characters that the tables of a PDF's fonts lead to.
fn letters(pdf: &[u8]) -> BTreeSet<char> {
    let tables = streams(pdf).into_iter().filter(|stream| stream.contains("beginbfchar"));
    let mut letters = BTreeSet::new();
    for table in tables {
        for line in table.lines().filter(|line| line.starts_with('<')) {
            let code = line.rsplit('<').next().unwrap().trim_end_matches('>');
            letters.extend(u32::from_str_radix(code, 16).ok().and_then(char::from_u32));
        }
    }
    letters
}

#[test]
fn a_report_is_written_as_pdf_whose_text_can_be_searched_and_is_the_same_again() {
    let desk = Desk::new();
    let line = "report cube.toml --pixels 24 --date 2026-11-24 --paper letter -o";
    assert_eq!(desk.done(&format!("{line} a.pdf")), "a.pdf\n");
    let pdf = std::fs::read(desk.at("a.pdf")).unwrap();
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-1.7") && text.contains("/MediaBox [0 0 61"));
    // Every letter of the report's text leads back to its character, and the pictures are in the file.
    let found = letters(&pdf);
    for letter in "brillianteer report cube.toml 2026-11-24 Ideal-Scope °±×".chars().filter(|c| *c != ' ')
    {
        assert!(found.contains(&letter), "{letter}: {found:?}");
    }
    assert_eq!(text.matches("/Subtype /Image").count(), 3);
    assert_eq!(desk.done(&format!("{line} b.pdf")), "b.pdf\n");
    assert!(std::fs::read(desk.at("b.pdf")).unwrap() == pdf, "another command for the same bytes");
}

#[test]
fn stones_are_compared_on_a_page_that_says_how_it_was_made() {
    let desk = Desk::new();
    desk.done("report cube.toml slanted.toml --material 1.5 --pixels 24 -o both.html");
    let page = desk.read("both.html");
    for said in [
        "2 cuts compared",
        "brillianteer report cube.toml slanted.toml --material 1.5 --pixels 24",
        "geometry of",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("http") && !page.contains("src="));
    assert!(!page.contains(desk.at("").to_str().unwrap()), "a path of this machine");
}

#[test]
fn what_makes_no_report_is_refused_and_leaves_no_file() {
    let desk = Desk::new();
    let before = files(&desk.at("")).len();
    for (line, code, told) in [
        ("cube.toml -o a.svg", 2, ".pdf or .html"),
        ("cube.toml", 2, "--out"),
        ("none.toml -o a.pdf", 1, "none.toml"),
        ("cube.toml -o nowhere/a/b.pdf --material rubby", 2, "did you mean 'ruby'"),
        ("a b c d e f g h -o a.pdf", 2, "1 to 7"),
    ] {
        let stderr = desk.refused(&format!("report {line}"), code);
        assert!(stderr.contains(told), "{line}: {stderr}");
    }
    assert_eq!(files(&desk.at("")).len(), before);
}

#[test]
fn a_report_on_several_stones_goes_on_past_a_file_that_is_not_there_and_ends_with_its_code() {
    let desk = Desk::new();
    let stderr = desk.refused("report cube.toml none.toml -o a.html --pixels 32", 1);
    assert!(stderr.contains("none.toml") && stderr.contains("1 of 2"), "{stderr}");
    let page = std::fs::read_to_string(desk.at("a.html")).unwrap();
    assert!(!page.contains("none.toml"), "the command on the page is that of the stones on it");
}
