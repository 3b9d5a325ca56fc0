//! Boundaries and pairs from a scene.

use super::MortarState;
use super::boundaries::Boundaries;
use super::memory;
use super::pair::pair;
use super::patch::in_scene;
use super::surface::BoundaryCarrier;
use crate::geometry::mortar::boundary::{Boundary, Chain};
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::outline::{outline, vertices};
use crate::geometry::mortar::space::facets::Facets;
use crate::geometry::mortar::space::skin::{skin, triangles};
use crate::kinds::InteractionResult;
use crate::values::{BodyBoundary, ContactValues, Mortar, MortarContact, Vertices};
use proctor_geometry::memory::Memory;
use proctor_geometry::team::Team;
use proctor_kernel::model::{CycleSettings, Dimension, Vector};
use proctor_kernel::simulation::{BodyRun, SetupError};
use std::fmt::Display;

/// Share of Young's modulus that a barrier may press with at the start.
const MOST_PRESSURE: f64 = 0.1;

impl MortarState {
    /// Boundaries and pairs of a scene, where anything has a boundary. Vertices follow their body also where nothing is in
    /// contact with it.
    pub(crate) fn of(
        values: &ContactValues,
        settings: &CycleSettings,
        bodies: &[BodyRun],
        memory: &mut Memory,
    ) -> Option<InteractionResult> {
        match Self::new(&values.mortar, settings, bodies, memory) {
            Ok(state) if state.plane.surfaces.is_empty() && state.space.surfaces.is_empty() => None,
            state => Some(state.map(|state| Box::new(state) as _)),
        }
    }

    fn new(
        given: &Mortar,
        settings: &CycleSettings,
        bodies: &[BodyRun],
        memory: &mut Memory,
    ) -> Result<Self, SetupError> {
        let mut state = Self {
            given: given.clone(),
            ..Self::default()
        };
        for given in &given.boundaries {
            let Some(index) = bodies.iter().position(|run| run.id == given.body) else {
                continue;
            };
            let body = &bodies[index];
            let carrier = BoundaryCarrier::of(body, index, given.follow);
            let path = format!("bodies[{index}].boundary_segment");
            if let Vertices::Spacing(length) = given.vertices {
                match settings.dimension {
                    Dimension::Two => {
                        memory::vertices(vertices(&body.shape, length), &path, memory)?;
                    }
                    Dimension::Three => {
                        memory::triangles(triangles(&body.shape, length), &path, memory)?;
                    }
                }
            }
            state.add_body(settings, given, body, carrier)?;
        }
        let origin = &settings.mesh.origin;
        for line in &given.lines {
            let carrier = BoundaryCarrier::Prescribed(line.motion.clone());
            let boundary = Boundary::new(&line.chains).map_err(|e| refused(&line.name, &e))?;
            state.plane.add(line.id, boundary, carrier, origin);
        }
        for rigid in &given.facets {
            let carrier = BoundaryCarrier::Prescribed(rigid.motion.clone());
            let boundary = Facets::new(&rigid.surface).map_err(|e| refused(&rigid.name, &e))?;
            state.space.add(rigid.id, boundary, carrier, origin);
        }
        let MortarState {
            given,
            plane,
            space,
            ..
        } = &mut state;
        plane.join(given, settings, bodies)?;
        space.join(given, settings, bodies)?;
        Ok(state)
    }

    fn add_body(
        &mut self,
        settings: &CycleSettings,
        given: &BodyBoundary,
        body: &BodyRun,
        carrier: BoundaryCarrier,
    ) -> Result<(), SetupError> {
        let path = format!("boundary of body {}", given.body);
        let origin = &settings.mesh.origin;
        let polyline = |chains: &[Chain]| Boundary::new(chains).map_err(|e| refused(&path, &e));
        match (&given.vertices, settings.dimension) {
            (Vertices::Given(chains), _) => {
                self.plane
                    .add(given.body, polyline(chains)?, carrier, origin);
            }
            // Vertices are found where particles are, relative to the origin, so that they are no worse far from zero.
            (Vertices::Spacing(length), Dimension::Two) => {
                let shape = body.shape.relative_to(origin);
                let chains = outline(&shape, *length).map_err(|e| refused(&path, &e))?;
                self.plane
                    .add(given.body, polyline(&chains)?, carrier, &[0.0; 3]);
            }
            (Vertices::Spacing(length), Dimension::Three) => {
                let shape = body.shape.relative_to(origin);
                let corners = skin(&shape, *length).map_err(|e| refused(&path, &e))?;
                let facets = Facets::from_corners(&corners).map_err(|e| refused(&path, &e))?;
                let facets = facets
                    .without_planes(&walls(settings, &[0.0; 3]))
                    .map_err(|e| refused(&path, &e))?;
                self.space.add(given.body, facets, carrier, &[0.0; 3]);
            }
            (Vertices::Surface(surface), _) => {
                let facets = Facets::new(surface).map_err(|e| refused(&path, &e))?;
                let facets = facets
                    .without_planes(&walls(settings, origin))
                    .map_err(|e| refused(&path, &e))?;
                self.space.add(given.body, facets, carrier, origin);
            }
        }
        Ok(())
    }
}

