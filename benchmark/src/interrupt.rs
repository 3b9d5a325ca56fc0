//! Ctrl-C as a flag, so that what was measured is still written.

use crate::exit::Failure;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a command that was interrupted, as a shell has it.
pub const EXIT_CODE: u8 = 130;

/// Raised by Ctrl-C. Work that may take long asks for it between its parts.
#[derive(Clone, Debug)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on. The first Ctrl-C raises the flag, a second one ends the process at once.
    ///
    /// # Errors
    /// [`Failure::BadInput`] if the system lets nobody listen, or something in this process listens already.
    pub fn listen() -> Result<Self, Failure> {
        let flag = Arc::new(AtomicBool::new(false));
        let raised = Arc::clone(&flag);
        ctrlc::set_handler(move || {
            if raised.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(EXIT_CODE));
            }
        })
        .map_err(|error| Failure::BadInput(format!("cannot listen to Ctrl-C: {error}")))?;
        Ok(Self(flag))
    }

    /// The flag itself, for work that only looks at it.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.0
    }

    /// Whether the work should end.
    #[must_use]
    pub fn raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
