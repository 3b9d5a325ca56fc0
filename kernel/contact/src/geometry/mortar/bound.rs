//! The time steps that the stiffness of a contact and its closing allow.
//!
//! The frequency of the nodes on the springs of the contact is bounded by row sums (Gershgorin):
//! omega² <= 2 max_I (sum_v S_Iv K_v)/m_I with the stiffness K_v of the contact at a vertex. The factor 2 is for the
//! other body, which may be as light. Row sums grow without bound where a weight S_Iv is of the size of the root of a mass, as
//! at a node that a face nearly ends at, though the frequency does not; with B for the matrix M^-1 S K S^T and x for its row
//! sums, max_I (B x)_I/x_I bounds it too (Collatz), is sharper, and is finite there. The printed rule, dt times the smallest gap over the critical gap, shortens the
//! step also where the contact is far from limiting (a resting disk forty times), and goes to zero with the gap.

use super::pair::VertexContact;

/// Share of the bound 2/omega that is used.
pub const SAFETY: f64 = 0.5;

/// Stiffness over mass of the nodes of one body's layer of the grid \[1/s²\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalStiffness {
    /// Row sums, and what they give in a second product.
    sums: Vec<f64>,
    again: Vec<f64>,
    touched: Vec<usize>,
    /// A second product was made.
    sharpened: bool,
}

impl NodalStiffness {
    /// Forgets all vertices.
    pub fn clear(&mut self) {
        for node in self.touched.drain(..) {
            self.sums[node] = 0.0;
            self.again[node] = 0.0;
        }
        self.sharpened = false;
    }

    /// Adds a vertex: the nodes of its patch, its augmented weights on them, their masses \[kg\] and the stiffness of the
    /// contact at it \[N/m\].
    pub fn add<const N: usize>(
        &mut self,
        nodes: &[usize; N],
        weights: &[f64; N],
        masses: &[f64; N],
        stiffness: f64,
    ) {
        if stiffness == 0.0 {
            return;
        }
        for k in 0..N {
            self.add_at(nodes[k], weights[k] * stiffness, masses[k]);
        }
    }

    /// Adds a vertex once more, after all of them have been added: multiplies its part of the matrix by the row sums.
    pub fn sharpen<const N: usize>(
        &mut self,
        nodes: &[usize; N],
        weights: &[f64; N],
        masses: &[f64; N],
        stiffness: f64,
    ) {
        if stiffness == 0.0 {
            return;
        }
        self.sharpened = true;
        let mut along = 0.0;
        for k in 0..N {
            if masses[k] > 0.0 {
                along += weights[k] * self.sums[nodes[k]];
            }
        }
        for k in 0..N {
            if masses[k] > 0.0 {
                self.again[nodes[k]] += weights[k] * stiffness * along / masses[k];
            }
        }
    }

    /// Adds a row sum of the stiffness \[N/m\] at a node with a mass \[kg\]; a node without mass has none.
    pub fn add_at(&mut self, node: usize, stiffness: f64, mass: f64) {
        if mass > 0.0 {
            if node >= self.sums.len() {
                self.sums.resize(node + 1, 0.0);
                self.again.resize(node + 1, 0.0);
            }
            self.sums[node] += stiffness / mass;
            self.touched.push(node);
        }
    }

    /// Bound of the angular frequency \[1/s\]; 0 without contact.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        let sums = self.touched.iter().map(|&node| match self.sums[node] {
            sum if self.sharpened && sum > 0.0 => self.again[node] / sum,
            sum => sum,
        });
        (2.0 * sums.fold(0.0, f64::max)).sqrt()
    }

    /// Largest time step \[s\], half of 2/omega; infinite without contact.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        SAFETY * 2.0 / self.frequency()
    }
}

/// Distance by which a gap may close in one step \[m\]: half the critical gap, and from afar down to half of it. No vertex then
/// passes through the layer in which the contact pushes without having been pushed.
#[must_use]
pub fn allowed_approach(gap: f64, critical_gap: f64) -> f64 {
    (gap - 0.5 * critical_gap).max(0.5 * critical_gap)
}

/// Speed at which a pair closes, where that is nearest to the limit of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosingRate {
    /// Vertex of the slave; none for the two boundaries as a whole.
    pub vertex: Option<usize>,
    /// Speed at which the gap closes \[m/s\].
    pub speed: f64,
    /// Distance by which it may close in one step \[m\].
    pub allowed: f64,
}

impl ClosingRate {
    /// A pair that does not close.
    pub const NONE: Self = Self {
        vertex: None,
        speed: 0.0,
        allowed: f64::INFINITY,
    };

    /// The vertex that allows the smallest step, or the boundaries as a whole: a vertex that faces nothing within
    /// `reach` \[m\] must not come in one step from there to where it would be too deep. `speeds` are the largest of the
    /// vertices of slave and master \[m/s\].
    #[must_use]
    pub fn of<const D: usize, const T: usize>(
        sites: &[Option<VertexContact<D, T>>],
        critical_gap: f64,
        reach: f64,
        speeds: [f64; 2],
    ) -> Self {
        let whole = Self {
            vertex: None,
            speed: speeds[0] + speeds[1],
            allowed: allowed_approach(reach, critical_gap),
        };
        sites
            .iter()
            .flatten()
            .map(|site| Self {
                vertex: Some(site.vertex),
                speed: site.closing,
                allowed: allowed_approach(site.gap, critical_gap),
            })
            .fold(whole, |most, one| {
                if one.time_step() < most.time_step() {
                    one
                } else {
                    most
                }
            })
    }

    /// Largest time step \[s\]; infinite where nothing closes.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        if self.speed > 0.0 {
            self.allowed / self.speed
        } else {
            f64::INFINITY
        }
    }
}
