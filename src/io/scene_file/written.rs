//! The keys of a scene file as they are written.

use super::super::cut_file::material_form::MaterialForm;
use super::super::toml_format::FORMAT;
use super::{Entry, SceneFile};
use crate::scene::Layout;
use serde::Serialize;
use std::borrow::Cow;

/// A whole scene file.
#[derive(Serialize)]
pub(super) struct EncodedScene<'a> {
    format: i64,
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    light: Option<Cow<'a, str>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    layout: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gap_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    background: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    background_distance_mm: Option<f64>,
    strength: f64,
    stone: Vec<WrittenStone<'a>>,
}

/// A table `[[stone]]`.
#[derive(Serialize)]
struct WrittenStone<'a> {
    cut: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    material: Option<MaterialForm>,
    #[serde(skip_serializing_if = "Option::is_none")]
    size: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<usize>,
    turn: f64,
    tilt: f64,
    azimuth: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<[f64; 3]>,
}

impl<'a> EncodedScene<'a> {
    pub fn of(scene: &'a SceneFile) -> Self {
        let is = |layout: &Layout| Layout::NAMES.into_iter().find(|(_, other)| other == layout);
        Self {
            format: FORMAT,
            name: &scene.name,
            light: scene.light.as_ref().map(|light| light.to_string_lossy()),
            layout: scene.layout.as_ref().and_then(is).map(|(name, _)| name),
            gap_mm: scene.layout.map(|_| scene.gap_mm),
            background: scene.background.as_ref().map(ToString::to_string),
            background_distance_mm: scene.background_distance_mm,
            strength: scene.strength,
            stone: scene.stones.iter().map(|entry| WrittenStone::of(entry, scene.layout.is_none())).collect(),
        }
    }
}

impl<'a> WrittenStone<'a> {
    fn of(entry: &'a Entry, is_placed: bool) -> Self {
        Self {
            cut: &entry.cut,
            material: entry.material.as_ref().map(MaterialForm::of),
            size: entry.size.map(|size| size.to_string()),
            count: (entry.count > 1).then_some(entry.count),
            turn: entry.turn,
            tilt: entry.tilt,
            azimuth: entry.azimuth,
            at: is_placed.then(|| entry.at_mm.to_array()),
        }
    }
}
