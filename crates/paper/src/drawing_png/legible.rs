//! Checks for tests: whether the texts of a drawing lie within it and do not overlap.

use super::parse;
use resvg::usvg::{self, Node, Rect};

/// The widest overlap that is invisible, pixels.
const TOUCHING: f32 = 1.0;

/// The box of a text, with its letters.
pub type Written = (Rect, String);

/// Returns the boxes of all texts, with their letters.
pub fn texts(group: &usvg::Group) -> Vec<Written> {
    let of_node = |node: &Node| match node {
        Node::Group(inner) => texts(inner),
        Node::Text(text) => {
            let said = text.chunks().iter().map(|chunk| chunk.text()).collect();
            vec![(text.abs_bounding_box(), said)]
        }
        Node::Path(_) | Node::Image(_) => vec![],
    };
    group.children().iter().flat_map(of_node).collect()
}

/// Returns the first two texts that overlap by more than can be seen.
pub fn overlapping(boxes: &[Written]) -> Option<(&Written, &Written)> {
    let over = |a: &Rect, b: &Rect| {
        (a.right().min(b.right()) - a.left().max(b.left()))
            .min(a.bottom().min(b.bottom()) - a.top().max(b.top()))
    };
    let pairs = boxes.iter().enumerate().flat_map(|(k, a)| boxes[..k].iter().map(move |b| (a, b)));
    pairs.into_iter().find(|(a, b)| over(&a.0, &b.0) >= TOUCHING)
}

/// Parses a drawing and checks that its texts lie within it and do not overlap.
pub fn assert_legible(svg: &str) {
    let tree = parse(svg).unwrap();
    let boxes = texts(tree.root());
    assert!(boxes.len() > 4);
    let size = tree.size();
    for (a, said) in &boxes {
        let inside =
            a.left() > 0.0 && a.top() > 0.0 && a.right() < size.width() && a.bottom() < size.height();
        assert!(inside, "{said}: {a:?} is outside {size:?}: {svg}");
    }
    if let Some((a, b)) = overlapping(&boxes) {
        panic!("{a:?} overlaps {b:?}: {svg}");
    }
}

#[test]
fn an_overlap_would_be_seen() {
    let drawing = |x: u32| {
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 200 50'><text x='5' y='30'>one</text>\
             <text x='{x}' y='30'>two</text></svg>"
        )
    };
    let is_clear = |x: u32| overlapping(&texts(parse(&drawing(x)).unwrap().root())).is_none();
    assert_eq!([5, 20, 60].map(is_clear), [false, false, true]);
}
