//! The reasons why triangles bound no solid.

use glam::DVec3;

/// The reason why a surface could not be mended. Fields count triangles and corners from 0; messages count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The surface has no triangle, or none that has an area.
    #[error("there is no triangle with an area; a closed surface of triangles is expected")]
    Empty,
    /// A triangle refers to a corner that does not exist.
    #[error("triangle {} refers to corner {}, and there are {vertices}", .triangle + 1, .vertex + 1)]
    Index {
        /// The triangle, counted from 0.
        triangle: usize,
        /// The corner that the triangle refers to.
        vertex: u32,
        /// The number of corners.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("corner {} is at {at}; finite coordinates are expected", .vertex + 1)]
    NotFinite {
        /// The corner, counted from 0.
        vertex: usize,
        /// The coordinates given for it.
        at: DVec3,
    },
    /// The surface is so small or so large that areas and volumes cannot be computed, or so far from the origin that
    /// its digits are lost.
    #[error("the surface is {size:e} across and {distance:e} from the origin; move it there, or rescale it")]
    OutOfScale {
        /// Half the diagonal of the surface's box.
        size: f64,
        /// The distance of the middle of the box from the origin.
        distance: f64,
    },
    /// Some edges have a triangle on one side only, and the gaps are too wide to be cracks.
    #[error("{}", open_edges_text(*.count, .edges, *.crack))]
    Open {
        /// The number of such edges.
        count: usize,
        /// The ends of the longest of these edges.
        edges: Vec<[DVec3; 2]>,
        /// The widest gap that would have been closed.
        crack: f64,
    },
    /// The surface has only one side, like a Möbius strip.
    #[error("the surface has no outside: its sides meet at the edge from {} to {}", point_text(.edge[0]), point_text(.edge[1]))]
    OneSided {
        /// The ends of an edge where the two sides meet.
        edge: [DVec3; 2],
    },
    /// The surface encloses no volume: all its triangles lie in one plane, or it is folded onto itself.
    #[error("the surface encloses nothing; a solid is expected")]
    Flat,
}

/// The most edges that an error names.
pub(super) const MOST_EDGES: usize = 4;

fn point_text(point: DVec3) -> String {
    // An f32 holds seven digits, and most files store f32.
    let digits = |x: f64| format!("{}", format!("{x:.6e}").parse::<f64>().unwrap_or(x));
    format!("({}, {}, {})", digits(point.x), digits(point.y), digits(point.z))
}

fn open_edges_text(count: usize, edges: &[[DVec3; 2]], crack: f64) -> String {
    let shown = edges.iter().map(|[a, b]| format!("{} to {}", point_text(*a), point_text(*b)));
    let shown = shown.collect::<Vec<_>>().join("; ");
    let more = count.saturating_sub(edges.len());
    let more = if more > 0 { format!("; and {more} more") } else { String::new() };
    let noun = if count == 1 { "edge lacks its" } else { "edges lack their" };
    format!(
        "the surface is open: {count} {noun} neighbour, by more than {crack:.1e}: {shown}{more}; close the holes, and \
         give each edge two triangles"
    )
}
