//! Start states: bodies that begin as another run left them.

use crate::plan::{PlanOptions, layouts};
use crate::values::{InitialStress, Scene};
use proctor_kernel::layout::Layout;
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::SetupError;
use proctor_kernel::stage::g2p::ParticleMaxima;

/// Bodies as another run left them.
#[derive(Clone, Debug, PartialEq)]
pub struct StartState {
    /// File that it was read from, for messages.
    pub source: String,
    /// Lower corner of the mesh of that run when it ended \[m\].
    pub origin: Vector,
    /// Edges of its cells \[m\].
    pub cell: Vector,
    /// The bodies.
    pub bodies: Vec<StartBody>,
    /// True if bodies keep their velocities; they begin at rest otherwise.
    pub keeps_velocity: bool,
}

/// A body as another run left it.
#[derive(Clone, Debug, PartialEq)]
pub struct StartBody {
    /// Identifier of the body.
    pub id: i64,
    /// Identifiers of its particles.
    pub particles: Vec<u64>,
    /// Columns by their names, as [`Layout::names`] has them, one value for each particle.
    pub columns: Vec<(String, Vec<f64>)>,
    /// Maxima over its particles.
    pub maxima: ParticleMaxima,
}

impl StartBody {
    fn column(&self, name: &str) -> Option<&[f64]> {
        let found = self.columns.iter().find(|(own, _)| own == name);
        found.map(|(_, values)| values.as_slice())
    }
}

/// Gives all bodies of a scene that a start state has their particles. Identifiers stay unique: they follow each other in the
/// order of the bodies.
///
/// # Errors
/// See [`take`].
pub(super) fn take_all(
    sets: &mut [ParticleSet],
    found: &mut [ParticleMaxima],
    scene: &Scene,
    start: &StartState,
) -> Result<(), SetupError> {
    let mut first = 0;
    for (index, (set, found)) in sets.iter_mut().zip(found).enumerate() {
        take(set, found, scene, index, start)?;
        let least = set.id.iter().copied().min().unwrap_or(0);
        for id in &mut set.id {
            *id = *id - least + first;
        }
        first += set.len() as u64;
    }
    Ok(())
}

/// Gives a body that was filled the particles of the body of the same identifier in a start state; a body that the state does
/// not have stays as it is.
///
/// # Errors
/// A state that cannot be that of the body: of another law, weighting or size of cells, or beside another state of its own.
fn take(
    set: &mut ParticleSet,
    found: &mut ParticleMaxima,
    scene: &Scene,
    index: usize,
    start: &StartState,
) -> Result<(), SetupError> {
    let body = &scene.bodies[index];
    let Some(state) = start.bodies.iter().find(|state| state.id == body.id) else {
        return Ok(());
    };
    let refused = |reason: String| SetupError::Body {
        body: body.name.clone(),
        reason: format!("initial_state {:?}: {reason}", start.source),
    };
    if body.initial_stress != InitialStress::None {
        return Err(refused(
            "it has the stress of the body, and so has `initial_stress`; accepted: one of them"
                .into(),
        ));
    }
    let boundaries = &scene.mortar.boundaries;
    if boundaries.iter().any(|boundary| boundary.body == body.id) {
        return Err(refused(
            "it has no vertices of the boundary of the body; accepted: a body without mortar contact".into(),
        ));
    }
    let axes = set.layout.axes;
    let (cell, was) = (&scene.mesh.cell[..axes], &start.cell[..axes]);
    if cell != was {
        return Err(refused(format!(
            "it is of a mesh with cells of {was:?} m, the scene has cells of {cell:?} m; accepted: cells of the same size"
        )));
    }
    let rank = ranks(&state.particles);
    let place_of_rank = {
        let mut places: Vec<usize> = (0..set.len()).collect();
        places.sort_unstable_by_key(|p| set.id[*p]);
        places
    };
    let mut columns = Vec::with_capacity(set.columns.len());
    for (column, name) in set.layout.names().into_iter().enumerate() {
        let values = match Role::of(&set.layout, column) {
            Role::Position(axis) => {
                let shift = start.origin[axis] - scene.mesh.origin[axis];
                let at_start = format!("position {}", axis + 1);
                let values = state.column(&at_start).ok_or_else(|| missing(&at_start));
                let values = values.map_err(&refused)?;
                inside(values, shift, scene, axis).map_err(&refused)?
            }
            Role::Velocity if !start.keeps_velocity => vec![0.0; state.particles.len()],
            Role::Affine => match state.column(&name) {
                Some(values) if start.keeps_velocity => values.to_vec(),
                _ => vec![0.0; state.particles.len()],
            },
            Role::Filled(what, accepted) => {
                if place_of_rank.len() != rank.len() {
                    return Err(refused(format!(
                        "it has {} particles where the body is filled with {}, {what}; accepted: as many, or {accepted}",
                        rank.len(),
                        place_of_rank.len()
                    )));
                }
                let own = |rank: &usize| set.columns[column][place_of_rank[*rank]];
                rank.iter().map(own).collect()
            }
            Role::Kept | Role::Velocity => {
                let values = state.column(&name).ok_or_else(|| missing(&name));
                values.map_err(&refused)?.to_vec()
            }
        };
        columns.push(values);
    }
    if let (Some(held), Some(pressure)) = (set.layout.held_pressure, set.layout.pore_pressure()) {
        for (p, rank) in rank.iter().enumerate() {
            if columns[held][p] == 0.0 {
                columns[pressure][p] = set.columns[pressure][place_of_rank[*rank]];
            }
        }
    }
    set.columns = columns;
    set.id = rank.iter().map(|r| *r as u64).collect();
    set.layers.clear();
    let speed_squared = if start.keeps_velocity {
        state.maxima.speed_squared
    } else {
        0.0
    };
    *found = ParticleMaxima {
        speed_squared,
        travel: 0.0,
        ..state.maxima
    };
    Ok(())
}

