use super::*;

#[test]
fn planes_of_both_sides_are_continued() {
    let side = |x: usize, y: usize, near: bool| {
        0.02 * x as f32 - 0.01 * y as f32 + if near { 3.0 } else { 1.0 }
    };
    let rho = Grid::from_fn(30, 20, |x, y| side(x, y, x > 14));
    let support = Grid::new(30, 20, true);
    let [near, far] = planes(&rho, &support, 13, 9, 0.5).unwrap();
    assert!((near - side(13, 9, true)).abs() < 0.1, "{near}");
    assert!((far - side(13, 9, false)).abs() < 0.05, "{far}");
    assert_eq!(planes(&rho, &support, 4, 9, 0.5), None);
    let marked = band(&rho, &support, 0.3);
    let row: Vec<usize> = (0..30).filter(|&x| marked[(x, 9)]).collect();
    assert_eq!(row, (11..18).collect::<Vec<_>>());
}
