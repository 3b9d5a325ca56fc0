//! Nodes with a force, a prescribed velocity or a dashpot, in one step.

/// A force on a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeForce {
    /// Index of the node in the grid.
    pub node: usize,
    /// Force \[N\].
    pub force: [f64; 3],
}

impl NodeForce {
    /// Adds up those on one node, in the order in which they come; after it they are in order of their nodes.
    pub fn add_up(all: &mut Vec<Self>) {
        all.sort_by_key(|load| load.node);
        all.dedup_by(|later, first| {
            let same = later.node == first.node;
            if same {
                for axis in 0..3 {
                    first.force[axis] += later.force[axis];
                }
            }
            same
        });
    }
}

/// A node that moves with a prescribed velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenNode {
    /// Index of the node in the grid.
    pub node: usize,
    /// Velocity half a step before \[m/s\].
    pub before: [f64; 3],
    /// Velocity half a step after \[m/s\].
    pub after: [f64; 3],
}

/// A node of absorbing planes in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotNode {
    /// Index of the node in the grid.
    pub node: usize,
    /// Impedance of its dashpot per axis \[N s/m\].
    pub impedance: [f64; 3],
    /// Force beside that of the dashpot \[N\].
    pub force: [f64; 3],
}

/// A load on a node that no particle reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmptyNode(pub usize);
