//! The time step that the stiffness of the contact allows.
//!
//! The frequency of the nodes on the springs of the contact is bounded by row sums (Gershgorin):
//! omega² <= 2 max_I (sum_v S_Iv K_v)/m_I with the stiffness K_v of the contact at a vertex. The factor 2 is for the
//! other body, which may be as light. The printed rule, dt times the smallest gap over the critical gap, shortens the
//! step also where the contact is far from limiting (a resting disk forty times), and goes to zero with the gap.

use super::weights::{VertexWeights, in_patch};
use std::array;
use std::collections::BTreeMap;

/// Share of the bound 2/omega that is used.
pub const SAFETY: f64 = 0.5;

/// Stiffness over mass of the nodes of one body's layer of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalStiffness<const D: usize>(BTreeMap<[i64; D], f64>);

impl<const D: usize> NodalStiffness<D> {
    /// Adds a vertex: its augmented weights, the masses of the nodes of its patch \[kg\] and the stiffness of the
    /// contact at it \[N/m\].
    pub fn add<const N: usize>(
        &mut self,
        weights: &VertexWeights<D, N>,
        masses: &[f64; N],
        stiffness: f64,
    ) {
        if stiffness == 0.0 {
            return;
        }
        for k in 0..N {
            if masses[k] > 0.0 {
                let at = in_patch::<D>(k);
                let node = array::from_fn(|axis| weights.base[axis] + at[axis] as i64);
                *self.0.entry(node).or_insert(0.0) += weights.weights[k] * stiffness / masses[k];
            }
        }
    }

    /// Bound of the angular frequency \[1/s\]; 0 without contact.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (2.0 * self.0.values().copied().fold(0.0, f64::max)).sqrt()
    }

    /// Largest time step \[s\], half of 2/omega; infinite without contact.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        SAFETY * 2.0 / self.frequency()
    }
}
