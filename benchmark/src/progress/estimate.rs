//! The estimate of the time that is left.

/// Share of an expectation that counts as if it had been measured, so that the first moments of a run cannot turn it over.
const TRUSTED: f64 = 0.1;
/// Share from which work that nobody expected anything of tells how long all of it takes, and after which time \[s\].
const TELLING: (f64, f64) = (0.01, 0.5);
/// Time from which on minutes are told \[s\].
const MINUTES: f64 = 120.0;

/// Time that is left \[s\], when `share` of the work (0 to 1) took `elapsed` \[s\]. With an expectation of the whole \[s\] it is
/// that at first, and more and more what the work itself shows; without one nothing is known at first.
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

/// The same in words; none where nothing is known.
pub fn words(left: Option<f64>) -> String {
    match left {
        None => String::new(),
        Some(seconds) if seconds < MINUTES => {
            format!("about {:.0} s left", seconds.ceil().max(1.0))
        }
        Some(seconds) => format!("about {:.0} min left", (seconds / 60.0).ceil()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_the_start_an_expectation_is_told_and_nothing_else() {
        assert_eq!(words(left(Some(95.0), 0.0, 0.0)), "about 95 s left");
        assert_eq!(words(left(None, 0.0, 0.0)), "");
        assert_eq!(words(left(None, 0.001, 10.0)), "");
        assert_eq!(words(left(None, 0.02, 0.1)), "");
        for expected in [None, Some(0.0), Some(0.4), Some(50.0), Some(5000.0)] {
            for share in [0.0, 0.005, 0.1] {
                let said = words(left(expected, share, 1.0));
                assert!(!said.contains(" 0 "), "{expected:?} {share}: {said}");
            }
        }
    }

    #[test]
    fn a_machine_half_as_fast_is_found_out_on_the_way() {
        // A hundred seconds were expected, and half of it took a hundred.
        let found = left(Some(100.0), 0.5, 100.0).expect("known");
        assert!((85.0..100.0).contains(&found), "{found}");
        let found = left(Some(100.0), 0.95, 190.0).expect("known");
        assert!((9.0..10.0).contains(&found), "{found}");
        assert_eq!(left(Some(100.0), 1.0, 300.0), Some(0.0));
    }

    #[test]
    fn without_an_expectation_the_work_itself_tells() {
        assert_eq!(left(None, 0.25, 10.0), Some(30.0));
        assert_eq!(words(Some(300.0)), "about 5 min left");
        assert_eq!(words(Some(0.3)), "about 1 s left");
        assert_eq!(words(Some(0.0)), "about 1 s left");
    }
}
