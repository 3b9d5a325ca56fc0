//! Events in a checkpoint.

use crate::output::{Checkpoint, CheckpointError};
use proctor_scene::simulation::{Event, EventKind, ParticleAt};

pub(super) fn save_events(events: &[Event], checkpoint: &mut Checkpoint) {
    let (mut whole, mut real) = (vec![], vec![]);
    for event in events {
        let (kind, at) = match &event.kind {
            EventKind::Removed(at) => (0, Some(*at)),
            EventKind::RecordEnded => (1, None),
            EventKind::WiderStencil => (2, None),
            EventKind::VolumeRatio { particle, .. } => (3, Some(*particle)),
            EventKind::Overlap {
                bodies, position, ..
            } => (
                4,
                Some(ParticleAt {
                    id: bodies[0] as u64,
                    body: bodies[1],
                    position: *position,
                    volume: 0.0,
                    mass: 0.0,
                }),
            ),
        };
        let ratio = match &event.kind {
            EventKind::VolumeRatio { ratio, .. } => *ratio,
            EventKind::Overlap { depth, .. } => *depth,
            _ => 0.0,
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
            ratio,
        ]);
    }
    checkpoint.push::<i64>("events/whole", whole);
    checkpoint.push::<f64>("events/real", real);
}

pub(super) fn read_events(checkpoint: &Checkpoint) -> Result<Vec<Event>, CheckpointError> {
    let whole = checkpoint.values::<i64>("events/whole")?;
    let real = checkpoint.array::<f64>("events/real", whole.len() / 4 * 7)?;
    Ok(whole
        .chunks_exact(4)
        .zip(real.chunks_exact(7))
        .map(|(w, r)| Event {
            step: w[1] as u64,
            time: r[0],
            kind: event_kind(w, r),
        })
        .collect())
}

/// The kind of an event from its whole and its real numbers.
fn event_kind(whole: &[i64], real: &[f64]) -> EventKind {
    let particle = ParticleAt {
        id: whole[2] as u64,
        body: whole[3],
        position: [real[1], real[2], real[3]],
        volume: real[4],
        mass: real[5],
    };
    match whole[0] {
        0 => EventKind::Removed(particle),
        1 => EventKind::RecordEnded,
        2 => EventKind::WiderStencil,
        4 => EventKind::Overlap {
            bodies: [whole[2], whole[3]],
            position: particle.position,
            depth: real[6],
        },
        _ => EventKind::VolumeRatio {
            particle,
            ratio: real[6],
        },
    }
}
