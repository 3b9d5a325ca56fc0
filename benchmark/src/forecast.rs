//! The time of a run as the sum of its parts, before the run.

use proctor_files::run::STEPS_PER_LOOK;

/// Time of the parts of a run \[s\], each as it was found on this machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunCost {
    /// The bodies filled with particles.
    pub set_up: f64,
    /// A step.
    pub step: f64,
    /// A row of the history: the balance of energy maps the particles once more, and goes over them.
    pub row: f64,
    /// A frame and a checkpoint, in memory.
    pub output: f64,
}

/// Numbers of the parts of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunCounts {
    /// Steps.
    pub steps: u64,
    /// Rows of the history.
    pub rows: u64,
    /// Frames, each with a checkpoint.
    pub outputs: u64,
    /// Files that are written at the outputs: a frame, the list of the frames and a checkpoint each.
    pub files: u64,
    /// Bytes that are written.
    pub bytes: u64,
    /// True where forces in balance end the run.
    pub has_end: bool,
}

/// Time in which a byte gets into a file \[s\]: a copy and a checksum.
const PER_BYTE: f64 = 1e-9;
/// Time in which a file is made, made safe on the disk and given its name \[s\]: 1 to 2 ms of the processor here.
const PER_FILE: f64 = 1.5e-3;

impl RunCost {
    /// Time of a run with so many parts \[s\].
    #[must_use]
    pub fn of(&self, counts: &RunCounts) -> f64 {
        let looks = if counts.has_end {
            counts.steps / STEPS_PER_LOOK
        } else {
            0
        };
        self.set_up
            + self.step * (counts.steps + looks) as f64
            + self.row * counts.rows as f64
            + self.output * counts.outputs as f64
            + PER_FILE * counts.files as f64
            + PER_BYTE * counts.bytes as f64
    }
}
