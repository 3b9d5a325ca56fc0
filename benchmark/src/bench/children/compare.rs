//! The distance of the last frame of a solver from the exact solution, or from another frame.

use crate::bench::scenes::Exact;
use crate::frames::Frame;
use crate::show::number;
use std::collections::HashMap;

/// Name of the array of displacements \[m\] in frames, as the manuals' program writes it.
const DISPLACEMENT: &str = "Displacement";
/// Grid, in cells, on which starting points of two solvers are matched.
const MATCH: f64 = 1e-3;
/// Share of a step by which the times of two frames may differ: labels are often printed with six digits.
const SAME_TIME: f64 = 0.01;

/// Relative L2 error of the displacement: sqrt(sum |u - u_exact|² / sum |u_exact|²) over the particles, u_exact at
/// where each began, x - u.
///
/// # Errors
/// If the frame has no displacements.
pub fn error(frame: &Frame, exact: &Exact, time: f64) -> Result<f64, String> {
    let u = displacements(frame)?;
    let (mut wrong, mut right) = (0.0, 0.0);
    for (x, u) in frame.points.iter().zip(&u) {
        let start = std::array::from_fn(|axis| x[axis] - u[axis]);
        let truth = exact(&start, time);
        for axis in 0..3 {
            wrong += (u[axis] - truth[axis]).powi(2);
            right += truth[axis].powi(2);
        }
    }
    finite((wrong / right).sqrt(), "the exact solution does not move")
}

/// True if two frames that know the times of their particles are of one time, to a hundredth of a step \[s\].
///
/// # Errors
/// The two times.
pub fn same_time(frame: &Frame, reference: &Frame, step: f64) -> Result<(), String> {
    match (frame.time, reference.time) {
        (Some(time), Some(other)) if (time - other).abs() > SAME_TIME * step => Err(format!(
            "frames of different times: {} s, the reference {} s, a step {} s",
            number(time),
            number(other),
            number(step)
        )),
        _ => Ok(()),
    }
}

/// Relative L2 difference of the displacements of two frames, particle by particle, each known by where it began, on a
/// mesh of cells of `cell` (m) and with steps of `step` (s).
///
/// # Errors
/// If the frames are of different times, a frame has no displacements, or the particles did not begin at the same places.
pub fn difference(frame: &Frame, reference: &Frame, cell: f64, step: f64) -> Result<f64, String> {
    same_time(frame, reference, step)?;
    let (u, u_reference) = (displacements(frame)?, displacements(reference)?);
    if frame.points.len() != reference.points.len() {
        return Err(format!(
            "{} particles where the reference has {}",
            frame.points.len(),
            reference.points.len()
        ));
    }
    let place = |x: &[f64; 3], u: &[f64; 3]| -> [i64; 3] {
        std::array::from_fn(|axis| ((x[axis] - u[axis]) / (MATCH * cell)).round() as i64)
    };
    let known: HashMap<[i64; 3], &[f64; 3]> = reference
        .points
        .iter()
        .zip(&u_reference)
        .map(|(x, u)| (place(x, u), u))
        .collect();
    let (mut wrong, mut right) = (0.0, 0.0);
    for (x, u) in frame.points.iter().zip(&u) {
        let here = place(x, u);
        // A starting point may be rounded to either side.
        let other = neighbours(here)
            .find_map(|near| known.get(&near))
            .ok_or_else(|| {
                format!("no particle of the reference began where that at {x:?} m did")
            })?;
        for axis in 0..3 {
            wrong += (u[axis] - other[axis]).powi(2);
            right += other[axis].powi(2);
        }
    }
    if wrong == 0.0 {
        return Ok(0.0);
    }
    finite((wrong / right).sqrt(), "the reference does not move")
}

fn neighbours([i, j, k]: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let mut steps = [0, -1, 1].into_iter().flat_map(|a| {
        [0, -1, 1]
            .into_iter()
            .flat_map(move |b| [0, -1, 1].into_iter().map(move |c| [a, b, c]))
    });
    std::iter::from_fn(move || steps.next().map(|[a, b, c]| [i + a, j + b, k + c]))
}

pub(super) fn displacements(frame: &Frame) -> Result<Vec<[f64; 3]>, String> {
    frame.vectors(DISPLACEMENT).ok_or_else(|| {
        let found: Vec<&str> = frame.arrays.keys().map(String::as_str).collect();
        format!(
            "no point data `{DISPLACEMENT}` of 3 components; found: {}",
            found.join(", ")
        )
    })
}

fn finite(value: f64, otherwise: &str) -> Result<f64, String> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(otherwise.to_owned())
    }
}
