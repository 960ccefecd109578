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
    /// The title of the menu.
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
            ViewBack => "View before",
            ViewOn => "View after",
            Top => "Top",
            Side => "Side",
            Bottom => "Bottom",
            Free => "Free",
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
            LayOut => "Lay copies out anew",
            NextBehind => "Next background",
            Panels => "Views alone",
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
            Open => "Opens a cut file; dropping one on the window does the same.",
            Save => "Saves the design where it lies.",
            SaveAs => "Saves the design as another file.",
            Export => "Writes pictures, drawings and figures as files.",
            CopyPicture => "Copies the large picture, or the one under the pointer, to the clipboard.",
            Quit => "Closes the window.",
            Undo => "Takes the last change back; a drag is one.",
            Redo => "Does again what was undone.",
            ViewBack => "Takes the last tilt, zoom, layout or overlay back; the design stays.",
            ViewOn => "Goes to the view that was gone back from.",
            Top => "Looks at the table.",
            Side => "Looks along the girdle.",
            Bottom => "Looks at the culet.",
            Free => "Goes back to the tilt before.",
            Fit => "Shows the whole stone.",
            Perspective => "Sees the stone of this view from nearby instead of along parallel rays.",
            EyeLeans => {
                "Moves the eye over a still stone and light; else the stone tilts under eye and light."
            }
            One => "One large view.",
            Two => "Two views.",
            Four => "Four views.",
            Wireframe => "Draws the edges over pictures.",
            Facets => "Gives each facet a colour.",
            Bounces => "Shows how often light is reflected inside.",
            Unresolved => "Shows where light was not followed to its end.",
            Total => "Shows how often light is totally reflected before the first way out.",
            Strongest => {
                "Shows only the zone that each point's strongest light comes from, as many ASET maps do."
            }
            Glare => {
                "Adds the light that the stone's outer surface reflects to scopes and to the zones of figures: what a camera \
                 records, but oranges and pinks where graders look for red."
            }
            CompareSaved => "Shows the design as it was saved while C is held.",
            CompareFile => "Shows another file's design while C is held.",
            Split => "Shows both designs side by side in every view.",
            NoCompare => "Forgets the design compared with.",
            LightPath => "Follows one ray through the stone: click a point of a view.",
            Play => "Copies tumble and plates wave in renders, until it is chosen again.",
            LayOut => "Scatters the copies that renders show.",
            NextBehind => "Hangs the next pattern behind renders.",
            Panels => "Hides the panels at both sides, until it is chosen again.",
            FullScreen => "Fills the screen with the window, until it is chosen again.",
            ResetView => {
                "Shows the whole stone face up in all views, linked, along parallel rays, with nothing drawn over it."
            }
            ResetLayout => {
                "Shows the four views of the first start, and both panels as wide as they were then."
            }
            Keys => "Lists the keys, and what the trade's terms mean.",
            About => "The program's version, its licences, and what it is built of.",
        }
    }
}
