//! The plan's promises: what is left out does not exist and is not called; what does nothing changes no bit and
//! costs no work.

mod foreseen;
mod nothing;
mod steps;
mod supported;

use crate::common::{
    BLEND, DIMENSIONS, NEO_HOOKEAN, SCHEMES, WEIGHTINGS, block, body, cuboid, material, options,
    particles, rough, run,
};
use proctor_kernel::layout::Layout;
use proctor_scene::plan::{Plan, PlanEntry, PlanOptions};
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    BaseMotion, BoxLoad, Contact, ContactNormal, Damping, Dimension, Field, History, Motion,
    PlaneCondition, PointLoad, Results, Scene, Transfer, TransferKind, Weighting,
};

/// State after some steps from a rough start.
fn after(scene: &Scene, add: &Options) -> Simulation {
    let initial = Some(rough(scene.dimension, 0.5, 1.0e3, 11));
    let all = Options {
        initial,
        ..add.clone()
    };
    let mut simulation = Simulation::new(scene, &all).expect("the scene is sound");
    run(&mut simulation, 25);
    simulation
}

/// Columns that every scene has.
fn bare(axes: usize) -> usize {
    2 + 2 * axes + if axes == 2 { 4 } else { 6 }
}

fn entry<'a>(plan: &'a Plan, name: &str) -> &'a PlanEntry {
    plan.entries
        .iter()
        .find(|e| e.name == name)
        .unwrap_or_else(|| panic!("no entry {name}"))
}

/// A scene that asks for nothing.
fn plain(dimension: Dimension) -> Scene {
    block(dimension)
}

#[test]
fn fields_that_are_left_out_do_not_exist() {
    for dimension in DIMENSIONS {
        let simulation = crate::common::simulation(&plain(dimension));
        let set = &simulation.sets()[0];
        assert_eq!(set.columns.len(), bare(dimension.axes()));
        assert_eq!(
            set.layout.bytes_per_particle(),
            8 * (bare(dimension.axes()) + 1)
        );
        for name in [
            "initial position",
            "deformation gradient",
            "half-lengths",
            "external force",
        ] {
            assert!(!entry(simulation.plan(), name).kept, "{name}");
        }
    }
}

#[test]
fn fields_that_are_kept_are_there_and_filled() {
    type Choose = fn(&mut Scene);
    let axes = 3;
    let cases: [(Choose, &str, usize); 6] = [
        (
            |s| s.transfer.kind = TransferKind::Apic,
            "affine velocity",
            axes * axes,
        ),
        (
            |s| s.materials = vec![material(NEO_HOOKEAN)],
            "deformation gradient",
            axes * axes,
        ),
        (
            |s| {
                s.weighting = Weighting::ContiguousGimp(proctor_scene::DomainUpdate::Stretch);
            },
            "half-lengths",
            axes * axes + 2 * axes,
        ),
        (
            |s| {
                s.box_loads = vec![BoxLoad {
                    p1: [0.0; 3],
                    p2: [1.0; 3],
                    force: [1.0; 3],
                }];
            },
            "external force",
            axes,
        ),
        (
            |s| {
                s.results = Results {
                    print: 1,
                    history_interval: None,
                    fields: vec![Field::Displacement],
                    nodal_fields: vec![],
                    checkpoint: false,
                };
            },
            "initial position",
            axes,
        ),
        (
            |s| {
                s.results = Results {
                    print: 1,
                    history_interval: None,
                    fields: vec![Field::DeformationGradient],
                    nodal_fields: vec![],
                    checkpoint: false,
                };
            },
            "deformation gradient",
            axes * axes,
        ),
    ];
    for (choose, name, columns) in cases {
        let mut scene = plain(Dimension::Three);
        choose(&mut scene);
        let mut simulation = crate::common::simulation(&scene);
        assert!(entry(simulation.plan(), name).kept, "{name}");
        let set = &simulation.sets()[0];
        assert_eq!(set.columns.len(), bare(axes) + columns, "{name}");
        assert!(
            set.columns.iter().all(|column| column.len() == set.len()),
            "{name}"
        );
        run(&mut simulation, 1);
    }
}

/// A stage that is called changes the result: every stage of the plan, where it is kept, makes the same start end otherwise,
/// and [`nothing`] shows that it does not where it is left out.
#[test]
fn stages_that_are_kept_act() {
    type Choose = fn(&mut Scene);
    let cases: [(Choose, &str); 11] = [
        (|s| s.gravity = [0.0, -10.0, 0.0], "gravity"),
        (|s| s.transfer = BLEND, "PIC blend"),
        (|s| s.transfer.kind = TransferKind::Tpic, "affine velocity"),
        (
            |s| s.damping = Damping::Local { alpha: 0.1 },
            "local damping",
        ),
        (
            |s| s.damping = Damping::Viscous { alpha: 0.1 },
            "viscous damping",
        ),
        (|s| s.damping = Damping::Kinetic, "kinetic damping"),
        (|s| s.mesh.planes[0][0] = PlaneCondition::Fixed, "plane X0"),
        (
            |s| s.mesh.planes[1][1] = PlaneCondition::Sliding,
            "plane Yn",
        ),
        (
            |s| {
                s.point_loads = vec![PointLoad {
                    position: [0.4, 0.4, 0.4],
                    force: [1.0, 0.0, 0.0],
                }];
            },
            "nodal loads",
        ),
        (
            |s| {
                s.base_motion = Some(BaseMotion {
                    axis: 0,
                    side: 0,
                    motion: Motion::Velocity(History {
                        times: vec![0.0],
                        values: vec![[0.2, 0.0, 0.0]],
                    }),
                });
            },
            "base motion",
        ),
        (
            |s| s.scheme = proctor_scene::StressScheme::Musl,
            "second mapping of momentum",
        ),
    ];
    // The body fills the mesh, so that planes act.
    let mut scene = crate::common::empty(Dimension::Two, [6, 5, 1], 0.1);
    scene.bodies = vec![body(1, cuboid([0.0; 3], [0.6, 0.5, 0.0]))];
    let without = after(&scene, &options());
    for (choose, name) in cases {
        let mut with = scene.clone();
        choose(&mut with);
        let with = after(&with, &options());
        assert!(
            entry(with.plan(), name).kept && !entry(without.plan(), name).kept,
            "{name}"
        );
        assert_ne!(
            particles(&with).iter().map(|p| p.1).collect::<Vec<_>>(),
            particles(&without).iter().map(|p| p.1).collect::<Vec<_>>(),
            "{name}"
        );
    }
}

