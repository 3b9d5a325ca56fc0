//! The whole state of a simulation in a checkpoint, bit by bit.

use super::RunError;
use crate::mortar::PointIn;
use crate::mortar::elements::Elements;
use crate::output::{Checkpoint, CheckpointError};
use crate::particles::Layout;
use crate::scene::{Results, Scene};
use crate::simulation::{Boundaries, Event, EventKind, ParticleAt, Simulation};
use crate::stage::g2p::Found;

/// Fingerprint of what a scene simulates: not its name, its end, its outputs or its threads, which a restart may
/// change.
pub(super) fn fingerprint(scene: &Scene) -> u64 {
    let what = Scene {
        name: String::new(),
        time: 0.0,
        results: Results {
            print: 0,
            fields: vec![],
            nodal_fields: vec![],
            checkpoint: false,
        },
        probes: vec![],
        threads: None,
        ..scene.clone()
    };
    // FNV-1a over the text of all values; f64 prints so that it reads back to the same bits.
    format!("{what:?}")
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

/// The state as a checkpoint.
pub(super) fn save(simulation: &Simulation) -> Checkpoint {
    let mut checkpoint = Checkpoint::new(fingerprint(&simulation.scene));
    let clock = &simulation.clock;
    let ledger = &simulation.ledger;
    checkpoint.push::<u64>(
        "counters",
        vec![
            clock.step,
            simulation.stencil as u64,
            simulation.groups.sorted as u64,
            simulation.groups.superfluous as u64,
        ],
    );
    checkpoint.push::<f64>(
        "numbers",
        vec![
            clock.time,
            clock.dt_before,
            clock.dt_min,
            clock.dt_max,
            clock.dt_critical,
            simulation.travel,
            simulation.relaxation.last[0],
            simulation.relaxation.last[1],
            ledger.external_work,
            ledger.dead_load_origin,
            ledger.initial_energy,
            simulation.mesh_shift[0],
            simulation.mesh_shift[1],
            simulation.mesh_shift[2],
        ],
    );
    for (i, (set, body)) in simulation.sets.iter().zip(&simulation.bodies).enumerate() {
        let found = &body.found;
        checkpoint.push::<f64>(
            format!("set{i}/found"),
            vec![
                found.speed_squared,
                found.stiffness,
                found.travel,
                found.half_length,
            ],
        );
        checkpoint.push::<u64>(format!("set{i}/id"), set.id.clone());
        checkpoint.push::<u64>(
            format!("set{i}/layers"),
            set.layers.iter().map(|&l| l as u64).collect(),
        );
        for (c, column) in set.columns.iter().enumerate() {
            checkpoint.push::<f64>(format!("set{i}/column{c}"), column.clone());
        }
    }
    let contact = &simulation.contact;
    if !contact.pairs.is_empty() {
        let near = contact.near.iter().map(|&near| u64::from(near)).collect();
        checkpoint.push::<u64>("contact/near", near);
        let forces = contact.forces.as_flattened().to_vec();
        checkpoint.push::<f64>("contact/forces", forces);
    }
    save_mortar(simulation, &mut checkpoint);
    if let Some(surfaces) = &simulation.surfaces {
        let flat =
            |impulses: &[Vec<[f64; 3]>]| impulses.iter().flatten().flatten().copied().collect();
        checkpoint.push::<f64>("surfaces/kick", vec![surfaces.last_kick]);
        checkpoint.push::<f64>("surfaces/last", flat(&surfaces.last));
        checkpoint.push::<f64>("surfaces/total", flat(&surfaces.total));
    }
    save_events(simulation, &mut checkpoint);
    checkpoint
}

/// Vertices with their last displacement, and the slip of each pair: what mortar contact remembers.
fn save_mortar(simulation: &Simulation, checkpoint: &mut Checkpoint) {
    save_boundaries(&simulation.mortar.plane, "mortar", checkpoint);
    save_boundaries(&simulation.mortar.space, "mortar/space", checkpoint);
}

fn save_boundaries<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    boundaries: &Boundaries<B, D, N, T>,
    name: &str,
    checkpoint: &mut Checkpoint,
) {
    let flat = |points: &[PointIn<D>]| points.iter().flatten().copied().collect();
    for (i, surface) in boundaries.surfaces.iter().enumerate() {
        let name = format!("{name}/surface{i}");
        checkpoint.push::<f64>(format!("{name}/points"), flat(surface.boundary.points()));
        checkpoint.push::<f64>(format!("{name}/moved"), flat(&surface.moved));
    }
    for (i, pair) in boundaries.pairs.iter().enumerate() {
        let slip = pair.slip.0.iter().flatten().copied().collect();
        checkpoint.push::<f64>(format!("{name}/pair{i}/slip"), slip);
    }
}

