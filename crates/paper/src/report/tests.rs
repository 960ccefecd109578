use super::*;
use crate::drawing_png::legible::assert_legible;
use brillianteer_base::unwatched;
use brillianteer_files::{cut_file, library};
use brillianteer_measure::STANDARD_ERROR;
use brillianteer_render::{Card, Wanted};
use brillianteer_scene::{Specimen, Viewpoint};

fn specimen(text: &str) -> Specimen {
    Specimen::new(cut_file::parse(text, "test").unwrap()).unwrap()
}

/// Returns a stone as it is seen in reports, traced only roughly.
fn viewing<'a>(specimen: &'a Specimen, file: &'a str) -> Viewing<'a> {
    Viewing {
        specimen,
        file,
        viewpoint: Viewpoint::default(),
        turned_deg: 0.0,
        medium: specimen.medium(589.3),
        wavelength_nm: Some(589.3),
        head_deg: 0.0,
        unresolved: Some(0.05),
        standard_error: Some(STANDARD_ERROR),
        polarised: true,
        glare: None,
        tracer: Wanted::Quickest,
    }
}

fn origin() -> ReportOrigin {
    ReportOrigin {
        command: "brillianteer report <it>".to_owned(),
        picture_side: 24,
        date: None,
        remarks: vec![],
    }
}

fn reported(viewings: &[Viewing]) -> Report {
    report(viewings, &origin(), &mut Renderer::new(Card::None), &unwatched, &|_| Ok(())).unwrap()
}

fn headings(report: &Report) -> Vec<&str> {
    use brillianteer_picture::ReportPart::Heading;
    let heading = |part: &'_ brillianteer_picture::ReportPart| matches!(part, Heading(_));
    let headings = report.parts.iter().filter(|part| heading(part));
    headings.filter_map(|part| if let Heading(text) = part { Some(text.as_str()) } else { None }).collect()
}

#[test]
fn a_page_holds_all_that_it_shows_and_a_report_is_the_same_every_time() {
    let cube = specimen(include_str!("../../../../tests/fixtures/cube.toml"));
    let viewings = [viewing(&cube, "cube.toml")];
    let found = reported(&viewings);
    let html = report_html(&found);
    for fetched in ["http:", "https:", "src=", "<script", "<link", "@import"] {
        assert!(!html.contains(fetched), "{fetched}");
    }
    // Every address is data within the page.
    let count = |text: &str| html.matches(text).count();
    assert_eq!((count("href=\""), count("url(")), (count("href=\"data:image/png;base64,"), 1));
    assert!(count("href=\"") == 3 && html.contains("url(data:font/ttf;base64,"));
    assert!(html.contains("brillianteer report &lt;it&gt;") && html.contains(&fingerprint(&cube.body)));
    assert_eq!(report_html(&reported(&viewings)), html);
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str, report: &Report| {
        let path = folder.path().join(name);
        write(&path, ReportFormat::of_name(&path).unwrap(), report, PaperSize::A4).unwrap();
        std::fs::read(path).unwrap()
    };
    let pdf = bytes("a.pdf", &found);
    assert!(pdf.starts_with(b"%PDF-1.7") && pdf == bytes("b.PDF", &reported(&viewings)));
    assert!(bytes("a.html", &found) == html.into_bytes());
}

#[test]
fn a_report_says_how_the_file_was_read() {
    let cube = specimen(include_str!("../../../../tests/fixtures/cube.toml"));
    let origin =
        ReportOrigin { remarks: vec!["warning: cube.stl: 5 of the facets bend".to_owned()], ..origin() };
    let viewings = [viewing(&cube, "cube.stl")];
    let found = report(&viewings, &origin, &mut Renderer::new(Card::None), &unwatched, &|_| Ok(())).unwrap();
    assert!(report_html(&found).contains("warning: cube.stl: 5 of the facets bend"));
}

#[test]
fn no_text_of_a_report_leaves_its_page_or_overlaps_another_whatever_is_said() {
    let cube = specimen(include_str!("../../../../tests/fixtures/cube.toml"));
    let mut found = reported(&[viewing(&cube, "cube.toml")]);
    let long = "a name that goes on and on without an end in sight ".repeat(6);
    for title in [String::new(), long] {
        found.title.clone_from(&title);
        found.subtitle.clone_from(&title);
        found.mark.clone_from(&title);
        found.facts.iter_mut().for_each(|[_, value]| value.push_str(&title));
        found.provenance.iter_mut().for_each(|[_, value]| value.push_str(&title));
        let tables = found.parts.iter_mut().filter_map(|part| match part {
            brillianteer_picture::ReportPart::Table(table) => Some(table),
            _ => None,
        });
        for table in tables {
            // Many rows, of which one has long cells.
            let first = table.rows[0].clone();
            table.rows[0].iter_mut().for_each(|cell| cell.text.push_str(&title));
            table.rows.extend(std::iter::repeat_n(first, 90));
        }
        for paper in [PaperSize::A4, PaperSize::Letter] {
            let pages = report_pages(&found, paper);
            assert!(pages.len() > 3, "{} pages", pages.len());
            pages.iter().for_each(|page| assert_legible(&page.to_string()));
        }
    }
}

#[test]
fn stones_are_compared_in_columns_and_a_solid_without_facets_has_its_sampled_light() {
    let cube = specimen(include_str!("../../../../tests/fixtures/cube.toml"));
    let slanted = specimen(include_str!("../../../../tests/fixtures/slanted.toml"));
    let compared = reported(&[viewing(&cube, "cube.toml"), viewing(&slanted, "slanted.toml")]);
    let tables = compared.parts.iter().filter_map(|part| match part {
        brillianteer_picture::ReportPart::Table(table) => Some(table),
        _ => None,
    });
    for table in tables {
        assert_eq!(table.columns.len(), 3);
        assert!(table.rows.iter().all(|row| row.len() == 3), "{table:?}");
    }
    assert!(headings(&compared).contains(&"Profiles and facet diagrams"));
    assert_eq!(compared.provenance[1][1], fingerprint(&slanted.body));
    let none = report(&[], &origin(), &mut Renderer::new(Card::None), &unwatched, &|_| Ok(()));
    assert!(none.unwrap_err().to_string().contains("1 to 7"));
    let pill = specimen(library::cut("pill").unwrap());
    let alone = reported(&[viewing(&pill, "pill.toml")]);
    assert_eq!(headings(&alone), ["Proportions of the design", "Light, in percent of the face"]);
}
