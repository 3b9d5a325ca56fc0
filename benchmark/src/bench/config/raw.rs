//! The keys of a benchmark configuration, as written: all optional, nothing checked but types.
//!
//! `global`, `interpolation` and `update` are those of `benchmark-configuration.json`, `executables` and `parameters`
//! those of `start-multi-benchmark-configuration.json` (technical manual, section 19); the program that the manual
//! describes, MPM-Geomechanics, names the keys inside them. The others are ours.

use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys of a benchmark"
)]
pub(super) struct RawConfig {
    pub global: Option<RawGlobal>,
    pub interpolation: Option<RawInterpolation>,
    pub update: Option<RawUpdate>,
    pub parameters: Option<RawParameters>,
    pub executables: Option<NamedEntries<RawExecutable>>,
    /// Built-in scenes by name, scene files by path.
    pub scenes: Option<OneOrMany<String>>,
    /// Wanted numbers of particles of built-in scenes.
    pub particles: Option<OneOrMany<usize>>,
    pub threads: Option<OneOrMany<usize>>,
    /// Numbers of ranks that share whole steps, as threads of this process.
    pub ranks: Option<OneOrMany<usize>>,
    pub shape_function: Option<OneOrMany<String>>,
    pub stress_scheme_update: Option<OneOrMany<String>>,
    pub transfer: Option<OneOrMany<String>>,
    /// Methods as three words each, in place of the three lists.
    pub methods: Option<OneOrMany<String>>,
    pub repetitions: Option<usize>,
    /// Steps, or plays of a stage, before the clock starts.
    pub warm_up: Option<usize>,
    /// Particles times steps of one sample, which decides its number of steps.
    pub particle_steps: Option<u64>,
    /// Single stages that are measured.
    pub stages: Option<OneOrMany<String>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with the keys of `global`")]
pub(super) struct RawGlobal {
    #[serde(rename = "numParticles")]
    pub num_particles: Option<usize>,
    #[serde(rename = "numThreads")]
    pub num_threads: Option<usize>,
    /// Edges of a particle's domain [m].
    #[serde(rename = "particleSize")]
    pub particle_size: Option<Vec<f64>>,
    /// Mass of a particle [kg].
    #[serde(rename = "particleMass")]
    pub particle_mass: Option<f64>,
    /// Edges of a cell [m].
    #[serde(rename = "cellDimension")]
    pub cell_dimension: Option<Vec<f64>>,
    #[serde(rename = "numCells")]
    pub num_cells: Option<Vec<usize>>,
    #[serde(rename = "randomSeed")]
    pub random_seed: Option<u64>,
    #[serde(rename = "interpolationTest")]
    pub interpolation_test: Option<bool>,
    #[serde(rename = "updateTest")]
    pub update_test: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the tests of `interpolation`"
)]
pub(super) struct RawInterpolation {
    #[serde(rename = "NodalMass_nParticles")]
    #[expect(
        dead_code,
        reason = "read so that it is known; there is nothing to set"
    )]
    pub nodal_mass: Option<RawComment>,
    #[serde(rename = "NodalMomentum_nParticles")]
    pub nodal_momentum: Option<RawNodalMomentum>,
    #[serde(rename = "NodalInternalForce_nParticles")]
    #[expect(
        dead_code,
        reason = "read so that it is known; there is nothing to set"
    )]
    pub nodal_internal_force: Option<RawComment>,
    #[serde(rename = "NodalExternalForce_nParticles")]
    pub nodal_external_force: Option<RawNodalExternalForce>,
    #[serde(rename = "ParticleStrainIncrement_nParticles")]
    pub strain_increment: Option<RawStrainIncrement>,
    #[serde(rename = "ParticleVorticityIncrement_nParticles")]
    pub vorticity_increment: Option<RawVorticityIncrement>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the tests of `update`"
)]
pub(super) struct RawUpdate {
    #[serde(rename = "ContributionNodes_nParticles")]
    #[expect(
        dead_code,
        reason = "read so that it is known; there is nothing to set"
    )]
    pub contribution_nodes: Option<RawComment>,
    #[serde(rename = "UpdatePerformance_ParticleDensity_nParticles")]
    pub density: Option<RawDensity>,
    #[serde(rename = "ParticleStress_nParticles")]
    pub stress: Option<RawStress>,
}

/// A test without parameters; a comment may stand there.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object without parameters")]
pub(super) struct RawComment {
    #[expect(dead_code, reason = "words for people")]
    pub comment: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `particleVelocity`")]
pub(super) struct RawNodalMomentum {
    /// Velocity of every particle [m/s].
    #[serde(rename = "particleVelocity")]
    pub particle_velocity: Option<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `appliedForce`")]
pub(super) struct RawNodalExternalForce {
    /// Force on every particle [N].
    #[serde(rename = "appliedForce")]
    pub applied_force: Option<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `dt01` and `nodalVelocity`"
)]
pub(super) struct RawStrainIncrement {
    /// Time step [s].
    pub dt01: Option<f64>,
    /// Velocity gradient along each axis [1/s].
    #[serde(rename = "nodalVelocity")]
    pub nodal_velocity: Option<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `dt02` and `omega`")]
pub(super) struct RawVorticityIncrement {
    /// Time step [s].
    pub dt02: Option<f64>,
    /// Angular velocity [1/s].
    pub omega: Option<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `initialDensity` and `traceStrain`"
)]
pub(super) struct RawDensity {
    /// Density [kg/m³].
    #[serde(rename = "initialDensity")]
    pub initial_density: Option<f64>,
    /// Trace of the strain increment.
    #[serde(rename = "traceStrain")]
    pub trace_strain: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `E`, `nu` and `epsilon0`"
)]
pub(super) struct RawStress {
    /// Young's modulus [Pa].
    #[serde(rename = "E")]
    pub young: Option<f64>,
    /// Poisson's ratio.
    #[serde(rename = "nu")]
    pub poisson: Option<f64>,
    /// Strain increment along x.
    #[serde(rename = "epsilon0")]
    pub strain: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `particles` and `threads`"
)]
pub(super) struct RawParameters {
    pub particles: Option<OneOrMany<usize>>,
    pub threads: Option<OneOrMany<usize>>,
}