fn restore_mortar(simulation: &mut Simulation, checkpoint: &Checkpoint) -> Result<(), RunError> {
    restore_boundaries(&mut simulation.mortar.plane, "mortar", checkpoint)?;
    restore_boundaries(&mut simulation.mortar.space, "mortar/space", checkpoint)?;
    Ok(())
}

fn restore_boundaries<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    boundaries: &mut Boundaries<B, D, N, T>,
    name: &str,
    checkpoint: &Checkpoint,
) -> Result<(), RunError> {
    let points = |name: &str, into: &mut [PointIn<D>]| {
        let values = checkpoint.array::<f64>(name, D * into.len())?;
        for (point, value) in into.iter_mut().zip(values.chunks_exact(D)) {
            *point = PointIn::from_column_slice(value);
        }
        Ok::<(), RunError>(())
    };
    for (i, surface) in boundaries.surfaces.iter_mut().enumerate() {
        let name = format!("{name}/surface{i}");
        points(&format!("{name}/points"), surface.boundary.points_mut())?;
        points(&format!("{name}/moved"), &mut surface.moved)?;
    }
    for (i, pair) in boundaries.pairs.iter_mut().enumerate() {
        let slip = &mut pair.slip.0;
        let values = checkpoint.array::<f64>(&format!("{name}/pair{i}/slip"), T * slip.len())?;
        slip.copy_from_slice(values.as_chunks().0);
    }
    Ok(())
}

fn save_events(simulation: &Simulation, checkpoint: &mut Checkpoint) {
    let (mut whole, mut real) = (vec![], vec![]);
    for event in &simulation.events {
        let (kind, at) = match &event.kind {
            EventKind::Removed(at) => (0, Some(*at)),
            EventKind::RecordEnded => (1, None),
            EventKind::WiderStencil => (2, None),
        };
        let at = at.unwrap_or(ParticleAt {
            id: 0,
            body: 0,
            position: [0.0; 3],
            volume: 0.0,
            mass: 0.0,
        });
        whole.extend([kind, event.step as i64, at.id as i64, at.body]);
        real.extend([
            event.time,
            at.position[0],
            at.position[1],
            at.position[2],
            at.volume,
            at.mass,
        ]);
    }
    checkpoint.push::<i64>("events/whole", whole);
    checkpoint.push::<f64>("events/real", real);
}

