//! Charts as structure: well-formed, readable without eyes, complete, nothing outside, nothing over an axis.

use proctor_benchmark::show::chart::{
    Axis, Chart, Colour, Entry, Format, Mark, Point, Scale, Series, Strength, Stroke,
};
use proctor_benchmark::show::figures;
use proctor_verification::case::{Curve, CurvePoint, Drawing};
use proctor_verification::convergence::{ConvergenceTable, Row};
use quick_xml::Reader;
use quick_xml::events::Event;
use std::collections::BTreeMap;

/// An element: name, attributes, text, whether it lies in a group of marks.
#[derive(Debug)]
struct Element {
    name: String,
    attributes: BTreeMap<String, String>,
    text: String,
}

impl Element {
    fn number(&self, key: &str) -> f64 {
        self.attributes[key].parse().expect("a number")
    }
}

/// All elements of a document in order, and a copy of it where people can look at it.
fn elements(name: &str, svg: &str) -> Vec<Element> {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join(format!("{name}.svg")), svg).expect("a copy");
    let mut reader = Reader::from_str(svg);
    let (mut all, mut open): (Vec<Element>, Vec<usize>) = (vec![], vec![]);
    loop {
        match reader.read_event().expect("well-formed XML") {
            Event::Start(tag) => {
                open.push(all.len());
                all.push(element(&tag));
            }
            Event::Empty(tag) => all.push(element(&tag)),
            Event::Text(text) => {
                if let Some(&i) = open.last() {
                    all[i].text += &text.decode().expect("UTF-8");
                }
            }
            Event::GeneralRef(_) => {
                if let Some(&i) = open.last() {
                    all[i].text.push('?');
                }
            }
            Event::End(_) => drop(open.pop()),
            Event::Eof => return all,
            _ => {}
        }
    }
}

fn element(tag: &quick_xml::events::BytesStart<'_>) -> Element {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Element {
        name: text(tag.name().as_ref()),
        attributes: tag
            .attributes()
            .map(|a| a.expect("an attribute"))
            .map(|a| (text(a.key.as_ref()), text(&a.value)))
            .collect(),
        text: String::new(),
    }
}

/// Checks that hold for every chart; returns its elements.
fn sound(name: &str, chart: &Chart) -> Vec<Element> {
    let svg = chart.to_svg();
    let all = elements(name, &svg);
    for value in all.iter().flat_map(|e| e.attributes.values()) {
        assert!(!value.contains("NaN") && !value.contains("inf"), "{value}");
    }
    assert_eq!(all[0].name, "svg");
    assert_eq!(all[0].attributes["role"], "img");
    assert_eq!(all[1].name, "title");
    assert_eq!(all[2].name, "desc");
    assert!(!all[1].text.is_empty() && !all[2].text.is_empty());
    // Every word of the title stands in the chart as well.
    for word in all[1].text.split_whitespace() {
        assert!(
            all.iter()
                .any(|e| e.name == "text" && e.text.contains(word)),
            "{word}"
        );
    }
    let size: Vec<f64> = all[0].attributes["viewBox"]
        .split(' ')
        .map(|n| n.parse().expect("a number"))
        .collect();
    for e in all.iter().filter(|e| e.name == "text") {
        let (x, y) = (e.number("x"), e.number("y"));
        // Half the size per letter is a lower bound for the mean of a sans-serif.
        let wide = 0.5 * e.number("font-size") * e.text.chars().count() as f64;
        let [left, right] = match e
            .attributes
            .get("text-anchor")
            .map_or("start", String::as_str)
        {
            "start" => [x, x + wide],
            "end" => [x - wide, x],
            _ => [x - 0.5 * wide, x + 0.5 * wide],
        };
        assert!(left >= 0.0 && right <= size[2], "{e:?}");
        assert!(y > 0.0 && y < size[3], "{e:?}");
        // 10 pixels where the chart is 400 pixels wide, 9 for the labels of slopes.
        assert!(e.number("font-size") * 400.0 / size[2] > 9.0, "{e:?}");
    }
    let titles = all.iter().filter(|e| e.name == "title").count() - 1;
    let points: usize = chart
        .series
        .iter()
        .filter(|s| s.mark != Mark::None)
        .map(|s| s.points.len())
        .sum();
    assert_eq!(titles, points, "every point says what it is");
    all
}

/// Ticks of the vertical axis: texts that end left of the plot.
fn texts(all: &[Element]) -> Vec<&str> {
    let texts = all.iter().filter(|e| e.name == "text");
    texts.map(|e| e.text.as_str()).collect()
}

fn points(values: &[(f64, Option<f64>)]) -> Vec<Point> {
    let title = |x: f64, y: Option<f64>| format!("x = {x}, y = {y:?} <&>");
    values
        .iter()
        .map(|&(x, y)| Point {
            x,
            y,
            title: title(x, y),
        })
        .collect()
}

