//! The chart of one error of several cases, each with its own method, against run time.

use super::precision::point;
use crate::precision::CaseStudy;
use crate::precision::findings::LEVELS;
use crate::show::chart::{
    Axis, Chart, Colour, Entry, Format, Guide, Mark, Scale, Series, Strength, Stroke,
};
use crate::show::percent;

/// Marks of the cases.
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Square, Mark::Triangle, Mark::Diamond];

/// An error of several cases against run time, one line per method of each, with the first of the levels that have a cost. Of
/// each case the number of the measure.
#[must_use]
pub fn cases_beside(of: &[(&CaseStudy, usize)], word: &str) -> Chart {
    let (mut series, mut legend) = (vec![], vec![]);
    for (i, (studied, measure)) in of.iter().enumerate() {
        let (colour, mark) = (Colour::Hue(i), MARKS[i % MARKS.len()]);
        for line in &studied.plan.lines {
            let points = line.path.iter();
            series.push(Series {
                colour,
                mark,
                stroke: Stroke::Solid,
                strength: Strength::Plain,
                points: points
                    .filter_map(|i| point(studied, *measure, *i))
                    .collect(),
            });
            legend.push(Entry {
                label: format!("{}, {}", studied.study.name(), line.method),
                colour,
                mark,
                stroke: Stroke::Solid,
                strength: Strength::Plain,
                open: false,
            });
        }
    }
    let times = series.iter().flat_map(|s| s.points.iter().map(|p| p.x));
    let (first, last) = times.fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), x| {
        (least.min(x), most.max(x))
    });
    let names = of.iter().map(|(studied, _)| studied.study.name());
    let names = names.collect::<Vec<_>>().join(" and ");
    let level = LEVELS[0];
    let guides = if first < last {
        vec![Guide {
            from: [first, level],
            to: [last, level],
            label: percent(level),
        }]
    } else {
        vec![]
    };
    Chart {
        equal: false,
        title: format!("{names}: error of the {word} against run time"),
        description:
            "Relative error over run time, both logarithmic; each line refines the mesh of a case."
                .to_owned(),
        x: Axis {
            label: of.first().map_or_else(String::new, |(studied, _)| {
                studied.seconds_words().to_owned()
            }),
            scale: Scale::Log,
            format: Format::Seconds,
        },
        y: Axis {
            label: format!("relative error of the {word}"),
            scale: Scale::Log,
            format: Format::Percent,
        },
        guides,
        legend,
        series,
    }
}
