use super::*;
use brillianteer_base::unwatched;
use brillianteer_cut::MaterialRef;
use brillianteer_files::{cut_file, library};
use brillianteer_picture::PictureName;
use brillianteer_render::{Renderer, Wanted};
use brillianteer_scene::{Glare, Lean, Medium, Projection, Side, Specimen, Viewpoint};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Mutex;

fn specimen() -> Specimen {
    Specimen::new(cut_file::parse(library::cut("tolkowsky").unwrap(), "tolkowsky").unwrap()).unwrap()
}

fn viewing(specimen: &Specimen) -> Viewing<'_> {
    Viewing {
        specimen,
        file: "mine.toml",
        viewpoint: Viewpoint::default(),
        turned_deg: 0.0,
        medium: specimen.medium(589.3),
        wavelength_nm: Some(589.3),
        head_deg: 10.0,
        unresolved: Some(0.3),
        standard_error: None,
        polarised: true,
        glare: None,
        tracer: Wanted::Beams,
    }
}

fn outputs(folder: &Path, pictures: &[&str], formats: &[OutputFormat]) -> Outputs {
    let pictures = pictures
        .iter()
        .map(|&name| (name.to_owned(), PictureName::of_key(name).unwrap().picture()))
        .collect();
    Outputs {
        folder: folder.into(),
        stem: "mine".into(),
        pictures,
        size: 32,
        formats: formats.into(),
        caption: false,
        mark_audit: false,
        strongest: true,
        timing: false,
    }
}

