//! The ball with any settings.

use proctor_scene::simulation::Simulation;
use proctor_scene::{Dimension, Mesh, PlaneCondition, Scene, TransferKind, Vector};

use super::{AVERAGED, FINE, FORCE, HertzSphere, L2, PEAK, WIDTH, peak, rungs};
use crate::case::{Curve, CurvePoint, Found, Quantity, Rung, Size};
use crate::cases::pressures::Pressures;
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Study, few};

impl Study for HertzSphere {
    fn path(&self, size: Size) -> Vec<Rung> {
        rungs(match size {
            Size::Quick => &[1.2, 0.6],
            Size::Full => &[1.5, 0.75, 0.375],
        })
    }

    fn measures(&self) -> Vec<Measure> {
        vec![Measure::new("pressure", L2), Measure::new("peak", PEAK)]
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
        // The surfaces are sound at every cell size; one that is not is reported by `try_scene_with`.
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

    fn try_scene_with(&self, rung: &Rung, settings: &Settings) -> Result<Scene, Failure> {
        Ok(Self::build(rung, settings)?)
    }

    fn guest(&self, _rung: &Rung) -> Result<Guest, &'static str> {
        Err("what is known exactly is the pressure of a contact, and frames of particles hold none")
    }

    fn run(
        &self,
        rung: &Rung,
        _settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure> {
        let from_axis = |x: &Vector| libm::hypot(x[0], x[1]);
        let found = Pressures::averaged(simulation, AVERAGED[0], FINE, from_axis, observer)?;
        let exact = self.exact();
        let distance = found.distance(|r| exact.pressure(r));
        // Of the Hertz pressure with the same second moment, sqrt(5/2 m_2/m_0).
        let radius = (2.5 * found.moment(2) / found.moment(0)).sqrt();
        let quantities = vec![
            Quantity::compared(FORCE, 4.0 * found.force[2], exact.load, "N"),
            Quantity::compared(PEAK, peak(&found, &exact), exact.peak(), "Pa"),
            Quantity::compared(WIDTH, radius, exact.contact_radius(), "m"),
            Quantity::of_zero(L2, distance),
        ];
        let mut points: Vec<CurvePoint> = found
            .vertices
            .iter()
            .filter(|p| p[0] < FINE)
            .map(|p| CurvePoint {
                at: p[0],
                computed: p[1],
                exact: exact.pressure(p[0]),
            })
            .collect();
        points.sort_by(|a, b| a.at.total_cmp(&b.at));
        let curve = Curve {
            title: format!("{}: contact pressure", rung.label),
            abscissa: "r in m",
            ordinate: "p in Pa",
            points,
        };
        Ok(Found::new(quantities, Some(curve)))
    }
}
