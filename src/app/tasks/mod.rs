//! What the editor does outside its window: it reads and writes files, asks and opens by the system.

pub mod autosave;
pub mod copying;
pub mod export_job;
pub mod export_scene;
pub mod files;
pub mod opener;
