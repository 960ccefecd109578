//! Scales photographs to the size of a picture.

use brillianteer_scene::Panorama;
use glam::DVec2;
use rayon::prelude::*;

/// Scales a picture to fill a size: as large as possible around its middle, and cut where it is longer.
pub fn filling(picture: &Panorama, size: [u32; 2]) -> Panorama {
    let [width, height] = size.map(|side| f64::from(side.max(1)));
    let scale = |p: &Panorama| (f64::from(p.width) / width).min(f64::from(p.height) / height);
    let mut picture = std::borrow::Cow::Borrowed(picture);
    // After this, each pixel stands for fewer than two of the picture's each way, so that the look-up skips none.
    while scale(&picture) >= 2.0 {
        picture = std::borrow::Cow::Owned(picture.halved());
    }
    let step = scale(&picture);
    let middle = DVec2::new(f64::from(picture.width), f64::from(picture.height)) / 2.0;
    let light = |k: usize| {
        let at = DVec2::new((k % size[0] as usize) as f64, (k / size[0] as usize) as f64) + 0.5;
        let from_middle = at - DVec2::new(width, height) / 2.0;
        picture.between(middle + from_middle * step - 0.5).as_vec3().to_array()
    };
    let pixels = (0..size[0] as usize * size[1] as usize).into_par_iter().map(light).collect();
    Panorama { width: size[0], height: size[1], pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_photograph_fills_the_picture() {
        let ramp = |width: u32, height: u32| {
            let pixels = (0..width * height).map(|k| [(k % width) as f32 + 0.5; 3]).collect();
            Panorama { width, height, pixels }
        };
        assert!(filling(&ramp(72, 56), [72, 56]) == ramp(72, 56));
        // The picture is cut to its middle half, then halved: each pixel stands for four.
        let seen = filling(&ramp(80, 20), [20, 10]);
        assert_eq!((seen.width, seen.height), (20, 10));
        assert!((0..20).all(|x| (seen.pixels[x][0] - (20.0 + 2.0 * x as f32 + 1.0)).abs() < 1e-4));
        assert!(filling(&ramp(3, 2), [0, 5]).pixels.is_empty());
    }
}
