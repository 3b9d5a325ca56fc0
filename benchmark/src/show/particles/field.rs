//! Fields of a frame: one number per particle by its name.

use crate::frames::Frame;
use std::fmt::Write as _;

/// Components of the stress in the order of the frames.
const STRESS: [&str; 6] = ["XX", "YY", "ZZ", "YZ", "XZ", "XY"];
/// Name of the equivalent stress, which frames with all components of the stress have.
const MISES: &str = "Mises stress";

/// One number per particle.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleField {
    /// Name and unit, for people.
    pub label: String,
    /// The numbers.
    pub values: Vec<f64>,
}

impl ParticleField {
    /// The field of this name. Upper and lower case are the same, and so are blanks and `_`. Of a vector it is the length, and
    /// with an axis behind the name the component.
    ///
    /// # Errors
    /// The names that there are.
    pub fn of(frame: &Frame, name: &str) -> Result<Self, String> {
        let wanted = plain(name);
        let mut all = fields(frame);
        let Some(place) = all.iter().position(|(known, _)| plain(known) == wanted) else {
            let mut text = format!("the frame has no field {name:?}; accepted: ");
            for (i, (known, _)) in all.iter().enumerate() {
                let _ = write!(text, "{}{known}", if i > 0 { ", " } else { "" });
            }
            if all.is_empty() {
                text.push_str("none, the frame holds positions alone");
            }
            return Err(text);
        };
        let (known, source) = all.swap_remove(place);
        let unit = unit(&known);
        let label = match unit {
            "" => known.clone(),
            unit => format!("{known} ({unit})"),
        };
        Ok(Self {
            values: source.values(frame),
            label,
        })
    }

    /// Least and largest of its values that are numbers; both zero where there is none.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let numbers = || self.values.iter().copied().filter(|v| v.is_finite());
        let low = numbers().fold(f64::INFINITY, f64::min);
        let high = numbers().fold(f64::NEG_INFINITY, f64::max);
        if low <= high { [low, high] } else { [0.0; 2] }
    }
}

/// Fields that are shown where nobody names one, the first that a frame has.
const USUAL: [&str; 3] = ["Displacement", "Velocity", "Pressure"];

/// The field that is shown where nobody names one: displacement, velocity or pressure, else the first one.
///
/// # Errors
/// The frame has none.
pub fn usual(frame: &Frame) -> Result<String, String> {
    let all = fields(frame);
    let names = || all.iter().map(|(name, _)| name.as_str());
    let found = USUAL
        .into_iter()
        .find(|usual| names().any(|name| name == *usual));
    let found = found.or_else(|| names().next());
    found
        .map(str::to_owned)
        .ok_or_else(|| "the frame holds positions alone, and no field".to_owned())
}

/// Source of the numbers of a field.
enum Source {
    /// An array of one component.
    Scalar(String),
    /// The length of a vector.
    Length(String),
    /// A component of a vector.
    Component(String, usize),
    /// The equivalent stress.
    Mises,
}

/// All fields by their names.
fn fields(frame: &Frame) -> Vec<(String, Source)> {
    let mut all = vec![];
    for (name, (components, _)) in &frame.arrays {
        match components {
            1 => all.push((name.clone(), Source::Scalar(name.clone()))),
            3 => {
                all.push((name.clone(), Source::Length(name.clone())));
                for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
                    let of_axis = format!("{name} {letter}");
                    all.push((of_axis, Source::Component(name.clone(), axis)));
                }
            }
            _ => {}
        }
    }
    if STRESS.iter().all(|s| frame.arrays.contains_key(&stress(s))) {
        all.push((MISES.to_owned(), Source::Mises));
    }
    all
}

fn stress(component: &str) -> String {
    format!("Stress_{component}")
}

impl Source {
    fn values(&self, frame: &Frame) -> Vec<f64> {
        let array = |name: &str| frame.arrays.get(name).map_or(&[][..], |(_, values)| values);
        match self {
            Self::Scalar(name) => array(name).to_vec(),
            Self::Length(name) => {
                let vectors = array(name).as_chunks::<3>().0.iter();
                let length = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
                vectors.map(length).collect()
            }
            Self::Component(name, axis) => {
                let vectors = array(name).as_chunks::<3>().0.iter();
                vectors.map(|v| v[*axis]).collect()
            }
            Self::Mises => {
                let s = STRESS.map(|component| array(&stress(component)));
                let mises = |p: usize| {
                    let [xx, yy, zz, yz, xz, xy] = s.map(|values| values[p]);
                    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
                    (0.5 * normal + 3.0 * (yz * yz + xz * xz + xy * xy)).sqrt()
                };
                (0..frame.points.len()).map(mises).collect()
            }
        }
    }
}

/// A name without regard to case, blanks and `_`.
fn plain(name: &str) -> String {
    let letters = name.chars().filter(|c| !" _.-".contains(*c));
    letters.flat_map(char::to_lowercase).collect()
}

/// Unit of a field of our own frames, by its name; empty where the name tells none.
fn unit(name: &str) -> &'static str {
    let begins = |word: &str| name.starts_with(word);
    if begins("Displacement") {
        "m"
    } else if begins("Velocity") {
        "m/s"
    } else if begins("Stress_") || name == "Pressure" || name == MISES {
        "Pa"
    } else if begins("External Force") {
        "N"
    } else {
        match name {
            "Mass" => "kg",
            "Volume" => "m³",
            "Density" => "kg/m³",
            "plastic work" | "algorithmic work" | "viscous work" => "J/m³",
            _ => "",
        }
    }
}
