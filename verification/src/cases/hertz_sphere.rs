//! Is the pressure between an elastic ball and a rigid plane that of Hertz?
//!
//! Source: Hertz 1881 (Johnson, Contact Mechanics, section 4.2b) for the answer; the numbers are those of the half disk of
//! Liang et al. 2024, section 4.2, R = 8 m, E = 200 Pa, nu = 0.3, critical gap 0.05 m, with the load of a contact of radius
//! a = 1.2 m. A quarter of the lower part of the ball is run, a round block of 6 m (5 a) between two planes of symmetry with
//! a spherical bottom and the load on its flat top; the plane is two rigid triangles. Pressures are averaged over the end.
//!
//! Expected: contact radius and peak pressure within 5 %. Of this the barrier layer takes about 1 % (it gives way by 5 % of
//! the approach of the bodies), and the block's size 8/3 (a/L)^3, 2 %, at most. `proctor verify hertz-sphere`.

use super::prelude::*;
use super::vocabulary::pressures::Pressures;
use crate::exact::hertz::contact_modulus;
use crate::exact::hertz_sphere::HertzSphere as Exact;
use libm::{asin, hypot, sin, sincos};
use proctor_contact::geometry::mortar::space::refine::fill;

const RADIUS: f64 = 8.0;
/// Contact radius that the load is chosen for \[m\].
const CONTACT: f64 = 1.2;
const YOUNG: f64 = 200.0;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 1.0;
/// Rate of viscous damping, with which the bounce of the block on its contact (1 rad/s) is damped critically \[1/s\].
const DAMPING: f64 = 2.0;
/// Share of PIC, with any transfer.
const PIC: f64 = 0.1;
const GAP: f64 = 0.05;
const KAPPA: f64 = 5.0e3;
const BLOCK: f64 = 6.0; // Radius and height of the block [m]
const FINE: f64 = 1.8; // The bottom within this length from the pole has fine triangles [m]
/// Time at which averaging begins, and at which it ends \[s\].
const AVERAGED: [f64; 2] = [8.0, 10.0];
const MIDDLE: f64 = 0.25; // The mean over this share of the contact radius gives the peak pressure

const FORCE: &str = "contact force";
const PEAK: &str = "peak pressure";
const WIDTH: &str = "contact radius";
const L2: &str = "L2(p) against Hertz";

const OVER_RADIUS: [&str; 2] = [
    "2.4 cells over the contact radius",
    "4.8 cells over the contact radius",
];
const WRONG_LOAD: Wrong = Wrong::factor("load", 1.02).breaks(|gate| gate.contains("force"));

/// The ball on a rigid plane.
pub static HERTZ_SPHERE: Case = Case::new(
    "hertz-sphere",
    "Is the pressure between an elastic ball and a rigid plane that of Hertz?",
)
.ladder(Ladder::made(|size| {
    of_cells(size.pick(&[0.5], &[0.5, 0.375, 0.25]))
}))
.method(|_| Settings::new(APIC))
.tried_scene(|rung, settings| Ok(build(rung, settings)?))
.run(compare)
.gates(&[
    error(FORCE).at_most(0.01, "the load must arrive").by_rung(),
    error(PEAK).at_most_of([0.1, 0.05], OVER_RADIUS).by_rung(),
    error(WIDTH).at_most_of([0.1, 0.05], OVER_RADIUS).by_rung(),
])
.tables(&[TableRule::new("{variant}", &[FORCE, PEAK, WIDTH, L2])])
.wrong_references(&[WRONG_LOAD])
.studies(&[Plan::new(
    Ladder::made(|size| of_cells(size.pick(&[1.2, 0.6], &[1.5, 0.75, 0.375]))),
    &[
        Measure::new("pressure", L2),
        Measure::new("peak", PEAK),
        Measure::new("radius", WIDTH),
    ],
    3,
)
// Down to an error of 1 % in peak and radius.
.going_on(Ladder::made(|size| of_cells(size.pick(&[], &[0.25]))))
.trying(few)])
.no_guest("only the pressure of the contact is known exactly, and frames of particles hold none");

fn exact(reference: Reference) -> Exact {
    Exact {
        load: load() * reference.of(&WRONG_LOAD),
        ..of_load(1.0)
    }
}

