//! Commands: everything that can be done by a key or a menu.

/// A command of the editor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    Open,
    Save,
    SaveAs,
    Export,
    CopyPicture,
    Quit,
    Undo,
    Redo,
    ViewBack,
    ViewOn,
    Top,
    Side,
    Bottom,
    Free,
    Fit,
    Perspective,
    EyeLeans,
    One,
    Two,
    Four,
    Wireframe,
    Facets,
    Bounces,
    Unresolved,
    Total,
    Strongest,
    Glare,
    CompareSaved,
    CompareFile,
    Split,
    NoCompare,
    LightPath,
    Play,
    LayOut,
    NextBehind,
    Panels,
    ResetView,
    ResetLayout,
    FullScreen,
    Keys,
    About,
}

/// A menu of the menu bar.
pub struct Menu {
    pub title: &'static str,
    /// The commands in the menu, in groups.
    pub groups: &'static [&'static [Command]],
}

use Command::*;

/// All menus. The File menu also lists recent files, and the cuts and scenes that come with the program.
pub const MENUS: [Menu; 5] = [
    Menu { title: "File", groups: &[&[Open], &[Save, SaveAs], &[Export, CopyPicture], &[Quit]] },
    Menu { title: "Edit", groups: &[&[Undo, Redo], &[ViewBack, ViewOn]] },
    Menu {
        title: "View",
        groups: &[
            &[Top, Side, Bottom, Free, Fit],
            &[Perspective, EyeLeans],
            &[One, Two, Four],
            &[Wireframe, Facets, Bounces, Unresolved, Total, Strongest, Glare],
            &[LightPath],
            &[Play, LayOut, NextBehind],
            &[Panels, FullScreen],
            &[ResetView, ResetLayout],
        ],
    },
    Menu { title: "Compare", groups: &[&[CompareSaved, CompareFile], &[Split], &[NoCompare]] },
    Menu { title: "Help", groups: &[&[Keys], &[About]] },
];

impl Command {
    /// All commands, in menu order.
    pub fn all() -> impl Iterator<Item = Self> {
        MENUS.iter().flat_map(|m| m.groups.iter()).flat_map(|g| g.iter()).copied()
    }

    /// Returns the name of the command in menus; three dots follow where the command asks for more.
    pub fn name(self) -> &'static str {
        match self {
            Open => "Open…",
            Save => "Save",
            SaveAs => "Save as…",
            Export => "Export…",
            CopyPicture => "Copy picture",
            Quit => "Quit",
            Undo => "Undo",
            Redo => "Redo",
            ViewBack => "Previous view",
            ViewOn => "Next view",
            Top => "Top",
            Side => "Side",
            Bottom => "Bottom",
            Free => "Previous tilt",
            Fit => "Fit to view",
            Perspective => "Perspective",
            EyeLeans => "Tilt the eye, not the stone",
            One => "One view",
            Two => "Two views",
            Four => "Four views",
            Wireframe => "Wireframe",
            Facets => "Facets in colour",
            Bounces => "Bounces",
            Unresolved => "Unresolved light",
            Total => "Total reflections",
            Strongest => "Strongest exits only",
            Glare => "Glare in scopes",
            CompareSaved => "Compare with saved",
            CompareFile => "Compare with file…",
            Split => "Split views",
            NoCompare => "Stop comparing",
            LightPath => "Light path",
            Play => "Motion",
            LayOut => "Scatter copies",
            NextBehind => "Next background",
            Panels => "Hide panels",
            FullScreen => "Full screen",
            ResetView => "Reset view",
            ResetLayout => "Reset layout",
            Keys => "Keys and terms",
            About => "About Brillianteer",
        }
    }

    /// Describes in a sentence what the command does.
    pub fn meaning(self) -> &'static str {
        match self {
            Open => "Opens a cut, a mesh or a scene. You can also drop the file on the window.",
            Save => "Saves the design in its file.",
            SaveAs => "Saves the design in another file.",
            Export => "Writes pictures, drawings and figures as files.",
            CopyPicture => "Copies the large picture, or the one under the pointer, to the clipboard.",
            Quit => "Closes the window.",
            Undo => "Undoes the last change; a whole drag is one change.",
            Redo => "Redoes the change that was undone last.",
            ViewBack => "Undoes the last change of tilt, zoom, layout or overlay; the design stays.",
            ViewOn => "Redoes the view change that was undone last.",
            Top => "Looks at the table.",
            Side => "Looks along the girdle.",
            Bottom => "Looks at the culet.",
            Free => "Goes back to the tilt that the view had before.",
            Fit => "Shows the whole stone.",
            Perspective => "Shows the stone of this view from nearby instead of along parallel rays.",
            EyeLeans => {
                "A drag tilts the eye, while stone and light stay. Otherwise it tilts the stone, while eye and \
                    light stay."
            }
            One => "One large view.",
            Two => "Two views.",
            Four => "Four views.",
            Wireframe => "Draws the edges of the facets over pictures.",
            Facets => "Gives each facet a colour.",
            Bounces => "Shows how often light is reflected inside.",
            Unresolved => "Shows where light was not followed to its end.",
            Total => "Shows how often light is totally reflected before it first can leave the stone.",
            Strongest => "Shows at each point only the zone of its strongest light, as many ASET maps do.",
            Glare => {
                "Adds glare, the light that the outer surface of the stone reflects, to scopes and to the zones of \
                    figures. A camera records it, but it turns the red that graders look for into orange and pink."
            }
            CompareSaved => "Compares the design with its saved version; hold C to see that version.",
            CompareFile => "Compares the design with that of another file; hold C to see the other one.",
            Split => "Shows both designs side by side in every view.",
            NoCompare => "Ends the comparison.",
            LightPath => "Follows one ray through the stone; click a point of a view to choose it.",
            Play => "Starts or stops the motion in renders: copies tumble and plates wave.",
            LayOut => "Scatters the copies in renders anew.",
            NextBehind => "Puts the next pattern behind renders.",
            Panels => "Hides the panels at both sides, or shows them again.",
            FullScreen => "Fills the screen with the window, or makes it smaller again.",
            ResetView => {
                "Links all views and shows the whole stone face up, along parallel rays, without overlays."
            }
            ResetLayout => "Brings back the four views and the panels of the first start.",
            Keys => "Lists all keys and explains the terms of the trade.",
            About => "Shows the version, the licences, and the crates that the program is built with.",
        }
    }
}
