//! The words that cases are written with: parts of scenes, laws, runs, comparisons, gates and ladders.

pub(crate) use std::f64::consts::{FRAC_PI_2, PI, TAU};
pub(crate) use std::sync::{Arc, OnceLock};

pub(crate) use proctor_contact::geometry::mortar::Point;
pub(crate) use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
pub(crate) use proctor_contact::geometry::mortar::motion::FollowMode;
pub(crate) use proctor_contact::geometry::surface::{Surface, SurfaceError};
pub(crate) use proctor_laws::{
    AnyLaw, Band, Bingham, ConeMatch, DruckerPrager, EquationOfState, LinearElastic, MohrCoulomb,
    NeoHookean, Newtonian, ObjectiveRate, Residual, Softening, Tresca, VonMises,
};
pub(crate) use proctor_scene::simulation::{
    InitialField, InitialState, Options, Simulation, StepError,
};
pub(crate) use proctor_scene::{
    BaseMotion, Body, BodyBoundary, BoxLoad, Contact, ContactNormal, Damping, Dimension,
    DomainUpdate, Field, HeldBox, History, InitialPressure, InitialStress, Material, Mesh, Mortar,
    MortarContact, Motion, ParticleSeed, PlaneCondition, PointLoad, PoreWater, Results,
    RigidFacets, RigidLine, Scene, Shape, StressScheme, TimeStep, Traction, TransferKind, Vector,
    Vertices, VolumetricStrain, Weighting,
};

pub(crate) use super::vocabulary::mortar::{self, *};
pub(crate) use super::vocabulary::parts::*;
pub(crate) use super::vocabulary::relaxation::*;
pub(crate) use super::vocabulary::stepping::*;
pub(crate) use super::vocabulary::wet::*;
pub(crate) use super::{FIELDS, PARTED, STRESS_MEASURE, known_reference};
pub(crate) use crate::case::gates::{
    GateRule, Runs, TableRule, error, excess, order, reciprocal_order, share, value, worst,
};
pub(crate) use crate::case::ladder::Ladder;
pub(crate) use crate::case::wrong::{Reference, Wrong};
pub(crate) use crate::case::{
    Case, Curve, CurvePoint, Drawing, Gate, Measurements, Plan, Quantity, Run, Rung, RungResult,
    Size, Verdict,
};
pub(crate) use crate::convergence::relative_l2;
pub(crate) use crate::guest::{self, ComparedField, Guest, Norm, Reading, Snapshot};
pub(crate) use crate::settings::{Method, Settings};
pub(crate) use crate::study::{Failure, Measure, Observer, Phase, few};
