//! References that describe another problem than the kernel solves, and by how much: below that the error of a mesh is
//! hidden, and no bar from differences of meshes can see it.

/// Cases whose "cell size" is a time step of one material point.
pub const WITHOUT_MESH: [&str; 2] = ["element", "shear-and-turn"];

/// A case or one of its variants, the relative error that its reference makes, and the reason, all from the text of the case.
const REFERENCES: [(&str, f64, &str); 15] = [
    ("step-bar", 1e-4, "small strain"),
    ("sudden-weight", 1e-4, "small strain"),
    ("yielding-column", 2e-3, "small strain"),
    ("base-acceleration/p-wave", 2e-2, "small strain"),
    ("rotation", 1e-4, "a rigid body"),
    ("rolling-disk", 3e-2, "a rigid body and creep"),
    ("hertz-slab", 6e-2, "Hertz's half-plane"),
    ("hertz-sphere", 5e-2, "Hertz's half-space"),
    ("corner-block", ALL, "a rigid body"),
    ("ironing", 1e-2, "finite elements"),
    ("slipping-disk", ALL, "a rigid body"),
    ("spinning-collision", 6e-3, "rigid bodies"),
    ("cantilever", 2e-3, "finite elements"),
    ("softening-bar", 2e-2, "the mean crack"),
    ("fluid/Bingham drag", 1e-5, "a regularised yield stress"),
];

/// Every error of the case is hidden.
const ALL: f64 = f64::INFINITY;

/// The relative error below which the reference of a ladder hides that of the mesh; 0 where it is exact.
pub(super) fn hidden_by(case: &str, ladder: &str) -> f64 {
    let of = |(name, _, _): &&(&str, f64, &str)| *name == case || *name == ladder;
    REFERENCES
        .iter()
        .find(of)
        .map_or(0.0, |(_, error, _)| *error)
}