fn logarithmic(series: Vec<Series>) -> Chart {
    let axis = |format| Axis {
        label: "a quantity & its unit".to_owned(),
        scale: Scale::Log,
        format,
    };
    Chart {
        equal: false,
        title: "errors < 1 & more of a title that is too long for one line of the chart".to_owned(),
        description: "what can be seen".to_owned(),
        x: axis(Format::Seconds),
        y: axis(Format::Percent),
        series,
        guides: vec![],
        legend: vec![],
    }
}

fn series(mark: Mark, values: &[(f64, Option<f64>)]) -> Series {
    Series {
        colour: Colour::Hue(0),
        mark,
        stroke: Stroke::Solid,
        strength: Strength::Plain,
        points: points(values),
    }
}

#[test]
fn failed_runs_are_open_marks_and_break_the_line() {
    let values = [
        (0.01, Some(0.1)),
        (0.1, None),
        (1.0, Some(0.01)),
        (2.0, Some(f64::NAN)),
        (3.0, Some(-1.0)),
    ];
    let mut chart = logarithmic(vec![series(Mark::Square, &values)]);
    chart.legend.push(Entry {
        label: "failed <run>".to_owned(),
        colour: Colour::Ink,
        mark: Mark::Circle,
        stroke: Stroke::None,
        strength: Strength::Plain,
        open: true,
    });
    let all = sound("failed", &chart);
    let marks = |class: &str| {
        all.iter()
            .filter(|e| e.name == "rect")
            .filter(|e| {
                e.attributes
                    .get("class")
                    .is_some_and(|c| c.ends_with(class))
            })
            .count()
    };
    assert_eq!(marks("hue0 mark"), 2);
    assert_eq!(marks("hue0 open"), 3);
    assert!(texts(&all).contains(&"failed"));
    let line = all
        .iter()
        .find(|e| e.attributes.get("class").is_some_and(|c| c == "hue0 line"))
        .expect("a line");
    assert_eq!(line.attributes["d"].matches('M').count(), 2);
    assert_eq!(line.attributes["d"].matches('L').count(), 0);
}

#[test]
fn marks_stay_inside_the_plot_and_numbers_apart() {
    for decades in [0.1, 1.0, 3.0, 9.0, 14.0] {
        let values: Vec<(f64, Option<f64>)> = (0..8)
            .map(|i| f64::from(i) / 7.0 * decades)
            .map(|d| (10f64.powf(d - 4.0), Some(10f64.powf(-d))))
            .collect();
        let all = sound("decades", &logarithmic(vec![series(Mark::Circle, &values)]));
        let frame = all
            .iter()
            .find(|e| e.attributes.get("class").is_some_and(|c| c == "frame"))
            .expect("a frame");
        let numbers: Vec<f64> = frame.attributes["d"]
            .split(|c: char| "MVH ".contains(c))
            .filter(|n| !n.is_empty())
            .map(|n| n.parse().expect("a number"))
            .collect();
        let [left, top, bottom, right] = numbers[..] else {
            panic!("{numbers:?}")
        };
        for e in all.iter().filter(|e| e.name == "circle") {
            let (x, y) = (e.number("cx"), e.number("cy"));
            assert!(
                (left..=right).contains(&x) && (top..=bottom).contains(&y),
                "{e:?}"
            );
        }
        // Numbers of the horizontal axis stand in one row, one after the other.
        let mut row: Vec<&Element> = all
            .iter()
            .filter(|e| {
                e.name == "text"
                    && e.attributes
                        .get("text-anchor")
                        .is_some_and(|a| a == "middle")
            })
            .collect();
        row.pop();
        assert!(row.len() >= 2, "{decades}");
        for pair in row.windows(2) {
            let half = |e: &Element| 0.25 * e.number("font-size") * e.text.chars().count() as f64;
            let gap = pair[1].number("x") - pair[0].number("x");
            assert!(gap > half(pair[0]) + half(pair[1]), "{pair:?}");
            assert!(pair[0].number("y") > bottom);
        }
    }
}

/// Letters of the title are bold: in DejaVu Sans, the widest of the fonts asked for, this one would lose its end.
#[test]
fn a_title_that_is_too_long_in_bold_is_broken() {
    let title = "inclined-two-blocks: error of the acceleration against run time";
    let chart = Chart {
        title: title.to_owned(),
        ..logarithmic(vec![series(Mark::Circle, &[(1.0, Some(0.1))])])
    };
    let all = sound("long title", &chart);
    let texts = texts(&all);
    assert!(texts.iter().all(|text| *text != title), "{texts:?}");
}

#[test]
fn nothing_to_show_is_still_a_chart() {
    sound("empty", &logarithmic(vec![]));
    sound(
        "one",
        &logarithmic(vec![series(Mark::Diamond, &[(1.0, Some(0.5))])]),
    );
}

