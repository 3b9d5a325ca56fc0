//! `summary.json`: what a run was, how it ended and what it cost.
//!
//! The file has no `null` and no not-a-number: what has no finite value is left out. This holds whatever is put
//! into [`Summary`].

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{OutputError, atomic};

/// Kind of the event that a particle was crushed or blown up.
pub const VOLUME_RATIO: &str = "volume_ratio";

/// Kind of the event that bodies in contact overlap.
pub const OVERLAP: &str = "overlap";

/// Name of the summary in the output folder.
pub const SUMMARY: &str = "summary.json";

/// The content of `summary.json`, in SI units. The names of the fields are the keys of the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// The plan: what was kept and what was left out. A `null`, it or inside it, is not written.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub plan: Value,
    /// The mesh, where it lies at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<SummaryMesh>,
    /// Number of particles at the end.
    pub particles: u64,
    /// Number of nodes with mass at the end.
    pub nodes_active: u64,
    /// Number of steps done, those before a restart included.
    pub steps: u64,
    /// Time reached \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub time: Option<f64>,
    /// Smallest time step taken \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub dt_min: Option<f64>,
    /// Largest time step taken \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub dt_max: Option<f64>,
    /// Smallest critical time step met \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub dt_critical: Option<f64>,
    /// Run time by the clock \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub wall_seconds: Option<f64>,
    /// Run time summed over the threads \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub cpu_seconds: Option<f64>,
    /// CPU time per particle and step \[ns\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub ns_per_particle_step: Option<f64>,
    /// Number of threads, of each rank where there are several.
    pub threads: usize,
    /// Number of ranks; left out where there is one process.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ranks: Option<usize>,
    /// Time that the first of them spent in messages while it stepped, until the others answered \[s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub message_seconds: Option<f64>,
    /// Lanes of the inner loops: `avx512`, `avx2` or `scalar`.
    pub lanes: String,
    /// Mass of all particles at the end \[kg\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub mass: Option<f64>,
    /// Momentum of all particles at the end, one value per axis \[kg m/s\]; left out if one is not finite.
    #[serde(default, skip_serializing_if = "no_vector")]
    pub momentum: Vec<f64>,
    /// Energy at the end.
    #[serde(default)]
    pub energy: SummaryEnergy,
    /// Bodies of laws with a yield surface.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub yielding: Vec<YieldingBody>,
    /// The vertex of mortar contact that is farthest off its body at the end; left out where no body that moves freely has a
    /// boundary.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub boundary_drift: Option<SummaryDrift>,
    /// Since when the run is not to be trusted, and why; nothing where all balances hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_to_be_trusted: Option<String>,
    /// Reasons for caution with the results: energy that no channel explains, strains that a law does not bear.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Warning>,
    /// Events of the run, in the order of time.
    #[serde(default)]
    pub events: Vec<SummaryEvent>,
    /// Hash of the final particle state in particle-id order, 16 hexadecimal digits in the file.
    #[serde(with = "hexadecimal")]
    pub state_hash: u64,
    /// Ending of the run.
    pub status: Status,
    /// Reason of the ending, unless it finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// The background mesh, one value per axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SummaryMesh {
    /// Lower corner \[m\].
    pub origin: Vec<f64>,
    /// Sides of a cell \[m\].
    pub cell: Vec<f64>,
    /// Number of cells.
    pub cells: Vec<u64>,
    /// True where the axes are radius and height; left out where they are not.
    #[serde(default, skip_serializing_if = "is_false")]
    pub axisymmetric: bool,
}

/// For keys that are left out where they are false.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_false(value: &bool) -> bool {
    !*value
}

/// Energy at the end of the run \[J\], all of it at the time of the positions. What was there at the start and was brought in
/// is what is there now and what is missing: start + external work = kinetic + strain + contact + dissipated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SummaryEnergy {
    /// Energy of motion.
    #[serde(default, skip_serializing_if = "no_number")]
    pub kinetic: Option<f64>,
    /// Stored in strain.
    #[serde(default, skip_serializing_if = "no_number")]
    pub strain: Option<f64>,
    /// Stored in mortar contact.
    #[serde(default, skip_serializing_if = "no_number")]
    pub contact: Option<f64>,
    /// Brought in by gravity, loads, moving boundaries and whoever moves bodies as prescribed.
    #[serde(default, skip_serializing_if = "no_number")]
    pub external_work: Option<f64>,
    /// Missing energy: the sum of damping, friction, impact, plastic, removed, absorbed and remainder.
    #[serde(default, skip_serializing_if = "no_number")]
    pub dissipated: Option<f64>,
    /// Taken out by damping.
    #[serde(default, skip_serializing_if = "no_number")]
    pub damping: Option<f64>,
    /// Taken out by friction of contact on the grid and of rigid surfaces.
    #[serde(default, skip_serializing_if = "no_number")]
    pub friction: Option<f64>,
    /// Taken out where bodies meet in the same contacts, along the normal.
    #[serde(default, skip_serializing_if = "no_number")]
    pub impact: Option<f64>,
    /// Dissipated by laws, such as plastic work.
    #[serde(default, skip_serializing_if = "no_number")]
    pub plastic: Option<f64>,
    /// Energy of particles that left the mesh and were removed.
    #[serde(default, skip_serializing_if = "no_number")]
    pub removed: Option<f64>,
    /// Left through absorbing planes; left out where no plane absorbs.
    #[serde(default, skip_serializing_if = "no_number")]
    pub absorbed: Option<f64>,
    /// Energy that none of these accounts for: the transfer between particles and nodes, friction of mortar contact, errors of
    /// the method. Negative where energy came from nowhere.
    #[serde(default, skip_serializing_if = "no_number")]
    pub remainder: Option<f64>,
    /// Rest that returns to yield surfaces leave of the work of the strain, which the remainder has; left out where no body yields.
    #[serde(default, skip_serializing_if = "no_number")]
    pub algorithmic: Option<f64>,
}

