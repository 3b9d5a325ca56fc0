//! Writes the output of a made-up run, for `scripts/check-frames.py` and for a look in `ParaView`.
//!
//! ```text
//! cargo run -p proctor-files --example frames -- target/frames
//! python3 scripts/check-frames.py target/frames/raw --expect 'Velocity:7:2=-1.9620000000000002+-1e-12'
//! ```
//!
//! Two bodies, a block and a line of particles, fall freely from rest. Three folders: `raw` and `zlib` hold the
//! same numbers, `empty` a run from which all particles have gone.

use proctor_files::output::{
    Array, ArrayData, Compression, Frame, HistoryWriter, OutputError, OutputFolder, Series,
};

const GRAVITY: f64 = 9.81;
const FRAMES: u64 = 5;
const TIME_BETWEEN_FRAMES: f64 = 0.05;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(folder) = std::env::args_os().nth(1).map(std::path::PathBuf::from) else {
        return Err("usage: frames FOLDER".into());
    };
    falling(&folder.join("raw"), Compression::None)?;
    falling(&folder.join("zlib"), Compression::Zlib(3))?;
    for (name, compression) in [
        ("empty", Compression::None),
        ("empty_zlib", Compression::Zlib(3)),
    ] {
        let mut series = Series::create(OutputFolder::create(folder.join(name))?, compression)?;
        series.write_frame(&frame(&[], 0.0, 0))?;
    }
    Ok(())
}

/// A particle as this example knows it: position \[m\] at the start, and body.
type Particle = ([f64; 3], i64);

fn particles() -> Vec<Particle> {
    let block = (0..1000).map(|i| {
        let [x, y, z] = [i % 10, i / 10 % 10, i / 100].map(|i| 0.05 + 0.1 * f64::from(i));
        ([x, y, z], 0)
    });
    let line = (0..10).map(|i| ([3.0, 0.1 * f64::from(i), 0.5], 1));
    block.chain(line).collect()
}

fn falling(folder: &std::path::Path, compression: Compression) -> Result<(), OutputError> {
    let particles = particles();
    let folder = OutputFolder::create(folder)?;
    let columns: Vec<String> = (0..2)
        .flat_map(|body| ["mass", "x", "y", "z"].map(|name| format!("body{body}_{name}")))
        .collect();
    let mut history = HistoryWriter::create(&folder, &columns)?;
    let mut series = Series::create(folder, compression)?;
    for number in 0..FRAMES {
        let time = TIME_BETWEEN_FRAMES * number as f64;
        let frame = frame(&particles, time, 100 * number);
        series.write_frame(&frame)?;
        let mut row = Vec::new();
        for body in 0..2 {
            let points: Vec<_> = frame
                .points
                .iter()
                .zip(&particles)
                .filter(|(_, p)| p.1 == body)
                .collect();
            let count = points.len() as f64;
            row.push(count * mass(body));
            row.extend(
                (0..3).map(|axis| points.iter().map(|(point, _)| point[axis]).sum::<f64>() / count),
            );
        }
        history.append(time, frame.step, &row)?;
    }
    Ok(())
}

fn mass(body: i64) -> f64 {
    if body == 0 { 1.5 } else { 2.5 }
}

fn frame(particles: &[Particle], time: f64, step: u64) -> Frame {
    let fall = [0.0, 0.0, -0.5 * GRAVITY * time * time];
    let scalar =
        |of: &dyn Fn(&Particle) -> f64| ArrayData::Scalar(particles.iter().map(of).collect());
    let mut arrays = vec![
        Array::new(
            "Particle Id",
            ArrayData::Integer((0..particles.len() as i64).collect()),
        ),
        Array::new(
            "Body Id",
            ArrayData::Integer(particles.iter().map(|p| p.1).collect()),
        ),
        Array::new("Mass", scalar(&|p| mass(p.1))),
        Array::new(
            "Displacement",
            ArrayData::Vector(vec![fall; particles.len()]),
        ),
        Array::new(
            "Velocity",
            ArrayData::Vector(vec![[0.0, 0.0, -GRAVITY * time]; particles.len()]),
        ),
    ];
    for (name, factor) in [
        ("XX", 1.0),
        ("YY", 2.0),
        ("ZZ", 3.0),
        ("XY", 4.0),
        ("YZ", 5.0),
        ("XZ", 6.0),
    ] {
        arrays.push(Array::new(
            format!("Stress_{name}"),
            scalar(&|p| factor * (p.0[0] - p.0[2])),
        ));
    }
    let points = particles
        .iter()
        .map(|(x, _)| [x[0] + fall[0], x[1] + fall[1], x[2] + fall[2]])
        .collect();
    Frame {
        time,
        step,
        points,
        arrays,
        lines: vec![],
    }
}
