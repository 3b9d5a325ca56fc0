//! Do soft grains that a plate compacts push back as a packing does?
//!
//! Source: Liang et al. 2024, section 4.6: sixteen soft grains, some of them concave, in a container of 10 m x 13 m under a
//! rigid plate that comes down at 0.1 m/s; E = 60 kPa, nu = 0.32, 500 kg/m³, no gravity; h = 0.2 m, 4 x 4 particles per
//! cell, segments of about 0.1 m; a PIC share of 0.1, viscous damping of 0.1; g_c = 0.085 m, kappa = 7e4 Pa/m,
//! kappa_t = 1e5 Pa/m, friction 0.2 between grains and plate; walls and floor without friction. The printed way of the
//! plate, 0.49 m, does not belong to the printed times of up to 49 s: 4.9 m does.
//!
//! The paper's shapes are not published. Here r(theta) is a circle with three waves of random amplitude and phase, from
//! the seed below, scaled into its part of the container, as large as the paper's 26 916 particles of 0.0025 m² make
//! them; four rows of them then leave 2.7 m free, where the paper's packing reaches the floor after 3 m.
//!
//! No exact solution: what must hold whatever the shapes is judged. No vertex of a grain lies in another one; momentum is
//! the impulse of plate, floor and walls less that of the damping; at the end the plate carries what floor and damping
//! take; the packing resists little while the grains find their places and more and more when they fill the voids; the
//! plate is not pushed sideways. What the packing resists with is the plate's force less that of the damping: eq. 20
//! takes 4.4 kN for every row of grains that moves with the plate, of 38 kN at the end, before any of them has reached
//! the floor. The slopes with it are stated. `proctor verify grains`.

use libm::{cos, hypot, sin};
use proctor_kernel::mortar::Point;
use proctor_kernel::mortar::boundary::{Chain, Side};
use proctor_kernel::mortar::motion::Follow;
use proctor_kernel::mortar::points::Detection;
use proctor_kernel::scene::{
    Body, BodyBoundary, Damping, Dimension, DomainUpdate, Enforcement, History, Mesh,
    MortarContact, PlaneCondition, RigidLine, Scene, Shape, StressScheme, TransferKind, Vertices,
    Weighting,
};
use proctor_kernel::simulation::{Options, Simulation};
use std::f64::consts::TAU;

use super::{NO_RESULTS, elastic, failed};
use crate::case::{
    Case, CaseError, Curve, CurvePoint, Drawing, Gate, Quantity, Relation, Rung, Size, Solved,
    Verdict,
};

/// Seed of the shapes.
const SEED: u64 = 2024;
/// The part of the container that belongs to a grain \[m\].
const PART: [f64; 2] = [2.5, 3.25];
/// Half the extents of a grain \[m\].
const HALF: [f64; 2] = [1.06, 1.29];
/// Points around a grain.
const POINTS: usize = 88;
/// Largest amplitudes of the waves with 2, 3 and 4 periods over the radius. A wave of k periods makes a circle concave
/// above 1/(k² + 1).
const WAVES: [f64; 3] = [0.1, 0.15, 0.06];
const YOUNG: f64 = 6e4;
const POISSON: f64 = 0.32;
const DENSITY: f64 = 500.0;
const GAP: f64 = 0.085;
const KAPPA: f64 = 7e4;
const KAPPA_T: f64 = 1e5;
const FRICTION: f64 = 0.2;
const DAMPING: f64 = 0.1;
/// Speed of the plate \[m/s\].
const SPEED: f64 = 0.1;
/// Way of the plate over the height of the container.
const WAY: f64 = 4.9 / 13.0;
/// Samples of a run.
const SAMPLES: usize = 245;

const PLATE: i64 = 101;
const FLOOR: i64 = 102;
const WALLS: [i64; 2] = [103, 104];

const INSIDE: &str = "vertices inside another grain";
const MOMENTUM: &str = "momentum that no impulse accounts for, over the plate's impulse";
const BALANCE: &str = "plate less floor and damping, over the plate, last tenth";
const FLOOR_SHARE: &str = "floor over plate, last tenth";
const PHASES: &str =
    "slope of the force less damping in the first half over that in the last tenth";
