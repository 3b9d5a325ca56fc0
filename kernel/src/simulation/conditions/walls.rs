//! The boundary planes of the mesh, free of stress, sliding, fixed or antisymmetric.
//!
//! The mapping knows the region beyond them too, and folds it back ([`Planes::fold`](crate::stage::solve::Planes)).

use super::{ConditionResult, ConditionType};
use crate::grid::GridShape;
use crate::history::value;
use crate::model::{CycleSettings, PlaneCondition, PlanePressure, Weighting};
use crate::simulation::context::{Condition, FieldNodes, NodalConditions, Remap};
use crate::simulation::step_view::StepView;
use crate::stage::solve::Wall;
use crate::stage::water::{NodalPressure, PressedPlane};
use std::sync::Arc;

/// The planes that are not free.
struct Walls {
    skeleton: Vec<Wall>,
    /// Walls that the pore water meets.
    water: Vec<Wall>,
    /// Planes at which the pressure of the pore water is given.
    pressed: Vec<GivenPressure>,
}

/// A boundary plane at which the pressure of the pore water is given.
struct GivenPressure {
    axis: usize,
    side: usize,
    pressure: PlanePressure,
    /// [`PressedPlane::finds_surface`].
    finds_surface: bool,
    /// Axis that levels are coordinates along, the lower boundary of the mesh there \[m\], and the weight of the water along it
    /// \[N/m³\].
    weight: (usize, f64, f64),
}

impl GivenPressure {
    /// The pressure at a time \[s\].
    fn at(&self, time: f64) -> PressedPlane {
        let pressure = match &self.pressure {
            PlanePressure::Uniform(pressure) => NodalPressure::Uniform(*pressure),
            PlanePressure::Level(history) => {
                let (along, origin, slope) = self.weight;
                NodalPressure::Rest {
                    along,
                    level: value(history, time)[0] - origin,
                    slope,
                }
            }
        };
        PressedPlane {
            axis: self.axis,
            side: self.side,
            finds_surface: self.finds_surface,
            pressure,
        }
    }
}

/// Boundary planes.
pub(super) const PLANES: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        for (axis, letter) in ["X", "Y", "Z"]
            .iter()
            .enumerate()
            .take(settings.dimension.axes())
        {
            for (side, end) in ["0", "n"].iter().enumerate() {
                let condition = settings.mesh.planes[axis][side];
                let base = settings.base_motion.as_ref();
                let moving = base.is_some_and(|b| b.axis == axis && b.side == side);
                let acts = moving || condition != PlaneCondition::Free;
                let why = if moving {
                    "its velocity is prescribed"
                } else {
                    condition.word()
                };
                list.choose("stage", &format!("plane {letter}{end}"), acts, why, "free");
            }
        }
    },
    make: Some(of),
    planes: true,
};

fn of(settings: &CycleSettings, shape: &GridShape) -> Option<ConditionResult> {
    let walls = walls_of(settings.mesh.planes, shape);
    let water = settings.water_planes;
    let water = water.map_or_else(Vec::new, |planes| walls_of(planes, shape));
    let pressed = pressed_planes(settings, shape);
    let act = !(walls.is_empty() && water.is_empty() && pressed.is_empty())
        || settings.base_motion.is_some();
    act.then(|| {
        Ok(Arc::new(Walls {
            skeleton: walls,
            water,
            pressed,
        }) as _)
    })
}

/// The planes at which the pressure of the pore water is given.
fn pressed_planes(settings: &CycleSettings, shape: &GridShape) -> Vec<GivenPressure> {
    let gravity = &settings.gravity;
    let steepest = |a: &usize, b: &usize| gravity[*a].abs().total_cmp(&gravity[*b].abs());
    let along = (0..shape.axes).max_by(steepest).unwrap_or(0);
    let weight = settings.water_density * gravity[along];
    let fills = settings.weighting != Weighting::QuadraticBSpline;
    let sides = (0..shape.axes).flat_map(|axis| [(axis, 0), (axis, 1)]);
    let given = sides.filter_map(|(axis, side)| {
        Some(GivenPressure {
            axis,
            side,
            pressure: settings.water_pressures[axis][side].clone()?,
            finds_surface: fills && settings.mesh.planes[axis][side] == PlaneCondition::Free,
            weight: (along, settings.mesh.origin[along], weight),
        })
    });
    given.collect()
}

/// The planes that are not free.
fn walls_of(planes: [[PlaneCondition; 2]; 3], shape: &GridShape) -> Vec<Wall> {
    let mut walls = vec![];
    for (axis, sides) in planes.iter().enumerate().take(shape.axes) {
        for (side, &condition) in sides.iter().enumerate() {
            if condition != PlaneCondition::Free {
                walls.push(Wall {
                    axis,
                    side,
                    prescribed: condition.prescribed(axis),
                    extrapolates: condition == PlaneCondition::Absorbing,
                    before: [0.0; 3],
                    after: [0.0; 3],
                });
            }
        }
    }
    walls
}

impl Condition for Walls {
    fn acts_on_water(&self) -> bool {
        true
    }

    fn prescribe(&self, _: &StepView<'_>, nodal: &mut NodalConditions) {
        nodal.walls.extend(self.skeleton.iter().copied());
        nodal.water_walls.extend(self.water.iter().copied());
        let [before, after] = nodal.half_steps;
        let middle = 0.5 * (before + after);
        let pressed = self.pressed.iter().map(|given| given.at(middle));
        nodal.water_pressures.extend(pressed);
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let owner = field.owner();
        let (planes, context, sums) = field.parts();
        let walls = context.walls_of(owner);
        planes.add_power_of_walls(walls, context.nodal.kick, sums);
        planes.constrain(walls, true);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        let owner = field.owner();
        let (planes, context, _) = field.parts();
        let walls = context.walls_of(owner);
        match context.remap {
            Some(Remap::OldPositions) => planes.constrain_remapped(walls),
            _ => planes.constrain(walls, false),
        }
    }
}