fn in_perspective(viewing: Viewing<'_>, distance: f64) -> Viewing<'_> {
    let projection = Projection::Perspective { distance };
    let viewpoint = Viewpoint { projection, ..viewing.viewpoint };
    Viewing { viewpoint, tracer: Wanted::Rays, ..viewing }
}

fn found(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let paths = std::fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    paths.map(|path| (path.clone(), std::fs::read(&path).unwrap())).collect()
}

/// Writes an export and returns its reports: the files, the texts of all other events, and the parts done.
fn written(export: &Export) -> (Vec<PathBuf>, Vec<String>, Vec<f64>) {
    let (files, texts, parts) = (Mutex::new(vec![]), Mutex::new(vec![]), Mutex::new(vec![]));
    let watch = |part: f64| {
        parts.lock().unwrap().push(part);
        ControlFlow::Continue(())
    };
    let tell = |event: Event| {
        match event {
            Event::Written(path) => files.lock().unwrap().push(path.to_owned()),
            Event::Begun(text) | Event::Note(text) | Event::Warning(text) => {
                texts.lock().unwrap().push(text.to_owned());
            }
        }
        Ok(())
    };
    export.write(&mut Renderer::default(), &watch, &tell).unwrap();
    (files.into_inner().unwrap(), texts.into_inner().unwrap(), parts.into_inner().unwrap())
}

#[test]
fn the_files_are_those_that_are_written_and_told_in_their_order() {
    let specimen = specimen();
    let beams = viewing(&specimen);
    let rays = Viewing { tracer: Wanted::Rays, ..beams };
    let all = ["profile", "aset", "hearts", "diagram"];
    let cases = [
        (beams, &all[..], &OutputFormat::ALL[..], 2 + 5 + 5 + 2 + 1),
        (beams, &all, &[OutputFormat::Svg], 1 + 2 + 2 + 1),
        (beams, &all, &[OutputFormat::Exr], 2),
        (beams, &all, &[OutputFormat::Json], 1),
        (beams, &[], &OutputFormat::ALL, 1),
        (rays, &all, &OutputFormat::ALL, 2 + 2 + 2 + 2 + 1),
        (in_perspective(beams, 9.0), &all[1..2], &[OutputFormat::Png], 2),
    ];
    for (viewing, pictures, formats, count) in cases {
        let folder = tempfile::tempdir().unwrap();
        let outputs = outputs(&folder.path().join("deep/er"), pictures, formats);
        let export = Export { viewing, outputs: &outputs };
        let files = export.files(&Renderer::default()).unwrap();
        assert_eq!((files.len(), found(&outputs.folder).len()), (count, 0));
        let (reported, _, parts) = written(&export);
        assert_eq!(reported, files);
        let mut sorted = files;
        sorted.sort();
        assert_eq!(found(&outputs.folder).into_keys().collect::<Vec<_>>(), sorted);
        assert!(parts.is_sorted() && parts[0] == 0.0 && parts.last() == Some(&1.0), "{parts:?}");
    }
}

/// Exports the ASET of a viewing as PNG, and as SVG of a convex stone; returns the pixels of each at the same size.
fn exported_pixels(viewing: Viewing, formats: &[OutputFormat]) -> Vec<Vec<[u8; 3]>> {
    let folder = tempfile::tempdir().unwrap();
    let outputs = Outputs { strongest: false, size: 96, ..outputs(folder.path(), &["aset"], formats) };
    let (files, ..) = written(&Export { viewing, outputs: &outputs });
    let pixels = |path: &PathBuf| {
        let bytes = std::fs::read(path).unwrap();
        let rgb = match path.extension().unwrap().to_str().unwrap() {
            "svg" => crate::rasterize(std::str::from_utf8(&bytes).unwrap(), 96).unwrap().2,
            _ => image::load_from_memory(&bytes).unwrap().to_rgb8().into_raw(),
        };
        rgb.chunks(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
    };
    files.iter().map(pixels).collect()
}

#[test]
fn a_drawing_of_a_turned_stone_shows_what_its_picture_shows() {
    let specimen = specimen();
    let formats = [OutputFormat::Png, OutputFormat::Svg];
    let viewpoint = Viewpoint { tilt_deg: 25.0, azimuth_deg: 10.0, ..Viewpoint::default() };
    let upright = Viewing { viewpoint, unresolved: Some(0.05), ..viewing(&specimen) };
    let all = [upright, Viewing { turned_deg: 22.5, ..upright }].map(|v| exported_pixels(v, &formats));
    let apart = |a: &[[u8; 3]], b: &[[u8; 3]]| {
        let bytes = a.as_flattened().iter().zip(b.as_flattened());
        bytes.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.as_flattened().len() as f64
    };
    let [same, other] = [apart(&all[1][0], &all[1][1]), apart(&all[1][0], &all[0][1])];
    assert!(
        3.0 * same < other,
        "the drawing is off its picture by {same}, that of the unturned stone by {other}"
    );
}

#[test]
fn a_picture_of_a_turned_stone_holds_all_of_it() {
    let design = cut_file::parse(library::cut("cube").unwrap(), "cube").unwrap();
    let specimen = Specimen::new(design).unwrap();
    // Seen from above, the cube is as black as what is around it.
    let viewpoint = Viewpoint { tilt_deg: 25.0, ..Viewpoint::default() };
    let glare = Some(Glare::Included);
    let turned = Viewing { viewpoint, turned_deg: 45.0, glare, tracer: Wanted::Rays, ..viewing(&specimen) };
    let pixels = &exported_pixels(turned, &[OutputFormat::Png])[0];
    let is_edge = |k: usize| [k % 96, k / 96].iter().any(|place| [0, 95].contains(place));
    assert!((0..96 * 96).all(|k| !is_edge(k) || pixels[k] == pixels[0]), "a corner is cut off");
    assert!(pixels.iter().any(|pixel| *pixel != pixels[0]));
}

#[test]
fn work_that_is_stopped_leaves_whole_files_only() {
    let specimen = specimen();
    let folder = tempfile::tempdir().unwrap();
    let formats = [OutputFormat::Png, OutputFormat::Exr, OutputFormat::Svg];
    let whole = outputs(&folder.path().join("whole"), &["aset", "profile", "arrows"], &formats);
    let export = Export { viewing: viewing(&specimen), outputs: &whole };
    written(&export);
    let contents = |outputs: &Outputs| -> Vec<Vec<u8>> {
        let name = |path: PathBuf| outputs.folder.join(path.file_name().unwrap());
        let files = export.files(&Renderer::default()).unwrap().into_iter().map(name);
        files.map_while(|path| std::fs::read(path).ok()).collect()
    };
    let complete = contents(&whole);
    for (stop, least) in [(0.0, 0), (0.3, 1), (0.7, 6), (0.99, 10)] {
        let part = Outputs { folder: folder.path().join(format!("to {stop}")), ..whole.clone() };
        let watch = |done: f64| if done >= stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let stopped =
            Export { outputs: &part, ..export }.write(&mut Renderer::default(), &watch, &|_| Ok(()));
        assert!(stopped.is_ok() == (stop > 0.9) || matches!(stopped, Err(Failure::Stopped)), "{stop}");
        let left = contents(&part);
        assert!(left.len() >= least && left == complete[..left.len()], "{stop}: {} files", left.len());
        assert_eq!(found(&part.folder).len(), left.len(), "{stop}: others than the first files");
    }
}

#[test]
fn who_is_told_may_end_the_work() {
    let specimen = specimen();
    let folder = tempfile::tempdir().unwrap();
    let outputs = outputs(folder.path(), &["profile", "diagram"], &[OutputFormat::Svg]);
    let tell = |event: Event| match event {
        Event::Written(path) => Err(Failure::Output(path.display().to_string())),
        _ => Ok(()),
    };
    let ended = Export { viewing: viewing(&specimen), outputs: &outputs }.write(
        &mut Renderer::default(),
        &unwatched,
        &tell,
    );
    assert!(matches!(ended, Err(Failure::Output(path)) if path.ends_with("mine-profile.svg")));
    assert_eq!(found(folder.path()).len(), 1);
}

#[test]
fn what_cannot_be_written_is_refused_before_anything_is() {
    let specimen = specimen();
    let folder = tempfile::tempdir().unwrap();
    let beams = viewing(&specimen);
    let rays = in_perspective(beams, 9.0);
    let plain = outputs(folder.path(), &["profile", "aset"], &OutputFormat::ALL);
    let twice = outputs(folder.path(), &["profile", "aset", "aset"], &[OutputFormat::Svg]);
    let cases = [
        (beams, twice, true, "'mine-aset-strongest'"),
        (Viewing { tracer: Wanted::Beams, ..rays }, plain.clone(), true, "parallel"),
        (
            rays,
            Outputs { formats: vec![OutputFormat::Svg], ..plain.clone() },
            true,
            "aset: rays make PNG pictures only",
        ),
        (in_perspective(beams, 0.2), plain, false, "mine.toml: the eye"),
    ];
    for (viewing, outputs, is_usage, says) in cases {
        let export = Export { viewing, outputs: &outputs };
        for refused in [
            export.files(&Renderer::default()).err(),
            export.write(&mut Renderer::default(), &unwatched, &|_| Ok(())).err(),
        ] {
            let refused = refused.unwrap();
            assert!(refused.to_string().contains(says), "{refused}");
            assert!(if is_usage {
                matches!(refused, Failure::Usage(_))
            } else {
                matches!(refused, Failure::Input(_))
            });
        }
    }
    assert_eq!(found(folder.path()).len(), 0);
}

#[test]
fn names_that_come_twice_among_stones_are_found() {
    let aset = outputs(Path::new("out"), &["aset"], &[OutputFormat::Json]);
    let other = Outputs { stem: "other".into(), ..aset.clone() };
    assert_eq!(first_twice(&[aset.clone(), other.clone()]), None);
    let twice = first_twice(&[aset.clone(), other, aset]);
    assert_eq!(twice, Some((2, "mine-aset-strongest".into())));
}

#[test]
fn notes_and_warnings_say_what_is_not_as_asked() {
    let specimen = specimen();
    let folder = tempfile::tempdir().unwrap();
    let drawn = outputs(folder.path(), &["profile"], &[OutputFormat::Exr]);
    let export = Export { viewing: viewing(&specimen), outputs: &drawn };
    assert!(export.files(&Renderer::default()).unwrap().is_empty());
    let (_, texts, _) = written(&export);
    assert_eq!(texts[1], "profile: a drawing comes as PNG and SVG only");
    let many = outputs(folder.path(), &["aset"], &OutputFormat::ALL[..3]);
    let (_, texts, _) = written(&Export { viewing: in_perspective(viewing(&specimen), 9.0), outputs: &many });
    assert_eq!(texts[0], "pictures in scopes: rays make PNG pictures only; SVG and EXR need exact beams");
    // Some light is still inside after a thousand reflections.
    let cube = cut_file::parse(include_str!("../../../../tests/fixtures/cube.toml"), "cube").unwrap();
    let cube = Specimen::new(cube).unwrap();
    let caught = Viewing { medium: Medium::clear(1e3), unresolved: Some(1e-9), ..viewing(&cube) };
    let pictures = outputs(folder.path(), &["aset"], &[OutputFormat::Png]);
    let (_, texts, _) = written(&Export { viewing: caught, outputs: &pictures });
    assert!(
        texts[1].starts_with("mine.toml: ") && texts[1].contains("% of the light is unresolved"),
        "{texts:?}"
    );
}

#[test]
fn figures_are_written_down_as_they_were_given() {
    let specimen = specimen();
    let viewpoint = Viewpoint { tilt_deg: 10.1, azimuth_deg: -30.0, lean: Lean::Eye, ..Viewpoint::default() };
    let viewing = Viewing { viewpoint, wavelength_nm: None, ..viewing(&specimen) };
    let figures = |viewing: &Viewing| {
        let report = measure(viewing, &Scoped::aset(), &mut Renderer::default(), &unwatched, &|_| Ok(()));
        report.unwrap().figures(false)
    };
    let found = figures(&viewing);
    let text = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<ViewFigures>(&text).unwrap(), found);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let view = r#"{"side":"table","tilt":0.0,"eye_tilt":10.1,"azimuth":-30.0,"projection":"orthographic"}"#;
    assert_eq!(json["view"].to_string(), view);
    assert_eq!(
        (&json["file"], &json["tracer"], &json["wavelength_nm"]),
        (&"mine.toml".into(), &"beam".into(), &serde_json::Value::Null)
    );
    assert!(json["surface"]["head"].is_number() && json.get("standard_error").is_none());
    let rays = Viewing { viewpoint: viewpoint.facing(Some(Side::Culet)), ..in_perspective(viewing, 9.0) };
    let found = figures(&rays);
    assert_eq!((found.tracer.as_str(), found.view.side.as_str()), ("ray", "culet"));
    assert!(found.standard_error.is_some_and(|error| error > 0.0));
}

#[test]
fn the_diagram_marks_the_findings_of_an_audit_where_they_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let mut design =
        Specimen::new(cut_file::parse(library::cut("tolkowsky").unwrap(), "t").unwrap()).unwrap().design;
    // In glass the mains lie below the critical angle.
    design.material = MaterialRef::Index(1.5);
    let specimen = Specimen::new(design).unwrap();
    let plain = outputs(folder.path(), &["diagram"], &[OutputFormat::Svg]);
    let drawn = |mark_audit| {
        let outputs = Outputs { mark_audit, ..plain.clone() };
        let export = Export { viewing: viewing(&specimen), outputs: &outputs };
        export.write(&mut Renderer::default(), &|_| ControlFlow::Continue(()), &|_| Ok(())).unwrap();
        std::fs::read_to_string(folder.path().join("mine-diagram.svg")).unwrap()
    };
    assert!(!drawn(false).contains("marked-facet"));
    assert_eq!(drawn(true).matches("class=\"marked-facet\"").count(), 8);
}
