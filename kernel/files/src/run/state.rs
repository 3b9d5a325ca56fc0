//! The whole state of a simulation in a checkpoint, bit by bit.

use super::changeable::{self, Changeable};
use super::saved_events::{read_events, save_events};
use super::{RunError, loads, ranks};
use crate::output::checkpoint::{SectionPart, SharedCheckpoint};
use crate::output::{Checkpoint, CheckpointError};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::stage::g2p::ParticleMaxima;
use proctor_scene::simulation::{
    AbsorbingNode, Clock, EnergyLedger, Extremes, FreeGroundNode, Groups, Invariant,
    InvariantMonitor, RestoreError, SavedState, Simulation, State, Violation,
};
use proctor_scene::{Results, Scene, StateFile};
use std::path::{Path, PathBuf};

/// Fingerprint of what a scene simulates: not its name, its end, its gravity, its local damping, its planes, its box
/// loads, its outputs or its threads, which a restart may change.
pub(super) fn fingerprint(scene: &Scene) -> u64 {
    let what = Scene {
        name: String::new(),
        time: 0.0,
        until: None,
        results: Results::NONE,
        probes: vec![],
        threads: None,
        // The folder of the stage before may have moved; what came from it is in the checkpoint.
        initial_state: scene.initial_state.as_ref().map(|state| StateFile {
            file: PathBuf::new(),
            ..state.clone()
        }),
        ..changeable::without(scene)
    };
    // FNV-1a over the text of all values; f64 prints so that it reads back to the same bits.
    format!("{what:?}")
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

/// Writes the state as a checkpoint, which ranks do together: the file has the bytes that one process would write.
///
/// # Errors
/// See [`Checkpoint::write`] and [`SharedCheckpoint::write`].
pub(super) fn write(simulation: &Simulation, path: &Path) -> Result<(), RunError> {
    let saved = save(simulation);
    let ranks = simulation.ranks();
    let written = match ranks {
        None => saved.checkpoint.write(path),
        Some(ranks) => saved.write(path, ranks),
    };
    ranks::agree(ranks, written.map_err(RunError::from))
}

/// The state as a checkpoint; of ranks the part of this one.
pub(super) fn save(simulation: &Simulation) -> SharedCheckpoint {
    let (saved, of_sets) = simulation.save_part();
    let mut parts = vec![];
    let mut checkpoint = Checkpoint::new(fingerprint(simulation.scene()));
    checkpoint.push::<u64>("counters", counters(&saved.state).to_vec());
    checkpoint.push::<f64>("numbers", numbers(&saved.state).to_vec());
    Changeable::of(simulation.scene()).save(&mut checkpoint);
    let mesh = &simulation.scene().mesh;
    checkpoint.push::<f64>("mesh", [mesh.origin, mesh.cell].concat());
    let bodies = simulation.scene().bodies.iter();
    checkpoint.push::<i64>("bodies", bodies.map(|body| body.id).collect());
    let state = saved.state;
    let wet = is_wet(&state.sets);
    for (i, (set, found)) in state.sets.into_iter().zip(state.found).enumerate() {
        checkpoint.push::<f64>(
            format!("set{i}/found"),
            vec![
                found.speed_squared,
                found.wave_speed_squared,
                found.travel,
                found.half_length,
                found.increment_squared,
            ],
        );
        let names = set.layout.names().join("\n");
        checkpoint.push::<u64>(
            format!("set{i}/names"),
            names.bytes().map(u64::from).collect(),
        );
        let part = |checkpoint: &Checkpoint| SectionPart {
            section: checkpoint.sections.len(),
            before: of_sets[i].before as u64,
            all: of_sets[i].all as u64,
        };
        parts.push(part(&checkpoint));
        checkpoint.push::<u64>(id_section(i), set.id);
        checkpoint.push::<u64>(
            format!("set{i}/layers"),
            set.layers.into_iter().map(|l| l as u64).collect(),
        );
        for (c, column) in set.columns.into_iter().enumerate() {
            parts.push(part(&checkpoint));
            checkpoint.push::<f64>(column_section(i, c), column);
        }
    }
    for (i, lists) in saved.interactions.into_iter().enumerate() {
        for (name, values) in lists {
            checkpoint.push::<f64>(format!("interaction{i}/{name}"), values);
        }
    }
    save_events(&state.events, &mut checkpoint);
    save_trust(&state.invariants, &mut checkpoint);
    save_absorbing(&state.absorbing, state.ledger.absorbed, &mut checkpoint);
    save_free_ground(&state.free_ground, &mut checkpoint);
    if wet {
        checkpoint.push::<f64>(DRAG, vec![state.ledger.drag]);
    }
    let extremes = vec![
        state.extremes.volume_change,
        state.extremes.stretch_ratio,
        state.extremes.stretched_share,
    ];
    checkpoint.push::<f64>("extremes/numbers", extremes);
    SharedCheckpoint { checkpoint, parts }
}

/// Name of the section with the identifiers of a set.
pub(super) fn id_section(set: usize) -> String {
    format!("set{set}/id")
}

/// Name of the section with a column of a set.
pub(super) fn column_section(set: usize, column: usize) -> String {
    format!("set{set}/column{column}")
}

/// Text that was written as its bytes.
pub(super) fn text(bytes: &[u64]) -> String {
    let bytes: Vec<u8> = bytes.iter().map(|byte| *byte as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Puts the state of a checkpoint, whose fingerprint was compared, into a simulation of the same scene; where its box loads are new,
/// the particles keep those.
pub(super) fn restore(
    simulation: &mut Simulation,
    checkpoint: &Checkpoint,
    new_loads: bool,
) -> Result<(), RunError> {
    // The state at the start has every list that the scene needs, with its length.
    let saved = read(checkpoint, simulation.save(), new_loads)?;
    simulation.restore(saved).map_err(misfit)?;
    Ok(())
}

/// Error of a part that does not fit the scene, by the section that holds it.
fn misfit(error: RestoreError) -> CheckpointError {
    let (name, expected, found) = match error {
        RestoreError::Length {
            what,
            expected,
            found,
        } => (what, expected, found),
        RestoreError::Places {
            body,
            particles,
            in_layers,
        } => (format!("set{body}/layers"), particles, in_layers),
    };
    CheckpointError::WrongLength {
        name,
        expected,
        found,
    }
}

fn counters(state: &State) -> [u64; 4] {
    [
        state.clock.step,
        state.stencil as u64,
        state.groups.sorted as u64,
        state.groups.superfluous as u64,
    ]
}

fn numbers(state: &State) -> [f64; 18] {
    let (clock, ledger) = (&state.clock, &state.ledger);
    let [x, y, z] = state.mesh_shift;
    [
        clock.time,
        clock.dt_before,
        clock.dt_min,
        clock.dt_max,
        clock.dt_critical,
        state.travel,
        state.kinetic[0],
        state.kinetic[1],
        ledger.external_work,
        ledger.dead_load_origin,
        ledger.initial_energy,
        x,
        y,
        z,
        ledger.damping,
        ledger.friction,
        ledger.impact,
        ledger.removed,
    ]
}

/// The state in a checkpoint; `like` is one of the same scene.
fn read(
    checkpoint: &Checkpoint,
    like: SavedState,
    new_loads: bool,
) -> Result<SavedState, CheckpointError> {
    let counters = checkpoint.array::<u64>("counters", 4)?;
    let numbers = checkpoint.array::<f64>("numbers", 18)?;
    let mut state = State {
        clock: Clock {
            step: counters[0],
            time: numbers[0],
            dt_before: numbers[1],
            dt_min: numbers[2],
            dt_max: numbers[3],
            dt_critical: numbers[4],
        },
        stencil: counters[1] as usize,
        groups: Groups {
            sorted: counters[2] as usize,
            superfluous: counters[3] as usize,
        },
        travel: numbers[5],
        kinetic: [numbers[6], numbers[7]],
        ledger: EnergyLedger {
            external_work: numbers[8],
            dead_load_origin: numbers[9],
            initial_energy: numbers[10],
            damping: numbers[14],
            friction: numbers[15],
            impact: numbers[16],
            removed: numbers[17],
            absorbed: 0.0,
            drag: 0.0,
        },
        mesh_shift: [numbers[11], numbers[12], numbers[13]],
        ..like.state
    };
    for (i, (set, found)) in state.sets.iter_mut().zip(&mut state.found).enumerate() {
        let id = checkpoint.values::<u64>(&id_section(i))?;
        let layers = checkpoint.array::<u64>(&format!("set{i}/layers"), set.layers.len())?;
        let was = checkpoint.array::<f64>(&format!("set{i}/found"), 5)?;
        if new_loads {
            let names = text(checkpoint.values::<u64>(&format!("set{i}/names"))?);
            let change = loads::take(checkpoint, (i, &names), set, id, state.mesh_shift)?;
            state.ledger.dead_load_origin += change;
        } else {
            for (c, column) in set.columns.iter_mut().enumerate() {
                let name = column_section(i, c);
                *column = checkpoint.array::<f64>(&name, id.len())?.to_vec();
            }
        }
        set.id = id.to_vec();
        set.set_layers(layers.iter().map(|&l| l as usize).collect());
        *found = ParticleMaxima {
            speed_squared: was[0],
            wave_speed_squared: was[1],
            travel: was[2],
            half_length: was[3],
            increment_squared: was[4],
            fault: None,
        };
    }
    state.events = read_events(checkpoint)?;
    state.ledger.absorbed = read_absorbing(checkpoint, &mut state.absorbing)?;
    read_free_ground(checkpoint, &mut state.free_ground)?;
    if is_wet(&state.sets) {
        state.ledger.drag = checkpoint.array::<f64>(DRAG, 1)?[0];
    }
    state.invariants = read_trust(checkpoint)?;
    let extremes = checkpoint.array::<f64>("extremes/numbers", 3)?;
    state.extremes = Extremes {
        volume_change: extremes[0],
        stretch_ratio: extremes[1],
        stretched_share: extremes[2],
    };
    let mut interactions = like.interactions;
    for (i, lists) in interactions.iter_mut().enumerate() {
        for (name, values) in lists {
            let section = format!("interaction{i}/{name}");
            // A list of entries that come and go is empty at the start; whether it fits is asked when it is taken up.
            let found = if values.is_empty() {
                checkpoint.values(&section)?
            } else {
                checkpoint.array(&section, values.len())?
            };
            values.clear();
            values.extend_from_slice(found);
        }
    }
    Ok(SavedState {
        state,
        interactions,
    })
}

/// Saves the watched invariants; a doubt as step, time, place of its reason and value.
fn save_trust(invariants: &InvariantMonitor, checkpoint: &mut Checkpoint) {
    let numbers = vec![
        invariants.given,
        invariants.gain,
        invariants.increment,
        invariants.lost_momentum,
        invariants.volume_left,
    ];
    checkpoint.push::<f64>("trust/numbers", numbers);
    let place = |violation: &Violation| Invariant::ALL.iter().position(|r| *r == violation.reason);
    let (mut whole, mut real) = (vec![], vec![]);
    if let Some((violation, place)) = invariants
        .violation
        .as_ref()
        .and_then(|d| Some((d, place(d)?)))
    {
        whole.extend([violation.step, place as u64]);
        real.extend([violation.time, violation.value]);
    }
    checkpoint.push::<u64>("trust/doubt/whole", whole);
    checkpoint.push::<f64>("trust/doubt/real", real);
}

fn read_trust(checkpoint: &Checkpoint) -> Result<InvariantMonitor, CheckpointError> {
    let numbers = checkpoint.array::<f64>("trust/numbers", 5)?;
    let whole = checkpoint.values::<u64>("trust/doubt/whole")?;
    let real = checkpoint.array::<f64>("trust/doubt/real", whole.len())?;
    let violation = match (whole, real) {
        (&[step, place], &[time, value]) => Some(Violation {
            step,
            time,
            reason: *Invariant::ALL
                .get(place as usize)
                .unwrap_or(&Invariant::Energy),
            value,
        }),
        _ => None,
    };
    Ok(InvariantMonitor {
        given: numbers[0],
        gain: numbers[1],
        increment: numbers[2],
        lost_momentum: numbers[3],
        volume_left: numbers[4],
        violation,
    })
}

/// Nodes of absorbing planes, and the energy that left through them; nothing where no plane absorbs.
fn save_absorbing(nodes: &[AbsorbingNode], absorbed: f64, checkpoint: &mut Checkpoint) {
    if nodes.is_empty() {
        return;
    }
    let numbers = nodes.iter().flat_map(AbsorbingNode::to_numbers);
    checkpoint.push::<u64>(
        "absorbing/node",
        nodes.iter().map(|one| one.node as u64).collect(),
    );
    checkpoint.push::<f64>("absorbing/numbers", numbers.collect());
    checkpoint.push::<f64>("absorbing/energy", vec![absorbed]);
}

/// The energy that left through absorbing planes \[J\]; their nodes in the place of those of the start.
/// Section of the energy that drag of pore water took \[J\].
const DRAG: &str = "water/drag";

/// True where particles have water in their pores.
fn is_wet(sets: &[ParticleSet]) -> bool {
    sets.iter().any(|set| set.layout.water.is_some())
}

fn read_absorbing(
    checkpoint: &Checkpoint,
    nodes: &mut [AbsorbingNode],
) -> Result<f64, CheckpointError> {
    if nodes.is_empty() {
        return Ok(0.0);
    }
    let places = checkpoint.array::<u64>("absorbing/node", nodes.len())?;
    let all = AbsorbingNode::NUMBERS * nodes.len();
    let numbers = checkpoint.array::<f64>("absorbing/numbers", all)?;
    let (numbers, _) = numbers.as_chunks();
    for ((one, &node), numbers) in nodes.iter_mut().zip(places).zip(numbers) {
        *one = AbsorbingNode::from_numbers(node as usize, numbers);
    }
    Ok(checkpoint.array::<f64>("absorbing/energy", 1)?[0])
}

/// Section of the motion of free ground beside absorbing sides.
const FREE_GROUND: &str = "absorbing/free-ground";

fn save_free_ground(nodes: &[FreeGroundNode], checkpoint: &mut Checkpoint) {
    if !nodes.is_empty() {
        let numbers = nodes.iter().flat_map(FreeGroundNode::motion);
        checkpoint.push::<f64>(FREE_GROUND, numbers.collect());
    }
}

fn read_free_ground(
    checkpoint: &Checkpoint,
    nodes: &mut [FreeGroundNode],
) -> Result<(), CheckpointError> {
    if nodes.is_empty() {
        return Ok(());
    }
    let all = FreeGroundNode::NUMBERS * nodes.len();
    let numbers = checkpoint.array::<f64>(FREE_GROUND, all)?;
    let (numbers, _) = numbers.as_chunks();
    for (node, numbers) in nodes.iter_mut().zip(numbers) {
        node.set_motion(*numbers);
    }
    Ok(())
}
