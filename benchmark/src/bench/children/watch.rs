//! The time that a process has, and its end when that is over or the user stops.

use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Interval at which an interrupt is looked for: short enough for a person, too long to be measured.
const LOOK: Duration = Duration::from_millis(200);
/// Time that a process has to end by itself after an interrupt, to write what it has.
const GRACE: Duration = Duration::from_secs(5);

/// Reason for which a process came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EndCause {
    /// By itself, or by an interrupt.
    Itself,
    /// Its time was over.
    TimedOut,
    /// It wrote more to its outputs than is kept.
    Flooded,
}

/// Starts a command in a group of processes of its own, so that all that it starts can be ended together. An interrupt from a
/// terminal does then not reach it; [`until_done`] hands it on.
#[cfg(unix)]
pub(super) fn apart(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    command.process_group(0);
}

/// Elsewhere a process is ended with those that it started by its own number.
#[cfg(not(unix))]
pub(super) fn apart(_: &mut Command) {}

/// Waits for the process `id`, and ends it with its group after `timeout`, or where `floods` finds too much on its outputs. An
/// interrupt is handed on to it.
pub(super) fn until_done<T>(
    id: u32,
    timeout: Duration,
    floods: impl Fn() -> bool + Send,
    stop: &AtomicBool,
    wait: impl FnOnce() -> T,
) -> (T, EndCause) {
    let (done, told) = channel::<()>();
    thread::scope(|scope| {
        let watch = scope.spawn(move || {
            let begun = Instant::now();
            let mut asked: Option<Instant> = None;
            loop {
                let left = timeout.saturating_sub(begun.elapsed());
                match told.recv_timeout(left.min(LOOK)) {
                    Err(RecvTimeoutError::Timeout) => {}
                    Ok(()) | Err(RecvTimeoutError::Disconnected) => return EndCause::Itself,
                }
                if begun.elapsed() >= timeout {
                    end(id, Force::Kill);
                    return EndCause::TimedOut;
                }
                if floods() {
                    end(id, Force::Kill);
                    return EndCause::Flooded;
                }
                if stop.load(Ordering::Relaxed) {
                    match asked {
                        None => {
                            end(id, Force::Interrupt);
                            asked = Some(Instant::now());
                        }
                        Some(when) if when.elapsed() >= GRACE => {
                            end(id, Force::Kill);
                            return EndCause::Itself;
                        }
                        Some(_) => {}
                    }
                }
            }
        });
        let result = wait();
        drop(done);
        // A thread that does nothing but look at clocks does not panic.
        (result, watch.join().unwrap_or(EndCause::Itself))
    })
}

/// Signal that ends a group of processes.
#[derive(Clone, Copy)]
enum Force {
    Interrupt,
    Kill,
}

/// A group that is gone already is no fault.
#[cfg(unix)]
fn end(id: u32, force: Force) {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;
    let signal = match force {
        Force::Interrupt => Signal::SIGINT,
        Force::Kill => Signal::SIGKILL,
    };
    if let Ok(id) = i32::try_from(id) {
        let _ = killpg(Pid::from_raw(id), signal);
    }
}

/// Elsewhere an interrupt reaches it from the terminal.
#[cfg(not(unix))]
fn end(id: u32, force: Force) {
    if matches!(force, Force::Kill) {
        let _ = Command::new("taskkill")
            .args(["/T", "/F", "/PID", &id.to_string()])
            .output();
    }
}