/// An executable: a `proctor`, by its path, or any other solver.
#[derive(Debug)]
pub(super) enum RawExecutable {
    Path(String),
    Solver(RawSolver),
}

#[derive(Debug, Default, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with `command`, `folder`, `timeout`, `time_label`, `warm_up`, `method`, `dimension`, `thickness` and \
                 `scene`"
)]
pub(super) struct RawSolver {
    /// Program and arguments, with {scene}, {threads} and {out}.
    pub command: Option<OneOrMany<String>>,
    /// Folder in which it works. Default: that of its results.
    pub folder: Option<String>,
    /// Time by the clock after which it is ended [s]. Default: an hour.
    pub timeout: Option<f64>,
    /// Meaning of the times of its frames. Default: the time of the particles.
    pub time_label: Option<String>,
    /// True for a run of each scene before the timed ones. Default: false.
    pub warm_up: Option<bool>,
    /// Its method, in words for tables.
    pub method: Option<String>,
    /// 2 for a solver that gets problems in the plane as such, and no others. Default: 3.
    pub dimension: Option<usize>,
    /// Cells of the slab that a problem in the plane becomes for a solver of three dimensions. Default: 1.
    pub thickness: Option<usize>,
    /// Keys of the method that take the place of those of the scene.
    pub scene: Option<serde_json::Map<String, serde_json::Value>>,
}

/// One value or a list of them.
#[derive(Debug)]
pub(super) struct OneOrMany<T>(pub Vec<T>);

/// A type that stands alone or in a list.
pub(super) trait Item: Sized {
    const ONE_OR_MANY: &'static str;
    fn word(_: &str) -> Option<Self> {
        None
    }
    fn count(_: u64) -> Option<Self> {
        None
    }
}

impl Item for String {
    const ONE_OR_MANY: &'static str = "a text in quotes, or a list of them";
    fn word(word: &str) -> Option<Self> {
        Some(word.to_owned())
    }
}

impl Item for usize {
    const ONE_OR_MANY: &'static str = "a whole number, 0 or more, or a list of them";
    fn count(count: u64) -> Option<Self> {
        count.try_into().ok()
    }
}

struct OneOrManyVisitor<T>(PhantomData<T>);

impl<'de, T: Item + Deserialize<'de>> Visitor<'de> for OneOrManyVisitor<T> {
    type Value = OneOrMany<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(T::ONE_OR_MANY)
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
        let one = T::word(word)
            .ok_or_else(|| E::invalid_type(serde::de::Unexpected::Str(word), &self))?;
        Ok(OneOrMany(vec![one]))
    }

    fn visit_u64<E: Error>(self, count: u64) -> Result<Self::Value, E> {
        let one = T::count(count)
            .ok_or_else(|| E::invalid_type(serde::de::Unexpected::Unsigned(count), &self))?;
        Ok(OneOrMany(vec![one]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut many = vec![];
        while let Some(one) = list.next_element()? {
            many.push(one);
        }
        Ok(OneOrMany(many))
    }
}

impl<'de, T: Item + Deserialize<'de>> Deserialize<'de> for OneOrMany<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrManyVisitor(PhantomData))
    }
}

struct ExecutableVisitor;

impl<'de> Visitor<'de> for ExecutableVisitor {
    type Value = RawExecutable;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the path of a proctor in quotes, or an object with `command`, `folder`, `timeout`, \
             `time_label`, `warm_up`, `method`, `dimension`, `thickness` and `scene`",
        )
    }

    fn visit_str<E: Error>(self, path: &str) -> Result<RawExecutable, E> {
        Ok(RawExecutable::Path(path.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RawExecutable, A::Error> {
        let solver = serde::de::value::MapAccessDeserializer::new(map);
        RawSolver::deserialize(solver).map(RawExecutable::Solver)
    }
}

impl<'de> Deserialize<'de> for RawExecutable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ExecutableVisitor)
    }
}

/// Named entries in the order of the file.
#[derive(Debug)]
pub(super) struct NamedEntries<T>(pub Vec<(String, T)>);

struct NamedVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for NamedVisitor<T> {
    type Value = NamedEntries<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of named executables")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut entries: Vec<(String, T)> = vec![];
        while let Some(name) = map.next_key::<String>()? {
            if entries.iter().any(|(known, _)| *known == name) {
                return Err(A::Error::custom(format!("duplicate field `{name}`")));
            }
            entries.push((name, map.next_value()?));
        }
        Ok(NamedEntries(entries))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for NamedEntries<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(NamedVisitor(PhantomData))
    }
}
