//! Entries of the plan: each thing that it keeps or leaves out, and why.

use super::{Plan, PlanEntry, PlanOptions, has_safe_step};
use crate::values::{Body, Scene};
use proctor_geometry::number::Number;
use proctor_kernel::layout::Layout;
use proctor_kernel::model::{Dimension, Shape, StressScheme};
use proctor_kernel::plan::PlanEntries;
use proctor_kernel::simulation::describe_conditions;
use proctor_kernel::stage::g2p::Affine;

/// The entries of a plan.
pub(super) fn describe(plan: &Plan, scene: &Scene, demands: PlanOptions) -> Vec<PlanEntry> {
    let mut list = PlanEntries::default();
    let dimension = match scene.dimension {
        Dimension::Two if plan.axisymmetric => {
            "2D, axisymmetric: radius and height, masses and forces of the full circle"
        }
        Dimension::Two => "2D, plane strain",
        Dimension::Three => "3D",
    };
    list.keep("stage", "dimension", dimension);
    list.keep("stage", "weighting function", scene.weighting.kind().plan);
    list.keep(
        "stage",
        "stress scheme",
        match scene.scheme {
            StressScheme::Usf => "USF: stress from the velocity mapped at the new positions",
            StressScheme::Usl => "USL: one mapping and one interpolation per step",
            StressScheme::Musl => "MUSL: momentum is mapped a second time",
        },
    );
    list.choose(
        "stage",
        "second mapping of momentum",
        scene.scheme != StressScheme::Usl,
        "the stress scheme needs it",
        "USL updates stress from the first one",
    );
    list.choose(
        "stage",
        "affine velocity",
        plan.affine != Affine::Leave,
        "the transfer is APIC, TPIC or MLS",
        "the transfer is FLIP",
    );
    list.choose(
        "stage",
        "PIC blend",
        scene.transfer.pic_fraction != 0.0,
        "the PIC fraction is not zero",
        "the PIC fraction is zero",
    );
    list.choose(
        "stage",
        "volumetric strain as a mean over cells",
        plan.cell_average,
        "the scene asks for it: nearly incompressible material does not lock",
        "the volumetric strain is that at the particle",
    );
    let settings = scene.settings();
    describe_conditions(&settings, &mut list);
    let bodies = scene.planned_bodies();
    proctor_contact::describe(&scene.contact_values(), &settings, &bodies, &mut list);
    list.choose(
        "stage",
        "measurement at the nodes",
        plan.measure,
        "kinetic energy or residual is needed in every step",
        "nothing needs it in every step",
    );
    let any = |has: fn(&Layout) -> bool| plan.layouts.iter().any(has);
    list.keep(
        "particle field",
        "mass, volume, position, velocity, stress",
        "every scene needs them",
    );
    list.choose(
        "particle field",
        "initial position",
        any(|l| l.displacement_origin.is_some()),
        "displacements are written or asked for",
        "no displacement is written",
    );
    list.choose(
        "particle field",
        "deformation gradient",
        any(|l| l.deformation.is_some()),
        "the law, the particle domain or an output needs it",
        "volume is enough for this law",
    );
    list.choose(
        "particle field",
        "half-lengths",
        any(|l| l.half_length.is_some()),
        "domains follow the deformation or differ between particles",
        "they are the same for all particles of a body",
    );
    list.choose(
        "particle field",
        "external force",
        any(|l| l.force.is_some()),
        if demands.body_force {
            "a body force is given"
        } else {
            "box loads are given"
        },
        "no box load and no body force",
    );
    if scene.has_water() {
        list.keep(
            "particle field",
            "water velocity, pore pressure",
            "`n_phases` is 2: bodies have water in their pores",
        );
        list.keep(
            "stage",
            "pore water",
            "a velocity field of its own, drag implicit at the nodes; (w - v) . grad w is left out",
        );
        list.choose(
            "particle field",
            "pore pressure that is held",
            any(|l| l.held_pressure.is_some()),
            "particles in a box keep their pore pressure",
            "no pore pressure is prescribed",
        );
    }
    let mut variables: Vec<String> = vec![];
    for body in &scene.bodies {
        let law = scene.law_of(body);
        for variable in law.variables() {
            let words = format!("{} of the law {}", variable.name, law.name());
            if !variables.contains(&words) {
                variables.push(words);
            }
        }
    }
    list.choose(
        "particle field",
        "internal variables",
        !variables.is_empty(),
        &variables.join(", "),
        "no law has any",
    );
    list.keep(
        "time step",
        "wave speed and particle speed",
        if has_safe_step(scene.weighting, scene.scheme, scene.transfer.kind) {
            "dt <= C min(h)/(c + |v|), C of the stress scheme, the weighting function and the transfer"
        } else {
            "dt <= 0.66 min(h)/(c + |v|), which holds only while no node is nearly empty: linear functions \
             have no safe step with USL or an affine transfer"
        },
    );
    if plan.axisymmetric {
        list.choose(
            "time step",
            "thin rods and rings",
            scene.bodies.iter().any(|body| scene.step_share(body) < 1.0),
            "a body is thinner than two cells along the radius: C r/(r + h), at least half of C",
            "no body is thinner than two cells along the radius",
        );
    }
    list.choose(
        "output",
        "frames, history, checkpoints",
        scene.results.print > 0,
        &format!(
            "{} frames: at the start and every {} s",
            scene.results.print + 1,
            Number(scene.time / scene.results.print.max(1) as f64)
        ),
        "print is zero",
    );
    if let Some(interval) = scene.results.history_interval {
        list.keep(
            "output",
            "history of its own interval",
            &format!(
                "a row for every {} s, of the nearest step",
                Number(interval)
            ),
        );
    }
    list.0
}

/// True if the particles of a body are given one by one.
pub(super) fn is_list(body: &Body) -> bool {
    matches!(body.shape, Shape::Particles(_))
}
