//! Drawings that explain the method: the weighting functions, and the step.

use super::BookFile;
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Mark, Point, Scale, Series, Strength, Stroke,
};
use std::fmt::Write as _;

/// Half-lengths of particle domains in cells, with the names of their functions.
pub const FUNCTIONS: [(f64, &str); 3] = [
    (0.0, "linear hat, l = 0"),
    (0.25, "GIMP with two particles per cell, l = 1/4"),
    (0.5, "quadratic B-spline, l = 1/2"),
];
/// Points of a line.
const POINTS: i32 = 96;

/// All drawings.
pub(super) fn all() -> Vec<BookFile> {
    let file = |name: &str, text| BookFile {
        path: format!("pictures/{name}.svg"),
        text,
    };
    vec![
        file(
            "weighting-functions",
            weighting("weight of the node", weight).to_svg(),
        ),
        file(
            "weighting-gradients",
            weighting("gradient times h", gradient).to_svg(),
        ),
        file("step", step()),
    ]
}

/// The weight of a node at a distance of x cells for domains of half-length l \[cells\]: the hat, averaged over the domain.
#[must_use]
pub fn weight(x: f64, l: f64) -> f64 {
    let x = x.abs();
    if x < l {
        1.0 - (x * x + l * l) / (2.0 * l)
    } else if x < 1.0 - l {
        1.0 - x
    } else if x < 1.0 + l {
        (1.0 + l - x) * (1.0 + l - x) / (4.0 * l)
    } else {
        0.0
    }
}

/// The derivative of [`weight`] by x \[1/cell\].
#[must_use]
pub fn gradient(x: f64, l: f64) -> f64 {
    let (side, x) = (if x < 0.0 { -1.0 } else { 1.0 }, x.abs());
    side * if x < l {
        -x / l
    } else if x < 1.0 - l {
        -1.0
    } else if x < 1.0 + l {
        -(1.0 + l - x) / (2.0 * l)
    } else {
        0.0
    }
}

/// A line per function over the distance from the node.
fn weighting(ordinate: &str, value: fn(f64, f64) -> f64) -> Chart {
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Linear,
        format: Format::Number,
    };
    let line = |i: usize, l: f64| Series {
        colour: Colour::Hue(i),
        mark: Mark::None,
        stroke: Stroke::Solid,
        strength: Strength::Plain,
        points: (-POINTS..=POINTS)
            .map(|k| 1.6 * f64::from(k) / f64::from(POINTS))
            .map(|x| Point {
                x,
                y: Some(value(x, l)),
                title: String::new(),
            })
            .collect(),
    };
    Chart {
        title: format!("{ordinate} against the distance of the particle"),
        description: "Three weighting functions of one node along one axis.".to_owned(),
        x: axis("(x_p - x_I)/h"),
        y: axis(ordinate),
        series: { FUNCTIONS.iter().enumerate() }
            .map(|(i, (l, _))| line(i, *l))
            .collect(),
        guides: vec![],
        legend: { FUNCTIONS.iter().enumerate() }
            .map(|(i, (_, label))| Entry {
                label: (*label).to_owned(),
                colour: Colour::Hue(i),
                mark: Mark::None,
                stroke: Stroke::Solid,
                strength: Strength::Plain,
                open: false,
            })
            .collect(),
        equal: false,
    }
}

/// The phases of a step: where each acts, its name, and its result.
const PHASES: [(bool, &str, &str); 6] = [
    (true, "sort", "particles by cells"),
    (false, "map to nodes", "m_I, p_I, f_I"),
    (false, "choose the step", "dt"),
    (false, "solve", "v_I, with contact"),
    (true, "gather", "v_p, x_p, F_p and stress"),
    (true, "finish", "energy balance and clock"),
];

/// The step as a row of boxes, those of particles above those of the grid.
fn step() -> String {
    let (width, height) = (640.0, 230.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"system-ui, 'Liberation Sans', sans-serif\" font-size=\"13\">\n\
         <title>The phases of a step</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n\
         <text x=\"8\" y=\"22\" fill=\"#1b1f24\" font-weight=\"600\">on particles</text>\n\
         <text x=\"8\" y=\"222\" fill=\"#1b1f24\" font-weight=\"600\">on the grid</text>\n"
    );
    let pitch = (width - 16.0) / PHASES.len() as f64;
    let middle = |i: usize| 8.0 + pitch * (i as f64 + 0.5);
    let level = |on_particles: bool| if on_particles { 70.0 } else { 150.0 };
    for (i, pair) in PHASES.windows(2).enumerate() {
        let _ = writeln!(
            text,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#5b6570\" stroke-width=\"1.5\"/>",
            middle(i),
            level(pair[0].0),
            middle(i + 1),
            level(pair[1].0)
        );
    }
    for (i, (on_particles, name, result)) in PHASES.iter().enumerate() {
        let (x, y) = (middle(i), level(*on_particles));
        let fill = if *on_particles { "#f4c9a3" } else { "#9ecae6" };
        let _ = writeln!(
            text,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"30\" rx=\"4\" fill=\"{fill}\" stroke=\"#1b1f24\"/>\n\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"12\" fill=\"#1b1f24\">{name}</text>",
            x - 0.5 * pitch + 2.0,
            y - 15.0,
            pitch - 4.0,
            y + 4.0
        );
        let mut words: Vec<String> = vec![String::new()];
        for word in result.split(' ') {
            match words.last_mut() {
                Some(line) if line.len() + word.len() < 16 => {
                    if !line.is_empty() {
                        line.push(' ');
                    }
                    line.push_str(word);
                }
                _ => words.push(word.to_owned()),
            }
        }
        let first = if *on_particles { y - 35.0 } else { y + 30.0 };
        for (k, line) in words.iter().filter(|line| !line.is_empty()).enumerate() {
            let _ = writeln!(
                text,
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\" fill=\"#1b1f24\">{line}</text>",
                first + 13.0 * k as f64
            );
        }
    }
    text.push_str("</svg>\n");
    text
}
