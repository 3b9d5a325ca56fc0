//! Force of a contact at a node, for output.

use crate::model::Vector;

/// Force of a contact at a node on one body in the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodalForce {
    /// Place of the body.
    pub body: usize,
    /// Node.
    pub node: usize,
    /// Force on the body \[N\].
    pub force: Vector,
    /// Gap \[m\].
    pub gap: f64,
}
