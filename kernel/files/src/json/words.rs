//! Words of the scene language, and the nearest known one to a word that is not.

use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_kernel::{transfers, weighting};
use proctor_scene::{
    ContactNormal, Dimension, Enforcement, Field, NodalField, OnImbalance, Outside, Permeability,
    PlaneCondition, StressScheme, TransferKind, VolumetricStrain, Weighting,
};

/// A word and what it means.
pub(super) type Words<T> = &'static [(&'static str, T)];

/// Weighting functions, the first of those with the same word; the domain update tells them apart. `GIMP` is what the
/// manuals' program makes of it: domains keep their initial size.
pub(super) fn shape_functions() -> Vec<(&'static str, Weighting)> {
    let mut words: Vec<(&'static str, Weighting)> = vec![];
    for kind in weighting::ALL {
        if words.iter().all(|(word, _)| *word != kind.word) {
            if kind.weighting == Weighting::UniformGimp {
                words.push(("GIMP", kind.weighting));
            }
            words.push((kind.word, kind.weighting));
        }
    }
    words
}

/// Domain updates of all weighting functions that have one.
pub(super) fn domain_updates() -> Vec<(&'static str, Weighting)> {
    (weighting::ALL.iter())
        .filter_map(|kind| Some((kind.update?, kind.weighting)))
        .collect()
}

pub(super) const SCHEMES: Words<StressScheme> = &[
    ("USF", StressScheme::Usf),
    ("USL", StressScheme::Usl),
    ("MUSL", StressScheme::Musl),
];

pub(super) fn transfers() -> Vec<(&'static str, TransferKind)> {
    transfers::ALL
        .iter()
        .map(|kind| (kind.word, kind.transfer))
        .collect()
}

pub(super) const VOLUMETRIC_STRAINS: Words<VolumetricStrain> = &[
    ("particle", VolumetricStrain::Particle),
    ("cell_average", VolumetricStrain::CellAverage),
];

pub(super) const PLANE_CONDITIONS: Words<PlaneCondition> = &[
    ("free", PlaneCondition::Free),
    ("sliding", PlaneCondition::Sliding),
    ("fixed", PlaneCondition::Fixed),
    ("antisymmetric", PlaneCondition::Antisymmetric),
    ("absorbing", PlaneCondition::Absorbing),
];

/// Conditions of planes for pore water.
pub(super) const WATER_CONDITIONS: Words<PlaneCondition> = &[
    ("free", PlaneCondition::Free),
    ("sliding", PlaneCondition::Sliding),
    ("fixed", PlaneCondition::Fixed),
];

/// Laws of the conductivity of a skeleton.
pub(super) const PERMEABILITIES: Words<Permeability> = &[
    ("constant", Permeability::Constant),
    ("square", Permeability::Square),
    ("kozeny_carman", Permeability::KozenyCarman),
];

/// Kinds of damping.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum DampingKind {
    None,
    Local,
    Kinetic,
    Viscous,
}

pub(super) const DAMPINGS: Words<DampingKind> = &[
    ("none", DampingKind::None),
    ("local", DampingKind::Local),
    ("kinetic", DampingKind::Kinetic),
    ("viscous", DampingKind::Viscous),
];

/// Kinds of shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ShapeKind {
    Cuboid,
    Rectangle,
    Sphere,
    Disc,
    Ring,
    Cylinder,
    Polygon,
    ExtrudedPolygon,
    Between,
    Solid,
    Particles,
}

/// Shapes in three dimensions.
const SHAPES_3: Words<ShapeKind> = &[
    ("cuboid", ShapeKind::Cuboid),
    ("sphere", ShapeKind::Sphere),
    ("cylinder", ShapeKind::Cylinder),
    ("extruded_polygon", ShapeKind::ExtrudedPolygon),
    ("between", ShapeKind::Between),
    ("solid", ShapeKind::Solid),
    ("particles", ShapeKind::Particles),
];

/// Shapes in two dimensions.
const SHAPES_2: Words<ShapeKind> = &[
    ("cuboid", ShapeKind::Cuboid),
    ("rectangle", ShapeKind::Rectangle),
    ("disc", ShapeKind::Disc),
    ("ring", ShapeKind::Ring),
    ("polygon", ShapeKind::Polygon),
    ("between", ShapeKind::Between),
    ("particles", ShapeKind::Particles),
];

/// Shapes that exist in a number of dimensions.
pub(super) fn shapes(dimension: Dimension) -> Words<ShapeKind> {
    match dimension {
        Dimension::Two => SHAPES_2,
        Dimension::Three => SHAPES_3,
    }
}

pub(super) const AXES: Words<usize> = &[("x", 0), ("y", 1), ("z", 2)];

/// Planes by axis and side.
pub(super) const PLANES: Words<(usize, usize)> = &[
    ("X0", (0, 0)),
    ("Xn", (0, 1)),
    ("Y0", (1, 0)),
    ("Yn", (1, 1)),
    ("Z0", (2, 0)),
    ("Zn", (2, 1)),
];

/// Quantity of a base record.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    Acceleration,
    Velocity,
}

