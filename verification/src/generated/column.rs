//! Columns between smooth sides: layers above each other that come to rest.

use proctor_scene::{
    Body, BoxLoad, Damping, Dimension, DomainUpdate, Material, Mesh, PlaneCondition, Scene,
    Transfer, TransferKind, Weighting,
};

use super::change::Frame;
use super::dice::Dice;
use super::seen::{FinalState, Particle};
use super::{crowd, law};
use crate::cases::{NO_RESULTS, body, cuboid};

/// Weighting functions. Linear ones jump where a particle lies on a line of the mesh ("Known limits" of the kernel).
const WEIGHTINGS: [Weighting; 3] = [
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
    Weighting::QuadraticBSpline,
];

/// A layer.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// Height \[cells\].
    pub height: f64,
    /// Young's modulus over that of the softest.
    pub stiffness: f64,
    /// Density over that of the lightest.
    pub density: f64,
}

/// A column of layers on a level.
#[derive(Clone, Debug)]
pub struct Column {
    /// The scene, upright: its last axis points upwards.
    pub scene: Scene,
    /// Lower face of the lowest layer and upper faces of all \[m\].
    pub faces: Vec<f64>,
    /// Coefficient of earth pressure at rest of each layer, nu/(1 - nu).
    pub ratios: Vec<f64>,
    /// Confined modulus of each layer \[Pa\].
    pub moduli: Vec<f64>,
    /// Lower bound of the lowest angular frequency \[1/s\] (Dunkerley).
    pub frequency: f64,
}

/// Largest strain of the softest layer: small, so that the answer is that of small strain.
const STRAIN: [f64; 2] = [2e-5, 2e-4];

impl Column {
    /// Layers, bodies 1, 2 … from below, whose lower face is so many cells above the lower plane of the mesh; `free`
    /// cells lie beside the column on both sides, with free planes, or none, with sliding ones.
    pub fn new(
        dice: &mut Dice,
        dimension: Dimension,
        below: f64,
        layers: &[Layer],
        free: usize,
    ) -> Self {
        let axes = dimension.axes();
        let up = axes - 1;
        let h = dice.cell();
        let total: f64 = layers.iter().map(|layer| layer.height).sum();
        let wide = if axes == 2 { dice.whole(1, 3) } else { 1 };
        let mut cells = [wide + 2 * free; 3];
        cells[up] = (below + total).ceil() as usize + 3;
        if axes == 2 {
            cells[2] = 1;
        }
        let origin = dice.pick(&[0.0, 0.0, -5.0 * h, 0.37 * h]);
        let origin: [f64; 3] = std::array::from_fn(|a| if a < axes { origin } else { 0.0 });
        let mesh = Mesh::new(dimension, origin, [h; 3], cells);
        let side = if free == 0 {
            PlaneCondition::Sliding
        } else {
            PlaneCondition::Free
        };
        let mut scene = Scene::new(dimension, mesh, 1.0).with_planes(side);
        scene.mesh.planes[up] = [PlaneCondition::Sliding, PlaneCondition::Free];
        scene.results = NO_RESULTS;
        scene.weighting = dice.pick(&WEIGHTINGS);
        scene.scheme = dice.pick(&crowd::SCHEMES);
        scene.transfer =
            Transfer::new(dice.pick(&[TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic]));
        let young = dice.decades(1e4, 1e8);
        let density = dice.decades(100.0, 5e3);
        let mut column = Self {
            scene,
            faces: vec![origin[up] + below * h],
            ratios: vec![],
            moduli: vec![],
            frequency: 0.0,
        };
        let particles = dice.pick(&[2, 2, if axes == 2 { 3 } else { 2 }]);
        for (index, layer) in layers.iter().enumerate() {
            column.add(dice, index, layer, [young, density], particles, free);
        }
        column.rest(dice, layers.iter().all(|layer| layer.stiffness == 1.0));
        column
    }

    /// Adds a layer with its material.
    fn add(
        &mut self,
        dice: &mut Dice,
        index: usize,
        layer: &Layer,
        [young, density]: [f64; 2],
        particles: usize,
        free: usize,
    ) {
        let axes = self.scene.dimension.axes();
        let (up, mesh) = (axes - 1, &self.scene.mesh);
        let h = mesh.cell[0];
        let young = young * layer.stiffness;
        let law = law::elastic(dice, young);
        let density = density * layer.density;
        let modulus = density * law.wave_speed(density) * law.wave_speed(density);
        // M/E = (1 - nu)/((1 + nu)(1 - 2 nu)) has no inverse in short; nu is a constant of the law.
        let poisson = law.constants()[1].1;
        let (mut p1, mut p2) = (mesh.origin, mesh.upper());
        for axis in 0..up {
            p1[axis] += free as f64 * h;
            p2[axis] -= free as f64 * h;
        }
        p1[up] = self.top();
        p2[up] = self.top() + layer.height * h;
        if axes == 2 {
            (p1[2], p2[2]) = (0.0, 0.0);
        }
        self.faces.push(p2[up]);
        let mut own = body(
            format!("layer {}", index + 1),
            index as i64 + 1,
            cuboid(p1, p2),
        );
        own.material = index;
        own.particles_per_cell[..axes].fill(particles);
        self.ratios.push(poisson / (1.0 - poisson));
        self.moduli.push(modulus);
        self.scene.materials.push(Material {
            name: format!("material {}", index + 1),
            id: index as i64 + 1,
            density,
            law,
        });
        self.scene.bodies.push(own);
    }

