//! The samples of a configuration, taken in turn, with every row in a record.

use super::children::{self, Child, OWN};
use super::config::Config;
use super::machine::Peaks;
use super::plan::{Slot, slots};
use super::rows;
use super::sample::Settings;
use crate::progress::Progress;
use crate::record::{Record, Row};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_scene::SceneError;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Reason for which an executable runs nothing.
const NOT_RUN: &str = "not run, as its calibration failed";

/// All that a configuration asks for, and what came of it.
pub struct Session {
    /// Combinations that are sampled in this process.
    pub slots: Vec<Slot>,
    /// Runs of executables.
    pub children: Vec<Child>,
    /// Measured peaks, one per number of threads.
    pub peaks: Vec<Peaks>,
    settings: Settings,
    repetitions: usize,
}

impl Session {
    /// Prepares the samples; nothing is run.
    ///
    /// # Errors
    /// If a scene does not go with a method.
    pub fn new(config: &Config, lanes: LaneChoice) -> Result<Self, SceneError> {
        // With executables each run is a process of its own, this program's as well.
        let alone = config.executables.is_empty();
        let slots = if alone || !config.stages.is_empty() {
            let mut slots = slots(config)?;
            slots.retain(|slot| alone || slot.stage.is_some());
            slots
        } else {
            vec![]
        };
        Ok(Self {
            slots,
            children: children::runs(config)?,
            peaks: vec![],
            settings: Settings {
                warm_up: config.warm_up,
                particle_steps: config.particle_steps,
                lanes,
            },
            repetitions: config.repetitions,
        })
    }

    /// Calibrates the executables, then takes all samples, one repetition of everything after the other, until `stop` is
    /// raised. Each sample is a row of
    /// the record, a failed one too. `folder` is for the scenes and results of executables.
    pub fn run(&mut self, record: &mut Record, folder: &Path, stop: &AtomicBool) {
        let trusted = self.calibrate(record, folder, stop);
        self.measure_peaks(record, stop);
        let rounds = self.repetitions * (self.slots.len() + self.children.len());
        let mut progress = Progress::new("bench");
        let mut done = 0;
        // What failed once would fail again.
        let mut failed = vec![false; self.slots.len() + self.children.len()];
        for (i, child) in self.children.iter().enumerate() {
            if !trusted(child) {
                failed[self.slots.len() + i] = true;
                record.push(child.not_run(0, NOT_RUN));
            }
        }
        for repetition in 0..self.repetitions as u64 {
            for (i, slot) in self.slots.iter().enumerate() {
                if stop.load(Ordering::Relaxed) {
                    return;
                }
                if !failed[i] {
                    match slot.work.sample(&self.settings, stop) {
                        Ok(Some(sample)) => {
                            let peaks = self
                                .peaks
                                .iter()
                                .find(|p| p.threads == slot.work.processors());
                            record.push(rows::row(slot, repetition, &sample, peaks));
                        }
                        Ok(None) => return,
                        Err(reason) => {
                            failed[i] = true;
                            record.push(failure(rows::blank(slot, repetition), &reason));
                        }
                    }
                }
                done += 1;
                progress.at(f64::from(done) / rounds as f64);
            }
            for (i, child) in self.children.iter().enumerate() {
                if stop.load(Ordering::Relaxed) {
                    return;
                }
                let failed = &mut failed[self.slots.len() + i];
                if !*failed {
                    let row = child.run(repetition, folder, stop);
                    if stop.load(Ordering::Relaxed) {
                        return;
                    }
                    *failed = row.error.is_some();
                    record.push(row);
                }
                done += 1;
                progress.at(f64::from(done) / rounds as f64);
            }
        }
    }

    /// Calibrates each executable by a free fall before anything else, in the dimensions of its scenes. Says of a run whether
    /// its executable passed.
    fn calibrate(
        &self,
        record: &mut Record,
        folder: &Path,
        stop: &AtomicBool,
    ) -> impl Fn(&Child) -> bool + use<> {
        let mut passed: BTreeMap<(String, usize), bool> = BTreeMap::new();
        for child in &self.children {
            let key = (child.executable.name.clone(), child.job.axes);
            if stop.load(Ordering::Relaxed) || key.0 == OWN || passed.contains_key(&key) {
                continue;
            }
            let (row, calibration) =
                children::calibrate(&child.executable, key.1, child.threads, folder, stop);
            if stop.load(Ordering::Relaxed) {
                break;
            }
            record.push(row);
            passed.insert(key, calibration.is_ok());
        }
        move |child| {
            let key = (child.executable.name.clone(), child.job.axes);
            passed.get(&key).copied().unwrap_or(true)
        }
    }

    fn measure_peaks(&mut self, record: &mut Record, stop: &AtomicBool) {
        let lanes =
            SelectedLanes::new(self.settings.lanes).unwrap_or_else(|_| SelectedLanes::any());
        let mut counts: Vec<usize> = self
            .slots
            .iter()
            .map(|slot| slot.work.processors())
            .collect();
        counts.sort_unstable();
        counts.dedup();
        for threads in counts {
            if !stop.load(Ordering::Relaxed) {
                let peaks = Peaks::measure(threads, lanes);
                record.push(rows::peaks_row(&peaks));
                self.peaks.push(peaks);
            }
        }
    }
}

fn failure(mut row: Row, reason: &str) -> Row {
    row.fail(reason);
    row
}
