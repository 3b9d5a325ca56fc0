//! The equation of motion at the nodes of one slab, the same for all velocity fields.

use super::fields::{Owner, Slab, SlabField};
use super::interaction::{Now, OnSlab};
use crate::grid::Line;
use crate::scene::Vector;
use crate::stage::solve::{DrivenNode, EmptyNode, Forces, NodeForce, PlaneSums, Planes, Wall};
use std::borrow::Cow;

/// From mapped sums to velocities that keep to the walls, to driven bodies and to each other; the sums of each plane.
pub(super) fn solve(
    slab: &mut Slab<'_>,
    parts: &mut [Box<dyn OnSlab + '_>],
    now: &Now<'_>,
) -> Result<Vec<PlaneSums>, EmptyNode> {
    for part in parts.iter_mut() {
        part.mapped(slab, now);
    }
    let loads = shared_loads(slab, now)?;
    let mut sums = vec![PlaneSums::default(); slab.range().len()];
    for (field, own) in slab.fields.iter_mut().zip(&loads) {
        let forces = Forces {
            loads: own,
            ..now.forces
        };
        equation_of_motion(field, now, &forces, &mut sums)?;
    }
    for part in parts.iter_mut() {
        part.correct(slab, now, &mut sums);
    }
    for planes in slab.planes() {
        planes.unfold(&now.walls, true);
    }
    if !now.settles {
        add_sums(slab, &loads, now, &mut sums);
    }
    Ok(sums)
}

/// From the mapped sums of a field to trial velocities that keep to the walls and to driven bodies.
fn equation_of_motion(
    field: &mut SlabField<'_>,
    now: &Now<'_>,
    forces: &Forces<'_>,
    sums: &mut [PlaneSums],
) -> Result<(), EmptyNode> {
    if let Some(velocities) = now.prescribed(field.owner) {
        prescribe(&mut field.planes, velocities, &now.walls);
        return Ok(());
    }
    let (planes, driven) = (&mut field.planes, now.driven_nodes(field.owner));
    planes.load(forces.loads)?;
    planes.accelerate(forces);
    planes.add_power_of_driven(driven, forces.kick, sums);
    planes.drive(driven, true);
    planes.add_power_of_walls(&now.walls, forces.kick, sums);
    planes.constrain(&now.walls, true);
    Ok(())
}

/// Ghost nodes of all fields, and the sums of each plane with the velocities that they hold.
pub(super) fn sums_after(slab: &mut Slab<'_>, now: &Now<'_>) -> Vec<PlaneSums> {
    for planes in slab.planes() {
        planes.unfold(&now.walls, true);
    }
    let mut sums = vec![PlaneSums::default(); slab.range().len()];
    // The loads found their nodes when they were added.
    if let Ok(loads) = shared_loads(slab, now) {
        add_sums(slab, &loads, now, &mut sums);
    }
    sums
}

/// Adds the sums of all fields whose motion is not prescribed to those of the planes. `loads` are those of each field.
fn add_sums(
    slab: &mut Slab<'_>,
    loads: &[Cow<'_, [NodeForce]>],
    now: &Now<'_>,
    sums: &mut [PlaneSums],
) {
    for (field, own) in slab.fields.iter().zip(loads) {
        if now.prescribed(field.owner).is_some() {
            continue;
        }
        let forces = Forces {
            loads: own,
            ..now.forces
        };
        let mut own = vec![PlaneSums::default(); sums.len()];
        field.planes.add_sums(&forces, now.measure, &mut own);
        for (sums, own) in sums.iter_mut().zip(&own) {
            sums.power += own.power;
            sums.kinetic += own.kinetic;
            sums.unbalanced_squared += own.unbalanced_squared;
        }
    }
}

/// Shares nodal loads between the fields of a node by their mass. Lists by number of the field.
fn shared_loads<'l>(
    slab: &Slab<'_>,
    now: &'l Now<'_>,
) -> Result<Vec<Cow<'l, [NodeForce]>>, EmptyNode> {
    let loads = now.forces.loads;
    if slab.fields.len() == 1 || loads.is_empty() {
        return Ok(vec![Cow::Borrowed(loads); slab.fields.len()]);
    }
    let shape = slab.shape();
    let first = slab.range().start * shape.plane_nodes();
    let last = slab.range().end * shape.plane_nodes();
    let mut shared = vec![vec![]; slab.fields.len()];
    for load in loads.iter().filter(|l| (first..last).contains(&l.node)) {
        let [plane, row, k] = shape.indices(load.node);
        let mass = |field: &SlabField<'_>| {
            let free = now.prescribed(field.owner).is_none();
            if free && field.planes.rows.span(plane, row).contains(&k) {
                field.planes.nodes[load.node - first][0]
            } else {
                0.0
            }
        };
        let masses: Vec<f64> = slab.fields.iter().map(mass).collect();
        let total: f64 = masses.iter().sum();
        if total <= 0.0 {
            return Err(EmptyNode(load.node));
        }
        for (own, mass) in shared.iter_mut().zip(masses) {
            if mass > 0.0 {
                own.push(NodeForce {
                    force: load.force.map(|f| f * (mass / total)),
                    ..*load
                });
            }
        }
    }
    Ok(shared.into_iter().map(Cow::Owned).collect())
}

