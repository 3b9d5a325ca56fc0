//! The time step that the stiffness of contact allows at the nodes of the bodies.

use super::boundaries::Boundaries;
use super::mirrors::Mirrors;
use super::surface::stays;
use crate::geometry::mortar::bound::NodalStiffness;
use crate::geometry::mortar::elements::Elements;
use proctor_kernel::simulation::StepView;

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Time step that the stiffness of all contacts allows \[s\]; `nodes` is memory.
    pub(super) fn time_step(&mut self, nodes: &mut NodalStiffness, view: &StepView<'_>) -> f64 {
        let mut most = f64::INFINITY;
        let (shape, mirrors) = (&view.grid.shape, Mirrors::of(view.settings));
        for (s, surface) in self.surfaces.iter_mut().enumerate() {
            let field = surface.body().and_then(|index| view.grid.own_field(index));
            let tied = surface.tied.as_mut().filter(|_| stays(&surface.carrier));
            let tied = tied.zip(field);
            let mut of_vertices = std::mem::take(&mut surface.stiffness);
            of_vertices.clear();
            of_vertices.resize(
                if tied.is_some() {
                    surface.start.len()
                } else {
                    0
                },
                0.0,
            );
            nodes.clear();
            for pair in &self.pairs {
                for (of, stiffness) in [
                    (pair.slave, &pair.forces.slave_stiffness),
                    (pair.master, &pair.forces.master_stiffness),
                ] {
                    if of != s {
                        continue;
                    }
                    for (sum, k) in of_vertices.iter_mut().zip(stiffness) {
                        *sum += k;
                    }
                    if tied.is_some() {
                        continue;
                    }
                    for (patch, k) in surface.patches.iter().zip(stiffness) {
                        nodes.add(&patch.nodes, &patch.weights.weights, &patch.masses, *k);
                    }
                }
            }
            if let Some((tied, field)) = tied {
                let lines = field.nodes.lines();
                tied.stiffen(nodes, &of_vertices, lines, shape, &mirrors);
            } else if surface.pressed {
                for pair in &self.pairs {
                    for (of, stiffness) in [
                        (pair.slave, &pair.forces.slave_stiffness),
                        (pair.master, &pair.forces.master_stiffness),
                    ] {
                        if of != s {
                            continue;
                        }
                        for (patch, k) in surface.patches.iter().zip(stiffness) {
                            nodes.sharpen(&patch.nodes, &patch.weights.weights, &patch.masses, *k);
                        }
                    }
                }
            }
            surface.stiffness = of_vertices;
            most = most.min(nodes.time_step());
        }
        most
    }
}
