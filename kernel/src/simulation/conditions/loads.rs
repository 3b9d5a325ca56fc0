//! Point loads and tractions, as forces on nodes.

use super::light::Masses;
use super::{ConditionResult, ConditionType};
use crate::fields::{Owner, SlabField};
use crate::grid::GridShape;
use crate::history::value;
use crate::model::{CycleSettings, History, Traction, Vector, Weighting};
use crate::simulation::Cycle;
use crate::simulation::context::{Condition, FieldNodes, NodalConditions};
use crate::simulation::step_view::StepView;
use crate::simulation::values::SetupError;
use crate::stage::solve::{EmptyNode, ExactStepSums, NodeForce, Planes};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Forces on the nodes of all fields together.
struct NodalLoads {
    /// Forces that stay what they are, one for each node, increasing; zero at a node that only others act on.
    steady: Vec<NodeForce>,
    /// Tractions that change in time.
    changing: Vec<VaryingTraction>,
    /// Nodes that only tractions act on, increasing: a traction acts where the body is.
    of_tractions: Vec<usize>,
}

/// A traction that changes in time.
struct VaryingTraction {
    /// Traction \[Pa\].
    traction: History,
    /// Numbers of nodes in the steady loads, and the area of each \[m²\].
    areas: Vec<(usize, f64)>,
}

/// Nodal loads.
pub(super) const NODAL_LOADS: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let acts = !(settings.point_loads.is_empty() && settings.tractions.is_empty());
        list.choose(
            "stage",
            "nodal loads",
            acts,
            "point loads or tractions are given",
            "none is given",
        );
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, shape: &GridShape) -> Option<ConditionResult> {
    match nodal(settings, shape) {
        Ok(loads) if loads.steady.is_empty() => None,
        loads => Some(loads.map(|loads| Arc::new(loads) as _)),
    }
}

impl Condition for NodalLoads {
    /// Loads of nothing act on no node, however light it is.
    fn reads_masses(&self) -> bool {
        let acts = |load: &NodeForce| load.force != [0.0; 3];
        !self.changing.is_empty() || self.steady.iter().any(acts)
    }

    /// Sets the forces that change, at the middle of the kick; those on nodes that are nearly empty, as the nodes around bear
    /// them.
    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        if !self.reads_masses() {
            return;
        }
        let masses = Masses::of(view);
        let left = self.left(view, &masses);
        if self.changing.is_empty() && !left && masses.bear(&self.steady) {
            return;
        }
        let [before, after] = nodal.half_steps;
        nodal.loads.extend_from_slice(&self.steady);
        for one in &self.changing {
            let traction = value(&one.traction, 0.5 * (before + after));
            for &(place, area) in &one.areas {
                for axis in 0..3 {
                    nodal.loads[place].force[axis] += traction[axis] * area;
                }
            }
        }
        if left {
            nodal.loads.retain(|load| !self.is_left(load.node, &masses));
        }
        if !masses.bear(&nodal.loads) {
            masses.spread(&mut nodal.loads);
        }
        nodal.spread = true;
    }

    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        if field.slab.fields.len() == 1 {
            let all = self.now(field.context.nodal);
            return field.parts().0.load(all);
        }
        self.for_share(field, |planes, own, _| planes.load(&[own]))
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        if field.slab.fields.len() == 1 {
            let (planes, now, sums) = field.parts();
            return planes.add_power_of_loads(self.now(now.nodal), sums);
        }
        let found = self.for_share(field, |planes, own, sums| {
            planes.add_power_of_loads(&[own], sums);
            Ok(())
        });
        debug_assert_eq!(
            found,
            Ok(()),
            "the loads found their nodes when they were added"
        );
    }
}

impl NodalLoads {
    /// All of them in a step.
    fn now<'a>(&'a self, nodal: &'a NodalConditions) -> &'a [NodeForce] {
        if nodal.spread {
            &nodal.loads
        } else {
            &self.steady
        }
    }

    /// True if a body has left a traction behind: it acted when the run began, and a node of it is empty.
    fn left(&self, view: &StepView<'_>, masses: &Masses<'_>) -> bool {
        let nodes = &self.of_tractions;
        view.clock.step > 0 && nodes.iter().any(|node| masses.at(*node) <= 0.0)
    }

    fn is_left(&self, node: usize, masses: &Masses<'_>) -> bool {
        self.of_tractions.binary_search(&node).is_ok() && masses.at(node) <= 0.0
    }