fn refused(path: &str, reason: &impl Display) -> SetupError {
    SetupError::Interaction {
        path: path.to_owned(),
        reason: reason.to_string(),
    }
}

/// Planes of a mesh that begins at `origin` and holds what lies in them: axis and coordinate \[m\].
fn walls(settings: &CycleSettings, origin: &Vector) -> Vec<(usize, f64)> {
    let mesh = &settings.mesh;
    let mut walls = vec![];
    for axis in 0..settings.dimension.axes() {
        let low = origin[axis];
        let ends = [low, low + mesh.cells[axis] as f64 * mesh.cell[axis]];
        for side in 0..2 {
            if settings.plane_acts(axis, side) {
                walls.push((axis, ends[side]));
            }
        }
    }
    walls
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Pairs of the scene between the boundaries that are there.
    fn join(
        &mut self,
        given: &Mortar,
        settings: &CycleSettings,
        bodies: &[BodyRun],
    ) -> Result<(), SetupError> {
        let contacts = given.contacts.iter();
        self.pairs = contacts
            .filter_map(|contact| pair(contact, &self.surfaces))
            .collect();
        self.pairs.sort_by_key(|pair| pair.id);
        (0..self.pairs.len())
            .try_for_each(|p| self.refuse_overlap(p, given, &settings.mesh.origin, bodies))
    }

    /// Refuses a pair whose surfaces overlap, or whose edges meet, at the start.
    fn refuse_overlap(
        &mut self,
        p: usize,
        given: &Mortar,
        origin: &Vector,
        bodies: &[BodyRun],
    ) -> Result<(), SetupError> {
        self.meet(p, None, &Team::ALONE);
        let pair = &self.pairs[p];
        let contact = given.contacts.iter().find(|c| c.id == pair.id);
        let name = contact.map_or("", |c| &c.name);
        let slave = &self.surfaces[pair.slave];
        if let Some((vertex, gap)) = pair.forces.smallest_gap()
            && gap < 0.0
        {
            let at = in_scene(&slave.boundary.points()[vertex], origin);
            return Err(refused(
                name,
                &format!(
                    "the gap is {gap} m at vertex {vertex} of {}, {} m; accepted: surfaces that are apart",
                    slave.id,
                    place(&at[..D]),
                ),
            ));
        }
        if let Some(contact) = contact {
            self.refuse_pressure(p, origin, bodies, contact)?;
        }
        if let Some(found) = slave.boundary.lies_in(&self.surfaces[pair.master].boundary) {
            return Err(refused(
                name,
                &format!("{found}; accepted: surfaces that are apart"),
            ));
        }
        if let Some((at, distance)) = self.edges_that_meet(p) {
            let at = in_scene(&at, origin);
            return Err(refused(
                name,
                &format!(
                    "a sharp edge of {} crosses one of {} at {} m, {distance} m apart; accepted: faces that meet faces, \
                     since mortar contact does not see edges",
                    slave.id,
                    self.surfaces[pair.master].id,
                    place(&at[..D]),
                ),
            ));
        }
        Ok(())
    }
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Refuses a pair that begins so far within the critical gap that the barrier squeezes the material before anything has
    /// moved: its vertices would be driven away from it.
    fn refuse_pressure(
        &self,
        p: usize,
        origin: &Vector,
        bodies: &[BodyRun],
        contact: &MortarContact,
    ) -> Result<(), SetupError> {
        let pair = &self.pairs[p];
        let slave = &self.surfaces[pair.slave];
        let Some(young) = softest(contact, bodies) else {
            return Ok(());
        };
        let most = MOST_PRESSURE * young;
        let sites = pair.forces.sites.iter().flatten();
        let Some(site) = sites.max_by(|a, b| a.pressure.total_cmp(&b.pressure)) else {
            return Ok(());
        };
        if site.pressure <= most {
            return Ok(());
        }
        let at = in_scene(&slave.boundary.points()[site.vertex], origin);
        Err(refused(
            &contact.name,
            &format!(
                "the gap of {} m at vertex {} of {}, {} m, begins with a pressure of {} Pa, more than a tenth of Young's \
                 modulus, {young} Pa, and drives the vertices off their body; accepted: a gap of at least {} m",
                site.gap,
                site.vertex,
                slave.id,
                place(&at[..D]),
                site.pressure,
                pair.law.normal.gap_at(most),
            ),
        ))
    }
}

/// Young's modulus of the softest body of a contact that is free to move \[Pa\].
fn softest(contact: &MortarContact, bodies: &[BodyRun]) -> Option<f64> {
    let ends = [contact.master, contact.slave];
    let free = bodies
        .iter()
        .filter(|body| ends.contains(&body.id) && body.motion.is_none());
    free.map(|body| body.law.young()).min_by(f64::total_cmp)
}

/// Coordinates in brackets.
fn place(x: &[f64]) -> String {
    let x: Vec<String> = x.iter().map(f64::to_string).collect();
    format!("({})", x.join(", "))
}
