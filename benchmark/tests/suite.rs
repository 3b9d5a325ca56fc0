//! Cases by wrong references beside the correct ones.

use proctor_benchmark::suite::{Against, CaseRun, run_side_by_side};
use proctor_scene::simulation::Options;
use proctor_verification::case::find;
use std::convert::Infallible;

/// Short ladders of cases, each of which meets its wrong references in another way.
fn ran(against: Against) -> Vec<CaseRun> {
    let names = ["bar", "element", "staggered-start", "slipping-disk"];
    let cases = names.map(|name| find(name).expect("there is one"));
    let mut all = vec![];
    let each = |ran| -> Result<(), Infallible> {
        all.push(ran);
        Ok(())
    };
    let options = Options::default();
    let Ok(()) = run_side_by_side(&cases, against, &options, 2, &|| true, &|_, _| (), each);
    all
}

#[test]
fn wrong_references_change_no_number_of_the_correct_one() {
    let numbers = |all: &[CaseRun]| -> Vec<String> {
        let rungs = all.iter().flat_map(|ran| &ran.rungs);
        let solved = rungs.map(|ran| ran.solved.as_ref().expect("it runs"));
        let quantities = solved.flat_map(|run| &run.quantities);
        quantities.map(|q| format!("{q:?}")).collect()
    };
    let [correct, wrong] = [Against::Correct, Against::Wrong].map(ran);
    assert!(wrong.iter().all(CaseRun::passed));
    assert!(wrong.iter().all(|ran| !ran.case.wrong().is_empty()));
    assert_eq!(numbers(&correct), numbers(&wrong));
}
