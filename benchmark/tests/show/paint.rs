//! Colours of a terminal, and their symbols.

use proctor_benchmark::show::paint::{Mark, Paint};

#[test]
fn every_colour_has_a_symbol_of_its_own() {
    let marks = [Mark::Held, Mark::Failed, Mark::Attention];
    for (i, mark) in marks.iter().enumerate() {
        assert_eq!(mark.symbol().chars().count(), 1);
        assert!(
            marks[..i]
                .iter()
                .all(|other| other.symbol() != mark.symbol())
        );
        assert_eq!(Paint::NONE.symbol(*mark), mark.symbol());
        let coloured = Paint { colour: true }.symbol(*mark);
        assert!(coloured.starts_with('\u{1b}') && coloured.contains(mark.symbol()));
        assert!(coloured.ends_with("\u{1b}[0m"), "{coloured:?}");
    }
}
