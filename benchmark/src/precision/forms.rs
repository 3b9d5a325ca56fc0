//! A problem in the shapes in which solvers get it: as a slab, or in the plane.

use super::Peer;
use crate::bench::children::GuestScene;
use crate::bench::config::Space;
use proctor_verification::case::Rung;
use proctor_verification::guest::Guest;
use proctor_verification::study::Study;
use std::path::{Path, PathBuf};

/// The problem of a run in each shape that a solver asks for.
pub(super) struct ProblemForms(Vec<(Space, Option<ProblemForm>)>);

/// The problem in one shape.
pub(super) struct ProblemForm {
    pub guest: Guest,
    pub handed: GuestScene,
    /// Particles over those of the shape that the case has.
    more: f64,
    /// Folder of its scenes; none for the shape that the case has.
    folder: Option<String>,
}

impl ProblemForms {
    /// Of the problem of a run, for some solvers.
    ///
    /// # Errors
    /// If a scene file cannot hold a part of its scene.
    pub(super) fn new(
        study: Study,
        rung: &Rung,
        guest: Guest,
        peers: &[Peer],
    ) -> Result<Self, String> {
        let mut spaces: Vec<Space> = vec![];
        for peer in peers {
            let space = peer.executable.space;
            if space != Space::Slab(1) && !spaces.contains(&space) {
                spaces.push(space);
            }
        }
        let mut all = vec![];
        for space in spaces {
            let made = study.guest(rung)?;
            let (form, folder) = match space {
                Space::Plane => (made.in_plane(), "plane".to_owned()),
                Space::Slab(cells) => (Some(made.thick(cells)), format!("slab-{cells}")),
            };
            let form = form.map(|form| ProblemForm::new(form, &guest, Some(folder)));
            all.push((space, form.transpose()?));
        }
        let handed = GuestScene::new(&guest)?;
        let as_it_is = ProblemForm {
            guest,
            handed,
            more: 1.0,
            folder: None,
        };
        all.push((Space::Slab(1), Some(as_it_is)));
        Ok(Self(all))
    }

    /// The problem in a shape; none where it has none.
    pub(super) fn of(&self, space: Space) -> Option<&ProblemForm> {
        let found = self.0.iter().find(|(known, _)| *known == space);
        found.and_then(|(_, form)| form.as_ref())
    }
}

impl ProblemForm {
    fn new(guest: Guest, slab: &Guest, folder: Option<String>) -> Result<Self, String> {
        Ok(Self {
            handed: GuestScene::new(&guest)?,
            more: guest.particles_over(slab),
            guest,
            folder,
        })
    }

    /// Number of particles that a solver has in this shape where it has `slab` in that of the case.
    pub(super) fn particles(&self, slab: usize) -> usize {
        (slab as f64 * self.more).round() as usize
    }

    /// Folder of its scenes below that of the run: solvers of one shape share the file of the scene.
    pub(super) fn folder(&self, run: &Path) -> PathBuf {
        self.folder
            .as_ref()
            .map_or_else(|| run.to_owned(), |own| run.join(own))
    }
}