    /// Calls `act` with the nodes of a field, its share of each load on them, and the sums of the slab. The share is that of
    /// its mass in the mass of all fields of a node that move freely.
    fn for_share(
        &self,
        field: &mut FieldNodes<'_, '_>,
        mut act: impl FnMut(&mut Planes<'_>, NodeForce, &mut ExactStepSums) -> Result<(), EmptyNode>,
    ) -> Result<(), EmptyNode> {
        let (shape, now) = (field.slab.shape(), field.context);
        let first = field.slab.range().start * shape.plane_nodes();
        let last = field.slab.range().end * shape.plane_nodes();
        let all = self.now(now.nodal).iter();
        for load in all.filter(|load| (first..last).contains(&load.node)) {
            let [plane, row, k] = shape.indices(load.node);
            if !field.slab.owns_row(row) {
                continue;
            }
            let mass = |field: &SlabField<'_>| {
                let free = field.owner != Owner::Water && now.prescribed(field.owner).is_none();
                if free && field.planes.rows.span(plane, row).contains(&k) {
                    field.planes.nodes[load.node - first][0]
                } else {
                    0.0
                }
            };
            let fields = &field.slab.fields;
            let total: f64 = fields.iter().map(mass).sum();
            if total <= 0.0 {
                return Err(EmptyNode(load.node));
            }
            let mass = mass(&fields[field.number]);
            if mass > 0.0 {
                let force = load.force.map(|f| f * (mass / total));
                let (planes, _, sums) = field.parts();
                act(planes, NodeForce { force, ..*load }, sums)?;
            }
        }
        Ok(())
    }
}

impl Cycle {
    /// The tractions that bodies have left behind, by their places in the scene, with the share of each that acts on nothing.
    pub(in crate::simulation) fn tractions_left(&self) -> Vec<(usize, f64)> {
        let mut all = vec![];
        if self.state.clock.step == 0 || self.nodes_with_mass() == 0 {
            return all;
        }
        let view = self.view();
        let (settings, masses) = (&self.model.settings, Masses::of(&view));
        for (i, load) in settings.tractions.iter().enumerate() {
            let Ok(areas) = areas(settings, &self.work.grid.shape, i, load) else {
                continue;
            };
            let here = areas
                .iter()
                .map(|(node, _)| f64::from(self.owns(*node) && masses.at(*node) > 0.0));
            let mut has_mass: Vec<f64> = here.collect();
            self.join_most(&mut has_mass);
            let nodes = areas.iter().zip(&has_mass);
            let left = nodes.filter(|(_, has_mass)| **has_mass == 0.0);
            let lost: f64 = left.map(|((_, area), _)| area).sum();
            let whole: f64 = areas.iter().map(|(_, area)| area).sum();
            if lost > 0.0 {
                all.push((i, lost / whole));
            }
        }
        all
    }
}

/// All nodal loads of a scene, one entry per node, in order of the node.
///
/// # Errors
/// A point load that is not at a node, or a traction outside the mesh.
fn nodal(settings: &CycleSettings, shape: &GridShape) -> Result<NodalLoads, SetupError> {
    let (mut all, mut changing) = (vec![], vec![]);
    let mut points = vec![];
    for (i, load) in settings.point_loads.iter().enumerate() {
        let path = format!("nodal_point_load[{i}]");
        let node = node_at(settings, shape, &load.position, &path)?;
        points.push(node);
        all.push(NodeForce {
            node,
            force: load.force,
        });
    }
    for (i, load) in settings.tractions.iter().enumerate() {
        let areas = areas(settings, shape, i, load)?;
        let steady = load.traction.constant();
        all.extend(areas.iter().map(|&(node, area)| NodeForce {
            node,
            force: steady.unwrap_or_default().map(|t| t * area),
        }));
        if steady.is_none() {
            changing.push((load.traction.clone(), areas));
        }
    }
    NodeForce::add_up(&mut all);
    let place = |node: usize| all.partition_point(|load| load.node < node);
    let changing = changing
        .into_iter()
        .map(|(traction, areas)| VaryingTraction {
            traction,
            areas: (areas.into_iter())
                .map(|(node, area)| (place(node), area))
                .collect(),
        });
    let nodes = all.iter().map(|load| load.node);
    Ok(NodalLoads {
        changing: changing.collect(),
        of_tractions: nodes.filter(|node| !points.contains(node)).collect(),
        steady: all,
    })
}

/// Coordinate in cells from the mesh origin; a node where it is one to round-off of the coordinates.
fn cells_from_origin(settings: &CycleSettings, axis: usize, x: f64) -> f64 {
    let (origin, h) = (settings.mesh.origin[axis], settings.mesh.cell[axis]);
    let xi = (x - origin) / h;
    let round_off = 4.0 * f64::EPSILON * ((x.abs() + origin.abs()) / h + 1.0);
    if (xi - xi.round()).abs() <= round_off {
        xi.round()
    } else {
        xi
    }
}

fn node_at(
    settings: &CycleSettings,
    shape: &GridShape,
    x: &Vector,
    path: &str,
) -> Result<usize, SetupError> {
    let mut at = [0; 3];
    for axis in 0..shape.axes {
        let xi = cells_from_origin(settings, axis, x[axis]);
        let nearest = xi.round();
        if (xi - nearest).abs() > 1e-6
            || nearest < 0.0
            || nearest > settings.mesh.cells[axis] as f64
        {
            return Err(SetupError::Load {
                path: path.into(),
                reason: format!("position {x:?} m is not at a node of the mesh"),
            });
        }
        at[axis] = nearest as usize;
    }
    Ok(shape.index(shape.mesh_node(at)))
}

