//! A manufactured problem as JSON. No scene file can say a body force of each particle, so a problem has a form of its own.

use crate::exit::Failure;
use proctor_kernel::{transfers, weighting};
use proctor_scene::{StressScheme, TransferKind, Weighting};
use proctor_verification::mill::draw;
use proctor_verification::mill::material::{Kind, Material};
use proctor_verification::mill::motion::{Bubble, Field, Motion};
use proctor_verification::mill::problem::{
    COARSEST, Family, PARTICLES_PER_CELL, Problem, SHARE_OF_STEP,
};
use proctor_verification::settings::Method;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::path::Path;

/// Schemes by their words.
const SCHEMES: [(&str, StressScheme); 3] = [
    ("USL", StressScheme::Usl),
    ("MUSL", StressScheme::Musl),
    ("USF", StressScheme::Usf),
];

/// Most particles per cell and axis that a file may ask for.
const MOST_PARTICLES: usize = 8;
/// Finest mesh that a file may ask for, in cells per metre.
const FINEST: usize = 512;

/// A problem, in SI units.
pub fn write(problem: &Problem) -> Value {
    let (motion, material) = (&problem.motion, &problem.material);
    let axes = problem.axes();
    let bubble = match motion.field.bubble {
        Bubble::Cosine => json!("cosine"),
        Bubble::Power(n) => json!(n),
    };
    let mut written = json!({
        "name": problem.name,
        "family": problem.family.word(),
        "axes": axes,
        "end": problem.end,
        "friction": problem.friction,
        "ladder": problem.ladder,
        "method": {
            "weighting": problem.method.weighting_word(),
            "scheme": problem.method.scheme_word(),
            "transfer": problem.method.transfer_word(),
        },
        "motion": {
            "center": motion.center,
            "bubble": bubble,
            "polynomials": &motion.field.polynomials[..axes],
            "pulse": motion.pulse,
            "drift": motion.drift,
            "axis": motion.axis,
            "spin": motion.spin,
            "stretch": motion.stretch,
        },
        "material": {
            "law": material.kind.word(),
            "young": material.young,
            "poisson": material.poisson,
            "strength": material.strength,
            "hardening": material.hardening,
            "viscosity": material.viscosity,
            "density": material.density,
            "stress": material.stress,
        },
    });
    // As drawn they need no word.
    if problem.particles_per_cell != PARTICLES_PER_CELL {
        written["method"]["particles_per_cell"] = json!(problem.particles_per_cell);
    }
    if problem.share_of_step != SHARE_OF_STEP {
        written["method"]["share_of_step"] = json!(problem.share_of_step);
    }
    if problem.parts != [1; 3] {
        written["parts"] = json!(problem.parts);
    }
    written
}

