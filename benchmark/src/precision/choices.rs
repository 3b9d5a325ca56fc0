//! The runs of the chart of a case: lines of methods, points of refinement and sweeps.

use proctor_scene::{DomainUpdate, StressScheme, TransferKind, Weighting};
use proctor_verification::case::{Rung, Size};
use proctor_verification::settings::{Method, Settings};
use proctor_verification::study::Study;

/// Share of the kernel's stability number that runs of a path take: what an automatic step takes, which leaves room
/// for waves that run faster in compression.
const SAFE_SHARE: f64 = 0.8;
/// Particles per cell and axis of a path.
const PARTICLES_PER_CELL: usize = 2;
/// Shares of the Courant number of the path that are tried at one cell size.
const COURANT_SWEEP: [f64; 3] = [0.5, 0.25, 0.125];
/// Particles per cell and axis that are tried at one cell size.
const PARTICLES_SWEEP: [usize; 3] = [1, 3, 4];

/// Amount of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Length of the paths; the short one leaves out the sweeps and all but the usual methods.
    pub size: Size,
    /// Runs of each point, of which the fastest counts.
    pub repetitions: usize,
    /// The method of each case alone, along its path without sweeps.
    pub own: bool,
}

/// One set of settings on one resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Resolution.
    pub rung: Rung,
    /// Settings; the Courant number is always given.
    pub settings: Settings,
}

/// The runs of one method, as numbers of choices.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Method.
    pub method: Method,
    /// Refinement at fixed Courant number and particles per cell, coarse to fine.
    pub path: Vec<usize>,
    /// Smaller Courant numbers at one cell size.
    pub courant: Vec<usize>,
    /// Other numbers of particles per cell at one cell size.
    pub particles: Vec<usize>,
}

/// All runs of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Runs, each once.
    pub choices: Vec<Choice>,
    /// Lines over them.
    pub lines: Vec<Line>,
}

impl Plan {
    /// The runs of a case, line by line.
    #[must_use]
    pub fn new(study: Study, effort: Effort) -> Self {
        let size = effort.size;
        let path = study.path(size);
        let middle = path.get(path.len() / 2);
        let mut plan = Self {
            choices: vec![],
            lines: vec![],
        };
        let tried = |method: &Method| study.tries(size, *method);
        let mut tries: Vec<Method> = methods(size).into_iter().filter(tried).collect();
        if effort.own {
            tries = study.own_method(size).into_iter().collect();
        }
        for method in tries {
            let base = Settings {
                allow_unstable: true,
                particles_per_cell: PARTICLES_PER_CELL,
                ..Settings::new(method)
            }
            .courant(SAFE_SHARE * method.stability_number(PARTICLES_PER_CELL));
            let mut add = |rung: &Rung, settings: Settings| {
                plan.choices.push(Choice {
                    rung: rung.clone(),
                    settings,
                });
                plan.choices.len() - 1
            };
            let mut line = Line {
                method,
                path: (study.path_of(size, method).iter())
                    .map(|rung| add(rung, base))
                    .collect(),
                courant: vec![],
                particles: vec![],
            };
            if let (Some(rung), Size::Full, false) = (middle, size, effort.own) {
                let courant = base.courant_or_automatic();
                for share in COURANT_SWEEP {
                    line.courant.push(add(rung, base.courant(share * courant)));
                }
                for particles_per_cell in PARTICLES_SWEEP {
                    let settings = Settings {
                        particles_per_cell,
                        ..base
                    };
                    line.particles.push(add(rung, settings));
                }
            }
            plan.lines.push(line);
        }
        plan
    }
}

/// Weighting functions in the order of their colours.
pub const WEIGHTINGS: [Weighting; 5] = [
    Weighting::UniformGimp,
    Weighting::Linear,
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
    Weighting::QuadraticBSpline,
    Weighting::ContiguousGimp(DomainUpdate::Determinant),
];
/// Stress schemes in the order of their marks.
pub const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Musl, StressScheme::Usf];
/// Transfers in the order of their strokes.
pub const TRANSFERS: [TransferKind; 4] = [
    TransferKind::Flip,
    TransferKind::Apic,
    TransferKind::Tpic,
    TransferKind::Mls,
];

/// All methods; for a short study those that a user is likely to choose between.
fn methods(size: Size) -> Vec<Method> {
    let mut methods = vec![];
    for weighting in WEIGHTINGS {
        for scheme in SCHEMES {
            for transfer in TRANSFERS {
                let method = Method {
                    weighting,
                    scheme,
                    transfer,
                };
                if method.goes_together() {
                    methods.push(method);
                }
            }
        }
    }
    if size == Size::Quick {
        methods.retain(|m| {
            m.scheme != StressScheme::Usf
                && !matches!(m.transfer, TransferKind::Tpic | TransferKind::Mls)
                && m.weighting != Weighting::ContiguousGimp(DomainUpdate::Determinant)
                && (m.transfer == TransferKind::Flip
                    || (m.scheme == StressScheme::Musl && m.weighting != Weighting::Linear))
        });
    }
    methods
}