const WITH_DAMPING: &str = "slope of the force in the last tenth over that in the first half";
const SIDEWAYS: &str = "mean horizontal force on the plate over the largest vertical one";
const LARGEST: &str = "largest force on the plate";
const REACHED: &str = "share of the way that was run";

/// The compacted grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grains {
    /// Damping of the momentum balance over that of the scenes. Anything but 1 is a wrong reference, to prove that the
    /// gates notice.
    pub reference_damping: f64,
}

impl Grains {
    /// The case as it is meant.
    pub const GIVEN: Self = Self {
        reference_damping: 1.0,
    };

    /// Grains per side of the packing.
    fn side(rung: &Rung) -> usize {
        if rung.variant == "four" { 2 } else { 4 }
    }
}

/// Uniform numbers on (0, 1) from a seed (splitmix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Outlines of the grains, counter-clockwise, row by row from the bottom; `side` grains per row and as many rows.
#[must_use]
pub fn outlines(side: usize) -> Vec<Vec<[f64; 2]>> {
    let mut random = Random(SEED);
    (0..side * side)
        .map(|grain| {
            let waves = WAVES.map(|most| (most * random.next(), TAU * random.next()));
            let around = (0..POINTS).map(|k| {
                let angle = TAU * k as f64 / POINTS as f64;
                let wave =
                    |(i, (a, phase)): (usize, &(f64, f64))| a * cos((i + 2) as f64 * angle + phase);
                let r = 1.0 + waves.iter().enumerate().map(wave).sum::<f64>();
                [r * cos(angle), r * sin(angle)]
            });
            let points: Vec<[f64; 2]> = around.collect();
            let place = [grain % side, grain / side];
            let scale: [(f64, f64); 2] = std::array::from_fn(|axis| {
                let range = points.iter().fold((f64::MAX, f64::MIN), |(low, high), p| {
                    (low.min(p[axis]), high.max(p[axis]))
                });
                let factor = 2.0 * HALF[axis] / (range.1 - range.0);
                let middle = 0.5 * (range.0 + range.1);
                let center = (place[axis] as f64 + 0.5) * PART[axis];
                (factor, center - factor * middle)
            });
            let placed = points
                .iter()
                .map(|p| std::array::from_fn(|axis| scale[axis].0 * p[axis] + scale[axis].1));
            placed.collect()
        })
        .collect()
}

/// A rigid line through points, with vertices no more than `segment` \[m\] apart.
fn line(id: i64, name: &str, ends: [[f64; 2]; 2], motion: Option<History>) -> RigidLine {
    let [a, b] = ends.map(Point::from);
    let count = ((b - a).norm() / 0.25).ceil() as usize;
    RigidLine {
        name: name.to_owned(),
        id,
        chains: vec![Chain {
            points: (0..=count)
                .map(|k| a + (b - a) * (k as f64 / count as f64))
                .collect(),
            side: Side::Open,
        }],
        motion,
    }
}

/// What is summed up step by step and looked at from time to time.
#[derive(Debug, Default)]
struct Watch {
    /// Impulses of plate, floor and walls, and of the damping so far \[N s\].
    plate: [f64; 2],
    others: [f64; 2],
    damping: [f64; 2],
    /// Way of the plate \[m\], force on it, force on the floor, damping force and rate of change of momentum \[N\].
    samples: Vec<Sample>,
    /// Most vertices inside another grain.
    inside: usize,
    /// Where all stand at the start, in the middle and at the end.
    drawings: Vec<Drawing>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    way: f64,
    /// Means since the sample before: of the forces on the grains from plate, floor and damping \[N\].
    plate: [f64; 2],
    floor: f64,
    damping: f64,
}

