//! Queries of a simulation: what it was set up with, and values of single particles.

use crate::running::Simulation;
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::Vector;
use proctor_kernel::plan::Plan;
use proctor_kernel::simulation::BodyHandle;

impl Simulation {
    /// The plan.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.model().plan
    }

    /// Number of velocity fields beside that of the phase: bodies with a boundary, or near a partner of contact.
    #[must_use]
    pub fn contact_layers(&self) -> usize {
        let grid = self.view().grid;
        grid.fields.len() - 1 - usize::from(grid.has_water)
    }

    /// True where bodies have water in their pores.
    #[must_use]
    pub fn has_water(&self) -> bool {
        self.view().grid.has_water
    }

    /// Number of threads in use.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.team().count()
    }

    /// Lanes in use.
    #[must_use]
    pub fn lanes(&self) -> SelectedLanes {
        self.model().lanes
    }

    /// Names of the internal variables of all laws, each once, with the number of the component where there are several.
    #[must_use]
    pub fn variables(&self) -> Vec<String> {
        let mut names: Vec<String> = vec![];
        let sets = self.sets().iter();
        for (variable, i, _) in sets.flat_map(|set| set.layout.components()) {
            let name = variable.component(i);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// Displacement of a particle since the start \[m\], where the plan keeps it.
    #[must_use]
    pub fn displacement(&self, body: impl Into<BodyHandle>, p: usize) -> Option<Vector> {
        let set = self.particles_of(body);
        let origin = set.vector(set.layout.displacement_origin?, p);
        let (x, shift) = (set.position(p), self.view().mesh_shift);
        Some(std::array::from_fn(|axis| {
            x[axis] - origin[axis] + shift[axis]
        }))
    }

    /// Position of a particle at the start in the coordinates of the scene \[m\], where the plan keeps it.
    #[must_use]
    pub fn initial_position(&self, body: impl Into<BodyHandle>, p: usize) -> Option<Vector> {
        let set = self.particles_of(body);
        let x = set.vector(set.layout.displacement_origin?, p);
        Some(std::array::from_fn(|axis| {
            x[axis] + self.model().settings.mesh.origin[axis]
        }))
    }

    /// Deformation gradient of a particle, where the plan keeps it.
    #[must_use]
    pub fn deformation(&self, body: impl Into<BodyHandle>, p: usize) -> Option<[[f64; 3]; 3]> {
        self.particles_of(body).deformation(p)
    }

    /// Mass of a particle \[kg\].
    #[must_use]
    pub fn particle_mass(&self, body: impl Into<BodyHandle>, p: usize) -> f64 {
        self.particles_of(body).columns[Layout::MASS][p]
    }

    /// Volume of a particle \[m³\].
    #[must_use]
    pub fn particle_volume(&self, body: impl Into<BodyHandle>, p: usize) -> f64 {
        self.particles_of(body).columns[Layout::VOLUME][p]
    }

    /// External force on a particle \[N\]: its weight, box loads and body force.
    #[must_use]
    pub fn external_force(&self, body: impl Into<BodyHandle>, p: usize) -> Vector {
        let particles = self.particles_of(body);
        let own = particles
            .layout
            .force
            .map_or([0.0; 3], |first| particles.vector(first, p));
        let m = particles.columns[Layout::MASS][p];
        std::array::from_fn(|axis| m * self.model().settings.gravity[axis] + own[axis])
    }
}
