//! Tests of the editor as a person uses it: by the names of what is on the screen.
#![allow(clippy::print_stdout, reason = "tests print what they skip or measure")]

mod asking;
mod audit;
mod backgrounds;
mod choosing;
mod copies;
mod drag;
mod emerald;
mod fitting;
mod flows;
mod formats;
mod grading;
mod guide;
mod handed_out;
mod keeping;
mod layout;
mod light_and_glass;
mod looks;
mod maps;
mod painted;
mod reading;
mod recorder;
mod rings;
mod row_defaults;
mod row_keys;
mod scenes;
mod searching;
mod tier_hand;
mod tiers;
mod views;

use crate::editor::Editor;
use crate::setup::Setup;
use crate::views::gallery::Shown;
use brillianteer_cut::{Cut, RoundBrilliant};
use brillianteer_scene::Copies;
use brillianteer_session::model::{
    Model,
    choosing::{Choice, Question},
    render_settings::RenderSettings,
    workspace::{PaneLayout, Workspace},
};
use brillianteer_session::shows::Shows;
use brillianteer_session::studio::{Grade, Shot, Slot, Which};
use brillianteer_session::tasks::files::Chooser;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// An editor under test. Its file dialogs answer with `choices`, the last one first.
pub struct Bench {
    pub harness: Harness<'static, Editor>,
    pub choices: Arc<Mutex<Vec<PathBuf>>>,
    /// Folders and pages that were opened outside the program.
    pub opened: Arc<Mutex<Vec<String>>>,
}

/// The longest time that anything may take, on a machine that is busy with other things.
const PATIENCE: Duration = Duration::from_secs(600);

/// Number of frames that scrolling takes.
const SCROLLED: usize = 24;

/// Returns how far the painted triangles of a shape reach beyond the rectangle around its points, points.
pub fn farthest_outside(shape: &egui::Shape) -> f32 {
    use egui::epaint::{ClippedShape, Primitive, TessellationOptions, Tessellator};
    let clipped = ClippedShape::new(egui::Rect::EVERYTHING, shape.clone());
    let mut tessellator = Tessellator::new(1.0, TessellationOptions::default(), [1, 1], vec![]);
    let mut painted = vec![];
    tessellator.tessellate_clipped_shape(clipped, &mut painted);
    let rect = shape.visual_bounding_rect();
    let of = |primitive: egui::ClippedPrimitive| match primitive.primitive {
        Primitive::Mesh(mesh) => mesh.vertices,
        Primitive::Callback(_) => vec![],
    };
    let beyond = |at: egui::Pos2| rect.distance_to_pos(at);
    painted.into_iter().flat_map(of).map(|vertex| beyond(vertex.pos)).fold(0.0, f32::max)
}

/// Returns the single shapes of a shape, without texts.
pub fn single_shapes(shape: &egui::Shape) -> Vec<egui::Shape> {
    match shape {
        egui::Shape::Vec(shapes) => shapes.iter().flat_map(single_shapes).collect(),
        egui::Shape::Text(_) | egui::Shape::Noop => vec![],
        other => vec![other.clone()],
    }
}

impl Bench {
    /// Changes what renders are made with, as a step of undo.
    fn change_look(&mut self, change: impl FnOnce(&mut brillianteer_scene::Look)) {
        let edit = self.editor().model.look_with(change);
        self.harness.state_mut().act(edit);
    }

    /// Opens an editor without a file, a graphics card or an autosave.
    pub fn new() -> Self {
        Self::with(Setup::default())
    }

    /// Opens an editor with this setup.
    pub fn with(setup: Setup) -> Self {
        Self::sized(setup, egui::vec2(1000.0, 520.0))
    }

    /// Opens an editor with this setup in a window of this size, in points.
    pub fn sized(setup: Setup, size: egui::Vec2) -> Self {
        Self::built(setup, Harness::builder().with_size(size))
    }

    /// Opens an editor whose window is drawn, so that there are pictures of it.
    pub fn drawn(setup: Setup, theme: egui::Theme) -> Self {
        let builder = Harness::builder().with_size(egui::vec2(1440.0, 900.0)).with_theme(theme);
        Self::built(setup, builder.wgpu())
    }

