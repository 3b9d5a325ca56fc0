//! The largest stable step between the entries of its table.

use crate::common::{SCHEMES, WEIGHTINGS};
use proctor_scene::plan::stability_number;
use proctor_scene::{TransferKind, Weighting};

/// Half-lengths of domains that are entries of the table \[cells\].
const ENTRIES: [f64; 3] = [0.5, 0.25, 0.125];

/// Between two entries the number is that of the line between them, above the largest it is that of the largest, and it
/// never rises where domains become smaller.
#[test]
fn numbers_between_two_entries_are_on_their_line() {
    for weighting in WEIGHTINGS {
        for scheme in SCHEMES {
            for transfer in [TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic] {
                let number = |half: f64| stability_number(weighting, scheme, transfer, half);
                for [upper, lower] in [[ENTRIES[0], ENTRIES[1]], [ENTRIES[1], ENTRIES[2]]] {
                    for share in [0.0, 0.25, 0.5, 0.9] {
                        let line = number(lower) + share * (number(upper) - number(lower));
                        let found = number(lower + share * (upper - lower));
                        let what = format!("{weighting:?} {scheme:?} {transfer:?} {share}");
                        assert!((found / line - 1.0).abs() < 1e-14, "{what}: {found} {line}");
                    }
                    assert!(number(upper) >= number(lower));
                    if let Weighting::UniformGimp | Weighting::ContiguousGimp(_) = weighting {
                        assert!(number(upper) > number(lower));
                    }
                }
                assert_eq!(number(0.7), number(ENTRIES[0]));
            }
        }
    }
}
