//! The ball with any settings.

use proctor_kernel::scene::{Dimension, Mesh, PlaneCondition, Scene, TransferKind};
use proctor_kernel::simulation::{Options, Simulation};

use super::{FINE, FORCE, HertzSphere, L2, PEAK, WIDTH, run, rungs};
use crate::case::{CaseError, Curve, CurvePoint, Quantity, Rung, Size, Solved};
use crate::cases::failed;
use crate::settings::{Method, Settings};
use crate::study::{Measure, Observer, Phase, Studied, Study, few};

impl Study for HertzSphere {
    fn path(&self, size: Size) -> Vec<Rung> {
        rungs(match size {
            Size::Quick => &[1.2, 0.6],
            Size::Full => &[1.5, 0.75, 0.375],
        })
    }

    fn measures(&self) -> &'static [Measure] {
        &[
            Measure {
                word: "pressure",
                quantity: L2,
            },
            Measure {
                word: "peak",
                quantity: PEAK,
            },
        ]
    }

    fn tries(&self, size: Size, method: Method) -> bool {
        few(size, method)
    }

    fn refined_axes(&self) -> usize {
        3
    }

    fn own_settings(&self, _rung: &Rung) -> Settings {
        Settings::new(Method {
            transfer: TransferKind::Apic,
            ..Method::DEFAULT
        })
    }

    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene {
        // The surfaces are sound at every cell size; one that is not is reported by `solve_with`.
        Self::build(rung, settings).unwrap_or_else(|_| {
            let mesh = Mesh {
                origin: [0.0; 3],
                cell: [1.0; 3],
                cells: [1; 3],
                planes: [[PlaneCondition::Free; 2]; 3],
            };
            Scene::new(Dimension::Three, mesh, 0.0)
        })
    }

    fn solve_with(
        &self,
        rung: &Rung,
        settings: &Settings,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Studied, CaseError> {
        observer.phase(Phase::SetUp);
        let scene = Self::build(rung, settings).map_err(|e| failed(self, rung, &e))?;
        scene.check().map_err(|e| failed(self, rung, &e))?;
        let mut simulation =
            Simulation::new(&scene, options).map_err(|e| failed(self, rung, &e))?;
        let found = run(&mut simulation, observer).map_err(|e| failed(self, rung, &e))?;
        let exact = self.exact();
        let of = |name, value: f64, exact: f64, unit| Quantity {
            name,
            value,
            exact: Some(exact),
            error: Some((value / exact - 1.0).abs()),
            unit,
        };
        let distance = found.distance(|r| exact.pressure(r));
        let quantities = vec![
            of(FORCE, found.force, exact.load, "N"),
            of(PEAK, found.peak(&exact), exact.peak(), "Pa"),
            of(WIDTH, found.radius(), exact.contact_radius(), "m"),
            Quantity {
                name: L2,
                value: distance,
                exact: Some(0.0),
                error: Some(distance),
                unit: "1",
            },
        ];
        let mut points: Vec<CurvePoint> = found
            .pressures
            .iter()
            .filter(|p| p[0] < FINE)
            .map(|p| CurvePoint {
                at: p[0],
                computed: p[1],
                exact: exact.pressure(p[0]),
            })
            .collect();
        points.sort_by(|a, b| a.at.total_cmp(&b.at));
        let solved = Solved {
            particles: simulation.particles(),
            steps: simulation.steps(),
            time: simulation.time(),
            quantities,
            drawings: vec![],
            curve: Some(Curve {
                title: format!("{}: contact pressure", rung.label),
                abscissa: "r in m",
                ordinate: "p in Pa",
                points,
            }),
        };
        Ok(Studied::new(solved, &simulation))
    }
}
