//! Colours of values.

use proctor_benchmark::show::drawing::Rgb;
use proctor_benchmark::show::particles::palette::colour;

#[test]
fn lighter_from_step_to_step() {
    let light =
        |[r, g, b]: Rgb| 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
    let steps: Vec<Rgb> = (0..11)
        .map(|step| colour(f64::from(step), [0.0, 10.0]))
        .collect();
    assert!(steps.windows(2).all(|pair| light(pair[0]) < light(pair[1])));
    // Colours of viridis at 0, 1/10, 1/2 and 1, and grey.
    assert_eq!(colour(-9.0, [0.0, 1.0]), [68, 1, 84]);
    assert_eq!(colour(1.0, [0.0, 1.0]), [253, 231, 37]);
    assert_eq!(colour(0.1, [0.0, 1.0]), [72, 36, 117]);
    assert_eq!(colour(3.0, [3.0, 3.0]), [33, 145, 140]);
    assert_eq!(colour(f64::NAN, [0.0, 1.0]), [160; 3]);
}
