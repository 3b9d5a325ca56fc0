//! What the plan says of each thing that it keeps or leaves out, and why.

use super::{Demands, Entry, Plan};
use crate::mortar::motion::Follow;
use crate::mortar::points::Detection;
use crate::particles::Layout;
use crate::scene::{
    Body, ContactNormal, Dimension, DomainUpdate, Enforcement, PlaneCondition, RigidSurface, Scene,
    Shape, StressScheme, Weighting,
};
use crate::simulation::has_safe_step;
use crate::stage::g2p::Affine;

impl Plan {
    pub(super) fn describe(&self, scene: &Scene, demands: Demands) -> Vec<Entry> {
        let mut list = Words(vec![]);
        let dimension = match scene.dimension {
            Dimension::Two => "2D, plane strain",
            Dimension::Three => "3D",
        };
        list.keep("stage", "dimension", dimension);
        list.keep(
            "stage",
            "weighting function",
            weighting_words(scene.weighting),
        );
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
            self.affine != Affine::Leave,
            "the transfer is APIC or TPIC",
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
            "gravity",
            self.gravity,
            "it is not zero",
            "it is zero",
        );
        for (axis, letter) in ["X", "Y", "Z"].iter().enumerate().take(self.axes) {
            for (side, end) in ["0", "n"].iter().enumerate() {
                let condition = scene.mesh.planes[axis][side];
                let moving = scene
                    .base_motion
                    .as_ref()
                    .is_some_and(|b| b.axis == axis && b.side == side);
                list.choose(
                    "stage",
                    &format!("plane {letter}{end}"),
                    moving || condition != PlaneCondition::Free,
                    if moving {
                        "its velocity is prescribed"
                    } else if condition == PlaneCondition::Fixed {
                        "fixed"
                    } else {
                        "sliding"
                    },
                    "free",
                );
            }
        }
        list.choose(
            "stage",
            "local damping",
            self.local_damping.is_some(),
            "its factor is not zero",
            "not asked for, or its factor is zero",
        );
        list.choose(
            "stage",
            "kinetic damping",
            self.kinetic_damping,
            "asked for: velocities are set to zero at each peak of kinetic energy",
            "not asked for",
        );
        list.choose(
            "stage",
            "viscous damping",
            self.viscous_damping.is_some(),
            "its factor is not zero",
            "not asked for, or its factor is zero",
        );
        list.choose(
            "stage",
            "base motion",
            scene.base_motion.is_some(),
            "a record moves a plane, and the mesh with it along its normal",
            "no active record",
        );
        list.choose(
            "stage",
            "held nodes",
            !scene.held_boxes.is_empty(),
            "nodes in a box stand still",
            "no box is held",
        );
        let nodal = scene.point_loads.len() + scene.tractions.len();
        list.choose(
            "stage",
            "nodal loads",
            nodal > 0,
            "point loads or tractions are given",
            "none is given",
        );
        list.choose(
            "stage",
            "driven bodies",
            scene.bodies.iter().any(|b| b.motion.is_some()),
            "a body has a prescribed velocity",
            "no body has a prescribed velocity",
        );
        contact_words(scene, &mut list);
        let surfaces: Vec<String> = scene.surfaces.iter().map(surface_words).collect();
        list.choose(
            "stage",
            "contact with rigid surfaces",
            !surfaces.is_empty(),
            &surfaces.join("; "),
            "the scene has none",
        );
        list.choose(
            "stage",
            "measurement at the nodes",
            self.measure,
            "kinetic energy or residual is needed in every step",
            "nothing needs it in every step",
        );
        let any = |has: fn(&Layout) -> bool| self.layouts.iter().any(has);
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
        let mut variables: Vec<String> = vec![];
        for body in &scene.bodies {
            let law = &scene.materials[body.material].law;
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
                "dt <= 0.7 min(h)/(c + |v|), which holds only while no node is nearly empty: linear functions \
                 have no safe step with USL or an affine transfer"
            },
        );
        list.choose(
            "output",
            "frames, history, checkpoints",
            scene.results.print > 0,
            &format!("written {} times", scene.results.print),
            "print is zero",
        );
        list.0
    }
}

