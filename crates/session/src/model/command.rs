//! Commands: everything that the user can start by a key or a menu.

use crate::described::described;

described! {
/// A command of the editor. Its keys are divided by commas, and menus show the first. `Ctrl` is the command key of a
/// Mac.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command by keys {
    New: "Ctrl+N", "New from a cut…", "Begins a design from one of the cuts that come with the program.";
    Open: "Ctrl+O", "Open…", "Opens a cut, a mesh or a scene. You can also drop the file on the window.";
    Save: "Ctrl+S", "Save", "Saves the design in its file.";
    SaveAs: "Ctrl+Shift+S", "Save as…", "Saves the design in another file.";
    Export: "Ctrl+E", "Export…", "Writes pictures, drawings and figures as files.";
    CopyPicture: "Ctrl+Shift+C", "Copy picture",
        "Copies the large picture, or the one under the pointer, to the clipboard.";
    Quit: "Ctrl+Q", "Quit", "Closes the window.";
    Undo: "Ctrl+Z", "Undo", "Undoes the last change; a whole drag is one change.";
    Redo: "Ctrl+Shift+Z, Ctrl+Y", "Redo", "Redoes the change that was undone last.";
    ViewBack: "Backspace", "Previous view",
        "Undoes the last change of tilt, zoom, layout or overlay; the design stays.";
    ViewOn: "Shift+Backspace", "Next view", "Redoes the view change that was undone last.";
    IntoTiers: "", "Turn into tiers",
        "Lists the facets as tiers on an index gear, so that each can be cut otherwise. Proportions end with it. \
         A heart, which is not convex at its cleft, and curved glass have no tiers.";
    Retarget: "", "Fit to another material…",
        "Changes the angles for another material by a rule, and compares the light of both.";
    Yield: "", "Size and yield…",
        "Finds the stone that a piece of rough gives, or that has a wanted weight.";
    Top: "T", "Top", "Looks at the table.";
    Side: "S", "Side", "Looks along the girdle.";
    Bottom: "B", "Bottom", "Looks at the culet.";
    PreviousTilt: "F", "Previous tilt", "Goes back to the last tilt before top, side or bottom.";
    Fit: "0", "Fit to view", "Shows the whole stone.";
    Perspective: "P", "Perspective",
        "Shows the stone of this view from nearby instead of along parallel rays.";
    EyeLeans: "E", "Tilt the eye, not the stone",
        "A drag tilts the eye, while stone and light stay. Otherwise it tilts the stone, while eye and \
         light stay.";
    One: "1", "One view", "One large view.";
    Two: "2", "Two views", "Two views.";
    Four: "4", "Four views", "Four views.";
    Wireframe: "W", "Wireframe", "Draws the edges of the facets over pictures.";
    Facets: "A", "Facets in colour", "Gives each facet a colour.";
    Bounces: "N", "Bounces", "Shows how often light is reflected inside.";
    Unresolved: "U", "Unresolved light", "Shows where light was not followed to its end.";
    Total: "I", "Total reflections",
        "Shows how often light is totally reflected before it first can leave the stone.";
    Strongest: "X", "Strongest exits only",
        "Shows at each point only the zone of its strongest light, as many ASET maps do.";
    Glare: "V", "Glare in scopes",
        "Adds glare, the light that the outer surface of the stone reflects, to scopes and to the zones of \
         figures. A camera records it, but it turns the red that graders look for into orange and pink.";
    LightPath: "L", "Light path", "Follows one ray through the stone; click a point of a view to choose it.";
    Play: "M", "Motion", "Starts or stops the motion in renders: copies tumble and plates wave.";
    LayOut: "Space", "Scatter copies", "Scatters the copies in renders anew.";
    NextBehind: "G", "Next background", "Puts the next world or pattern behind renders.";
    AnotherLight: "Shift+G", "Another light", "Lights renders by another light and turns it, both at random.";
    ResetLight: "", "Reset light",
        "Sets light, background and head as they were when the document was opened.";
    Tiers: "Shift+T", "Table of tiers",
        "Opens a table below the views, in which tiers are added, placed and named.";
    BenchMode: "Shift+B", "Bench mode",
        "Shows one step of the cutting at a time, in large letters, and marks what has been cut.";
    Audit: "Shift+A", "Audit",
        "Lists places of the stone that may not be what its designer meant.";
    Map: "Shift+M", "Map of a measure",
        "Maps how well the cut handles light over two of its proportions; a click on the map moves the design.";
    Search: "Shift+F", "Find a better cut",
        "Searches for a design that handles light better, by the measures that you choose; one step of undo.";
    Panels: "H", "Hide panels", "Hides the panels at both sides, or shows them again.";
    FullScreen: "F11", "Full screen", "Fills the screen with the window, or makes it smaller again.";
    ResetView: "", "Reset view",
        "Links all views and shows the whole stone face up, along parallel rays, without overlays.";
    ResetLayout: "", "Reset layout", "Brings back the four views and the panels of the first start.";
    CompareSaved: "R", "Compare with saved",
        "Compares the design with its saved version; hold C to see that version.";
    CompareFile: "", "Compare with file…",
        "Compares the design with that of another file; hold C to see the other one.";
    Split: "D", "Split views", "Shows both designs side by side in every view.";
    NoCompare: "", "Stop comparing", "Ends the comparison.";
    Keys: "F1", "Keys and terms", "Lists all keys and explains the terms of the trade.";
    About: "", "About Brillianteer",
        "Shows the version, the licences, and the crates that the program is built with.";
}
}

/// A menu of the menu bar.
pub struct Menu {
    /// The title of the menu.
    pub title: &'static str,
    /// The commands in the menu, in groups.
    pub groups: &'static [&'static [Command]],
}

use Command::*;

/// All menus, from left to right. The File menu also lists recent files, and the scenes that come with the program.
pub const MENUS: [Menu; 6] = [
    Menu { title: "File", groups: &[&[New, Open], &[Save, SaveAs], &[Export, CopyPicture], &[Quit]] },
    Menu { title: "Edit", groups: &[&[Undo, Redo], &[ViewBack, ViewOn], &[IntoTiers]] },
    Menu { title: "Design", groups: &[&[Retarget], &[Yield]] },
    Menu {
        title: "View",
        groups: &[
            &[Top, Side, Bottom, PreviousTilt, Fit],
            &[Perspective, EyeLeans],
            &[One, Two, Four],
            &[Wireframe, Facets, Bounces, Unresolved, Total, Strongest, Glare],
            &[LightPath],
            &[Play, LayOut, NextBehind, AnotherLight, ResetLight],
            &[Tiers, BenchMode, Audit, Map, Search],
            &[Panels, FullScreen],
            &[ResetView, ResetLayout],
        ],
    },
    Menu { title: "Compare", groups: &[&[CompareSaved, CompareFile], &[Split], &[NoCompare]] },
    Menu { title: "Help", groups: &[&[Keys], &[About]] },
];