/// Every decision has a reason, and affine columns belong to the transfer alone.
#[test]
fn the_plan_says_why() {
    let scene = plain(Dimension::Two);
    let plan = proctor_scene::simulation::plan(&scene, PlanOptions::default());
    assert_eq!(
        plan.layouts,
        vec![Layout::new(
            2,
            proctor_kernel::layout::Optional::default(),
            &[]
        )]
    );
    for entry in &plan.entries {
        assert!(!entry.because.is_empty(), "{entry:?}");
    }
    let text = plan.to_string();
    let (kept, left_out) = text.split_once("left out").expect("two lists");
    assert!(
        kept.contains("uGIMP") && left_out.contains("because it is zero"),
        "{text}"
    );
    let with = Transfer {
        kind: TransferKind::Apic,
        pic_fraction: 1.0,
    };
    let plan = proctor_scene::simulation::plan(
        &Scene {
            transfer: with,
            ..scene
        },
        PlanOptions::default(),
    );
    assert!(plan.layouts[0].affine.is_some() && plan.full_mapping);
}

fn contact(master: i64, slave: i64) -> Contact {
    Contact {
        name: "contact".into(),
        id: 4,
        friction: 0.3,
        master,
        slave,
        normal: ContactNormal::Collinear,
    }
}

/// Bodies of a pair whose boxes never meet stay in the common field: no second one, and the same bits. So does a third
/// body beside two that do meet.
#[test]
fn contact_of_bodies_that_never_meet_changes_no_bit() {
    for dimension in DIMENSIONS {
        for weighting in WEIGHTINGS {
            for scheme in SCHEMES {
                let mut scene = crate::common::empty(dimension, [24, 8, 7], 0.1);
                (scene.weighting, scene.scheme) = (weighting, scheme);
                scene.bodies = vec![
                    body(1, cuboid([0.21, 0.22, 0.23], [0.61, 0.52, 0.53])),
                    body(2, cuboid([1.5, 0.22, 0.23], [1.9, 0.52, 0.53])),
                ];
                crate::common::calm(&mut scene);
                let without = after(&scene, &options());
                assert!(!entry(without.plan(), "contact").kept);
                scene.contacts = vec![contact(2, 1)];
                let with = after(&scene, &options());
                assert!(entry(with.plan(), "contact 4").kept);
                assert_eq!(with.contact_layers(), 0);
                assert_eq!(
                    with.state_hash(),
                    without.state_hash(),
                    "{weighting:?} {scheme:?}"
                );
            }
        }
    }
}

#[test]
fn only_bodies_near_a_partner_have_a_field_of_their_own() {
    let mut scene = crate::common::empty(Dimension::Two, [40, 8, 1], 0.1);
    let at = |x: f64| cuboid([x, 0.2, 0.0], [x + 0.4, 0.5, 0.0]);
    scene.bodies = vec![
        body(1, at(0.2)),
        body(2, at(0.6)),
        body(3, at(2.0)),
        body(4, at(2.4)),
    ];
    scene.contacts = vec![
        contact(1, 2),
        Contact {
            id: 5,
            ..contact(2, 3)
        },
    ];
    let simulation = crate::common::simulation(&scene);
    // Bodies 3 and 4 touch, but are not a pair.
    assert_eq!(simulation.contact_layers(), 2);
    assert!(simulation.has_contact(2) && !simulation.has_contact(3));
}

#[test]
fn contact_of_two_driven_bodies_is_left_out() {
    let mut scene = plain(Dimension::Two);
    scene
        .bodies
        .push(body(2, cuboid([0.7, 0.2, 0.0], [0.8, 0.3, 0.0])));
    for body in &mut scene.bodies {
        body.motion = Some(History {
            times: vec![0.0],
            values: vec![[0.0; 3]],
        });
    }
    scene.contacts = vec![contact(1, 2)];
    let simulation = crate::common::simulation(&scene);
    let entry = entry(simulation.plan(), "contact 4");
    assert!(!entry.kept && entry.because.contains("both bodies is prescribed"));
    assert_eq!(simulation.contact_layers(), 0);
    assert!(!simulation.has_contact(0));
}
