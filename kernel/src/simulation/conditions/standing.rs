//! Water that stands beside bodies and presses on their surfaces, wherever these go.
//!
//! The virtual power of a pressure p on the surface of a body is minus the integral of p n . v over it, which is minus the integral
//! of p div v + v . grad p over the body, for any field p that has the pressure at the surface. So a node gets
//! -sum V (p grad S + S grad p) over the particles, and nobody looks for a surface (Given et al. 2022 have it on virtual
//! particles outside). The sum over the nodes is -sum V grad p to round-off: the buoyancy of Archimedes. A body whose
//! stress is -p is in equilibrium node by node: the load on its surface cancels with the stress behind it and does not shake
//! nodes that are nearly empty.
//!
//! Pore water shares the force at the node, n of it, and the skeleton has the rest: the total traction is the pressure, and
//! the water in the pores meets the same pressure at the surface. Fields are folded at boundary planes as the pressure of the pores is.
//!
//! Each slab of planes sums up what the particles that reach it give its nodes, in the order of the particles: how the planes are cut
//! changes no bit.

mod sums;

use super::{ConditionResult, ConditionType};
use crate::fields::Owner;
use crate::grid::{GridShape, Line};
use crate::history::value;
use crate::layout::Layout;
use crate::model::{CycleSettings, PlaneCondition, Shore, StandingWater, Vector, VolumetricStrain};
use crate::simulation::context::{Condition, FieldForces, FieldNodes, NodalConditions};
use crate::simulation::step_view::StepView;
use crate::simulation::water::porosity_at;
use crate::stage::solve::{EmptyNode, ExactStepSums, StepSum};
use crate::weights::Family;
use smallvec::SmallVec;
use std::sync::Arc;
use sums::{Images, NodeSums, half_length};

/// Standing water.
pub(super) const STANDING_WATER: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        if !settings.standing_waters.is_empty() {
            list.keep(
                "stage",
                "standing water",
                "water presses on the surfaces of bodies",
            );
        }
    },
    make: Some(of),
    planes: false,
};

/// The waters, and what they need of the scene.
struct StandingWaters {
    waters: Vec<StandingWater>,
    /// Axis of gravity, and its acceleration along it \[m/s²\].
    gravity: (usize, f64),
    /// True where forces of mean stresses are mapped by means over cells.
    averaged: bool,
    /// The images beyond the boundary planes.
    images: Images,
}

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    if settings.standing_waters.is_empty() {
        return None;
    }
    let gravity = &settings.gravity;
    let steepest = |a: &usize, b: &usize| gravity[*a].abs().total_cmp(&gravity[*b].abs());
    let along = (0..settings.dimension.axes()).max_by(steepest).unwrap_or(0);
    let planes = settings.water_planes.unwrap_or(settings.mesh.planes);
    let images = std::array::from_fn(|axis| {
        planes[axis].map(|plane| (plane != PlaneCondition::Free).then(|| plane.prescribed(axis)))
    });
    Some(Ok(Arc::new(StandingWaters {
        waters: settings.standing_waters.clone(),
        gravity: (along, gravity[along]),
        averaged: settings.volumetric_strain == VolumetricStrain::CellAverage,
        images,
    })))
}

impl Condition for StandingWaters {
    fn acts_on_water(&self) -> bool {
        true
    }

    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        let [before, after] = nodal.half_steps;
        let pressures = self.at(0.5 * (before + after));
        let grid = view.grid;
        (nodal.standing).resize_with(grid.fields.len(), FieldForces::default);
        for (number, (field, pressed)) in grid.fields.iter().zip(&mut nodal.standing).enumerate() {
            pressed.clear();
            let bodies = || {
                let all = view.bodies.iter().enumerate();
                all.filter(move |(index, body)| {
                    body.motion.is_none() && grid.number_of(*index) == number
                })
            };
            let is_pressed =
                bodies().any(|(_, body)| pressures.iter().any(|one| one.acts_on(body.id)));
            if field.owner == Owner::Water || !is_pressed {
                continue;
            }
            let mut all = NodeSums::of(&grid.shape, &field.rows, pressed, &self.images);
            view.team().each(all.of_slabs(&grid.slabs), |mut sums| {
                for (index, body) in bodies() {
                    let acting = pressures.iter().filter(|one| one.acts_on(body.id));
                    self.press(view, index, &acting.collect(), &mut sums);
                }
            });
            all.fold();
        }
    }

    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        for_forces(field, |line, force, _| {
            for axis in 0..3 {
                line[4 + axis] += force[axis];
            }
        });
        Ok(())
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        for_forces(field, |line, force, sums| {
            let power = (0..3).map(|axis| force[axis] * line[1 + axis]);
            sums.add(StepSum::Power, power.sum::<f64>());
        });
    }
}

/// Waters of a scene; more than these take memory in each step.
const FEW: usize = 8;

/// A water at a time.
struct WaterPressure<'a> {
    bodies: &'a [i64],
    shore: Option<Shore>,
    /// Level \[m\].
    level: f64,
    /// Axis of gravity, and the increase of the pressure along it \[Pa/m\].
    weight: (usize, f64),
}