/// The first load that acts on a node, as a path into the scene; `None` where none does.
pub(in crate::simulation) fn load_on(
    settings: &CycleSettings,
    shape: &GridShape,
    node: usize,
) -> Option<String> {
    let mut points = settings.point_loads.iter().enumerate();
    let at_node = points.find_map(|(i, load)| {
        let path = format!("nodal_point_load[{i}]");
        let own = node_at(settings, shape, &load.position, &path).ok()?;
        (own == node).then_some(path)
    });
    at_node.or_else(|| {
        let mut tractions = settings.tractions.iter().enumerate();
        tractions.find_map(|(i, load)| {
            let areas = areas(settings, shape, i, load).ok()?;
            (areas.iter().any(|(own, _)| *own == node)).then(|| format!("traction[{i}]"))
        })
    })
}

/// Nodes that a traction acts on, each with its area \[m²\]: the integral of its hat, exact for rectangles that cut cells. Where the
/// scene is axisymmetric, areas are those of rings, as the particles have them.
/// # Errors
/// [`SetupError::Load`] where its rectangle is not inside the mesh.
pub fn areas(
    settings: &CycleSettings,
    shape: &GridShape,
    i: usize,
    load: &Traction,
) -> Result<Vec<(usize, f64)>, SetupError> {
    let mut all = vec![];
    let axes = shape.axes;
    let mut per_axis: Vec<Vec<(usize, f64)>> = vec![];
    for axis in 0..axes {
        let (a, b) = (
            cells_from_origin(settings, axis, load.p1[axis]),
            cells_from_origin(settings, axis, load.p2[axis]),
        );
        let cells = settings.mesh.cells[axis];
        if a < 0.0 || b > cells as f64 || b < a {
            return Err(SetupError::Load {
                path: format!("traction[{i}]"),
                reason: format!(
                    "rectangle {:?} to {:?} m is not inside the mesh",
                    load.p1, load.p2
                ),
            });
        }
        // Along the normal the hat itself, along the others its integral.
        let factor = |node: usize| {
            let n = node as f64;
            if load.p1[axis] == load.p2[axis] {
                let circumference = match axis {
                    0 if settings.mesh.axisymmetric => TAU * load.p1[0],
                    _ => 1.0,
                };
                (1.0 - (a - n).abs()).max(0.0) * circumference
            } else if settings.mesh.axisymmetric && axis == 0 {
                rings(settings, [a, b], n)
            } else {
                (hat_integral(b - n) - hat_integral(a - n)) * settings.mesh.cell[axis]
            }
        };
        per_axis.push(
            (0..=cells)
                .map(|n| (n, factor(n)))
                .filter(|(_, f)| *f > 0.0)
                .collect(),
        );
    }
    if axes == 2 {
        per_axis.push(vec![(0, 1.0)]);
    }
    for &(x, fx) in &per_axis[0] {
        for &(y, fy) in &per_axis[1] {
            for &(z, fz) in &per_axis[2] {
                let node = shape.index(shape.mesh_node([x, y, z]));
                all.push((node, fx * fy * fz));
            }
        }
    }
    Ok(all)
}

/// Area of a node, `n` cells from the lower edge of the mesh, in rings between two places in cells \[m²\]: the sum of its weights over
/// the rows of particles below, times their radii. Those of the particles act against it, so that a uniform stress is at rest.
pub(in crate::simulation) fn rings(settings: &CycleSettings, [a, b]: [f64; 2], n: f64) -> f64 {
    let (h, first) = (settings.mesh.cell[0], settings.mesh.origin[0]);
    let per_cell = settings.radial_particles as f64;
    // What a node beyond the axis would have is folded onto its mirror image.
    let weight = |lower: f64, upper: f64| match settings.weighting {
        Weighting::QuadraticBSpline => {
            let place = 0.5 * (lower + upper);
            let mirrored = if first == 0.0 && n == 1.0 {
                spline(place + n)
            } else {
                0.0
            };
            (spline(place - n) + mirrored) * (upper - lower)
        }
        _ => hat_integral(upper - n) - hat_integral(lower - n),
    };
    let reach = match settings.weighting {
        Weighting::QuadraticBSpline => 1.5,
        _ => 1.0,
    };
    let (from, to) = (a.max(n - reach), b.min(n + reach));
    let mut area = 0.0;
    let mut lower = from;
    while lower < to {
        // A piece ends where a row of particles does.
        let mut upper = ((lower * per_cell + 1e-9).floor() + 1.0) / per_cell;
        upper = upper.min(b);
        area += (first + 0.5 * h * (lower + upper)) * weight(lower, upper);
        lower = upper;
    }
    TAU * h * area
}

/// The quadratic B-spline at a distance in cells.
fn spline(distance: f64) -> f64 {
    let d = distance.abs();
    if d < 0.5 {
        0.75 - d * d
    } else {
        0.5 * (1.5 - d).max(0.0).powi(2)
    }
}

/// Integral of the unit hat from minus infinity to `x`.
fn hat_integral(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    if x < 0.0 {
        0.5 * (1.0 + x) * (1.0 + x)
    } else {
        1.0 - 0.5 * (1.0 - x) * (1.0 - x)
    }
}
