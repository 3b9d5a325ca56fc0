//! Nodes of the free ground beside absorbing sides, as the state keeps them.

use crate::model::Vector;

/// A node of a column of free ground: level ground that an absorbing side borders on, and that the base shakes too.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FreeGroundNode {
    /// Its place in the list of the nodes of absorbing planes.
    pub absorbing: usize,
    /// True if the base prescribes its velocity.
    pub is_held: bool,
    /// True if the wave from below comes in at it.
    pub enters: bool,
    /// Mass per area of the column \[kg/m²\].
    pub mass: f64,
    /// Rate of viscous damping \[1/s\].
    pub damping_rate: f64,
    /// Stiffness per area of the link to the node before it in the list, in shear and in compression \[Pa/m\]; zero at the first
    /// node of a column.
    pub stiffness: [f64; 2],
    /// Impedance per area of the dashpot below it, for shear and compression \[Pa s/m\]; zero where there is none.
    pub base: [f64; 2],
    /// Area of the sides that it stands for, along their outward normals \[m²\].
    pub area: Vector,
    /// Impedance of the dashpots between it and the node of the side per axis \[N s/m\].
    pub impedance: Vector,
    /// Stiffness of the springs between them per axis \[N/m\].
    pub spring: Vector,
    /// Velocity, half a step behind \[m/s\].
    pub velocity: Vector,
    /// Displacement since the start \[m\].
    pub displacement: Vector,
}

impl FreeGroundNode {
    /// Numbers of [`FreeGroundNode::motion`].
    pub const NUMBERS: usize = 6;

    /// Its velocity and its displacement, for a file; all else follows from the scene.
    #[must_use]
    pub fn motion(&self) -> [f64; Self::NUMBERS] {
        let ([u, v, w], [x, y, z]) = (self.velocity, self.displacement);
        [u, v, w, x, y, z]
    }

    /// Takes the motion of a file.
    pub fn set_motion(&mut self, [u, v, w, x, y, z]: [f64; Self::NUMBERS]) {
        (self.velocity, self.displacement) = ([u, v, w], [x, y, z]);
    }
}