/// Puts the state of a checkpoint, whose fingerprint was compared, into a simulation of the same scene.
pub(super) fn restore(
    simulation: &mut Simulation,
    checkpoint: &Checkpoint,
) -> Result<(), RunError> {
    let counters = checkpoint.array::<u64>("counters", 4)?;
    let numbers = checkpoint.array::<f64>("numbers", 14)?;
    for (i, (set, body)) in simulation
        .sets
        .iter_mut()
        .zip(&mut simulation.bodies)
        .enumerate()
    {
        let id = checkpoint.values::<u64>(&format!("set{i}/id"))?;
        let layers = checkpoint.array::<u64>(&format!("set{i}/layers"), set.layers.len())?;
        let found = checkpoint.array::<f64>(&format!("set{i}/found"), 4)?;
        for c in 0..set.layout.columns {
            set.columns[c] = checkpoint
                .array::<f64>(&format!("set{i}/column{c}"), id.len())?
                .to_vec();
        }
        set.id = id.to_vec();
        set.layers = layers.iter().map(|&l| l as usize).collect();
        let ordered = set.layers.is_sorted() && set.layers.last() == Some(&id.len());
        let inside = (0..set.layout.axes).all(|axis| {
            set.columns[Layout::POSITION + axis].iter().all(|x| {
                let extent =
                    simulation.scene.mesh.cells[axis] as f64 * simulation.scene.mesh.cell[axis];
                (0.0..=extent).contains(x)
            })
        });
        if !ordered || !inside {
            return Err(CheckpointError::WrongLength {
                name: format!("set{i}/layers"),
                expected: id.len(),
                found: set.layers.last().copied().unwrap_or(0),
            }
            .into());
        }
        body.found = Found {
            speed_squared: found[0],
            stiffness: found[1],
            travel: found[2],
            half_length: found[3],
            fault: None,
        };
    }
    if let Some(surfaces) = &mut simulation.surfaces {
        surfaces.last_kick = checkpoint.array::<f64>("surfaces/kick", 1)?[0];
        for (name, impulses) in [("last", &mut surfaces.last), ("total", &mut surfaces.total)] {
            let count = 3 * impulses.iter().map(Vec::len).sum::<usize>();
            let values = checkpoint.array::<f64>(&format!("surfaces/{name}"), count)?;
            for (impulse, value) in impulses.iter_mut().flatten().flatten().zip(values) {
                *impulse = *value;
            }
        }
    }
    let clock = &mut simulation.clock;
    clock.step = counters[0];
    simulation.stencil = counters[1] as usize;
    simulation.groups.sorted = counters[2] as usize;
    simulation.groups.superfluous = counters[3] as usize;
    [
        clock.time,
        clock.dt_before,
        clock.dt_min,
        clock.dt_max,
        clock.dt_critical,
    ] = std::array::from_fn(|i| numbers[i]);
    simulation.travel = numbers[5];
    simulation.relaxation.last = [numbers[6], numbers[7]];
    simulation.ledger.external_work = numbers[8];
    simulation.ledger.dead_load_origin = numbers[9];
    simulation.ledger.initial_energy = numbers[10];
    simulation.mesh_shift = [numbers[11], numbers[12], numbers[13]];
    simulation.events = restore_events(checkpoint)?;
    simulation.grid.resume(&simulation.sets, simulation.stencil);
    let pairs = simulation.contact.pairs.len();
    if pairs > 0 {
        let near = checkpoint.array::<u64>("contact/near", pairs)?;
        let forces = checkpoint.array::<f64>("contact/forces", 3 * pairs)?;
        simulation.contact.near = near.iter().map(|&near| near != 0).collect();
        simulation.contact.forces = forces.as_chunks().0.to_vec();
    }
    restore_mortar(simulation, checkpoint)?;
    simulation.set_fields();
    Ok(())
}

fn restore_events(checkpoint: &Checkpoint) -> Result<Vec<Event>, RunError> {
    let whole = checkpoint.values::<i64>("events/whole")?;
    let real = checkpoint.array::<f64>("events/real", whole.len() / 4 * 6)?;
    Ok(whole
        .chunks_exact(4)
        .zip(real.chunks_exact(6))
        .map(|(w, r)| Event {
            step: w[1] as u64,
            time: r[0],
            kind: match w[0] {
                0 => EventKind::Removed(ParticleAt {
                    id: w[2] as u64,
                    body: w[3],
                    position: [r[1], r[2], r[3]],
                    volume: r[4],
                    mass: r[5],
                }),
                1 => EventKind::RecordEnded,
                _ => EventKind::WiderStencil,
            },
        })
        .collect())
}