/// One entry per pair, and what goes with contact.
fn contact_words(scene: &Scene, list: &mut Words) {
    let driven = |id: i64| {
        scene
            .bodies
            .iter()
            .any(|b| b.id == id && b.motion.is_some())
    };
    for contact in &scene.contacts {
        let normal = match contact.normal {
            ContactNormal::Master => "normal of the master",
            ContactNormal::Slave => "normal of the slave",
            ContactNormal::Collinear => "mean of both normals",
        };
        list.choose(
            "stage",
            &format!("contact {}", contact.id),
            !(driven(contact.master) && driven(contact.slave)),
            &format!(
                "bodies {} (master) and {}, friction {}, {normal}; on the grid, while the boxes of the bodies meet",
                contact.master, contact.slave, contact.friction
            ),
            "the motion of both bodies is prescribed",
        );
    }
    for boundary in &scene.mortar.boundaries {
        list.keep(
            "stage",
            &format!("boundary of body {}", boundary.body),
            match boundary.follow {
                Follow::Unaugmented => {
                    "its vertices follow the velocities of the nodes, those without mass too"
                }
                Follow::Velocity => "its vertices follow the velocities of the nodes",
                Follow::Spin => "its vertices follow velocities and spins of the nodes",
                Follow::Gradient => {
                    "its vertices follow velocities and velocity gradients of the nodes"
                }
            },
        );
    }
    for contact in &scene.mortar.contacts {
        list.keep(
            "stage",
            &format!("mortar contact {}", contact.id),
            &format!(
                "master {}, slave {}, critical gap {} m, normal stiffness {} Pa/m, friction {}; {}, {}",
                contact.master,
                contact.slave,
                contact.critical_gap,
                contact.normal_stiffness,
                contact.friction,
                match contact.enforcement {
                    Enforcement::Barrier => "barrier",
                    Enforcement::Penalty => "penalty",
                },
                match (contact.detection, scene.dimension) {
                    (Detection::Mortar, Dimension::Two) => "mortar segments",
                    (Detection::Mortar, Dimension::Three) => "mortar triangles",
                    (Detection::NodeToSegment, Dimension::Two) => "node to segment",
                    (Detection::NodeToSegment, Dimension::Three) => "node to triangle",
                },
            ),
        );
    }
    if scene.contacts.is_empty() && !scene.mortar.contacts.is_empty() {
        return;
    }
    if scene.contacts.is_empty() {
        list.leave("stage", "contact", "the scene asks for none");
        return;
    }
    list.choose(
        "stage",
        "real distance of contacts",
        scene.contact_distance != Some(0.0),
        &scene.contact_distance.map_or_else(
            || "contact acts below the sum of the half-lengths of the particles".to_owned(),
            |lambda| format!("contact acts below {lambda} cells"),
        ),
        "its coefficient is zero",
    );
    list.keep(
        "node field",
        "mass gradient, second velocity field",
        "128 bytes per node of a body while it is near a partner",
    );
}

/// Whether the particles of a body are given one by one.
pub(super) fn is_list(body: &Body) -> bool {
    matches!(body.shape, Shape::Particles(_))
}

/// A surface in a few words, its open edges among them: a terrain has some, a closed body none.
fn surface_words(rigid: &RigidSurface) -> String {
    let edges = rigid.surface.open_edges().map_or_else(
        || "closed".to_owned(),
        |open| {
            let [a, b] = open.first;
            format!(
                "{} open edges, the first at triangle {} from {a:?} to {b:?} m",
                open.count, open.triangle
            )
        },
    );
    format!(
        "{}, {} triangles, {edges}{}{}",
        rigid.name,
        rigid.surface.triangle_count(),
        if rigid.motion.is_some() {
            ", moving"
        } else {
            ""
        },
        if rigid.penalty_stiffness.is_some() {
            ", with a penalty force"
        } else {
            ""
        },
    )
}

fn weighting_words(weighting: Weighting) -> &'static str {
    match weighting {
        Weighting::Linear => "linear, 3 nodes per axis",
        Weighting::UniformGimp => "uGIMP, 3 nodes per axis",
        Weighting::ContiguousGimp(DomainUpdate::Determinant) => {
            "cpGIMP, domain by det F; 3 nodes per axis, 4 once a half-length exceeds h/2"
        }
        Weighting::ContiguousGimp(DomainUpdate::Stretch) => {
            "cpGIMP, domain by U_ii; 3 nodes per axis, 4 once a half-length exceeds h/2"
        }
        Weighting::ContiguousGimp(DomainUpdate::LeftStretch) => {
            "cpGIMP, domain by V_ii; 3 nodes per axis, 4 once a half-length exceeds h/2"
        }
        Weighting::QuadraticBSpline => "quadratic B-spline, 3 nodes per axis",
    }
}

/// The list as it grows.
struct Words(Vec<Entry>);

impl Words {
    fn keep(&mut self, group: &'static str, name: &str, because: &str) {
        self.0.push(Entry {
            group,
            name: name.into(),
            kept: true,
            because: because.into(),
        });
    }

    fn leave(&mut self, group: &'static str, name: &str, because: &str) {
        self.0.push(Entry {
            group,
            name: name.into(),
            kept: false,
            because: because.into(),
        });
    }

    fn choose(&mut self, group: &'static str, name: &str, kept: bool, why: &str, why_not: &str) {
        if kept {
            self.keep(group, name, why);
        } else {
            self.leave(group, name, why_not);
        }
    }
}
