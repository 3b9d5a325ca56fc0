//! Bars between rollers and blocks in the open.

use crate::cases::prelude::*;
use crate::exact::bar_impact::{BarImpact, MovingBar};

/// Length of the first body \[m\].
pub const LENGTH: f64 = 1.0;
const YOUNG: f64 = 1e6; // Young's modulus of the first body [Pa]
const DENSITY: f64 = 1e3; // Density of the first body [kg/m³]; waves run at 31.6 m/s
const SPEED: f64 = 1e-3; // Speed of a bar over that of waves: strains stay small
const BLOCK_SPEED: f64 = 1e-2; // Speed of a block over that of waves
const POISSON: f64 = 0.3; // Poisson's ratio of the blocks; that of the bars is zero
const FRICTION: f64 = 0.3; // Friction of the blocks
/// `c dt/h`.
pub const COURANT: f64 = 0.3;
const AIR: usize = 3; // Empty cells beyond the far ends

/// Pair that collides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Bars end to end; the second is so many times as long.
    Bars(f64),
    /// Blocks, off centre by a quarter of their height.
    Blocks,
}

/// A collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variant {
    /// Its word.
    pub name: &'static str,
    /// Pair that collides.
    pub kind: Kind,
    /// Density of the second body over that of the first.
    pub density: f64,
    /// Its stiffness over that of the first.
    pub stiffness: f64,
    /// Number of dimensions.
    pub dimension: Dimension,
    /// Stress scheme.
    pub scheme: StressScheme,
    /// Transfer.
    pub transfer: TransferKind,
}

const fn bars(name: &'static str, longer: f64, ratio: f64) -> Variant {
    Variant {
        name,
        kind: Kind::Bars(longer),
        density: ratio,
        stiffness: ratio,
        dimension: Dimension::Two,
        scheme: StressScheme::Usl,
        transfer: TransferKind::Flip,
    }
}

const fn blocks(name: &'static str, ratio: f64, scheme: StressScheme) -> Variant {
    Variant {
        kind: Kind::Blocks,
        scheme,
        ..bars(name, 1.0, ratio)
    }
}

/// All collisions.
pub const VARIANTS: [Variant; 14] = [
    bars("bars 1:1", 1.0, 1.0),
    Variant {
        scheme: StressScheme::Usf,
        ..bars("bars 1:1 USF", 1.0, 1.0)
    },
    Variant {
        scheme: StressScheme::Musl,
        ..bars("bars 1:1 MUSL", 1.0, 1.0)
    },
    bars("bars 1:1e3", 1.0, 1e3),
    bars("bars 1:1e6", 1.0, 1e6),
    bars("bars 1:2 long", 2.0, 1.0),
    // Neither transits nor impedances are the same.
    Variant {
        stiffness: 3.0,
        ..bars("bars 1:7, three times as stiff", 1.0, 7.0)
    },
    Variant {
        dimension: Dimension::Three,
        ..bars("bars 1:1 3D", 1.0, 1.0)
    },
    blocks("blocks 1:1", 1.0, StressScheme::Usl),
    blocks("blocks 1:1e3", 1e3, StressScheme::Usl),
    blocks("blocks 1:1e6", 1e6, StressScheme::Usl),
    blocks("blocks 1:1 USF", 1.0, StressScheme::Usf),
    blocks("blocks 1:1 MUSL", 1.0, StressScheme::Musl),
    Variant {
        dimension: Dimension::Three,
        ..blocks("blocks 1:1 3D", 1.0, StressScheme::Usl)
    },
];

