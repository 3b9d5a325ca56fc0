//! The mill of manufactured solutions: its derivations, three fixed families, and faults that its gates must notice.

mod derivation;
mod families;
mod faults;

use proctor_scene::{DomainUpdate, StressScheme, TransferKind, Weighting};
use proctor_verification::mill::draw::{self, Choice};
use proctor_verification::mill::material::Kind;
use proctor_verification::mill::problem::{Family, Problem};
use proctor_verification::settings::Method;

/// cpGIMP whose domains follow the stretch along the axes of space.
const CONTIGUOUS: Weighting = Weighting::ContiguousGimp(DomainUpdate::LeftStretch);

/// A method with cpGIMP.
const fn method(scheme: StressScheme, transfer: TransferKind) -> Method {
    Method {
        weighting: CONTIGUOUS,
        scheme,
        transfer,
    }
}

/// A problem in the plane of a fixed seed, on meshes of 8 and 16 cells, and of 24 where it yields.
fn problem(family: Family, kind: Kind, method: Method) -> Problem {
    let choice = Choice {
        axes: 2,
        family,
        kind,
        method,
    };
    let mut problem = draw::of(&mut draw::dice(7, 3, 0), &choice, family.word().to_owned())
        .expect("a problem that has a solution");
    if !kind.yields() {
        problem.ladder = vec![8, 16];
    }
    problem
}