/// A column of the particles of a body that a scene needs, and that the body of the same identifier lacks in the scene before it: the
/// place of the body, and the name of the column.
#[must_use]
pub fn missing_column(before: &Scene, scene: &Scene) -> Option<(usize, String)> {
    let demands = PlanOptions::default();
    let had = layouts(before, demands);
    for (index, (body, layout)) in scene.bodies.iter().zip(layouts(scene, demands)).enumerate() {
        let Some(old) = before.bodies.iter().position(|old| old.id == body.id) else {
            continue;
        };
        let had = had[old].names();
        let mut names = layout.names().into_iter().enumerate();
        let missing = names.find(|(column, name)| {
            matches!(Role::of(&layout, *column), Role::Kept) && !had.contains(name)
        });
        if let Some((_, name)) = missing {
            return Some((index, name));
        }
    }
    None
}

/// The content of a column, as far as a start state treats it in a way of its own.
enum Role {
    /// Position or position at the start along an axis.
    Position(usize),
    Velocity,
    Affine,
    /// That of the particles with which the body was filled: what they were given, and the way without.
    Filled(&'static str, &'static str),
    Kept,
}

impl Role {
    fn of(layout: &Layout, column: usize) -> Self {
        let axes = layout.axes;
        let within = |first: Option<usize>, width: usize| {
            first.is_some_and(|first| (first..first + width).contains(&column))
        };
        if within(Some(Layout::POSITION), axes) {
            Self::Position(column - Layout::POSITION)
        } else if within(layout.displacement_origin, axes) {
            Self::Position(column - layout.displacement_origin.unwrap_or(column))
        } else if within(Some(Layout::velocity(axes)), axes) {
            Self::Velocity
        } else if within(layout.affine, axes * axes) {
            Self::Affine
        } else if within(layout.force, axes) {
            Self::Filled("over which the box loads are spread", "no box loads")
        } else if within(layout.held_pressure, 2) {
            Self::Filled(
                "some of which keep a pore pressure",
                "no `prescribed_pressure_box`",
            )
        } else {
            Self::Kept
        }
    }
}

fn missing(name: &str) -> String {
    format!(
        "it lacks \"{name}\" of the particles; accepted: a state of the same law and the same weighting"
    )
}

/// Positions in the mesh of the scene.
fn inside(values: &[f64], shift: f64, scene: &Scene, axis: usize) -> Result<Vec<f64>, String> {
    let extent = scene.mesh.cells[axis] as f64 * scene.mesh.cell[axis];
    let moved: Vec<f64> = values.iter().map(|x| x + shift).collect();
    match moved.iter().find(|x| !(0.0..=extent).contains(*x)) {
        None => Ok(moved),
        Some(x) => Err(format!(
            "a particle at {} = {} m lies outside the mesh; accepted: a mesh around all bodies",
            ["x", "y", "z"][axis],
            x + scene.mesh.origin[axis]
        )),
    }
}

/// The place of each identifier in their increasing order.
fn ranks(identifiers: &[u64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..identifiers.len()).collect();
    order.sort_unstable_by_key(|i| identifiers[*i]);
    let mut ranks = vec![0; identifiers.len()];
    for (rank, i) in order.into_iter().enumerate() {
        ranks[i] = rank;
    }
    ranks
}