impl Variant {
    /// Cells along the first body, coarse to fine.
    pub fn cells(&self, size: Size) -> &'static [u32] {
        match (self.kind, self.dimension, size) {
            (Kind::Bars(_), Dimension::Two, Size::Quick) => &[16, 32, 64],
            (Kind::Bars(_), Dimension::Two, Size::Full) => &[16, 32, 64, 128, 256],
            (Kind::Bars(_), Dimension::Three, Size::Quick) => &[32],
            (Kind::Bars(_), Dimension::Three, Size::Full) => &[32, 64],
            (Kind::Blocks, _, Size::Quick) => &[4],
            (Kind::Blocks, Dimension::Three, Size::Full) => &[8],
            (Kind::Blocks, Dimension::Two, Size::Full) => &[8, 16],
        }
    }

    /// Velocities before the collision \[m/s\]: the first body runs into the second, which comes half as fast.
    pub fn velocities(&self) -> [f64; 2] {
        let speed = match self.kind {
            Kind::Bars(_) => SPEED,
            Kind::Blocks => BLOCK_SPEED,
        } * (YOUNG / DENSITY).sqrt();
        [speed, -0.5 * speed]
    }

    /// Lengths of the bodies \[m\].
    fn lengths(&self) -> [f64; 2] {
        match self.kind {
            Kind::Bars(longer) => [LENGTH, longer * LENGTH],
            Kind::Blocks => [LENGTH; 2],
        }
    }

    /// The impact of bars.
    pub fn impact(&self) -> Option<BarImpact> {
        let [v_1, v_2] = self.velocities();
        let [l_1, l_2] = self.lengths();
        let bar = |length, velocity, stiffness: f64, density: f64| MovingBar {
            length,
            modulus: YOUNG * stiffness,
            density: DENSITY * density,
            velocity,
        };
        matches!(self.kind, Kind::Bars(_)).then(|| BarImpact {
            bars: [
                bar(l_1, v_1, 1.0, 1.0),
                bar(l_2, v_2, self.stiffness, self.density),
            ],
        })
    }

    /// Cross-section of a bar of a scene \[m²\]: one cell wide and high, in two dimensions 1 m thick.
    pub fn section(scene: &Scene) -> f64 {
        scene.mesh.cell[1] * scene.mesh.cell[2]
    }

    /// The scene but for what settings say. Bars touch at the start; so do blocks. It lasts for three transits along the longer
    /// body, and half as long again as bars press on each other.
    pub fn scene(&self, h: f64) -> Scene {
        let [l_1, l_2] = self.lengths();
        let air = AIR as f64 * h;
        let cells = |length: f64| (length / h).round() as usize;
        let height = match self.kind {
            Kind::Bars(_) => h,
            Kind::Blocks => 1.25 * LENGTH + 2.0 * air,
        };
        let high = cells(height);
        let counts = [cells(l_1 + l_2) + 2 * AIR, high, high];
        let mut mesh = Mesh::new(self.dimension, [0.0; 3], [h; 3], counts);
        mesh.planes[0] = [PlaneCondition::Free; 2];
        if self.kind == Kind::Blocks {
            mesh.planes[..self.dimension.axes()].fill([PlaneCondition::Free; 2]);
        }
        let transit = l_1.max(l_2) / (YOUNG / DENSITY).sqrt();
        let pressed = self.impact().and_then(|impact| impact.press());
        let time = pressed.map_or(0.0, |press| 1.5 * press.parted);
        let mut scene = bare_scene(
            "colliding_blocks",
            self.dimension,
            mesh,
            time.max(3.0 * transit),
        );
        let (poisson, friction) = match self.kind {
            Kind::Bars(_) => (0.0, 0.0),
            Kind::Blocks => (POISSON, FRICTION),
        };
        scene.materials = [(1.0, 1.0), (self.stiffness, self.density)]
            .into_iter()
            .enumerate()
            .map(|(i, (stiffness, density))| Material {
                name: format!("elastic {}", i + 1),
                id: i as i64 + 1,
                density: DENSITY * density,
                law: elastic_law(YOUNG * stiffness, poisson),
            })
            .collect();
        let flat = self.dimension == Dimension::Two;
        let starts = [air, air + l_1];
        scene.bodies = (0..2)
            .map(|i| {
                // Off centre by a quarter, along both axes across.
                let (low, high) = match self.kind {
                    Kind::Bars(_) => (0.0, h),
                    Kind::Blocks => {
                        let low = air + 0.25 * LENGTH * i as f64;
                        (low, low + LENGTH)
                    }
                };
                let far = starts[i] + self.lengths()[i];
                let deep = |height: f64| if flat { 0.0 } else { height };
                let shape = cuboid([starts[i], low, deep(low)], [far, high, deep(high)]);
                Body {
                    material: i,
                    velocity: [self.velocities()[i], 0.0, 0.0],
                    ..body(format!("body {}", i + 1), i as i64 + 1, shape)
                }
            })
            .collect();
        scene.contacts = contact("contact", [1, 2], friction, ContactNormal::Collinear);
        scene
    }
}