impl WaterPressure<'_> {
    /// True if it stands beside the body of this identifier.
    fn acts_on(&self, body: i64) -> bool {
        self.bodies.is_empty() || self.bodies.contains(&body)
    }

    /// Pressure at a place \[Pa\] and its gradient \[Pa/m\], as means over a piece of half the length `half` \[m\] along each axis:
    /// so the gradients of pieces side by side sum up to the pressure.
    fn at(&self, x: &Vector, half: &Vector) -> (f64, Vector) {
        let (along, slope) = self.weight;
        let (across, half) = (half, half[along]);
        // Of the axis that points down.
        let depth = (self.level - x[along]) * -slope.signum();
        let (mean, wet) = if depth >= half {
            (depth, 1.0)
        } else if depth <= -half {
            (0.0, 0.0)
        } else {
            let wet = 0.5 * (depth + half) / half;
            (wet * wet * half, wet)
        };
        let mut pressure = slope.abs() * mean;
        let mut gradient = [0.0; 3];
        gradient[along] = slope * wet;
        if let Some(shore) = &self.shore {
            let (at, half) = (x[shore.axis], across[shore.axis]);
            let share = shore.share(at);
            let rise = (shore.share(at + half) - shore.share(at - half)) / (2.0 * half);
            gradient = gradient.map(|g| g * share);
            gradient[shore.axis] += pressure * rise;
            pressure *= share;
        }
        (pressure, gradient)
    }
}

impl StandingWaters {
    /// The waters at a time \[s\].
    fn at(&self, time: f64) -> SmallVec<[WaterPressure<'_>; FEW]> {
        let (along, gravity) = self.gravity;
        let waters = self.waters.iter().map(|water| WaterPressure {
            bodies: &water.bodies,
            shore: water.shore,
            level: value(&water.level, time)[0],
            weight: (along, water.density * gravity),
        });
        waters.collect()
    }

    /// Adds what the waters give a body to the nodes of a slab.
    fn press(
        &self,
        view: &StepView<'_>,
        index: usize,
        waters: &SmallVec<[&WaterPressure<'_>; FEW]>,
        sums: &mut NodeSums<'_>,
    ) {
        let (set, body) = (&view.particles[index], &view.bodies[index]);
        let (origin, axes) = (view.origin(), view.grid.shape.axes);
        for p in sums.particles(set, view.stencil) {
            let local = set.position(p);
            let x: Vector = std::array::from_fn(|axis| local[axis] + origin[axis]);
            let mut half = [0.0; 3];
            for axis in 0..axes {
                let cells = match body.mapping.family {
                    Family::Hat => OF_POINTS,
                    Family::Gimp => half_length(set, body, axis, p),
                };
                half[axis] = cells * body.mapping.cell[axis];
            }
            let (mut pressure, mut gradient) = (0.0, [0.0; 3]);
            for water in waters {
                let (own, slope) = water.at(&x, &half);
                pressure += own;
                for axis in 0..3 {
                    gradient[axis] += slope[axis];
                }
            }
            if pressure == 0.0 && gradient == [0.0; 3] {
                continue;
            }
            let volume = set.columns[Layout::VOLUME][p];
            let term = (-volume * pressure, gradient.map(|g| -volume * g));
            if view.stencil == 3 {
                sums.add::<3>(set, body, p, &local, term, self.averaged);
            } else {
                sums.add::<4>(set, body, p, &local, term, self.averaged);
            }
        }
    }
}

/// Half-length in cells of the piece that stands for a particle without a domain: that of two to a cell.
const OF_POINTS: f64 = 0.25;

/// Calls `act` for each node of a field with mass on which water presses, with its part of the force \[N\] and the sums of the slab.
fn for_forces(
    field: &mut FieldNodes<'_, '_>,
    mut act: impl FnMut(&mut Line, Vector, &mut ExactStepSums),
) {
    let owner = field.owner();
    // Both phases share the forces of the first field.
    let number = if owner == Owner::Water {
        0
    } else {
        field.number
    };
    let context = field.context;
    let Some(pressed) = context.nodal().standing.get(number) else {
        return;
    };
    if pressed.forces.is_empty() {
        return;
    }
    let (shape, range) = (field.slab.shape(), field.slab.range());
    let first = range.start * shape.plane_nodes();
    let rows = field.slab.fields[number].planes.rows;
    for plane in range {
        for row in rows.in_plane(plane) {
            let span = rows.span(plane, row);
            let start = pressed.starts[plane * shape.nodes[1] + row];
            let forces = &pressed.forces[start..start + span.len()];
            for (k, force) in span.zip(forces) {
                if *force == [0.0; 3] {
                    continue;
                }
                let node = shape.index([plane, row, k]);
                let n = if number == 0 {
                    porosity_at(field.slab, context, node)
                } else {
                    None
                };
                let share = match (owner, n) {
                    (Owner::Water, n) => n.unwrap_or(0.0),
                    (_, n) => 1.0 - n.unwrap_or(0.0),
                };
                let (planes, _, sums) = field.parts();
                let line = &mut planes.nodes[node - first];
                if planes.rows.span(plane, row).contains(&k) && line[0] > 0.0 {
                    let force = force.map(|f| f * share);
                    act(line, force, sums);
                }
            }
        }
    }
}