/// Work of the strain of a body that yields, by its destination \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct YieldingBody {
    /// Identifier of the body.
    pub body: i64,
    /// Energy that its stress stores.
    #[serde(default, skip_serializing_if = "no_number")]
    pub stored: Option<f64>,
    /// Plastic work.
    #[serde(default, skip_serializing_if = "no_number")]
    pub plastic: Option<f64>,
    /// Share of neither, which the finite step leaves.
    #[serde(default, skip_serializing_if = "no_number")]
    pub algorithmic: Option<f64>,
}

/// Distance of a vertex of mortar contact from its place in the body, as the particles that were around it at the start give
/// it; it is zero in rigid motions and uniform strains of vertices that go with their body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SummaryDrift {
    /// Identifier of the body.
    pub body: i64,
    /// Number of the vertex in its boundary, from 0.
    pub vertex: u64,
    /// The distance \[m\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub distance: Option<f64>,
    /// The same over the smallest size of a cell.
    #[serde(default, skip_serializing_if = "no_number")]
    pub in_cells: Option<f64>,
}

/// A reason for caution with the results of a run that ended well.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// Kind, a fixed word: `energy`, `strain`, `stretch`, `traction`.
    pub kind: String,
    /// Amount, the probable cause, and what to use, for people.
    pub message: String,
}

/// Something that the reader of the results has to know, such as a particle that left the mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SummaryEvent {
    /// Kind of the event, a fixed word such as `particle_left`.
    pub kind: String,
    /// Text of the event, for people.
    pub message: String,
    /// Time \[s\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub time: Option<f64>,
    /// Number of the step.
    pub step: u64,
    /// Id of the particle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub particle: Option<u64>,
    /// Where, one value per axis \[m\]; left out if empty or not finite.
    #[serde(default, skip_serializing_if = "no_vector")]
    pub position: Vec<f64>,
    /// Mass of the particle \[kg\].
    #[serde(default, skip_serializing_if = "no_number")]
    pub mass: Option<f64>,
}

/// Ending of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It reached its end time.
    Finished,
    /// A step or the output failed.
    Failed,
    /// It was stopped from outside. The default: a summary that nobody completed is of a run that nobody ended.
    #[default]
    Interrupted,
}

/// `value`, or nothing if it is not finite. Writing leaves out what is not finite in any case; this is for those
/// who want the same value in memory as a reader gets.
#[must_use]
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

impl Summary {
    /// Writes the summary to `path`, indented, atomically.
    ///
    /// # Errors
    /// [`OutputError::Write`].
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        // Serialising may fail only by what `plan` or a later field holds; report it as a failed write.
        let clean = Self {
            plan: without_null(self.plan.clone()),
            ..self.clone()
        };
        let text = serde_json::to_string_pretty(&clean)
            .map_err(|error| OutputError::write(path, error.into()))?;
        atomic::write(path, |file| writeln!(file, "{text}"))
    }

    /// Reads a summary.
    ///
    /// # Errors
    /// [`OutputError::Read`], [`OutputError::Malformed`] if it is not a summary.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text =
            crate::reading::read_to_string(path).map_err(|error| OutputError::read(path, error))?;
        serde_json::from_str(&text)
            .map_err(|error| OutputError::malformed(path, error.line(), error.to_string()))
    }
}

/// `value` without any `null`: members of objects and entries of lists that are `null` are taken out.
fn without_null(value: Value) -> Value {
    match value {
        Value::Object(members) => members
            .into_iter()
            .filter(|(_, v)| !v.is_null())
            .map(|(k, v)| (k, without_null(v)))
            .collect(),
        Value::Array(entries) => entries
            .into_iter()
            .filter(|v| !v.is_null())
            .map(without_null)
            .collect(),
        other => other,
    }
}

// Serde hands the field by reference, whatever its type.
#[allow(clippy::trivially_copy_pass_by_ref, clippy::ref_option)]
fn no_number(value: &Option<f64>) -> bool {
    !value.is_some_and(f64::is_finite)
}

fn no_vector(values: &[f64]) -> bool {
    values.is_empty() || values.iter().any(|value| !value.is_finite())
}

/// A `u64` as 16 hexadecimal digits: JSON numbers lose bits above 2^53 in many readers.
mod hexadecimal {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    #[allow(clippy::trivially_copy_pass_by_ref)]
    pub(super) fn serialize<S: Serializer>(value: &u64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{value:016x}"))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<u64, D::Error> {
        let text = String::deserialize(deserializer)?;
        if text.len() != 16 || !text.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(D::Error::custom(format!(
                "'{text}' is not 16 hexadecimal digits"
            )));
        }
        u64::from_str_radix(&text, 16).map_err(D::Error::custom)
    }
}