pub(super) const QUANTITIES: Words<Quantity> = &[
    ("acceleration", Quantity::Acceleration),
    ("velocity", Quantity::Velocity),
];

/// Bases under the ground.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Base {
    Rigid,
    Compliant,
}

pub(super) const BASES: Words<Base> = &[("rigid", Base::Rigid), ("compliant", Base::Compliant)];

/// Motions that a record is of, where the base is compliant.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum RecordedMotion {
    Outcrop,
    Incoming,
}

pub(super) const RECORDED_MOTIONS: Words<RecordedMotion> = &[
    ("outcrop", RecordedMotion::Outcrop),
    ("incoming", RecordedMotion::Incoming),
];

/// Velocities at the start: true keeps those of another run.
pub(super) const START_VELOCITIES: Words<bool> = &[("zero", false), ("kept", true)];

pub(super) const OUTSIDES: Words<Outside> = &[("stop", Outside::Stop), ("remove", Outside::Remove)];

pub(super) const ON_IMBALANCE: Words<OnImbalance> =
    &[("tell", OnImbalance::Tell), ("stop", OnImbalance::Stop)];

/// Fields of frames; `all` and `none` stand for lists.
pub(super) const FIELDS: Words<&[Field]> = &[
    ("id", &[Field::Id]),
    ("material", &[Field::Material]),
    ("body", &[Field::Body]),
    ("active", &[Field::Active]),
    ("mass", &[Field::Mass]),
    ("volume", &[Field::Volume]),
    ("density", &[Field::Density]),
    ("displacement", &[Field::Displacement]),
    ("velocity", &[Field::Velocity]),
    ("stress", &[Field::Stress]),
    ("pressure", &[Field::Pressure]),
    ("deformation_gradient", &[Field::DeformationGradient]),
    ("external_force", &[Field::ExternalForce]),
    ("internal_variables", &[Field::InternalVariables]),
    ("all", &Field::ALL),
    ("none", &[]),
];

/// Fields of grid frames.
pub(super) const NODAL_FIELDS: Words<&[NodalField]> = &[
    ("mass", &[NodalField::Mass]),
    ("velocity", &[NodalField::Velocity]),
    ("body", &[NodalField::Body]),
    ("contact_force", &[NodalField::ContactForce]),
    ("contact_gap", &[NodalField::ContactGap]),
    ("all", &NodalField::ALL),
    ("none", &[]),
];

pub(super) const CONTACT_NORMALS: Words<ContactNormal> = &[
    ("master", ContactNormal::Master),
    ("slave", ContactNormal::Slave),
    ("collinear", ContactNormal::Collinear),
];

/// Methods of contact.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ContactMethod {
    Grid,
    Mortar,
}

pub(super) const CONTACT_METHODS: Words<ContactMethod> = &[
    ("grid", ContactMethod::Grid),
    ("mortar", ContactMethod::Mortar),
];

pub(super) const ENFORCEMENTS: Words<Enforcement> = &[
    ("barrier", Enforcement::Barrier),
    ("penalty", Enforcement::Penalty),
];

pub(super) const DETECTIONS: Words<Detection> = &[
    ("mortar", Detection::Mortar),
    ("node_to_segment", Detection::NodeToSegment),
];

pub(super) const FOLLOWS: Words<FollowMode> = &[
    ("unaugmented", FollowMode::Unaugmented),
    ("velocity", FollowMode::Velocity),
    ("spin", FollowMode::Spin),
    ("gradient", FollowMode::Gradient),
    ("material", FollowMode::Material),
];

/// Meaning of a word; upper and lower case are the same.
pub(super) fn meaning<T: Copy>(word: &str, words: &[(&str, T)]) -> Option<T> {
    words
        .iter()
        .find(|(known, _)| known.eq_ignore_ascii_case(word))
        .map(|(_, meaning)| *meaning)
}

/// The known word that is most like `word`, if one is like it at all.
#[must_use]
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    known
        .into_iter()
        .map(|candidate| {
            let likeness = strsim::normalized_damerau_levenshtein(&word, &candidate.to_lowercase());
            (likeness, candidate)
        })
        // Half of the letters: `youngs_modulus` is still like `young` by its start, below.
        .filter(|(likeness, candidate)| {
            *likeness >= 0.5 || (candidate.len() >= 4 && word.starts_with(*candidate))
        })
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// `a`, `b` or `c`.
#[must_use]
pub fn listed<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let words: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    match words.as_slice() {
        [] => "nothing".to_owned(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} or {last}", most.join(", ")),
    }
}

/// The words that a key of the method accepts: `shape_function`, `stress_scheme_update` or `transfer`; none for any
/// other key.
#[must_use]
pub fn words_of(key: &str) -> Vec<&'static str> {
    fn names<T>(words: &[(&'static str, T)]) -> Vec<&'static str> {
        words.iter().map(|(name, _)| *name).collect()
    }
    match key {
        "shape_function" => names(&shape_functions()),
        "stress_scheme_update" => names(SCHEMES),
        "transfer" => names(&transfers()),
        _ => vec![],
    }
}