    /// Damping, and a time after which nothing moves.
    fn rest(&mut self, dice: &mut Dice, alike: bool) {
        // Compliance below each slice times its mass, summed: 1/omega_1^2 is no more (Dunkerley).
        let (mut sum, mut compliance) = (0.0, 0.0);
        for (index, faces) in self.faces.windows(2).enumerate() {
            let height = faces[1] - faces[0];
            let mass = height * self.scene.materials[index].density;
            let own = height / self.moduli[index];
            sum += mass * (compliance + 0.5 * own);
            compliance += own;
        }
        self.frequency = 1.0 / sum.sqrt();
        // Viscous damping is that of each material: layers that are alike are damped alike.
        if alike && dice.chance(0.5) {
            let material = &self.scene.materials[0];
            let rate = (material.law.young() / material.density).sqrt() / self.h();
            let share = dice.between(1.2, 2.0);
            self.scene.damping = Damping::Viscous {
                alpha: share * self.frequency / rate,
            };
            self.scene.time = 14.0 / self.frequency;
        } else {
            let alpha = dice.between(0.6, 0.8);
            self.scene.damping = Damping::Local { alpha };
            self.scene.time = 40.0 / self.frequency;
        }
    }

    /// The upper face \[m\].
    pub fn top(&self) -> f64 {
        self.faces.last().copied().unwrap_or(0.0)
    }

    /// Edge of a cell \[m\].
    pub fn h(&self) -> f64 {
        self.scene.mesh.cell[0]
    }

    /// The axis that points upwards.
    pub fn up(&self) -> usize {
        self.scene.dimension.axes() - 1
    }

    /// Presses on the uppermost two rows of particles, and returns the pressure below them \[Pa\] and their lower end \[m\].
    pub fn press(&mut self, dice: &mut Dice) -> (f64, f64) {
        let softest = self.moduli.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let pressure = softest * dice.decades(STRAIN[0], STRAIN[1]);
        let up = self.up();
        let last: &Body = &self.scene.bodies[self.faces.len() - 2];
        let (mut p1, p2) = crowd::corners(last);
        let height = p2[up] - p1[up];
        let rows = height / self.h() * last.particles_per_cell[up] as f64;
        let rows = (rows - 1e-6).ceil();
        p1[up] = p2[up] - 2.0 * height / rows;
        let area: f64 = (0..up).map(|axis| p2[axis] - p1[axis]).product();
        let mut force = [0.0; 3];
        force[up] = -pressure * area;
        self.scene.box_loads.push(BoxLoad { p1, p2, force });
        (pressure, p1[up])
    }

    /// Turns the scene so that its up is any axis, in any direction; returns the frame.
    pub fn turn(&mut self, dice: &mut Dice) -> Frame {
        let (axes, up) = (self.scene.dimension.axes(), self.up());
        let mut frame = Frame::SAME;
        let to = dice.whole(0, axes - 1);
        (frame.to[up], frame.to[to]) = (to, up);
        frame.sign[up] = dice.sign();
        self.scene = frame.scene(&self.scene);
        frame
    }
}

/// Height of a particle at the start, along the axis that was up \[m\].
pub fn height(p: &Particle, frame: &Frame, up: usize) -> f64 {
    frame.sign[up] * p.start[frame.to[up]]
}

/// Stress along the axis that was up \[Pa\].
pub fn vertical(p: &Particle, frame: &Frame, up: usize) -> f64 {
    p.stress[frame.to[up]]
}

/// Largest share of a number by which the vertical stress of a particle is off, among those that `asked` gives an exact stress
/// \[Pa\] and the number \[Pa\].
pub fn off(
    seen: &FinalState,
    frame: &Frame,
    up: usize,
    asked: impl Fn(f64, i64) -> Option<(f64, f64)>,
) -> f64 {
    let of = |p: &Particle| {
        let (exact, over) = asked(height(p, frame, up), p.body)?;
        Some((vertical(p, frame, up) - exact) / over)
    };
    super::seen::largest(seen.particles.iter().filter_map(of))
}