/// Reads a problem.
///
/// # Errors
/// A file that is none, with the key at fault, or a problem that has no solution to converge to.
pub fn read(path: &Path) -> Result<Problem, Failure> {
    let at_fault = |reason: String| Failure::BadInput(format!("{}: {reason}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|e| at_fault(e.to_string()))?;
    let value: Value = serde_json::from_str(&text).map_err(|e| at_fault(e.to_string()))?;
    let mut problem = problem(&value).map_err(at_fault)?;
    problem.fastest = draw::solvable(&problem).map_err(at_fault)?;
    Ok(problem)
}

fn problem(value: &Value) -> Result<Problem, String> {
    let axes: usize = at(value, "axes")?;
    if !(2..=3).contains(&axes) {
        return Err(format!("`axes` is {axes}; accepted: 2 or 3"));
    }
    let ladder: Vec<usize> = at(value, "ladder")?;
    let fits = |cells: &usize| cells.is_multiple_of(COARSEST) && (1..=FINEST).contains(cells);
    if ladder.len() < 2 || !ladder.iter().all(fits) || !ladder.is_sorted_by(|a, b| a < b) {
        return Err(format!(
            "`ladder` is {ladder:?}; accepted: at least two rising multiples of {COARSEST} up to {FINEST}"
        ));
    }
    let bubble = match &value["motion"]["bubble"] {
        Value::String(word) if word == "cosine" => Bubble::Cosine,
        other => match other.as_u64() {
            Some(n @ 2..=16) => Bubble::Power(n as usize),
            _ => {
                return Err(format!(
                    "`motion.bubble` is {other}; accepted: \"cosine\" or a power from 2 to 16"
                ));
            }
        },
    };
    let mut polynomials = [[0.0; 10]; 3];
    let given: Vec<[f64; 10]> = at(value, "motion.polynomials")?;
    if given.len() != axes {
        return Err(format!(
            "`motion.polynomials` has {} rows; accepted: one for each of {axes} axes",
            given.len()
        ));
    }
    polynomials[..axes].copy_from_slice(&given);
    let end: f64 = at(value, "end")?;
    if !(end.is_finite() && end > 0.0) {
        return Err(format!("`end` is {end}; accepted: a positive number [s]"));
    }
    let motion = Motion {
        center: at(value, "motion.center")?,
        field: Field {
            axes,
            bubble,
            polynomials,
        },
        pulse: at(value, "motion.pulse")?,
        drift: at(value, "motion.drift")?,
        axis: at(value, "motion.axis")?,
        spin: at(value, "motion.spin")?,
        stretch: at(value, "motion.stretch")?,
    };
    stays_in_plane(&motion)?;
    Ok(Problem {
        name: at(value, "name")?,
        family: word(
            value,
            "family",
            &Family::ALL.map(|family| (family.word(), family)),
        )?,
        motion,
        material: material(value)?,
        friction: or_zero(value, "friction", "a number that is not negative")?,
        end,
        method: method(value)?,
        particles_per_cell: particles_per_cell(value)?,
        share_of_step: share_of_step(value)?,
        ladder,
        parts: parts(value)?,
        fastest: 0.0,
    })
}

/// Looks at the direction of the turn, and that a motion of the plane has no part across it.
fn stays_in_plane(motion: &Motion) -> Result<(), String> {
    let length = motion.axis.iter().map(|x| x * x).sum::<f64>();
    if (length - 1.0).abs() > 1e-9 {
        return Err("`motion.axis` is no unit vector".to_owned());
    }
    let stretch = &motion.stretch;
    let across = [
        motion.center[2],
        motion.drift[2],
        motion.axis[0],
        motion.axis[1],
    ];
    let across = across
        .into_iter()
        .chain(stretch[2])
        .chain([stretch[0][2], stretch[1][2]]);
    if motion.axes() == 2 && across.into_iter().any(|x| x != 0.0) {
        return Err("`motion` has a part across the plane; accepted: `axis` along z and no third component of `center`, \
                    `drift` and `stretch`"
            .to_owned());
    }
    Ok(())
}

fn material(value: &Value) -> Result<Material, String> {
    let of = |key: &str, accepted: &str, fits: fn(f64) -> bool| {
        let found: f64 = at(value, &format!("material.{key}"))?;
        if fits(found) {
            Ok(found)
        } else {
            Err(format!("`material.{key}` is {found}; accepted: {accepted}"))
        }
    };
    let positive = |x: f64| x > 0.0;
    Ok(Material {
        kind: word(
            value,
            "material.law",
            &Kind::ALL.map(|kind| (kind.word(), kind)),
        )?,
        young: of("young", "a positive number [Pa]", positive)?,
        poisson: of("poisson", "a number from 0 to 0.49", |x| {
            (0.0..=0.49).contains(&x)
        })?,
        strength: of("strength", "a positive number [Pa]", positive)?,
        hardening: of("hardening", "a number that is not negative [Pa]", |x| {
            x >= 0.0
        })?,
        viscosity: or_zero(
            value,
            "material.viscosity",
            "a number that is not negative [Pa s]",
        )?,
        density: of("density", "a positive number [kg/m³]", positive)?,
        stress: at(value, "material.stress")?,
    })
}

fn method(value: &Value) -> Result<Method, String> {
    let weightings: Vec<(&str, Weighting)> = (weighting::ALL.iter())
        .map(|kind| (kind.name, kind.weighting))
        .collect();
    let transfers: Vec<(&str, TransferKind)> = (transfers::ALL.iter())
        .map(|kind| (kind.word, kind.transfer))
        .collect();
    Ok(Method {
        weighting: word(value, "method.weighting", &weightings)?,
        scheme: word(value, "method.scheme", &SCHEMES)?,
        transfer: word(value, "method.transfer", &transfers)?,
    })
}

/// Particles per cell and axis; those of drawn problems where a file has none.
fn particles_per_cell(value: &Value) -> Result<usize, String> {
    let found = at::<Option<usize>>(value, "method.particles_per_cell")?;
    match found.unwrap_or(PARTICLES_PER_CELL) {
        count @ 1..=MOST_PARTICLES => Ok(count),
        count => Err(format!(
            "`method.particles_per_cell` is {count}; accepted: 1 to {MOST_PARTICLES}"
        )),
    }
}

/// Cells on each axis for one of the ladder; one where a file has none.
fn parts(value: &Value) -> Result<[usize; 3], String> {
    let found = at::<Option<[usize; 3]>>(value, "parts")?.unwrap_or([1; 3]);
    if found.iter().all(|count| (1..=2).contains(count)) {
        Ok(found)
    } else {
        Err(format!(
            "`parts` is {found:?}; accepted: 1 or 2 on each axis"
        ))
    }
}

/// Share of the largest stable step; that of drawn problems where a file has none.
fn share_of_step(value: &Value) -> Result<f64, String> {
    let found = at::<Option<f64>>(value, "method.share_of_step")?.unwrap_or(SHARE_OF_STEP);
    if found > 0.0 && found <= 1.0 {
        Ok(found)
    } else {
        Err(format!(
            "`method.share_of_step` is {found}; accepted: above 0, up to 1"
        ))
    }
}

/// The number at a key that a problem of another kind lacks; 0 where it is not there.
fn or_zero(value: &Value, key: &str, accepted: &str) -> Result<f64, String> {
    let found = at::<Option<f64>>(value, key)?.unwrap_or(0.0);
    if found >= 0.0 {
        Ok(found)
    } else {
        Err(format!("`{key}` is {found}; accepted: {accepted}"))
    }
}

/// The value at a key, whose parts are joined by dots.
fn at<T: DeserializeOwned>(value: &Value, key: &str) -> Result<T, String> {
    let found = key.split('.').fold(value, |value, part| &value[part]);
    serde_json::from_value(found.clone()).map_err(|e| format!("`{key}`: {e}"))
}

/// The thing that a word at a key stands for.
fn word<T: Copy>(value: &Value, key: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found: String = at(value, key)?;
    let thing = known.iter().find(|(word, _)| *word == found);
    thing.map(|(_, thing)| *thing).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        format!("`{key}` is {found:?}; accepted: {}", words.join(", "))
    })
}