fn build(rung: &Rung, settings: &Settings) -> Result<Scene, SurfaceError> {
    let h = rung.cell;
    let (margin, top) = (2.0 * h, GAP + BLOCK);
    let cells = |length: f64| (length / h).ceil() as usize;
    let (wide, high) = (cells(BLOCK + margin), cells(top + 2.0 * margin));
    let origin = [0.0, 0.0, -margin];
    let mut mesh = Mesh::new(Dimension::Three, origin, [h; 3], [wide, wide, high]);
    let symmetry = [PlaneCondition::Sliding, PlaneCondition::Free];
    mesh.planes = [symmetry, symmetry, [PlaneCondition::Free; 2]];
    let ball = Shape::Particles(Arc::new(particles(h, settings.particles_per_cell)));
    let around = Vertices::Surface(Arc::new(boundary(h)?));
    let mut scene = Scene {
        name: rung.label.clone(),
        time_step: settings.multiplier(),
        materials: elastic(DENSITY, YOUNG, POISSON),
        bodies: vec![body("ball", 1, ball)],
        damping: Damping::Viscous {
            alpha: DAMPING * h / (YOUNG / DENSITY).sqrt(),
        },
        box_loads: vec![BoxLoad {
            p1: [0.0, 0.0, top - h],
            p2: [BLOCK, BLOCK, top + h],
            force: [0.0, 0.0, -0.25 * load()],
        }],
        mortar: Mortar {
            boundaries: vec![mortar::boundary(1, around)],
            facets: vec![RigidFacets {
                name: "plane".into(),
                id: 2,
                surface: Arc::new(plane()?),
                motion: None,
            }],
            contacts: vec![barrier("ball on plane", [2, 1], GAP, KAPPA)],
            ..Mortar::default()
        },
        ..Scene::new(Dimension::Three, mesh, AVERAGED[1])
    };
    settings.apply(&mut scene);
    scene.transfer.pic_fraction = PIC;
    Ok(scene)
}

fn of_load(load: f64) -> Exact {
    Exact {
        radius: RADIUS,
        load,
        modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
    }
}

/// Force with which Hertz gives the contact radius \[N\].
fn load() -> f64 {
    4.0 * of_load(1.0).modulus * CONTACT.powi(3) / (3.0 * RADIUS)
}

/// Height of the ball's bottom at a distance from its axis \[m\].
fn bottom(r: f64) -> f64 {
    GAP + RADIUS - (RADIUS * RADIUS - r * r).sqrt()
}

/// Particles of the quarter of the block, about so many per cell and axis: columns that reach from the ball's surface to the
/// top, so that no step of a lattice lies in the contact, with volumes that add up to that of the block.
fn particles(h: f64, per_cell: usize) -> Vec<ParticleSeed> {
    let step = h / per_cell as f64;
    let count = (BLOCK / step).ceil() as usize;
    let at = |k: usize| (k as f64 + 0.5) * step;
    let mut seeds = vec![];
    for i in 0..count {
        for j in 0..count {
            let (x, y) = (at(i), at(j));
            let r = hypot(x, y);
            if r >= BLOCK {
                continue;
            }
            let height = GAP + BLOCK - bottom(r);
            let layers = (height / step).round();
            for k in 0..layers as usize {
                let z = bottom(r) + height * (k as f64 + 0.5) / layers;
                seeds.push(ParticleSeed {
                    position: [x, y, z],
                    volume: step * step * height / layers,
                });
            }
        }
    }
    // The block without what is below the ball: pi L² H less the volume under its cap.
    let sag = bottom(BLOCK) - GAP;
    let cap = PI * sag * sag * (RADIUS - sag / 3.0);
    let below = PI * BLOCK * BLOCK * sag - cap;
    let volume = 0.25 * (PI * BLOCK.powi(3) - below);
    let scale = volume / seeds.iter().map(|seed| seed.volume).sum::<f64>();
    for seed in &mut seeds {
        seed.volume *= scale;
    }
    seeds
}

/// Distance from the axis and height along the outline of the block from the pole to the top's middle.
fn profile(h: f64) -> Vec<[f64; 2]> {
    let mut outline = vec![];
    let (mut s, end) = (0.0, RADIUS * asin(BLOCK / RADIUS));
    while s < end - h {
        let r = RADIUS * sin(s / RADIUS);
        outline.push([r, bottom(r)]);
        s += if s < FINE { 0.4 * h } else { 2.0 * h };
    }
    let top = GAP + BLOCK;
    outline.extend([[BLOCK, bottom(BLOCK)], [BLOCK, top], [0.0, top]]);
    outline
}