impl Watch {
    fn run(
        simulation: &mut Simulation,
        rate: f64,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Self, String> {
        let mut watch = Self::default();
        let end = simulation.scene().time;
        let grains = simulation.sets().len() as i64;
        let mut dt_before = 0.0;
        watch.drawings.push(drawing(simulation, grains));
        for k in 1..=SAMPLES {
            let time = end * k as f64 / SAMPLES as f64;
            let mut mean = Sample::default();
            let mut span = 0.0;
            while simulation.time() < time {
                let p = simulation.momentum();
                let info = simulation.step(time).map_err(|e| e.to_string())?;
                // A step changes velocities over the mean of the steps that it joins.
                let kick = 0.5 * (dt_before + info.dt);
                dt_before = info.dt;
                let force = |id| simulation.mortar_force(id).unwrap_or([f64::NAN; 3]);
                let (plate, floor) = (force(PLATE), force(FLOOR));
                let [left, right] = WALLS.map(force);
                for axis in 0..2 {
                    watch.plate[axis] -= kick * plate[axis];
                    watch.others[axis] -= kick * (floor[axis] + left[axis] + right[axis]);
                    watch.damping[axis] -= kick * rate * p[axis];
                    mean.plate[axis] -= kick * plate[axis];
                }
                mean.floor -= kick * floor[1];
                mean.damping -= kick * rate * p[1];
                span += kick;
            }
            progress(k as f64 / SAMPLES as f64);
            watch.samples.push(Sample {
                way: SPEED * simulation.time(),
                plate: mean.plate.map(|f| f / span),
                floor: mean.floor / span,
                damping: mean.damping / span,
            });
            watch.inside = watch.inside.max(vertices_inside(simulation, grains));
            if k == SAMPLES / 2 || k == SAMPLES {
                watch.drawings.push(drawing(simulation, grains));
            }
        }
        Ok(watch)
    }

    fn quantities(&self, simulation: &Simulation) -> Vec<Quantity> {
        let p = simulation.momentum();
        let left: [f64; 2] = std::array::from_fn(|axis| {
            p[axis] - self.plate[axis] - self.others[axis] - self.damping[axis]
        });
        let tenth = self.samples.len() / 10;
        let last = &self.samples[self.samples.len() - tenth..];
        let mean = |of: fn(&Sample) -> f64| last.iter().map(of).sum::<f64>() / tenth as f64;
        // Forces on the grains: the plate pushes down, floor and damping up.
        let (plate, floor, damping) = (
            -mean(|s| s.plate[1]),
            mean(|s| s.floor),
            mean(|s| s.damping),
        );
        let half = &self.samples[..self.samples.len() / 2];
        let phases = |force: fn(&Sample) -> f64| {
            let slopes = [half, last].map(|part| slope(part, force));
            (slopes[1] > 0.0).then_some(slopes)
        };
        let largest = self.samples.iter().map(|s| -s.plate[1]);
        let largest = largest.fold(0.0, f64::max);
        let sideways = self.samples.iter().map(|s| s.plate[0]).sum::<f64>();
        let sideways = sideways / self.samples.len() as f64;
        let plain = |name, value, unit| Quantity {
            name,
            value,
            exact: None,
            error: None,
            unit,
        };
        vec![
            plain(INSIDE, self.inside as f64, "1"),
            plain(MOMENTUM, hypot(left[0], left[1]) / self.plate[1].abs(), "1"),
            plain(BALANCE, (plate - floor - damping).abs() / plate, "1"),
            plain(FLOOR_SHARE, floor / plate, "1"),
            plain(
                PHASES,
                // Where nothing rises at the end there are no two phases.
                phases(|s| -s.plate[1] - s.damping)
                    .map_or(f64::INFINITY, |[first, last]| first.abs() / last),
                "1",
            ),
            plain(
                WITH_DAMPING,
                phases(|s| -s.plate[1]).map_or(f64::NAN, |[first, last]| last / first),
                "1",
            ),
            plain(SIDEWAYS, sideways.abs() / largest, "1"),
            plain(LARGEST, largest, "N"),
            plain(REACHED, simulation.time() / simulation.scene().time, "1"),
        ]
    }
}

/// Slope of a force over the way \[N/m\], by least squares.
fn slope(samples: &[Sample], force: fn(&Sample) -> f64) -> f64 {
    let n = samples.len() as f64;
    let x = samples.iter().map(|s| s.way).sum::<f64>() / n;
    let y = samples.iter().map(force).sum::<f64>() / n;
    let (mut product, mut square) = (0.0, 0.0);
    for s in samples {
        product += (s.way - x) * (force(s) - y);
        square += (s.way - x).powi(2);
    }
    product / square
}

/// Grains, plate, floor and walls as they are now.
fn drawing(simulation: &Simulation, grains: i64) -> Drawing {
    let of = |id| {
        let vertices = simulation.boundary_vertices(id)?;
        Some(vertices.iter().map(|x| [x[0], x[1]]).collect())
    };
    Drawing {
        title: format!(
            "{}: grains at t = {:.1} s",
            simulation.scene().name,
            simulation.time()
        ),
        bodies: (1..=grains).filter_map(of).collect(),
        lines: [PLATE, FLOOR, WALLS[0], WALLS[1]]
            .into_iter()
            .filter_map(of)
            .collect(),
    }
}

/// Number of vertices of grains that lie inside another grain's polyline.
fn vertices_inside(simulation: &Simulation, grains: i64) -> usize {
    let outlines: Vec<Vec<[f64; 3]>> = (1..=grains)
        .filter_map(|id| simulation.boundary_vertices(id))
        .collect();
    let boxes: Vec<[f64; 4]> = outlines.iter().map(|o| box_of(o)).collect();
    let mut count = 0;
    for (i, outline) in outlines.iter().enumerate() {
        for (j, other) in outlines.iter().enumerate() {
            let (a, b) = (&boxes[i], &boxes[j]);
            if i == j || a[1] < b[0] || b[1] < a[0] || a[3] < b[2] || b[3] < a[2] {
                continue;
            }
            count += outline.iter().filter(|x| is_inside(other, x)).count();
        }
    }
    count
}

/// Smallest and largest x, then y.
fn box_of(points: &[[f64; 3]]) -> [f64; 4] {
    let start = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    points.iter().fold(start, |b, p| {
        [
            b[0].min(p[0]),
            b[1].max(p[0]),
            b[2].min(p[1]),
            b[3].max(p[1]),
        ]
    })
}

/// Whether a point lies in a polygon: a ray from it crosses the polygon an odd number of times.
fn is_inside(polygon: &[[f64; 3]], x: &[f64; 3]) -> bool {
    let mut inside = false;
    let mut before = polygon.len() - 1;
    for (k, a) in polygon.iter().enumerate() {
        let b = &polygon[before];
        let crosses = (a[1] > x[1]) != (b[1] > x[1]);
        if crosses && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) {
            inside = !inside;
        }
        before = k;
    }
    inside
}