#[test]
fn a_convergence_plot_has_a_line_per_quantity_and_slopes() {
    let mut table = ConvergenceTable::new(["displacement", "stress"]);
    for (n, stress) in [(8.0, 0.2), (16.0, 0.1), (32.0, f64::NAN), (64.0, 0.025)] {
        let h: f64 = 1.0 / n;
        let row = Row {
            h,
            errors: vec![2.0 * h * h, stress],
            particles: 1,
            steps: 1,
        };
        table.push(row).expect("two errors");
    }
    let all = sound(
        "convergence",
        &figures::convergence("box under a load", &table),
    );
    let texts = texts(&all);
    for text in ["order 1", "order 2", "displacement", "stress", "failed"] {
        assert!(texts.contains(&text), "{text}: {texts:?}");
    }
    assert!(
        all[2].text.contains("displacement falls with order 2.00"),
        "{}",
        all[2].text
    );
}

#[test]
fn a_curve_shows_exact_as_line_and_computed_as_dots() {
    let curve = Curve {
        title: "settlement on the axis".to_owned(),
        abscissa: "z (m)",
        ordinate: "u_z (m)",
        points: (0..20)
            .map(|i| f64::from(i) / 20.0)
            .map(|z| CurvePoint {
                at: z,
                computed: -1.02e-8 * z * z,
                exact: -1e-8 * z * z,
            })
            .collect(),
    };
    let all = sound("curve", &figures::curve(&curve));
    assert_eq!(all.iter().filter(|e| e.name == "circle").count(), 20 + 1);
    assert!(
        texts(&all).iter().any(|t| t.contains("10⁻⁹")),
        "the power of ten is said"
    );
}

#[test]
fn a_curve_without_anything_exact_is_a_line_alone() {
    let point = |at: f64, computed: f64| CurvePoint {
        at,
        computed,
        exact: f64::NAN,
    };
    let curve = Curve {
        title: "force on the plate".to_owned(),
        abscissa: "way (m)",
        ordinate: "force (N)",
        points: vec![
            point(0.0, 0.0),
            point(1.0, 10.0),
            point(f64::NAN, f64::NAN),
            point(0.0, 3.0),
            point(1.0, 4.0),
        ],
    };
    let all = sound("curve alone", &figures::curve(&curve));
    assert!(!texts(&all).contains(&"exact"));
    assert!(texts(&all).contains(&"computed"));
}

#[test]
fn a_drawing_keeps_the_shape_of_bodies() {
    for [width, height] in [[10.0, 13.0], [40.0, 3.0]] {
        let square = vec![[1.0, 1.0], [2.5, 1.0], [2.5, 2.5], [1.0, 2.5]];
        let drawing = Drawing {
            title: "a block on the floor".to_owned(),
            bodies: vec![square],
            lines: vec![
                vec![[width, 0.0], [0.0, 0.0]],
                vec![[0.0, 0.0], [0.0, height]],
            ],
        };
        let all = sound("drawing", &figures::drawing(&drawing));
        let lines = all.iter().filter(|e| e.name == "path");
        let mut lines = lines.filter(|e| e.attributes["class"].ends_with(" line"));
        let outline = &lines.next().expect("the block").attributes["d"];
        let numbers: Vec<f64> = outline
            .split(['M', 'L', ' '])
            .filter_map(|n| n.parse().ok())
            .collect();
        let range = |from: usize| {
            let along = || numbers.iter().skip(from).step_by(2);
            along().fold(f64::MIN, |m, x| m.max(*x)) - along().fold(f64::MAX, |m, x| m.min(*x))
        };
        assert_eq!(numbers.len(), 10, "closed");
        assert!((range(0) - range(1)).abs() < 0.25, "{outline}");
        let rigid = lines.filter(|e| e.attributes["d"].contains('L'));
        assert_eq!(rigid.count(), 2, "those of the legend have no corner");
    }
}

#[test]
fn bars_begin_at_zero_and_carry_name_and_value() {
    let values = [
        ("1 thread".to_owned(), 100.0),
        ("2 threads, longer name".to_owned(), 53.0),
        ("another".to_owned(), 12.5),
    ];
    let all = sound(
        "bars",
        &figures::bars("speed", "ns per particle and step", &values),
    );
    let bars: Vec<&Element> = all
        .iter()
        .filter(|e| e.name == "rect")
        .filter(|e| {
            e.attributes
                .get("class")
                .is_some_and(|c| c.ends_with("hue0 mark"))
        })
        .collect();
    assert_eq!(bars.len(), 3);
    let scale = bars[0].number("width") / 100.0;
    for (bar, (name, value)) in bars.iter().zip(&values) {
        assert!((bar.number("width") - scale * value).abs() < 0.2);
        assert_eq!(bar.number("x"), bars[0].number("x"));
        assert!(texts(&all).contains(&name.as_str()));
    }
    for value in ["100", "53", "12.5"] {
        assert!(texts(&all).contains(&value), "{value}");
    }
}
