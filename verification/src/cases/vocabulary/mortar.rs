//! Parts of all mortar contact cases: boundaries that move with their particles, contact through a barrier, the method
//! of Liang et al. 2024.

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::{
    BodyBoundary, DomainUpdate, Enforcement, History, MortarContact, RigidLine, Scene,
    StressScheme, TransferKind, Vertices, Weighting,
};

use crate::settings::{Method, Settings};
use proctor_scene::simulation::Simulation;

/// Reason for which no other solver can run a case.
pub const NO_GUEST: &str = "its subject is mortar contact, which the manuals do not know";

/// The paper's method.
pub const PAPER: Method = Method {
    weighting: Weighting::ContiguousGimp(DomainUpdate::LeftStretch),
    scheme: StressScheme::Musl,
    transfer: TransferKind::Apic,
};

/// uGIMP and USL with APIC.
pub const APIC: Method = Method::DEFAULT.with_transfer(TransferKind::Apic);

/// The paper's APIC: particles keep their velocity, the affine part goes to the nodes.
pub fn without_pic(scene: &mut Scene) {
    if scene.transfer.kind == TransferKind::Apic {
        scene.transfer.pic_fraction = 0.0;
    }
}

/// A method with so many particles per cell and axis.
pub fn settings(method: Method, particles_per_cell: usize) -> Settings {
    Settings {
        particles_per_cell,
        ..Settings::new(method)
    }
}

/// The boundary of a body, which follows its particles with their spin.
pub fn boundary(body: i64, vertices: Vertices) -> BodyBoundary {
    BodyBoundary {
        body,
        vertices,
        follow: FollowMode::Spin,
    }
}

/// A rigid line.
pub fn rigid_line(name: &str, id: i64, chain: Chain, motion: Option<History>) -> RigidLine {
    RigidLine {
        name: name.to_owned(),
        id,
        chains: vec![chain],
        motion,
    }
}

/// A rigid line through points that is open at its ends, with the body on its left.
pub fn open_line(
    name: &str,
    id: i64,
    points: impl IntoIterator<Item = Point>,
    motion: Option<History>,
) -> RigidLine {
    let chain = Chain {
        points: points.into_iter().collect(),
        side: BoundarySide::Open,
    };
    rigid_line(name, id, chain, motion)
}

/// The same contact with friction, on a tangential spring of a stiffness \[Pa/m\].
pub fn rubbing([friction, tangential_stiffness]: [f64; 2], smooth: MortarContact) -> MortarContact {
    MortarContact {
        friction,
        tangential_stiffness,
        ..smooth
    }
}

/// Contact of two boundaries without friction, through a barrier below the critical gap \[m\] of a stiffness \[Pa/m\].
pub fn barrier(
    name: impl Into<String>,
    [master, slave]: [i64; 2],
    critical_gap: f64,
    normal_stiffness: f64,
) -> MortarContact {
    MortarContact {
        name: name.into(),
        id: 1,
        master,
        slave,
        friction: 0.0,
        critical_gap,
        normal_stiffness,
        tangential_stiffness: 0.0,
        enforcement: Enforcement::Barrier,
        detection: Detection::Mortar,
    }
}

/// Angular momentum in the plane of the particles of a set about their own centre \[kg m²/s\], anticlockwise; in two
/// dimensions per thickness.
pub fn angular_momentum(simulation: &Simulation, set: usize) -> f64 {
    let center = simulation.center(set);
    let (x_c, v_c) = (center.position, center.velocity);
    let of = |p: usize| {
        let m = simulation.particle_mass(set, p);
        let (x, v) = (
            simulation.position(set, p),
            simulation.sets()[set].velocity(p),
        );
        let (rx, ry) = (x[0] - x_c[0], x[1] - x_c[1]);
        m * (rx * (v[1] - v_c[1]) - ry * (v[0] - v_c[0]))
    };
    (0..simulation.sets()[set].len()).map(of).sum()
}
