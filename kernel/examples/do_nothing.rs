//! A small block of particles with a feature that does nothing, for `scripts/count-instructions.sh`.
//!
//! `do_nothing FEATURE`: one of `none`, `local-damping`, `viscous-damping`, `second-material`, `far-plane`,
//! `zero-load`, `far-body`, `far-contact`. The last is to be compared with the one before it.

use proctor_kernel::scene::{
    Body, Contact, ContactNormal, Damping, Dimension, Law, Material, Mesh, Mortar, ObjectiveRate,
    Outside, PlaneCondition, PointLoad, Results, Scene, Shape, StressScheme, TimeStep, Transfer,
    TransferKind, Weighting,
};
use proctor_kernel::simulation::{Options, Simulation};

const H: f64 = 0.1;

fn scene() -> Scene {
    let law = Law::LinearElastic {
        young: 1.0e6,
        poisson: 0.3,
        rate: ObjectiveRate::HughesWinget,
    };
    Scene {
        name: "do nothing".into(),
        dimension: Dimension::Three,
        time: 1.0,
        time_step: TimeStep::Automatic,
        gravity: [0.0, 0.0, -10.0],
        mesh: Mesh {
            origin: [0.0; 3],
            cell: [H; 3],
            cells: [18; 3],
            planes: [[PlaneCondition::Free; 2]; 3],
        },
        weighting: Weighting::UniformGimp,
        scheme: StressScheme::Usl,
        transfer: Transfer {
            kind: TransferKind::Flip,
            pic_fraction: 0.0,
        },
        materials: vec![Material {
            name: "solid".into(),
            id: 1,
            density: 1000.0,
            law,
        }],
        bodies: vec![Body {
            name: "block".into(),
            id: 1,
            material: 0,
            shape: Shape::Cuboid {
                p1: [0.2; 3],
                p2: [1.2; 3],
            },
            particles_per_cell: [2; 3],
            velocity: [1.0, 0.5, 0.0],
            motion: None,
        }],
        damping: Damping::None,
        base_motion: None,
        point_loads: vec![],
        tractions: vec![],
        box_loads: vec![],
        contacts: vec![],
        contact_distance: None,
        mortar: Mortar::default(),
        outside: Outside::Stop,
        results: Results {
            print: 0,
            fields: vec![],
            nodal_fields: vec![],
            checkpoint: false,
        },
        probes: vec![],
        threads: Some(1),
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = scene();
    match std::env::args().nth(1).as_deref() {
        None | Some("none") => {}
        Some("local-damping") => scene.damping = Damping::Local { alpha: 0.0 },
        Some("viscous-damping") => scene.damping = Damping::Viscous { alpha: 0.0 },
        Some("second-material") => scene.materials.push(scene.materials[0].clone()),
        Some("far-plane") => scene.mesh.planes[0][1] = PlaneCondition::Sliding,
        Some("zero-load") => {
            scene.point_loads = vec![PointLoad {
                position: [0.7; 3],
                force: [0.0; 3],
            }];
        }
        Some(feature @ ("far-body" | "far-contact")) => {
            scene.bodies.push(Body {
                name: "far block".into(),
                id: 2,
                shape: Shape::Cuboid {
                    p1: [1.7; 3],
                    p2: [1.8; 3],
                },
                velocity: [0.0; 3],
                ..scene.bodies[0].clone()
            });
            if feature == "far-contact" {
                scene.contacts = vec![Contact {
                    name: "contact".into(),
                    id: 1,
                    friction: 0.3,
                    master: 1,
                    slave: 2,
                    normal: ContactNormal::Collinear,
                }];
            }
        }
        Some(other) => return Err(format!("no feature {other}").into()),
    }
    let mut simulation = Simulation::new(&scene, &Options::default())?;
    for _ in 0..20 {
        simulation.step(1.0)?;
    }
    println!("{:016x}", simulation.state_hash());
    Ok(())
}