impl Case for Grains {
    fn name(&self) -> &'static str {
        "grains"
    }

    fn question(&self) -> &'static str {
        "Do soft grains that a plate compacts push back as a packing does?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        let (variant, cell) = match size {
            Size::Quick => ("four", 0.3125),
            Size::Full => ("sixteen", 0.2),
        };
        vec![Rung {
            label: format!("{variant} h={cell}"),
            cell,
            variant,
        }]
    }

    fn scene(&self, rung: &Rung) -> Scene {
        let h = rung.cell;
        let side = Self::side(rung);
        let per_cell = if side == 2 { 3 } else { 4 };
        let [width, height] = PART.map(|part| part * side as f64);
        let margin = 2.0 * h;
        let cells = |length: f64| ((length + 2.0 * margin) / h).ceil() as usize;
        let mut mesh = Mesh::new(
            Dimension::Two,
            [-margin, -margin, 0.0],
            [h, h, 1.0],
            [cells(width), cells(height), 1],
        );
        mesh.planes[..2].fill([PlaneCondition::Free; 2]);
        let mut scene = Scene::new(Dimension::Two, mesh, WAY * height / SPEED);
        scene.name.clone_from(&rung.label);
        scene.results = NO_RESULTS;
        scene.weighting = Weighting::ContiguousGimp(DomainUpdate::LeftStretch);
        scene.scheme = StressScheme::Musl;
        scene.transfer.kind = TransferKind::Apic;
        scene.transfer.pic_fraction = 0.1;
        scene.damping = Damping::Viscous { alpha: DAMPING };
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        let down = History {
            times: vec![0.0],
            values: vec![[0.0, -SPEED, 0.0]],
        };
        let top = height + 1.0;
        scene.mortar.lines = vec![
            line(
                PLATE,
                "plate",
                [[-1.0, height], [width + 1.0, height]],
                Some(down),
            ),
            line(FLOOR, "floor", [[width + 1.0, 0.0], [-1.0, 0.0]], None),
            line(WALLS[0], "left wall", [[0.0, -1.0], [0.0, top]], None),
            line(WALLS[1], "right wall", [[width, top], [width, -1.0]], None),
        ];
        for (k, outline) in outlines(side).into_iter().enumerate() {
            let id = k as i64 + 1;
            scene.bodies.push(Body {
                name: format!("grain {id}"),
                id,
                material: 0,
                shape: Shape::Polygon {
                    points: outline.iter().map(|p| [p[0], p[1], 0.0]).collect(),
                },
                particles_per_cell: [per_cell, per_cell, 1],
                velocity: [0.0; 3],
                motion: None,
            });
            scene.mortar.boundaries.push(BodyBoundary {
                body: id,
                vertices: Vertices::Given(vec![Chain {
                    points: outline.into_iter().map(Point::from).collect(),
                    side: Side::Outer,
                }]),
                follow: Follow::Spin,
            });
            let masters = (1..id).chain([PLATE, FLOOR, WALLS[0], WALLS[1]]);
            for master in masters {
                let smooth = master == FLOOR || WALLS.contains(&master);
                scene.mortar.contacts.push(MortarContact {
                    name: format!("grain {id} and {master}"),
                    id: scene.mortar.contacts.len() as i64 + 1,
                    master,
                    slave: id,
                    friction: if smooth { 0.0 } else { FRICTION },
                    critical_gap: GAP,
                    normal_stiffness: KAPPA,
                    tangential_stiffness: KAPPA_T,
                    enforcement: Enforcement::Barrier,
                    detection: Detection::Mortar,
                });
            }
        }
        scene
    }

    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let scene = self.scene(rung);
        scene.check().map_err(|e| failed(self, rung, &e))?;
        let mut simulation =
            Simulation::new(&scene, options).map_err(|e| failed(self, rung, &e))?;
        let rate = self.reference_damping * DAMPING * (YOUNG / DENSITY).sqrt() / rung.cell;
        let watch =
            Watch::run(&mut simulation, rate, progress).map_err(|e| failed(self, rung, &e))?;
        let quantities = watch.quantities(&simulation);
        let points = watch.samples.iter().map(|s| CurvePoint {
            at: s.way,
            computed: -s.plate[1],
            exact: f64::NAN,
        });
        Ok(Solved {
            particles: simulation.particles(),
            steps: simulation.steps(),
            time: simulation.time(),
            quantities,
            drawings: watch.drawings,
            curve: Some(Curve {
                title: format!("{}: force on the plate", rung.label),
                abscissa: "way of the plate in m",
                ordinate: "F_y in N",
                points: points.collect(),
            }),
        })
    }

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let mut gates = vec![];
        for rung in self.rungs(size) {
            let found = solved.iter().find(|(other, _)| *other == rung);
            let mut gate = |name: &'static str, relation, bound, reason| {
                gates.push(Gate {
                    name: format!("{}: {name}", rung.label),
                    value: found.map_or(f64::NAN, |(_, s)| s.value(name)),
                    relation,
                    bound,
                    reason,
                });
            };
            let (most, least) = (Relation::AtMost, Relation::AtLeast);
            gate(INSIDE, most, 0.0, "grains do not penetrate each other");
            gate(
                MOMENTUM,
                most,
                1e-8,
                "forces on grains and walls are the same vectors; round-off of some thousand steps",
            );
            gate(
                BALANCE,
                most,
                0.02,
                "the packing hardly accelerates; the walls have no friction",
            );
            gate(
                PHASES,
                most,
                0.2,
                "grains that fill the voids resist, grains that find their places hardly do",
            );
            gate(
                SIDEWAYS,
                most,
                0.05,
                "nothing but friction with a few grains pushes the plate sideways",
            );
            gate(REACHED, least, 1.0, "no failure to the end");
        }
        Verdict {
            gates,
            for_the_record: solved
                .iter()
                .map(|(rung, s)| {
                    format!(
                        "{}: largest force on the plate {:.4e} N; at the end the floor takes {:.1} % of the plate's force, \
                         the damping the rest; slopes of the plate's own force {:.2} : 1",
                        rung.label,
                        s.value(LARGEST),
                        100.0 * s.value(FLOOR_SHARE),
                        s.value(WITH_DAMPING),
                    )
                })
                .collect(),
            ..Verdict::default()
        }
    }
}
