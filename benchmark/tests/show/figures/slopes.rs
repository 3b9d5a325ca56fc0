//! Slopes beside the lines of a chart.

use proctor_benchmark::show::chart::{Colour, Mark, Point, Series, Strength, Stroke};
use proctor_benchmark::show::figures::slopes::slopes;

fn line(points: &[(f64, f64)]) -> Series {
    Series {
        colour: Colour::Ink,
        mark: Mark::Circle,
        stroke: Stroke::Solid,
        strength: Strength::Plain,
        points: points
            .iter()
            .map(|&(x, y)| Point {
                x,
                y: Some(y),
                title: String::new(),
            })
            .collect(),
    }
}

#[test]
fn slopes_have_their_orders_and_keep_clear_of_a_falling_line() {
    let series = [line(&[(1.0, 1.0), (100.0, 0.01)])];
    let guides = slopes(&series, |order| -f64::from(order) / 2.0);
    assert_eq!(guides.len(), 2);
    for (guide, order) in guides.iter().zip([1.0, 2.0]) {
        let rise = (guide.to[1] / guide.from[1]).ln() / (guide.to[0] / guide.from[0]).ln();
        assert!((rise + order / 2.0).abs() < 1e-12, "{guide:?}");
        // The line is x y = 1: both ends lie on the same side of it, at a distance.
        for [x, y] in [guide.from, guide.to] {
            assert!(x * y < 0.9 || x * y > 1.1, "{guide:?}");
        }
    }
}

#[test]
fn there_are_none_without_room_or_extent() {
    assert!(slopes(&[], f64::from).is_empty());
    assert!(slopes(&[line(&[(1.0, 1.0)])], f64::from).is_empty());
    let steep = [line(&[(1.0, 1.0), (1e4, 1e-12)])];
    assert!(slopes(&steep, |order| -0.01 * f64::from(order)).is_empty());
}
