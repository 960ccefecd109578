//! Polygons that may be slivers, or seen edge-on. egui softens the borders of its own polygons and joins closed lines by
//! mitres, and both stick out of a sliver as long spikes.

use egui::{Color32, Mesh, Pos2, Shape, Stroke};

/// Adds a convex polygon to a mesh, without softened borders.
pub fn fill(mesh: &mut Mesh, corners: impl IntoIterator<Item = Pos2>, colour: Color32) {
    let first = mesh.vertices.len() as u32;
    corners.into_iter().for_each(|corner| mesh.colored_vertex(corner, colour));
    for k in first + 2..mesh.vertices.len() as u32 {
        mesh.add_triangle(first, k - 1, k);
    }
}

/// Returns a closed line with round corners.
pub fn closed_line(corners: &[Pos2], stroke: Stroke) -> Vec<Shape> {
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let lines = ends.map(|(&a, &b)| Shape::line_segment([a, b], stroke));
    let corners = corners.iter().map(|&p| Shape::circle_filled(p, stroke.width / 2.0, stroke.color));
    lines.chain(corners).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::farthest_outside;
    use egui::pos2;

    #[test]
    fn slivers_have_no_spikes_and_egui_s_own_polygons_have() {
        let sliver = [pos2(0.0, 0.0), pos2(50.0, 0.01), pos2(100.0, 0.0), pos2(50.0, -0.01)];
        let stroke = Stroke::new(1.0, Color32::WHITE);
        let own = Shape::convex_polygon(sliver.to_vec(), Color32::WHITE, stroke);
        assert!(farthest_outside(&own) > 20.0, "this is what the functions here are for");
        let mut mesh = Mesh::default();
        fill(&mut mesh, sliver, Color32::WHITE);
        assert_eq!((mesh.vertices.len(), mesh.indices.len()), (4, 6));
        let mut shapes = closed_line(&sliver, stroke);
        shapes.push(Shape::mesh(mesh));
        assert!(shapes.iter().all(|shape| farthest_outside(shape) < 2.0));
    }
}