/// Triangles around the quarter of the block.
fn boundary(h: f64) -> Result<Surface, SurfaceError> {
    let profile = profile(h);
    let ring = |k: usize| -> Vec<[f64; 3]> {
        let [r, z] = profile[k];
        if r == 0.0 {
            return vec![[0.0, 0.0, z]];
        }
        let spacing = if r < FINE { 0.4 * h } else { 2.0 * h };
        let count = (FRAC_PI_2 * r / spacing).ceil() as usize;
        (0..=count)
            .map(|i| {
                let (sin, cos) = sincos(FRAC_PI_2 * i as f64 / count as f64);
                let on = |x: f64, end: usize| if i == end { 0.0 } else { r * x };
                [on(cos, count), on(sin, 0), z]
            })
            .collect()
    };
    let mut corners: Vec<[[f64; 3]; 3]> = vec![];
    for k in 1..profile.len() {
        let (lower, upper) = (ring(k - 1), ring(k));
        let (n, m) = (lower.len() - 1, upper.len() - 1);
        let (mut i, mut j) = (0, 0);
        while i < n || j < m {
            if j == m || (i < n && (i + 1) * m <= (j + 1) * n) {
                corners.push([lower[i], lower[i + 1], upper[j]]);
                i += 1;
            } else {
                corners.push([lower[i], upper[j + 1], upper[j]]);
                j += 1;
            }
        }
    }
    // The two planes of symmetry.
    let outline: Vec<_> = profile.iter().map(|p| (*p).into()).collect();
    let (points, triangles) = fill(&outline, f64::INFINITY);
    for [a, b, c] in triangles {
        corners.push([a, b, c].map(|v| [points[v].x, 0.0, points[v].y]));
        corners.push([a, c, b].map(|v| [0.0, points[v].x, points[v].y]));
    }
    Surface::new(&corners)
}

/// The rigid plane.
fn plane() -> Result<Surface, SurfaceError> {
    let (low, high) = (-1.0, BLOCK + 2.0);
    let at = |x: f64, y: f64| [x, y, 0.0];
    let [a, b, c, d] = [at(low, low), at(high, low), at(high, high), at(low, high)];
    Surface::new(&[[a, b, c], [a, c, d]])
}

/// Cell sizes \[m\].
fn of_cells(cells: &[f64]) -> Vec<Rung> {
    let of = |&cell: &f64| Rung::labelled(format!("h={cell}"), "sphere", cell);
    cells.iter().map(of).collect()
}

/// Peak pressure with the mean over the middle, as Hertz has it.
fn peak(found: &Pressures, exact: &Exact) -> f64 {
    let within = MIDDLE * exact.contact_radius();
    let inner = found.vertices.iter().filter(|p| p[0] <= within);
    let (force, area) = inner.fold((0.0, 0.0), |(f, a), [_, p, w]| (f + p * w, a + w));
    force / area * exact.peak() / exact.mean_within(within)
}

fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let from_axis = |x: &Vector| hypot(x[0], x[1]);
    let [from, _] = AVERAGED;
    let found = Pressures::averaged(run.simulation, from, FINE, from_axis, run.observer)?;
    let exact = exact(run.reference);
    // Of the Hertz pressure with the same second moment, sqrt(5/2 m_2/m_0).
    let radius = (2.5 * found.moment(2) / found.moment(0)).sqrt();
    let quantities = [
        Quantity::compared(FORCE, 4.0 * found.force[2], exact.load, "N"),
        Quantity::compared(PEAK, peak(&found, &exact), exact.peak(), "Pa"),
        Quantity::compared(WIDTH, radius, exact.contact_radius(), "m"),
        Quantity::of_zero(L2, found.distance(|r| exact.pressure(r))),
    ];
    let mut curve = found.curve(run.rung, "r in m", FINE, |r| exact.pressure(r));
    curve.points.sort_by(|a, b| a.at.total_cmp(&b.at));
    Ok(Measurements::of(quantities).drawn(curve))
}
