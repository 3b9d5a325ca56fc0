//! The words that rows are written with: the vocabulary, and parts of scenes and runs.

pub(super) use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};
pub(super) use std::sync::Arc;

pub(super) use proctor_laws::{AnyLaw, NeoHookean};
pub(super) use proctor_scene::simulation::{
    EventKind, InitialState, Options, SetupError, Simulation, StartError, StepError, StepErrorKind,
};
pub(super) use proctor_scene::{
    BodyBoundary, Contact, ContactNormal, Damping, Dimension, DomainUpdate, Enforcement, History,
    Mesh, MortarContact, OnImbalance, Outside, ParticleSeed, PlaneCondition, RigidSurface, Scene,
    Shape, StressScheme, TimeStep, Transfer, TransferKind, Vector, Vertices, VolumetricStrain,
    Weighting,
};

pub(super) use super::gates::*;
pub(super) use super::particles::*;
pub(super) use super::starts::*;
pub(super) use super::vocabulary::*;
pub(super) use super::{Extreme, Finding, Result, RowFault, RowVerdict};
pub(super) use crate::case::Gate;
pub(super) use crate::cases::{
    AT_REST, confined_modulus as confined, cuboid, elastic_law as elastic, equal_steps_of as fixed,
    larger as worst, moving, moving_along_x, rectangle, starting, uniaxial,
};
pub(super) use crate::generated::{apart, largest};
pub(super) use crate::settings::Method;
pub(super) use crate::stability::map::{SCHEMES, TRANSFERS, WEIGHTINGS};
pub(super) use crate::stability::nonlinear::{METHODS, energy};
pub(super) use crate::stability::scene::method_of;
