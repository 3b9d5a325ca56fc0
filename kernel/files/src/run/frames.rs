//! Frames of the present state: of one process, or of several ranks in one file or in a piece for each.

use super::probes::{STRESS, pore_pressure, total_stress};
use super::{RunError, ranks};
use crate::output::pvd::GRID;
use crate::output::{Array, ArrayData, Compression, Frame, Series, pieces};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::ranks::{Ranks, Words};
use proctor_scene::Field;
use proctor_scene::simulation::Simulation;
use std::path::Path;

/// Most points of a frame that ranks write into one file.
const MOST_IN_ONE_FILE: usize = 10_000_000;

/// The part that this process has of a frame: all of it, where no ranks share the simulation.
pub(super) struct FramePart {
    pub(super) frame: Frame,
    /// Places of the points in the whole, in their order: of two parts the point with the smaller place comes first, of equal
    /// places that of the rank before.
    pub(super) places: Vec<[u64; 3]>,
}

impl FramePart {
    /// A frame that one process has.
    pub(super) fn whole(frame: Frame) -> Self {
        Self {
            places: vec![[0; 3]; frame.points.len()],
            frame,
        }
    }
}

/// Where the frames of a kind go.
pub(super) struct FrameTarget<'a> {
    /// Beginning of their names.
    pub(super) stem: &'static str,
    pub(super) folder: &'a Path,
    /// Their list, on the first rank.
    pub(super) series: Option<&'a mut Series>,
    /// True for a piece of each rank whatever the number of points.
    pub(super) in_pieces: bool,
}

/// Writes a frame. All ranks call this at the same time.
///
/// # Errors
/// As [`Series::write_frame`].
pub(super) fn write(
    part: &FramePart,
    target: FrameTarget<'_>,
    ranks: Option<&dyn Ranks>,
) -> Result<(), RunError> {
    let FrameTarget {
        stem,
        folder,
        series,
        in_pieces,
    } = target;
    let here = part.places.len() as u64;
    let counts = ranks.map(|ranks| ranks.all_gather(&[here]));
    let points = counts.map_or(here, |counts| counts.iter().flatten().sum());
    if points == 0 && stem == GRID {
        // Nodes have values from the first step on.
        return Ok(());
    }
    let Some(ranks) = ranks else {
        if let Some(series) = series {
            series.write_frame(&part.frame)?;
        }
        return Ok(());
    };
    if !in_pieces && points <= MOST_IN_ONE_FILE as u64 {
        let written = match (gathered(ranks, part), series) {
            (Some(frame), Some(series)) => series.write_frame(&frame).map(|_| ()),
            _ => Ok(()),
        };
        return ranks::agree(Some(ranks), written.map_err(RunError::from));
    }
    let number = series.as_ref().map_or(0, |series| series.next_number());
    let number = ranks.all_gather(&[number])[0][0];
    let piece = pieces::Piece {
        stem,
        number,
        rank: ranks.rank(),
    };
    let written = pieces::write(folder, &piece, &part.frame, Compression::None);
    ranks::agree(Some(ranks), written.map_err(RunError::from))?;
    let listed = series.map_or(Ok(()), |series| {
        series.list_pieces(&part.frame, ranks.count())
    });
    ranks::agree(Some(ranks), listed.map_err(RunError::from))
}

/// The whole of a frame on the first rank, from the parts of all.
fn gathered(ranks: &dyn Ranks, part: &FramePart) -> Option<Frame> {
    let mut parts = vec![vec![]; ranks.count()];
    parts[0] = pack(part);
    let received = ranks.all_to_all(parts);
    if ranks.rank() != 0 {
        return None;
    }
    let (mut whole, mut places) = (Frame::default(), vec![]);
    (whole.time, whole.step) = (part.frame.time, part.frame.step);
    whole.arrays = part
        .frame
        .arrays
        .iter()
        .map(Array::without_values)
        .collect();
    for words in &received {
        unpack(&mut Words::of(words), &mut whole, &mut places);
    }
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_key(|i| places[*i]);
    whole.points = order.iter().map(|&i| whole.points[i]).collect();
    for array in &mut whole.arrays {
        array.data = array.data.in_order(&order);
    }
    Some(whole)
}

/// A part as words: the number of points, their places, their positions, and each array.
fn pack(part: &FramePart) -> Vec<u64> {
    let mut words = vec![part.places.len() as u64];
    words.extend(part.places.as_flattened());
    words.extend(part.frame.points.as_flattened().iter().map(|x| x.to_bits()));
    for array in &part.frame.arrays {
        match &array.data {
            ArrayData::Scalar(values) => words.extend(values.iter().map(|x| x.to_bits())),
            ArrayData::Integer(values) => words.extend(values.iter().map(|x| x.cast_unsigned())),
            ArrayData::Vector(values) => {
                words.extend(values.as_flattened().iter().map(|x| x.to_bits()));
            }
        }
    }
    words
}

/// Appends a packed part to the whole.
fn unpack(words: &mut Words<'_>, whole: &mut Frame, places: &mut Vec<[u64; 3]>) {
    let count = words.count();
    places.extend_from_slice(words.take(3 * count).as_chunks().0);
    let vectors = |words: &[u64]| -> Vec<[f64; 3]> {
        let vectors = words.as_chunks().0.iter();
        vectors.map(|v: &[u64; 3]| v.map(f64::from_bits)).collect()
    };
    whole.points.extend(vectors(words.take(3 * count)));
    for array in &mut whole.arrays {
        match &mut array.data {
            ArrayData::Scalar(values) => {
                values.extend(words.take(count).iter().map(|&word| f64::from_bits(word)));
            }
            ArrayData::Integer(values) => {
                values.extend(words.take(count).iter().map(|word| word.cast_signed()));
            }
            ArrayData::Vector(values) => values.extend(vectors(words.take(3 * count))),
        }
    }
}