    /// Returns a workspace of two scopes, without a render, which takes long.
    fn small() -> Workspace {
        let [_, aset, hearts, profile] = Workspace::default().panes;
        Workspace { layout: PaneLayout::Two, panes: [aset, hearts, aset, profile], ..Workspace::default() }
    }

    fn built(setup: Setup, builder: egui_kittest::HarnessBuilder<Editor>) -> Self {
        let choices: Arc<Mutex<Vec<PathBuf>>> = Arc::default();
        let chosen = Arc::clone(&choices);
        let chooser: Chooser =
            Arc::new(move |_: &Question| chosen.lock().unwrap().pop().map_or(Choice::NoDialog, Choice::File));
        let workspace =
            if setup.workspace == Workspace::default() { Self::small() } else { setup.workspace.clone() };
        let opened: Arc<Mutex<Vec<String>>> = Arc::default();
        let outside = Arc::clone(&opened);
        let opener: brillianteer_session::tasks::Opener = Arc::new(move |what: &str| {
            outside.lock().unwrap().push(what.to_owned());
            Ok(())
        });
        let setup = Setup { chooser, opener, workspace, ..setup };
        let harness = builder
            .with_max_steps(20)
            .with_step_dt(1.0 / 60.0)
            .build_eframe(|context| Editor::new(context, setup).unwrap());
        Self { harness, choices, opened }
    }

    /// Leaves of a scene of glass one shape at rest, without a background, under the program's light, in all views of the layout.
    pub fn leave_one(&mut self) {
        let Model { document, workspace, session } = &mut self.harness.state_mut().model;
        (document.work.copies, document.work.settings) = (Copies::default(), RenderSettings::default());
        workspace.begin_views();
        session.motion.rest();
    }

    pub fn editor(&self) -> &Editor {
        self.harness.state()
    }

    /// Runs frames until everything that was requested is done.
    pub fn settle(&mut self) {
        let begun = Instant::now();
        self.harness.run_steps(3);
        // A map that comes in causes a look-up, so that the editor may be busy again.
        loop {
            while !self.editor().is_idle() {
                assert!(begun.elapsed() < PATIENCE, "the studio does not come to rest");
                std::thread::sleep(Duration::from_millis(5));
                self.harness.step();
            }
            self.harness.run_steps(3);
            if self.editor().is_idle() {
                return;
            }
        }
    }

    /// Runs frames until all pictures are fine. Figures may not be ready, because they take longer by rays.
    pub fn look(&mut self) {
        self.harness.run_steps(3);
        self.wait(|editor| {
            let is_fine = |shown: &Shown| shown.grade == Grade::Fine;
            let is_taken = |(slot, shot): &(Slot, Shot)| {
                editor
                    .views
                    .gallery
                    .traced
                    .get(slot)
                    .is_some_and(|shown| is_fine(shown) && shown.shot == *shot)
            };
            let is_shown = |&pane: &usize| {
                let is_own = editor.model.workspace.panes[pane].shows == Shows::Profile;
                is_own || editor.shown((pane, Which::Present)).is_some_and(is_fine)
            };
            editor.model.session.ordered.shots.iter().all(is_taken)
                && editor.model.workspace.shown().iter().all(is_shown)
                && !editor.outside.is_looking_up()
        });
    }

    /// Runs frames until `come` returns true.
    pub fn wait(&mut self, come: impl Fn(&Editor) -> bool) {
        let begun = Instant::now();
        while !come(self.editor()) {
            assert!(begun.elapsed() < PATIENCE, "what is waited for does not come");
            std::thread::sleep(Duration::from_millis(5));
            self.harness.step();
        }
        self.harness.run_steps(2);
    }

    /// Moves the pointer to a point and clicks.
    pub fn click_at(&mut self, at: egui::Pos2) {
        self.harness.hover_at(at);
        for pressed in [true, false] {
            let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
            self.harness.step();
            self.harness.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        }
        self.harness.run_steps(2);
    }

