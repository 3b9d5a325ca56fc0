//! The estimate of the time that is left.

/// Share of an expectation that counts as if it had been measured, so that the first moments of a run cannot turn it over.
const TRUSTED: f64 = 0.1;
/// Share from which work that nobody expected anything of tells how long all of it takes, and after which time \[s\].
const TELLING: (f64, f64) = (0.01, 0.5);
/// Time from which on minutes are told \[s\].
const MINUTES: f64 = 120.0;

/// Time that is left \[s\], when `share` of the work (0 to 1) took `elapsed` \[s\]. With an expectation of the whole \[s\] it is
/// that at first, and more and more what the work itself shows; without one nothing is known at first.
#[must_use]
pub fn left(expected: Option<f64>, share: f64, elapsed: f64) -> Option<f64> {
    let share = share.clamp(0.0, 1.0);
    match expected.filter(|whole| *whole > 0.0) {
        Some(whole) => {
            let trusted = TRUSTED * whole;
            let slower = (elapsed + trusted) / (share * whole + trusted);
            Some(slower * whole * (1.0 - share))
        }
        None if share < TELLING.0 || elapsed < TELLING.1 => None,
        None => Some(elapsed * (1.0 - share) / share),
    }
}

/// Time that is left \[s\], in words; none where nothing is known.
#[must_use]
pub fn words(left: Option<f64>) -> String {
    match left {
        None => String::new(),
        Some(seconds) if seconds < MINUTES => {
            format!("about {:.0} s left", seconds.ceil().max(1.0))
        }
        Some(seconds) => format!("about {:.0} min left", (seconds / 60.0).ceil()),
    }
}