/// The particles of this process in order of the identifier, with the fields of the scene.
pub(super) fn of_particles(simulation: &Simulation) -> FramePart {
    let mut order: Vec<(usize, usize)> = vec![];
    for (s, set) in simulation.sets().iter().enumerate() {
        let mut own: Vec<usize> = simulation.own_particles(set).iter().collect();
        own.sort_unstable_by_key(|&p| set.id[p]);
        order.extend(own.into_iter().map(|p| (s, p)));
    }
    let mut fields = simulation.scene().results.fields.clone();
    fields.sort_unstable();
    fields.dedup();
    let place = |&(s, p): &(usize, usize)| [s as u64, simulation.sets()[s].id[p], 0];
    FramePart {
        places: order.iter().map(place).collect(),
        frame: Frame {
            time: simulation.time(),
            step: simulation.steps(),
            points: order
                .iter()
                .map(|&(s, p)| simulation.position(s, p))
                .collect(),
            arrays: fields
                .into_iter()
                .flat_map(|field| arrays(simulation, &order, field))
                .collect(),
            lines: vec![],
        },
    }
}

/// Arrays of pore water, where there is any.
fn of_water(simulation: &Simulation, arrays: impl FnOnce() -> Vec<Array>) -> Vec<Array> {
    if simulation.has_water() {
        arrays()
    } else {
        vec![]
    }
}

fn arrays(simulation: &Simulation, order: &[(usize, usize)], field: Field) -> Vec<Array> {
    let set = |s: usize| -> &ParticleSet { &simulation.sets()[s] };
    let scalar = |name: &str, of: &dyn Fn(usize, usize) -> f64| {
        vec![Array::new(
            name,
            ArrayData::Scalar(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    let integer = |name: &str, of: &dyn Fn(usize, usize) -> i64| {
        vec![Array::new(
            name,
            ArrayData::Integer(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    let vector = |name: &str, of: &dyn Fn(usize, usize) -> [f64; 3]| {
        vec![Array::new(
            name,
            ArrayData::Vector(order.iter().map(|&(s, p)| of(s, p)).collect()),
        )]
    };
    match field {
        Field::Id => integer("Particle Id", &|s, p| set(s).id[p] as i64),
        Field::Material => integer("Material Id", &|s, _| simulation.body(s).material_id),
        Field::Body => integer("Body Id", &|s, _| simulation.body(s).id),
        Field::Active => integer("Active", &|_, _| 1),
        Field::Mass => scalar("Mass", &|s, p| simulation.particle_mass(s, p)),
        Field::Volume => scalar("Volume", &|s, p| simulation.particle_volume(s, p)),
        Field::Density => scalar("Density", &|s, p| {
            simulation.particle_mass(s, p) / simulation.particle_volume(s, p)
        }),
        Field::Displacement => vector("Displacement", &|s, p| {
            simulation.displacement(s, p).unwrap_or_default()
        }),
        Field::Velocity => vector("Velocity", &|s, p| set(s).velocity(p))
            .into_iter()
            .chain(of_water(simulation, || {
                vector("Water Velocity", &|s, p| {
                    let first = set(s).layout.water;
                    first.map_or([f64::NAN; 3], |first| set(s).vector(first, p))
                })
            }))
            .collect(),
        Field::Stress => (0..STRESS.len())
            .flat_map(|i| {
                scalar(&format!("Stress_{}", STRESS[i]), &|s, p| {
                    set(s).stress(p)[i]
                })
            })
            .chain(of_water(simulation, || {
                (0..STRESS.len())
                    .flat_map(|i| {
                        scalar(&format!("Total_Stress_{}", STRESS[i]), &|s, p| {
                            total_stress(set(s), p).map_or(f64::NAN, |stress| stress[i])
                        })
                    })
                    .collect()
            }))
            .collect(),
        Field::Pressure => scalar("Pressure", &|s, p| {
            let stress = set(s).stress(p);
            -(stress[0] + stress[1] + stress[2]) / 3.0
        })
        .into_iter()
        .chain(of_water(simulation, || {
            scalar("Pore Pressure", &|s, p| {
                pore_pressure(set(s), p).unwrap_or(f64::NAN)
            })
        }))
        .collect(),
        Field::DeformationGradient => (0..9)
            .flat_map(|i| {
                let name = format!(
                    "Deformation_{}{}",
                    ["X", "Y", "Z"][i / 3],
                    ["X", "Y", "Z"][i % 3]
                );
                scalar(&name, &|s, p| {
                    simulation
                        .deformation(s, p)
                        .map_or(f64::NAN, |f| f[i / 3][i % 3])
                })
            })
            .collect(),
        Field::ExternalForce => vector("External Force", &|s, p| simulation.external_force(s, p)),
        Field::InternalVariables => (simulation.variables().iter())
            .flat_map(|name| {
                let columns: Vec<Option<&[f64]>> = simulation
                    .sets()
                    .iter()
                    .map(|set| set.column(name))
                    .collect();
                scalar(name, &|s, p| {
                    columns[s].map_or(f64::NAN, |column| column[p])
                })
            })
            .collect(),
    }
}
