//! Nodes of absorbing planes, as the state keeps them.

use crate::model::Vector;

/// A node of one or more absorbing planes: the ground that goes on beyond it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AbsorbingNode {
    /// Index of the node in the grid.
    pub node: usize,
    /// Impedance of its dashpot per axis, area times density times wave speed \[N s/m\]; zero where the velocity is prescribed.
    pub impedance: Vector,
    /// Stiffness of its spring per axis \[N/m\].
    pub stiffness: Vector,
    /// Force that balances the stress and the weight of the start \[N\].
    pub reaction: Vector,
    /// Displacement since the start \[m\].
    pub displacement: Vector,
}

impl AbsorbingNode {
    /// Numbers of [`AbsorbingNode::to_numbers`].
    pub const NUMBERS: usize = 12;

    /// All of it but the node, for a file.
    #[must_use]
    pub fn to_numbers(&self) -> [f64; Self::NUMBERS] {
        let vectors = [
            &self.impedance,
            &self.stiffness,
            &self.reaction,
            &self.displacement,
        ];
        std::array::from_fn(|i| vectors[i / 3][i % 3])
    }

    /// The node with those numbers.
    #[must_use]
    pub fn from_numbers(node: usize, numbers: &[f64; Self::NUMBERS]) -> Self {
        let vector = |first: usize| std::array::from_fn(|axis| numbers[3 * first + axis]);
        Self {
            node,
            impedance: vector(0),
            stiffness: vector(1),
            reaction: vector(2),
            displacement: vector(3),
        }
    }
}
