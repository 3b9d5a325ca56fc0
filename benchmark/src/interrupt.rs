//! Ctrl-C and a polite end from outside as a flag, so that what was measured is still written.

use crate::exit::{Failure, Outcome};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Signals that end work between its parts, each with the exit code of a command that it ended, as a shell has it.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, 130), (SIGTERM, 143)];

/// Raised by SIGINT (Ctrl-C) and SIGTERM (what `kill`, `timeout` and schedulers of jobs send). Work that may take long asks
/// for it between its parts.
#[derive(Clone, Debug)]
pub struct Interrupt {
    raised: Arc<AtomicBool>,
    /// Exit code of the signal that came last.
    code: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens from now on. The first signal raises the flag, a second one ends the process at once.
    ///
    /// # Errors
    /// [`Failure::BadInput`] if the system lets nobody listen.
    pub fn listen() -> Result<Self, Failure> {
        let interrupt = Self {
            raised: Arc::new(AtomicBool::new(false)),
            code: Arc::new(AtomicUsize::new(SIGNALS[0].1.into())),
        };
        let listen = |(signal, code): (i32, u8)| {
            // In this order: what ends the process looks at the flag before this signal raises it.
            flag::register_conditional_shutdown(
                signal,
                code.into(),
                Arc::clone(&interrupt.raised),
            )?;
            flag::register_usize(signal, Arc::clone(&interrupt.code), code.into())?;
            flag::register(signal, Arc::clone(&interrupt.raised))
        };
        for (signal, code) in SIGNALS {
            listen((signal, code)).map_err(|error| {
                Failure::BadInput(format!("cannot listen to signals of the system: {error}"))
            })?;
        }
        Ok(interrupt)
    }

    /// The flag itself, for work that only looks at it.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.raised
    }

    /// True if the work should end.
    #[must_use]
    pub fn raised(&self) -> bool {
        self.raised.load(Ordering::Relaxed)
    }

    /// Ending of a verb that was interrupted.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        let code = self.code.load(Ordering::Relaxed);
        Outcome::Interrupted(u8::try_from(code).unwrap_or(SIGNALS[0].1))
    }
}
