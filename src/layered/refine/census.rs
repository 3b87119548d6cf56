//! Which neighbours of a pixel are brighter: its 5×5 census, 24 bits. The number of differing bits of two pixels
//! hardly depends on light (Zabih and Woodfill 1994).

use crate::grid::Grid;

/// The census of every pixel; the frame is continued outwards.
pub fn census(picture: &Grid<f32>) -> Vec<u32> {
    let (width, height) = (picture.width(), picture.height());
    let mut bits = vec![0u32; width * height];
    let mut padded: Vec<Vec<f32>> = vec![vec![0.0; width + 4]; 5];
    for y in 0..height {
        for (k, row) in padded.iter_mut().enumerate() {
            let source = picture.row((y + k).saturating_sub(2).min(height - 1));
            row[..2].fill(source[0]);
            row[2..width + 2].copy_from_slice(source);
            row[width + 2..].fill(source[width - 1]);
        }
        let out = &mut bits[y * width..(y + 1) * width];
        let centre = picture.row(y);
        for (j, row) in padded.iter().enumerate() {
            for i in 0..5 {
                if (i, j) == (2, 2) {
                    continue;
                }
                for ((b, &n), &c) in out.iter_mut().zip(&row[i..i + width]).zip(centre) {
                    *b = *b << 1 | u32::from(n > c);
                }
            }
        }
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::census;
    use crate::grid::Grid;

    #[test]
    fn does_not_see_light() {
        let grey = |x: usize, y: usize| ((x * 37 + y * 101) % 71) as f32;
        let plain = census(&Grid::from_fn(20, 15, grey));
        let bright = census(&Grid::from_fn(20, 15, |x, y| 1.5 * grey(x, y) + 20.0));
        assert_eq!(plain, bright);
        assert!(plain.iter().any(|&b| b.count_ones() > 12));
        assert!(census(&Grid::new(3, 2, 1.0)).iter().all(|&b| b == 0));
    }
}
