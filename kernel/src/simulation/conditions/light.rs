//! Loads on nodes that are nearly empty.
//!
//! A load that is fixed in space stays where it is when its body moves on, until only the edge of a particle domain reaches its
//! nodes. The mass of such a node falls with the square of the way that is left, the derivatives of its weights only with the way:
//! a force there strains the particles without bound, and its work is that of a velocity which no particle has. So a node bears
//! a force in proportion to its mass, over that of the heaviest node around it, and the nodes around it bear the rest in
//! proportion to theirs. The force on the body stays what it is, and it acts where the mass is.

use crate::grid::{GHOSTS_BELOW, GridShape};
use crate::simulation::step_view::StepView;
use crate::stage::solve::NodeForce;

/// Mass over that of the heaviest node around from which a node bears a whole force. The corner of a body that begins at a
/// node has an eighth in space.
const BEARS: f64 = 1.0 / 16.0;
/// Part of the share of a neighbour that a step along one more axis takes.
const ACROSS: f64 = 0.1;

/// Masses of nodes while loads are spread.
pub(super) struct Masses<'a> {
    view: &'a StepView<'a>,
    shape: &'a GridShape,
}

impl<'a> Masses<'a> {
    /// Masses that were mapped for this step.
    pub(super) fn of(view: &'a StepView<'a>) -> Self {
        let shape = &view.grid.shape;
        Self { view, shape }
    }

    /// Mass of all fields of a node that move freely \[kg\].
    pub(super) fn at(&self, node: usize) -> f64 {
        let [plane, row, k] = self.shape.indices(node);
        let bodies = self.view.bodies;
        let fields = self.view.grid.fields.iter();
        let free = fields.filter(|field| {
            let moved = field
                .owner
                .body()
                .is_some_and(|body| bodies[body].motion.is_some());
            !moved && field.rows.span(plane, row).contains(&k)
        });
        free.map(|field| field.nodes.lines()[node][0]).sum()
    }

    /// Calls `act` with each node around one, itself among them, in order, with its mass and the number of axes along which it
    /// is another.
    fn around(&self, node: usize, mut act: impl FnMut(usize, f64, i32)) {
        let (shape, at) = (self.shape, self.shape.indices(node));
        let settings = self.view.settings;
        // Along each direction of the storage: mirror images beyond a plane with a condition are left out.
        let mut ranges = [(0, 0); 3];
        for axis in 0..shape.axes {
            let direction = shape.direction(axis);
            let (first, last) = (GHOSTS_BELOW, GHOSTS_BELOW + shape.cells[axis]);
            let low = at[direction] > first || !settings.plane_acts(axis, 0);
            let high = at[direction] < last || !settings.plane_acts(axis, 1);
            ranges[direction] = (-i32::from(low), i32::from(high));
        }
        let moved = |direction: usize, by: i32| at[direction].checked_add_signed(by as isize);
        for a in ranges[0].0..=ranges[0].1 {
            for b in ranges[1].0..=ranges[1].1 {
                for c in ranges[2].0..=ranges[2].1 {
                    let (Some(plane), Some(row), Some(k)) = (moved(0, a), moved(1, b), moved(2, c))
                    else {
                        continue;
                    };
                    let there = [plane, row, k];
                    if (0..3).all(|direction| there[direction] < shape.nodes[direction]) {
                        let other = shape.index(there);
                        act(other, self.at(other), a.abs() + b.abs() + c.abs());
                    }
                }
            }
        }
    }

    /// True if every node bears all of its load.
    pub(super) fn bear(&self, loads: &[NodeForce]) -> bool {
        loads.iter().all(|load| self.share(load.node) >= 1.0)
    }

    /// The share of its load that a node bears.
    fn share(&self, node: usize) -> f64 {
        let (mut own, mut most) = (0.0, 0.0_f64);
        self.around(node, |_, mass, away| {
            most = most.max(mass);
            if away == 0 {
                own = mass;
            }
        });
        // Where there is nothing at all, or nothing at the node, the load is an error that a step reports.
        if own > 0.0 {
            own / (BEARS * most)
        } else {
            f64::INFINITY
        }
    }

    /// Spreads loads, which are in order of their nodes, so that each node bears what it can; they stay in that order.
    pub(super) fn spread(&self, loads: &mut Vec<NodeForce>) {
        for place in 0..loads.len() {
            let NodeForce { node, force } = loads[place];
            let share = self.share(node);
            if share >= 1.0 {
                continue;
            }
            let weight =
                |mass: f64, away: i32| mass * libm::pow(ACROSS, f64::from((away - 1).max(0)));
            let mut total = 0.0;
            self.around(node, |_, mass, away| total += weight(mass, away));
            loads[place].force = force.map(|f| f * share);
            self.around(node, |other, mass, away| {
                if mass > 0.0 {
                    let part = (1.0 - share) * weight(mass, away) / total;
                    loads.push(NodeForce {
                        node: other,
                        force: force.map(|f| f * part),
                    });
                }
            });
        }
        NodeForce::add_up(loads);
    }
}