    /// Returns the widget of this name, which may have to have a role.
    fn named<'a>(&'a self, role: Option<egui::Role>, name: &'a str) -> egui_kittest::Node<'a> {
        match role {
            Some(role) => self.field(role, name),
            None => self.harness.get_by_label(name),
        }
    }

    /// Scrolls a widget into sight, until it is at rest. A click outside of what is in sight would go to another widget.
    fn reveal(&mut self, role: Option<egui::Role>, name: &str) {
        self.named(role, name).scroll_to_me();
        self.harness.run_steps(2);
        for _ in 0..SCROLLED {
            let before = self.named(role, name).rect();
            self.harness.step();
            if self.named(role, name).rect() == before {
                return;
            }
        }
    }

    /// Clicks the widget with this label, scrolled into sight first.
    pub fn click(&mut self, label: &str) {
        self.reveal(None, label);
        self.harness.get_by_label(label).click();
        self.harness.run_steps(2);
    }

    /// Chooses an entry of a menu.
    pub fn choose(&mut self, menu: &str, entry: &str) {
        self.click(menu);
        self.harness.run_steps(4);
        // A menu that is higher than the window is scrolled.
        self.harness.get_by_label_contains(entry).scroll_to_me();
        self.harness.run_steps(SCROLLED);
        self.harness.get_by_label_contains(entry).click();
        self.harness.run_steps(4);
    }

    /// Replaces the text of the field that has the focus, and presses Enter.
    fn replace_text(&mut self, text: &str) {
        self.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.harness.run_steps(1);
        self.harness.key_press(egui::Key::Enter);
        self.harness.run_steps(3);
    }

    /// Types a number into the field of this name, scrolled into sight first.
    pub fn type_number(&mut self, name: &str, number: &str) {
        self.reveal(Some(egui::Role::SpinButton), name);
        let field = self.harness.get_by_role_and_label(egui::Role::SpinButton, name);
        field.focus();
        self.harness.run_steps(2);
        self.harness.get_by_role_and_label(egui::Role::SpinButton, name).click();
        self.harness.run_steps(2);
        self.replace_text(number);
    }

    /// Opens the colour picker of this name, types the codes of a colour from 0 to 255, and closes the picker.
    pub fn pick_colour(&mut self, name: &str, codes: [u8; 3]) {
        self.harness.get_by_role_and_label(egui::Role::ColorWell, name).scroll_to_me();
        self.harness.run_steps(SCROLLED);
        self.harness.get_by_role_and_label(egui::Role::ColorWell, name).click();
        self.harness.run_steps(4);
        for (channel, code) in ["R ", "G ", "B "].into_iter().zip(codes) {
            let field = self
                .harness
                .query_all_by_role(egui::Role::SpinButton)
                .find(|node| node.accesskit_node().value().is_some_and(|value| value.starts_with(channel)));
            field.expect("the picker is open").click();
            self.harness.run_steps(2);
            self.replace_text(&code.to_string());
        }
        self.harness.key_press(egui::Key::Escape);
        self.harness.run_steps(3);
    }

    /// Returns the field of this role and name.
    pub fn field<'a>(&'a self, role: egui::Role, name: &'a str) -> egui_kittest::Node<'a> {
        self.harness.get_by_role_and_label(role, name)
    }

    /// Sends events all in one frame, as they come where a frame takes long.
    pub fn at_once(&mut self, events: Vec<egui::Event>) {
        self.harness.input_mut().events.extend(events);
        self.harness.run_steps(4);
    }

    pub fn brilliant(&self) -> RoundBrilliant {
        match self.editor().model.document.work.design.cut {
            Cut::RoundBrilliant(brilliant) => brilliant,
            _ => panic!("a round brilliant is expected"),
        }
    }

    /// Returns the pixels of a view, whose picture must be fine.
    pub fn picture(&self, pane: usize) -> Vec<[u8; 4]> {
        let shown = self.editor().shown((pane, Which::Present)).unwrap();
        assert_eq!(shown.grade, Grade::Fine);
        shown.taken.image.rgba.as_chunks().0.to_vec()
    }
}
