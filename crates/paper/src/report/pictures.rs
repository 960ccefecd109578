//! The pictures of a report: a stone in every scope and under light, its profile and its facet diagram.

use crate::export::{Reporter, ScopeStill, Viewing, note};
use crate::lighting;
use crate::png_bytes::png;
use ::png::{BitDepth, ColorType};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use brillianteer_base::Failure;
use brillianteer_base::Watch;
use brillianteer_measure::facet_deviations;
use brillianteer_optics::linear_from_encoded;
use brillianteer_picture::{
    Develop, DiagramStyle, EmbeddedDrawing, Inks, Linear, Scoped, develop, diagram, profile,
};
use brillianteer_render::{Job, LightProduct, Partial, Product, Quality, Renderer, Steps, Surroundings};
use brillianteer_scene::Background;
use brillianteer_scene::Scene;
use std::sync::Arc;

/// The bands of wavelengths of the picture under light.
const WAVELENGTHS: u32 = 8;

/// Rays along each side of a pixel in a scope, and passes of the picture under light, of solids that only rays trace. It is
/// less than pictures of their own have, so that a report takes seconds.
const RAYS_PER_SIDE: u32 = 2;
const PASSES_OF_RAYS: u32 = 16;

/// The share of the light that pictures leave unresolved.
const UNRESOLVED: f64 = 2e-3;

/// The background of the picture under light, as an sRGB code of each channel.
const BEHIND: u8 = 0xf2;

/// The width and the height of the facet diagram on paper, points, at which its names are readable.
const DIAGRAM: [f64; 2] = [140.0, 262.0];

/// A picture with its title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedDrawing {
    pub name: &'static str,
    pub drawing: EmbeddedDrawing,
}

/// Returns the scopes that suit the cut of a stone, each with its title.
fn scopes(viewing: &Viewing) -> Vec<(&'static str, Scoped)> {
    let mut scopes = vec![("ASET", Scoped::aset()), ("Ideal-Scope", Scoped::ideal_scope())];
    if viewing.specimen.stone().is_ok_and(|stone| facet_deviations(stone).is_ok()) {
        scopes.extend([("Hearts", Scoped::hearts()), ("Arrows", Scoped::arrows())]);
    }
    scopes
}

/// Takes the pictures of a stone, `side` pixels along each side: under light, and in every scope that suits its cut.
pub(super) fn pictures(
    (viewing, side): (&Viewing, u32),
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<Vec<NamedDrawing>, Failure> {
    let scopes = scopes(viewing);
    let count = scopes.len() as f64 + 1.0;
    let part = |k: usize| move |done: f64| watch((k as f64 + done) / count);
    let mut all = vec![under_light((viewing, side), renderer, &part(0), tell)?];
    for (k, (name, scoped)) in scopes.iter().enumerate() {
        let drawing = in_scope((viewing, side), scoped, renderer, &part(k + 1), tell)?;
        all.push(NamedDrawing { name, drawing });
    }
    Ok(all)
}

fn in_scope(
    (viewing, side): (&Viewing, u32),
    scoped: &Scoped,
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<EmbeddedDrawing, Failure> {
    let film = viewing.facing(scoped.side).film(side);
    let rays_per_side = Some(RAYS_PER_SIDE);
    let shot = ScopeStill { viewing: *viewing, scoped, film, unresolved: UNRESOLVED, rays_per_side };
    drawn(side, &shot.take(renderer, watch, tell)?.rgb)
}

fn under_light(
    (viewing, side): (&Viewing, u32),
    renderer: &mut Renderer,
    watch: Watch,
    tell: Reporter,
) -> Result<NamedDrawing, Failure> {
    let product = Product::Light(LightProduct {
        surroundings: Surroundings::of(Arc::new(lighting::load("studio")?)),
        wavelengths: WAVELENGTHS,
        adapted: true,
        strength: 1.0,
        jitter: true,
        steps: Steps::Strips,
    });
    let scene = Arc::new(Scene::alone(viewing.specimen));
    // Beams take few passes by themselves.
    let samples = (!viewing.check(renderer)?).then_some(PASSES_OF_RAYS);
    let quality = Quality { samples, tracer: viewing.tracer, ..Quality::of_pictures(viewing.polarised) };
    let job = Job { scene, view: viewing.view(), film: viewing.film(side), product, quality };
    let mut light = Linear { width: side, height: side, pixels: vec![] };
    renderer.run(&job, watch, &mut |part| match part {
        Partial::LightRow { y, pixels } => {
            light.pixels.truncate(y as usize * side as usize);
            light.pixels.extend_from_slice(pixels);
            Ok(())
        }
        other => note(&other, tell),
    })?;
    let paper = [linear_from_encoded(f64::from(BEHIND) / 255.0) as f32; 3];
    let manner = Develop { bloom: None, background: Background::Plain(paper), ..Develop::default() };
    let rgb: Vec<u8> = develop(&light, &manner).chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    Ok(NamedDrawing { name: "Studio light", drawing: drawn(side, &rgb)? })
}

/// Makes a drawing of the pixels of a picture, which stands in it whole.
fn drawn(side: u32, rgb: &[u8]) -> Result<EmbeddedDrawing, Failure> {
    let bytes = png([side; 2], (ColorType::Rgb, BitDepth::Eight), rgb, &[]);
    let bytes = bytes.map_err(|e| Failure::Output(format!("a picture of the report: {e}")))?;
    let href = format!("data:image/png;base64,{}", STANDARD.encode(bytes));
    Ok(EmbeddedDrawing::of_picture([side; 2], &href))
}

/// Draws the profile and the facet diagram of a stone; none of a solid that is no convex stone.
pub(super) fn drawings(viewing: &Viewing) -> Vec<NamedDrawing> {
    let Ok(stone) = viewing.specimen.stone() else { return vec![] };
    let design = &viewing.specimen.design;
    let style = DiagramStyle::fitting(stone, Inks::PAPER, DIAGRAM);
    let drawn = [
        ("Profile", profile(stone, &design.name, design.cut.brilliant())),
        ("Facet diagram", diagram(stone, &design.name, &style)),
    ];
    let named = |(name, document): (&'static str, svg::Document)| {
        Some(NamedDrawing { name, drawing: EmbeddedDrawing::of(&document.to_string())? })
    };
    drawn.into_iter().filter_map(named).collect()
}