/// From sums that were mapped again, to the upper lanes (MUSL), to velocities that keep to walls, driven bodies and each
/// other.
pub(super) fn solve_remapped(
    slab: &mut Slab<'_>,
    parts: &mut [Box<dyn OnSlab + '_>],
    now: &Now<'_>,
) {
    for field in &mut slab.fields {
        let planes = &mut field.planes;
        planes.clear_upper();
        if let Some([_, after]) = now.prescribed(field.owner) {
            for_masses(planes, |line| line[4..7].copy_from_slice(after));
        } else {
            now.mapping.run_field(field);
            let planes = &mut field.planes;
            planes.fold_remapped(&now.walls);
            planes.remapped_velocities();
            planes.drive_remapped(now.driven_nodes(field.owner));
        }
        field.planes.constrain_remapped(&now.walls);
    }
    // Contact keeps to the planes once the fields do; the ghosts are filled after it.
    for part in parts {
        part.correct_again(slab, now);
        for planes in slab.planes() {
            planes.constrain_remapped(&now.walls);
        }
    }
}

/// The same for momentum that was mapped at new positions, to the lower lanes (USF).
pub(super) fn solve_mapped(slab: &mut Slab<'_>, parts: &mut [Box<dyn OnSlab + '_>], now: &Now<'_>) {
    now.mapping.run(slab);
    for planes in slab.planes() {
        planes.fold(&now.walls, true, false);
        planes.velocities();
    }
    for part in parts.iter_mut() {
        part.mapped(slab, now);
    }
    for field in &mut slab.fields {
        let planes = &mut field.planes;
        if let Some(velocities) = now.prescribed(field.owner) {
            prescribe(planes, velocities, &now.walls);
        } else {
            planes.drive(now.driven_nodes(field.owner), false);
            planes.constrain(&now.walls, false);
        }
    }
    for part in parts {
        part.correct_again(slab, now);
    }
    for planes in slab.planes() {
        planes.unfold(&now.walls, false);
    }
}

/// Gives the nodes of a driven body its velocity.
fn prescribe(planes: &mut Planes<'_>, [before, after]: &[Vector; 2], walls: &[Wall]) {
    for_masses(planes, |line| {
        for axis in 0..3 {
            line[1 + axis] = after[axis];
            line[4 + axis] = after[axis] - before[axis];
        }
    });
    planes.constrain(walls, true);
}

/// Calls `act` for every node in use that has mass.
fn for_masses(planes: &mut Planes<'_>, act: impl Fn(&mut Line)) {
    planes.for_rows(|row| row.iter_mut().filter(|line| line[0] > 0.0).for_each(&act));
}

/// Walls for a mapping of the velocities after the kick: both half-steps are the later one.
pub(super) fn at_half_step_after(walls: &[Wall]) -> Vec<Wall> {
    walls
        .iter()
        .map(|wall| Wall {
            before: wall.after,
            ..*wall
        })
        .collect()
}

/// Adds up plane after plane, so that the slabs do not matter.
pub(super) fn total<'a>(planes: impl IntoIterator<Item = &'a PlaneSums>) -> PlaneSums {
    let mut total = PlaneSums::default();
    for plane in planes {
        total.power += plane.power;
        total.kinetic += plane.kinetic;
        total.unbalanced_squared += plane.unbalanced_squared;
    }
    total
}

impl Now<'_> {
    /// Nodes of a field that move as prescribed.
    fn driven_nodes(&self, owner: Owner) -> &[DrivenNode] {
        match owner {
            Owner::Phase => &self.acting.driven,
            Owner::Body(_) => &self.acting.held,
        }
    }

    /// Velocities half a step before and after \[m/s\] where the motion of the whole field is prescribed.
    pub(super) fn prescribed(&self, owner: Owner) -> Option<&[Vector; 2]> {
        self.prescribed[owner.body()?].as_ref()
    }
}
